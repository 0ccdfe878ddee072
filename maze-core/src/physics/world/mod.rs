//! The exact motion: walls, ball and tick length in one immutable [`World`], which advances any number of balls.

mod carlson;
mod collision;
mod events;
mod free_space;
mod guard;
mod roll;
mod state;

pub use events::MAX_EVENTS;
pub use state::{BallState, Contact, Contacts};

use crate::physics::ball::{BallSpec, OutOfRange};
use crate::physics::sorted_planes::SortedPlanes;
use crate::physics::tick::{Observer, Tick};
use nalgebra::Vector2;
use std::sync::Arc;

/// Longest tick (s).
pub const MAX_TICK_S: f64 = 1000.0;

/// The length of a tick (s), if it is usable.
pub(crate) fn check_tick_s(tick_s: f64) -> Result<f64, OutOfRange> {
    if 0.0 < tick_s && tick_s <= MAX_TICK_S {
        return Ok(tick_s);
    }
    Err(OutOfRange { what: "the tick's length", expected: "seconds greater than 0, at most 1000" })
}

/// Everything that the motion of a ball depends on except the ball's own state: walls, radius and material, tick length.
///
/// A world is immutable. Clones share the walls, so that one world serves a ball, its ghosts and a batch of a million balls; balls
/// do not touch each other. The same inputs give the same bits on every platform, and a tick allocates nothing.
///
/// ```
/// use maze_core::{Ball, BallSpec, BallState, Facing, Plane, SortedPlanes, World};
/// use nalgebra::Vector2;
/// use std::sync::Arc;
///
/// let wall = Plane { facing: Facing::MinusX, offset: 5.0, start: -1.0, end: 1.0 };
/// let world = World::new(Arc::new(SortedPlanes::new([wall])?), BallSpec::default(), 0.01)?;
/// let at = |x: f64| BallState::new(Ball::at(Vector2::new(x, 0.0)));
/// let mut balls = [at(0.0)?, at(1.0)?, at(2.0)?];
/// for _ in 0..100 {
///     world.tick_all(&mut balls, &[Vector2::new(2.0, 0.0); 3])?;
/// }
/// assert!((balls[0].ball().position.x - 1.0).abs() < 1.0e-9); // a t² / 2
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
#[repr(C)] // Field order for memory locality: the last fields lie beside the state of the ball in `Continuous`.
pub struct World {
    planes: Arc<SortedPlanes>,
    /// Whether the free-space cache is used.
    is_cached: bool,
    spec: BallSpec,
    tick_s: f64,
}

/// A batch of balls could not be advanced.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum BatchError {
    /// Each ball needs an acceleration of its own.
    #[error("{n_accelerations} accelerations for {n_balls} balls: expected one for each ball")]
    Length {
        /// How many balls there are.
        n_balls: usize,
        /// How many accelerations there are.
        n_accelerations: usize,
    },
    /// A ball could not be advanced. Those before it have been, it and those after it have not.
    #[error("ball {index}: {error}")]
    Ball {
        /// Which one, counted from 0.
        index: usize,
        /// Why.
        error: OutOfRange,
    },
}

impl World {
    /// Walls, ball and the length of a tick (s).
    ///
    /// # Errors
    /// A tick length that is not finite, not greater than 0, or more than [`MAX_TICK_S`]; a restitution or rolling factor outside
    /// 0 to 1; a negative or infinite rolling resistance.
    pub fn new(planes: Arc<SortedPlanes>, spec: BallSpec, tick_s: f64) -> Result<Self, OutOfRange> {
        Ok(Self { planes, is_cached: true, spec: spec.checked()?, tick_s: check_tick_s(tick_s)? })
    }

    /// The same world that searches in every tick: what the free-space cache is tested and measured against.
    #[must_use]
    pub fn without_cache(self) -> Self {
        Self { is_cached: false, ..self }
    }

    /// The wall faces.
    pub fn planes(&self) -> &Arc<SortedPlanes> {
        &self.planes
    }

    /// Radius and material of the ball.
    pub fn spec(&self) -> &BallSpec {
        &self.spec
    }

    /// Length of a tick (s).
    pub fn tick_s(&self) -> f64 {
        self.tick_s
    }

    fn radius(&self) -> f64 {
        self.spec.radius.units()
    }

    /// Advances one ball by one tick under a constant projected gravity (units/s²), and shows an observer every stretch of motion
    /// and every hit; `&mut ()` observes nothing and costs nothing.
    ///
    /// A state belongs to the world that advances it: what it remembers of the walls is that world's. To carry a ball into another
    /// world, make a new state of [`BallState::ball`].
    ///
    /// # Errors
    /// A position, velocity or acceleration whose square is not finite, at the start or at the end of the tick; the ball stays as it
    /// was.
    #[inline(always)] // Keeps the ball in registers; passing it through memory costs as much as the rest.
    pub fn tick<O: Observer + ?Sized>(
        &self,
        state: &mut BallState,
        acceleration: Vector2<f64>,
        observer: &mut O,
    ) -> Result<Tick, OutOfRange> {
        let acceleration = acceleration * self.spec.rolling;
        if let Some(free_space) = &state.free_space
            && let Some((ball, path)) = free_space.pass(state.ball, acceleration, self.tick_s)
        {
            state.ball = ball;
            observer.flight(&path, self.tick_s);
            return Ok(Tick { n_steps: 1, ..Tick::default() });
        }
        self.searched_tick(state, acceleration, observer)
    }

