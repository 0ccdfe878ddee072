//! The window: events in, frames out; nothing else.

use super::graphics::{Drawn, Graphics};
use super::idle::Idle;
use super::presence::Presence;
use super::watch::Watch;
use super::{display, layout};
use crate::clock::Clock;
use crate::demo::Demo;
use crate::failure::Failure;
use crate::frame_log::{FrameLog, Parts, Stopwatch};
use crate::input::{Action, Keyboard, TiltControl};
use crate::numbers::to_f32;
use crate::overlay::{self, Layers, Notes};
use crate::platform::native::keeper::{Keeper, KeptFrames};
use crate::platform::native::rescue::{self, OpenWindow};
use crate::platform::native::state_log::{State, StateLog};
use crate::quality::QualityChoice;
use crate::session::Session;
use crate::setup::{Setup, Unfocused};
use crate::slowness::Slowness;
use crate::source::Source;
use crate::ui::{self, FramesPanel, Hud, Labels};
use crate::view::{self, View};
use maze_core::{Event, Maze, Phase};
use maze_render::{Quality, TextureSet};
use std::path::PathBuf;
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

/// What `maze-app frames` does differently from `maze-app play`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Options {
    /// The autopilot plays, round after round.
    pub(crate) demo: bool,
    /// As many frames as the window takes.
    pub(crate) uncapped: bool,
    /// Of the window (pixels).
    pub(crate) size: Option<[u32; 2]>,
    /// How long frames are remembered (s).
    pub(crate) keep_s: f64,
}

impl Default for Options {
    fn default() -> Self {
        Self { demo: false, uncapped: false, size: None, keep_s: 10.0 }
    }
}

/// Everything that lives as long as the window.
pub(crate) struct App {
    pub(super) game: Session,
    pub(super) clock: Clock,
    pub(super) keyboard: Keyboard,
    pub(super) control: TiltControl,
    pub(super) presence: Presence,
    pub(super) view: View,
    pub(super) source: Source,
    pub(super) labels: Labels,
    pub(super) textures: TextureSet,
    /// Where they come from whatever the maze.
    pub(super) textures_flag: Option<PathBuf>,
    /// Where to write it; opened with the window, so that nothing is lost when there is none.
    pub(super) state_log_path: Option<PathBuf>,
    pub(super) state_log: Option<StateLog>,
    /// Keeps the run to be written; nothing any more when one that reached the goal stands there.
    pub(super) keeper: Option<Keeper>,
    pub(super) exit_after: Option<Duration>,
    pub(super) quality: QualityChoice,
    pub(super) options: Options,
    /// Plays in the player's place.
    pub(super) demo: Option<Demo>,
    pub(super) graphics: Option<Graphics>,
    /// Who drew the last frame: adapter, quality, size.
    pub(super) drawn_by: Option<(String, Quality, [u32; 2])>,
    pub(super) frame_log: FrameLog,
    /// The frames once more, to be written when the program is ended from outside.
    pub(super) kept_frames: Option<KeptFrames>,
    pub(super) shows_frames: bool,
    pub(super) slowness: Slowness,
    /// Whether the quality was chosen by the user, and stays.
    pub(super) quality_is_chosen: bool,
    pub(super) idle: Idle,
    /// Where it was last, if anywhere.
    pub(super) cursor: Option<PhysicalPosition<f64>>,
    pub(super) help: bool,
    pub(super) layers: Layers,
    /// News of a moment, such as why a dropped file was not loaded, and when.
    pub(super) notice: Option<(String, Instant)>,
    pub(super) n_ticks: u64,
    pub(super) max_tilt_rad: f32,
    pub(super) opened: Instant,
    pub(super) first_frame: Option<Instant>,
    pub(super) last_frame: Instant,
    pub(super) next_frame: Instant,
    pub(super) failure: Option<Failure>,
}

