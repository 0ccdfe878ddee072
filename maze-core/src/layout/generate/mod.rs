//! Seeded generators: the same maze for the same seed, on every platform and in every version.

mod backtracker;
mod braid;
mod eller;
mod growing_tree;
mod kruskal;
mod prim;
mod wilson;

pub use backtracker::recursive_backtracker;
pub use eller::{EllerRow, EllerRows};

use super::{Layout, LayoutSizeError, neighbours};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use std::fmt::{Display, Formatter};
use std::str::FromStr;

/// How a maze is made. Every one of them makes a perfect maze: one path between any two cells.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Algorithm {
    /// Depth-first search: long winding corridors, few dead ends.
    #[default]
    Backtracker,
    /// Any perfect maze with the same probability.
    Wilson,
    /// Passages opened at random places: many short dead ends.
    Kruskal,
    /// Spreads from the middle: many short dead ends, a direct solution.
    Prim,
    /// Between the others, by [`Recipe::elitism`] and [`Recipe::river`].
    GrowingTree,
    /// Row by row: the last row at the top has the longest corridors.
    Eller,
}

/// A name that no algorithm has.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no algorithm `{name}`: expected {}", Algorithm::ALL.map(Algorithm::name).join(", "))]
pub struct UnknownAlgorithm {
    /// What was asked for.
    pub name: String,
}

impl Algorithm {
    /// All of them.
    pub const ALL: [Self; 6] =
        [Self::Backtracker, Self::Wilson, Self::Kruskal, Self::Prim, Self::GrowingTree, Self::Eller];

    /// As on the command line and in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Backtracker => "backtracker",
            Self::Wilson => "wilson",
            Self::Kruskal => "kruskal",
            Self::Prim => "prim",
            Self::GrowingTree => "growing-tree",
            Self::Eller => "eller",
        }
    }
}

impl Display for Algorithm {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(self.name())
    }
}

impl FromStr for Algorithm {
    type Err = UnknownAlgorithm;

    fn from_str(name: &str) -> Result<Self, UnknownAlgorithm> {
        let known = Self::ALL.into_iter().find(|algorithm| algorithm.name() == name);
        known.ok_or_else(|| UnknownAlgorithm { name: name.to_owned() })
    }
}

/// All that a generated maze depends on.
///
/// ```
/// use maze_core::layout::{Algorithm, CorridorGraph, Metrics, Recipe};
///
/// let recipe = Recipe { braid: 0.5, ..Recipe::new(12, 9, Algorithm::Kruskal, 7) };
/// let layout = recipe.layout()?;
/// let solution = layout.solution().ok_or("no path")?; // cells, y * width + x
/// let metrics = Metrics::new(&CorridorGraph::of_layout(&layout), solution[0], solution[solution.len() - 1]);
/// println!("{}", metrics.ok_or("no path")?);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Recipe {
    /// Cells along x.
    pub width: usize,
    /// Cells along y.
    pub height: usize,
    /// How it is made.
    pub algorithm: Algorithm,
    /// Which of the mazes that can be made so.
    pub seed: u64,
    /// Probability, 0 to 1, with which a dead end is opened to a random neighbour, so that the maze gets loops. With 1 no
    /// dead end is left (unless the maze is one cell wide).
    pub braid: f64,
    /// 0 to 100, for the growing tree alone: how direct the solution is.
    pub elitism: u8,
    /// 0 to 100, for the growing tree alone: how few and how long the dead ends are.
    pub river: u8,
}

/// What no maze can be made of.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RecipeError {
    /// Too small or too large.
    #[error(transparent)]
    Size(#[from] LayoutSizeError),
    /// Not a probability.
    #[error("braid {0}: expected a probability, 0 to 1")]
    Braid(f64),
    /// Not a percentage.
    #[error("{knob} {value}: expected 0 to 100")]
    Knob {
        /// `elitism` or `river`.
        knob: &'static str,
        /// What it was set to.
        value: u8,
    },
    /// The other algorithms have no such knob.
    #[error("elitism and river are knobs of {}, not of {algorithm}", Algorithm::GrowingTree)]
    NoKnobs {
        /// What was asked for.
        algorithm: Algorithm,
    },
}

impl Recipe {
    /// River where none is given: half of the growth from the newest cell, half from any.
    pub const RIVER: u8 = 50;

    /// With no loops, and knobs as they are when nobody turns them.
    pub fn new(width: usize, height: usize, algorithm: Algorithm, seed: u64) -> Self {
        Self { width, height, algorithm, seed, braid: 0.0, elitism: 0, river: Self::RIVER }
    }

    /// Makes the maze, in time and memory proportional to its cells (Wilson: to the cells times their logarithm, on average).
    ///
    /// # Errors
    /// A size that no layout has, and knobs out of their range or of another algorithm.
    pub fn layout(&self) -> Result<Layout, RecipeError> {
        self.check_knobs()?;
        let Self { width, height, seed, .. } = *self;
        let mut layout = match self.algorithm {
            Algorithm::Backtracker => recursive_backtracker(width, height, seed),
            Algorithm::Wilson => wilson::wilson(width, height, seed),
            Algorithm::Kruskal => kruskal::kruskal(width, height, seed),
            Algorithm::Prim => prim::prim(width, height, seed),
            Algorithm::GrowingTree => {
                growing_tree::growing_tree(width, height, seed, self.elitism, self.river)
            }
            Algorithm::Eller => eller::eller(width, height, seed),
        }?;
        if 0.0 < self.braid {
            braid::braid(&mut layout, self.braid, seed);
        }
        Ok(layout)
    }

    fn check_knobs(&self) -> Result<(), RecipeError> {
        if !(0.0..=1.0).contains(&self.braid) {
            return Err(RecipeError::Braid(self.braid));
        }
        for (knob, value) in [("elitism", self.elitism), ("river", self.river)] {
            if 100 < value {
                return Err(RecipeError::Knob { knob, value });
            }
        }
        let is_turned = (self.elitism, self.river) != (0, Self::RIVER);
        if is_turned && self.algorithm != Algorithm::GrowingTree {
            return Err(RecipeError::NoKnobs { algorithm: self.algorithm });
        }
        Ok(())
    }
}

/// The numbers that a seed stands for.
fn rng(seed: u64) -> ChaCha8Rng {
    ChaCha8Rng::seed_from_u64(seed)
}

/// A number in `0..bound`, 0 when there is none (Lemire's multiply-shift; its bias is below `bound` / 2^32).
///
/// Written out, because a library's own choice from a range may change between its versions and with it every maze.
#[allow(clippy::cast_possible_truncation, reason = "the product's upper half is below `bound`")]
fn below(rng: &mut impl Rng, bound: usize) -> usize {
    ((u64::from(rng.next_u32()) * bound as u64) >> 32) as usize
}

/// True with this probability, to 2^-32.
fn chance(rng: &mut impl Rng, probability: f64) -> bool {
    f64::from(rng.next_u32()) < probability * 4_294_967_296.0
}

/// A random one of the neighbours that have not been visited; `None`, without drawing, when there is none.
fn unvisited_neighbour(layout: &Layout, cell: usize, visited: &[bool], rng: &mut impl Rng) -> Option<usize> {
    let mut unvisited = [0; 4];
    let mut n_unvisited = 0;
    for next in
        neighbours(cell, [layout.width, layout.height]).into_iter().flatten().filter(|next| !visited[*next])
    {
        unvisited[n_unvisited] = next;
        n_unvisited += 1;
    }
    (0 < n_unvisited).then(|| unvisited[below(rng, n_unvisited)])
}

#[cfg(test)]
mod tests;
