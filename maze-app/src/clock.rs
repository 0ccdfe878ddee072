//! Fixed ticks from uneven frames.

use std::time::Duration;

/// Most ticks made up for in one frame. A longer pause (a dragged window, a debugger) is forgotten, not replayed.
const MAX_TICKS_PER_FRAME: u32 = 8;

/// Slowest motion: this many times halved.
const MAX_HALVINGS: usize = 5;

/// Said in a pause.
pub(crate) const PAUSED: &str = "paused";

/// What the speeds are called, from the usual one down.
const SPEEDS: [&str; MAX_HALVINGS + 1] =
    ["", "1/2 speed", "1/4 speed", "1/8 speed", "1/16 speed", "1/32 speed"];

/// Turns elapsed time into whole ticks and a remainder for interpolated drawing.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Clock {
    tick_s: f64,
    left_s: f64,
    n_halvings: usize,
    is_paused: bool,
    /// Asked for and not yet made.
    n_steps: u32,
    /// Of the last [`Clock::advance`].
    lost_s: f64,
}

impl Clock {
    pub(crate) fn new(tick_s: f64) -> Self {
        Self { tick_s, left_s: 0.0, n_halvings: 0, is_paused: false, n_steps: 0, lost_s: 0.0 }
    }

    /// Ticks that have become due after another `elapsed_s`.
    pub(crate) fn advance(&mut self, mut elapsed_s: f64) -> u32 {
        self.lost_s = 0.0;
        if self.is_paused {
            return std::mem::take(&mut self.n_steps);
        }
        for _ in 0..self.n_halvings {
            elapsed_s /= 2.0;
        }
        self.left_s += elapsed_s;
        let mut n_ticks = 0;
        while self.tick_s <= self.left_s {
            self.left_s -= self.tick_s;
            n_ticks += 1;
            if n_ticks == MAX_TICKS_PER_FRAME {
                // Less than a tick is nothing to speak of.
                self.lost_s = if self.tick_s <= self.left_s { self.left_s } else { 0.0 };
                self.left_s = 0.0;
            }
        }
        n_ticks
    }

    /// What the last [`Clock::advance`] forgot of its time, in the game's own.
    pub(crate) fn lost(&self) -> Duration {
        Duration::try_from_secs_f64(self.lost_s).unwrap_or(Duration::MAX)
    }

    /// Stops, with what the last tick led to in view, or goes on from there.
    pub(crate) fn toggle_pause(&mut self) {
        self.is_paused = !self.is_paused;
        self.left_s = self.tick_s;
    }

    /// No pause, at the usual speed.
    pub(crate) fn go_on(&mut self) {
        *self = Self::new(self.tick_s);
    }

    /// The single ticks that were asked for; what the last one led to is in view.
    pub(crate) fn take_steps(&mut self) -> u32 {
        (self.left_s, self.lost_s) = (self.tick_s, 0.0);
        std::mem::take(&mut self.n_steps)
    }

    /// One tick at the next [`Clock::advance`], and a pause.
    pub(crate) fn step(&mut self) {
        if !self.is_paused {
            self.toggle_pause();
        }
        self.n_steps += 1;
    }

    pub(crate) fn slower(&mut self) {
        self.n_halvings = (self.n_halvings + 1).min(MAX_HALVINGS);
    }

    pub(crate) fn faster(&mut self) {
        self.n_halvings = self.n_halvings.saturating_sub(1);
    }

    /// Said unless time passes as usual.
    pub(crate) fn pace(&self) -> Option<&'static str> {
        let speed = (0 < self.n_halvings).then_some(SPEEDS[self.n_halvings]);
        if self.is_paused { Some(PAUSED) } else { speed }
    }

    /// How far the time has gone from the last tick to the next, 0..=1; 1 in a pause.
    pub(crate) fn alpha(&self) -> f64 {
        self.left_s / self.tick_s
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_the_same_at_30_60_and_240_frames_a_second() {
        for frames_per_s in [30_u32, 60, 240] {
            let mut clock = Clock::new(0.03);
            let mut n_ticks = 0;
            for _ in 0..frames_per_s * 30 {
                n_ticks += clock.advance(1.0 / f64::from(frames_per_s));
                assert!((0.0..1.0).contains(&clock.alpha()));
            }
            // 30 s are 1000 ticks; the sum of rounded frame times may end just short of the last one.
            assert!((999..=1000).contains(&n_ticks), "{n_ticks} at {frames_per_s} frames/s");
        }
    }

    #[test]
    fn a_pause_holds_steps_are_single_and_going_on_is_seamless() {
        let mut clock = Clock::new(0.03);
        clock.advance(0.02);
        clock.toggle_pause();
        assert_eq!((clock.advance(10.0), clock.alpha(), clock.pace()), (0, 1.0, Some("paused")));
        clock.step();
        assert_eq!((clock.advance(0.0), clock.advance(10.0), clock.alpha()), (1, 0, 1.0));
        clock.toggle_pause();
        // What was shown is the last tick's end, which is the next one's beginning.
        assert_eq!((clock.advance(0.0), clock.alpha(), clock.pace()), (1, 0.0, None));
        clock.step();
        assert_eq!((clock.advance(10.0), clock.pace()), (1, Some("paused")));
    }

    #[test]
    fn slow_motion_goes_down_to_a_32nd() {
        let mut clock = Clock::new(0.03);
        for n_ticks in [200_u32, 100, 50, 25] {
            let made: u32 = (0..600).map(|_| clock.advance(0.01)).sum();
            assert!(made.abs_diff(n_ticks) <= 1, "{made} of {n_ticks} at {:?}", clock.pace());
            clock.slower();
        }
        (0..10).for_each(|_| clock.slower());
        assert_eq!(clock.pace(), Some("1/32 speed"));
        (0..10).for_each(|_| clock.faster());
        assert_eq!(clock.pace(), None);
    }

    #[test]
    fn a_long_pause_is_forgotten() {
        let mut clock = Clock::new(0.03);
        assert_eq!(clock.advance(3600.0), MAX_TICKS_PER_FRAME);
        assert_eq!(clock.advance(0.031), 1);
    }
}
