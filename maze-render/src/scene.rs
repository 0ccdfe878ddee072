//! What one frame shows: plain data, built by the application from the game's state.

use nalgebra::UnitQuaternion;

use crate::Camera;

/// One frame, complete: the renderer keeps nothing between frames but the maze's mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scene {
    /// Where the eye is.
    pub camera: Camera,
    /// How the maze is tilted; turns about the board's centre.
    pub world_from_maze: UnitQuaternion<f32>,
    /// The ball.
    pub ball: BallView,
    /// Where the run began: a thin blue ring with a dot.
    pub start: Marker,
    /// Where the run ends: gold and green rings, a target.
    pub goal: Marker,
    /// How brightly the goal shines, from 0 (painted) to 1 (lit); pulse it to draw the eye.
    pub goal_glow: f32,
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

/// A round mark on the floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Marker {
    /// Centre, maze frame.
    pub position: [f32; 2],
    /// Outer radius in maze units; zero or less hides the mark.
    pub radius: f32,
}
