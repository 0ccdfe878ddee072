//! The report's data structure: wall faces in four groups, sorted, searched by bisection in the direction of motion.

mod coordinates;
mod corners;
mod group;
mod nearby;

use crate::physics::wall::{Facing, Plane, PlaneError};
use coordinates::{Collector, Coordinates};
use group::{Group, Interval, Row};
use nalgebra::Vector2;
pub use nearby::Clearance;
use std::ops::Range;

/// The least reach (units) of a search: its square is not 0.
pub(crate) const LEAST_REACH: f64 = 1.5e-154;

/// Searches reach this much farther than asked, so that no rounding (1e-12 on the largest boards) hides a plane.
pub(crate) const WIDENED: f64 = 1.0 + 1.0e-6;

/// Most planes of one facing: an axis has at most six coordinates for each, whose ranks are counted in 31 bits.
const MAX_PLANES: usize = 1 << 28;

/// Wall faces in four groups sorted by (offset, start, end). Built once in O(n log n), then searched by bisection.
///
/// The report bisects once over the sorted tuples, which has two faults: several offsets may lie within the ball's reach,
/// so the first candidate need not be the nearest; and a test of start and end against the ball's centre forgets its
/// extent. Here a group is a list of rows of equal offset, each with disjoint sorted intervals: bisect for the first row
/// in reach, walk the rows in the direction of motion, bisect in each for the interval. O(log n) a row within reach, and
/// O(1) where offsets and interval ends are evenly spread: bucket indexes give each bisection its start.
///
/// A plane takes 8 bytes and its share of its row's bucket index about 2: start and end are kept as ranks among the coordinates
/// of their axis, which a maze uses again and again. Where every plane has coordinates and a row of its own it is some 100.
///
/// ```
/// use maze_core::{Facing, Plane, SortedPlanes};
/// use maze_core::nalgebra::Vector2;
///
/// let wall = Plane { facing: Facing::MinusX, offset: 5.0, start: -1.0, end: 1.0 };
/// let planes = SortedPlanes::new([wall])?;
/// let nearest = planes.clearance(Vector2::new(2.0, 0.5)).ok_or("no plane")?;
/// assert_eq!((nearest.plane, nearest.distance), (wall, 3.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct SortedPlanes {
    axes: [Coordinates; 2],
    groups: [Group; 4], // in the order of Facing::ALL
    /// Whether a face somewhere ends without meeting another, as one side of a wall without thickness does.
    has_free_ends: bool,
}

/// A plane, and which of its ends are corners that a ball can touch: where faces meet outward, and free ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Face {
    pub(crate) plane: Plane,
    pub(crate) is_corner: [bool; 2],
}

impl SortedPlanes {
    /// Sorts the planes and merges those of the same facing and offset that touch or overlap.
    ///
    /// # Errors
    /// A plane with a coordinate that is not finite, or with no extent; more than 2²⁸ planes of one facing.
    pub fn new(planes: impl IntoIterator<Item = Plane>) -> Result<Self, PlaneError> {
        let mut by_facing: [Vec<[f64; 3]>; 4] = Default::default();
        let mut collectors = <[Collector; 2]>::default();
        for (index, plane) in planes.into_iter().enumerate() {
            let Plane { facing, offset, start, end } = plane.checked(index)?;
            // Adding 0 takes the sign of -0: coordinates are compared as numbers.
            let numbers @ [offset, start, end] = [offset, start, end].map(|value| value + 0.0);
            by_facing[facing as usize].push(numbers);
            collectors[facing.axis()].push(offset);
            collectors[1 - facing.axis()].push(start);
            collectors[1 - facing.axis()].push(end);
        }
        if by_facing.iter().any(|planes| MAX_PLANES < planes.len()) {
            return Err(PlaneError::TooMany);
        }
        let axes = collectors.map(Collector::coordinates);
        let mut groups = <[Group; 4]>::default();
        for (facing, planes) in Facing::ALL.into_iter().zip(by_facing) {
            let (across, along) = (&axes[facing.axis()], &axes[1 - facing.axis()]);
            let ranks = |[offset, start, end]: [f64; 3]| {
                [across.rank_of(offset), along.rank_of(start), along.rank_of(end)]
            };
            let planes: Vec<_> = planes.into_iter().map(ranks).collect();
            groups[facing as usize] = Group::new(&planes, across.len(), |rank| across.value(rank));
        }
        let mut sorted = Self { axes, groups, has_free_ends: false };
        sorted.find_corners();
        Ok(sorted)
    }

