//! The steel ball by closed forms: it stops, starts and rebounds as its constants say.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use maze_core::{Ball, BallKind, BallSpec, Continuous, Engine, Facing, Plane, SortedPlanes};
use nalgebra::Vector2;
use std::sync::Arc;

const TICK_S: f64 = 0.03;

/// At the origin with a velocity (units/s), and a wall across x at a distance.
fn engine(velocity: Vector2<f64>, wall_x: f64) -> Continuous {
    let spec = BallKind::Steel.spec(BallSpec::RADIUS);
    let wall = Plane { facing: Facing::MinusX, offset: wall_x, start: -100.0, end: 100.0 };
    let planes = Arc::new(SortedPlanes::new([wall]).unwrap());
    Continuous::new(planes, spec, Ball { position: Vector2::zeros(), velocity }, TICK_S).unwrap()
}

#[test]
fn on_a_flat_board_it_stops_after_its_speed_over_the_resistance() {
    for speed in [0.2, 1.0, 2.0, 3.0] {
        let mut engine = engine(Vector2::new(0.6, 0.8) * speed, 1000.0);
        let mut n_ticks = 0;
        while engine.ball().velocity != Vector2::zeros() {
            engine.tick(Vector2::zeros()).unwrap();
            n_ticks += 1;
        }
        let (time_s, expected_s) = (f64::from(n_ticks) * TICK_S, speed / BallKind::STEEL_RESISTANCE);
        assert!((time_s - expected_s).abs() <= TICK_S, "{speed}: {time_s} s, expected {expected_s}");
        // The resistance is taken at the end of each tick: half a tick's way at the first speed more.
        let way = speed * speed / (2.0 * BallKind::STEEL_RESISTANCE);
        let rolled = engine.ball().position.norm();
        assert!((rolled - way).abs() <= speed * TICK_S, "{speed}: {rolled} units, expected {way}");
    }
}

#[test]
fn a_tilt_of_5_degrees_leaves_it_at_rest_and_one_of_6_sets_it_in_motion() {
    // With the sines of the angles: the physics and its tests have no trigonometry.
    for (degrees, sin, moves) in
        [(1, 0.017_452, false), (5, 0.087_156, false), (6, 0.104_528, true), (20, 0.342_020, true)]
    {
        let mut engine = engine(Vector2::zeros(), 1000.0);
        let acceleration = 9.81 * sin;
        for _ in 0..100 {
            engine.tick(Vector2::new(0.0, acceleration)).unwrap();
        }
        let (time_s, ball) = (100.0 * TICK_S, engine.ball());
        assert_eq!(0.0 < ball.velocity.y, moves, "{degrees} degrees");
        let net = acceleration * BallSpec::ROLLING_SPHERE - BallKind::STEEL_RESISTANCE;
        let expected = if moves { net * time_s } else { 0.0 };
        assert!(
            (ball.velocity.y - expected).abs() < 1.0e-9,
            "{degrees} degrees: {} units/s",
            ball.velocity.y
        );
    }
}

#[test]
fn it_keeps_two_fifths_of_its_speed_towards_a_wall_and_all_of_that_along_it() {
    let mut engine = engine(Vector2::new(3.0, 1.0), 0.4);
    let tick = engine.tick(Vector2::zeros()).unwrap();
    assert_eq!(tick.n_hits, 1);
    let velocity = engine.ball().velocity;
    let before_resistance = Vector2::new(-3.0 * BallKind::STEEL_RESTITUTION, 1.0);
    let lost = before_resistance.norm() - velocity.norm();
    assert!((lost - BallKind::STEEL_RESISTANCE * TICK_S).abs() < 1.0e-12, "{velocity}");
    assert!(velocity.perp(&before_resistance).abs() < 1.0e-12, "its direction is that of the reflection");
}

#[test]
fn balls_have_names() {
    for kind in BallKind::ALL {
        assert_eq!(kind.name().parse(), Ok(kind));
        assert!(kind.spec(BallSpec::RADIUS).checked().is_ok());
    }
    assert_eq!("glass".parse::<BallKind>().unwrap_err().to_string(), "expected report or steel");
    assert_eq!(BallKind::Report.spec(BallSpec::RADIUS), BallSpec::default());
}
