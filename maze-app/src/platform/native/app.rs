//! The window: events in, frames out, orders of the game carried out.

use super::graphics::{Drawn, Graphics};
use super::idle::Idle;
use super::look::Look;
use super::outputs::Outputs;
use super::presence::Presence;
use super::settings_file::SettingsFile;
use super::watch::Watch;
use super::{display, layout};
use crate::failure::Failure;
use crate::frame_log::{FrameLog, Parts, Stopwatch};
use crate::game::{Board, Extras, Game, Order, Role};
use crate::numbers::to_f32;
use crate::overlay::{self, Notes};
use crate::platform::native::files;
use crate::platform::native::rescue::{self, OpenWindow};
use crate::session::Pose;
use crate::settings::Settings;
use crate::setup::{Options, Setup, Unfocused};
use crate::source::Source;
use crate::ui::{self, FramesPanel};
use crate::view;
use maze_core::Event;
use maze_render::{Camera, Quality, Scene};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};
use winit::application::ApplicationHandler;
use winit::dpi::PhysicalPosition;
use winit::event::{ElementState, MouseButton, MouseScrollDelta, StartCause, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop};
use winit::window::{Window, WindowId};

/// Size of a new window (logical pixels).
const WINDOW_SIZE: [u32; 2] = [1280, 720];

/// Pixels of a touchpad's scroll that count as one notch of a wheel.
const PIXELS_PER_NOTCH: f64 = 40.0;

/// While nothing is shown, how often to look whether it is time to end.
const HIDDEN_WAKE: Duration = Duration::from_millis(100);

/// How long a message stays on screen.
const NOTICE_TIME: Duration = Duration::from_secs(10);

/// Settings are written so long after the last change, and at the end.
const SAVE_AFTER: Duration = Duration::from_millis(500);

/// When frames were, and when they are due.
struct Timing {
    opened: Instant,
    first_frame: Option<Instant>,
    last_frame: Instant,
    next_frame: Instant,
    exit_after: Option<Duration>,
}

/// Settings that hold, and the file that keeps them.
struct Kept {
    file: SettingsFile,
    applied: Settings,
    changed: Option<Instant>,
}

/// Everything that lives as long as the window.
pub(crate) struct App {
    pub(super) game: Game,
    pub(super) graphics: Option<Graphics>,
    pub(super) look: Look,
    pub(super) presence: Presence,
    pub(super) outputs: Outputs,
    pub(super) idle: Idle,
    kept: Kept,
    timing: Timing,
    options: Options,
    /// Whether a flag says what happens without the keyboard.
    unfocused_flag: bool,
    /// Where it was last, if anywhere.
    pub(super) cursor: Option<PhysicalPosition<f64>>,
    /// News of a moment, such as why a dropped file was not loaded, and when.
    pub(super) notice: Option<(String, Instant)>,
    /// The desktop's window for choosing a file, while it is open.
    dialog: Option<Receiver<Option<PathBuf>>>,
    failure: Option<Failure>,
}

impl App {
    /// `told` is shown at first, such as why no settings were read.
    pub(crate) fn new(
        setup: Setup,
        options: Options,
        board: Board,
        file: SettingsFile,
        told: Option<String>,
    ) -> Result<Self, Failure> {
        let Setup { settings, rules, first, look, record, state_log, csv, exit_after, unfocused } = setup;
        // What ends by itself, or plays by itself, does not wait for the player unless a flag asks for it.
        let waits = !board.is_demo() && exit_after.is_none() && settings.game.pause_without_focus;
        let usual = if waits { Unfocused::Pause } else { Unfocused::Run };
        let game = Game::new(board, first, settings, rules);
        let now = Instant::now();
        let outputs = Outputs::new(record, state_log, csv, &game.board, options.keep_s)?;
        Ok(Self {
            graphics: None,
            look,
            presence: Presence::new(unfocused.unwrap_or(usual)),
            outputs,
            idle: Idle::default(),
            kept: Kept { file, applied: game.settings.clone(), changed: None },
            timing: Timing { opened: now, first_frame: None, last_frame: now, next_frame: now, exit_after },
            options,
            unfocused_flag: unfocused.is_some() || exit_after.is_some() || game.board.is_demo(),
            cursor: None,
            notice: told.map(|told| (told, now)),
            dialog: None,
            failure: None,
            game,
        })
    }

