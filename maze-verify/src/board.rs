//! Walls as every engine wants them: rectangles, faces, triangles, and a grid of what is solid.

use maze_core::{Bounds, Facing, Plane, PlaneError, SortedPlanes};
use nalgebra::Vector2;
use std::sync::Arc;

/// How far the solid outside of a maze with openings is taken to reach (units): enough that no ball gets behind it.
const MARGIN: f64 = 1.0;

/// The plan cut along every coordinate at which a wall starts or ends.
/// Invariant: `xs` and `ys` ascend strictly; `solid` holds `(xs.len() - 1) * (ys.len() - 1)` cells, row by row.
#[derive(Clone, Debug, PartialEq)]
struct Grid {
    xs: Vec<f64>,
    ys: Vec<f64>,
    solid: Vec<bool>,
}

/// The walls of a scene: the same walls in every form that an engine takes.
#[derive(Clone, Debug)]
pub struct Board {
    rectangles: Vec<Bounds>,
    planes: Arc<SortedPlanes>,
    grid: Grid,
}

/// Triangles of the walls, closed, counter-clockwise seen from outside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WallMesh {
    /// x, y (units) and z: -1 at the lower end of the walls, 1 at the upper one.
    pub vertices: Vec<[f64; 3]>,
    /// Corners of each triangle.
    pub triangles: Vec<[u32; 3]>,
}

impl Board {
    /// Solid rectangles, which may touch and overlap. Faces hidden between them are no faces of the board.
    ///
    /// # Errors
    /// A rectangle with a coordinate that is not finite.
    pub fn from_rectangles(rectangles: Vec<Bounds>) -> Result<Self, PlaneError> {
        let grid = Grid::of_rectangles(&rectangles);
        let planes = Arc::new(SortedPlanes::new(grid.faces())?);
        Ok(Self { rectangles, planes, grid })
    }

    /// The walls that these faces enclose, cut into rectangles. A face with nothing behind it, as those that close the
    /// openings of a maze, bounds a solid of one unit.
    pub fn from_planes(planes: &Arc<SortedPlanes>) -> Self {
        let grid = Grid::of_planes(planes);
        Self { rectangles: grid.rectangles(), planes: Arc::clone(planes), grid }
    }

    /// Solid rectangles.
    pub fn rectangles(&self) -> &[Bounds] {
        &self.rectangles
    }

    /// The faces.
    pub fn planes(&self) -> &Arc<SortedPlanes> {
        &self.planes
    }

    /// How deep a circle lies in the walls (units): radius less distance to the nearest point of any face, 0 when clear.
    ///
    /// A scan of every face, independent of every engine's search.
    pub fn penetration(&self, centre: Vector2<f64>, radius: f64) -> f64 {
        let depth = |plane: Plane| {
            let (axis, along) = (plane.facing.axis(), centre[1 - plane.facing.axis()]);
            let beside = along.clamp(plane.start, plane.end) - along;
            radius - (centre[axis] - plane.offset).hypot(beside)
        };
        Facing::ALL.into_iter().flat_map(|facing| self.planes.planes(facing)).map(depth).fold(0.0, f64::max)
    }

    /// Whether the centre of a ball can have got from one place to the other by a path no longer than `distance` (units) without
    /// crossing a wall; false also when it ended inside of one.
    pub fn can_have_moved(&self, from: Vector2<f64>, to: Vector2<f64>, distance: f64) -> bool {
        let (start, end) = match (self.grid.cell_at(from), self.grid.cell_at(to)) {
            // Beyond all walls there is nothing to cross.
            (None, None) => return true,
            // A path into the plan is a path out of it.
            (None, Some(end)) => return !self.grid.solid[end] && self.can_have_moved(to, from, distance),
            (Some(start), end) => (start, end),
        };
        if end.map_or(self.grid.solid[start], |end| self.grid.solid[end]) {
            return false;
        }
        let mut seen = vec![false; self.grid.solid.len()];
        let mut open = vec![start];
        seen[start] = true;
        while let Some(cell) = open.pop() {
            let is_there = end
                .map_or_else(|| self.grid.distance_over_rim(cell, [from, to]) <= distance, |end| end == cell);
            if is_there {
                return true;
            }
            for next in self.grid.neighbours(cell) {
                // Every point of the path lies within its length of the start.
                if !seen[next] && !self.grid.solid[next] && self.grid.distance(next, from) <= distance {
                    seen[next] = true;
                    open.push(next);
                }
            }
        }
        false
    }

    /// The walls as one closed mesh. Its vertices are those of the plan's cut, shared by all triangles that meet there, so
    /// that a wall made of several pieces has edges within its faces.
    pub fn mesh(&self) -> WallMesh {
        self.grid.mesh()
    }
}

