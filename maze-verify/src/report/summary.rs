//! Who is closer to the truth where, in words made from the numbers.

use super::number::{duration, percent, plain, tick};
use crate::contender::Contender;
use crate::metrics::Metrics;
use crate::results::{Results, SceneResult};
use crate::scene::Family;

/// What a topic speaks of, on one run.
type Value = fn(&Metrics) -> Option<f64>;

/// One question that the report answers with a ranking.
struct Topic {
    title: &'static str,
    asks: &'static str,
    families: &'static [Family],
    value: Value,
    shown: fn(f64) -> String,
    note: &'static str,
}

/// An engine's worst value of a topic.
#[derive(Clone, Debug, PartialEq)]
pub struct Ranked {
    /// Which engine.
    pub engine: Contender,
    /// Its worst value.
    pub worst: f64,
    /// In which scene, with which tick.
    pub scene: String,
}

/// One finding.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// A few words.
    pub title: String,
    /// Sentences.
    pub text: String,
    /// Best first; empty where nothing is ranked.
    pub ranking: Vec<Ranked>,
    /// The same values, ready to show.
    pub shown: Vec<String>,
}

const TOPICS: &[Topic] = &[
    Topic {
        title: "Running on a tilted board",
        asks: "Distance to the true place, by the distance covered",
        families: &[Family::Tilt],
        value: |m| Some(m.errors.as_ref()?.position_part),
        shown: percent,
        note: " On a swinging board rapier-rolling solves the real problem, which projected gravity only approximates: see below.",
    },
    Topic {
        title: "Bouncing off walls",
        asks: "Distance to the true place, by the distance covered",
        families: &[Family::Bounce],
        value: |m| Some(m.errors.as_ref()?.position_part),
        shown: percent,
        note: "",
    },
    Topic {
        title: "Height of the first bounce",
        asks: "Error of the height",
        families: &[Family::Drop],
        value: |m| m.errors.as_ref()?.first_apex_part,
        shown: percent,
        note: "",
    },
    Topic {
        title: "Coming to rest",
        asks: "Error of the time of rest",
        families: &[Family::Drop],
        value: |m| m.errors.as_ref()?.rest_s,
        shown: duration,
        note: " An engine that never comes to rest counts with all the time that is left.",
    },
    Topic {
        title: "Corners",
        asks: "Error of the direction after the bounce",
        families: &[Family::Corner],
        value: |m| m.errors.as_ref()?.angle_deg,
        shown: |value| format!("{}°", plain(value)),
        note: "",
    },
    Topic {
        title: "Grazing a corner",
        asks: "Distance to the true place, by the distance covered",
        families: &[Family::Graze],
        value: |m| Some(m.errors.as_ref()?.position_part),
        shown: percent,
        note: " rapier's contacts begin 0.02 corridors before the touch.",
    },
    Topic {
        title: "Sliding, resting, squeezing through",
        asks: "Distance to the true place, by the distance covered",
        families: &[Family::Slide],
        value: |m| Some(m.errors.as_ref()?.position_part),
        shown: percent,
        note: "",
    },
    Topic {
        title: "A wall made of many pieces",
        asks: "Distance to the true place, by the distance covered",
        families: &[Family::Seams],
        value: |m| Some(m.errors.as_ref()?.position_part),
        shown: percent,
        note: "",
    },
    Topic {
        title: "High speed",
        asks: "Distance to the true place, by the distance covered",
        families: &[Family::Speed],
        value: |m| Some(m.errors.as_ref()?.position_part),
        shown: percent,
        note: "",
    },
    Topic {
        title: "Wedged",
        asks: "Distance of the last place to where the ball must lie, and its distance in a second",
        families: &[Family::Wedge],
        value: |m| m.rest_error,
        shown: plain,
        note: " A ball that got through the gap is off by all that it went on.",
    },
    Topic {
        title: "Rolling over an edge",
        asks: "Distance to the true place, by the distance covered",
        families: &[Family::RollOver, Family::FreeEnd],
        value: |m| Some(m.errors.as_ref()?.position_part),
        shown: percent,
        note: "",
    },
    Topic {
        title: "Steps and slits in a floor",
        asks: "Distance to the true place, by the distance covered",
        families: &[Family::Step, Family::Slit],
        value: |m| Some(m.errors.as_ref()?.position_part),
        shown: percent,
        note: "",
    },
    Topic {
        title: "A corridor as wide as the ball",
        asks: "Distance to the true place, by the distance covered",
        families: &[Family::Narrow],
        value: |m| Some(m.errors.as_ref()?.position_part),
        shown: percent,
        note: "",
    },
    Topic {
        title: "A corridor that is too narrow by 1e-9",
        asks: "Distance of the last place to where the ball must lie, and its distance in a second",
        families: &[Family::Narrow],
        value: |m| m.rest_error,
        shown: plain,
        note: "",
    },
    Topic {
        title: "Penetration",
        asks: "Depth in a wall at a tick's end, in corridors",
        families: &Family::ALL,
        value: |m| Some(m.penetration_max),
        shown: plain,
        note: "",
    },
    Topic {
        title: "Through the wall",
        asks: "Ticks that ended where no path leads",
        families: &Family::ALL,
        value: |m| Some(f64::from(m.n_tunnels)),
        shown: |value| format!("{value:.0}"),
        note: "",
    },
    Topic {
        title: "Energy from nothing",
        asks: "Gain in one tick, by the largest kinetic energy",
        families: &Family::ALL,
        value: |m| Some(m.energy_gain_part),
        shown: percent,
        note: " A board in motion does work on rapier-rolling's ball.",
    },
];

