//! The exact engine against closed forms, and against what must never happen.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "counts and cells, small and not negative"
)]
#![allow(clippy::disallowed_methods, reason = "the truth that a test compares with may use trigonometry")]

mod images;
mod noise;

use images::{Image, MIRRORED, TURNED};
use maze_core::{
    AssembleOptions, Ball, BallSpec, Continuous, Engine, Facing, Maze, Plane, Radius, SortedPlanes, Tick,
    layout,
};
use nalgebra::Vector2;
use noise::Noise;
use std::sync::Arc;

const E: f64 = BallSpec::RESTITUTION;
const R: f64 = 0.25;
const TICKS_S: [f64; 4] = [0.001, 1.0 / 120.0, 0.03, 0.1];

fn plane(facing: Facing, offset: f64, start: f64, end: f64) -> Plane {
    Plane { facing, offset, start, end }
}

/// A solid rectangle.
fn block([x0, x1]: [f64; 2], [y0, y1]: [f64; 2]) -> [Plane; 4] {
    [
        plane(Facing::MinusX, x0, y0, y1),
        plane(Facing::PlusX, x1, y0, y1),
        plane(Facing::MinusY, y0, x0, x1),
        plane(Facing::PlusY, y1, x0, x1),
    ]
}

fn ball(position: [f64; 2], velocity: [f64; 2]) -> Ball {
    Ball { position: position.into(), velocity: velocity.into() }
}

fn spec(restitution: f64) -> BallSpec {
    BallSpec { radius: Radius::new(R).unwrap(), restitution, ..BallSpec::default() }
}

fn engine(planes: &[Plane], ball: Ball, tick_s: f64) -> Continuous {
    let planes = Arc::new(SortedPlanes::new(planes.iter().copied()).unwrap());
    Continuous::new(planes, spec(E), ball, tick_s).unwrap()
}

/// Runs for a time that is a whole number of ticks.
fn run(engine: &mut Continuous, acceleration: [f64; 2], time_s: f64) -> Vec<Tick> {
    let n_ticks = (time_s / engine.tick_s()).round();
    assert!((n_ticks * engine.tick_s() - time_s).abs() < 1.0e-9);
    (0..n_ticks as u32).map(|_| engine.tick(acceleration.into()).unwrap()).collect()
}

/// A floor below a ball that falls towards -y.
const FLOOR: [Plane; 1] = [Plane { facing: Facing::PlusY, offset: 0.0, start: -100.0, end: 100.0 }];

#[test]
fn bounce_k_reaches_e_to_the_2k_of_the_height() {
    let (height, acceleration) = (1.0, 0.01);
    for tick_s in TICKS_S {
        let mut engine = engine(&FLOOR, ball([0.0, R + height], [0.0, 0.0]), tick_s);
        let (mut n_hits, mut seen) = (0, 0);
        while n_hits <= 20 {
            n_hits += engine.tick(Vector2::new(0.0, -acceleration)).unwrap().n_hits;
            // In flight the height of the apex is the energy over the acceleration, whenever one looks.
            let state = engine.ball();
            let apex = state.position.y - R + state.velocity.y * state.velocity.y / (2.0 * acceleration);
            let exact = height * E.powi(2 * n_hits as i32);
            assert!((apex - exact).abs() < 1.0e-9, "tick {tick_s}, bounce {n_hits}: {apex}, exact {exact}");
            seen = seen.max(n_hits);
        }
        assert_eq!(seen, 21);
    }
}

#[test]
fn corridor_rattle_loses_e_a_bounce_and_keeps_time() {
    // Two walls, 3 apart for the centre: after k hits the speed is v e^k, and hit k happens at (3 / v) sum e^-j.
    let walls = [plane(Facing::MinusX, 3.0 + R, -9.0, 9.0), plane(Facing::PlusX, -R, -9.0, 9.0)];
    for tick_s in TICKS_S {
        let mut engine = engine(&walls, ball([0.0, 0.0], [2.0, 0.0]), tick_s);
        let (mut n_hits, mut time_s) = (0_i32, 0.0);
        for _ in 0..(6.0 / tick_s) as u32 {
            n_hits += engine.tick(Vector2::zeros()).unwrap().n_hits as i32;
            time_s += tick_s;
            let last_hit_s: f64 = (0..n_hits).map(|j| 3.0 / (2.0 * E.powi(j))).sum();
            let way = 2.0 * E.powi(n_hits) * (time_s - last_hit_s);
            let exact = if n_hits % 2 == 0 { way } else { 3.0 - way };
            let state = engine.ball();
            assert!((state.position.x - exact).abs() < 1.0e-9, "{} instead of {exact}", state.position.x);
            assert!((state.velocity.x.abs() - 2.0 * E.powi(n_hits)).abs() < 1.0e-12);
        }
        assert_eq!(n_hits, 3);
    }
}

