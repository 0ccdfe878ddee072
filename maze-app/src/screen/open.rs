//! A file of the player's.

use super::{Choice, Start};
use crate::settings::Settings;
use crate::ui::menu::{heading, item, line, text};
use egui::Ui;

pub(super) fn show(ui: &mut Ui, path: &mut String, settings: &Settings) -> Option<Choice> {
    let mut choice = None;
    if item(ui, "Choose a file", "", "With the desktop's own window.") {
        choice = Some(Choice::ChooseFile);
    }
    let is_done = line(ui, "Or its path", "Enter opens it.", path);
    if (is_done || item(ui, "Open this path", "", "")) && !path.trim().is_empty() {
        choice = Some(Choice::Play(Start::File(path.trim().into())));
    }
    text(ui, "Or drop a file on the window. Kinds: .obj, .svg, .txt, .png, .bmp.");
    if !settings.memory.recent.is_empty() {
        heading(ui, "Recent");
    }
    for recent in &settings.memory.recent {
        let name = recent.file_name().unwrap_or(recent.as_os_str()).to_string_lossy();
        if item(
            ui,
            &crate::ui::readable(ui.ctx(), &name),
            "",
            &crate::ui::readable(ui.ctx(), &recent.to_string_lossy()),
        ) {
            choice = Some(Choice::Play(Start::File(recent.clone())));
        }
    }
    choice
}