    /// Until the window closes.
    pub(crate) fn run(mut self, event_loop: EventLoop<()>) -> Result<Self, Failure> {
        let open = OpenWindow::new();
        if let Some(time) = self.timing.exit_after {
            rescue::end_after(time);
        }
        let ran = display::guarded(|| event_loop.run_app(&mut self));
        drop(open);
        // Whatever ended the game, what was played and chosen is written first.
        let written = self.outputs.write_recording();
        if let Some(reason) = self.kept.file.save(&self.game.settings) {
            crate::failure::note(&reason);
        }
        ran?.map_err(Failure::bad_input)?;
        written?;
        match self.failure.take() {
            Some(failure) => Err(failure),
            None => Ok(self),
        }
    }

    /// Adapter, quality and size of the last frame.
    pub(crate) fn drawn_by(&self) -> Option<(String, Quality, [u32; 2])> {
        self.outputs.drawn_by.clone()
    }

    /// When the first frame had been drawn.
    pub(crate) fn first_frame(&self) -> Option<Instant> {
        self.timing.first_frame
    }

    pub(crate) fn into_frame_log(self) -> FrameLog {
        self.outputs.frame_log
    }

    fn end_with(&mut self, event_loop: &ActiveEventLoop, failure: Failure) {
        self.failure = Some(failure);
        event_loop.exit();
    }

    pub(super) fn notify(&mut self, notice: String) {
        self.notice = Some((notice, Instant::now()));
        self.idle.wake();
    }

    pub(super) fn load_into_graphics(&mut self) -> Result<(), Failure> {
        let Some(graphics) = &mut self.graphics else { return Ok(()) };
        let title = ui::window_title(self.game.board.labels.title());
        let title = if self.game.board.is_played() { format!("Maze  {title}") } else { "Maze".to_owned() };
        graphics.set_maze(self.game.board.session.maze(), &title)
    }

    fn open_window(&mut self, event_loop: &ActiveEventLoop) -> Result<(), Failure> {
        let size = display::window_size(event_loop, self.options.size, WINDOW_SIZE);
        let attributes = Window::default_attributes().with_inner_size(size).with_title("Maze");
        let window = event_loop
            .create_window(attributes)
            .map_err(|error| Failure::bad_input(format!("cannot open a window: {error}")))?;
        self.presence.watch(Watch::new(&window));
        if self.presence.is_on_x11() {
            self.game.keyboard.set_layouts(layout::read(), None);
        }
        let graphics = Graphics::new(event_loop, window, &self.look.textures, self.look.quality)?;
        self.graphics = Some(graphics);
        self.apply_video();
        self.load_into_graphics()?;
        self.outputs.open()
    }

    /// Does what the game asks for.
    pub(super) fn obey(&mut self, event_loop: &ActiveEventLoop, order: Option<Order>) -> Result<(), Failure> {
        self.idle.wake();
        match order {
            None => {}
            Some(Order::Load(source, role)) => self.load(source, role)?,
            Some(Order::ShowBoard) => self.show_board()?,
            Some(Order::ChooseFile) => self.choose_file(),
            Some(Order::SaveRecording) => self.save_recording(),
            Some(Order::Screenshot) => self.screenshot(),
            Some(Order::NextQuality) => self.next_quality(),
            Some(Order::Restarted) => self.outputs.keep_anew(&self.game.board)?,
            Some(Order::Quit) => event_loop.exit(),
        }
        Ok(())
    }

    /// Puts another maze on the board. One that cannot be loaded is reported, and what is there stays.
    pub(super) fn load(&mut self, source: Source, role: Role) -> Result<(), Failure> {
        let rules = *self.game.rules();
        let board = rules.load(&source).and_then(|maze| Board::new(maze, source, role, &rules));
        let ready = board.and_then(|board| Ok((self.look.textures_of(&board.source)?, board)));
        match ready {
            Ok((textures, board)) => {
                self.game.put(board)?;
                self.cover_with(textures);
                self.notice = None;
                self.show_board()?;
            }
            Err(failure) if self.game.screens.is_playing() => self.notify(failure.to_string()),
            Err(failure) => self.game.trouble = Some(failure.to_string()),
        }
        // The time it took to load is not played.
        self.timing.last_frame = Instant::now();
        Ok(())
    }

    fn show_board(&mut self) -> Result<(), Failure> {
        self.load_into_graphics()?;
        self.idle.wake();
        self.outputs.keep_anew(&self.game.board)
    }