#[test]
fn oblique_bounce_keeps_the_tangential_and_scales_the_normal_speed() {
    for degrees in [30.0_f64, 45.0, 60.0, 80.0] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let mut engine = engine(&FLOOR, ball([0.0, 1.0 + R], [3.0 * sin, -3.0 * cos]), 0.03);
        let ticks = run(&mut engine, [0.0, 0.0], 3.0);
        assert_eq!(ticks.iter().map(|tick| tick.n_hits).sum::<u32>(), 1);
        let exact = Vector2::new(3.0 * sin, E * 3.0 * cos);
        assert!((engine.ball().velocity - exact).norm() < 1.0e-14);
        let hit_s = 1.0 / (3.0 * cos);
        assert!((engine.ball().position.y - R - exact.y * (3.0 - hit_s)).abs() < 1.0e-12);
    }
}

#[test]
fn corner_at_any_impact_parameter_reflects_about_the_true_normal() {
    // A ball flies towards +x at a block whose upper left corner is the origin, its centre b above it.
    let block = block([0.0, 5.0], [-5.0, 0.0]);
    for step in 1..100 {
        let b = R * f64::from(step) / 100.0;
        let mut engine = engine(&block, ball([-2.0, b], [3.0, 0.0]), 0.03);
        let ticks = run(&mut engine, [0.0, 0.0], 1.2);
        assert_eq!(ticks.iter().map(|tick| tick.n_corner_hits).sum::<u32>(), 1, "b = {b}");
        let normal = Vector2::new(-(R * R - b * b).sqrt(), b) / R;
        let before = Vector2::new(3.0, 0.0);
        let exact = before - normal * ((1.0 + E) * before.dot(&normal));
        assert!((engine.ball().velocity - exact).norm() < 1.0e-12, "b = {b}: {}", engine.ball().velocity);
    }
}

#[test]
fn sliding_along_a_face_is_exact() {
    for tick_s in [0.001, 0.01, 0.025, 0.1] {
        let mut engine = engine(&FLOOR, ball([0.0, R], [0.0, 0.0]), tick_s);
        run(&mut engine, [1.0, -4.0], 2.0);
        let state = engine.ball();
        assert!((state.position - Vector2::new(2.0, R)).norm() < 1.0e-12, "{}", state.position);
        assert!((state.velocity - Vector2::new(2.0, 0.0)).norm() < 1.0e-12);
    }
}

#[test]
fn bouncing_ends_in_rest_and_the_ball_leaves_when_the_board_turns() {
    let mut engine = engine(&FLOOR, ball([0.0, R + 0.5], [0.0, 0.0]), 0.03);
    let ticks = run(&mut engine, [0.0, -3.0], 30.0);
    assert_eq!(ticks.iter().map(|tick| tick.n_rests).sum::<u32>(), 1);
    assert!(ticks.iter().all(|tick| tick.dropped_s == 0.0));
    assert_eq!(engine.ball(), ball([0.0, R], [0.0, 0.0]));
    run(&mut engine, [0.0, 1.0], 0.3);
    assert!((engine.ball().position.y - R - 0.045).abs() < 1.0e-12);
}

#[test]
fn motion_does_not_depend_on_the_length_of_the_tick() {
    // A room without a convex corner: no touch multiplies a rounding difference.
    let room = [
        plane(Facing::PlusX, 0.0, 0.0, 5.0),
        plane(Facing::MinusX, 5.0, 0.0, 5.0),
        plane(Facing::PlusY, 0.0, 0.0, 5.0),
        plane(Facing::MinusY, 5.0, 0.0, 5.0),
    ];
    let after = |tick_s| {
        let mut engine = engine(&room, ball([1.0, 2.0], [7.0, -5.0]), tick_s);
        run(&mut engine, [1.5, -2.5], 1.0);
        engine.ball()
    };
    let finest = after(0.001);
    for tick_s in [0.008, 0.025, 0.1] {
        let state = after(tick_s);
        assert!((state.position - finest.position).norm() < 1.0e-9, "tick {tick_s}");
        assert!((state.velocity - finest.velocity).norm() < 1.0e-9, "tick {tick_s}");
    }
}

