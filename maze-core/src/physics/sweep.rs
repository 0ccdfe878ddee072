//! Sweep queries: what a circle on a parabola touches first among all walls.
//!
//! From a start that overlaps no wall the answer is bit for bit the same in whichever order the planes are searched: every search
//! passes the same numbers to the same functions of [`crate::time_of_impact`].

use crate::physics::ball::OutOfRange;
use crate::physics::contact;
use crate::physics::numbers::{greater, lesser};
use crate::physics::sorted_planes::{Face, LEAST_REACH, SortedPlanes, WIDENED};
use crate::physics::time_of_impact::{self, Path};
use crate::physics::tolerance;
use crate::physics::wall::{Facing, Feature, Plane};
use nalgebra::Vector2;
use std::ops::Range;

/// Squared speeds below this (units²/s²) are so near to the least float that products with them can't be compared.
const LEAST_SQUARED_SPEED: f64 = 1.0e-200;

/// A circle that moves along a path for a time. All numbers are finite; the radius is greater than 0 and the time 0 or more.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SweepQuery {
    /// The path of the circle's centre.
    pub(crate) path: Path,
    /// The circle's radius (units).
    pub(crate) radius: f64,
    /// From the start of the path (s).
    pub(crate) until_s: f64,
    /// The point that the circle has just left, if any.
    pub(crate) left: Option<Vector2<f64>>,
}

impl SweepQuery {
    /// A circle of a radius (units) on a path, until a time (s).
    ///
    /// # Errors
    /// A number that is not finite, or so large that the square of how far or fast it leads is not; a radius that is not greater than 0; a time less than 0.
    pub fn new(path: Path, radius: f64, until_s: f64) -> Result<Self, OutOfRange> {
        if !(0.0 < radius && (radius * radius).is_finite()) {
            return Err(OutOfRange {
                what: "the radius of the circle",
                expected: "a finite number greater than 0",
            });
        }
        if !(0.0 <= until_s && until_s.is_finite()) {
            return Err(OutOfRange { what: "the time of the sweep", expected: "a finite number, 0 or more" });
        }
        // Upper bounds of the three vectors throughout the sweep; searches square such values.
        let bound = |vector: Vector2<f64>| vector.x.abs() + vector.y.abs();
        let acceleration = bound(path.acceleration);
        let speed = bound(path.velocity) + acceleration * until_s;
        let extent = bound(path.position) + speed * until_s;
        if !(acceleration * acceleration + speed * speed + extent * extent).is_finite() {
            return Err(OutOfRange::not_finite("the path of the circle"));
        }
        Ok(Self { path, radius, until_s, left: None })
    }

    /// The same query for a circle that has just left a point: to touch it at the very start does not count.
    #[must_use]
    pub fn after_leaving(self, point: Vector2<f64>) -> Self {
        Self { left: Some(point), ..self }
    }

    /// The path of the circle's centre.
    pub fn path(&self) -> &Path {
        &self.path
    }
}

/// What is touched first, and when.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact {
    /// From the start of the path (s).
    pub time_s: f64,
    /// What is touched.
    pub feature: Feature,
}

impl Impact {
    /// The point of the wall that is touched by a circle whose path leads there.
    pub fn point(&self, path: &Path) -> Vector2<f64> {
        self.feature.contact_point(path.at(self.time_s))
    }
}

/// The answer to a sweep query.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sweep {
    /// Nothing is touched.
    Free,
    /// The circle overlaps a wall at the start, by more than a touch.
    #[non_exhaustive]
    Overlaps {
        /// The face that is overlapped most deeply.
        wall: Plane,
        /// Radius less the distance from the centre to the nearest point of the face (units), on either side of it.
        depth: f64,
    },
    /// The first impact.
    #[non_exhaustive]
    Hit {
        /// From the start of the path (s).
        time_s: f64,
        /// The point of the wall that is touched.
        point: Vector2<f64>,
        /// Unit vector from that point towards the circle's centre.
        normal: Vector2<f64>,
        /// The face that is touched, or one that ends in the point.
        wall: Plane,
        /// What of the wall is touched.
        feature: Feature,
    },
}