    /// With the desktop's own window, on a thread of its own: it may stay open for long.
    fn choose_file(&mut self) {
        let (sender, receiver) = channel();
        let ask = move || {
            let endings = ["obj", "svg", "txt", "png", "bmp"];
            let chosen =
                rfd::FileDialog::new().set_title("Open a maze").add_filter("mazes", &endings).pick_file();
            // The game may have ended.
            let _ = sender.send(chosen);
        };
        match std::thread::Builder::new().name("choose a file".to_owned()).spawn(ask) {
            Ok(_) => self.dialog = Some(receiver),
            Err(error) => {
                self.game.trouble = Some(format!("no window to choose a file: {error}; type its path"))
            }
        }
    }

    /// What was chosen in the desktop's window, if it has been closed.
    fn take_chosen(&mut self) -> Result<(), Failure> {
        let Some(answer) = self.dialog.as_ref().map(|dialog| dialog.try_recv()) else { return Ok(()) };
        match answer {
            Err(std::sync::mpsc::TryRecvError::Empty) => {}
            Ok(Some(path)) => {
                self.dialog = None;
                self.load(self.game.board.source.of_file(path), Role::Play)?;
            }
            Ok(None) | Err(_) => {
                self.dialog = None;
                self.game.trouble =
                    Some("no file was chosen; a path can be typed, or a file dropped".to_owned());
                self.idle.wake();
            }
        }
        Ok(())
    }

    fn save_recording(&mut self) {
        let board = &self.game.board;
        let saved = board
            .source
            .words()
            .and_then(|words| board.session.recording(words))
            .and_then(|run| files::write_numbered(Path::new(""), "run", "maze", &run.to_bytes()));
        match saved {
            Ok(path) => self.game.saved(path.display().to_string()),
            Err(failure) => self.game.trouble = Some(failure.to_string()),
        }
    }

    /// Takes over what has changed in the settings since the last frame.
    fn apply_settings(&mut self, now: Instant) {
        if self.game.settings != self.kept.applied {
            self.game.settings_changed();
            let settings = self.game.settings.clone();
            if settings.video.quality != self.kept.applied.video.quality {
                self.look.quality = settings.video.quality.into();
            }
            let pause = settings.game.pause_without_focus;
            if pause != self.kept.applied.game.pause_without_focus && !self.unfocused_flag {
                self.presence.set(if pause { Unfocused::Pause } else { Unfocused::Run });
            }
            let is_video_new = settings.video != self.kept.applied.video;
            self.kept.applied = settings;
            self.kept.changed = Some(now);
            if is_video_new {
                self.apply_video();
            }
            self.idle.wake();
        }
        if self.kept.changed.is_some_and(|changed| SAVE_AFTER < now - changed) {
            self.kept.changed = None;
            if let Some(reason) = self.kept.file.save(&self.game.settings) {
                self.notify(reason);
            }
        }
    }

    fn apply_video(&mut self) {
        let video = &self.game.settings.video;
        let Some(graphics) = &mut self.graphics else { return };
        graphics.set_vsync(video.vsync && !self.options.uncapped);
        graphics.set_fullscreen(video.fullscreen);
        let quality = graphics.quality_of(self.look.quality);
        if quality != graphics.quality() && self.look.is_wanted(self.look.quality) {
            self.set_quality(quality);
        }
    }

    fn simulate(&mut self, elapsed: Duration) -> Result<(), Failure> {
        for _ in 0..self.game.advance(elapsed) {
            let events = self.game.tick()?;
            if !self.game.board.is_played() {
                continue;
            }
            // The other events are for sound; the screen reads the game's phase.
            let is_finished = events.iter().any(|event| matches!(event, Event::Finished(_)));
            self.outputs.note_tick(&self.game, is_finished)?;
        }
        Ok(())
    }

    /// A view of the whole board that leaves room at the lower and upper edge, and what it leaves at the side.
    fn whole(&self, graphics: &Graphics, [below, above]: [f32; 2]) -> (Camera, f32) {
        let covered = self.game.covered_width(graphics.size_points());
        let max_tilt_rad = to_f32(self.game.rules().max_tilt_rad);
        let half_size = self.game.board.session.half_size();
        let whole =
            view::fitted(self.game.pitch_rad(), half_size, graphics.aspect(), max_tilt_rad, covered.abs());
        (view::with_room(whole, below, above), covered)
    }

