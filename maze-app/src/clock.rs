//! Fixed ticks from uneven frames.

/// Most ticks made up for in one frame. A longer pause (a dragged window, a debugger) is forgotten, not replayed.
const MAX_TICKS_PER_FRAME: u32 = 8;

/// Turns elapsed time into whole ticks and a remainder for interpolated drawing.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Clock {
    tick_s: f64,
    left_s: f64,
}

impl Clock {
    pub(crate) fn new(tick_s: f64) -> Self {
        Self { tick_s, left_s: 0.0 }
    }

    /// Ticks that have become due after another `elapsed_s`.
    pub(crate) fn advance(&mut self, elapsed_s: f64) -> u32 {
        self.left_s += elapsed_s;
        let mut n_ticks = 0;
        while self.tick_s <= self.left_s {
            self.left_s -= self.tick_s;
            n_ticks += 1;
            if n_ticks == MAX_TICKS_PER_FRAME {
                self.left_s = 0.0;
            }
        }
        n_ticks
    }

    /// How far the time has gone from the last tick to the next, 0..1.
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
    fn a_long_pause_is_forgotten() {
        let mut clock = Clock::new(0.03);
        assert_eq!(clock.advance(3600.0), MAX_TICKS_PER_FRAME);
        assert_eq!(clock.advance(0.031), 1);
    }
}
