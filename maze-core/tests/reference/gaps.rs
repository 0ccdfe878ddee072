//! Gaps about as wide as the ball.

use crate::irregular::depth;
use crate::wedges::{face, slit};
use maze_core::{Ball, BallSpec, Continuous, Engine, Facing, Plane, Radius, SortedPlanes};
use std::sync::Arc;

/// Overlap that is none (radii).
const OVERLAP: f64 = 1.0e-9;
const RADII: [f64; 4] = [1.0e-3, 0.1, 0.35, 0.5];
const SPEEDS: [f64; 5] = [0.0, 0.5, 3.0, 30.0, 1.0e3];

/// A ball above a gap, a hundred ticks later; it is never deeper in a wall than [`OVERLAP`].
pub(crate) fn after(planes: &[Plane], r: f64, e: f64, aside: f64, speed: f64) -> Ball {
    let spec = BallSpec { radius: Radius::new(r).unwrap(), restitution: e, ..BallSpec::default() };
    let sorted = Arc::new(SortedPlanes::new(planes.iter().copied()).unwrap());
    let ball = Ball { position: [aside, 2.0 * r].into(), velocity: [0.0, -speed].into() };
    let mut engine = Continuous::new(sorted, spec, ball, 0.01).unwrap();
    for _ in 0..100 {
        let tick = engine.tick([0.0, -4.0].into()).unwrap();
        assert_eq!((tick.dropped_s, tick.corrected_overlap), (0.0, 0.0), "r {r}, e {e}, speed {speed}");
        let overlap = depth(planes, engine.ball().position, r);
        assert!(overlap < OVERLAP * r, "r {r}, e {e}, speed {speed}: {} r deep", overlap / r);
    }
    engine.ball()
}

#[test]
fn a_gap_narrower_than_the_ball_is_not_entered() {
    for (r, speed) in RADII.into_iter().flat_map(|r| SPEEDS.map(|speed| (r, speed))) {
        for part in [1.0e-10, 1.0e-8, 1.0e-6, 1.0e-3, 0.1] {
            for (e, aside) in [(0.0, 0.0), (0.5, 0.0), (0.8, 1.0e-9 * r), (0.8, 0.01 * r), (0.99, 0.1 * r)] {
                let ball = after(&slit(r * (1.0 - part)), r, e, aside, speed);
                let rest = r * (part * (2.0 - part)).sqrt();
                let high = ball.position.y;
                assert!(rest - OVERLAP * r < high, "r {r}, narrower by {part}, e {e}, speed {speed}: {high}");
            }
        }
    }
}

/// The ball falls as if there were nothing.
fn is_passed(planes: &[Plane], r: f64, aside: f64) {
    for (speed, e) in SPEEDS.into_iter().flat_map(|speed| [0.0, 0.8, 1.0].map(|e| (speed, e))) {
        let ball = after(planes, r, e, aside, speed);
        let [x, y] = [aside, 2.0 * r - speed - 2.0];
        // A hundred roundings of the place.
        let bound = 100.0 * f64::EPSILON * (1.0 + y.abs());
        let apart = [ball.position.x - x, ball.position.y - y, ball.velocity.x];
        assert!(apart.iter().all(|apart| apart.abs() < bound), "r {r}, e {e}, speed {speed}: {ball:?}");
    }
}

#[test]
fn a_gap_equal_to_the_diameter_to_the_last_bit_is_passed() {
    for r in RADII {
        is_passed(&slit(r), r, 0.0);
    }
}

#[test]
fn a_gap_wider_than_the_diameter_by_an_ulp_is_passed() {
    for r in RADII {
        let mut planes = slit(r);
        for plane in &mut planes {
            match plane.facing {
                Facing::MinusX => plane.offset = r.next_up(),
                _ if plane.start == r => *plane = face(plane.facing, plane.offset, r.next_up(), plane.end),
                _ => {}
            }
        }
        is_passed(&planes, r, 0.0);
    }
}
