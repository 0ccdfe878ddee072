//! The view: perspective, from above and a little from the south, so that the walls' near sides show.

use crate::mesh::RIM_DEPTH;
use nalgebra::{Matrix4, Perspective3, Point3, UnitQuaternion, Vector2, Vector3, Vector4};
use std::f32::consts::{FRAC_PI_2, PI};

/// Vertical field of view. Narrow enough that far walls do not lean outwards much, wide enough to feel like depth.
pub const FIELD_OF_VIEW_RAD: f32 = 0.54;

/// Angle between the line of sight and straight down.
pub const PITCH_RAD: f32 = 0.36;

/// Near plane as a fraction of the distance. A fitted board at its steepest stays beyond 0.3.
const NEAR_FRACTION: f32 = 0.05;

/// Far plane as a fraction of the distance. Reaches the top edge of the screen on a floor that leans away 45 degrees.
const FAR_FRACTION: f32 = 12.0;

/// How much of the half screen a fitted board may fill: leaves a border of 3 percent.
const FIT_FRACTION: f32 = 0.97;

/// How much farther away than needed a fitted view may be for the sake of a level board in the middle.
const MAX_STEP_BACK: f32 = 0.03;

/// Rounds in which distance and middle settle. Each leaves a tenth of the error, at most: 1e-4 of the board.
const N_FIT_ROUNDS: u16 = 4;

/// Axes tried by the fit over half a turn, 11 degrees apart. The bound in [`Edge::farthest`] for what lies between two
/// then adds 0.3 percent of the distance at a limit of 35 degrees.
const N_FIT_AXES: u16 = 16;

/// Where the eye is. The field of view is fixed: [`FIELD_OF_VIEW_RAD`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// World point in the middle of the view.
    pub target: [f32; 3],
    /// From the eye to the target, greater than zero.
    pub distance: f32,
    /// Between the line of sight and straight down: [`PITCH_RAD`], or 0 from above.
    pub pitch_rad: f32,
}

impl Camera {
    /// A view that holds a whole board at every tilt up to the limit, with the level board near the middle.
    ///
    /// A tilted board reaches farther up the screen where its far side comes up than down where the near side does, so
    /// the level board would stand low in the nearest such view. This one steps back, by 3 percent at most, and
    /// moves the level board's middle as near to the screen's as the tilted one allows.
    ///
    /// The board reaches `half_size[0]` to either side in x, `half_size[1]` in y, and from its rim, a plank
    /// below the floor, up to `half_size[2]`. `aspect` is width over height. A limit above a quarter turn counts as one.
    /// Takes some microseconds.
    pub fn fitted(half_size: [f32; 3], aspect: f32, max_tilt_rad: f32) -> Self {
        Self::fitted_at(PITCH_RAD, half_size, aspect, max_tilt_rad)
    }

    /// The same at another pitch.
    pub fn fitted_at(pitch_rad: f32, half_size: [f32; 3], aspect: f32, max_tilt_rad: f32) -> Self {
        let fit = Fit::new(pitch_rad, half_size, aspect, max_tilt_rad);
        let nearest = fit.sides.max(0.5 * (fit.above + fit.below)).max(f32::MIN_POSITIVE);
        let half_y = half_view_y();
        let mut distance = nearest;
        for _ in 0..N_FIT_ROUNDS {
            let wanted = level_middle(pitch_rad, half_size, distance) / half_y;
            let needed = (fit.above - wanted).max(fit.below + wanted);
            distance = needed.min((1.0 + MAX_STEP_BACK) * nearest).max(nearest);
        }
        let wanted = level_middle(pitch_rad, half_size, distance) / half_y;
        let shift = half_y * wanted.max(fit.above - distance).min(distance - fit.below);
        let target = world_from_view(pitch_rad) * Vector3::new(0.0, shift, 0.0);
        Self { target: target.into(), distance, pitch_rad }
    }

    /// How far a camera that looks at the board's centre has to stand; otherwise like [`Camera::fitted`].
    pub fn fitted_distance(half_size: [f32; 3], aspect: f32, max_tilt_rad: f32) -> f32 {
        let fit = Fit::new(PITCH_RAD, half_size, aspect, max_tilt_rad);
        fit.sides.max(fit.above).max(fit.below).max(f32::MIN_POSITIVE)
    }

