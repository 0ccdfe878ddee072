//! The sun, fixed in the world, and the view matrix along it.

use nalgebra::{Matrix4, Vector3};

/// Towards the sun, in the world: from the upper left of the screen, 52 degrees high. A wall 0.6 high throws a shadow
/// 0.47 long: half a corridor.
pub(crate) const SUN_IN_WORLD: [f32; 3] = [-0.50, 0.36, 0.80];

/// An upright box in the maze frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bounds {
    pub(crate) min: [f32; 3],
    pub(crate) max: [f32; 3],
}

impl Bounds {
    /// The smallest box around some points; a unit box when there are none.
    pub(crate) fn around(points: impl Iterator<Item = [f32; 3]>) -> Self {
        let none = Self { min: [f32::MAX; 3], max: [f32::MIN; 3] };
        let found = points.fold(none, |b, p| Self {
            min: std::array::from_fn(|i| b.min[i].min(p[i])),
            max: std::array::from_fn(|i| b.max[i].max(p[i])),
        });
        if found.min[0] <= found.max[0] { found } else { Self { min: [-0.5, -0.5, 0.0], max: [0.5; 3] } }
    }

    /// Longer side in x or y.
    pub(crate) fn extent(&self) -> f32 {
        (self.max[0] - self.min[0]).max(self.max[1] - self.min[1])
    }

    fn corners(&self) -> [Vector3<f32>; 8] {
        std::array::from_fn(|i| {
            let pick = |axis: usize| if i >> axis & 1 == 0 { self.min[axis] } else { self.max[axis] };
            Vector3::new(pick(0), pick(1), pick(2))
        })
    }
}

/// Orthographic view along the sun that holds `bounds`: x, y in -1 to 1, depth 0 next to the sun to 1.
///
/// Its x axis follows the maze's as far as the sun allows, so that a board wastes little of the map.
pub(crate) fn sun_clip_from_maze(sun_in_maze: &Vector3<f32>, bounds: &Bounds) -> Matrix4<f32> {
    let x_axis = Vector3::x() - sun_in_maze * sun_in_maze.x;
    let x_axis = x_axis.try_normalize(1e-3).unwrap_or_else(Vector3::y);
    let y_axis = sun_in_maze.cross(&x_axis);
    let axes = [x_axis, y_axis, -sun_in_maze];
    let mut clip = Matrix4::identity();
    for (row, axis) in axes.iter().enumerate() {
        let along = bounds.corners().map(|c| axis.dot(&c));
        let low = along.iter().copied().fold(f32::MAX, f32::min);
        let high = along.iter().copied().fold(f32::MIN, f32::max);
        let span = (high - low).max(1e-3);
        // The whole range to -1..1 in x and y, to 0.02..0.98 in depth.
        let (scale, offset) = if row < 2 {
            (2.0 / span, -(high + low) / span)
        } else {
            (0.96 / span, 0.02 - 0.96 * low / span)
        };
        clip.fixed_view_mut::<1, 3>(row, 0).copy_from(&(axis * scale).transpose());
        clip[(row, 3)] = offset;
    }
    clip
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sun_sees_the_whole_board() {
        let bounds = Bounds { min: [-3.0, -2.0, 0.0], max: [3.0, 2.0, 0.6] };
        let sun = Vector3::from(SUN_IN_WORLD).normalize();
        let clip_from_maze = sun_clip_from_maze(&sun, &bounds);
        for corner in bounds.corners() {
            let clip = clip_from_maze.transform_point(&corner.into());
            assert!(clip.x.abs() < 1.0 + 1e-4 && clip.y.abs() < 1.0 + 1e-4, "{clip}");
            assert!((0.0..=1.0).contains(&clip.z), "{clip}");
        }
        let (low, high) = (Vector3::zeros(), sun);
        assert!(
            clip_from_maze.transform_point(&high.into()).z < clip_from_maze.transform_point(&low.into()).z,
            "nearer to the sun is nearer in depth"
        );
    }
}
