//! Layouts and blocks -> polygons: walls, tops and floor.

use crate::blocks::{Blocks, to_f64};
use crate::layout::Layout;
use crate::polygons::PolygonMesh;
use nalgebra::Vector3;

/// Width of a corridor (units).
pub const CORRIDOR: f64 = 1.0;
/// Thickness of a wall (units): thin enough that the corridor rules the picture, thick enough to show its top.
pub const WALL_THICKNESS: f64 = 0.2;
/// Height of a wall (units): below the top of the usual ball (0.7), so that the ball stays in sight behind it.
pub const WALL_HEIGHT: f64 = 0.55;

/// Coordinate of the k-th wall line or corridor edge: even k starts a wall, odd k a corridor.
fn line(k: usize) -> f64 {
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

/// Blocks of 1 unit as a mesh; `xs` and `ys` are their edges, so that what does not differ is one piece.
pub(crate) fn extrude_blocks(blocks: &Blocks, xs: &[usize], ys: &[usize], height: f64) -> PolygonMesh {
    let lines = |edges: &[usize]| edges.iter().map(|edge| to_f64(*edge)).collect();
    Grid { xs: lines(xs), ys: lines(ys), height, is_wall: |i, j| blocks.is_wall(xs[i], ys[j]) }.mesh()
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

    /// Whether a wall's side towards this place shows.
    fn is_outside_or_free(&self, i: Option<usize>, j: Option<usize>) -> bool {
        let [n_x, n_y] = self.size();
        match (i, j) {
            (Some(i), Some(j)) if i < n_x && j < n_y => !(self.is_wall)(i, j),
            _ => true,
        }
    }

    /// Faces are one rectangle each, so that edges meet corner to corner and no crack shows between them. They come row by
    /// row, and in a row floors first, then tops, then sides.
    fn mesh(&self) -> PolygonMesh {
        let [n_x, n_y] = self.size();
        let levels = [0.0, self.height];
        let positions = self
            .ys
            .iter()
            .flat_map(|y| self.xs.iter().flat_map(move |x| levels.map(|z| Vector3::new(*x, *y, z))));
        // Coordinates are finite and countable, and corners lie on the grid.
        let mut mesh = PolygonMesh::new(positions.collect()).unwrap_or_default();
        // A layout of 2^20 cells has at most 2 (2 + 2) (2^21 + 2) corners.
        #[allow(clippy::cast_possible_truncation, reason = "at most 2^25")]
        let corner = |i: usize, j: usize, level: usize| ((j * (n_x + 1) + i) * 2 + level) as u32;
        let mut all_known = true;
        for j in 0..n_y {
            for level in [0, 1] {
                for i in (0..n_x).filter(|i| usize::from((self.is_wall)(*i, j)) == level) {
                    let quad = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
                    all_known &= mesh.push_face(&quad.map(|(i, j)| corner(i, j, level)));
                }
            }
            for i in (0..n_x).filter(|i| (self.is_wall)(*i, j)) {
                let [a, b, c, d] = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
                let sides = [
                    (a, b, (Some(i), j.checked_sub(1))),
                    (b, c, (Some(i + 1), Some(j))),
                    (c, d, (Some(i), Some(j + 1))),
                    (d, a, (i.checked_sub(1), Some(j))),
                ];
                for (from, to, beside) in sides {
                    if self.is_outside_or_free(beside.0, beside.1) {
                        let bottom = [from, to].map(|(i, j)| corner(i, j, 0));
                        let top = [to, from].map(|(i, j)| corner(i, j, 1));
                        all_known &= mesh.push_face(&[bottom[0], bottom[1], top[0], top[1]]);
                    }
                }
            }
        }
        debug_assert!(all_known, "every corner lies on the grid");
        mesh
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{AssembleOptions, Facing, Maze, layout};

    /// Two cells with a passage between them.
    fn two_cells() -> Maze {
        let layout = layout::recursive_backtracker(2, 1, 1).unwrap();
        Maze::from_polygons(&extrude(&layout), &AssembleOptions::default()).unwrap()
    }

    #[test]
    fn two_cells_are_a_box() {
        let maze = two_cells();
        let one_of_each = Facing::ALL.map(|facing| maze.planes.n_planes(facing));
        assert_eq!(one_of_each, [1, 1, 1, 1]);
        assert_eq!(maze.scale, 1.0);
        assert!((maze.bounds.size().x - 2.6).abs() < 1.0e-12);
        assert!(maze.solvable && maze.has_floor && maze.openings.is_empty() && maze.ignored.is_empty());
        let far = (maze.start - maze.goal).norm();
        assert!((0.6..1.4).contains(&far), "start and goal lie in the two cells: {far}");
    }

    #[test]
    fn every_seed_and_size_gives_a_maze_in_its_own_units() {
        for (width, height) in [(2, 1), (1, 2), (2, 2), (3, 2), (4, 4), (8, 6), (14, 9)] {
            for seed in 0..100 {
                let layout = layout::recursive_backtracker(width, height, seed).unwrap();
                let maze = Maze::from_polygons(&extrude(&layout), &AssembleOptions::default()).unwrap();
                assert!(maze.scale == 1.0 && maze.solvable, "{width}x{height}, seed {seed}: {}", maze.scale);
                assert!(0.5 < (maze.start - maze.goal).norm(), "{width}x{height}, seed {seed}");
            }
        }
    }

    #[test]
    fn corridors_stay_one_unit_wide_and_start_lies_in_a_corridor() {
        let layout = layout::recursive_backtracker(12, 9, 7).unwrap();
        let maze = Maze::from_polygons(&extrude(&layout), &AssembleOptions::default()).unwrap();
        assert_eq!(maze.scale, 1.0);
        assert!((maze.wall_height - WALL_HEIGHT).abs() < 1.0e-12);
        for point in [maze.start, maze.goal] {
            for facing in Facing::ALL {
                let overlap = maze.planes.first_overlap(facing, point, maze.ball_radius.units());
                assert!(overlap.is_none(), "{point} overlaps {overlap:?}");
            }
        }
    }
}