    /// The same planes searched by bisection alone: what the bucket indexes are measured and tested against.
    #[must_use]
    pub fn without_bucket_index(mut self) -> Self {
        self.axes.iter_mut().for_each(|axis| axis.list_buckets(1));
        self.groups.iter_mut().for_each(Group::drop_buckets);
        self
    }

    /// Number of planes after merging.
    pub fn len(&self) -> usize {
        self.groups.iter().map(|group| group.intervals.len()).sum()
    }

    /// Whether there is no plane at all.
    pub fn is_empty(&self) -> bool {
        self.groups.iter().all(|group| group.intervals.is_empty())
    }

    /// Number of planes with this facing.
    pub fn n_planes(&self, facing: Facing) -> usize {
        self.group(facing).intervals.len()
    }

    /// Number of distinct offsets with this facing.
    pub fn n_rows(&self, facing: Facing) -> usize {
        self.group(facing).rows.len()
    }

    /// The distinct offsets of one group, ascending: one a row.
    pub fn offsets(&self, facing: Facing) -> impl Iterator<Item = f64> {
        self.group(facing).rows.iter().map(|row| row.offset)
    }

    /// Whether a face somewhere ends without meeting another, as one side of a wall without thickness does.
    pub(crate) fn has_free_ends(&self) -> bool {
        self.has_free_ends
    }

    /// One group in sorted order (the report's Fig. 5).
    pub fn planes(&self, facing: Facing) -> impl Iterator<Item = Plane> {
        self.faces(facing).map(|face| face.plane)
    }

    /// One group in sorted order, with what is known about the planes' ends.
    pub(crate) fn faces(&self, facing: Facing) -> impl Iterator<Item = Face> {
        self.group(facing).rows.iter().flat_map(move |row| {
            let view = self.view(facing, row);
            row.range().map(move |index| view.face(index))
        })
    }

    /// The first plane of one group, met in its direction of motion, whose closest point lies nearer than `radius`.
    ///
    /// Rows are met in the direction of motion: ascending offsets for faces whose normals point towards minus (the ball moves towards
    /// plus), descending otherwise. A face that the centre has passed by less than the radius still counts. Within a row the
    /// interval nearest to the centre wins, the lower one on a tie.
    /// Needs a finite `centre` and `radius`. O(log n) for each row that lies within reach.
    pub fn first_overlap(&self, facing: Facing, centre: Vector2<f64>, radius: f64) -> Option<Plane> {
        let (across, along) = (centre[facing.axis()], centre[1 - facing.axis()]);
        let reach = radius * WIDENED;
        self.rows_within(facing, [across - reach, across + reach]).find_map(|row| {
            let plane = row.nearest(along)?;
            is_within(plane.offset - across, plane.gap(along), radius).then_some(plane)
        })
    }

    /// The plain O(n) truth that [`SortedPlanes::first_overlap`] is tested against.
    pub fn first_overlap_scan(&self, facing: Facing, centre: Vector2<f64>, radius: f64) -> Option<Plane> {
        let (across, along) = (centre[facing.axis()], centre[1 - facing.axis()]);
        let by_row = |plane: &Plane| -facing.sign() * plane.offset;
        self.planes(facing)
            .filter(|plane| is_within(plane.offset - across, plane.gap(along), radius))
            .min_by(|a, b| by_row(a).total_cmp(&by_row(b)).then_with(|| a.compare_distance(b, along)))
    }

