//! A tick that the free-space cache cannot answer, event by event: in flight on a parabola, along a face, around a point on an arc.

use super::collision::{self, Surface};
use super::free_space::FreeSpace;
use super::roll::{self, Pivot, tangent};
use super::state::{Contact, presses};
use super::{BallState, World};
use crate::physics::ball::{Ball, OutOfRange};
use crate::physics::numbers::greater;
use crate::physics::roots::falls_through_zero;
use crate::physics::sweep::{self, SweepQuery};
use crate::physics::tick::{Hit, Log, Observer, RolledArc, Tick};
use crate::physics::time_of_impact::Path;
use crate::physics::tolerance::{self, TANGENT};
use crate::physics::wall::Feature;
use nalgebra::Vector2;

/// Most events in a tick (hits, ends of faces and arcs, lift-offs). Usual play has fewer than ten. Bounces on a face with
/// restitution e end from speed v, when they are slower than the rest speed v_rest, after ln(v / v_rest) / ln(1/e) of them (docs/physics.md): for e = 0.99 that is always fewer than this, for e = 0.998
/// from up to 0.33 units/s (radius 0.35, 4 units/s²). A ball that loses little may have more between near walls; the time that
/// is left is dropped and reported.
pub const MAX_EVENTS: u32 = 4096;

/// The free-space cache is refreshed when a tick moves the ball less far than this (radii): a faster ball would soon leave the box.
const WORTHWHILE: f64 = 0.25;

/// Ticks until the cache is refreshed again where no free space was found: between walls without thickness, for example.
const RETRY_TICKS: u32 = 8;

/// The last hit and the last lift-off within this tick.
#[derive(Clone, Copy, Debug, Default)]
struct Recent {
    /// The last hit: where the ball was, and what it touched.
    hit: Option<(Vector2<f64>, Contact)>,
    /// The point that the ball has just lifted off from, or passes in a narrow gap (see `hit`).
    left: Option<Vector2<f64>>,
}

/// A tick while it is computed.
pub(super) struct Events<'a, O: Observer + ?Sized> {
    pub(super) world: &'a World,
    pub(super) state: &'a mut BallState,
    pub(super) log: Log<'a, O>,
    /// Constant throughout the tick (units/s²).
    acceleration: Vector2<f64>,
    recent: Recent,
    /// Time until the end of the tick (s).
    left_s: f64,
}

impl World {
    /// A tick that needs searches. The acceleration is already multiplied by [`BallSpec::rolling`](crate::BallSpec::rolling).
    #[inline(never)]
    pub(super) fn searched_tick<O: Observer + ?Sized>(
        &self,
        state: &mut BallState,
        acceleration: Vector2<f64>,
        observer: &mut O,
    ) -> Result<Tick, OutOfRange> {
        self.expect_finite_end(state.ball, acceleration)?;
        state.free_space = None;
        let mut events = Events::new(self, state, acceleration, observer);
        events.play();
        Ok(events.log.tick)
    }

    /// Refuses what is not finite, and what would leave the range of numbers within the tick, squares included.
    fn expect_finite_end(&self, ball: Ball, acceleration: Vector2<f64>) -> Result<(), OutOfRange> {
        let free = Path { position: ball.position, velocity: ball.velocity, acceleration };
        let is_within = |vector: Vector2<f64>| vector.norm_squared().is_finite();
        if !is_within(acceleration) {
            Err(OutOfRange::not_finite("the acceleration"))
        } else if !is_within(free.velocity_at(self.tick_s)) {
            Err(OutOfRange::not_finite("the ball's velocity"))
        } else if !is_within(free.at(self.tick_s)) {
            Err(OutOfRange::not_finite("the ball's position"))
        } else {
            Ok(())
        }
    }
}

impl<'a, O: Observer + ?Sized> Events<'a, O> {
    pub(super) fn new(
        world: &'a World,
        state: &'a mut BallState,
        acceleration: Vector2<f64>,
        observer: &'a mut O,
    ) -> Self {
        let log = Log { tick: Tick { n_steps: 1, ..Tick::default() }, observer };
        Self { world, state, log, acceleration, recent: Recent::default(), left_s: world.tick_s }
    }

    fn radius(&self) -> f64 {
        self.world.radius()
    }

    fn play(&mut self) {
        if self.state.is_placed {
            self.state.is_placed = false;
            let depth = self.depenetrate();
            self.log.tick.recovered = 0.0 < depth;
            self.log.note_penetration(depth);
        }
        self.state.contacts.settle(self.acceleration);
        if self.is_held() {
            self.rest();
            return;
        }
        let from = self.state.ball.position;
        self.run();
        self.refresh_free_space();
        // A free space that was found proves that nothing overlaps but the supports, on which the ball was placed exactly.
        if self.state.free_space.is_none() {
            self.guard(from);
        }
        self.state.ball.velocity = self.world.spec.slowed(self.state.ball.velocity, self.world.tick_s);
    }

