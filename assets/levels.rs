//! The reader of levels.toml, for the game and for the cross-check: both compile it in, so that neither depends on the other.

use maze_core::BallKind;
use maze_core::layout::Recipe;
use serde::Deserialize;

/// A level of the game.
#[derive(Clone, Debug)]
pub(crate) struct Level {
    pub(crate) name: String,
    pub(crate) recipe: Recipe,
    /// Time of the autopilot.
    pub(crate) par_ticks: u64,
    /// Material of the ball.
    pub(crate) ball: BallKind,
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
    /// Cells along x and y, such as 14x9.
    size: String,
    algorithm: String,
    seed: u64,
    #[serde(default)]
    braid: f64,
    #[serde(default)]
    elitism: u8,
    river: Option<u8>,
    par_ticks: u64,
    /// Its name.
    ball: String,
}

impl Entry {
    fn level(self) -> Result<Level, String> {
        let in_level = |reason: String| format!("level {}: {reason}", self.name);
        let sides = self.size.split_once('x').and_then(|(x, y)| Some((x.parse().ok()?, y.parse().ok()?)));
        let (width, height) = sides.ok_or_else(|| in_level("size: expected WxH in cells".to_owned()))?;
        let algorithm = self.algorithm.parse().map_err(|error| in_level(format!("{error}")))?;
        let plain = Recipe::new(width, height, algorithm, self.seed);
        let river = self.river.unwrap_or(plain.river);
        let recipe = Recipe { braid: self.braid, elitism: self.elitism, river, ..plain };
        let ball = self.ball.parse().map_err(|error| in_level(format!("ball: {error}")))?;
        Ok(Level { name: self.name, recipe, par_ticks: self.par_ticks, ball })
    }
}

/// Every level, in order.
pub(crate) fn levels() -> Result<Vec<Level>, String> {
    read(include_str!("levels.toml"))
}

/// Those of a text.
pub(crate) fn read(text: &str) -> Result<Vec<Level>, String> {
    let in_file = |reason: String| format!("assets/levels.toml: {reason}");
    let file: File = toml::from_str(text).map_err(|error| in_file(error.to_string()))?;
    file.level.into_iter().map(Entry::level).collect::<Result<_, _>>().map_err(in_file)
}
