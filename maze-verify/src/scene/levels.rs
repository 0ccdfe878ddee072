//! The levels of the game as scenes.

use maze_core::layout::Recipe;
use serde::Deserialize;

const LEVELS: &str = include_str!("../../../assets/levels.toml");

/// What the file holds; the par is the game's own.
#[derive(Deserialize)]
struct File {
    level: Vec<Level>,
}

#[derive(Deserialize)]
struct Level {
    name: String,
    size: String,
    algorithm: String,
    seed: u64,
    #[serde(default)]
    braid: f64,
    #[serde(default)]
    elitism: u8,
    river: Option<u8>,
}

/// Name and recipe of each, in order; empty when the file that was compiled in is damaged, which a test rules out.
pub(super) fn recipes() -> Vec<(String, Recipe)> {
    let file: File = toml::from_str(LEVELS).unwrap_or(File { level: Vec::new() });
    let recipe = |level: Level| {
        let (width, height) = level.size.split_once('x')?;
        let algorithm = level.algorithm.parse().ok()?;
        let plain = Recipe::new(width.parse().ok()?, height.parse().ok()?, algorithm, level.seed);
        let river = level.river.unwrap_or(plain.river);
        Some((level.name, Recipe { braid: level.braid, elitism: level.elitism, river, ..plain }))
    };
    file.level.into_iter().filter_map(recipe).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_level_of_the_game_is_read() {
        assert_eq!(recipes().len(), LEVELS.matches("[[level]]").count());
        assert!(recipes().iter().any(|(_, recipe)| recipe.braid != 0.0));
    }
}
