//! Clock, maze, keys, and the goal.

use super::menu::{Plan, SMALL_LETTERS};
use super::{FramesPanel, letters};
use crate::input::{HINTS, Keyboard, TABLE};
use crate::numbers::to_f32;
use crate::overlay::{Layers, Notes};
use crate::session::Session;
use crate::source::{Onwards, Source};
use egui::{Align2, Color32, Context, FontId, Frame, Margin, RichText, Stroke, Ui, vec2};
use maze_core::{Facing, Maze, Phase, Plane};
use nalgebra::Vector2;

pub(super) const INK: Color32 = Color32::from_rgb(245, 238, 226);
pub(super) const QUIET_INK: Color32 = Color32::from_rgb(200, 188, 170);
pub(crate) const GOLD: Color32 = Color32::from_rgb(255, 205, 96);
/// As the ghost looks.
const GHOST: Color32 = Color32::from_rgb(120, 205, 235);
const GLASS: Color32 = Color32::from_rgba_premultiplied(20, 15, 11, 222);

/// Where there is more to read, and the maze behind it is bright.
pub(super) const DENSE_GLASS: Color32 = Color32::from_rgba_premultiplied(20, 15, 11, 245);

/// Distance of the panels from the window's edge (points).
pub(super) const MARGIN: f32 = 14.0;

/// Below this width or height (points) only the clock is shown.
const SMALL: [f32; 2] = [520.0, 300.0];

/// The row of hints, and the clock, with their margins (points): the board is shown between them.
const HINTS_HEIGHT: f32 = 44.0;
const CLOCK_HEIGHT: f32 = 56.0;

/// Where the method's panels begin: below the clock (points).
const NOTES_TOP: f32 = 96.0;

/// What is on screen beside the maze.
pub(crate) struct Hud<'a> {
    pub(crate) phase: Phase,
    pub(crate) n_ticks: u64,
    pub(crate) tick_s: f64,
    /// The ghost's engine, and how far it is from the ball (corridors).
    pub(crate) ghost: Option<(&'static str, f64)>,
    pub(crate) labels: &'a Labels,
    /// The row of hints.
    pub(crate) hints: bool,
    /// The list of all keys.
    pub(crate) help: bool,
    /// A screen is in front: only tags and notices are shown.
    pub(crate) is_behind: bool,
    /// News of a moment.
    pub(crate) notice: Option<&'a str>,
    /// What of the method is shown, and what is written of it.
    pub(crate) layers: Layers,
    pub(crate) notes: &'a Notes,
    /// Said while the game does not run at its usual speed.
    pub(crate) pace: Option<&'a str>,
    /// What the keys print.
    pub(crate) keyboard: &'a Keyboard,
    /// What frames take, when asked for.
    pub(crate) frames: Option<FramesPanel<'a>>,
}

/// What does not change while a maze is played.
#[derive(Default)]
pub(crate) struct Labels {
    title: String,
    /// What of the maze is not as it looks, or not as usual.
    remarks: Vec<String>,
    par_ticks: Option<u64>,
    onwards: Onwards,
}

impl Labels {
    pub(crate) fn new(source: &Source, maze: &Maze) -> Self {
        Self {
            title: source.title(),
            remarks: remarks(maze),
            par_ticks: source.par_ticks(),
            onwards: source.onwards(),
        }
    }

    pub(crate) fn title(&self) -> &str {
        &self.title
    }

    /// What comes next.
    pub(crate) fn onwards(&self) -> Option<&'static str> {
        match self.onwards {
            Onwards::Nothing => None,
            Onwards::NewMaze => Some("new maze"),
            Onwards::NextLevel => Some("next level"),
        }
    }
}

/// What a player has to know about a maze.
fn remarks(maze: &Maze) -> Vec<String> {
    let ball = maze.report.passing_radius.map(|radius| match maze.is_solvable() {
        true => format!("a ball of {}: the usual one does not pass", radius.units()),
        false => format!("no path for this ball: one of {} passes", radius.units()),
    });
    let unmet: usize = maze.report.ignored.iter().filter(|note| note.is_unmet).map(|note| note.n_faces).sum();
    let unmet = (unmet != 0).then(|| format!("{unmet} low faces are drawn and not met"));
    ball.into_iter().chain(unmet).collect()
}

