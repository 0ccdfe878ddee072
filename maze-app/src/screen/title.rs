//! What the game begins with.

use super::{Choice, Facts, Screen};
use crate::levels::N_LEVELS;
use crate::ui::menu::item;
use egui::Ui;

pub(super) fn show(ui: &mut Ui, facts: &Facts<'_>) -> Option<Choice> {
    let mut choice = None;
    let today = facts.today.to_string();
    let n_levels = N_LEVELS.to_string();
    let lines = [
        ("Continue", facts.to_continue, "Where you left off.", Choice::Continue),
        ("Levels", &n_levels, "Each has a par: the autopilot's time.", Choice::Show(Screen::Levels)),
        ("Random maze", "", "Any size, made in six ways.", Choice::Show(Screen::Random)),
        ("Daily maze", &today, "The same for everybody, a new one each day.", Choice::Show(Screen::Daily)),
        (
            "Open a file",
            "",
            "A maze of your own: .obj, .svg, .txt, .png or .bmp.",
            Choice::Show(Screen::Open),
        ),
        ("How it works", "", "The physics, figure by figure.", Choice::Show(Screen::HowItWorks)),
        ("Settings", "", "Picture, controls, accessibility.", Choice::Show(Screen::Settings)),
        ("Quit", "", "", Choice::Quit),
    ];
    for (text, note, help, then) in lines {
        if item(ui, text, note, help) {
            choice = Some(then);
        }
    }
    choice
}
