//! The exact engine: within a tick the ball moves on a parabola from touch to touch, without substeps or penetration.

use super::clearing::Clearing;
use super::pivot::{self, Pivot};
use super::{Engine, Hit, Log, Tick};
use crate::ball::{Ball, BallSpec, OutOfRange};
use crate::contact;
use crate::impact::{self, Impact, Path, TOUCH, Touched};
use crate::plane::Plane;
use crate::roots::falls_through_zero;
use crate::sorted_planes::SortedPlanes;
use nalgebra::Vector2;
use std::sync::Arc;

/// A ball whose next bounce would rise less than this (units) comes to rest: large against rounding at 100 units (1.4e-14),
/// small against a pixel (about 1e-2). Infinitely many ever smaller bounces end here.
pub const REST_APEX: f64 = 1.0e-9;

/// Most events in a tick (touches, face ends, lift-offs). Real play has a handful; a ball hammered at 10⁴ units/s in a gap
/// of 1e-6 has more, and the time that is left is dropped and reported.
pub const MAX_EVENTS: u32 = 256;

/// Longest tick (s): a ball pressed onto a corner is followed in small steps for as long as a tick lasts.
pub const MAX_TICK_S: f64 = 1000.0;

/// Most walls a ball that starts inside of them is pushed out of, one after the other.
const MAX_RECOVERIES: u32 = 16;

/// A clearing is looked for when a tick leads less far than this (radii): a faster ball would soon leave it.
const WORTHWHILE: f64 = 0.25;

/// Ticks until a clearing is looked for again where there was none: between walls without thickness, say.
const PATIENCE: u32 = 8;

/// What carries the ball.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Support {
    /// A face across x and one across y that the ball is pressed onto and may slide along.
    faces: [Option<Plane>; 2],
    /// A corner that it rolls around.
    corner: Option<Pivot>,
}

/// The exact engine. Its motion does not depend on the tick's length (but for rolling resistance, which is taken at the end
/// of each tick), nor its cost on the speed.
#[derive(Clone, Debug)]
#[repr(C)] // What the usual tick needs comes first, in two cache lines.
pub struct Continuous {
    ball: Ball,
    /// Where nothing is touched, as found at the end of the last tick that was searched, for what carried the ball then.
    clearing: Option<Clearing>,
    tick_s: f64,
    spec: BallSpec,
    planes: Arc<SortedPlanes>,
    support: Support,
    /// Whether the ball was put here from outside and may lie inside a wall.
    is_placed: bool,
    /// Ticks to wait for until a clearing is looked for again.
    n_ticks_to_wait: u32,
}

impl Continuous {
    /// A ball among planes; `tick_s` is the length of a tick (s).
    ///
    /// # Errors
    /// A position, velocity or tick length that is not finite; a tick length that is not greater than 0; a restitution or
    /// rolling factor outside 0 to 1; a negative or infinite rolling resistance.
    pub fn new(
        planes: Arc<SortedPlanes>,
        spec: BallSpec,
        ball: Ball,
        tick_s: f64,
    ) -> Result<Self, OutOfRange> {
        if !(0.0 < tick_s && tick_s <= MAX_TICK_S) {
            let expected = "seconds greater than 0, at most 1000";
            return Err(OutOfRange { what: "the tick's length", expected });
        }
        let (spec, ball) = (spec.checked()?, ball.checked()?);
        let support = Support::default();
        let (clearing, n_ticks_to_wait) = (None, 0);
        Ok(Self { ball, clearing, tick_s, spec, planes, support, is_placed: true, n_ticks_to_wait })
    }

    fn radius(&self) -> f64 {
        self.spec.radius.units()
    }

    /// Lets go of faces that the acceleration no longer presses the ball onto.
    fn release(&mut self, acceleration: Vector2<f64>) {
        for support in &mut self.support.faces {
            let is_pressed = |face: &Plane| acceleration[face.facing.axis()] * face.facing.sign() < 0.0;
            if !support.as_ref().is_none_or(is_pressed) {
                *support = None;
            }
        }
    }

