//! A maze: everything an engine or a renderer needs.

mod report;

pub use report::{FaceNote, FaceReason, ImportReport};

use crate::assembly::surface::SurfaceMesh;
use crate::layout::Metrics;
use crate::navigation::space::ConfigurationSpace;
use crate::physics::ball::{Ball, BallKind, BallSpec, OutOfRange, Radius};
use crate::physics::bounds::Bounds;
use crate::physics::engine::{Continuous, Published};
use crate::physics::sorted_planes::SortedPlanes;
use crate::physics::sweep::{Sweep, SweepQuery};
use crate::physics::time_of_impact::Path;
use crate::physics::wall::Plane;
use crate::physics::world::World;
use nalgebra::Vector2;
use std::sync::Arc;

/// A maze in maze units, its centre at the origin and its floor at z = 0.
///
/// ```
/// use maze_core::layout::{Algorithm, Recipe};
/// use maze_core::{Engine, Sweep, Tilt};
///
/// let maze = Recipe::new(20, 20, Algorithm::Wilson, 3).maze()?;
/// // The exact engine, with the maze's own ball at the start.
/// let mut engine = maze.exact_engine(0.01)?;
/// for hit in engine.simulate(Tilt::degrees(5.0, 0.0), 10.0)? {
///     println!("after {:.2} s with {:.2} units/s", hit.time_s, hit.normal_speed());
/// }
/// match maze.sweep(maze.start(), maze.goal(), maze.ball_radius.units())? {
///     Sweep::Free => println!("the goal is in sight"),
///     Sweep::Overlaps { wall, depth, .. } => println!("{depth} deep in {wall:?}"),
///     Sweep::Hit { point, normal, .. } => println!("a wall is in the way at {point:?}, its normal {normal:?}"),
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Maze {
    /// Wall faces, the frame around the board included.
    pub planes: Arc<SortedPlanes>,
    /// Where the outer wall is open: the parts of the frame that close it.
    pub openings: Vec<Plane>,
    /// Triangles to draw.
    pub surface: SurfaceMesh,
    /// Bounding box of the walls.
    pub bounds: Bounds,
    /// From the floor to the top of the walls as drawn (units); very high walls are lowered.
    pub wall_height: f64,
    /// Radius of the ball this maze is played with.
    pub ball_radius: Radius,
    /// Its material: the report's until another one is chosen.
    pub ball: BallKind,
    /// What was found in the file that it comes from.
    pub report: ImportReport,
    /// Start, goal and the paths between them: found together, and not to be changed one by one.
    pub(crate) route: Route,
}

/// Start and goal, and where the ball's centre can be.
#[derive(Clone, Debug)]
pub(crate) struct Route {
    pub(crate) start: Vector2<f64>,
    pub(crate) goal: Vector2<f64>,
    pub(crate) goal_radius: f64,
    pub(crate) is_solvable: bool,
    pub(crate) space: Arc<ConfigurationSpace>,
}

impl Maze {
    /// Where the ball's centre starts.
    pub fn start(&self) -> Vector2<f64> {
        self.route.start
    }

    /// Where the ball's centre has to get.
    pub fn goal(&self) -> Vector2<f64> {
        self.route.goal
    }

    /// How near the centre must come to the goal (units).
    pub fn goal_radius(&self) -> f64 {
        self.route.goal_radius
    }

    /// Whether a path leads from start to goal.
    pub fn is_solvable(&self) -> bool {
        self.route.is_solvable
    }

    /// The ball this maze is played with.
    pub fn ball_spec(&self) -> BallSpec {
        self.ball.spec(self.ball_radius)
    }

    /// The walls, the maze's ball and a tick length (s), for any number of balls.
    ///
    /// # Errors
    /// A tick length that [`World::new`] refuses.
    pub fn world(&self, tick_s: f64) -> Result<World, OutOfRange> {
        World::new(Arc::clone(&self.planes), self.ball_spec(), tick_s)
    }

