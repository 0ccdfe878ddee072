//! Runs engines over scenes.

use crate::contender::{Build, Contender};
use crate::metrics::{Track, measure};
use crate::results::{CaseResult, RunResult, SceneResult};
use crate::scene::{Scene, SceneError, Stage};
use maze_core::OutOfRange;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

/// Most points of a path and of a distance over time that are kept: more than a picture of 400 pixels shows.
const MAX_PATH_POINTS: usize = 400;
const MAX_SAMPLES: usize = 120;

/// A point of a path that lies nearer than this (units) to the line between its neighbours is left out.
const PATH_TOLERANCE: f64 = 0.01;

/// Why a scene did not run.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The scene itself.
    #[error("scene {scene}: {reason}")]
    Scene {
        /// Its name.
        scene: String,
        /// What is wrong.
        reason: SceneError,
    },
    /// An engine refused it.
    #[error("scene {scene}, {engine}: {reason}")]
    Engine {
        /// Its name.
        scene: String,
        /// Which engine.
        engine: &'static str,
        /// What it refused.
        reason: OutOfRange,
    },
}

/// Runs scenes, given with their place among all, on as many threads as the machine has; `on_scene` hears of each that is done.
///
/// # Errors
/// The first scene that does not stand or that an engine refuses.
pub fn run(
    scenes: &[(usize, Scene)],
    engines: &[Contender],
    build: &Build,
    on_scene: &(dyn Fn(&str) + Sync),
) -> Result<Vec<SceneResult>, RunError> {
    let next = AtomicUsize::new(0);
    let done = Mutex::new(Vec::with_capacity(scenes.len()));
    let n_threads = std::thread::available_parallelism().map_or(1, usize::from).min(scenes.len().max(1));
    std::thread::scope(|scope| {
        let work = || {
            while let Some((index, scene)) = scenes.get(next.fetch_add(1, Ordering::Relaxed)) {
                let result = run_scene(*index, scene, engines, build);
                let failed = result.is_err();
                on_scene(&scene.name);
                done.lock().unwrap_or_else(std::sync::PoisonError::into_inner).push(result);
                if failed {
                    next.store(scenes.len(), Ordering::Relaxed);
                }
            }
        };
        for _ in 1..n_threads {
            // Where no more threads can be made, those there are do the work.
            if std::thread::Builder::new().spawn_scoped(scope, work).is_err() {
                break;
            }
        }
        work();
    });
    done.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner).into_iter().collect()
}

fn run_scene(
    index: usize,
    scene: &Scene,
    engines: &[Contender],
    build: &Build,
) -> Result<SceneResult, RunError> {
    let stage = scene.set_up().map_err(|reason| RunError::Scene { scene: scene.name.clone(), reason })?;
    let mut cases = Vec::new();
    for (number, tick_s) in scene.ticks_s.iter().enumerate() {
        cases.push(run_case(&stage, *tick_s, engines, build, number == 0)?);
    }
    let walls =
        stage.board.rectangles().iter().map(|wall| [wall.low.x, wall.low.y, wall.high.x, wall.high.y]);
    Ok(SceneResult {
        index,
        name: scene.name.clone(),
        about: scene.about.clone(),
        family: scene.family,
        duration_s: scene.duration_s,
        radius: scene.spec.radius.units(),
        restitution: scene.spec.restitution,
        rolling: scene.spec.rolling,
        walls: walls.collect(),
        cases,
    })
}

fn run_case(
    stage: &Stage,
    tick_s: f64,
    engines: &[Contender],
    build: &Build,
    keep_paths: bool,
) -> Result<CaseResult, RunError> {
    let refused = |engine: Contender, reason| RunError::Engine {
        scene: stage.scene.name.clone(),
        engine: engine.name(),
        reason,
    };
    // Truth and the continuous engine are what the others are compared with, asked for or not.
    let mut tracks = Vec::new();
    for engine in Contender::ALL {
        let is_reference = matches!(engine, Contender::ClosedForm | Contender::Continuous);
        if is_reference || engines.contains(&engine) {
            let track = track(stage, tick_s, engine, build).map_err(|reason| refused(engine, reason))?;
            tracks.extend(track.map(|track| (engine, track)));
        }
    }
    let find = |wanted| tracks.iter().find(|(engine, _)| *engine == wanted).map(|(_, track)| track);
    let (truth, continuous) = (find(Contender::ClosedForm), find(Contender::Continuous));
    let reference = truth.or(continuous);
    let asked = tracks.iter().filter(|(engine, _)| engines.contains(engine));
    let runs = asked.map(|(engine, track)| RunResult {
        engine: *engine,
        metrics: measure(
            stage,
            track,
            truth.filter(|_| *engine != Contender::ClosedForm),
            continuous.filter(|_| *engine != Contender::Continuous),
        ),
        path: if keep_paths { thinned_path(track) } else { Vec::new() },
        distance: match reference {
            Some(reference) if keep_paths && !std::ptr::eq(reference, track) => samples(track, reference),
            _ => Vec::new(),
        },
        energy: if keep_paths && truth.is_some() { stretches(track, &track.energies()) } else { Vec::new() },
    });
    Ok(CaseResult { tick_s, runs: runs.collect() })
}

