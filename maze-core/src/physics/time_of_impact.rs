//! Time of impact: when a circle on a parabola first touches a face or a corner.
//!
//! Times are counted from the parabola's start and are bit for bit the same whichever way the planes are searched: every
//! search hands the same numbers to the same functions.

use crate::physics::roots::{bracketed_root, falls_through_zero, quadratic_roots};
use crate::physics::sorted_planes::{Face, SortedPlanes, WIDENED};
use crate::physics::tolerance::{self, PASSING};
pub use crate::physics::wall::Feature;
use crate::physics::wall::{Facing, Plane};
use nalgebra::Vector2;
use std::ops::Range;

/// Squared speeds below this (units²/s²) are too near to what floats hold for products with them to be compared.
const RESTS: f64 = 1.0e-200;

/// Motion under constant acceleration: position + velocity t + acceleration t² / 2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Path {
    /// Where it starts (units).
    pub position: Vector2<f64>,
    /// At the start (units/s).
    pub velocity: Vector2<f64>,
    /// Throughout (units/s²).
    pub acceleration: Vector2<f64>,
}

/// The first touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact {
    /// From the start of the path (s).
    pub time_s: f64,
    /// What is touched.
    pub touched: Feature,
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
    fn range_until(&self, axis: usize, until_s: f64) -> [f64; 2] {
        let (from, speed, pull) = (self.position[axis], self.velocity[axis], self.acceleration[axis]);
        let to = from + (speed + pull * (until_s / 2.0)) * until_s;
        let [low, high] = if from < to { [from, to] } else { [to, from] };
        if 0.0 <= speed * (speed + pull * until_s) {
            return [low, high];
        }
        // The turn lies v² / 2a from the start.
        let turn = from - speed * speed / (2.0 * pull);
        [if turn < low { turn } else { low }, if high < turn { turn } else { high }]
    }
}

/// When a circle on a path first touches a face from its front, within the face's extent.
///
/// `None` when it moves away, runs parallel, or passes beside. A centre behind the face counts as beside it: the touch is
/// the fall after it has come round to the front.
#[inline]
pub fn face(path: &Path, radius: f64, plane: &Plane) -> Option<f64> {
    let (axis, sign) = (plane.facing.axis(), plane.facing.sign());
    let gap = (path.position[axis] - plane.offset) * sign - radius;
    // A ball set down exactly at its radius may read as a rounding inside.
    let gap = if gap < 0.0 && -tolerance::touch(radius, path.position) < gap { 0.0 } else { gap };
    let (rise, pull) = (path.velocity[axis] * sign, path.acceleration[axis] * sign);
    let time_s = match falls_through_zero(gap, rise, pull) {
        Some(time_s) => time_s,
        None if gap < 0.0 && 0.0 < rise && pull < 0.0 => skims(path, radius, gap, rise, pull)?,
        None => return None,
    };
    let (along, speed) = (path.at(time_s)[1 - axis], path.velocity_at(time_s)[1 - axis]);
    if plane.start <= along && along <= plane.end {
        // Over the very end and on the way out the circle is the corner's, which knows whether it is pressed.
        let leaves = (along == plane.end && 0.0 < speed) || (along == plane.start && speed < 0.0);
        return (!leaves).then_some(time_s);
    }
    // Beside it: a circle that grazes the corner comes over the face when it is a little below its level.
    let (outside, inward) =
        if along < plane.start { (plane.start - along, speed) } else { (along - plane.end, -speed) };
    let fall = -(path.velocity_at(time_s)[axis] * sign);
    // Deeper than a touch by then, as usual.
    if inward <= 0.0 || tolerance::touch(radius, path.position) * inward < fall * outside {
        return None;
    }
    enters(path, radius, plane, time_s)
}

/// When a circle that rises from behind a face is at its highest, if it gets there as near as a touch: it has come over the
/// corner that it grazes.
#[cold]
#[inline(never)]
fn skims(path: &Path, radius: f64, gap: f64, rise: f64, pull: f64) -> Option<f64> {
    let highest = gap - rise * rise / (2.0 * pull);
    (-tolerance::touch(radius, path.position) < highest).then_some(-rise / pull)
}

/// When a circle that has fallen to the level of a face beside it comes over the face, still touching.
#[cold]
#[inline(never)]
fn enters(path: &Path, radius: f64, plane: &Plane, beside_s: f64) -> Option<f64> {
    let (axis, sign) = (plane.facing.axis(), plane.facing.sign());
    let (along, speed) = (path.at(beside_s)[1 - axis], path.velocity_at(beside_s)[1 - axis]);
    let pull = path.acceleration[1 - axis];
    let later_s = match along < plane.start {
        true => falls_through_zero(plane.start - along, -speed, -pull)?,
        false => falls_through_zero(along - plane.end, speed, pull)?,
    };
    let time_s = beside_s + later_s;
    let (centre, velocity) = (path.at(time_s), path.velocity_at(time_s));
    let gap = (centre[axis] - plane.offset) * sign - radius;
    (-tolerance::touch(radius, centre) < gap && velocity[axis] * sign <= 0.0).then_some(time_s)
}

