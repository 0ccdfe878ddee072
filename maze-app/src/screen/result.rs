//! The goal is reached.

use super::Choice;
use crate::ui::menu::{item, text};
use crate::ui::{GOLD, clock_text};
use egui::{FontId, RichText, Ui};

/// What a run came to.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Outcome {
    pub(crate) time_s: f64,
    pub(crate) par_s: Option<f64>,
    /// The best time before this one.
    pub(crate) best_s: Option<f64>,
    /// Below 100 where the game was played slower.
    pub(crate) speed_percent: u32,
    /// What comes next, if anything.
    pub(crate) next: Option<String>,
    /// Times of all levels, after the last one.
    pub(crate) total_s: Option<f64>,
    pub(crate) saved: Option<String>,
}

impl Outcome {
    /// Whether Enter is for trying again.
    fn is_slower(&self) -> bool {
        self.best_s.is_some_and(|best| best < self.time_s)
    }
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

fn difference(seconds: f64) -> String {
    let sign = if seconds < 0.0 { '-' } else { '+' };
    format!("{sign}{}", clock_text(seconds.abs()))
}

pub(super) fn show(ui: &mut Ui, outcome: &Outcome) -> Option<Choice> {
    ui.label(RichText::new(clock_text(outcome.time_s)).font(FontId::monospace(38.0)));
    if let Some(par) = outcome.par_s {
        let words = if outcome.time_s < par { "under par" } else { "par" };
        text(ui, &format!("{words} {}   ({})", clock_text(par), difference(outcome.time_s - par)));
    }
    match outcome.best_s {
        Some(best) => {
            text(ui, &format!("best so far {}   ({})", clock_text(best), difference(outcome.time_s - best)))
        }
        None => text(ui, "your first time here"),
    }
    if outcome.speed_percent < 100 {
        text(ui, &format!("played at {} % of the speed", outcome.speed_percent));
    }
    if let Some(total) = outcome.total_s {
        ui.label(
            RichText::new(format!("That was the last level. All of them: {}", clock_text(total))).color(GOLD),
        );
    }
    ui.add_space(6.0);
    let again = ("Again".to_owned(), Choice::Restart);
    let next = outcome.next.clone().map(|next| (capitalised(&next), Choice::Next));
    let mut lines =
        if outcome.is_slower() { vec![again] } else { next.clone().into_iter().chain([again]).collect() };
    if outcome.is_slower() {
        lines.extend(next);
    }
    let mut choice = None;
    for (name, then) in lines {
        if item(ui, &name, "", "") {
            choice = Some(then);
        }
    }
    if item(
        ui,
        "Save the recording",
        outcome.saved.as_deref().unwrap_or(""),
        "A file for maze-app replay, in the working directory.",
    ) {
        choice = Some(Choice::SaveRecording);
    }
    if item(ui, "Title", "", "") {
        choice = Some(Choice::ToTitle);
    }
    choice
}
