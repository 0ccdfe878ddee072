//! The exact engine for as long as one likes: `cargo run --release -p maze-core --example soak -- --ticks 1000000000`.
//!
//! Random mazes, radii up to 0.499 of a corridor, accelerations to 1000, speeds to 10⁴. Prints how often a ball was in a
//! wall, on another side of one, not finite, or richer in energy than before; exit status 1 when that was ever so.

#![allow(clippy::disallowed_methods, reason = "the judge may compute in any way")]

#[path = "../tests/noise/mod.rs"]
mod noise;

use indicatif::{ProgressBar, ProgressStyle};
use maze_core::{AssembleOptions, Ball, BallSpec, Continuous, Engine, Facing, Layout, Maze, Radius};
use maze_core::{SortedPlanes, extrude, layout};
use nalgebra::Vector2;
use noise::Noise;
use std::process::ExitCode;

const TICK_S: f64 = 0.03;

/// Deeper than this (units) is a penetration; richer by more than this part is an energy gain. Both far above rounding.
const BAR: f64 = 1.0e-9;

const TICKS_PER_MAZE: u64 = 50_000;

#[derive(Default)]
struct Totals {
    n_ticks: u64,
    n_hits: u64,
    n_corner_hits: u64,
    n_rests: u64,
    n_penetrations: u64,
    n_tunnels: u64,
    n_not_finite: u64,
    n_energy_gains: u64,
    n_recovered: u64,
    n_dropped: u64,
    deepest: f64,
    dropped_s: f64,
    first_fault: Option<String>,
}

impl Totals {
    fn n_faults(&self) -> u64 {
        self.n_penetrations + self.n_tunnels + self.n_not_finite + self.n_energy_gains
    }
}

/// How deep a circle is in the walls around it, by a plain look at every plane.
fn penetration(planes: &[Plane4], position: Vector2<f64>, radius: f64) -> f64 {
    let depth = |plane: &Plane4| {
        let along = position[1 - plane.axis].clamp(plane.start, plane.end) - position[1 - plane.axis];
        let across = position[plane.axis] - plane.offset;
        radius - (across * across + along * along).sqrt()
    };
    planes.iter().map(depth).fold(0.0, f64::max)
}

/// A plane without its facing: for the judge both sides count.
struct Plane4 {
    axis: usize,
    offset: f64,
    start: f64,
    end: f64,
}

fn flat(planes: &SortedPlanes) -> Vec<Plane4> {
    let all = Facing::ALL.into_iter().flat_map(|facing| planes.planes(facing));
    all.map(|p| Plane4 { axis: p.facing.axis(), offset: p.offset, start: p.start, end: p.end }).collect()
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

/// Whether one tick can have led from one cell to the other: through passages, by a way no longer than the ball's.
fn is_joined(layout: &Layout, from: (usize, usize), to: (usize, usize), way: f64) -> bool {
    let n_cells = (way / extrude::CORRIDOR).ceil() + 2.0;
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
    let maze = Maze::from_polygons(&extrude::extrude(&layout), &AssembleOptions::default())?;
    let planes = flat(&maze.planes);
    let radius = Radius::new(0.2 + 0.299 * noise.next().abs()).ok_or("radius")?;
    let spec = BallSpec { radius, ..BallSpec::default() };
    let mut engine = Continuous::new(maze.planes.clone(), spec, Ball::at(maze.start), TICK_S)?;
    for n in 0..n_ticks {
        if n % 1000 == 0 {
            let speed = 10.0_f64.powf(4.0 * noise.next().abs());
            engine.place(Ball { position: engine.ball().position, velocity: noise.vector() * speed })?;
        }
        let strength = if n % 7000 < 1000 { 1000.0 } else { 5.0 };
        let pull = noise.vector() * strength;
        let energy = |state: Ball| state.velocity.norm_squared() / 2.0 - pull.dot(&state.position);
        let before = engine.ball();
        let tick = engine.tick(pull)?;
        let after = engine.ball();
        totals.n_ticks += 1;
        totals.n_hits += u64::from(tick.n_hits);
        totals.n_corner_hits += u64::from(tick.n_corner_hits);
        totals.n_rests += u64::from(tick.n_rests);
        totals.n_recovered += u64::from(tick.recovered);
        totals.n_dropped += u64::from(0.0 < tick.dropped_s);
        totals.dropped_s += tick.dropped_s;
        totals.n_not_finite +=
            u64::from(!after.position.iter().chain(&after.velocity).all(|v| v.is_finite()));
        let depth = penetration(&planes, after.position, radius.units());
        totals.deepest = totals.deepest.max(depth);
        totals.n_penetrations += u64::from(BAR < depth);
        let scale = before.velocity.norm_squared() + after.velocity.norm_squared() + pull.norm() * 20.0;
        totals.n_energy_gains += u64::from(BAR * scale < energy(after) - energy(before));
        let [from, to] = [before, after].map(|state| cell_of(&layout, state.position - maze.bounds.low));
        let way = (before.velocity.norm() + pull.norm() * TICK_S) * TICK_S;
        let tunnelled = match (from, to) {
            (Some(from), Some(to)) => !is_joined(&layout, from, to, way),
            _ => true,
        };
        totals.n_tunnels += u64::from(tunnelled);
        if totals.first_fault.is_none() && 0 < totals.n_faults() {
            let radius = radius.units();
            totals.first_fault = Some(format!(
                "seed {seed}, tick {n}, radius {radius}, pull {pull:?}: {before:?} -> {after:?}, {tick:?}"
            ));
        }
    }
    Ok(())
}

fn n_ticks_from_arguments() -> Option<u64> {
    let mut arguments = std::env::args().skip(1);
    match (arguments.next().as_deref(), arguments.next(), arguments.next()) {
        (None, ..) => Some(10_000_000),
        (Some("--ticks"), Some(n), None) => n.parse().ok().filter(|n| 0 < *n),
        _ => None,
    }
}

fn main() -> Result<ExitCode, Box<dyn std::error::Error>> {
    let Some(n_wanted) = n_ticks_from_arguments() else {
        eprintln!("usage: soak [--ticks N]   with N greater than 0");
        return Ok(ExitCode::from(2));
    };
    let mut totals = Totals::default();
    // Shows itself on a terminal only.
    let bar = ProgressBar::new(n_wanted).with_style(ProgressStyle::with_template(
        "{wide_bar} {human_pos} of {human_len} ticks, {per_sec}, {eta} left",
    )?);
    for seed in 0.. {
        let left = n_wanted - totals.n_ticks;
        if left == 0 {
            break;
        }
        run_maze(seed, left.min(TICKS_PER_MAZE), &mut totals)?;
        bar.set_position(totals.n_ticks);
    }
    bar.finish_and_clear();
    println!("ticks               {}", totals.n_ticks);
    println!(
        "hits                {} ({} of corners, {} ended in rest)",
        totals.n_hits, totals.n_corner_hits, totals.n_rests
    );
    println!("penetrations > {BAR:e} {} (deepest {:e})", totals.n_penetrations, totals.deepest);
    println!("tunnels             {}", totals.n_tunnels);
    println!("not finite          {}", totals.n_not_finite);
    println!("energy gains > {BAR:e} {}", totals.n_energy_gains);
    println!("recovered           {}", totals.n_recovered);
    println!("dropped time        in {} ticks, {:.6} s in all", totals.n_dropped, totals.dropped_s);
    if let Some(fault) = &totals.first_fault {
        println!("first fault         {fault}");
    }
    Ok(if totals.n_faults() == 0 { ExitCode::SUCCESS } else { ExitCode::from(1) })
}
