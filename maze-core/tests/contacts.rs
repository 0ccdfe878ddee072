//! Rest, sliding and rolling wherever a ball touches two features at once, or walls have small steps, slits or no thickness:
//! each scene has a right answer by mechanics.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]
#![allow(clippy::disallowed_methods, reason = "the truth that a test compares with may use any function")]

mod contact_scene;
mod irregular;
mod noise;

use contact_scene::{R, Scene};
use irregular::block;
use maze_core::Path;
use maze_core::time_of_impact;
use maze_core::{Ball, Engine, Facing, Plane};
use nalgebra::Vector2;

/// A long block whose top is y = 0, from x = -99 to `end`.
fn ground(end: f64) -> Vec<Plane> {
    block([-99.0, end], [-2.0, 0.0])
}

/// A wall without thickness, across x or y.
fn sheet(axis: usize, offset: f64, start: f64, end: f64) -> [Plane; 2] {
    let sides = if axis == 0 { [Facing::PlusX, Facing::MinusX] } else { [Facing::PlusY, Facing::MinusY] };
    sides.map(|facing| Plane { facing, offset, start, end })
}

#[test]
fn however_slowly_it_falls_a_ball_touches_the_face_it_lies_on() {
    let floor = Plane { facing: Facing::PlusY, offset: 0.0, start: -5.0, end: 5.0 };
    for speed in [1.0e-150, 1.0e-162, 1.0e-200, 5.0e-324] {
        let (position, velocity) = (Vector2::new(0.0, R), Vector2::new(0.0, -speed));
        let path = Path { position, velocity, acceleration: Vector2::new(0.0, -4.0) };
        assert_eq!(time_of_impact::face(&path, R, &floor), Some(0.0), "{speed:e}");
        let scene = Scene::new(ground(5.0), [0.0, R], [0.0, -speed], [0.0, -4.0]);
        scene.rests_at(0.3, 0.0, R, &format!("speed {speed:e}"));
    }
}

/// A floor and, `height` above it, the corner of a block, with a ball that is driven into the gap between them.
fn wedge(height: f64, restitution: f64, velocity: [f64; 2], acceleration: [f64; 2]) -> Scene {
    let mut planes = ground(9.0);
    planes.extend(block([0.0, 5.0], [height, 9.0]));
    Scene { restitution, ..Scene::new(planes, [-1.0, R], velocity, acceleration) }
}

#[test]
fn a_ball_in_a_wedge_of_a_floor_and_a_corner_comes_to_rest_between_them() {
    for height in [0.36, 0.5, 0.6, 0.69, 0.699, 0.6999] {
        for restitution in [0.0, 1.0e-3, 0.5, 0.8, 0.9] {
            for (velocity, acceleration) in
                [([1.0, 0.0], [2.0, -4.0]), ([0.0, 3.0], [2.0, -4.0]), ([4.0, 0.0], [2.0, -1.0])]
            {
                let scene = wedge(height, restitution, velocity, acceleration);
                let x = -(R * R - (height - R) * (height - R)).sqrt();
                let about =
                    format!("height {height}, restitution {restitution}, {velocity:?}, {acceleration:?}");
                let ticks = scene.rests_at(90.0, x, R, &about);
                let most = ticks.iter().map(|tick| tick.n_hits).max().unwrap();
                assert!(most < 200, "{about}: {most} hits in a tick");
            }
        }
    }
}

#[test]
fn a_ball_between_two_corners_comes_to_rest_above_their_middle() {
    for gap in [0.1, 0.3, 0.6, 0.69] {
        for restitution in [0.0, 0.5, 0.8] {
            let mut planes = block([-5.0, -gap / 2.0], [-2.0, 0.0]);
            planes.extend(block([gap / 2.0, 5.0], [-2.0, 0.0]));
            // Dropped from so low that it does not bounce out of the pit.
            let y = (R * R - gap * gap / 4.0).sqrt();
            let start = [0.01 * gap, y + 0.1 * gap];
            let scene = Scene { restitution, ..Scene::new(planes, start, [0.0, 0.0], [0.0, -4.0]) };
            scene.rests_at(60.0, 0.0, y, &format!("gap {gap}, restitution {restitution}"));
        }
    }
}

