//! Mazes of any size, and balls in them.

use super::BenchError;
use crate::board::Board;
use maze_core::Path;
use maze_core::{
    Ball, BallSpec, Bounds, Continuous, Engine, Facing, Layout, Plane, Radius, SortedPlanes, SweepQuery,
};
use maze_core::{extrude, layout};
use nalgebra::Vector2;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use std::sync::Arc;

/// Radius of the ball (units): half a corridor wide.
pub const RADIUS: f64 = 0.25;

/// A tick of the game (s).
pub const TICK_S: f64 = 0.03;

/// From a corridor to the next (units).
pub const PITCH: f64 = extrude::CORRIDOR + extrude::WALL_THICKNESS;

/// Lengths of a step (corridors, which are 1 unit wide).
pub const STEPS: [f64; 4] = [0.01, 0.1, 1.0, 10.0];

/// Of the layout and of the random queries: anything, so long as it stays.
const SEED: u64 = 2020;

/// A acceleration of 1 unit/s² turns round once in so many ticks: slowly enough that the ball meets walls again and again.
const TICKS_A_TURN: u32 = 333;

/// A face of the walls, and which of its ends are corners that a ball can touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallFace {
    /// As long as the face goes on.
    pub plane: Plane,
    /// At its start and at its end.
    pub is_corner: [bool; 2],
}

/// A square grid maze: a tile laid side by side with itself, so that a ball meets the same walls in all sizes.
pub struct Case {
    tile: Layout,
    side: usize,
    faces: Vec<WallFace>,
    board: Board,
}

/// A circle of [`RADIUS`] on a path: what does it touch first, if anything?
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Query {
    /// Its centre's.
    pub path: Path,
    /// How long it moves (s).
    pub until_s: f64,
    /// The same as maze-core takes it, checked.
    pub sweep: SweepQuery,
}

/// Queries of one kind.
#[derive(Clone, Debug, PartialEq)]
pub struct QuerySet {
    /// As in the table.
    pub name: &'static str,
    /// In the order in which they are asked.
    pub queries: Vec<Query>,
}

impl Query {
    /// A circle on a path, until a time (s).
    ///
    /// # Errors
    /// What [`SweepQuery::new`] refuses.
    pub fn new(path: Path, until_s: f64) -> Result<Self, BenchError> {
        let sweep = SweepQuery::new(path, RADIUS, until_s).map_err(BenchError::set_up)?;
        Ok(Self { path, until_s, sweep })
    }

    /// Of the straight line from where the path starts to where it ends, for casts that know no acceleration.
    pub fn mean_velocity(&self) -> Vector2<f64> {
        self.path.velocity + self.path.acceleration * (self.until_s / 2.0)
    }
}

impl Case {
    /// `n_tiles` x `n_tiles` tiles of `tile` x `tile` cells: about 1.75 planes a cell.
    ///
    /// # Errors
    /// A tile with fewer than two cells or more than 1024 on a side; no tile.
    pub fn new(tile: usize, n_tiles: usize) -> Result<Self, BenchError> {
        let layout = layout::recursive_backtracker(tile, tile, SEED).map_err(BenchError::set_up)?;
        if n_tiles == 0 {
            return Err(BenchError::set_up("a maze of no tile"));
        }
        let planes = Arc::new(SortedPlanes::new([]).map_err(BenchError::set_up)?);
        let mut case = Self {
            side: tile * n_tiles,
            tile: layout,
            faces: Vec::new(),
            board: Board::from_planes(&planes),
        };
        for axis in [0, 1] {
            for line in 1..case.n_blocks() {
                case.list_faces(axis, line);
            }
        }
        let planes = SortedPlanes::new(case.planes_in()).map_err(BenchError::set_up)?;
        case.board = Board::from_planes(&Arc::new(planes));
        Ok(case)
    }

    /// Cells along each side.
    pub fn side(&self) -> usize {
        self.side
    }

    /// Faces whose normals point into the maze.
    pub fn faces(&self) -> &[WallFace] {
        &self.faces
    }

    /// The faces as planes.
    pub fn planes_in(&self) -> impl Iterator<Item = Plane> {
        self.faces.iter().map(|face| face.plane)
    }

    /// The faces, sorted.
    pub fn planes(&self) -> &Arc<SortedPlanes> {
        self.board.planes()
    }

    /// The walls as solid rectangles, as long as they go on: what a user would hand to a physics engine.
    pub fn rectangles(&self) -> &[Bounds] {
        self.board.rectangles()
    }

    /// The same walls in every form that an engine takes.
    pub fn board(&self) -> &Board {
        &self.board
    }

