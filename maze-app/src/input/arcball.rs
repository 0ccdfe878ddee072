//! The arcball: dragging a point on a glass sphere over the window turns what is inside.
//!
//! Ken Shoemake, "ARCBALL: A User Interface for Specifying Three-Dimensional Orientation Using a Mouse", Graphics
//! Interface 1992. A drag over an arc turns by twice the arc, so the tangent of half the turn is that of the arc.
//!
//! Two things differ. The sphere is always taken hold of at its front, wherever the pointer is: near the sphere's outline
//! a drag would turn about the line of sight, which is no tilt. And pixels are projected from the sphere's centre onto
//! the plane that touches its front instead of straight onto the sphere: then there is no outline behind which a drag
//! stops or turns back, and an arc stays below a right angle however far the pointer goes. So a straight drag tilts ever
//! further, in its own direction, from any place in a window of any size. In the middle both are Shoemake's.

use nalgebra::Vector2;

/// Sphere radius as a fraction of the window's diagonal. Half of it puts the tilt's limit of 20 degrees, which is 10
/// degrees of arc, at 129 pixels of drag in a 1280 x 720 window.
const RADIUS_FRACTION: f64 = 0.5;

/// What a drag between two pixels (x right, y down) adds to the half-angle tangents of the tilt (x right, y up).
///
/// Zero for a window without area.
pub(crate) fn drag_tangents(size: [u32; 2], from: [f64; 2], to: [f64; 2]) -> Vector2<f64> {
    let [width, height] = size.map(f64::from);
    let radius = RADIUS_FRACTION * (width * width + height * height).sqrt();
    match 0.0 < radius {
        true => Vector2::new(to[0] - from[0], from[1] - to[1]) / radius,
        false => Vector2::zeros(),
    }
}

/// The same by pixels alone, whatever the window: 1280 x 720 counts as every size.
pub(crate) fn relative_tangents(from: [f64; 2], to: [f64; 2]) -> Vector2<f64> {
    drag_tangents([1280, 720], from, to)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drag_in_the_middle_turns_by_twice_its_arc() {
        let arc = 0.05_f64;
        let radius = 0.5 * 1280_f64.hypot(720.0);
        let tangents = drag_tangents([1280, 720], [640.0, 360.0], [640.0 + radius * arc.sin(), 360.0]);
        // Straight onto the sphere and from its centre differ by the third power of the arc.
        assert!((2.0 * tangents.x.atan() - 2.0 * arc).abs() < 2.0 * arc.powi(3) && tangents.y == 0.0);
        assert!(0.0 < drag_tangents([1280, 720], [0.0, 9.0], [0.0, 8.0]).y, "upwards");
        assert_eq!(drag_tangents([0, 0], [0.0; 2], [5.0; 2]), Vector2::zeros());
    }
}
