//! The exact engine: within a tick the ball moves from event to event, in flight on a parabola, on a face along it, around a
//! point on an arc, without substeps or penetration.

mod guard;

use super::clearing::Clearing;
use super::collision::{self, Surface};
use super::roll::{self, Pivot, tangent};
use super::state::{BallState, Contact, Contacts, presses};
use super::{Engine, Hit, Log, Observer, RolledArc, Tick};
use crate::physics::ball::{Ball, BallSpec, OutOfRange};
use crate::physics::roots::falls_through_zero;
use crate::physics::sorted_planes::SortedPlanes;
use crate::physics::time_of_impact::{self, Feature, Path};
use crate::physics::tolerance::{self, TANGENT};
use nalgebra::Vector2;
use std::sync::Arc;

/// Most events in a tick (hits, ends of faces and arcs, lift-offs). Real play has a handful. Bounces on a face from speed v end
/// in rest after ln(v / v_rest) / ln(1/e) of them (docs/physics.md): for e = 0.99 that is always fewer than this, for e = 0.998
/// from up to 0.33 units/s (radius 0.35, 4 units/s²). A ball that loses little may have more between near walls; the time that
/// is left is dropped and reported.
pub const MAX_EVENTS: u32 = 4096;

/// Longest tick (s).
pub const MAX_TICK_S: f64 = 1000.0;

/// A clearing is looked for when a tick leads less far than this (radii): a faster ball would soon leave it.
const WORTHWHILE: f64 = 0.25;

/// Ticks until a clearing is looked for again where there was none: between walls without thickness, say.
const PATIENCE: u32 = 8;

/// The last hit and the last lift-off within this tick.
#[derive(Clone, Copy, Debug, Default)]
struct Recent {
    /// The last hit: where the ball was, and what it touched.
    hit: Option<(Vector2<f64>, Contact)>,
    /// The point that the ball has just lifted off from, or passes.
    left: Option<Vector2<f64>>,
}

