//! What the game is set up with, checked before a window opens.

use crate::engine_kind::EngineKind;
use crate::quality::QualityChoice;
use crate::source::Source;
use clap::ValueEnum;
use maze_render::TextureSet;
use std::path::PathBuf;
use std::time::Duration;

/// Steepest tilt of the player's board where no flag says otherwise, and of the autopilot's (degrees).
pub(crate) const USUAL_MAX_TILT_DEGREES: f64 = 20.0;

/// Steepest tilt there is (degrees): beyond it the board would be seen from its edge.
pub(crate) const STEEPEST_DEGREES: f64 = 45.0;

/// What happens while the window is in view and another one has the keyboard.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Unfocused {
    /// The game's time stands until the window has the keyboard again
    #[default]
    Pause,
    /// The game goes on
    Run,
}

/// What the window needs, all checked before it opens.
pub(crate) struct Setup {
    pub(crate) source: Source,
    pub(crate) textures: TextureSet,
    /// Where they come from whatever the maze.
    pub(crate) textures_flag: Option<PathBuf>,
    pub(crate) engine: EngineKind,
    pub(crate) max_tilt_rad: f64,
    pub(crate) state_log: Option<PathBuf>,
    pub(crate) record: Option<PathBuf>,
    /// Where frames are written when the program is ended from outside.
    pub(crate) csv: Option<PathBuf>,
    pub(crate) exit_after: Option<Duration>,
    pub(crate) unfocused: Option<Unfocused>,
    pub(crate) quality: QualityChoice,
}

pub(crate) fn parse_max_tilt(text: &str) -> Result<f64, String> {
    let degrees = text.parse().ok().filter(|degrees| (1.0..=STEEPEST_DEGREES).contains(degrees));
    degrees.ok_or_else(|| "expected 1 to 45 degrees".to_owned())
}

pub(crate) fn parse_seconds(text: &str) -> Result<Duration, String> {
    let seconds = text.parse().ok().filter(|seconds: &f64| 0.0 <= *seconds);
    let duration = seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    duration.ok_or_else(|| "expected a number of seconds, 0 or more".to_owned())
}
