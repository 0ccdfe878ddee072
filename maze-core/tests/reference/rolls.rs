//! Rolls around points, over edges, steps and slits.

use crate::reference_model::{Reference, World, big::big};
use crate::wedges::{face, slit};
use maze_core::{Ball, BallSpec, Continuous, Engine, Facing, Plane, Radius, SortedPlanes};
use std::sync::Arc;

/// Largest distance between engine and reference (radii): a hundred times what was measured, and less than the 3e-9 that a rest
/// may change, which on these courses it does not.
const BOUND: f64 = 1.0e-10;
/// Hits after which a comparison says nothing any more.
const MAX_HITS: usize = 20;
const TICKS_S: [f64; 4] = [0.001, 0.0137, 0.03, 0.1];

/// A start on a face, in radii; velocities in the speed that a fall by a radius gives.
pub(crate) struct Course {
    name: &'static str,
    planes: Vec<Plane>,
    start: [f64; 2],
    speed: [f64; 2],
    /// Directions of the acceleration: one, and the one that follows it.
    accelerations: [[f64; 2]; 2],
}

/// The upper and the right side of a block.
fn edge() -> Vec<Plane> {
    vec![face(Facing::PlusY, 0.0, -20.0, 0.0), face(Facing::PlusX, 0.0, -20.0, 0.0)]
}

/// A wall without thickness.
fn sheet() -> Vec<Plane> {
    vec![face(Facing::PlusY, 0.0, -20.0, 0.0), face(Facing::MinusY, 0.0, -20.0, 0.0)]
}

/// A floor with a step up.
fn step(height: f64) -> Vec<Plane> {
    vec![
        face(Facing::PlusY, 0.0, -20.0, 0.0),
        face(Facing::MinusX, 0.0, 0.0, height),
        face(Facing::PlusY, height, 0.0, 20.0),
    ]
}

/// A floor with a step down.
fn down(height: f64) -> Vec<Plane> {
    vec![
        face(Facing::PlusY, 0.0, -20.0, 0.0),
        face(Facing::PlusX, 0.0, -height, 0.0),
        face(Facing::PlusY, -height, 0.0, 20.0),
    ]
}

fn courses() -> Vec<Course> {
    let course =
        |name, planes, start, speed, accelerations| Course { name, planes, start, speed, accelerations };
    let still = |acceleration| [acceleration, acceleration];
    vec![
        course("edge", edge(), [-1.0, 1.0], [0.3, 0.0], still([0.0, -1.0])),
        course("edge, pushed", edge(), [-0.5, 1.0], [0.0, 0.0], still([0.1, -1.0])),
        course("edge, onto the side", edge(), [-0.5, 1.0], [0.1, 0.0], still([-0.2, -1.0])),
        course(
            "edge, then pressed onto the side",
            edge(),
            [-0.3, 1.0],
            [0.2, 0.0],
            [[0.1, -1.0], [-1.0, -0.2]],
        ),
        course("edge and back", edge(), [-0.3, 1.0], [0.4, 0.0], [[0.1, -1.0], [-1.0, -0.8]]),
        course(
            "free end, there and onto the other side",
            sheet(),
            [-0.2, 1.0],
            [0.5, 0.0],
            [[-0.3, -0.9], [-0.8, 0.6]],
        ),
        course("free end, swinging", sheet(), [-0.2, 1.0], [0.4, 0.0], still([-1.0, -0.02])),
        course("up a step", step(0.3), [-2.0, 1.0], [1.9, 0.0], still([0.05, -1.0])),
        course("up a low step", step(1.0e-3), [-2.0, 1.0], [0.3, 0.0], still([0.05, -1.0])),
        course("pulled up a step", step(0.1), [-0.44, 1.0], [0.0, 0.0], still([0.9, -0.3])),
        course("over a slit", slit(0.05), [-1.0, 1.0], [0.5, 0.0], still([0.05, -1.0])),
        course("over a wide slit", slit(0.3), [-1.0, 1.0], [0.9, 0.0], still([0.05, -1.0])),
        course("down a step", down(0.1), [-1.0, 1.0], [0.1, 0.0], still([0.05, -1.0])),
        course("down a low step", down(1.0e-4), [-1.0, 1.0], [0.3, 0.0], still([0.0, -1.0])),
        course("down a high step", down(1.5), [-1.0, 1.0], [0.3, 0.0], still([0.0, -1.0])),
    ]
}

