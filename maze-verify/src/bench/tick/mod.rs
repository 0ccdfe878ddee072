//! Whole ticks: engines of ours beside rapier3d's step, and beside its broad phase alone.
//!
//! A question is a set of contenders, each with a ball of its own that is ticked on and on. What they answer is compared
//! before (see [`agree`]): later than the first bounces their balls go different ways, as chaos has it.

pub mod agree;
mod movers;

pub use movers::Mover;

use super::agreement::{Agreement, Comparison};
use super::case::{Case, TICK_S, spec, turning_accelerations};
use super::figures::{Figures, Group};
use super::measure::{BenchError, Plan};
use super::paired::{Runner, Series, time};
use crate::engine::Walls;
use maze_core::{Ball, BallSpec, Continuous, Engine, SortedPlanes};
use movers::{boxes, crowd, exact, exact_on_2_threads, published, rapier, without_bucket_index};
use nalgebra::Vector2;
use std::sync::Arc;
use std::time::Duration;

/// Speeds of a ball that bounces without loss (units/s, corridors a second): 0.03 to 30 corridors a tick.
pub const SPEEDS: [(f64, &str); 4] =
    [(1.0, "speed 1"), (10.0, "speed 10"), (100.0, "speed 100"), (1000.0, "speed 1000")];

/// Balls that are ticked in turn, each far from the last one: more than caches keep the surroundings of.
const N_SCATTERED: usize = 4096;

/// And as many as the question about many balls is about.
const N_MANY: usize = 100_000;

/// Ticks that scattered balls have behind them when they are first compared: at rest in the middle of a cell none is near a
/// wall, and later most are.
const N_BEFORE: usize = 60;

/// More than 10⁶ separate colliders take gigabytes, and seconds to insert.
const MOST_COLLIDERS: usize = 1_200_000;

/// Where a ball is ticked.
pub struct Course<'a> {
    /// The maze.
    pub case: &'a Case,
    /// What the ball is made of.
    pub spec: BallSpec,
    /// Each place is a ball.
    pub starts: Vec<Ball>,
}

/// Makes a contender.
pub type Build = fn(&Course) -> Result<Box<dyn Mover>, BenchError>;

/// One way to move a ball through a tick.
#[derive(Clone, Copy)]
pub struct Contender {
    /// As in the table.
    pub name: &'static str,
    /// What it is.
    pub about: &'static str,
    /// What is asked of the path of its ball.
    pub agreement: Agreement,
    /// Whether each wall is a collider of its own, which bounds the size of the maze.
    pub is_separate: bool,
    /// Makes it.
    pub build: Build,
}

const fn contender(name: &'static str, about: &'static str, agreement: Agreement, build: Build) -> Contender {
    Contender { name, about, agreement, is_separate: false, build }
}

impl Contender {
    const fn separate(self) -> Self {
        Self { is_separate: true, ..self }
    }
}

/// The contender that all others are compared with.
pub const REFERENCE: &str = "continuous";

const CONTINUOUS: Contender =
    contender(REFERENCE, "maze-core: the exact engine, the game's default", Agreement::Exact, exact);
const BISECTION: Contender = contender(
    "continuous by bisection",
    "the same without bucket indexes",
    Agreement::Exact,
    without_bucket_index,
);
const PUBLISHED: Contender =
    contender("published", "maze-core: the report's engine", agree::REPORT, published);
const COMPOUND: Contender = contender(
    "rapier3d compound",
    "PhysicsWorld::step, all walls one compound collider: the fair set-up for a large maze. With its ccd a fast ball goes as \
     far as the next wall in a step, not through the whole tick",
    agree::FIRST_ORDER,
    |course| rapier(course, Walls::Compound, true),
);
const BROAD_PHASE: Contender = contender(
    "rapier3d broad phase",
    "BroadPhaseBvh::update with the ball's collider moved along its path, a collider a wall",
    Agreement::OtherQuestion("pairs of boxes that meet; moves nothing"),
    boxes,
)
.separate();

/// The name of the question about them.
const ROLLING_BALL: &str = "rolling tick";

