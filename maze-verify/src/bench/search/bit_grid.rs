//! The practical limit for grid mazes: four bits a cell, and a walk through the cells that the circle passes.
//!
//! It works for no other maze: every coordinate follows from a cell's number, so that one word of memory holds the walls of
//! sixteen cells. Faces and corners that the bits and the boxes around the motion leave go through maze-core's own
//! [`time_of_impact::face`] and [`time_of_impact::corner`], so that the answers are the same to the bit.

use super::{BenchError, Case, Query, Search};
use crate::bench::case::{PITCH, RADIUS};
use maze_core::Path;
use maze_core::time_of_impact;
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
        let position = query.path.position;
        let chord = query.mean_velocity() * query.until_s;
        // A parabola strays from its chord by at most this.
        let sag = query.path.acceleration.abs() * (query.until_s * query.until_s / 8.0);
        let whole = [0, 1].map(|axis| {
            let (from, to) = (position[axis], position[axis] + chord[axis]);
            Range { low: from.min(to) - sag[axis], high: from.max(to) + sag[axis] }
        });
        let cell = [cell_at(position.x), cell_at(position.y)];
        let near = near(cell, whole);
        if near == 0 {
            return None;
        }
        let mut first = First { query, chord, reach: REACH + sag.x + sag.y, time_s: f64::INFINITY };
        first.search(self, cell, whole, near);
        (first.time_s <= query.until_s).then_some(first.time_s)
    }
}

/// The cell in whose region a coordinate lies. Regions meet in the middle of passages and walls, and what can be touched
/// from within half a wall beyond is visited too: rounding moves no border that far.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "not below 0")]
fn cell_at(value: f64) -> usize {
    (((value - MIDDLE) * (1.0 / PITCH)) as i64).max(0) as usize
}

/// Where a cell's region begins.
fn middle_line(cell: usize) -> f64 {
    to_f64(cell) * PITCH + MIDDLE
}

#[allow(clippy::cast_possible_wrap, clippy::cast_precision_loss, reason = "counts far below 2^53")]
fn to_f64(cell: usize) -> f64 {
    cell as i64 as f64
}

/// The lines around a cell along an axis: the far and the near side of the passage before it and of the one after it. The
/// same numbers as [`crate::bench::case::line_at`] gives.
fn lines(cell: usize) -> [f64; 4] {
    let [n, next, after] = [0.0, 1.0, 2.0].map(|k| to_f64(cell) + k);
    let line =
        |n_walls: f64, n_corridors: f64| n_walls * extrude::WALL_THICKNESS + n_corridors * extrude::CORRIDOR;
    [line(n, n), line(next, n), line(next, next), line(after, next)]
}

/// Which sides of a cell come within reach, as bits in the order of the walls'.
fn near(cell: [usize; 2], range: [Range; 2]) -> u64 {
    let near = |axis: usize| {
        let [_, low, high, _] = lines(cell[axis]);
        u64::from(range[axis].low - REACH < low) | u64::from(high < range[axis].high + REACH) << 1
    };
    near(0) | near(1) << 2
}

/// Where the centre is during a part of the motion.
#[derive(Clone, Copy)]
struct Range {
    low: f64,
    high: f64,
}

/// The earliest touch so far.
struct First<'a> {
    query: &'a Query,
    /// From the start straight to the end.
    chord: Vector2<f64>,
    /// How far from the chord something can be that is touched.
    reach: f64,
    time_s: f64,
}

