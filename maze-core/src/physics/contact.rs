//! Closest point, penetration, push-out and reflection: steps 1 to 4 of the report's collision computation.

use crate::physics::ball::{Ball, BallSpec};
use crate::physics::sorted_planes::{SortedPlanes, is_within};
use crate::physics::tolerance;
use crate::physics::wall::Plane;
use nalgebra::Vector2;

/// A ball that overlaps a plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// What is overlapped.
    pub plane: Plane,
    /// The plane's point nearest to the ball's centre.
    pub closest: Vector2<f64>,
    /// From the centre to `closest` (units), less than the radius.
    pub distance: f64,
    /// Radius - distance (units), 0 or more.
    pub penetration: f64,
}

/// Step 1: the plane's point nearest to `centre`.
///
/// The report takes D = centre - plane centre and clamps it to the plane's extent; clamping the coordinate itself is the
/// same point without the rounding of the two additions.
pub fn closest_point(centre: Vector2<f64>, plane: &Plane) -> Vector2<f64> {
    let axis = plane.facing.axis();
    let along = centre[1 - axis];
    let mut closest = Vector2::zeros();
    closest[axis] = plane.offset;
    closest[1 - axis] = if along < plane.start {
        plane.start
    } else if plane.end < along {
        plane.end
    } else {
        along
    };
    closest
}

/// Steps 2 and 3: the contact, if the closest point is nearer than the radius.
pub fn find(centre: Vector2<f64>, radius: f64, plane: &Plane) -> Option<Contact> {
    let closest = closest_point(centre, plane);
    let from_closest = centre - closest;
    // The very test of the search: what it finds is a contact.
    is_within(from_closest.x, from_closest.y, radius).then(|| {
        let distance = from_closest.norm();
        Contact { plane: *plane, closest, distance, penetration: radius - distance }
    })
}

/// Of the planes that a circle overlaps by more than a touch, the one that is overlapped most deeply.
pub(crate) fn deepest(planes: &SortedPlanes, centre: Vector2<f64>, radius: f64) -> Option<Contact> {
    let touch = tolerance::touch(radius, centre);
    planes
        .planes_within(centre, radius)
        .filter_map(|plane| find(centre, radius, &plane))
        .filter(|contact| touch < contact.penetration)
        .max_by(|a, b| a.penetration.total_cmp(&b.penetration))
}

impl Contact {
    /// Step 3: out of the plane by the penetration, along the plane's normal.
    ///
    /// At a corner the normal is not the direction of contact, so this pushes too little: a weakness of the method.
    pub fn pushed_out(&self, centre: Vector2<f64>) -> Vector2<f64> {
        centre + self.plane.facing.normal() * self.penetration
    }

    /// Step 4: the velocity mirrored about the plane's normal, its normal component times the restitution.
    ///
    /// A ball that already moves away keeps its velocity.
    pub fn reflected(&self, velocity: Vector2<f64>, restitution: f64) -> Vector2<f64> {
        let axis = self.plane.facing.axis();
        let mut reflected = velocity;
        if velocity[axis] * self.plane.facing.sign() < 0.0 {
            reflected[axis] = -restitution * velocity[axis];
        }
        reflected
    }

    /// Steps 3 and 4 on a ball.
    pub fn respond(&self, ball: Ball, spec: &BallSpec) -> Ball {
        Ball {
            position: self.pushed_out(ball.position),
            velocity: self.reflected(ball.velocity, spec.restitution),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::wall::Facing;

    const WALL: Plane = Plane { facing: Facing::MinusX, offset: 5.0, start: -1.0, end: 1.0 };

    #[test]
    fn step_1_closest_point_lies_within_the_extent() {
        assert_eq!(closest_point(Vector2::new(4.0, 0.5), &WALL), Vector2::new(5.0, 0.5));
        assert_eq!(closest_point(Vector2::new(4.0, 3.0), &WALL), Vector2::new(5.0, 1.0));
        assert_eq!(closest_point(Vector2::new(6.0, -3.0), &WALL), Vector2::new(5.0, -1.0));
    }

    #[test]
    fn step_2_collision_needs_a_distance_below_the_radius() {
        assert!(find(Vector2::new(4.5, 0.0), 0.5, &WALL).is_none());
        assert!(find(Vector2::new(4.6, 0.0), 0.5, &WALL).is_some());
    }

    #[test]
    fn step_3_penetration_is_pushed_out_along_the_normal() {
        let contact = find(Vector2::new(4.75, 0.25), 0.5, &WALL).unwrap();
        assert_eq!((contact.distance, contact.penetration), (0.25, 0.25));
        assert_eq!(contact.pushed_out(Vector2::new(4.75, 0.25)), Vector2::new(4.5, 0.25));
    }

    #[test]
    fn step_4_normal_velocity_is_mirrored_and_scaled_by_the_restitution() {
        let contact = find(Vector2::new(4.75, 0.0), 0.5, &WALL).unwrap();
        assert_eq!(contact.reflected(Vector2::new(2.0, 3.0), 0.8), Vector2::new(-1.6, 3.0));
        assert_eq!(contact.reflected(Vector2::new(-2.0, 3.0), 0.8), Vector2::new(-2.0, 3.0), "moving away");
    }
}
