//! The levels that come with the game: assets/levels.toml, in the binary.

use crate::failure::Failure;
use crate::recipe;
use maze_core::layout::Recipe;
use serde::Deserialize;

const LEVELS: &str = include_str!("../../assets/levels.toml");

/// How many there are; a test counts them.
pub(crate) const N_LEVELS: usize = 14;

/// Of the flag that chooses one.
pub(crate) const HELP: &str = "A level of the game, 1 (gentle) to 14 (hard)";

/// One of them.
#[derive(Clone, Debug)]
pub(crate) struct Level {
    pub(crate) name: String,
    pub(crate) recipe: Recipe,
    /// Time of the autopilot.
    pub(crate) par_ticks: u64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    level: Vec<Entry>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    name: String,
    size: String,
    algorithm: String,
    seed: u64,
    #[serde(default)]
    braid: f64,
    #[serde(default)]
    elitism: u8,
    river: Option<u8>,
    par_ticks: u64,
}

impl Entry {
    fn level(self) -> Result<Level, String> {
        let size = recipe::parse_grid_size(&self.size)?;
        let algorithm = self.algorithm.parse().map_err(|error| format!("{error}"))?;
        let plain = Recipe::new(size.width, size.height, algorithm, self.seed);
        let river = self.river.unwrap_or(plain.river);
        let recipe = Recipe { braid: self.braid, elitism: self.elitism, river, ..plain };
        Ok(Level { name: self.name, recipe, par_ticks: self.par_ticks })
    }
}

/// A level by its number, the first one is 1.
pub(crate) fn level(number: usize) -> Result<Level, Failure> {
    let in_levels = |reason: String| Failure::bad_input(format!("assets/levels.toml: {reason}"));
    let file: File = toml::from_str(LEVELS).map_err(|error| in_levels(error.to_string()))?;
    let entry = number.checked_sub(1).and_then(|index| file.level.into_iter().nth(index));
    entry.ok_or_else(|| in_levels(format!("no level {number}")))?.level().map_err(in_levels)
}

/// A number on the command line.
pub(crate) fn parse_level(text: &str) -> Result<usize, String> {
    let number = text.parse().ok().filter(|number| (1..=N_LEVELS).contains(number));
    number.ok_or_else(|| format!("expected 1 to {N_LEVELS}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::ReadArguments;

    #[test]
    fn every_level_can_be_loaded_and_each_is_about_as_hard_as_the_one_before_or_harder() {
        let file: File = toml::from_str(LEVELS).unwrap();
        assert_eq!(file.level.len(), N_LEVELS);
        assert!(HELP.contains(&format!("to {N_LEVELS} ")));
        let mut difficulties = Vec::new();
        for number in 1..=N_LEVELS {
            let level = level(number).unwrap();
            let maze = ReadArguments::default().generate(&level.recipe).unwrap();
            difficulties.push(maze.metrics().unwrap().difficulty);
        }
        assert!(difficulties.is_sorted(), "{difficulties:?}");
        assert!(10.0 * difficulties[0] < difficulties[N_LEVELS - 1], "{difficulties:?}");
    }
}