/// The hits that a wedge takes: those of the bounces along the floor, which the restitution bounds, and one for the wedge itself,
/// however narrow its angle.
#[test]
fn a_wedge_stops_a_ball_within_a_stated_number_of_hits_at_any_angle() {
    for exponent in 0..=12 {
        // The normals of floor and corner are opposite but for an angle of about √(2 gap / r).
        let misfit = 0.5 * 10.0_f64.powi(-exponent) * R;
        let height = 2.0 * R - misfit;
        for (restitution, most) in [(0.0, 10), (0.5, 40), (0.8, 120), (0.99, 5000)] {
            let scene = wedge(height, restitution, [0.5, 0.0], [2.0, -4.0]);
            let (ball, ticks) = scene.run(if restitution < 0.9 { 30.0 } else { 400.0 });
            let n_hits: u32 = ticks.iter().map(|tick| tick.n_hits).sum();
            let about = format!("misfit {misfit:e}, restitution {restitution}: {n_hits} hits, {ball:?}");
            assert_eq!(ball.velocity, Vector2::zeros(), "{about}");
            let x = -(R * R - (height - R) * (height - R)).sqrt();
            // The place is where two curves cut under that angle: its rounding is divided by it.
            let rounding = 1.0e-15 / (2.0 * misfit / R).sqrt() + 1.0e-12;
            assert!((ball.position - Vector2::new(x, R)).norm() < rounding, "{about}");
            assert!(n_hits <= most, "{about}");
        }
    }
}

#[test]
fn a_gap_narrower_than_the_ball_holds_it() {
    for misfit in [1.0e-3, 1.0e-6, 1.0e-9, 1.0e-11] {
        let mut planes = ground(9.0);
        planes.extend(block([0.0, 5.0], [2.0 * R * (1.0 - misfit), 2.0]));
        for velocity in [0.5, 30.0, 1.0e4] {
            let scene = Scene::new(planes.clone(), [-1.0, R], [velocity, 0.0], [2.0, -4.0]);
            let (ball, _) = scene.run(6.0);
            assert!(ball.position.x < 0.0, "misfit {misfit:e}, speed {velocity}: {ball:?}");
        }
    }
}

/// A corridor from x = 0 on, `width` wide, and a ball on its floor.
fn corridor(width: f64) -> Scene {
    let mut planes = ground(20.0);
    planes.extend(block([0.0, 20.0], [width, 2.0]));
    Scene::new(planes, [-1.0, R], [2.0, 0.0], [0.5, -4.0])
}

#[test]
fn a_gap_equal_to_the_diameter_to_the_last_bit_is_passed() {
    let (ball, _) = corridor(2.0 * R).run(3.0);
    assert!((ball.position - Vector2::new(-1.0 + 6.0 + 2.25, R)).norm() < 1.0e-12, "{ball:?}");
}

#[test]
fn a_gap_wider_by_an_ulp_is_passed() {
    let (ball, _) = corridor((2.0 * R).next_up()).run(3.0);
    assert!((ball.position - Vector2::new(-1.0 + 6.0 + 2.25, R)).norm() < 1.0e-12, "{ball:?}");
}

#[test]
fn a_ball_falls_through_a_shaft_as_wide_as_itself() {
    for width in [2.0 * R, (2.0 * R).next_up()] {
        let mut planes = block([-5.0, 0.0], [-3.0, 0.0]);
        planes.extend(block([width, 5.0], [-3.0, 0.0]));
        let scene = Scene::new(planes, [width / 2.0, 0.5], [0.0, 0.0], [0.0, -4.0]);
        let (ball, _) = scene.run(0.9);
        assert!((ball.position.y - (0.5 - 2.0 * 0.81)).abs() < 1.0e-9, "{ball:?}");
    }
}