#[test]
fn a_slow_ball_rolls_around_a_corner_and_keeps_its_energy() {
    // Pressed onto the top of a block and pushed gently over its right end, it rolls around the corner and falls.
    let block = block([-5.0, 0.0], [-5.0, 0.0]);
    let mut engine = engine(&block, ball([-0.5, R], [0.2, 0.0]), 0.01);
    let acceleration = Vector2::new(0.0, -4.0);
    let energy = |state: Ball| state.velocity.norm_squared() / 2.0 - acceleration.dot(&state.position);
    let before = energy(engine.ball());
    let mut touched_after_end = false;
    for _ in 0..400 {
        let tick = engine.tick(acceleration).unwrap();
        assert_eq!((tick.n_hits, tick.dropped_s), (u32::from(tick.n_rests == 1), 0.0));
        let state = engine.ball();
        assert!((energy(state) - before).abs() < 1.0e-9, "{}", energy(state) - before);
        let distance = state.position.norm();
        touched_after_end |= 0.01 < state.position.x && (distance - R).abs() < 1.0e-9;
        if 0.0 < state.position.x {
            assert!(R - 1.0e-9 < distance);
        }
    }
    assert!(touched_after_end, "it rolled around the corner");
    assert!(engine.ball().position.y < -1.0, "and fell");
}

#[test]
fn a_fast_ball_flies_off_the_end_of_a_face_it_is_pressed_onto() {
    let block = block([-5.0, 0.0], [-5.0, 0.0]);
    let mut engine = engine(&block, ball([-0.5, R], [4.0, 0.0]), 0.03);
    let ticks = run(&mut engine, [0.0, -4.0], 0.3);
    assert!(ticks.iter().all(|tick| tick.n_corner_hits == 0 && tick.dropped_s == 0.0));
    // Over the end after 1/8 s, then a throw.
    let fall_s = 0.3 - 0.125;
    let exact = Vector2::new(0.7, R - 2.0 * fall_s * fall_s);
    assert!((engine.ball().position - exact).norm() < 1.0e-12, "{}", engine.ball().position);
}

#[test]
fn concave_corner_takes_both_components() {
    let walls = [plane(Facing::MinusX, 5.0, -9.0, 3.0), plane(Facing::MinusY, 3.0, -9.0, 5.0)];
    let start = ball([5.0 - R - 1.0, 3.0 - R - 1.0], [4.0, 4.0]);
    let mut engine = engine(&walls, start, 0.5);
    assert_eq!(engine.tick(Vector2::zeros()).unwrap().n_hits, 2);
    let exact = Vector2::new(5.0 - R, 3.0 - R) - Vector2::new(1.0, 1.0) * (4.0 * E * 0.25);
    assert!((engine.ball().position - exact).norm() < 1.0e-12);
    // Pressed into the corner it stays there.
    run(&mut engine, [2.0, 1.0], 90.0);
    assert_eq!(engine.ball(), ball([5.0 - R, 3.0 - R], [0.0, 0.0]));
}

#[test]
fn a_graze_of_a_corner_changes_nothing() {
    let block = block([0.0, 5.0], [-5.0, 0.0]);
    let mut engine = engine(&block, ball([-2.0, R], [3.0, 0.0]), 0.03);
    run(&mut engine, [0.0, 0.0], 1.2);
    assert_eq!(engine.ball().velocity, Vector2::new(3.0, 0.0));
    assert_eq!(engine.ball().position.y, R);
}