/// Ascending, each value once.
fn cuts(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut cuts: Vec<f64> = values.collect();
    cuts.sort_by(f64::total_cmp);
    cuts.dedup();
    cuts
}

impl Grid {
    fn n_columns(&self) -> usize {
        self.xs.len().saturating_sub(1)
    }

    fn n_rows(&self) -> usize {
        self.ys.len().saturating_sub(1)
    }

    fn is_solid(&self, column: usize, row: usize) -> bool {
        column < self.n_columns() && row < self.n_rows() && self.solid[row * self.n_columns() + column]
    }

    /// Nothing but free cells.
    fn free(xs: Vec<f64>, ys: Vec<f64>) -> Self {
        let mut grid = Self { xs, ys, solid: Vec::new() };
        grid.solid = vec![false; grid.n_columns() * grid.n_rows()];
        grid
    }

    fn of_rectangles(rectangles: &[Bounds]) -> Self {
        let xs = cuts(rectangles.iter().flat_map(|wall| [wall.low.x, wall.high.x]));
        let ys = cuts(rectangles.iter().flat_map(|wall| [wall.low.y, wall.high.y]));
        let mut grid = Self::free(xs, ys);
        for wall in rectangles {
            let first = |cuts: &[f64], value: f64| cuts.partition_point(|cut| *cut < value);
            let columns = first(&grid.xs, wall.low.x)..first(&grid.xs, wall.high.x);
            let n_columns = grid.n_columns();
            for row in first(&grid.ys, wall.low.y)..first(&grid.ys, wall.high.y) {
                grid.solid[row * n_columns + columns.start..row * n_columns + columns.end].fill(true);
            }
        }
        grid
    }

    fn of_planes(planes: &SortedPlanes) -> Self {
        let all: Vec<Plane> = Facing::ALL.into_iter().flat_map(|facing| planes.planes(facing)).collect();
        let axis_cuts = |axis: usize| {
            let values = all.iter().flat_map(|plane| match plane.facing.axis() == axis {
                true => vec![plane.offset],
                false => vec![plane.start, plane.end],
            });
            let inner = cuts(values);
            let (low, high) = (inner.first().map(|low| low - MARGIN), inner.last().map(|high| high + MARGIN));
            low.into_iter().chain(inner).chain(high).collect::<Vec<_>>()
        };
        let mut grid = Self::free(axis_cuts(0), axis_cuts(1));
        let known = grid.beside_faces(&all);
        grid.flood(known);
        grid
    }

    /// Cells that lie behind a face are solid, those before one free, all others not known yet.
    fn beside_faces(&self, faces: &[Plane]) -> Vec<Option<bool>> {
        let mut known = vec![None; self.solid.len()];
        for face in faces {
            let across_x = face.facing.axis() == 0;
            let (across, along) = if across_x { (&self.xs, &self.ys) } else { (&self.ys, &self.xs) };
            let index = |cuts: &[f64], value: f64| cuts.partition_point(|cut| *cut < value);
            let line = index(across, face.offset);
            for along in index(along, face.start)..index(along, face.end) {
                for (across, is_upper) in [(line - 1, false), (line, true)] {
                    let (column, row) = if across_x { (across, along) } else { (along, across) };
                    known[row * self.n_columns() + column] = Some(is_upper != (0.0 < face.facing.sign()));
                }
            }
        }
        known
    }

    /// No face lies between a cell that is not known and its neighbours: they are alike.
    fn flood(&mut self, mut known: Vec<Option<bool>>) {
        let mut open: Vec<usize> = (0..known.len()).filter(|cell| known[*cell].is_some()).collect();
        while let Some(cell) = open.pop() {
            for next in self.neighbours(cell) {
                if known[next].is_none() {
                    known[next] = known[cell];
                    open.push(next);
                }
            }
        }
        self.solid = known.into_iter().map(|known| known == Some(true)).collect();
    }

    /// A face wherever solid meets free.
    fn faces(&self) -> Vec<Plane> {
        let mut faces = Vec::new();
        for row in 0..self.n_rows() {
            for column in 0..self.n_columns() {
                if !self.is_solid(column, row) {
                    continue;
                }
                let ([x0, x1], [y0, y1]) =
                    ([self.xs[column], self.xs[column + 1]], [self.ys[row], self.ys[row + 1]]);
                let sides = [
                    (Facing::MinusX, self.is_solid(column.wrapping_sub(1), row), x0, y0, y1),
                    (Facing::PlusX, self.is_solid(column + 1, row), x1, y0, y1),
                    (Facing::MinusY, self.is_solid(column, row.wrapping_sub(1)), y0, x0, x1),
                    (Facing::PlusY, self.is_solid(column, row + 1), y1, x0, x1),
                ];
                let free = sides.into_iter().filter(|(_, hidden, ..)| !hidden);
                faces.extend(free.map(|(facing, _, offset, start, end)| Plane {
                    facing,
                    offset,
                    start,
                    end,
                }));
            }
        }
        faces
    }

