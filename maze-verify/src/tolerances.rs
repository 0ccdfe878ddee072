//! What must hold. Each bar is a limit with its reason; a run that misses one ends with exit status 1 and says where.

use crate::contender::Contender::{self, Continuous, Published, RapierCuboids, RapierMesh, RapierRolling};
use crate::metrics::{FirstBounce, Metrics};
use crate::model_error::ModelError;
use crate::results::SceneResult;
use crate::scene;
use crate::scene::Family::{
    self, Bounce, Corner, Drop, FreeEnd, Graze, Level, Maze, Narrow, Own, RollOver, Seams, Slide, Slit,
    Speed, Step, Tilt, Wedge,
};
use serde::{Deserialize, Serialize};

/// A limit on one metric of some engines in some scenes.
pub struct Tolerance {
    /// Of the metric, as in reports.
    pub metric: &'static str,
    /// Whom it binds.
    pub engines: &'static [Contender],
    /// Where.
    pub families: &'static [Family],
    /// Longest tick for which it binds (s).
    pub longest_tick_s: f64,
    /// What is limited; `None` where the scene has no such thing.
    pub value: fn(&Metrics) -> Option<f64>,
    /// Largest value that holds.
    pub limit: f64,
    /// Why this much.
    pub reason: &'static str,
}

/// Where a tolerance was missed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Missed {
    /// Name of the scene.
    pub scene: String,
    /// Length of the tick (s); 0 where it is no matter of ticks.
    pub tick_s: f64,
    /// Which engine.
    pub engine: Contender,
    /// What was measured.
    pub value: f64,
}

/// How a tolerance came out.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Verdict {
    /// Of the metric.
    pub metric: String,
    /// Whom it binds.
    pub engines: Vec<Contender>,
    /// Largest value that holds.
    pub limit: f64,
    /// Why this much.
    pub reason: String,
    /// Runs that were asked.
    pub n_checked: usize,
    /// The largest value of them.
    pub worst: Option<Missed>,
    /// All that were above the limit.
    pub missed: Vec<Missed>,
}

const ALL: &[Family] = &Family::ALL;
const NAMED: &[Family] = &[
    Tilt, Bounce, Drop, Corner, Graze, Slide, Seams, Speed, Wedge, RollOver, Step, Slit, FreeEnd, Narrow,
    Maze, Level,
];
/// Without those families that are about two contacts at once and about edges: of these the report's method knows nothing, and
/// its errors there are told, not bound.
const SINGLE_CONTACTS: &[Family] = &[Tilt, Bounce, Drop, Corner, Graze, Slide, Seams, Speed, Maze, Level];
/// A truth that a user states is held to as well.
const WITH_TRUTH: &[Family] =
    &[Tilt, Bounce, Drop, Corner, Graze, Slide, Seams, Speed, RollOver, Step, Slit, FreeEnd, Narrow, Own];
/// A truth of bounces and of slides, one contact after the other.
const ONE_BY_ONE: &[Family] = &[Tilt, Bounce, Drop, Corner, Graze, Slide, Seams, Speed, Own];
/// Where the contacts are faces.
const FACES: &[Family] = &[Tilt, Bounce, Drop, Slide, Speed];
const PLANAR_RAPIER: &[Contender] = &[RapierCuboids, RapierMesh];
const ANY_TICK: f64 = f64::INFINITY;
/// The finest tick of the catalogue is 0.001 s.
const FINE_TICK: f64 = 0.0011;

/// A rounding of f64 at 10 units is 2e-15; some thousand operations and one division by a small normal speed later it is
/// still below this.
const EXACT: f64 = 1.0e-9;

/// The published engine walks fast ticks in steps of this (units).
const SUBSTEP: f64 = maze_core::engine::SUBSTEP;

/// Of the ball in every named scene (units).
const RADIUS: f64 = 0.25;

/// A push-out by a tick's displacement, v dt, against a acceleration a gives a v dt; by v² / 2 that is 2 a dt / v = 0.094 for the drop from
/// 1 unit at 0.03 s.
const PUBLISHED_GAIN: f64 = 0.1;

