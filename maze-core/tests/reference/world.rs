//! What the reference knows, and what it does next.

use super::big::{Big, Pair, big, dot, length, minus, pair, plus};
use maze_core::{Ball, BallSpec, Plane};
use std::cmp::Ordering;

/// Rise (radii) below which a bounce is none: far below what is tested, for which it is about 3e-9.
const REST: f64 = 1.0e-14;
/// Lengths, speeds and accelerations below this are 0 (units): far above 192 bits and the truncated series.
const ZERO: f64 = 1.0e-25;
/// Two contacts this close (radii) hold a ball that bounces no more.
const NEAR: f64 = 1.0e-10;
/// Events of one call at most: a test that needs more has a fault.
const MAX_EVENTS: u32 = 20_000;

/// A wall face.
#[derive(Clone)]
pub(crate) struct Face {
    pub(crate) axis: usize,
    pub(crate) sign: Big,
    pub(crate) offset: Big,
    pub(crate) ends: [Big; 2],
}

/// What can be touched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Feature {
    Face(usize),
    Point(usize),
}

/// Walls, and the ball's constants.
pub(crate) struct World {
    pub(crate) faces: Vec<Face>,
    pub(crate) points: Vec<Pair>,
    pub(crate) r: Big,
    pub(crate) e: Big,
    pub(crate) rolling: Big,
    pub(crate) zero: Big,
}

impl World {
    pub(crate) fn new(planes: &[Plane], spec: &BallSpec) -> Self {
        let mut ends: Vec<[f64; 2]> = Vec::new();
        for plane in planes {
            for along in [plane.start, plane.end] {
                let point = plane.facing.point(plane.offset, along).into();
                if !ends.contains(&point) {
                    ends.push(point);
                }
            }
        }
        let face = |plane: &Plane| Face {
            axis: plane.facing.axis(),
            sign: big(plane.facing.sign()),
            offset: big(plane.offset),
            ends: pair([plane.start, plane.end]),
        };
        Self {
            faces: planes.iter().map(face).collect(),
            points: ends.into_iter().map(pair).collect(),
            r: big(spec.radius.units()),
            e: big(spec.restitution),
            rolling: big(spec.rolling),
            zero: big(ZERO),
        }
    }

    /// Whether a number is 0 but for rounding.
    pub(crate) fn is_zero(&self, value: &Big) -> bool {
        value.abs() < self.zero
    }
}

impl Face {
    pub(crate) fn normal(&self) -> Pair {
        let mut normal = pair([0.0; 2]);
        normal[self.axis] = self.sign.clone();
        normal
    }

    /// How far a centre is in front of where it touches.
    pub(crate) fn gap(&self, centre: &Pair, r: &Big) -> Big {
        &self.sign * (&centre[self.axis] - &self.offset) - r
    }

    /// Whether a centre is in front of the face, and not beside it.
    pub(crate) fn spans(&self, centre: &Pair, zero: &Big) -> bool {
        let along = &centre[1 - self.axis];
        &self.ends[0] - zero <= *along && *along <= &self.ends[1] + zero
    }
}

/// A contact of the ball where it is now.
pub(crate) struct Contact {
    pub(crate) feature: Feature,
    pub(crate) n: Pair,
}

/// A change of the velocity by a wall.
#[derive(Clone)]
pub(crate) struct Hit {
    pub(crate) feature: Feature,
    pub(crate) time_s: Big,
    /// How high the ball would rise from it (radii): 0 without a rebound, infinite where nothing presses.
    pub(crate) rise: f64,
    /// Sine of the angle between the path and what is hit.
    pub(crate) sine: f64,
}

/// How the ball moves until something happens.
enum Mode {
    Hit(Feature),
    Flight,
    Along(Feature),
    Rest,
}

/// A ball, and what has happened to it.
#[derive(Clone)]
pub(crate) struct Reference<'a> {
    pub(crate) world: &'a World,
    pub(crate) p: Pair,
    pub(crate) v: Pair,
    pub(crate) a: Pair,
    pub(crate) is_at_rest: bool,
    /// Each hit, in order.
    pub(crate) hits: Vec<Hit>,
    /// Bounces too low to follow.
    pub(crate) n_rests: u32,
    pub(crate) time_s: Big,
    /// Stop at this number of hits.
    pub(crate) max_hits: usize,
}

