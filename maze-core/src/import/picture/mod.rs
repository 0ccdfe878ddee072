//! Pictures: dark or light lines are walls. Bytes in: colours pixel by pixel, so that no decoder is needed here.

mod tones;

use crate::assembly::from_layout::BlocksError;
use crate::layout::blocks::Blocks;
use crate::{AssembleOptions, Maze};
use tones::Tones;

/// Which pixels are walls.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WallTone {
    /// Dark walls on a light ground.
    Dark,
    /// Light walls on a dark ground.
    Light,
}

/// Most pixels of a picture.
pub const MAX_PIXELS: usize = 1 << 22;

/// Why a picture is no maze.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
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
        "one tone alone: the darkest pixel, at ({x}, {y}), has {darkest} of 255; expected dark walls on a light ground"
    )]
    NoWalls {
        /// From the left, counted from 0.
        x: usize,
        /// From the top, counted from 0.
        y: usize,
        /// Brightness.
        darkest: u8,
    },
    /// Dark and light could change places.
    #[error(
        "the dark or the light pixels can be the walls: expected picture.wall to say which, dark or light"
    )]
    Ambiguous,
    /// The walls do not lie along the picture's sides.
    #[error(
        "the walls are turned by about {degrees} degrees: expected a picture whose walls lie along its sides (turn it before)"
    )]
    Turned {
        /// To the nearest degree.
        degrees: i32,
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
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Walls, one block a cell.
    pub blocks: Blocks,
    /// Pixels along the side of a cell: the largest that all edges of walls are multiples of.
    pub cell: usize,
    /// Pixels left of the walls.
    pub left: usize,
    /// Pixels above the walls.
    pub top: usize,
    /// Which pixels are walls.
    pub tone: WallTone,
    /// Pixels in colour that count as free.
    pub n_marked: usize,
}

/// The blocks of a picture given as red, green and blue, row by row from the top. Margins around the walls are left out. Colours
/// on a grey drawing are marks: free, and a green and a red spot are start and goal. `wall` says which pixels are walls, where
/// it is not to be found.
///
/// # Errors
/// A picture that is too large, has one tone alone, or turned walls.
///
/// ```
/// use maze_core::AssembleOptions;
/// use maze_core::import::picture;
///
/// let rows = ["# ####", "# #  #", "#   ##", "### ##"];
/// let rgb: Vec<[u8; 3]> = rows.concat().chars().map(|sign| if sign == '#' { [0; 3] } else { [255; 3] }).collect();
/// let maze = picture::read(6, 4, &rgb, None)?.maze(&AssembleOptions::default())?;
/// assert_eq!(maze.openings.len(), 2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn read(
    width: usize,
    height: usize,
    rgb: &[[u8; 3]],
    wall: Option<WallTone>,
) -> Result<Picture, PictureError> {
    let size = PictureError::Size { width, height };
    let fits = width.checked_mul(height).is_some_and(|n| n == rgb.len() && (1..=MAX_PIXELS).contains(&n));
    if !fits {
        return Err(size);
    }
    let Tones { wall, tone, spots, n_marked } = tones::read(width, height, rgb, wall)?;
    let Some([left, right, top, bottom]) = wall.bounds() else {
        return Err(PictureError::NoWalls { x: 0, y: 0, darkest: u8::MAX });
    };
    let (n_x, n_y) = (right + 1 - left, bottom + 1 - top);
    let mut cell = gcd(n_x, n_y);
    for y in top..=bottom {
        for x in left..=right {
            if left < x && wall.at(x, y) != wall.at(x - 1, y) {
                cell = gcd(cell, x - left);
            }
            if top < y && wall.at(x, y) != wall.at(x, y - 1) {
                cell = gcd(cell, y - top);
            }
        }
        if cell == 1 {
            break;
        }
    }
    let [n_x, n_y] = [n_x / cell, n_y / cell];
    let is_wall = |index: usize| wall.at(left + index % n_x * cell, bottom - index / n_x * cell);
    let walls: Vec<bool> = (0..n_x * n_y).map(is_wall).collect();
    let ends = spots.map(|spot| {
        let [x, y] = spot?;
        let block = [x.checked_sub(left)? / cell, bottom.checked_sub(y)? / cell];
        (block[0] < n_x && block[1] < n_y && !walls[block[1] * n_x + block[0]]).then_some(block)
    });
    let blocks = Blocks::new(n_x, n_y, walls, ends).ok_or(size)?;
    Ok(Picture { blocks, cell, left, top, tone, n_marked })
}

