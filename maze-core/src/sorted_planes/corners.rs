//! Which ends of faces are corners that a ball can touch.

use super::{Face, SortedPlanes};
use crate::plane::Facing;

/// What a face's end is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum End {
    /// It runs into a face that looks back along it.
    Inward,
    /// It meets a face that looks on.
    Outward,
    /// It meets none, as one side of a wall without thickness does.
    Free,
}

impl SortedPlanes {
    /// Tells corners that a ball can touch from those that it cannot, and finds out whether some ends are free.
    ///
    /// Where a +x face runs into a -y face that covers its front, a ball touches one of the two before it reaches the corner
    /// between them, or the other end of a short one.
    pub(super) fn find_corners(&mut self) {
        for facing in Facing::ALL {
            let ends: Vec<_> = self.faces(facing).map(|face| self.ends_of(&face)).collect();
            self.has_free_ends |= ends.iter().flatten().any(|end| *end == End::Free);
            let is_corner = ends.into_iter().map(|ends| ends.map(|end| end != End::Inward));
            self.groups[facing as usize].is_corner = is_corner.collect();
        }
    }

    fn ends_of(&self, face: &Face) -> [End; 2] {
        let (facing, offset) = (face.plane.facing, face.plane.offset);
        let [plus, minus] = Facing::across(1 - facing.axis());
        let end = |along: f64, on: Facing, back: Facing| {
            let meets = |other: Facing, is_met: &dyn Fn(f64, f64) -> bool| {
                let row = self.rows_within(other, [along, along]).next();
                row.is_some_and(|row| {
                    row.within([offset, offset]).any(|met| is_met(met.plane.start, met.plane.end))
                })
            };
            let covers_front = |start: f64, end: f64| {
                if facing.sign() < 0.0 { start < offset } else { offset < end }
            };
            if meets(back, &covers_front) {
                End::Inward
            } else if meets(on, &|_, _| true) {
                End::Outward
            } else {
                End::Free
            }
        };
        [end(face.plane.start, minus, plus), end(face.plane.end, plus, minus)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plane::Plane;

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
