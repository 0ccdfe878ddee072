//! Which ends of faces are corners that a ball can touch.

use super::SortedPlanes;
use super::group::{End, Group, Interval, n_32};
use crate::physics::wall::Facing;

/// Finds the intervals of one group where they meet a line that moves up along its rows.
struct Cursors<'a> {
    group: &'a Group,
    /// For each row the first interval that does not end below the line.
    next: Vec<u32>,
}

impl<'a> Cursors<'a> {
    fn new(group: &'a Group) -> Self {
        Self { group, next: group.rows.iter().map(|row| row.first).collect() }
    }

    /// The interval of the row at rank `across` that holds rank `along`, which must not be below the last one asked for.
    fn at(&mut self, across: u32, along: u32) -> Option<Interval> {
        let row = self.group.row_at(across)?;
        let next = &mut self.next[row];
        let last = self.group.rows[row].last;
        while *next < last && self.group.intervals[*next as usize].end.is_below(along) {
            *next += 1;
        }
        let interval = (*next < last).then(|| self.group.intervals[*next as usize])?;
        (interval.start.rank() <= along).then_some(interval)
    }
}

impl SortedPlanes {
    /// Tells corners that a ball can touch from those that it cannot, and finds out whether some ends are free.
    ///
    /// Where a +x face runs into a -y face that covers its front, a ball touches one of the two before it reaches the corner
    /// between them, or the other end of a short one. O(n): rows are passed in ascending order, and so are the intervals of
    /// the faces that they meet.
    pub(super) fn find_corners(&mut self) {
        let mut has_free_ends = false;
        for facing in Facing::ALL {
            // Put back below; the ends of one group do not depend on what is known about another's.
            let mut intervals = std::mem::take(&mut self.groups[facing as usize].intervals);
            let group = &self.groups[facing as usize];
            let [mut plus, mut minus] =
                Facing::across(1 - facing.axis()).map(|other| Cursors::new(self.group(other)));
            for rank in 0..n_32(self.axes[facing.axis()].len()) {
                let Some(row) = group.row_at(rank) else { continue };
                for interval in &mut intervals[group.rows[row].range()] {
                    let covers_front = |met: Interval| match facing.sign() < 0.0 {
                        true => met.start.rank() < rank,
                        false => rank < met.end.rank(),
                    };
                    let mut end = |end: End, on: &mut Cursors, back: &mut Cursors| {
                        if back.at(end.rank(), rank).is_some_and(covers_front) {
                            return End::new(end.rank(), false);
                        }
                        has_free_ends |= on.at(end.rank(), rank).is_none();
                        End::new(end.rank(), true)
                    };
                    interval.start = end(interval.start, &mut minus, &mut plus);
                    interval.end = end(interval.end, &mut plus, &mut minus);
                }
            }
            self.groups[facing as usize].intervals = intervals;
        }
        self.has_free_ends = has_free_ends;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::wall::Plane;

    fn plane(facing: Facing, offset: f64, start: f64, end: f64) -> Plane {
        Plane { facing, offset, start, end }
    }

    fn corners(planes: &SortedPlanes, facing: Facing) -> Vec<[bool; 2]> {
        planes.faces(facing).map(|face| face.is_corner).collect()
    }

    #[test]
    fn a_block_has_outward_corners_and_a_room_inward_ones() {
        let block = |[plus, minus]: [f64; 2]| {
            let faces = [
                (Facing::PlusX, plus),
                (Facing::MinusX, minus),
                (Facing::PlusY, plus),
                (Facing::MinusY, minus),
            ];
            SortedPlanes::new(faces.map(|(facing, offset)| plane(facing, offset, 0.0, 1.0))).unwrap()
        };
        let (solid, room) = (block([1.0, 0.0]), block([0.0, 1.0]));
        for facing in Facing::ALL {
            assert_eq!(corners(&solid, facing), [[true; 2]]);
            assert_eq!(corners(&room, facing), [[false; 2]]);
        }
        assert!(!solid.has_free_ends() && !room.has_free_ends());
    }

    #[test]
    fn a_wall_without_thickness_has_free_ends() {
        let wall = [Facing::PlusX, Facing::MinusX].map(|facing| plane(facing, 0.0, 0.0, 1.0));
        let wall = SortedPlanes::new(wall).unwrap();
        assert_eq!(corners(&wall, Facing::PlusX), [[true; 2]]);
        assert!(wall.has_free_ends());
    }

    #[test]
    fn a_face_that_runs_into_the_middle_of_another_ends_inward_there() {
        let planes = [plane(Facing::PlusX, 0.0, 0.0, 1.0), plane(Facing::MinusY, 1.0, -1.0, 1.0)];
        let planes = SortedPlanes::new(planes).unwrap();
        assert_eq!(corners(&planes, Facing::PlusX), [[true, false]]);
    }
}
