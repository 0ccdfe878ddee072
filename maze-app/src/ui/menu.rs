//! The parts that screens are made of: each can be reached by keys and by the mouse, and shows when it has the focus.

use super::hud::{DENSE_GLASS, GOLD, INK, MARGIN, QUIET_INK};
use crate::settings::Named;
use egui::{
    Align, Align2, Color32, CornerRadius, Frame, Id, Layout, Margin, Response, RichText, Role, Sense, Stroke,
    Ui, WidgetInfo, vec2,
};
use std::ops::RangeInclusive;

/// Height of an item (points).
const ITEM: f32 = 30.0;
const LETTERS: f32 = 19.0;
pub(crate) const SMALL_LETTERS: f32 = 14.0;

/// Below this width (points) a column takes all of it.
const NARROW: f32 = 700.0;

/// Width of the column where there is room (points).
const COLUMN: f32 = 400.0;

/// Two lines of help at the foot of a column (points).
const HELP: f32 = 42.0;

/// Where the ids of the first item, and of the one that has the focus, are kept in a frame.
fn first_key() -> Id {
    Id::unique("the first item of a screen")
}

/// Where the help of what has the focus is kept in a frame.
fn help_key() -> Id {
    Id::unique("help of what has the focus")
}

/// Whether a column takes the whole width.
fn is_narrow(screen: f32) -> bool {
    screen < NARROW
}

/// What a column takes of the window's width.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Width {
    Usual,
    /// It holds pictures.
    Wide,
    /// The board stays in view beside it, in a narrow window too.
    Half,
}

/// How wide the column is on a screen of a width (points); a wide one holds pictures.
fn column_width(screen: f32, width: Width) -> f32 {
    match width {
        Width::Half => COLUMN.min(0.5 * screen - MARGIN),
        _ if is_narrow(screen) => screen - 2.0 * MARGIN,
        Width::Wide => 0.5 * screen,
        Width::Usual => COLUMN.min(0.45 * screen),
    }
}

/// Fraction of the width that a column covers and the board leaves free; none where it covers everything.
pub(crate) fn covered_by_column(screen: f32, width: Width) -> f32 {
    let is_whole = is_narrow(screen) && width != Width::Half;
    if is_whole { 0.0 } else { (column_width(screen, width) + MARGIN) / screen }
}

/// A column on the left, or on the right, that scrolls when it is higher than the window; the board behind it is dimmed.
pub(crate) fn column(
    ui: &mut Ui,
    title: &str,
    (width, on_the_right): (Width, bool),
    add: impl FnOnce(&mut Ui),
) {
    let screen = ui.ctx().content_rect();
    ui.painter().rect_filled(screen, CornerRadius::ZERO, Color32::from_black_alpha(70));
    let width = column_width(screen.width(), width);
    let left = if on_the_right { screen.right() - MARGIN - width } else { screen.left() + MARGIN };
    let place = egui::Rect::from_min_size(
        egui::pos2(left, screen.top() + MARGIN),
        vec2(width, screen.height() - 2.0 * MARGIN),
    );
    ui.data_mut(|data| {
        data.remove::<Id>(first_key());
        data.remove::<String>(help_key());
    });
    ui.scope_builder(egui::UiBuilder::new().max_rect(place).layout(Layout::top_down(Align::Min)), |ui| {
        let frame = Frame::new().fill(DENSE_GLASS).corner_radius(10).inner_margin(Margin::symmetric(18, 14));
        frame.show(ui, |ui| {
            ui.set_width(width - 36.0);
            ui.label(RichText::new(title).size(30.0).color(GOLD));
            ui.add_space(6.0);
            let most = place.bottom() - ui.cursor().top() - 14.0 - HELP;
            egui::ScrollArea::vertical().max_height(most).auto_shrink([false, true]).show(ui, |ui| {
                // Room for the frame of what has the focus.
                ui.spacing_mut().item_spacing.y = 5.0;
                Frame::new().inner_margin(Margin::symmetric(4, 3)).show(ui, add);
            });
            let help = ui.data(|data| data.get_temp::<String>(help_key())).unwrap_or_default();
            let help = RichText::new(help).size(SMALL_LETTERS).color(QUIET_INK);
            ui.allocate_ui(vec2(ui.available_width(), HELP), |ui| {
                ui.set_min_height(HELP);
                ui.add_space(6.0);
                ui.add(egui::Label::new(help).wrap());
            });
        });
    });
}