    /// Whether rolling resistance keeps the ball where it is, on the floor or along its support.
    fn is_held(&self) -> bool {
        let is_on_point = |contact: Contact| matches!(contact.feature, Feature::Point(_));
        let BallState { ball, contacts, .. } = &*self.state;
        0.0 < self.world.spec.resistance
            && !contacts.iter().any(is_on_point)
            && self.world.spec.holds(ball.velocity, contacts.along(self.acceleration), self.world.tick_s)
    }

    /// Goes from event to event until the tick is over. Active contacts are those onto which the acceleration pushes the ball.
    fn run(&mut self) {
        for _ in 0..MAX_EVENTS {
            match self.state.contacts.first() {
                _ if self.state.contacts.are_two() => self.rest(),
                Some(&Contact { feature: Feature::Point(point), normal }) => self.roll(point, normal),
                _ => self.fly(),
            }
            self.state.contacts.settle(self.acceleration);
            if self.left_s <= 0.0 {
                return;
            }
        }
        self.log.tick.dropped_s = self.left_s;
    }

    /// Stays at rest until the end of the tick.
    fn rest(&mut self) {
        self.state.ball.velocity = Vector2::zeros();
        let path = Path {
            position: self.state.ball.position,
            velocity: Vector2::zeros(),
            acceleration: Vector2::zeros(),
        };
        self.log.observer.flight(&path, self.left_s);
        self.left_s = 0.0;
    }

    /// The ball's path from now on, along its support.
    fn path(&self) -> Path {
        let Ball { position, velocity } = self.state.ball;
        Path { position, velocity, acceleration: self.state.contacts.along(self.acceleration) }
    }

    /// When and off which end the ball slides off the face that supports it.
    fn slides_off(&self, path: &Path) -> Option<(f64, Vector2<f64>)> {
        let Some(&Contact { feature: Feature::Face(face), .. }) = self.state.contacts.first() else {
            return None;
        };
        let axis = 1 - face.facing.axis();
        let (along, speed, acceleration) =
            (path.position[axis], path.velocity[axis], path.acceleration[axis]);
        let upper =
            falls_through_zero(face.end - along, -speed, -acceleration).map(|time_s| (time_s, face.end));
        let lower =
            falls_through_zero(along - face.start, speed, acceleration).map(|time_s| (time_s, face.start));
        let (time_s, end) = match (upper, lower) {
            (Some(upper), Some(lower)) if lower.0 < upper.0 => lower,
            (upper, lower) => upper.or(lower)?,
        };
        Some((time_s, face.facing.point(face.offset, end)))
    }

    /// Moves along a path; a face that supports the ball keeps it exactly at its radius.
    fn advance(&mut self, path: &Path, time_s: f64) {
        self.log.observer.flight(path, time_s);
        self.left_s -= time_s;
        let mut ball = Ball { position: path.at(time_s), velocity: path.velocity_at(time_s) };
        if let Some(&Contact { feature, normal }) = self.state.contacts.first() {
            ball.position = feature.touching(ball.position, normal, self.radius());
            ball.velocity -= normal * ball.velocity.dot(&normal);
        }
        self.state.ball = ball;
    }

    /// Flies or slides until the next event or the end of the tick.
    fn fly(&mut self) {
        let path = self.path();
        let query =
            SweepQuery { path, radius: self.radius(), until_s: self.left_s, left: self.recent.left.take() };
        let impact = sweep::first_impact(&self.world.planes, &query);
        let until_s = impact.map_or(self.left_s, |impact| impact.time_s);
        if let Some((time_s, point)) = self.slides_off(&path)
            && time_s < until_s
        {
            self.advance(&path, time_s);
            // Over the very end the ball stands on the point there: it lifts off at once if it is fast, or rolls around it.
            if let Some(&Contact { feature: Feature::Face(face), normal }) = self.state.contacts.first() {
                let axis = 1 - face.facing.axis();
                self.state.ball.position[axis] = point[axis];
                self.state.contacts.set(Contact { feature: Feature::Point(point), normal });
            }
            return;
        }
        self.advance(&path, until_s);
        if let Some(impact) = impact {
            self.hit(impact.feature);
        }
    }

    /// Refreshes the free-space cache at the end of a tick, when the ball is so slow that it will last.
    fn refresh_free_space(&mut self) {
        let Self { world, state, .. } = self;
        if 0 < state.n_ticks_to_wait {
            state.n_ticks_to_wait -= 1;
            return;
        }
        let is_slow = state.ball.velocity.amax() * world.tick_s < WORTHWHILE * world.radius();
        if !(world.is_cached && is_slow && world.spec.resistance == 0.0) {
            return;
        }
        let mut supports = [None; 2];
        for contact in state.contacts.iter() {
            let Feature::Face(face) = contact.feature else { return };
            supports[face.facing.axis()] = Some(face);
        }
        state.free_space = FreeSpace::around(&world.planes, state.ball, world.radius(), &supports);
        state.n_ticks_to_wait = if state.free_space.is_some() { 0 } else { RETRY_TICKS };
    }