/// rapier's steps of 1/1000 s are of first order, its contacts are soft and begin 0.02 units early.
const FEW_PERCENT: f64 = 0.03;

/// How much of what projection leaves the equation of the rolling sphere may leave (1).
const EQUATION_FRACTION: f64 = 0.1;

/// Every tolerance.
pub const TOLERANCES: &[Tolerance] = &[
    Tolerance {
        metric: "apex error",
        engines: &[Continuous],
        families: WITH_TRUTH,
        longest_tick_s: ANY_TICK,
        value: |m| m.errors.as_ref()?.apex,
        limit: EXACT,
        reason: "bounces that rise less than 3e-9 radii (7.5e-10) are rest; all others are exact but for rounding",
    },
    Tolerance {
        metric: "velocity error",
        engines: &[Continuous],
        families: WITH_TRUTH,
        longest_tick_s: ANY_TICK,
        value: |m| m.errors.as_ref()?.velocity,
        limit: EXACT,
        reason: "after the first bounce, exact but for rounding",
    },
    Tolerance {
        metric: "restitution error",
        engines: &[Continuous],
        families: FACES,
        longest_tick_s: ANY_TICK,
        value: |m| m.errors.as_ref()?.restitution,
        limit: EXACT,
        reason: "of the first bounce, exact but for rounding; a graze would divide it by next to nothing",
    },
    Tolerance {
        metric: "angle error",
        engines: &[Continuous],
        families: WITH_TRUTH,
        longest_tick_s: ANY_TICK,
        value: |m| m.errors.as_ref()?.angle_deg,
        limit: EXACT,
        reason: "degrees after the first bounce, exact but for rounding",
    },
    Tolerance {
        metric: "position error",
        engines: &[Continuous],
        families: ONE_BY_ONE,
        longest_tick_s: ANY_TICK,
        value: |m| Some(m.errors.as_ref()?.position),
        limit: 2.0e-9,
        reason: "a bounce that rises less than 3e-9 radii (7.5e-10) is rest, and may be missed on the way up and on the way down",
    },
    Tolerance {
        metric: "position error over steps, slits",
        engines: &[Continuous],
        families: &[Step, Slit],
        longest_tick_s: ANY_TICK,
        value: |m| Some(m.errors.as_ref()?.position),
        limit: 2.0e-9,
        reason: "each edge is rolled over or hit where it is; after it a bounce below 1e-9 is rest, as above",
    },
    Tolerance {
        metric: "position error around edges",
        engines: &[Continuous],
        families: &[RollOver, FreeEnd],
        longest_tick_s: ANY_TICK,
        value: |m| Some(m.errors.as_ref()?.position),
        limit: EXACT,
        reason: "slides, arcs and flights follow one another without a bounce: exact but for rounding, which a ball of 0.001 units/s \
                 on an edge multiplies by 1000",
    },
    Tolerance {
        metric: "position error without play",
        engines: &[Continuous],
        families: &[Narrow],
        longest_tick_s: ANY_TICK,
        value: |m| Some(m.errors.as_ref()?.position),
        limit: EXACT,
        reason: "a corridor as wide as the ball leaves it nothing but the way along: exact but for rounding",
    },
    Tolerance {
        metric: "rest error",
        engines: &[Continuous],
        families: ALL,
        longest_tick_s: ANY_TICK,
        value: |m| m.rest_error,
        limit: EXACT,
        reason: "of the last place, and the distance of a second at the last speed: a ball that is wedged rests where it touches both, \
                 exact but for rounding",
    },
    Tolerance {
        metric: "penetration",
        engines: &[Continuous],
        families: ALL,
        longest_tick_s: ANY_TICK,
        value: |m| Some(m.penetration_max),
        limit: EXACT,
        reason: "0 but for the contact tolerances (8e-12 radii) and rounding",
    },
    Tolerance {
        metric: "tunnels",
        engines: &[Continuous, Published],
        families: ALL,
        longest_tick_s: ANY_TICK,
        value: |m| Some(f64::from(m.n_tunnels)),
        limit: 0.0,
        reason: "a ball that goes through a wall ends the game's world",
    },
    Tolerance {
        metric: "energy gain",
        engines: &[Continuous],
        families: ALL,
        longest_tick_s: ANY_TICK,
        value: |m| Some(m.energy_gain_part),
        limit: EXACT,
        reason: "bounces and rest take energy and never give any, but for rounding",
    },
    Tolerance {
        metric: "overlap corrected",
        engines: &[Continuous],
        families: ALL,
        longest_tick_s: ANY_TICK,
        value: |m| Some(m.corrected_overlap),
        limit: 0.0,
        reason: "the engine keeps the ball outside by itself, and its check at the end of a tick never has to",
    },
    Tolerance {
        metric: "time dropped",
        engines: &[Continuous, Published],
        families: NAMED,
        longest_tick_s: ANY_TICK,
        value: |m| Some(m.dropped_s),
        limit: 0.0,
        reason: "no scene needs more events than the engines' bounds",
    },
    Tolerance {
        metric: "penetration",
        engines: &[Published],
        families: SINGLE_CONTACTS,
        longest_tick_s: ANY_TICK,
        value: |m| Some(m.penetration_max),
        limit: SUBSTEP,
        reason: "what is left after a push-out along a face's normal: at a corner at most a substep",
    },
    Tolerance {
        metric: "penetration before push-out",
        engines: &[Published],
        families: SINGLE_CONTACTS,
        longest_tick_s: ANY_TICK,
        value: |m| Some(m.own_penetration),
        limit: RADIUS,
        reason: "a step is never longer than the ball's radius",
    },
    Tolerance {
        metric: "energy gain",
        engines: &[Published],
        families: SINGLE_CONTACTS,
        longest_tick_s: ANY_TICK,
        value: |m| Some(m.energy_gain_part),
        limit: PUBLISHED_GAIN,
        reason: "of the largest kinetic energy in one tick: a push-out by a tick's displacement against gravity",
    },
    Tolerance {
        metric: "position error",
        engines: PLANAR_RAPIER,
        families: FACES,
        longest_tick_s: FINE_TICK,
        value: |m| Some(m.errors.as_ref()?.position_part),
        limit: FEW_PERCENT,
        reason: "of the distance covered: the scenes are set up alike",
    },
    Tolerance {
        metric: "position error over seams",
        engines: &[RapierMesh],
        families: &[Seams],
        longest_tick_s: FINE_TICK,
        value: |m| Some(m.errors.as_ref()?.position_part),
        limit: FEW_PERCENT,
        reason: "of the distance covered: a mesh with corrected internal edges has no ghost bumps (separate cuboids have, and are not bound)",
    },
    Tolerance {
        metric: "first apex error",
        engines: &[RapierCuboids, RapierMesh, RapierRolling],
        families: &[Drop],
        longest_tick_s: FINE_TICK,
        value: |m| m.errors.as_ref()?.first_apex_part,
        limit: FEW_PERCENT,
        reason: "of the height: the scenes are set up alike",
    },
    Tolerance {
        metric: "angle error",
        engines: PLANAR_RAPIER,
        families: FACES,
        longest_tick_s: FINE_TICK,
        value: |m| m.errors.as_ref()?.angle_deg,
        limit: 0.1,
        reason: "degrees after the first bounce off a face: the scenes are set up alike",
    },
];

