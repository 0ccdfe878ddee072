//! The arcball: dragging a point on a glass sphere over the window turns what is inside.
//!
//! Ken Shoemake, "ARCBALL: A User Interface for Specifying Three-Dimensional Orientation Using a Mouse", Graphics
//! Interface 1992. A drag from p to q turns by the quaternion (p . q, p x q): twice the arc, so that a drag that closes
//! on itself undoes itself.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

/// Sphere radius as a part of the window's diagonal. Half of it puts the tilt's limit of 20 degrees, which is 10
/// degrees of arc, at 128 pixels of drag in a 1280 x 720 window.
const RADIUS_PART: f64 = 0.5;

/// The point of the unit sphere under a pixel, in view axes (x right, y up, z towards the eye).
///
/// Beyond the sphere's rim the nearest rim point. `None` for a window without area.
pub(crate) fn sphere_point(size: [u32; 2], pixel: [f64; 2]) -> Option<Vector3<f64>> {
    let [width, height] = size.map(f64::from);
    let radius = RADIUS_PART * (width * width + height * height).sqrt();
    if radius == 0.0 {
        return None;
    }
    let x = (pixel[0] - width / 2.0) / radius;
    let y = (height / 2.0 - pixel[1]) / radius;
    let squared = x * x + y * y;
    Some(match squared < 1.0 {
        true => Vector3::new(x, y, (1.0 - squared).sqrt()),
        false => Vector3::new(x, y, 0.0) / squared.sqrt(),
    })
}

/// The rotation of a drag from one point of the sphere to another.
pub(crate) fn rotation(from: Vector3<f64>, to: Vector3<f64>) -> UnitQuaternion<f64> {
    UnitQuaternion::new_normalize(Quaternion::from_parts(from.dot(&to), from.cross(&to)))
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: [u32; 2] = [1280, 720];

    #[test]
    fn the_middle_is_the_front_and_far_outside_is_the_rim() {
        assert_eq!(sphere_point(SIZE, [640.0, 360.0]), Some(Vector3::z()));
        let rim = sphere_point(SIZE, [1.0e6, 360.0]).unwrap();
        assert!((rim - Vector3::x()).norm() < 1.0e-12);
        assert_eq!(sphere_point([0, 0], [0.0, 0.0]), None);
    }

    #[test]
    fn a_drag_turns_by_twice_its_arc() {
        let from = Vector3::z();
        let to = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 0.1) * from;
        let turned = rotation(from, to);
        assert!((turned.angle() - 0.2).abs() < 1.0e-12);
        assert!((turned.axis().unwrap().into_inner() - Vector3::y()).norm() < 1.0e-12);
    }

    #[test]
    fn a_closed_drag_undoes_itself() {
        let points = [[640.0, 360.0], [700.0, 300.0], [600.0, 250.0], [640.0, 360.0]];
        let points = points.map(|pixel| sphere_point(SIZE, pixel).unwrap());
        // Shoemake's arcball depends on the ends of a drag alone: from the first to the last point.
        assert!(rotation(points[0], points[3]).angle() < 1.0e-12);
    }
}
