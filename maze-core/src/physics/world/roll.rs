//! A ball that rolls around a point it is pressed onto: a pendulum, solved in closed form.
//!
//! The speed follows from the energy, v² = v₀² + 2 r a.(n - n₀). So every event lies in a direction that the radius, the
//! acceleration and the features around give by a square root, whatever the time: where the ball lifts off, where it turns
//! back, and where it touches something else. Only the time at which it gets there is an elliptic integral, which Carlson's
//! R_F gives by square roots too. Nothing depends on where ticks end but for rounding. docs/physics.md derives the formulas.

use super::carlson::r_f;
use crate::physics::ball::Ball;
use crate::physics::numbers::{greater, lesser};
use crate::physics::roots::bracketed_root;
use crate::physics::sorted_planes::{SortedPlanes, WIDENED};
use crate::physics::tolerance::{self, ARC_ROUNDING, LEAST_ENERGY, PASSING, TANGENT};
use crate::physics::wall::{Feature, Plane};
use nalgebra::Vector2;

/// Why a roll ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum End {
    /// The time is over.
    Time,
    /// The ball came to a halt on its way up, and now rolls back.
    Turn,
    /// The ball is too fast, or not pressed.
    LiftOff,
    /// Another feature is touched.
    Touch(Feature),
}

/// A ball on its arc, and how it got there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Roll {
    /// From the point to the centre.
    pub(super) normal: Vector2<f64>,
    /// Along the arc, counter-clockwise (units/s).
    pub(super) speed: f64,
    pub(super) time_s: f64,
    pub(super) end: End,
}

/// A quarter turn counter-clockwise.
pub(super) fn tangent(normal: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(-normal.y, normal.x)
}

/// The circle of a ball's centre around a point, under one acceleration.
pub(super) struct Pivot<'a> {
    pub(super) planes: &'a SortedPlanes,
    pub(super) point: Vector2<f64>,
    pub(super) radius: f64,
    pub(super) acceleration: Vector2<f64>,
}

