//! A maze: everything an engine or a renderer needs.

use crate::assembly::polygons::UpAxis;
use crate::assembly::surface::SurfaceMesh;
use crate::layout::Metrics;
use crate::navigation::reach::Reach;
use crate::physics::ball::Radius;
use crate::physics::sorted_planes::SortedPlanes;
use crate::physics::wall::Plane;
use nalgebra::Vector2;
use std::sync::Arc;

/// An axis-aligned rectangle in the maze plane (units).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Lower left corner.
    pub low: Vector2<f64>,
    /// Upper right corner.
    pub high: Vector2<f64>,
}

impl Bounds {
    /// Width and depth.
    pub fn size(&self) -> Vector2<f64> {
        self.high - self.low
    }
}

/// Faces of a file that the maze does not use, or not as they are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaceNote {
    /// Why, or how else, in words.
    pub reason: &'static str,
    /// How many.
    pub n_faces: usize,
    /// Their part of the area of all faces, 0..=1.
    pub area_part: f64,
    /// Whether they are drawn although the ball never meets them, which a player has to know.
    pub is_unmet: bool,
}

/// A maze in maze units, its centre at the origin and its floor at z = 0.
#[derive(Clone, Debug)]
pub struct Maze {
    /// Wall faces, the frame around the board included.
    pub planes: Arc<SortedPlanes>,
    /// Where the outer wall is open: the parts of the frame that close it.
    pub openings: Vec<Plane>,
    /// Triangles to draw.
    pub surface: SurfaceMesh,
    /// Of the walls.
    pub bounds: Bounds,
    /// From the floor to the top of the walls as drawn (units); very high walls are lowered.
    pub wall_height: f64,
    /// The ball this maze is played with.
    pub ball_radius: Radius,
    /// The largest ball, in corridors and steps of 0.01 and with 0.01 to spare, for which a path leads from start to goal, where there is none for the one
    /// that was asked for, or for the usual one. The maze is played with it unless another one was asked for.
    pub passing_radius: Option<Radius>,
    /// Where the ball's centre starts.
    pub start: Vector2<f64>,
    /// Where it has to get.
    pub goal: Vector2<f64>,
    /// How near the centre must come to `goal`.
    pub goal_radius: f64,
    /// Whether a way leads from start to goal.
    pub solvable: bool,
    /// Where the ball's centre can be.
    pub(crate) reach: Arc<Reach>,
    /// Which axis of the file points out of the board.
    pub up_axis: UpAxis,
    /// Maze units in a unit of the file.
    pub scale: f64,
    /// Whether the file has a floor; else one was laid.
    pub has_floor: bool,
    /// Where the walls' x axis points in the file, across its up axis, before they were turned back; unit length, (1, 0)
    /// when they were not turned.
    pub turned: Vector2<f64>,
    /// Faces that were not used, and why.
    pub ignored: Vec<FaceNote>,
    /// Faces that were used otherwise than they are, and how.
    pub adjusted: Vec<FaceNote>,
    /// Wall coordinates nearer than this (units) were noise and became one.
    pub merged_within: Option<f64>,
    /// Walls of the file without thickness were made this thick (units).
    pub thickened_to: Option<f64>,
    /// Part of the plan, 0..=1, on which a face is missing in the file and the other sides decided what is wall.
    pub doubtful_part: f64,
}

impl Maze {
    /// Length of the shortest way from start to goal (corridors), along the axes through the middles of the corridors;
    /// `None` when there is no way.
    pub fn way_length(&self) -> Option<f64> {
        let [start, goal] = self.ends()?;
        Some(self.reach.distances_from(start).to(goal)).filter(|length| length.is_finite())
    }

    /// Numbers about the corridors; `None` when there is no way, and for a maze that is not one of corridors alone: one with a
    /// room in which the ball can pass to the side has no dead ends and junctions that could be counted. Lengths are between
    /// the middles of stretches of corridor, at most 1 long, between the ends of walls.
    pub fn metrics(&self) -> Option<Metrics> {
        let [start, goal] = self.ends()?;
        let (ways, [start, goal]) = self.reach.ways(start, goal)?;
        Metrics::new(&ways, start, goal)
    }

    fn ends(&self) -> Option<[usize; 2]> {
        Some([self.reach.cell_at(self.start)?, self.reach.cell_at(self.goal)?])
    }
}

#[cfg(test)]
mod tests {
    use crate::layout::{Algorithm, Metrics, Recipe, Ways};
    use crate::{AssembleOptions, Maze, extrude};

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
            let maze = Maze::from_polygons(&extrude::extrude(&layout), &AssembleOptions::default()).unwrap();
            // Cells are told by where the ball is: the walls' outer corner is the origin of the first one.
            let cell = |point: nalgebra::Vector2<f64>| {
                let from_corner = (point - maze.bounds.low) / pitch;
                let index = |along: f64, n: usize| (0..n).rfind(|i| (*i as f64) < along).unwrap();
                index(from_corner.y, height) * width + index(from_corner.x, width)
            };
            let expected =
                Metrics::new(&Ways::of_layout(&layout), cell(maze.start), cell(maze.goal)).unwrap();
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
            assert!(near(maze.way_length().unwrap(), metrics.solution_length));
        }
    }

    #[test]
    fn a_room_has_a_way_and_no_numbers_about_corridors() {
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
        assert!(maze.way_length().is_some() && maze.metrics().is_none());
    }
}
