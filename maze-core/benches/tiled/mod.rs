//! A square maze of any size: one small maze laid side by side with itself, so that a ball meets the same walls in all sizes.

use maze_core::{Facing, Layout, Plane, extrude, layout};
use nalgebra::Vector2;

/// Cells along a side of the small maze.
pub(crate) const TILE: usize = 24;

const PITCH: f64 = extrude::CORRIDOR + extrude::WALL_THICKNESS;

/// The faces of the maze and where its cells are.
pub(crate) struct Tiled {
    pub(crate) faces: Vec<Plane>,
    /// Cells along a side.
    pub(crate) side: usize,
}

impl Tiled {
    /// The ground plan of a layout, without the way through a mesh that a million planes would take long for. 1, 3, 10 and
    /// 34 tiles along a side make about 10³, 10⁴, 10⁵ and 10⁶ planes.
    pub(crate) fn new(n_tiles: usize) -> Result<Self, layout::LayoutSizeError> {
        let tile = layout::recursive_backtracker(TILE, TILE, 2020)?;
        Ok(Self { faces: faces(&tile, n_tiles), side: n_tiles * TILE })
    }

    /// The middle of a cell, counted row by row; beyond the last row it begins anew.
    #[allow(clippy::cast_precision_loss, reason = "counts far below 2^53")]
    pub(crate) fn centre(&self, cell: usize) -> Vector2<f64> {
        let at = |index: usize| index as f64 * PITCH + extrude::WALL_THICKNESS + extrude::CORRIDOR / 2.0;
        Vector2::new(at(cell % self.side), at(cell / self.side % self.side))
    }
}

#[allow(clippy::cast_precision_loss, reason = "counts far below 2^53")]
fn line(k: usize) -> f64 {
    k.div_ceil(2) as f64 * extrude::WALL_THICKNESS + (k / 2) as f64 * extrude::CORRIDOR
}

fn faces(tile: &Layout, n_tiles: usize) -> Vec<Plane> {
    let n = 2 * TILE * n_tiles + 1;
    let is_wall = |i: usize, j: usize| match (i % 2, j % 2) {
        (1, 1) => false,
        (0, 1) => i == 0 || !tile.is_open_east((i / 2 - 1) % TILE, j / 2 % TILE),
        (1, 0) => j == 0 || !tile.is_open_north(i / 2 % TILE, (j / 2 - 1) % TILE),
        _ => true,
    };
    let mut faces = Vec::new();
    for across in 0..n {
        for step in 1..n {
            let [offset, start, end] = [step, across, across + 1].map(line);
            let mut push = |before, after, [minus, plus]: [Facing; 2]| match (before, after) {
                (true, false) => faces.push(Plane { facing: plus, offset, start, end }),
                (false, true) => faces.push(Plane { facing: minus, offset, start, end }),
                _ => {}
            };
            push(is_wall(step - 1, across), is_wall(step, across), [Facing::MinusX, Facing::PlusX]);
            push(is_wall(across, step - 1), is_wall(across, step), [Facing::MinusY, Facing::PlusY]);
        }
    }
    faces
}
