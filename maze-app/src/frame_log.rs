//! What each frame took: the report's figures 20 and 21, live on F3 and as a file from `maze-app frames`.

use cpu_time::{ProcessTime, ThreadTime};
use std::collections::VecDeque;
use std::fmt::Write;
use std::time::{Duration, Instant};

/// Time over which frames a second and the processor's share are averaged (s).
const WINDOW_S: f64 = 0.5;

/// Measures the processor's time of the thread that starts it: other programs on the machine do not count.
pub(crate) struct Stopwatch(Option<ThreadTime>);

impl Stopwatch {
    pub(crate) fn start() -> Self {
        Self(ThreadTime::try_now().ok())
    }

    /// Milliseconds; 0 where the system does not measure it.
    pub(crate) fn ms(&self) -> f64 {
        self.0.and_then(|time| time.try_elapsed().ok()).map_or(0.0, ms)
    }
}

fn ms(time: Duration) -> f64 {
    time.as_secs_f64() * 1.0e3
}

/// What our own thread did for a frame (ms of the processor).
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Parts {
    /// Input, physics, rules.
    pub(crate) simulate: f64,
    /// The scene and the HUD into commands, and handing them over.
    pub(crate) encode: f64,
    /// Waiting for the window's next picture and giving it back.
    pub(crate) present: f64,
}

/// One line of the log. Times in milliseconds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    number: u64,
    /// Since the first frame (s).
    at_s: f64,
    /// By the clock, since the frame before.
    frame: f64,
    /// Of the processor, all threads of the process, since the frame before: a software driver draws there.
    process: f64,
    parts: Parts,
    /// By the adapter's clock.
    gpu: Option<f64>,
}

/// Half the values are below the median, 99 in 100 below p99.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Spread {
    pub(crate) median: f64,
    pub(crate) p99: f64,
}

/// Averages over a short while: a point of the two graphs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rate {
    pub(crate) at_s: f64,
    pub(crate) frames_per_s: f64,
    /// 100 is one core.
    pub(crate) processor_percent: f64,
}

/// The last frames, or all of them.
pub(crate) struct FrameLog {
    frames: VecDeque<Frame>,
    /// Older frames are dropped.
    keep_s: f64,
    /// The first frame.
    begun: Option<Instant>,
    last: Option<(Instant, Duration)>,
    n_frames: u64,
}

impl FrameLog {
    pub(crate) fn new(keep_s: f64) -> Self {
        Self { frames: VecDeque::new(), keep_s, begun: None, last: None, n_frames: 0 }
    }

    /// Notes a frame that is done. The first has none before it to be measured from, and is left out.
    pub(crate) fn push(&mut self, parts: Parts) {
        let now = Instant::now();
        let used = ProcessTime::try_now().map_or(Duration::ZERO, |time| time.as_duration());
        self.begun.get_or_insert(now);
        if let Some((last, used_then)) = self.last.replace((now, used)) {
            let at_s = (now - self.begun.unwrap_or(last)).as_secs_f64();
            let (frame, process) = (ms(now - last), ms(used.saturating_sub(used_then)));
            self.frames.push_back(Frame { number: self.n_frames, at_s, frame, process, parts, gpu: None });
            while self.frames.front().is_some_and(|first| first.at_s < at_s - self.keep_s) {
                self.frames.pop_front();
            }
        }
        self.n_frames += 1;
    }

    /// Notes the last frame in another log too.
    pub(crate) fn copy_last_to(&self, other: &mut Self) {
        other.frames.extend(
            self.frames
                .back()
                .filter(|last| other.frames.back().is_none_or(|known| known.number < last.number)),
        );
    }

    /// Number of the frame that the next [`FrameLog::push`] notes.
    pub(crate) fn next_number(&self) -> u64 {
        self.n_frames
    }

    /// The adapter's time of a frame comes some frames later.
    pub(crate) fn set_gpu_time(&mut self, number: u64, seconds: f64) {
        if let Some(frame) = self.frames.iter_mut().rev().find(|frame| frame.number == number) {
            frame.gpu = Some(seconds * 1.0e3);
        }
    }

    pub(crate) fn len(&self) -> usize {
        self.frames.len()
    }

    /// `None` before the second frame.
    pub(crate) fn frame_ms(&self) -> Option<Spread> {
        spread(self.frames.iter().map(|frame| frame.frame))
    }

    /// The frame that took longest (ms), and when it ended (s after the first): the median hides a driver that stood still.
    pub(crate) fn slowest(&self) -> Option<(f64, f64)> {
        let slowest = self.frames.iter().max_by(|a, b| a.frame.total_cmp(&b.frame));
        slowest.map(|frame| (frame.frame, frame.at_s))
    }

    /// Simulate and encode together: what is ours of a frame.
    pub(crate) fn ours_ms(&self) -> Option<Spread> {
        spread(self.frames.iter().map(|frame| frame.parts.simulate + frame.parts.encode))
    }

    /// All threads of the process.
    pub(crate) fn process_ms(&self) -> Option<Spread> {
        spread(self.frames.iter().map(|frame| frame.process))
    }

