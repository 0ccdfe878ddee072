//! Clock, maze, keys, and the goal.

use super::{FramesPanel, letters};
use crate::input::{Action, Control, Direction, Keyboard};
use crate::overlay::{Layer, Layers, Notes};
use crate::source::{Onwards, Source};
use egui::{Align2, Color32, Context, FontId, Frame, Margin, RichText, Stroke, Ui, vec2};
use maze_core::{Maze, Phase};

const INK: Color32 = Color32::from_rgb(245, 238, 226);
pub(super) const QUIET_INK: Color32 = Color32::from_rgb(200, 188, 170);
pub(super) const GOLD: Color32 = Color32::from_rgb(255, 205, 96);
/// As the ghost looks.
const GHOST: Color32 = Color32::from_rgb(120, 205, 235);
const GLASS: Color32 = Color32::from_rgba_premultiplied(20, 15, 11, 222);

/// Where there is more to read, and the maze behind it is bright.
pub(super) const DENSE_GLASS: Color32 = Color32::from_rgba_premultiplied(20, 15, 11, 245);

/// Distance of the panels from the window's edge (points).
pub(super) const MARGIN: f32 = 14.0;

/// Below this width or height (points) only the clock is shown.
const SMALL: [f32; 2] = [520.0, 300.0];

/// The list of keys in two lines, with its margins (points).
const KEYS_HEIGHT: f32 = 74.0;

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
    pub(crate) help: bool,
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
    /// In small letters: what the maze is like.
    facts: String,
    /// What of the maze is not as it looks, or not as usual.
    remarks: Vec<String>,
    par_ticks: Option<u64>,
    onwards: Onwards,
}

impl Labels {
    pub(crate) fn new(source: &Source, maze: &Maze) -> Self {
        let path = maze.path_length().map(|length| format!("path {length:.0}"));
        let difficulty = maze.metrics().map(|metrics| format!("difficulty {:.0}", metrics.difficulty));
        Self {
            title: source.title(),
            facts: path.into_iter().chain(difficulty).collect::<Vec<_>>().join("   "),
            remarks: remarks(maze),
            par_ticks: source.par_ticks(),
            onwards: source.onwards(),
        }
    }

    /// What N does.
    fn onwards(&self) -> Option<&'static str> {
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
    });
}

pub(super) fn panel() -> Frame {
    Frame::new().fill(GLASS).corner_radius(8).inner_margin(Margin::symmetric(14, 8))
}

