//! What the game writes while it is played: the run, the state of each tick, the times of frames.

use super::keeper::{Keeper, KeptFrames};
use super::state_log::{State, StateLog};
use crate::failure::Failure;
use crate::frame_log::{FrameLog, Parts};
use crate::game::{Board, Game};
use maze_render::Quality;
use std::path::PathBuf;

pub(super) struct Outputs {
    /// Where to write it; opened with the window, so that nothing is lost when there is none.
    state_log_path: Option<PathBuf>,
    state_log: Option<StateLog>,
    /// Where the run goes.
    record: Option<PathBuf>,
    /// Keeps the run to be written; nothing any more when one that reached the goal stands there.
    keeper: Option<Keeper>,
    is_recorded: bool,
    pub(super) frame_log: FrameLog,
    /// The frames once more, to be written when the program is ended from outside.
    kept_frames: Option<KeptFrames>,
    /// Who drew the last frame: adapter, quality, size.
    pub(super) drawn_by: Option<(String, Quality, [u32; 2])>,
    n_ticks: u64,
}

impl Outputs {
    pub(super) fn new(
        record: Option<PathBuf>,
        state_log_path: Option<PathBuf>,
        csv: Option<PathBuf>,
        board: &Board,
        keep_s: f64,
    ) -> Result<Self, Failure> {
        let mut outputs = Self {
            state_log_path,
            state_log: None,
            record,
            keeper: None,
            is_recorded: false,
            frame_log: FrameLog::new(keep_s),
            kept_frames: csv.map(KeptFrames::new),
            drawn_by: None,
            n_ticks: 0,
        };
        outputs.keep_anew(board)?;
        Ok(outputs)
    }

    /// The window is there.
    pub(super) fn open(&mut self) -> Result<(), Failure> {
        self.state_log = self.state_log_path.as_deref().map(StateLog::create).transpose()?;
        Ok(())
    }

    /// A run begins, perhaps in another maze.
    pub(super) fn keep_anew(&mut self, board: &Board) -> Result<(), Failure> {
        if self.is_recorded || !board.is_played() {
            return Ok(());
        }
        match (&mut self.keeper, &self.record) {
            (Some(keeper), _) => keeper.begin(&board.session, &board.source)?,
            (None, Some(path)) => self.keeper = Some(Keeper::new(path, &board.session, &board.source)?),
            (None, None) => {}
        }
        Ok(())
    }

    /// Another tick of the player's maze; the goal was reached in it or not.
    pub(super) fn note_tick(&mut self, game: &Game, is_finished: bool) -> Result<(), Failure> {
        if let Some(keeper) = &mut self.keeper {
            keeper.add(&game.board.session);
        }
        if is_finished {
            self.write_recording()?;
            self.is_recorded |= self.keeper.take().is_some();
        }
        self.n_ticks += 1;
        let Some(log) = &mut self.state_log else { return Ok(()) };
        let session = &game.board.session;
        let orientation = session.tilt().world_from_maze();
        let ball = session.ball();
        log.write(&State {
            tick: self.n_ticks,
            orientation: [orientation.w, orientation.i, orientation.j, orientation.k],
            position: ball.position.into(),
            velocity: ball.velocity.into(),
            camera_distance: game.view.camera().distance,
            phase: session.phase().name(),
            clock_ticks: session.n_ticks(),
        })
    }

    pub(super) fn write_recording(&self) -> Result<(), Failure> {
        self.keeper.as_ref().map_or(Ok(()), Keeper::write)
    }

    pub(super) fn push_frame(&mut self, parts: Parts) {
        self.frame_log.push(parts);
        if let Some(kept) = &self.kept_frames {
            kept.add(&self.frame_log);
        }
    }
}