#[test]
fn steps_down_are_rolled_over_and_steps_up_by_rounding_too() {
    let step = |height: f64, speed: f64| {
        let mut planes = ground(0.0);
        planes.extend(block([0.0, 99.0], [-2.0, height]));
        Scene::new(planes, [-0.5, R], [speed, 0.0], [0.0, -4.0])
    };
    for height in [0.0, 1.0e-16, 1.0e-15, 1.0e-13, 4.0e-13, 1.0e-12, 1.0e-11, 1.0e-10, 1.0e-9] {
        for (height, speed) in [(height, 0.5), (height, 3.0), (-height, 0.5), (-height, 3.0)] {
            let (ball, _) = step(height, speed).run(3.0);
            // A step of h takes or gives a height of h and, in the hit of its corner, some 2 h / r of the energy.
            let exact = Vector2::new(-0.5 + 3.0 * speed, R + height);
            let off = (ball.position - exact).amax();
            assert!(off < 1.0e-11 + 120.0 * height.abs(), "step {height:e}, speed {speed}: {ball:?}");
        }
    }
    // Larger steps down: the ball comes to lie on the lower floor, at any speed.
    let mut noise = noise::Noise(5);
    for height in [1.0e-7, 1.0e-5, 1.0e-3, 0.05, 0.2, R] {
        for _ in 0..200 {
            let (ball, _) = step(-height, 0.1 + noise.next().abs()).run(9.0);
            assert!((ball.position.y - (R - height)).abs() < 1.0e-9, "step {height}: {ball:?}");
        }
    }
}

#[test]
fn a_ball_that_stops_dead_below_an_overhang_stays_on_the_floor() {
    let scene = wedge(0.5, 0.0, [1.0, 0.0], [2.0, -4.0]);
    scene.rests_at(3.0, -(R * R - 0.15 * 0.15_f64).sqrt(), R, "overhang");
}

#[test]
fn a_ball_rolls_down_a_step_under_any_pull() {
    for acceleration in [1.0e3, 1.0e4, 1.0e5, 1.0e6] {
        for height in [0.05, 0.1, 0.2] {
            for k in 1..20 {
                let mut planes = ground(0.0);
                planes.extend(block([0.0, 99.0], [-2.0, -height]));
                let scene = Scene::new(planes, [-0.1, R], [f64::from(k) * 0.25, 0.0], [0.0, -acceleration]);
                scene.run(0.9);
            }
        }
    }
}

#[test]
fn slits_in_a_floor_are_passed() {
    for width in [1.0e-16, 1.0e-15, 1.0e-12, 1.0e-9, 1.0e-8, 1.0e-7, 1.0e-6, 1.0e-5, 1.0e-3] {
        for speed in [0.5, 3.0] {
            let mut planes = ground(0.0);
            planes.extend(block([width, 9.0], [-2.0, 0.0]));
            let scene = Scene::new(planes, [-0.5, R], [speed, 0.0], [0.0, -4.0]);
            let (ball, _) = scene.run(1.2);
            // The slit's far corner takes (width / r)² of the energy at most.
            let exact = Vector2::new(-0.5 + 1.2 * speed, R);
            let off = (ball.position - exact).amax();
            assert!(off < 1.0e-9 + 10.0 * width * width, "slit {width:e}, speed {speed}: {ball:?}");
        }
    }
}

#[test]
fn a_ball_slower_than_the_rest_bound_passes_slits_and_steps_by_rounding() {
    for width in [0.0, 1.0e-15, 1.0e-12, 1.0e-9, 1.0e-8] {
        for height in [0.0, 1.0e-16, 1.0e-14, -1.0e-14, -1.0e-12] {
            let mut planes = ground(0.0);
            planes.extend(block([width, 99.0], [-2.0, height]));
            // It starts at rest 5e-11 before the edge, and has 1e-6 units/s there.
            let scene = Scene::new(planes, [-5.0e-11, R], [0.0, 0.0], [0.01, -4.0]);
            let (ball, _) = scene.run(9.0);
            let off = (ball.position.x - 0.01 * 81.0 / 2.0).abs();
            assert!(off < 1.0e-4, "width {width:e}, height {height:e}: {ball:?}");
        }
    }
}

