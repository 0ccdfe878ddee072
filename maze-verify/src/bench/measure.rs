//! A run of the benchmark: every size, every question, every contender.

use super::agreement::{Built, check};
use super::case::{Case, QuerySet, STEPS};
use super::figures::{Figures, Group};
use super::machine::Machine;
use super::paired::{Runner, Series, time};
use super::search::{Contender, in_turn};
use cpu_time::ProcessTime;
use std::time::Duration;

/// Names of the random queries, one a length of [`STEPS`].
const RANDOM: [&str; STEPS.len()] = ["random 0.01", "random 0.1", "random 1", "random 10"];

/// The name of the queries of a rolling ball.
const COHERENT: &str = "rolling ball";

/// The name of the time that it takes to make a structure.
const BUILD: &str = "build (a plane)";

/// Mazes of up to so many planes are built again each round; larger ones, which take seconds, a tenth as often.
const BUILT_AGAIN: usize = 20_000;

/// How much is measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Cells along a tile and tiles along a maze, one pair a size.
    pub sizes: Vec<[usize; 2]>,
    /// The same for the questions about whole ticks.
    pub tick_sizes: Vec<[usize; 2]>,
    /// Queries of each kind that all contenders answer before any is timed.
    pub n_checked: usize,
    /// Queries of each kind that are asked in turn: so many that caches do not hold what the last round has read.
    pub n_queries: usize,
    /// Times that every contender has its turn.
    pub n_rounds: usize,
    /// Least time of a turn.
    pub batch: Duration,
}

impl Plan {
    /// Under a minute: about 10², 10³, 10⁴, 10⁵ and 10⁶ planes.
    pub fn quick() -> Self {
        let sizes = vec![[9, 1], [27, 1], [27, 3], [27, 10], [27, 32]];
        Self {
            tick_sizes: sizes.clone(),
            sizes,
            n_checked: 10_000,
            n_queries: 100_000,
            n_rounds: 5,
            batch: Duration::from_millis(2),
        }
    }

    /// Minutes: up to about 10⁷ planes.
    pub fn full() -> Self {
        let mut sizes = Self::quick().sizes;
        let mut tick_sizes = sizes.clone();
        sizes.push([27, 100]);
        // In between, a maze of about 10⁶ walls: as many colliders, for who takes each as one.
        tick_sizes.extend([[27, 50], [27, 100]]);
        Self { sizes, tick_sizes, n_rounds: 25, batch: Duration::from_millis(20), ..Self::quick() }
    }
}

impl Plan {
    /// Only mazes of at most about so many planes.
    #[must_use]
    pub fn up_to(mut self, n_planes: usize) -> Self {
        // 1.388 planes a cell and a few more, of tiles as large as these.
        for sizes in [&mut self.sizes, &mut self.tick_sizes] {
            sizes.retain(|[tile, n_tiles]| 1388 * (tile * n_tiles).pow(2) / 1000 <= n_planes);
        }
        self
    }

    /// Every kind of queries in a maze.
    ///
    /// # Errors
    /// As [`Case::coherent`].
    pub fn query_sets(&self, case: &Case) -> Result<Vec<QuerySet>, BenchError> {
        let random = RANDOM.into_iter().zip(STEPS);
        let mut sets: Vec<QuerySet> =
            random.map(|(name, step)| case.random(name, step, self.n_queries)).collect::<Result<_, _>>()?;
        sets.push(case.coherent(COHERENT, self.n_queries)?);
        Ok(sets)
    }
}

/// Why there are no figures.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BenchError {
    /// A maze, a structure or an engine could not be made.
    #[error("the benchmark cannot be set up: {0}")]
    SetUp(String),
}

impl BenchError {
    pub(super) fn set_up(reason: impl ToString) -> Self {
        Self::SetUp(reason.to_string())
    }
}

/// How often [`measure`] reports what comes next.
pub fn n_steps(plan: &Plan) -> usize {
    plan.sizes.len() * (1 + RANDOM.len() + 1)
}

/// Measures all searches; `on_step` hears what comes next.
///
/// Contenders whose answers are wrong are timed all the same; [`Figures::held`] is false, and the table names them.
///
/// # Errors
/// A maze, a structure or an engine that cannot be made.
pub fn measure(plan: &Plan, contenders: &[Contender], on_step: &dyn Fn(&str)) -> Result<Figures, BenchError> {
    let mut figures = Figures { machine: Machine::here(), groups: Vec::new(), comparisons: Vec::new() };
    for [tile, n_tiles] in &plan.sizes {
        let case = Case::new(*tile, *n_tiles)?;
        let n_planes = case.planes().len();
        on_step(&format!("building, {n_planes} planes"));
        let (mut built, group_of_builds) = build_all(plan, &case, contenders)?;
        figures.groups.push(group_of_builds);
        for set in plan.query_sets(&case)? {
            on_step(&format!("{}, {n_planes} planes", set.name));
            let (comparisons, touches) = check(&mut built, n_planes, &set, plan.n_checked);
            figures.comparisons.extend(comparisons);
            let series = time_all(plan, &mut built, &set);
            figures.groups.push(Group { question: set.name, n_planes, touches: Some(touches), series });
        }
    }
    Ok(figures)
}

/// Makes every contender's structure, the small ones several times in turn.
fn build_all<'a>(
    plan: &Plan,
    case: &Case,
    contenders: &'a [Contender],
) -> Result<(Vec<Built<'a>>, Group), BenchError> {
    let n_planes = case.planes().len();
    let taking_part = || contenders.iter().filter(|contender| n_planes <= contender.max_planes);
    let mut series: Vec<Series> =
        taking_part().map(|contender| Series { name: contender.name, ns: Vec::new() }).collect();
    let mut built = Vec::new();
    let n_rounds = if n_planes <= BUILT_AGAIN { plan.n_rounds } else { plan.n_rounds.div_ceil(10) };
    for _ in 0..n_rounds {
        built.clear();
        for (contender, series) in taking_part().zip(&mut series) {
            let start = ProcessTime::now();
            built.push((contender, (contender.build)(case)?));
            #[allow(clippy::cast_precision_loss, reason = "counts far below 2^53")]
            series.ns.push(start.elapsed().as_secs_f64() * 1.0e9 / n_planes.max(1) as f64);
        }
    }
    Ok((built, Group { question: BUILD, n_planes, touches: None, series }))
}

/// All in turn on the same queries.
fn time_all(plan: &Plan, built: &mut [Built], set: &QuerySet) -> Vec<Series> {
    let mut runners: Vec<Runner> = built
        .iter_mut()
        .map(|(contender, search)| Runner {
            name: contender.name,
            run: in_turn(search.as_mut(), &set.queries),
        })
        .collect();
    time(&mut runners, plan.n_rounds, plan.batch)
}