/// Once for a context: dark glass, warm text.
pub(super) fn style(context: &Context) {
    letters::add_system_fonts(context);
    context.set_theme(egui::Theme::Dark);
    context.all_styles_mut(|style| {
        style.visuals.override_text_color = Some(INK);
        style.interaction.selectable_labels = false;
        // About 2 % of the window's height.
        for font in style.text_styles.values_mut() {
            font.size = font.size.max(SMALL_LETTERS);
        }
    });
}

pub(super) fn panel() -> Frame {
    Frame::new().fill(GLASS).corner_radius(8).inner_margin(Margin::symmetric(14, 8))
}

impl<'a> Hud<'a> {
    /// Of a maze that is played, with nothing beside clock and name.
    pub(crate) fn of(
        session: &Session,
        labels: &'a Labels,
        keyboard: &'a Keyboard,
        notes: &'a Notes,
    ) -> Self {
        Self {
            phase: session.phase(),
            n_ticks: session.n_ticks(),
            tick_s: session.tick_s(),
            ghost: session.ghost(),
            labels,
            hints: true,
            help: false,
            is_behind: false,
            notice: None,
            layers: Layers::default(),
            notes,
            pace: None,
            keyboard,
            frames: None,
        }
    }

    pub(crate) fn show(&self, ui: &mut Ui) {
        let screen = ui.ctx().content_rect();
        self.notes.show_tags(ui);
        if let Some(notice) = self.notice {
            show_notice(ui.ctx(), &letters::readable(ui.ctx(), notice));
        }
        if self.is_behind {
            return;
        }
        self.notes.show_panels(ui, NOTES_TOP);
        self.clock(ui.ctx());
        if is_small([screen.width(), screen.height()]) {
            return;
        }
        area(ui.ctx(), "title", Align2::RIGHT_TOP, vec2(-MARGIN, MARGIN), |ui| {
            let par = self.labels.par_ticks.map(|ticks| format!("par {}", clock_text(self.seconds(ticks))));
            let title = letters::readable_name(ui.ctx(), &self.labels.title);
            let title = RichText::new(title).color(QUIET_INK);
            ui.vertical(|ui| {
                // Extended, not wrapped: egui would keep to the width of the last maze's name.
                let lines = [title].into_iter().chain(par.map(|par| RichText::new(par).color(QUIET_INK)));
                for text in
                    lines.chain(self.labels.remarks.iter().map(|remark| RichText::new(remark).color(GOLD)))
                {
                    ui.add(egui::Label::new(text).wrap_mode(egui::TextWrapMode::Extend));
                }
            });
        });
        if let Some(frames) = self.frames {
            area(ui.ctx(), "frames", Align2::RIGHT_TOP, vec2(-MARGIN, 5.5 * MARGIN), |ui| frames.show(ui));
        }
        if self.help {
            self.all_keys(ui.ctx());
        } else if self.hints {
            self.hint_row(ui.ctx());
        }
    }

    fn seconds(&self, n_ticks: u64) -> f64 {
        seconds(n_ticks, self.tick_s)
    }

    fn clock(&self, context: &Context) {
        area(context, "clock", Align2::LEFT_TOP, vec2(MARGIN, MARGIN), |ui| {
            ui.label(RichText::new(clock_text(self.seconds(self.n_ticks))).font(FontId::monospace(24.0)));
            if let Some(pace) = self.pace {
                let pace = egui::Label::new(RichText::new(pace).color(GOLD));
                ui.add(pace.wrap_mode(egui::TextWrapMode::Extend));
            } else if self.phase == Phase::Ready {
                ui.label(RichText::new("tilt the board to start").color(GOLD));
            } else if self.phase == Phase::Finished {
                ui.label(RichText::new("goal reached").color(GOLD));
            }
            if let Some((engine, distance)) = self.ghost {
                ui.label(RichText::new(format!("{engine}  {distance:.3} corridors away")).color(GHOST));
            }
        });
    }

    fn hint_row(&self, context: &Context) {
        area(context, "hints", Align2::CENTER_BOTTOM, vec2(0.0, -0.5 * MARGIN), |ui| {
            ui.set_max_width(context.content_rect().width() - 2.0 * MARGIN);
            ui.horizontal_wrapped(|ui| {
                key_and_effect(ui, "drag", "or");
                for (controls, effect) in HINTS {
                    key_and_effect(
                        ui,
                        &letters::readable(ui.ctx(), &self.keyboard.hint_of(controls)),
                        effect,
                    );
                }
            });
        });
    }