    /// Runs of solid cells along x, joined along y where they are equally long.
    fn rectangles(&self) -> Vec<Bounds> {
        let mut done = vec![false; self.solid.len()];
        let mut rectangles = Vec::new();
        let n_columns = self.n_columns();
        for row in 0..self.n_rows() {
            for column in 0..n_columns {
                let is_open = |column: usize, row: usize, done: &[bool]| {
                    self.is_solid(column, row) && !done[row * n_columns + column]
                };
                if !is_open(column, row, &done) {
                    continue;
                }
                let mut end = column + 1;
                while is_open(end, row, &done) {
                    end += 1;
                }
                let mut top = row + 1;
                while (column..end).all(|column| is_open(column, top, &done)) {
                    top += 1;
                }
                for row in row..top {
                    done[row * n_columns + column..row * n_columns + end].fill(true);
                }
                rectangles.push(Bounds {
                    low: Vector2::new(self.xs[column], self.ys[row]),
                    high: Vector2::new(self.xs[end], self.ys[top]),
                });
            }
        }
        rectangles
    }

    fn cell_at(&self, point: Vector2<f64>) -> Option<usize> {
        let index = |cuts: &[f64], value: f64| {
            let above = cuts.partition_point(|cut| *cut <= value);
            above.checked_sub(1).filter(|index| index + 1 < cuts.len())
        };
        Some(index(&self.ys, point.y)? * self.n_columns() + index(&self.xs, point.x)?)
    }

    fn neighbours(&self, cell: usize) -> impl Iterator<Item = usize> {
        let n_columns = self.n_columns();
        let (column, row) = (cell % n_columns, cell / n_columns);
        let beside = [
            (0 < column).then(|| cell - 1),
            (column + 1 < n_columns).then(|| cell + 1),
            (0 < row).then(|| cell - n_columns),
            (row + 1 < self.n_rows()).then(|| cell + n_columns),
        ];
        beside.into_iter().flatten()
    }

    /// Length of the shortest path between two points through a side of a cell that is a side of the whole plan, as if nothing
    /// else was there; at most as long as any path. Infinite where the cell has none.
    fn distance_over_rim(&self, cell: usize, points: [Vector2<f64>; 2]) -> f64 {
        let cell = [cell % self.n_columns(), cell / self.n_columns()];
        let mut shortest = f64::INFINITY;
        for axis in [0, 1] {
            let cuts = [&self.xs, &self.ys];
            let (across, along) = (cuts[axis], cuts[1 - axis]);
            let range = [along[cell[1 - axis]], along[cell[1 - axis] + 1]];
            let low = (cell[axis] == 0).then(|| across[0]);
            let high = (cell[axis] + 2 == across.len()).then(|| across[cell[axis] + 1]);
            for side in low.into_iter().chain(high) {
                let to_side = |point: Vector2<f64>| {
                    let beside = point[1 - axis].clamp(range[0], range[1]) - point[1 - axis];
                    (point[axis] - side).hypot(beside)
                };
                shortest = shortest.min(points.map(to_side).iter().sum());
            }
        }
        shortest
    }

    /// From a point to the nearest point of a cell.
    fn distance(&self, cell: usize, point: Vector2<f64>) -> f64 {
        let (column, row) = (cell % self.n_columns(), cell / self.n_columns());
        let outside =
            |cuts: &[f64], index: usize, value: f64| value.clamp(cuts[index], cuts[index + 1]) - value;
        outside(&self.xs, column, point.x).hypot(outside(&self.ys, row, point.y))
    }

