//! SVG as mazegenerator.net writes it: walls as lines on a grid, openings in the outer wall, the solution as a polyline.

mod drawing;
mod grid;
mod numbers;
mod painted;
mod style;

use crate::assembly::assemble::AssembleOptions;
use crate::assembly::from_layout::BlocksError;
use crate::layout::blocks::Blocks;
use crate::layout::{Layout, LayoutSizeError};
use crate::maze::Maze;
use crate::physics::numbers::to_f64;
use drawing::Drawing;

/// Why an SVG is no rectangular maze.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SvgError {
    /// There is nothing.
    #[error("the file is empty: expected an SVG")]
    Empty,
    /// Not UTF-8.
    #[error("line {line}: not UTF-8 text: expected an SVG")]
    NotText {
        /// Counted from 1.
        line: usize,
    },
    /// The document declares its own entities.
    #[error("line {line}: declares an entity: expected an SVG without")]
    Entity {
        /// Counted from 1.
        line: usize,
    },
    /// Not XML.
    #[error("line {line}: not well-formed XML ({reason}): expected an SVG")]
    Xml {
        /// Counted from 1.
        line: usize,
        /// The parser's words.
        reason: String,
    },
    /// XML of another kind.
    #[error("line {line}: the root element is <{found}>: expected <svg>")]
    NotSvg {
        /// Counted from 1.
        line: usize,
        /// Its name.
        found: String,
    },
    /// An attribute that cannot be read.
    #[error("line {line}: {attribute}=\"{found}\" of <{element}>: expected {expected}")]
    Attribute {
        /// Counted from 1.
        line: usize,
        /// Of which element.
        element: String,
        /// Its name.
        attribute: &'static str,
        /// Its value, shortened.
        found: String,
        /// What it should be.
        expected: &'static str,
    },
    /// Arcs.
    #[error("line {line}: a circular (theta) maze, its walls are arcs: expected a rectangular maze")]
    Circular {
        /// Of the first arc, counted from 1.
        line: usize,
    },
    /// Curves.
    #[error("line {line}: a drawing of curves: expected a rectangular maze of straight walls")]
    Curved {
        /// Of the first curve, counted from 1.
        line: usize,
    },
    /// Lines along no axis.
    #[error(
        "line {line}: a maze of other cells than squares, such as hexagonal (sigma) or triangular (delta) ones: {n_slanted} of \
         {n_walls} walls are slanted; expected a rectangular maze"
    )]
    Slanted {
        /// Of the first such wall, counted from 1.
        line: usize,
        /// How many.
        n_slanted: usize,
        /// Of all.
        n_walls: usize,
    },
    /// More than a drawing has.
    #[error("line {line}: too many {what}: expected at most {most}")]
    TooMuch {
        /// Where it was too much, counted from 1.
        line: usize,
        /// Of what.
        what: &'static str,
        /// How many there may be.
        most: usize,
    },
    /// Pictures and the like.
    #[error("line {line}: <{element}>: expected walls drawn as lines or areas")]
    Element {
        /// Counted from 1.
        line: usize,
        /// Its name.
        element: String,
    },
    /// No lines.
    #[error("no walls: expected lines or areas that are painted and seen")]
    NoWalls,
    /// What is drawn is the path and not the wall.
    #[error(
        "draws the passages, not the walls (nothing is drawn along {n_open} of the {n_border} cells at the border): expected \
         walls, as mazegenerator.net writes them by default"
    )]
    Passages {
        /// Cells at the border without a wall.
        n_open: usize,
        /// Sides of cells at the border.
        n_border: usize,
    },
    /// Half of the outer wall is missing.
    #[error(
        "the outer wall is open at {n_open} of the {n_border} cells at the border: expected at most a quarter"
    )]
    OpenBorder {
        /// Cells at the border without a wall.
        n_open: usize,
        /// Sides of cells at the border.
        n_border: usize,
    },
    /// A coordinate that no grid has.
    #[error(
        "line {line}: ({x}, {y}) lies on no grid: the other walls have cells of {cell_x} x {cell_y} from ({left}, {top})"
    )]
    OffGrid {
        /// Counted from 1.
        line: usize,
        /// After all transforms.
        x: f64,
        /// After all transforms.
        y: f64,
        /// Width of a cell.
        cell_x: f64,
        /// Height of a cell.
        cell_y: f64,
        /// Of the grid.
        left: f64,
        /// Of the grid.
        top: f64,
    },
    /// Too many edges.
    #[error("{n_x} x {n_y} distinct edges of walls: expected plain walls")]
    TooFine {
        /// Along x.
        n_x: usize,
        /// Along y.
        n_y: usize,
    },
    /// No grid at all.
    #[error("line {line}: the walls lie on no grid of equal cells: expected a rectangular maze")]
    NoGrid {
        /// Of the first wall, counted from 1.
        line: usize,
    },
    /// Too many or too few cells.
    #[error(transparent)]
    Size(#[from] LayoutSizeError),
    /// The drawn solution is none.
    #[error("line {line}: the solution line goes through a wall at ({x}, {y})")]
    SolutionThroughWall {
        /// Counted from 1.
        line: usize,
        /// After all transforms.
        x: f64,
        /// After all transforms.
        y: f64,
    },
    /// The drawn solution is another path than ours.
    #[error(
        "line {line}: the solution line is {n_cells} cells long, the shortest path between its ends {n_shortest}"
    )]
    SolutionLonger {
        /// Counted from 1.
        line: usize,
        /// Of the line.
        n_cells: usize,
        /// Of the shortest path.
        n_shortest: usize,
    },
}