    /// Advances each ball by one tick under an acceleration of its own (units/s²), in order.
    ///
    /// # Errors
    /// Another number of accelerations than of balls; what [`World::tick`] refuses, with the ball's index.
    pub fn tick_all(
        &self,
        states: &mut [BallState],
        accelerations: &[Vector2<f64>],
    ) -> Result<(), BatchError> {
        let (n_balls, n_accelerations) = (states.len(), accelerations.len());
        if n_balls != n_accelerations {
            return Err(BatchError::Length { n_balls, n_accelerations });
        }
        for (index, (state, acceleration)) in states.iter_mut().zip(accelerations).enumerate() {
            self.tick(state, *acceleration, &mut ()).map_err(|error| BatchError::Ball { index, error })?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::ball::Ball;
    use crate::physics::engine::{Continuous, Engine};
    use crate::physics::wall::{Facing, Plane};

    fn room() -> Arc<SortedPlanes> {
        let walls =
            [(Facing::PlusX, 0.0), (Facing::MinusX, 9.0), (Facing::PlusY, 0.0), (Facing::MinusY, 9.0)];
        let room = walls.map(|(facing, offset)| Plane { facing, offset, start: 0.0, end: 9.0 });
        let post = [(Facing::MinusX, 4.0), (Facing::PlusX, 5.0), (Facing::MinusY, 4.0), (Facing::PlusY, 5.0)];
        let post = post.map(|(facing, offset)| Plane { facing, offset, start: 4.0, end: 5.0 });
        Arc::new(SortedPlanes::new(room.into_iter().chain(post)).unwrap())
    }

    #[test]
    fn a_batch_moves_each_ball_as_an_engine_of_its_own_does() {
        let world = World::new(room(), BallSpec::default(), 0.03).unwrap();
        let balls: Vec<Ball> = (0..40)
            .map(|n| Ball {
                position: Vector2::new(0.5 + 0.2 * f64::from(n % 7), 0.6 + 0.2 * f64::from(n)),
                velocity: Vector2::new(f64::from(n) - 20.0, 7.0),
            })
            .collect();
        let mut states: Vec<BallState> = balls.iter().map(|ball| BallState::new(*ball).unwrap()).collect();
        let engine = |ball: &Ball| Continuous::new(room(), BallSpec::default(), *ball, 0.03).unwrap();
        let mut engines: Vec<Continuous> = balls.iter().map(engine).collect();
        for n in 0..2000_u32 {
            let acceleration = |index: usize| {
                Vector2::new(1.0, if n % 300 < 150 { -3.0 } else { 2.0 }) * (index as f64 / 40.0)
            };
            let accelerations: Vec<_> = (0..40).map(acceleration).collect();
            world.tick_all(&mut states, &accelerations).unwrap();
            for (engine, acceleration) in engines.iter_mut().zip(accelerations) {
                engine.tick(acceleration).unwrap();
            }
        }
        for (state, engine) in states.iter().zip(&engines) {
            assert_eq!(state, engine.state());
        }
    }

    #[test]
    fn a_batch_names_the_ball_that_it_cannot_advance() {
        let world = World::new(room(), BallSpec::default(), 0.03).unwrap();
        let state = BallState::new(Ball::at(Vector2::new(2.0, 2.0))).unwrap();
        let mut states = [state.clone(), state.clone(), state.clone()];
        let steady = Vector2::new(1.0, 0.0);
        let error = world.tick_all(&mut states, &[steady]).unwrap_err();
        assert_eq!(error.to_string(), "1 accelerations for 3 balls: expected one for each ball");
        let error = world.tick_all(&mut states, &[steady, steady * f64::NAN, steady]).unwrap_err();
        assert_eq!(error.to_string(), "ball 1: the acceleration: expected a finite number");
        assert_eq!(states.map(|moved| moved == state), [false, true, true]);
    }

    #[test]
    fn most_ticks_of_a_rolling_ball_need_no_search() {
        let walls =
            [(Facing::PlusX, 0.0), (Facing::MinusX, 9.0), (Facing::PlusY, 0.0), (Facing::MinusY, 1.0)];
        let corridor = walls.map(|(facing, offset)| Plane { facing, offset, start: 0.0, end: 9.0 });
        let planes = Arc::new(SortedPlanes::new(corridor).unwrap());
        let world = World::new(planes, BallSpec::default(), 0.03).unwrap();
        let mut state = BallState::new(Ball::at(Vector2::new(1.0, 0.5))).unwrap();
        let mut n_searched = 0;
        for n in 0..1000 {
            let acceleration = Vector2::new(if n % 200 < 100 { 0.5 } else { -0.5 }, -0.5);
            let free_space = state.free_space.as_ref();
            let passes = free_space.and_then(|free| free.pass(state.ball, acceleration, 0.03)).is_some();
            n_searched += u32::from(!passes);
            world.tick(&mut state, acceleration, &mut ()).unwrap();
        }
        assert!(n_searched < 200, "{n_searched} of 1000");
    }
}
