//! Whether a frame would show anything new: where nothing moves, nothing is drawn, and the machine rests.

use crate::input::Letters;
use crate::overlay::{Layers, Notes};
use crate::ui::Hud;
use maze_core::Phase;
use maze_render::Scene;
use std::time::{Duration, Instant};

/// After the last change frames go on this long: a panel whose text has become shorter is narrower a frame later.
const SETTLE: Duration = Duration::from_millis(100);

/// Frames of a still picture come this far apart, for a window that has come out from under another.
const REST: Duration = Duration::from_millis(500);

/// What the last frame showed.
#[derive(Default)]
pub(super) struct Idle {
    shown: Option<Shown>,
    /// Of the last change, and of the last frame that was drawn.
    times: Option<[Instant; 2]>,
}

#[derive(Clone, PartialEq)]
struct Shown {
    scene: Scene,
    size: [u32; 2],
    phase: Phase,
    n_ticks: u64,
    ghost: Option<(&'static str, f64)>,
    help: bool,
    hints: bool,
    is_behind: bool,
    notice: Option<String>,
    layers: Layers,
    notes: Notes,
    pace: Option<String>,
    letters: Letters,
}

impl Idle {
    /// True when a frame of this would only repeat the last one; otherwise takes it for drawn.
    pub(super) fn may_skip(&mut self, now: Instant, scene: &Scene, hud: &Hud<'_>, size: [u32; 2]) -> bool {
        let shown = Shown {
            scene: scene.clone(),
            size,
            phase: hud.phase,
            n_ticks: hud.n_ticks,
            ghost: hud.ghost,
            help: hud.help,
            hints: hud.hints,
            is_behind: hud.is_behind,
            notice: hud.notice.map(str::to_owned),
            layers: hud.layers,
            notes: hud.notes.clone(),
            pace: hud.pace.map(str::to_owned),
            letters: hud.keyboard.letters().clone(),
        };
        let is_same = hud.frames.is_none() && self.shown.as_ref() == Some(&shown);
        self.shown = Some(shown);
        let [changed, drawn] = self.times.filter(|_| is_same).unwrap_or([now; 2]);
        let may_skip = is_same && SETTLE <= now - changed && now - drawn < REST;
        self.times = Some([changed, if may_skip { drawn } else { now }]);
        may_skip
    }

    /// The next frame is drawn whatever it shows.
    pub(super) fn wake(&mut self) {
        self.times = None;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine_kind::EngineKind;
    use crate::input::Keyboard;
    use crate::session::Session;
    use crate::ui::Labels;
    use maze_render::{BallView, Camera, Marker};
    use nalgebra::UnitQuaternion;

    #[test]
    fn a_still_picture_is_drawn_twice_a_second_and_a_moving_one_always() {
        let (labels, notes, keyboard) = (Labels::default(), Notes::default(), Keyboard::default());
        let maze = maze_core::layout::recursive_backtracker(3, 2, 1).unwrap();
        let maze = maze.maze(&Default::default()).unwrap();
        let session = Session::new(maze, EngineKind::Continuous).unwrap();
        let hud = |n_ticks| Hud { n_ticks, ..Hud::of(&session, &labels, &keyboard, &notes) };
        let marker = Marker { position: [0.0; 2], radius: 1.0 };
        let scene = Scene {
            camera: Camera { target: [0.0; 3], distance: 9.0, pitch_rad: maze_render::PITCH_RAD },
            world_from_maze: UnitQuaternion::identity(),
            ball: BallView { position: [0.0; 3], radius: 0.3, rotation: UnitQuaternion::identity() },
            ghost: None,
            start: marker,
            goal: marker,
            goal_glow: 0.0,
            lines: vec![],
            patches: vec![],
            shows_maze: true,
        };
        let begun = Instant::now();
        let frames = (0..600).map(|i| begun + Duration::from_millis(10 * i));
        let mut idle = Idle::default();
        let n_drawn = frames.clone().filter(|now| !idle.may_skip(*now, &scene, &hud(0), [9, 9])).count();
        assert!((10 + 9..=10 + 13).contains(&n_drawn), "{n_drawn}");
        let n_drawn =
            (0..).zip(frames).filter(|(i, now)| !idle.may_skip(*now, &scene, &hud(*i), [9, 9])).count();
        assert_eq!(n_drawn, 600);
    }
}
