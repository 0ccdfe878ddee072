//! Wedges narrower than the ball: where it comes to rest is known in closed form.

use crate::reference_model::{Reference, World, big::big};
use maze_core::{Ball, BallSpec, Continuous, Engine, Facing, Plane, Radius, SortedPlanes};
use nalgebra::Vector2;
use std::f64::consts::PI;
use std::sync::Arc;

/// Walls, where a ball begins at rest, what presses it into the wedge, and where it must come to rest.
pub(crate) struct Wedge {
    pub(crate) planes: Vec<Plane>,
    pub(crate) start: [f64; 2],
    pub(crate) acceleration: [f64; 2],
    pub(crate) rest: [f64; 2],
}

pub(crate) fn face(facing: Facing, offset: f64, start: f64, end: f64) -> Plane {
    Plane { facing, offset, start, end }
}

/// Tops of two blocks with a slit of width 2 c between them.
pub(crate) fn slit(c: f64) -> Vec<Plane> {
    vec![
        face(Facing::PlusY, 0.0, -9.0, -c),
        face(Facing::PlusX, -c, -9.0, 0.0),
        face(Facing::MinusX, c, -9.0, 0.0),
        face(Facing::PlusY, 0.0, c, 9.0),
    ]
}

const PULL: f64 = 4.0;
const TICK_S: f64 = 0.03;
/// How far from its place a ball may rest (radii): the rise below which the engine lets a bounce rest is about 3e-9.
const REST: f64 = 3.0e-9;

impl Wedge {
    /// Two points, by the angle between their normals; the ball begins below the height at which it could leave.
    pub(crate) fn points(r: f64, angle: f64) -> Self {
        let c = r * (angle / 2.0).sin();
        let (rest, barrier) = (r * (angle / 2.0).cos(), r * 2.0 * (angle / 4.0).sin().powi(2));
        Self {
            planes: slit(c),
            start: [0.1 * c, rest + 0.5 * barrier],
            acceleration: [0.0, -PULL],
            rest: [0.0, rest],
        }
    }

    /// A floor and the lower corner of a block above it (beyond a right angle), or the upper corner of a step.
    pub(crate) fn floor_and_corner(r: f64, angle: f64) -> Self {
        // h = r (1 - cos angle), without cancellation.
        let (h, out) = (r * 2.0 * (angle / 2.0).sin().powi(2), r * angle.sin());
        let mut planes = vec![face(Facing::PlusY, 0.0, -9.0, if h < r { 0.0 } else { 9.0 })];
        if h < r {
            planes.extend([face(Facing::MinusX, 0.0, 0.0, h), face(Facing::PlusY, h, 0.0, 9.0)]);
        } else {
            planes.extend([face(Facing::MinusX, 0.0, h, 9.0), face(Facing::MinusY, h, 0.0, 9.0)]);
        }
        // Into the wedge along the middle of the two directions in which the contacts press.
        let (sin, cos) = (angle / 2.0).sin_cos();
        let acceleration = if h < r { [PULL * sin, -PULL * cos] } else { [PULL * 0.7, -PULL * 0.3] };
        let (back, up) = if h < r { (0.1 * out, 0.1 * h * 0.3) } else { (1.5 * r, 0.2 * r) };
        Self { planes, start: [-out - back, r + up], acceleration, rest: [-out, r] }
    }

    /// A concave corner.
    fn faces(r: f64) -> Self {
        let planes = vec![face(Facing::PlusY, 0.0, -9.0, 0.0), face(Facing::MinusX, 0.0, 0.0, 9.0)];
        Self { planes, start: [-2.0 * r, 1.7 * r], acceleration: [2.0, -3.0], rest: [-r, r] }
    }

    /// Two points whose distance is less than the diameter by a part of it.
    pub(crate) fn narrow(r: f64, part: f64) -> Self {
        let rest = r * (part * (2.0 - part)).sqrt();
        let planes = slit(r * (1.0 - part));
        Self { planes, start: [0.02 * r, rest + 0.2 * r], acceleration: [0.0, -PULL], rest: [0.0, rest] }
    }

    pub(crate) fn engine(&self, r: f64, e: f64) -> Continuous {
        let spec = BallSpec { radius: Radius::new(r).unwrap(), restitution: e, ..BallSpec::default() };
        let planes = Arc::new(SortedPlanes::new(self.planes.iter().copied()).unwrap());
        Continuous::new(planes, spec, Ball::at(self.start.into()), TICK_S).unwrap()
    }

