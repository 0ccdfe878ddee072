//! What the game is set up with, checked before a window opens.

use crate::game::Rules;
use crate::platform::native::Look;
use crate::screen::Screen;
use crate::settings::Settings;
use clap::ValueEnum;
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
    pub(crate) settings: Settings,
    pub(crate) rules: Rules,
    /// The screen in front.
    pub(crate) first: Screen,
    pub(crate) look: Look,
    pub(crate) record: Option<PathBuf>,
    pub(crate) state_log: Option<PathBuf>,
    /// Where frames are written when the program is ended from outside.
    pub(crate) csv: Option<PathBuf>,
    pub(crate) exit_after: Option<Duration>,
    pub(crate) unfocused: Option<Unfocused>,
}

/// What `maze-app frames` does differently from `maze-app play`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Options {
    /// As many frames as the window takes.
    pub(crate) uncapped: bool,
    /// Of the window (pixels).
    pub(crate) size: Option<[u32; 2]>,
    /// How long frames are remembered (s).
    pub(crate) keep_s: f64,
}

impl Default for Options {
    fn default() -> Self {
        Self { uncapped: false, size: None, keep_s: 10.0 }
    }
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
