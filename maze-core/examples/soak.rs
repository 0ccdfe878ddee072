//! The exact engine for as long as one likes: `cargo run --release -p maze-core --example soak -- --ticks 1000000000`.
//!
//! Half of the ticks are played in random mazes (radii up to 0.499 of a corridor, accelerations to 1000, speeds to 10⁴), half in
//! irregular scenes, in which every wall has coordinates of its own (`tests/irregular`). The judges know nothing of the engine:
//! they look at every face. Prints how often a ball was in a wall, went through one, was not finite, or richer in energy than
//! before, and how often the engine's own last check had to correct it; exit status 1 if any of these is not 0.

#![allow(clippy::disallowed_methods, reason = "the judge may compute in any way")]

#[path = "../tests/irregular/mod.rs"]
mod irregular;
#[path = "../tests/noise/mod.rs"]
mod noise;

use clap::Parser;
use indicatif::{ProgressBar, ProgressStyle};
use irregular::{Scene, depth, rounding};
use maze_core::Path;
use maze_core::RolledArc;
use maze_core::{AssembleOptions, Ball, BallSpec, Continuous, Engine, Facing, Layout, Observer, Plane};
use maze_core::{Radius, SortedPlanes, Tick, extrude, layout};
use nalgebra::Vector2;
use noise::Noise;
use std::process::ExitCode;
use std::sync::Arc;

/// Looks for a ball in a wall, beyond one, or richer in energy than before. Exit status 1 if there was a fault.
///
/// Ten million ticks take about a minute. The same seed plays the same scenes. In mazes the ends of ticks are judged, in irregular
/// scenes the whole way.
#[derive(Parser)]
struct Arguments {
    /// Ticks in all.
    #[arg(long, default_value_t = 10_000_000, value_parser = clap::value_parser!(u64).range(1..))]
    ticks: u64,
    /// Seed of the first scene; the others follow.
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Irregular scenes alone.
    #[arg(long, conflicts_with = "mazes")]
    irregular: bool,
    /// Mazes alone.
    #[arg(long)]
    mazes: bool,
}

const TICK_S: f64 = 0.03;

/// Deeper than this (radii) is a penetration; richer by more than this fraction is an energy gain. Both far above rounding.
const LIMIT: f64 = 1.0e-9;

const TICKS_PER_MAZE: u64 = 50_000;
const TICKS_PER_SCENE: u64 = 1000;

/// From this restitution on a ball may bounce more often in a tick than the engine follows, which then drops time.
const ELASTIC: f64 = 0.99;

#[derive(Default)]
struct Totals {
    n_scenes: u64,
    n_ticks: u64,
    n_hits: u64,
    n_corner_hits: u64,
    n_rests: u64,
    n_rolls: u64,
    n_penetrations: u64,
    n_tunnels: u64,
    n_not_finite: u64,
    n_energy_gains: u64,
    n_corrected: u64,
    n_recovered: u64,
    n_dropped: u64,
    /// Of those, with a ball that loses enough at each bounce.
    n_dropped_inelastic: u64,
    deepest: f64,
    dropped_s: f64,
    first_fault: Option<String>,
}

impl Totals {
    fn n_faults(&self) -> u64 {
        self.n_penetrations
            + self.n_tunnels
            + self.n_not_finite
            + self.n_energy_gains
            + self.n_corrected
            + self.n_dropped_inelastic
    }

    /// Judges one tick; `context` tells what it was if it is the first that fails.
    fn judge(&mut self, case: &Case, tick: &Tick, [before, after]: [Ball; 2], context: impl Fn() -> String) {
        let n_faults = self.n_faults();
        self.n_ticks += 1;
        self.n_hits += u64::from(tick.n_hits);
        self.n_corner_hits += u64::from(tick.n_corner_hits);
        self.n_rests += u64::from(tick.n_rests);
        self.n_recovered += u64::from(tick.recovered);
        self.n_corrected += u64::from(0.0 < tick.corrected_overlap);
        self.n_dropped += u64::from(0.0 < tick.dropped_s);
        self.n_dropped_inelastic += u64::from(0.0 < tick.dropped_s && case.spec.restitution < ELASTIC);
        self.dropped_s += tick.dropped_s;
        let is_finite = after.position.iter().chain(&after.velocity).all(|value| value.is_finite());
        self.n_not_finite += u64::from(!is_finite);
        let radius = case.spec.radius.units();
        let depth = (depth(case.planes, after.position, radius) - rounding(after.position)) / radius;
        self.deepest = self.deepest.max(depth);
        self.n_penetrations += u64::from(LIMIT < depth);
        let acceleration = case.acceleration;
        // Heights are counted from near by, so that they do not drown in the coordinates.
        let energy = |ball: Ball| {
            ball.velocity.norm_squared() / 2.0 - acceleration.dot(&(ball.position - before.position))
        };
        let scale =
            before.velocity.norm_squared() + after.velocity.norm_squared() + acceleration.norm() * 20.0;
        self.n_energy_gains += u64::from(LIMIT * scale < energy(after) - energy(before));
        self.n_tunnels += u64::from(case.has_tunnelled);
        if n_faults < self.n_faults() && self.first_fault.is_none() {
            self.first_fault = Some(format!(
                "{}, {:?}, acceleration {acceleration:?}: {before:?} -> {after:?}, {tick:?}",
                context(),
                case.spec
            ));
        }
    }
}

