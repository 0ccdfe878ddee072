//! The model error of the planar projection: how far "project gravity, forget z" lies from a ball that rolls on a real, tilting board.
//!
//! Truth here is rapier in three dimensions, itself checked by the equation of a sphere that rolls without slipping on a
//! board which turns about an axis through its middle (derived in docs/verification.md):
//! x'' = 5/7 (g sin θ + θ'² x) - r θ''.

use crate::board::Board;
use crate::engine::RollingEngine;
use crate::scene::Gravity;
use maze_core::gravity::WORLD_GRAVITY;
use maze_core::{Ball, BallSpec, Bounds, Engine, OutOfRange, Radius};
use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

/// Step of rapier (s): fine enough that its own error is far below what is shown.
const TICK_S: f64 = 1.0 / 1000.0;

/// Radius of the ball (units).
const R: f64 = 0.25;

/// Higher than this above the floor (units) the ball has left it: above rapier's own standoff and what a contact gives.
const THROWN: f64 = 1.0e-3;

/// How long a board swings (s).
const SWING_S: f64 = 4.0;

/// Of held boards (degrees).
const TILTS_DEG: [f64; 8] = [1.0, 2.0, 5.0, 10.0, 15.0, 20.0, 30.0, 40.0];

/// Of swinging boards: the game's limit is 20 degrees, and a hand does two swings a second at most.
const AMPLITUDES_DEG: [f64; 5] = [1.0, 2.0, 5.0, 10.0, 20.0];
const FREQUENCIES_HZ: [f64; 6] = [0.1, 0.2, 0.5, 1.0, 1.5, 2.0];

/// A board held still.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Held {
    /// Degrees.
    pub tilt_deg: f64,
    /// Acceleration by g sin θ: 5/7 by theory.
    pub part: f64,
}

/// A board that swings.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Swing {
    /// Degrees.
    pub amplitude_deg: f64,
    /// Hz.
    pub frequency_hz: f64,
    /// Largest rate of the tilt (degrees/s).
    pub rate_deg_s: f64,
    /// How far the real ball got from where it began (units).
    pub travel: f64,
    /// Largest distance of projected gravity with 5/7 to the real ball (units).
    pub projected_off: f64,
    /// The same for a point mass, as the report has it (units).
    pub point_mass_off: f64,
    /// Largest distance of the equation of the rolling sphere to the real ball (units).
    pub equation_off: f64,
    /// When the board threw the ball off, where the comparison ends (s).
    pub thrown_s: Option<f64>,
}

/// A rolling ball that meets a wall head-on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SpinBounce {
    /// Of ball and wall.
    pub restitution: f64,
    /// Speed when it rolls again by that before, with its sign.
    pub measured: f64,
    /// By theory (5 e - 2) / 7: the spin goes on towards the wall and takes its part back.
    pub formula: f64,
}

/// All three.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModelError {
    /// Boards held still.
    pub held: Vec<Held>,
    /// Boards that swing.
    pub swings: Vec<Swing>,
    /// Rolling balls at a wall.
    pub bounces: Vec<SpinBounce>,
}

fn spec(restitution: f64) -> BallSpec {
    let radius = Radius::new(R).unwrap_or(BallSpec::RADIUS);
    BallSpec { radius, restitution, rolling: BallSpec::ROLLING_SPHERE, ..BallSpec::default() }
}

#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few seconds of ticks")]
fn n_ticks(time_s: f64) -> u32 {
    (time_s / TICK_S).round() as u32
}

/// Measures all.
///
/// # Errors
/// None that these numbers can meet; those of the engine.
pub fn measure() -> Result<ModelError, OutOfRange> {
    let swings =
        AMPLITUDES_DEG.iter().flat_map(|amplitude| FREQUENCIES_HZ.map(|frequency| (*amplitude, frequency)));
    Ok(ModelError {
        held: TILTS_DEG.into_iter().map(held).collect::<Result<_, _>>()?,
        swings: swings.map(|(amplitude, frequency)| swing(amplitude, frequency)).collect::<Result<_, _>>()?,
        bounces: [0.5, 0.8, 1.0].into_iter().map(spin_bounce).collect::<Result<_, _>>()?,
    })
}

fn open_board() -> Result<Board, OutOfRange> {
    board(Vec::new())
}

fn board(walls: Vec<Bounds>) -> Result<Board, OutOfRange> {
    Board::from_rectangles(walls).map_err(|_| OutOfRange::not_finite("a wall"))
}

fn held(tilt_deg: f64) -> Result<Held, OutOfRange> {
    let acceleration = Gravity::Constant { tilt_deg: [tilt_deg, 0.0] }.acceleration(0.0);
    let mut engine = RollingEngine::new(&open_board()?, spec(0.8), Ball::default(), TICK_S)?;
    let time_s = 1.0;
    for _ in 0..n_ticks(time_s) {
        engine.tick(acceleration)?;
    }
    Ok(Held { tilt_deg, part: engine.ball().velocity.x / time_s / acceleration.x })
}