/// When a circle on a path first touches a point, within `horizon_s`.
///
/// Touching or overlapping at the start and closing gives 0; at the start and separating gives the next touch, if any;
/// a graze gives `None` unless the acceleration presses the circle onto the point.
///
/// The squared distance is a quartic in t. Its turning points are isolated by those of its derivative, whose own are the
/// roots of a quadratic; in each stretch that falls through zero the root is bracketed and found by safeguarded Newton.
pub fn corner(path: &Path, radius: f64, point: Vector2<f64>, horizon_s: f64) -> Option<f64> {
    touches_point(path, radius, point, horizon_s, false)
}

/// [`corner`], for a circle that has just left the point if `has_left`: what is no deeper than a contact is at the start no touch.
fn touches_point(
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
    // Where the slope may turn: half its derivative is 3/2 a² t² + 3 a.v t + v² + a.d.
    let bends = quadratic_roots(
        1.5 * a.norm_squared(),
        3.0 * a.dot(&v),
        v.norm_squared() + a.dot(&from_point.position),
    );
    let mut turns = [0.0; 5]; // the start, at most three turning points, the end
    let mut n_turns = 1;
    let mut from = 0.0;
    for to in bends.into_iter().flatten().filter(within).chain([horizon_s]) {
        if (half_slope(from) < 0.0) != (half_slope(to) < 0.0) {
            turns[n_turns] = bracketed_root(from, to, |t| (half_slope(t), half_curve(t)));
            n_turns += 1;
        }
        from = to;
    }
    turns[n_turns] = horizon_s;
    (0..n_turns).find_map(|index| {
        let [from, to] = [turns[index], turns[index + 1]];
        // At a turning point the path is at its nearest or farthest: what rounding makes of a graze there is neither a
        // touch nor a start inside.
        let graze = 2.0 * radius * tolerance::graze(radius, path.position);
        let deep_enough = if index + 1 < n_turns { excess(to) < -graze } else { excess(to) <= 0.0 };
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

/// The best impact so far: the earliest; of equal times see `comes_first`.
struct First<'a> {
    path: &'a Path,
    radius: f64,
    /// How far from the centre what is touched can be (units).
    reach: f64,
    horizon_s: f64,
    until_s: f64,
    /// Least and greatest coordinate of the centre along both axes until then.
    ranges: [[f64; 2]; 2],
    impact: Option<Impact>,
}

impl<'a> First<'a> {
    fn new(path: &'a Path, radius: f64, until_s: f64) -> Self {
        let ranges = [path.range_until(0, until_s), path.range_until(1, until_s)];
        Self { path, radius, reach: radius * WIDENED, horizon_s: until_s, until_s, ranges, impact: None }
    }

    /// Where along an axis the circle is until the best impact so far.
    fn reached(&self, axis: usize) -> [f64; 2] {
        let [low, high] = self.ranges[axis];
        [low - self.reach, high + self.reach]
    }

    /// The groups across one axis that oppose the motion.
    fn search_axis(
        &mut self,
        planes: &SortedPlanes,
        axis: usize,
        left: Option<Vector2<f64>>,
        watch: &mut impl FnMut(Visit),
    ) {
        let start = self.path.velocity[axis];
        // Within the whole time: a touch at its very start, on the other axis, must not hide one of equal time here.
        let end = start + self.path.acceleration[axis] * self.horizon_s;
        // The end of a wall without thickness belongs to no face that opposes a motion along the wall.
        let all = planes.has_free_ends();
        let (falls, rises) = (all || start < 0.0 || end < 0.0, all || 0.0 < start || 0.0 < end);
        if !falls && !rises {
            return;
        }
        let [plus, minus] = Facing::across(axis);
        let offsets = self.reached(axis);
        let ranks = planes.ranks(axis, offsets);
        // Written out for both: as one function, a short query takes a tenth more instructions.
        if falls {
            watch(Visit::Group { facing: plus, offsets });
            let rows = planes.rows_at(plus, &ranks);
            if !rows.is_empty() {
                self.search_rows(planes, plus, rows, left, watch);
            }
        }
        if rises {
            watch(Visit::Group { facing: minus, offsets });
            let rows = planes.rows_at(minus, &ranks);
            if !rows.is_empty() {
                self.search_rows(planes, minus, rows, left, watch);
            }
        }
    }

    /// Row by row in the direction of motion, and in each row the planes that the circle passes while it is in reach.
    fn search_rows(
        &mut self,
        planes: &SortedPlanes,
        facing: Facing,
        rows: Range<usize>,
        left: Option<Vector2<f64>>,
        watch: &mut impl FnMut(Visit),
    ) {
        let axis = facing.axis();
        for row in planes.rows(facing, rows) {
            // A touch found meanwhile shortens the time, and with it the way.
            let [low, high] = self.reached(axis);
            let (is_above, is_below) = (high < row.offset(), row.offset() < low);
            if is_above || is_below {
                if is_above == (facing.sign() < 0.0) {
                    return; // and so are all that follow
                }
                continue;
            }
            let window = self.window(axis, row.offset());
            watch(Visit::Row { offset: row.offset(), window });
            for candidate in row.within(window) {
                watch(Visit::Plane(candidate.plane));
                self.offer(&candidate, left);
            }
        }
    }

    fn offer(&mut self, candidate: &Face, left: Option<Vector2<f64>>) {
        let Face { plane, is_corner: [starts, ends] } = candidate;
        if let Some(time_s) = face(self.path, self.radius, plane) {
            self.keep(Impact { time_s, touched: Feature::Face(*plane) });
        }
        if *starts {
            self.offer_corner(plane.facing.point(plane.offset, plane.start), left);
        }
        if *ends {
            self.offer_corner(plane.facing.point(plane.offset, plane.end), left);
        }
    }

    fn offer_corner(&mut self, point: Vector2<f64>, left: Option<Vector2<f64>>) {
        let is_known = |known: Impact| known.touched == Feature::Point(point);
        if self.is_beside(point) || self.is_out_of_time(point) || self.impact.is_some_and(is_known) {
            return;
        }
        // Ends of neighbouring faces at the same place count as the point that was left.
        let has_left = left.is_some_and(|left| (left - point).amax() <= tolerance::snap(self.radius, point));
        // The root is sought within the whole time, not within what is left of it: its bits must not depend on what was
        // found before.
        if let Some(time_s) = touches_point(self.path, self.radius, point, self.horizon_s, has_left) {
            self.keep(Impact { time_s, touched: Feature::Point(point) });
        }
    }

    /// Whether a point stays out of reach until the best impact so far: the usual case, told without a root.
    fn is_beside(&self, point: Vector2<f64>) -> bool {
        let is_off = |axis: usize| {
            let [low, high] = self.reached(axis);
            point[axis] < low || high < point[axis]
        };
        if is_off(0) || is_off(1) {
            return true;
        }
        // Beside the line of the initial velocity, from which the acceleration leads away by no more than a t² / 2.
        let Path { position, velocity, acceleration } = self.path;
        let to_point = point - position;
        let across = velocity.x * to_point.y - velocity.y * to_point.x;
        let strays = (acceleration.x.abs() + acceleration.y.abs()) * (self.until_s * self.until_s / 2.0);
        let (reach, speed) = (self.reach + strays, velocity.norm_squared());
        RESTS < speed && reach * reach * speed < across * across
    }

    /// Whether the path leads away from a point from the start, or is still out of its reach and closing at the best
    /// impact so far.
    ///
    /// Either holds all the time where the squared distance is convex: where |v|² + d.a is positive, with v as fast as at
    /// first but for what the acceleration takes, and d, to a point that is not beside, at most twice the way and the reach.
    fn is_out_of_time(&self, point: Vector2<f64>) -> bool {
        let (until_s, path) = (self.until_s, self.path);
        let (speed, pull) = (path.velocity.norm(), path.acceleration.norm());
        let slowest = speed - pull * until_s;
        let farthest = 2.0 * ((speed + pull * until_s) * until_s + self.reach);
        let is_convex = 0.0 < slowest && pull * farthest < slowest * slowest;
        let (first, last) = (path.position - point, path.at(until_s) - point);
        let is_left = 0.0 <= first.dot(&path.velocity);
        let is_ahead =
            last.dot(&path.velocity_at(until_s)) < 0.0 && self.reach * self.reach < last.norm_squared();
        is_convex && (is_left || is_ahead)
    }

    fn keep(&mut self, impact: Impact) {
        let is_better = match self.impact {
            None => impact.time_s <= self.horizon_s,
            Some(known) if impact.time_s == known.time_s => self.comes_first(&impact, &known),
            Some(known) => impact.time_s < known.time_s,
        };
        if is_better {
            self.until_s = impact.time_s;
            self.ranges = [self.path.range_until(0, self.until_s), self.path.range_until(1, self.until_s)];
            self.impact = Some(impact);
        }
    }

    /// Which of two impacts at the same time counts: a face before a point, then the nearer one, then the one that is approached
    /// faster, then the one that stands out farther. All of that is the same in a scene that is mirrored or turned; only then the coordinates decide.
    #[cold]
    #[inline(never)]
    fn comes_first(&self, one: &Impact, other: &Impact) -> bool {
        let (centre, velocity) = (self.path.at(one.time_s), self.path.velocity_at(one.time_s));
        let order = |feature: &Feature| {
            let away = centre - feature.contact_point(centre);
            let is_point = matches!(feature, Feature::Point(_));
            (is_point, away.norm_squared(), away.dot(&velocity), feature.prominence(centre), rank(feature))
        };
        order(&one.touched) < order(&other.touched)
    }

    /// Part of the other coordinate's range in which the circle is near a row's offset, widened by its reach.
    ///
    /// On a short way the whole range will do, and where one of the coordinates turns.
    fn window(&self, axis: usize, offset: f64) -> [f64; 2] {
        let Self { path, until_s, reach, .. } = *self;
        let [low, high] = self.reached(1 - axis);
        if high - low < 3.0 * reach {
            return [low, high];
        }
        let (start, end) = (path.velocity, path.velocity_at(until_s));
        if start[axis] * end[axis] <= 0.0 || start[1 - axis] * end[1 - axis] < 0.0 {
            return [low, high];
        }
        // Not before the faster of the two speeds leads there, and not after the slower one leads away.
        let (start, end) = (start[axis].abs(), end[axis].abs());
        let (slow, fast) = if start < end { (start, end) } else { (end, start) };
        let gap = offset - path.position[axis];
        let gap = if path.velocity[axis] < 0.0 { -gap } else { gap };
        let (from_s, to_s) = ((gap - reach) / fast, (gap + reach) / slow);
        let along = |time_s: f64| {
            let time_s = if time_s < 0.0 { 0.0 } else { time_s };
            path.at(if time_s < until_s { time_s } else { until_s })[1 - axis]
        };
        let (from, to) = (along(from_s), along(to_s));
        if from < to { [from - reach, to + reach] } else { [to - reach, from + reach] }
    }
}

/// A total order of features, so that the order of the search does not show.
fn rank(feature: &Feature) -> (u8, f64, f64) {
    match feature {
        Feature::Face(plane) => (plane.facing as u8, plane.offset, plane.start),
        Feature::Point(point) => (4, point.x, point.y),
    }
}

/// What a circle on a path touches first within `until_s`.
///
/// `left` is the point that the circle has just lifted off from, if any: a touch of it at the very start is none. The search goes
/// through the groups that oppose the motion, the faster coordinate first. Finite numbers, and an `until_s` of 0 or more, are
/// expected and not checked.
pub fn first(
    planes: &SortedPlanes,
    path: &Path,
    radius: f64,
    until_s: f64,
    left: Option<Vector2<f64>>,
) -> Option<Impact> {
    search(planes, path, radius, until_s, left, &mut |_| {})
}

/// What a search looks at.
pub(crate) enum Visit {
    /// A group, and the offsets within which the circle can touch a plane of it.
    Group { facing: Facing, offsets: [f64; 2] },
    /// A row, and the range along it within which the circle can touch it.
    Row { offset: f64, window: [f64; 2] },
    /// A plane that is handed to the impact test.
    Plane(Plane),
}

/// [`first`], which shows what it looks at; nothing of that remains where nobody watches.
pub(crate) fn search(
    planes: &SortedPlanes,
    path: &Path,
    radius: f64,
    until_s: f64,
    left: Option<Vector2<f64>>,
    watch: &mut impl FnMut(Visit),
) -> Option<Impact> {
    let mut first = First::new(path, radius, until_s);
    // What the faster coordinate meets shortens the way for the other one.
    let axes = if path.velocity.x.abs() < path.velocity.y.abs() { [1, 0] } else { [0, 1] };
    for axis in axes {
        first.search_axis(planes, axis, left, watch);
    }
    first.impact
}

/// What [`first`] is tested against: every plane of every group, in any order. Both tell corners off alike; that no touch is
/// lost by it is tested against [`face`] and [`corner`] themselves.
pub fn first_scan(
    planes: &SortedPlanes,
    path: &Path,
    radius: f64,
    until_s: f64,
    left: Option<Vector2<f64>>,
) -> Option<Impact> {
    let mut first = First::new(path, radius, until_s);
    for candidate in Facing::ALL.into_iter().flat_map(|facing| planes.faces(facing)) {
        first.offer(&candidate, left);
    }
    first.impact
}
