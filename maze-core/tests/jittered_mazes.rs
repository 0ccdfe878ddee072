//! Mazes as files have them: OBJ text in which every wall has a place and a thickness of its own, played by the autopilot, under a
//! board that turns, and under random tilts.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]
#![allow(clippy::disallowed_methods, reason = "the truth that a test compares with may use any function")]

mod irregular;
mod noise;
mod obj_text;

use irregular::depth;
use maze_core::{
    AssembleOptions, Autopilot, Ball, BallSpec, Continuous, Engine, Facing, Maze, Plane, Radius,
};
use maze_core::{gravity, import, layout};
use nalgebra::Vector2;
use noise::Noise;
use obj_text::block;

/// The layout with a box for each wall between two cells, shifted by up to 0.2, 0.06 to 0.3 thick, and about as long as a cell.
fn obj(width: usize, height: usize, seed: u64) -> String {
    const PITCH: f64 = 1.2;
    let layout = layout::recursive_backtracker(width, height, seed).unwrap();
    let mut noise = Noise(seed);
    let mut boxes = Vec::new();
    let mut wall = |middle: [f64; 2], across: usize, half: f64, shift: f64| {
        let thickness = 0.09 + 0.06 * noise.next();
        let mut middle = middle;
        middle[across] += shift * noise.next();
        let mut extent = [half + 0.15 * noise.next().abs(); 2];
        extent[across] = thickness;
        boxes.push((
            [0, 1].map(|axis| middle[axis] - extent[axis]),
            [0, 1].map(|axis| middle[axis] + extent[axis]),
        ));
    };
    #[allow(clippy::cast_precision_loss, reason = "small")]
    let at = |k: usize| k as f64 * PITCH;
    for y in 0..height {
        for x in 0..width {
            let (east, north) = (at(x + 1), at(y + 1));
            let (cell_x, cell_y) = (at(x) + PITCH / 2.0, at(y) + PITCH / 2.0);
            if x + 1 < width && !layout.is_open_east(x, y) {
                wall([east, cell_y], 0, PITCH / 2.0, 0.2);
            }
            if y + 1 < height && !layout.is_open_north(x, y) {
                wall([cell_x, north], 1, PITCH / 2.0, 0.2);
            }
        }
    }
    let (right, top) = (at(width), at(height));
    boxes.extend([
        ([-0.1, -0.1], [0.1, top + 0.1]),
        ([right - 0.1, -0.1], [right + 0.1, top + 0.1]),
        ([-0.1, -0.1], [right + 0.1, 0.1]),
        ([-0.1, top - 0.1], [right + 0.1, top + 0.1]),
    ]);
    boxes
        .iter()
        .enumerate()
        .map(|(n, (low, high))| block(8 * n, [low[0], low[1], 0.0], [high[0], high[1], 0.55]))
        .collect()
}

/// The accelerations of three ways to play.
fn accelerations(mode: u32, maze: &Maze, seed: u64) -> Box<dyn FnMut(Ball) -> Vector2<f64>> {
    let mut noise = Noise(seed);
    match mode {
        0 => {
            let mut autopilot = Autopilot::new(maze, 0.176);
            Box::new(move |ball| {
                autopilot.as_mut().map_or(Vector2::new(1.0, -2.0), |autopilot| {
                    gravity::project(gravity::WORLD_GRAVITY, &autopilot.tilt(ball).world_from_maze())
                })
            })
        }
        1 => {
            let mut angle = 0.0_f64;
            Box::new(move |_| {
                angle += 0.013;
                Vector2::new(angle.cos(), angle.sin()) * 2.5
            })
        }
        _ => {
            let (mut n, mut acceleration) = (0_u32, Vector2::zeros());
            Box::new(move |_| {
                if n.is_multiple_of(40) {
                    acceleration = noise.vector() * 3.4;
                }
                n += 1;
                acceleration
            })
        }
    }
}

#[test]
fn a_ball_stays_outside_of_every_wall_of_200_jittered_mazes() {
    let (mut n_mazes, mut n_hits) = (0, 0);
    for seed in 0..200 {
        let mesh = import::obj::read(obj(6, 5, seed).as_bytes()).unwrap();
        let radius = [0.35, 0.25, 0.3, 0.15][usize::try_from(seed % 4).unwrap()];
        let options = AssembleOptions { ball_radius: Radius::new(radius).ok(), ..AssembleOptions::default() };
        let Ok(maze) = Maze::from_polygons(&mesh, &options) else { continue };
        n_mazes += 1;
        let planes: Vec<Plane> =
            Facing::ALL.into_iter().flat_map(|facing| maze.planes.planes(facing)).collect();
        let radius = maze.ball_radius.units();
        let spec = BallSpec { radius: maze.ball_radius, ..BallSpec::default() };
        for mode in 0..3 {
            let mut engine =
                Continuous::new(maze.planes.clone(), spec, Ball::at(maze.start()), 0.03).unwrap();
            let mut acceleration = accelerations(mode, &maze, seed);
            for n in 0..1500 {
                let before = engine.ball();
                let tick = engine.tick(acceleration(before)).unwrap();
                let after = engine.ball();
                let depth = depth(&planes, after.position, radius);
                let about = format!("maze {seed}, mode {mode}, tick {n}: {before:?} -> {after:?}, {tick:?}");
                assert!(depth < 1.0e-9 * radius, "{about}: {depth} deep");
                assert_eq!((tick.dropped_s, tick.corrected_overlap), (0.0, 0.0), "{about}");
                n_hits += tick.n_hits;
            }
            assert!(maze.bounds.low < engine.ball().position && engine.ball().position < maze.bounds.high);
        }
    }
    assert!(190 < n_mazes && 50_000 < n_hits, "{n_mazes} mazes, {n_hits} hits");
}
