//! Pictures: dark is wall. Bytes in: brightness pixel by pixel, so that no decoder is needed here.

use crate::blocks::{Blocks, BlocksError};
use crate::{AssembleOptions, Maze};

/// A pixel darker than this is wall: half of the range, because drawn walls are near 0 and paper is near 255, and
/// smoothed edges and compression noise stay on their side.
const HALF: u8 = 128;

/// Most pixels of a picture.
pub const MAX_PIXELS: usize = 1 << 22;

/// Why a picture is no maze.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PictureError {
    /// Too many pixels, or none.
    #[error("{width} x {height} pixels: expected at least 1 and at most {max} in all", max = MAX_PIXELS)]
    Size {
        /// Pixels along x.
        width: usize,
        /// Pixels along y.
        height: usize,
    },
    /// No wall.
    #[error(
        "no pixel is darker than half: the darkest, at ({x}, {y}), has {darkest} of 255; expected dark walls on a light ground"
    )]
    NoWalls {
        /// From the left, counted from 0.
        x: usize,
        /// From the top, counted from 0.
        y: usize,
        /// Brightness.
        darkest: u8,
    },
    /// Walls of every shape and size.
    #[error(
        "walls of {n_x} x {n_y} distinct edges, pixel ({x}, {y}) the first that is smaller than its surroundings: expected \
         plain dark lines on a light ground, without noise or shading"
    )]
    TooFine {
        /// Of the pixel, from the left, counted from 0.
        x: usize,
        /// Of the pixel, from the top, counted from 0.
        y: usize,
        /// Distinct edges along x.
        n_x: usize,
        /// Distinct edges along y.
        n_y: usize,
    },
    /// The walls make no maze.
    #[error(transparent)]
    Blocks(#[from] BlocksError),
}

/// What was found in a picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Walls, one block a cell.
    pub blocks: Blocks,
    /// Pixels along the side of a cell: the largest that all edges of walls are multiples of.
    pub cell: usize,
    /// Pixels left of the walls.
    pub left: usize,
    /// Pixels above the walls.
    pub top: usize,
}

/// The blocks of a picture given as brightness, row by row from the top. Light margins around the walls are left out.
///
/// # Errors
/// A picture that is too large or has no dark pixel.
pub fn read(width: usize, height: usize, brightness: &[u8]) -> Result<Picture, PictureError> {
    let size = PictureError::Size { width, height };
    let fits =
        width.checked_mul(height).is_some_and(|n| n == brightness.len() && (1..=MAX_PIXELS).contains(&n));
    if !fits {
        return Err(size);
    }
    let is_dark = |x: usize, y: usize| brightness[y * width + x] < HALF;
    let wall_rows = brightness.chunks_exact(width).map(|row| row.iter().any(|pixel| *pixel < HALF));
    let Some([top, bottom]) = first_and_last(wall_rows) else {
        let (index, darkest) = brightness
            .iter()
            .enumerate()
            .min_by_key(|(_, pixel)| **pixel)
            .map_or((0, HALF), |(i, p)| (i, *p));
        return Err(PictureError::NoWalls { x: index % width, y: index / width, darkest });
    };
    let mut in_column = vec![false; width];
    for row in brightness.chunks_exact(width) {
        in_column.iter_mut().zip(row).for_each(|(any, pixel)| *any |= *pixel < HALF);
    }
    // There is a dark row, hence a dark column.
    let [left, right] = first_and_last(in_column.into_iter()).unwrap_or([0, width - 1]);
    let (n_x, n_y) = (right + 1 - left, bottom + 1 - top);
    let mut cell = gcd(n_x, n_y);
    for y in top..=bottom {
        for x in left..=right {
            if left < x && is_dark(x, y) != is_dark(x - 1, y) {
                cell = gcd(cell, x - left);
            }
            if top < y && is_dark(x, y) != is_dark(x, y - 1) {
                cell = gcd(cell, y - top);
            }
        }
        if cell == 1 {
            break;
        }
    }
    let [n_x, n_y] = [n_x / cell, n_y / cell];
    let block = |index: usize| is_dark(left + index % n_x * cell, bottom - index / n_x * cell);
    let blocks = Blocks::new(n_x, n_y, (0..n_x * n_y).map(block).collect(), [None; 2]).ok_or(size)?;
    Ok(Picture { blocks, cell, left, top })
}

impl Picture {
    /// The maze of this picture; its openings are start and goal.
    ///
    /// # Errors
    /// Walls that make no maze.
    pub fn maze(&self, options: &AssembleOptions) -> Result<Maze, PictureError> {
        self.blocks.maze(options).map_err(|error| match error {
            BlocksError::TooFine { .. } | BlocksError::TooLarge { .. } => {
                let [n_x, n_y] = self.blocks.edges().map(|edges| edges.len());
                let (x, y) = self.first_speck();
                PictureError::TooFine { x, y, n_x, n_y }
            }
            other => other.into(),
        })
    }

