//! `maze-app frames`: how fast frames come, and what they cost.

use crate::clock::Clock;
use crate::demo::Demo;
use crate::engine_kind::EngineKind;
use crate::failure::Failure;
use crate::frame::FramePainter;
use crate::frame_log::{FrameLog, Parts, Spread, Stopwatch};
use crate::game::{Board, Role, Rules};
use crate::input::Keyboard;
use crate::numbers::to_f32;
use crate::numbers::to_points;
use crate::overlay::Notes;
use crate::platform::native::files;
use crate::platform::native::keeper::KeptFrames;
use crate::platform::native::{self, App, Look, SettingsFile};
use crate::plot;
use crate::quality::QualityChoice;
use crate::recipe::parse_pixel_size;
use crate::screen::{Date, Screen};
use crate::session::Session;
use crate::settings::Settings;
use crate::setup::{Options, Setup, USUAL_MAX_TILT_DEGREES, parse_seconds};
use crate::source::{ReadArguments, Source};
use crate::ui::{Hud, Labels};
use clap::Args;
use egui::RawInput;
use maze_core::layout::{Algorithm, Recipe};
use maze_render::{Camera, Gpu, Quality};
use std::collections::VecDeque;
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// The random maze that is played where no file is given.
const SEED: u64 = 1;
const GRID_SIZE: [usize; 2] = [14, 9];

/// Longest side of a picture that every adapter can draw (pixels).
const EVERY_ADAPTER: u32 = 2048;

/// Frames submitted and not yet drawn, offscreen: as many as a window's driver lets a game be ahead.
const N_FRAMES_AHEAD: usize = 2;

#[derive(Args)]
#[command(after_help = "Examples:\n  maze-app frames --seconds 20 --csv frames.csv --plot frames.png\n  \
                        maze-app frames --offscreen --size 1920x1080 --quality high\n\n\
                        In a window frames come as in the game, at most 60 a second on a software driver and 240 elsewhere,\n\
                        unless --uncapped; offscreen as fast as they can.")]
pub(crate) struct Arguments {
    /// A maze (.obj, .svg, .txt, .png or .bmp); without one, always the same random maze
    file: Option<PathBuf>,
    #[command(flatten)]
    read: ReadArguments,
    /// How long, from the first frame on
    #[arg(long, value_name = "N", value_parser = parse_seconds, default_value = "10")]
    seconds: Duration,
    /// Pixels
    #[arg(long, value_name = "WxH", value_parser = parse_pixel_size, default_value = "1280x720")]
    size: [u32; 2],
    /// Without a window
    #[arg(long)]
    offscreen: bool,
    /// As many frames as the window takes
    #[arg(long)]
    uncapped: bool,
    /// How much is spent on the picture
    #[arg(long, value_enum, default_value_t = QualityChoice::Auto)]
    quality: QualityChoice,
    /// Write a line a frame: times of the clock, of the processor, of its parts, and of the adapter
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Draw frames a second and the processor's share over time; the name ends in .png or .svg
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
}

/// What was measured, and on what.
struct Measured {
    log: FrameLog,
    adapter: String,
    quality: Quality,
    size: [u32; 2],
    first_frame: Option<Duration>,
}

/// `started` is when the program did.
pub(crate) fn run(arguments: &Arguments, started: Instant) -> Result<(), Failure> {
    if let Some(path) = &arguments.plot
        && files::expect_extension(path, "svg").is_err()
    {
        files::expect_extension(path, "png")
            .map_err(|_| Failure::in_file(path, "expected a name that ends in .png or .svg"))?;
    }
    let csv = arguments.csv.as_deref().map(|path| ("--csv", path));
    let plot = arguments.plot.as_deref().map(|path| ("--plot", path));
    let outputs: Vec<files::Named> = csv.into_iter().chain(plot).collect();
    files::expect_outputs(&outputs, &source(arguments).inputs())?;
    let measured = match arguments.offscreen {
        true => offscreen(arguments, started)?,
        false => in_a_window(arguments, started)?,
    };
    let title = measured.title();
    if let Some(path) = &arguments.csv {
        files::write_whole(path, measured.log.csv().as_bytes())?;
    }
    if let Some(path) = &arguments.plot {
        let is_svg = files::expect_extension(path, "svg").is_ok();
        let draw = if is_svg { plot::svg } else { plot::png };
        files::write_whole(path, &draw(&measured.log, &title)?)?;
    }
    files::print(&measured.text())
}

