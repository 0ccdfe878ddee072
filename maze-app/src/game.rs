//! The game: the maze on the board, the screens before it, and what each choice leads to.
//!
//! It knows no window, no file and no clock: a platform hands it keys, choices and elapsed time, and carries out its
//! [`Order`]s.

use crate::clock::Clock;
use crate::demo::Demo;
use crate::engine_kind::EngineKind;
use crate::failure::Failure;
use crate::input::{Action, Keyboard, TiltControl};
use crate::overlay::{Layers, Notes};
use crate::recipe::next_seed;
use crate::screen::{Choice, Date, Facts, LevelCard, METHOD_STEPS, Outcome, Screen, Screens, Start};
use crate::session::Session;
use crate::settings::{CameraMode, Settings};
use crate::source::Source;
use crate::ui::{self, FramesPanel, Hud, Labels};
use crate::view::View;
use egui::Ui;
use maze_core::layout::{Algorithm, Recipe};
use maze_core::{BallKind, Event, Maze, Phase};
use maze_render::PITCH_RAD;
use std::collections::BTreeMap;
use std::time::Duration;

/// How long the goal is in view before the result is shown (ticks of 0.03 s).
const TICKS_TO_RESULT: u32 = 13;

/// Corridors across a view that follows the ball.
const FOLLOWED: f64 = 9.0;

/// The keys are shown throughout in so many levels, elsewhere until the clock starts.
const N_TAUGHT: usize = 2;

/// How long the figures of the method wait for a hit.
const MAX_TICKS_TO_HIT: u32 = 500;

/// Speed of the game behind the menus.
const ATTRACT_SPEED: f64 = 0.5;

/// What the platform is asked to do.
#[derive(Clone, Debug)]
pub(crate) enum Order {
    /// Load a maze and put it on the board.
    Load(Source, Role),
    /// Ask for a file with the desktop's own window, and then open it.
    ChooseFile,
    /// Another maze is on the board.
    ShowBoard,
    SaveRecording,
    Screenshot,
    NextQuality,
    /// The run has begun anew.
    Restarted,
    Quit,
}

/// What a maze on the board is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Role {
    /// The player plays.
    Play,
    /// It lies behind a menu, and the autopilot plays.
    Look,
}

/// What a platform adds to what is written over the board.
#[derive(Clone, Copy)]
pub(crate) struct Extras<'a> {
    /// News of a moment.
    pub(crate) notice: Option<&'a str>,
    /// What is written of the method.
    pub(crate) notes: &'a Notes,
    /// Said while the game does not run at its usual speed.
    pub(crate) pace: Option<&'a str>,
    /// What frames take, when asked for.
    pub(crate) frames: Option<FramesPanel<'a>>,
}

/// A maze on the board, what it is called, and who plays it.
pub(crate) struct Board {
    pub(crate) session: Session,
    pub(crate) source: Source,
    pub(crate) labels: Labels,
    role: Role,
    /// Plays in the player's place.
    demo: Option<Demo>,
    /// The slowest speed that the run was played at.
    speed_percent: u32,
    n_ticks_at_goal: u32,
}

/// What the game is started with, besides the first maze.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rules {
    pub(crate) engine: EngineKind,
    pub(crate) max_tilt_rad: f64,
    /// The autopilot plays in the player's place.
    pub(crate) demo: bool,
    /// The autopilot plays round after round, and no result is shown.
    pub(crate) rounds: bool,
    /// For the first random maze.
    pub(crate) seed: u64,
    pub(crate) today: Date,
}

impl Rules {
    /// The maze of a source, with the ball that it is played with.
    pub(crate) fn load(&self, source: &Source) -> Result<Maze, Failure> {
        source.load_for(self.engine, BallKind::Steel)
    }
}

impl Board {
    pub(crate) fn new(maze: Maze, source: Source, role: Role, rules: &Rules) -> Result<Self, Failure> {
        let session = Session::new(maze, rules.engine)?;
        let demo = match role {
            Role::Play if rules.demo => Some(Demo::new(&session, rules.max_tilt_rad, rules.rounds)?),
            Role::Play => None,
            // A maze that the autopilot cannot play just lies there.
            Role::Look => Demo::new(&session, rules.max_tilt_rad, true).ok(),
        };
        let labels = Labels::new(&source, session.maze());
        Ok(Self { session, source, labels, role, demo, speed_percent: 100, n_ticks_at_goal: 0 })
    }

