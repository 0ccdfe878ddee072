//! A run that is kept while it is played, so that it is saved when the program is ended from outside.

use crate::failure::Failure;
use crate::files;
use crate::game::Game;
use crate::rescue::{self, Kept, Shared, lock};
use crate::source::Source;
use maze_core::replay::Recording;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

/// Keeps what is played.
pub(crate) struct Keeper {
    recording: Shared<Recording>,
    path: PathBuf,
    _kept: Kept,
}

impl Keeper {
    /// Of a game that begins; written to that file when it has to be.
    pub(crate) fn new(path: &Path, game: &Game, source: &Source) -> Result<Self, Failure> {
        let recording = Arc::new(Mutex::new(game.recording(source)?));
        let (kept, to) = (Arc::clone(&recording), path.to_path_buf());
        let save = move || save(&to, &lock(&kept));
        Ok(Self { recording, path: path.to_path_buf(), _kept: rescue::keep(save) })
    }

    /// The ticks since the last time.
    pub(crate) fn add(&mut self, game: &Game) {
        game.continue_recording(&mut lock(&self.recording));
    }

    /// The game has begun anew, perhaps in another maze.
    pub(crate) fn begin(&mut self, game: &Game, source: &Source) -> Result<(), Failure> {
        *lock(&self.recording) = game.recording(source)?;
        Ok(())
    }

    /// Writes what was played.
    pub(crate) fn write(&self) -> Result<(), Failure> {
        save(&self.path, &lock(&self.recording))
    }
}

/// A game that has not begun leaves an older recording as it is.
fn save(path: &Path, recording: &Recording) -> Result<(), Failure> {
    if recording.tilts.is_empty() {
        return Ok(());
    }
    files::write_whole(path, &recording.to_bytes())
}
