//! The physics and the maze of a tilt-the-maze ball game.
pub mod surface;
