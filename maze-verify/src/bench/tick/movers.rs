//! What ticks balls: engines of ours, and rapier3d.

use super::super::case::{TICK_S, turning_pulls};
use super::super::measure::BenchError;
use super::Course;
use crate::engine::{RapierEngine, Walls};
use maze_core::{Ball, Continuous, Engine, Published, SortedPlanes};
use nalgebra::Vector2;
use std::hint::black_box;
use std::sync::Arc;

/// Ticks of the way that the broad phase is taken along: three turns of the pull.
const WAY_TICKS: usize = 999;

/// Moves a ball, or each of several in turn.
pub trait Mover {
    /// A tick under a pull (units/s²).
    fn tick(&mut self, pull: Vector2<f64>);

    /// A tick under each pull: one call through the trait for many ticks.
    fn tick_all(&mut self, pulls: &[Vector2<f64>]) {
        for pull in pulls {
            self.tick(black_box(*pull));
        }
    }

    /// The ball, the first of several.
    fn ball(&self) -> Ball;

    /// Puts the first ball somewhere.
    fn place(&mut self, ball: Ball);
}

/// Engines of one kind, each with a ball of its own, which are ticked in turn.
struct Engines<E> {
    engines: Vec<E>,
    next: usize,
}

impl<E: Engine> Mover for Engines<E> {
    fn tick(&mut self, pull: Vector2<f64>) {
        // Refused is only what is not finite.
        let _ = black_box(self.engines[self.next].tick(pull));
        self.next = if self.next + 1 < self.engines.len() { self.next + 1 } else { 0 };
    }

    fn ball(&self) -> Ball {
        self.engines[0].ball()
    }

    fn place(&mut self, ball: Ball) {
        let _ = self.engines[0].place(ball);
    }
}

pub(super) fn of_engine(engine: impl Engine + 'static) -> Box<dyn Mover> {
    Box::new(Engines { engines: vec![engine], next: 0 })
}

/// An engine a ball.
fn engines<E: Engine + 'static>(
    course: &Course,
    make: impl Fn(Ball) -> Result<E, maze_core::OutOfRange>,
) -> Result<Box<dyn Mover>, BenchError> {
    let engines: Result<Vec<E>, _> = course.starts.iter().copied().map(make).collect();
    Ok(Box::new(Engines { engines: engines.map_err(BenchError::set_up)?, next: 0 }))
}

fn continuous(course: &Course, planes: &Arc<SortedPlanes>) -> Result<Box<dyn Mover>, BenchError> {
    engines(course, |ball| Continuous::new(Arc::clone(planes), course.spec, ball, TICK_S))
}

/// The exact engine.
pub(super) fn exact(course: &Course) -> Result<Box<dyn Mover>, BenchError> {
    continuous(course, course.case.planes())
}

/// The exact engine on planes without directories.
pub(super) fn without_directories(course: &Course) -> Result<Box<dyn Mover>, BenchError> {
    let planes = SortedPlanes::clone(course.case.planes()).without_directories();
    continuous(course, &Arc::new(planes))
}

/// The report's engine.
pub(super) fn published(course: &Course) -> Result<Box<dyn Mover>, BenchError> {
    engines(course, |ball| Published::new(Arc::clone(course.case.planes()), course.spec, ball))
}

/// rapier's step, without a look at what happened in it.
struct Steps(RapierEngine);

impl Mover for Steps {
    fn tick(&mut self, pull: Vector2<f64>) {
        self.0.step(pull);
    }

    fn ball(&self) -> Ball {
        self.0.ball()
    }

    fn place(&mut self, ball: Ball) {
        let _ = self.0.place(ball);
    }
}

fn world(course: &Course, walls: Walls) -> Result<RapierEngine, BenchError> {
    let mut engine = RapierEngine::new(&course.board, walls, course.spec, course.starts[0], TICK_S)
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
    Ok(Box::new(Steps(engine)))
}

/// rapier's broad phase alone: the ball's collider is put where a ball was after each tick.
struct Boxes {
    engine: RapierEngine,
    way: Vec<Vector2<f64>>,
    next: usize,
}

impl Mover for Boxes {
    fn tick(&mut self, _: Vector2<f64>) {
        black_box(self.engine.update_broad_phase(self.way[self.next]));
        self.next = if self.next + 1 < self.way.len() { self.next + 1 } else { 0 };
    }

    fn ball(&self) -> Ball {
        Ball::at(self.way[self.next])
    }

    fn place(&mut self, _: Ball) {}
}

/// The broad phase on the way of a ball that rolls; from one to the next where there are several.
pub(super) fn boxes(course: &Course) -> Result<Box<dyn Mover>, BenchError> {
    let way = if let [_] = course.starts[..] {
        let mut ball = course.reference()?;
        let mut way = Vec::with_capacity(WAY_TICKS);
        for pull in turning_pulls().into_iter().cycle().take(WAY_TICKS) {
            ball.tick(pull).map_err(BenchError::set_up)?;
            way.push(ball.ball().position);
        }
        way
    } else {
        course.starts.iter().map(|ball| ball.position).collect()
    };
    Ok(Box::new(Boxes { engine: world(course, Walls::Cuboids)?, way, next: 0 }))
}
