//! The same head-on bounce through our engine, through rapier3d, and by hand.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use maze_core::{Ball, BallSpec, Bounds, Engine, Facing, Plane, Published, SortedPlanes};
use maze_verify::{Board, RapierEngine, Walls};
use nalgebra::Vector2;
use std::sync::Arc;

const SPEED: f64 = 3.0;
const WALL: Bounds = Bounds { low: Vector2::new(5.0, -10.0), high: Vector2::new(6.0, 10.0) };

fn ball() -> Ball {
    Ball { position: Vector2::zeros(), velocity: Vector2::new(SPEED, 0.0) }
}

fn published() -> Published {
    let face = Plane { facing: Facing::MinusX, offset: WALL.low.x, start: WALL.low.y, end: WALL.high.y };
    let planes = Arc::new(SortedPlanes::new([face]).unwrap());
    Published::new(planes, BallSpec::default(), ball(), Published::TICK_S).unwrap()
}

fn rapier() -> RapierEngine {
    let board = Board::from_rectangles(vec![WALL]).unwrap();
    RapierEngine::new(&board, Walls::Cuboids, BallSpec::default(), ball(), Published::TICK_S).unwrap()
}

/// Ticks until well after the bounce; the number of hits and the ball at the end.
fn after_the_bounce(engine: &mut dyn Engine) -> (u32, Ball) {
    let n_hits = (0..80).map(|_| engine.tick(Vector2::zeros()).unwrap().n_hits).sum();
    (n_hits, engine.ball())
}

#[test]
fn the_same_head_on_bounce_through_our_engine_and_rapier() {
    let (ours_hits, ours) = after_the_bounce(&mut published());
    let (rapiers_hits, rapiers) = after_the_bounce(&mut rapier());
    assert_eq!((ours_hits, rapiers_hits), (1, 1));

    // Closed form: back at restitution times the speed. Ours is exact, rapier's is f32.
    let expected = -BallSpec::RESTITUTION * SPEED;
    assert_eq!(ours.velocity, Vector2::new(expected, 0.0));
    assert!((rapiers.velocity.x - expected).abs() < 1.0e-5, "{}", rapiers.velocity.x);
    assert!(rapiers.velocity.y.abs() < 1.0e-5);

    // Closed form: contact at (5 - r) / v, then back. Both notice the wall at the end of a tick at the earliest, which is
    // worth at most one tick's displacement in and one out.
    let contact = WALL.low.x - BallSpec::RADIUS.units();
    let exact = contact + expected * (80.0 * Published::TICK_S - contact / SPEED);
    let one_tick = (SPEED - expected) * Published::TICK_S;
    for (name, position) in [("ours", ours.position.x), ("rapier's", rapiers.position.x)] {
        assert!((position - exact).abs() < one_tick, "{name}: {position}, exact {exact}");
    }
}

#[test]
fn rapier_refuses_what_our_engine_refuses() {
    let mut rapier = rapier();
    assert!(rapier.tick(Vector2::new(f64::NAN, 0.0)).is_err());
    assert!(rapier.place(Ball::at(Vector2::new(f64::INFINITY, 0.0))).is_err());
    assert_eq!(rapier.ball(), ball());
    let board = Board::from_rectangles(vec![WALL]).unwrap();
    for resistance in [-0.1, f64::INFINITY] {
        let spec = BallSpec { resistance, ..BallSpec::default() };
        assert!(RapierEngine::new(&board, Walls::Cuboids, spec, ball(), 0.03).is_err(), "{resistance}");
    }
}
