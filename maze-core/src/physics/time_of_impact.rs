//! Time of impact: when a circle on a parabola first touches one face or one end point.
//!
//! Times are counted from the parabola's start. Numbers are expected to be finite, as a [`crate::sweep::SweepQuery`] holds them,
//! and are not checked here.

use crate::physics::numbers::{greater, lesser};
use crate::physics::roots::{bracketed_root, falls_through_zero, quadratic_roots};
use crate::physics::tolerance::{self, PASSING};
use crate::physics::wall::Plane;
use nalgebra::Vector2;

/// Motion under constant acceleration: position + velocity t + acceleration t² / 2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Path {
    /// Where it starts (units).
    pub position: Vector2<f64>,
    /// Velocity at the start (units/s).
    pub velocity: Vector2<f64>,
    /// Constant acceleration (units/s²).
    pub acceleration: Vector2<f64>,
}

impl Path {
    /// Where the path is at a time (s).
    pub fn at(&self, time_s: f64) -> Vector2<f64> {
        self.position + (self.velocity + self.acceleration * (time_s / 2.0)) * time_s
    }

    /// Its velocity at a time (s).
    pub fn velocity_at(&self, time_s: f64) -> Vector2<f64> {
        self.velocity + self.acceleration * time_s
    }

    /// Least and greatest coordinate along one axis from the start to a time.
    pub(crate) fn range_until(&self, axis: usize, until_s: f64) -> [f64; 2] {
        let (from, speed, acceleration) = (self.position[axis], self.velocity[axis], self.acceleration[axis]);
        let to = from + (speed + acceleration * (until_s / 2.0)) * until_s;
        let [low, high] = if from < to { [from, to] } else { [to, from] };
        if 0.0 <= speed * (speed + acceleration * until_s) {
            return [low, high];
        }
        // The stationary point lies v² / 2a from the start.
        let stationary = from - speed * speed / (2.0 * acceleration);
        [lesser(low, stationary), greater(high, stationary)]
    }
}

/// When a circle on a path first touches a face from its front, within the face's extent.
///
/// `None` when it moves away, runs parallel, or passes the face beyond its ends. A centre behind the face touches it only after it
/// has come around to the front.
#[inline]
pub fn face(path: &Path, radius: f64, plane: &Plane) -> Option<f64> {
    let (axis, sign) = (plane.facing.axis(), plane.facing.sign());
    let gap = (path.position[axis] - plane.offset) * sign - radius;
    // A ball placed exactly at its radius may appear to overlap by a rounding.
    let gap = if gap < 0.0 && -tolerance::touch(radius, path.position) < gap { 0.0 } else { gap };
    let (rise, acceleration) = (path.velocity[axis] * sign, path.acceleration[axis] * sign);
    let time_s = match falls_through_zero(gap, rise, acceleration) {
        Some(time_s) => time_s,
        None if gap < 0.0 && 0.0 < rise && acceleration < 0.0 => {
            grazes_from_behind(path, radius, gap, rise, acceleration)?
        }
        None => return None,
    };
    let (along, speed) = (path.at(time_s)[1 - axis], path.velocity_at(time_s)[1 - axis]);
    if plane.start <= along && along <= plane.end {
        // Over the very end and moving outwards the circle touches the end point: `corner` decides.
        let leaves = (along == plane.end && 0.0 < speed) || (along == plane.start && speed < 0.0);
        return (!leaves).then_some(time_s);
    }
    // Beyond an end: a circle that grazes the corner may come over the face when the circle is a little below the level of the face.
    let (outside, inward) =
        if along < plane.start { (plane.start - along, speed) } else { (along - plane.end, -speed) };
    let fall = -(path.velocity_at(time_s)[axis] * sign);
    // Usually it would be too deep to count by then.
    if inward <= 0.0 || tolerance::touch(radius, path.position) * inward < fall * outside {
        return None;
    }
    enters(path, radius, plane, time_s)
}

/// When a circle that rises from behind a face is at its highest, if it gets within the touch tolerance there: it has passed over the
/// corner that it grazes.
#[cold]
#[inline(never)]
fn grazes_from_behind(path: &Path, radius: f64, gap: f64, rise: f64, acceleration: f64) -> Option<f64> {
    let highest = gap - rise * rise / (2.0 * acceleration);
    (-tolerance::touch(radius, path.position) < highest).then_some(-rise / acceleration)
}