    /// Turns view axes (right, up, towards the eye) into the world; the arcball needs it.
    pub fn world_from_view(&self) -> UnitQuaternion<f32> {
        world_from_view(self.pitch_rad)
    }

    /// The eye, in the world.
    pub fn eye(&self) -> Point3<f32> {
        Point3::from(self.target) + self.world_from_view() * Vector3::new(0.0, 0.0, self.distance)
    }

    /// World to clip space (x right, y up, depth 0 near to 1 far). `aspect` is width over height.
    pub fn clip_from_world(&self, aspect: f32) -> Matrix4<f32> {
        let view_from_world =
            self.world_from_view().inverse().to_homogeneous() * Matrix4::new_translation(&-self.eye().coords);
        let near = NEAR_FRACTION * self.distance;
        let far = FAR_FRACTION * self.distance;
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
    FIT_FRACTION * (0.5 * FIELD_OF_VIEW_RAD).tan()
}

fn world_from_view(pitch_rad: f32) -> UnitQuaternion<f32> {
    UnitQuaternion::from_axis_angle(&Vector3::x_axis(), pitch_rad)
}

/// The distances that the three kinds of edges ask for, for a camera that looks at the origin.
///
/// A point at view coordinates (x, y, z) is inside when `|x| <= t_x (d - z)` and `|y - s| <= t_y (d - z)`, with the
/// half views `t` at distance 1, the distance `d` and the upward shift `s`. All three are linear in `d` and `s`: with a
/// shift, the upper edge needs `above <= d + s / t_y` and the lower one `below <= d - s / t_y`.
struct Fit {
    sides: f32,
    above: f32,
    below: f32,
}

impl Fit {
    fn new(pitch_rad: f32, half_size: [f32; 3], aspect: f32, max_tilt_rad: f32) -> Self {
        let half_y = half_view_y();
        let max_tilt_rad = max_tilt_rad.clamp(0.0, FRAC_PI_2);
        let corners = corners(half_size);
        let distance = |x: f32, y: f32| {
            let edge = Edge::new(world_from_view(pitch_rad) * Vector3::new(x, y, 1.0), max_tilt_rad);
            corners.iter().map(|corner| edge.farthest(corner)).fold(f32::MIN, f32::max)
        };
        // Board and tilts are the same mirrored in x: what holds on the right holds on the left.
        Self {
            sides: distance(1.0 / (half_y * aspect), 0.0),
            above: distance(0.0, 1.0 / half_y),
            below: distance(0.0, -1.0 / half_y),
        }
    }
}

/// An edge of the screen, as the direction (not of unit length) along which the distance that a point asks for grows.
struct Edge {
    out: Vector3<f32>,
    sin: f32,
    cos: f32,
    /// Unit vectors in x and y.
    axes: [Vector2<f32>; N_FIT_AXES as usize],
}

impl Edge {
    fn new(out: Vector3<f32>, max_tilt_rad: f32) -> Self {
        let mut axes = [Vector2::x(); N_FIT_AXES as usize];
        for (i, axis) in (0..N_FIT_AXES).zip(&mut axes) {
            let azimuth_rad = PI * f32::from(i) / f32::from(N_FIT_AXES);
            *axis = Vector2::new(azimuth_rad.cos(), azimuth_rad.sin());
        }
        Self { out, sin: max_tilt_rad.sin(), cos: max_tilt_rad.cos(), axes }
    }

