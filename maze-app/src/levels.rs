//! The levels that come with the game: assets/levels.toml, in the binary.

#[path = "../../assets/levels.rs"]
mod file;

pub(crate) use file::Level;

use crate::failure::Failure;

/// How many there are; a test counts them.
pub(crate) const N_LEVELS: usize = 14;

/// Of the flag that chooses one.
pub(crate) const HELP: &str = "A level of the game, 1 (gentle) to 14 (hard)";

/// A level by its number, the first one is 1.
pub(crate) fn level(number: usize) -> Result<Level, Failure> {
    let levels = file::levels().map_err(Failure::bad_input)?;
    let level = number.checked_sub(1).and_then(|index| levels.into_iter().nth(index));
    level.ok_or_else(|| Failure::bad_input(format!("assets/levels.toml: no level {number}")))
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
    fn a_level_of_an_unknown_ball_is_refused_by_its_name() {
        let text =
            "[[level]]\nname = 'Odd'\nsize = '4x3'\nalgorithm = 'prim'\nseed = 1\npar_ticks = 9\nball = ";
        assert_eq!(file::read(&format!("{text}'steel'")).unwrap()[0].ball, maze_core::BallKind::Steel);
        let error = file::read(&format!("{text}'glass'")).unwrap_err();
        assert_eq!(error, "assets/levels.toml: level Odd: ball: expected report or steel");
    }

    #[test]
    fn every_level_can_be_loaded_and_each_is_about_as_hard_as_the_one_before_or_harder() {
        assert_eq!(file::levels().unwrap().len(), N_LEVELS);
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