impl Pivot<'_> {
    /// The ball in a direction from the point.
    pub(super) fn ball(&self, normal: Vector2<f64>, speed: f64) -> Ball {
        Ball { position: self.point + normal * self.radius, velocity: tangent(normal) * speed }
    }

    /// Whether a ball leaves the point: a.n + v²/r >= 0, for longer than rounding can decide.
    fn lifts_off(&self, normal: Vector2<f64>, speed: f64) -> bool {
        let outward = self.acceleration.dot(&normal) + speed * speed / self.radius;
        // On the way up this falls at a rate. A ball that would rise by less than a graze until it is pressed again stays: the
        // rise is 2/3 of outward cubed by rate squared.
        let rate = -3.0 * speed * self.acceleration.dot(&tangent(normal)) / self.radius;
        let graze = tolerance::graze(self.radius, self.point);
        let stays = 0.0 < rate && 2.0 * outward * outward * outward <= 3.0 * graze * rate * rate;
        0.0 <= outward && !stays
    }

    /// Rolls in one direction until the next event, for `left_s` at most.
    pub(super) fn roll(&self, normal: Vector2<f64>, speed: f64, left_s: f64) -> Roll {
        let ended = |end| Roll { normal, speed, time_s: 0.0, end };
        if self.lifts_off(normal, speed) {
            return ended(End::LiftOff);
        }
        let Some(arc) = Arc::new(normal, speed, self.radius, self.acceleration) else {
            // Exactly on top, at rest.
            return Roll { time_s: left_s, ..ended(End::Time) };
        };
        let (mut sine, mut end) = arc.last();
        let mut first: Option<Touch> = None;
        for candidate in self.touches(normal, &arc) {
            let comes_first = match &first {
                None => candidate.along <= sine,
                Some(known) => self.comes_first(&candidate, known),
            };
            if comes_first {
                (sine, end) = (candidate.along, End::Touch(candidate.feature));
                first = Some(candidate);
            }
        }
        let time_s = arc.time_to(sine);
        if left_s < time_s {
            let (normal, speed) = arc.after(left_s, sine);
            return Roll { normal, speed, time_s: left_s, end: End::Time };
        }
        let normal = first.map_or_else(|| arc.normal(sine), |touch| touch.normal);
        Roll { normal, speed: if end == End::Turn { 0.0 } else { arc.speed(sine) }, time_s, end }
    }

    /// Of touches at one place a face comes before a point, then the farther feature before the nearer one, then what stands out
    /// farther. That is the same in a scene that is mirrored or turned.
    fn comes_first(&self, one: &Touch, other: &Touch) -> bool {
        let order = |touch: &Touch| {
            let centre = self.point + touch.normal * self.radius;
            let is_point = matches!(touch.feature, Feature::Point(_));
            (touch.along, is_point, -touch.distance, touch.feature.prominence(centre))
        };
        order(one) < order(other)
    }

    /// What the ball can touch on its direction.
    fn touches(&self, from: Vector2<f64>, arc: &Arc) -> impl Iterator<Item = Touch> {
        let reach = 2.0 * self.radius * WIDENED;
        let near = self.planes.faces_around(self.point, reach);
        near.flat_map(move |face| {
            let plane = face.plane;
            let point = |is_corner: bool, along: f64| {
                is_corner
                    .then(|| self.touch_point(from, arc, plane.facing.point(plane.offset, along)))
                    .flatten()
            };
            let [starts, ends] = face.is_corner;
            let touches =
                [self.touch_face(from, arc, plane), point(starts, plane.start), point(ends, plane.end)];
            touches.into_iter().flatten()
        })
    }

    /// Whether a feature at a gap (units) from the ball is touched where the ball is now.
    fn is_touched(&self, gap: f64, centre: Vector2<f64>) -> bool {
        -tolerance::touch(self.radius, centre) < gap && gap <= tolerance::snap(self.radius, centre)
    }

    /// Where the ball touches a face. A face that ends in the point is touched where the arc ends.
    fn touch_face(&self, from: Vector2<f64>, arc: &Arc, plane: Plane) -> Option<Touch> {
        let (axis, outward) = (plane.facing.axis(), plane.facing.normal());
        let centre = self.point + from * self.radius;
        let snap = tolerance::snap(self.radius, centre);
        // The face is touched where n.m = level.
        let level = (plane.offset - self.point[axis]) * plane.facing.sign() / self.radius + 1.0;
        // Out of reach on the far side of the circle, but for a graze.
        if level <= -1.0 + tolerance::graze(self.radius, centre) / self.radius {
            return None;
        }
        let gap = self.radius * (from.dot(&outward) - level);
        let direction = tangent(from) * arc.side;
        let feature = Feature::Face(plane);
        let leaves = |along: f64, direction: f64| {
            along < plane.start && direction <= 0.0
                || plane.end < along && 0.0 <= direction
                || along == plane.start && direction < 0.0
                || along == plane.end && 0.0 < direction
        };
        let is_over = |along: f64, slack: f64| plane.start - slack <= along && along <= plane.end + slack;
        if self.is_touched(gap, centre) {
            let along = centre[1 - axis];
            if direction.dot(&outward) <= 0.0 && is_over(along, 0.0) && !leaves(along, direction[1 - axis]) {
                return Some(Touch { along: arc.begin, normal: from, feature, distance: level });
            }
        }
        // The point lies below the face's level: the ball came from behind it.
        if 1.0 + snap / self.radius < level {
            return None;
        }
        let level = lesser(level, 1.0);
        let normal = outward * level + tangent(outward) * (arc.side * ((1.0 - level) * (1.0 + level)).sqrt());
        let along = self.point[1 - axis] + self.radius * normal[1 - axis];
        let direction = tangent(normal) * arc.side;
        (is_over(along, snap) && !leaves(along, direction[1 - axis])).then_some(())?;
        Some(Touch { along: arc.ahead(normal)?, normal, feature, distance: level })
    }

    /// Where the ball touches another point: two circles of the radius around the points meet there.
    fn touch_point(&self, from: Vector2<f64>, arc: &Arc, point: Vector2<f64>) -> Option<Touch> {
        let between = point - self.point;
        let distance = between.norm();
        let centre = self.point + from * self.radius;
        if distance == 0.0 || 2.0 * self.radius - tolerance::graze(self.radius, centre) <= distance {
            return None;
        }
        let feature = Feature::Point(point);
        let half = distance / (2.0 * self.radius);
        let direction = between / distance;
        let normal =
            direction * half - tangent(direction) * (arc.side * ((1.0 - half) * (1.0 + half)).sqrt());
        // One that lies ahead is touched there, however near it is now: neighbours would pass the ball to each other.
        if let Some(along) = arc.ahead(normal) {
            return Some(Touch { along, normal, feature, distance });
        }
        let from_point = centre - point;
        let gap = from_point.norm() - self.radius;
        // Past one on the other side the ball goes on, as through any gap that is too narrow by a graze.
        let slowest = if from.dot(&from_point) < 0.0 { PASSING } else { TANGENT };
        let approach = -(tangent(from) * arc.side).dot(&from_point);
        let is_hit = self.is_touched(gap, centre) && slowest * self.radius < approach;
        is_hit.then_some(Touch { along: arc.begin, normal: from, feature, distance })
    }
}