    /// The rows of one group with offsets in a closed range, in the direction of motion of a ball that they stop.
    pub(crate) fn rows_within(&self, facing: Facing, range: [f64; 2]) -> impl Iterator<Item = RowView<'_>> {
        self.rows(facing, self.rows_at(facing, &self.ranks(facing.axis(), range)))
    }

    /// Ranks of the coordinates of an axis within a closed range.
    pub(crate) fn ranks(&self, axis: usize, range: [f64; 2]) -> Range<u32> {
        self.axes[axis].within(range)
    }

    /// Indices of the rows of one group at ranks of offsets.
    pub(crate) fn rows_at(&self, facing: Facing, ranks: &Range<u32>) -> Range<usize> {
        let group = self.group(facing);
        group.row_from(ranks.start)..group.row_from(ranks.end)
    }

    /// Rows of one group by index, in the direction of motion of a ball that they stop.
    pub(crate) fn rows(&self, facing: Facing, rows: Range<usize>) -> impl Iterator<Item = RowView<'_>> {
        let group = self.group(facing);
        let ascends = facing.sign() < 0.0;
        rows.clone().map(move |index| {
            let index = if ascends { index } else { rows.start + (rows.end - 1 - index) };
            self.view(facing, &group.rows[index])
        })
    }

    fn group(&self, facing: Facing) -> &Group {
        &self.groups[facing as usize]
    }

    fn view<'a>(&'a self, facing: Facing, row: &'a Row) -> RowView<'a> {
        RowView { facing, along: &self.axes[1 - facing.axis()], group: self.group(facing), row }
    }
}

/// The same planes in the same order.
impl PartialEq for SortedPlanes {
    fn eq(&self, other: &Self) -> bool {
        Facing::ALL.into_iter().all(|facing| self.faces(facing).eq(other.faces(facing)))
    }
}

/// A row, to find planes in.
#[derive(Clone, Copy)]
pub(crate) struct RowView<'a> {
    facing: Facing,
    /// Coordinates along the row.
    along: &'a Coordinates,
    group: &'a Group,
    row: &'a Row,
}

impl RowView<'_> {
    pub(crate) fn offset(&self) -> f64 {
        self.row.offset
    }

    fn plane(&self, interval: &Interval) -> Plane {
        let [start, end] = [interval.start, interval.end].map(|end| self.along.value(end.rank()));
        Plane { facing: self.facing, offset: self.row.offset, start, end }
    }

    fn face(&self, index: usize) -> Face {
        let interval = &self.group.intervals[index];
        let is_corner = [interval.start.is_corner(), interval.end.is_corner()];
        Face { plane: self.plane(interval), is_corner }
    }

    /// The planes that touch a closed range along the row, ascending.
    pub(crate) fn within(self, range: [f64; 2]) -> impl Iterator<Item = Face> {
        self.at(self.along.within(range))
    }

    /// The planes that touch coordinates at these ranks along the row, or hold all of them, ascending.
    pub(crate) fn at(self, ranks: Range<u32>) -> impl Iterator<Item = Face> {
        let rest = self.group.interval_from(self.row, ranks.start)..self.row.last as usize;
        rest.take_while(move |index| self.group.intervals[*index].start.is_below(ranks.end))
            .map(move |index| self.face(index))
    }

    /// The plane nearest to `along`, the lower one on a tie.
    fn nearest(&self, along: f64) -> Option<Plane> {
        let next = self.group.interval_from(self.row, self.along.n_below(along));
        let at = |index: usize| {
            self.row.range().contains(&index).then(|| self.plane(&self.group.intervals[index]))
        };
        match (next.checked_sub(1).and_then(at), at(next)) {
            (Some(below), Some(above)) if above.gap(along) < below.gap(along) => Some(above),
            (Some(below), _) => Some(below),
            (None, above) => above,
        }
    }
}

/// Whether a point that far away along two axes is nearer than `radius`.
pub(crate) fn is_within(across: f64, along: f64, radius: f64) -> bool {
    across * across + along * along < radius * radius
}

#[cfg(test)]
mod tests {
    use super::*;

    fn minus_x(offset: f64, start: f64, end: f64) -> Plane {
        Plane { facing: Facing::MinusX, offset, start, end }
    }

