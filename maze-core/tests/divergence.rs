//! How a difference grows: not at all between corner hits, and at a corner by what its geometry says.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]
#![allow(clippy::disallowed_methods, reason = "a bar may be computed in any way")]

mod noise;

use maze_core::{
    AssembleOptions, Ball, BallSpec, Continuous, Engine, Facing, Plane, Radius, SortedPlanes, layout,
};
use nalgebra::Vector2;
use noise::Noise;
use std::sync::Arc;

const R: f64 = 0.25;
const E: f64 = BallSpec::RESTITUTION;

fn spec() -> BallSpec {
    BallSpec { radius: Radius::new(R).unwrap(), ..BallSpec::default() }
}

/// A ball that meets a corner with its centre `b` beside it and a difference d in b leaves with velocities that differ by
/// (1 + e) |v| d / (r cos φ), where sin φ = b / r: docs/physics.md.
#[test]
fn a_corner_hit_multiplies_a_difference_by_what_its_geometry_says() {
    const D: f64 = 1.0e-7;
    const SPEED: f64 = 3.0;
    let block = [
        Plane { facing: Facing::MinusX, offset: 0.0, start: -5.0, end: 0.0 },
        Plane { facing: Facing::PlusY, offset: 0.0, start: 0.0, end: 5.0 },
    ];
    let planes = Arc::new(SortedPlanes::new(block).unwrap());
    for step in 1..20 {
        let b = R * f64::from(step) / 20.0;
        let leaves = |b: f64| {
            let start = Ball { position: Vector2::new(-1.0, b), velocity: Vector2::new(SPEED, 0.0) };
            let mut engine = Continuous::new(planes.clone(), spec(), start, 0.5).unwrap();
            assert_eq!(engine.tick(Vector2::zeros()).unwrap().n_corner_hits, 1);
            engine.ball().velocity
        };
        let growth = (leaves(b + D / 2.0) - leaves(b - D / 2.0)).norm() / D;
        let exact = (1.0 + E) * SPEED / (R * R - b * b).sqrt();
        // A central difference is off by its third derivative times d² / 24, and by rounding / d = 1e-8.
        assert!((growth / exact - 1.0).abs() < 1.0e-6, "b = {b}: {growth}, {exact}");
    }
}

/// Most that one corner hit multiplies a difference by, as a rule: (1 + e) L / (r cos φ) for a flight of L = 3 corridors
/// at cos φ = 1/10 is 216.
const GROWTH_PER_CORNER_HIT: f64 = 216.0;

#[test]
fn motion_in_a_maze_depends_on_the_ticks_length_only_through_corner_hits() {
    let mut n_scenes_with_corner_hits = 0;
    for seed in 0..40 {
        let layout = layout::recursive_backtracker(6, 6, seed).unwrap();
        let maze = layout.maze(&AssembleOptions::default()).unwrap();
        let mut noise = Noise(seed);
        let start = Ball { position: maze.start(), velocity: noise.vector() * 6.0 };
        let acceleration = noise.vector() * 4.0;
        let after_a_second = |tick_s: f64, n_ticks: u32| {
            let mut engine = Continuous::new(maze.planes.clone(), spec(), start, tick_s).unwrap();
            let n_corner_hits: u32 =
                (0..n_ticks).map(|_| engine.tick(acceleration).unwrap().n_corner_hits).sum();
            (engine.ball(), n_corner_hits)
        };
        let (finest, n_corner_hits) = after_a_second(0.001, 1000);
        n_scenes_with_corner_hits += u32::from(0 < n_corner_hits);
        // Without a corner hit the bar is 1e-9; 1e-14 is what a thousand ticks of rounding leave for corners to multiply.
        let grown = 1.0e-14 * GROWTH_PER_CORNER_HIT.powf(f64::from(n_corner_hits));
        let bar = if grown < 1.0e-9 { 1.0e-9 } else { grown };
        for (tick_s, n_ticks) in [(0.008, 125), (0.025, 40), (0.1, 10)] {
            let (state, _) = after_a_second(tick_s, n_ticks);
            let difference = (state.position - finest.position).norm();
            assert!(
                difference < bar,
                "seed {seed}, tick {tick_s}, {n_corner_hits} corner hits: {difference}"
            );
        }
    }
    assert!((5..40).contains(&n_scenes_with_corner_hits), "{n_scenes_with_corner_hits}");
}