    /// How strongly the acceleration presses the ball onto a feature (units/s²): the larger of the values with and without the other
    /// feature as a support.
    fn pressing(&self, normal: Vector2<f64>, support: Option<Vector2<f64>>) -> f64 {
        let acceleration = self.acceleration;
        let alone = -acceleration.dot(&normal);
        let along = support.map_or(alone, |support| {
            let pressed = acceleration.dot(&support);
            if pressed < 0.0 { -(acceleration - support * pressed).dot(&normal) } else { alone }
        });
        let pressing = greater(alone, along);
        greater(0.0, pressing)
    }

    /// Puts the ball exactly onto a feature that it has reached, and changes its velocity. What a hit does to a velocity, at a face
    /// or a corner, is decided in `collision.rs`.
    fn hit(&mut self, feature: Feature) {
        let (before, radius) = (self.state.ball, self.radius());
        let Some(normal) = feature.normal_at(before.position) else { return };
        let position = feature.touching(before.position, normal, radius);
        let contact = Contact { feature, normal };
        let support = self.state.contacts.first().copied();
        // Another feature that was hit at the same place before counts as a second, simultaneous contact.
        let snap = tolerance::snap(radius, position);
        let is_again = |(place, again): &(Vector2<f64>, Contact)| {
            (position - place).amax() <= snap && again.feature != feature
        };
        let again = self.recent.hit.filter(is_again).map(|(_, again)| again);
        let other = support.or(again);
        let surface = |normal: Vector2<f64>, other: Option<Vector2<f64>>, is_active: bool| Surface {
            normal,
            rest_speed: tolerance::rest_speed(radius, position, self.pressing(normal, other)),
            is_active,
        };
        let on_hit = surface(normal, other.map(|other| other.normal), false);
        let on_other = other.map(|other| surface(other.normal, Some(normal), support.is_some()));
        let is_held =
            other.is_some_and(|other| presses(self.acceleration, other.normal, normal) == [true, true]);
        let outcome = match (support, again) {
            (Some(support), Some(again)) if collision::are_opposite(again.normal, normal) => {
                collision::jam(before.velocity, normal, support.normal)
            }
            _ => collision::collide(
                before.velocity,
                &on_hit,
                on_other.as_ref(),
                is_held,
                self.world.spec.restitution,
            ),
        };
        self.state.ball = Ball { position, velocity: outcome.velocity };
        let contacts = &mut self.state.contacts;
        match (outcome.rests_on, other) {
            ([true, true], Some(other)) => contacts.set_two([other, contact]),
            ([true, _], _) => contacts.set(contact),
            ([false, true], Some(other)) => contacts.set(other),
            _ => contacts.clear(),
        }
        self.recent.hit = Some((position, contact));
        // The ball passes a gap that is narrower than itself by less than a graze: the point on the other side is not hit again here.
        if let Some(Contact { feature: Feature::Point(point), normal: opposite }) = other
            && collision::are_opposite(opposite, normal)
        {
            self.recent.left = Some(point);
        }
        self.log.tick.n_rests += u32::from(outcome.rests_on[0]);
        self.log.tick.n_corner_hits += u32::from(matches!(feature, Feature::Point(_)));
        let hit = Hit {
            time_s: self.world.tick_s - self.left_s,
            point: feature.contact_point(position),
            normal,
            penetration: 0.0,
            before,
            after: self.state.ball,
        };
        self.log.note_hit(-before.velocity.dot(&normal), &hit);
    }

    /// Rolls around a point until the next event or the end of the tick.
    fn roll(&mut self, point: Vector2<f64>, normal: Vector2<f64>) {
        let radius = self.radius();
        let pivot = Pivot { planes: &self.world.planes, point, radius, acceleration: self.acceleration };
        let speed = self.state.ball.velocity.dot(&tangent(normal));
        let roll = pivot.roll(normal, speed, self.left_s);
        let arc = RolledArc { point, radius, from: normal, to: roll.normal };
        self.log.observer.roll(&arc, roll.time_s);
        self.left_s -= roll.time_s;
        self.state.ball = pivot.ball(roll.normal, roll.speed);
        self.state.contacts.set(Contact { feature: Feature::Point(point), normal: roll.normal });
        match roll.end {
            roll::End::Time | roll::End::Turn => {}
            roll::End::LiftOff => {
                self.state.contacts.clear();
                self.recent.left = Some(point);
            }
            roll::End::Touch(feature) => {
                if !self.rolls_onto(feature, roll.normal) {
                    self.hit(feature);
                }
            }
        }
    }

    /// Continues along a feature without a bounce when the arc approaches it tangentially: the face where an arc ends, or a point so
    /// near that the ball moves along it.
    fn rolls_onto(&mut self, feature: Feature, from: Vector2<f64>) -> bool {
        let radius = self.radius();
        let BallState { ball, contacts, .. } = &mut *self.state;
        let Some(normal) = feature.normal_at(ball.position) else { return false };
        let (approach, speed) = (-ball.velocity.dot(&normal), ball.velocity.norm());
        // A ball that does not move may be held by both: `hit` decides that.
        let is_smooth = 0.0 < speed && approach <= TANGENT * speed && 0.0 < from.dot(&normal);
        if is_smooth {
            ball.position = feature.touching(ball.position, normal, radius);
            ball.velocity += normal * approach;
            contacts.set(Contact { feature, normal });
        }
        is_smooth
    }
}
