//! The whole board is in view, at any window shape and tilt, and no larger border than needed is left.

use maze_render::{Camera, PITCH_RAD};
use nalgebra::{UnitQuaternion, Vector3, Vector4};

const BOARDS: [[f32; 3]; 5] =
    [[5.0, 5.0, 0.6], [9.0, 5.5, 0.7], [2.6, 10.0, 0.5], [100.0, 60.0, 0.6], [2.5, 2.5, 0.6]];
const ASPECTS: [f32; 8] = [0.2, 0.45, 0.75, 1.0, 1.34, 1.78, 2.4, 5.0];
const MAX_TILTS_RAD: [f32; 3] = [0.0, 0.26, 0.6];

/// How far a rim hangs below the floor, as in `src/mesh.rs`.
const RIM_DEPTH: f32 = 0.35;

/// What part of the half screen a fit fills at most, and how little of it at least: it is off by 0.3 percent.
const FILLED: [f32; 2] = [0.966, 0.9701];

/// Farthest that the board gets up and down the screen, and to its sides, from the middle: 1 is the edge.
#[derive(Debug)]
struct Reach {
    up: f32,
    down: f32,
    aside: f32,
}

impl Reach {
    fn at_tilts(
        camera: &Camera,
        [hx, hy, hz]: [f32; 3],
        aspect: f32,
        tilts: impl Iterator<Item = UnitQuaternion<f32>>,
    ) -> Self {
        let clip_from_world = camera.clip_from_world(aspect);
        let mut reach = Self { up: f32::MIN, down: f32::MIN, aside: f32::MIN };
        for tilt in tilts {
            for corner in 0..8_u8 {
                let pick = |bit: u8, low: f32, high: f32| if corner >> bit & 1 == 0 { low } else { high };
                let p = tilt * Vector3::new(pick(0, -hx, hx), pick(1, -hy, hy), pick(2, -RIM_DEPTH, hz));
                let clip = clip_from_world * Vector4::new(p.x, p.y, p.z, 1.0);
                assert!(
                    0.0 < clip.w && 0.0 < clip.z && clip.z < clip.w,
                    "between the near and the far plane"
                );
                reach.aside = reach.aside.max((clip.x / clip.w).abs());
                reach.up = reach.up.max(clip.y / clip.w);
                reach.down = reach.down.max(-clip.y / clip.w);
            }
        }
        reach
    }

    fn level(camera: &Camera, board: [f32; 3], aspect: f32) -> Self {
        Self::at_tilts(camera, board, aspect, std::iter::once(UnitQuaternion::identity()))
    }

    fn tilted(camera: &Camera, board: [f32; 3], aspect: f32, max_tilt_rad: f32) -> Self {
        // Odd counts, so that these are not the directions the fit itself looks at.
        let tilts = (0..91_u8).flat_map(|direction| {
            let azimuth_rad = std::f32::consts::TAU * f32::from(direction) / 91.0;
            let axis = Vector3::new(azimuth_rad.cos(), azimuth_rad.sin(), 0.0);
            [0.0, 0.37, 0.71, 1.0].map(|part| UnitQuaternion::from_scaled_axis(axis * (part * max_tilt_rad)))
        });
        Self::at_tilts(camera, board, aspect, tilts)
    }

    fn most(&self) -> f32 {
        self.up.max(self.down).max(self.aside)
    }

    /// How far above the screen's middle the board's is.
    fn above_middle(&self) -> f32 {
        0.5 * (self.up - self.down)
    }
}

fn cases() -> impl Iterator<Item = ([f32; 3], f32, f32)> {
    let of_board = |board| {
        ASPECTS
            .into_iter()
            .flat_map(move |aspect| MAX_TILTS_RAD.map(|max_tilt_rad| (board, aspect, max_tilt_rad)))
    };
    BOARDS.into_iter().flat_map(of_board)
}

/// The camera moved by a part of its distance, up the screen and away.
fn moved(camera: Camera, up: f32, away: f32) -> Camera {
    let target = Vector3::from(camera.target)
        + camera.world_from_view() * Vector3::new(0.0, up * camera.distance, 0.0);
    Camera { target: target.into(), distance: (1.0 + away) * camera.distance, pitch_rad: PITCH_RAD }
}

#[test]
fn the_fit_holds_every_board_and_is_tight_at_one_edge() {
    let [least, most] = FILLED;
    for (board, aspect, max_tilt_rad) in cases() {
        let looking_at_centre = Camera {
            target: [0.0; 3],
            distance: Camera::fitted_distance(board, aspect, max_tilt_rad),
            pitch_rad: PITCH_RAD,
        };
        for camera in [Camera::fitted(board, aspect, max_tilt_rad), looking_at_centre] {
            let reach = Reach::tilted(&camera, board, aspect, max_tilt_rad);
            assert!(
                (least..most).contains(&reach.most()),
                "{board:?} at {aspect}, {max_tilt_rad}: {reach:?}"
            );
        }
    }
}