    /// Blocks along each side: walls and posts at even places, cells and passages at odd ones.
    fn n_blocks(&self) -> usize {
        2 * self.side + 1
    }

    /// Whether a block is wall.
    pub fn is_wall(&self, i: usize, j: usize) -> bool {
        let (width, height) = (self.tile.width(), self.tile.height());
        match (i % 2, j % 2) {
            (1, 1) => false,
            (0, 1) => i == 0 || !self.tile.is_open_east((i / 2 - 1) % width, j / 2 % height),
            (1, 0) => j == 0 || !self.tile.is_open_north(i / 2 % width, (j / 2 - 1) % height),
            _ => true,
        }
    }

    /// The faces at one line of blocks, each as long as it goes on.
    fn list_faces(&mut self, axis: usize, line: usize) {
        let [plus, minus] =
            if axis == 0 { [Facing::PlusX, Facing::MinusX] } else { [Facing::PlusY, Facing::MinusY] };
        let is_wall = |across: usize, along: usize| {
            if axis == 0 { self.is_wall(across, along) } else { self.is_wall(along, across) }
        };
        let facing_at = |along: usize| match (is_wall(line - 1, along), is_wall(line, along)) {
            (true, false) => Some(plus),
            (false, true) => Some(minus),
            _ => None,
        };
        let mut found = Vec::new();
        let mut run: Option<(Facing, usize)> = None;
        for along in 0..=self.n_blocks() {
            let here = (along < self.n_blocks()).then(|| facing_at(along)).flatten();
            if run.map(|(facing, _)| facing) == here {
                continue;
            }
            if let Some((facing, start)) = run {
                let plane =
                    Plane { facing, offset: line_at(line), start: line_at(start), end: line_at(along) };
                // A wall in front of what comes next hides the corner.
                let front = if facing == plus { line } else { line - 1 };
                let is_corner = [start - 1, along].map(|beyond| !is_wall(front, beyond));
                found.push(WallFace { plane, is_corner });
            }
            run = here.map(|facing| (facing, along));
        }
        self.faces.append(&mut found);
    }

    /// The middle of a cell.
    pub fn centre(&self, column: usize, row: usize) -> Vector2<f64> {
        Vector2::new(column, row).map(|index| line_at(2 * index + 1) + extrude::CORRIDOR / 2.0)
    }

    /// The middle of a cell in the middle of the maze: the same place of the tile in all sizes.
    pub fn middle(&self) -> Vector2<f64> {
        let middle = self.side / self.tile.width() / 2 * self.tile.width() + self.tile.width() / 2;
        self.centre(middle, middle)
    }

    /// The middles of so many cells, far from one another and in an order that no prefetcher guesses.
    pub fn scattered(&self, n: usize) -> Vec<Vector2<f64>> {
        let mut rng = ChaCha8Rng::seed_from_u64(SEED);
        let mut index = || below(&mut rng, self.side);
        (0..n).map(|_| self.centre(index(), index())).collect()
    }

    /// Circles anywhere in free cells that move so far (units) in any direction within 1 s.
    ///
    /// # Errors
    /// A step that is not finite.
    pub fn random(&self, name: &'static str, step: f64, n: usize) -> Result<QuerySet, BenchError> {
        let mut rng = ChaCha8Rng::seed_from_u64(SEED);
        let room = extrude::CORRIDOR / 2.0 - RADIUS;
        let query = |_| {
            let cell = Vector2::from_fn(|_, _| below(&mut rng, self.side));
            let aside = Vector2::from_fn(|_, _| room * (2.0 * unit(&mut rng) - 1.0));
            let (sin, cos) = (unit(&mut rng) * std::f64::consts::TAU).sin_cos();
            let path = Path {
                position: self.centre(cell.x, cell.y) + aside,
                velocity: Vector2::new(cos, sin) * step,
                acceleration: Vector2::zeros(),
            };
            Query::new(path, 1.0)
        };
        Ok(QuerySet { name, queries: (0..n).map(query).collect::<Result<_, _>>()? })
    }