impl App {
    pub(crate) fn new(setup: Setup, options: Options, maze: Maze) -> Result<Self, Failure> {
        let game = Session::new(maze, setup.engine)?;
        let demo = options.demo.then(|| Demo::new(&game, setup.max_tilt_rad)).transpose()?;
        // What ends by itself, or plays by itself, does not wait for the player unless a flag asks for it.
        let waits = demo.is_none() && setup.exit_after.is_none();
        let usual = if waits { Unfocused::Pause } else { Unfocused::Run };
        let unfocused = setup.unfocused.unwrap_or(usual);
        let now = Instant::now();
        let keeper =
            setup.record.as_deref().map(|path| Keeper::new(path, &game, &setup.source)).transpose()?;
        Ok(Self {
            clock: Clock::new(game.tick_s()),
            keyboard: Keyboard::default(),
            control: TiltControl::new(setup.max_tilt_rad),
            presence: Presence::new(unfocused),
            view: View::default(),
            labels: Labels::new(&setup.source, game.maze()),
            game,
            source: setup.source,
            textures: setup.textures,
            textures_flag: setup.textures_flag,
            state_log_path: setup.state_log,
            state_log: None,
            keeper,
            exit_after: setup.exit_after,
            quality: setup.quality,
            options,
            demo,
            graphics: None,
            drawn_by: None,
            frame_log: FrameLog::new(options.keep_s),
            kept_frames: setup.csv.map(KeptFrames::new),
            shows_frames: false,
            slowness: Slowness::default(),
            quality_is_chosen: setup.quality.is_chosen(),
            idle: Idle::default(),
            cursor: None,
            help: true,
            layers: Layers::default(),
            notice: None,
            n_ticks: 0,
            max_tilt_rad: to_f32(setup.max_tilt_rad),
            opened: now,
            first_frame: None,
            last_frame: now,
            next_frame: now,
            failure: None,
        })
    }

    /// Until the window closes.
    pub(crate) fn run(mut self, event_loop: EventLoop<()>) -> Result<Self, Failure> {
        let open = OpenWindow::new();
        if let Some(time) = self.exit_after {
            rescue::end_after(time);
        }
        let ran = display::guarded(|| event_loop.run_app(&mut self));
        drop(open);
        // Whatever ended the game, what was played is written first.
        let written = self.write_recording();
        ran?.map_err(Failure::bad_input)?;
        written?;
        match self.failure.take() {
            Some(failure) => Err(failure),
            None => Ok(self),
        }
    }

    /// Adapter, quality and size of the last frame.
    pub(crate) fn drawn_by(&self) -> Option<(String, Quality, [u32; 2])> {
        self.drawn_by.clone()
    }

    /// When the first frame had been drawn.
    pub(crate) fn first_frame(&self) -> Option<Instant> {
        self.first_frame
    }

    pub(crate) fn into_frame_log(self) -> FrameLog {
        self.frame_log
    }

    fn write_recording(&self) -> Result<(), Failure> {
        self.keeper.as_ref().map_or(Ok(()), Keeper::write)
    }

    fn end_with(&mut self, event_loop: &ActiveEventLoop, failure: Failure) {
        self.failure = Some(failure);
        event_loop.exit();
    }

    pub(super) fn load_into_graphics(&mut self) -> Result<(), Failure> {
        let Some(graphics) = &mut self.graphics else { return Ok(()) };
        graphics.set_maze(self.game.maze(), &format!("Maze  {}", ui::window_title(&self.source.title())))
    }

    fn open_window(&mut self, event_loop: &ActiveEventLoop) -> Result<(), Failure> {
        let size = display::window_size(event_loop, self.options.size, WINDOW_SIZE);
        let attributes = Window::default_attributes().with_inner_size(size).with_title("Maze");
        let window = event_loop
            .create_window(attributes)
            .map_err(|error| Failure::bad_input(format!("cannot open a window: {error}")))?;
        self.presence.watch(Watch::new(&window));
        if self.presence.is_on_x11() {
            self.keyboard.set_layouts(layout::read(), None);
        }
        self.graphics = Some(Graphics::new(event_loop, window, &self.textures, self.quality)?);
        self.load_into_graphics()?;
        self.state_log = self.state_log_path.as_deref().map(StateLog::create).transpose()?;
        Ok(())
    }

