//! The screens: which one is shown, and what a choice on one leads to. Plain data: no window, no file, no clock.

mod daily;
mod how;
mod levels;
mod open;
mod paused;
mod random;
mod result;
mod settings;
mod title;

pub(crate) use daily::Date;
pub(crate) use how::STEPS as METHOD_STEPS;
pub(crate) use levels::LevelCard;
pub(crate) use random::RandomForm;
pub(crate) use result::Outcome;

use crate::input::{Control, Key, Keyboard};
use crate::overlay::Notes;
use crate::settings::Settings;
use crate::ui::menu::{self, Width};
use egui::{Id, Ui};
use maze_core::layout::Recipe;
use std::path::PathBuf;

/// What is in front of the player.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Screen {
    Title,
    Levels,
    Random,
    Daily,
    Open,
    HowItWorks,
    Settings,
    Playing,
    Paused,
    Result,
    /// Whether a run in progress is to be left.
    Leave,
}

impl Screen {
    fn width(self) -> Width {
        match self {
            Self::Levels => Width::Wide,
            Self::Result => Width::Half,
            _ => Width::Usual,
        }
    }
}

/// A maze to play or to look at.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Start {
    Level(usize),
    Random(Recipe),
    Daily(Date),
    File(PathBuf),
}

/// What a player has chosen.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Choice {
    Show(Screen),
    Back,
    /// The run that was left, or the level to continue with.
    Continue,
    Play(Start),
    /// The maze behind the menu.
    Look(Start),
    Resume,
    Restart,
    /// Another random maze, or the next level.
    Next,
    /// By one level, without asking.
    ChangeLevel {
        forwards: bool,
    },
    SaveRecording,
    ChooseFile,
    /// A figure of the method, 0 is the first.
    Figure(usize),
    OneTick,
    ToTitle,
    Quit,
}

/// What screens show of the game.
pub(crate) struct Facts<'a> {
    pub(crate) keyboard: &'a Keyboard,
    pub(crate) levels: &'a [LevelCard],
    pub(crate) today: Date,
    /// What Continue goes on with.
    pub(crate) to_continue: &'a str,
    /// What the maze on the board is called.
    pub(crate) title: &'a str,
    pub(crate) outcome: &'a Outcome,
    /// A failure of what was chosen last: stays until something else is chosen.
    pub(crate) trouble: Option<&'a str>,
    /// What is written of the method.
    pub(crate) notes: &'a Notes,
}

/// The screens behind each other, the one in front last, and what has been entered on them.
#[derive(Debug)]
pub(crate) struct Screens {
    stack: Vec<Screen>,
    /// What had the focus when a screen was left.
    focus: Vec<(Screen, Option<Id>)>,
    pub(crate) random: RandomForm,
    /// The path that is typed.
    path: String,
    /// The level that is looked at.
    looked_at: Option<usize>,
    page: settings::Page,
    /// The control that waits for a key, and the place of that key.
    pub(crate) captures: Option<(Control, usize)>,
    /// The figure of the method that is shown.
    figure: usize,
    /// What is done when the run in progress is left.
    pub(crate) after_leaving: Option<Choice>,
    /// The one that was drawn last.
    drawn: Option<Screen>,
}

impl Screens {
    pub(crate) fn new(first: Screen, seed: u64) -> Self {
        Self {
            stack: vec![first],
            focus: Vec::new(),
            random: RandomForm::new(seed),
            path: String::new(),
            looked_at: None,
            page: settings::Page::default(),
            captures: None,
            figure: 0,
            after_leaving: None,
            drawn: None,
        }
    }

    /// The one in front.
    pub(crate) fn top(&self) -> Screen {
        self.stack.last().copied().unwrap_or(Screen::Title)
    }

    /// Whether keys and mouse are for the board.
    pub(crate) fn is_playing(&self) -> bool {
        self.top() == Screen::Playing
    }

    /// In front of the others; one that is there already comes to the front and those before it go.
    pub(crate) fn show(&mut self, screen: Screen) {
        self.captures = None;
        match self.stack.iter().position(|known| *known == screen) {
            Some(place) => self.stack.truncate(place + 1),
            None => self.stack.push(screen),
        }
    }

    /// The only one.
    pub(crate) fn begin_with(&mut self, screen: Screen) {
        self.captures = None;
        self.looked_at = None;
        self.stack = vec![screen];
    }

