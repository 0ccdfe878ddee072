//! The practical limit for grid mazes: four bits a cell, and a walk through the cells that the circle passes.
//!
//! It works for no other maze: every coordinate follows from a cell's number, so that one word of memory tells the walls of
//! sixteen cells. Faces and corners that the bits and the boxes around the motion leave go through maze-core's own
//! [`impact::face`] and [`impact::corner`], so that the answers are the same to the bit.

use super::{BenchError, Case, Query, Search};
use crate::bench::case::{PITCH, RADIUS, line_at};
use maze_core::impact::{self, Path};
use maze_core::{Facing, Plane, extrude};
use nalgebra::Vector2;

/// How far from the centre something can be that is touched; wider than any rounding.
const REACH: f64 = RADIUS * (1.0 + 1.0e-6);

/// From a cell's number to where its region begins: in the middle of the passages to the cells before it.
const MIDDLE: f64 = extrude::WALL_THICKNESS / 2.0;

/// The walls of a maze, by cells. Bits of a cell: walls at lower and at higher x, at lower and at higher y.
struct BitGrid {
    /// Words along x.
    n_across: usize,
    /// Each of 4 x 4 cells, so that a walk along either axis stays in a word, and in a cache line, for long.
    words: Vec<u64>,
}

/// Where the centre is during a part of the motion.
#[derive(Clone, Copy)]
struct Range {
    low: f64,
    high: f64,
}

pub(super) fn build(case: &Case) -> Result<Box<dyn Search>, BenchError> {
    let n_across = case.side().div_ceil(4);
    let mut words = vec![0; n_across * n_across];
    for y in 0..case.side() {
        for x in 0..case.side() {
            let (i, j) = (2 * x + 1, 2 * y + 1);
            let walls = [(i - 1, j), (i + 1, j), (i, j - 1), (i, j + 1)].map(|(i, j)| case.is_wall(i, j));
            let bits = walls.into_iter().rev().fold(0, |bits, wall| bits << 1 | u64::from(wall));
            words[y / 4 * n_across + x / 4] |= bits << (4 * (y % 4 * 4 + x % 4));
        }
    }
    Ok(Box::new(BitGrid { n_across, words }))
}

impl BitGrid {
    /// All walls where no cell is.
    fn walls(&self, [x, y]: [usize; 2]) -> u64 {
        let word = self.words.get(y / 4 * self.n_across + x / 4).copied().unwrap_or(u64::MAX);
        word >> (4 * (y % 4 * 4 + x % 4)) & 15
    }
}

impl Search for BitGrid {
    fn first_touch(&mut self, query: &Query) -> Option<f64> {
        let mut first = First::new(query);
        let whole = [0, 1].map(|axis| first.range(axis));
        let cell = [0, 1].map(|axis| cell_at(query.path.position[axis]));
        let stays = |axis: usize| {
            middle_line(cell[axis]) <= whole[axis].low && whole[axis].high <= middle_line(cell[axis] + 1)
        };
        if stays(0) && stays(1) {
            first.look(self, cell, whole);
        } else if query.path.acceleration == Vector2::zeros() {
            first.walk(self, cell);
        } else {
            // A tick's parabola: all cells of the box around it are a handful.
            let last = whole.map(|range| cell_at(range.high));
            for y in cell_at(whole[1].low)..=last[1] {
                for x in cell_at(whole[0].low)..=last[0] {
                    first.look(self, [x, y], whole);
                }
            }
        }
        (first.time_s <= query.until_s).then_some(first.time_s)
    }
}

/// The cell in whose region a coordinate lies; what rounding makes of a border is in both.
fn cell_at(value: f64) -> usize {
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates at 0")]
    let cell = ((value - MIDDLE) * (1.0 / PITCH)) as usize;
    cell
}

/// Where a cell's region begins.
#[allow(clippy::cast_precision_loss, reason = "counts far below 2^53")]
fn middle_line(cell: usize) -> f64 {
    cell as f64 * PITCH + MIDDLE
}

/// The earliest touch so far.
struct First<'a> {
    path: &'a Path,
    until_s: f64,
    /// From the start straight to the end.
    chord: Vector2<f64>,
    /// Least squared distance of a point from the chord at which it cannot be touched, times the chord's squared length.
    too_far: f64,
    /// How far the path strays from the chord.
    sag: Vector2<f64>,
    /// Whether the motion goes towards minus, or plus, along each axis at its start or at its end.
    moves: [[bool; 2]; 2],
    time_s: f64,
}

impl<'a> First<'a> {
    fn new(query: &'a Query) -> Self {
        let (path, until_s) = (&query.path, query.until_s);
        let chord = query.mean_velocity() * until_s;
        let sag = path.acceleration.abs() * (until_s * until_s / 8.0);
        let end = path.velocity + path.acceleration * until_s;
        let moves = [0, 1]
            .map(|axis| [path.velocity[axis].min(end[axis]) < 0.0, 0.0 < path.velocity[axis].max(end[axis])]);
        let reach = REACH + sag.x + sag.y;
        let too_far = reach * reach * chord.norm_squared();
        Self { path, until_s, chord, too_far, sag, moves, time_s: f64::INFINITY }
    }