    /// The exact engine, with the maze's ball at rest at the start.
    ///
    /// # Errors
    /// A tick length (s) that [`World::new`] refuses.
    pub fn exact_engine(&self, tick_s: f64) -> Result<Continuous, OutOfRange> {
        Continuous::new(Arc::clone(&self.planes), self.ball_spec(), Ball::at(self.start()), tick_s)
    }

    /// The report's engine, with the maze's ball at rest at the start.
    ///
    /// # Errors
    /// A tick length (s) that [`World::new`] refuses.
    pub fn published_engine(&self, tick_s: f64) -> Result<Published, OutOfRange> {
        Published::new(Arc::clone(&self.planes), self.ball_spec(), Ball::at(self.start()), tick_s)
    }

    /// What a circle of a radius (units) touches first on the straight line between two points; here [`Sweep::Hit`]'s `time_s` is
    /// the fraction of the line, 0 to 1. For curved paths see [`SortedPlanes::sweep`].
    ///
    /// Walls are met from the front: a circle that starts inside a wall, far from its faces, or beyond the board leaves it unhindered.
    /// Ask [`Maze::is_free`] for the start where that matters.
    ///
    /// # Errors
    /// A number that is not finite, a radius that is not greater than 0.
    pub fn sweep(&self, from: Vector2<f64>, to: Vector2<f64>, radius: f64) -> Result<Sweep, OutOfRange> {
        let path = Path { position: from, velocity: to - from, acceleration: Vector2::zeros() };
        Ok(self.planes.sweep(&SweepQuery::new(path, radius, 1.0)?))
    }

    /// Whether a circle of a radius (units) fits at a point: on the board, in no wall, and overlapping none by more than a touch.
    ///
    /// # Errors
    /// A number that is not finite, a radius that is not greater than 0.
    pub fn is_free(&self, point: Vector2<f64>, radius: f64) -> Result<bool, OutOfRange> {
        let sweep = self.sweep(point, point, radius)?;
        let Bounds { low, high } = self.bounds;
        let is_on_board = low.x < point.x && point.x < high.x && low.y < point.y && point.y < high.y;
        Ok(is_on_board && !matches!(sweep, Sweep::Overlaps { .. }) && !self.planes.is_inside_wall(point))
    }

    /// Length of the shortest path from start to goal (corridors), along the axes through the middles of the corridors;
    /// `None` when there is no path.
    pub fn path_length(&self) -> Option<f64> {
        let [start, goal] = self.ends()?;
        Some(self.route.space.distances_from(start).to(goal)).filter(|length| length.is_finite())
    }

    /// Numbers about the corridors; `None` when there is no path, and for a maze that is not one of corridors alone: one with a
    /// room in which the ball can pass to the side has no dead ends and junctions that could be counted. Lengths are between
    /// the middles of stretches of corridor, at most 1 long, between the ends of walls.
    pub fn metrics(&self) -> Option<Metrics> {
        let [start, goal] = self.ends()?;
        let (graph, [start, goal]) = self.route.space.corridors(start, goal)?;
        Metrics::new(&graph, start, goal)
    }

    fn ends(&self) -> Option<[usize; 2]> {
        let Route { start, goal, space, .. } = &self.route;
        Some([space.cell_at(*start)?, space.cell_at(*goal)?])
    }
}

#[cfg(test)]
#[allow(
    clippy::disallowed_methods,
    reason = "the truth that a test compares with may be computed in any way"
)]
mod tests {
    use crate::layout::{Algorithm, CorridorGraph, Metrics, Recipe};
    use crate::{AssembleOptions, Ball, Engine, Maze, Radius, extrude};
    use nalgebra::Vector2;