    pub(super) fn act(&mut self, event_loop: &ActiveEventLoop, action: Action) -> Result<(), Failure> {
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
            Action::ToggleFullscreen => self.graphics.iter().for_each(Graphics::toggle_fullscreen),
            Action::NextGhost => self.game.next_ghost()?,
            Action::NextQuality => self.next_quality()?,
            Action::Screenshot => self.screenshot(),
            Action::Quit => event_loop.exit(),
            Action::Restart => {
                self.control.level();
                self.game.restart()?;
                self.keep_anew()?;
            }
            Action::GoOn => {
                let changed = self.source.go_on()?;
                self.load(changed)?;
            }
            Action::GoOnFromGoal => {
                if self.game.phase() == Phase::Finished {
                    self.act(event_loop, Action::GoOn)?;
                }
            }
            Action::NextLevel | Action::PreviousLevel => {
                let changed = self.source.change_level(action == Action::NextLevel)?;
                self.load(changed)?;
            }
        }
        Ok(())
    }

    /// Loads the source's maze when it has changed.
    pub(super) fn load(&mut self, changed: bool) -> Result<(), Failure> {
        if changed {
            self.game = self.game.on(self.source.load()?)?;
            self.cover_with(self.textures_of(&self.source)?);
            self.load_into_graphics()?;
            self.begin();
            self.keep_anew()?;
        }
        Ok(())
    }

    /// The game has restarted.
    fn keep_anew(&mut self) -> Result<(), Failure> {
        self.keeper.as_mut().map_or(Ok(()), |keeper| keeper.begin(&self.game, &self.source))
    }

    /// Another maze is there: level, all of it in view.
    fn begin(&mut self) {
        self.labels = Labels::new(&self.source, self.game.maze());
        self.control.level();
        self.view.show_all();
        self.notice = None;
        self.idle.wake();
    }

    /// Plays a file dropped on the window. One that is no maze is reported, and the game continues.
    pub(super) fn drop_file(&mut self, path: PathBuf) -> Result<(), Failure> {
        let source = self.source.of_file(path);
        let game = source.load().and_then(|maze| self.game.on(maze));
        match game.and_then(|game| Ok((game, self.textures_of(&source)?))) {
            Ok((game, textures)) => {
                (self.game, self.source) = (game, source);
                self.cover_with(textures);
                self.load_into_graphics()?;
                self.begin();
                self.keep_anew()?;
            }
            Err(failure) => self.notice = Some((failure.to_string(), Instant::now())),
        }
        // The time it took to load is not played.
        self.last_frame = Instant::now();
        Ok(())
    }

    fn simulate(&mut self, elapsed: Duration) -> Result<(), Failure> {
        for _ in 0..self.clock.advance(elapsed.as_secs_f64()) {
            self.control.tick(self.game.tick_s());
            let tilt = match &mut self.demo {
                Some(demo) => demo.tilt(&mut self.game)?,
                None => self.control.tilt(),
            };
            // The other events are for sound; the screen reads the game's phase.
            let events = self.game.tick(tilt)?;
            if events.iter().any(|event| matches!(event, Event::Finished(_))) {
                if let Some(keeper) = &mut self.keeper {
                    keeper.add(&self.game);
                }
                self.write_recording()?;
                self.keeper = None;
            }
            self.n_ticks += 1;
            self.log_state()?;
        }
        if let Some(keeper) = &mut self.keeper {
            keeper.add(&self.game);
        }
        Ok(())
    }

    fn log_state(&mut self) -> Result<(), Failure> {
        let Some(log) = &mut self.state_log else { return Ok(()) };
        let orientation = self.game.tilt().world_from_maze();
        let ball = self.game.ball();
        log.write(&State {
            tick: self.n_ticks,
            orientation: [orientation.w, orientation.i, orientation.j, orientation.k],
            position: ball.position.into(),
            velocity: ball.velocity.into(),
            camera_distance: self.view.camera().distance,
            phase: self.game.phase().name(),
            clock_ticks: self.game.n_ticks(),
        })
    }

    fn frame(&mut self) -> Result<(), Failure> {
        let watch = Stopwatch::start();
        let now = Instant::now();
        // The time for which the program was stopped is not played.
        let elapsed = if rescue::was_stopped() { Duration::ZERO } else { now - self.last_frame };
        self.last_frame = now;
        let Some(graphics) = &self.graphics else { return Ok(()) };
        let (aspect, size_points) = (graphics.aspect(), graphics.size_points());
        let (adapter, quality, size) = (graphics.adapter(), graphics.quality(), graphics.size());
        let waits = self.presence.waits();
        self.simulate(if waits { Duration::ZERO } else { elapsed })?;
        let simulate = watch.ms();
        self.keep_up(elapsed)?;
        let pace = self.pace();
        let watch = Stopwatch::start();
        let notice = self.notice.as_ref().filter(|(_, since)| now.duration_since(*since) < NOTICE_TIME);
        let hud = Hud {
            phase: self.game.phase(),
            n_ticks: self.game.n_ticks(),
            tick_s: self.game.tick_s(),
            ghost: self.game.ghost(),
            labels: &self.labels,
            help: self.help,
            notice: notice.map(|(text, _)| text.as_str()),
            layers: self.layers,
            notes: &Notes::default(),
            pace: pace.as_deref(),
            keyboard: &self.keyboard,
            frames: self.shows_frames.then_some(FramesPanel {
                log: &self.frame_log,
                quality: quality.name(),
                size,
                adapter: &adapter,
            }),
        };
        let held = self.control.is_dragged().then_some(&self.control);
        let pose = self.game.pose(self.clock.alpha(), held);
        let left = ui::covered_width(self.layers, size_points);
        let whole = view::fitted(self.game.half_size(), aspect, self.max_tilt_rad, left);
        let whole = view::with_room_below(whole, hud.covered_part(size_points));
        self.view.update(elapsed, whole, pose.ball_in_world().cast());
        let mut scene = self.game.scene(&pose, view::beside(self.view.camera(), aspect, left));
        let notes = overlay::add(self.layers, &self.game, &mut scene, size);
        let hud = Hud { notes: &notes, ..hud };
        if self.idle.may_skip(now, &scene, &hud, size) {
            return Ok(());
        }
        let prepare = watch.ms();
        let number = self.frame_log.next_number();
        let Some(graphics) = &mut self.graphics else { return Ok(()) };
        match graphics.draw(&scene, &hud, number)? {
            Drawn::Shown { encode, present } => {
                self.frame_log.push(Parts { simulate, encode: prepare + encode, present });
                if let Some(kept) = &self.kept_frames {
                    kept.add(&self.frame_log);
                }
                graphics.tell_times(&mut self.frame_log);
                if self.first_frame.is_none() {
                    graphics.wait();
                    self.first_frame = Some(Instant::now());
                }
                self.drawn_by = Some((adapter, quality, size));
            }
            Drawn::Hidden => {}
            Drawn::DeviceLost => {
                // The old device must be gone before a new one may have the window.
                self.graphics = self.graphics.take().map(|lost| lost.rebuilt(&self.textures)).transpose()?;
                self.load_into_graphics()?;
            }
        }
        Ok(())
    }

    fn handle(&mut self, event_loop: &ActiveEventLoop, event: WindowEvent) -> Result<(), Failure> {
        let Some(graphics) = &mut self.graphics else { return Ok(()) };
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
                self.last_frame = Instant::now();
            }
            WindowEvent::Focused(has_it) => self.focus(has_it),
            WindowEvent::ModifiersChanged(modifiers) => self.keyboard.set_modifiers(modifiers.state()),
            WindowEvent::KeyboardInput { event, is_synthetic, .. } => {
                self.key(event_loop, &event, is_synthetic)?;
            }
            WindowEvent::CursorMoved { position, .. } => self.pointer(position),
            WindowEvent::MouseInput { state, button: MouseButton::Left, .. } => match state {
                ElementState::Released => self.control.end_drag(),
                ElementState::Pressed => self.control.begin_drag(),
            },
            WindowEvent::MouseWheel { delta, .. } => self.view.zoom_by_notches(match delta {
                MouseScrollDelta::LineDelta(_, notches) => f64::from(notches),
                MouseScrollDelta::PixelDelta(pixels) => pixels.y / PIXELS_PER_NOTCH,
            }),
            WindowEvent::DroppedFile(path) => self.drop_file(path)?,
            WindowEvent::RedrawRequested => self.frame()?,
            _ => {}
        }
        Ok(())
    }
}