    /// In two columns, over the board until H is pressed again.
    fn all_keys(&self, context: &Context) {
        area(context, "all keys", Align2::CENTER_CENTER, vec2(0.0, 0.0), |ui| {
            let most = context.content_rect().height() - 4.0 * MARGIN;
            egui::ScrollArea::vertical().max_height(most).show(ui, |ui| {
                egui::Grid::new("all keys").num_columns(4).spacing(vec2(18.0, 4.0)).show(ui, |ui| {
                    let half = TABLE.len().div_ceil(2);
                    for line in 0..half {
                        for entry in [TABLE.get(line), TABLE.get(line + half)].into_iter().flatten() {
                            let keys = self.keyboard.names_of(entry.control).join(", ");
                            ui.label(RichText::new(letters::readable(ui.ctx(), &keys)).color(GOLD));
                            ui.label(RichText::new(entry.name).color(INK));
                        }
                        ui.end_row();
                    }
                });
            });
        });
    }
}

/// Fractions of a window's height, at its lower and at its upper edge, that are left to what is written.
pub(crate) fn room(size_points: [f32; 2]) -> [f32; 2] {
    match is_small(size_points) {
        true => [0.0; 2],
        false => [HINTS_HEIGHT / size_points[1], CLOCK_HEIGHT / size_points[1]],
    }
}

/// So many ticks in seconds.
pub(crate) fn seconds(n_ticks: u64, tick_s: f64) -> f64 {
    #[allow(clippy::cast_precision_loss, reason = "2^53 ticks are longer than anybody plays")]
    let n_ticks = n_ticks as f64;
    n_ticks * tick_s
}

/// The walls of a maze as they are seen from above.
pub(crate) fn plan_of(maze: &Maze) -> Plan {
    let side = maze.bounds.size().max().max(f64::MIN_POSITIVE);
    let middle = 0.5 * (maze.bounds.low + maze.bounds.high);
    let at = |point: Vector2<f64>| [(point.x - middle.x) / side, (point.y - middle.y) / side].map(to_f32);
    let planes = Facing::ALL.into_iter().flat_map(|facing| maze.planes.planes(facing));
    let ends =
        |plane: Plane| [plane.start, plane.end].map(|along| at(plane.facing.point(plane.offset, along)));
    let lines = planes.map(ends).collect();
    Plan { lines, start: at(maze.start()), goal: at(maze.goal()) }
}

/// Denser than the panels, and over them.
fn show_notice(context: &Context, text: &str) {
    let screen = context.content_rect();
    let painter =
        context.layer_painter(egui::LayerId::new(egui::Order::Foreground, egui::Id::unique("notice")));
    let galley = painter.layout(text.to_owned(), FontId::proportional(16.0), GOLD, 0.7 * screen.width());
    let at = screen.center_top() + vec2(0.0, 6.0 * MARGIN);
    let place = Align2::CENTER_TOP.anchor_size(at, galley.size());
    painter.rect(
        place.expand2(vec2(16.0, 10.0)),
        8.0,
        DENSE_GLASS,
        Stroke::new(1.0, GOLD),
        egui::StrokeKind::Inside,
    );
    painter.galley(place.min, galley, GOLD);
}

fn key_and_effect(ui: &mut Ui, key: &str, effect: &str) {
    ui.label(RichText::new(key).strong().color(GOLD));
    ui.label(RichText::new(effect).color(QUIET_INK));
    ui.add_space(6.0);
}

pub(super) fn is_small(size_points: [f32; 2]) -> bool {
    size_points[0] < SMALL[0] || size_points[1] < SMALL[1]
}

fn area(context: &Context, name: &str, anchor: Align2, offset: egui::Vec2, add: impl FnOnce(&mut Ui)) {
    floating(context, name, anchor, offset, |ui| {
        panel().show(ui, add);
    });
}

/// There from its first frame on, without fading in.
fn floating(context: &Context, name: &str, anchor: Align2, offset: egui::Vec2, add: impl FnOnce(&mut Ui)) {
    let id = egui::Id::unique(name);
    let is_new = egui::AreaState::load(context, id).is_none();
    egui::Area::new(id).anchor(anchor, offset).interactable(false).fade_in(false).show(context, add);
    if is_new {
        // The first time egui only measures.
        context.request_discard("a new panel");
    }
}

/// Minutes, seconds and hundredths.
pub(crate) fn clock_text(seconds: f64) -> String {
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
