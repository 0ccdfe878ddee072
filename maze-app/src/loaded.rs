//! A maze, and how its file was read.

use maze_core::Maze;

/// A maze, and how its file was read.
pub(crate) struct Loaded {
    pub(crate) maze: Maze,
    /// In words, where the kind of file has something to say.
    pub(crate) found: Option<String>,
}

impl From<Maze> for Loaded {
    fn from(maze: Maze) -> Self {
        Self { maze, found: None }
    }
}
