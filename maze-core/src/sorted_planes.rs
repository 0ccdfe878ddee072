//! The report's data structure: wall faces in four groups, sorted, searched by bisection in the direction of motion.

use crate::plane::{Facing, Plane, PlaneError};
use nalgebra::Vector2;

/// Part of a row that is wall.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Interval {
    start: f64,
    end: f64,
}

impl Interval {
    /// How far `along` lies outside; 0 within.
    fn gap(self, along: f64) -> f64 {
        if along < self.start {
            self.start - along
        } else if self.end < along {
            along - self.end
        } else {
            0.0
        }
    }
}

/// All faces of one group that share an offset: `intervals[first..last]` of the group.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Row {
    offset: f64,
    first: usize,
    last: usize,
}

/// The faces that look one way.
/// Invariant: offsets finite and ascending; a row's intervals are disjoint, do not touch, and ascend.
#[derive(Clone, Debug, Default, PartialEq)]
struct Group {
    rows: Vec<Row>,
    intervals: Vec<Interval>,
}

/// Wall faces in four groups sorted by (offset, start, end). Built once in O(n log n), then searched by bisection.
///
/// The report bisects once over the sorted tuples, which has two faults: several offsets may lie within the ball's reach,
/// so the first candidate need not be the nearest; and a test of start and end against the ball's centre forgets its
/// extent. Here a group is a list of rows of equal offset, each with disjoint sorted intervals: bisect for the first row
/// in reach, walk the rows in the direction of motion, bisect in each for the interval. O(log n) a row within reach.
#[derive(Clone, Debug, PartialEq)]
pub struct SortedPlanes {
    groups: [Group; 4], // in the order of Facing::ALL
}

impl SortedPlanes {
    /// Sorts the planes and merges those of the same facing and offset that touch or overlap.
    ///
    /// # Errors
    /// A plane with a coordinate that is not finite, or with no extent.
    pub fn new(planes: impl IntoIterator<Item = Plane>) -> Result<Self, PlaneError> {
        let mut by_facing: [Vec<Plane>; 4] = Default::default();
        for (index, plane) in planes.into_iter().enumerate() {
            by_facing[plane.facing as usize].push(plane.checked(index)?);
        }
        Ok(Self { groups: by_facing.map(Group::new) })
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

    /// One group in sorted order (the report's Fig. 5).
    pub fn planes(&self, facing: Facing) -> impl Iterator<Item = Plane> {
        let group = self.group(facing);
        group.rows.iter().flat_map(move |row| {
            let plane = move |interval: &Interval| Plane {
                facing,
                offset: row.offset,
                start: interval.start,
                end: interval.end,
            };
            group.intervals[row.first..row.last].iter().map(plane)
        })
    }

    /// The first plane of one group, met in its direction of motion, whose closest point lies nearer than `radius`.
    ///
    /// Rows are met in the direction of motion: ascending offsets for faces that look towards minus (the ball moves towards
    /// plus), descending otherwise. A face that the centre has passed by less than the radius still counts. Within a row the interval nearest to the centre wins, the lower one on a tie.
    /// Needs a finite `centre` and `radius`. O(log n) for each row that lies within reach.
    pub fn first_overlap(&self, facing: Facing, centre: Vector2<f64>, radius: f64) -> Option<Plane> {
        let group = self.group(facing);
        let (across, along) = (centre[facing.axis()], centre[1 - facing.axis()]);
        let low = group.rows.partition_point(|row| row.offset - across <= -radius);
        let high = low + group.rows[low..].partition_point(|row| row.offset - across < radius);
        let hit = |row: &Row| group.nearest_in_row(facing, row, across, along, radius);
        if facing.sign() < 0.0 {
            group.rows[low..high].iter().find_map(hit)
        } else {
            group.rows[low..high].iter().rev().find_map(hit)
        }
    }

    /// The plain O(n) truth that [`SortedPlanes::first_overlap`] is tested against.
    pub fn first_overlap_scan(&self, facing: Facing, centre: Vector2<f64>, radius: f64) -> Option<Plane> {
        let (across, along) = (centre[facing.axis()], centre[1 - facing.axis()]);
        let rank = |plane: &Plane| {
            let gap = Interval { start: plane.start, end: plane.end }.gap(along);
            (-facing.sign() * plane.offset, gap, plane.start)
        };
        self.planes(facing)
            .filter(|plane| {
                let (_, gap, _) = rank(plane);
                is_within(plane.offset - across, gap, radius)
            })
            .min_by(|a, b| {
                let (a, b) = (rank(a), rank(b));
                a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.total_cmp(&b.2))
            })
    }