    #[test]
    fn a_maze_has_the_numbers_of_the_layout_it_was_made_from() {
        let pitch = extrude::CORRIDOR + extrude::WALL_THICKNESS;
        for (algorithm, braid, width, height) in [
            (Algorithm::Backtracker, 0.0, 12, 9),
            (Algorithm::Wilson, 0.0, 7, 15),
            (Algorithm::Kruskal, 1.0, 10, 10),
            (Algorithm::Prim, 0.4, 9, 8),
            (Algorithm::Eller, 0.0, 11, 8),
        ] {
            let recipe = Recipe { braid, ..Recipe::new(width, height, algorithm, 8) };
            let layout = recipe.layout().unwrap();
            let maze = layout.maze(&AssembleOptions::default()).unwrap();
            // Cells are told by where the ball is: the walls' outer corner is the origin of the first one.
            let cell = |point: nalgebra::Vector2<f64>| {
                let from_corner = (point - maze.bounds.low) / pitch;
                let index = |along: f64, n: usize| (0..n).rfind(|i| (*i as f64) < along).unwrap();
                index(from_corner.y, height) * width + index(from_corner.x, width)
            };
            let expected =
                Metrics::new(&CorridorGraph::of_layout(&layout), cell(maze.start()), cell(maze.goal()))
                    .unwrap();
            let metrics = maze.metrics().unwrap();
            let near = |a: f64, b: f64| (a - b).abs() < 1.0e-9 * (1.0 + b);
            assert!(near(metrics.solution_length, pitch * expected.solution_length), "{algorithm}");
            assert!(near(metrics.straightness, pitch * expected.straightness), "{algorithm}");
            assert!(near(metrics.dead_end_length, pitch * expected.dead_end_length), "{algorithm}");
            assert!(near(metrics.directness, expected.directness), "{algorithm}");
            assert!(near(metrics.difficulty, expected.difficulty), "{algorithm}");
            let counts = |metrics: &Metrics| {
                let Metrics {
                    n_turns,
                    n_shortest,
                    is_unique,
                    n_dead_ends,
                    n_junctions,
                    n_crossroads,
                    n_loops,
                    ..
                } = *metrics;
                (n_turns, n_shortest, is_unique, n_dead_ends, n_junctions, n_crossroads, n_loops)
            };
            assert_eq!(counts(&metrics), counts(&expected), "{algorithm}");
            assert!(near(maze.path_length().unwrap(), metrics.solution_length));
        }
    }

    #[test]
    fn a_room_has_a_path_and_no_numbers_about_corridors() {
        // Four walls, and two that part winding corridors from the rest.
        let mut text = String::new();
        let walls = [[0.0, 0.0, 9.0, 1.0], [0.0, 8.0, 9.0, 9.0], [0.0, 1.0, 1.0, 8.0], [8.0, 1.0, 9.0, 8.0]];
        for (n, [x0, y0, x1, y1]) in
            walls.into_iter().chain([[2.0, 1.0, 3.0, 7.0], [4.0, 2.0, 5.0, 8.0]]).enumerate()
        {
            for z in [0, 1] {
                text += &format!("v {x0} {y0} {z}\nv {x1} {y0} {z}\nv {x1} {y1} {z}\nv {x0} {y1} {z}\n");
            }
            for [a, b, c, d] in [[1, 2, 6, 5], [2, 3, 7, 6], [3, 4, 8, 7], [4, 1, 5, 8], [5, 6, 7, 8]] {
                text += &format!("f {} {} {} {}\n", a + 8 * n, b + 8 * n, c + 8 * n, d + 8 * n);
            }
        }
        let mesh = crate::import::obj::read(text.as_bytes()).unwrap();
        let maze = Maze::from_polygons(&mesh, &AssembleOptions::default()).unwrap();
        assert!(maze.path_length().is_some() && maze.metrics().is_none());
    }

