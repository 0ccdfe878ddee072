//! Closed-form mechanics as a [`maze_core::Engine`]: the truth, where there is one.
//!
//! Written without a line of maze-core's physics: a flaw there cannot hide here.

use super::without_resistance;
use maze_core::{Ball, BallSpec, Engine, Observer, OutOfRange, Tick};
use nalgebra::Vector2;

/// A motion that has a closed form.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Motion {
    /// Among up to four walls that reach far enough in both directions: the axes do not know of each other.
    Room {
        /// Lower bounds of the free space along x and y (units), where there is a wall.
        low: [Option<f64>; 2],
        /// Upper bounds.
        high: [Option<f64>; 2],
    },
    /// Past a single point, without acceleration, to be hit at most once.
    Corner {
        /// Of the wall (units).
        point: Vector2<f64>,
    },
}

impl Motion {
    /// Nothing in the way.
    pub const FREE: Self = Self::Room { low: [None; 2], high: [None; 2] };
}

/// Bounces that rise less than this (units) are rest: far below every bar.
const REST_APEX: f64 = 1.0e-15;

/// Most bounces along one axis: with a restitution of 0.99 a fall from 1 unit ends after 1700.
const MAX_BOUNCES: u32 = 1_000_000;

/// The ball at any time by formula.
#[derive(Clone, Debug)]
pub struct ClosedForm {
    motion: Motion,
    spec: BallSpec,
    tick_s: f64,
    /// When the acceleration changes a new piece begins.
    from: Ball,
    acceleration: Vector2<f64>,
    n_ticks: u32,
    now: Ball,
}

impl ClosedForm {
    /// `tick_s` is how far one tick looks ahead (s); the motion does not depend on it.
    ///
    /// # Errors
    /// A position or velocity that is not finite.
    pub fn new(motion: Motion, spec: BallSpec, ball: Ball, tick_s: f64) -> Result<Self, OutOfRange> {
        let (spec, from) = (without_resistance(spec)?, ball.checked()?);
        Ok(Self { motion, spec, tick_s, from, acceleration: Vector2::zeros(), n_ticks: 0, now: from })
    }

    /// `None` when the ball bounces more often than is followed.
    fn at(&self, time_s: f64) -> Option<Ball> {
        let radius = self.spec.radius.units();
        match self.motion {
            Motion::Room { low, high } => {
                let [x, y] = [0, 1].map(|axis| {
                    let line = Line {
                        low: low[axis].map(|wall| wall + radius),
                        high: high[axis].map(|wall| wall - radius),
                        acceleration: self.acceleration[axis],
                        restitution: self.spec.restitution,
                    };
                    line.at(self.from.position[axis], self.from.velocity[axis], time_s)
                });
                let (x, y) = (x?, y?);
                Some(Ball { position: Vector2::new(x.0, y.0), velocity: Vector2::new(x.1, y.1) })
            }
            Motion::Corner { point } => Some(past_corner(self.from, point, &self.spec, time_s)),
        }
    }
}

/// One axis of a room, for the centre of the ball.
struct Line {
    low: Option<f64>,
    high: Option<f64>,
    acceleration: f64,
    restitution: f64,
}

impl Line {
    /// Position and velocity after a time; `None` after too many bounces.
    fn at(&self, mut position: f64, mut velocity: f64, time_s: f64) -> Option<(f64, f64)> {
        let mut left_s = time_s;
        for _ in 0..MAX_BOUNCES {
            let high =
                self.high.and_then(|wall| arrival(wall - position, velocity, self.acceleration, wall, -1.0));
            let low =
                self.low.and_then(|wall| arrival(position - wall, -velocity, -self.acceleration, wall, 1.0));
            let next = [high, low].into_iter().flatten().min_by(|a, b| a.time_s.total_cmp(&b.time_s));
            let Some(hit) = next.filter(|hit| hit.time_s <= left_s) else {
                let half = self.acceleration * left_s / 2.0;
                return Some((position + (velocity + half) * left_s, velocity + self.acceleration * left_s));
            };
            left_s -= hit.time_s;
            position = hit.wall;
            let rebound = self.restitution * hit.speed;
            let pressing = -hit.away * self.acceleration;
            if 0.0 < pressing && rebound * rebound < 2.0 * pressing * REST_APEX {
                return Some((position, 0.0));
            }
            velocity = hit.away * rebound;
        }
        None
    }
}

struct Arrival {
    time_s: f64,
    speed: f64,
    wall: f64,
    away: f64,
}