/// All that roll a ball; the first is what the others are compared with.
pub const ROLLING: [Contender; 8] = [
    CONTINUOUS,
    BISECTION,
    PUBLISHED,
    COMPOUND,
    contender("rapier3d compound no ccd", "with max_ccd_substeps = 0", agree::FIRST_ORDER, |course| {
        rapier(course, Walls::Compound, false)
    }),
    contender("rapier3d colliders", "a collider a wall", agree::FIRST_ORDER, |course| {
        rapier(course, Walls::Cuboids, true)
    })
    .separate(),
    contender("rapier3d colliders no ccd", "with max_ccd_substeps = 0", agree::FIRST_ORDER, |course| {
        rapier(course, Walls::Cuboids, false)
    })
    .separate(),
    BROAD_PHASE,
];

/// All that tick balls all over the maze in turn. A step of rapier's moves all balls of a world: see [`MANY`].
pub const ANYWHERE: [Contender; 4] = [CONTINUOUS, BISECTION, PUBLISHED, BROAD_PHASE];

/// All that move a multitude.
pub const MANY: [Contender; 4] = [
    CONTINUOUS,
    contender("continuous on 2 threads", "half of the balls each", Agreement::Exact, exact_on_2_threads),
    PUBLISHED,
    contender("rapier3d world of 10^4", "one step for all balls of a world", agree::FIRST_ORDER, crowd),
];

/// All that keep a fast ball between the walls.
pub const FAST: [Contender; 4] = [CONTINUOUS, BISECTION, PUBLISHED, COMPOUND];

/// A question with all that is ready to answer it.
pub struct Question {
    /// As in the table.
    pub name: &'static str,
    /// Of the maze.
    pub n_planes: usize,
    /// Hits in a tick, on average.
    pub hits_a_tick: Option<f64>,
    /// How the answers compare.
    pub comparisons: Vec<Comparison>,
    /// The contenders.
    pub entrants: Vec<Entrant>,
}

/// A contender at the start.
pub struct Entrant {
    /// Ticks all its balls, again and again.
    pub runner: Runner<'static>,
    /// How many those are.
    pub n_balls: usize,
}

impl Question {
    /// Times all in turn, a tick of one ball each.
    pub fn time(self, n_rounds: usize, batch: Duration) -> Group {
        let (mut runners, n_balls): (Vec<_>, Vec<_>) =
            self.entrants.into_iter().map(|entrant| (entrant.runner, entrant.n_balls)).unzip();
        let series = time(&mut runners, n_rounds, batch);
        #[allow(clippy::cast_precision_loss, reason = "counts far below 2^53")]
        let each = |(series, n): (Series, usize)| Series {
            ns: series.ns.iter().map(|ns| ns / n as f64).collect(),
            ..series
        };
        Group {
            question: self.name,
            n_planes: self.n_planes,
            touches: self.hits_a_tick,
            series: series.into_iter().zip(n_balls).map(each).collect(),
        }
    }
}

impl<'a> Course<'a> {
    /// One ball at rest in the middle of the maze.
    pub fn middle(case: &'a Case) -> Self {
        Self { case, spec: spec(), starts: vec![Ball::at(case.middle())] }
    }

    fn n_planes(&self) -> usize {
        self.case.planes().len()
    }

    /// Whether the maze is not too large for a contender.
    fn holds(&self, contender: &Contender) -> bool {
        !contender.is_separate || self.case.rectangles().len() <= MOST_COLLIDERS
    }

    /// Many balls all over the maze, in an order that no prefetcher guesses, which have rolled for a while.
    ///
    /// # Errors
    /// As [`rolling`].
    pub fn scattered(self, n: usize) -> Result<Self, BenchError> {
        let accelerations = turning_accelerations();
        let roll = |start| {
            let mut engine = self.exact(Ball::at(start))?;
            for acceleration in accelerations.iter().take(N_BEFORE) {
                engine.tick(*acceleration).map_err(BenchError::set_up)?;
            }
            Ok(engine.ball())
        };
        let starts: Result<Vec<Ball>, _> = self.case.scattered(n).into_iter().map(roll).collect();
        Ok(Self { starts: starts?, ..self })
    }

