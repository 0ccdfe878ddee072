//! The bisection against its linear-scan twin, and the published engine against what must never happen.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]
#![allow(
    clippy::disallowed_methods,
    reason = "the truth that a test compares with may be computed in any way"
)]

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

/// So many floats above a number.
fn above(value: f64, n_ulps: u32) -> f64 {
    (0..n_ulps).fold(value, |value, _| value.next_up())
}

/// Planes so short, and so near to each other, that their distances from a far point round to the same number.
fn splinter() -> impl Strategy<Value = Plane> {
    let place = (-8..8_i32).prop_map(|steps| f64::from(steps) * 0.125 + 0.1);
    (facing(), place.clone(), place, 0..9_u32, 1..3_u32).prop_map(|(facing, offset, start, n_up, n_long)| {
        let start = above(start, n_up);
        Plane { facing, offset, start, end: above(start, n_long) }
    })
}

fn plane() -> impl Strategy<Value = Plane> {
    (facing(), coordinate(), coordinate(), prop_oneof![Just(0.125), Just(1.0), 0.001..6.0_f64])
        .prop_map(|(facing, offset, start, extent)| Plane { facing, offset, start, end: start + extent })
}

/// A set of planes, as a list that can be compared.
fn in_order(planes: impl Iterator<Item = Plane>) -> Vec<Plane> {
    let mut planes: Vec<_> = planes.collect();
    planes.sort_by(|a, b| (a.facing, a.offset, a.start).partial_cmp(&(b.facing, b.offset, b.start)).unwrap());
    planes
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 10_000, failure_persistence: None, ..ProptestConfig::default() })]

    /// 10^4 sets of planes, ten queries each: 10^5 cases.
    #[test]
    fn bisection_agrees_with_scan(
        planes in prop::collection::vec(prop_oneof![3 => plane(), 1 => splinter()], 0..60),
        queries in prop::collection::vec((facing(), coordinate(), coordinate(), 0.01..2.0_f64), 10),
    ) {
        let directed = SortedPlanes::new(planes).unwrap();
        let plain = directed.clone().without_bucket_index();
        for (facing, x, y, radius) in queries {
            let centre = Vector2::new(x, y);
            for sorted in [&directed, &plain] {
                prop_assert_eq!(
                    sorted.first_overlap(facing, centre, radius),
                    sorted.first_overlap_scan(facing, centre, radius)
                );
                prop_assert_eq!(sorted.clearance(centre), sorted.clearance_scan(centre));
                let near = in_order(sorted.planes_within(centre, radius));
                prop_assert_eq!(near, in_order(sorted.planes_within_scan(centre, radius)));
            }
        }
    }

    /// Where distances round to the same number the places of the planes tell which is nearer, in search and scan alike.
    #[test]
    fn bisection_agrees_with_scan_among_splinters(
        planes in prop::collection::vec(splinter(), 1..40),
        queries in prop::collection::vec((facing(), coordinate(), coordinate(), 0.01..9.0_f64), 10),
    ) {
        let sorted = SortedPlanes::new(planes).unwrap();
        for (facing, x, y, radius) in queries {
            let centre = Vector2::new(x, y);
            let found = sorted.first_overlap(facing, centre, radius);
            prop_assert_eq!(found, sorted.first_overlap_scan(facing, centre, radius));
            prop_assert_eq!(sorted.clearance(centre), sorted.clearance_scan(centre));
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
            // Not a point more and not a point less: every stretch between neighbouring ends is wall in both or in neither.
            let raw: Vec<&Plane> = planes.iter().filter(|plane| plane.facing == facing).collect();
            let mut ends: Vec<f64> = raw.iter().flat_map(|plane| [plane.start, plane.end]).collect();
            ends.sort_by(f64::total_cmp);
            for offset in raw.iter().map(|plane| plane.offset) {
                for pair in ends.windows(2).filter(|pair| pair[0] < pair[1]) {
                    let middle = f64::midpoint(pair[0], pair[1]);
                    let is_wall = |p: &Plane| p.offset == offset && p.start < middle && middle < p.end;
                    prop_assert_eq!(list.iter().any(is_wall), raw.iter().any(|plane| is_wall(plane)));
                }
            }
        }
    }
}

/// Bits of position and velocity after the run below.
const MARATHON: [u64; 4] = [
    4_600_399_222_296_810_034,
    13_826_096_345_617_264_046,
    13_829_174_519_677_813_036,
    13_822_567_019_517_409_855,
];

/// Whether a point of a layout's board, from its lower left corner, lies in a wall: told from the grid alone.
fn is_wall(layout: &maze_core::Layout, point: Vector2<f64>) -> bool {
    let pitch = extrude::WALL_THICKNESS + extrude::CORRIDOR;
    let [x, y] = [point.x, point.y].map(|value| {
        let cell = (value / pitch).floor();
        (cell, value - cell * pitch < extrude::WALL_THICKNESS)
    });
    let outside = |cell: f64, n: usize| cell < 0.0 || n as f64 <= cell;
    if outside(x.0, layout.width()) || outside(y.0, layout.height()) {
        return true;
    }
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 <= cell < n by now")]
    let (i, j) = (x.0 as usize, y.0 as usize);
    match (x.1, y.1) {
        (false, false) => false,
        (true, false) => i == 0 || !layout.is_open_east(i - 1, j),
        (false, true) => j == 0 || !layout.is_open_north(i, j - 1),
        (true, true) => true,
    }
}

/// The published engine on a random maze under a slowly turning tilt: whatever its errors, the ball's centre never enters
/// a wall, and the motion is the same bits everywhere and for ever.
#[test]
fn published_engine_keeps_the_ball_in_the_maze() {
    let layout = layout::recursive_backtracker(12, 12, 5).unwrap();
    let mesh = extrude::extrude(&layout);
    let maze = Maze::from_polygons(&mesh, &AssembleOptions::default()).unwrap();
    let travel = || {
        let mut engine = Published::new(
            maze.planes.clone(),
            BallSpec::default(),
            Ball::at(maze.start()),
            Published::TICK_S,
        )
        .unwrap();
        let mut n_hits = 0;
        for tick in 0..20_000_i32 {
            let phase = |period: i32| f64::from((tick % period) * 4 - 2 * period) / f64::from(2 * period);
            let tilt = Tilt::from_half_tangents(0.17 * phase(311), 0.17 * phase(433));
            let acceleration = gravity::project(gravity::WORLD_GRAVITY, &tilt.world_from_maze());
            n_hits += engine.tick(acceleration).unwrap().n_hits;
            let from_corner = engine.ball().position - maze.bounds.low;
            assert!(!is_wall(&layout, from_corner), "tick {tick}: {from_corner}");
        }
        assert!(1000 < n_hits, "the ball must have met walls: {n_hits} hits");
        let state = engine.ball();
        [state.position.x, state.position.y, state.velocity.x, state.velocity.y].map(f64::to_bits)
    };
    assert_eq!(
        travel(),
        MARATHON,
        "physics changed: if intended, update MARATHON and say so in CHANGELOG under Behaviour"
    );
}