    pub(crate) fn is_played(&self) -> bool {
        self.role == Role::Play
    }

    /// Whether the autopilot plays.
    pub(crate) fn is_demo(&self) -> bool {
        self.demo.is_some()
    }

    /// Whether a player would lose something with it.
    fn is_run(&self) -> bool {
        self.is_played() && self.demo.is_none() && self.session.phase() == Phase::Playing
    }

    fn restart(&mut self) -> Result<(), Failure> {
        (self.speed_percent, self.n_ticks_at_goal) = (100, 0);
        self.session.restart()
    }
}

pub(crate) struct Game {
    pub(crate) board: Board,
    /// A run that was left for the title.
    parked: Option<Board>,
    pub(crate) screens: Screens,
    pub(crate) settings: Settings,
    pub(crate) clock: Clock,
    pub(crate) keyboard: Keyboard,
    pub(crate) control: TiltControl,
    pub(crate) view: View,
    pub(crate) layers: Layers,
    /// The list of all keys is shown.
    pub(crate) help: bool,
    pub(crate) shows_frames: bool,
    /// What of a choice failed; shown until another one is made.
    pub(crate) trouble: Option<String>,
    rules: Rules,
    outcome: Outcome,
    /// Best times of this start of the program, by maze (ticks).
    best: BTreeMap<String, u64>,
    levels: Vec<LevelCard>,
}

impl Game {
    pub(crate) fn new(board: Board, first: Screen, settings: Settings, rules: Rules) -> Self {
        let mut game = Self {
            clock: Clock::new(board.session.tick_s()),
            board,
            parked: None,
            screens: Screens::new(first, rules.seed),
            keyboard: Keyboard::default(),
            control: TiltControl::new(rules.max_tilt_rad),
            view: View::default(),
            layers: Layers::default(),
            help: false,
            shows_frames: false,
            trouble: None,
            rules,
            outcome: Outcome::default(),
            best: BTreeMap::new(),
            levels: Vec::new(),
            settings,
        };
        game.settings_changed();
        game
    }

    pub(crate) fn rules(&self) -> &Rules {
        &self.rules
    }

    /// Takes over what of the settings is the game's.
    pub(crate) fn settings_changed(&mut self) {
        self.keyboard.bind(self.settings.controls.bindings());
        self.control.tune(&self.settings.controls);
    }

    /// What a key asks for.
    pub(crate) fn act(&mut self, action: Action) -> Result<Option<Order>, Failure> {
        match action {
            Action::ZoomIn => self.view.zoom_by_notches(1.0),
            Action::ZoomOut => self.view.zoom_by_notches(-1.0),
            Action::Level => self.control.level(),
            Action::ToggleHelp => self.help = !self.help,
            Action::ToggleFrames => self.shows_frames = !self.shows_frames,
            Action::ToggleLayer(layer) => self.layers.toggle(layer),
            Action::HideLayers => self.layers = Layers::default(),
            Action::TogglePause => self.clock.toggle_pause(),
            Action::Step => self.clock.step(),
            Action::Slower => self.clock.slower(),
            Action::Faster => self.clock.faster(),
            Action::ToggleFullscreen => self.settings.video.fullscreen = !self.settings.video.fullscreen,
            Action::NextGhost => self.board.session.next_ghost()?,
            Action::NextQuality => return Ok(Some(Order::NextQuality)),
            Action::Screenshot => return Ok(Some(Order::Screenshot)),
            Action::Menu => return self.back(),
            Action::Restart => return self.choose(Choice::Restart),
            Action::GoOn => return self.choose_or_ask(Choice::Next),
            Action::GoOnFromGoal if self.board.session.phase() == Phase::Finished => {
                return self.choose(Choice::Next);
            }
            Action::GoOnFromGoal => {}
            Action::NextLevel | Action::PreviousLevel => {
                return self.choose_or_ask(Choice::ChangeLevel { forwards: action == Action::NextLevel });
            }
        }
        Ok(None)
    }

