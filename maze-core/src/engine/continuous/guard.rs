//! What puts a ball outside of walls that it is in: at the start, where it was placed there, and at the end of a tick, where
//! that would be a fault of the engine.

use super::super::{Log, Observer};
use super::Continuous;
use crate::contact;
use crate::plane::Plane;
use crate::tolerance;
use nalgebra::Vector2;

/// Most walls a ball that starts inside of them is pushed out of, one after the other.
const MAX_RECOVERIES: u32 = 16;

impl Continuous {
    /// Puts a ball that starts inside a wall outside of it, out of the deepest overlap first; returns the deepest (units).
    pub(super) fn depenetrate(&mut self) -> f64 {
        let mut deepest_of_all = 0.0;
        for _ in 0..MAX_RECOVERIES {
            let centre = self.ball.position;
            let radius = self.radius();
            let touch = tolerance::touch(radius, centre);
            let deepest = self
                .planes
                .planes_within(centre, radius)
                .filter_map(|plane| contact::find(centre, radius, &plane))
                .filter(|contact| touch < contact.penetration)
                .max_by(|a, b| a.penetration.total_cmp(&b.penetration));
            let Some(contact) = deepest else { break };
            let facing = contact.plane.facing;
            let front = (centre[facing.axis()] - contact.plane.offset) * facing.sign();
            // In front, away from the closest point; behind, through the face.
            let away = (centre - contact.closest).try_normalize(0.0).filter(|_| 0.0 <= front);
            self.ball.position = contact.closest + away.unwrap_or(facing.normal()) * radius;
            if deepest_of_all < contact.penetration {
                deepest_of_all = contact.penetration;
            }
        }
        deepest_of_all
    }

    /// Checks the state that is about to be returned by a plain query that knows nothing of contacts and events: a ball that
    /// came from outside and is deeper in a wall than it may be is put outside, and that is reported.
    pub(super) fn guard<O: Observer + ?Sized>(&mut self, from: Vector2<f64>, log: &mut Log<O>) {
        let (centre, radius) = (self.ball.position, self.radius());
        // A face has no back: whoever comes from behind it passes.
        let is_in_front = |centre: Vector2<f64>, plane: &Plane| {
            0.0 <= (centre[plane.facing.axis()] - plane.offset) * plane.facing.sign()
        };
        let within = radius - tolerance::overlap(radius, centre);
        let is_inside = |plane: &Plane| is_in_front(centre, plane) || is_in_front(from, plane);
        if self.planes.any_within(centre, within, is_inside) {
            log.tick.corrected_overlap = self.depenetrate();
            self.contacts.clear();
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::ball::{Ball, BallSpec};
    use crate::engine::{Continuous, Engine};
    use crate::plane::{Facing, Plane};
    use crate::sorted_planes::SortedPlanes;
    use nalgebra::Vector2;
    use std::sync::Arc;

    /// A ball at rest on a floor, with a wall beside it.
    fn resting() -> Continuous {
        let planes = [
            Plane { facing: Facing::PlusY, offset: 0.0, start: -5.0, end: 5.0 },
            Plane { facing: Facing::PlusX, offset: -0.35, start: 0.0, end: 5.0 },
        ];
        let planes = Arc::new(SortedPlanes::new(planes).unwrap());
        let start = Ball::at(Vector2::new(0.0, 0.35));
        let mut engine = Continuous::new(planes, BallSpec::default(), start, 0.03).unwrap().without_cache();
        engine.tick(Vector2::new(-1.0, -4.0)).unwrap();
        engine
    }

    #[test]
    fn a_ball_that_a_fault_has_put_into_a_wall_is_put_outside_and_that_is_reported() {
        let pull = Vector2::new(-1.0, -4.0);
        for depth in [1.0e-8, 1.0e-3, 0.2] {
            let mut engine = resting();
            assert_eq!(engine.tick(pull).unwrap().corrected_overlap, 0.0);
            // As no tick does it: two contacts that do not know of it.
            engine.ball.position.x -= depth;
            let tick = engine.tick(pull).unwrap();
            assert!((tick.corrected_overlap - depth).abs() < 1.0e-12, "{depth}: {tick:?}");
            assert!((engine.ball().position - Vector2::new(0.0, 0.35)).norm() < 1.0e-12);
            // And the ball rests again.
            assert_eq!(engine.tick(pull).unwrap().corrected_overlap, 0.0);
            assert_eq!(engine.ball(), Ball::at(Vector2::new(0.0, 0.35)));
        }
    }

    #[test]
    fn a_ball_that_comes_from_behind_a_face_passes_it() {
        let floor = Plane { facing: Facing::PlusY, offset: 0.0, start: -5.0, end: 5.0 };
        let planes = Arc::new(SortedPlanes::new([floor]).unwrap());
        let ball = Ball { position: Vector2::new(0.0, -1.0), velocity: Vector2::new(0.0, 2.0) };
        let mut engine = Continuous::new(planes, BallSpec::default(), ball, 0.03).unwrap();
        for _ in 0..50 {
            assert_eq!(engine.tick(Vector2::zeros()).unwrap().corrected_overlap, 0.0);
        }
        assert!((engine.ball().position.y - 2.0).abs() < 1.0e-12);
    }
}
