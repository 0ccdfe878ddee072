//! From a file's units to maze units.

use crate::section::Section;
use nalgebra::Vector3;

/// A corridor this near to 1 unit is 1 unit: the rounding of a gap between two sums must not rescale a maze.
const UNIT_SCALE: f64 = 1.0e-9;

/// Moves the plan's middle to the origin and the floor to z = 0, and scales corridors to 1.
pub(crate) struct Frame {
    middle: [f64; 2],
    floor_z: f64,
    scale: f64,
}

impl Frame {
    /// `corridor` is the corridor's width in the file, greater than 0.
    pub(crate) fn new(section: &Section, floor_z: f64, corridor: f64) -> Self {
        let [low, high] = section.corners();
        let scale = if (corridor - 1.0).abs() < UNIT_SCALE { 1.0 } else { 1.0 / corridor };
        Self { middle: [0, 1].map(|axis| (low[axis] + high[axis]) / 2.0), floor_z, scale }
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

    pub(crate) fn point(&self, point: Vector3<f64>) -> Vector3<f64> {
        Vector3::new(self.x(point.x), self.y(point.y), (point.z - self.floor_z) * self.scale)
    }
}