    /// Esc: one step back.
    pub(crate) fn back(&mut self) -> Result<Option<Order>, Failure> {
        self.screens.back().map_or(Ok(None), |choice| self.choose(choice))
    }

    /// A run in progress is not ended without asking.
    fn choose_or_ask(&mut self, choice: Choice) -> Result<Option<Order>, Failure> {
        if self.board.is_run() && !self.leads_nowhere(&choice) {
            self.screens.show(Screen::Leave);
            self.screens.after_leaving = Some(choice);
            return Ok(None);
        }
        self.choose(choice)
    }

    fn leads_nowhere(&self, choice: &Choice) -> bool {
        *choice == Choice::Next && self.board.labels.onwards().is_none()
    }

    /// What a choice leads to. The platform carries out the order, if any.
    pub(crate) fn choose(&mut self, choice: Choice) -> Result<Option<Order>, Failure> {
        self.trouble = None;
        match choice {
            Choice::Show(Screen::HowItWorks) => {
                self.screens.show(Screen::HowItWorks);
                self.set_figure(0);
                let recipe = Recipe::new(4, 3, Algorithm::default(), 4);
                return Ok(Some(Order::Load(Source::random(recipe), Role::Look)));
            }
            Choice::Show(Screen::Daily) => {
                self.screens.show(Screen::Daily);
                return Ok(Some(Order::Load(Source::daily(self.rules.today), Role::Look)));
            }
            Choice::Show(Screen::Levels) => {
                self.screens.show(Screen::Levels);
                self.read_levels()?;
            }
            Choice::Show(screen) => self.screens.show(screen),
            Choice::Back => self.leave_screen(),
            Choice::Resume => {
                self.screens.pop();
                self.control.level();
            }
            Choice::Continue => match self.parked.take() {
                Some(board) => {
                    self.board = board;
                    self.screens.begin_with(Screen::Playing);
                    self.control.level();
                    return Ok(Some(Order::ShowBoard));
                }
                None => return self.choose(Choice::Play(Start::Level(self.level_to_continue()))),
            },
            Choice::Play(start) => return Ok(Some(Order::Load(self.source_of(start)?, Role::Play))),
            Choice::Look(start) => return Ok(Some(Order::Load(self.source_of(start)?, Role::Look))),
            Choice::Restart => {
                self.control.level();
                self.board.restart()?;
                if self.board.is_played() {
                    self.screens.begin_with(Screen::Playing);
                }
                return Ok(Some(Order::Restarted));
            }
            Choice::Next | Choice::ChangeLevel { .. } => {
                let mut source = self.board.source.clone();
                let changed = match choice {
                    Choice::ChangeLevel { forwards } => source.change_level(forwards)?,
                    _ => {
                        self.rules.seed = next_seed(self.rules.seed);
                        source.go_on(self.rules.seed)?
                    }
                };
                return Ok(changed.then_some(Order::Load(source, Role::Play)));
            }
            Choice::SaveRecording => return Ok(Some(Order::SaveRecording)),
            Choice::ChooseFile => return Ok(Some(Order::ChooseFile)),
            Choice::Figure(figure) => self.set_figure(figure),
            Choice::OneTick => self.clock.step(),
            Choice::ToTitle => {
                self.screens.begin_with(Screen::Title);
                let recipe = Recipe::new(14, 9, Algorithm::default(), self.rules.seed);
                return Ok(Some(Order::Load(Source::random(recipe), Role::Look)));
            }
            Choice::Quit => return Ok(Some(Order::Quit)),
        }
        Ok(None)
    }

    fn leave_screen(&mut self) {
        if self.screens.top() == Screen::HowItWorks {
            self.layers = Layers::default();
            self.clock.go_on();
        }
        self.screens.pop();
    }

    fn set_figure(&mut self, figure: usize) {
        self.screens.set_figure(figure);
        self.layers = Layers::default();
        let (layer, _, _) = METHOD_STEPS[self.screens.figure()];
        self.layers.toggle(layer);
    }

