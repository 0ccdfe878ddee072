//! What frames take, live: figures, and a graph of the last seconds.

use super::hud::{GOLD, QUIET_INK};
use crate::frame_log::{FrameLog, Spread};
use egui::{Color32, Pos2, Rect, RichText, Sense, Shape, Stroke, Ui, pos2, vec2};

/// Points.
const GRAPH: egui::Vec2 = vec2(250.0, 46.0);

const FRAMES_COLOUR: Color32 = Color32::from_rgb(130, 210, 140);
const PROCESSOR_COLOUR: Color32 = Color32::from_rgb(240, 150, 90);

/// The log, and what draws the frames.
#[derive(Clone, Copy)]
pub(crate) struct FramesPanel<'a> {
    pub(crate) log: &'a FrameLog,
    pub(crate) quality: &'static str,
    pub(crate) size: [u32; 2],
    pub(crate) adapter: &'a str,
}

impl FramesPanel<'_> {
    pub(super) fn show(&self, ui: &mut Ui) {
        let quiet = |text: String| RichText::new(text).color(QUIET_INK).size(12.0);
        let figure = |text: String| RichText::new(text).monospace().size(12.0);
        let [width, height] = self.size;
        ui.set_max_width(GRAPH.x);
        ui.label(quiet(format!("{width}x{height}, quality {}", self.quality)));
        ui.label(quiet(self.adapter.to_owned()));
        let log = self.log;
        let rates = log.rates();
        let (fps, percent) = rates.last().map_or((0.0, 0.0), |r| (r.frames_per_s, r.processor_percent));
        ui.label(RichText::new(format!("{fps:.0} frames/s   {percent:.0} % of a core")).color(GOLD));
        let line = |name: &str, spread: Option<Spread>| match spread {
            Some(Spread { median, p99 }) => format!("{name:9}{median:7.2} ms   p99 {p99:.2}"),
            None => format!("{name:9}      not known"),
        };
        ui.label(figure(line("frame", log.frame_ms())));
        let parts = log.parts_ms();
        ui.label(figure(format!("simulate {:7.2} ms", parts.simulate)));
        ui.label(figure(format!("encode   {:7.2} ms", parts.encode)));
        ui.label(figure(format!("present  {:7.2} ms", parts.present)));
        ui.label(figure(line("adapter", log.gpu_ms())));
        graph(ui, FRAMES_COLOUR, "frames/s", rates.iter().map(|rate| rate.frames_per_s).collect());
        graph(ui, PROCESSOR_COLOUR, "% of a core", rates.iter().map(|rate| rate.processor_percent).collect());
    }
}

/// A line from the oldest value to the newest, from zero up.
fn graph(ui: &mut Ui, colour: Color32, name: &str, values: Vec<f64>) {
    let (space, _) = ui.allocate_exact_size(GRAPH, Sense::empty());
    let highest = values.iter().copied().fold(1.0, f64::max);
    let painter = ui.painter_at(space);
    painter.rect_filled(space, 3.0, Color32::from_black_alpha(90));
    let points = points(space, &values, highest);
    painter.add(Shape::line(points, Stroke::new(1.5, colour)));
    let label = format!("{name}, up to {highest:.0}");
    let font = egui::FontId::proportional(11.0);
    painter.text(space.left_bottom() + vec2(4.0, -3.0), egui::Align2::LEFT_BOTTOM, label, font, QUIET_INK);
}

#[allow(clippy::cast_possible_truncation, clippy::cast_precision_loss, reason = "pixels of a small graph")]
fn points(space: Rect, values: &[f64], highest: f64) -> Vec<Pos2> {
    let step = space.width() / values.len().saturating_sub(1).max(1) as f32;
    let y = |value: f64| space.bottom() - (value / highest) as f32 * (space.height() - 4.0);
    values.iter().enumerate().map(|(i, value)| pos2(space.left() + step * i as f32, y(*value))).collect()
}
