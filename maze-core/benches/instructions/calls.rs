//! The hot calls, each a round of calls on inputs that are the same to the bit on every machine.

#[path = "../../tests/noise/mod.rs"]
mod noise;
#[path = "../tiled/mod.rs"]
mod tiled;

use maze_core::impact::{self, Path};
use maze_core::{Ball, BallSpec, Continuous, Engine, Published, SortedPlanes, extrude};
use nalgebra::Vector2;
use noise::Noise;
use std::error::Error;
use std::hint::black_box;
use std::sync::Arc;
use tiled::{TILE, Tiled};

/// A number of calls, to be made again and again.
pub(crate) struct Round {
    pub(crate) n_calls: usize,
    pub(crate) make: Box<dyn FnMut()>,
}

type Made = Result<Box<dyn Engine>, Box<dyn Error>>;
type Prepare = fn() -> Result<Round, Box<dyn Error>>;

/// Every call that is counted, by name.
pub(crate) const CALLS: [(&str, Prepare); 6] = [
    ("impact::first, 0.1 corridors", || first(0.1)),
    ("impact::first, 10 corridors", || first(10.0)),
    ("Continuous::tick, rolling", || rolling(|planes, ball| exact(planes, BallSpec::default(), ball))),
    ("Continuous::tick, bouncing", bouncing),
    ("Published::tick, rolling", || {
        rolling(|planes, ball| Ok(Box::new(Published::new(planes, BallSpec::default(), ball)?)))
    }),
    ("SortedPlanes::new, a plane given", build),
];

/// As many queries or ticks as make a round.
const N: usize = 2000;

const TICK_S: f64 = 0.03;

/// A maze of about 10⁵ planes, for queries all over it.
const N_TILES_LARGE: usize = 10;

/// And one of about 10⁴, for all else.
const N_TILES: usize = 3;

/// First hits of balls that start anywhere and move anywhere, `way` units far; a corridor is a unit wide.
fn first(way: f64) -> Result<Round, Box<dyn Error>> {
    let maze = Tiled::new(N_TILES_LARGE)?;
    let radius = BallSpec::RADIUS.units();
    let mut noise = Noise(7);
    let mut paths = Vec::with_capacity(N);
    for n in 0..N {
        let play = extrude::CORRIDOR / 2.0 - radius;
        let position = maze.centre(n.wrapping_mul(0x9e37_79b9_7f4a_7c15)) + noise.vector() * play;
        let velocity = noise.vector().normalize() * way;
        paths.push(Path { position, velocity, acceleration: Vector2::zeros() });
    }
    let planes = SortedPlanes::new(maze.faces)?;
    let make = move || {
        for path in &paths {
            black_box(impact::first(&planes, black_box(path), radius, 1.0, None));
        }
    };
    Ok(Round { n_calls: N, make: Box::new(make) })
}

fn exact(planes: Arc<SortedPlanes>, spec: BallSpec, ball: Ball) -> Result<Box<dyn Engine>, Box<dyn Error>> {
    Ok(Box::new(Continuous::new(planes, spec, ball, TICK_S)?))
}

/// One ball tick after tick, under a pull of 1 unit/s² that turns once in about 3 s.
fn rolling(engine: fn(Arc<SortedPlanes>, Ball) -> Made) -> Result<Round, Box<dyn Error>> {
    let maze = Tiled::new(N_TILES)?;
    let middle = maze.side / 2 / TILE * TILE + TILE / 2;
    let start = Ball::at(maze.centre(middle * maze.side + middle));
    let mut engine = engine(Arc::new(SortedPlanes::new(maze.faces)?), start)?;
    // A turn of 3.6 degrees in whole numbers: 1023² + 64² = 1025².
    let (cos, sin) = (1023.0 / 1025.0, 64.0 / 1025.0);
    let mut pull = Vector2::new(1.0, 0.0);
    let make = move || {
        for _ in 0..N {
            pull = Vector2::new(cos * pull.x - sin * pull.y, sin * pull.x + cos * pull.y);
            let _ = black_box(engine.tick(black_box(pull)));
        }
    };
    Ok(Round { n_calls: N, make: Box::new(make) })
}

/// One ball that bounces without loss, at 30 units/s: about 1.7 hits a tick.
fn bouncing() -> Result<Round, Box<dyn Error>> {
    let maze = Tiled::new(N_TILES)?;
    let start = Ball { position: maze.centre(0), velocity: Vector2::new(18.0, 24.0) };
    let spec = BallSpec { restitution: 1.0, ..BallSpec::default() };
    let mut engine = exact(Arc::new(SortedPlanes::new(maze.faces)?), spec, start)?;
    let make = move || {
        for _ in 0..N {
            let _ = black_box(engine.tick(black_box(Vector2::zeros())));
        }
    };
    Ok(Round { n_calls: N, make: Box::new(make) })
}

/// A round builds one structure; a call is one of the planes given, of which many are merged.
fn build() -> Result<Round, Box<dyn Error>> {
    let maze = Tiled::new(N_TILES)?;
    let n_calls = maze.faces.len();
    let make = move || {
        let _ = black_box(SortedPlanes::new(black_box(&maze.faces).iter().copied()));
    };
    Ok(Round { n_calls, make: Box::new(make) })
}