    /// Where the centre can be along an axis, all the time.
    fn range(&self, axis: usize) -> Range {
        let from = self.path.position[axis];
        let to = from + self.chord[axis];
        Range { low: from.min(to) - self.sag[axis], high: from.max(to) + self.sag[axis] }
    }

    /// From cell to cell along a straight line, until something is touched before the next one.
    fn walk(&mut self, grid: &BitGrid, mut cell: [usize; 2]) {
        let (from, velocity) = (self.path.position, self.path.velocity);
        let inverse = velocity.map(|speed| 1.0 / speed);
        let leaves = |axis: usize, cell: usize| match velocity[axis] == 0.0 {
            true => f64::INFINITY,
            false => (middle_line(cell + usize::from(0.0 < velocity[axis])) - from[axis]) * inverse[axis],
        };
        let mut leaving = [leaves(0, cell[0]), leaves(1, cell[1])];
        let mut at = from;
        loop {
            let axis = usize::from(leaving[1] < leaving[0]);
            let until_s = leaving[axis].min(self.until_s);
            let to = from + velocity * until_s;
            let range = |axis: usize| Range { low: at[axis].min(to[axis]), high: at[axis].max(to[axis]) };
            self.look(grid, cell, [range(0), range(1)]);
            if self.until_s <= until_s || self.time_s <= until_s {
                return;
            }
            at = to;
            let next = if 0.0 < velocity[axis] { Some(cell[axis] + 1) } else { cell[axis].checked_sub(1) };
            let Some(next) = next else { return };
            cell[axis] = next;
            leaving[axis] = leaves(axis, cell[axis]);
        }
    }

    /// What can be touched from within a cell and the passages that lead out of it.
    fn look(&mut self, grid: &BitGrid, cell: [usize; 2], range: [Range; 2]) {
        let lines = cell.map(|cell| [0, 1, 2, 3].map(|k| line_at(2 * cell + k)));
        let near = |axis: usize| {
            [range[axis].low - REACH < lines[axis][1], lines[axis][2] < range[axis].high + REACH]
        };
        let near = [near(0), near(1)];
        if !near.iter().flatten().any(|near| *near) {
            return;
        }
        let walls = grid.walls(cell);
        let is_wall = |axis: usize, side: usize| walls >> (2 * axis + side) & 1 != 0;
        for axis in [0, 1] {
            for side in [0, 1] {
                if near[axis][side] && self.moves[axis][side] {
                    self.faces(
                        axis,
                        side,
                        &lines,
                        [0, 1].map(|axis| [0, 1].map(|side| is_wall(axis, side))),
                        range,
                    );
                }
            }
        }
        for x in [0, 1] {
            for y in [0, 1] {
                if near[0][x] && near[1][y] && !is_wall(0, x) && !is_wall(1, y) {
                    self.corner(Vector2::new(lines[0][1 + x], lines[1][1 + y]));
                }
            }
        }
    }

    /// The faces at one side of a cell: its wall, as far as the ball can see it, or the posts beside the passage.
    fn faces(
        &mut self,
        axis: usize,
        side: usize,
        lines: &[[f64; 4]; 2],
        walls: [[bool; 2]; 2],
        range: [Range; 2],
    ) {
        let (along, facing) =
            (lines[1 - axis], [[Facing::PlusX, Facing::MinusX], [Facing::PlusY, Facing::MinusY]]);
        let offset = lines[axis][1 + side];
        let [low_wall, high_wall] = walls[1 - axis];
        let plane = |start: f64, end: f64| Plane { facing: facing[axis][side], offset, start, end };
        if walls[axis][side] {
            self.face(&plane(along[usize::from(low_wall)], along[3 - usize::from(high_wall)]));
            return;
        }
        if !low_wall && range[1 - axis].low <= along[1] {
            self.face(&plane(along[0], along[1]));
        }
        if !high_wall && along[2] <= range[1 - axis].high {
            self.face(&plane(along[2], along[3]));
        }
    }

    fn face(&mut self, plane: &Plane) {
        if let Some(time_s) = impact::face(self.path, RADIUS, plane) {
            self.time_s = self.time_s.min(time_s);
        }
    }

    fn corner(&mut self, point: Vector2<f64>) {
        let to_point = point - self.path.position;
        let aside = to_point.perp(&self.chord);
        if self.too_far < aside * aside {
            return;
        }
        if let Some(time_s) = impact::corner(self.path, RADIUS, point, self.until_s) {
            self.time_s = self.time_s.min(time_s);
        }
    }
}
