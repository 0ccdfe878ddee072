//! A run and its frames that are kept while it is played, so that they are saved when the program is ended from outside.

use crate::failure::Failure;
use crate::frame_log::FrameLog;
use crate::platform::native::files;
use crate::platform::native::rescue::{self, Kept, Shared, lock};
use crate::session::Session;
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
    pub(crate) fn new(path: &Path, game: &Session, source: &Source) -> Result<Self, Failure> {
        let recording = Arc::new(Mutex::new(game.recording(source.words()?)?));
        let (kept, to) = (Arc::clone(&recording), path.to_path_buf());
        let save = move || save(&to, &lock(&kept));
        Ok(Self { recording, path: path.to_path_buf(), _kept: rescue::keep(save) })
    }

    /// The ticks since the last time.
    pub(crate) fn add(&mut self, game: &Session) {
        game.continue_recording(&mut lock(&self.recording));
    }

    /// The game has restarted, perhaps in another maze.
    pub(crate) fn begin(&mut self, game: &Session, source: &Source) -> Result<(), Failure> {
        *lock(&self.recording) = game.recording(source.words()?)?;
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

/// Keeps the frames of a log.
pub(crate) struct KeptFrames {
    frames: Shared<FrameLog>,
    _kept: Kept,
}

impl KeptFrames {
    /// Written to that file when they have to be.
    pub(crate) fn new(csv: PathBuf) -> Self {
        let frames = Arc::new(Mutex::new(FrameLog::new(f64::MAX)));
        let kept = Arc::clone(&frames);
        let save = move || files::write_whole(&csv, lock(&kept).csv().as_bytes());
        Self { frames, _kept: rescue::keep(save) }
    }

    /// The last frame of the log.
    pub(crate) fn add(&self, log: &FrameLog) {
        log.copy_last_to(&mut lock(&self.frames));
    }
}
