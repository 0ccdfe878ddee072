//! Whether frames come too slowly to play by, or for the game to keep up with the time, and what is done about it.

use maze_render::Quality;
use std::collections::VecDeque;
use std::time::Duration;

/// Frames of this time are looked at.
const SPAN: Duration = Duration::from_secs(2);

/// At least so many, or a single late one would decide.
const MIN_FRAMES: usize = 6;

/// A frame that takes longer is late: below 12 a second a ball cannot be steered.
const LATE: Duration = Duration::from_millis(83);

/// Fraction of them that were late where the game is called slow, and where no longer.
const SLOW_FRACTION: f64 = 0.5;
const FAST_FRACTION: f64 = 0.1;

/// Frames behind each other, and the time that each of them could not simulate.
#[derive(Clone, Debug, Default)]
pub(crate) struct Slowness {
    frames: VecDeque<[Duration; 2]>,
    is_slow: bool,
}

impl Slowness {
    /// Another frame: the time since the last one, and what of it the game did not play.
    pub(crate) fn push(&mut self, elapsed: Duration, lost: Duration) {
        self.frames.push_back([elapsed, lost]);
        let mut span: Duration = self.frames.iter().map(|[elapsed, _]| *elapsed).sum();
        while let Some([first, _]) = self.frames.front()
            && MIN_FRAMES < self.frames.len()
            && SPAN + *first <= span
        {
            span -= *first;
            self.frames.pop_front();
        }
        if span < SPAN || self.frames.len() < MIN_FRAMES {
            return;
        }
        let is_late = |[elapsed, lost]: &&[Duration; 2]| LATE < *elapsed || !lost.is_zero();
        let late = count(self.frames.iter().filter(is_late).count()) / count(self.frames.len());
        self.is_slow = if self.is_slow { FAST_FRACTION < late } else { SLOW_FRACTION <= late };
    }

    /// After a pause, or a change of what a frame costs: what was measured before no longer counts.
    pub(crate) fn forget(&mut self) {
        *self = Self::default();
    }

    /// What is said while it is slow: the fraction of real time in steps of 5 %, which can be read, or the frames.
    pub(crate) fn told(&self) -> Option<String> {
        let [elapsed, lost] =
            [0, 1].map(|i| self.frames.iter().map(|frame| frame[i].as_secs_f64()).sum::<f64>());
        let frames_per_s = count(self.frames.len()) / elapsed;
        let percent = (20.0 * (1.0 - lost / elapsed)).round().clamp(1.0, 20.0) * 5.0;
        self.is_slow.then(|| match percent < 100.0 {
            true => format!("the game runs at {percent} % of real time"),
            false => format!("{frames_per_s:.0} frames a second"),
        })
    }

    /// The quality to draw with instead, when it is slow and the user has not chosen the quality. Only ever a cheaper one, so that it does
    /// not go to and fro.
    pub(crate) fn remedy(&self, quality: Quality, is_chosen: bool) -> Option<Quality> {
        quality.cheaper().filter(|_| self.is_slow && !is_chosen)
    }
}

#[allow(clippy::cast_precision_loss, reason = "some hundred frames")]
fn count(n: usize) -> f64 {
    n as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clock::Clock;

    /// Runs frames of a length (ms) through the game's clock.
    fn run(slowness: &mut Slowness, frame_ms: u64, n_frames: u32) -> Option<String> {
        let mut clock = Clock::new(0.03);
        for _ in 0..n_frames {
            let elapsed = Duration::from_millis(frame_ms);
            clock.advance(elapsed.as_secs_f64());
            slowness.push(elapsed, clock.lost());
        }
        slowness.told()
    }

    #[test]
    fn i9_slow_frames_are_told_and_how_slow_the_game_is() {
        for (frame_ms, percent) in [(300, 80), (400, 60), (1000, 25), (5000, 5)] {
            let told = run(&mut Slowness::default(), frame_ms, 12).unwrap();
            assert_eq!(told, format!("the game runs at {percent} % of real time"));
        }
        for (frame_ms, told) in [(100, "10 frames a second"), (200, "5 frames a second")] {
            assert_eq!(run(&mut Slowness::default(), frame_ms, 30).unwrap(), told);
        }
        for frame_ms in [4, 16, 33, 80] {
            assert_eq!(run(&mut Slowness::default(), frame_ms, 1000), None, "{frame_ms} ms");
        }
    }

    #[test]
    fn i9_one_late_frame_is_no_slowness_and_fast_frames_end_it() {
        let mut slowness = Slowness::default();
        run(&mut slowness, 16, 200);
        assert_eq!(run(&mut slowness, 3000, 1), None);
        assert_eq!(run(&mut slowness, 16, 10), None);
        assert!(run(&mut slowness, 400, 12).is_some());
        assert_eq!(run(&mut slowness, 16, 200), None);
    }

    #[test]
    fn i9_quality_falls_by_itself_to_the_lowest_unless_it_was_chosen() {
        let (mut slowness, mut quality, mut n_falls) = (Slowness::default(), Quality::High, 0);
        for _ in 0..100 {
            run(&mut slowness, 400, 1);
            assert_eq!(slowness.remedy(quality, true), None);
            if let Some(cheaper) = slowness.remedy(quality, false) {
                (quality, n_falls) = (cheaper, n_falls + 1);
                // What another quality costs is not known yet.
                slowness.forget();
            }
        }
        assert_eq!((quality, n_falls), (Quality::Low, 2));
        run(&mut slowness, 16, 1000);
        assert_eq!(slowness.remedy(Quality::High, false), None);
    }

    #[test]
    fn i9_what_was_before_a_pause_is_forgotten() {
        let mut slowness = Slowness::default();
        assert!(run(&mut slowness, 400, 12).is_some());
        slowness.forget();
        assert_eq!(slowness.told(), None);
        assert_eq!(run(&mut slowness, 400, 3), None);
    }
}
