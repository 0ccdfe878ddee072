//! What is near a point, whichever way it moves.

use super::{Face, LEAST_REACH, SortedPlanes, WIDENED, is_within};
use crate::physics::wall::{Facing, Plane};
use nalgebra::Vector2;
use std::cmp::Ordering;

/// The plane nearest to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clearance {
    /// Which one.
    pub plane: Plane,
    /// From the point to the plane's closest point (units).
    pub distance: f64,
}

/// Squared distance of a point from a plane's closest point.
fn squared_distance(plane: &Plane, centre: Vector2<f64>) -> f64 {
    let across = plane.offset - centre[plane.facing.axis()];
    let along = plane.gap(centre[1 - plane.facing.axis()]);
    across * across + along * along
}

/// The nearest plane so far; of equally near ones the first in the order of facing and offset, then the lower one.
#[derive(Default)]
struct Nearest(Option<(f64, Plane)>);

impl Nearest {
    fn offer(&mut self, plane: Plane, centre: Vector2<f64>) {
        let squared = squared_distance(&plane, centre);
        let rank = |(squared, plane): (f64, Plane)| (squared, plane.facing, plane.offset);
        let is_nearer = |known: (f64, Plane)| match rank((squared, plane)).partial_cmp(&rank(known)) {
            // Distances that round to the same number: in a row the places of the planes decide.
            Some(Ordering::Equal) => {
                plane.compare_distance(&known.1, centre[1 - plane.facing.axis()]).is_lt()
            }
            order => order == Some(Ordering::Less),
        };
        if self.0.is_none_or(is_nearer) {
            self.0 = Some((squared, plane));
        }
    }

    fn is_nearer_than(&self, across: f64) -> bool {
        self.0.is_some_and(|(squared, _)| squared < across * across)
    }

    fn clearance(self) -> Option<Clearance> {
        self.0.map(|(squared, plane)| Clearance { plane, distance: squared.sqrt() })
    }
}

impl SortedPlanes {
    /// All planes whose closest point lies nearer to `centre` than `reach`, group by group.
    ///
    /// Needs finite numbers. O(log n) for each row within reach.
    pub fn planes_within(&self, centre: Vector2<f64>, reach: f64) -> impl Iterator<Item = Plane> {
        self.faces_around(centre, reach).map(|face| face.plane)
    }

    /// The same planes, with what is known about their ends.
    pub(crate) fn faces_around(&self, centre: Vector2<f64>, reach: f64) -> impl Iterator<Item = Face> {
        let wide = reach * WIDENED;
        Facing::ALL.into_iter().flat_map(move |facing| {
            let (across, along) = (centre[facing.axis()], centre[1 - facing.axis()]);
            self.rows_within(facing, [across - wide, across + wide])
                .flat_map(move |row| row.within([along - wide, along + wide]))
                .filter(move |face| is_within(face.plane.offset - across, face.plane.gap(along), reach))
        })
    }

    /// Whether one of these planes is of some kind: what the exact engine asks after many a tick, with half of the probes.
    pub(crate) fn any_within(
        &self,
        centre: Vector2<f64>,
        reach: f64,
        is_meant: impl Fn(&Plane) -> bool,
    ) -> bool {
        let wide = reach * WIDENED;
        let ranks = [0, 1].map(|axis| self.ranks(axis, [centre[axis] - wide, centre[axis] + wide]));
        for facing in Facing::ALL {
            let (across, along) = (facing.axis(), 1 - facing.axis());
            for row in self.rows(facing, self.rows_at(facing, &ranks[across])) {
                for face in row.at(ranks[along].clone()) {
                    let Face { plane, .. } = face;
                    let is_near = is_within(plane.offset - centre[across], plane.gap(centre[along]), reach);
                    if is_near && is_meant(&plane) {
                        return true;
                    }
                }
            }
        }
        false
    }

    /// The plain O(n) truth that [`SortedPlanes::planes_within`] is tested against; the order may differ.
    pub fn planes_within_scan(&self, centre: Vector2<f64>, reach: f64) -> impl Iterator<Item = Plane> {
        Facing::ALL.into_iter().flat_map(|facing| self.planes(facing)).filter(move |plane| {
            let (across, along) = (centre[plane.facing.axis()], centre[1 - plane.facing.axis()]);
            is_within(plane.offset - across, plane.gap(along), reach)
        })
    }

    /// The plane nearest to a point, whichever its facing; `None` when there is none at all.
    ///
    /// Of equally near planes the first in the order of facing and offset, then the lower one. Needs a finite `centre`.
    /// O(log n) for each row that is nearer than the plane found.
    pub fn clearance(&self, centre: Vector2<f64>) -> Option<Clearance> {
        let mut nearest = Nearest::default();
        for facing in Facing::ALL {
            let (across, along) = (centre[facing.axis()], centre[1 - facing.axis()]);
            let group = self.group(facing);
            let begin = group.row_from(self.axes[facing.axis()].n_below(across));
            let (below, above) = group.rows.split_at(begin);
            let mut walk = |rows: &mut dyn Iterator<Item = &super::Row>| {
                for row in rows {
                    if nearest.is_nearer_than(row.offset - across) {
                        break;
                    }
                    if let Some(plane) = self.view(facing, row).nearest(along) {
                        nearest.offer(plane, centre);
                    }
                }
            };
            walk(&mut above.iter());
            walk(&mut below.iter().rev());
        }
        nearest.clearance()
    }

