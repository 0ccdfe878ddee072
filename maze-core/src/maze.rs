//! A maze: everything an engine or a renderer needs.

use crate::ball::Radius;
use crate::plane::Plane;
use crate::polygons::UpAxis;
use crate::reach::Reach;
use crate::sorted_planes::SortedPlanes;
use crate::surface::SurfaceMesh;
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

/// How far from a wished start or goal the ball may be put (units): where a corridor is several blocks wide, the ball's
/// centre does not get to the middle of the blocks beside a wall.
const MAX_SHIFT: f64 = 0.5;

impl Maze {
    /// The same maze from another start to another goal (units), each the nearest place to the wished one where the ball
    /// fits.
    ///
    /// # Errors
    /// 0 when the ball fits nowhere near the start, 1 when it does not near the goal.
    pub(crate) fn with_ends(mut self, start: Vector2<f64>, goal: Vector2<f64>) -> Result<Self, usize> {
        let (from, start) = self.reach.nearest(start, MAX_SHIFT).ok_or(0_usize)?;
        let (to, goal) = self.reach.nearest(goal, MAX_SHIFT).ok_or(1_usize)?;
        self.solvable = self.reach.distances_from(from).to(to).is_finite();
        (self.start, self.goal) = (start, goal);
        Ok(self)
    }
}