    fn source_of(&self, start: Start) -> Result<Source, Failure> {
        Ok(match start {
            Start::Level(number) => Source::level(number)?,
            Start::Random(recipe) => Source::random(recipe),
            Start::Daily(date) => Source::daily(date),
            Start::File(path) => self.board.source.of_file(path),
        })
    }

    fn level_to_continue(&self) -> usize {
        self.settings
            .memory
            .level
            .filter(|number| (1..=crate::levels::N_LEVELS).contains(number))
            .unwrap_or(1)
    }

    /// Puts a maze on the board.
    pub(crate) fn put(&mut self, mut board: Board) -> Result<(), Failure> {
        if board.is_played() {
            // The ghost comes along.
            board.session.set_ghost(self.board.session.ghost_kind())?;
            self.parked = None;
            self.settings.memory.level = board.source.level_number().or(self.settings.memory.level);
            if let Some(path) = board.source.file() {
                self.settings.memory.remember_file(path.to_path_buf());
            }
            self.screens.begin_with(Screen::Playing);
            self.layers = if self.board.is_played() { self.layers } else { Layers::default() };
            self.board = board;
        } else if self.board.is_run() {
            let shown = std::mem::replace(&mut self.board, board);
            self.parked = Some(shown);
        } else {
            self.board = board;
        }
        self.settle();
        if self.screens.top() == Screen::HowItWorks {
            self.play_to_a_hit()?;
        }
        Ok(())
    }

    /// The figures of the method show a ball that moves and has met a wall.
    fn play_to_a_hit(&mut self) -> Result<(), Failure> {
        let mut n_left = MAX_TICKS_TO_HIT;
        while 0 < n_left && self.board.session.last_hit().is_none() {
            self.tick()?;
            n_left -= 1;
        }
        Ok(())
    }

    /// Level, all of it in view.
    fn settle(&mut self) {
        self.control.level();
        self.view.show_all();
        self.clock.go_on();
    }

    /// The cards of the level grid: read when they are needed first.
    fn read_levels(&mut self) -> Result<(), Failure> {
        if self.levels.is_empty() {
            let cards = (1..=crate::levels::N_LEVELS).map(|number| {
                let source = Source::level(number)?;
                let maze = source.load()?;
                Ok(source.card(&maze, self.board.session.tick_s()))
            });
            self.levels = cards.collect::<Result<_, Failure>>()?;
        }
        Ok(())
    }

    /// How fast the game runs on the screen in front; 0 where it stands.
    fn speed(&self) -> f64 {
        match self.screens.top() {
            Screen::Playing | Screen::Result => f64::from(self.settings.accessibility.speed_percent) / 100.0,
            Screen::Paused | Screen::Settings | Screen::Leave if self.board.is_played() => 0.0,
            Screen::HowItWorks => 0.0,
            _ if self.settings.video.reduced_motion => 0.0,
            _ => ATTRACT_SPEED,
        }
    }

    /// Ticks that are due after another while.
    pub(crate) fn advance(&mut self, elapsed: Duration) -> u32 {
        if self.screens.top() == Screen::HowItWorks {
            return self.clock.take_steps();
        }
        let speed = self.speed();
        if speed == 0.0 {
            return 0;
        }
        self.clock.advance(elapsed.as_secs_f64() * speed)
    }

    /// Whether anything moves by itself.
    pub(crate) fn moves(&self) -> bool {
        0.0 < self.speed()
    }

    /// Another tick of what is on the board.
    pub(crate) fn tick(&mut self) -> Result<Vec<Event>, Failure> {
        let board = &mut self.board;
        self.control.tick(board.session.tick_s());
        let tilt = match &mut board.demo {
            Some(demo) => demo.tilt(&mut board.session)?,
            None if self.screens.is_playing() => self.control.tilt(),
            // The board is left as it was.
            None => board.session.tilt(),
        };
        board.speed_percent = board.speed_percent.min(self.settings.accessibility.speed_percent);
        let events = board.session.tick(tilt)?;
        if events.iter().any(|event| matches!(event, Event::Finished(_))) && board.is_played() {
            self.note_outcome();
        }
        let board = &mut self.board;
        if board.session.phase() == Phase::Finished && board.is_played() && !self.rules.rounds {
            board.n_ticks_at_goal += 1;
            if board.n_ticks_at_goal == TICKS_TO_RESULT && self.screens.is_playing() {
                self.screens.show(Screen::Result);
            }
        }
        Ok(events)
    }

