//! The ball: where it is, how it moves, its radius and material.

use nalgebra::Vector2;

/// A number from outside is not usable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{what}: expected {expected}")]
pub struct OutOfRange {
    /// What the number means.
    pub what: &'static str,
    /// Which numbers are usable.
    pub expected: &'static str,
}

impl OutOfRange {
    /// NaN or infinite.
    pub const fn not_finite(what: &'static str) -> Self {
        Self { what, expected: "a finite number" }
    }
}

/// A ball radius (maze units): finite and greater than zero.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Radius(f64);

impl Radius {
    /// A radius (maze units).
    ///
    /// # Errors
    /// A number that is not finite, or not greater than zero.
    pub const fn new(units: f64) -> Result<Self, OutOfRange> {
        if units.is_finite() && 0.0 < units {
            return Ok(Self(units));
        }
        Err(OutOfRange { what: "the ball's radius", expected: "a finite number greater than 0" })
    }

    /// In maze units.
    pub const fn units(self) -> f64 {
        self.0
    }
}

/// Position (units) and velocity (units/s) of the ball's centre in the maze plane.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ball {
    /// Maze units.
    pub position: Vector2<f64>,
    /// Maze units per second.
    pub velocity: Vector2<f64>,
}

impl Ball {
    /// At rest.
    pub fn at(position: Vector2<f64>) -> Self {
        Self { position, velocity: Vector2::zeros() }
    }

    /// The ball itself, or which of its vectors is not finite.
    pub fn checked(self) -> Result<Self, OutOfRange> {
        let finite = |vector: Vector2<f64>| vector.iter().all(|value| value.is_finite());
        match (finite(self.position), finite(self.velocity)) {
            (true, true) => Ok(self),
            (false, _) => Err(OutOfRange::not_finite("the ball's position")),
            (true, false) => Err(OutOfRange::not_finite("the ball's velocity")),
        }
    }
}

/// Radius and material of the ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallSpec {
    /// Of the circle in the maze plane.
    pub radius: Radius,
    /// Fraction of the normal speed that a bounce keeps, 0..=1.
    pub restitution: f64,
    /// Fraction of the projected gravity that accelerates the centre: [`BallSpec::POINT_MASS`] or [`BallSpec::ROLLING_SPHERE`].
    pub rolling: f64,
    /// Rolling resistance: deceleration against the motion (units/s²), from 0, which is off.
    pub resistance: f64,
}

impl BallSpec {
    /// The report's ball: a point mass that slides without friction.
    pub const POINT_MASS: f64 = 1.0;
    /// A solid sphere that rolls without slipping: 1 / (1 + 2/5), from I = 2/5 m r².
    pub const ROLLING_SPHERE: f64 = 5.0 / 7.0;
    /// The report's restitution.
    pub const RESTITUTION: f64 = 0.8;

    /// The spec itself, or which of its numbers is out of range.
    pub fn checked(self) -> Result<Self, OutOfRange> {
        let fraction = |what| OutOfRange { what, expected: "a fraction, 0 to 1" };
        if !(0.0..=1.0).contains(&self.restitution) {
            return Err(fraction("the restitution"));
        }
        if !(0.0..=1.0).contains(&self.rolling) {
            return Err(fraction("the rolling factor"));
        }
        let is_resistance = self.resistance.is_finite() && 0.0 <= self.resistance;
        let expected = "a finite number, 0 or more";
        if is_resistance { Ok(self) } else { Err(OutOfRange { what: "the rolling resistance", expected }) }
    }

    /// What rolling resistance leaves of a velocity after a time (s): its direction, and never a turn.
    pub fn slowed(&self, velocity: Vector2<f64>, time_s: f64) -> Vector2<f64> {
        if self.resistance == 0.0 {
            return velocity;
        }
        let (speed, loss) = (velocity.norm(), self.resistance * time_s);
        if speed <= loss { Vector2::zeros() } else { velocity * (1.0 - loss / speed) }
    }

    /// Whether rolling resistance holds a ball: it stops within the time (s), and the acceleration does not overcome it.
    pub fn holds(&self, velocity: Vector2<f64>, acceleration: Vector2<f64>, time_s: f64) -> bool {
        0.0 < self.resistance
            && acceleration.norm() <= self.resistance
            && velocity.norm() <= self.resistance * time_s
    }

    /// The usual radius: large enough to be seen, and corridors stay wide enough to bounce in.
    pub const RADIUS: Radius = Radius(0.35);
}

/// A ball's material by its name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum BallKind {
    /// The report's: a point mass of restitution 0.8 that nothing slows down.
    #[default]
    Report,
    /// A solid steel sphere that rolls, bounces little and comes to rest: for players, who have to be able to brake.
    Steel,
}

impl BallKind {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Report, Self::Steel];

    /// Restitution of [`BallKind::Steel`]. A real rolling sphere whose material has 0.8 comes back with (5 * 0.8 - 2) / 7 = 0.29 once it
    /// rolls again; a little more looks livelier.
    pub const STEEL_RESTITUTION: f64 = 0.4;

    /// Rolling resistance of [`BallKind::Steel`] (units/s²). From 1 unit/s the ball stops after 1.54 s, and a tilt of 5.3 degrees
    /// sets it in motion. Half as much would leave it rolling for 3 s, twice as much would need 10.7 degrees.
    pub const STEEL_RESISTANCE: f64 = 0.65;

    /// As in a level file.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Report => "report",
            Self::Steel => "steel",
        }
    }

    /// A ball of this material and a radius.
    pub fn spec(self, radius: Radius) -> BallSpec {
        let report = BallSpec { radius, ..BallSpec::default() };
        match self {
            Self::Report => report,
            Self::Steel => BallSpec {
                restitution: Self::STEEL_RESTITUTION,
                rolling: BallSpec::ROLLING_SPHERE,
                resistance: Self::STEEL_RESISTANCE,
                ..report
            },
        }
    }
}

/// No ball has that name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("expected report or steel")]
pub struct UnknownBall;

impl std::str::FromStr for BallKind {
    type Err = UnknownBall;

    fn from_str(name: &str) -> Result<Self, UnknownBall> {
        Self::ALL.into_iter().find(|kind| kind.name() == name).ok_or(UnknownBall)
    }
}

impl Default for BallSpec {
    fn default() -> Self {
        Self {
            radius: Self::RADIUS,
            restitution: Self::RESTITUTION,
            rolling: Self::POINT_MASS,
            resistance: 0.0,
        }
    }
}
