//! A random maze by its recipe; the board shows it while it is chosen.

use super::{Choice, Start};
use crate::recipe::next_seed;
use crate::ui::menu::{choose, item, line, number};
use egui::Ui;
use maze_core::layout::{Algorithm, Recipe};

/// Cells on a side.
const SIDES: std::ops::RangeInclusive<usize> = 2..=40;

#[derive(Clone, Debug)]
pub(crate) struct RandomForm {
    pub(crate) recipe: Recipe,
    seed: String,
    /// What the board shows.
    shown: Option<Recipe>,
}

impl RandomForm {
    pub(super) fn new(seed: u64) -> Self {
        let recipe = Recipe::new(14, 9, Algorithm::default(), seed);
        Self { recipe, seed: seed.to_string(), shown: None }
    }
}

pub(super) fn show(ui: &mut Ui, form: &mut RandomForm) -> Option<Choice> {
    let mut choice = None;
    let recipe = &mut form.recipe;
    if item(ui, "Play", "", "Roll the ball from the ring to the goal.") {
        choice = Some(Choice::Play(Start::Random(*recipe)));
    }
    if item(ui, "Another seed", &form.seed, "A new maze of the same kind.") {
        recipe.seed = next_seed(recipe.seed);
        form.seed = recipe.seed.to_string();
    }
    number(ui, "Width", "Cells from left to right.", &mut recipe.width, SIDES, 1.0);
    number(ui, "Depth", "Cells from front to back.", &mut recipe.height, SIDES, 1.0);
    let algorithms = Algorithm::ALL.map(|algorithm| (algorithm, algorithm.name().to_owned()));
    choose(
        ui,
        "Algorithm",
        "How it is made; each has a style of its own.",
        &algorithms,
        &mut recipe.algorithm,
    );
    number(
        ui,
        "Braid",
        "Fraction of the dead ends that are opened, so that there are loops.",
        &mut recipe.braid,
        0.0..=1.0,
        0.05,
    );
    if recipe.algorithm == Algorithm::GrowingTree {
        number(ui, "Elitism", "How direct the solution is.", &mut recipe.elitism, 0..=100, 1.0);
        number(ui, "River", "How few and how long the dead ends are.", &mut recipe.river, 0..=100, 1.0);
    }
    line(ui, "Seed", "The same seed gives the same maze, everywhere.", &mut form.seed);
    form.seed.retain(|letter| letter.is_ascii_digit());
    form.seed.truncate(18);
    if let Ok(seed) = form.seed.parse() {
        recipe.seed = seed;
    }
    if choice.is_none() && form.shown != Some(*recipe) {
        form.shown = Some(*recipe);
        choice = Some(Choice::Look(Start::Random(*recipe)));
    }
    choice
}
