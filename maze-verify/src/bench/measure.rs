//! A run of the benchmark: every size, every question, every contender.

use super::agreement::{Agreement, Disagreement, answers, compare};
use super::case::{Case, QuerySet, STEPS};
use super::figures::{Figures, Group};
use super::machine::Machine;
use super::paired::{Runner, time};
use super::search::{Contender, Search};
use super::tick;
use std::time::Duration;

/// Names of the random queries, one a length of [`STEPS`].
const RANDOM: [&str; STEPS.len()] = ["random 0.01", "random 0.1", "random 1", "random 10"];

/// The name of the queries of a rolling ball.
const COHERENT: &str = "rolling ball";

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
        Self { sizes, tick_sizes, n_rounds: 21, batch: Duration::from_millis(8), ..Self::quick() }
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

/// Measures all; `on_step` hears what comes next and how many steps there are.
///
/// Contenders that do not agree are not timed at that size; [`Figures::disagreements`] names them.
///
/// # Errors
/// A maze, a structure or an engine that cannot be made.
pub fn measure(
    plan: &Plan,
    contenders: &[Contender],
    on_step: &dyn Fn(&str, usize),
) -> Result<Figures, BenchError> {
    let mut figures = Figures { machine: Machine::here(), groups: Vec::new(), disagreements: Vec::new() };
    let n_steps = plan.sizes.len() * (1 + RANDOM.len() + 1) + tick::n_steps(plan);
    for [tile, n_tiles] in &plan.sizes {
        let case = Case::new(*tile, *n_tiles)?;
        let n_planes = case.planes().len();
        on_step(&format!("building, {n_planes} planes"), n_steps);
        let mut built = Vec::new();
        for contender in contenders.iter().filter(|contender| n_planes <= contender.max_planes) {
            built.push((contender, (contender.build)(&case)?));
        }
        for set in query_sets(&case, plan)? {
            on_step(&format!("{}, {n_planes} planes", set.name), n_steps);
            check(&mut figures.disagreements, plan, n_planes, &mut built, &set);
            figures.groups.push(group(plan, n_planes, &mut built, &set));
        }
    }
    tick::measure(plan, &mut figures, &|what| on_step(what, n_steps))?;
    Ok(figures)
}

fn query_sets(case: &Case, plan: &Plan) -> Result<Vec<QuerySet>, BenchError> {
    let random = RANDOM.into_iter().zip(STEPS);
    let mut sets: Vec<QuerySet> =
        random.map(|(name, step)| case.random(name, step, plan.n_queries)).collect();
    sets.push(case.coherent(COHERENT, plan.n_queries)?);
    Ok(sets)
}

type Built<'a> = (&'a Contender, Box<dyn Search>);

/// All answer the same queries before any is timed.
fn check(
    disagreements: &mut Vec<Disagreement>,
    plan: &Plan,
    n_planes: usize,
    built: &mut [Built],
    set: &QuerySet,
) {
    let Some(((_, reference), others)) = built.split_first_mut() else { return };
    let truth = answers(reference.as_mut(), set, plan.n_checked);
    for (contender, search) in others {
        if matches!(contender.agreement, Agreement::OtherQuestion(_)) {
            continue;
        }
        let given = answers(search.as_mut(), set, plan.n_checked);
        let found = compare(contender.name, contender.agreement, n_planes, set, [&truth, &given]);
        disagreements.extend(found.filter(|found| 0 < found.n_different));
    }
}

fn group(plan: &Plan, n_planes: usize, built: &mut [Built], set: &QuerySet) -> Group {
    let hits = built.first_mut().map_or(0, |(_, reference)| {
        answers(reference.as_mut(), set, plan.n_checked).into_iter().flatten().count()
    });
    let mut runners: Vec<Runner> = built
        .iter_mut()
        .map(|(contender, search)| Runner {
            name: contender.name,
            run: in_turn(search.as_mut(), &set.queries),
        })
        .collect();
    let series = time(&mut runners, plan.n_rounds, plan.batch);
    #[allow(clippy::cast_precision_loss, reason = "counts far below 2^53")]
    let touches = hits as f64 / plan.n_checked.min(set.queries.len()).max(1) as f64;
    Group { question: set.name, n_planes, touches: Some(touches), series }
}

/// Asks query after query, from the first again after the last.
fn in_turn<'a>(
    search: &'a mut dyn Search,
    queries: &'a [super::case::Query],
) -> Box<dyn FnMut(usize) -> f64 + 'a> {
    let mut next = 0;
    Box::new(move |n| {
        let mut sum = 0.0;
        let mut left = n;
        while 0 < left {
            let end = queries.len().min(next + left);
            sum += search.answer_all(&queries[next..end]);
            left -= end - next;
            next = if end == queries.len() { 0 } else { end };
        }
        sum
    })
}