impl SortedPlanes {
    /// Answers a query: whether the circle overlaps a wall at the start, or what it touches first. A wall is met from its front:
    /// a centre behind a face, nearer than the radius, overlaps it.
    ///
    /// ```
    /// use maze_core::{Facing, Path, Plane, SortedPlanes, Sweep, SweepQuery};
    /// use nalgebra::Vector2;
    ///
    /// let planes = SortedPlanes::new([Plane { facing: Facing::MinusX, offset: 5.0, start: -1.0, end: 1.0 }])?;
    /// let path = Path { position: Vector2::zeros(), velocity: Vector2::new(2.0, 0.0), acceleration: Vector2::zeros() };
    /// let Sweep::Hit { time_s, point, .. } = planes.sweep(&SweepQuery::new(path, 1.0, 9.0)?) else { unreachable!() };
    /// assert_eq!((time_s, point), (2.0, Vector2::new(5.0, 0.0)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// O(log n) for each row that the circle passes until the impact.
    pub fn sweep(&self, query: &SweepQuery) -> Sweep {
        if let Some(contact) = contact::deepest(self, query.path.position, query.radius) {
            return Sweep::Overlaps { wall: contact.plane, depth: contact.penetration };
        }
        let Some(impact) = first_impact(self, query) else { return Sweep::Free };
        let Impact { time_s, feature } = impact;
        let centre = query.path.at(time_s);
        let wall = match feature {
            Feature::Face(plane) => Some(plane),
            Feature::Point(point) => self.plane_that_ends_in(point),
        };
        match (wall, feature.normal_at(centre)) {
            (Some(wall), Some(normal)) => {
                Sweep::Hit { time_s, point: feature.contact_point(centre), normal, wall, feature }
            }
            // A point is an end of a plane, and a circle that touches it has its centre elsewhere.
            _ => Sweep::Free,
        }
    }

    /// The first plane, in the order of facings, that has an end there.
    fn plane_that_ends_in(&self, point: Vector2<f64>) -> Option<Plane> {
        let ends_in = |plane: &Plane| {
            [plane.start, plane.end].into_iter().any(|along| plane.facing.point(plane.offset, along) == point)
        };
        self.planes_within(point, LEAST_REACH).find(ends_in)
    }
}

/// The earliest impact found so far; of equal times see `comes_first`.
struct Search<'a> {
    query: &'a SweepQuery,
    /// How far from the centre what is touched can be (units).
    reach: f64,
    /// Until the earliest impact so far.
    until_s: f64,
    /// Least and greatest coordinate of the centre along both axes until then.
    ranges: [[f64; 2]; 2],
    impact: Option<Impact>,
}

impl<'a> Search<'a> {
    fn new(query: &'a SweepQuery) -> Self {
        let SweepQuery { path, radius, until_s, .. } = query;
        let ranges = [path.range_until(0, *until_s), path.range_until(1, *until_s)];
        Self { query, reach: radius * WIDENED, until_s: *until_s, ranges, impact: None }
    }

    /// Bounds along an axis of the circle swept until the earliest impact so far.
    fn swept_bounds(&self, axis: usize) -> [f64; 2] {
        let [low, high] = self.ranges[axis];
        [low - self.reach, high + self.reach]
    }

    /// The groups across one axis that oppose the motion.
    fn search_axis(&mut self, planes: &SortedPlanes, axis: usize, watch: &mut impl FnMut(Visit)) {
        let start = self.query.path.velocity[axis];
        // The whole time of the query counts, so that an impact at time 0 on the other axis does not hide one at time 0 on this axis.
        let end = start + self.query.path.acceleration[axis] * self.query.until_s;
        // A motion along a wall without thickness opposes neither of its faces, and may hit its end: then all groups are searched.
        let all = planes.has_free_ends();
        let (falls, rises) = (all || start < 0.0 || end < 0.0, all || 0.0 < start || 0.0 < end);
        if !falls && !rises {
            return;
        }
        let [plus, minus] = Facing::across(axis);
        let offsets = self.swept_bounds(axis);
        let ranks = planes.ranks(axis, offsets);
        // Written out for both: as one function, a short query takes a tenth more instructions.
        if falls {
            watch(Visit::Group { facing: plus, offsets });
            let rows = planes.rows_at(plus, &ranks);
            if !rows.is_empty() {
                self.search_rows(planes, plus, rows, watch);
            }
        }
        if rises {
            watch(Visit::Group { facing: minus, offsets });
            let rows = planes.rows_at(minus, &ranks);
            if !rows.is_empty() {
                self.search_rows(planes, minus, rows, watch);
            }
        }
    }