impl ApplicationHandler for App {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        if self.graphics.is_some() {
            return;
        }
        if let Err(failure) = self.open_window(event_loop) {
            return self.end_with(event_loop, failure);
        }
        self.opened = Instant::now();
        self.last_frame = self.opened;
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        if let Err(failure) = self.handle(event_loop, event) {
            self.end_with(event_loop, failure);
        }
    }

    fn new_events(&mut self, event_loop: &ActiveEventLoop, _: StartCause) {
        let begun = self.first_frame.unwrap_or(self.opened);
        if self.exit_after.is_some_and(|exit_after| exit_after <= begun.elapsed()) {
            event_loop.exit();
        }
    }

    fn about_to_wait(&mut self, event_loop: &ActiveEventLoop) {
        rescue::beat();
        let Some(graphics) = &self.graphics else { return };
        let now = Instant::now();
        if self.presence.is_hidden() || !graphics.has_area() {
            self.last_frame = now;
            return event_loop.set_control_flow(ControlFlow::WaitUntil(now + HIDDEN_WAKE));
        }
        if self.next_frame <= now {
            // Kept to a fixed rhythm. A frame that came late is made up for, by one frame at most: timers and a busy
            // machine are late all the time, and after a pause there must be no burst.
            let frame_time = if self.options.uncapped { Duration::ZERO } else { graphics.frame_time() };
            let earliest = now.checked_sub(frame_time).unwrap_or(now);
            self.next_frame = (self.next_frame + frame_time).max(earliest);
            graphics.request_redraw();
        }
        event_loop.set_control_flow(ControlFlow::WaitUntil(self.next_frame));
    }
}
