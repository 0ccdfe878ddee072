//! What a run found: the content of results.json. The schema is told in docs/verification.md.

use crate::contender::Contender;
use crate::metrics::Metrics;
use crate::model_error::ModelError;
use crate::scene::Family;
use crate::tolerances::{self, Verdict};
use serde::{Deserialize, Serialize};

/// Of results.json; raised when a key changes its meaning or goes.
pub const SCHEMA: u32 = 1;

/// A part of the scenes: every `n`-th, from the `k`-th on, counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Partition {
    /// Which one, 1 to n.
    pub k: usize,
    /// Of how many.
    pub n: usize,
}

impl Partition {
    /// Most parts of a run.
    pub const MAX: usize = 10_000;

    /// All scenes.
    pub const WHOLE: Self = Self { k: 1, n: 1 };

    /// Whether the scene with this place among all that were asked for is in this part.
    pub fn has(self, index: usize) -> bool {
        index % self.n == self.k - 1
    }
}

/// A whole run, or a part of one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Results {
    /// [`SCHEMA`].
    pub schema: u32,
    /// Name and version.
    pub program: String,
    /// Which part of the scenes.
    pub partition: Partition,
    /// How many scenes were asked for, in all parts together.
    pub n_scenes: usize,
    /// In the order of the catalogue.
    pub scenes: Vec<SceneResult>,
    /// In the first part, and when all engines ran.
    #[serde(rename = "relaxation")]
    pub model_error: Option<ModelError>,
    /// What was demanded and whether it holds.
    pub verdicts: Vec<Verdict>,
}

/// A scene and its runs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SceneResult {
    /// Place among all scenes that were asked for, from 0.
    pub index: usize,
    /// As on the command line.
    pub name: String,
    /// One sentence.
    pub about: String,
    /// What it is about.
    pub family: Family,
    /// How long (s).
    pub duration_s: f64,
    /// Of the ball (units).
    pub radius: f64,
    /// Of the ball (1).
    pub restitution: f64,
    /// Of the ball (1).
    pub rolling: f64,
    /// Solid rectangles: left, below, right, above (units).
    pub walls: Vec<[f64; 4]>,
    /// One for each tick length.
    pub cases: Vec<CaseResult>,
}

/// All engines with one tick length.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CaseResult {
    /// Length of a tick (s).
    pub tick_s: f64,
    /// In the order of [`Contender::ALL`].
    pub runs: Vec<RunResult>,
}

/// One engine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RunResult {
    /// Which one.
    pub engine: Contender,
    /// What was measured.
    pub metrics: Metrics,
    /// The centre's path, thinned (units); for the scene's first tick length only.
    pub path: Vec<[f64; 2]>,
    /// Time (s) and distance (units) to closed form, else to the continuous engine; thinned, largest of each stretch.
    pub distance: Vec<[f64; 2]>,
    /// Time (s) and energy (units²/s², for a mass of 1, less the work of gravity), where there is a truth; thinned likewise.
    pub energy: Vec<[f64; 2]>,
}

impl Results {
    /// Puts scenes in order and asks every tolerance.
    pub fn new(
        partition: Partition,
        n_scenes: usize,
        mut scenes: Vec<SceneResult>,
        model_error: Option<ModelError>,
    ) -> Self {
        scenes.sort_by_key(|scene| scene.index);
        let verdicts = tolerances::judge(&scenes, model_error.as_ref());
        let program = concat!(env!("CARGO_PKG_NAME"), " ", env!("CARGO_PKG_VERSION")).to_owned();
        Self { schema: SCHEMA, program, partition, n_scenes, scenes, model_error, verdicts }
    }

    /// Whether every tolerance holds.
    pub fn held(&self) -> bool {
        self.verdicts.iter().all(|verdict| verdict.missed.is_empty())
    }

    /// Joins the parts of one run.
    ///
    /// # Errors
    /// Parts of different runs or schemas, a part twice, or one that is missing, in words.
    pub fn merge(parts: Vec<Self>) -> Result<Self, String> {
        let Some(first) = parts.first() else { return Err("no part given".to_owned()) };
        let (n, n_scenes, program) = (first.partition.n, first.n_scenes, first.program.clone());
        if !(1..=Partition::MAX).contains(&n) {
            return Err(format!("a run in {n} parts: expected 1 to {}", Partition::MAX));
        }
        let mut seen = vec![false; n];
        for part in &parts {
            if (part.partition.n, part.n_scenes) != (n, n_scenes) || part.program != program {
                return Err("the parts are not of one run".to_owned());
            }
            let slot = part.partition.k.checked_sub(1).and_then(|index| seen.get_mut(index));
            match slot {
                Some(seen) if !*seen => *seen = true,
                _ => return Err(format!("part {}/{n} is there twice", part.partition.k)),
            }
        }
        if let Some(missing) = seen.iter().position(|seen| !seen) {
            return Err(format!("part {}/{n} is missing", missing + 1));
        }
        let mut model_error = None;
        let mut scenes = Vec::new();
        for part in parts {
            model_error = model_error.or(part.model_error);
            scenes.extend(part.scenes);
        }
        if scenes.len() != n_scenes {
            return Err(format!("{} scenes in all parts: expected {n_scenes}", scenes.len()));
        }
        Ok(Self::new(Partition::WHOLE, n_scenes, scenes, model_error))
    }
}

impl SceneResult {
    /// Engine and metrics of every run with the scene's first tick length.
    pub fn first_case(&self) -> Option<&CaseResult> {
        self.cases.first()
    }
}

impl CaseResult {
    /// The run of one engine.
    pub fn run(&self, engine: Contender) -> Option<&RunResult> {
        self.runs.iter().find(|run| run.engine == engine)
    }
}
