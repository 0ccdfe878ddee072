//! The levels of the game as scenes.

#[path = "../../../assets/levels.rs"]
#[allow(dead_code, reason = "the par is the game's own")]
mod file;

use maze_core::layout::Recipe;

/// Name and recipe of each, in order.
pub(super) fn recipes() -> Result<Vec<(String, Recipe)>, String> {
    Ok(file::levels()?.into_iter().map(|level| (level.name, level.recipe)).collect())
}
