//! What ticks balls: engines of ours, and rapier3d.

use super::super::case::{TICK_S, spec, turning_accelerations};
use super::super::measure::BenchError;
use super::Course;
use crate::engine::{RapierEngine, Walls};
use maze_core::{Ball, Continuous, Engine, OutOfRange, Published, SortedPlanes};
use nalgebra::Vector2;
use std::hint::black_box;
use std::sync::Arc;
use std::thread;

/// Most balls in one world of rapier's: more make its step so long that it is timed too seldom.
const MOST_IN_WORLD: usize = 10_000;

/// Most places that the broad phase is taken to in what counts as one tick: it may take 20 µs for each.
const MOST_BOXES: usize = 256;

/// Ticks of the path that the broad phase is taken along: three turns of the acceleration.
const WAY_TICKS: usize = 999;

/// Moves one or many balls.
pub trait Mover {
    /// A tick of every ball under a acceleration (units/s²).
    fn tick(&mut self, acceleration: Vector2<f64>);

    /// A tick under each acceleration: one call through the trait for many ticks.
    fn tick_all(&mut self, accelerations: &[Vector2<f64>]) {
        for acceleration in accelerations {
            self.tick(black_box(*acceleration));
        }
    }

    /// How many balls there are.
    fn n_balls(&self) -> usize;

    /// The first ball.
    fn ball(&self) -> Ball;

    /// Puts the first ball somewhere.
    fn place(&mut self, ball: Ball);
}

/// Engines of one kind, each with a ball of its own.
struct Engines<E> {
    engines: Vec<E>,
    n_threads: usize,
}

impl<E: Engine + Send> Mover for Engines<E> {
    fn tick(&mut self, acceleration: Vector2<f64>) {
        if self.n_threads == 1 {
            return tick_engines(&mut self.engines, acceleration);
        }
        let n_each = self.engines.len().div_ceil(self.n_threads);
        let mut parts = self.engines.chunks_mut(n_each);
        let first = parts.next().unwrap_or_default();
        thread::scope(|scope| {
            for part in parts {
                scope.spawn(move || tick_engines(part, acceleration));
            }
            // One part is this thread's.
            tick_engines(first, acceleration);
        });
    }

    fn n_balls(&self) -> usize {
        self.engines.len()
    }

    fn ball(&self) -> Ball {
        self.engines[0].ball()
    }

    fn place(&mut self, ball: Ball) {
        let _ = self.engines[0].place(ball);
    }
}

fn tick_engines<E: Engine>(engines: &mut [E], acceleration: Vector2<f64>) {
    for engine in engines {
        // Refused is only what is not finite.
        let _ = black_box(engine.tick(black_box(acceleration)));
    }
}

/// An engine a ball.
fn engines<E: Engine + Send + 'static>(
    course: &Course,
    n_threads: usize,
    make: impl Fn(Ball) -> Result<E, OutOfRange>,
) -> Result<Box<dyn Mover>, BenchError> {
    let engines: Result<Vec<E>, _> = course.starts.iter().copied().map(make).collect();
    Ok(Box::new(Engines { engines: engines.map_err(BenchError::set_up)?, n_threads }))
}

fn continuous(
    course: &Course,
    planes: &Arc<SortedPlanes>,
    n_threads: usize,
) -> Result<Box<dyn Mover>, BenchError> {
    engines(course, n_threads, |ball| Continuous::new(Arc::clone(planes), course.spec, ball, TICK_S))
}

/// The exact engine.
pub(super) fn exact(course: &Course) -> Result<Box<dyn Mover>, BenchError> {
    continuous(course, course.case.planes(), 1)
}

/// The exact engine with one ball, without a course.
pub(super) fn alone(planes: Arc<SortedPlanes>, ball: Ball) -> Result<Box<dyn Mover>, BenchError> {
    let engine = Continuous::new(planes, spec(), ball, TICK_S).map_err(BenchError::set_up)?;
    Ok(Box::new(Engines { engines: vec![engine], n_threads: 1 }))
}

/// The exact engine with the balls shared out to threads.
pub(super) fn exact_on_2_threads(course: &Course) -> Result<Box<dyn Mover>, BenchError> {
    continuous(course, course.case.planes(), 2)
}

/// The exact engine on planes without bucket indexes.
pub(super) fn without_bucket_index(course: &Course) -> Result<Box<dyn Mover>, BenchError> {
    let planes = SortedPlanes::clone(course.case.planes()).without_bucket_index();
    continuous(course, &Arc::new(planes), 1)
}

/// The report's engine.
pub(super) fn published(course: &Course) -> Result<Box<dyn Mover>, BenchError> {
    engines(course, 1, |ball| Published::new(Arc::clone(course.case.planes()), course.spec, ball, TICK_S))
}

