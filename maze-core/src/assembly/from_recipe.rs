//! Recipe -> Maze.

use crate::assembly::assemble::AssembleOptions;
use crate::assembly::error::AssembleError;
use crate::layout::{Recipe, RecipeError};
use crate::maze::Maze;

/// Why a recipe gives no maze.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GenerateError {
    /// No layout.
    #[error(transparent)]
    Recipe(#[from] RecipeError),
    /// The layout makes no maze.
    #[error(transparent)]
    Assemble(#[from] AssembleError),
}

impl Recipe {
    /// Makes the maze of [`Recipe::layout`], with the usual ball. For another ball, or a start and goal of your own, see
    /// [`crate::Layout::maze`].
    ///
    /// # Errors
    /// What [`Recipe::layout`] refuses.
    pub fn maze(&self) -> Result<Maze, GenerateError> {
        Ok(self.layout()?.maze(&AssembleOptions::default())?)
    }
}
