//! The game's time stands.

use super::{Choice, Screen};
use crate::ui::menu::{item, text};
use egui::Ui;

pub(super) fn show(ui: &mut Ui) -> Option<Choice> {
    let mut choice = None;
    for (name, help, then) in [
        ("Resume", "The ball goes on as it was.", Choice::Resume),
        ("Restart", "Ball to the start, clock to zero.", Choice::Restart),
        ("Settings", "", Choice::Show(Screen::Settings)),
        ("Quit to title", "The run waits there under Continue.", Choice::ToTitle),
        ("Quit the game", "", Choice::Quit),
    ] {
        if item(ui, name, "", help) {
            choice = Some(then);
        }
    }
    choice
}

/// A run in progress would be lost.
pub(super) fn leave(ui: &mut Ui, then: Option<Choice>) -> Option<Choice> {
    text(ui, "The clock is running; another maze would end this run.");
    let mut choice = None;
    if item(ui, "Keep playing", "", "") {
        choice = Some(Choice::Resume);
    }
    if item(ui, "Leave", "", "") {
        choice = then;
    }
    choice
}
