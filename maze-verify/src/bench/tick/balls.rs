//! Many balls in one maze, none of which knows of another.

use super::super::agreement::Comparison;
use super::super::case::{Case, TICK_S, spec, turning_pulls};
use super::super::measure::BenchError;
use super::super::paired::Runner;
use super::{Entrant, Question};
use crate::board::Board;
use crate::engine::{RapierEngine, Walls};
use maze_core::{Ball, Continuous, Engine, OutOfRange, Published};
use nalgebra::Vector2;
use std::hint::black_box;
use std::sync::Arc;
use std::thread;

/// As many as the question is about.
const N_BALLS: usize = 100_000;

/// rapier's balls, all in one world: its step takes so much longer.
const N_IN_WORLD: usize = 10_000;

/// All balls ticked under one pull that turns, again and again; what is told is the time of one ball's tick.
///
/// # Errors
/// An engine that refuses the maze or a ball.
pub fn balls(case: &Case) -> Result<Question, BenchError> {
    let starts: Vec<Ball> = case.scattered(N_BALLS).into_iter().map(Ball::at).collect();
    let (planes, spec) = (case.planes(), spec());
    let exact = |ball: &Ball| Continuous::new(Arc::clone(planes), spec, *ball, TICK_S);
    let report = |ball: &Ball| Published::new(Arc::clone(planes), spec, *ball);
    let entrants = vec![
        on_threads("continuous", 1, all(&starts, exact)?),
        on_threads("continuous on 2 threads", 2, all(&starts, exact)?),
        on_threads("published", 1, all(&starts, report)?),
        in_one_world(case, &starts)?,
    ];
    let (name, n_planes) = ("10^5 balls", planes.len());
    Ok(Question { name, n_planes, hits_a_tick: None, comparisons: Vec::<Comparison>::new(), entrants })
}

fn all<E>(starts: &[Ball], make: impl Fn(&Ball) -> Result<E, OutOfRange>) -> Result<Vec<E>, BenchError> {
    let engines: Result<Vec<E>, _> = starts.iter().map(make).collect();
    engines.map_err(BenchError::set_up)
}

/// Each thread ticks its part of the balls.
fn on_threads<E: Engine + Send + 'static>(
    name: &'static str,
    n_threads: usize,
    mut engines: Vec<E>,
) -> Entrant {
    let n_balls = engines.len();
    let pulls = turning_pulls();
    let mut n_done = 0;
    let run = move |n: usize| {
        let pulls = pulls.iter().cycle().skip(n_done % pulls.len()).take(n);
        let mut parts = engines.chunks_mut(n_balls.div_ceil(n_threads));
        let (first, others) = (parts.next(), parts);
        thread::scope(|scope| {
            for part in others {
                let pulls = pulls.clone();
                scope.spawn(move || tick_all(part, pulls));
            }
            // One part is this thread's.
            tick_all(first.unwrap_or_default(), pulls.clone());
        });
        n_done += n;
        engines.first().map_or(0.0, |engine| engine.ball().position.x)
    };
    Entrant { runner: Runner { name, run: Box::new(run) }, n_balls }
}

fn tick_all<'a, E: Engine>(engines: &mut [E], pulls: impl Iterator<Item = &'a Vector2<f64>>) {
    for pull in pulls {
        for engine in &mut *engines {
            // Refused is only what is not finite.
            let _ = black_box(engine.tick(black_box(*pull)));
        }
    }
}

/// One step of rapier's moves all balls of a world.
fn in_one_world(case: &Case, starts: &[Ball]) -> Result<Entrant, BenchError> {
    let board = Board::from_planes(case.planes());
    let (first, others) = (starts[0], starts[1..N_IN_WORLD].iter().copied());
    let mut world =
        RapierEngine::new(&board, Walls::Compound, spec(), first, TICK_S).map_err(BenchError::set_up)?;
    world.add_balls(others).map_err(BenchError::set_up)?;
    let pulls = turning_pulls();
    let mut n_done = 0;
    let run = move |n: usize| {
        for pull in pulls.iter().cycle().skip(n_done % pulls.len()).take(n) {
            world.step(*pull);
        }
        n_done += n;
        world.ball().position.x
    };
    let runner = Runner { name: "rapier3d world of 10^4", run: Box::new(run) };
    Ok(Entrant { runner, n_balls: N_IN_WORLD })
}