    /// The ball comes to rest at the place, without dropped time, after as many hits and as long as a wedge of such an angle takes.
    ///
    /// A pass from one contact to the other keeps the cosine of the angle of the speed and takes about the time of a fall by a
    /// radius, and at each contact it bounces until e^k is small: both grow as 1 / ((1 - e) angle²). Times a number that has
    /// the decades to the rest bound in it, and a margin of two over what was measured.
    fn holds(&self, name: &str, r: f64, e: f64, angle: f64) {
        let slowness = (1.0 + 1.0 / (1.0 - e)) * (1.0 + 1.0 / (angle * angle));
        let max_hits = 80.0 * slowness;
        let max_ticks = 20.0 * slowness * (r / PULL).sqrt() / TICK_S + 5.0;
        let mut engine = self.engine(r, e);
        let (mut n_ticks, mut n_hits, mut before) = (0, 0, None);
        // At rest: twice the same.
        while before.replace(engine.ball()) != Some(engine.ball()) {
            let tick = engine.tick(self.acceleration.into()).unwrap();
            assert_eq!(
                (tick.dropped_s, tick.corrected_overlap, tick.recovered),
                (0.0, 0.0, false),
                "{name}, r {r}, e {e}"
            );
            n_ticks += 1;
            n_hits += tick.n_hits;
            assert!(
                f64::from(n_ticks) < max_ticks && f64::from(n_hits) < max_hits,
                "{name}, r {r}, e {e}: {n_ticks} ticks of {max_ticks}, {n_hits} hits of {max_hits}"
            );
        }
        assert_eq!(engine.ball().velocity, Vector2::zeros(), "{name}, r {r}, e {e}");
        let apart = (engine.ball().position - Vector2::from(self.rest)).norm();
        assert!(apart < REST * r, "{name}, r {r}, e {e}: {} r apart", apart / r);
    }
}

pub(crate) const RADII: [f64; 3] = [1.0e-3, 0.03, 0.5];
const RESTITUTIONS: [f64; 4] = [0.0, 0.5, 0.8, 0.99];

/// Each radius and restitution.
fn balls() -> impl Iterator<Item = (f64, f64)> {
    RADII.into_iter().flat_map(|r| RESTITUTIONS.map(|e| (r, e)))
}

#[test]
fn a_wedge_holds_the_ball_at_the_place_of_the_closed_form() {
    for (r, e) in balls() {
        for angle in [1.5, 1.0, 0.3] {
            Wedge::points(r, angle).holds(&format!("two points, angle {angle}"), r, e, angle);
            Wedge::floor_and_corner(r, angle).holds(&format!("foot of a step, angle {angle}"), r, e, angle);
        }
        for angle in [1.6, 2.0, 2.5, 3.0, 3.1, PI - 1.0e-3, PI - 1.0e-4] {
            Wedge::floor_and_corner(r, angle).holds(&format!("corner above, angle {angle}"), r, e, 1.0);
        }
        Wedge::faces(r).holds("two faces", r, e, 1.0);
    }
    // 1e4 passes: one of each.
    Wedge::points(0.03, 0.1).holds("two points, angle 0.1", 0.03, 0.5, 0.1);
    Wedge::floor_and_corner(0.5, 0.1).holds("foot of a step, angle 0.1", 0.5, 0.0, 0.1);
}

#[test]
fn a_gap_narrower_than_the_ball_holds_it_at_the_place_of_the_closed_form() {
    for (r, e) in balls() {
        for part in [0.1, 1.0e-2, 1.0e-3, 1.0e-4, 1.0e-6, 1.0e-8, 1.0e-10] {
            Wedge::narrow(r, part).holds(&format!("narrower by {part}"), r, e, 1.0);
        }
    }
}

#[test]
fn rocking_in_a_shallow_wedge_is_that_of_the_reference() {
    // Here rest is far away: each pass keeps 1 - angle² / 2 of the speed. The first 20 falls by a radius.
    for (r, angle) in RADII.into_iter().flat_map(|r| [0.3, 0.1, 1.0e-2, 1.0e-3].map(|angle| (r, angle))) {
        let wedge = Wedge::points(r, angle);
        let mut engine = wedge.engine(r, 0.0);
        let world = World::new(&wedge.planes, engine.spec());
        let mut reference = Reference::new(&world, engine.ball(), wedge.acceleration);
        let n_ticks = (20.0 * (r / PULL).sqrt() / TICK_S) as u32 + 1;
        for n in 1..=n_ticks {
            let tick = engine.tick(wedge.acceleration.into()).unwrap();
            assert_eq!((tick.dropped_s, tick.corrected_overlap), (0.0, 0.0));
            if n % 10 == 0 || n == n_ticks {
                reference.advance(&(big(TICK_S) * big(f64::from(n))));
                let apart = (engine.ball().position - reference.ball().position).norm();
                assert!(apart < REST * r, "angle {angle}, r {r}, tick {n}: {} r apart", apart / r);
            }
        }
    }
}
