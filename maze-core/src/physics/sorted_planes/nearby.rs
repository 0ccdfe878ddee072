//! What is near a point, whichever way it moves.

use super::{Face, SortedPlanes, WIDENED, is_within};
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
    pub fn is_inside_wall(&self, point: Vector2<f64>) -> bool {
        let Some(Clearance { distance, .. }) = self.clearance(point) else { return false };
        let is_in_front =
            |plane: &Plane| 0.0 <= (point[plane.facing.axis()] - plane.offset) * plane.facing.sign();
        // Widened, so that rounding does not hide the second face of a corner.
        !self.planes_within(point, distance * WIDENED + f64::MIN_POSITIVE).any(|plane| is_in_front(&plane))
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
