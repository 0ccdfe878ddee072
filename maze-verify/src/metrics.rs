//! What is measured on a track. Every definition stands in docs/verification.md; none asks an engine for its opinion,
//! except where the name says so.

use crate::scene::Stage;
use maze_core::{Ball, Tick};
use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

/// A part of the approach that an impulse must reach to be a bounce (1): above what f32 makes of a ball that slides.
const BOUNCE_FRACTION: f64 = 1.0e-3;

/// Slower than this (units/s) to the end is rest: a corridor takes a hundred seconds.
pub const REST_SPEED: f64 = 0.01;

/// And for at least this long (s).
const REST_S: f64 = 0.1;

/// A ball that shall lie at rest in the end is off by its displacement in this time (s) too.
const AFTER_REST_S: f64 = 1.0;

/// Deeper than this (units) is counted as a tick in a wall: above the rounding of f32 at 10 units (1e-6), far below what
/// is seen.
pub const COUNTED_DEPTH: f64 = 1.0e-4;

/// Energies are told as parts of the largest kinetic energy, but at least of a fall by one radius (units/s²): a ball that
/// only lies has none.
const REST_ENERGY: f64 = 9.81;

/// Two balls this far apart (units) have diverged: a radius of the scenes' ball.
pub const DIVERGED: f64 = 0.25;

/// Bounces this few ticks after the first belong to it when engines are compared.
const SETTLE_TICKS: usize = 2;

/// A flight shorter than this many ticks has no apex that could be read from the ends of ticks.
const MIN_FLIGHT_TICKS: usize = 4;

/// An engine's run: the ball at the start and after every tick, finite throughout.
#[derive(Clone, Debug)]
pub struct Track {
    /// Length of a tick (s).
    pub tick_s: f64,
    /// One more than there are ticks.
    pub balls: Vec<Ball>,
    /// Acceleration of the centre in each tick (units/s²), rolling included.
    pub accelerations: Vec<Vector2<f64>>,
    /// What the engine said of each tick.
    pub ticks: Vec<Tick>,
    /// Time that the engine took (s).
    pub taken_s: f64,
}

/// A bounce as it shows from the ends of ticks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounce {
    /// The tick in which the velocity began to change.
    pub first_tick: usize,
    /// Before.
    pub velocity_in: Vector2<f64>,
    /// After.
    pub velocity_out: Vector2<f64>,
    /// Unit direction of the impulse, out of the wall.
    pub normal: Vector2<f64>,
}

/// The first bounce in numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FirstBounce {
    /// End of the tick in which it began (s).
    pub time_s: f64,
    /// Speed along the impulse after, by that before.
    pub restitution: f64,
    /// Direction of the velocity after (degrees from +x, -180 to 180).
    pub angle_deg: f64,
    /// Velocity before (units/s).
    pub velocity_in: [f64; 2],
    /// Velocity after (units/s).
    pub velocity_out: [f64; 2],
    /// Acceleration of the centre in its tick (units/s²).
    #[serde(rename = "pull")]
    pub acceleration: f64,
    /// Velocity after all bounces that begin within `SETTLE_TICKS` (units/s): in a concave corner one engine meets both
    /// walls in the tick in which another meets the first.
    pub settled: [f64; 2],
}

/// Against closed form.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Errors {
    /// Largest distance to the true position at any tick's end (units).
    pub position: f64,
    /// The same by the distance that the true ball covered in the scene.
    pub position_part: f64,
    /// Of the first bounce (1).
    pub restitution: Option<f64>,
    /// Of the direction after the first bounce (degrees).
    pub angle_deg: Option<f64>,
    /// Of the velocity after the first bounce (units/s).
    pub velocity: Option<f64>,
    /// Largest of all apexes (units).
    pub apex: Option<f64>,
    /// Of the first apex, by the true one.
    pub first_apex_part: Option<f64>,
    /// Mean difference of the energy at the ticks' ends, by the largest kinetic energy of the true ball.
    pub energy_part: f64,
    /// Of the time of rest (s).
    pub rest_s: Option<f64>,
}