impl First<'_> {
    fn search(&mut self, grid: &BitGrid, cell: [usize; 2], whole: [Range; 2], near: u64) {
        let path = &self.query.path;
        let end = path.velocity_at(self.query.until_s);
        // Whether the motion goes towards a side at its start or at its end.
        let moves = |axis: usize| {
            let (start, end) = (path.velocity[axis], end[axis]);
            u64::from(start.min(end) < 0.0) | u64::from(0.0 < start.max(end)) << 1
        };
        let moves = moves(0) | moves(1) << 2;
        let stays = |axis: usize| {
            middle_line(cell[axis]) <= whole[axis].low && whole[axis].high <= middle_line(cell[axis] + 1)
        };
        if stays(0) && stays(1) {
            self.probe(grid, cell, whole, near, moves);
        } else if path.acceleration == Vector2::zeros() {
            self.walk(grid, cell, moves);
        } else {
            // A tick's parabola: all cells of the box around it are a handful.
            let [[left, below], [right, above]] =
                [[whole[0].low, whole[1].low], [whole[0].high, whole[1].high]].map(|ends| ends.map(cell_at));
            // The box may reach beyond the maze.
            let [right, above] = [right, above].map(|cell| cell.min(4 * grid.n_across - 1));
            for cell in (below..=above).flat_map(|y| (left..=right).map(move |x| [x, y])) {
                self.probe(grid, cell, whole, self::near(cell, whole), moves);
            }
        }
    }

    /// From cell to cell along a straight line, until something is touched before the next one.
    fn walk(&mut self, grid: &BitGrid, mut cell: [usize; 2], moves: u64) {
        let Query { path: Path { position: from, velocity, .. }, until_s: end_s, .. } = *self.query;
        let inverse = velocity.map(|speed| 1.0 / speed);
        let leaves = |axis: usize, cell: usize| match velocity[axis] == 0.0 {
            true => f64::INFINITY,
            false => (middle_line(cell + usize::from(0.0 < velocity[axis])) - from[axis]) * inverse[axis],
        };
        let mut leaving = [leaves(0, cell[0]), leaves(1, cell[1])];
        let mut at = from;
        loop {
            let axis = usize::from(leaving[1] < leaving[0]);
            let until_s = leaving[axis].min(end_s);
            let to = from + velocity * until_s;
            let range =
                [0, 1].map(|axis| Range { low: at[axis].min(to[axis]), high: at[axis].max(to[axis]) });
            self.probe(grid, cell, range, near(cell, range), moves);
            if end_s <= until_s || self.time_s <= until_s {
                return;
            }
            at = to;
            let next = if 0.0 < velocity[axis] { Some(cell[axis] + 1) } else { cell[axis].checked_sub(1) };
            let Some(next) = next else { return };
            cell[axis] = next;
            leaving[axis] = leaves(axis, next);
        }
    }

    /// What can be touched from within a cell and half of the passages that lead out of it.
    fn probe(&mut self, grid: &BitGrid, cell: [usize; 2], range: [Range; 2], near: u64, moves: u64) {
        if near == 0 {
            return;
        }
        let walls = grid.walls(cell);
        let lines = cell.map(lines);
        for bit in 0..4 {
            if near & moves & walls & 1 << bit != 0 {
                // A wall goes on beside the passages to both sides.
                let beside = walls >> (2 - bit / 2 * 2);
                self.face(bit, &lines, [(beside & 1) as usize, 3 - (beside >> 1 & 1) as usize]);
            }
        }
        // Posts stand out only between two passages.
        let open = near & !walls;
        if open & 3 == 0 || open & 12 == 0 {
            return;
        }
        for bit in 0..4 {
            if open & moves & 1 << bit != 0 {
                let (axis, beside) = (1 - bit / 2, open >> (2 - bit / 2 * 2));
                if beside & 1 != 0 && range[axis].low <= lines[axis][1] {
                    self.face(bit, &lines, [0, 1]);
                }
                if beside & 2 != 0 && lines[axis][2] <= range[axis].high {
                    self.face(bit, &lines, [2, 3]);
                }
            }
        }
        for (x, y) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            if open >> x & 1 != 0 && open >> (2 + y) & 1 != 0 {
                self.corner(Vector2::new(lines[0][1 + x], lines[1][1 + y]));
            }
        }
    }

    /// A face at one side of a cell, between two lines of the other axis.
    fn face(&mut self, bit: usize, lines: &[[f64; 4]; 2], [start, end]: [usize; 2]) {
        let (axis, side) = (bit / 2, bit % 2);
        let facing = [Facing::PlusX, Facing::MinusX, Facing::PlusY, Facing::MinusY][bit];
        let along = lines[1 - axis];
        let plane = Plane { facing, offset: lines[axis][1 + side], start: along[start], end: along[end] };
        if let Some(time_s) = time_of_impact::face(&self.query.path, RADIUS, &plane) {
            self.time_s = self.time_s.min(time_s);
        }
    }

    /// A corner, unless the chord shows that it is not touched before what is known: then no root is sought.
    fn corner(&mut self, point: Vector2<f64>) {
        let Query { path, until_s, .. } = self.query;
        let (chord, reach) = (self.chord, self.reach * self.reach);
        let from_start = point - path.position;
        let aside = from_start.perp(&chord);
        if reach * chord.norm_squared() < aside * aside {
            return;
        }
        let is_left_behind = from_start.dot(&chord) <= 0.0 && reach < from_start.norm_squared();
        let from_end = from_start - chord * (self.time_s.min(*until_s) / until_s);
        let is_ahead = 0.0 <= from_end.dot(&chord) && reach < from_end.norm_squared();
        if is_left_behind || is_ahead {
            return;
        }
        if let Some(time_s) = time_of_impact::corner(path, RADIUS, point, *until_s) {
            self.time_s = self.time_s.min(time_s);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::case::line_at;

    #[test]
    fn lines_have_the_bits_of_the_planes() {
        for cell in 0..5000 {
            assert_eq!(lines(cell), [0, 1, 2, 3].map(|k| line_at(2 * cell + k)));
        }
    }
}
