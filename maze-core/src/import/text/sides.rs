//! Cells with walls at their sides -> blocks.

use super::{MAX_BLOCKS, TextError};
use crate::layout::blocks::Blocks;

/// A rectangle of square cells with walls between them, row by row from the top.
#[derive(Clone, Debug)]
pub(super) struct Sides {
    pub(super) width: usize,
    pub(super) height: usize,
    upright: Vec<bool>, // [y * (width + 1) + x]: a wall at the left of cell x, or at the right of the last one
    level: Vec<bool>,   // [y * width + x]: a wall above cell y, or below the last one
}

impl Sides {
    /// No walls.
    ///
    /// # Errors
    /// Too many cells.
    pub(super) fn new(width: usize, height: usize) -> Result<Self, TextError> {
        let [n_x, n_y] = [width, height].map(|n| n.saturating_mul(2).saturating_add(1));
        if MAX_BLOCKS < n_x.saturating_mul(n_y) {
            return Err(TextError::TooManyCells { width, height });
        }
        let [upright, level] = [vec![false; (width + 1) * height], vec![false; width * (height + 1)]];
        Ok(Self { width, height, upright, level })
    }

    /// Draws a wall at the left of cell (x, y); at the right of the last one for `x == width`.
    pub(super) fn add_upright(&mut self, x: usize, y: usize) {
        self.upright[y * (self.width + 1) + x] = true;
    }

    /// Draws a wall above cell (x, y); below the last one for `y == height`.
    pub(super) fn add_level(&mut self, x: usize, y: usize) {
        self.level[y * self.width + x] = true;
    }

    /// The cell on the other side of a side of a cell, where no wall is between them; sides are north, east, south, west.
    pub(super) fn neighbour(&self, [x, y]: [usize; 2], side: usize) -> Option<[usize; 2]> {
        let upright = |x: usize| self.upright[y * (self.width + 1) + x];
        let level = |y: usize| self.level[y * self.width + x];
        match side {
            0 if 0 < y && !level(y) => Some([x, y - 1]),
            1 if x + 1 < self.width && !upright(x + 1) => Some([x + 1, y]),
            2 if y + 1 < self.height && !level(y + 1) => Some([x, y + 1]),
            3 if 0 < x && !upright(x) => Some([x - 1, y]),
            _ => None,
        }
    }

    /// Number of walls.
    pub(super) fn n_walls(&self) -> usize {
        self.upright.iter().chain(&self.level).filter(|wall| **wall).count()
    }

    /// The blocks of these walls, thin ones, with posts where a wall ends or passes; an end is a cell, or the middle of a square
    /// of four.
    pub(super) fn blocks(&self, ends: [Option<End>; 2]) -> Option<Blocks> {
        let [n_x, n_y] = [2 * self.width + 1, 2 * self.height + 1];
        let mut wall = vec![false; n_x * n_y];
        let row = |y: usize| n_y - 1 - y;
        for (index, _) in self.upright.iter().enumerate().filter(|(_, wall)| **wall) {
            let (x, y) = (index % (self.width + 1), index / (self.width + 1));
            for y in 2 * y..=2 * y + 2 {
                wall[row(y) * n_x + 2 * x] = true;
            }
        }
        for (index, _) in self.level.iter().enumerate().filter(|(_, wall)| **wall) {
            let (x, y) = (index % self.width, index / self.width);
            for x in 2 * x..=2 * x + 2 {
                wall[row(2 * y) * n_x + x] = true;
            }
        }
        let block = |end: End| {
            let [x, y] = end.cell;
            let middle = [2 * x + 2, row(2 * y + 2)];
            let is_free = end.is_square && wall[middle[1] * n_x + middle[0]..].first() == Some(&false);
            if is_free { middle } else { [2 * x + 1, row(2 * y + 1)] }
        };
        let ends = ends.map(|end| end.map(block));
        Blocks::new(n_x, n_y, wall, ends).map(Blocks::with_thin_walls)
    }
}

/// Where a maze begins or ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct End {
    /// x and y, from the upper left.
    pub(super) cell: [usize; 2],
    /// Whether it is the upper left one of four cells that are the end together, as in a micromouse maze.
    pub(super) is_square: bool,
}