    /// `None` where the adapter does not measure it.
    pub(crate) fn gpu_ms(&self) -> Option<Spread> {
        spread(self.frames.iter().filter_map(|frame| frame.gpu))
    }

    /// Medians of the parts.
    pub(crate) fn parts_ms(&self) -> Parts {
        let median = |part: fn(&Parts) -> f64| {
            spread(self.frames.iter().map(|frame| part(&frame.parts))).map_or(0.0, |spread| spread.median)
        };
        Parts {
            simulate: median(|parts| parts.simulate),
            encode: median(|parts| parts.encode),
            present: median(|parts| parts.present),
        }
    }

    /// Over windows of half a second, without gaps; what is left at the end is not long enough for one.
    pub(crate) fn rates(&self) -> Vec<Rate> {
        let mut rates = Vec::new();
        let (mut frame_ms, mut process_ms, mut n_frames) = (0.0, 0.0, 0.0);
        for frame in &self.frames {
            frame_ms += frame.frame;
            process_ms += frame.process;
            n_frames += 1.0;
            if WINDOW_S * 1.0e3 <= frame_ms {
                rates.push(Rate {
                    at_s: frame.at_s,
                    frames_per_s: n_frames / frame_ms * 1.0e3,
                    processor_percent: 100.0 * process_ms / frame_ms,
                });
                (frame_ms, process_ms, n_frames) = (0.0, 0.0, 0.0);
            }
        }
        rates
    }

    /// One line a frame, after a line that names the columns.
    pub(crate) fn csv(&self) -> String {
        let mut text =
            "frame,time_s,frame_ms,process_ms,simulate_ms,encode_ms,present_ms,gpu_ms\n".to_owned();
        for frame in &self.frames {
            let Frame { number, at_s, frame, process, parts, gpu } = frame;
            let Parts { simulate, encode, present } = parts;
            // Writing to a string cannot fail.
            let _ = write!(
                text,
                "{number},{at_s:.4},{frame:.3},{process:.3},{simulate:.4},{encode:.4},{present:.4},"
            );
            let _ = match gpu {
                Some(gpu) => writeln!(text, "{gpu:.4}"),
                None => writeln!(text),
            };
        }
        text
    }
}

fn spread(values: impl Iterator<Item = f64>) -> Option<Spread> {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    let last = values.len().checked_sub(1)?;
    // The value that so many in a hundred do not exceed (nearest rank).
    let rank = |percent: usize| values[((last + 1) * percent).div_ceil(100).max(1) - 1];
    Some(Spread { median: rank(50), p99: rank(99) })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn log_of(frame_ms: impl Iterator<Item = f64>) -> FrameLog {
        let mut log = FrameLog::new(f64::MAX);
        let mut at_s = 0.0;
        for (number, frame) in (0..).zip(frame_ms) {
            at_s += frame / 1.0e3;
            let parts = Parts { simulate: 0.1, encode: 0.2, present: 0.3 };
            log.frames.push_back(Frame { number, at_s, frame, process: 0.5 * frame, parts, gpu: None });
        }
        log
    }

    #[test]
    fn spreads_are_nearest_ranks() {
        assert_eq!(spread(std::iter::empty()), None);
        assert_eq!(spread([3.0].into_iter()), Some(Spread { median: 3.0, p99: 3.0 }));
        let hundred = (1..=100).rev().map(f64::from);
        assert_eq!(spread(hundred), Some(Spread { median: 50.0, p99: 99.0 }));
    }

    #[test]
    fn rates_are_frames_and_processor_over_the_clock() {
        let rates = log_of(std::iter::repeat_n(10.0, 170)).rates();
        assert_eq!(rates.len(), 3, "half a second each");
        for rate in rates {
            assert!(
                (rate.frames_per_s - 100.0).abs() < 1.0e-9 && (rate.processor_percent - 50.0).abs() < 1.0e-9
            );
        }
    }

    #[test]
    fn the_slowest_frame_is_named_with_its_time() {
        assert_eq!(log_of(std::iter::empty()).slowest(), None);
        assert_eq!(log_of([16.0, 250.0, 17.0].into_iter()).slowest(), Some((250.0, 0.266)));
    }

    #[test]
    fn a_csv_has_a_line_a_frame_and_leaves_out_what_the_adapter_did_not_tell() {
        let mut log = log_of([16.0, 17.5].into_iter());
        log.set_gpu_time(1, 0.002);
        log.set_gpu_time(7, 0.009);
        assert_eq!(
            log.csv(),
            "frame,time_s,frame_ms,process_ms,simulate_ms,encode_ms,present_ms,gpu_ms\n\
             0,0.0160,16.000,8.000,0.1000,0.2000,0.3000,\n\
             1,0.0335,17.500,8.750,0.1000,0.2000,0.3000,2.0000\n"
        );
    }

    #[test]
    fn old_frames_are_dropped_and_time_is_measured() {
        let mut log = FrameLog::new(0.05);
        for _ in 0..8 {
            log.push(Parts::default());
            std::thread::sleep(Duration::from_millis(15));
        }
        assert!((1..=5).contains(&log.len()), "{} frames of 15 ms in 50 ms", log.len());
        assert!(15.0 <= log.frame_ms().unwrap().median);
        assert_eq!(log.next_number(), 8);
    }
}
