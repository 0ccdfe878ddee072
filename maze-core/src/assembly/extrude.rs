//! Layouts and blocks -> polygons: walls, tops and floor.

use crate::assembly::polygons::PolygonMesh;
use crate::layout::Layout;
use crate::layout::blocks::Blocks;
use crate::physics::numbers::to_f64;
use nalgebra::Vector3;

/// Width of a corridor (units).
pub const CORRIDOR: f64 = 1.0;
/// Thickness of a wall (units): thin enough that the corridor rules the picture, thick enough to show its top.
pub const WALL_THICKNESS: f64 = 0.2;
/// Height of a wall (units): below the top of the usual ball (0.7), so that the ball stays in sight behind it.
pub const WALL_HEIGHT: f64 = 0.55;

/// Coordinate of the k-th wall line or corridor edge: even k starts a wall, odd k a corridor.
pub(crate) fn line(k: usize) -> f64 {
    let [n_walls, n_corridors] = [to_f64(k.div_ceil(2)), to_f64(k / 2)];
    n_walls * WALL_THICKNESS + n_corridors * CORRIDOR
}

/// The layout as a mesh: floor, the walls' sides where they face free space, and their tops; +z is up.
pub fn extrude(layout: &Layout) -> PolygonMesh {
    let blocks = Blocks::of_layout(layout);
    let lines = |n_blocks| (0..=n_blocks).map(line).collect();
    let [xs, ys] = [lines(blocks.width()), lines(blocks.height())];
    Grid { xs, ys, height: WALL_HEIGHT, is_wall: |i, j| blocks.is_wall(i, j) }.mesh()
}

/// Blocks as a mesh; `xs` and `ys` are their edges, so that what does not differ is one piece, and `line` is where an edge along an axis lies.
pub(crate) fn extrude_blocks(
    blocks: &Blocks,
    xs: &[usize],
    ys: &[usize],
    line: impl Fn(usize, usize) -> f64,
    height: f64,
) -> PolygonMesh {
    let lines = |axis: usize, edges: &[usize]| edges.iter().map(|edge| line(axis, *edge)).collect();
    Grid { xs: lines(0, xs), ys: lines(1, ys), height, is_wall: |i, j| blocks.is_wall(xs[i], ys[j]) }.mesh()
}

/// Rectangles between lines, each wall or free.
struct Grid<W> {
    xs: Vec<f64>,
    ys: Vec<f64>,
    height: f64,
    is_wall: W, // (i, j): the rectangle right of xs[i] and above ys[j]
}

impl<W: Fn(usize, usize) -> bool> Grid<W> {
    /// Number of rectangles along x and y.
    fn size(&self) -> [usize; 2] {
        [self.xs.len().saturating_sub(1), self.ys.len().saturating_sub(1)]
    }

    /// Whether a place is wall; beyond the grid nothing is.
    fn at(&self, i: Option<usize>, j: Option<usize>) -> bool {
        let [n_x, n_y] = self.size();
        i.zip(j).is_some_and(|(i, j)| i < n_x && j < n_y && (self.is_wall)(i, j))
    }

    /// One floor under everything; tops and sides in pieces as large as can be, so that a mesh is no larger than its maze.
    /// They come floor first, then tops, then sides.
    fn mesh(&self) -> PolygonMesh {
        let [n_x, n_y] = self.size();
        let mut corners =
            Corners { grid: self, numbers: vec![UNUSED; 2 * (n_x + 1) * (n_y + 1)], positions: Vec::new() };
        let mut faces: Vec<[u32; 4]> = Vec::new();
        if 0 < n_x && 0 < n_y {
            faces.push([(0, 0), (n_x, 0), (n_x, n_y), (0, n_y)].map(|(i, j)| corners.number(i, j, 0)));
        }
        for [low, high, left, right] in self.tops() {
            faces.push(
                [(left, low), (right, low), (right, high), (left, high)]
                    .map(|(i, j)| corners.number(i, j, 1)),
            );
        }
        for [from, to] in self.sides() {
            let [a, b, c, d] = [(from, 0), (to, 0), (to, 1), (from, 1)];
            faces.push([a, b, c, d].map(|((i, j), level)| corners.number(i, j, level)));
        }
        // Coordinates are finite and countable, and corners are numbered positions.
        let mut mesh = PolygonMesh::new(corners.positions).unwrap_or_default();
        let all_known = faces.iter().all(|face| mesh.push_face(face).is_ok());
        debug_assert!(all_known, "every corner is a position");
        mesh
    }

    /// Rectangles of wall, as rows from and to, columns from and to: runs of a row that the next rows go on with.
    fn tops(&self) -> Vec<[usize; 4]> {
        let [n_x, n_y] = self.size();
        let mut tops: Vec<[usize; 4]> = Vec::new();
        let mut open: Vec<[usize; 3]> = Vec::new(); // row from, columns from and to, in the row before
        for j in 0..=n_y {
            let row: Vec<[usize; 2]> = runs(n_x, |i| j < n_y && (self.is_wall)(i, j)).collect();
            let mut before = open.iter().peekable();
            let mut next = Vec::with_capacity(row.len());
            for [left, right] in row {
                // Both rows are in order: what lies left of this run has ended.
                while let Some(ended) = before.next_if(|open| open[1] < left) {
                    tops.push([ended[0], j, ended[1], ended[2]]);
                }
                match before.next_if(|open| open[1] == left) {
                    Some(same) if same[2] == right => next.push(*same),
                    other => {
                        tops.extend(other.map(|ended| [ended[0], j, ended[1], ended[2]]));
                        next.push([j, left, right]);
                    }
                }
            }
            tops.extend(before.map(|ended| [ended[0], j, ended[1], ended[2]]));
            open = next;
        }
        tops
    }

