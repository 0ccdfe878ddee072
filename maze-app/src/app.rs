//! The window: events in, frames out; nothing else.

mod graphics;
mod idle;
mod picture;
pub(crate) mod view;

use crate::clock::Clock;
use crate::command::play::Setup;
use crate::demo::Demo;
use crate::failure::Failure;
use crate::files;
use crate::frame_log::{FrameLog, Parts, Stopwatch};
use crate::game::{Game, to_f32};
use crate::input::{self, Action, TiltControl};
use crate::overlay::{self, Layers, Notes};
use crate::quality::QualityChoice;
use crate::source::Source;
use crate::state_log::{State, StateLog};
use crate::ui::{self, FramesPanel, Hud, Labels};
use graphics::{Drawn, Graphics};
use idle::Idle;
use maze_core::{Event, Maze, Phase};
use maze_render::{Quality, TextureSet};
use std::path::PathBuf;
use std::time::{Duration, Instant};
use view::View;
use winit::application::ApplicationHandler;
use winit::dpi::{LogicalSize, PhysicalPosition, PhysicalSize, Size};
use winit::event::{ElementState, KeyEvent, MouseButton, MouseScrollDelta, StartCause, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop};
use winit::keyboard::PhysicalKey;
use winit::window::{Window, WindowId};

/// Size of a new window (logical pixels).
const WINDOW_SIZE: LogicalSize<u32> = LogicalSize::new(1280, 720);

/// Pixels of a touchpad's scroll that count as one notch of a wheel.
const PIXELS_PER_NOTCH: f64 = 40.0;

/// While nothing is shown, how often to look whether it is time to end.
const HIDDEN_WAKE: Duration = Duration::from_millis(100);

/// How long a message stays on screen.
const NOTICE_TIME: Duration = Duration::from_secs(10);

/// The way to the window system, or one line that says why there is none.
pub(crate) fn event_loop() -> Result<EventLoop<()>, Failure> {
    // The error itself names a line of the library's source, and says no more than this.
    EventLoop::new().map_err(|_| {
        let named = |name: &str| std::env::var(name).map(|value| format!(" ({name} is {value})"));
        let which = named("WAYLAND_DISPLAY").or_else(|_| named("DISPLAY")).unwrap_or_default();
        Failure::bad_input(format!(
            "no display to open a window on{which}; `maze-app render` draws without one"
        ))
    })
}

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
    game: Game,
    clock: Clock,
    control: TiltControl,
    view: View,
    source: Source,
    labels: Labels,
    textures: TextureSet,
    /// Where they come from whatever the maze.
    textures_flag: Option<PathBuf>,
    /// Where to write it; opened with the window, so that nothing is lost when there is none.
    state_log_path: Option<PathBuf>,
    state_log: Option<StateLog>,
    /// Where to write the run, and whether one that reached the goal stands there.
    record: Option<PathBuf>,
    is_recorded: bool,
    exit_after: Option<Duration>,
    quality: QualityChoice,
    options: Options,
    /// Plays in the player's place.
    demo: Option<Demo>,
    graphics: Option<Graphics>,
    /// Who drew the last frame: adapter, quality, size.
    drawn_by: Option<(String, Quality, [u32; 2])>,
    frame_log: FrameLog,
    shows_frames: bool,
    idle: Idle,
    cursor: PhysicalPosition<f64>,
    help: bool,
    layers: Layers,
    /// News of a moment, such as why a dropped file was not loaded, and when.
    notice: Option<(String, Instant)>,
    hidden: bool,
    n_ticks: u64,
    max_tilt_rad: f32,
    opened: Instant,
    first_frame: Option<Instant>,
    last_frame: Instant,
    next_frame: Instant,
    failure: Option<Failure>,
}

