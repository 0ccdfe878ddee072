//! A rectangle in the maze plane.

use nalgebra::Vector2;

/// An axis-aligned rectangle in the maze plane (units).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Lower left corner.
    pub low: Vector2<f64>,
    /// Upper right corner.
    pub high: Vector2<f64>,
}

impl Bounds {
    /// Width and depth.
    pub fn size(&self) -> Vector2<f64> {
        self.high - self.low
    }
}
