//! Layouts and blocks -> Maze.

use crate::assembly::assemble::{AssembleOptions, Given};
use crate::assembly::error::AssembleError;
use crate::assembly::extrude::{self, WALL_HEIGHT};
use crate::assembly::polygons::UpAxis;
use crate::layout::Layout;
use crate::layout::blocks::{Blocks, Lines};
use crate::maze::Maze;
use crate::navigation::ends::Endpoint;
use crate::physics::numbers::to_f64;
use nalgebra::Vector2;

/// Most rectangles that the lines along the blocks' edges may make: [`crate::MAX_GRID_CELLS`] as 1024 x 64 cells have 2050 x 130.
const MAX_PIECES: usize = 2050 * 130;

/// Most faces of walls, each as long as can be: [`crate::MAX_GRID_CELLS`] have 130 to 165 thousand, by the algorithm. A few bytes of a
/// picture can ask for any number of them, and it takes some 300 bytes each to find the paths between them.
const MAX_FACES: usize = 180_000;

/// Why blocks are no maze.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BlocksError {
    /// Too much detail.
    #[error("{n_x} x {n_y} distinct wall edges: expected at most {max} rectangles between them", max = MAX_PIECES)]
    TooFine {
        /// Columns that differ from the one before.
        n_x: usize,
        /// Rows that differ from the one before.
        n_y: usize,
    },
    /// Start or goal lies beyond the walls, or the ball does not fit there.
    #[error("the ball does not fit at the {end}: expected a free place between the walls")]
    NoRoomAt {
        /// Which of the two.
        end: Endpoint,
    },
    /// Too large.
    #[error("a maze of {n_faces} wall faces: expected at most {max}", max = MAX_FACES)]
    TooLarge {
        /// Sides and tops, each as long as can be.
        n_faces: usize,
    },
    /// The walls make no maze.
    #[error(transparent)]
    Assemble(#[from] AssembleError),
}

impl Layout {
    /// The maze of this layout. Its up axis is z whatever the options say.
    ///
    /// # Errors
    /// A ball that does not fit; a start or goal in a wall; a scale out of range.
    pub fn maze(&self, options: &AssembleOptions) -> Result<Maze, AssembleError> {
        let options = AssembleOptions { up_axis: Some(UpAxis::Z), ..*options };
        Maze::from_polygons(&extrude::extrude(self), &options)
    }
}

impl Blocks {
    /// Where the k-th column (axis 0) or row (axis 1) of blocks begins.
    fn line(&self, axis: usize, k: usize) -> f64 {
        match &self.lines {
            Lines::Even => to_f64(k),
            Lines::ThinWalls => extrude::line(k),
            Lines::At(lines) => lines[axis].get(k).copied().unwrap_or(0.0),
        }
    }

    /// The maze of these blocks. Its up axis is z whatever the options say.
    ///
    /// # Errors
    /// Too many blocks, blocks that make no maze, and ends where the ball does not fit.
    pub fn maze(&self, options: &AssembleOptions) -> Result<Maze, BlocksError> {
        let scale = {
            let maze = self.maze_of_height(WALL_HEIGHT, options)?;
            if maze.report.scale == 1.0 {
                return Ok(maze);
            }
            maze.report.scale
        };
        // Only now it is known how many blocks make a corridor; the first maze is gone before there is another one.
        self.maze_of_height(WALL_HEIGHT / scale, options)
    }

    fn maze_of_height(&self, height: f64, options: &AssembleOptions) -> Result<Maze, BlocksError> {
        let [xs, ys] = self.edges();
        let [n_x, n_y] = [xs.len(), ys.len()];
        if MAX_PIECES < n_x.saturating_mul(n_y) {
            return Err(BlocksError::TooFine { n_x, n_y });
        }
        let mesh = extrude::extrude_blocks(self, &xs, &ys, |axis, k| self.line(axis, k), height);
        if MAX_FACES < mesh.n_faces() {
            return Err(BlocksError::TooLarge { n_faces: mesh.n_faces() });
        }
        let point = |block: [usize; 2]| {
            let middle =
                |axis: usize| (self.line(axis, block[axis]) + self.line(axis, block[axis] + 1)) / 2.0;
            Vector2::new(middle(0), middle(1))
        };
        // Cells with thin walls are a corridor wide, also where they are a hall.
        let corridor = (self.lines == Lines::ThinWalls).then_some(extrude::CORRIDOR);
        let given = Given { ends: self.ends().map(|end| end.map(point)), corridor };
        let options = AssembleOptions { up_axis: Some(UpAxis::Z), ..*options };
        Maze::assembled(&mesh, &options, &given, &mut |_| ()).map_err(|error| match error {
            AssembleError::NoRoomNear { end } => BlocksError::NoRoomAt { end },
            error => error.into(),
        })
    }
}