/// A place on the arc at which a feature is touched.
struct Touch {
    /// See [`Arc`].
    along: f64,
    normal: Vector2<f64>,
    feature: Feature,
    /// Orders features of one kind: a face's level (radii), a point's distance (units).
    distance: f64,
}

/// One stretch of the pendulum's motion, in one direction.
///
/// With the angle θ from the top (the direction against the acceleration), counted in the direction of motion, places are
/// named by s = sin(θ/2), which rises in time. The energy is C = v² - V² s² with V² = 4 r |a|: the squared speed at the top,
/// less than 0 where the ball does not get there.
struct Arc {
    /// Unit vector towards the top.
    top: Vector2<f64>,
    /// 1 counter-clockwise, -1 clockwise.
    side: f64,
    radius: f64,
    /// V².
    full: f64,
    /// C.
    energy: f64,
    /// s at the start.
    begin: f64,
}

impl Arc {
    /// `None` for a ball at rest on top, which does not move. Needs an acceleration other than 0.
    fn new(normal: Vector2<f64>, speed: f64, radius: f64, acceleration: Vector2<f64>) -> Option<Self> {
        let strength = acceleration.norm();
        let top = -acceleration / strength;
        let gain = acceleration.dot(&tangent(normal));
        let towards = if speed == 0.0 { gain } else { speed };
        if towards == 0.0 {
            return None;
        }
        let side = if towards < 0.0 { -1.0 } else { 1.0 };
        let begin = sine(top, normal) * side;
        let full = 4.0 * radius * strength;
        let energy = speed * speed - full * begin * begin;
        let energy = if energy.abs() < LEAST_ENERGY * full { LEAST_ENERGY * full } else { energy };
        Some(Self { top, side, radius, full, energy, begin })
    }

    /// Where the stretch ends if nothing is touched: the ball lifts off on its way down, or turns back on its way up.
    fn last(&self) -> (f64, End) {
        if self.energy < 0.0 && self.begin < 0.0 {
            return (-(-self.energy / self.full).sqrt(), End::Turn);
        }
        // a.n + v²/r = 0, with a.n = -|a| (1 - 2 s²).
        let squared = (1.0 - 4.0 * self.energy / self.full) / 6.0;
        (if 0.0 < squared { squared.sqrt() } else { 0.0 }, End::LiftOff)
    }

