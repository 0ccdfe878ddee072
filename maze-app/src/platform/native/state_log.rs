//! One JSON line a tick, for tests and for the curious.

use crate::failure::Failure;
use crate::platform::native::files::{self, plain};
use serde::Serialize;
use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};

/// The content of a line.
#[derive(Serialize)]
pub(crate) struct State {
    /// Ticks since the program started.
    pub(crate) tick: u64,
    /// World from maze, as (w, x, y, z).
    pub(crate) orientation: [f64; 4],
    /// Of the ball's centre (maze units).
    pub(crate) position: [f64; 2],
    /// Maze units per second.
    pub(crate) velocity: [f64; 2],
    /// From the eye to what it looks at (maze units).
    pub(crate) camera_distance: f32,
    /// `ready`, `playing` or `finished`.
    pub(crate) phase: &'static str,
    /// Ticks since the run began.
    pub(crate) clock_ticks: u64,
}

/// Appends to the file line by line, so that it can be read while the game runs.
pub(crate) struct StateLog {
    file: File,
    path: PathBuf,
}

impl StateLog {
    pub(crate) fn create(path: &Path) -> Result<Self, Failure> {
        files::expect_replaceable(path)?;
        let file = File::create(path).map_err(|error| Failure::in_file(path, plain(&error)))?;
        Ok(Self { file, path: path.to_path_buf() })
    }

    pub(crate) fn write(&mut self, state: &State) -> Result<(), Failure> {
        let failed = |error: &dyn std::fmt::Display| Failure::in_file(&self.path, error);
        let mut line = serde_json::to_vec(state).map_err(|error| failed(&error))?;
        line.push(b'\n');
        self.file.write_all(&line).map_err(|error| failed(&error))
    }
}