/// What a tick is judged by.
struct Case<'a> {
    planes: &'a [Plane],
    spec: BallSpec,
    acceleration: Vector2<f64>,
    has_tunnelled: bool,
}

/// Follows the centre through a tick and notices when it crosses a face.
struct Crossings<'a> {
    planes: &'a [Plane],
    radius: f64,
    has_crossed: bool,
    n_rolls: u64,
}

impl Observer for Crossings<'_> {
    fn flight(&mut self, path: &Path, duration_s: f64) {
        let to = path.at(duration_s);
        for plane in self.planes {
            let axis = plane.facing.axis();
            let [from, speed, acceleration] =
                [path.position, path.velocity, path.acceleration].map(|v| v[axis]);
            // A path that stays on one side, as told by its ends and by its turning point.
            let turn = if acceleration == 0.0 { from } else { from - speed * speed / (2.0 * acceleration) };
            let lowest = from.min(to[axis]).min(turn);
            let highest = from.max(to[axis]).max(turn);
            if plane.offset < lowest || highest < plane.offset {
                continue;
            }
            let (gap, half) = (from - plane.offset, acceleration / 2.0);
            let root = (speed * speed - 4.0 * half * gap).max(0.0).sqrt();
            // Both roots of gap + speed t + half t², by the form of each that does not cancel.
            let sum = -(speed + root.copysign(speed)) / 2.0;
            for time_s in [sum / half, gap / sum] {
                if 0.0 < time_s && time_s < duration_s {
                    let along = path.at(time_s)[1 - axis];
                    self.has_crossed |= plane.start < along && along < plane.end;
                }
            }
        }
    }

    fn roll(&mut self, arc: &RolledArc, _duration_s: f64) {
        self.n_rolls += 1;
        let halfway = (arc.from + arc.to).try_normalize(0.0).unwrap_or(arc.to);
        let centre = arc.point + halfway * arc.radius;
        let depth = depth(self.planes, centre, self.radius);
        self.has_crossed |= LIMIT * self.radius + rounding(centre) < depth;
    }
}

/// Which cell of the layout a point lies in, told from the grid alone; `None` in a wall.
fn cell_of(layout: &Layout, from_corner: Vector2<f64>) -> Option<(usize, usize)> {
    let pitch = extrude::WALL_THICKNESS + extrude::CORRIDOR;
    let line = |value: f64, n: usize| {
        let cell = (value / pitch).floor();
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 <= cell < n")]
        let index = (0.0 <= cell).then_some(cell as usize).filter(|index| *index < n)?;
        Some((index, value - cell * pitch < extrude::WALL_THICKNESS))
    };
    let ((i, in_x), (j, in_y)) =
        (line(from_corner.x, layout.width())?, line(from_corner.y, layout.height())?);
    let free = match (in_x, in_y) {
        (false, false) => true,
        (true, false) => 0 < i && layout.is_open_east(i - 1, j),
        (false, true) => 0 < j && layout.is_open_north(i, j - 1),
        (true, true) => false,
    };
    free.then_some((i, j))
}

/// Whether one tick can have led from one cell to the other: through passages, by a path no longer than the ball's.
fn is_joined(layout: &Layout, from: (usize, usize), to: (usize, usize), distance: f64) -> bool {
    let n_cells = (distance / extrude::CORRIDOR).ceil() + 2.0;
    let mut reached = std::collections::BTreeSet::from([from]);
    let mut edge = vec![from];
    let mut n = 0.0;
    while n < n_cells && !edge.is_empty() {
        if reached.contains(&to) {
            return true;
        }
        let mut next = Vec::new();
        for (x, y) in edge {
            next.extend(layout.is_open_east(x, y).then(|| (x + 1, y)));
            next.extend(layout.is_open_north(x, y).then(|| (x, y + 1)));
            next.extend((0 < x && layout.is_open_east(x - 1, y)).then(|| (x - 1, y)));
            next.extend((0 < y && layout.is_open_north(x, y - 1)).then(|| (x, y - 1)));
        }
        next.retain(|cell| reached.insert(*cell));
        edge = next;
        n += 1.0;
    }
    reached.contains(&to)
}