/// A limit that is not a matter of one run's metrics.
fn verdict(metric: &str, engines: &[Contender], limit: f64, reason: &str, checked: Vec<Missed>) -> Verdict {
    let n_checked = checked.len();
    let worst = checked.iter().max_by(|a, b| a.value.total_cmp(&b.value)).cloned();
    // Not `limit < value`: what is no number does not hold.
    #[allow(clippy::neg_cmp_op_on_partial_ord, reason = "NaN must miss the bar")]
    let missed = checked.into_iter().filter(|run| !(run.value <= limit)).collect();
    Verdict {
        metric: metric.to_owned(),
        engines: engines.to_vec(),
        limit,
        reason: reason.to_owned(),
        n_checked,
        worst,
        missed,
    }
}

/// Asks every tolerance.
pub fn judge(scenes: &[SceneResult], model_error: Option<&ModelError>) -> Vec<Verdict> {
    let mut verdicts: Vec<Verdict> = TOLERANCES.iter().map(|tolerance| tolerance.judge(scenes)).collect();
    if measures_rapier(scenes) {
        verdicts.push(first_bounces(scenes));
    }
    verdicts.extend(model_error.into_iter().flat_map(relaxed));
    verdicts.retain(|verdict| 0 < verdict.n_checked);
    verdicts
}