#[test]
fn a_ball_that_does_not_get_over_a_free_end_slides_down_the_side_it_came_from() {
    for side in [-1.0, 1.0] {
        let wall = sheet(0, 0.0, -5.0, 0.0).to_vec();
        let scene = Scene::new(wall, [side * R, -0.1], [0.0, 0.5], [-side * 3.0, -1.0]);
        let (ball, _) = scene.run(2.01);
        assert!(
            (ball.position.x - side * R).abs() < 1.0e-12 && ball.position.y < 0.0,
            "side {side}: {ball:?}"
        );
    }
}

#[test]
fn walls_without_thickness_that_meet_in_an_l_are_rolled_off() {
    let walls: Vec<Plane> = [sheet(0, 0.0, -3.0, 0.0), sheet(1, 0.0, 0.0, 3.0)].concat();
    let (ball, _) = Scene::new(walls.clone(), [0.1, R], [-0.2, 0.0], [0.0, -4.0]).run(3.0);
    assert!(ball.position.x < -R && ball.position.y < -1.0, "{ball:?}");
    // Dropped onto the outside of the corner it gains nothing, see `Scene::run`.
    let drop = Scene::new(walls, [-0.2, 0.29], [0.0, 0.0], [0.0, -4.0]);
    let (ball, _) = Scene { restitution: 0.0, ..drop }.run(0.6);
    assert!(ball.position.x <= -R + 1.0e-9, "{ball:?}");
}

#[test]
fn a_wall_that_ends_in_a_wall_without_thickness_is_no_corner() {
    let walls: Vec<Plane> = [sheet(1, 0.0, -3.0, 3.0), sheet(0, 0.0, -3.0, 0.0)].concat();
    let (ball, _) = Scene::new(walls, [-1.0, R], [1.0, 0.0], [0.0, -4.0]).run(2.01);
    assert!((ball.position - Vector2::new(1.01, R)).norm() < 1.0e-12, "{ball:?}");
}

#[test]
fn a_ball_rolls_over_the_end_of_a_wall_of_any_thickness() {
    for thickness in [1.0e-9, 1.0e-6, 1.0e-4, 3.0e-4, 1.0e-3, 0.1] {
        let walls = block([0.0, thickness], [-5.0, 0.0]);
        let start = [0.18490125472008073, 0.4];
        let scene = Scene::new(walls, start, [-0.004920314727550723, 0.0], [-1.9186, -2.7111]);
        let (ball, _) = Scene { restitution: 0.0, ..scene }.run(1.8);
        assert!(ball.position.y < -0.5, "thickness {thickness}: {ball:?}");
    }
}

#[test]
fn a_ball_that_comes_off_a_floor_and_meets_a_wall_at_the_same_instant_stays_outside() {
    let mut planes = block([-6.0, 0.0], [-3.0, 0.0]);
    planes.extend(block([R, 2.0], [-3.0, 3.0]));
    for (x, speed) in [(-0.9, 0.0), (-0.9, 2.0), (-0.3, 3.0)] {
        let scene = Scene::new(planes.clone(), [x, R], [speed, 0.0], [1.7, -0.7]);
        let (ball, _) = scene.run(30.0);
        assert_eq!(ball, Ball { position: Vector2::new(0.0, R), velocity: Vector2::zeros() });
    }
}

#[test]
fn a_roll_off_an_edge_follows_the_pendulum_whatever_the_tick() {
    // Lift-off where 3 g cos θ = 2 g + v² / r; the speed there is that of the energy; then a parabola.
    for (radius, acceleration, speed) in
        [(0.35, 4.0, 0.2), (0.25, 4.0, 0.01), (0.35, 300.0, 0.5), (1.0e-3, 4.0, 0.02)]
    {
        let cos = 2.0 / 3.0 + speed * speed / (3.0 * acceleration * radius);
        let sin = (1.0_f64 - cos * cos).sqrt();
        let faster = (speed * speed + 2.0 * radius * acceleration * (1.0 - cos)).sqrt();
        // Tall enough for a fall of half a second.
        let planes = block([-9.0, 0.0], [-99.0, 0.0]);
        let after = |tick_s: f64| {
            let scene =
                Scene::new(planes.clone(), [-speed * 0.5, radius], [speed, 0.0], [0.0, -acceleration]);
            Scene { radius, restitution: 0.0, tick_s, ..scene }.run(3.2).0
        };
        let finest = after(0.001);
        for tick_s in [0.005, 0.032, 0.1] {
            let off = (after(tick_s).position - finest.position).norm();
            assert!(off < 1.0e-9, "radius {radius}, tick {tick_s}: {off}");
        }
        // In flight the speed across the acceleration stays what it was at lift-off.
        assert!((finest.velocity.x - faster * cos).abs() < 1.0e-10, "{finest:?}, {}", faster * cos);
        // ... and so does the point where the parabola left the arc.
        let fallen = (finest.position.x - radius * sin) / finest.velocity.x;
        let y = radius * cos - faster * sin * fallen - acceleration * fallen * fallen / 2.0;
        assert!((finest.position.y - y).abs() < 1.0e-9 * y.abs().max(1.0), "{finest:?}, {y}");
    }
}

