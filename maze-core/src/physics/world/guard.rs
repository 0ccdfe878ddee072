//! What puts a ball outside of walls that it is in: at the start, where it was placed there, and at the end of a tick, where
//! that would be a fault of the engine.

use super::events::Events;
use crate::physics::contact;
use crate::physics::tick::Observer;
use crate::physics::tolerance;
use crate::physics::wall::Plane;
use nalgebra::Vector2;

/// Most walls a ball that starts inside of them is pushed out of, one after the other.
const MAX_PUSH_OUTS: u32 = 16;

impl<O: Observer + ?Sized> Events<'_, O> {
    /// Puts a ball that starts inside a wall outside of it, out of the deepest overlap first; returns the deepest (units).
    pub(super) fn depenetrate(&mut self) -> f64 {
        let radius = self.world.radius();
        let mut deepest_of_all = 0.0;
        for _ in 0..MAX_PUSH_OUTS {
            let centre = self.state.ball.position;
            let Some(contact) = contact::deepest(&self.world.planes, centre, radius) else { break };
            let facing = contact.plane.facing;
            let front = (centre[facing.axis()] - contact.plane.offset) * facing.sign();
            // In front, away from the closest point; behind, through the face.
            let away = (centre - contact.closest).try_normalize(0.0).filter(|_| 0.0 <= front);
            self.state.ball.position = contact.closest + away.unwrap_or(facing.normal()) * radius;
            if deepest_of_all < contact.penetration {
                deepest_of_all = contact.penetration;
            }
        }
        deepest_of_all
    }

    /// Checks the state that is about to be returned by a plain query that uses neither contacts nor events: a ball that
    /// came from the front (it was at `from` at the start of the tick), and is deeper in a face than it may be, is put outside, and
    /// that is reported.
    pub(super) fn guard(&mut self, from: Vector2<f64>) {
        let (centre, radius) = (self.state.ball.position, self.world.radius());
        let within = radius - tolerance::overlap(radius, centre);
        let velocity = self.state.ball.velocity;
        let is_fault = |plane: &Plane| !passes_from_behind(plane, [from, centre], velocity, radius);
        if self.world.planes.any_within(centre, within, is_fault) {
            self.log.tick.corrected_overlap = self.depenetrate();
            self.state.contacts.clear();
        }
    }
}

