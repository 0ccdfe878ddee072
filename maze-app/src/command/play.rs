//! `maze-app play`: the game in a window.

use crate::app::{self, App};
use crate::failure::Failure;
use crate::files;
use crate::game::EngineKind;
use crate::source::{GridSize, ReadArguments, fresh_seed, parse_grid_size};
use clap::Args;
use maze_core::Maze;
use maze_render::TextureSet;
use std::path::PathBuf;
use std::time::Duration;

#[derive(Args, Clone, Debug)]
#[command(
    after_help = "Examples:\n  maze-app play\n  maze-app play --seed 7 --size 20x12\n  maze-app play my_maze.obj"
)]
pub(crate) struct Arguments {
    /// A maze (.obj); without one, a random maze
    #[arg(conflicts_with_all = ["random", "seed", "size"])]
    file: Option<PathBuf>,
    #[command(flatten)]
    read: ReadArguments,
    /// A random maze (what happens anyway without a FILE)
    #[arg(long)]
    random: bool,
    /// The same seed gives the same maze [default: a new one]
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// Cells of a random maze
    #[arg(long, value_name = "WxH", value_parser = parse_grid_size, default_value = GridSize::DEFAULT)]
    size: GridSize,
    /// How the ball's motion is computed
    #[arg(long, value_enum, default_value_t = EngineKind::Continuous)]
    engine: EngineKind,
    /// Steepest tilt of the board, 1 to 45 degrees
    #[arg(long, value_name = "DEGREES", value_parser = parse_max_tilt, default_value = "20")]
    max_tilt: f64,
    /// Directory with wall.bmp, floor.bmp and top.bmp (24-bit, uncompressed) [default: built in]
    #[arg(long, value_name = "DIR")]
    textures: Option<PathBuf>,
    /// Write one JSON line a tick: tick, orientation, ball, camera distance, phase
    #[arg(long, value_name = "FILE")]
    state_log: Option<PathBuf>,
    /// End by itself after this time
    #[arg(long, value_name = "SECONDS", value_parser = parse_seconds)]
    exit_after: Option<Duration>,
}

fn parse_max_tilt(text: &str) -> Result<f64, String> {
    let degrees = text.parse().ok().filter(|degrees| (1.0..=45.0).contains(degrees));
    degrees.ok_or_else(|| "expected 1 to 45 degrees".to_owned())
}

fn parse_seconds(text: &str) -> Result<Duration, String> {
    let seconds = text.parse().ok().filter(|seconds: &f64| 0.0 <= *seconds);
    let duration = seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    duration.ok_or_else(|| "expected a number of seconds, 0 or more".to_owned())
}

/// What is played, and how to get the next maze of the same kind.
pub(crate) struct Source {
    read: ReadArguments,
    kind: Kind,
}

enum Kind {
    File(PathBuf),
    Random { size: GridSize, seed: u64 },
}

impl Source {
    pub(crate) fn load(&self) -> Result<Maze, Failure> {
        match &self.kind {
            Kind::File(path) => self.read.load(path),
            Kind::Random { size, seed } => self.read.generate(*size, *seed),
        }
    }

    /// What the screen calls it.
    pub(crate) fn title(&self) -> String {
        match &self.kind {
            Kind::File(path) => path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned(),
            Kind::Random { size, seed } => format!("{}x{}  seed {seed}", size.width, size.height),
        }
    }

    /// Moves on to another random maze; false for a file.
    pub(crate) fn next(&mut self) -> bool {
        match &mut self.kind {
            Kind::File(_) => false,
            Kind::Random { seed, .. } => {
                *seed = fresh_seed();
                true
            }
        }
    }

    /// Whether there is another maze of the same kind.
    pub(crate) fn has_next(&self) -> bool {
        matches!(self.kind, Kind::Random { .. })
    }
}

/// What the window needs, all checked before it opens.
pub(crate) struct Setup {
    pub(crate) source: Source,
    pub(crate) textures: TextureSet,
    pub(crate) engine: EngineKind,
    pub(crate) max_tilt_rad: f64,
    pub(crate) state_log: Option<PathBuf>,
    pub(crate) exit_after: Option<Duration>,
}

pub(crate) fn run(arguments: Arguments) -> Result<(), Failure> {
    let kind = match arguments.file {
        Some(path) => Kind::File(path),
        None => Kind::Random { size: arguments.size, seed: arguments.seed.unwrap_or_else(fresh_seed) },
    };
    let source = Source { read: arguments.read, kind };
    let maze = source.load()?;
    let textures = files::textures(arguments.textures.as_deref())?;
    let event_loop = app::event_loop()?;
    let max_tilt_rad = arguments.max_tilt.to_radians();
    let setup = Setup {
        source,
        textures,
        engine: arguments.engine,
        max_tilt_rad,
        state_log: arguments.state_log,
        exit_after: arguments.exit_after,
    };
    App::new(setup, maze)?.run(event_loop)
}
