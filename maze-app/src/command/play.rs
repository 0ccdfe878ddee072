//! `maze-app play`: the game in a window.

use crate::engine_kind::EngineKind;
use crate::failure::Failure;
use crate::platform::native::files;
use crate::platform::native::sidecar;
use crate::platform::native::{self, App, Options};
use crate::quality::QualityChoice;
use crate::setup::{self, Setup, USUAL_MAX_TILT_DEGREES, Unfocused};
use crate::source::{MazeArguments, Source};
use clap::Args;
use std::path::PathBuf;
use std::time::Duration;

#[derive(Args, Clone, Debug)]
#[command(
    after_help = "Examples:\n  maze-app play\n  maze-app play --level 3\n  maze-app play --seed 7 --size 20x12\n  \
                  maze-app play --algorithm wilson --braid 0.5\n  maze-app play my_maze.obj"
)]
pub(crate) struct Arguments {
    #[command(flatten)]
    maze: MazeArguments,
    /// How the ball's motion is computed
    #[arg(long, value_enum, default_value_t = EngineKind::Continuous)]
    engine: EngineKind,
    /// Steepest tilt of the board, 1 to 45 degrees
    #[arg(long, value_name = "DEGREES", value_parser = setup::parse_max_tilt, default_value_t = USUAL_MAX_TILT_DEGREES)]
    max_tilt: f64,
    /// How much is spent on the picture; Q changes it
    #[arg(long, value_enum, default_value_t = QualityChoice::Auto)]
    quality: QualityChoice,
    /// Directory with wall.bmp, floor.bmp and top.bmp (24-bit, uncompressed) [default: built in]
    #[arg(long, value_name = "DIR")]
    textures: Option<PathBuf>,
    /// Write one JSON line a tick: tick, orientation, ball, camera distance, phase
    #[arg(long, value_name = "FILE")]
    state_log: Option<PathBuf>,
    /// Write the run at the goal, for `maze-app replay`; without a goal reached, what was played last
    #[arg(long, value_name = "FILE")]
    record: Option<PathBuf>,
    /// End by itself after this time
    #[arg(long, value_name = "SECONDS", value_parser = setup::parse_seconds)]
    exit_after: Option<Duration>,
    /// What happens while another window has the keyboard [default: pause; with --exit-after: run]
    #[arg(long, value_enum, value_name = "WHAT")]
    unfocused: Option<Unfocused>,
}

pub(crate) fn run(arguments: Arguments) -> Result<(), Failure> {
    let source = Source::new(&arguments.maze)?;
    let record = arguments.record.as_deref().map(|path| ("--record", path));
    let state_log = arguments.state_log.as_deref().map(|path| ("--state-log", path));
    let outputs: Vec<files::Named> = record.into_iter().chain(state_log).collect();
    let mut inputs = source.inputs();
    inputs.extend(arguments.textures.as_deref().map(files::texture_files).into_iter().flatten());
    files::expect_outputs(&outputs, &inputs)?;
    if record.is_some() {
        source.expect_recordable()?;
    }
    let maze = source.load()?;
    let textures = sidecar::textures(arguments.textures.as_deref(), source.file())?;
    let event_loop = native::event_loop()?;
    let max_tilt_rad = arguments.max_tilt.to_radians();
    let setup = Setup {
        source,
        textures,
        textures_flag: arguments.textures,
        engine: arguments.engine,
        max_tilt_rad,
        state_log: arguments.state_log,
        record: arguments.record,
        csv: None,
        exit_after: arguments.exit_after,
        unfocused: arguments.unfocused,
        quality: arguments.quality,
    };
    App::new(setup, Options::default(), maze)?.run(event_loop).map(|_| ())
}