    fn pose(&self) -> Pose {
        let game = &self.game;
        let held = game.control.is_dragged().then_some(&game.control).filter(|_| game.screens.is_playing());
        game.board.session.pose(game.clock.alpha(), held)
    }

    /// Moves the view on.
    fn look_on(&mut self, elapsed: Duration) {
        let Some(graphics) = &self.graphics else { return };
        let (whole, _) = self.whole(graphics, ui::room(graphics.size_points()));
        let ball = self.pose().ball_in_world().cast();
        let (nearest, slides) = (self.game.nearest_zoom(), !self.game.settings.video.reduced_motion);
        self.game.view.update(elapsed, whole, ball, nearest, slides);
    }

    /// Maze and method as they are now, with room at the lower and upper edge.
    pub(super) fn picture(&self, room: [f32; 2]) -> Option<(Scene, Notes)> {
        let graphics = self.graphics.as_ref()?;
        let session = &self.game.board.session;
        let pose = self.pose();
        let (whole, covered) = self.whole(graphics, room);
        let camera = self.game.view.look(whole, pose.ball_in_world().cast());
        let mut scene = session.scene(&pose, view::beside(camera, graphics.aspect(), covered));
        let notes = overlay::add(self.game.layers, session, &mut scene, graphics.size());
        if self.game.settings.accessibility.high_contrast {
            overlay::mark(session, &pose, &mut scene);
        }
        Some((scene, notes))
    }

    fn frame(&mut self, event_loop: &ActiveEventLoop) -> Result<(), Failure> {
        let watch = Stopwatch::start();
        let now = Instant::now();
        self.take_chosen()?;
        self.apply_settings(now);
        // The time for which the program was stopped is not played.
        let elapsed = if rescue::was_stopped() { Duration::ZERO } else { now - self.timing.last_frame };
        self.timing.last_frame = now;
        let Some(graphics) = &mut self.graphics else { return Ok(()) };
        graphics.set_zoom(&self.game.settings);
        let size_points = graphics.size_points();
        let (adapter, quality, size) = (graphics.adapter(), graphics.quality(), graphics.size());
        let waits = self.presence.waits();
        self.simulate(if waits { Duration::ZERO } else { elapsed })?;
        let simulate = watch.ms();
        self.keep_up(elapsed)?;
        let pace = self.pace();
        let watch = Stopwatch::start();
        self.look_on(elapsed);
        let Some((scene, notes)) = self.picture(ui::room(size_points)) else { return Ok(()) };
        let game = &mut self.game;
        let notice = self.notice.as_ref().filter(|(_, since)| now.duration_since(*since) < NOTICE_TIME);
        let frames =
            FramesPanel { log: &self.outputs.frame_log, quality: quality.name(), size, adapter: &adapter };
        let extras = Extras {
            notice: notice.map(|(text, _)| text.as_str()),
            notes: &notes,
            pace: pace.as_deref(),
            frames: game.shows_frames.then_some(frames),
        };
        if self.idle.may_skip(now, &scene, &game.hud(&extras), size) {
            return Ok(());
        }
        let prepare = watch.ms();
        let number = self.outputs.frame_log.next_number();
        let mut chosen = None;
        let drawn = graphics_draw(&mut self.graphics, (&scene, number), |ui| {
            game.hud(&extras).show(ui);
            chosen = chosen.take().or(game.draw_screen(ui, &notes));
        })?;
        match drawn {
            Drawn::Shown { encode, present } => {
                self.outputs.push_frame(Parts { simulate, encode: prepare + encode, present });
                if let Some(graphics) = &mut self.graphics {
                    graphics.tell_times(&mut self.outputs.frame_log);
                    if self.timing.first_frame.is_none() {
                        graphics.wait();
                        self.timing.first_frame = Some(Instant::now());
                    }
                }
                self.outputs.drawn_by = Some((adapter, quality, size));
            }
            Drawn::Hidden => {}
            Drawn::DeviceLost => {
                // The old device must be gone before a new one may have the window.
                let lost = self.graphics.take();
                self.graphics = lost.map(|lost| lost.rebuilt(&self.look.textures)).transpose()?;
                self.load_into_graphics()?;
            }
        }
        if let Some(choice) = chosen {
            let order = self.game.choose(choice)?;
            self.obey(event_loop, order)?;
        }
        Ok(())
    }

