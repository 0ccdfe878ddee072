//! The whole board is in view, at any window shape and tilt, and no larger border than needed is left.

use maze_render::{Camera, PITCH_RAD};
use nalgebra::{UnitQuaternion, Vector3, Vector4};

const BOARDS: [[f32; 3]; 5] =
    [[5.0, 5.0, 0.6], [9.0, 5.5, 0.7], [2.6, 10.0, 0.5], [100.0, 60.0, 0.6], [2.5, 2.5, 0.6]];
const ASPECTS: [f32; 8] = [0.2, 0.45, 0.75, 1.0, 1.34, 1.78, 2.4, 5.0];
const MAX_TILTS_RAD: [f32; 3] = [0.0, 0.26, 0.6];

/// Farthest that any corner of the board gets from the middle of the screen at any tilt: 1 is the edge.
fn reach(camera: &Camera, [hx, hy, hz]: [f32; 3], aspect: f32, max_tilt_rad: f32) -> f32 {
    let clip_from_world = camera.clip_from_world(aspect);
    let mut reach = 0.0_f32;
    // Odd counts, so that these are not the directions the fit itself looks at.
    for direction in 0..91_u8 {
        let azimuth_rad = std::f32::consts::TAU * f32::from(direction) / 91.0;
        for part in [0.0, 0.37, 0.71, 1.0] {
            let axis = Vector3::new(azimuth_rad.cos(), azimuth_rad.sin(), 0.0);
            let tilt = UnitQuaternion::from_scaled_axis(axis * (part * max_tilt_rad));
            for corner in 0..8_u8 {
                let pick = |bit: u8, low: f32, high: f32| if corner >> bit & 1 == 0 { low } else { high };
                let p = tilt * Vector3::new(pick(0, -hx, hx), pick(1, -hy, hy), pick(2, 0.0, hz));
                let clip = clip_from_world * Vector4::new(p.x, p.y, p.z, 1.0);
                assert!(
                    0.0 < clip.w && 0.0 < clip.z && clip.z < clip.w,
                    "between the near and the far plane"
                );
                reach = reach.max((clip.x / clip.w).abs()).max((clip.y / clip.w).abs());
            }
        }
    }
    reach
}

#[test]
fn the_fit_holds_every_board_and_wastes_little() {
    for board in BOARDS {
        for aspect in ASPECTS {
            for max_tilt_rad in MAX_TILTS_RAD {
                let looking_at_centre = Camera {
                    target: [0.0; 3],
                    distance: Camera::fitted_distance(board, aspect, max_tilt_rad),
                };
                let centred = Camera::fitted(board, aspect, max_tilt_rad);
                assert!(centred.distance <= looking_at_centre.distance);
                for camera in [centred, looking_at_centre] {
                    let reach = reach(&camera, board, aspect, max_tilt_rad);
                    assert!((0.9..1.0).contains(&reach), "{board:?} at {aspect}, {max_tilt_rad}: {reach}");
                }
            }
        }
    }
}

#[test]
fn a_board_without_size_still_gives_a_usable_view() {
    let camera = Camera::fitted([0.0; 3], 1.0, 0.0);
    assert!(0.0 < camera.distance && camera.distance.is_finite());
}

#[test]
fn screen_right_is_world_x_and_screen_up_is_away() {
    let camera = Camera { target: [0.0; 3], distance: 10.0 };
    let size = [800, 600];
    let at = |world| camera.project(size, world).unwrap();
    let near = |a: [f32; 2], b: [f32; 2]| (a[0] - b[0]).abs() < 1e-2 && (a[1] - b[1]).abs() < 1e-2;
    assert!(near(at([0.0; 3]), [400.0, 300.0]), "the target is in the middle");
    let right = at([1.0, 0.0, 0.0]);
    assert!(400.0 < right[0] && (right[1] - 300.0).abs() < 1e-2);
    let away = at([0.0, 1.0, 0.0]);
    assert!(away[1] < 300.0 && (away[0] - 400.0).abs() < 1e-2);
    assert!(camera.project(size, (camera.eye() * 2.0).into()).is_none(), "behind the eye");
}

#[test]
fn view_axes_turn_into_the_world() {
    let world_from_view = Camera::world_from_view();
    let camera = Camera { target: [0.0; 3], distance: 2.0 };
    let towards_eye = world_from_view * Vector3::z() * 2.0;
    assert!((towards_eye - camera.eye().coords).norm() < 1e-6);
    assert!((world_from_view * Vector3::x() - Vector3::x()).norm() < 1e-6);
    assert!((towards_eye.angle(&Vector3::z()) - PITCH_RAD).abs() < 1e-6);
    assert!(towards_eye.y < 0.0, "the eye is on the player's side");
}
