//! Mazes of square blocks, each wall or free: text and pictures, and the grid behind a [`Layout`].

use crate::layout::{Layout, Side};
use std::collections::BTreeSet;

/// Most cells of a generated maze that a text, an SVG, a picture or a recording may ask for, such as 256 x 256: a few bytes are
/// enough to ask, and 64 MiB are enough to answer.
pub const MAX_GRID_CELLS: usize = 1 << 16;

/// Where columns and rows of blocks begin.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Lines {
    /// At whole numbers.
    Even,
    /// Even columns and rows are walls and posts, as thin as those of a layout.
    ThinWalls,
    /// There.
    At(Box<[Vec<f64>; 2]>),
}

/// A rectangle of blocks. Row 0 is the lowest.
#[derive(Clone, Debug, PartialEq)]
pub struct Blocks {
    width: usize,
    height: usize,
    wall: Vec<bool>,               // [y * width + x]
    ends: [Option<[usize; 2]>; 2], // free blocks: start and goal
    pub(crate) lines: Lines,
}

impl Blocks {
    /// Blocks row by row from the lowest; `ends` are start and goal as (x, y), both free, where they are known.
    ///
    /// `None` unless there are `width * height` of them, and the ends lie on free ones.
    pub(crate) fn new(
        width: usize,
        height: usize,
        wall: Vec<bool>,
        ends: [Option<[usize; 2]>; 2],
    ) -> Option<Self> {
        let is_free = |[x, y]: &[usize; 2]| *x < width && *y < height && !wall[y * width + x];
        let fits = width.checked_mul(height) == Some(wall.len());
        let fits = fits && ends.iter().flatten().all(is_free);
        fits.then_some(Self { width, height, wall, ends, lines: Lines::Even })
    }

    /// The same blocks, of which those in even columns and rows are as thin as the walls of a [`Layout`].
    pub(crate) fn with_thin_walls(self) -> Self {
        Self { lines: Lines::ThinWalls, ..self }
    }

    /// The same blocks with start and goal; one that is a wall is left out.
    pub(crate) fn with_ends(self, ends: [Option<[usize; 2]>; 2]) -> Self {
        let ends =
            ends.map(|end| end.filter(|[x, y]| *x < self.width && *y < self.height && !self.is_wall(*x, *y)));
        Self { ends, ..self }
    }

    /// The same blocks, between these coordinates along x and y, which ascend and are one more than the blocks.
    pub(crate) fn with_lines(self, lines: [Vec<f64>; 2]) -> Self {
        debug_assert_eq!([self.width + 1, self.height + 1], [lines[0].len(), lines[1].len()]);
        Self { lines: Lines::At(Box::new(lines)), ..self }
    }

    /// Whether a block between walls has walls at none of its sides.
    pub(crate) fn is_lonely_post(&self, x: usize, y: usize) -> bool {
        let beside = [
            0 < x && self.is_wall(x - 1, y),
            self.is_wall(x + 1, y),
            0 < y && self.is_wall(x, y - 1),
            self.is_wall(x, y + 1),
        ];
        beside == [false; 4]
    }

    /// The same blocks without those posts at which no wall ends, but for these, given as x and y.
    pub(crate) fn without_lonely_posts(mut self, kept: &[[usize; 2]]) -> Self {
        let kept: BTreeSet<[usize; 2]> = kept.iter().copied().collect();
        for (x, y) in
            (0..self.height).step_by(2).flat_map(|y| (0..self.width).step_by(2).map(move |x| (x, y)))
        {
            if self.is_lonely_post(x, y) && !kept.contains(&[x, y]) {
                self.wall[y * self.width + x] = false;
            }
        }
        self
    }

    /// Posts, walls and corridors of a layout in turn, `2 n + 1` blocks along each axis; its doors are gaps.
    pub fn of_layout(layout: &Layout) -> Self {
        let [width, height] = [2 * layout.width() + 1, 2 * layout.height() + 1];
        let is_wall = |i: usize, j: usize| match (i % 2, j % 2) {
            (1, 1) => false,
            (0, 1) if i == 0 => !layout.has_door(Side::Left, j / 2),
            (0, 1) if i + 1 == width => !layout.has_door(Side::Right, j / 2),
            (0, 1) => !layout.is_open_east(i / 2 - 1, j / 2),
            (1, 0) if j == 0 => !layout.has_door(Side::Bottom, i / 2),
            (1, 0) if j + 1 == height => !layout.has_door(Side::Top, i / 2),
            (1, 0) => !layout.is_open_north(i / 2, j / 2 - 1),
            _ => true,
        };
        let wall = (0..width * height).map(|index| is_wall(index % width, index / width)).collect();
        Self { width, height, wall, ends: [None; 2], lines: Lines::ThinWalls }
    }

    /// Blocks along x.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Blocks along y.
    pub fn height(&self) -> usize {
        self.height
    }

    /// Whether block (x, y) is wall; false beyond the border.
    pub fn is_wall(&self, x: usize, y: usize) -> bool {
        x < self.width && y < self.height && self.wall[y * self.width + x]
    }

    /// Start and goal as (x, y), where they are given.
    pub fn ends(&self) -> [Option<[usize; 2]>; 2] {
        self.ends
    }

    /// The coordinates along x and y at which blocks differ from their neighbours, ascending; nothing when there is no wall.
    pub(crate) fn edges(&self) -> [Vec<usize>; 2] {
        let columns = |x: usize| (0..self.height).map(move |y| self.is_wall(x, y));
        let rows = |y: usize| (0..self.width).map(move |x| self.is_wall(x, y));
        // Beyond the border nothing is wall: the first column with a wall differs from the one before.
        let xs = (0..=self.width).filter(|x| match x.checked_sub(1) {
            None => columns(*x).any(|wall| wall),
            Some(before) => !columns(before).eq(columns(*x)),
        });
        let ys = (0..=self.height).filter(|y| match y.checked_sub(1) {
            None => rows(*y).any(|wall| wall),
            Some(before) => !rows(before).eq(rows(*y)),
        });
        [xs.collect(), ys.collect()]
    }
}
