//! A ball that rolls around a convex corner it is pressed onto.
//!
//! On the arc the motion is that of a pendulum, which has no closed form: the direction is integrated in small steps
//! (Runge-Kutta of fourth order), the speed follows from the energy and is exact.

use crate::ball::Ball;
use crate::impact::{self, Impact, Path, Touched};
use crate::plane::{Facing, Plane};
use crate::sorted_planes::SortedPlanes;
use nalgebra::Vector2;

/// Longest step on the arc (s). At 1 unit/s around a radius of 0.35 it turns by 0.003, so that a step's error is about
/// 0.003⁵ / 120 = 2e-15.
const STEP_S: f64 = 1.0 / 1024.0;

/// A convex corner, and the faces that meet in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pivot {
    point: Vector2<f64>,
    /// The face across x and the one across y; a face that stands alone has no partner.
    faces: [Option<Plane>; 2],
}

/// Why a roll ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum End {
    /// The time is over.
    Time,
    /// The ball is too fast, or no longer pressed.
    LiftOff,
    /// The arc ends on this face.
    Face(Plane),
    /// Something else was hit; the ball stands at the touch and has not bounced yet.
    Hit(Impact),
}

/// A roll and how it ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Roll {
    pub(super) ball: Ball,
    pub(super) time_s: f64,
    pub(super) end: End,
}

/// Direction from the corner to the centre, and speed along the arc (counter-clockwise).
#[derive(Clone, Copy, Debug)]
struct Arc {
    normal: Vector2<f64>,
    speed: f64,
}

fn tangent(normal: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(-normal.y, normal.x)
}

impl Pivot {
    /// `None` when no face ends at the point.
    pub(super) fn at(planes: &SortedPlanes, point: Vector2<f64>) -> Option<Self> {
        let find =
            |facings: [Facing; 2]| facings.into_iter().find_map(|facing| planes.ending_at(facing, point));
        let faces = [0, 1].map(|axis| find(Facing::across(axis)));
        faces.iter().any(Option::is_some).then_some(Self { point, faces })
    }

    fn ball(&self, arc: Arc, radius: f64) -> Ball {
        Ball { position: self.point + arc.normal * radius, velocity: tangent(arc.normal) * arc.speed }
    }

    /// Rolls for `left_s` at most.
    pub(super) fn roll(
        &self,
        planes: &SortedPlanes,
        ball: Ball,
        radius: f64,
        acceleration: Vector2<f64>,
        left_s: f64,
    ) -> Roll {
        let normal = (ball.position - self.point) / radius;
        let begin = Arc { normal, speed: ball.velocity.dot(&tangent(normal)) };
        let lifts_off = |arc: Arc| 0.0 <= acceleration.dot(&arc.normal) + arc.speed * arc.speed / radius;
        let (mut arc, mut time_s) = (begin, 0.0);
        if lifts_off(arc) {
            return Roll { ball, time_s, end: End::LiftOff };
        }
        // The speed follows from the energy, its direction from the step.
        let with_energy = |normal: Vector2<f64>, direction: f64| {
            let squared =
                begin.speed * begin.speed + 2.0 * radius * acceleration.dot(&(normal - begin.normal));
            let speed = if 0.0 < squared { squared.sqrt() } else { 0.0 };
            Arc { normal, speed: if direction < 0.0 { -speed } else { speed } }
        };
        while time_s < left_s {
            let rest_s = left_s - time_s;
            let step_s = if STEP_S < rest_s { STEP_S } else { rest_s };
            let next = step(arc, radius, acceleration, step_s);
            let next = with_energy(next.normal, next.speed);
            if let Some((hit, normal)) = self.hit(planes, arc, next, radius) {
                let ball = self.ball(with_energy(normal, next.speed), radius);
                return Roll { ball, time_s: time_s + hit.time_s * step_s, end: End::Hit(hit) };
            }
            if let Some((part, face)) = self.end_of_arc(arc.normal, next.normal) {
                let ball = self.ball(with_energy(face.facing.normal(), next.speed), radius);
                return Roll { ball, time_s: time_s + part * step_s, end: End::Face(face) };
            }
            arc = next;
            time_s += step_s;
            if lifts_off(arc) {
                return Roll { ball: self.ball(arc, radius), time_s, end: End::LiftOff };
            }
        }
        Roll { ball: self.ball(arc, radius), time_s: left_s, end: End::Time }
    }

