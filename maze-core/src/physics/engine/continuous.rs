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
