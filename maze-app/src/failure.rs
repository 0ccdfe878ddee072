//! Why a command failed: one line and an exit status.

use maze_core::printable;
use std::fmt::{Display, Formatter};
use std::io::Write;
use std::path::Path;
use std::process::ExitCode;

/// Ends the program with one line on stderr.
#[derive(Debug)]
pub(crate) enum Failure {
    /// Exit status 1: the input was good, and what was asked for does not hold.
    NotHeld(String),
    /// Exit status 2: a file, a flag, the window system or the graphics driver is not usable.
    BadInput(String),
}

impl Failure {
    pub(crate) fn not_held(reason: impl Display) -> Self {
        Self::NotHeld(reason.to_string())
    }

    pub(crate) fn bad_input(reason: impl Display) -> Self {
        Self::BadInput(reason.to_string())
    }

    /// Bad input, with the file's name in front.
    pub(crate) fn in_file(path: &Path, reason: impl Display) -> Self {
        Self::BadInput(format!("{}: {reason}", path.display()))
    }

    pub(crate) fn exit_code(&self) -> ExitCode {
        match self {
            Self::NotHeld(_) => ExitCode::from(1),
            Self::BadInput(_) => ExitCode::from(2),
        }
    }
}

impl Display for Failure {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> std::fmt::Result {
        let (Self::NotHeld(reason) | Self::BadInput(reason)) = self;
        // One line without control characters, whatever a library or a file contains.
        formatter.write_str(&printable(reason))
    }
}

/// Prints a note that is no failure, on stderr.
pub(crate) fn note(text: &str) {
    // A closed stderr is no failure.
    let _ = writeln!(std::io::stderr(), "maze-app: {}", printable(text));
}
