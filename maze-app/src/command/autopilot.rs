//! `maze-app autopilot`: plays to the goal without a window.

use crate::command::info::no_path;
use crate::engine_kind::EngineKind;
use crate::failure::Failure;
use crate::platform::native::files;
use crate::platform::native::keeper::Keeper;
use crate::session::Session;
use crate::setup::USUAL_MAX_TILT_DEGREES;
use crate::source::{MazeArguments, Source};
use clap::Args;
use maze_core::replay::MAX_TICKS;
use maze_core::{Autopilot, BallKind, Event, Phase};
use serde_json::json;
use std::path::PathBuf;

#[derive(Args)]
#[command(after_help = "Examples:\n  maze-app autopilot my_maze.obj\n  maze-app autopilot --level 3\n  \
                        maze-app autopilot --random --seed 7 --size 20x20 --record run.maze\n\n\
                        Exit status 1 when the goal was not reached.")]
pub(crate) struct Arguments {
    #[command(flatten)]
    maze: MazeArguments,
    /// How the ball's motion is computed
    #[arg(long, value_enum, default_value_t = EngineKind::Continuous)]
    engine: EngineKind,
    /// Write the run, for `maze-app replay`
    #[arg(long, value_name = "FILE")]
    record: Option<PathBuf>,
    /// One JSON object instead of text
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let source = Source::new(&arguments.maze)?;
    if let Some(path) = &arguments.record {
        files::expect_outputs(&[("--record", path)], &source.inputs())?;
        source.expect_recordable()?;
    }
    let mut game = Session::new(source.load_for(arguments.engine, BallKind::Report)?, arguments.engine)?;
    let mut kept = arguments.record.as_deref().map(|path| Keeper::new(path, &game, &source)).transpose()?;
    let half_tangent_limit = (USUAL_MAX_TILT_DEGREES.to_radians() / 2.0).tan();
    let Ok(mut autopilot) = Autopilot::new(game.maze(), half_tangent_limit) else {
        return Err(no_path(&source, game.maze()));
    };
    let mut n_bounces = 0_u64;
    let mut deepest_penetration = 0.0_f64;
    // The autopilot gives up where a recording is full.
    while game.phase() != Phase::Finished && game.n_played() < MAX_TICKS {
        let tilt = autopilot.tilt(game.ball());
        let events = game.tick(tilt)?;
        if let Some(kept) = &mut kept {
            kept.add(&game);
        }
        n_bounces += events.iter().map(|event| u64::from(matches!(event, Event::Bounced(_)))).sum::<u64>();
        deepest_penetration = deepest_penetration.max(game.last_tick().deepest_penetration);
    }
    drop(kept);
    let (finished, n_ticks) = (game.phase() == Phase::Finished, game.n_played());
    if let Some(path) = &arguments.record {
        files::write_whole(path, &game.recording(source.words()?)?.to_bytes())?;
    }
    files::print(&match arguments.json {
        true => format!(
            "{}\n",
            json!({
                "finished": finished,
                "ticks": n_ticks,
                "bounces": n_bounces,
                "deepest_penetration": deepest_penetration,
            })
        ),
        false => format!(
            "finished             {finished}\nticks                {n_ticks}\nbounces              {n_bounces}\n\
             deepest penetration  {deepest_penetration}\n"
        ),
    })?;
    if finished {
        Ok(())
    } else {
        Err(Failure::not_held(format!("the goal was not reached in {n_ticks} ticks")))
    }
}