fn run_maze(seed: u64, n_ticks: u64, totals: &mut Totals) -> Result<(), Box<dyn std::error::Error>> {
    let mut noise = Noise(seed);
    let layout = layout::recursive_backtracker(8, 6, seed)?;
    let maze = layout.maze(&AssembleOptions::default())?;
    let planes: Vec<Plane> = Facing::ALL.into_iter().flat_map(|facing| maze.planes.planes(facing)).collect();
    let radius = Radius::new(0.2 + 0.299 * noise.next().abs())?;
    let spec = BallSpec { radius, ..BallSpec::default() };
    let mut engine = Continuous::new(maze.planes.clone(), spec, Ball::at(maze.start()), TICK_S)?;
    totals.n_scenes += 1;
    for n in 0..n_ticks {
        if n % 1000 == 0 {
            let speed = 10.0_f64.powf(4.0 * noise.next().abs());
            engine.place(Ball { position: engine.ball().position, velocity: noise.vector() * speed })?;
        }
        let strength = if n % 7000 < 1000 { 1000.0 } else { 5.0 };
        let acceleration = noise.vector() * strength;
        let before = engine.ball();
        let tick = engine.tick(acceleration)?;
        let after = engine.ball();
        let [from, to] = [before, after].map(|state| cell_of(&layout, state.position - maze.bounds.low));
        let distance = (before.velocity.norm() + acceleration.norm() * TICK_S) * TICK_S;
        let has_tunnelled = match (from, to) {
            (Some(from), Some(to)) => !is_joined(&layout, from, to, distance),
            _ => true,
        };
        let case = Case { planes: &planes, spec, acceleration, has_tunnelled };
        totals.judge(&case, &tick, [before, after], || format!("maze {seed}, tick {n}"));
    }
    Ok(())
}

fn run_irregular(seed: u64, n_ticks: u64, totals: &mut Totals) -> Result<(), Box<dyn std::error::Error>> {
    let Some(scene) = Scene::new(seed) else { return Ok(()) };
    let planes = Arc::new(SortedPlanes::new(scene.planes.iter().copied())?);
    let mut engine = Continuous::new(planes, scene.spec, scene.ball, scene.tick_s)?;
    let radius = scene.spec.radius.units();
    totals.n_scenes += 1;
    for (n, acceleration) in (0..n_ticks).zip(scene.accelerations(seed)) {
        let before = engine.ball();
        let mut watch = Crossings { planes: &scene.planes, radius, has_crossed: false, n_rolls: 0 };
        let tick = engine.tick_observed(acceleration, &mut watch)?;
        totals.n_rolls += watch.n_rolls;
        let acceleration = acceleration * scene.spec.rolling;
        let is_outside = irregular::HALF < (engine.ball().position - scene.middle).amax();
        let has_tunnelled = watch.has_crossed || is_outside;
        let case = Case { planes: &scene.planes, spec: scene.spec, acceleration, has_tunnelled };
        let context = || format!("irregular scene {seed}, tick {n} of {} s", scene.tick_s);
        totals.judge(&case, &tick, [before, engine.ball()], context);
    }
    Ok(())
}

fn main() -> Result<ExitCode, Box<dyn std::error::Error>> {
    let arguments = Arguments::parse();
    let mut totals = Totals::default();
    // Shows itself on a terminal only.
    let bar = ProgressBar::new(arguments.ticks).with_style(ProgressStyle::with_template(
        "{wide_bar} {human_pos} of {human_len} ticks, {per_sec}, {eta} left",
    )?);
    let for_mazes = match () {
        () if arguments.irregular => 0,
        () if arguments.mazes => arguments.ticks,
        () => arguments.ticks / 2,
    };
    for (most, n_per_scene, run) in [
        (for_mazes, TICKS_PER_MAZE, run_maze as fn(u64, u64, &mut Totals) -> Result<(), _>),
        (arguments.ticks, TICKS_PER_SCENE, run_irregular),
    ] {
        let mut seed = arguments.seed;
        while totals.n_ticks < most {
            run(seed, n_per_scene.min(most - totals.n_ticks), &mut totals)?;
            seed = seed.wrapping_add(1);
            bar.set_position(totals.n_ticks);
        }
    }
    bar.finish_and_clear();
    println!("ticks                            {} in {} scenes", totals.n_ticks, totals.n_scenes);
    println!(
        "hits                             {} ({} of corners, {} ended in rest), {} rolls in irregular scenes",
        totals.n_hits, totals.n_corner_hits, totals.n_rests, totals.n_rolls
    );
    let count = |what: &str, n: u64| println!("{what:32} {n}");
    count("in a wall, deeper than 1e-9 r", totals.n_penetrations);
    println!("  deepest                        {:e} r", totals.deepest);
    count("through a wall", totals.n_tunnels);
    count("not finite", totals.n_not_finite);
    count("richer in energy by 1e-9", totals.n_energy_gains);
    count("corrected by the last check", totals.n_corrected);
    count("placed in a wall", totals.n_recovered);
    count("time dropped, restitution < 0.99", totals.n_dropped_inelastic);
    println!(
        "  with more, which may be        {} ticks, {:.6} s",
        totals.n_dropped - totals.n_dropped_inelastic,
        totals.dropped_s
    );
    if let Some(fault) = &totals.first_fault {
        println!("first fault                      {fault}");
    }
    println!("{} faults", totals.n_faults());
    Ok(if totals.n_faults() == 0 { ExitCode::SUCCESS } else { ExitCode::from(1) })
}
