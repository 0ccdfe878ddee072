//! A scene's mirror image, and the scene turned by a quarter: points and planes.

use maze_core::{Facing, Plane};
use nalgebra::Vector2;

/// A way to look at a scene that must not change the motion.
pub(crate) struct Image {
    pub(crate) point: fn(Vector2<f64>) -> Vector2<f64>,
    pub(crate) plane: fn(Plane) -> Plane,
}

/// x becomes -x.
pub(crate) const MIRRORED: Image = Image {
    point: |v| Vector2::new(-v.x, v.y),
    plane: |p| match p.facing {
        Facing::PlusX => Plane { facing: Facing::MinusX, offset: -p.offset, ..p },
        Facing::MinusX => Plane { facing: Facing::PlusX, offset: -p.offset, ..p },
        _ => Plane { start: -p.end, end: -p.start, ..p },
    },
};

/// x becomes y.
pub(crate) const TURNED: Image = Image {
    point: |v| Vector2::new(-v.y, v.x),
    plane: |p| match p.facing {
        Facing::PlusX => Plane { facing: Facing::PlusY, start: -p.end, end: -p.start, ..p },
        Facing::MinusX => Plane { facing: Facing::MinusY, start: -p.end, end: -p.start, ..p },
        Facing::PlusY => Plane { facing: Facing::MinusX, offset: -p.offset, ..p },
        Facing::MinusY => Plane { facing: Facing::PlusX, offset: -p.offset, ..p },
    },
};
