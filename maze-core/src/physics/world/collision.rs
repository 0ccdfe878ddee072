//! What a hit does to the velocity, where the ball may touch a second feature at the same time.

use crate::physics::tolerance::{PASSING, TANGENT};
use nalgebra::Vector2;

/// Most reflections of one collision. A ball in the mouth of a wedge bounces between its two sides without a time between
/// the bounces: without loss some π / angle times, and with loss fewer, or without end. After this many it is stopped.
const MAX_REFLECTIONS: u32 = 4096;

/// What is left of the speed (a fraction) when it has decayed to rest (inelastic collapse): far above where squares leave the range of floats.
const COLLAPSED: f64 = 1.0e-40;

/// One of the features that a collision takes place at.
#[derive(Clone, Copy, Debug)]
pub(super) struct Surface {
    /// From the feature to the centre.
    pub(super) normal: Vector2<f64>,
    /// A rebound that is slower than this ends in rest (units/s); 0 where the acceleration does not push the ball onto this feature.
    pub(super) rest_speed: f64,
    /// Whether the ball was supported by it before.
    pub(super) is_active: bool,
}

/// The velocity after a collision, and on which of the surfaces the ball rests.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Outcome {
    pub(super) velocity: Vector2<f64>,
    pub(super) rests_on: [bool; 2],
}

/// The velocity with its component along the normal replaced. Exact where the normal is an axis.
fn with_normal_speed(velocity: Vector2<f64>, normal: Vector2<f64>, speed: f64) -> Vector2<f64> {
    velocity - normal * velocity.dot(&normal) + normal * speed
}

/// Reflects a velocity about the surface that is hit, and, where that drives the ball into the other surface, about both in
/// turn until it leads away from both.
///
/// In a narrow wedge the turns do not end (inelastic collapse): each takes a fraction of the speed, and the limit is rest.
/// Between opposite surfaces only the motion along the normal ends so. Where `is_held`, the acceleration holds a ball at rest
/// between both surfaces, and one that leaves so slowly that it would rise above neither stays there.
pub(super) fn collide(
    velocity: Vector2<f64>,
    hit: &Surface,
    other: Option<&Surface>,
    is_held: bool,
    restitution: f64,
) -> Outcome {
    let Some(other) = other else {
        let rebound = restitution * -velocity.dot(&hit.normal);
        let rests = rebound < hit.rest_speed;
        let velocity = with_normal_speed(velocity, hit.normal, if rests { 0.0 } else { rebound });
        return Outcome { velocity, rests_on: [rests, false] };
    };
    let surfaces = [hit, other];
    let mut rests_on = [false, other.is_active];
    let mut velocity = velocity;
    let mut was_plastic = false;
    // What a reflection leaves along its normal by rounding.
    let rounding = 4.0 * f64::EPSILON * velocity.norm();
    let least = COLLAPSED * velocity.amax();
    for n_reflections in 0..=MAX_REFLECTIONS {
        let approach = surfaces.map(|surface| -velocity.dot(&surface.normal));
        let slowest = TANGENT * velocity.norm();
        // The hit itself always counts, however slow it is; then the surface that is approached faster.
        let index = usize::from(n_reflections != 0 && approach[0] < approach[1]);
        if n_reflections != 0 && approach[index] <= slowest {
            break;
        }
        let rebound = restitution * approach[index];
        let is_plastic = rebound < surfaces[index].rest_speed;
        // Two consecutive reflections without a rebound are the inelastic collapse: the ball is driven into both surfaces.
        let collapses = (is_plastic && was_plastic && slowest < approach[index])
            || (n_reflections != 0 && velocity.amax() <= least);
        if collapses || n_reflections == MAX_REFLECTIONS {
            rests_on = [rests_on[0] || collapses, rests_on[1] || collapses];
            velocity = collapsed(velocity, surfaces);
            break;
        }
        velocity =
            with_normal_speed(velocity, surfaces[index].normal, if is_plastic { 0.0 } else { rebound });
        rests_on[index] = is_plastic;
        was_plastic = is_plastic;
    }
    let outcome = settled(velocity, rounding, surfaces, rests_on);
    if is_held && surfaces.iter().all(|surface| outcome.velocity.norm() <= surface.rest_speed) {
        return Outcome { velocity: Vector2::zeros(), rests_on: [true; 2] };
    }
    outcome
}

/// A hit between two opposite features without play, on a third that supports the ball: a motion across the gap has nowhere to go,
/// and what drives the ball into its support ends.
pub(super) fn jam(velocity: Vector2<f64>, hit: Vector2<f64>, support: Vector2<f64>) -> Outcome {
    let along = with_normal_speed(velocity, hit, 0.0);
    let (rise, slowest) = (along.dot(&support), TANGENT * along.norm());
    let velocity = if rise < -slowest { Vector2::zeros() } else { along };
    Outcome { velocity, rests_on: [false, rise <= slowest] }
}

/// Whether two normals are opposite, within [`PASSING`].
pub(super) fn are_opposite(one: Vector2<f64>, two: Vector2<f64>) -> bool {
    one.dot(&two) < 0.0 && one.perp(&two).abs() < PASSING
}

/// Whether the normals lie along one line.
fn are_parallel([one, two]: [&Surface; 2]) -> bool {
    one.normal.perp(&two.normal).abs() < PASSING
}

/// What the reflections tend to: rest, and between opposite surfaces the motion along them.
fn collapsed(velocity: Vector2<f64>, surfaces: [&Surface; 2]) -> Vector2<f64> {
    match are_parallel(surfaces) {
        true => with_normal_speed(velocity, surfaces[0].normal, 0.0),
        false => Vector2::zeros(),
    }
}

