//! Faces sorted into wall, upward and downward; upright faces cut at one height into planes.

use crate::assembly::polygons::doubled_area;
use crate::physics::wall::{Facing, Plane};
use nalgebra::{Vector2, Vector3};

/// Cosine of the steepest angle by which a face may lean off its axis and still count as axis-aligned: 1 degree.
/// Modelling by hand leaves 0.1 to 0.6 degrees; mazes that are really slanted start at about 3.
pub(crate) const COS_SNAP: f64 = 0.999_847_7;
/// The sine of that angle.
pub(crate) const SIN_SNAP: f64 = 0.017_452_4;

/// Faces below this fraction of the squared size of the mesh have no direction worth trusting.
const DEGENERATE_AREA: f64 = 1.0e-12;

/// What a face is by its normal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum FaceKind {
    /// Upright along x or y.
    Wall(Facing),
    /// Upward: floor, or the top of a wall.
    Up,
    /// Downward: never seen, never met.
    Down,
    /// Upright or slanted, along no axis.
    OffAxis,
    /// Without area.
    Degenerate,
}

/// Kind, area and normal of a polygon; `mesh_size` is the largest extent of the mesh.
pub(crate) fn classify(polygon: &[Vector3<f64>], mesh_size: f64) -> (FaceKind, f64, Vector3<f64>) {
    let doubled = doubled_area(polygon);
    let area = doubled.norm() / 2.0;
    if area <= DEGENERATE_AREA * mesh_size * mesh_size {
        return (FaceKind::Degenerate, area, Vector3::zeros());
    }
    let normal = doubled / (2.0 * area);
    let kind = match (normal.x, normal.y, normal.z) {
        (x, _, _) if COS_SNAP <= x => FaceKind::Wall(Facing::PlusX),
        (x, _, _) if x <= -COS_SNAP => FaceKind::Wall(Facing::MinusX),
        (_, y, _) if COS_SNAP <= y => FaceKind::Wall(Facing::PlusY),
        (_, y, _) if y <= -COS_SNAP => FaceKind::Wall(Facing::MinusY),
        (_, _, z) if COS_SNAP <= z => FaceKind::Up,
        (_, _, z) if z <= -COS_SNAP => FaceKind::Down,
        _ => FaceKind::OffAxis,
    };
    (kind, area, normal)
}

/// Where the edges of a polygon cross the height `z`, in order along an axis.
fn crossings(polygon: &[Vector3<f64>], along: usize, z: f64) -> Vec<Vector2<f64>> {
    let next = polygon.iter().cycle().skip(1);
    // Half-open (`< z`), so that a corner exactly at the height is crossed once and not twice.
    let mut crossings: Vec<Vector2<f64>> = polygon
        .iter()
        .zip(next)
        .filter(|(a, b)| (a.z < z) != (b.z < z))
        .map(|(a, b)| {
            let fraction = (z - a.z) / (b.z - a.z);
            Vector2::new(a.x + (b.x - a.x) * fraction, a.y + (b.y - a.y) * fraction)
        })
        .collect();
    crossings.sort_by(|a, b| a[along].total_cmp(&b[along]));
    crossings
}