/// The exact engine. Its motion does not depend on the tick's length (but for rolling resistance, which is taken at the end
/// of each tick, and for rounding). There are no substeps: the cost of a tick grows with what the ball touches in it, not with the
/// way it goes. The same inputs give the same bits on every platform.
#[derive(Clone, Debug)]
#[repr(C)] // What the usual tick needs comes first, in two cache lines.
pub struct Continuous {
    ball: Ball,
    /// Where nothing is touched, as found at the end of the last tick that was searched, for what supported the ball then.
    clearing: Option<Clearing>,
    tick_s: f64,
    spec: BallSpec,
    planes: Arc<SortedPlanes>,
    contacts: Contacts,
    /// Whether the ball was put here from outside and may lie inside a wall.
    is_placed: bool,
    /// Whether a clearing is looked for at all.
    is_cached: bool,
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
        Ok(Self {
            ball,
            clearing: None,
            tick_s,
            spec,
            planes,
            contacts: Contacts::default(),
            is_placed: true,
            is_cached: true,
            n_ticks_to_wait: 0,
        })
    }

    /// The same engine that searches in every tick: what the cache is tested and measured against.
    #[must_use]
    pub fn without_cache(self) -> Self {
        Self { is_cached: false, clearing: None, ..self }
    }

    /// The ball and what supports it, as at the end of the last tick; no contacts after [`Continuous::new`] and
    /// [`Engine::place`] until the first one. To save an engine and go on to the bit, clone it.
    pub fn state(&self) -> BallState {
        BallState { ball: self.ball, contacts: self.contacts }
    }

    fn radius(&self) -> f64 {
        self.spec.radius.units()
    }

    /// The ball's path from now on, along what supports it.
    fn path(&self, acceleration: Vector2<f64>) -> Path {
        let Ball { position, velocity } = self.ball;
        Path { position, velocity, acceleration: self.contacts.along(acceleration) }
    }

    /// When and off which end the ball slides off the face that supports it.
    fn slides_off(&self, path: &Path) -> Option<(f64, Vector2<f64>)> {
        let Some(&Contact { feature: Feature::Face(face), .. }) = self.contacts.first() else { return None };
        let axis = 1 - face.facing.axis();
        let (along, speed, pull) = (path.position[axis], path.velocity[axis], path.acceleration[axis]);
        let upper = falls_through_zero(face.end - along, -speed, -pull).map(|time_s| (time_s, face.end));
        let lower = falls_through_zero(along - face.start, speed, pull).map(|time_s| (time_s, face.start));
        let (time_s, end) = match (upper, lower) {
            (Some(upper), Some(lower)) if lower.0 < upper.0 => lower,
            (upper, lower) => upper.or(lower)?,
        };
        Some((time_s, face.facing.point(face.offset, end)))
    }

    /// Moves along a path; a face that supports the ball keeps it exactly at its radius.
    fn advance<O: Observer + ?Sized>(&mut self, path: &Path, time_s: f64, log: &mut Log<O>) {
        log.observer.flight(path, time_s);
        self.ball = Ball { position: path.at(time_s), velocity: path.velocity_at(time_s) };
        if let Some(&Contact { feature, normal }) = self.contacts.first() {
            self.ball.position = feature.touching(self.ball.position, normal, self.radius());
            self.ball.velocity -= normal * self.ball.velocity.dot(&normal);
        }
    }

    /// Flies or slides until the next event or for `left_s`; returns the time that passed.
    fn fly<O: Observer + ?Sized>(
        &mut self,
        acceleration: Vector2<f64>,
        left_s: f64,
        recent: &mut Recent,
        log: &mut Log<O>,
    ) -> f64 {
        let path = self.path(acceleration);
        let impact = time_of_impact::first(&self.planes, &path, self.radius(), left_s, recent.left.take());
        let until_s = impact.map_or(left_s, |impact| impact.time_s);
        if let Some((time_s, point)) = self.slides_off(&path)
            && time_s < until_s
        {
            self.advance(&path, time_s, log);
            // Over the very end the ball stands on the point there: it lifts off at once if it is fast, or rolls around it.
            if let Some(&Contact { feature: Feature::Face(face), normal }) = self.contacts.first() {
                let axis = 1 - face.facing.axis();
                self.ball.position[axis] = point[axis];
                self.contacts.set(Contact { feature: Feature::Point(point), normal });
            }
            return time_s;
        }
        self.advance(&path, until_s, log);
        if let Some(impact) = impact {
            self.hit(impact.touched, acceleration, recent, log);
        }
        until_s
    }

    /// Looks for a clearing at the end of a tick, when the ball is so slow that one will last.
    fn look_around(&mut self) {
        if 0 < self.n_ticks_to_wait {
            self.n_ticks_to_wait -= 1;
            return;
        }
        let is_slow = self.ball.velocity.amax() * self.tick_s < WORTHWHILE * self.radius();
        if !(self.is_cached && is_slow && self.spec.resistance == 0.0) {
            return;
        }
        let mut carriers = [None; 2];
        for contact in self.contacts.iter() {
            let Feature::Face(face) = contact.feature else { return };
            carriers[face.facing.axis()] = Some(face);
        }
        self.clearing = Clearing::around(&self.planes, self.ball, self.radius(), &carriers);
        self.n_ticks_to_wait = if self.clearing.is_some() { 0 } else { PATIENCE };
    }

    /// How strongly the acceleration presses the ball onto a feature (units/s²), where another one may support it.
    fn pressing(acceleration: Vector2<f64>, normal: Vector2<f64>, support: Option<Vector2<f64>>) -> f64 {
        let alone = -acceleration.dot(&normal);
        let along = support.map_or(alone, |support| {
            let pressed = acceleration.dot(&support);
            if pressed < 0.0 { -(acceleration - support * pressed).dot(&normal) } else { alone }
        });
        let pressing = if alone < along { along } else { alone };
        if 0.0 < pressing { pressing } else { 0.0 }
    }

    /// Puts the ball exactly onto a feature that it has reached, and changes its velocity.
    fn hit<O: Observer + ?Sized>(
        &mut self,
        feature: Feature,
        acceleration: Vector2<f64>,
        recent: &mut Recent,
        log: &mut Log<O>,
    ) {
        let (before, radius) = (self.ball, self.radius());
        let Some(normal) = feature.normal_at(before.position) else { return };
        let position = feature.touching(before.position, normal, radius);
        let contact = Contact { feature, normal };
        let support = self.contacts.first().copied();
        // A feature that was hit at the same place a moment ago still is touched.
        let snap = tolerance::snap(radius, position);
        let is_again = |(place, again): &(Vector2<f64>, Contact)| {
            (position - place).amax() <= snap && again.feature != feature
        };
        let again = recent.hit.filter(is_again).map(|(_, again)| again);
        let other = support.or(again);
        let surface = |normal: Vector2<f64>, other: Option<Vector2<f64>>, is_active: bool| Surface {
            normal,
            rest_speed: tolerance::rest_speed(radius, position, Self::pressing(acceleration, normal, other)),
            is_active,
        };
        let on_hit = surface(normal, other.map(|other| other.normal), false);
        let on_other = other.map(|other| surface(other.normal, Some(normal), support.is_some()));
        let is_held = other.is_some_and(|other| presses(acceleration, other.normal, normal) == [true, true]);
        let outcome = match (support, again) {
            (Some(support), Some(again)) if collision::are_opposite(again.normal, normal) => {
                collision::jam(before.velocity, normal, support.normal)
            }
            _ => collision::collide(
                before.velocity,
                &on_hit,
                on_other.as_ref(),
                is_held,
                self.spec.restitution,
            ),
        };
        self.ball = Ball { position, velocity: outcome.velocity };
        match (outcome.rests_on, other) {
            ([true, true], Some(other)) => self.contacts.set_two([other, contact]),
            ([true, _], _) => self.contacts.set(contact),
            ([false, true], Some(other)) => self.contacts.set(other),
            _ => self.contacts.clear(),
        }
        recent.hit = Some((position, contact));
        // Through a gap that is too narrow by a graze the ball passes: the point on the other side is not hit again here.
        if let Some(Contact { feature: Feature::Point(point), normal: opposite }) = other
            && collision::are_opposite(opposite, normal)
        {
            recent.left = Some(point);
        }
        log.tick.n_rests += u32::from(outcome.rests_on[0]);
        log.tick.n_corner_hits += u32::from(matches!(feature, Feature::Point(_)));
        let point = feature.contact_point(position);
        let speed = -before.velocity.dot(&normal);
        log.note_hit(speed, &Hit { point, normal, penetration: 0.0, before, after: self.ball });
    }

    /// Rolls around a point until the next event or for `left_s`; returns the time that passed.
    fn roll<O: Observer + ?Sized>(
        &mut self,
        point: Vector2<f64>,
        normal: Vector2<f64>,
        acceleration: Vector2<f64>,
        left_s: f64,
        recent: &mut Recent,
        log: &mut Log<O>,
    ) -> f64 {
        let pivot = Pivot { planes: &self.planes, point, radius: self.radius(), acceleration };
        let speed = self.ball.velocity.dot(&tangent(normal));
        let roll = pivot.roll(normal, speed, left_s);
        let arc = RolledArc { point, radius: self.radius(), from: normal, to: roll.normal };
        log.observer.roll(&arc, roll.time_s);
        self.ball = pivot.ball(roll.normal, roll.speed);
        self.contacts.set(Contact { feature: Feature::Point(point), normal: roll.normal });
        match roll.end {
            roll::End::Time | roll::End::Turn => {}
            roll::End::LiftOff => {
                self.contacts.clear();
                recent.left = Some(point);
            }
            roll::End::Touch(feature) => {
                if !self.rolls_onto(feature, roll.normal) {
                    self.hit(feature, acceleration, recent, log);
                }
            }
        }
        roll.time_s
    }

    /// Goes on along a feature that the arc leads onto without a hit: the face where an arc ends, or a point so near that the
    /// ball moves along it.
    fn rolls_onto(&mut self, feature: Feature, from: Vector2<f64>) -> bool {
        let Some(normal) = feature.normal_at(self.ball.position) else { return false };
        let (approach, speed) = (-self.ball.velocity.dot(&normal), self.ball.velocity.norm());
        // A ball that does not move may be held by both, which a hit finds out.
        let is_smooth = 0.0 < speed && approach <= TANGENT * speed && 0.0 < from.dot(&normal);
        if is_smooth {
            self.ball.position = feature.touching(self.ball.position, normal, self.radius());
            self.ball.velocity += normal * approach;
            self.contacts.set(Contact { feature, normal });
        }
        is_smooth
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

    /// Goes from event to event until the tick is over. Contacts are those that the acceleration presses.
    fn pass<O: Observer + ?Sized>(&mut self, acceleration: Vector2<f64>, log: &mut Log<O>) {
        let mut left_s = self.tick_s;
        let mut recent = Recent::default();
        for _ in 0..MAX_EVENTS {
            left_s -= match self.contacts.first() {
                _ if self.contacts.are_two() => self.rest(left_s, log),
                Some(&Contact { feature: Feature::Point(point), normal }) => {
                    self.roll(point, normal, acceleration, left_s, &mut recent, log)
                }
                _ => self.fly(acceleration, left_s, &mut recent, log),
            };
            self.contacts.settle(acceleration);
            if left_s <= 0.0 {
                return;
            }
        }
        log.tick.dropped_s = left_s;
    }

    /// Stays where it is.
    fn rest<O: Observer + ?Sized>(&mut self, left_s: f64, log: &mut Log<O>) -> f64 {
        self.ball.velocity = Vector2::zeros();
        let path =
            Path { position: self.ball.position, velocity: Vector2::zeros(), acceleration: Vector2::zeros() };
        log.observer.flight(&path, left_s);
        left_s
    }

    /// Whether rolling resistance keeps the ball where it is, on the floor or along what supports it.
    fn is_held(&self, acceleration: Vector2<f64>) -> bool {
        let is_on_point = |contact: Contact| matches!(contact.feature, Feature::Point(_));
        0.0 < self.spec.resistance
            && !self.contacts.iter().any(is_on_point)
            && self.spec.holds(self.ball.velocity, self.path(acceleration).acceleration, self.tick_s)
    }

    /// A tick that is searched.
    #[inline(never)]
    fn search<O: Observer + ?Sized>(
        &mut self,
        acceleration: Vector2<f64>,
        observer: &mut O,
    ) -> Result<Tick, OutOfRange> {
        self.expect_finite_end(acceleration)?;
        self.clearing = None;
        let mut log = Log { tick: Tick { n_steps: 1, ..Tick::default() }, observer };
        if self.is_placed {
            self.is_placed = false;
            let depth = self.depenetrate();
            log.tick.recovered = 0.0 < depth;
            log.note_penetration(depth);
        }
        self.contacts.settle(acceleration);
        if self.is_held(acceleration) {
            self.rest(self.tick_s, &mut log);
            return Ok(log.tick);
        }
        let from = self.ball.position;
        self.pass(acceleration, &mut log);
        self.look_around();
        // Where a clearing was found, every plane near was checked but the faces that support the ball, which it was put onto.
        if self.clearing.is_none() {
            self.guard(from, &mut log);
        }
        self.ball.velocity = self.spec.slowed(self.ball.velocity, self.tick_s);
        Ok(log.tick)
    }

    /// A tick, for observers of any kind: what is not observed costs nothing.
    #[inline(always)] // A call would send the ball through memory, which costs as much as the rest.
    fn advance_tick<O: Observer + ?Sized>(
        &mut self,
        acceleration: Vector2<f64>,
        observer: &mut O,
    ) -> Result<Tick, OutOfRange> {
        let acceleration = acceleration * self.spec.rolling;
        if let Some(clearing) = &self.clearing
            && let Some((ball, path)) = clearing.pass(self.ball, acceleration, self.tick_s)
        {
            self.ball = ball;
            observer.flight(&path, self.tick_s);
            return Ok(Tick { n_steps: 1, ..Tick::default() });
        }
        self.search(acceleration, observer)
    }
}

impl Engine for Continuous {
    fn tick_observed(
        &mut self,
        acceleration: Vector2<f64>,
        observer: &mut dyn Observer,
    ) -> Result<Tick, OutOfRange> {
        self.advance_tick(acceleration, observer)
    }

    fn tick(&mut self, acceleration: Vector2<f64>) -> Result<Tick, OutOfRange> {
        self.advance_tick(acceleration, &mut ())
    }

    fn ball(&self) -> Ball {
        self.ball
    }

    fn place(&mut self, ball: Ball) -> Result<(), OutOfRange> {
        self.ball = ball.checked()?;
        self.contacts.clear();
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
    use crate::physics::wall::{Facing, Plane};

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
