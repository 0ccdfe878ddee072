//! The view: perspective, from above and a little from the south, so that the walls' near sides show.

use crate::mesh::RIM_DEPTH;
use nalgebra::{Matrix4, Perspective3, Point3, UnitQuaternion, Vector3, Vector4};

/// Vertical field of view. Narrow enough that far walls do not lean outwards much, wide enough to feel like depth.
pub const FIELD_OF_VIEW_RAD: f32 = 0.54;

/// Angle between the line of sight and straight down.
pub const PITCH_RAD: f32 = 0.36;

/// Near plane as a part of the distance. A fitted board at its steepest stays beyond 0.3.
const NEAR_PART: f32 = 0.05;

/// Far plane as a part of the distance. Reaches the top edge of the screen on a floor that leans away 45 degrees.
const FAR_PART: f32 = 12.0;

/// How much of the half screen a fitted board may fill: a border of 3 percent, and room for the tilts between samples.
const FIT_PART: f32 = 0.97;

/// Directions of tilt tried by the fit. The gap between two is 5 degrees: off by at most 0.1 percent of the board.
const N_FIT_DIRECTIONS: u16 = 72;

/// Angles of tilt tried for each direction, from level to the limit.
const N_FIT_ANGLES: u16 = 5;

/// Where the eye is. Field of view and pitch are fixed: [`FIELD_OF_VIEW_RAD`], [`PITCH_RAD`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// World point in the middle of the view.
    pub target: [f32; 3],
    /// From the eye to the target, greater than zero.
    pub distance: f32,
}

impl Camera {
    /// The nearest view that holds a whole board at every tilt up to the limit, centred on the screen.
    ///
    /// The board reaches `half_size[0]` to either side in x, `half_size[1]` in y, and from its rim, a plank
    /// below the floor, up to `half_size[2]`. `aspect` is width over height.
    pub fn fitted(half_size: [f32; 3], aspect: f32, max_tilt_rad: f32) -> Self {
        let fit = Fit::new(half_size, aspect, max_tilt_rad);
        let distance = fit.sides.max(0.5 * (fit.above + fit.below));
        let shift = 0.5 * (fit.above - fit.below) * half_view_y();
        let target = Self::world_from_view() * Vector3::new(0.0, shift, 0.0);
        Self { target: target.into(), distance: distance.max(f32::MIN_POSITIVE) }
    }

    /// Like [`Camera::fitted`], for a camera that looks at the board's centre: how far it has to stand.
    pub fn fitted_distance(half_size: [f32; 3], aspect: f32, max_tilt_rad: f32) -> f32 {
        let fit = Fit::new(half_size, aspect, max_tilt_rad);
        fit.sides.max(fit.above).max(fit.below).max(f32::MIN_POSITIVE)
    }

    /// Turns view axes (right, up, towards the eye) into the world; the arcball needs it.
    pub fn world_from_view() -> UnitQuaternion<f32> {
        UnitQuaternion::from_axis_angle(&Vector3::x_axis(), PITCH_RAD)
    }

    /// The eye, in the world.
    pub fn eye(&self) -> Point3<f32> {
        Point3::from(self.target) + Self::world_from_view() * Vector3::new(0.0, 0.0, self.distance)
    }

    /// World to clip space (x right, y up, depth 0 near to 1 far). `aspect` is width over height.
    pub fn clip_from_world(&self, aspect: f32) -> Matrix4<f32> {
        let view_from_world = Self::world_from_view().inverse().to_homogeneous()
            * Matrix4::new_translation(&-self.eye().coords);
        let near = NEAR_PART * self.distance;
        let far = FAR_PART * self.distance;
        let clip_from_view = Perspective3::new(aspect, FIELD_OF_VIEW_RAD, near, far).to_homogeneous();
        HALF_DEPTH * clip_from_view * view_from_world
    }

    /// Pixel (x right, y down, from the top left corner) that shows a world point; `None` behind the eye.
    pub fn project(&self, size: [u32; 2], world: [f32; 3]) -> Option<[f32; 2]> {
        let [width, height] = size.map(|n| n.max(1) as f32);
        let clip = self.clip_from_world(width / height) * Vector4::new(world[0], world[1], world[2], 1.0);
        (0.0 < clip.w)
            .then(|| [(0.5 + 0.5 * clip.x / clip.w) * width, (0.5 - 0.5 * clip.y / clip.w) * height])
    }
}

/// OpenGL's depth (-1 to 1, what nalgebra makes) to wgpu's (0 to 1).
const HALF_DEPTH: Matrix4<f32> = Matrix4::new(
    1.0, 0.0, 0.0, 0.0, //
    0.0, 1.0, 0.0, 0.0, //
    0.0, 0.0, 0.5, 0.5, //
    0.0, 0.0, 0.0, 1.0,
);

/// Half the height of the view at distance 1.
fn half_view_y() -> f32 {
    FIT_PART * (0.5 * FIELD_OF_VIEW_RAD).tan()
}

/// The distances that the three kinds of edges ask for, for a camera that looks at the origin.
///
/// A point at view coordinates (x, y, z) is inside when `|x| <= t_x (d - z)` and `|y - s| <= t_y (d - z)`, with the
/// half views `t` at distance 1, the distance `d` and the upward shift `s`. All three are linear in `d` and `s`.
struct Fit {
    sides: f32,
    above: f32,
    below: f32,
}

impl Fit {
    fn new(half_size: [f32; 3], aspect: f32, max_tilt_rad: f32) -> Self {
        let half_y = half_view_y();
        let half_x = half_y * aspect;
        let view_from_world = Camera::world_from_view().inverse();
        let mut fit = Self { sides: 0.0, above: f32::MIN, below: f32::MIN };
        for tilt in tilts(max_tilt_rad) {
            for corner in corners(half_size) {
                let p = view_from_world * (tilt * corner);
                fit.sides = fit.sides.max(p.x.abs() / half_x + p.z);
                fit.above = fit.above.max(p.y / half_y + p.z);
                fit.below = fit.below.max(-p.y / half_y + p.z);
            }
        }
        fit
    }
}

fn corners([x, y, z]: [f32; 3]) -> [Vector3<f32>; 8] {
    [[-x, -y], [x, -y], [-x, y], [x, y]]
        .map(|[x, y]| [Vector3::new(x, y, -RIM_DEPTH), Vector3::new(x, y, z)])
        .as_flattened()
        .try_into()
        .unwrap_or_default()
}

fn tilts(max_tilt_rad: f32) -> impl Iterator<Item = UnitQuaternion<f32>> {
    (0..N_FIT_DIRECTIONS).flat_map(move |direction| {
        let azimuth_rad = std::f32::consts::TAU * f32::from(direction) / f32::from(N_FIT_DIRECTIONS);
        let axis = Vector3::new(azimuth_rad.cos(), azimuth_rad.sin(), 0.0);
        (0..N_FIT_ANGLES).map(move |angle| {
            let part = f32::from(angle) / f32::from(N_FIT_ANGLES - 1);
            UnitQuaternion::from_scaled_axis(axis * (part * max_tilt_rad))
        })
    })
}
