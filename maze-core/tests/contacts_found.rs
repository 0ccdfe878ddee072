//! Scenes in which an attempt to break the engine has succeeded: each failed once.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]
#![allow(clippy::disallowed_methods, reason = "the truth that a test compares with may use any function")]

mod contact_scene;
mod irregular;
mod noise;

use contact_scene::{R, Scene};
use irregular::{block, depth};
use maze_core::Engine;
use nalgebra::Vector2;

#[test]
fn a_ball_that_an_acceleration_all_but_lifts_off_and_brakes_stays_on_its_arc() {
    let planes = block([-9.0, 0.0], [-9.0, 0.0]);
    let mut n = 0;
    for k in 0..20 {
        for lift in [0.0, 1.0e-15, 1.0e-12, 1.0e-9, 1.0e-6] {
            for brake in [0.1, 1.0, 10.0, 100.0] {
                let speed = 0.3 + 0.014 * f64::from(k);
                let scene = Scene::new(planes.clone(), [-0.1, R], [speed, 0.0], [0.0, -4.0]);
                let mut engine = Scene { tick_s: 0.01, ..scene }.engine();
                // Until it rolls around the corner.
                let contact = (0..100).find_map(|_| {
                    engine.tick(Vector2::new(0.0, -4.0)).unwrap();
                    engine.state().contacts().iter().next().filter(|contact| contact.normal.x != 0.0)
                });
                let Some(contact) = contact else { continue };
                let velocity = engine.ball().velocity;
                let outward = velocity.norm_squared() / R - lift;
                let tick = engine.tick(-contact.normal * outward - velocity.normalize() * brake).unwrap();
                let about =
                    format!("speed {speed}, lift {lift:e}, brake {brake}: {tick:?}, {:?}", engine.ball());
                assert!(depth(&planes, engine.ball().position, R) < 1.0e-9 * R, "{about}");
                assert_eq!((tick.corrected_overlap, tick.dropped_s), (0.0, 0.0), "{about}");
                n += 1;
            }
        }
    }
    assert!(300 < n, "{n} cases");
}

#[test]
fn a_slow_approach_to_a_corner_that_does_not_turn_away_is_no_graze() {
    for slope in [1.0e-8, 1.0e-7, 3.0e-7, 4.9e-7] {
        for excess in [1.0e-9, 1.0e-6, 1.0e-4, 1.0e-3] {
            for brake in [0.1, 1.0, 100.0, 1000.0] {
                // Just too fast for the acceleration of 1 unit/s² to hold it, and braked.
                let speed = (R + excess).sqrt();
                let planes = block([-1.0, 0.0], [-1.0, 0.0]);
                let scene = Scene::new(planes, [1.0e-9, R], [speed, -slope * speed], [-brake, -1.0]);
                scene.run(0.09);
                Scene { tick_s: 0.1, ..scene }.run(0.1);
            }
        }
    }
}

#[test]
fn a_ball_that_has_come_over_its_face_by_a_rounding_slides_on_it() {
    let planes = block([-437.2, -436.6518059245237], [-997.4084468437193, -996.0]);
    let start = [-436.6518059245237, -997.7584468437193];
    let acceleration = [-22.501134640744354, 113.94614226497342];
    let (ball, _) = Scene::new(planes, start, [-6.571817446985296e-5, 0.0], acceleration).run(0.03);
    assert_eq!((ball.position.y, ball.velocity.y), (start[1], 0.0));
    assert!((ball.velocity.x + 0.675_099_757).abs() < 1.0e-6, "{ball:?}");
}

#[test]
fn a_ball_in_a_nook_as_wide_as_itself_rests_on_its_bottom() {
    let [left, right] = [-1.2008804842037786, -0.5008804842037786];
    for restitution in [0.0, 0.8, 0.93] {
        let mut planes = block([-1.3, left], [1.3, 1.9]);
        planes.extend(block([right, -0.4], [1.3, 1.9]));
        planes.extend(block([-1.3, -0.4], [1.2, 1.3081816537397628]));
        let start = [-0.8508804842037786, 1.6581816537397627];
        let scene = Scene { restitution, ..Scene::new(planes, start, [0.35, 0.0], [0.0, -1.0]) };
        let ticks = scene.rests_at(0.3, start[0], start[1], &format!("restitution {restitution}"));
        assert!(ticks.iter().all(|tick| tick.n_hits < 10), "restitution {restitution}");
    }
}