    /// The exact engine with a ball.
    fn exact(&self, ball: Ball) -> Result<Continuous, BenchError> {
        let planes = Arc::clone(self.case.planes());
        Continuous::new(planes, self.spec, ball, TICK_S).map_err(BenchError::set_up)
    }

    /// Hits in a tick of the first ball, on average over many.
    fn hits_a_tick(&self, accelerations: &[Vector2<f64>]) -> Result<f64, BenchError> {
        let mut engine = self.exact(self.starts[0])?;
        let mut n_hits = 0;
        for acceleration in accelerations.iter().cycle().take(N_COUNTED) {
            n_hits += engine.tick(*acceleration).map_err(BenchError::set_up)?.n_hits;
        }
        #[allow(clippy::cast_precision_loss, reason = "counts far below 2^53")]
        let each = f64::from(n_hits) / N_COUNTED as f64;
        Ok(each)
    }

    fn build(&self, contenders: &[Contender]) -> Result<Vec<Built>, BenchError> {
        let fitting = contenders.iter().filter(|contender| self.holds(contender));
        fitting.map(|contender| Ok((*contender, (contender.build)(self)?))).collect()
    }

    fn ask(
        &self,
        name: &'static str,
        built: Vec<Built>,
        accelerations: &[Vector2<f64>],
    ) -> Result<Question, BenchError> {
        Ok(Question {
            name,
            n_planes: self.n_planes(),
            hits_a_tick: Some(self.hits_a_tick(accelerations)?),
            comparisons: Vec::new(),
            entrants: built
                .into_iter()
                .map(|(contender, mover)| entrant(contender.name, mover, accelerations))
                .collect(),
        })
    }
}

/// A contender, and what it ticks.
type Built = (Contender, Box<dyn Mover>);

/// Ticks that hits are counted in.
const N_COUNTED: usize = 3330;

fn entrant(name: &'static str, mover: Box<dyn Mover>, accelerations: &[Vector2<f64>]) -> Entrant {
    let n_balls = mover.n_balls();
    Entrant { runner: Runner { name, run: in_turn(mover, accelerations.to_vec()) }, n_balls }
}

/// Ticks on under acceleration after acceleration, from the first again after the last.
fn in_turn(mut mover: Box<dyn Mover>, accelerations: Vec<Vector2<f64>>) -> Box<dyn FnMut(usize) -> f64> {
    let mut next = 0;
    Box::new(move |n| {
        let mut left = n;
        while 0 < left {
            let end = accelerations.len().min(next + left);
            mover.tick_all(&accelerations[next..end]);
            left -= end - next;
            next = if end == accelerations.len() { 0 } else { end };
        }
        mover.ball().position.x
    })
}

/// One ball that rolls tick after tick under a acceleration that turns.
///
/// # Errors
/// An engine that refuses the maze or the ball.
pub fn rolling(course: &Course) -> Result<Question, BenchError> {
    let mut built = course.build(&ROLLING)?;
    let comparisons = agree::compare_all(course, &mut built);
    for (_, mover) in &mut built {
        mover.place(course.starts[0]);
    }
    Ok(Question { comparisons, ..course.ask(ROLLING_BALL, built, &turning_accelerations())? })
}

/// Balls all over the maze, ticked in turn: each finds the caches cold.
///
/// # Errors
/// As [`rolling`].
pub fn anywhere(course: Course) -> Result<Question, BenchError> {
    scattered("ticks anywhere", course, N_SCATTERED, &ANYWHERE)
}

/// So many balls that not even they themselves stay in the caches; the time is that of one ball's tick.
///
/// # Errors
/// As [`rolling`].
pub fn many(case: &Case) -> Result<Question, BenchError> {
    scattered("10^5 balls", Course::middle(case), N_MANY, &MANY)
}

fn scattered(
    name: &'static str,
    course: Course,
    n: usize,
    contenders: &[Contender],
) -> Result<Question, BenchError> {
    let course = course.scattered(n)?;
    let built = course.build(contenders)?;
    Ok(Question { hits_a_tick: None, ..course.ask(name, built, &turning_accelerations())? })
}