/// Angle, rate and its change (radians, 1/s, 1/s²) of a board that swings from its largest tilt on.
fn swinging(amplitude_deg: f64, frequency_hz: f64, time_s: f64) -> [f64; 3] {
    let (amplitude, omega) = (amplitude_deg.to_radians(), std::f64::consts::TAU * frequency_hz);
    let (sin, cos) = (omega * time_s).sin_cos();
    [amplitude * cos, -amplitude * omega * sin, -amplitude * omega * omega * cos]
}

fn swing(amplitude_deg: f64, frequency_hz: f64) -> Result<Swing, OutOfRange> {
    let gravity = Gravity::Sinusoidal { amplitude_deg: [amplitude_deg, 0.0], frequency_hz };
    let mut engine = RollingEngine::new(&open_board()?, spec(0.8), Ball::default(), TICK_S)?;
    let angle = |time_s| swinging(amplitude_deg, frequency_hz, time_s);
    let acceleration = |time_s: f64| -WORLD_GRAVITY.z * angle(time_s)[0].sin();
    let projected = |part: f64| move |time_s: f64, _: [f64; 2]| part * acceleration(time_s);
    let [sphere, point] = [BallSpec::ROLLING_SPHERE, BallSpec::POINT_MASS].map(projected);
    let equation = |time_s: f64, [x, _]: [f64; 2]| {
        let [_, rate, change] = angle(time_s);
        BallSpec::ROLLING_SPHERE * (acceleration(time_s) + rate * rate * x) - R * change
    };
    let (mut by_sphere, mut by_point, mut by_equation) = ([0.0; 2], [0.0; 2], [0.0; 2]);
    let mut swing = Swing {
        amplitude_deg,
        frequency_hz,
        rate_deg_s: amplitude_deg * std::f64::consts::TAU * frequency_hz,
        travel: 0.0,
        projected_off: 0.0,
        point_mass_off: 0.0,
        equation_off: 0.0,
        thrown_s: None,
    };
    for tick in 0..n_ticks(SWING_S) {
        let time_s = f64::from(tick) * TICK_S;
        // The board gets where it shall be by the end of the tick.
        engine.tick(gravity.acceleration(time_s + TICK_S))?;
        if THROWN < engine.height() {
            swing.thrown_s = Some(time_s + TICK_S);
            break;
        }
        by_sphere = runge_kutta(by_sphere, time_s, &sphere);
        by_point = runge_kutta(by_point, time_s, &point);
        by_equation = runge_kutta(by_equation, time_s, &equation);
        let x = engine.ball().position.x;
        swing.travel = swing.travel.max(x.abs());
        swing.projected_off = swing.projected_off.max((by_sphere[0] - x).abs());
        swing.point_mass_off = swing.point_mass_off.max((by_point[0] - x).abs());
        swing.equation_off = swing.equation_off.max((by_equation[0] - x).abs());
    }
    Ok(swing)
}

/// One step of Runge and Kutta's fourth order for position and velocity.
fn runge_kutta([x, v]: [f64; 2], time_s: f64, acceleration: &impl Fn(f64, [f64; 2]) -> f64) -> [f64; 2] {
    let slope = |[x, v]: [f64; 2], time_s| [v, acceleration(time_s, [x, v])];
    let ahead = |[dx, dv]: [f64; 2], step_s: f64| [x + dx * step_s, v + dv * step_s];
    let half_s = TICK_S / 2.0;
    let k1 = slope([x, v], time_s);
    let k2 = slope(ahead(k1, half_s), time_s + half_s);
    let k3 = slope(ahead(k2, half_s), time_s + half_s);
    let k4 = slope(ahead(k3, TICK_S), time_s + TICK_S);
    ahead([0, 1].map(|i| (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]) / 6.0), TICK_S)
}

fn spin_bounce(restitution: f64) -> Result<SpinBounce, OutOfRange> {
    let wall = Bounds { low: Vector2::new(1.0, -5.0), high: Vector2::new(2.0, 5.0) };
    let speed = 3.0;
    let ball = Ball { position: Vector2::zeros(), velocity: Vector2::new(speed, 0.0) };
    let mut engine = RollingEngine::new(&board(vec![wall])?, spec(restitution), ball, TICK_S)?;
    for _ in 0..n_ticks(1.5) {
        engine.tick(Vector2::zeros())?;
    }
    let measured = -engine.ball().velocity.x / speed;
    Ok(SpinBounce { restitution, measured, formula: (5.0 * restitution - 2.0) / 7.0 })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sphere_on_a_held_board_gets_five_sevenths() {
        let held = held(10.0).unwrap();
        assert!((held.part - 5.0 / 7.0).abs() < 2.0e-3, "{}", held.part);
    }

    #[test]
    fn the_equation_of_the_rolling_sphere_and_rapier_agree_where_projection_does_not() {
        let swing = swing(10.0, 0.5).unwrap();
        assert!(swing.equation_off < 0.02 * swing.travel, "{swing:?}");
        assert!(5.0 * swing.equation_off < swing.projected_off, "{swing:?}");
    }

    #[test]
    fn a_rolling_ball_keeps_its_spin_at_a_wall() {
        let bounce = spin_bounce(0.8).unwrap();
        assert!((bounce.measured - bounce.formula).abs() < 0.03, "{bounce:?}");
    }
}