#[test]
fn a_start_in_contact_is_no_hit_and_a_start_in_overlap_is_recovered_and_reported() {
    let mut engine = engine(&FLOOR, ball([0.0, R], [1.0, 0.0]), 0.03);
    let tick = engine.tick(Vector2::zeros()).unwrap();
    assert_eq!((tick.n_hits, tick.recovered), (0, false));
    engine.place(ball([0.0, 0.1], [0.0, 0.0])).unwrap();
    let tick = engine.tick(Vector2::zeros()).unwrap();
    assert!(tick.recovered);
    assert!((tick.deepest_penetration - (R - 0.1)).abs() < 1.0e-12);
    assert_eq!(engine.ball().position, Vector2::new(0.0, R));
}

#[test]
fn a_corridor_barely_wider_than_the_ball_is_passed() {
    let gap = 1.0e-6;
    let walls = [plane(Facing::PlusY, 0.0, -9.0, 99.0), plane(Facing::MinusY, 2.0 * R + gap, -9.0, 99.0)];
    let mut engine = engine(&walls, ball([0.0, R + gap / 2.0], [10.0, 0.001]), 0.03);
    let ticks = run(&mut engine, [1.0, -1.0], 3.0);
    assert!(ticks.iter().all(|tick| tick.dropped_s == 0.0));
    assert!((engine.ball().position.x - 34.5).abs() < 1.0e-9);
    assert!((R..=R + gap).contains(&engine.ball().position.y));
}

#[test]
fn no_speed_tunnels_through_a_thin_wall() {
    let wall = block([5.0, 5.02], [-9.0, 9.0]);
    for speed in [1.0, 10.0, 1.0e2, 1.0e3, 1.0e4, 1.0e6] {
        let mut engine = engine(&wall, ball([0.0, 0.0], [speed, 0.0]), 0.03);
        for _ in 0..200 {
            engine.tick(Vector2::zeros()).unwrap();
            assert!(engine.ball().position.x <= 5.0 - R, "speed {speed}");
        }
    }
}

#[test]
fn not_finite_input_is_refused_and_changes_nothing() {
    let start = ball([1.0, 2.0], [3.0, 4.0]);
    let mut engine = engine(&FLOOR, start, 0.03);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert!(engine.tick(Vector2::new(0.0, bad)).is_err());
        assert!(engine.place(ball([bad, 0.0], [0.0, 0.0])).is_err());
        assert_eq!(engine.ball(), start);
        let planes = Arc::new(SortedPlanes::new([]).unwrap());
        assert!(Continuous::new(planes, spec(E), start, bad).is_err());
    }
}

#[test]
fn numbers_that_leave_the_range_within_a_tick_are_refused_and_change_nothing() {
    // The square of 10^200 is not finite; 10^160 units/s for a second go as far.
    for (velocity, tick_s) in [(1.0e200, 0.03), (1.0e160, 1.0)] {
        let start = ball([0.0, 9.0], [velocity, 0.0]);
        let mut engine = engine(&FLOOR, start, tick_s);
        assert!(engine.tick(Vector2::zeros()).is_err());
        assert_eq!(engine.ball(), start);
    }
    let planes = Arc::new(SortedPlanes::new(FLOOR).unwrap());
    assert!(Continuous::new(planes, spec(E), ball([0.0, 9.0], [0.0, 0.0]), 1.0e6).is_err());
    // Also by a ball at rest on the floor, whose ticks need no search.
    let mut engine = engine(&FLOOR, ball([0.0, 0.5], [0.0, 0.0]), 0.03);
    run(&mut engine, [0.0, -1.0], 3.0);
    let rest = engine.ball();
    for acceleration in [-f64::INFINITY, -1.0e200, f64::NAN] {
        assert!(
            engine.tick(Vector2::new(0.0, acceleration)).is_err()
                && engine.tick(Vector2::new(acceleration, -1.0)).is_err()
        );
        assert_eq!(engine.ball(), rest);
    }
}

fn random_maze(seed: u64) -> Maze {
    let layout = layout::recursive_backtracker(8, 6, seed).unwrap();
    layout.maze(&AssembleOptions::default()).unwrap()
}

/// How deep the ball is in the nearest wall, by a scan of every plane and both of its ends.
fn penetration(planes: &SortedPlanes, position: Vector2<f64>, radius: f64) -> f64 {
    let mut deepest = 0.0_f64;
    for plane in Facing::ALL.into_iter().flat_map(|facing| planes.planes(facing)) {
        let axis = plane.facing.axis();
        let along = position[1 - axis].clamp(plane.start, plane.end);
        let across = position[axis] - plane.offset;
        let distance = across.hypot(position[1 - axis] - along);
        deepest = deepest.max(radius - distance);
    }
    deepest
}