    /// What Esc means: one step back, and from the board the pause menu.
    pub(crate) fn back(&mut self) -> Option<Choice> {
        if self.captures.take().is_some() {
            return None;
        }
        match self.top() {
            Screen::Playing => Some(Choice::Show(Screen::Paused)),
            Screen::Paused => Some(Choice::Resume),
            Screen::Result => Some(Choice::ToTitle),
            // Nothing is behind it, and the game does not end by one press too many.
            Screen::Title => None,
            _ => Some(Choice::Back),
        }
    }

    /// Leaves the one in front.
    pub(crate) fn pop(&mut self) {
        if 1 < self.stack.len() {
            self.stack.pop();
        }
        self.after_leaving = None;
    }

    pub(crate) fn set_figure(&mut self, figure: usize) {
        self.figure = figure.min(METHOD_STEPS.len() - 1);
    }

    pub(crate) fn figure(&self) -> usize {
        self.figure
    }

    /// A key for the control that waits for one.
    pub(crate) fn capture(&mut self, key: Key, settings: &mut Settings) -> bool {
        let Some((control, place)) = self.captures.take() else { return false };
        settings.controls.bind(control, place, key);
        true
    }

    /// Fraction of the window's width that the screen in front covers.
    pub(crate) fn covered_width(&self, width_points: f32) -> f32 {
        if self.is_playing() { 0.0 } else { menu::covered_by_column(width_points, self.top().width()) }
    }

    /// Shows the one in front, and returns what was chosen on it.
    pub(crate) fn draw(&mut self, ui: &mut Ui, facts: &Facts<'_>, settings: &mut Settings) -> Option<Choice> {
        let screen = self.top();
        if screen == Screen::Playing {
            self.drawn = None;
            return None;
        }
        let place = (screen.width(), settings.accessibility.left_handed);
        if self.drawn != Some(screen) {
            // What had it on another screen is no longer there.
            self.drawn = Some(screen);
            ui.memory_mut(|memory| memory.focused().map(|id| memory.surrender_focus(id)));
        }
        let mut choice = None;
        // Each screen has ids of its own.
        ui.push_id(screen, |ui| {
            menu::column(ui, title_of(screen, facts), place, |ui| {
                choice = self.items(ui, screen, facts, settings);
                if let Some(trouble) = facts.trouble {
                    ui.add_space(6.0);
                    ui.label(
                        egui::RichText::new(trouble).size(menu::SMALL_LETTERS + 1.0).color(crate::ui::GOLD),
                    );
                }
            });
        });
        let place = self.focus.iter().position(|(known, _)| *known == screen).unwrap_or_else(|| {
            self.focus.push((screen, None));
            self.focus.len() - 1
        });
        menu::keep_focus(ui, &mut self.focus[place].1);
        let hints: &[(&str, &str)] = match screen {
            Screen::Title => &[("Up Down", "move"), ("Enter", "choose")],
            _ => &[("Up Down", "move"), ("Enter", "choose"), ("Esc", "back")],
        };
        menu::hints(ui, hints);
        choice
    }

    fn items(
        &mut self,
        ui: &mut Ui,
        screen: Screen,
        facts: &Facts<'_>,
        settings: &mut Settings,
    ) -> Option<Choice> {
        match screen {
            Screen::Title => title::show(ui, facts),
            Screen::Levels => levels::show(ui, facts, &mut self.looked_at),
            Screen::Random => random::show(ui, &mut self.random),
            Screen::Daily => daily::show(ui, facts),
            Screen::Open => open::show(ui, &mut self.path, settings),
            Screen::HowItWorks => how::show(ui, self.figure, facts.notes),
            Screen::Settings => {
                settings::show(ui, facts.keyboard, &mut self.page, &mut self.captures, settings)
            }
            Screen::Paused => paused::show(ui),
            Screen::Result => result::show(ui, facts.outcome),
            Screen::Leave => paused::leave(ui, self.after_leaving.clone()),
            Screen::Playing => None,
        }
    }
}

fn title_of<'a>(screen: Screen, facts: &Facts<'a>) -> &'a str {
    match screen {
        Screen::Title => "MAZE",
        Screen::Levels => "Levels",
        Screen::Random => "Random maze",
        Screen::Daily => "Daily maze",
        Screen::Open => "Open a file",
        Screen::HowItWorks => "How it works",
        Screen::Settings => "Settings",
        Screen::Paused => facts.title,
        Screen::Result => "Goal",
        Screen::Leave => "Leave this run?",
        Screen::Playing => "",
    }
}
