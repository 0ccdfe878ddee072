//! Faces sorted into wall, upward and downward; upright faces cut at one height into planes.

use crate::plane::{Facing, Plane};
use crate::polygons::doubled_area;
use nalgebra::Vector3;

/// Cosine of the steepest angle by which a face may lean off its axis and still count as axis-aligned: 1 degree.
/// Modelling by hand leaves 0.1 to 0.6 degrees; mazes that are really slanted start at about 3.
const COS_SNAP: f64 = 0.999_847_7;

/// Faces below this part of the squared size of the mesh have no direction worth trusting.
const DEGENERATE_AREA: f64 = 1.0e-12;

/// What a face is by its normal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum FaceKind {
    /// Upright along x or y.
    Wall(Facing),
    /// Looks up: floor, or the top of a wall.
    Up,
    /// Looks down: never seen, never met.
    Down,
    /// Upright or slanted, along no axis.
    OffAxis,
    /// Without area.
    Degenerate,
}

/// Kind and area of a polygon; `mesh_size` is the largest extent of the mesh.
pub(crate) fn classify(polygon: &[Vector3<f64>], mesh_size: f64) -> (FaceKind, f64) {
    let doubled = doubled_area(polygon);
    let area = doubled.norm() / 2.0;
    if area <= DEGENERATE_AREA * mesh_size * mesh_size {
        return (FaceKind::Degenerate, area);
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
    (kind, area)
}

/// Where an upright polygon crosses the height `z`: one plane for each stretch (a concave polygon may have several).
pub(crate) fn cut(polygon: &[Vector3<f64>], facing: Facing, z: f64) -> Vec<Plane> {
    let along = 1 - facing.axis();
    let next = polygon.iter().cycle().skip(1);
    // Half-open (`< z`), so that a corner exactly at the height is crossed once and not twice.
    let mut crossings: Vec<f64> = polygon
        .iter()
        .zip(next)
        .filter(|(a, b)| (a.z < z) != (b.z < z))
        .map(|(a, b)| a[along] + (b[along] - a[along]) * ((z - a.z) / (b.z - a.z)))
        .collect();
    crossings.sort_by(f64::total_cmp);
    #[allow(clippy::cast_precision_loss, reason = "a polygon has far fewer than 2^53 corners")]
    let n_corners = polygon.len() as f64;
    let offset = polygon.iter().map(|corner| corner[facing.axis()]).sum::<f64>() / n_corners;
    // The mean of equal numbers can be off by a rounding: keep the corners' own value where they agree.
    let first = polygon[0][facing.axis()];
    let offset = if polygon.iter().all(|corner| corner[facing.axis()] == first) { first } else { offset };
    let stretch = |pair: &[f64]| match *pair {
        [start, end] if start < end => Some(Plane { facing, offset, start, end }),
        _ => None,
    };
    crossings.chunks(2).filter_map(stretch).collect()
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
        assert_eq!(classify(&up, 1.0), (FaceKind::Up, 1.0));
        let down: Vec<_> = up.iter().rev().copied().collect();
        assert_eq!(classify(&down, 1.0).0, FaceKind::Down);
        let wall = corners(&[[2.0, 0.0, 0.0], [2.0, 3.0, 0.0], [2.0, 3.0, 1.0]]);
        assert_eq!(classify(&wall, 1.0), (FaceKind::Wall(Facing::PlusX), 1.5));
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
        assert_eq!(cut(&wall, Facing::MinusY, 1.0), [plane(0.0, 1.0), plane(3.0, 4.0)]);
        assert_eq!(cut(&wall, Facing::MinusY, 0.25), [plane(0.0, 4.0)]);
        assert!(cut(&wall, Facing::MinusY, 3.0).is_empty());
    }
}