    /// Whether a point lies inside a solid wall: behind all of the faces that are nearest to it. Needs a finite `point`.
    ///
    /// Of equally near faces, those that are nearest within their extent decide, and only where there are none those that are nearest
    /// at an end: where a face ends at another one, a point may lie in front of its line and inside the wall.
    pub fn is_inside_wall(&self, point: Vector2<f64>) -> bool {
        let Some(Clearance { plane: nearest, distance }) = self.clearance(point) else { return false };
        // Widened against rounding, and for a point on a face; equally near faces have the same squares, to the bit.
        let reach = distance * WIDENED + LEAST_REACH;
        let least = squared_distance(&nearest, point);
        let is_beyond_an_end = |plane: &Plane| 0.0 < plane.gap(point[1 - plane.facing.axis()]);
        let is_in_front =
            |plane: &Plane| 0.0 <= (point[plane.facing.axis()] - plane.offset) * plane.facing.sign();
        // The nearest one is named too: squares of great distances are infinite, and then nothing is within reach.
        let near = self.planes_within(point, reach).chain([nearest]);
        let equally_near: Vec<Plane> = near.filter(|plane| squared_distance(plane, point) == least).collect();
        let ends_decide = equally_near.iter().all(is_beyond_an_end);
        !equally_near.iter().any(|plane| is_in_front(plane) && (ends_decide || !is_beyond_an_end(plane)))
    }

    /// The plain O(n) truth that [`SortedPlanes::clearance`] is tested against.
    pub fn clearance_scan(&self, centre: Vector2<f64>) -> Option<Clearance> {
        let mut nearest = Nearest::default();
        for plane in Facing::ALL.into_iter().flat_map(|facing| self.planes(facing)) {
            nearest.offer(plane, centre);
        }
        nearest.clearance()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn face(facing: Facing, offset: f64, start: f64, end: f64) -> Plane {
        Plane { facing, offset, start, end }
    }

    #[test]
    fn a_point_behind_a_face_is_inside_also_where_another_face_ends_there() {
        // A free quadrant: the wall is all the rest.
        let quadrant = [face(Facing::PlusX, 0.0, 0.0, 9.0), face(Facing::PlusY, 0.0, 0.0, 9.0)];
        let planes = SortedPlanes::new(quadrant).unwrap();
        let is_inside = |x: f64, y: f64| planes.is_inside_wall(Vector2::new(x, y));
        for y in [-1.0, -1.0e-3, -1.0e-17, 0.0, 1.0e-17, 1.0e-4, 1.0e-3, 0.5] {
            assert!(is_inside(-1.0, y) && is_inside(y, -1.0), "{y}");
        }
        assert!(!is_inside(1.0, 1.0e-9) && !is_inside(0.5, 0.5));
        // A solid quadrant: the corner is seen from outside.
        let block = [face(Facing::PlusX, 0.0, -9.0, 0.0), face(Facing::PlusY, 0.0, -9.0, 0.0)];
        let planes = SortedPlanes::new(block).unwrap();
        let is_inside = |x: f64, y: f64| planes.is_inside_wall(Vector2::new(x, y));
        for y in [0.0, 1.0e-17, 1.0e-4, 1.0] {
            assert!(!is_inside(1.0, y) && !is_inside(y, 1.0) && !is_inside(1.0, -y), "{y}");
        }
        assert!(is_inside(-1.0, -1.0e-9) && is_inside(-0.5, -0.5));
    }

    #[test]
    fn nothing_is_inside_of_a_wall_without_thickness() {
        let wall = [face(Facing::PlusX, 0.0, 0.0, 1.0), face(Facing::MinusX, 0.0, 0.0, 1.0)];
        let planes = SortedPlanes::new(wall).unwrap();
        for (x, y) in [(0.0, 0.5), (0.0, 0.0), (0.0, 2.0), (0.3, 0.5), (-0.3, 1.0), (1.0e-300, 0.5)] {
            assert!(!planes.is_inside_wall(Vector2::new(x, y)), "{x} {y}");
        }
        // So far away that squares are infinite.
        let planes = SortedPlanes::new([face(Facing::MinusX, 1.0e155, -1.0, 1.0)]).unwrap();
        assert!(!planes.is_inside_wall(Vector2::zeros()));
        assert!(planes.is_inside_wall(Vector2::new(1.0e156, 0.0)));
    }
}
