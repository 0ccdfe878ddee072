//! Clock, maze, keys, and the goal.

use super::FramesPanel;
use egui::{Align2, Color32, Context, FontId, Frame, Margin, RichText, Stroke, Ui, vec2};
use maze_core::Phase;

const INK: Color32 = Color32::from_rgb(245, 238, 226);
pub(super) const QUIET_INK: Color32 = Color32::from_rgb(200, 188, 170);
pub(super) const GOLD: Color32 = Color32::from_rgb(255, 205, 96);
const GLASS: Color32 = Color32::from_rgba_premultiplied(20, 15, 11, 222);

/// Distance of the panels from the window's edge (points).
const MARGIN: f32 = 14.0;

/// Below this width or height (points) only the clock is shown.
const SMALL: [f32; 2] = [520.0, 300.0];

/// The list of keys in one line, with its margins (points).
const KEYS_HEIGHT: f32 = 50.0;

const KEYS: [(&str, &str); 12] = [
    ("drag", "tilt"),
    ("arrows, W A X D", "tilt"),
    ("T", "level"),
    ("B / S, wheel", "zoom in / out"),
    ("R", "restart"),
    ("N", "new maze"),
    ("Q", "quality"),
    ("F3", "frame times"),
    ("F11", "whole screen"),
    ("F12", "picture to a file"),
    ("H", "hide keys"),
    ("Esc", "quit"),
];

/// What is on screen beside the maze.
pub(crate) struct Hud<'a> {
    pub(crate) phase: Phase,
    pub(crate) n_ticks: u64,
    pub(crate) tick_s: f64,
    pub(crate) title: &'a str,
    /// Whether N brings another maze.
    pub(crate) has_next: bool,
    pub(crate) help: bool,
    /// News of a moment.
    pub(crate) notice: Option<&'a str>,
    /// What frames take, when asked for.
    pub(crate) frames: Option<FramesPanel<'a>>,
}

/// Once for a context: dark glass, warm text.
pub(super) fn style(context: &Context) {
    context.set_theme(egui::Theme::Dark);
    context.all_styles_mut(|style| {
        style.visuals.override_text_color = Some(INK);
        style.interaction.selectable_labels = false;
    });
}

fn panel() -> Frame {
    Frame::new().fill(GLASS).corner_radius(8).inner_margin(Margin::symmetric(14, 8))
}

impl Hud<'_> {
    /// Part of the window's height, at its lower edge, that the list of keys takes: the maze is shown above it.
    pub(crate) fn covered_part(&self, size_points: [f32; 2]) -> f32 {
        if self.help && !is_small(size_points) { KEYS_HEIGHT / size_points[1] } else { 0.0 }
    }

    pub(super) fn show(&self, ui: &mut Ui) {
        let screen = ui.ctx().content_rect();
        self.clock(ui.ctx());
        if self.phase == Phase::Finished {
            self.goal_reached(ui.ctx());
        }
        if let Some(notice) = self.notice {
            area(ui.ctx(), "notice", Align2::CENTER_TOP, vec2(0.0, 6.0 * MARGIN), |ui| {
                ui.set_max_width(0.7 * screen.width());
                ui.label(RichText::new(notice).color(GOLD));
            });
        }
        if is_small([screen.width(), screen.height()]) {
            return;
        }
        area(ui.ctx(), "title", Align2::RIGHT_TOP, vec2(-MARGIN, MARGIN), |ui| {
            // Extended, not wrapped: egui would keep to the width of the last maze's name.
            let title = RichText::new(self.title).color(QUIET_INK);
            ui.add(egui::Label::new(title).wrap_mode(egui::TextWrapMode::Extend));
        });
        if let Some(frames) = self.frames {
            area(ui.ctx(), "frames", Align2::RIGHT_TOP, vec2(-MARGIN, 4.5 * MARGIN), |ui| frames.show(ui));
        }
        if self.help {
            self.keys(ui.ctx());
        }
    }

    fn seconds(&self) -> f64 {
        #[allow(clippy::cast_precision_loss, reason = "2^53 ticks are longer than anybody plays")]
        let n_ticks = self.n_ticks as f64;
        n_ticks * self.tick_s
    }

    fn clock(&self, context: &Context) {
        area(context, "clock", Align2::LEFT_TOP, vec2(MARGIN, MARGIN), |ui| {
            ui.horizontal(|ui| {
                ui.label(RichText::new(clock_text(self.seconds())).font(FontId::monospace(24.0)));
                ui.label(RichText::new(format!("{} ticks", self.n_ticks)).color(QUIET_INK));
            });
            if self.phase == Phase::Ready {
                ui.label(RichText::new("tilt the board to start").color(GOLD));
            }
        });
    }

    fn keys(&self, context: &Context) {
        area(context, "keys", Align2::CENTER_BOTTOM, vec2(0.0, -MARGIN), |ui| {
            ui.set_max_width(context.content_rect().width() - 4.0 * MARGIN);
            ui.horizontal_wrapped(|ui| {
                for (key, effect) in KEYS.into_iter().filter(|(key, _)| self.has_next || *key != "N") {
                    ui.label(RichText::new(key).strong().color(GOLD).size(13.0));
                    ui.label(RichText::new(effect).color(QUIET_INK).size(13.0));
                    ui.add_space(8.0);
                }
            });
        });
    }

    fn goal_reached(&self, context: &Context) {
        let frame = panel().inner_margin(Margin::symmetric(36, 22)).stroke(Stroke::new(1.5, GOLD));
        egui::Area::new(egui::Id::unique("goal")).anchor(Align2::CENTER_CENTER, vec2(0.0, 0.0)).show(
            context,
            |ui| {
                frame.show(ui, |ui| {
                    ui.vertical_centered(|ui| {
                        ui.label(RichText::new("Goal reached").size(30.0).color(GOLD));
                        ui.label(RichText::new(clock_text(self.seconds())).font(FontId::monospace(40.0)));
                        ui.label(RichText::new(format!("{} ticks", self.n_ticks)).color(QUIET_INK));
                        ui.add_space(6.0);
                        let next =
                            if self.has_next { "R  play again      N  new maze" } else { "R  play again" };
                        ui.label(RichText::new(next).size(16.0));
                    });
                });
            },
        );
    }
}

fn is_small(size_points: [f32; 2]) -> bool {
    size_points[0] < SMALL[0] || size_points[1] < SMALL[1]
}

fn area(context: &Context, name: &str, anchor: Align2, offset: egui::Vec2, add: impl FnOnce(&mut Ui)) {
    egui::Area::new(egui::Id::unique(name)).anchor(anchor, offset).interactable(false).show(context, |ui| {
        panel().show(ui, add);
    });
}

/// Minutes, seconds and hundredths.
fn clock_text(seconds: f64) -> String {
    // Rounded before it is split, so that 59.999 does not read 0:60.00.
    let hundredths = (seconds * 100.0).round();
    let minutes = (hundredths / 6000.0).floor();
    format!("{minutes}:{:05.2}", (hundredths - minutes * 6000.0) / 100.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clock_shows_minutes_seconds_hundredths() {
        assert_eq!(clock_text(0.0), "0:00.00");
        assert_eq!(clock_text(12.34), "0:12.34");
        assert_eq!(clock_text(59.999), "1:00.00");
        assert_eq!(clock_text(754.5), "12:34.50");
    }
}
