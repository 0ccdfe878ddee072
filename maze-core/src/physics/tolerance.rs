//! Every tolerance that decides about contacts, in one place.
//!
//! Lengths are fractions of the ball's radius r plus a few ulps of its largest coordinate: so a scene scaled by a power of two
//! gives the scaled motion, to the bit. What is not a length is a ratio.
//!
//! The order matters: `GRAZE < SNAP < TOUCH < OVERLAP`. What a search ignores as a graze (`GRAZE`) is a fortieth of what is taken
//! for a contact afterwards (`SNAP`), that a fortieth of what counts as lying behind a face (`TOUCH`), and that a third of what
//! is never returned (`OVERLAP`).

use crate::physics::numbers::greater;
use nalgebra::Vector2;

/// Depth (radii) up to which a path that passes a point only grazes it. A graze has a double root, which rounding (1e-16 r,
/// 1e-14 r a hundred radii away) would place anywhere within 1e-7 s or nowhere.
const GRAZE: f64 = 2.0e-13;

/// Gap (radii) up to which a feature counts as touched by a ball that moves towards it: many a `GRAZE`, so that what was
/// ignored as a graze is found as a contact.
const SNAP: f64 = 8.0e-12;

/// Overlap (radii) up to which a ball touches a face or a point from outside; one that is deeper lies behind it.
/// Some 40 [`SNAP`]s, and a third of [`OVERLAP`].
const TOUCH: f64 = 3.0e-10;

/// Overlap (radii) that is never returned: the promise of 1e-9, less rounding near the origin.
const OVERLAP: f64 = 9.0e-10;

/// A bounce that would rise less than this (radii) ends in rest: large against rounding 10⁵ radii from the origin (1e-11 r),
/// small against a pixel (1e-2).
const REST_APEX: f64 = 3.0e-9;

/// A velocity whose component along a contact normal is less than this fraction of it is a motion along the feature: the
/// rounding of a ball that has just left it or slides by (1e-16, multiplied by the distance in radii). Past a point it leads no
/// deeper than half its square, 5e-21 r.
pub(crate) const TANGENT: f64 = 1.0e-10;

/// A point that is approached slower than this fraction of the speed is passed, unless the acceleration presses the ball onto
/// it: the path leads no deeper than half its square, 1.3e-13 r, which is a graze. For the same reason two contact normals whose
/// cross product is less than this are opposite: a gap that is narrower than the ball by a graze is passed.
pub(crate) const PASSING: f64 = 5.0e-7;

/// A push out of a contact's cone by less than this fraction of the acceleration is rounding (18 times that of one operation):
/// the ball stays at rest.
pub(crate) const CONE: f64 = 4.0e-15;

/// A direction on an arc that lies behind the ball by this little (sine of half the angle) is where it is: some roundings of 1.
pub(crate) const ARC_ROUNDING: f64 = 8.0 * f64::EPSILON;

/// An energy this small against that of the whole arc is taken for one that just passes the top: a ball at exactly the speed
/// that would come to rest there needs infinitely long.
pub(crate) const LEAST_ENERGY: f64 = 1.0e-200;

/// Rounding of a coordinate (units): two to four ulps.
fn rounding(position: Vector2<f64>) -> f64 {
    let (x, y) = (position.x.abs(), position.y.abs());
    2.0 * f64::EPSILON * greater(x, y)
}

/// Depth (units) up to which a path only grazes a point.
pub(crate) fn graze(radius: f64, position: Vector2<f64>) -> f64 {
    GRAZE * radius + rounding(position)
}

/// Gap (units) up to which a feature is touched.
pub(crate) fn snap(radius: f64, position: Vector2<f64>) -> f64 {
    SNAP * radius + 2.0 * rounding(position)
}

/// Overlap (units) up to which a ball touches from outside.
pub(crate) fn touch(radius: f64, position: Vector2<f64>) -> f64 {
    TOUCH * radius + 3.0 * rounding(position)
}

/// Overlap (units) that is never returned.
pub(crate) fn overlap(radius: f64, position: Vector2<f64>) -> f64 {
    OVERLAP * radius + 4.0 * rounding(position)
}

/// The speed (units/s) of a bounce that rises up to the rest bound against a pressing acceleration (units/s², 0 or more).
///
/// The bound is some ulps at least: a ball that is put onto a face within an ulp falls from there again and again.
pub(crate) fn rest_speed(radius: f64, position: Vector2<f64>, pressing: f64) -> f64 {
    (2.0 * (REST_APEX * radius + 8.0 * rounding(position)) * pressing).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tolerances_keep_their_order_near_and_far() {
        for (radius, far) in [(0.35, 0.0), (0.35, 1.0e5), (1.0e-3, 1.0e5), (1.0e3, 1.0)] {
            let position = Vector2::new(far, -0.5 * far);
            let all = [graze, snap, touch, overlap].map(|tolerance| tolerance(radius, position));
            assert!(all.is_sorted_by(|a, b| a < b), "radius {radius} at {far}: {all:?}");
        }
    }

    #[test]
    fn they_scale_with_the_scene() {
        let position = Vector2::new(3.0, -17.1);
        for tolerance in [graze, snap, touch, overlap] {
            assert_eq!(tolerance(0.35 * 8.0, position * 8.0), tolerance(0.35, position) * 8.0);
        }
        assert_eq!(rest_speed(0.35 * 8.0, position * 8.0, 4.0 * 8.0), rest_speed(0.35, position, 4.0) * 8.0);
    }
}