#[test]
fn the_fit_steps_back_by_three_percent_at_most() {
    for (board, aspect, max_tilt_rad) in cases() {
        let fitted = Camera::fitted(board, aspect, max_tilt_rad);
        // 0.5 percent more than the step and the fit's own error together.
        let nearer = moved(fitted, 0.0, 1.0 / 1.038 - 1.0);
        for step in -20..=20_i8 {
            let camera = moved(nearer, 0.005 * f32::from(step), 0.0);
            let reach = Reach::tilted(&camera, board, aspect, max_tilt_rad);
            assert!(FILLED[1] < reach.most(), "{board:?} at {aspect}, {max_tilt_rad}: {step}");
        }
    }
}

#[test]
fn a_level_board_is_as_near_to_the_middle_as_the_tilted_one_allows() {
    let [least, most] = FILLED;
    for (board, aspect, max_tilt_rad) in cases() {
        let fitted = Camera::fitted(board, aspect, max_tilt_rad);
        let off = Reach::level(&fitted, board, aspect).above_middle();
        if off.abs() < 1e-3 {
            continue;
        }
        // Not in the middle: then all of the step back was taken, and the edge on the other side holds the tilted board.
        let reach = Reach::tilted(&fitted, board, aspect, max_tilt_rad);
        let holding = if off < 0.0 { reach.up } else { reach.down };
        assert!((least..most).contains(&holding), "{board:?} at {aspect}, {max_tilt_rad}: {off}, {reach:?}");
        let nearer = moved(fitted, 0.0, 1.0 / 1.02 - 1.0);
        let is_held_from_nearer = (-20..=20_i8).any(|step| {
            let camera = moved(nearer, 0.005 * f32::from(step), 0.0);
            Reach::tilted(&camera, board, aspect, max_tilt_rad).most() < most
        });
        assert!(is_held_from_nearer, "{board:?} at {aspect}, {max_tilt_rad}: no 2 of the 3 percent are used");
    }
}

#[test]
fn a_board_without_size_still_gives_a_usable_view() {
    let camera = Camera::fitted([0.0; 3], 1.0, 0.0);
    assert!(0.0 < camera.distance && camera.distance.is_finite());
}

#[test]
fn screen_right_is_world_x_and_screen_up_is_away() {
    let camera = Camera { target: [0.0; 3], distance: 10.0, pitch_rad: PITCH_RAD };
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
    let camera = Camera { target: [0.0; 3], distance: 2.0, pitch_rad: PITCH_RAD };
    let world_from_view = camera.world_from_view();
    let towards_eye = world_from_view * Vector3::z() * 2.0;
    assert!((towards_eye - camera.eye().coords).norm() < 1e-6);
    assert!((world_from_view * Vector3::x() - Vector3::x()).norm() < 1e-6);
    assert!((towards_eye.angle(&Vector3::z()) - PITCH_RAD).abs() < 1e-6);
    assert!(towards_eye.y < 0.0, "the eye is on the player's side");
}

#[test]
fn from_above_the_board_is_in_view_at_every_tilt_and_a_level_one_in_the_middle() {
    let half_size = [7.0, 4.5, 0.5];
    for width in [540_u16, 900, 1620] {
        let (aspect, size) = (f32::from(width) / 900.0, [u32::from(width), 900]);
        let camera = Camera::fitted_at(0.0, half_size, aspect, 0.35);
        assert!(
            (camera.eye().xy().coords - Vector3::from(camera.target).xy()).norm() < 1.0e-5,
            "straight above"
        );
        let [left, right] = [-7.0, 7.0].map(|x| camera.project(size, [x, 0.0, 0.0]).unwrap());
        let [near, far] = [-4.5, 4.5].map(|y| camera.project(size, [0.0, y, 0.0]).unwrap());
        assert!((left[0] + right[0] - f32::from(width)).abs() < 1.0);
        assert!((near[1] + far[1] - 900.0).abs() < 9.0, "{near:?} {far:?}");
        for azimuth in 0..16_u8 {
            let azimuth_rad = f32::from(azimuth) * 0.4;
            let axis = nalgebra::Unit::new_normalize(Vector3::new(azimuth_rad.cos(), azimuth_rad.sin(), 0.0));
            let tilt = nalgebra::UnitQuaternion::from_axis_angle(&axis, 0.35);
            for corner in [[7.0, 4.5], [-7.0, 4.5], [7.0, -4.5], [-7.0, -4.5]] {
                let world = tilt * Vector3::new(corner[0], corner[1], 0.5);
                let [x, y] = camera.project(size, world.into()).unwrap();
                assert!((0.0..=f32::from(width)).contains(&x) && (0.0..=900.0).contains(&y), "{x}, {y}");
            }
        }
    }
}
