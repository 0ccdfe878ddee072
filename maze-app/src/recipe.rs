//! How a random maze is made, as stated on the command line.

use clap::Args;
use maze_core::layout::{Algorithm, Recipe};
use std::time::{SystemTime, UNIX_EPOCH};

/// What a random maze is like.
#[derive(Args, Clone, Debug)]
pub(crate) struct RecipeArguments {
    /// Cells of a random maze [default: 14x9]
    #[arg(long, value_name = "WxH", value_parser = parse_grid_size, allow_hyphen_values = true)]
    size: Option<GridSize>,
    /// The same seed gives the same maze [default: a new one]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    seed: Option<u64>,
    /// How it is made: backtracker, wilson, kruskal, prim, growing-tree or eller [default: backtracker; growing-tree with
    /// --elitism or --river]
    #[arg(long, value_name = "NAME", value_parser = parse_algorithm)]
    algorithm: Option<Algorithm>,
    /// Open dead ends with this probability, 0 to 1, so that there are loops
    #[arg(long, value_name = "P", value_parser = parse_probability, default_value = "0", allow_negative_numbers = true)]
    braid: f64,
    /// How direct the solution is, 0 to 100 (growing-tree) [default: 0]
    #[arg(long, value_name = "E", value_parser = parse_percentage, allow_negative_numbers = true)]
    elitism: Option<u8>,
    /// How few and how long the dead ends are, 0 to 100 (growing-tree) [default: 50]
    #[arg(long, value_name = "R", value_parser = parse_percentage, allow_negative_numbers = true)]
    river: Option<u8>,
}

/// The names of its arguments, for what they conflict with.
pub(crate) const RECIPE_ARGUMENTS: [&str; 6] = ["size", "seed", "algorithm", "braid", "elitism", "river"];

impl RecipeArguments {
    /// Whether any of them was given.
    pub(crate) fn is_given(&self) -> bool {
        let Self { size, seed, algorithm, braid, elitism, river } = self;
        let is_knob = elitism.is_some() || river.is_some() || *braid != 0.0;
        size.is_some() || seed.is_some() || algorithm.is_some() || is_knob
    }

    /// Chooses a seed where none was given.
    pub(crate) fn recipe(&self) -> Recipe {
        let size = self.size.unwrap_or(GridSize::DEFAULT);
        let has_knobs = self.elitism.is_some() || self.river.is_some();
        let usual = if has_knobs { Algorithm::GrowingTree } else { Algorithm::default() };
        let algorithm = self.algorithm.unwrap_or(usual);
        let recipe = Recipe::new(size.width, size.height, algorithm, self.seed.unwrap_or_else(fresh_seed));
        Recipe {
            braid: self.braid,
            elitism: self.elitism.unwrap_or(recipe.elitism),
            river: self.river.unwrap_or(recipe.river),
            ..recipe
        }
    }
}

/// The arguments that give this recipe again on the command line.
pub(crate) fn words(recipe: &Recipe) -> Vec<String> {
    let Recipe { width, height, algorithm, seed, braid, elitism, river } = *recipe;
    let mut words = vec![
        format!("--size={width}x{height}"),
        format!("--algorithm={algorithm}"),
        format!("--seed={seed}"),
    ];
    words.extend((braid != 0.0).then(|| format!("--braid={braid}")));
    words.extend((elitism != 0).then(|| format!("--elitism={elitism}")));
    words.extend((river != Recipe::RIVER).then(|| format!("--river={river}")));
    words
}

/// A random seed; short enough to read out.
pub(crate) fn fresh_seed() -> u64 {
    let since = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
    (since.as_secs() ^ u64::from(since.subsec_nanos())) % 1_000_000
}

/// Another one, by Knuth's MMIX generator.
pub(crate) fn next_seed(seed: u64) -> u64 {
    let next = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (next >> 33) % 1_000_000
}

/// Cells along x and y.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct GridSize {
    pub(crate) width: usize,
    pub(crate) height: usize,
}

impl GridSize {
    /// A maze of a few minutes that fits a wide window.
    pub(crate) const DEFAULT: Self = Self { width: 14, height: 9 };
}

/// `WxH`: two whole numbers.
fn parse_pair<N: std::str::FromStr>(text: &str) -> Option<[N; 2]> {
    let (width, height) = text.split_once(['x', 'X'])?;
    Some([width.parse().ok()?, height.parse().ok()?])
}

pub(crate) fn parse_grid_size(text: &str) -> Result<GridSize, String> {
    let [width, height] = parse_pair(text).ok_or("expected WxH in cells, such as 14x9")?;
    Ok(GridSize { width, height })
}

pub(crate) fn parse_pixel_size(text: &str) -> Result<[u32; 2], String> {
    let size = parse_pair(text).ok_or("expected WxH in pixels, such as 1280x720")?;
    if size.contains(&0) { Err("expected at least 1x1 pixels".to_owned()) } else { Ok(size) }
}

fn parse_algorithm(text: &str) -> Result<Algorithm, String> {
    text.parse().map_err(|_| format!("expected {}", Algorithm::ALL.map(Algorithm::name).join(", ")))
}

fn parse_probability(text: &str) -> Result<f64, String> {
    let probability = text.parse().ok().filter(|probability| (0.0..=1.0).contains(probability));
    probability.ok_or_else(|| "expected a probability, 0 to 1".to_owned())
}

fn parse_percentage(text: &str) -> Result<u8, String> {
    let percentage = text.parse().ok().filter(|percentage| *percentage <= 100);
    percentage.ok_or_else(|| "expected a whole number, 0 to 100".to_owned())
}