    #[test]
    fn a_circle_is_free_in_corridors_alone() {
        let layout = Recipe::new(5, 4, Algorithm::Wilson, 8).layout().unwrap();
        let maze = layout.with_doors_top_and_bottom().maze(&AssembleOptions::default()).unwrap();
        let corner = maze.bounds.low;
        let is_free = |x: f64, y: f64, radius| maze.is_free(corner + Vector2::new(x, y), radius).unwrap();
        // The first cell spans 0.2 to 1.2, its walls and the post at its lower left corner 0 to 0.2.
        assert!(is_free(0.7, 0.7, 0.5) && !is_free(0.7, 0.7, 0.501));
        assert!(!is_free(0.1, 0.1, 0.01), "inside of a wall, far from its faces");
        assert!(!is_free(-3.0, -3.0, 0.1), "beyond the board");
        for value in [f64::NAN, f64::INFINITY] {
            assert!(maze.is_free(Vector2::new(value, 0.0), 0.1).is_err());
            assert!(maze.is_free(Vector2::zeros(), value).is_err());
            assert!(maze.sweep(maze.start(), Vector2::new(0.0, value), 0.1).is_err());
        }
        assert!(
            maze.is_free(Vector2::zeros(), 0.0).is_err() && maze.is_free(Vector2::zeros(), -1.0).is_err()
        );
    }

    #[test]
    fn what_is_free_is_what_the_blocks_of_the_layout_leave() {
        for seed in 0..40 {
            let layout = Recipe::new(6, 5, Algorithm::Wilson, seed).layout().unwrap();
            let maze = layout.maze(&AssembleOptions::default()).unwrap();
            let blocks = crate::Blocks::of_layout(&layout);
            let lines =
                |n: usize| (0..=n).map(|k| extrude::line(k) - extrude::line(n) / 2.0).collect::<Vec<_>>();
            let (xs, ys) = (lines(blocks.width()), lines(blocks.height()));
            // On a grid that meets corners and faces, a little off them, and in between.
            let samples = |lines: &[f64]| {
                let near = |x: &f64| [-0.07, -1.0e-4, 0.0, 1.0e-9, 1.0e-3, 0.051].map(|by| x + by);
                lines.iter().flat_map(near).collect::<Vec<_>>()
            };
            let radius = 0.05;
            for (x, y) in samples(&xs).into_iter().flat_map(|x| samples(&ys).into_iter().map(move |y| (x, y)))
            {
                // The distance to the nearest wall block, by all of them.
                let mut nearest = f64::INFINITY;
                for (i, j) in (0..blocks.width()).flat_map(|i| (0..blocks.height()).map(move |j| (i, j))) {
                    if blocks.is_wall(i, j) {
                        let dx = x.clamp(xs[i], xs[i + 1]) - x;
                        let dy = y.clamp(ys[j], ys[j + 1]) - y;
                        nearest = nearest.min((dx * dx + dy * dy).sqrt());
                    }
                }
                let is_on_board = xs[0] < x && x < xs[xs.len() - 1] && ys[0] < y && y < ys[ys.len() - 1];
                if (nearest - radius).abs() < 1.0e-8 {
                    continue;
                }
                let expected = is_on_board && radius < nearest;
                let found = maze.is_free(Vector2::new(x, y), radius).unwrap();
                assert_eq!(found, expected, "seed {seed}: {x} {y}, {nearest} from the nearest wall");
            }
        }
    }

    #[test]
    fn its_engines_play_with_its_own_ball() {
        let layout = Recipe::new(5, 4, Algorithm::Wilson, 8).layout().unwrap();
        let options = AssembleOptions { ball_radius: Radius::new(0.2).ok(), ..AssembleOptions::default() };
        let maze = layout.maze(&options).unwrap();
        for engine in
            [&maze.exact_engine(0.02).unwrap() as &dyn Engine, &maze.published_engine(0.02).unwrap()]
        {
            assert_eq!((engine.spec().radius.units(), engine.tick_s()), (0.2, 0.02));
            assert_eq!(engine.ball(), Ball::at(maze.start()));
        }
        assert!(maze.exact_engine(0.0).is_err());
    }
}