/// All of one run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Metrics {
    /// Ticks that ran.
    pub n_ticks: u32,
    /// Bounces seen.
    pub n_bounces: u32,
    /// The first of them.
    pub first_bounce: Option<FirstBounce>,
    /// Whether the first was at a corner, as the engine said.
    pub first_is_corner: bool,
    /// Heights of the flights between bounces (units); only where a wall lies below.
    pub apexes: Vec<f64>,
    /// Deepest in a wall at a tick's end (units).
    pub penetration_max: f64,
    /// 99 % of the ticks end less deep (units).
    pub penetration_p99: f64,
    /// Ticks that end deeper than [`COUNTED_DEPTH`].
    pub n_penetrating: u32,
    /// Deepest that the engine itself met before it pushed the ball out (units).
    pub own_penetration: f64,
    /// Ticks that end where no path leads.
    pub n_tunnels: u32,
    /// Largest gain of energy in one tick (units²/s²).
    pub energy_gain: f64,
    /// The same by the largest kinetic energy of the run (at least that of a fall by one radius).
    pub energy_gain_part: f64,
    /// From when on it rests (s).
    pub rest_s: Option<f64>,
    /// Distance of the last place to where the ball lies by formula, and the distance of a second at the last speed (units); only
    /// where that place is known.
    pub rest_error: Option<f64>,
    /// Mean speed (units/s).
    pub mean_speed: f64,
    /// Farthest from the start (units).
    pub reach: f64,
    /// Time that the engine dropped (s).
    pub dropped_s: f64,
    /// Deepest overlap that the engine's own check at the end of a tick had to correct (units); 0 for engines without one.
    #[serde(default)]
    pub corrected_overlap: f64,
    /// When it parted from the continuous engine (s).
    pub diverged_s: Option<f64>,
    /// Time a tick (ns); depends on the machine.
    pub ns_per_tick: f64,
    /// Against closed form.
    pub errors: Option<Errors>,
}

impl Track {
    /// Energy at each tick's end: v²/2 less the work of gravity since the start (units²/s²).
    pub fn energies(&self) -> Vec<f64> {
        let mut work = 0.0;
        let after = self.balls.windows(2).zip(&self.accelerations).map(|(pair, acceleration)| {
            work += acceleration.dot(&(pair[1].position - pair[0].position));
            pair[1].velocity.norm_squared() / 2.0 - work
        });
        let start = self.balls[0].velocity.norm_squared() / 2.0;
        std::iter::once(start).chain(after).collect()
    }

    /// Bounces in order.
    pub fn bounces(&self) -> Vec<Bounce> {
        let mut bounces: Vec<Bounce> = Vec::new();
        let mut last_tick = usize::MAX;
        for (index, (pair, acceleration)) in self.balls.windows(2).zip(&self.accelerations).enumerate() {
            let gain = *acceleration * self.tick_s;
            let impulse = pair[1].velocity - pair[0].velocity - gain;
            let Some(normal) = impulse.try_normalize(0.0) else { continue };
            let approach = -pair[0].velocity.dot(&normal);
            // A ball that lies on a wall gets an impulse each tick, but does not come from anywhere.
            if approach <= BOUNCE_FRACTION * pair[0].velocity.norm() + 1.5 * gain.norm()
                || impulse.norm() <= BOUNCE_FRACTION * pair[0].velocity.norm() + 1.5 * gain.norm()
            {
                continue;
            }
            match bounces.last_mut() {
                // A bounce may be spread over ticks.
                Some(last) if last_tick.wrapping_add(1) == index && 0.9 < last.normal.dot(&normal) => {
                    last.velocity_out = pair[1].velocity;
                }
                _ => bounces.push(Bounce {
                    first_tick: index,
                    velocity_in: pair[0].velocity,
                    velocity_out: pair[1].velocity,
                    normal,
                }),
            }
            last_tick = index;
        }
        bounces
    }

    /// Apexes above the wall that a constant acceleration accelerations towards: of each flight the vertex of the parabola through
    /// its highest sample. They end with the first flight too short to tell.
    pub fn apexes(
        &self,
        height: impl Fn(Vector2<f64>) -> f64,
        down: Vector2<f64>,
        acceleration: f64,
    ) -> Vec<f64> {
        let rising: Vec<f64> = self.balls.iter().map(|ball| -ball.velocity.dot(&down)).collect();
        let mut apexes = Vec::new();
        let mut last_top = 0;
        for index in 1..self.balls.len() {
            if !(0.0 < rising[index - 1] && rising[index] <= 0.0) {
                continue;
            }
            if index - last_top < MIN_FLIGHT_TICKS {
                break;
            }
            last_top = index;
            let top = if rising[index - 1] < -rising[index] { index - 1 } else { index };
            apexes.push(height(self.balls[top].position) + rising[top] * rising[top] / (2.0 * acceleration));
        }
        apexes
    }

    fn rest_s(&self) -> Option<f64> {
        let still = |ball: &Ball| ball.velocity.norm() < REST_SPEED;
        let n_still = self.balls.iter().rev().take_while(|ball| still(ball)).count();
        // Shorter than this at the end may be a turning point.
        let is_rest = REST_S <= n_still as f64 * self.tick_s;
        is_rest.then(|| (self.balls.len() - n_still) as f64 * self.tick_s)
    }