/// Below this a value is rounding of f64, and nobody is better than somebody else.
const ROUNDING: f64 = 1.0e-8;

/// Values this near to each other are told as equal.
const ALIKE: f64 = 0.02;

/// Every finding that the results allow.
pub fn findings(results: &Results) -> Vec<Finding> {
    let mut findings: Vec<Finding> =
        TOPICS.iter().filter_map(|topic| topic.finding(&results.scenes)).collect();
    findings.extend(mazes(&results.scenes));
    findings.extend(speed(&results.scenes));
    findings.extend(model_error(results));
    findings
}

/// The worst of an engine's runs in some families, whatever the tick.
fn worst(scenes: &[SceneResult], engine: Contender, families: &[Family], value: Value) -> Option<Ranked> {
    let scenes = scenes.iter().filter(|scene| families.contains(&scene.family));
    let cases = scenes.flat_map(|scene| scene.cases.iter().map(move |case| (scene, case)));
    let values = cases.filter_map(|(scene, case)| {
        let worst = value(&case.run(engine)?.metrics)?;
        Some(Ranked { engine, worst, scene: format!("{} at {}", scene.name, tick(case.tick_s)) })
    });
    // Of equals the first, which has the longer tick.
    values.reduce(|a, b| if a.worst < b.worst { b } else { a })
}

impl Topic {
    fn finding(&self, scenes: &[SceneResult]) -> Option<Finding> {
        let engines = Contender::ALL.into_iter().filter(|engine| *engine != Contender::ClosedForm);
        let mut ranking: Vec<Ranked> =
            engines.filter_map(|engine| worst(scenes, engine, self.families, self.value)).collect();
        ranking.sort_by(|a, b| a.worst.total_cmp(&b.worst));
        let last = ranking.last()?;
        let shown: Vec<String> = ranking.iter().map(|ranked| (self.shown)(ranked.worst)).collect();
        let groups = groups(&ranking, self.shown);
        let text = match groups.split_last() {
            Some(((last, value), [(first, best), between @ ..])) => {
                let between: String =
                    between.iter().map(|(names, value)| format!(", then {names} ({value})")).collect();
                format!(
                    "Closest to the truth: {first} ({best}){between}. Farthest off: {last} ({value}, in {scene}). {}.{}",
                    self.asks,
                    self.note,
                    scene = ranking.last().map_or("", |ranked| &ranked.scene)
                )
            }
            _ if last.worst < ROUNDING => {
                format!("Nobody is off by more than rounding. {}.{}", self.asks, self.note)
            }
            _ => format!(
                "{} off by {}. {}.{}",
                last.engine.name(),
                (self.shown)(last.worst),
                self.asks,
                self.note
            ),
        };
        Some(Finding { title: self.title.to_owned(), text, ranking, shown })
    }
}

/// Names and value of engines that are equally good, best first.
fn groups(ranking: &[Ranked], shown: fn(f64) -> String) -> Vec<(String, String)> {
    let alike = |a: &Ranked, b: &Ranked| b.worst - a.worst <= ALIKE * b.worst || b.worst < ROUNDING;
    let together = |group: &[Ranked]| {
        let names: Vec<&str> = group.iter().map(|ranked| ranked.engine.name()).collect();
        let worst = group.last().map_or(0.0, |ranked| ranked.worst);
        let value = match worst {
            0.0 => "0".to_owned(),
            worst if worst < ROUNDING => "0 but for rounding".to_owned(),
            worst => shown(worst),
        };
        (listed(&names), value)
    };
    ranking.chunk_by(alike).map(together).collect()
}