    /// The ball's path from now on: what a face carries does not accelerate into it.
    fn path(&self, acceleration: Vector2<f64>) -> Path {
        let mut path = Path { position: self.ball.position, velocity: self.ball.velocity, acceleration };
        for face in self.support.faces.into_iter().flatten() {
            path.acceleration[face.facing.axis()] = 0.0;
        }
        path
    }

    /// When and off which end the ball slides off a face that carries it.
    fn slides_off(&self, path: &Path) -> Option<(f64, Plane, Vector2<f64>)> {
        let mut first: Option<(f64, Plane, Vector2<f64>)> = None;
        for face in self.support.faces.iter().flatten() {
            let axis = 1 - face.facing.axis();
            let (along, speed, pull) = (path.position[axis], path.velocity[axis], path.acceleration[axis]);
            let upper = falls_through_zero(face.end - along, -speed, -pull).map(|time_s| (time_s, face.end));
            let lower =
                falls_through_zero(along - face.start, speed, pull).map(|time_s| (time_s, face.start));
            for (time_s, end) in [upper, lower].into_iter().flatten() {
                if first.is_none_or(|(first_s, ..)| time_s < first_s) {
                    first = Some((time_s, *face, face.facing.point(face.offset, end)));
                }
            }
        }
        first
    }

    /// Moves along a path; a face that carries the ball keeps it exactly at its radius.
    fn advance(&mut self, path: &Path, time_s: f64) {
        self.ball = Ball { position: path.at(time_s), velocity: path.velocity_at(time_s) };
        for face in self.support.faces.into_iter().flatten() {
            let axis = face.facing.axis();
            self.ball.position[axis] = face.offset + face.facing.sign() * self.radius();
            self.ball.velocity[axis] = 0.0;
        }
    }

    /// Flies or slides until the next event or for `left_s`; returns the time that passed.
    fn fly(&mut self, acceleration: Vector2<f64>, left_s: f64, log: &mut Log) -> f64 {
        let path = self.path(acceleration);
        let impact = impact::first(&self.planes, &path, self.radius(), left_s, None);
        let until_s = impact.map_or(left_s, |impact| impact.time_s);
        if let Some((time_s, face, point)) = self.slides_off(&path)
            && time_s < until_s
        {
            self.advance(&path, time_s);
            self.support.faces[face.facing.axis()] = None;
            // Off the end the ball either flies on or, when it is too slow, rolls around the corner.
            self.ball.position[1 - face.facing.axis()] = point[1 - face.facing.axis()];
            self.support.corner = Pivot::at(&self.planes, point);
            return time_s;
        }
        self.advance(&path, until_s);
        match impact {
            Some(Impact { touched: Touched::Face(face), .. }) => {
                self.bounce_off_face(face, acceleration, log)
            }
            Some(Impact { touched: Touched::Corner(point), .. }) => {
                self.bounce_off_corner(point, acceleration, log);
            }
            None => {}
        }
        until_s
    }

    /// Looks for a clearing at the end of a tick, when the ball is so slow that one will last.
    fn look_around(&mut self) {
        if 0 < self.n_ticks_to_wait {
            self.n_ticks_to_wait -= 1;
            return;
        }
        let is_free = self.support.corner.is_none() && self.spec.resistance == 0.0;
        if is_free && self.ball.velocity.amax() * self.tick_s < WORTHWHILE * self.radius() {
            self.clearing = Clearing::around(&self.planes, self.ball, self.radius(), &self.support.faces);
            self.n_ticks_to_wait = if self.clearing.is_some() { 0 } else { PATIENCE };
        }
    }

    fn bounce_off_face(&mut self, face: Plane, acceleration: Vector2<f64>, log: &mut Log) {
        let (axis, sign, before) = (face.facing.axis(), face.facing.sign(), self.ball);
        // Exactly at the radius: a gap of one rounding would make ghost touches of the corners.
        self.ball.position[axis] = face.offset + sign * self.radius();
        let speed = -self.ball.velocity[axis] * sign;
        let rebound = self.spec.restitution * speed;
        if is_rest(rebound, acceleration[axis] * sign) {
            self.ball.velocity[axis] = 0.0;
            self.support.faces[axis] = Some(face);
            log.tick.n_rests += 1;
        } else {
            self.ball.velocity[axis] = sign * rebound;
        }
        let point = face.facing.point(face.offset, before.position[1 - axis]);
        let normal = face.facing.normal();
        log.note_hit(speed, &Hit { point, normal, penetration: 0.0, before, after: self.ball });
    }

