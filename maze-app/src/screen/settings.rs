//! The settings: a line each. A change holds at once.

use super::Choice;
use crate::input::{Bindings, Control, Keyboard, MAX_KEYS};
use crate::settings::{Controls, FRAME_CAPS, Named, SENSITIVITIES, SPEEDS, Settings, UI_SCALES, controls};
use crate::ui::menu::{choose, choose_named, heading, item, number, text, toggle};
use egui::Ui;

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Page {
    #[default]
    Video,
    Controls,
    Keys,
    Accessibility,
}

impl Named for Page {
    const ALL: &'static [(Self, &'static str)] = &[
        (Self::Video, "video"),
        (Self::Controls, "controls"),
        (Self::Keys, "keys"),
        (Self::Accessibility, "accessibility"),
    ];
}

pub(super) fn show(
    ui: &mut Ui,
    keyboard: &Keyboard,
    page: &mut Page,
    captures: &mut Option<(Control, usize)>,
    settings: &mut Settings,
) -> Option<Choice> {
    choose_named(ui, "Page", "", page);
    ui.add_space(4.0);
    match page {
        Page::Video => video(ui, settings),
        Page::Controls => control(ui, settings),
        Page::Keys => keys(ui, keyboard, captures, &mut settings.controls),
        Page::Accessibility => accessibility(ui, settings),
    }
    ui.add_space(6.0);
    item(ui, "Back", "", "").then_some(Choice::Back)
}

fn video(ui: &mut Ui, settings: &mut Settings) {
    let video = &mut settings.video;
    choose_named(
        ui,
        "Quality",
        "How much is spent on the picture; auto is what suits the adapter.",
        &mut video.quality,
    );
    toggle(
        ui,
        "Lower it on a slow machine",
        "When frames come too slowly, the picture gets cheaper by itself.",
        &mut video.lower_quality_when_slow,
    );
    toggle(ui, "Full screen", "", &mut video.fullscreen);
    toggle(
        ui,
        "In step with the screen",
        "No tearing; off, frames come as soon as they are ready.",
        &mut video.vsync,
    );
    let caps = FRAME_CAPS.map(|cap| (cap, if cap == 0 { "auto".to_owned() } else { cap.to_string() }));
    choose(ui, "Most frames a second", "", &caps, &mut video.frame_cap);
    number(ui, "Size of texts", "Menus and clock.", &mut video.ui_scale, UI_SCALES, 0.05);
    choose_named(ui, "Camera", "Fixed shows the whole board.", &mut video.camera);
    toggle(
        ui,
        "Reduced motion",
        "Nothing moves behind the menus, and the view does not slide.",
        &mut video.reduced_motion,
    );
}

fn control(ui: &mut Ui, settings: &mut Settings) {
    let controls = &mut settings.controls;
    choose_named(
        ui,
        "Drag",
        "Arcball goes by the size of the window, relative by pixels.",
        &mut controls.drag,
    );
    number(ui, "Sensitivity of the mouse", "", &mut controls.sensitivity, SENSITIVITIES, 0.05);
    choose_named(ui, "Response", "Gentle and finest make small tilts smaller.", &mut controls.curve);
    toggle(ui, "Invert left and right", "Of the mouse.", &mut controls.invert_x);
    toggle(ui, "Invert away and towards", "Of the mouse.", &mut controls.invert_y);
    number(ui, "Speed of keys", "How fast keys tip the board.", &mut controls.key_speed, SENSITIVITIES, 0.05);
    toggle(
        ui,
        "Pause without the keyboard",
        "The game waits while another window has the keyboard.",
        &mut settings.game.pause_without_focus,
    );
}

fn keys(ui: &mut Ui, keyboard: &Keyboard, captures: &mut Option<(Control, usize)>, settings: &mut Controls) {
    choose_named(ui, "Usual keys", "The report's: B and S zoom, X tilts towards you.", &mut settings.set);
    if item(ui, "All keys as usual", "", "Forgets your own keys.") {
        settings.set_bindings(&Bindings::new(settings.set));
    }
    text(ui, "Choose a line, then press the new key. Esc leaves it as it is.");
    let bindings = settings.bindings();
    for place in 0..MAX_KEYS {
        heading(ui, ["First key", "Second key"][place.min(1)]);
        for (control, name) in controls() {
            let key = bindings.keys_of(control).get(place).map(|key| keyboard.name_of(*key));
            let key = match *captures == Some((control, place)) {
                true => "press a key ...".to_owned(),
                false => crate::ui::readable(ui.ctx(), &key.unwrap_or_else(|| "-".to_owned())),
            };
            let others: Vec<&str> = bindings.conflicts(control).map(|entry| entry.name).collect();
            let clash = if others.is_empty() { key } else { format!("{key}  ! also {}", others.join(", ")) };
            if item(ui, name, &clash, "") {
                *captures = Some((control, place));
            }
        }
    }
}

fn accessibility(ui: &mut Ui, settings: &mut Settings) {
    let accessibility = &mut settings.accessibility;
    toggle(ui, "High contrast marks", "Rings around ball, start and goal.", &mut accessibility.high_contrast);
    toggle(ui, "Larger text", "", &mut accessibility.larger_text);
    let speeds = SPEEDS.map(|speed| (speed, format!("{speed} %")));
    choose(
        ui,
        "Speed of the game",
        "Slower is marked in the result.",
        &speeds,
        &mut accessibility.speed_percent,
    );
    toggle(ui, "Menus on the right", "For left-handed players.", &mut accessibility.left_handed);
}