    /// The rows of one group with offsets in a closed range, in the direction of motion of a ball that they stop.
    pub(crate) fn rows_within(
        &self,
        facing: Facing,
        [low, high]: [f64; 2],
    ) -> impl Iterator<Item = RowView<'_>> {
        let group = self.group(facing);
        let first = group.rows.partition_point(|row| row.offset < low);
        let last = first + group.rows[first..].partition_point(|row| row.offset <= high);
        let n_rows = last - first;
        (0..n_rows).map(move |step| {
            let row = &group.rows[if facing.sign() < 0.0 { first + step } else { last - 1 - step }];
            RowView { facing, offset: row.offset, intervals: &group.intervals[row.first..row.last] }
        })
    }

    /// The plane of one facing that starts or ends at a point.
    pub(crate) fn ending_at(&self, facing: Facing, point: Vector2<f64>) -> Option<Plane> {
        let (across, along) = (point[facing.axis()], point[1 - facing.axis()]);
        let row = self.rows_within(facing, [across, across]).next()?;
        row.within([along, along]).find(|plane| plane.start == along || plane.end == along)
    }

    fn group(&self, facing: Facing) -> &Group {
        &self.groups[facing as usize]
    }
}

/// A row, to look for intervals in.
pub(crate) struct RowView<'a> {
    facing: Facing,
    offset: f64,
    intervals: &'a [Interval],
}

impl RowView<'_> {
    pub(crate) fn offset(&self) -> f64 {
        self.offset
    }

    /// The planes that touch a closed range along the row, ascending.
    pub(crate) fn within(&self, [low, high]: [f64; 2]) -> impl Iterator<Item = Plane> {
        let first = self.intervals.partition_point(|interval| interval.end < low);
        let near = self.intervals[first..].iter().take_while(move |interval| interval.start <= high);
        near.map(|interval| Plane {
            facing: self.facing,
            offset: self.offset,
            start: interval.start,
            end: interval.end,
        })
    }
}

/// Whether a point that far away along two axes is nearer than `radius`.
pub(crate) fn is_within(across: f64, along: f64, radius: f64) -> bool {
    across * across + along * along < radius * radius
}

impl Group {
    fn new(mut planes: Vec<Plane>) -> Self {
        planes.sort_by(|a, b| {
            a.offset.total_cmp(&b.offset).then(a.start.total_cmp(&b.start)).then(a.end.total_cmp(&b.end))
        });
        let mut group = Self::default();
        for plane in planes {
            // Compared as numbers, so that rows at -0 and +0 are one row.
            let same_row = group.rows.last().is_some_and(|row| row.offset == plane.offset);
            if !same_row {
                let first = group.intervals.len();
                group.rows.push(Row { offset: plane.offset, first, last: first });
            }
            let interval = Interval { start: plane.start, end: plane.end };
            match group.intervals.last_mut() {
                Some(previous) if same_row && interval.start <= previous.end => {
                    if previous.end < interval.end {
                        previous.end = interval.end;
                    }
                }
                _ => group.intervals.push(interval),
            }
            if let Some(row) = group.rows.last_mut() {
                row.last = group.intervals.len();
            }
        }
        group
    }

    /// Of one row, the interval nearest to `along`, if it is within the radius.
    fn nearest_in_row(
        &self,
        facing: Facing,
        row: &Row,
        across: f64,
        along: f64,
        radius: f64,
    ) -> Option<Plane> {
        let intervals = &self.intervals[row.first..row.last];
        let next = intervals.partition_point(|interval| interval.end < along);
        let above = intervals.get(next);
        let below = next.checked_sub(1).and_then(|previous| intervals.get(previous));
        let nearest = match (below, above) {
            (Some(below), Some(above)) if above.gap(along) < below.gap(along) => above,
            (Some(below), _) => below,
            (None, above) => above?,
        };
        is_within(row.offset - across, nearest.gap(along), radius).then_some(Plane {
            facing,
            offset: row.offset,
            start: nearest.start,
            end: nearest.end,
        })
    }
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
        // Three faces within one radius; the middle of the sorted list, where a bisection looks first, is not the nearest.
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