/// What rapier itself is off by at first bounces where there is a truth, as the largest over all scenes.
struct OwnError {
    /// Of the velocity after, by the speed before: where nothing accelerations.
    of_speed: f64,
    /// Of the velocity after, by what the acceleration gives while the bounce may happen: off faces.
    of_acceleration: f64,
}

/// One first bounce in this many may be another one than ours.
const UNTOLD: usize = 100;

/// rapier's contacts begin this far before the touch (units).
const RAPIER_MARGIN: f64 = 0.02;

/// What the acceleration gives (units/s) within a tick, and while it passes through rapier's margin: when within these a bounce happens is
/// not rapier's to tell.
fn acceleration_gain(bounce: FirstBounce, tick_s: f64) -> f64 {
    let [incoming, outgoing] = [bounce.velocity_in, bounce.velocity_out].map(nalgebra::Vector2::from);
    let approach = (outgoing - incoming).try_normalize(0.0).map_or(0.0, |normal| -incoming.dot(&normal));
    if approach <= 0.0 {
        bounce.acceleration * tick_s
    } else {
        bounce.acceleration * (tick_s + RAPIER_MARGIN / approach)
    }
}

impl OwnError {
    fn new(scenes: &[SceneResult], engine: Contender, tick_s: f64, at_corner: bool) -> Self {
        let runs = |is_like: &dyn Fn(Family) -> bool| {
            let cases = scenes.iter().filter(|scene| is_like(scene.family)).flat_map(|scene| &scene.cases);
            let runs = cases.filter(|case| case.tick_s == tick_s).filter_map(|case| case.run(engine));
            let firsts = runs
                .filter_map(|run| Some((run.metrics.first_bounce?, run.metrics.errors.as_ref()?.velocity?)));
            firsts.collect::<Vec<_>>()
        };
        let is_face = |family: Family| FACES.contains(&family);
        let is_alike = |family: Family| match at_corner {
            true => matches!(family, Corner | Graze),
            false => is_face(family),
        };
        let without_acceleration = runs(&is_alike).into_iter().filter(|(first, _)| first.acceleration == 0.0);
        let with_acceleration = runs(&is_face).into_iter().filter(|(first, _)| first.acceleration != 0.0);
        let speed = |[x, y]: [f64; 2]| x.hypot(y);
        Self {
            of_speed: without_acceleration
                .map(|(first, off)| off / speed(first.velocity_in))
                .fold(0.0, f64::max),
            of_acceleration: with_acceleration
                .map(|(first, off)| off / acceleration_gain(first, tick_s))
                .fold(0.0, f64::max),
        }
    }

    /// For one bounce (units/s); 0 where there was nothing to measure.
    fn at(&self, bounce: FirstBounce, tick_s: f64) -> f64 {
        let [x, y] = bounce.velocity_in;
        self.of_speed * x.hypot(y) + self.of_acceleration * acceleration_gain(bounce, tick_s)
    }
}

/// Whether every named scene is there that tells rapier's own error: a part of them would make it smaller than it is.
fn measures_rapier(scenes: &[SceneResult]) -> bool {
    let tells = |family: Family| FACES.contains(&family) || matches!(family, Corner | Graze);
    let is_there = |wanted: scene::Scene| scenes.iter().any(|scene| scene.name == wanted.name);
    scene::catalogue().is_ok_and(|named| named.into_iter().filter(|scene| tells(scene.family)).all(is_there))
}