    /// Row by row in the direction of motion, and in each row the planes that the circle passes while it is in reach.
    fn search_rows(
        &mut self,
        planes: &SortedPlanes,
        facing: Facing,
        rows: Range<usize>,
        watch: &mut impl FnMut(Visit),
    ) {
        let axis = facing.axis();
        for row in planes.rows(facing, rows) {
            // An impact found meanwhile shortens the path.
            let [low, high] = self.swept_bounds(axis);
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
                self.offer(&candidate);
            }
        }
    }

    fn offer(&mut self, candidate: &Face) {
        let Face { plane, is_corner: [starts, ends] } = candidate;
        if let Some(time_s) = time_of_impact::face(&self.query.path, self.query.radius, plane) {
            self.keep(Impact { time_s, feature: Feature::Face(*plane) });
        }
        if *starts {
            self.offer_corner(plane.facing.point(plane.offset, plane.start));
        }
        if *ends {
            self.offer_corner(plane.facing.point(plane.offset, plane.end));
        }
    }

    fn offer_corner(&mut self, point: Vector2<f64>) {
        let is_known = |known: Impact| known.feature == Feature::Point(point);
        if self.is_out_of_reach(point)
            || self.is_separating_or_not_yet_reached(point)
            || self.impact.is_some_and(is_known)
        {
            return;
        }
        // A face end within the snap tolerance of the point that was left counts as that point.
        let has_left = self
            .query
            .left
            .is_some_and(|left| (left - point).amax() <= tolerance::snap(self.query.radius, point));
        // The root is sought within the whole time, not within what is left of it: its bits must not depend on what was
        // found before.
        let SweepQuery { path, radius, until_s, .. } = self.query;
        if let Some(time_s) = time_of_impact::touches_point(path, *radius, point, *until_s, has_left) {
            self.keep(Impact { time_s, feature: Feature::Point(point) });
        }
    }

    /// Whether a point is culled by the swept bounds, or by its distance from the line of the initial velocity: the usual case, which
    /// needs no root.
    fn is_out_of_reach(&self, point: Vector2<f64>) -> bool {
        let is_off = |axis: usize| {
            let [low, high] = self.swept_bounds(axis);
            point[axis] < low || high < point[axis]
        };
        if is_off(0) || is_off(1) {
            return true;
        }
        // The acceleration deviates from the line of the initial velocity by no more than a t² / 2.
        let Path { position, velocity, acceleration } = self.query.path;
        let to_point = point - position;
        let across = velocity.x * to_point.y - velocity.y * to_point.x;
        let deviation = (acceleration.x.abs() + acceleration.y.abs()) * (self.until_s * self.until_s / 2.0);
        let (reach, speed) = (self.reach + deviation, velocity.norm_squared());
        LEAST_SQUARED_SPEED < speed && reach * reach * speed < across * across
    }

    /// Whether a point is culled because the path separates from it from the start, or is still out of its reach and closing at the
    /// earliest impact so far.
    ///
    /// Both hold throughout where the squared distance is convex, that is where |v|² + d.a > 0. The speed is at least the first speed
    /// less a t; d, the distance to a point within the swept bounds, is at most twice the distance covered and the reach.
    fn is_separating_or_not_yet_reached(&self, point: Vector2<f64>) -> bool {
        let (until_s, path) = (self.until_s, &self.query.path);
        let (speed, acceleration) = (path.velocity.norm(), path.acceleration.norm());
        let slowest = speed - acceleration * until_s;
        let farthest = 2.0 * ((speed + acceleration * until_s) * until_s + self.reach);
        let is_convex = 0.0 < slowest && acceleration * farthest < slowest * slowest;
        let (first, last) = (path.position - point, path.at(until_s) - point);
        let is_separating = 0.0 <= first.dot(&path.velocity);
        let is_not_yet_reached =
            last.dot(&path.velocity_at(until_s)) < 0.0 && self.reach * self.reach < last.norm_squared();
        is_convex && (is_separating || is_not_yet_reached)
    }

    fn keep(&mut self, impact: Impact) {
        let is_better = match self.impact {
            None => impact.time_s <= self.query.until_s,
            Some(known) if impact.time_s == known.time_s => self.comes_first(&impact, &known),
            Some(known) => impact.time_s < known.time_s,
        };
        if is_better {
            self.until_s = impact.time_s;
            self.ranges = [0, 1].map(|axis| self.query.path.range_until(axis, self.until_s));
            self.impact = Some(impact);
        }
    }

    /// Which of two impacts at the same time counts: a face before a point, then the nearer one, then the one that is approached
    /// faster, then the more prominent one ([`Feature::prominence`]). All of that is the same in a scene that is mirrored or turned;
    /// only then the coordinates decide.
    #[cold]
    #[inline(never)]
    fn comes_first(&self, one: &Impact, other: &Impact) -> bool {
        let (centre, velocity) = (self.query.path.at(one.time_s), self.query.path.velocity_at(one.time_s));
        let order = |feature: &Feature| {
            let away = centre - feature.contact_point(centre);
            let is_point = matches!(feature, Feature::Point(_));
            (is_point, away.norm_squared(), away.dot(&velocity), feature.prominence(centre), rank(feature))
        };
        order(&one.feature) < order(&other.feature)
    }

    /// The range of the other coordinate in which the circle is near a row's offset, widened by its reach.
    ///
    /// The whole range on a short path, and where one of the coordinates has a stationary point.
    fn window(&self, axis: usize, offset: f64) -> [f64; 2] {
        let Self { query: SweepQuery { path, .. }, until_s, reach, .. } = *self;
        let [low, high] = self.swept_bounds(1 - axis);
        if high - low < 3.0 * reach {
            return [low, high];
        }
        let (start, end) = (path.velocity, path.velocity_at(until_s));
        if start[axis] * end[axis] <= 0.0 || start[1 - axis] * end[1 - axis] < 0.0 {
            return [low, high];
        }
        // The earliest arrival is that at the higher of the two speeds, the latest departure that at the lower one.
        let (start, end) = (start[axis].abs(), end[axis].abs());
        let (slow, fast) = if start < end { (start, end) } else { (end, start) };
        let gap = offset - path.position[axis];
        let gap = if path.velocity[axis] < 0.0 { -gap } else { gap };
        let (from_s, to_s) = ((gap - reach) / fast, (gap + reach) / slow);
        let along = |time_s: f64| {
            let time_s = greater(time_s, 0.0);
            path.at(lesser(until_s, time_s))[1 - axis]
        };
        let (from, to) = (along(from_s), along(to_s));
        if from < to { [from - reach, to + reach] } else { [to - reach, from + reach] }
    }
}