    /// The most that `out . R corner` reaches over all tilts `R`: turns by up to the limit, either way, about axes `a`
    /// in the board's plane. Never too little; a little too much, see [`N_FIT_AXES`].
    ///
    /// By Rodrigues' formula it is `e + (out . corner - e) cos t + a . (corner x out) sin t`, `e = (a . corner)(a . out)`,
    /// whose highest point in `t` has a closed form. Along the axes' azimuth no curve of it bends down more than
    /// `bend`, so one that lies half a gap away from its top at most misses `bend (gap / 2)² / 2`.
    fn farthest(&self, corner: &Vector3<f32>) -> f32 {
        let (out, plane) = (self.out.xy(), corner.xy());
        let across = corner.cross(&self.out).xy();
        let level = corner.dot(&self.out);
        let most = self.axes.iter().map(|axis| {
            let along = axis.dot(&plane) * axis.dot(&out);
            let (cos_part, sin_part) = (level - along, axis.dot(&across).abs());
            let is_top_in_reach = 0.0 <= cos_part && sin_part * self.cos <= cos_part * self.sin;
            along
                + if is_top_in_reach {
                    (cos_part * cos_part + sin_part * sin_part).sqrt()
                } else {
                    cos_part * self.cos + sin_part * self.sin
                }
        });
        let bend = self.sin * across.norm() + 2.0 * (1.0 - self.cos) * plane.norm() * out.norm();
        let half_gap = 0.5 * PI / f32::from(N_FIT_AXES);
        most.fold(f32::MIN, f32::max) + 0.5 * bend * half_gap * half_gap
    }
}

/// How far above the origin (view y) a camera at this distance has to look for a level board to be in the middle of the
/// screen: with as much room above as below.
///
/// Points (y, z) and (y', z') are equally far from the middle, on either side, when the camera is shifted by `s` with
/// `(y - s) / (d - z) = (s - y') / (d - z')`. The upper one of many is the one that asks for most, the lower one
/// the one that then asks for least.
fn level_middle(pitch_rad: f32, half_size: [f32; 3], distance: f32) -> f32 {
    let view_from_world = world_from_view(pitch_rad).inverse();
    // Seen from the side: x makes no difference to y and z.
    let points = corners(half_size).map(|corner| view_from_world * corner);
    let points = &points[..4];
    let between = |upper: &Vector3<f32>, lower: &Vector3<f32>| {
        let (to_upper, to_lower) = (distance - upper.z, distance - lower.z);
        (upper.y * to_lower + lower.y * to_upper) / (to_upper + to_lower)
    };
    let above = |lower| points.iter().map(|upper| between(upper, lower)).fold(f32::MIN, f32::max);
    points.iter().map(above).fold(f32::MAX, f32::min)
}

/// All eight; the first four have the same x.
fn corners([x, y, z]: [f32; 3]) -> [Vector3<f32>; 8] {
    std::array::from_fn(|i| {
        let pick = |bit: u8, low: f32, high: f32| if i >> bit & 1 == 0 { low } else { high };
        Vector3::new(pick(2, -x, x), pick(1, -y, y), pick(0, -RIM_DEPTH, z))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_farthest_tilt_is_a_close_bound_of_every_tilt() {
        for max_tilt_rad in [0.0, 0.1, 0.35, 0.6, FRAC_PI_2] {
            for out in [[3.7, 0.4, 0.9], [0.0, 3.0, 2.0], [0.0, -3.7, 0.1], [0.0, 0.0, 1.0]] {
                let edge = Edge::new(Vector3::from(out), max_tilt_rad);
                for corner in corners([5.0, 3.0, 0.6]) {
                    let mut tried = f32::MIN;
                    for direction in 0..720_u16 {
                        let azimuth_rad = 2.0 * PI * f32::from(direction) / 720.0;
                        let axis = Vector3::new(azimuth_rad.cos(), azimuth_rad.sin(), 0.0);
                        for part in 0..=60_u16 {
                            let tilt = axis * (max_tilt_rad * f32::from(part) / 60.0);
                            tried =
                                tried.max(edge.out.dot(&(UnitQuaternion::from_scaled_axis(tilt) * corner)));
                        }
                    }
                    let bound = edge.farthest(&corner);
                    // In units of the most that the product could be.
                    let unit = edge.out.norm() * corner.norm();
                    let excess = (bound - tried) / unit;
                    // Half a gap of 5.6 degrees, squared and halved; the trial's own gaps miss up to 1e-4.
                    let allowed = 0.00482 * (edge.sin + 2.0 * (1.0 - edge.cos)) + 1e-4;
                    assert!((-1e-5..allowed).contains(&excess), "{max_tilt_rad} {out:?}: {excess}");
                }
            }
        }
    }
}