    /// How far from rest at a place it ends (units).
    fn rest_error(&self, place: Vector2<f64>) -> f64 {
        let last = self.balls[self.balls.len() - 1];
        (last.position - place).norm() + last.velocity.norm() * AFTER_REST_S
    }

    fn distance_covered(&self) -> f64 {
        self.balls.windows(2).map(|pair| (pair[1].position - pair[0].position).norm()).sum()
    }

    /// Distance to another track at each tick's end.
    pub fn distances(&self, other: &Self) -> Vec<f64> {
        let pairs = self.balls.iter().zip(&other.balls);
        pairs.map(|(a, b)| (a.position - b.position).norm()).collect()
    }
}

fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, f64::max)
}

fn angle_deg(velocity: Vector2<f64>) -> f64 {
    velocity.y.atan2(velocity.x).to_degrees()
}

/// Between two directions (degrees), well told also where they are nearly the same; `None` when one of them is no direction.
fn angle_between_deg(a: Vector2<f64>, b: Vector2<f64>) -> Option<f64> {
    let slow = 1.0e-9;
    (slow < a.norm() && slow < b.norm()).then(|| a.perp(&b).atan2(a.dot(&b)).abs().to_degrees())
}

/// Height above the wall that a constant gravity accelerations towards, if the scene has a closed form that knows it.
fn drop_of(stage: &Stage) -> Option<(usize, f64, f64, f64)> {
    let crate::engine::Motion::Room { low, high } = stage.scene.truth.as_ref()? else { return None };
    if !stage.scene.gravity.is_constant() {
        return None;
    }
    let acceleration = stage.scene.gravity.acceleration(0.0) * stage.scene.spec.rolling;
    let axis = acceleration.iamax();
    let acceleration = acceleration[axis];
    let (wall, sign) = if acceleration < 0.0 { (low[axis]?, 1.0) } else { (high[axis]?, -1.0) };
    (acceleration != 0.0).then_some((axis, wall, sign, acceleration.abs()))
}

/// Measures a track on its own, and against the truth and the continuous engine where these ran.
pub fn measure(stage: &Stage, track: &Track, truth: Option<&Track>, continuous: Option<&Track>) -> Metrics {
    let (board, radius) = (&stage.board, stage.scene.spec.radius.units());
    let mut depths: Vec<f64> =
        track.balls[1..].iter().map(|ball| board.penetration(ball.position, radius)).collect();
    let penetration_max = largest(depths.iter().copied());
    let n_penetrating = depths.iter().filter(|depth| COUNTED_DEPTH < **depth).count();
    depths.sort_by(f64::total_cmp);
    let n_tunnels = (1..track.balls.len()).filter(|index| has_tunnelled(stage, track, *index)).count();
    let energies = track.energies();
    let energy_gain = largest(energies.windows(2).map(|pair| pair[1] - pair[0]));
    let kinetic = largest(track.balls.iter().map(|ball| ball.velocity.norm_squared() / 2.0));
    let bounces = track.bounces();
    let start = track.balls[0].position;
    let n_ticks = track.ticks.len() as f64;
    let count = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
    Metrics {
        n_ticks: count(track.ticks.len()),
        n_bounces: count(bounces.len()),
        first_bounce: first_bounce(&bounces, track),
        first_is_corner: track
            .ticks
            .iter()
            .find(|tick| 0 < tick.n_hits)
            .is_some_and(|tick| 0 < tick.n_corner_hits),
        apexes: apexes_of(stage, track),
        penetration_max,
        penetration_p99: depths[(depths.len() * 99 / 100).min(depths.len() - 1)],
        n_penetrating: count(n_penetrating),
        own_penetration: largest(track.ticks.iter().map(|tick| tick.deepest_penetration)),
        n_tunnels: count(n_tunnels),
        energy_gain,
        energy_gain_part: energy_gain / kinetic.max(REST_ENERGY * radius),
        rest_s: track.rest_s(),
        rest_error: stage.scene.rest.map(|place| track.rest_error(place)),
        mean_speed: track.balls.iter().map(|ball| ball.velocity.norm()).sum::<f64>() / (n_ticks + 1.0),
        reach: largest(track.balls.iter().map(|ball| (ball.position - start).norm())),
        dropped_s: track.ticks.iter().map(|tick| tick.dropped_s).sum(),
        corrected_overlap: largest(track.ticks.iter().map(|tick| tick.corrected_overlap)),
        diverged_s: continuous.and_then(|other| diverged_s(track, other)),
        ns_per_tick: track.taken_s / n_ticks * 1.0e9,
        errors: truth.map(|truth| errors(stage, track, truth)),
    }
}