    /// What the ball touches on the arc of a step other than the corner and its own faces: after which part of the step (as
    /// the impact's time), and the direction in which it then stands.
    ///
    /// The chord of the step finds it, with a radius that makes up for the arc's bulge; where on the arc it is touched is
    /// then the intersection of two circles, or of a circle and a line.
    fn hit(&self, planes: &SortedPlanes, from: Arc, to: Arc, radius: f64) -> Option<(Impact, Vector2<f64>)> {
        let chord = (to.normal - from.normal) * radius;
        let bulge = chord.norm_squared() / (4.0 * radius);
        let way = Path {
            position: self.point + from.normal * radius,
            velocity: chord,
            acceleration: Vector2::zeros(),
        };
        let hit = impact::first(planes, &way, radius + bulge, 1.0, Some(self.point))?;
        let near = (way.at(hit.time_s) - self.point) / radius;
        let normal = match hit.touched {
            Touched::Face(face) if self.faces.contains(&Some(face)) => return None,
            Touched::Face(face) => {
                let axis = face.facing.axis();
                let across = (face.offset - self.point[axis]) / radius + face.facing.sign();
                let along = 1.0 - across * across;
                let mut normal = Vector2::zeros();
                normal[axis] = across;
                normal[1 - axis] = if near[1 - axis] < 0.0 { -along.sqrt() } else { along.sqrt() };
                (0.0 <= along).then_some(normal)?
            }
            Touched::Corner(other) => {
                let half = (other - self.point) / (2.0 * radius);
                let height = 1.0 - half.norm_squared();
                let side = tangent(half).try_normalize(0.0)?;
                let side = if side.dot(&near) < 0.0 { -side } else { side };
                (0.0 <= height).then_some(half + side * height.sqrt())?
            }
        };
        // The wider radius may see what this step does not yet reach.
        let turned =
            |normal: Vector2<f64>| from.normal.perp(&normal) * if to.speed < 0.0 { -1.0 } else { 1.0 };
        (turned(normal) <= turned(to.normal)).then_some((hit, normal))
    }

    /// Whether a step leaves the quarter of directions between the two faces: after which part of it, and onto which face.
    fn end_of_arc(&self, from: Vector2<f64>, to: Vector2<f64>) -> Option<(f64, Plane)> {
        [0, 1].into_iter().find_map(|axis| {
            // Where the direction has no part across one face left, the ball stands over the other.
            let (across, over) = (self.faces[axis]?, self.faces[1 - axis]?);
            let sign = across.facing.sign();
            let (before, after) = (from[axis] * sign, to[axis] * sign);
            (after < 0.0 && after < before).then(|| {
                let part = if 0.0 < before { before / (before - after) } else { 0.0 };
                (part, over)
            })
        })
    }
}

/// One step of Runge-Kutta: normal' = speed / radius tangent, speed' = acceleration . tangent.
fn step(arc: Arc, radius: f64, acceleration: Vector2<f64>, step_s: f64) -> Arc {
    let slope = |arc: Arc| {
        let tangent = tangent(arc.normal);
        (tangent * (arc.speed / radius), acceleration.dot(&tangent))
    };
    let moved = |(turn, gain): (Vector2<f64>, f64), time_s: f64| Arc {
        normal: arc.normal + turn * time_s,
        speed: arc.speed + gain * time_s,
    };
    let k1 = slope(arc);
    let k2 = slope(moved(k1, step_s / 2.0));
    let k3 = slope(moved(k2, step_s / 2.0));
    let k4 = slope(moved(k3, step_s));
    let mean = |a, b, c, d| (a + (b + c) * 2.0 + d) / 6.0;
    let turn = (k1.0 + (k2.0 + k3.0) * 2.0 + k4.0) / 6.0;
    let next = moved((turn, mean(k1.1, k2.1, k3.1, k4.1)), step_s);
    Arc { normal: next.normal / next.normal.norm(), ..next }
}
