//! Flights from hit to hit among irregular walls.

use crate::irregular::Scene;
use crate::reference_model::{Feature, Reference, World, big::big};
use maze_core::{Ball, Continuous, Engine, SortedPlanes};
use nalgebra::Vector2;
use std::sync::Arc;

/// A start that differs by this part shows how errors grow: 2^10 roundings.
const NUDGE: f64 = 1.0 / (1_u64 << 42) as f64;
/// Roundings (of the largest coordinate and of the largest speed) that the engine may make before they are multiplied, over all hits.
const ROUNDINGS: f64 = 32.0;
/// Largest error of a position (units) with which a comparison still says something.
const WORTH: f64 = 1.0e-9;
/// A bounce that rises less (radii) may be none for the engine, whose bound is about 3e-9.
const LOW: f64 = 1.0e-6;

/// A hit at a smaller angle may be none for the engine: a step or slit of 1e-9 radii in a face, which it takes for one face, has a
/// sine of 4.5e-5. Such a hit is also too near a graze.
const FLAT: f64 = 1.0e-4;

/// One start.
struct Case {
    planes: Vec<maze_core::Plane>,
    spec: maze_core::BallSpec,
    ball: Ball,
    acceleration: Vector2<f64>,
    /// Largest coordinate and speed there are.
    scale: [f64; 2],
    horizon_s: f64,
}

/// What came of the cases.
#[derive(Debug, Default)]
struct Count {
    compared: u32,
    /// Of these: with a corner among the hits, and with a bounce that rests.
    corners: u32,
    rests: u32,
    /// Not compared: fewer hits within the time, a hit near the rest bound or a graze, a nudge that meets other walls, an error that is
    /// multiplied too often.
    without_hit: u32,
    low: u32,
    ambiguous: u32,
    multiplied: u32,
    /// Largest error in its bound.
    worst: f64,
}

impl Case {
    fn new(seed: u64, n_crossings: f64) -> Option<Self> {
        let scene = Scene::new(seed)?;
        let acceleration = scene.accelerations(seed).next()?;
        let (ball, mut spec) = (scene.ball, scene.spec);
        spec.resistance = 0.0;
        let (speed, strength) = (ball.velocity.norm(), acceleration.norm() * spec.rolling);
        // Time to cross the room so often.
        let horizon_s = n_crossings * (8.0 / speed).min((16.0 / strength).sqrt());
        let coordinate = scene.middle.abs().max() + 4.0;
        let scale = [coordinate, speed + strength * horizon_s];
        (1.0e-6 < horizon_s && horizon_s < 1.0e3).then_some(Self {
            planes: scene.planes,
            spec,
            ball,
            acceleration,
            scale,
            horizon_s,
        })
    }

    /// Compares a start after some hits. The bound is what [`ROUNDINGS`] grow to on the way, as two nudged starts show: a hit of a
    /// corner multiplies an error by about 2 (1 + e) v / (r cos phi) times the time that follows.
    fn compare(&self, seed: u64, n_hits: usize, n_ticks: u32, count: &mut Count) {
        let world = World::new(&self.planes, &self.spec);
        let mut planned = Reference::new(&world, self.ball, self.acceleration.into());
        planned.max_hits = n_hits;
        planned.advance(&big(self.horizon_s));
        let Some(last_s) = planned.hits.get(n_hits - 1).map(|last| last.time_s.f64()) else {
            count.without_hit += 1;
            return;
        };
        let mut exact = planned.clone();
        planned.max_hits += 1;
        planned.advance(&big(self.horizon_s));
        if planned.hits.iter().any(|hit| (0.0 < hit.rise && hit.rise < LOW) || hit.sine < FLAT) {
            count.low += 1;
            return;
        }
        let next_s = planned.hits.get(n_hits).map_or(self.horizon_s, |next| next.time_s.f64());
        let tick_s = (last_s + 0.3 * (next_s - last_s)) / f64::from(n_ticks);
        let until_s = big(tick_s) * big(f64::from(n_ticks));
        let features =
            |reference: &Reference| reference.hits.iter().map(|hit| hit.feature).collect::<Vec<_>>();
        exact.max_hits = usize::MAX;
        exact.advance(&until_s);
        let met = features(&exact);
        let truth = exact.ball();
        let mut grown = [0.0_f64; 2];
        for way in [Vector2::new(1.0, 0.0), Vector2::new(0.0, 1.0)] {
            let nudged = Ball {
                position: self.ball.position + way * (NUDGE * self.scale[0]),
                velocity: self.ball.velocity + Vector2::new(-way.y, way.x) * (NUDGE * self.scale[1]),
            };
            let mut other = Reference::new(&world, nudged, self.acceleration.into());
            other.advance(&until_s);
            if features(&other) != met {
                count.ambiguous += 1;
                return;
            }
            grown[0] = grown[0].max((other.ball().position - truth.position).norm());
            grown[1] = grown[1].max((other.ball().velocity - truth.velocity).norm());
        }
        let own = [0, 1].map(|n| 4.0 * f64::EPSILON * self.scale[n]);
        let bounds = [0, 1].map(|n| own[n] + grown[n] * (ROUNDINGS * f64::EPSILON / NUDGE));
        if WORTH < bounds[0] {
            count.multiplied += 1;
            return;
        }
        let planes = Arc::new(SortedPlanes::new(self.planes.iter().copied()).unwrap());
        let mut engine = Continuous::new(planes, self.spec, self.ball, tick_s).unwrap();
        for _ in 0..n_ticks {
            let tick = engine.tick(self.acceleration).unwrap();
            assert_eq!(
                (tick.dropped_s, tick.recovered, tick.corrected_overlap),
                (0.0, false, 0.0),
                "seed {seed}"
            );
        }
        let ball = engine.ball();
        let apart =
            [ball.position - truth.position, ball.velocity - truth.velocity].map(|apart| apart.norm());
        let share = (apart[0] / bounds[0]).max(apart[1] / bounds[1]);
        assert!(share <= 1.0, "seed {seed}: {ball:?} instead of {truth:?}, bounds {bounds:?}, {met:?}");
        count.compared += 1;
        count.corners += u32::from(met.iter().any(|feature| matches!(feature, Feature::Point(_))));
        count.rests += u32::from(0 < exact.n_rests);
        count.worst = count.worst.max(share);
    }
}

#[test]
fn a_flight_and_its_first_hit_are_those_of_the_reference() {
    let mut count = Count::default();
    for seed in 0..2000 {
        if let Some(case) = Case::new(seed, 2.0) {
            case.compare(seed, 1, 1, &mut count);
        }
    }
    println!("{count:?}");
    assert!(1500 < count.compared && 150 < count.corners, "{count:?}");
    assert!(20 * count.ambiguous < count.compared, "{count:?}");
}

#[test]
fn three_to_five_hits_are_those_of_the_reference() {
    let mut count = Count::default();
    for seed in 10_000..10_500 {
        if let Some(case) = Case::new(seed, 8.0) {
            // In one tick and in several.
            let n_ticks = if seed % 2 == 0 { 1 } else { 7 };
            case.compare(seed, [3, 4, 5][seed as usize % 3], n_ticks, &mut count);
        }
    }
    println!("{count:?}");
    assert!(200 < count.compared && 60 < count.corners, "{count:?}");
    assert!(10 * count.ambiguous < count.compared, "{count:?}");
}