#[test]
fn the_rest_between_two_features_does_not_depend_on_the_tick() {
    for tick_s in [0.001, 0.006, 0.03, 0.1] {
        let scene = Scene { tick_s, ..wedge(0.6, 0.8, [1.0, 0.0], [2.0, -4.0]) };
        scene.rests_at(12.0, -(R * R - 0.25 * 0.25_f64).sqrt(), R, &format!("tick {tick_s}"));
    }
}

#[test]
fn a_ball_that_rests_between_two_features_leaves_when_the_board_turns() {
    let scene = wedge(0.6, 0.8, [1.0, 0.0], [2.0, -4.0]);
    let mut engine = scene.engine();
    for _ in 0..400 {
        engine.tick(Vector2::new(2.0, -4.0)).unwrap();
    }
    let rest = engine.ball();
    assert_eq!((rest.velocity, engine.state().contacts().iter().count()), (Vector2::zeros(), 2));
    // Along the floor, as if the corner were not there.
    engine.tick(Vector2::new(-1.0, -4.0)).unwrap();
    let exact = rest.position + Vector2::new(-0.03 * 0.03 / 2.0, 0.0);
    assert!((engine.ball().position - exact).norm() < 1.0e-15);
    assert_eq!(engine.state().contacts().iter().count(), 1);
}

#[test]
fn bounces_that_lose_little_are_followed_to_their_rest() {
    for (restitution, tick_s) in [(0.99, 1.0), (0.998, 0.03), (0.998, 0.1)] {
        let scene = Scene::new(ground(9.0), [0.0, R + 1.0e-3], [0.0, 0.0], [0.0, -4.0]);
        let scene = Scene { restitution, tick_s, ..scene };
        scene.rests_at(60.0, 0.0, R, &format!("restitution {restitution}, tick {tick_s}"));
    }
}

/// A stretch of wall that ends above a floor, as in a plan of blocks, and boards held at every whole degree.
#[test]
fn at_every_whole_degree_a_ball_in_a_maze_with_wedges_comes_to_rest() {
    // A room of 6 by 4 with a bar that leaves a gap of 0.6 above the floor and one of 0.65 beside the wall.
    let mut planes = block([-3.0, 2.35], [-1.4, -1.0]);
    planes.extend(block([-1.0, 3.0], [0.4, 1.0]));
    for (facing, offset) in
        [(Facing::PlusX, -3.0), (Facing::MinusX, 3.0), (Facing::PlusY, -2.0), (Facing::MinusY, 2.0)]
    {
        let half = if facing.axis() == 0 { 2.0 } else { 3.0 };
        planes.push(Plane { facing, offset, start: -half, end: half });
    }
    for x in 1..=14 {
        for y in 1..=21 {
            let acceleration = [f64::from(x), -f64::from(y)].map(|degrees| 9.81 * degrees.to_radians().sin());
            let scene = Scene::new(planes.clone(), [-2.0, 1.5], [0.0, 0.0], acceleration);
            let (ball, _) = scene.run(60.0);
            assert_eq!(ball.velocity, Vector2::zeros(), "tilt {x}, {y}: {ball:?}");
            assert!(ball.position.x.abs() < 3.0 && ball.position.y.abs() < 2.0, "tilt {x}, {y}: {ball:?}");
        }
    }
}
