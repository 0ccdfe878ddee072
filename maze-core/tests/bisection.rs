//! The bisection against its linear-scan twin, and the published engine against what must never happen.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use maze_core::{
    AssembleOptions, Ball, BallSpec, Engine, Facing, Maze, Plane, Published, SortedPlanes, Tilt,
};
use maze_core::{extrude, gravity, layout};
use nalgebra::Vector2;
use proptest::prelude::*;

fn facing() -> impl Strategy<Value = Facing> {
    prop::sample::select(Facing::ALL.to_vec())
}

/// Coordinates that collide often: equal offsets, touching and overlapping intervals, several rows within reach.
fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![(-40..40_i32).prop_map(|steps| f64::from(steps) * 0.125), -5.0..5.0_f64]
}

fn plane() -> impl Strategy<Value = Plane> {
    (facing(), coordinate(), coordinate(), prop_oneof![Just(0.125), Just(1.0), 0.001..6.0_f64])
        .prop_map(|(facing, offset, start, extent)| Plane { facing, offset, start, end: start + extent })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 10_000, failure_persistence: None, ..ProptestConfig::default() })]

    /// 10^4 sets of planes, ten queries each: 10^5 cases.
    #[test]
    fn bisection_agrees_with_scan(
        planes in prop::collection::vec(plane(), 0..60),
        queries in prop::collection::vec((facing(), coordinate(), coordinate(), 0.01..2.0_f64), 10),
    ) {
        let sorted = SortedPlanes::new(planes).unwrap();
        for (facing, x, y, radius) in queries {
            let centre = Vector2::new(x, y);
            prop_assert_eq!(
                sorted.first_overlap(facing, centre, radius),
                sorted.first_overlap_scan(facing, centre, radius)
            );
        }
    }

    /// Merging changes neither which points are wall nor the order.
    #[test]
    fn rows_are_sorted_and_disjoint(planes in prop::collection::vec(plane(), 0..60)) {
        let sorted = SortedPlanes::new(planes.clone()).unwrap();
        for facing in Facing::ALL {
            let list: Vec<Plane> = sorted.planes(facing).collect();
            for pair in list.windows(2) {
                let in_order = pair[0].offset < pair[1].offset
                    || (pair[0].offset == pair[1].offset && pair[0].end < pair[1].start);
                prop_assert!(in_order, "{:?}", pair);
            }
            for plane in planes.iter().filter(|plane| plane.facing == facing) {
                let covers = |kept: &Plane| {
                    kept.offset == plane.offset && kept.start <= plane.start && plane.end <= kept.end
                };
                prop_assert!(list.iter().any(covers));
            }
        }
    }
}

/// The published engine on a random maze under a slowly turning tilt: whatever its errors, the ball stays on the board,
/// stays finite, and moves the same way each time.
#[test]
fn published_engine_keeps_the_ball_in_the_maze() {
    let mesh = extrude::extrude(&layout::recursive_backtracker(12, 12, 5).unwrap());
    let maze = Maze::from_polygons(&mesh, &AssembleOptions::default()).unwrap();
    let travel = || {
        let mut engine =
            Published::new(maze.planes.clone(), BallSpec::default(), Ball::at(maze.start)).unwrap();
        let mut n_hits = 0;
        for tick in 0..20_000_i32 {
            let phase = |period: i32| f64::from((tick % period) * 4 - 2 * period) / f64::from(2 * period);
            let tilt = Tilt::from_half_tangents(0.17 * phase(311), 0.17 * phase(433));
            let acceleration = gravity::project(gravity::WORLD_GRAVITY, &tilt.world_from_maze());
            n_hits += engine.tick(acceleration).unwrap().n_hits;
            let position = engine.ball().position;
            let inside = maze.bounds.low.x < position.x
                && position.x < maze.bounds.high.x
                && maze.bounds.low.y < position.y
                && position.y < maze.bounds.high.y;
            assert!(inside, "tick {tick}: {position}");
        }
        assert!(1000 < n_hits, "the ball must have met walls: {n_hits} hits");
        engine.ball()
    };
    assert_eq!(travel(), travel());
}