    fn bounce_off_corner(&mut self, point: Vector2<f64>, acceleration: Vector2<f64>, log: &mut Log) {
        let before = self.ball;
        let Some(normal) = (before.position - point).try_normalize(0.0) else { return };
        self.ball.position = point + normal * self.radius();
        let speed = -self.ball.velocity.dot(&normal);
        let rebound = self.spec.restitution * speed;
        log.tick.n_corner_hits += 1;
        self.ball.velocity += normal * (speed + rebound);
        // A face that carried the ball either gets it back at once, or has lost it.
        self.support.faces = [None; 2];
        if is_rest(rebound, acceleration.dot(&normal)) {
            self.ball.velocity -= normal * self.ball.velocity.dot(&normal);
            self.support.corner = Pivot::at(&self.planes, point);
            log.tick.n_rests += 1;
        }
        log.note_hit(speed, &Hit { point, normal, penetration: 0.0, before, after: self.ball });
    }

    /// Rolls around a corner until the next event or for `left_s`; returns the time that passed.
    fn roll(&mut self, pivot: Pivot, acceleration: Vector2<f64>, left_s: f64, log: &mut Log) -> f64 {
        let roll = pivot.roll(&self.planes, self.ball, self.radius(), acceleration, left_s);
        self.ball = roll.ball;
        match roll.end {
            pivot::End::Time => {}
            pivot::End::LiftOff => self.support.corner = None,
            pivot::End::Face(face) => {
                self.support = Support::default();
                self.support.faces[face.facing.axis()] = Some(face);
            }
            pivot::End::Hit(impact) => {
                let before = self.ball.velocity;
                match impact.touched {
                    Touched::Face(face) => self.bounce_off_face(face, Vector2::zeros(), log),
                    Touched::Corner(point) => self.bounce_off_corner(point, Vector2::zeros(), log),
                }
                // Pressed into the gap between the corner and what was hit: it stays there while the tick lasts.
                let pull = acceleration.norm();
                if self.ball.velocity.norm_squared() < 2.0 * pull * REST_APEX
                    && before.norm_squared() < 2.0 * pull * REST_APEX
                {
                    self.ball.velocity = Vector2::zeros();
                    self.support = Support { corner: Some(pivot), ..Support::default() };
                    log.tick.n_rests += 1;
                    return left_s;
                }
                self.support.corner = None;
            }
        }
        roll.time_s
    }

    /// Refuses what is not finite, and what would leave the range of numbers within the tick, squares included.
    fn expect_finite_end(&self, acceleration: Vector2<f64>) -> Result<(), OutOfRange> {
        let free = Path { position: self.ball.position, velocity: self.ball.velocity, acceleration };
        let is_within = |vector: Vector2<f64>| vector.norm_squared().is_finite();
        let (position, velocity) = (free.at(self.tick_s), free.velocity_at(self.tick_s));
        match () {
            () if !is_within(acceleration) => Err(OutOfRange::not_finite("the acceleration")),
            () if !is_within(velocity) => Err(OutOfRange::not_finite("the ball's velocity")),
            () if !is_within(position) => Err(OutOfRange::not_finite("the ball's position")),
            () => Ok(()),
        }
    }

    /// Goes from event to event until the tick is over.
    fn pass(&mut self, acceleration: Vector2<f64>, log: &mut Log) {
        let mut left_s = self.tick_s;
        for _ in 0..MAX_EVENTS {
            left_s -= match self.support.corner {
                Some(pivot) => self.roll(pivot, acceleration, left_s, log),
                None => self.fly(acceleration, left_s, log),
            };
            if left_s <= 0.0 {
                return;
            }
        }
        log.tick.dropped_s = left_s;
    }

    /// Whether rolling resistance keeps the ball where it is, on the floor or along what carries it.
    fn is_held(&self, acceleration: Vector2<f64>) -> bool {
        0.0 < self.spec.resistance
            && self.support.corner.is_none()
            && self.spec.holds(self.ball.velocity, self.path(acceleration).acceleration, self.tick_s)
    }