    /// The first block, from the top, whose neighbours left and right, or above and below, are both of the other kind.
    fn first_speck(&self) -> (usize, usize) {
        let (n_x, n_y) = (self.blocks.width(), self.blocks.height());
        let is_wall =
            |x: Option<usize>, y: Option<usize>| x.zip(y).is_some_and(|(x, y)| self.blocks.is_wall(x, y));
        let is_speck = |&(x, y): &(usize, usize)| {
            let wall = self.blocks.is_wall(x, y);
            let differs = |beside: [bool; 2]| beside == [!wall; 2];
            differs([is_wall(x.checked_sub(1), Some(y)), is_wall(Some(x + 1), Some(y))])
                || differs([is_wall(Some(x), y.checked_sub(1)), is_wall(Some(x), Some(y + 1))])
        };
        let from_top = (0..n_y).rev().flat_map(|y| (0..n_x).map(move |x| (x, y)));
        let (x, y) = from_top.into_iter().find(is_speck).unwrap_or((0, n_y - 1));
        (self.left + x * self.cell, self.top + (n_y - 1 - y) * self.cell)
    }
}

/// Index of the first and of the last that holds.
fn first_and_last(holds: impl Iterator<Item = bool>) -> Option<[usize; 2]> {
    let mut which = holds.enumerate().filter(|(_, holds)| *holds).map(|(index, _)| index);
    let first = which.next()?;
    Some([first, which.last().unwrap_or(first)])
}

/// Greatest common divisor (Euclid).
fn gcd(a: usize, b: usize) -> usize {
    let (mut a, mut b) = (a, b);
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::import::text;

    const WAY: &str = "# ####\n# #  #\n#   ##\n### ##\n";

    /// A text maze as a picture: `cell` pixels a character, a margin around it, and two tones.
    fn drawn(text: &str, cell: usize, margin: usize, [dark, light]: [u8; 2]) -> (usize, usize, Vec<u8>) {
        let lines: Vec<&[u8]> = text.lines().map(str::as_bytes).collect();
        let [width, height] = [lines[0].len(), lines.len()].map(|n| n * cell + 2 * margin);
        let pixel = |index: usize| {
            let [x, y] = [index % width, index / width].map(|at| at.checked_sub(margin).map(|at| at / cell));
            let block = y.and_then(|y| lines.get(y)).zip(x).and_then(|(line, x)| line.get(x));
            if block == Some(&b'#') { dark } else { light }
        };
        (width, height, (0..width * height).map(pixel).collect())
    }

    #[test]
    fn the_cell_is_found_and_the_maze_is_that_of_the_text() {
        let blocks = text::read(WAY.as_bytes(), &text::TextOptions::default()).unwrap().blocks;
        for (cell, margin) in [(1, 0), (1, 3), (2, 0), (5, 7), (16, 2)] {
            for tones in [[0, 255], [127, 128], [90, 200]] {
                let (width, height, pixels) = drawn(WAY, cell, margin, tones);
                let picture = read(width, height, &pixels).unwrap();
                assert_eq!((picture.cell, picture.left, picture.top), (cell, margin, margin));
                assert_eq!(picture.blocks, blocks);
            }
        }
        let (width, height, pixels) = drawn(WAY, 5, 7, [0, 255]);
        let options = AssembleOptions::default();
        let maze = read(width, height, &pixels).unwrap().maze(&options).unwrap();
        assert_eq!(maze.planes, blocks.maze(&options).unwrap().planes);
        assert!(maze.solvable && maze.openings.len() == 2);
    }

    #[test]
    fn thin_lines_with_wide_corridors_are_scaled() {
        // Lines of 2 pixels, corridors of 14, as an exported picture of 16 pixels a cell.
        let is_line = |at: usize| at % 16 < 2;
        let wall = |x: usize, y: usize| {
            let door = (y < 2 && (2..16).contains(&x)) || (48 <= y && (34..48).contains(&x));
            let inner = (1..3).any(|k| x / 16 == k && is_line(x) && (y < 32) == (k == 1));
            (!(2..48).contains(&x) || !(2..48).contains(&y) || inner) && !door
        };
        let pixels: Vec<u8> = (0..50 * 50).map(|i| if wall(i % 50, i / 50) { 0 } else { 255 }).collect();
        let maze = read(50, 50, &pixels).unwrap().maze(&AssembleOptions::default()).unwrap();
        assert!((maze.scale - 1.0 / 7.0).abs() < 1.0e-12, "{}", maze.scale);
        assert!(maze.solvable && maze.openings.len() == 2);
        assert!((maze.wall_height - crate::extrude::WALL_HEIGHT).abs() < 1.0e-9);
    }

    #[test]
    fn what_is_no_maze_is_told_with_the_pixel() {
        let message = |width, height, pixels: &[u8]| {
            let read = read(width, height, pixels);
            read.and_then(|picture| picture.maze(&AssembleOptions::default())).unwrap_err().to_string()
        };
        assert!(message(0, 0, &[]).starts_with("0 x 0 pixels: expected at least 1"));
        assert!(message(3, 2, &[0; 5]).starts_with("3 x 2 pixels"));
        assert!(message(usize::MAX, 2, &[0; 5]).contains("expected at least 1"));
        let mut light = [250; 6];
        light[4] = 200;
        assert!(
            message(3, 2, &light)
                .starts_with("no pixel is darker than half: the darkest, at (1, 1), has 200")
        );
        assert_eq!(message(3, 3, &[0; 9]), "no corridor: no two walls face each other across free space");
        let noise: Vec<u8> = (0..700 * 700_u32)
            .map(|i| if i.wrapping_mul(2_654_435_761) >> 31 == 0 { 0 } else { 255 })
            .collect();
        let error = message(700, 700, &noise);
        assert!(error.starts_with("walls of 701 x 701 distinct edges, pixel ("), "{error}");
    }
}