/// Where the focus is, or goes when it is nowhere: to what had it when the screen was left, else to the first item.
pub(crate) fn keep_focus(ui: &Ui, last: &mut Option<Id>) {
    let focused = ui.memory(|memory| memory.focused());
    if focused.is_some() {
        *last = focused;
        return;
    }
    let first = ui.data(|data| data.get_temp::<Id>(first_key()));
    // What is gone is asked once.
    if let Some(id) = last.take().or(first) {
        ui.memory_mut(|memory| memory.request_focus(id));
        ui.ctx().request_repaint();
    }
}

/// Takes note of an item, shows its focus by more than a colour, and its help under it.
fn finish(ui: &mut Ui, response: &Response, help: &str) {
    ui.data_mut(|data| {
        let first = data.get_temp_mut_or_insert_with(first_key(), || response.id);
        _ = first;
    });
    let moved = ui.input(|input| input.pointer.delta() != egui::Vec2::ZERO);
    if response.hovered() && moved && !response.has_focus() && ui.memory(|memory| memory.focused().is_some())
    {
        response.request_focus();
    }
    if !response.has_focus() {
        return;
    }
    if response.gained_focus() {
        response.scroll_to_me(None);
    }
    let outline = response.rect.expand(2.0);
    ui.painter().rect_stroke(outline, 6.0, Stroke::new(2.0, GOLD), egui::StrokeKind::Outside);
    say(ui, help);
}

/// The help of what has the focus, for the foot of the column: under its item it would move what is below away from the pointer.
fn say(ui: &Ui, help: &str) {
    let help = help.to_owned();
    ui.data_mut(|data| data.insert_temp(help_key(), help));
}

/// A line of a menu; true when it is chosen.
pub(crate) fn item(ui: &mut Ui, name: &str, note: &str, help: &str) -> bool {
    let text = RichText::new(name).size(LETTERS).color(INK);
    let mut button = egui::Button::new(text)
        .min_size(vec2(ui.available_width(), ITEM))
        .fill(Color32::TRANSPARENT)
        .stroke(Stroke::NONE);
    button = button.right_text(RichText::new(note).size(SMALL_LETTERS).color(QUIET_INK));
    let response = ui.add(button);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, name));
    finish(ui, &response, help);
    response.clicked()
}

/// A line of a menu that is on or off.
pub(crate) fn toggle(ui: &mut Ui, name: &str, help: &str, value: &mut bool) {
    if item(ui, name, if *value { "on" } else { "off" }, help) {
        *value = !*value;
    }
}

/// A line of a menu with the values to choose from beside each other.
pub(crate) fn choose<T: PartialEq + Copy>(
    ui: &mut Ui,
    name: &str,
    help: &str,
    values: &[(T, String)],
    value: &mut T,
) {
    ui.label(RichText::new(name).size(SMALL_LETTERS + 2.0).color(QUIET_INK));
    let mut focused = false;
    ui.horizontal_wrapped(|ui| {
        for (one, text) in values {
            let is_chosen = *value == *one;
            // The mark says it without a colour.
            let shown = if is_chosen { format!("• {text}") } else { text.clone() };
            let ink = if is_chosen { GOLD } else { INK };
            let button = egui::Button::selectable(
                is_chosen,
                RichText::new(shown).size(SMALL_LETTERS + 2.0).color(ink),
            );
            let response = ui.add(button.min_size(vec2(0.0, 24.0)));
            let (chosen, label) = (is_chosen, format!("{name}: {text}"));
            response.widget_info(|| WidgetInfo::selected(Role::RadioButton, true, chosen, &label));
            finish(ui, &response, "");
            focused |= response.has_focus();
            if response.clicked() {
                *value = *one;
            }
        }
    });
    if focused {
        say(ui, help);
    }
}

