//! The autopilot at the board, round after round.

use crate::failure::Failure;
use crate::session::Session;
use maze_core::{Autopilot, Phase, Tilt};

/// How long the goal is admired before the next round (ticks of 0.03 s).
const TICKS_AT_GOAL: u32 = 50;

pub(crate) struct Demo {
    autopilot: Autopilot,
    half_tangent_limit: f64,
    n_ticks_at_goal: u32,
    /// Whether another round follows.
    rounds: bool,
}

impl Demo {
    /// Fails for a maze with no path to the goal.
    pub(crate) fn new(game: &Session, max_tilt_rad: f64, rounds: bool) -> Result<Self, Failure> {
        let half_tangent_limit = (max_tilt_rad / 2.0).tan();
        let autopilot = Autopilot::new(game.maze(), half_tangent_limit).map_err(Failure::not_held)?;
        Ok(Self { autopilot, half_tangent_limit, n_ticks_at_goal: 0, rounds })
    }

    /// For the next tick; in rounds, starts another round some time after the goal.
    pub(crate) fn tilt(&mut self, game: &mut Session) -> Result<Tilt, Failure> {
        if game.phase() == Phase::Finished {
            self.n_ticks_at_goal += 1;
            if self.n_ticks_at_goal < TICKS_AT_GOAL || !self.rounds {
                return Ok(game.tilt());
            }
            game.restart()?;
            self.n_ticks_at_goal = 0;
            if let Ok(autopilot) = Autopilot::new(game.maze(), self.half_tangent_limit) {
                self.autopilot = autopilot;
            }
        }
        Ok(self.autopilot.tilt(game.ball()))
    }
}