#[test]
fn a_million_random_ticks_never_penetrate_tunnel_or_gain_energy() {
    let (mut n_hits, mut n_corner_hits, mut n_dropped) = (0_u64, 0_u64, 0_u32);
    for seed in 0..20 {
        let maze = random_maze(seed);
        let mut noise = Noise(seed);
        let radius = Radius::new(0.25 + 0.249 * noise.next().abs()).unwrap();
        let spec = BallSpec { radius, ..BallSpec::default() };
        let mut engine = Continuous::new(maze.planes.clone(), spec, Ball::at(maze.start()), 0.03).unwrap();
        for n in 0..50_000_u32 {
            if n % 1000 == 0 {
                let speed = 10.0_f64.powf(4.0 * noise.next().abs());
                let velocity = noise.vector() * speed;
                engine.place(Ball { position: engine.ball().position, velocity }).unwrap();
            }
            let strength = if n % 7000 < 1000 { 1000.0 } else { 5.0 };
            let acceleration = noise.vector() * strength;
            let energy =
                |state: Ball| state.velocity.norm_squared() / 2.0 - acceleration.dot(&state.position);
            let before = engine.ball();
            let tick = engine.tick(acceleration).unwrap();
            let after = engine.ball();
            assert!(after.position.iter().chain(&after.velocity).all(|value| value.is_finite()));
            assert!(!tick.recovered, "seed {seed}, tick {n}: {before:?} -> {after:?}");
            let depth = penetration(&maze.planes, after.position, radius.units());
            assert!(
                depth < 1.0e-9,
                "seed {seed}, tick {n}: {depth} deep, {before:?} -> {after:?}, acceleration {acceleration}"
            );
            let gain = energy(after) - energy(before);
            let scale =
                before.velocity.norm_squared() + after.velocity.norm_squared() + acceleration.norm() * 20.0;
            assert!(
                gain < 1.0e-9 * scale,
                "seed {seed}, tick {n}: gain {gain}, {before:?} -> {after:?}, {acceleration}"
            );
            n_hits += u64::from(tick.n_hits);
            n_corner_hits += u64::from(tick.n_corner_hits);
            n_dropped += u32::from(0.0 < tick.dropped_s);
        }
        assert!(maze.bounds.low < engine.ball().position && engine.ball().position < maze.bounds.high);
    }
    assert!(100_000 < n_hits && 1000 < n_corner_hits, "{n_hits} hits, {n_corner_hits} of corners");
    assert_eq!(n_dropped, 0, "ticks with dropped time");
}

/// Bits of position and velocity after the run below.
const MARATHON: [u64; 4] = [
    13_834_239_942_370_903_663,
    13_829_176_949_903_316_155,
    4_603_690_461_547_010_958,
    4_593_573_683_088_129_775,
];

#[test]
fn a_marathon_of_20000_ticks_ends_in_the_same_bits_everywhere() {
    let maze = random_maze(7);
    let mut engine = Continuous::new(maze.planes.clone(), spec(E), Ball::at(maze.start()), 0.03).unwrap();
    let mut noise = Noise(7);
    let mut n_hits = 0;
    for tick in 0..20_000 {
        // Held for ten ticks, so that there is rest, sliding and rolling around corners as well.
        let acceleration = if tick % 10 < 5 { noise.vector() * 4.0 } else { Vector2::new(0.5, -2.0) };
        n_hits += engine.tick(acceleration).unwrap().n_hits;
    }
    assert!(1000 < n_hits);
    let state = engine.ball();
    let bits = [state.position.x, state.position.y, state.velocity.x, state.velocity.y].map(f64::to_bits);
    assert_eq!(
        bits, MARATHON,
        "physics changed: if intended, update MARATHON and say so in CHANGELOG under Behaviour"
    );
}