/// Keeps the surfaces that the ball does not move away from, and takes the rounding along their normals from the velocity.
fn settled(velocity: Vector2<f64>, rounding: f64, surfaces: [&Surface; 2], rests_on: [bool; 2]) -> Outcome {
    let slowest = TANGENT * velocity.norm() + rounding;
    let [hit, other] = surfaces;
    let stays = |index: usize| rests_on[index] && velocity.dot(&surfaces[index].normal).abs() <= slowest;
    let mut rests_on = [stays(0), stays(1)];
    let is_opposite = are_opposite(hit.normal, other.normal);
    // In a gap without play a motion across it has nowhere to go.
    let velocity = match is_opposite && velocity.dot(&hit.normal).abs() <= slowest {
        true => with_normal_speed(velocity, hit.normal, 0.0),
        false => velocity,
    };
    if rests_on == [true; 2] {
        if !are_parallel(surfaces) {
            return Outcome { velocity: Vector2::zeros(), rests_on };
        }
        // Two features in one direction, as neighbours on a floor: the one that is hit supports the ball, the other one is dropped.
        rests_on[1] = is_opposite;
    }
    let velocity = match rests_on {
        [true, _] => with_normal_speed(velocity, hit.normal, 0.0),
        [false, true] => with_normal_speed(velocity, other.normal, 0.0),
        [false, false] => velocity,
    };
    Outcome { velocity, rests_on }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn surface(x: f64, y: f64) -> Surface {
        Surface { normal: Vector2::new(x, y).normalize(), rest_speed: 0.0, is_active: false }
    }

    #[test]
    fn a_face_scales_the_normal_speed_and_keeps_the_other() {
        let outcome = collide(Vector2::new(3.0, -2.0), &surface(0.0, 1.0), None, false, 0.8);
        assert_eq!(outcome, Outcome { velocity: Vector2::new(3.0, 1.6), rests_on: [false; 2] });
    }

    #[test]
    fn a_wall_that_is_hit_by_a_ball_on_the_floor_leaves_it_on_the_floor() {
        let floor = Surface { is_active: true, ..surface(0.0, 1.0) };
        let outcome = collide(Vector2::new(2.0, 0.0), &surface(-1.0, 0.0), Some(&floor), false, 0.5);
        assert_eq!(outcome, Outcome { velocity: Vector2::new(-1.0, 0.0), rests_on: [false, true] });
    }

    #[test]
    fn without_loss_a_ball_leaves_a_wedge_of_a_thousandth_as_fast_as_it_came() {
        for angle in [1.5, 1.0, 0.3, 0.01, 0.001_f64] {
            let (rise, run) = (angle, 1.0 - angle * angle / 4.0);
            let floor = Surface { is_active: true, ..surface(0.0, 1.0) };
            let roof = surface(-rise, -run);
            let before = Vector2::new(1.0, 0.0);
            let after = collide(before, &roof, Some(&floor), false, 1.0).velocity;
            assert!((after.norm() - 1.0).abs() < 1.0e-12, "{angle}: {after}");
            assert!(-1.0e-9 < after.dot(&roof.normal) && -1.0e-9 < after.y, "{angle}: {after}");
        }
    }

    #[test]
    fn with_loss_a_narrow_wedge_stops_the_ball_and_a_wide_one_throws_it_back() {
        let floor = Surface { is_active: true, ..surface(0.0, 1.0) };
        for (rise, stops) in [(1.0, false), (0.3, false), (0.05, true), (1.0e-3, true), (1.0e-5, true)] {
            let after =
                collide(Vector2::new(1.0, 0.0), &surface(-rise, -1.0), Some(&floor), false, 0.8).velocity;
            assert_eq!(after.norm() < 1.0e-6, stops, "{rise}: {after}");
            assert!(after.norm() < 1.0);
        }
    }

    #[test]
    fn a_slow_ball_comes_to_rest_between_two_surfaces() {
        let floor = Surface { is_active: true, rest_speed: 1.0e-4, ..surface(0.0, 1.0) };
        let roof = Surface { rest_speed: 1.0e-4, ..surface(-1.0, -1.0) };
        let outcome = collide(Vector2::new(1.0e-5, 0.0), &roof, Some(&floor), false, 0.8);
        assert_eq!(outcome, Outcome { velocity: Vector2::zeros(), rests_on: [true; 2] });
    }

    #[test]
    fn between_opposite_surfaces_the_motion_along_them_goes_on() {
        let floor = Surface { is_active: false, ..surface(0.0, 1.0) };
        for restitution in [0.0, 0.8, 1.0] {
            let after =
                collide(Vector2::new(2.0, 1.0), &surface(0.0, -1.0), Some(&floor), false, restitution);
            assert_eq!(after.velocity.x, 2.0);
            assert!(after.velocity.y.abs() < 1.0e-9);
        }
    }

    #[test]
    fn no_collision_gains_energy() {
        for n in 0..360 {
            let angle = f64::from(n).to_radians();
            #[allow(clippy::disallowed_methods, reason = "a test may use trigonometry")]
            let hit = surface(angle.cos(), angle.sin());
            for restitution in [0.0, 0.5, 0.8, 1.0] {
                for before in [Vector2::new(1.0, -1.0), Vector2::new(-2.0, 0.0), Vector2::new(0.3, -0.1)] {
                    if before.dot(&hit.normal) < 0.0 {
                        let floor = surface(0.0, 1.0);
                        let after = collide(before, &hit, Some(&floor), false, restitution).velocity;
                        assert!(after.norm() <= before.norm() * (1.0 + 1.0e-12));
                    }
                }
            }
        }
    }
}
