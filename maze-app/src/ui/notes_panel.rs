//! The text of the method's overlays: panels on the left, and tags at places in the maze.

use super::hud::{DENSE_GLASS, GOLD, MARGIN, is_small, panel};
use crate::overlay::{Layers, Notes, Span};
use egui::text::LayoutJob;
use egui::{Align2, Color32, FontId, RichText, TextFormat, TextWrapMode, Ui, vec2};

/// Size of the letters (points).
const LETTERS: f32 = 11.5;

/// What panels take of the picture, with their margins (points).
const WIDTH: f32 = 330.0;

/// Words stand beside their place, not on it (points).
const ASIDE: egui::Vec2 = vec2(10.0, -10.0);

/// Fraction of the picture's width, on the left, that the layers' panels take: the maze is shown beside it.
pub(crate) fn covered_width(layers: Layers, size_points: [f32; 2]) -> f32 {
    let is_hidden = layers == Layers::default() || is_small(size_points);
    // More than half is never taken from the maze.
    if is_hidden { 0.0 } else { (WIDTH / size_points[0]).min(0.5) }
}

impl Notes {
    /// At their places in the picture.
    pub(crate) fn show_tags(&self, ui: &mut Ui) {
        let screen = ui.ctx().content_rect();
        let painter = ui.painter();
        for tag in &self.tags {
            let mut at = screen.min + vec2(tag.at[0] * screen.width(), tag.at[1] * screen.height()) + ASIDE;
            let galley = painter.layout_job(job(std::slice::from_ref(&tag.words), 14.0));
            at.x = at.x.min(screen.right() - galley.size().x - ASIDE.x);
            let place = Align2::LEFT_BOTTOM.anchor_size(at, galley.size());
            painter.rect_filled(place.expand2(vec2(5.0, 2.0)), 4.0, Color32::from_black_alpha(170));
            painter.galley(place.min, galley, Color32::WHITE);
        }
    }

    /// On the left; `top` is where the first one begins (points).
    pub(crate) fn show_panels(&self, ui: &mut Ui, top: f32) {
        let screen = ui.ctx().content_rect();
        if self.panels.is_empty() || is_small([screen.width(), screen.height()]) {
            return;
        }
        // Not an area of egui's, which measures in its first frame and shows itself in the second: a picture has but one.
        let place = egui::Rect::from_min_max(screen.min + vec2(MARGIN, top), screen.max);
        ui.scope_builder(egui::UiBuilder::new().max_rect(place), |ui| {
            self.show_panels_in(ui);
        });
    }

    /// One below the other.
    pub(crate) fn show_panels_in(&self, ui: &mut Ui) {
        ui.scope(|ui| {
            ui.spacing_mut().item_spacing.y = 2.0;
            for note in &self.panels {
                panel().fill(DENSE_GLASS).show(ui, |ui| {
                    ui.set_width(WIDTH - 3.5 * MARGIN);
                    ui.label(RichText::new(&note.heading).color(GOLD).size(13.0));
                    for line in &note.lines {
                        ui.add(egui::Label::new(job(line, LETTERS)).wrap_mode(TextWrapMode::Extend));
                    }
                });
                ui.add_space(4.0);
            }
        });
    }
}

fn job(spans: &[Span], size: f32) -> LayoutJob {
    let mut job = LayoutJob::default();
    job.wrap.max_width = f32::INFINITY;
    for span in spans {
        let [r, g, b] = span.colour;
        let format = TextFormat::simple(FontId::monospace(size), Color32::from_rgb(r, g, b));
        job.append(&span.text, 0.0, format);
    }
    job
}