#[test]
fn a_pin_of_a_billionth_carries_a_ball() {
    let pin = block([0.3281249999999999, 0.3281250009999999], [1.413125, 1.413125001]);
    let start = [0.32812500348952767, 1.0631249999999999];
    let scene = Scene::new(pin, start, [0.0, 0.0], [-2.133880929185544e-8, 3.0]);
    let (_, ticks) = Scene { restitution: 0.95, tick_s: 0.1, ..scene }.run(0.3);
    assert!(ticks.iter().all(|tick| tick.n_hits < 10));
}

#[test]
fn a_ball_that_is_pressed_exactly_along_a_corner_s_normal_comes_to_rest_there() {
    let planes = block([-0.25, 0.0], [0.3, 0.6250000000000001]);
    let (start, velocity) = ([-0.44999999999999984, 0.7750000000000004], [-0.2, 0.15]);
    let scene = Scene::new(planes, start, velocity, [7.8479999999999945, -5.886000000000009]);
    let (ball, ticks) = Scene { radius: 0.25, restitution: 0.3, tick_s: 0.3, ..scene }.run(0.9);
    assert!(ball.velocity.norm() < 1.0e-12 && ticks.iter().all(|tick| tick.n_hits < 20), "{ball:?}");
}

#[test]
fn a_ball_between_two_opposite_corners_leaves_where_it_is_pulled() {
    let mut planes = block([19236.7, 19236.71351793893], [81171.8294264443, 81171.84]);
    planes.extend(block([19236.71360348213, 19236.72], [81171.80, 81171.81308904727]));
    let (start, acceleration) =
        ([19236.713560710534, 81171.82125774579], [-0.005229343783858636, 0.002975854944420495]);
    let scene = Scene::new(planes, start, [0.0, 0.0], acceleration);
    let mut engine =
        Scene { radius: 0.008168810514943522, restitution: 1.0e-3, tick_s: 1.0, ..scene }.engine();
    for _ in 0..2 {
        assert_eq!(engine.tick(acceleration.into()).unwrap().dropped_s, 0.0);
    }
    assert!(engine.ball().velocity.x < -0.009, "{:?}", engine.ball());
}

#[test]
fn a_ball_that_is_pressed_into_a_slit_of_a_ten_billionth_rests_between_its_edges() {
    let mut planes = block([-0.9, 0.0], [-0.9, -0.35]);
    planes.extend(block([7.0e-11, 0.9], [-0.9, -0.35]));
    let scene = Scene::new(planes, [0.0, 0.0], [0.0, 0.0], [1.0e-17, -0.04]);
    let (ball, ticks) = scene.run(0.9);
    assert!(ball.velocity.norm() < 1.0e-12 && ticks.iter().all(|tick| tick.n_hits < 10), "{ball:?}");
}

#[test]
fn a_ball_that_is_pressed_along_one_normal_of_two_rests_on_both() {
    let mut planes = block([-1.4, -1.243959964769095], [0.5168876505938718, 0.7]);
    planes.extend(block([-0.3794370867597898, -0.2], [-0.1, 0.09003707567865266]));
    let start = [-0.8255844643254964, 0.2753384427904154];
    let acceleration = [-8.495709211125341, 4.905000000000004].map(|acceleration| 0.3 * acceleration);
    let scene = Scene::new(planes, start, [1.533124083701694e-5, 4.56655560775427e-5], acceleration);
    let (ball, ticks) = Scene { radius: 0.4830984156069126, tick_s: 0.001, ..scene }.run(0.003);
    assert!(ball.velocity == Vector2::zeros() && ticks.iter().all(|tick| tick.n_hits < 10), "{ball:?}");
}
