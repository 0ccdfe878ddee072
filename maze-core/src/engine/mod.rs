//! Engines: what moves the ball through one tick.

mod clearing;
pub mod continuous;
mod pivot;
pub mod published;

pub use continuous::Continuous;
pub use published::Published;

use crate::ball::{Ball, BallSpec, OutOfRange};
use nalgebra::Vector2;

/// What happened within one tick.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tick {
    /// Steps that the tick was walked in; 1 when the ball was slow.
    pub n_steps: u32,
    /// Contacts that changed the velocity.
    pub n_hits: u32,
    /// Those of them that were corners; always 0 for an engine that knows faces only.
    pub n_corner_hits: u32,
    /// Bounces that ended in rest.
    pub n_rests: u32,
    /// Whether the ball began inside a wall and was put outside.
    pub recovered: bool,
    /// Largest normal speed of a hit (units/s): how loud it was.
    pub hardest_hit_speed: f64,
    /// Steps that ended with a wall still overlapped, because the bound on contacts was reached.
    pub n_unresolved: u32,
    /// Deepest penetration met before push-out (units).
    pub deepest_penetration: f64,
    /// Time that was not simulated because a bound was reached (s).
    pub dropped_s: f64,
}

/// One hit, as the engine saw it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The point of the wall that was touched.
    pub point: Vector2<f64>,
    /// Unit vector along which the ball was pushed out and reflected.
    pub normal: Vector2<f64>,
    /// How deep the ball was in the wall (units); 0 for an engine that meets walls exactly.
    pub penetration: f64,
    /// Before push-out and reflection.
    pub before: Ball,
    /// After both.
    pub after: Ball,
}

/// What is noted while a tick is computed: the sums, and for who asks every hit.
struct Log<'a> {
    tick: Tick,
    observer: &'a mut dyn FnMut(&Hit),
}

impl Log<'_> {
    /// Counts a hit with this normal speed (units/s).
    fn note_hit(&mut self, speed: f64, hit: &Hit) {
        self.tick.n_hits += 1;
        if self.tick.hardest_hit_speed < speed {
            self.tick.hardest_hit_speed = speed;
        }
        (self.observer)(hit);
    }

    /// Remembers a penetration (units) when it is the deepest.
    fn note_penetration(&mut self, depth: f64) {
        if self.tick.deepest_penetration < depth {
            self.tick.deepest_penetration = depth;
        }
    }
}

/// A way to compute the ball's motion.
///
/// The same inputs give the same bits on every platform.
pub trait Engine {
    /// Advances by one tick under a constant acceleration in the maze plane (units/s²).
    ///
    /// # Errors
    /// An acceleration that is not finite, or one that makes the velocity so; the ball stays as it was.
    fn tick(&mut self, acceleration: Vector2<f64>) -> Result<Tick, OutOfRange>;

    /// [`Engine::tick`] that also shows each hit as it happens. An engine that cannot tell shows none.
    ///
    /// # Errors
    /// As [`Engine::tick`].
    fn tick_observed(
        &mut self,
        acceleration: Vector2<f64>,
        observer: &mut dyn FnMut(&Hit),
    ) -> Result<Tick, OutOfRange> {
        let _ = observer;
        self.tick(acceleration)
    }

    /// Where the ball is now.
    fn ball(&self) -> Ball;

    /// Puts the ball somewhere else.
    ///
    /// # Errors
    /// A position or velocity that is not finite; the ball stays as it was.
    fn place(&mut self, ball: Ball) -> Result<(), OutOfRange>;

    /// What the ball is made of.
    fn spec(&self) -> &BallSpec;

    /// Length of a tick (s).
    fn tick_s(&self) -> f64;
}