impl Measured {
    fn title(&self) -> String {
        let [width, height] = self.size;
        format!("{width}x{height}, quality {}, {}", self.quality.name(), self.adapter)
    }

    fn text(&self) -> String {
        let line = |name: &str, spread: Option<Spread>| match spread {
            Some(Spread { median, p99 }) => format!("{name:21}{median:.3} ms median, {p99:.3} ms p99\n"),
            None => format!("{name:21}not known\n"),
        };
        let log = &self.log;
        let rate = log.frame_ms().map_or(0.0, |spread| 1.0e3 / spread.median);
        let parts = log.parts_ms();
        let first = self.first_frame.map_or("none".to_owned(), |time| format!("{:.3} s", time.as_secs_f64()));
        [
            format!("{:21}{}\n", "picture", self.title()),
            format!("{:21}{}, {rate:.1} a second at the median\n", "frames", log.len()),
            line("frame time", log.frame_ms()),
            match log.slowest() {
                Some((ms, at_s)) => {
                    format!("{:21}{ms:.3} ms, ended {at_s:.1} s after the first\n", "  the slowest")
                }
                None => String::new(),
            },
            line("our thread", log.ours_ms()),
            format!(
                "{:21}{:.3} ms simulate, {:.3} ms encode, {:.3} ms present (medians)\n",
                "  its parts", parts.simulate, parts.encode, parts.present
            ),
            line("all threads", log.process_ms()),
            line("graphics adapter", log.gpu_ms()),
            format!("{:21}{first}\n", "start to first frame"),
        ]
        .concat()
    }
}

fn source(arguments: &Arguments) -> Source {
    let [width, height] = GRID_SIZE;
    let recipe = Recipe::new(width, height, Algorithm::default(), SEED);
    Source::file_or_random(&arguments.read, arguments.file.clone(), recipe)
}

/// The autopilot plays round after round.
fn rules() -> Rules {
    Rules {
        engine: EngineKind::Continuous,
        max_tilt_rad: USUAL_MAX_TILT_DEGREES.to_radians(),
        demo: true,
        rounds: true,
        seed: SEED,
        today: Date::default(),
    }
}

fn in_a_window(arguments: &Arguments, started: Instant) -> Result<Measured, Failure> {
    let source = source(arguments);
    let maze = source.load()?;
    let rules = rules();
    let board = Board::new(maze, source, Role::Play, &rules)?;
    let setup = Setup {
        settings: Settings::default(),
        rules,
        first: Screen::Playing,
        look: Look::new(files::textures(None)?, None, arguments.quality),
        record: None,
        state_log: None,
        csv: arguments.csv.clone(),
        exit_after: Some(arguments.seconds),
        unfocused: None,
    };
    let event_loop = native::event_loop()?;
    if arguments.size.iter().any(|side| EVERY_ADAPTER < *side) {
        // A window of a size that no adapter can draw is not opened.
        expect_size(arguments.size, &Gpu::offscreen().map_err(Failure::bad_input)?)?;
    }
    let options = Options { uncapped: arguments.uncapped, size: Some(arguments.size), keep_s: f64::MAX };
    let shown = App::new(setup, options, board, SettingsFile::none(), None)?.run(event_loop)?;
    let (adapter, quality, size) = shown
        .drawn_by()
        .ok_or_else(|| Failure::not_held("the window was closed before the time was over"))?;
    let first_frame = shown.first_frame().map(|first| first - started);
    Ok(Measured { adapter, quality, size, first_frame, log: shown.into_frame_log() })
}