/// Whether a ball that overlaps a face is one that passes it from behind. A face has no back.
fn passes_from_behind(
    plane: &Plane,
    [from, to]: [Vector2<f64>; 2],
    velocity: Vector2<f64>,
    radius: f64,
) -> bool {
    let axis = plane.facing.axis();
    let [before, after] = [from, to].map(|centre| (centre[axis] - plane.offset) * plane.facing.sign());
    let was_outside =
        radius - tolerance::touch(radius, from) <= (from - contact::closest_point(from, plane)).norm();
    if !was_outside {
        // On its way through; one that does not move on was placed where it has no room.
        return before < 0.0 || 0.0 < velocity[axis] * plane.facing.sign();
    }
    if 0.0 <= before || after < 0.0 {
        return before < 0.0;
    }
    // Now in front: either through the face, or around one of its ends.
    let along = from[1 - axis] + (to[1 - axis] - from[1 - axis]) * (before / (before - after));
    plane.start <= along && along <= plane.end
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::ball::{Ball, BallSpec};
    use crate::physics::sorted_planes::SortedPlanes;
    use crate::physics::wall::Facing;
    use crate::physics::world::{BallState, World};
    use std::sync::Arc;

    /// A ball at rest on a floor, with a wall beside it.
    fn resting() -> (World, BallState) {
        let planes = [
            Plane { facing: Facing::PlusY, offset: 0.0, start: -5.0, end: 5.0 },
            Plane { facing: Facing::PlusX, offset: -0.35, start: 0.0, end: 5.0 },
        ];
        let planes = Arc::new(SortedPlanes::new(planes).unwrap());
        let world = World::new(planes, BallSpec::default(), 0.03).unwrap().without_cache();
        let mut state = BallState::new(Ball::at(Vector2::new(0.0, 0.35))).unwrap();
        world.tick(&mut state, Vector2::new(-1.0, -4.0), &mut ()).unwrap();
        (world, state)
    }

    #[test]
    fn a_ball_that_a_fault_has_put_into_a_wall_is_put_outside_and_that_is_reported() {
        let (acceleration, rest) = (Vector2::new(-1.0, -4.0), Vector2::new(0.0, 0.35));
        for depth in [0.0, 1.0e-10, 1.0e-8, 1.0e-3, 0.2] {
            let (world, mut state) = resting();
            // As no tick does it.
            state.ball.position.x -= depth;
            let mut nobody = ();
            let mut events = Events::new(&world, &mut state, acceleration, &mut nobody);
            events.guard(rest);
            let tick = events.log.tick;
            let found = if depth < 1.0e-9 { 0.0 } else { depth };
            assert!((tick.corrected_overlap - found).abs() < 1.0e-12, "{depth}: {tick:?}");
            assert!((state.ball.position - rest).norm() <= depth - found + 1.0e-12);
            // And the ball rests again.
            assert_eq!(world.tick(&mut state, acceleration, &mut ()).unwrap().corrected_overlap, 0.0);
            assert!((state.ball.position - rest).norm() <= depth - found + 1.0e-12);
        }
    }

    #[test]
    fn a_ball_that_comes_from_behind_a_face_passes_it() {
        // Along a wall that supports it, so that the guard checks every tick.
        let floor = Plane { facing: Facing::PlusY, offset: 0.0, start: -5.0, end: 5.0 };
        let wall = Plane { facing: Facing::PlusX, offset: -0.35, start: -5.0, end: 5.0 };
        let planes = Arc::new(SortedPlanes::new([floor, wall]).unwrap());
        for speed in [2.0, 20.0] {
            let ball = Ball { position: Vector2::new(0.0, -1.0), velocity: Vector2::new(0.0, speed) };
            let world = World::new(planes.clone(), BallSpec::default(), 0.003).unwrap().without_cache();
            let mut state = BallState::new(ball).unwrap();
            for _ in 0..60 {
                let tick = world.tick(&mut state, Vector2::new(-1.0, 0.0), &mut ()).unwrap();
                assert_eq!(tick.corrected_overlap, 0.0);
            }
            assert_eq!(state.contacts.iter().count(), 1);
            assert!((state.ball.position.y + 1.0 - speed * 0.18).abs() < 1.0e-12);
        }
    }

    #[test]
    fn a_ball_that_is_placed_where_it_has_no_room_is_reported_in_every_tick() {
        let planes = [(Facing::PlusY, 0.0), (Facing::MinusY, 0.5)].map(|(facing, offset)| Plane {
            facing,
            offset,
            start: -5.0,
            end: 5.0,
        });
        let planes = Arc::new(SortedPlanes::new(planes).unwrap());
        let world = World::new(planes, BallSpec::default(), 0.03).unwrap();
        let mut state = BallState::new(Ball::at(Vector2::new(0.0, 0.25))).unwrap();
        for _ in 0..9 {
            let tick = world.tick(&mut state, Vector2::new(1.0, -4.0), &mut ()).unwrap();
            assert!(0.1 < tick.corrected_overlap, "{tick:?}");
        }
    }

    #[test]
    fn a_ball_that_comes_around_the_end_of_a_face_does_not_pass_it() {
        let face = Plane { facing: Facing::PlusY, offset: 0.0, start: 0.0, end: 5.0 };
        let up = Vector2::new(0.0, 1.0);
        let passes =
            |from: [f64; 2], to: [f64; 2]| passes_from_behind(&face, [from.into(), to.into()], up, 0.35);
        assert!(passes([1.0, -1.0], [1.0, 0.1]) && passes([1.0, -0.1], [1.0, 0.2]));
        assert!(!passes([-1.0, -0.5], [0.1, 0.3]) && !passes([1.0, 0.5], [1.0, -0.1]));
    }
}
