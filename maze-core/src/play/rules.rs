//! A run of the game: start, goal, a clock in ticks, and the events that sound and screen react to.

use crate::maze::Maze;
use crate::physics::gravity::Tilt;
use crate::physics::tick::Tick;
use nalgebra::Vector2;

/// Where a run stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// The ball waits at the start; the clock stands until the board is tilted.
    Ready,
    /// The clock counts.
    Playing,
    /// The ball has reached the goal; the clock stands.
    Finished,
}

impl Phase {
    /// As in the state log: `ready`, `playing`, `finished`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Ready => "ready",
            Self::Playing => "playing",
            Self::Finished => "finished",
        }
    }
}

/// Something that happened in one tick.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Event {
    /// The board was tilted for the first time.
    Started,
    /// The ball hit a wall with this normal speed (units/s).
    Bounced(f64),
    /// The goal was reached after so many ticks.
    Finished(u64),
}

/// One attempt at a maze.
///
/// ```
/// use maze_core::layout::{Algorithm, Recipe};
/// use maze_core::{Autopilot, Engine, Phase, Run, gravity};
///
/// let maze = Recipe::new(8, 6, Algorithm::Eller, 1).maze()?;
/// let mut engine = maze.exact_engine(0.03)?;
/// let mut autopilot = Autopilot::new(&maze, 0.17)?; // the tangent of half of 20 degrees
/// let mut run = Run::new(&maze);
/// while run.phase() != Phase::Finished {
///     let (tilt, from) = (autopilot.tilt(engine.ball()), engine.ball().position);
///     let tick = engine.tick(gravity::project(gravity::WORLD_GRAVITY, &tilt.world_from_maze()))?;
///     for event in run.observe(tilt, [from, engine.ball().position], &tick) {
///         println!("tick {}: {event:?}", run.n_ticks());
///     }
/// #   assert!(run.n_ticks() < 10_000);
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Run {
    goal: Vector2<f64>,
    goal_radius: f64,
    phase: Phase,
    n_ticks: u64,
}

impl Run {
    /// A run that has not begun.
    pub fn new(maze: &Maze) -> Self {
        Self { goal: maze.goal(), goal_radius: maze.goal_radius(), phase: Phase::Ready, n_ticks: 0 }
    }

    /// Where the run stands.
    pub fn phase(&self) -> Phase {
        self.phase
    }

    /// Ticks since the board was first tilted, up to the goal.
    pub fn n_ticks(&self) -> u64 {
        self.n_ticks
    }

    /// Takes note of one tick: the tilt it was made under, where the ball was before and after it, and what the engine reported.
    pub fn observe(
        &mut self,
        tilt: Tilt,
        [from, to]: [Vector2<f64>; 2],
        tick: &Tick,
    ) -> impl Iterator<Item = Event> + use<> {
        let mut events = [None; 3];
        if self.phase == Phase::Ready && tilt != Tilt::LEVEL {
            self.phase = Phase::Playing;
            events[0] = Some(Event::Started);
        }
        if 0 < tick.n_hits {
            events[1] = Some(Event::Bounced(tick.hardest_hit_speed));
        }
        if self.phase == Phase::Playing {
            self.n_ticks += 1;
            // The whole line counts: a fast ball must not jump over the goal between two ticks.
            if distance_to_segment(self.goal, from, to) < self.goal_radius {
                self.phase = Phase::Finished;
                events[2] = Some(Event::Finished(self.n_ticks));
            }
        }
        events.into_iter().flatten()
    }
}

/// From a point to the nearest point of a segment.
fn distance_to_segment(point: Vector2<f64>, from: Vector2<f64>, to: Vector2<f64>) -> f64 {
    let line = to - from;
    let length_squared = line.norm_squared();
    let fraction = if 0.0 < length_squared { (point - from).dot(&line) / length_squared } else { 0.0 };
    (point - (from + line * fraction.clamp(0.0, 1.0))).norm()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run() -> Run {
        Run { goal: Vector2::new(3.0, 0.0), goal_radius: 0.35, phase: Phase::Ready, n_ticks: 0 }
    }

    const TILTED: Tilt = Tilt { towards_x: 100, towards_y: 0 };

    fn still(x: f64) -> [Vector2<f64>; 2] {
        [Vector2::new(x, 0.0); 2]
    }

    #[test]
    fn clock_starts_with_the_first_tilt_and_stops_at_the_goal() {
        let mut run = run();
        let quiet = Tick::default();
        assert_eq!(run.observe(Tilt::LEVEL, still(0.0), &quiet).count(), 0);
        assert_eq!((run.phase(), run.n_ticks()), (Phase::Ready, 0));
        assert_eq!(run.observe(TILTED, still(0.0), &quiet).collect::<Vec<_>>(), [Event::Started]);
        assert_eq!(run.observe(Tilt::LEVEL, still(2.0), &quiet).count(), 0);
        let events: Vec<_> = run.observe(TILTED, still(2.8), &quiet).collect();
        assert_eq!(events, [Event::Finished(3)]);
        assert_eq!(run.observe(TILTED, still(9.0), &quiet).count(), 0);
        assert_eq!((run.phase(), run.n_ticks()), (Phase::Finished, 3));
    }

    #[test]
    fn a_ball_that_jumps_over_the_goal_in_one_tick_has_reached_it() {
        let line = |y: f64| [Vector2::new(1.0, y), Vector2::new(5.0, y)];
        assert_eq!(run().observe(TILTED, line(0.5), &Tick::default()).count(), 1);
        assert_eq!(run().observe(TILTED, line(0.3), &Tick::default()).count(), 2);
    }

    #[test]
    fn bounces_are_events() {
        let tick = Tick { n_hits: 1, hardest_hit_speed: 2.5, ..Tick::default() };
        let events: Vec<_> = run().observe(Tilt::LEVEL, still(0.0), &tick).collect();
        assert_eq!(events, [Event::Bounced(2.5)]);
    }
}
