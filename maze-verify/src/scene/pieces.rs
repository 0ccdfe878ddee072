//! What named scenes are put together from.

use super::{Family, Gravity, Scene, Walls};
use maze_core::{Ball, BallSpec, Bounds, Radius};
use nalgebra::Vector2;

/// The tick lengths of the cross-check (s): the report's, those of usual screens and physics, and a fine one.
pub const TICKS_S: [f64; 5] = [0.03, 1.0 / 60.0, 1.0 / 120.0, 1.0 / 240.0, 0.001];

/// Radius of the ball in the scenes (units).
pub(super) const R: f64 = 0.25;

pub(super) fn spec(restitution: f64) -> BallSpec {
    BallSpec { radius: Radius::new(R).unwrap_or(BallSpec::RADIUS), restitution, ..BallSpec::default() }
}

pub(super) fn wall([x0, y0]: [f64; 2], [x1, y1]: [f64; 2]) -> Bounds {
    Bounds { low: Vector2::new(x0, y0), high: Vector2::new(x1, y1) }
}

pub(super) fn ball(position: [f64; 2], velocity: [f64; 2]) -> Option<Ball> {
    Some(Ball { position: position.into(), velocity: velocity.into() })
}

/// On a level board, with restitution 0.8.
pub(super) fn scene(name: impl Into<String>, about: impl Into<String>, family: Family) -> Scene {
    Scene {
        name: name.into(),
        about: about.into(),
        family,
        walls: Walls::Rectangles(Vec::new()),
        ball: None,
        spec: spec(BallSpec::RESTITUTION),
        gravity: Gravity::Flat,
        duration_s: 3.0,
        ticks_s: TICKS_S.to_vec(),
        truth: None,
        rest: None,
    }
}