    fn sorted(planes: &[Plane]) -> SortedPlanes {
        SortedPlanes::new(planes.iter().copied()).unwrap()
    }

    #[test]
    fn planes_come_out_sorted_by_offset_start_end() {
        let planes = sorted(&[minus_x(2.0, 0.0, 1.0), minus_x(1.0, 5.0, 6.0), minus_x(1.0, 0.0, 2.0)]);
        let keys: Vec<_> = planes.planes(Facing::MinusX).map(|p| (p.offset, p.start, p.end)).collect();
        assert_eq!(keys, [(1.0, 0.0, 2.0), (1.0, 5.0, 6.0), (2.0, 0.0, 1.0)]);
        assert_eq!((planes.n_rows(Facing::MinusX), planes.len(), planes.n_planes(Facing::PlusY)), (2, 3, 0));
    }

    #[test]
    fn touching_and_overlapping_planes_of_a_row_are_merged() {
        let planes = sorted(&[minus_x(1.0, 0.0, 1.0), minus_x(1.0, 1.0, 2.0), minus_x(1.0, 0.5, 0.7)]);
        assert_eq!(planes.planes(Facing::MinusX).collect::<Vec<_>>(), [minus_x(1.0, 0.0, 2.0)]);
    }

    #[test]
    fn search_fault_1_of_several_offsets_in_reach_the_first_in_the_direction_of_motion_is_found() {
        // Three faces within one radius; the middle of the sorted list, where a bisection probes first, is not the nearest.
        let planes = sorted(&[minus_x(0.1, -1.0, 1.0), minus_x(0.2, -1.0, 1.0), minus_x(0.3, -1.0, 1.0)]);
        let hit = planes.first_overlap(Facing::MinusX, Vector2::zeros(), 0.35).unwrap();
        assert_eq!(hit.offset, 0.1);
        let mirrored = [0.1, 0.2, 0.3].map(|offset| Plane {
            facing: Facing::PlusX,
            offset: -offset,
            start: -1.0,
            end: 1.0,
        });
        let hit = sorted(&mirrored).first_overlap(Facing::PlusX, Vector2::zeros(), 0.35).unwrap();
        assert_eq!(hit.offset, -0.1);
    }

    #[test]
    fn search_fault_2_the_extent_of_the_ball_counts_not_its_centre() {
        // The centre passes the face's end by 0.2, the ball of radius 0.35 does not.
        let planes = sorted(&[minus_x(0.1, -1.0, -0.2)]);
        assert!(planes.first_overlap(Facing::MinusX, Vector2::zeros(), 0.35).is_some());
        // ... and its extent at the face's offset is what counts: the corner (0.3, -0.2) is 0.36 away.
        let planes = sorted(&[minus_x(0.3, -1.0, -0.2)]);
        assert!(planes.first_overlap(Facing::MinusX, Vector2::zeros(), 0.35).is_none());
    }

    #[test]
    fn a_row_in_reach_without_a_face_in_reach_is_passed_over() {
        let planes = sorted(&[minus_x(0.1, 5.0, 6.0), minus_x(0.2, -1.0, 1.0)]);
        assert_eq!(planes.first_overlap(Facing::MinusX, Vector2::zeros(), 0.35).unwrap().offset, 0.2);
    }

    #[test]
    fn touching_is_not_overlapping() {
        let planes = sorted(&[minus_x(0.5, -1.0, 1.0)]);
        assert!(planes.first_overlap(Facing::MinusX, Vector2::zeros(), 0.5).is_none());
    }

    #[test]
    fn bad_planes_are_refused_by_index() {
        let error = SortedPlanes::new([minus_x(0.0, 0.0, 1.0), minus_x(f64::NAN, 0.0, 1.0)]).unwrap_err();
        assert_eq!(error.to_string(), "plane 1 (-x): a coordinate is not finite");
        let error = SortedPlanes::new([minus_x(0.0, 1.0, 1.0)]).unwrap_err();
        assert_eq!(error.to_string(), "plane 0 (-x) starts at 1 and ends at 1: expected start < end");
    }
}