/// a, b and c.
fn listed(names: &[&str]) -> String {
    match names {
        [] => String::new(),
        [only] => (*only).to_owned(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied()
}

/// Mazes have no truth: when the engines part, and how alike they are before and after.
fn mazes(scenes: &[SceneResult]) -> Option<Finding> {
    let mazes: Vec<&SceneResult> = scenes.iter().filter(|scene| scene.family == Family::Maze).collect();
    let of = |engine: Contender, value: fn(&Metrics, f64) -> f64| {
        let runs =
            mazes.iter().filter_map(|scene| Some((scene.first_case()?.run(engine)?, scene.duration_s)));
        median(runs.map(|(run, duration_s)| value(&run.metrics, duration_s)).collect())
    };
    let parted = |m: &Metrics, _: f64| m.diverged_s.unwrap_or(f64::MAX);
    let others = [Contender::Published, Contender::RapierCuboids, Contender::RapierRolling];
    let parts: Vec<String> = others
        .into_iter()
        .filter_map(|engine| {
            let after = of(engine, parted)?;
            let told = if after == f64::MAX { "later than the scenes last".into() } else { duration(after) };
            Some(format!("{} after {told}", engine.name()))
        })
        .collect();
    let alike: Vec<String> = Contender::ALL
        .into_iter()
        .filter_map(|engine| {
            let speed = of(engine, |m, _| m.mean_speed)?;
            let bounces = of(engine, |m, duration_s| f64::from(m.n_bounces) / duration_s)?;
            Some(format!("{} {} corridors/s and {} bounces/s", engine.name(), plain(speed), plain(bounces)))
        })
        .collect();
    (!parts.is_empty()).then(|| Finding {
        title: "Mazes: chaos".to_owned(),
        text: format!(
            "In {} random mazes there is no truth, and every corner multiplies a difference. The ball is a radius away from \
             the continuous engine's (median): {}. What stays comparable is how lively the ball is (medians): {}.",
            mazes.len(),
            parts.join(", "),
            alike.join("; ")
        ),
        ranking: Vec::new(),
        shown: Vec::new(),
    })
}

fn speed(scenes: &[SceneResult]) -> Option<Finding> {
    let of = |engine: Contender| {
        let in_maze = scenes.iter().filter(|scene| matches!(scene.family, Family::Maze | Family::Level));
        let runs = in_maze.filter_map(|scene| scene.first_case()?.run(engine));
        median(runs.map(|run| run.metrics.ns_per_tick).collect())
    };
    let ours = of(Contender::Continuous)?;
    let others = Contender::ALL
        .into_iter()
        .filter(|engine| !matches!(engine, Contender::ClosedForm | Contender::Continuous));
    let told: Vec<String> = others
        .filter_map(|engine| {
            of(engine).map(|ns| format!("{} {} ns ({:.1} times)", engine.name(), plain(ns), ns / ours))
        })
        .collect();
    Some(Finding {
        title: "Time a tick".to_owned(),
        text: format!(
            "In a maze (median, on the machine that ran this; reported, never a tolerance): continuous {} ns, {}.",
            plain(ours),
            told.join(", ")
        ),
        ranking: Vec::new(),
        shown: Vec::new(),
    })
}

fn model_error(results: &Results) -> Option<Finding> {
    let model_error = results.model_error.as_ref()?;
    let held = model_error.held.iter().map(|held| (held.part * 7.0 / 5.0 - 1.0).abs()).fold(0.0, f64::max);
    let find_swing = |amplitude_deg: f64| {
        let mut swings = model_error.swings.iter();
        swings.find(|swing| swing.amplitude_deg == amplitude_deg && swing.frequency_hz == 0.5)
    };
    let gentle = find_swing(5.0);
    let wild = find_swing(20.0);
    let told = |swing: &crate::model_error::Swing| {
        format!(
            "±{}° at {} Hz: {} of {} corridors",
            swing.amplitude_deg,
            swing.frequency_hz,
            plain(swing.projected_off),
            plain(swing.travel)
        )
    };
    let n_thrown = model_error.swings.iter().filter(|swing| swing.thrown_s.is_some()).count();
    let bounce = model_error.bounces.iter().find(|bounce| bounce.restitution == 0.8)?;
    Some(Finding {
        title: "The model error: project gravity, forget z".to_owned(),
        text: format!(
            "On a board held still it is right: a real sphere gets 5/7 of the projected acceleration to {}, whatever the tilt. On a \
             board in motion it lacks the board's own turning; after 4 s it is off by ({}). In {n_thrown} of {} swings the \
             board throws the ball off, which the method cannot know. And a real ball keeps its spin at a wall: with \
             restitution 0.8 it returns with {} of its speed and not with 0.8 (theory: {}).",
            percent(held),
            [gentle, wild].into_iter().flatten().map(told).collect::<Vec<_>>().join("; "),
            model_error.swings.len(),
            plain(bounce.measured),
            plain(bounce.formula)
        ),
        ranking: Vec::new(),
        shown: Vec::new(),
    })
}