impl App {
    pub(crate) fn new(setup: Setup, options: Options, maze: Maze) -> Result<Self, Failure> {
        let game = Game::new(maze, setup.engine)?;
        let demo = options.demo.then(|| Demo::new(&game, setup.max_tilt_rad)).transpose()?;
        let now = Instant::now();
        Ok(Self {
            clock: Clock::new(game.tick_s()),
            control: TiltControl::new(setup.max_tilt_rad),
            view: View::default(),
            labels: Labels::new(&setup.source, game.maze()),
            game,
            source: setup.source,
            textures: setup.textures,
            textures_flag: setup.textures_flag,
            state_log_path: setup.state_log,
            state_log: None,
            record: setup.record,
            is_recorded: false,
            exit_after: setup.exit_after,
            quality: setup.quality,
            options,
            demo,
            graphics: None,
            drawn_by: None,
            frame_log: FrameLog::new(options.keep_s),
            shows_frames: false,
            idle: Idle::default(),
            cursor: PhysicalPosition::default(),
            help: true,
            layers: Layers::default(),
            notice: None,
            hidden: false,
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
        event_loop.run_app(&mut self).map_err(Failure::bad_input)?;
        if !self.is_recorded {
            self.write_recording()?;
        }
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
        let Some(path) = &self.record else { return Ok(()) };
        files::write_whole(path, &self.game.recording(&self.source)?.to_bytes())
    }

    fn end_with(&mut self, event_loop: &ActiveEventLoop, failure: Failure) {
        self.failure = Some(failure);
        event_loop.exit();
    }

    fn load_into_graphics(&mut self) -> Result<(), Failure> {
        let Some(graphics) = &mut self.graphics else { return Ok(()) };
        graphics.set_maze(self.game.maze(), &format!("Maze  {}", self.source.title()))
    }

    fn open_window(&mut self, event_loop: &ActiveEventLoop) -> Result<(), Failure> {
        let size = self.options.size.map(|[width, height]| Size::from(PhysicalSize::new(width, height)));
        let size = size.unwrap_or(WINDOW_SIZE.into());
        let attributes = Window::default_attributes().with_inner_size(size).with_title("Maze");
        let window = event_loop
            .create_window(attributes)
            .map_err(|error| Failure::bad_input(format!("cannot open a window: {error}")))?;
        self.graphics = Some(Graphics::new(event_loop, window, &self.textures, self.quality)?);
        self.load_into_graphics()?;
        self.state_log = self.state_log_path.as_deref().map(StateLog::create).transpose()?;
        Ok(())
    }

    fn act(&mut self, event_loop: &ActiveEventLoop, action: Action) -> Result<(), Failure> {
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
    fn load(&mut self, changed: bool) -> Result<(), Failure> {
        if changed {
            self.game = self.game.on(self.source.load()?)?;
            self.cover_with(self.textures_of(&self.source)?);
            self.load_into_graphics()?;
            self.begin();
        }
        Ok(())
    }

    /// Another maze is there: level, all of it in view.
    fn begin(&mut self) {
        self.labels = Labels::new(&self.source, self.game.maze());
        self.control.level();
        self.view.show_all();
        self.notice = None;
        self.idle.wake();
    }

    /// Plays a file dropped on the window. One that is no maze is told, and the game goes on.
    fn drop_file(&mut self, path: PathBuf) -> Result<(), Failure> {
        let source = self.source.of_file(path);
        let game = source.load().and_then(|maze| self.game.on(maze));
        match game.and_then(|game| Ok((game, self.textures_of(&source)?))) {
            Ok((game, textures)) => {
                (self.game, self.source) = (game, source);
                self.cover_with(textures);
                self.load_into_graphics()?;
                self.begin();
            }
            Err(failure) => self.notice = Some((failure.to_string(), Instant::now())),
        }
        // The time it took to load is not played.
        self.last_frame = Instant::now();
        Ok(())
    }

    fn key(&mut self, event_loop: &ActiveEventLoop, event: &KeyEvent) -> Result<(), Failure> {
        let PhysicalKey::Code(key) = event.physical_key else { return Ok(()) };
        let pressed = event.state == ElementState::Pressed;
        if let Some(direction) = input::tilt_direction_of(key)
            && !event.repeat
        {
            self.control.key(direction, pressed);
        }
        match input::action_of(&event.logical_key) {
            // Held zoom and step keys go on; everything else happens once a press.
            Some(action @ (Action::ZoomIn | Action::ZoomOut | Action::Step)) if pressed => {
                self.act(event_loop, action)
            }
            Some(action) if pressed && !event.repeat => self.act(event_loop, action),
            _ => Ok(()),
        }
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
                self.write_recording()?;
                self.is_recorded = true;
            }
            self.n_ticks += 1;
            self.log_state()?;
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
        let elapsed = now - self.last_frame;
        self.last_frame = now;
        let Some(graphics) = &self.graphics else { return Ok(()) };
        let (aspect, size_points) = (graphics.aspect(), graphics.size_points());
        let (adapter, quality, size) = (graphics.adapter(), graphics.quality(), graphics.size());
        self.simulate(elapsed)?;
        let simulate = watch.ms();
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
            pace: self.clock.pace(),
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
            WindowEvent::Occluded(hidden) => {
                self.hidden = hidden;
                // The time behind other windows is not played.
                self.last_frame = Instant::now();
            }
            WindowEvent::Focused(false) => self.control.release_all(),
            WindowEvent::KeyboardInput { event, is_synthetic: false, .. } => self.key(event_loop, &event)?,
            WindowEvent::CursorMoved { position, .. } => {
                self.cursor = position;
                if let Some(point) = graphics.arcball_point(position.into()) {
                    self.control.drag_to(point);
                }
            }
            WindowEvent::MouseInput { state, button: MouseButton::Left, .. } => match state {
                ElementState::Released => self.control.end_drag(),
                ElementState::Pressed => {
                    if let Some(point) = graphics.arcball_point(self.cursor.into()) {
                        self.control.begin_drag(point);
                    }
                }
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
        let Some(graphics) = &self.graphics else { return };
        let now = Instant::now();
        if self.hidden || !graphics.has_area() {
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
