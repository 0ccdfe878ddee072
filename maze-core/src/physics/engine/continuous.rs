//! The exact engine: one [`World`] and one ball in it.

use super::Engine;
use crate::physics::ball::{Ball, BallSpec, OutOfRange};
use crate::physics::sorted_planes::SortedPlanes;
use crate::physics::tick::{Observer, Tick};
use crate::physics::world::{BallState, World};
use nalgebra::Vector2;
use std::sync::Arc;

/// The exact engine: a [`World`] and the state of one ball in it.
///
/// Its motion does not depend on the tick's length (but for rolling resistance, which is taken at the end of each tick, and for
/// rounding). There are no substeps: the cost of a tick grows with what the ball touches in it, not with the distance that it
/// covers. The same inputs give the same bits on every platform.
///
/// ```
/// use maze_core::{Ball, BallSpec, Continuous, Engine, Facing, Plane, SortedPlanes, Tilt};
/// use std::sync::Arc;
///
/// let floor = Plane { facing: Facing::PlusY, offset: 0.0, start: -9.0, end: 9.0 };
/// let planes = Arc::new(SortedPlanes::new([floor])?);
/// let ball = Ball::at([0.0, 1.0].into());
/// let mut engine = Continuous::new(planes, BallSpec::default(), ball, 0.03)?;
/// let hits = engine.simulate(Tilt::degrees(0.0, -30.0), 2.0)?;
/// // It falls 1 - 0.35 units under g sin 30°.
/// let expected_s = (2.0 * (1.0 - 0.35) / (9.81 * 0.5_f64)).sqrt();
/// assert!((hits[0].time_s - expected_s).abs() < 1.0e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
#[repr(C)] // What the usual tick needs lies side by side: the end of the world, and the start of the state.
pub struct Continuous {
    world: World,
    state: BallState,
}

impl Continuous {
    /// A ball among planes; `tick_s` is the length of a tick (s).
    ///
    /// # Errors
    /// What [`World::new`] and [`BallState::new`] refuse.
    pub fn new(
        planes: Arc<SortedPlanes>,
        spec: BallSpec,
        ball: Ball,
        tick_s: f64,
    ) -> Result<Self, OutOfRange> {
        Ok(Self { world: World::new(planes, spec, tick_s)?, state: BallState::new(ball)? })
    }

    /// The same engine that searches in every tick: what the free-space cache is tested and measured against.
    #[must_use]
    pub fn without_cache(self) -> Self {
        Self { world: self.world.without_cache(), state: self.state }
    }

    /// The ball and its active contacts, as at the end of the last tick; no contacts after [`Continuous::new`] and
    /// [`Engine::place`] until the first one. To save an engine and go on to the bit, clone it.
    pub fn state(&self) -> &BallState {
        &self.state
    }

    /// Walls, ball and tick length.
    pub fn world(&self) -> &World {
        &self.world
    }
}

impl Engine for Continuous {
    fn tick_observed(
        &mut self,
        acceleration: Vector2<f64>,
        observer: &mut dyn Observer,
    ) -> Result<Tick, OutOfRange> {
        self.world.tick(&mut self.state, acceleration, observer)
    }

    fn tick(&mut self, acceleration: Vector2<f64>) -> Result<Tick, OutOfRange> {
        self.world.tick(&mut self.state, acceleration, &mut ())
    }

    fn ball(&self) -> Ball {
        self.state.ball()
    }

    fn place(&mut self, ball: Ball) -> Result<(), OutOfRange> {
        self.state = BallState::new(ball)?;
        Ok(())
    }

    fn spec(&self) -> &BallSpec {
        self.world.spec()
    }

    fn tick_s(&self) -> f64 {
        self.world.tick_s()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::gravity::Tilt;
    use crate::physics::wall::{Facing, Plane};

    /// Between two walls, one unit apart, at 10 units/s and without loss.
    fn between_walls(tick_s: f64) -> Continuous {
        let walls = [(Facing::PlusX, 0.0), (Facing::MinusX, 1.0)];
        let walls = walls.map(|(facing, offset)| Plane { facing, offset, start: -9.0, end: 9.0 });
        let spec = BallSpec { restitution: 1.0, ..BallSpec::default() };
        let ball = Ball { position: Vector2::new(0.5, 0.0), velocity: Vector2::new(10.0, 0.0) };
        Continuous::new(Arc::new(SortedPlanes::new(walls).unwrap()), spec, ball, tick_s).unwrap()
    }

    #[test]
    fn simulated_hits_have_their_times_from_the_start() {
        for tick_s in [0.01, 0.03, 1.0, 7.0] {
            let hits = between_walls(tick_s).simulate(Tilt::LEVEL, 21.0).unwrap();
            // The centre has 0.3 units of play, and starts in the middle of it.
            assert!((699..=701).contains(&hits.len()), "{tick_s}: {}", hits.len());
            for (n, hit) in hits.iter().enumerate() {
                assert!((hit.time_s - (0.015 + 0.03 * n as f64)).abs() < 1.0e-9, "{tick_s}: {hit:?}");
                assert!((hit.normal_speed() - 10.0).abs() < 1.0e-9);
            }
        }
    }

    #[test]
    fn a_time_that_cannot_be_simulated_is_refused() {
        let refused = |tick_s: f64, duration_s: f64| {
            let error = between_walls(tick_s).simulate(Tilt::LEVEL, duration_s).unwrap_err();
            error.to_string()
        };
        for duration_s in [-1.0, f64::NAN, f64::INFINITY, 86_400_001.0] {
            let message = "the time to simulate: expected seconds, 0 or more, of at most 86,400,000 ticks";
            assert_eq!(refused(1.0, duration_s), message);
        }
        // More hits than a tick follows: nothing is dropped in silence.
        let message = "the tick's length: expected so short that the engine drops no time";
        assert_eq!(refused(1000.0, 1000.0), message);
        assert!(between_walls(0.03).simulate(Tilt::LEVEL, 0.0).unwrap().is_empty());
    }
}
