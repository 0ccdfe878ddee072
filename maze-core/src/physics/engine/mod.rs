//! Engines: different ways to compute the motion of one ball, behind one trait.

mod continuous;
mod published;

pub use continuous::Continuous;
pub use published::{MAX_SUBSTEPS, Published, SUBSTEP};

use crate::physics::ball::{Ball, BallSpec, OutOfRange};
use crate::physics::gravity::{self, Tilt};
use crate::physics::tick::{Hit, Observer, Tick};
use nalgebra::Vector2;

/// Most ticks of one call of [`Engine::simulate`]: a day of ticks of a millisecond.
const MAX_SIMULATED_TICKS: f64 = 86_400_000.0;

/// A way to compute the motion of one ball.
///
/// What holds for every implementor is written here. [`Continuous`] and [`Published`] also give the same bits on every
/// platform and allocate nothing in a tick; an engine that wraps another library may do neither.
pub trait Engine {
    /// Advances by one tick under a constant projected gravity (units/s²). The ball's acceleration is this times
    /// [`BallSpec::rolling`].
    ///
    /// The observer is shown the hits and the stretches of motion that the engine knows of, in the order in which they happen.
    /// An engine that cannot tell shows fewer of them, or none. The motion does not depend on the observer.
    ///
    /// # Errors
    /// An acceleration that is not finite, or one that makes the velocity so; the ball stays as it was.
    fn tick_observed(
        &mut self,
        acceleration: Vector2<f64>,
        observer: &mut dyn Observer,
    ) -> Result<Tick, OutOfRange>;

    /// [`Engine::tick_observed`] without an observer.
    ///
    /// # Errors
    /// As [`Engine::tick_observed`].
    fn tick(&mut self, acceleration: Vector2<f64>) -> Result<Tick, OutOfRange> {
        self.tick_observed(acceleration, &mut ())
    }

    /// Plays ticks under one tilt of the board for a time (s), rounded to whole ticks, and returns the hits that the engine
    /// showed. Here [`Hit::time_s`] counts from the start of the call, to rounding.
    ///
    /// # Errors
    /// A time that is negative or not finite, or more than 86,400,000 ticks. After the ticks that could be played: an acceleration
    /// that makes the velocity not finite, and a tick so long that the engine drops a part of it ([`Tick::dropped_s`]).
    fn simulate(&mut self, tilt: Tilt, duration_s: f64) -> Result<Vec<Hit>, OutOfRange> {
        let tick_s = self.tick_s();
        let wanted = duration_s / tick_s;
        if !(0.0 <= duration_s && wanted <= MAX_SIMULATED_TICKS) {
            let expected = "seconds, 0 or more, of at most 86,400,000 ticks";
            return Err(OutOfRange { what: "the time to simulate", expected });
        }
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "0 <= wanted <= 86,400,000"
        )]
        let n_ticks = (wanted + 0.5) as u32;
        let acceleration = gravity::project(gravity::WORLD_GRAVITY, &tilt.world_from_maze());
        let mut hits = Vec::new();
        for n in 0..n_ticks {
            let started_s = f64::from(n) * tick_s;
            let mut note = |hit: &Hit| hits.push(Hit { time_s: started_s + hit.time_s, ..*hit });
            if self.tick_observed(acceleration, &mut note)?.dropped_s != 0.0 {
                let expected = "so short that the engine drops no time";
                return Err(OutOfRange { what: "the tick's length", expected });
            }
        }
        Ok(hits)
    }

    /// Where the ball is now.
    fn ball(&self) -> Ball;

    /// Puts the ball somewhere else, and forgets what it touched. A ball that is put into a wall is pushed out of it in the ticks
    /// that follow, as far as the engine can.
    ///
    /// # Errors
    /// A position or velocity that is not finite; the ball stays as it was.
    fn place(&mut self, ball: Ball) -> Result<(), OutOfRange>;

    /// Radius and material of the ball.
    fn spec(&self) -> &BallSpec;

    /// Length of a tick (s).
    fn tick_s(&self) -> f64;
}