/// When a circle that has fallen to the level of a face beyond one of its ends comes over the face, still touching.
#[cold]
#[inline(never)]
fn enters(path: &Path, radius: f64, plane: &Plane, level_s: f64) -> Option<f64> {
    let (axis, sign) = (plane.facing.axis(), plane.facing.sign());
    let (along, speed) = (path.at(level_s)[1 - axis], path.velocity_at(level_s)[1 - axis]);
    let acceleration = path.acceleration[1 - axis];
    let later_s = match along < plane.start {
        true => falls_through_zero(plane.start - along, -speed, -acceleration)?,
        false => falls_through_zero(along - plane.end, speed, acceleration)?,
    };
    let time_s = level_s + later_s;
    let (centre, velocity) = (path.at(time_s), path.velocity_at(time_s));
    let gap = (centre[axis] - plane.offset) * sign - radius;
    (-tolerance::touch(radius, centre) < gap && velocity[axis] * sign <= 0.0).then_some(time_s)
}

/// When a circle on a path first touches a point, within `horizon_s`.
///
/// Touching or overlapping at the start and closing gives 0; at the start and separating gives the next touch, if any;
/// a graze gives `None` unless the acceleration presses the circle onto the point.
///
/// The squared distance is a quartic in t. Its stationary points are isolated by its inflection points, the roots of a quadratic;
/// in each interval in which it falls through zero the root is bracketed and found by safeguarded Newton.
pub fn corner(path: &Path, radius: f64, point: Vector2<f64>, horizon_s: f64) -> Option<f64> {
    touches_point(path, radius, point, horizon_s, false)
}

/// [`corner`], for a circle that has just left the point if `has_left`: an overlap no deeper than a contact is ignored at time 0.
pub(crate) fn touches_point(
    path: &Path,
    radius: f64,
    point: Vector2<f64>,
    horizon_s: f64,
    has_left: bool,
) -> Option<f64> {
    let from_point = Path { position: path.position - point, ..*path };
    let (v, a) = (path.velocity, path.acceleration);
    let start = from_point.position.norm_squared();
    let outer = radius * radius;
    // A circle set down at its radius may read as a rounding inside: then the point is touched where it is now.
    let touching = start < outer && radius - tolerance::touch(radius, path.position) < start.sqrt();
    let level = if touching { start } else { outer };
    let excess = |t: f64| from_point.at(t).norm_squared() - level;
    let half_slope = |t: f64| from_point.at(t).dot(&from_point.velocity_at(t));
    let half_curve = |t: f64| from_point.velocity_at(t).norm_squared() + from_point.at(t).dot(&a);
    let is_touch = |t: f64| {
        let approach = half_slope(t) / radius;
        let graze = PASSING * from_point.velocity_at(t).norm();
        // A slow touch counts only if the acceleration points at the point by more than this fraction: a ball that slides on a
        // face, almost over its end, is not pressed onto the end.
        let is_pressed = from_point.at(t).dot(&a) < -PASSING * radius * a.norm();
        approach < -graze || (approach <= graze && is_pressed && half_curve(t) < 0.0)
    };
    if !has_left && excess(0.0) <= 0.0 && is_touch(0.0) {
        return Some(0.0);
    }
    let within = |t: &f64| 0.0 < *t && *t < horizon_s;
    // The inflection points: half the second derivative is 3/2 a² t² + 3 a.v t + v² + a.d.
    let inflections = quadratic_roots(
        1.5 * a.norm_squared(),
        3.0 * a.dot(&v),
        v.norm_squared() + a.dot(&from_point.position),
    );
    let mut ends = [0.0; 5]; // of intervals: the start, at most three stationary points, the end
    let mut n_ends = 1;
    let mut from = 0.0;
    for to in inflections.into_iter().flatten().filter(within).chain([horizon_s]) {
        if (half_slope(from) < 0.0) != (half_slope(to) < 0.0) {
            ends[n_ends] = bracketed_root(from, to, |t| (half_slope(t), half_curve(t)));
            n_ends += 1;
        }
        from = to;
    }
    ends[n_ends] = horizon_s;
    (0..n_ends).find_map(|index| {
        let [from, to] = [ends[index], ends[index + 1]];
        // At a stationary point the path is at its nearest or farthest: what rounding makes of a graze there is neither a
        // touch nor a start inside.
        let graze = 2.0 * radius * tolerance::graze(radius, path.position);
        let deep_enough = if index + 1 < n_ends { excess(to) < -graze } else { excess(to) <= 0.0 };
        if excess(from) < -graze || !deep_enough {
            return None;
        }
        let time_s = match 0.0 < excess(from) {
            true => bracketed_root(from, to, |t| (excess(t), 2.0 * half_slope(t))),
            false => from,
        };
        // A slow approach is a graze only if the path does not lead deeper before it turns.
        let is_deep = excess(to) < -graze;
        let is_known =
            has_left && time_s == 0.0 && -2.0 * radius * tolerance::snap(radius, path.position) <= excess(to);
        ((is_deep || is_touch(time_s)) && !is_known).then_some(time_s)
    })
}