    /// The place of a direction that lies ahead.
    fn ahead(&self, normal: Vector2<f64>) -> Option<f64> {
        let along = sine(self.top, normal) * self.side;
        // Below the middle nothing presses the ball onto the point.
        let is_ahead = self.begin - ARC_ROUNDING <= along && 0.0 <= self.top.dot(&normal);
        is_ahead.then_some(greater(along, self.begin))
    }

    fn normal(&self, along: f64) -> Vector2<f64> {
        let (sin, cos) = (2.0 * along * (1.0 - along * along).sqrt(), 1.0 - 2.0 * along * along);
        self.top * cos + tangent(self.top) * (self.side * sin)
    }

    /// Speed counter-clockwise.
    fn speed(&self, along: f64) -> f64 {
        let squared = self.energy + self.full * along * along;
        self.side * if 0.0 < squared { squared.sqrt() } else { 0.0 }
    }

    /// The speed outwards, away from the top, where the energy is less than 0 and the ball stays on one side of it.
    fn outward(&self, along: f64) -> f64 {
        // At the turn itself the difference of the squares is rounding, the root of which is not small.
        let turn = (-self.energy / self.full).sqrt();
        let speed = if along.abs() == turn { 0.0 } else { self.speed(along).abs() };
        if along < 0.0 { -speed } else { speed }
    }

    /// A clock that runs through the stretch, by place; by outward speed where the energy is less than 0.
    fn clock(&self, x: f64) -> f64 {
        if 0.0 < self.energy {
            let scale = 2.0 * self.radius / self.energy.sqrt();
            return scale * x * r_f(1.0 - x * x, 1.0 + self.full / self.energy * x * x, 1.0);
        }
        let (low, high) = (-self.energy, self.full + self.energy);
        2.0 * self.radius * x / (low.sqrt() * high.sqrt()) * r_f(1.0 + x * x / low, 1.0 - x * x / high, 1.0)
    }

    /// How fast the clock runs.
    fn clock_rate(&self, x: f64) -> f64 {
        if 0.0 < self.energy {
            return 2.0 * self.radius / ((1.0 - x * x) * (self.energy + self.full * x * x)).sqrt();
        }
        let (low, high) = (-self.energy + x * x, self.full + self.energy - x * x);
        2.0 * self.radius / (low.sqrt() * high.sqrt())
    }

    /// What the clock is read by.
    fn hand(&self, along: f64) -> f64 {
        if 0.0 < self.energy { along } else { self.outward(along) }
    }

    /// Time from the start to a place (s).
    fn time_to(&self, along: f64) -> f64 {
        let time_s = self.clock(self.hand(along)) - self.clock(self.hand(self.begin));
        greater(0.0, time_s)
    }

    /// Direction and speed after a time (s), which lies before the place `last`.
    fn after(&self, time_s: f64, last: f64) -> (Vector2<f64>, f64) {
        let (low, high) = (self.hand(self.begin), self.hand(last));
        let reading = self.clock(low) + time_s;
        let hand = bracketed_root(low, high, |x| (self.clock(x) - reading, self.clock_rate(x)));
        if 0.0 < self.energy {
            return (self.normal(hand), self.speed(hand));
        }
        // On the way up the place is before the top, and the outward speed less than 0.
        let along = ((hand * hand - self.energy) / self.full).sqrt();
        let along = if hand < 0.0 { -along } else { along };
        (self.normal(along), self.side * hand.abs())
    }
}

/// sin(θ/2) of the angle from one unit vector to another, counter-clockwise.
fn sine(from: Vector2<f64>, to: Vector2<f64>) -> f64 {
    let (half, perp) = ((to - from).norm() / 2.0, from.perp(&to));
    // In one direction but for their lengths: a side would be rounding's, and another one in a mirrored scene.
    if perp == 0.0 && 0.0 < from.dot(&to) {
        return 0.0;
    }
    if perp < 0.0 { -half } else { half }
}
