//! What a tick costs, as the maze and the speed grow: `cargo bench -p maze-core --bench tick`.
//!
//! `coherent` rolls one ball tick after tick; `random` ticks balls all over the maze in turn, so that each finds the caches
//! cold; `speed` bounces one without loss at 1 to 1000 units/s. The number of hits a tick is part of the name.
#![allow(clippy::disallowed_methods, reason = "a benchmark may choose its inputs in any way")]

#[path = "tiled/mod.rs"]
mod tiled;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use maze_core::{Ball, BallSpec, Continuous, Engine, Published, SortedPlanes};
use nalgebra::Vector2;
use std::hint::black_box;
use std::sync::Arc;
use tiled::{TILE, Tiled};

const TICK_S: f64 = 0.03;

/// Tiles along a side, for about 10³, 10⁴, 10⁵ and 10⁶ planes.
const N_TILES: [usize; 4] = [1, 3, 10, 34];

/// A maze, its planes, and the same without directories.
struct Grid {
    maze: Tiled,
    planes: Arc<SortedPlanes>,
    plain: Arc<SortedPlanes>,
}

impl Grid {
    fn new(n_tiles: usize) -> Result<Self, Box<dyn std::error::Error>> {
        let maze = Tiled::new(n_tiles)?;
        let planes = SortedPlanes::new(maze.faces.iter().copied())?;
        let plain = Arc::new(planes.clone().without_directories());
        Ok(Self { maze, planes: Arc::new(planes), plain })
    }

    fn centre(&self, cell: usize) -> Vector2<f64> {
        self.maze.centre(cell)
    }
}

/// A pull of 1 unit/s² that turns once in 3 s.
fn turning_pulls() -> Vec<Vector2<f64>> {
    let turn = |tick: u32| f64::from(tick) / 100.0 * std::f64::consts::TAU;
    (0..100).map(|tick| Vector2::new(turn(tick).cos(), turn(tick).sin())).collect()
}

type Make = fn(&Grid, BallSpec, Ball) -> Box<dyn Engine>;

fn exact(planes: &Arc<SortedPlanes>, spec: BallSpec, ball: Ball) -> Box<dyn Engine> {
    match Continuous::new(planes.clone(), spec, ball, TICK_S) {
        Ok(engine) => Box::new(engine),
        Err(error) => panic!("{error}"),
    }
}

/// The exact engine, the same without directories, and the report's.
const ENGINES: [(&str, Make); 3] = [
    ("continuous", |grid, spec, ball| exact(&grid.planes, spec, ball)),
    ("continuous, bisection alone", |grid, spec, ball| exact(&grid.plain, spec, ball)),
    ("published", |grid, spec, ball| match Published::new(grid.planes.clone(), spec, ball) {
        Ok(engine) => Box::new(engine),
        Err(error) => panic!("{error}"),
    }),
];

/// Directories change no bit of the motion.
fn assert_agreement(grid: &Grid) {
    let start = Ball { position: grid.centre(0), velocity: Vector2::new(3.0, 5.0) };
    let mut engines = [&grid.planes, &grid.plain].map(|planes| exact(planes, BallSpec::default(), start));
    for pull in turning_pulls().into_iter().cycle().take(2000) {
        let [one, other] = engines.each_mut().map(|engine| {
            tick(engine.as_mut(), pull * 5.0);
            engine.ball()
        });
        assert_eq!(one, other);
    }
}

fn tick(engine: &mut dyn Engine, pull: Vector2<f64>) -> u32 {
    match engine.tick(black_box(pull)) {
        Ok(tick) => tick.n_hits,
        Err(error) => panic!("{error}"),
    }
}

fn coherent(criterion: &mut Criterion, grids: &[Grid]) {
    let mut group = criterion.benchmark_group("coherent");
    let pulls = turning_pulls();
    for grid in grids {
        for (name, make) in ENGINES {
            let middle = grid.maze.side / TILE / 2 * TILE + TILE / 2;
            let start = Ball::at(grid.centre(middle * grid.maze.side + middle));
            let mut engine = make(grid, BallSpec::default(), start);
            group.throughput(Throughput::Elements(pulls.len() as u64));
            group.bench_function(BenchmarkId::new(name, grid.planes.len()), |bencher| {
                bencher.iter(|| pulls.iter().map(|pull| tick(engine.as_mut(), *pull)).sum::<u32>());
            });
        }
    }
}

fn random(criterion: &mut Criterion, grids: &[Grid]) {
    const N_BALLS: usize = 4096;
    let mut group = criterion.benchmark_group("random");
    for grid in grids {
        for (name, make) in ENGINES {
            // Far from one another, in an order that no prefetcher guesses.
            let mut engines: Vec<_> = (0..N_BALLS)
                .map(|n| {
                    let cell = n.wrapping_mul(0x9e37_79b9_7f4a_7c15) % (grid.maze.side * grid.maze.side);
                    make(grid, BallSpec::default(), Ball::at(grid.centre(cell)))
                })
                .collect();
            let pulls = turning_pulls();
            let mut round = 0;
            group.throughput(Throughput::Elements(N_BALLS as u64));
            group.bench_function(BenchmarkId::new(name, grid.planes.len()), |bencher| {
                bencher.iter(|| {
                    round += 1;
                    let one = |(n, engine): (usize, &mut Box<dyn Engine>)| {
                        tick(engine.as_mut(), pulls[(n + round) % pulls.len()])
                    };
                    engines.iter_mut().enumerate().map(one).sum::<u32>()
                });
            });
        }
    }
}

fn speed(criterion: &mut Criterion, grid: &Grid) {
    let mut group = criterion.benchmark_group("speed");
    for speed in [1.0, 10.0, 100.0, 1000.0] {
        for (name, make) in ENGINES {
            let spec = BallSpec { restitution: 1.0, ..BallSpec::default() };
            let start = Ball { position: grid.centre(0), velocity: Vector2::new(0.6, 0.8) * speed };
            let mut engine = make(grid, spec, start);
            let n_hits: u32 = (0..1000).map(|_| tick(engine.as_mut(), Vector2::zeros())).sum();
            let hits_a_tick = format!("{:.2} hits a tick", f64::from(n_hits) / 1000.0);
            group.bench_function(BenchmarkId::new(format!("{name} x{speed}"), hits_a_tick), |bencher| {
                bencher.iter(|| tick(engine.as_mut(), Vector2::zeros()));
            });
        }
    }
}

fn benches(criterion: &mut Criterion) {
    let grids: Result<Vec<_>, _> = N_TILES.into_iter().map(Grid::new).collect();
    match grids {
        Ok(grids) => {
            grids.iter().for_each(assert_agreement);
            coherent(criterion, &grids);
            random(criterion, &grids);
            speed(criterion, &grids[1]);
        }
        Err(error) => panic!("{error}"),
    }
}

criterion_group!(ticks, benches);
criterion_main!(ticks);