    fn note_outcome(&mut self) {
        let board = &self.board;
        let seconds = |n_ticks: u64| crate::ui::seconds(n_ticks, board.session.tick_s());
        let n_ticks = board.session.n_ticks();
        let title = board.source.title();
        let before = self.best.get(&title).copied();
        if before.is_none_or(|before| n_ticks < before) && board.speed_percent == 100 {
            self.best.insert(title, n_ticks);
        }
        let is_last = board.source.level_number() == Some(crate::levels::N_LEVELS);
        let times = (1..=crate::levels::N_LEVELS).map(|number| {
            let title = Source::level(number).ok()?.title();
            self.best.get(&title).copied()
        });
        let total: Option<u64> = if is_last { times.sum() } else { None };
        self.outcome = Outcome {
            time_s: seconds(n_ticks),
            par_s: board.source.par_ticks().map(seconds),
            best_s: before.map(seconds),
            speed_percent: board.speed_percent,
            next: board.labels.onwards().map(str::to_owned),
            total_s: total.map(seconds),
            saved: None,
        };
        if let Some(number) = board.source.level_number() {
            self.settings.memory.level = Some((number + 1).min(crate::levels::N_LEVELS));
        }
    }

    /// A recording of the result has been written to that file.
    pub(crate) fn saved(&mut self, name: String) {
        self.outcome.saved = Some(name);
    }

    /// Fraction of the width that is covered, negative on the right: the board is shown beside it.
    pub(crate) fn covered_width(&self, size_points: [f32; 2]) -> f32 {
        match self.screens.is_playing() {
            true => ui::covered_width(self.layers, size_points),
            false if self.settings.accessibility.left_handed => -self.screens.covered_width(size_points[0]),
            false => self.screens.covered_width(size_points[0]),
        }
    }

    /// Between the line of sight and straight down.
    pub(crate) fn pitch_rad(&self) -> f32 {
        if self.settings.video.camera == CameraMode::Above { 0.0 } else { PITCH_RAD }
    }

    /// How near the view is when the player has not zoomed.
    pub(crate) fn nearest_zoom(&self) -> f64 {
        let [width, depth, _] = self.board.session.half_size().map(f64::from);
        match self.settings.video.camera {
            CameraMode::Follow if self.screens.is_playing() => (2.0 * width.max(depth) / FOLLOWED).max(1.0),
            _ => 1.0,
        }
    }

    /// What is written over the board.
    pub(crate) fn hud<'a>(&'a self, extras: &Extras<'a>) -> Hud<'a> {
        let board = &self.board;
        let is_new = board.session.phase() == Phase::Ready;
        let is_first = board.source.level_number().is_some_and(|number| number <= N_TAUGHT);
        Hud {
            hints: is_new || is_first,
            help: self.help,
            is_behind: !self.screens.is_playing(),
            layers: self.layers,
            notice: extras.notice,
            pace: extras.pace,
            frames: extras.frames,
            ..Hud::of(&board.session, &board.labels, &self.keyboard, extras.notes)
        }
    }

    /// Shows the screen in front, and returns what was chosen on it.
    pub(crate) fn draw_screen(&mut self, ui: &mut Ui, notes: &Notes) -> Option<Choice> {
        let level = self.level_to_continue();
        let to_continue = match (&self.parked, self.screens.top()) {
            (_, top) if top != Screen::Title => String::new(),
            (Some(board), _) => board.source.title(),
            (None, _) => format!("level {level}"),
        };
        let facts = Facts {
            keyboard: &self.keyboard,
            levels: &self.levels,
            today: self.rules.today,
            to_continue: &to_continue,
            title: self.board.labels.title(),
            outcome: &self.outcome,
            trouble: self.trouble.as_deref(),
            notes,
        };
        self.screens.draw(ui, &facts, &mut self.settings)
    }
}

#[cfg(test)]
mod tests;