    /// Puts a ball that starts inside a wall outside of it, out of the deepest overlap first.
    fn recover(&mut self, log: &mut Log) {
        for _ in 0..MAX_RECOVERIES {
            let centre = self.ball.position;
            let radius = self.radius();
            let deepest = self
                .planes
                .planes_within(centre, radius)
                .filter_map(|plane| contact::find(centre, radius, &plane))
                .filter(|contact| TOUCH < contact.penetration)
                .max_by(|a, b| a.penetration.total_cmp(&b.penetration));
            let Some(contact) = deepest else { return };
            let facing = contact.plane.facing;
            let front = (centre[facing.axis()] - contact.plane.offset) * facing.sign();
            // In front, away from the closest point; behind, through the face.
            let away = (centre - contact.closest).try_normalize(0.0).filter(|_| 0.0 <= front);
            self.ball.position = contact.closest + away.unwrap_or(facing.normal()) * radius;
            log.tick.recovered = true;
            log.note_penetration(contact.penetration);
        }
    }
}

/// Whether a bounce that leaves with this speed against a pressing acceleration is one too small to follow.
fn is_rest(rebound: f64, normal_acceleration: f64) -> bool {
    normal_acceleration < 0.0 && rebound * rebound < -2.0 * normal_acceleration * REST_APEX
}

impl Engine for Continuous {
    fn tick(&mut self, acceleration: Vector2<f64>) -> Result<Tick, OutOfRange> {
        if let Some(clearing) = &self.clearing
            && let Some(ball) = clearing.pass(self.ball, acceleration * self.spec.rolling, self.tick_s)
        {
            self.ball = ball;
            return Ok(Tick { n_steps: 1, ..Tick::default() });
        }
        self.tick_observed(acceleration, &mut |_| {})
    }

    fn tick_observed(
        &mut self,
        acceleration: Vector2<f64>,
        observer: &mut dyn FnMut(&Hit),
    ) -> Result<Tick, OutOfRange> {
        let acceleration = acceleration * self.spec.rolling;
        self.expect_finite_end(acceleration)?;
        self.clearing = None;
        let mut log = Log { tick: Tick { n_steps: 1, ..Tick::default() }, observer };
        if self.is_placed {
            self.recover(&mut log);
            self.is_placed = false;
        }
        self.release(acceleration);
        if self.is_held(acceleration) {
            self.ball.velocity = Vector2::zeros();
            return Ok(log.tick);
        }
        self.pass(acceleration, &mut log);
        self.look_around();
        self.ball.velocity = self.spec.slowed(self.ball.velocity, self.tick_s);
        Ok(log.tick)
    }

    fn ball(&self) -> Ball {
        self.ball
    }

    fn place(&mut self, ball: Ball) -> Result<(), OutOfRange> {
        self.ball = ball.checked()?;
        self.support = Support::default();
        self.is_placed = true;
        self.clearing = None;
        Ok(())
    }

    fn spec(&self) -> &BallSpec {
        &self.spec
    }

    fn tick_s(&self) -> f64 {
        self.tick_s
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plane::Facing;

    #[test]
    fn most_ticks_of_a_rolling_ball_need_no_search() {
        let walls =
            [(Facing::PlusX, 0.0), (Facing::MinusX, 9.0), (Facing::PlusY, 0.0), (Facing::MinusY, 1.0)];
        let corridor = walls.map(|(facing, offset)| Plane { facing, offset, start: 0.0, end: 9.0 });
        let planes = Arc::new(SortedPlanes::new(corridor).unwrap());
        let start = Ball::at(Vector2::new(1.0, 0.5));
        let mut engine = Continuous::new(planes, BallSpec::default(), start, 0.03).unwrap();
        let mut n_searched = 0;
        for n in 0..1000 {
            let pull = Vector2::new(if n % 200 < 100 { 0.5 } else { -0.5 }, -0.5);
            let passes = |clearing: &Clearing| clearing.pass(engine.ball, pull, engine.tick_s).is_some();
            n_searched += u32::from(!engine.clearing.as_ref().is_some_and(passes));
            engine.tick(pull).unwrap();
        }
        assert!(n_searched < 200, "{n_searched} of 1000");
    }
}
