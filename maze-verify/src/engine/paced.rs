//! The published engine at tick lengths other than its own.

use maze_core::{Ball, BallSpec, Engine, Observer, OutOfRange, Published, SortedPlanes, Tick};
use nalgebra::Vector2;
use std::sync::Arc;

/// [`Published`] with a tick of any length.
///
/// The report's tick is 0.03 s. Its method knows time only as way a tick and gain of way a tick, so a tick of dt seconds is
/// the same method with velocities times dt / 0.03 and accelerations, rolling resistance among them, times (dt / 0.03)².
#[derive(Clone, Debug)]
pub struct PacedPublished {
    inner: Published,
    spec: BallSpec,
    tick_s: f64,
}

impl PacedPublished {
    /// A ball among planes; `tick_s` is greater than 0.
    ///
    /// # Errors
    /// What [`Published::new`] refuses.
    pub fn new(
        planes: Arc<SortedPlanes>,
        spec: BallSpec,
        ball: Ball,
        tick_s: f64,
    ) -> Result<Self, OutOfRange> {
        let pace = tick_s / Published::TICK_S;
        let ball = Ball { velocity: ball.velocity * pace, ..ball };
        let paced = BallSpec { resistance: spec.resistance * (pace * pace), ..spec };
        Ok(Self { inner: Published::new(planes, paced, ball)?, spec, tick_s })
    }

    fn pace(&self) -> f64 {
        self.tick_s / Published::TICK_S
    }
}

impl Engine for PacedPublished {
    /// Shows an observer nothing: the engine within counts in other units.
    fn tick_observed(
        &mut self,
        acceleration: Vector2<f64>,
        _observer: &mut dyn Observer,
    ) -> Result<Tick, OutOfRange> {
        let pace = self.pace();
        let tick = self.inner.tick(acceleration * (pace * pace))?;
        Ok(Tick {
            hardest_hit_speed: tick.hardest_hit_speed / pace,
            dropped_s: tick.dropped_s * pace,
            ..tick
        })
    }

    fn ball(&self) -> Ball {
        let ball = self.inner.ball();
        Ball { velocity: ball.velocity / self.pace(), ..ball }
    }

    fn place(&mut self, ball: Ball) -> Result<(), OutOfRange> {
        self.inner.place(Ball { velocity: ball.velocity * self.pace(), ..ball })
    }

    fn spec(&self) -> &BallSpec {
        &self.spec
    }

    fn tick_s(&self) -> f64 {
        self.tick_s
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use maze_core::{Facing, Plane};

    #[test]
    fn at_its_own_tick_it_is_the_published_engine_to_the_bit() {
        let wall = Plane { facing: Facing::MinusX, offset: 2.0, start: -9.0, end: 9.0 };
        let planes = Arc::new(SortedPlanes::new([wall]).unwrap());
        let ball = Ball { position: Vector2::zeros(), velocity: Vector2::new(3.0, 0.1) };
        let mut paced =
            PacedPublished::new(planes.clone(), BallSpec::default(), ball, Published::TICK_S).unwrap();
        let mut plain = Published::new(planes, BallSpec::default(), ball).unwrap();
        for _ in 0..100 {
            let pull = Vector2::new(1.0, -0.2);
            assert_eq!(paced.tick(pull).unwrap(), plain.tick(pull).unwrap());
            assert_eq!(paced.ball(), plain.ball());
        }
    }

    #[test]
    fn half_a_tick_moves_half_as_far() {
        let planes = Arc::new(SortedPlanes::new([]).unwrap());
        let ball = Ball { position: Vector2::zeros(), velocity: Vector2::new(2.0, 0.0) };
        let mut paced = PacedPublished::new(planes, BallSpec::default(), ball, 0.015).unwrap();
        paced.tick(Vector2::new(0.0, 4.0)).unwrap();
        let after = paced.ball();
        assert!((after.velocity - Vector2::new(2.0, 0.06)).norm() < 1.0e-15);
        assert!((after.position - Vector2::new(0.03, 0.0009)).norm() < 1.0e-15);
    }
}