/// Adds where a polygon crosses the height `z`: one face for each stretch (a concave polygon may have several).
///
/// A stretch off axis becomes a face along the axis that it follows more, at its middle, and a half step at either end. So
/// the outline stays closed and the area behind it the same.
pub(crate) fn cut(polygon: &[Vector3<f64>], z: f64, planes: &mut Vec<Plane>) {
    let normal = doubled_area(polygon).xy();
    // The way runs across the normal.
    let along = if normal.x.abs() < normal.y.abs() { 0 } else { 1 };
    let across = 1 - along;
    let towards = |axis: usize| match (axis, 0.0 <= normal[axis]) {
        (0, true) => Facing::PlusX,
        (0, false) => Facing::MinusX,
        (_, true) => Facing::PlusY,
        (_, false) => Facing::MinusY,
    };
    for pair in crossings(polygon, along, z).chunks_exact(2) {
        let [from, to] = [pair[0], pair[1]];
        let middle = (from[across] + to[across]) / 2.0;
        let pieces = [
            (towards(across), middle, from[along], to[along]),
            (towards(along), from[along], from[across], middle),
            (towards(along), to[along], middle, to[across]),
        ];
        for (facing, offset, a, b) in pieces {
            let (start, end) = if a < b { (a, b) } else { (b, a) };
            if start < end {
                planes.push(Plane { facing, offset, start, end });
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corners(list: &[[f64; 3]]) -> Vec<Vector3<f64>> {
        list.iter().map(|&[x, y, z]| Vector3::new(x, y, z)).collect()
    }

    #[test]
    fn a_face_is_classified_by_its_normal() {
        let up = corners(&[[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 1.0, 1.0], [0.0, 1.0, 1.0]]);
        assert_eq!(classify(&up, 1.0), (FaceKind::Up, 1.0, Vector3::z()));
        let down: Vec<_> = up.iter().rev().copied().collect();
        assert_eq!(classify(&down, 1.0).0, FaceKind::Down);
        let wall = corners(&[[2.0, 0.0, 0.0], [2.0, 3.0, 0.0], [2.0, 3.0, 1.0]]);
        assert_eq!(classify(&wall, 1.0), (FaceKind::Wall(Facing::PlusX), 1.5, Vector3::x()));
        assert_eq!(classify(&wall[..2], 1.0).0, FaceKind::Degenerate);
        let slanted = corners(&[[0.0, 0.0, 0.0], [1.0, 0.05, 0.0], [1.0, 0.05, 1.0]]);
        assert_eq!(classify(&slanted, 1.0).0, FaceKind::OffAxis);
        let nearly = corners(&[[0.0, 0.0, 0.0], [1.0, 0.01, 0.0], [1.0, 0.01, 1.0]]);
        assert_eq!(classify(&nearly, 1.0).0, FaceKind::Wall(Facing::MinusY));
    }

    #[test]
    fn a_concave_wall_is_cut_into_its_stretches() {
        // A wall with a notch from above, cut through the notch.
        let wall = corners(&[
            [0.0, 5.0, 0.0],
            [4.0, 5.0, 0.0],
            [4.0, 5.0, 2.0],
            [3.0, 5.0, 2.0],
            [3.0, 5.0, 0.5],
            [1.0, 5.0, 0.5],
            [1.0, 5.0, 2.0],
            [0.0, 5.0, 2.0],
        ]);
        let plane = |start, end| Plane { facing: Facing::MinusY, offset: 5.0, start, end };
        let cut_at = |z| {
            let mut planes = Vec::new();
            cut(&wall, z, &mut planes);
            planes
        };
        assert_eq!(cut_at(1.0), [plane(0.0, 1.0), plane(3.0, 4.0)]);
        assert_eq!(cut_at(0.25), [plane(0.0, 4.0)]);
        assert!(cut_at(3.0).is_empty());
    }

    #[test]
    fn a_slanted_wall_becomes_steps_that_keep_the_outline_closed() {
        // From (0, 0) to (4, 1), its normal to the lower right.
        let wall = corners(&[[0.0, 0.0, 0.0], [4.0, 1.0, 0.0], [4.0, 1.0, 2.0], [0.0, 0.0, 2.0]]);
        let mut planes = Vec::new();
        cut(&wall, 1.0, &mut planes);
        let plane = |facing, offset, start, end| Plane { facing, offset, start, end };
        assert_eq!(
            planes,
            [
                plane(Facing::MinusY, 0.5, 0.0, 4.0),
                plane(Facing::PlusX, 0.0, 0.0, 0.5),
                plane(Facing::PlusX, 4.0, 0.5, 1.0),
            ]
        );
    }
}