    fn mesh(&self) -> WallMesh {
        let mut mesh = WallMesh::default();
        let n_across = self.xs.len();
        for y in &self.ys {
            for x in &self.xs {
                mesh.vertices.extend([[*x, *y, -1.0], [*x, *y, 1.0]]);
            }
        }
        // A plan has far fewer cuts than 2^16 a side.
        #[allow(clippy::cast_possible_truncation, reason = "vertices of a plan, far below 2^32")]
        let vertex = |column: usize, row: usize, level: usize| (2 * (row * n_across + column) + level) as u32;
        let mut quad = |a: u32, b: u32, c: u32, d: u32| mesh.triangles.extend([[a, b, c], [a, c, d]]);
        for row in 0..self.n_rows() {
            for column in 0..self.n_columns() {
                if !self.is_solid(column, row) {
                    continue;
                }
                let corners = [(column, row), (column + 1, row), (column + 1, row + 1), (column, row + 1)];
                let [bottom, top] = [0, 1].map(|level| corners.map(|(c, r)| vertex(c, r, level)));
                quad(top[0], top[1], top[2], top[3]);
                quad(bottom[3], bottom[2], bottom[1], bottom[0]);
                let hidden = [
                    self.is_solid(column, row.wrapping_sub(1)),
                    self.is_solid(column + 1, row),
                    self.is_solid(column, row + 1),
                    self.is_solid(column.wrapping_sub(1), row),
                ];
                for side in (0..4).filter(|side| !hidden[*side]) {
                    let next = (side + 1) % 4;
                    quad(bottom[side], bottom[next], top[next], top[side]);
                }
            }
        }
        mesh
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use maze_core::{AssembleOptions, layout};

    fn rectangle(x0: f64, y0: f64, x1: f64, y1: f64) -> Bounds {
        Bounds { low: Vector2::new(x0, y0), high: Vector2::new(x1, y1) }
    }

    #[test]
    fn a_wall_of_many_pieces_is_one_wall() {
        let pieces = (0..10_u8).map(f64::from).map(|x| rectangle(x, -1.0, x + 1.0, 0.0)).collect();
        let board = Board::from_rectangles(pieces).unwrap();
        assert_eq!(board.planes().len(), 4);
        let whole = Board::from_rectangles(vec![rectangle(0.0, -1.0, 10.0, 0.0)]).unwrap();
        assert_eq!(board.planes(), whole.planes());
        assert!(whole.mesh().vertices.len() < board.mesh().vertices.len(), "the seams stay in the mesh");
    }

    #[test]
    fn rectangles_of_a_maze_have_the_faces_of_the_maze() {
        for seed in 0..10 {
            let layout = layout::recursive_backtracker(7, 5, seed).unwrap();
            let maze = layout.maze(&AssembleOptions::default()).unwrap();
            let board = Board::from_planes(&maze.planes);
            let again = Board::from_rectangles(board.rectangles().to_vec()).unwrap();
            let faces = |planes: &SortedPlanes| {
                Facing::ALL
                    .into_iter()
                    .flat_map(|facing| planes.planes(facing).collect::<Vec<_>>())
                    .collect::<Vec<_>>()
            };
            let mut outside = faces(again.planes());
            outside.retain(|face| !faces(&maze.planes).contains(face));
            // A maze has no faces towards the outside; the solid around it has four.
            assert_eq!((again.planes().len(), outside.len()), (maze.planes.len() + 4, 4));
        }
    }

    #[test]
    fn an_opening_is_closed_by_a_solid() {
        let faces = [
            Plane { facing: Facing::PlusX, offset: 0.0, start: 0.0, end: 1.0 },
            Plane { facing: Facing::PlusY, offset: 0.0, start: 0.0, end: 1.0 },
        ];
        let board = Board::from_planes(&Arc::new(SortedPlanes::new(faces).unwrap()));
        assert!(!board.can_have_moved(Vector2::new(0.5, 0.5), Vector2::new(-0.5, 0.5), 9.0));
    }

    #[test]
    fn a_ball_beyond_a_wall_has_tunnelled_unless_the_way_round_was_short() {
        let board = Board::from_rectangles(vec![
            rectangle(-5.0, -5.0, 5.0, -4.0),
            rectangle(0.0, -4.0, 0.1, 1.0),
            rectangle(-5.0, 4.0, 5.0, 5.0),
        ])
        .unwrap();
        let (left, right) = (Vector2::new(-0.5, 0.0), Vector2::new(0.5, 0.0));
        assert!(!board.can_have_moved(left, right, 0.8));
        assert!(board.can_have_moved(left, right, 4.0));
        assert!(!board.can_have_moved(left, Vector2::new(0.05, 0.0), 4.0), "inside the wall");
        assert!(board.can_have_moved(left, Vector2::new(-1.5, 2.0), 3.0));
        // Off the plan to the left, and back; to the right only around the wall.
        let (far_left, far_right) = (Vector2::new(-5.5, 0.0), Vector2::new(5.5, 0.0));
        assert!(board.can_have_moved(left, far_left, 5.1) && board.can_have_moved(far_left, left, 5.1));
        assert!(!board.can_have_moved(left, far_right, 4.0));
        assert!(!board.can_have_moved(right, Vector2::new(1.0, -5.5), 5.6), "through the floor");
    }

    #[test]
    fn the_mesh_is_closed() {
        let layout = layout::recursive_backtracker(4, 3, 1).unwrap();
        let maze = layout.maze(&AssembleOptions::default()).unwrap();
        let mesh = Board::from_planes(&maze.planes).mesh();
        let mut edges: Vec<[u32; 2]> = Vec::new();
        for [a, b, c] in &mesh.triangles {
            edges.extend([[*a, *b], [*b, *c], [*c, *a]]);
        }
        for [a, b] in &edges {
            let there = edges.iter().filter(|edge| **edge == [*a, *b]).count();
            let back = edges.iter().filter(|edge| **edge == [*b, *a]).count();
            assert_eq!(there, back, "edge {a} {b}");
        }
    }
}
