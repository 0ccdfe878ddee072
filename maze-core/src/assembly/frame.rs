//! From a file's units to maze units.

use crate::assembly::occupancy::Occupancy;
use nalgebra::Vector3;

/// A corridor this near to 1 unit is 1 unit: the rounding of a gap between two sums must not rescale a maze.
const UNIT_SCALE: f64 = 1.0e-9;

/// Walls higher than this (units) are drawn lower: seen from above, a corridor between higher ones hides its ball. The
/// physics knows no height.
const MAX_WALL_HEIGHT: f64 = 0.8;

/// Moves the plan's middle to the origin and the floor to z = 0, and scales corridors to 1.
pub(crate) struct Frame {
    middle: [f64; 2],
    floor_z: f64,
    scale: f64,
    z_scale: f64,
}

impl Frame {
    /// `corridor` is the corridor's width in the file, greater than 0; floor and wall tops are its z coordinates. `scale`
    /// is the user's, in maze units a unit of the file.
    pub(crate) fn new(
        plan: &Occupancy,
        [floor_z, top_z]: [f64; 2],
        corridor: f64,
        scale: Option<f64>,
    ) -> Self {
        let [low, high] = plan.corners();
        let own_scale = if (corridor - 1.0).abs() < UNIT_SCALE { 1.0 } else { 1.0 / corridor };
        let scale = scale.unwrap_or(own_scale);
        let height = (top_z - floor_z) * scale;
        let z_scale = if MAX_WALL_HEIGHT < height { MAX_WALL_HEIGHT / (top_z - floor_z) } else { scale };
        Self { middle: [0, 1].map(|axis| (low[axis] + high[axis]) / 2.0), floor_z, scale, z_scale }
    }

    /// Maze units in a file unit.
    pub(crate) fn scale(&self) -> f64 {
        self.scale
    }

    pub(crate) fn x(&self, x: f64) -> f64 {
        (x - self.middle[0]) * self.scale
    }

    pub(crate) fn y(&self, y: f64) -> f64 {
        (y - self.middle[1]) * self.scale
    }

    pub(crate) fn z(&self, z: f64) -> f64 {
        (z - self.floor_z) * self.z_scale
    }

    pub(crate) fn point(&self, point: Vector3<f64>) -> Vector3<f64> {
        Vector3::new(self.x(point.x), self.y(point.y), self.z(point.z))
    }
}
