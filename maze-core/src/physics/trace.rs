//! What one search visited, as data: for pictures of the method (the report's Fig. 5 to 7).
//!
//! The search itself is that of [`sweep::first_impact`]; only a traced query pays for the trace.

use crate::physics::sorted_planes::SortedPlanes;
use crate::physics::sweep::{self, Impact, SweepQuery, Visit};
use crate::physics::wall::{Facing, Plane};

/// One probe of a bisection: what is sought lies in `low..=high`, and `mid` is compared with it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Probe {
    /// First index that is not excluded.
    pub low: usize,
    /// Index that is compared.
    pub mid: usize,
    /// Last index that is not excluded, or one past the end.
    pub high: usize,
}

/// A row that the search visited.
#[derive(Clone, Debug, PartialEq)]
pub struct RowVisit {
    /// Index among the rows of the group.
    pub row: usize,
    /// Offset of its planes.
    pub offset: f64,
    /// Range along the row in which the circle can touch it.
    pub window: [f64; 2],
    /// The bisection for the first plane that does not end below the window, by index within the row.
    pub probes: Vec<Probe>,
    /// The planes that were tested for an impact.
    pub planes: Vec<Plane>,
}

/// The search through one group.
#[derive(Clone, Debug, PartialEq)]
pub struct GroupVisit {
    /// Which group.
    pub facing: Facing,
    /// Range of offsets in which the circle can touch a plane.
    pub offsets: [f64; 2],
    /// The bisection for the first row in that range, in the direction of motion.
    pub probes: Vec<Probe>,
    /// In the order in which they were visited.
    pub rows: Vec<RowVisit>,
}

/// One search.
#[derive(Clone, Debug, PartialEq)]
pub struct SearchTrace {
    /// In the order in which they were searched.
    pub groups: Vec<GroupVisit>,
    /// What was found.
    pub impact: Option<Impact>,
}

/// [`sweep::first_impact`], and what it visited.
///
/// Bisections are shown in full, as the report draws them; the search itself starts each in a bucket of an index and finds the same
/// position. Made for pictures: O(n) for each row that is visited.
pub fn search(planes: &SortedPlanes, query: &SweepQuery) -> SearchTrace {
    let mut groups: Vec<GroupVisit> = Vec::new();
    let impact = sweep::search(planes, query, &mut |visit| match visit {
        Visit::Group { facing, offsets } => {
            let rows: Vec<f64> = planes.offsets(facing).collect();
            let [low, high] = offsets;
            let probes = if facing.sign() < 0.0 {
                bisection(rows.len(), |row| rows[row] < low)
            } else {
                bisection(rows.len(), |row| rows[row] <= high)
            };
            groups.push(GroupVisit { facing, offsets, probes, rows: Vec::new() });
        }
        Visit::Row { offset, window } => {
            let Some(group) = groups.last_mut() else { return };
            let row = planes.offsets(group.facing).position(|known| known == offset).unwrap_or_default();
            let ends: Vec<f64> = planes
                .planes(group.facing)
                .filter(|plane| plane.offset == offset)
                .map(|plane| plane.end)
                .collect();
            let probes = bisection(ends.len(), |index| ends[index] < window[0]);
            group.rows.push(RowVisit { row, offset, window, probes, planes: Vec::new() });
        }
        Visit::Plane(plane) => {
            if let Some(row) = groups.last_mut().and_then(|group| group.rows.last_mut()) {
                row.planes.push(plane);
            }
        }
    });
    SearchTrace { groups, impact }
}

/// The probes of a bisection for the first of `n` indices that is not below.
fn bisection(n: usize, is_below: impl Fn(usize) -> bool) -> Vec<Probe> {
    let (mut low, mut high) = (0, n);
    let mut probes = Vec::new();
    while low < high {
        let mid = low + (high - low) / 2;
        probes.push(Probe { low, mid, high });
        if is_below(mid) {
            low = mid + 1;
        } else {
            high = mid;
        }
    }
    probes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::time_of_impact::Path;
    use nalgebra::Vector2;

    fn walls() -> SortedPlanes {
        let face = |offset: i32, start: i32| Plane {
            facing: Facing::MinusX,
            offset: f64::from(offset),
            start: f64::from(start),
            end: f64::from(start) + 1.0,
        };
        // Nine rows of ten faces with gaps between them; the first two rows have none where the ball passes.
        let faces = (1..10).flat_map(|offset| (0..10).map(move |n| face(offset, 2 * n)));
        SortedPlanes::new(faces.filter(|face| 2.0 < face.offset || face.start != 8.0)).unwrap()
    }

    #[test]
    fn a_trace_shows_the_rows_that_were_visited_up_to_the_first_hit() {
        let path = Path {
            position: Vector2::new(0.0, 8.5),
            velocity: Vector2::new(1.0, 0.0),
            acceleration: Vector2::zeros(),
        };
        let query = SweepQuery::new(path, 0.25, 100.0).unwrap();
        let trace = search(&walls(), &query);
        assert_eq!(trace.impact, sweep::first_impact(&walls(), &query));
        assert_eq!(trace.impact.unwrap().point(&path), Vector2::new(3.0, 8.5));
        // The faces end freely, so all groups are searched; three are empty.
        let group = trace.groups.iter().find(|group| !group.rows.is_empty()).unwrap();
        assert_eq!(group.facing, Facing::MinusX);
        let rows: Vec<_> = group.rows.iter().map(|row| (row.row, row.offset, row.planes.len())).collect();
        assert_eq!(rows, [(0, 1.0, 0), (1, 2.0, 0), (2, 3.0, 1)]);
        assert_eq!(group.rows[2].planes[0].start, 8.0);
        // Nine rows are bisected in four probes at most, the first at the middle one.
        assert_eq!(group.probes[0], Probe { low: 0, mid: 4, high: 9 });
        assert!(group.probes.len() <= 4 && group.rows.iter().all(|row| row.probes.len() <= 4));
    }

    #[test]
    fn bisection_ends_at_the_first_that_is_not_below() {
        for n in 0..20 {
            for first in 0..=n {
                let last = bisection(n, |index| index < first).pop();
                let end = last.map_or(0, |probe| if probe.mid < first { probe.mid + 1 } else { probe.mid });
                assert_eq!(end, first);
            }
        }
    }
}