    fn handle(&mut self, event_loop: &ActiveEventLoop, event: WindowEvent) -> Result<(), Failure> {
        let is_playing = self.game.screens.is_playing();
        let Some(graphics) = &mut self.graphics else { return Ok(()) };
        if !matches!(event, WindowEvent::KeyboardInput { .. } | WindowEvent::RedrawRequested) {
            graphics.feed(&event);
            if !is_playing {
                self.idle.wake();
            }
        }
        match event {
            WindowEvent::CloseRequested => event_loop.exit(),
            WindowEvent::Destroyed => {
                // Somebody else closed it: there is nothing left to draw on.
                self.graphics = None;
                event_loop.exit();
            }
            WindowEvent::Resized(size) => {
                graphics.resize(size.into());
                self.idle.wake();
            }
            WindowEvent::ScaleFactorChanged { scale_factor, inner_size_writer } => {
                display::rescale(scale_factor, inner_size_writer, graphics.size());
                self.idle.wake();
            }
            WindowEvent::Occluded(hidden) => {
                self.presence.occlude(hidden);
                // The time behind other windows is not played.
                self.timing.last_frame = Instant::now();
            }
            WindowEvent::Focused(has_it) => self.focus(has_it),
            WindowEvent::ModifiersChanged(modifiers) => self.game.keyboard.set_modifiers(modifiers.state()),
            WindowEvent::KeyboardInput { .. } => self.key(event_loop, &event)?,
            WindowEvent::CursorMoved { position, .. } => self.pointer(position),
            WindowEvent::MouseInput { state, button: MouseButton::Left, .. } => match state {
                ElementState::Released => self.game.control.end_drag(),
                ElementState::Pressed if is_playing => self.game.control.begin_drag(),
                ElementState::Pressed => {}
            },
            WindowEvent::MouseWheel { delta, .. } if is_playing => {
                self.game.view.zoom_by_notches(match delta {
                    MouseScrollDelta::LineDelta(_, notches) => f64::from(notches),
                    MouseScrollDelta::PixelDelta(pixels) => pixels.y / PIXELS_PER_NOTCH,
                });
            }
            WindowEvent::DroppedFile(path) => self.load(self.game.board.source.of_file(path), Role::Play)?,
            WindowEvent::RedrawRequested => self.frame(event_loop)?,
            _ => {}
        }
        Ok(())
    }
}

fn graphics_draw(
    graphics: &mut Option<Graphics>,
    scene: (&maze_render::Scene, u64),
    show: impl FnMut(&mut egui::Ui),
) -> Result<Drawn, Failure> {
    graphics.as_mut().map_or(Ok(Drawn::Hidden), |graphics| graphics.draw(scene, show))
}

impl ApplicationHandler for App {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        if self.graphics.is_some() {
            return;
        }
        if let Err(failure) = self.open_window(event_loop) {
            return self.end_with(event_loop, failure);
        }
        self.timing.opened = Instant::now();
        self.timing.last_frame = self.timing.opened;
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        if let Err(failure) = self.handle(event_loop, event) {
            self.end_with(event_loop, failure);
        }
    }

    fn new_events(&mut self, event_loop: &ActiveEventLoop, _: StartCause) {
        let begun = self.timing.first_frame.unwrap_or(self.timing.opened);
        if self.timing.exit_after.is_some_and(|exit_after| exit_after <= begun.elapsed()) {
            event_loop.exit();
        }
    }

    fn about_to_wait(&mut self, event_loop: &ActiveEventLoop) {
        rescue::beat();
        let Some(graphics) = &self.graphics else { return };
        let now = Instant::now();
        if self.presence.is_hidden() || !graphics.has_area() {
            self.timing.last_frame = now;
            return event_loop.set_control_flow(ControlFlow::WaitUntil(now + HIDDEN_WAKE));
        }
        if self.timing.next_frame <= now {
            // Kept to a fixed rhythm. A frame that came late is made up for, by one frame at most: timers and a busy
            // machine are late all the time, and after a pause there must be no burst.
            let frame_time = match (self.options.uncapped, self.game.settings.video.frame_cap) {
                (true, _) => Duration::ZERO,
                (false, 0) => graphics.frame_time(),
                (false, frames_per_s) => Duration::from_secs(1) / frames_per_s,
            };
            let earliest = now.checked_sub(frame_time).unwrap_or(now);
            self.timing.next_frame = (self.timing.next_frame + frame_time).max(earliest);
            graphics.request_redraw();
        }
        event_loop.set_control_flow(ControlFlow::WaitUntil(self.timing.next_frame));
    }
}