/// rapier's step, without reading its events.
struct Steps {
    engine: RapierEngine,
    n_balls: usize,
}

impl Mover for Steps {
    fn tick(&mut self, acceleration: Vector2<f64>) {
        self.engine.step(acceleration);
    }

    fn n_balls(&self) -> usize {
        self.n_balls
    }

    fn ball(&self) -> Ball {
        self.engine.ball()
    }

    fn place(&mut self, ball: Ball) {
        let _ = self.engine.place(ball);
    }
}

fn world(course: &Course, walls: Walls) -> Result<RapierEngine, BenchError> {
    let mut engine = RapierEngine::new(course.case.board(), walls, course.spec, course.starts[0], TICK_S)
        .map_err(BenchError::set_up)?;
    // Makes the trees, which is no part of a tick.
    engine.step(Vector2::zeros());
    engine.place(course.starts[0]).map_err(BenchError::set_up)?;
    Ok(engine)
}

/// rapier with a ball among walls.
pub(super) fn rapier(course: &Course, walls: Walls, ccd: bool) -> Result<Box<dyn Mover>, BenchError> {
    let mut engine = world(course, walls)?;
    engine.set_ccd(ccd);
    Ok(Box::new(Steps { engine, n_balls: 1 }))
}

/// rapier with many balls in one world: a step moves them all.
pub(super) fn crowd(course: &Course) -> Result<Box<dyn Mover>, BenchError> {
    let mut engine = world(course, Walls::Compound)?;
    let n_balls = course.starts.len().min(MOST_IN_WORLD);
    engine.add_balls(course.starts[1..n_balls].iter().copied()).map_err(BenchError::set_up)?;
    Ok(Box::new(Steps { engine, n_balls }))
}

/// rapier's broad phase alone: the ball's collider is put where a ball was after each tick, or where one of several balls
/// began after another.
struct Boxes {
    engine: RapierEngine,
    n_balls: usize,
    path: Vec<Vector2<f64>>,
    next: usize,
}

impl Mover for Boxes {
    fn tick(&mut self, _: Vector2<f64>) {
        for _ in 0..self.n_balls {
            black_box(self.engine.update_broad_phase(self.path[self.next]));
            self.next = if self.next + 1 < self.path.len() { self.next + 1 } else { 0 };
        }
    }

    fn n_balls(&self) -> usize {
        self.n_balls
    }

    fn ball(&self) -> Ball {
        Ball::at(self.path[self.next])
    }

    fn place(&mut self, _: Ball) {}
}

/// The broad phase on the path of a ball that rolls; from one to the next where there are several.
pub(super) fn boxes(course: &Course) -> Result<Box<dyn Mover>, BenchError> {
    let path = match course.starts[..] {
        [start] => rolled_path(course, start)?,
        _ => course.starts.iter().map(|ball| ball.position).collect(),
    };
    let (engine, n_balls) = (world(course, Walls::Cuboids)?, course.starts.len().min(MOST_BOXES));
    Ok(Box::new(Boxes { engine, n_balls, path, next: 0 }))
}

fn rolled_path(course: &Course, start: Ball) -> Result<Vec<Vector2<f64>>, BenchError> {
    let mut engine = course.exact(start)?;
    let tick = |acceleration| {
        engine.tick(acceleration).map_err(BenchError::set_up)?;
        Ok(engine.ball().position)
    };
    turning_accelerations().into_iter().cycle().take(WAY_TICKS).map(tick).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::case::Case;

    #[test]
    fn threads_change_no_bit_and_all_balls_are_ticked() {
        let case = Case::new(9, 1).unwrap();
        let course = Course::middle(&case).scattered(5).unwrap();
        let starts = course.starts.clone();
        let [mut one, mut two] = [exact(&course).unwrap(), exact_on_2_threads(&course).unwrap()];
        let mut alone: Vec<Continuous> = starts.iter().map(|start| course.exact(*start).unwrap()).collect();
        for acceleration in turning_accelerations() {
            one.tick(acceleration);
            two.tick(acceleration);
            for engine in &mut alone {
                engine.tick(acceleration).unwrap();
            }
            assert_eq!((one.ball(), two.ball()), (alone[0].ball(), alone[0].ball()));
        }
        assert_eq!([one.n_balls(), two.n_balls()], [5, 5]);
    }

    #[test]
    fn the_broad_phase_is_taken_along_the_way_that_a_ball_rolls() {
        let case = Case::new(9, 1).unwrap();
        let course = Course::middle(&case);
        let (mut boxes, mut engine) = (boxes(&course).unwrap(), course.exact(course.starts[0]).unwrap());
        for acceleration in turning_accelerations() {
            engine.tick(acceleration).unwrap();
            assert_eq!(boxes.ball().position, engine.ball().position);
            boxes.tick(acceleration);
        }
    }
}