impl Picture {
    /// How the picture was read, in words.
    pub fn found(&self) -> String {
        let (n_x, n_y, cell) = (self.blocks.width(), self.blocks.height(), self.cell);
        let mut words = format!("{n_x} x {n_y} cells of {cell} x {cell} pixels");
        if self.tone == WallTone::Light {
            words += ", light walls on a dark ground";
        }
        if self.n_marked != 0 {
            words += &format!(", {} pixels in colour ignored", self.n_marked);
        }
        let spots = [("green", "start"), ("red", "goal")].into_iter().zip(self.blocks.ends());
        for ((colour, name), _) in spots.filter(|(_, end)| end.is_some()) {
            words += &format!(", {name} at the {colour} spot");
        }
        words
    }

    /// The maze of this picture; its openings are start and goal where no spots are.
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
    fn drawn(text: &str, cell: usize, margin: usize, [dark, light]: [u8; 2]) -> (usize, usize, Vec<[u8; 3]>) {
        let lines: Vec<&[u8]> = text.lines().map(str::as_bytes).collect();
        let [width, height] = [lines[0].len(), lines.len()].map(|n| n * cell + 2 * margin);
        let pixel = |index: usize| {
            let [x, y] = [index % width, index / width].map(|at| at.checked_sub(margin).map(|at| at / cell));
            let block = y.and_then(|y| lines.get(y)).zip(x).and_then(|(line, x)| line.get(x));
            [if block == Some(&b'#') { dark } else { light }; 3]
        };
        (width, height, (0..width * height).map(pixel).collect())
    }

    #[test]
    fn the_cell_is_found_and_the_maze_is_that_of_the_text() {
        let blocks = text::read(WAY.as_bytes(), &text::TextOptions::default()).unwrap().blocks;
        for (cell, margin) in [(1, 0), (1, 3), (2, 0), (5, 7), (16, 2)] {
            for tones in [[0, 255], [127, 128], [90, 200]] {
                let (width, height, pixels) = drawn(WAY, cell, margin, tones);
                let picture = read(width, height, &pixels, None).unwrap();
                assert_eq!((picture.cell, picture.left, picture.top), (cell, margin, margin));
                assert_eq!(picture.blocks, blocks);
            }
        }
        let (width, height, pixels) = drawn(WAY, 5, 7, [0, 255]);
        let options = AssembleOptions::default();
        let maze = read(width, height, &pixels, None).unwrap().maze(&options).unwrap();
        assert_eq!(maze.planes, blocks.maze(&options).unwrap().planes);
        assert!(maze.is_solvable() && maze.openings.len() == 2);
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
        let pixels: Vec<[u8; 3]> =
            (0..50 * 50).map(|i| [if wall(i % 50, i / 50) { 0 } else { 255 }; 3]).collect();
        let maze = read(50, 50, &pixels, None).unwrap().maze(&AssembleOptions::default()).unwrap();
        assert!((maze.report.scale - 1.0 / 7.0).abs() < 1.0e-12, "{}", maze.report.scale);
        assert!(maze.is_solvable() && maze.openings.len() == 2);
        assert!((maze.wall_height - crate::assembly::extrude::WALL_HEIGHT).abs() < 1.0e-9);
    }

    #[test]
    fn what_is_no_maze_is_told_with_the_pixel() {
        let message = |width, height, pixels: &[u8]| {
            let rgb: Vec<[u8; 3]> = pixels.iter().map(|pixel| [*pixel; 3]).collect();
            let read = read(width, height, &rgb, None);
            read.and_then(|picture| picture.maze(&AssembleOptions::default())).unwrap_err().to_string()
        };
        assert!(message(0, 0, &[]).starts_with("0 x 0 pixels: expected at least 1"));
        assert!(message(3, 2, &[0; 5]).starts_with("3 x 2 pixels"));
        assert!(message(usize::MAX, 2, &[0; 5]).contains("expected at least 1"));
        assert!(
            message(3, 2, &[240; 6]).starts_with("one tone alone: the darkest pixel, at (0, 0), has 240")
        );
        assert_eq!(message(3, 3, &[0; 9]), "no corridor: no two walls face each other across free space");
        let noise: Vec<u8> = (0..700 * 700_u32)
            .map(|i| {
                // Mixed twice: one multiplication leaves lines.
                let mixed = (i ^ (i >> 7)).wrapping_mul(2_654_435_761);
                if (mixed ^ (mixed >> 15)).wrapping_mul(2_246_822_519) >> 31 == 0 { 0 } else { 255 }
            })
            .collect();
        let error = message(700, 700, &noise);
        assert!(error.starts_with("walls of 701 x 701 distinct edges, pixel ("), "{error}");
    }
}
