//! What the reference has found in the engine: each failed once.

use crate::gaps::after;
use crate::reference_model::{Reference, World, big::big};
use crate::rolls::{BALLS, turning_courses};
use crate::wedges::{RADII, Wedge, face, slit};
use maze_core::{Ball, BallSpec, Continuous, Engine, Facing, Radius, SortedPlanes};
use std::sync::Arc;

#[test]
fn a_roll_that_turns_back_within_a_tick_keeps_its_time() {
    // Around the free end of a wall without thickness, up to where it turns, and back, without any hit from tick 26 on.
    let (r, tick_s, acceleration) = (0.35, 0.0137, [-3.6, -1.2]);
    let wall = [Facing::PlusY, Facing::MinusY].map(|facing| face(facing, 0.0, -20.0 * r, 0.0));
    let spec = BallSpec { radius: Radius::new(r).unwrap(), restitution: 0.0, ..BallSpec::default() };
    let speed = 0.9 * (2.0 * r * 4.0).sqrt();
    let ball = Ball { position: [-0.5 * r, r].into(), velocity: [speed, 0.0].into() };
    let world = World::new(&wall, &spec);
    let mut reference = Reference::new(&world, ball, acceleration);
    let mut engine = Continuous::new(Arc::new(SortedPlanes::new(wall).unwrap()), spec, ball, tick_s).unwrap();
    for n in 1..=40 {
        engine.tick(acceleration.into()).unwrap();
        reference.advance(&(big(tick_s) * big(f64::from(n))));
        let (ball, truth) = (engine.ball(), reference.ball());
        let apart = (ball.velocity - truth.velocity).norm();
        // 1e-15 until it turns.
        assert!(apart < 1.0e-12, "tick {n}: {apart} units/s apart, {ball:?} instead of {truth:?}");
    }
}

#[test]
fn courses_on_which_a_roll_turns_back_are_those_of_the_reference() {
    for [r, strength, rolling] in BALLS {
        for course in turning_courses() {
            course.compare([r, strength, rolling, 0.0]);
        }
    }
}

#[test]
fn a_wedge_of_a_millionth_drops_no_time() {
    // Half the barrier is r angle² / 16 = 6e-14 r: far below the rest bound, so that the first touch is the last.
    let angle = 1.0e-6;
    for r in RADII {
        for wedge in [Wedge::points(r, angle), Wedge::floor_and_corner(r, angle)] {
            let mut engine = wedge.engine(r, 0.8);
            for n in 0..4 {
                let tick = engine.tick(wedge.acceleration.into()).unwrap();
                assert_eq!(tick.dropped_s, 0.0, "r {r}, tick {n}: {tick:?}");
            }
        }
    }
}

#[test]
fn a_gap_narrower_by_a_part_in_1e12_is_not_passed_down_its_middle() {
    for r in RADII {
        let ball = after(&slit(r * (1.0 - 1.0e-12)), r, 0.8, 0.0, 3.0);
        assert!(0.0 < ball.position.y, "r {r}: {ball:?}");
    }
}

#[test]
fn a_gap_narrower_by_a_part_in_1e12_is_not_passed_after_bounces_from_side_to_side() {
    for r in RADII {
        let wedge = Wedge::narrow(r, 1.0e-12);
        let mut engine = wedge.engine(r, 0.8);
        for n in 0..100 {
            engine.tick(wedge.acceleration.into()).unwrap();
            assert!(0.0 < engine.ball().position.y, "r {r}, tick {n}: {:?}", engine.ball());
        }
    }
}