/// What was found in an SVG.
#[derive(Clone, Debug, PartialEq)]
pub struct SvgMaze {
    /// Cells, walls and doors.
    pub layout: Layout,
    /// The cells (`y * width + x`) of the solution drawn in the file, which is a shortest path, from start to goal.
    pub solution: Option<Vec<usize>>,
    /// Width and height of a cell in the file's units.
    pub cell: [f64; 2],
    /// Upper left corner of the outer wall in the file's units.
    pub corner: [f64; 2],
    /// Dots at corners of cells, at which no wall need end: blocks of [`Blocks::of_layout`] as x and y.
    pub posts: Vec<[usize; 2]>,
    /// Start and goal, where a green and a red mark lie: blocks as x and y.
    pub ends: [Option<[usize; 2]>; 2],
}

impl SvgMaze {
    /// The block of the cell at a point of the file.
    fn block_at(&self, point: [f64; 2]) -> Option<[usize; 2]> {
        let size = [self.layout.width(), self.layout.height()];
        let cell = |axis: usize| {
            let position = (point[axis] - self.corner[axis]) / self.cell[axis];
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "0 to the number of cells"
            )]
            (0.0 <= position && position < to_f64(size[axis])).then_some(position as usize)
        };
        Some([2 * cell(0)? + 1, 2 * (size[1] - 1 - cell(1)?) + 1])
    }
}

/// The maze of an SVG of equal cells with lines between them. The cell's size and the corner are found from the lines; what
/// else is in the file (title, description, texts, a background, areas and dots as marks) is not read.
///
/// # Errors
/// With the line where there is one, and by name for the other kinds of maze that mazegenerator.net makes.
pub fn read_cells(bytes: &[u8]) -> Result<SvgMaze, SvgError> {
    cells(&drawing::read(bytes)?)
}

fn cells(drawing: &Drawing) -> Result<SvgMaze, SvgError> {
    grid::maze(&drawing.chains()?)
}

/// What an SVG is.
#[derive(Clone, Debug)]
pub enum SvgPlan {
    /// Equal cells with lines between them.
    Cells(SvgMaze),
    /// Walls of whatever thickness, as they are painted.
    Painted {
        /// The walls.
        blocks: Blocks,
        /// How they were read, in words.
        found: String,
    },
}

/// The maze of any SVG: lines between equal cells, else walls as they are painted.
///
/// # Errors
/// With the line where there is one.
///
/// ```
/// use maze_core::layout::{Algorithm, Recipe};
/// use maze_core::{AssembleOptions, export, import};
///
/// let layout = Recipe::new(6, 4, Algorithm::Prim, 1).layout()?.with_doors_top_and_bottom();
/// let svg = export::svg::write(&layout, None, "a maze");
/// let plan = import::svg::read(svg.as_bytes())?;
/// assert_eq!(plan.maze(&AssembleOptions::default())?.planes, layout.maze(&AssembleOptions::default())?.planes);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn read(bytes: &[u8]) -> Result<SvgPlan, SvgError> {
    let drawing = drawing::read(bytes)?;
    let painted = || {
        let painted = painted::walls(&drawing)?;
        Ok(SvgPlan::Painted { blocks: painted.blocks, found: painted.words })
    };
    if drawing.has_areas() {
        return painted();
    }
    match cells(&drawing) {
        Ok(mut maze) => {
            maze.ends = painted::spots(&drawing).map(|spot| spot.and_then(|point| maze.block_at(point)));
            Ok(SvgPlan::Cells(maze))
        }
        Err(
            error @ (SvgError::OffGrid { .. }
            | SvgError::NoGrid { .. }
            | SvgError::NoWalls
            | SvgError::OpenBorder { .. }
            | SvgError::Slanted { .. }
            | SvgError::SolutionThroughWall { .. }
            | SvgError::SolutionLonger { .. }),
        ) => painted().map_err(|_: SvgError| error),
        Err(error) => Err(error),
    }
}

impl SvgPlan {
    /// The maze in maze units.
    ///
    /// # Errors
    /// Walls that make no maze.
    pub fn maze(&self, options: &AssembleOptions) -> Result<Maze, BlocksError> {
        match self {
            Self::Cells(cells) => {
                let blocks = Blocks::of_layout(&cells.layout).without_lonely_posts(&cells.posts);
                blocks.with_ends(cells.ends).maze(options)
            }
            Self::Painted { blocks, .. } => blocks.maze(options),
        }
    }

    /// How it was read, in words.
    pub fn found(&self) -> String {
        match self {
            Self::Cells(SvgMaze { layout, cell: [cell_x, cell_y], solution, ends, .. }) => {
                let mut found =
                    format!("{} x {} cells of {cell_x} x {cell_y}", layout.width(), layout.height());
                if let Some(path) = solution {
                    found +=
                        &format!("; the solution drawn in it, {} cells long, is a shortest path", path.len());
                }
                found + &painted::spot_words(*ends)
            }
            Self::Painted { found, .. } => found.clone(),
        }
    }
}

#[cfg(test)]
mod tests;