    /// What a ball asks that is rolled tick after tick by the exact engine, from the middle of the maze.
    ///
    /// # Errors
    /// None that this maze and this ball give; the engine's own.
    pub fn coherent(&self, name: &'static str, n: usize) -> Result<QuerySet, BenchError> {
        let (spec, ball) = (spec(), Ball::at(self.middle()));
        let mut engine = Continuous::new(Arc::clone(self.board.planes()), spec, ball, TICK_S)
            .map_err(BenchError::set_up)?;
        let mut queries = Vec::with_capacity(n);
        for acceleration in turning_accelerations().into_iter().cycle().take(n) {
            let before = engine.ball();
            engine.tick(acceleration).map_err(BenchError::set_up)?;
            let after = engine.ball();
            // What only presses the ball onto a wall that it rests on is no motion: the engine does not ask about it.
            let rests = |axis| before.velocity[axis] == 0.0 && before.position[axis] == after.position[axis];
            let moves = |axis, acceleration: f64| if rests(axis) { 0.0 } else { acceleration * spec.rolling };
            let acceleration = Vector2::new(moves(0, acceleration.x), moves(1, acceleration.y));
            let path = Path { position: before.position, velocity: before.velocity, acceleration };
            queries.push(Query::new(path, TICK_S)?);
        }
        Ok(QuerySet { name, queries })
    }
}

/// A ball of [`RADIUS`], else as in the game.
pub fn spec() -> BallSpec {
    let radius = Radius::new(RADIUS).unwrap_or(BallSpec::RADIUS); // the constant is one
    BallSpec { radius, ..BallSpec::default() }
}

/// A acceleration of 1 unit/s² that turns round once in 10 s, tick by tick.
pub fn turning_accelerations() -> Vec<Vector2<f64>> {
    let turn = |tick: u32| f64::from(tick) / f64::from(TICKS_A_TURN) * std::f64::consts::TAU;
    (0..TICKS_A_TURN).map(|tick| Vector2::new(turn(tick).cos(), turn(tick).sin())).collect()
}

/// Coordinate of the k-th line between blocks: even k starts a wall, odd k a corridor.
#[allow(clippy::cast_precision_loss, reason = "counts far below 2^53")]
pub fn line_at(k: usize) -> f64 {
    k.div_ceil(2) as f64 * extrude::WALL_THICKNESS + (k / 2) as f64 * extrude::CORRIDOR
}

/// From 0 to 1.
#[allow(clippy::cast_precision_loss, reason = "53 bits fit")]
fn unit(rng: &mut ChaCha8Rng) -> f64 {
    (rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
}

/// From 0 to `bound`, without it.
#[allow(clippy::cast_possible_truncation, reason = "below the bound, which is a usize")]
fn below(rng: &mut ChaCha8Rng, bound: usize) -> usize {
    ((u128::from(rng.next_u64()) * bound as u128) >> 64) as usize
}

#[cfg(test)]
mod tests {
    use super::*;
    use maze_core::sweep;

    #[test]
    fn the_faces_are_those_of_the_board_and_know_their_corners() {
        let case = Case::new(5, 2).unwrap();
        assert_eq!(case.faces().len(), case.planes().len(), "each as long as it goes on");
        let again = Board::from_rectangles(case.rectangles().to_vec()).unwrap();
        // A maze has no faces towards the outside; the solid around it has four.
        assert_eq!(again.planes().len(), case.planes().len() + 4);
        // A post stands at either side of a corner, or a wall ends at it: two faces meet.
        let ends = case.faces().iter().flat_map(|face| {
            let along = [face.plane.start, face.plane.end].into_iter().zip(face.is_corner);
            along.filter(|(_, is)| *is).map(|(along, _)| face.plane.facing.point(face.plane.offset, along))
        });
        let mut ends: Vec<[u64; 2]> = ends.map(|end| [end.x.to_bits(), end.y.to_bits()]).collect();
        ends.sort_unstable();
        let (pairs, rest) = ends.as_chunks::<2>();
        assert!(!pairs.is_empty() && rest.is_empty() && pairs.iter().all(|[a, b]| a == b));
    }

    #[test]
    fn circles_start_free_and_go_as_far_as_asked() {
        let case = Case::new(8, 1).unwrap();
        let board = Board::from_planes(case.planes());
        for Query { path, until_s, .. } in case.random("", 10.0, 1000).unwrap().queries {
            assert!(board.penetration(path.position, RADIUS) <= 1.0e-12);
            assert!((path.velocity.norm() * until_s - 10.0).abs() < 1.0e-12);
        }
    }

    #[test]
    fn a_rolling_ball_gets_around_and_meets_walls_now_and_then() {
        let case = Case::new(8, 1).unwrap();
        let rolled = case.coherent("", 3000).unwrap().queries;
        let from = rolled[0].path.position;
        assert!(rolled.iter().any(|query| 1.0 < (query.path.position - from).norm()));
        let touches = |query: &&Query| sweep::first_impact(case.planes(), &query.sweep).is_some();
        let n_touches = rolled.iter().filter(touches).count();
        assert!((30..1500).contains(&n_touches), "{n_touches}");
    }
}
