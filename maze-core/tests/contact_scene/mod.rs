//! A ball among walls, and what must hold of it in every tick.
#![allow(dead_code, reason = "each test uses a part of it")]

use super::irregular::depth;
use maze_core::{Ball, BallSpec, Continuous, Engine, Plane, Radius, SortedPlanes, Tick};
use nalgebra::Vector2;
use std::sync::Arc;

/// Radius of most balls.
pub(crate) const R: f64 = 0.35;

/// A ball among walls.
pub(crate) struct Scene {
    pub(crate) planes: Vec<Plane>,
    pub(crate) radius: f64,
    pub(crate) restitution: f64,
    pub(crate) position: [f64; 2],
    pub(crate) velocity: [f64; 2],
    pub(crate) acceleration: [f64; 2],
    pub(crate) tick_s: f64,
}

impl Scene {
    pub(crate) fn new(
        planes: Vec<Plane>,
        position: [f64; 2],
        velocity: [f64; 2],
        acceleration: [f64; 2],
    ) -> Self {
        Self { planes, radius: R, restitution: 0.8, position, velocity, acceleration, tick_s: 0.03 }
    }

    pub(crate) fn engine(&self) -> Continuous {
        let radius = Radius::new(self.radius).unwrap();
        let spec = BallSpec { radius, restitution: self.restitution, ..BallSpec::default() };
        let ball = Ball { position: self.position.into(), velocity: self.velocity.into() };
        let planes = Arc::new(SortedPlanes::new(self.planes.iter().copied()).unwrap());
        Continuous::new(planes, spec, ball, self.tick_s).unwrap()
    }

    /// The ball after a time, and all ticks; never in a wall, never richer, never corrected, no time dropped.
    pub(crate) fn run(&self, time_s: f64) -> (Ball, Vec<Tick>) {
        let (mut engine, acceleration) = (self.engine(), Vector2::from(self.acceleration));
        let energy = |ball: Ball| ball.velocity.norm_squared() / 2.0 - acceleration.dot(&ball.position);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small count")]
        let n_ticks = (time_s / self.tick_s).round() as u32;
        let ticks = (0..n_ticks).map(|n| {
            let before = engine.ball();
            let tick = engine.tick(acceleration).unwrap();
            let after = engine.ball();
            let deep = depth(&self.planes, after.position, self.radius);
            assert!(deep < 1.0e-9 * self.radius, "tick {n}: {deep} deep, {before:?} -> {after:?}");
            let gain = energy(after) - energy(before);
            let scale = before.velocity.norm_squared() + acceleration.norm() * self.radius;
            assert!(gain < 1.0e-9 * scale, "tick {n}: gains {gain}, {before:?} -> {after:?}");
            assert_eq!((tick.dropped_s, tick.corrected_overlap), (0.0, 0.0), "tick {n}: {before:?} {tick:?}");
            tick
        });
        let ticks = ticks.collect();
        (engine.ball(), ticks)
    }

    /// Where it ends, which must be at rest there.
    pub(crate) fn rests_at(&self, time_s: f64, x: f64, y: f64, about: &str) -> Vec<Tick> {
        let (ball, ticks) = self.run(time_s);
        assert_eq!(ball.velocity, Vector2::zeros(), "{about}: {ball:?}");
        let off = (ball.position - Vector2::new(x, y)).norm();
        assert!(off < 1.0e-9, "{about}: {off} off, {ball:?} instead of {x}, {y}");
        ticks
    }
}