impl<'a> Reference<'a> {
    pub(crate) fn new(world: &'a World, ball: Ball, a: [f64; 2]) -> Self {
        let a = pair(a).map(|part| part * &world.rolling);
        let (p, v) = (pair(ball.position.into()), pair(ball.velocity.into()));
        let (hits, time_s) = (Vec::new(), big(0.0));
        Self { world, p, v, a, is_at_rest: false, hits, n_rests: 0, time_s, max_hits: usize::MAX }
    }

    /// Another acceleration from now on.
    pub(crate) fn acceleration(&mut self, a: [f64; 2]) {
        self.a = pair(a).map(|part| part * &self.world.rolling);
        self.is_at_rest = false;
    }

    /// Goes on until a time (s) since the beginning, or until the last hit that is wanted.
    pub(crate) fn advance(&mut self, until_s: &Big) {
        for _ in 0..MAX_EVENTS {
            if *until_s <= self.time_s || self.max_hits <= self.hits.len() {
                return;
            }
            let left_s = until_s - &self.time_s;
            let spent_s = match self.next_mode() {
                Mode::Rest => left_s,
                Mode::Hit(feature) => {
                    self.bounce(feature);
                    continue;
                }
                Mode::Flight => self.fly(&left_s),
                Mode::Along(Feature::Face(face)) => self.slide(face, &left_s),
                Mode::Along(Feature::Point(point)) => self.roll(point, &left_s),
            };
            self.time_s = &self.time_s + spent_s;
        }
        panic!("no end of events");
    }

    /// The contact with a feature, wherever the ball is.
    pub(crate) fn contact(&self, feature: Feature) -> Contact {
        let n = match feature {
            Feature::Face(face) => self.world.faces[face].normal(),
            Feature::Point(point) => {
                let from = minus(&self.p, &self.world.points[point]);
                let length = dot(&from, &from).sqrt();
                from.map(|part| part / &length)
            }
        };
        Contact { feature, n }
    }

    /// Acceleration along the normal, relative to what keeps the ball on the feature: it presses where it is negative.
    pub(crate) fn press(&self, contact: &Contact) -> Big {
        let acceleration = dot(&self.a, &contact.n);
        match contact.feature {
            Feature::Face(_) => acceleration,
            Feature::Point(_) => {
                let across = dot(&self.v, &[-&contact.n[1], contact.n[0].clone()]);
                acceleration + &across * &across / &self.world.r
            }
        }
    }

    /// What the ball touches within a distance, each direction once; a face that it is about to leave over its end is not among
    /// them.
    fn touched(&self, within: &Big) -> Vec<Contact> {
        let world = self.world;
        let mut contacts: Vec<Contact> = Vec::new();
        let is_new = |contacts: &[Contact], n: &Pair| {
            let same = |other: &Contact| {
                let apart = minus(&other.n, n);
                world.is_zero(&dot(&apart, &apart).sqrt())
            };
            !contacts.iter().any(same)
        };
        for (index, face) in world.faces.iter().enumerate() {
            let is_touched = face.gap(&self.p, &world.r).abs() < *within && face.spans(&self.p, &world.zero);
            let n = face.normal();
            if is_touched && !self.leaves(face) && is_new(&contacts, &n) {
                contacts.push(Contact { feature: Feature::Face(index), n });
            }
        }
        for (index, point) in world.points.iter().enumerate() {
            let from = minus(&self.p, point);
            // Most are far away; the root is for those that are not.
            if 1.0e-6 * world.r.f64() < (length(&from) - world.r.f64()).abs() {
                continue;
            }
            let gap = dot(&from, &from).sqrt() - &world.r;
            let contact = self.contact(Feature::Point(index));
            if gap.abs() < *within && is_new(&contacts, &contact.n) {
                contacts.push(contact);
            }
        }
        contacts
    }