/// A total order of features, so that the order of the search does not affect the result.
fn rank(feature: &Feature) -> (u8, f64, f64) {
    match feature {
        Feature::Face(plane) => (plane.facing as u8, plane.offset, plane.start),
        Feature::Point(point) => (4, point.x, point.y),
    }
}

/// What the circle of a query touches first: the sweep that the exact engine asks for.
///
/// A face that the circle overlaps at the start is ignored, so that a ball may come from behind it; [`SortedPlanes::sweep`]
/// reports an overlap. The search goes through the groups that oppose the motion, the faster coordinate first.
///
/// O(log n) for each row that the circle passes until the impact.
pub fn first_impact(planes: &SortedPlanes, query: &SweepQuery) -> Option<Impact> {
    search(planes, query, &mut |_| {})
}

/// What a search visits.
pub(crate) enum Visit {
    /// A group, and the offsets within which the circle can touch a plane of it.
    Group { facing: Facing, offsets: [f64; 2] },
    /// A row, and the range along it within which the circle can touch it.
    Row { offset: f64, window: [f64; 2] },
    /// A plane that is tested for an impact.
    Plane(Plane),
}

/// [`first_impact`], which shows what it visits; without a visitor nothing of that is compiled.
pub(crate) fn search(
    planes: &SortedPlanes,
    query: &SweepQuery,
    watch: &mut impl FnMut(Visit),
) -> Option<Impact> {
    let mut search = Search::new(query);
    // An impact along the faster coordinate shortens the path for the other one.
    let velocity = query.path.velocity;
    let axes = if velocity.x.abs() < velocity.y.abs() { [1, 0] } else { [0, 1] };
    for axis in axes {
        search.search_axis(planes, axis, watch);
    }
    search.impact
}

/// The linear scan that [`first_impact`] is tested against: every plane of every group, in any order, O(n).
///
/// Search and scan cull corners alike. That culling loses no impact is tested against [`time_of_impact::face`] and [`time_of_impact::corner`].
pub fn first_impact_scan(planes: &SortedPlanes, query: &SweepQuery) -> Option<Impact> {
    let mut search = Search::new(query);
    for candidate in Facing::ALL.into_iter().flat_map(|facing| planes.faces(facing)) {
        search.offer(&candidate);
    }
    search.impact
}
