//! What a tick reports: its sums, its hits, and the stretches of motion between them.

use crate::physics::ball::Ball;
use crate::physics::numbers::greater;
use crate::physics::time_of_impact::Path;
use nalgebra::Vector2;

/// What happened within one tick.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tick {
    /// Steps that the tick was divided into; 1 when the ball was slow, and for the exact engine always.
    pub n_steps: u32,
    /// Hits. One may leave the velocity as it is: a ball that is set down on a wall meets it at speed 0.
    pub n_hits: u32,
    /// Those of them that were corners; always 0 for an engine that knows faces only.
    pub n_corner_hits: u32,
    /// Hits after which the ball no longer bounces off the wall; it may still slide along it.
    pub n_rests: u32,
    /// Whether the ball was placed inside a wall and was pushed out. Where it has no room an overlap remains, which
    /// `corrected_overlap` shows in every tick.
    pub recovered: bool,
    /// Largest normal speed of a hit (units/s): how loud it was.
    pub hardest_hit_speed: f64,
    /// Steps of the published engine that ended with a wall still overlapped, because the bound on contacts was reached.
    pub n_unresolved: u32,
    /// Deepest penetration met before push-out (units); for the exact engine only that of a ball that was placed in a wall.
    pub deepest_penetration: f64,
    /// Time that was not simulated because a bound was reached (s).
    pub dropped_s: f64,
    /// Overlap (units) that the exact engine's check at the end of the tick found, and pushed the ball out of. Not 0 means a
    /// fault of the engine, or a ball that was placed where it has no room; there some overlap may remain.
    pub corrected_overlap: f64,
}

/// One hit, as the engine saw it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// From the start of the tick (s). An engine that moves in steps gives the end of the step.
    pub time_s: f64,
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

impl Hit {
    /// The speed at which the ball met the wall, along the normal (units/s); 0 for one that moved away already.
    pub fn normal_speed(&self) -> f64 {
        let speed = -self.before.velocity.dot(&self.normal);
        greater(0.0, speed)
    }
}

/// Watches a tick: each stretch of motion and each hit, in the order in which they happen.
///
/// A function of a [`Hit`] is an observer that is shown hits alone; `()` is one that is shown nothing. Not shown are a push-out
/// ([`Tick::recovered`], [`Tick::corrected_overlap`]) and the speed that rolling resistance takes at the end of a tick.
pub trait Observer {
    /// The centre moved along a path for a time (s), which may be 0: in flight, along a face (the acceleration is then that along
    /// it), or at rest (without velocity and acceleration).
    fn flight(&mut self, path: &Path, duration_s: f64) {
        let _ = (path, duration_s);
    }

    /// The centre moved on an arc for a time (s).
    fn roll(&mut self, arc: &RolledArc, duration_s: f64) {
        let _ = (arc, duration_s);
    }

    /// The ball met a wall.
    fn hit(&mut self, hit: &Hit) {
        let _ = hit;
    }
}

impl Observer for () {}

impl<F: FnMut(&Hit)> Observer for F {
    fn hit(&mut self, hit: &Hit) {
        self(hit);
    }
}

/// A stretch of rolling around a point: the shorter arc from one direction to the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RolledArc {
    /// The middle of the circle on which the ball's centre moves.
    pub point: Vector2<f64>,
    /// Its radius: that of the ball (units).
    pub radius: f64,
    /// Unit vector from the point to the centre at the start.
    pub from: Vector2<f64>,
    /// The same at the end.
    pub to: Vector2<f64>,
}

/// What is noted while a tick is computed: its sums, and its observer.
pub(crate) struct Log<'a, O: Observer + ?Sized> {
    pub(crate) tick: Tick,
    pub(crate) observer: &'a mut O,
}

impl<O: Observer + ?Sized> Log<'_, O> {
    /// Counts a hit with this normal speed (units/s).
    pub(crate) fn note_hit(&mut self, speed: f64, hit: &Hit) {
        self.tick.n_hits += 1;
        if self.tick.hardest_hit_speed < speed {
            self.tick.hardest_hit_speed = speed;
        }
        self.observer.hit(hit);
    }

    /// Remembers a penetration (units) when it is the deepest.
    pub(crate) fn note_penetration(&mut self, depth: f64) {
        if self.tick.deepest_penetration < depth {
            self.tick.deepest_penetration = depth;
        }
    }
}
