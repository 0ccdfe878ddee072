//! The levels as pictures.

use super::{Choice, Facts, Start};
use crate::ui::clock_text;
use crate::ui::menu::{self, Plan, card};
use egui::Ui;

/// A level as the grid shows it.
#[derive(Clone, Debug)]
pub(crate) struct LevelCard {
    pub(crate) name: String,
    pub(crate) par_s: f64,
    pub(crate) plan: Plan,
}

/// Width of a picture where there is room (points).
const CARD: f32 = 132.0;

pub(super) fn show(ui: &mut Ui, facts: &Facts<'_>, looked_at: &mut Option<usize>) -> Option<Choice> {
    let mut choice = None;
    let room = ui.available_width() + ui.spacing().item_spacing.x;
    let n_columns = (room / (CARD + 8.0)).floor().max(1.0);
    let width = room / n_columns - ui.spacing().item_spacing.x - 1.0;
    ui.horizontal_wrapped(|ui| {
        for (number, level) in (1..).zip(facts.levels) {
            let response = card(ui, &level.plan, &format!("{number}  {}", level.name), width);
            if response.clicked() {
                choice = Some(Choice::Play(Start::Level(number)));
            } else if response.has_focus() && *looked_at != Some(number) {
                *looked_at = Some(number);
                choice = Some(Choice::Look(Start::Level(number)));
            }
        }
    });
    let looked_at = looked_at.and_then(|number| facts.levels.get(number - 1));
    if let Some(level) = looked_at {
        menu::text(ui, &format!("{}   par {}", level.name, clock_text(level.par_s)));
    }
    choice
}