    /// Runs of sides that face the same way, from and to, counter-clockwise around the wall.
    fn sides(&self) -> Vec<[(usize, usize); 2]> {
        let [n_x, n_y] = self.size();
        let mut sides = Vec::new();
        for j in 0..=n_y {
            let (below, above) = (j.checked_sub(1), Some(j));
            let looks_down = |i: usize| self.at(Some(i), above) && !self.at(Some(i), below);
            let looks_up = |i: usize| self.at(Some(i), below) && !self.at(Some(i), above);
            sides.extend(runs(n_x, looks_down).map(|[from, to]| [(from, j), (to, j)]));
            sides.extend(runs(n_x, looks_up).map(|[from, to]| [(to, j), (from, j)]));
        }
        for i in 0..=n_x {
            let (left, right) = (i.checked_sub(1), Some(i));
            let looks_left = |j: usize| self.at(right, Some(j)) && !self.at(left, Some(j));
            let looks_right = |j: usize| self.at(left, Some(j)) && !self.at(right, Some(j));
            sides.extend(runs(n_y, looks_left).map(|[from, to]| [(i, to), (i, from)]));
            sides.extend(runs(n_y, looks_right).map(|[from, to]| [(i, from), (i, to)]));
        }
        sides
    }
}

/// A corner of the grid that no face uses so far.
const UNUSED: u32 = u32::MAX;

/// Numbers the corners in the order of their first use.
struct Corners<'a, W> {
    grid: &'a Grid<W>,
    numbers: Vec<u32>, // [2 * (j * (n_x + 1) + i) + level]
    positions: Vec<Vector3<f64>>,
}

impl<W> Corners<'_, W> {
    fn number(&mut self, i: usize, j: usize, level: usize) -> u32 {
        let number = &mut self.numbers[2 * (j * self.grid.xs.len() + i) + level];
        if *number == UNUSED {
            #[allow(
                clippy::cast_possible_truncation,
                reason = "a layout has at most 2 (2 * 2^10 + 2)^2 corners"
            )]
            let next = self.positions.len() as u32;
            *number = next;
            let z = if level == 0 { 0.0 } else { self.grid.height };
            self.positions.push(Vector3::new(self.grid.xs[i], self.grid.ys[j], z));
        }
        *number
    }
}

/// Maximal runs of what holds in `0..n`, as start and end.
pub(crate) fn runs(n: usize, holds: impl Fn(usize) -> bool) -> impl Iterator<Item = [usize; 2]> {
    let mut next = 0;
    std::iter::from_fn(move || {
        let start = (next..n).find(|at| holds(*at))?;
        let end = (start..n).find(|at| !holds(*at)).unwrap_or(n);
        next = end;
        Some([start, end])
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{AssembleOptions, Facing, Maze, layout};

    /// Two cells with a passage between them.
    fn two_cells() -> Maze {
        let layout = layout::recursive_backtracker(2, 1, 1).unwrap();
        layout.maze(&AssembleOptions::default()).unwrap()
    }

    #[test]
    fn two_cells_are_a_box() {
        let maze = two_cells();
        let one_of_each = Facing::ALL.map(|facing| maze.planes.n_planes(facing));
        assert_eq!(one_of_each, [1, 1, 1, 1]);
        assert_eq!(maze.report.scale, 1.0);
        assert!((maze.bounds.size().x - 2.6).abs() < 1.0e-12);
        assert!(
            maze.is_solvable()
                && maze.report.has_floor
                && maze.openings.is_empty()
                && maze.report.ignored.is_empty()
        );
        let far = (maze.start() - maze.goal()).norm();
        assert!((0.6..1.4).contains(&far), "start and goal lie in the two cells: {far}");
    }

    #[test]
    fn every_seed_and_size_gives_a_maze_in_its_own_units() {
        for (width, height) in [(2, 1), (1, 2), (2, 2), (3, 2), (4, 4), (8, 6), (14, 9)] {
            for seed in 0..100 {
                let layout = layout::recursive_backtracker(width, height, seed).unwrap();
                let maze = layout.maze(&AssembleOptions::default()).unwrap();
                assert!(
                    maze.report.scale == 1.0 && maze.is_solvable(),
                    "{width}x{height}, seed {seed}: {}",
                    maze.report.scale
                );
                assert!(0.5 < (maze.start() - maze.goal()).norm(), "{width}x{height}, seed {seed}");
            }
        }
    }

    #[test]
    fn corridors_stay_one_unit_wide_and_start_lies_in_a_corridor() {
        let layout = layout::recursive_backtracker(12, 9, 7).unwrap();
        let maze = layout.maze(&AssembleOptions::default()).unwrap();
        assert_eq!(maze.report.scale, 1.0);
        assert!((maze.wall_height - WALL_HEIGHT).abs() < 1.0e-12);
        for point in [maze.start(), maze.goal()] {
            for facing in Facing::ALL {
                let overlap = maze.planes.first_overlap(facing, point, maze.ball_radius.units());
                assert!(overlap.is_none(), "{point} overlaps {overlap:?}");
            }
        }
    }
}