/// The same for a setting that has a name for each value.
pub(crate) fn choose_named<T: Named>(ui: &mut Ui, name: &str, help: &str, value: &mut T) {
    let values: Vec<(T, String)> = T::ALL.iter().map(|(value, text)| (*value, (*text).to_owned())).collect();
    choose(ui, name, help, &values, value);
}

/// A number that is drawn along a line or typed.
pub(crate) fn number<N: egui::emath::Numeric>(
    ui: &mut Ui,
    name: &str,
    help: &str,
    value: &mut N,
    range: RangeInclusive<N>,
    step: f64,
) {
    ui.label(RichText::new(name).size(SMALL_LETTERS + 2.0).color(QUIET_INK));
    let slider = egui::Slider::new(value, range).step_by(step);
    let response = ui.add(slider);
    response.widget_info(|| WidgetInfo::labeled(Role::Slider, true, name));
    finish(ui, &response, help);
}

/// A line of text to type; true when Enter ends it.
pub(crate) fn line(ui: &mut Ui, name: &str, help: &str, text: &mut String) -> bool {
    ui.label(RichText::new(name).size(SMALL_LETTERS + 2.0).color(QUIET_INK));
    let response = ui.add(egui::TextEdit::singleline(text).desired_width(f32::INFINITY));
    finish(ui, &response, help);
    response.lost_focus() && ui.input(|input| input.key_pressed(egui::Key::Enter))
}

/// A plain text in a column.
pub(crate) fn text(ui: &mut Ui, text: &str) {
    ui.label(RichText::new(text).size(SMALL_LETTERS + 1.0).color(INK));
}

/// A heading within a column.
pub(crate) fn heading(ui: &mut Ui, text: &str) {
    ui.add_space(8.0);
    ui.label(RichText::new(text).size(LETTERS).color(GOLD));
}

/// A maze's walls as lines, in a square of side 1 with its middle in (0, 0); y points up.
#[derive(Clone, Debug, Default)]
pub(crate) struct Plan {
    pub(crate) lines: Vec<[[f32; 2]; 2]>,
    pub(crate) start: [f32; 2],
    pub(crate) goal: [f32; 2],
}

/// A picture of a maze with its name under it; true when it is chosen.
pub(crate) fn card(ui: &mut Ui, plan: &Plan, name: &str, width: f32) -> Response {
    let size = vec2(width, 0.75 * width + 22.0);
    let (place, response) = ui.allocate_exact_size(size, Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, name));
    let painter = ui.painter().with_clip_rect(place.intersect(ui.clip_rect()));
    painter.rect_filled(place, 6.0, Color32::from_rgb(52, 42, 34));
    let middle = place.center_top() + vec2(0.0, 0.375 * width);
    let scale = 0.68 * width;
    let at = |[x, y]: [f32; 2]| middle + vec2(x * scale, -y * scale);
    for [a, b] in &plan.lines {
        painter.line_segment([at(*a), at(*b)], Stroke::new(1.2, Color32::from_rgb(226, 196, 150)));
    }
    // The marks differ in shape, too: a ring and a disc.
    painter.circle_stroke(at(plan.start), 3.2, Stroke::new(1.6, Color32::from_rgb(120, 180, 255)));
    painter.circle_filled(at(plan.goal), 3.6, Color32::from_rgb(110, 220, 120));
    let font = egui::FontId::proportional(SMALL_LETTERS - 1.0);
    painter.text(place.center_bottom() - vec2(0.0, 4.0), Align2::CENTER_BOTTOM, name, font, INK);
    finish(ui, &response, "");
    response
}

/// Keys and what they do, at the lower right.
pub(crate) fn hints(ui: &Ui, hints: &[(&str, &str)]) {
    let screen = ui.ctx().content_rect();
    if is_narrow(screen.width()) {
        return;
    }
    let text = hints.iter().map(|(key, does)| format!("{key} {does}")).collect::<Vec<_>>().join("     ");
    let font = egui::FontId::proportional(SMALL_LETTERS);
    let at = screen.right_bottom() - vec2(MARGIN, MARGIN);
    ui.painter().text(at, Align2::RIGHT_BOTTOM, text, font, QUIET_INK);
}