impl Hud<'_> {
    /// Fraction of the window's height, at its lower edge, that the list of keys takes: the maze is shown above it.
    pub(crate) fn covered_part(&self, size_points: [f32; 2]) -> f32 {
        if self.help && !is_small(size_points) { KEYS_HEIGHT / size_points[1] } else { 0.0 }
    }

    pub(crate) fn show(&self, ui: &mut Ui) {
        let screen = ui.ctx().content_rect();
        self.notes.show(ui, NOTES_TOP);
        self.clock(ui.ctx());
        if self.phase == Phase::Finished {
            self.goal_reached(ui.ctx());
        }
        if let Some(notice) = self.notice {
            show_notice(ui.ctx(), &letters::readable(ui.ctx(), notice));
        }
        if is_small([screen.width(), screen.height()]) {
            return;
        }
        area(ui.ctx(), "title", Align2::RIGHT_TOP, vec2(-MARGIN, MARGIN), |ui| {
            let par = self.labels.par_ticks.map(|ticks| format!("par {}", clock_text(self.seconds(ticks))));
            let facts = par.into_iter().chain([self.labels.facts.clone()]).collect::<Vec<_>>().join("   ");
            let title = letters::readable_name(ui.ctx(), &self.labels.title);
            ui.vertical(|ui| {
                // Extended, not wrapped: egui would keep to the width of the last maze's name.
                for text in [RichText::new(title), RichText::new(facts).size(11.0)] {
                    let label = egui::Label::new(text.color(QUIET_INK));
                    ui.add(label.wrap_mode(egui::TextWrapMode::Extend));
                }
                for remark in &self.labels.remarks {
                    let label = egui::Label::new(RichText::new(remark).size(11.0).color(GOLD));
                    ui.add(label.wrap_mode(egui::TextWrapMode::Extend));
                }
            });
        });
        if let Some(frames) = self.frames {
            area(ui.ctx(), "frames", Align2::RIGHT_TOP, vec2(-MARGIN, 4.5 * MARGIN), |ui| frames.show(ui));
        }
        if self.help {
            self.keys(ui.ctx());
        }
    }

    fn seconds(&self, n_ticks: u64) -> f64 {
        #[allow(clippy::cast_precision_loss, reason = "2^53 ticks are longer than anybody plays")]
        let n_ticks = n_ticks as f64;
        n_ticks * self.tick_s
    }

    fn clock(&self, context: &Context) {
        area(context, "clock", Align2::LEFT_TOP, vec2(MARGIN, MARGIN), |ui| {
            ui.horizontal(|ui| {
                ui.label(RichText::new(clock_text(self.seconds(self.n_ticks))).font(FontId::monospace(24.0)));
                ui.label(RichText::new(format!("{} ticks", self.n_ticks)).color(QUIET_INK));
            });
            if let Some(pace) = self.pace {
                let pace = egui::Label::new(RichText::new(pace).color(GOLD));
                ui.add(pace.wrap_mode(egui::TextWrapMode::Extend));
            } else if self.phase == Phase::Ready {
                ui.label(RichText::new("tilt the board to start").color(GOLD));
            }
            if let Some((engine, distance)) = self.ghost {
                ui.label(RichText::new(format!("{engine}  {distance:.3} corridors away")).color(GHOST));
            }
        });
    }

    fn keys(&self, context: &Context) {
        area(context, "keys", Align2::CENTER_BOTTOM, vec2(0.0, -MARGIN), |ui| {
            ui.set_max_width(context.content_rect().width() - 4.0 * MARGIN);
            ui.horizontal_wrapped(|ui| {
                for (key, effect) in key_list(self.keyboard, self.labels.onwards()) {
                    key_and_effect(ui, &letters::readable(ui.ctx(), &key), effect, QUIET_INK);
                }
            });
            ui.horizontal_wrapped(|ui| {
                for (number, layer) in (1..).zip(Layer::ALL) {
                    let ink = if self.layers.has(layer) { GOLD } else { QUIET_INK };
                    key_and_effect(ui, &format!("{number}"), layer.name(), ink);
                }
                for (key, effect) in method_key_list(self.keyboard) {
                    key_and_effect(ui, &letters::readable(ui.ctx(), &key), effect, QUIET_INK);
                }
            });
        });
    }

    fn goal_reached(&self, context: &Context) {
        let frame = panel().inner_margin(Margin::symmetric(36, 22)).stroke(Stroke::new(1.5, GOLD));
        floating(context, "goal", Align2::CENTER_CENTER, vec2(0.0, 0.0), |ui| {
            frame.show(ui, |ui| {
                ui.vertical_centered(|ui| {
                    ui.label(RichText::new("Goal reached").size(30.0).color(GOLD));
                    let time = clock_text(self.seconds(self.n_ticks));
                    ui.label(RichText::new(time).font(FontId::monospace(40.0)));
                    ui.label(RichText::new(format!("{} ticks", self.n_ticks)).color(QUIET_INK));
                    if let Some(par_ticks) = self.labels.par_ticks {
                        let under = if self.n_ticks < par_ticks { "under par" } else { "par" };
                        let par = format!("{under} {}", clock_text(self.seconds(par_ticks)));
                        let ink = if self.n_ticks < par_ticks { GOLD } else { QUIET_INK };
                        ui.label(RichText::new(par).color(ink));
                    }
                    ui.add_space(6.0);
                    let onwards = self.labels.onwards();
                    let [restart, go_on] = [Action::Restart, Action::GoOn]
                        .map(|action| self.keyboard.letter_of(Control::Act(action)));
                    let onwards = onwards.map(|effect| format!("      {go_on} or Enter  {effect}"));
                    let next = format!("{restart}  play again{}", onwards.unwrap_or_default());
                    ui.label(RichText::new(next).size(16.0));
                });
            });
        });
    }
}

/// Keys and what they do, by the letters of the player's layout; N has something to do in some mazes only.
fn key_list(keyboard: &Keyboard, onwards: Option<&'static str>) -> Vec<(String, &'static str)> {
    let act = |action| keyboard.letter_of(Control::Act(action));
    let tilt = |direction| keyboard.letter_of(Control::Tilt(direction));
    let [away, left, towards, right] =
        [Direction::Away, Direction::Left, Direction::Towards, Direction::Right].map(tilt);
    let keys = [
        ("drag".to_owned(), Some("tilt")),
        (format!("arrows or {away} {left} {towards} {right}"), Some("tilt")),
        (act(Action::Level), Some("level")),
        (format!("{} / {}, wheel", act(Action::ZoomIn), act(Action::ZoomOut)), Some("zoom in / out")),
        (act(Action::Restart), Some("restart")),
        (act(Action::GoOn), onwards),
        ("PgUp / PgDn".to_owned(), Some("levels")),
        (act(Action::NextGhost), Some("ghost")),
        (act(Action::NextQuality), Some("quality")),
        ("F3".to_owned(), Some("frame times")),
        ("F11".to_owned(), Some("whole screen")),
        ("F12".to_owned(), Some("picture to a file")),
    ];
    keys.into_iter().filter_map(|(key, effect)| Some((key, effect?))).collect()
}

/// After the overlays, which are 1 to 6, in the second line.
fn method_key_list(keyboard: &Keyboard) -> [(String, &'static str); 6] {
    let act = |action| match keyboard.letter_of(Control::Act(action)) {
        letter if letter == "." => "dot".to_owned(),
        letter => letter,
    };
    [
        ("0".to_owned(), "none"),
        (format!("{}, Space", act(Action::TogglePause)), "pause"),
        (act(Action::Step), "one tick"),
        (format!("{} / {}", act(Action::Slower), act(Action::Faster)), "slower / faster"),
        (act(Action::ToggleHelp), "hide keys"),
        ("Esc".to_owned(), "quit"),
    ]
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

fn key_and_effect(ui: &mut Ui, key: &str, effect: &str, ink: Color32) {
    ui.label(RichText::new(key).strong().color(GOLD).size(13.0));
    ui.label(RichText::new(effect).color(ink).size(13.0));
    ui.add_space(8.0);
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
