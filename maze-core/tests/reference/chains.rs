//! Flights from hit to hit among irregular walls.

use crate::irregular::Scene;
use crate::reference_model::{Feature, Reference, World, big::big};
use maze_core::{Ball, Continuous, Engine, SortedPlanes};
use nalgebra::Vector2;
use std::sync::Arc;

/// A start that differs by this part shows how errors grow: 2^10 roundings.
const NUDGE: f64 = 1.0 / (1_u64 << 42) as f64;
/// Roundings (of the largest coordinate and of the largest speed) that the engine may make before they are multiplied.
const ROUNDINGS: f64 = 32.0;
/// Largest error of a position (units) with which a comparison still says something.
const WORTH: f64 = 1.0e-9;
/// A bounce that rises less (radii) may be none for the engine, whose bound is about 3e-9.
const LOW: f64 = 1.0e-6;

/// One start.
struct Case {
    planes: Vec<maze_core::Plane>,
    spec: maze_core::BallSpec,
    ball: Ball,
    pull: Vector2<f64>,
    /// Largest coordinate and speed there are.
    scale: [f64; 2],
    horizon_s: f64,
}

/// What came of the cases.
#[derive(Debug, Default)]
struct Count {
    compared: u32,
    corners: u32,
    rests: u32,
    without_hit: u32,
    low: u32,
    ambiguous: u32,
    multiplied: u32,
    worst: f64,
    worst_m: f64,
}

impl Case {
    fn new(seed: u64) -> Option<Self> {
        let scene = Scene::new(seed)?;
        let pull = scene.pulls(seed).next()?;
        let (ball, mut spec) = (scene.ball, scene.spec);
        spec.resistance = 0.0;
        let (speed, strength) = (ball.velocity.norm(), pull.norm() * spec.rolling);
        // Time to cross the room about twice.
        let horizon_s = (16.0 / speed).min((32.0 / strength).sqrt());
        let coordinate = scene.middle.abs().max() + 4.0;
        let scale = [coordinate, speed + strength * horizon_s];
        (1.0e-6 < horizon_s && horizon_s < 1.0e3).then_some(Self {
            planes: scene.planes,
            spec,
            ball,
            pull,
            scale,
            horizon_s,
        })
    }

    /// Compares a start after some hits.
    fn compare(&self, seed: u64, n_hits: usize, n_ticks: u32, count: &mut Count) {
        let world = World::new(&self.planes, &self.spec);
        let mut planned = Reference::new(&world, self.ball, self.pull.into());
        planned.max_hits = n_hits + 1;
        planned.advance(&big(self.horizon_s));
        let Some(last) = planned.hits.get(n_hits - 1) else {
            count.without_hit += 1;
            return;
        };
        if planned.hits.iter().any(|hit| 0.0 < hit.rise && hit.rise < LOW) {
            count.low += 1;
            return;
        }
        let last_s = last.time_s.f64();
        let next_s = planned.hits.get(n_hits).map_or(self.horizon_s, |next| next.time_s.f64());
        let tick_s = (last_s + 0.3 * (next_s - last_s)) / f64::from(n_ticks);
        let until_s = big(tick_s) * big(f64::from(n_ticks));
        let run = |ball: Ball| {
            let mut reference = Reference::new(&world, ball, self.pull.into());
            reference.advance(&until_s);
            let features: Vec<Feature> = reference.hits.iter().map(|hit| hit.feature).collect();
            (reference.ball(), features, reference.n_rests)
        };
        let (exact, features, n_rests) = run(self.ball);
        let mut grown = [0.0_f64; 2];
        for way in [Vector2::new(1.0, 0.0), Vector2::new(0.0, 1.0)] {
            let nudged = Ball {
                position: self.ball.position + way * (NUDGE * self.scale[0]),
                velocity: self.ball.velocity + Vector2::new(-way.y, way.x) * (NUDGE * self.scale[1]),
            };
            let (other, others, _) = run(nudged);
            if others != features {
                count.ambiguous += 1;
                return;
            }
            grown[0] = grown[0].max((other.position - exact.position).norm());
            grown[1] = grown[1].max((other.velocity - exact.velocity).norm());
        }
        let bounds = grown.map(|grown| grown * (ROUNDINGS * f64::EPSILON / NUDGE));
        if WORTH < bounds[0] {
            count.multiplied += 1;
            return;
        }
        let planes = Arc::new(SortedPlanes::new(self.planes.iter().copied()).unwrap());
        let mut engine = Continuous::new(planes, self.spec, self.ball, tick_s).unwrap();
        for _ in 0..n_ticks {
            let tick = engine.tick(self.pull).unwrap();
            assert_eq!((tick.dropped_s, tick.recovered, tick.corrected_overlap), (0.0, false, 0.0), "seed {seed}");
        }
        let apart = engine.ball().position - exact.position;
        let apart_v = engine.ball().velocity - exact.velocity;
        let share = (apart.norm() / bounds[0]).max(apart_v.norm() / bounds[1]);
        if share > 1.0 {
            println!("seed {seed} hits {n_hits} ticks {n_ticks} share {share} apart {apart:?} {apart_v:?} bounds {bounds:?} {features:?} scale {:?} r {} {:?}", self.scale, self.spec.radius.units(), self.spec);
        }
        count.compared += 1;
        count.corners += u32::from(features.iter().any(|feature| matches!(feature, Feature::Point(_))));
        count.rests += u32::from(0 < n_rests);
        count.worst = count.worst.max(share);
        count.worst_m = count.worst_m.max(apart.norm() / self.scale[0]);
    }
}

#[test]
fn a_flight_and_its_first_hit_are_those_of_the_reference() {
    let start = std::time::Instant::now();
    let mut count = Count::default();
    for seed in 0..400 {
        if let Some(case) = Case::new(seed) {
            case.compare(seed, 1, 1, &mut count);
        }
    }
    println!("{count:?} {:?}", start.elapsed());
}
#[test]
fn chains() {
    let start = std::time::Instant::now();
    let mut count = Count::default();
    for seed in 10000..10200 {
        if let Some(case) = Case::new(seed) {
            case.compare(seed, 3 + (seed % 3) as usize, if seed % 2 == 0 { 1 } else { 7 }, &mut count);
        }
    }
    println!("{count:?} {:?}", start.elapsed());
}