    /// Whether the ball is at an end of a face and goes on outwards.
    fn leaves(&self, face: &Face) -> bool {
        let along = 1 - face.axis;
        [big(-1.0), big(1.0)].into_iter().zip(&face.ends).any(|(outwards, end)| {
            let (v, a) = (&outwards * &self.v[along], &outwards * &self.a[along]);
            let is_outwards = self.world.zero < v || (self.world.is_zero(&v) && self.world.zero < a);
            self.world.is_zero(&(&self.p[along] - end)) && is_outwards
        })
    }

    fn next_mode(&self) -> Mode {
        if self.is_at_rest {
            return Mode::Rest;
        }
        let world = self.world;
        let touched = self.touched(&world.zero);
        if let Some(hit) = touched.iter().find(|contact| dot(&self.v, &contact.n) < -&world.zero) {
            return Mode::Hit(hit.feature);
        }
        let is_active = |c: &&Contact| world.is_zero(&dot(&self.v, &c.n)) && self.press(c) < -&world.zero;
        let active: Vec<_> = touched.iter().filter(is_active).collect();
        let Some(first) = active.first() else { return Mode::Flight };
        if !world.is_zero(&dot(&self.v, &self.v).sqrt()) {
            return Mode::Along(first.feature);
        }
        for (index, one) in active.iter().enumerate() {
            if active[index + 1..].iter().any(|other| self.is_held(&one.n, &other.n)) {
                return Mode::Rest;
            }
        }
        let is_free = |one: &&&Contact| {
            let along = plus(&self.a, &one.n, &-dot(&self.a, &one.n));
            active.iter().all(|other| -&world.zero < dot(&along, &other.n))
        };
        Mode::Along(active.iter().find(is_free).map_or(first.feature, |one| one.feature))
    }

    /// Whether two contacts can hold the ball: a = -(alpha n1 + beta n2) with neither negative.
    fn is_held(&self, n1: &Pair, n2: &Pair) -> bool {
        let cross = |a: &Pair, b: &Pair| &a[0] * &b[1] - &a[1] * &b[0];
        let area = cross(n1, n2);
        if self.world.is_zero(&area) {
            return false;
        }
        let (alpha, beta) = (-cross(&self.a, n2) / &area, -cross(n1, &self.a) / &area);
        alpha.sign() != Ordering::Less && beta.sign() != Ordering::Less
    }

    /// Whether a ball that leaves along a normal would rise too little to be followed.
    fn is_low(&self, contact: &Contact, speed: &Big) -> bool {
        let press = self.press(contact);
        press < -&self.world.zero && speed * speed < big(2.0 * REST) * &self.world.r * press.abs()
    }

    /// Reflects about the true normal; a bounce that would rise less than [`REST`] rests.
    pub(crate) fn bounce(&mut self, feature: Feature) {
        let contact = self.contact(feature);
        let speed = -dot(&self.v, &contact.n);
        let rebound = &self.world.e * &speed;
        let sine = speed.f64() / length(&self.v);
        self.v = plus(&self.v, &contact.n, &speed);
        let press = self.press(&contact).f64();
        let height = rebound.f64().powi(2) / (-2.0 * press * self.world.r.f64());
        let rise = if rebound.sign() == Ordering::Equal {
            0.0
        } else if press < 0.0 {
            height
        } else {
            f64::INFINITY
        };
        self.hits.push(Hit { feature, time_s: self.time_s.clone(), rise, sine });
        if !self.is_low(&contact, &rebound) {
            self.v = plus(&self.v, &contact.n, &rebound);
            return;
        }
        self.n_rests += 1;
        // The other side of a wedge: held by both when what is left does not rise from it either.
        let others = self.touched(&(big(NEAR) * &self.world.r));
        self.is_at_rest = others
            .iter()
            .any(|other| self.is_held(&contact.n, &other.n) && self.is_low(other, &dot(&self.v, &other.n)));
        if self.is_at_rest {
            self.v = pair([0.0; 2]);
        }
    }

    /// Where it is and how it moves, rounded.
    pub(crate) fn ball(&self) -> Ball {
        let round = |pair: &Pair| [pair[0].f64(), pair[1].f64()];
        Ball { position: round(&self.p).into(), velocity: round(&self.v).into() }
    }
}
