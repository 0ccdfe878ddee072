//! `maze-app play`: the game in a window.

use crate::engine_kind::EngineKind;
use crate::failure::{self, Failure};
use crate::game::{Board, Role, Rules};
use crate::input::KeySet;
use crate::platform::native::{self, App, Look, SettingsFile, files, sidecar};
use crate::quality::QualityChoice;
use crate::recipe;
use crate::screen::{Date, Screen};
use crate::setup::{self, Options, Setup, USUAL_MAX_TILT_DEGREES, Unfocused};
use crate::source::{MazeArguments, Source};
use clap::Args;
use std::path::PathBuf;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

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
    /// How much is spent on the picture; Q changes it [default: as in the settings, auto at first]
    #[arg(long, value_enum)]
    quality: Option<QualityChoice>,
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

    /// Which keys are usual: W A S D, or the report's
    #[arg(long, value_enum, value_name = "SET")]
    keys: Option<KeySet>,
    /// Where settings are kept [default: settings.toml in the user's configuration directory]
    #[arg(long, value_name = "FILE")]
    config: Option<PathBuf>,
    /// Begin at the title, whatever else is given
    #[arg(long)]
    title: bool,
    /// The autopilot plays
    #[arg(long)]
    demo: bool,
}

impl Arguments {
    /// Whether any flag chooses or watches a run: then it begins at once.
    fn begins_at_once(&self) -> bool {
        let is_watched = self.state_log.is_some() || self.record.is_some() || self.exit_after.is_some();
        let is_set_up = self.engine != EngineKind::Continuous
            || self.max_tilt != USUAL_MAX_TILT_DEGREES
            || self.quality.is_some()
            || self.textures.is_some()
            || self.unfocused.is_some();
        !self.title && (self.maze.is_given() || is_watched || is_set_up)
    }
}

pub(crate) fn run(arguments: Arguments) -> Result<(), Failure> {
    let source = Source::new(&arguments.maze)?;
    let record = arguments.record.as_deref().map(|path| ("--record", path));
    let state_log = arguments.state_log.as_deref().map(|path| ("--state-log", path));
    let config = arguments.config.as_deref().map(|path| ("--config", path));
    let outputs: Vec<files::Named> = record.into_iter().chain(state_log).chain(config).collect();
    let mut inputs = source.inputs();
    inputs.extend(arguments.textures.as_deref().map(files::texture_files).into_iter().flatten());
    files::expect_outputs(&outputs, &inputs)?;
    if record.is_some() {
        source.expect_recordable()?;
    }
    let rules = Rules {
        engine: arguments.engine,
        max_tilt_rad: arguments.max_tilt.to_radians(),
        demo: arguments.demo,
        rounds: false,
        seed: recipe::fresh_seed(),
        today: today(),
    };
    let maze = rules.load(&source)?;
    let textures = sidecar::textures(arguments.textures.as_deref(), source.file())?;
    let event_loop = native::event_loop()?;
    let (mut file, mut settings, told) = SettingsFile::open(arguments.config.clone());
    if let Some(told) = &told {
        failure::note(told);
    }
    if let Some(set) = arguments.keys {
        settings.controls.set = set;
        file.take_for_written(&settings);
    }
    let begins_at_once = arguments.begins_at_once();
    let (first, role) = match begins_at_once {
        true => (Screen::Playing, Role::Play),
        false => (Screen::Title, Role::Look),
    };
    let quality = arguments.quality.unwrap_or(settings.video.quality.into());
    let setup = Setup {
        settings,
        rules,
        first,
        look: Look::new(textures, arguments.textures, quality),
        record: arguments.record,
        state_log: arguments.state_log,
        csv: None,
        exit_after: arguments.exit_after,
        unfocused: arguments.unfocused,
    };
    let board = Board::new(maze, source, role, &rules)?;
    App::new(setup, Options::default(), board, file, told)?.run(event_loop).map(|_| ())
}

/// The day in UTC.
fn today() -> Date {
    let since = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
    Date::of_day(i64::try_from(since.as_secs() / 86_400).unwrap_or(0))
}
