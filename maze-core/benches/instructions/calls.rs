//! The hot calls, each a round of calls on inputs that are the same to the bit on every machine.

#[path = "../../tests/noise/mod.rs"]
mod noise;

use maze_core::sweep;
use maze_core::{
    AssembleOptions, Ball, BallSpec, Continuous, Engine, Facing, Hit, Path, Plane, Published, SortedPlanes,
    SweepQuery,
};
use maze_core::{extrude, layout};
use nalgebra::Vector2;
use noise::Noise;
use std::error::Error;
use std::hint::black_box;
use std::sync::Arc;

/// A number of calls, to be made again and again.
pub(crate) struct Round {
    pub(crate) n_calls: usize,
    pub(crate) make: Box<dyn FnMut()>,
}

type Made = Result<Box<dyn Engine>, Box<dyn Error>>;
type Prepare = fn() -> Result<Round, Box<dyn Error>>;

/// Every call that is counted, by name.
pub(crate) const CALLS: [(&str, Prepare); 7] = [
    ("sweep::first_impact, 0.1 corridors", || first_impact(0.1)),
    ("sweep::first_impact, 10 corridors", || first_impact(10.0)),
    ("Continuous::tick, rolling", || {
        rolling(usual, |engine, acceleration| {
            let _ = black_box(engine.tick(acceleration));
        })
    }),
    // As the game plays it: the last hit is kept.
    ("Continuous::tick_observed, rolling", || {
        let mut last_hit = None;
        rolling(usual, move |engine, acceleration| {
            let mut observer = |hit: &Hit| last_hit = Some(*hit);
            let _ = black_box(engine.tick_observed(acceleration, &mut observer));
        })
    }),
    ("Continuous::tick, bouncing", bouncing),
    ("Published::tick, rolling", || {
        let published = |planes, ball| {
            Ok(Box::new(Published::new(planes, BallSpec::default(), ball, Published::TICK_S)?) as _)
        };
        rolling(published, |engine, acceleration| {
            let _ = black_box(engine.tick(acceleration));
        })
    }),
    ("SortedPlanes::new, a plane", build),
];

/// As many queries as make a round.
const N: u32 = 2000;

/// As many ticks: enough that it does not show where a ball happens to roll.
const N_TICKS: u32 = 100_000;

const TICK_S: f64 = 0.03;

/// Cells along each side of the maze: about 7000 planes.
const SIDE: u32 = 72;

fn planes() -> Result<Arc<SortedPlanes>, Box<dyn Error>> {
    let layout = layout::recursive_backtracker(SIDE as usize, SIDE as usize, 2020)?;
    Ok(layout.maze(&AssembleOptions::default())?.planes)
}

/// The middle of a cell; the maze lies around the origin.
fn centre(column: u32, row: u32) -> Vector2<f64> {
    const PITCH: f64 = extrude::CORRIDOR + extrude::WALL_THICKNESS;
    Vector2::new(column, row).map(|index| (f64::from(2 * index + 1) - f64::from(SIDE)) * PITCH / 2.0)
}

/// First impacts of balls that start anywhere and move anywhere, by `distance` units; a corridor is a unit wide.
fn first_impact(distance: f64) -> Result<Round, Box<dyn Error>> {
    let (planes, radius) = (planes()?, BallSpec::RADIUS.units());
    let play = extrude::CORRIDOR / 2.0 - radius;
    let mut noise = Noise(7);
    let mut path = |n: u32| Path {
        // Cell after cell in strides that share no factor with their number.
        position: centre(n * 31 % SIDE, n * 31 / SIDE * 37 % SIDE) + noise.vector() * play,
        velocity: noise.vector().normalize() * distance,
        acceleration: Vector2::zeros(),
    };
    let queries: Vec<SweepQuery> =
        (0..N).map(|n| SweepQuery::new(path(n), radius, 1.0)).collect::<Result<_, _>>()?;
    let make = move || {
        for query in &queries {
            black_box(sweep::first_impact(&planes, black_box(query)));
        }
    };
    Ok(Round { n_calls: N as usize, make: Box::new(make) })
}

fn exact(planes: Arc<SortedPlanes>, spec: BallSpec, ball: Ball) -> Made {
    Ok(Box::new(Continuous::new(planes, spec, ball, TICK_S)?))
}

fn usual(planes: Arc<SortedPlanes>, ball: Ball) -> Made {
    exact(planes, BallSpec::default(), ball)
}

/// One ball tick after tick, under a acceleration of 1 unit/s² that turns once in about 3 s.
fn rolling(
    engine: fn(Arc<SortedPlanes>, Ball) -> Made,
    mut tick: impl FnMut(&mut dyn Engine, Vector2<f64>) + 'static,
) -> Result<Round, Box<dyn Error>> {
    let mut engine = engine(planes()?, Ball::at(centre(SIDE / 2, SIDE / 2)))?;
    // A turn of 3.6 degrees in whole numbers: 1023² + 64² = 1025².
    let (cos, sin) = (1023.0 / 1025.0, 64.0 / 1025.0);
    let mut acceleration = Vector2::new(1.0, 0.0);
    let make = move || {
        for _ in 0..N_TICKS {
            acceleration = Vector2::new(
                cos * acceleration.x - sin * acceleration.y,
                sin * acceleration.x + cos * acceleration.y,
            );
            tick(engine.as_mut(), black_box(acceleration));
        }
    };
    Ok(Round { n_calls: N_TICKS as usize, make: Box::new(make) })
}

/// One ball that bounces without loss, at 30 units/s: more than one hit a tick.
fn bouncing() -> Result<Round, Box<dyn Error>> {
    let start = Ball { position: centre(0, 0), velocity: Vector2::new(18.0, 24.0) };
    let spec = BallSpec { restitution: 1.0, ..BallSpec::default() };
    let mut engine = exact(planes()?, spec, start)?;
    let make = move || {
        for _ in 0..N_TICKS {
            let _ = black_box(engine.tick(black_box(Vector2::zeros())));
        }
    };
    Ok(Round { n_calls: N_TICKS as usize, make: Box::new(make) })
}

/// A round builds one structure, from planes in no order; a call is one plane of it.
fn build() -> Result<Round, Box<dyn Error>> {
    let sorted = planes()?;
    let mut planes: Vec<Plane> = Facing::ALL.into_iter().flat_map(|facing| sorted.planes(facing)).collect();
    let mut noise = Noise(7);
    planes.sort_by_cached_key(|_| noise.next().to_bits());
    let n_calls = planes.len();
    let make = move || {
        let _ = black_box(SortedPlanes::new(black_box(&planes).iter().copied()));
    };
    Ok(Round { n_calls, make: Box::new(make) })
}
