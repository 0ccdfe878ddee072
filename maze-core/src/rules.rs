//! A run of the game: start, goal, a clock in ticks, and the events that sound and screen react to.

use crate::engine::Tick;
use crate::gravity::Tilt;
use crate::maze::Maze;
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
pub enum Event {
    /// The board was tilted for the first time.
    Started,
    /// The ball hit a wall with this normal speed (units/s).
    Bounced(f64),
    /// The goal was reached after so many ticks.
    Finished(u64),
}

/// One attempt at a maze.
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
        Self { goal: maze.goal, goal_radius: maze.goal_radius, phase: Phase::Ready, n_ticks: 0 }
    }

    /// Where the run stands.
    pub fn phase(&self) -> Phase {
        self.phase
    }

    /// Ticks since the board was first tilted, up to the goal.
    pub fn n_ticks(&self) -> u64 {
        self.n_ticks
    }

    /// Takes note of one tick: the tilt it was made under, where the ball is after it, and what the engine reported.
    pub fn observe(
        &mut self,
        tilt: Tilt,
        position: Vector2<f64>,
        tick: &Tick,
    ) -> impl Iterator<Item = Event> {
        let mut events = [None; 3];
        if self.phase == Phase::Ready && tilt != Tilt::LEVEL {
            self.phase = Phase::Playing;
            events[0] = Some(Event::Started);
        }
        if 0 < tick.n_hits {
            events[1] = Some(Event::Bounced(tick.hardest_hit));
        }
        if self.phase == Phase::Playing {
            self.n_ticks += 1;
            if (position - self.goal).norm() < self.goal_radius {
                self.phase = Phase::Finished;
                events[2] = Some(Event::Finished(self.n_ticks));
            }
        }
        events.into_iter().flatten()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run() -> Run {
        Run { goal: Vector2::new(3.0, 0.0), goal_radius: 0.35, phase: Phase::Ready, n_ticks: 0 }
    }

    const TILTED: Tilt = Tilt { towards_x: 100, towards_y: 0 };

    #[test]
    fn clock_starts_with_the_first_tilt_and_stops_at_the_goal() {
        let mut run = run();
        let quiet = Tick::default();
        assert_eq!(run.observe(Tilt::LEVEL, Vector2::zeros(), &quiet).count(), 0);
        assert_eq!((run.phase(), run.n_ticks()), (Phase::Ready, 0));
        assert_eq!(run.observe(TILTED, Vector2::zeros(), &quiet).collect::<Vec<_>>(), [Event::Started]);
        assert_eq!(run.observe(Tilt::LEVEL, Vector2::new(2.0, 0.0), &quiet).count(), 0);
        let events: Vec<_> = run.observe(TILTED, Vector2::new(2.8, 0.0), &quiet).collect();
        assert_eq!(events, [Event::Finished(3)]);
        assert_eq!(run.observe(TILTED, Vector2::new(9.0, 0.0), &quiet).count(), 0);
        assert_eq!((run.phase(), run.n_ticks()), (Phase::Finished, 3));
    }

    #[test]
    fn bounces_are_events() {
        let tick = Tick { n_hits: 1, hardest_hit: 2.5, ..Tick::default() };
        let events: Vec<_> = run().observe(Tilt::LEVEL, Vector2::zeros(), &tick).collect();
        assert_eq!(events, [Event::Bounced(2.5)]);
    }
}