/// Courses on which the ball turns back while it rolls around a point.
pub(crate) fn turning_courses() -> [Course; 3] {
    let course = |name, planes, start, speed, acceleration| Course {
        name,
        planes,
        start,
        speed,
        accelerations: [acceleration, acceleration],
    };
    [
        course("free end and back", sheet(), [-0.5, 1.0], [0.9, 0.0], [-0.9, -0.3]),
        course("not up a step", step(0.5), [-2.0, 1.0], [0.5, 0.0], [0.05, -1.0]),
        course("into a slit", slit(0.6), [-1.0, 1.0], [0.3, 0.0], [0.05, -1.0]),
    ]
}

impl Course {
    /// Compares engine and reference at quarters of both stretches and with each tick length; how often of 32 times.
    pub(crate) fn compare(&self, [r, strength, rolling, e]: [f64; 4]) -> u32 {
        let mut n_compared = 0;
        let scaled = |plane: &Plane| Plane {
            offset: plane.offset * r,
            start: plane.start * r,
            end: plane.end * r,
            ..*plane
        };
        let planes: Vec<Plane> = self.planes.iter().map(scaled).collect();
        let spec = BallSpec { radius: Radius::new(r).unwrap(), restitution: e, rolling, resistance: 0.0 };
        let speed = (2.0 * r * strength * rolling).sqrt();
        let ball = Ball {
            position: self.start.map(|x| x * r).into(),
            velocity: self.speed.map(|v| v * speed).into(),
        };
        let accelerations = self.accelerations.map(|acceleration| acceleration.map(|a| a * strength));
        let unit_s = (r / (strength * rolling)).sqrt();
        let world = World::new(&planes, &spec);
        for tick_s in TICKS_S {
            let n_ticks = [3.0, 5.0].map(|time| (time * unit_s / tick_s).ceil() as u32);
            let mut reference = Reference::new(&world, ball, accelerations[0]);
            let sorted = Arc::new(SortedPlanes::new(planes.iter().copied()).unwrap());
            let mut engine = Continuous::new(sorted, spec, ball, tick_s).unwrap();
            let mut n = 0;
            for (acceleration, n_ticks) in accelerations.into_iter().zip(n_ticks) {
                reference.acceleration(acceleration);
                // Compared at quarters of it.
                for quarter in 1..=4 {
                    let until = n + (n_ticks * quarter).div_ceil(4) - (n_ticks * (quarter - 1)).div_ceil(4);
                    let mut dropped = 0.0;
                    for _ in n..until {
                        let tick = engine.tick(acceleration.into()).unwrap();
                        dropped += tick.dropped_s + tick.corrected_overlap;
                    }
                    n = until;
                    reference.advance(&(big(tick_s) * big(f64::from(n))));
                    let (ball, truth) = (engine.ball(), reference.ball());
                    let apart = (ball.position - truth.position).norm();
                    let case = format!(
                        "{}, r {r}, {strength} units/s², rolling {rolling}, e {e}, {n} ticks of {tick_s}",
                        self.name
                    );
                    assert_eq!(dropped, 0.0, "{case}");
                    // Dozens of hits on points multiply roundings until nothing can be said.
                    if MAX_HITS < reference.hits.len() {
                        continue;
                    }
                    assert!(
                        apart < BOUND * r,
                        "{case}: {} r apart, {ball:?} instead of {truth:?}",
                        apart / r
                    );
                    n_compared += 1;
                }
            }
        }
        n_compared
    }
}

/// Radius, acceleration and rolling factor.
pub(crate) const BALLS: [[f64; 3]; 4] = [
    [0.35, 4.0, 1.0],
    [0.35, 4.0, BallSpec::ROLLING_SPHERE],
    [0.25, 300.0, 1.0],
    [1.0e-3, 300.0, BallSpec::ROLLING_SPHERE],
];

#[test]
fn rolls_over_edges_free_ends_steps_and_slits_are_those_of_the_reference() {
    let (mut n_compared, mut n) = (0, 0);
    for [r, strength, rolling] in BALLS {
        for e in [0.0, 0.8] {
            for course in courses() {
                n_compared += course.compare([r, strength, rolling, e]);
                n += 32;
            }
        }
    }
    // The others had too many hits by then.
    assert!(n * 85 / 100 < n_compared, "{n_compared} of {n} compared");
}