fn track(stage: &Stage, tick_s: f64, engine: Contender, build: &Build) -> Result<Option<Track>, OutOfRange> {
    let Some(mut engine) = build(engine, stage, tick_s)? else { return Ok(None) };
    let n_ticks = stage.n_ticks(tick_s);
    let accelerations: Vec<_> =
        (0..n_ticks).map(|index| stage.scene.gravity.of_tick(index, tick_s)).collect();
    let mut balls = vec![stage.ball];
    let mut ticks = Vec::new();
    let mut taken_s = 0.0;
    for acceleration in &accelerations {
        let begin = Instant::now();
        ticks.push(engine.tick(*acceleration)?);
        taken_s += begin.elapsed().as_secs_f64();
        balls.push(engine.ball().checked()?);
    }
    let accelerations =
        accelerations.into_iter().map(|acceleration| acceleration * stage.scene.spec.rolling).collect();
    Ok(Some(Track { tick_s, balls, accelerations, ticks, taken_s }))
}

/// A tenth of a thousandth: what a picture of a board of 100 units still shows.
fn rounded(value: f64) -> f64 {
    (value * 1.0e4).round() / 1.0e4
}

/// Only the points that matter (Douglas and Peucker 1973), and of these at most [`MAX_PATH_POINTS`].
fn thinned_path(track: &Track) -> Vec<[f64; 2]> {
    let points: Vec<_> = track.balls.iter().map(|ball| ball.position).collect();
    let mut keep = vec![false; points.len()];
    let mut open = vec![(0, points.len() - 1)];
    keep[0] = true;
    keep[points.len() - 1] = true;
    while let Some((first, last)) = open.pop() {
        let chord = points[last] - points[first];
        let off = |index: &usize| {
            let from = points[*index] - points[first];
            let fraction = (from.dot(&chord) / chord.norm_squared()).clamp(0.0, 1.0);
            if fraction.is_nan() { from.norm() } else { (from - chord * fraction).norm() }
        };
        let farthest = (first + 1..last).max_by(|a, b| off(a).total_cmp(&off(b)));
        if let Some(index) = farthest.filter(|index| PATH_TOLERANCE < off(index)) {
            keep[index] = true;
            open.extend([(first, index), (index, last)]);
        }
    }
    let kept: Vec<_> = points.iter().zip(&keep).filter(|(_, keep)| **keep).map(|(point, _)| *point).collect();
    let stride = kept.len().div_ceil(MAX_PATH_POINTS).max(1);
    kept.iter().step_by(stride).chain(kept.last()).map(|point| [rounded(point.x), rounded(point.y)]).collect()
}

/// Distance over time.
fn samples(track: &Track, reference: &Track) -> Vec<[f64; 2]> {
    stretches(track, &track.distances(reference))
}

/// A value at the ticks' ends over time: of each stretch the largest.
fn stretches(track: &Track, values: &[f64]) -> Vec<[f64; 2]> {
    let stride = values.len().div_ceil(MAX_SAMPLES).max(1);
    let time_s = |index: usize| rounded(index as f64 * track.tick_s);
    let stretches = values.chunks(stride).enumerate();
    stretches
        .map(|(index, stretch)| {
            let largest = stretch.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            // Three digits are enough for a plot and keep the file small.
            let digits = format!("{largest:.2e}").parse().unwrap_or(largest);
            [time_s(index * stride + stretch.len() - 1), digits]
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use maze_core::Ball;
    use nalgebra::Vector2;

    #[test]
    fn a_thinned_path_keeps_its_corners() {
        let point = |x: f64, y: f64| Ball::at(Vector2::new(x, y));
        let there = (0..100_u8).map(|k| point(f64::from(k) / 10.0, 0.0));
        let back = (0..100_u8).map(|k| point(9.9 - f64::from(k) / 10.0, f64::from(k) / 20.0));
        let track = Track {
            tick_s: 0.03,
            balls: there.chain(back).collect(),
            accelerations: Vec::new(),
            ticks: Vec::new(),
            taken_s: 0.0,
        };
        assert_eq!(thinned_path(&track)[..2], [[0.0, 0.0], [9.9, 0.0]]);
        assert!(thinned_path(&track).len() <= 4);
    }
}