#[test]
fn rolling_resistance_stops_a_ball_where_mechanics_says_and_then_holds_it() {
    let spec = BallSpec { resistance: 0.5, ..spec(E) };
    let planes = Arc::new(SortedPlanes::new(FLOOR).unwrap());
    let start = ball([0.0, R], [3.0, 0.0]);
    let mut engine = Continuous::new(planes, spec, start, 0.001).unwrap();
    run(&mut engine, [0.0, -4.0], 10.0);
    // v² / (2 c) = 9; the speed is taken at the end of each tick, which is v tick / 2 too far at most.
    assert!((engine.ball().position.x - 9.0).abs() < 3.0 * 0.001, "{}", engine.ball().position);
    let stopped = engine.ball();
    assert_eq!(stopped.velocity, Vector2::zeros());
    run(&mut engine, [0.49, -4.0], 1.0);
    assert_eq!(engine.ball(), stopped, "a acceleration below the resistance moves nothing");
    run(&mut engine, [0.51, -4.0], 1.0);
    assert!(stopped.position.x < engine.ball().position.x);
}

#[test]
fn with_rolling_resistance_energy_only_falls() {
    let maze = random_maze(5);
    let spec = BallSpec { resistance: 0.3, ..spec(E) };
    let mut engine = Continuous::new(maze.planes.clone(), spec, Ball::at(maze.start()), 0.03).unwrap();
    let mut noise = Noise(5);
    for n in 0..20_000 {
        let acceleration = noise.vector() * 4.0;
        let energy = |state: Ball| state.velocity.norm_squared() / 2.0 - acceleration.dot(&state.position);
        let before = energy(engine.ball());
        engine.tick(acceleration).unwrap();
        // Rounding at energies below 100.
        assert!(energy(engine.ball()) <= before + 1.0e-12, "tick {n}");
    }
    for bad in [-0.1, f64::NAN, f64::INFINITY] {
        let refused = BallSpec { resistance: bad, ..spec }.checked().unwrap_err();
        assert_eq!(refused.to_string(), "the rolling resistance: expected a finite number, 0 or more");
    }
}

#[test]
fn an_observer_sees_every_hit_and_changes_none() {
    let maze = random_maze(9);
    let new = || Continuous::new(maze.planes.clone(), spec(E), Ball::at(maze.start()), 0.03).unwrap();
    let (mut watched, mut alone, mut noise) = (new(), new(), Noise(9));
    for _ in 0..3000 {
        let acceleration = noise.vector() * 4.0;
        let mut n_seen = 0;
        let tick = watched
            .tick_observed(acceleration, &mut |hit: &maze_core::Hit| {
                n_seen += 1;
                let from_wall = hit.after.position - hit.point;
                assert!((from_wall - hit.normal * R).norm() < 1.0e-12, "{hit:?}");
                assert!(hit.before.velocity.dot(&hit.normal) <= 0.0, "{hit:?}");
                assert!(0.0 <= hit.after.velocity.dot(&hit.normal), "{hit:?}");
            })
            .unwrap();
        assert_eq!(tick, alone.tick(acceleration).unwrap());
        assert_eq!((watched.ball(), n_seen), (alone.ball(), tick.n_hits));
    }
}

/// Runs a maze and its image side by side.
fn image_of_the_path_is_the_path_of_the_image(symmetry: &Image) {
    let maze = random_maze(3);
    let image = Facing::ALL.into_iter().flat_map(|facing| maze.planes.planes(facing)).map(symmetry.plane);
    let image = Arc::new(SortedPlanes::new(image).unwrap());
    let at = Ball::at((symmetry.point)(maze.start()));
    let mut one = Continuous::new(maze.planes.clone(), spec(E), Ball::at(maze.start()), 0.03).unwrap();
    let mut other = Continuous::new(image, spec(E), at, 0.03).unwrap();
    let mut noise = Noise(1);
    for n in 0..2000 {
        let acceleration = noise.vector() * 4.0;
        one.tick(acceleration).unwrap();
        other.tick((symmetry.point)(acceleration)).unwrap();
        assert_eq!((symmetry.point)(one.ball().position), other.ball().position, "tick {n}");
        assert_eq!((symmetry.point)(one.ball().velocity), other.ball().velocity, "tick {n}");
    }
}

#[test]
fn a_mirrored_maze_gives_the_mirrored_path() {
    image_of_the_path_is_the_path_of_the_image(&MIRRORED);
}

#[test]
fn a_maze_turned_by_a_quarter_gives_the_turned_path() {
    image_of_the_path_is_the_path_of_the_image(&TURNED);
}
