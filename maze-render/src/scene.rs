//! What one frame shows: plain data, built by the application from the game's state.

use nalgebra::UnitQuaternion;

use crate::Camera;

/// One frame, complete: the renderer keeps nothing between frames but the maze's mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Where the eye is.
    pub camera: Camera,
    /// How the maze is tilted; turns about the board's centre.
    pub world_from_maze: UnitQuaternion<f32>,
    /// Without it the ball and its lines and patches stand alone above the table.
    pub shows_maze: bool,
    /// The ball.
    pub ball: BallView,
    /// Another ball beside it, as of tinted glass; throws no shadow.
    pub ghost: Option<GhostView>,
    /// Where the run began: a thin blue ring with a dot.
    pub start: Marker,
    /// Where the run ends: gold and green rings, a target.
    pub goal: Marker,
    /// How brightly the goal shines, from 0 (painted) to 1 (lit); pulse it to draw the eye.
    pub goal_glow: f32,
    /// Drawn over everything, in this order, above the patches: also over walls between them and the eye, since a plane, a
    /// contact or the ball's acceleration is visible where it is, whatever the tilt.
    pub lines: Vec<Line>,
    /// Drawn over everything but the lines, in this order.
    pub patches: Vec<Patch>,
}

/// A straight line of even width.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// One end, maze frame.
    pub from: [f32; 3],
    /// The other.
    pub to: [f32; 3],
    /// Pixels.
    pub width: f32,
    /// sRGB, and how much it covers.
    pub colour: [u8; 4],
}

/// A flat, convex piece with four corners.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patch {
    /// In order around it, maze frame.
    pub corners: [[f32; 3]; 4],
    /// sRGB, and how much it covers.
    pub colour: [u8; 4],
}

/// The ball as drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallView {
    /// Centre, maze frame.
    pub position: [f32; 3],
    /// Radius in maze units; zero or less hides the ball.
    pub radius: f32,
    /// How far the ball has rolled: maze from ball, turns the pattern into the maze frame.
    pub rotation: UnitQuaternion<f32>,
}

/// A translucent ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GhostView {
    /// Centre, maze frame.
    pub position: [f32; 3],
    /// Radius in maze units; zero or less hides the ghost.
    pub radius: f32,
}

/// A round mark on the floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Marker {
    /// Centre, maze frame.
    pub position: [f32; 2],
    /// Outer radius in maze units; zero or less hides the mark.
    pub radius: f32,
}