fn first_bounce(bounces: &[Bounce], track: &Track) -> Option<FirstBounce> {
    let bounce = bounces.first()?;
    let last = bounces.iter().rfind(|next| next.first_tick <= bounce.first_tick + SETTLE_TICKS)?;
    let time_s = (bounce.first_tick + 1) as f64 * track.tick_s;
    Some(FirstBounce {
        time_s,
        restitution: bounce.velocity_out.dot(&bounce.normal) / -bounce.velocity_in.dot(&bounce.normal),
        angle_deg: angle_deg(bounce.velocity_out),
        velocity_in: bounce.velocity_in.into(),
        velocity_out: bounce.velocity_out.into(),
        acceleration: track.accelerations[bounce.first_tick].norm(),
        settled: last.velocity_out.into(),
    })
}

/// Whether no path that the ball can have gone in the tick leads from where it was to where it is.
fn has_tunnelled(stage: &Stage, track: &Track, index: usize) -> bool {
    let (before, after) = (track.balls[index - 1], track.balls[index]);
    let gain = track.accelerations[index - 1].norm() * track.tick_s;
    let speed = before.velocity.norm().max(after.velocity.norm()) + gain;
    // Twice the distance, and what a push out of a wall may add.
    let distance = 2.0 * speed * track.tick_s + stage.scene.spec.radius.units();
    !stage.board.can_have_moved(before.position, after.position, distance)
}

fn apexes_of(stage: &Stage, track: &Track) -> Vec<f64> {
    let Some((axis, wall, sign, acceleration)) = drop_of(stage) else { return Vec::new() };
    let radius = stage.scene.spec.radius.units();
    let mut down = Vector2::zeros();
    down[axis] = -sign;
    track.apexes(|position| (position[axis] - wall) * sign - radius, down, acceleration)
}

fn diverged_s(track: &Track, other: &Track) -> Option<f64> {
    let index = track.distances(other).iter().position(|distance| DIVERGED < *distance)?;
    Some(index as f64 * track.tick_s)
}

fn errors(stage: &Stage, track: &Track, truth: &Track) -> Errors {
    let position = largest(track.distances(truth));
    let kinetic = largest(truth.balls.iter().map(|ball| ball.velocity.norm_squared() / 2.0));
    let (ours, theirs) = (track.energies(), truth.energies());
    let energy = ours.iter().zip(&theirs).map(|(a, b)| (a - b).abs()).sum::<f64>() / ours.len() as f64;
    let (seen, wanted) = (track.bounces(), truth.bounces());
    let first = wanted.first().map(|wanted| (seen.first(), wanted));
    // A bounce that did not happen is off by all of it.
    let at_first = |of: &dyn Fn(&Bounce, &Bounce) -> Option<f64>, missing: f64| {
        first.and_then(|(seen, wanted)| seen.map_or(Some(missing), |seen| of(seen, wanted)))
    };
    let restitution = |bounce: &Bounce, normal: Vector2<f64>| {
        bounce.velocity_out.dot(&normal) / -bounce.velocity_in.dot(&normal)
    };
    let apexes: Vec<(f64, f64)> = apex_pairs(&apexes_of(stage, track), &apexes_of(stage, truth));
    let has_apexes = !apexes.is_empty();
    Errors {
        position,
        position_part: position / truth.distance_covered().max(stage.scene.spec.radius.units()),
        restitution: at_first(
            &|seen, wanted| {
                Some((restitution(seen, wanted.normal) - restitution(wanted, wanted.normal)).abs())
            },
            1.0,
        ),
        angle_deg: at_first(&|seen, wanted| angle_between_deg(seen.velocity_out, wanted.velocity_out), 180.0),
        velocity: at_first(
            &|seen, wanted| Some((seen.velocity_out - wanted.velocity_out).norm()),
            wanted.first().map_or(0.0, |bounce| (bounce.velocity_out - bounce.velocity_in).norm()),
        ),
        apex: has_apexes.then(|| largest(apexes.iter().map(|(seen, wanted)| (seen - wanted).abs()))),
        first_apex_part: apexes.first().map(|(seen, wanted)| (seen - wanted).abs() / wanted),
        energy_part: energy / kinetic.max(REST_ENERGY * stage.scene.spec.radius.units()),
        rest_s: match (track.rest_s(), truth.rest_s()) {
            (Some(seen), Some(wanted)) => Some((seen - wanted).abs()),
            (None, Some(wanted)) => Some(stage.scene.duration_s - wanted),
            _ => None,
        },
    }
}

/// Each true apex with the one seen; one that was not seen is 0 high.
fn apex_pairs(seen: &[f64], wanted: &[f64]) -> Vec<(f64, f64)> {
    let pair = |(index, wanted): (usize, &f64)| (seen.get(index).copied().unwrap_or(0.0), *wanted);
    wanted.iter().enumerate().map(pair).collect()
}