/// What the adapter can draw.
fn expect_size(size: [u32; 2], gpu: &Gpu) -> Result<(), Failure> {
    match size.iter().any(|side| gpu.max_side() < *side) {
        true => Err(Failure::bad_input(format!("--size: at most {} pixels a side here", gpu.max_side()))),
        false => Ok(()),
    }
}

fn offscreen(arguments: &Arguments, started: Instant) -> Result<Measured, Failure> {
    native::leave_silent();
    let source = source(arguments);
    let mut game = Session::new(source.load()?, EngineKind::Continuous)?;
    let max_tilt_rad = USUAL_MAX_TILT_DEGREES.to_radians();
    let mut demo = Demo::new(&game, max_tilt_rad, true)?;
    let gpu = Gpu::offscreen().map_err(Failure::bad_input)?;
    let quality = arguments.quality.on(&gpu);
    let size = arguments.size;
    expect_size(size, &gpu)?;
    let mut painter = FramePainter::new(&gpu, quality.picture_format(), &files::textures(None)?, quality);
    painter.renderer.set_maze(&gpu, &game.maze().surface).map_err(Failure::bad_input)?;
    let view = picture(&gpu, painter.renderer.target_format(), size);
    let aspect = to_points(size[0], 1.0) / to_points(size[1], 1.0);
    let camera = Camera::fitted(game.half_size(), aspect, to_f32(max_tilt_rad));
    let labels = Labels::new(&source, game.maze());
    let (keyboard, notes) = (Keyboard::default(), Notes::default());
    let mut clock = Clock::new(game.tick_s());
    let mut log = FrameLog::new(f64::MAX);
    let kept = arguments.csv.clone().map(KeptFrames::new);
    let (mut ahead, mut first_frame) = (VecDeque::new(), None::<Instant>);
    let mut last = Instant::now();
    // The first frame takes as long as the driver needs to make the shaders.
    while first_frame.is_none_or(|first| first.elapsed() < arguments.seconds) {
        let watch = Stopwatch::start();
        let elapsed = last.elapsed();
        last = Instant::now();
        for _ in 0..clock.advance(elapsed.as_secs_f64()) {
            let tilt = demo.tilt(&mut game)?;
            game.tick(tilt)?;
        }
        let simulate = watch.ms();
        let watch = Stopwatch::start();
        let scene = game.scene(&game.pose(clock.alpha(), None), camera);
        let hud = Hud::of(&game, &labels, &keyboard, &notes);
        let number = log.next_number();
        let input = RawInput::default();
        let (submitted, _) =
            painter.draw(&gpu, (&view, size, 1.0), (&scene, number), input, |ui| hud.show(ui));
        ahead.push_back(submitted);
        let encode = watch.ms();
        let watch = Stopwatch::start();
        if N_FRAMES_AHEAD <= ahead.len() || first_frame.is_none() {
            let wait = wgpu::PollType::Wait { submission_index: ahead.pop_front(), timeout: None };
            gpu.device.poll(wait).map_err(Failure::bad_input)?;
        }
        first_frame.get_or_insert_with(Instant::now);
        log.push(Parts { simulate, encode, present: watch.ms() });
        if let Some(kept) = &kept {
            kept.add(&log);
        }
        painter.note_times(&mut log);
        if let Some(error) = gpu.take_error() {
            return Err(Failure::bad_input(error));
        }
    }
    let first_frame = first_frame.map(|first| first - started);
    Ok(Measured { log, adapter: gpu.describe(), quality, size, first_frame })
}

fn picture(gpu: &Gpu, format: wgpu::TextureFormat, [width, height]: [u32; 2]) -> wgpu::TextureView {
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("frames"),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
        view_formats: &[],
    });
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}
