//! Layout -> polygons: walls, tops and floor.

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
    #[allow(clippy::cast_precision_loss, reason = "a layout has at most 2^20 cells")]
    let [n_walls, n_corridors] = [k.div_ceil(2) as f64, (k / 2) as f64];
    n_walls * WALL_THICKNESS + n_corridors * CORRIDOR
}

/// The grid of a layout: posts, walls and corridors in turn, `2 n + 1` along each axis.
struct Grid<'a>(&'a Layout);

impl Grid<'_> {
    fn size(&self) -> [usize; 2] {
        [2 * self.0.width() + 1, 2 * self.0.height() + 1]
    }

    fn is_wall(&self, i: usize, j: usize) -> bool {
        let [n_x, n_y] = self.size();
        if i == 0 || j == 0 || i + 1 == n_x || j + 1 == n_y {
            return true;
        }
        match (i % 2, j % 2) {
            (1, 1) => false,
            (0, 1) => !self.0.is_open_east(i / 2 - 1, j / 2),
            (1, 0) => !self.0.is_open_north(i / 2, j / 2 - 1),
            _ => true,
        }
    }

    /// Whether a wall's side towards this place shows.
    fn is_outside_or_free(&self, i: Option<usize>, j: Option<usize>) -> bool {
        let [n_x, n_y] = self.size();
        match (i, j) {
            (Some(i), Some(j)) if i < n_x && j < n_y => !self.is_wall(i, j),
            _ => true,
        }
    }
}

/// The layout as a mesh: floor, the walls' sides where they face free space, and their tops; +z is up.
///
/// Faces are one grid cell each, so that edges meet corner to corner and no crack shows between them.
pub fn extrude(layout: &Layout) -> PolygonMesh {
    let grid = Grid(layout);
    let [n_x, n_y] = grid.size();
    let levels = [0.0, WALL_HEIGHT];
    let position = |index: usize| {
        let (level, rest) = (index % 2, index / 2);
        Vector3::new(line(rest % (n_x + 1)), line(rest / (n_x + 1)), levels[level])
    };
    let positions = (0..2 * (n_x + 1) * (n_y + 1)).map(position).collect();
    // A layout's size keeps positions and corners countable, and corners lie on the grid.
    let mut mesh = PolygonMesh::new(positions).unwrap_or_default();
    // A layout of 2^20 cells has at most 2 (2 + 2) (2^21 + 2) corners.
    #[allow(clippy::cast_possible_truncation, reason = "at most 2^25")]
    let corner = |i: usize, j: usize, level: usize| ((j * (n_x + 1) + i) * 2 + level) as u32;
    let mut all_known = true;
    for j in 0..n_y {
        for i in 0..n_x {
            let level = usize::from(grid.is_wall(i, j));
            let [a, b, c, d] = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
            let quad = [a, b, c, d].map(|(i, j)| corner(i, j, level));
            all_known &= mesh.push_face(&quad);
            if level == 0 {
                continue;
            }
            let sides = [
                (a, b, (Some(i), j.checked_sub(1))),
                (b, c, (Some(i + 1), Some(j))),
                (c, d, (Some(i), Some(j + 1))),
                (d, a, (i.checked_sub(1), Some(j))),
            ];
            for (from, to, beside) in sides {
                if grid.is_outside_or_free(beside.0, beside.1) {
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
