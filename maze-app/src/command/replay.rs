//! `maze-app replay`: a recording played again, and whether it ends in the same state.

use crate::engine_kind::EngineKind;
use crate::failure::Failure;
use crate::platform::native::files;
use crate::source::{MazeArguments, Source};
use clap::{Args, Parser, ValueEnum};
use maze_core::Ball;
use maze_core::replay::{MAX_TICKS, Recording, VerifyError};
use serde_json::json;
use std::path::PathBuf;

#[derive(Args)]
#[command(after_help = "Example:\n  maze-app replay run.maze\n\n\
                        A maze file is looked for where it was recorded, from the same directory.\n\
                        Exit status 1 when the run ends in another state.")]
pub(crate) struct Arguments {
    /// A recording (`maze-app autopilot --record`)
    file: PathBuf,
    /// One JSON object instead of text
    #[arg(long)]
    json: bool,
}

/// Longest recording: four bytes a tick, and a head.
const MAX_BYTES: u64 = 4 * MAX_TICKS as u64 + (1 << 16);

/// A recording's source is arguments that `play` takes.
#[derive(Parser)]
#[command(no_binary_name = true)]
struct SourceWords {
    #[command(flatten)]
    maze: MazeArguments,
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let in_file = |reason: String| Failure::in_file(&arguments.file, reason);
    let bytes = files::read_at_most(&arguments.file, MAX_BYTES)?;
    let recording = Recording::from_bytes(&bytes).map_err(|error| in_file(error.to_string()))?;
    let kind = EngineKind::from_str(&recording.engine, false).map_err(|_| {
        in_file(format!("recorded with an engine `{}`, which this program does not have", recording.engine))
    })?;
    let words = SourceWords::try_parse_from(recording.source.split('\n'))
        .map_err(|_| in_file(format!("the recording's source is damaged: {}", recording.source)))?;
    let source = Source::new(&words.maze)?;
    source.expect_recordable().map_err(|failure| in_file(failure.to_string()))?;
    let maze = source.load()?;
    let spec = recording.constants.spec().map_err(|error| in_file(error.to_string()))?;
    let (start, tick_s) = (Ball::at(maze.start()), recording.constants.tick_s);
    let mut engine =
        kind.build_with(&maze, spec, start, tick_s).map_err(|error| in_file(error.to_string()))?;
    let (same, run) = match recording.verify_with(&maze, engine.as_mut()) {
        Ok(run) => (true, run),
        Err(VerifyError::OtherEnd { run, .. }) => (false, run),
        Err(VerifyError::OtherMaze { .. }) => {
            return Err(in_file(format!("recorded on another maze than {} is now", source.title())));
        }
        Err(error) => return Err(in_file(error.to_string())),
    };
    let (n_ticks, phase) = (recording.tilts.len(), run.phase().name());
    files::print(&match arguments.json {
        true => format!("{}\n", json!({ "same": same, "ticks": n_ticks, "phase": phase })),
        false => {
            format!("same final state  {same}\nticks             {n_ticks}\nphase             {phase}\n")
        }
    })?;
    if same {
        Ok(())
    } else {
        Err(Failure::not_held(format!("the run ended in another state after {n_ticks} ticks")))
    }
}