/// In mazes without a truth the first bounces of continuous and rapier differ by no more than rapier's own error.
fn first_bounces(scenes: &[SceneResult]) -> Verdict {
    let mut checked = Vec::new();
    for scene in scenes.iter().filter(|scene| matches!(scene.family, Maze | Level)) {
        for case in &scene.cases {
            let Some(ours) = case.run(Continuous).map(|run| &run.metrics) else { continue };
            let Some(wanted) = ours.first_bounce else { continue };
            for engine in [RapierCuboids, RapierMesh] {
                let Some(seen) = case.run(engine).map(|run| run.metrics.first_bounce) else { continue };
                let own =
                    OwnError::new(scenes, engine, case.tick_s, ours.first_is_corner).at(wanted, case.tick_s);
                if own == 0.0 {
                    continue;
                }
                // Where two bounces lie within few ticks it is not told which engine saw one and which both.
                let off = seen.map_or(f64::MAX, |seen| {
                    let ends = |after: FirstBounce| [after.velocity_out, after.settled];
                    let pairs =
                        ends(seen).into_iter().flat_map(|seen| ends(wanted).map(|wanted| (seen, wanted)));
                    pairs.map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1])).fold(f64::MAX, f64::min)
                });
                let value = off / own;
                checked.push(Missed { scene: scene.name.clone(), tick_s: case.tick_s, engine, value });
            }
        }
    }
    // The worst of a hundred are set aside, as told in the reason.
    checked.sort_by(|a: &Missed, b: &Missed| a.value.total_cmp(&b.value));
    checked.truncate(checked.len() - checked.len() / UNTOLD);
    verdict(
        "first bounce: continuous to rapier",
        &[RapierCuboids, RapierMesh],
        1.0,
        "velocity after it, in units of the error that rapier itself makes at its worst first bounce with a truth; one run in \
         a hundred is set aside, in which a corner is passed within rapier's margin and only rapier bounces, or two walls are \
         met at nearly the same time",
        checked,
    )
}

/// The board that tilts in three dimensions is what it is taken for.
fn relaxed(model_error: &ModelError) -> [Verdict; 3] {
    let missed = |scene: String, value: f64| Missed { scene, tick_s: 0.0, engine: RapierRolling, value };
    let held = model_error.held.iter().map(|held| {
        let off = (held.part / maze_core::BallSpec::ROLLING_SPHERE - 1.0).abs();
        missed(format!("relaxation/held-{}", held.tilt_deg), off)
    });
    let swings = model_error.swings.iter().map(|swing| {
        let name = format!("relaxation/swing-{}-deg-{}-hz", swing.amplitude_deg, swing.frequency_hz);
        missed(name, swing.equation_off / swing.projected_off)
    });
    let bounces = model_error.bounces.iter().map(|bounce| {
        missed(format!("relaxation/bounce-{}", bounce.restitution), (bounce.measured - bounce.formula).abs())
    });
    let engines = &[RapierRolling];
    let reason = "of 5/7: the ball rolls without slipping";
    [
        verdict("rolling factor", engines, 1.0e-3, reason, held.collect()),
        verdict(
            "equation of the rolling sphere",
            engines,
            EQUATION_FRACTION,
            "its distance to rapier by that of projected gravity: what projection leaves out is understood",
            swings.collect(),
        ),
        verdict(
            "bounce with spin",
            engines,
            5.0e-3,
            "speed after by speed before, against (5 e - 2) / 7: the spin is understood",
            bounces.collect(),
        ),
    ]
}

impl Tolerance {
    fn judge(&self, scenes: &[SceneResult]) -> Verdict {
        let mut checked = Vec::new();
        for scene in scenes.iter().filter(|scene| self.families.contains(&scene.family)) {
            for case in scene.cases.iter().filter(|case| case.tick_s <= self.longest_tick_s) {
                for run in case.runs.iter().filter(|run| self.engines.contains(&run.engine)) {
                    checked.extend((self.value)(&run.metrics).map(|value| Missed {
                        scene: scene.name.clone(),
                        tick_s: case.tick_s,
                        engine: run.engine,
                        value,
                    }));
                }
            }
        }
        verdict(self.metric, self.engines, self.limit, self.reason, checked)
    }
}
