//! Closed-form mechanics as a [`maze_core::Engine`]: the truth, where there is one.
//!
//! Written without a line of maze-core's physics: a flaw there cannot hide here.

mod arc;
mod around;
mod floor;
mod line;

use super::without_resistance;
use line::Line;
use maze_core::{Ball, BallSpec, Bounds, Engine, Observer, OutOfRange, Tick};
use nalgebra::Vector2;

/// A motion that has a closed form.
#[derive(Clone, Debug, PartialEq)]
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
    /// On the outside of one solid rectangle, which the ball touches at the start, under a constant acceleration: along its
    /// sides and around its corners, up to the place where the ball lifts off. After that it touches nothing.
    Around {
        /// The rectangle.
        block: Bounds,
    },
    /// Towards +x over a floor of level stretches with steps and slits between them, under a constant acceleration that
    /// presses the ball onto the floor. At each edge the ball slides, without a bounce left.
    Floor {
        /// From left to right.
        stretches: Vec<Stretch>,
    },
}

/// A level piece of a floor: the top of a wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// Its left end (units).
    pub start: f64,
    /// Its right end (units), not beyond the start of the next one.
    pub end: f64,
    /// Its y (units).
    pub height: f64,
}

impl Motion {
    /// Nothing in the way.
    pub const FREE: Self = Self::Room { low: [None; 2], high: [None; 2] };
}

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
    /// `tick_s` is the length of a tick (s); the motion does not depend on it.
    ///
    /// # Errors
    /// A position or velocity that is not finite.
    pub fn new(motion: Motion, spec: BallSpec, ball: Ball, tick_s: f64) -> Result<Self, OutOfRange> {
        let (spec, from) = (without_resistance(spec)?, ball.checked()?);
        Ok(Self { motion, spec, tick_s, from, acceleration: Vector2::zeros(), n_ticks: 0, now: from })
    }

    /// `None` when the ball bounces more often than is followed, or where the motion has no closed form.
    fn at(&self, time_s: f64) -> Option<Ball> {
        let radius = self.spec.radius.units();
        match &self.motion {
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
            Motion::Corner { point } => Some(past_corner(self.from, *point, &self.spec, time_s)),
            Motion::Around { block } => around::at(self.from, block, &self.spec, self.acceleration, time_s),
            Motion::Floor { stretches } => {
                floor::at(self.from, stretches, &self.spec, self.acceleration, time_s)
            }
        }
    }
}

/// Straight on, mirrored once about the line from the corner to the centre at the touch.
fn past_corner(from: Ball, point: Vector2<f64>, spec: &BallSpec, time_s: f64) -> Ball {
    let radius = spec.radius.units();
    let (offset, velocity) = (from.position - point, from.velocity);
    // |offset + velocity t|² = radius².
    let (a, b, c) = (velocity.norm_squared(), offset.dot(&velocity), offset.norm_squared() - radius * radius);
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
            what: "the motion of the closed form",
            expected: "one that it describes, with at most a million bounces under one tilt",
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

    #[test]
    fn a_corner_met_in_the_middle_sends_the_ball_straight_back() {
        let ball = Ball { position: Vector2::new(-2.0, 0.0), velocity: Vector2::new(1.0, 0.0) };
        let spec = BallSpec::default();
        let after = past_corner(ball, Vector2::zeros(), &spec, 3.0);
        assert!((after.velocity - Vector2::new(-0.8, 0.0)).norm() < 1.0e-15);
        assert!((after.position.x + 0.35 + 0.8 * (3.0 - 1.65)).abs() < 1.0e-14);
    }
}
