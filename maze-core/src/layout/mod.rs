//! Grid mazes: cells, and which of them are joined.

pub(crate) mod blocks;
mod corridors;
mod door;
#[cfg(feature = "generate")]
mod generate;
mod metrics;
mod solution;
mod solve;

pub use corridors::CorridorGraph;
pub use door::{Door, NoSuchDoor, Side};
#[cfg(feature = "generate")]
pub use generate::{
    Algorithm, EllerRow, EllerRows, Recipe, RecipeError, UnknownAlgorithm, recursive_backtracker,
};
pub use metrics::Metrics;
pub use solve::{MOST_COUNTED, Solution};

use std::collections::BTreeSet;

/// Most cells of a layout along each side.
const MAX_SIDE: usize = 1024;

/// The cells to the right, to the left, above and below a cell of a grid, given as `y * width + x`.
pub(crate) fn neighbours(cell: usize, [width, height]: [usize; 2]) -> [Option<usize>; 4] {
    let (x, y) = (cell % width, cell / width);
    [
        (x + 1 < width).then(|| cell + 1),
        (0 < x).then(|| cell - 1),
        (y + 1 < height).then(|| cell + width),
        (0 < y).then(|| cell - width),
    ]
}

/// A rectangle of cells; each pair of neighbours is joined by a passage or parted by a wall.
///
/// ```
/// use maze_core::layout::{Door, Layout, Side};
/// use maze_core::AssembleOptions;
///
/// let mut hall = Layout::walled(2, 1)?; // two cells, walled in
/// hall.open_door(Door { side: Side::Left, index: 0 })?;
/// let maze = hall.maze(&AssembleOptions::default())?;
/// assert!(!maze.planes.is_empty());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Layout {
    width: usize,
    height: usize,
    east: Vec<bool>,  // [y * width + x]: a passage to the cell on the right
    north: Vec<bool>, // [y * width + x]: a passage to the cell above
    doors: BTreeSet<Door>,
}

/// A size that no layout has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a maze of {width}x{height} cells: expected at least 2 cells and at most {max} on a side", max = MAX_SIDE)]
pub struct LayoutSizeError {
    /// Cells along x.
    pub width: usize,
    /// Cells along y.
    pub height: usize,
}

impl Layout {
    /// All cells walled in.
    ///
    /// # Errors
    /// Fewer than two cells (there is no path) or more than 1024 x 1024.
    pub fn walled(width: usize, height: usize) -> Result<Self, LayoutSizeError> {
        let fits = width <= MAX_SIDE && height <= MAX_SIDE;
        match width.checked_mul(height) {
            Some(n_cells) if fits && 2 <= n_cells => {
                let [east, north] = [vec![false; n_cells], vec![false; n_cells]];
                Ok(Self { width, height, east, north, doors: BTreeSet::new() })
            }
            _ => Err(LayoutSizeError { width, height }),
        }
    }

    /// Cells along x.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Cells along y.
    pub fn height(&self) -> usize {
        self.height
    }

    /// Whether a passage leads from cell (x, y) to the one on its right; false at the border.
    pub fn is_open_east(&self, x: usize, y: usize) -> bool {
        x + 1 < self.width && self.east[y * self.width + x]
    }

    /// Whether a passage leads from cell (x, y) to the one above it; false at the border.
    pub fn is_open_north(&self, x: usize, y: usize) -> bool {
        y + 1 < self.height && self.north[y * self.width + x]
    }

    /// Number of passages.
    pub fn n_passages(&self) -> usize {
        self.east.iter().chain(&self.north).filter(|open| **open).count()
    }

    /// The cells that passages lead to from a cell, both given as `y * width + x`.
    pub(crate) fn open_neighbours(&self, cell: usize) -> impl Iterator<Item = usize> {
        let (x, y) = (cell % self.width, cell / self.width);
        let [right, left, above, below] = neighbours(cell, [self.width, self.height]);
        let open = [
            right.filter(|_| self.is_open_east(x, y)),
            left.filter(|_| self.is_open_east(x - 1, y)),
            above.filter(|_| self.is_open_north(x, y)),
            below.filter(|_| self.is_open_north(x, y - 1)),
        ];
        open.into_iter().flatten()
    }

    /// Whether a passage leads from one cell to a neighbour.
    fn is_joined(&self, a: usize, b: usize) -> bool {
        self.open_neighbours(a).any(|next| next == b)
    }

    /// Where the outer wall is open, each place once, in a fixed order.
    pub fn doors(&self) -> impl ExactSizeIterator<Item = Door> + '_ {
        self.doors.iter().copied()
    }

    /// Whether the outer wall is open there.
    pub fn has_door(&self, side: Side, index: usize) -> bool {
        self.doors.contains(&Door { side, index })
    }

    /// Opens the outer wall.
    ///
    /// # Errors
    /// No cell lies behind the door; nothing is opened.
    pub fn open_door(&mut self, door: Door) -> Result<(), NoSuchDoor> {
        if door.cell(self.width, self.height).is_none() {
            return Err(NoSuchDoor { door, width: self.width, height: self.height });
        }
        self.doors.insert(door);
        Ok(())
    }

    /// Opens the middle of the top and of the bottom side, where mazegenerator.net puts start and goal.
    #[must_use]
    pub fn with_doors_top_and_bottom(mut self) -> Self {
        self.doors.insert(Door { side: Side::Top, index: (self.width - 1) / 2 });
        self.doors.insert(Door { side: Side::Bottom, index: self.width / 2 });
        self
    }

    /// Joins two neighbours, given as indices `y * width + x`.
    pub(crate) fn join(&mut self, a: usize, b: usize) {
        let low = a.min(b);
        if a.abs_diff(b) == 1 && self.width != 1 {
            self.east[low] = true;
        } else {
            self.north[low] = true;
        }
    }
}