/// When a gap closes at a speed that grows by `acceleration`, and how fast then: gap = v t + a t² / 2.
fn arrival(gap: f64, speed: f64, acceleration: f64, wall: f64, away: f64) -> Option<Arrival> {
    let squared = speed * speed + 2.0 * acceleration * gap;
    if squared < 0.0 {
        return None;
    }
    let at_wall = squared.sqrt();
    let time_s = if 0.0 < speed {
        2.0 * gap / (speed + at_wall)
    } else if 0.0 < acceleration {
        (at_wall - speed) / acceleration
    } else {
        return None;
    };
    Some(Arrival { time_s, speed: at_wall, wall, away })
}

/// Straight on, mirrored once about the line from the corner to the centre at the touch.
fn past_corner(from: Ball, point: Vector2<f64>, spec: &BallSpec, time_s: f64) -> Ball {
    let radius = spec.radius.units();
    let (way, velocity) = (from.position - point, from.velocity);
    // |way + velocity t|² = radius².
    let (a, b, c) = (velocity.norm_squared(), way.dot(&velocity), way.norm_squared() - radius * radius);
    let root = b * b - a * c;
    let hit_s = if b < 0.0 && 0.0 < root { c / (root.sqrt() - b) } else { f64::INFINITY };
    if time_s < hit_s {
        return Ball { position: from.position + velocity * time_s, velocity };
    }
    let touch = from.position + velocity * hit_s;
    let normal = (touch - point) / radius;
    let after = velocity - normal * ((1.0 + spec.restitution) * velocity.dot(&normal));
    Ball { position: touch + after * (time_s - hit_s), velocity: after }
}

impl Engine for ClosedForm {
    fn tick_observed(
        &mut self,
        acceleration: Vector2<f64>,
        _observer: &mut dyn Observer,
    ) -> Result<Tick, OutOfRange> {
        let acceleration = acceleration * self.spec.rolling;
        if !acceleration.iter().all(|value| value.is_finite()) {
            return Err(OutOfRange::not_finite("the acceleration"));
        }
        if acceleration != self.acceleration {
            self.from = self.now;
            self.acceleration = acceleration;
            self.n_ticks = 0;
        }
        self.n_ticks += 1;
        self.now = self.at(f64::from(self.n_ticks) * self.tick_s).ok_or(OutOfRange {
            what: "the bounces of the closed form",
            expected: "at most a million under one tilt",
        })?;
        Ok(Tick { n_steps: 1, ..Tick::default() })
    }

    fn ball(&self) -> Ball {
        self.now
    }

    fn place(&mut self, ball: Ball) -> Result<(), OutOfRange> {
        self.from = ball.checked()?;
        self.now = self.from;
        self.n_ticks = 0;
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

    fn line(low: Option<f64>, high: Option<f64>, acceleration: f64) -> Line {
        Line { low, high, acceleration, restitution: 0.8 }
    }

    #[test]
    fn the_fall_that_schoolbooks_tell() {
        let fall = line(Some(0.0), None, -2.0);
        // From 1 unit: down after 1 s at 2 units/s, up to 0.64 after another 0.8 s.
        assert!((fall.at(1.0, 0.0, 0.5).unwrap().0 - 0.75).abs() < 1.0e-15);
        let (height, speed) = fall.at(1.0, 0.0, 1.8).unwrap();
        assert!((height - 0.64).abs() < 1.0e-15 && speed.abs() < 1.0e-15);
        // All bounces take 1 + 2 (0.8 + 0.64 + ...) = 9 s; then it lies.
        assert!(0.0 < fall.at(1.0, 0.0, 8.9).unwrap().0);
        assert_eq!(fall.at(1.0, 0.0, 9.0 + 1.0e-6).unwrap(), (0.0, 0.0));
    }

    #[test]
    fn to_and_fro_without_pull() {
        let corridor = line(Some(0.0), Some(1.0), 0.0);
        assert!((corridor.at(0.0, 1.0, 2.5).unwrap().1 - 0.64).abs() < 1.0e-15);
        assert!((corridor.at(0.0, 1.0, 1.5).unwrap().0 - 0.6).abs() < 1.0e-15);
    }

    #[test]
    fn a_corner_met_in_the_middle_sends_the_ball_straight_back() {
        let ball = Ball { position: Vector2::new(-2.0, 0.0), velocity: Vector2::new(1.0, 0.0) };
        let spec = BallSpec::default();
        let after = past_corner(ball, Vector2::zeros(), &spec, 3.0);
        assert!((after.velocity - Vector2::new(-0.8, 0.0)).norm() < 1.0e-15);
        assert!((after.position.x + 0.35 + 0.8 * (3.0 - 1.65)).abs() < 1.0e-14);
    }
}
