//! SVG as mazegenerator.net writes it: walls as lines on a grid, openings in the outer wall, the solution as a polyline.

mod drawing;
mod grid;
mod numbers;

use crate::layout::{Layout, LayoutSizeError};

/// Why an SVG is no rectangular maze.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
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
    /// Areas.
    #[error("line {line}: <{element}>: expected walls drawn as lines, not as areas or copies")]
    Element {
        /// Counted from 1.
        line: usize,
        /// Its name.
        element: String,
    },
    /// No lines.
    #[error("no walls: expected <line> elements, as mazegenerator.net writes them")]
    NoWalls,
    /// What is drawn is the way and not the wall.
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
    /// The drawn solution goes another way than ours.
    #[error(
        "line {line}: the solution line is {n_cells} cells long, the shortest way between its ends {n_shortest}"
    )]
    SolutionLonger {
        /// Counted from 1.
        line: usize,
        /// Of the line.
        n_cells: usize,
        /// Of the shortest way.
        n_shortest: usize,
    },
}

/// What was found in an SVG.
#[derive(Clone, Debug, PartialEq)]
pub struct SvgMaze {
    /// Cells, walls and doors.
    pub layout: Layout,
    /// The cells (`y * width + x`) of the solution drawn in the file, which is a shortest way, from start to goal.
    pub solution: Option<Vec<usize>>,
    /// Width and height of a cell in the file's units.
    pub cell: [f64; 2],
    /// Upper left corner of the outer wall in the file's units.
    pub corner: [f64; 2],
}

/// The maze of an SVG. The cell's size and the corner are found from the lines; what else is in the file (title,
/// description, texts, a background, circles as marks) is not looked at.
///
/// # Errors
/// With the line where there is one, and by name for the other kinds of maze that the site makes.
pub fn read(bytes: &[u8]) -> Result<SvgMaze, SvgError> {
    grid::maze(&drawing::read(bytes)?)
}

#[cfg(test)]
mod tests;