/// A ball that bounces without loss and without acceleration.
///
/// # Errors
/// As [`rolling`].
pub fn fast(case: &Case, (speed, name): (f64, &'static str)) -> Result<Question, BenchError> {
    let mut course = Course::middle(case);
    course.spec.restitution = 1.0;
    course.starts[0].velocity = Vector2::new(0.6, 0.8) * speed;
    course.ask(name, course.build(&FAST)?, &[Vector2::zeros()])
}

/// Names of the mazes in [`growth`], by their number of planes; smaller ones are left out.
const SIZES: [(&str, std::ops::Range<usize>); 5] = [
    ("10^3 planes", 500..5_000),
    ("10^4 planes", 5_000..50_000),
    ("10^5 planes", 50_000..500_000),
    ("10^6 planes", 500_000..2_000_000),
    ("10^7 planes", 5_000_000..50_000_000),
];

/// The exact engine's rolling ball in small and large mazes in turn, so that one noise disturbs all alike. The mazes come
/// with the middles that the balls start at.
///
/// # Errors
/// As [`rolling`].
pub fn growth(mazes: Vec<(Arc<SortedPlanes>, Vector2<f64>)>) -> Result<Question, BenchError> {
    let n_planes = mazes.iter().map(|(planes, _)| planes.len()).max().unwrap_or(0);
    let mut entrants = Vec::new();
    for (planes, middle) in mazes {
        let Some((name, _)) = SIZES.into_iter().find(|(_, sizes)| sizes.contains(&planes.len())) else {
            continue;
        };
        entrants.push(entrant(name, movers::alone(planes, Ball::at(middle))?, &turning_accelerations()));
    }
    let name = "rolling tick as mazes grow";
    Ok(Question { name, n_planes, hits_a_tick: None, comparisons: Vec::new(), entrants })
}

/// Cells and tiles of the maze that a fast ball bounces in: about 10⁴ planes.
pub const FAST_SIZE: [usize; 2] = [27, 3];

/// And of the maze of the many balls: about 10⁵ planes.
pub const MANY_SIZE: [usize; 2] = [27, 10];

/// How often [`measure`] reports what comes next.
pub fn n_steps(plan: &Plan) -> usize {
    let has = |size| usize::from(plan.tick_sizes.contains(&size));
    2 * plan.tick_sizes.len() + 1 + SPEEDS.len() * has(FAST_SIZE) + has(MANY_SIZE)
}

/// Measures all questions about ticks; fast balls and many balls where the plan has their mazes. `on_step` hears what comes
/// next.
///
/// # Errors
/// As [`rolling`].
pub fn measure(plan: &Plan, figures: &mut Figures, on_step: &dyn Fn(&str)) -> Result<(), BenchError> {
    let mut add = |mut question: Question| {
        figures.comparisons.append(&mut question.comparisons);
        figures.groups.push(question.time(plan.n_rounds, plan.batch));
    };
    let mut mazes = Vec::new();
    for [tile, n_tiles] in &plan.tick_sizes {
        let case = Case::new(*tile, *n_tiles)?;
        let n_planes = case.planes().len();
        on_step(&format!("tick, {n_planes} planes"));
        let course = Course::middle(&case);
        add(rolling(&course)?);
        on_step(&format!("balls anywhere, {n_planes} planes"));
        add(anywhere(course)?);
        mazes.push((Arc::clone(case.planes()), case.middle()));
    }
    on_step("small and large mazes in turn");
    let growth = growth(mazes)?;
    if !growth.entrants.is_empty() {
        add(growth);
    }
    if plan.tick_sizes.contains(&FAST_SIZE) {
        let case = Case::new(FAST_SIZE[0], FAST_SIZE[1])?;
        for speed in SPEEDS {
            on_step(speed.1);
            add(fast(&case, speed)?);
        }
    }
    if plan.tick_sizes.contains(&MANY_SIZE) {
        on_step("many balls");
        add(many(&Case::new(MANY_SIZE[0], MANY_SIZE[1])?)?);
    }
    Ok(())
}
