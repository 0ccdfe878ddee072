//! Timing in turn: what disturbs the machine for a while disturbs all alike.

use cpu_time::ProcessTime;
use std::hint::black_box;
use std::time::Duration;

/// Least number of operations in a batch: what they cost may differ much.
const LEAST_IN_BATCH: usize = 16;

/// Something to be timed.
pub struct Runner<'a> {
    /// As in the table.
    pub name: &'static str,
    /// Does so many operations, going on where the last call ended; gives something that depends on all of them.
    pub run: Box<dyn FnMut(usize) -> f64 + 'a>,
}

/// What one contender took, round by round.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// As in the table.
    pub name: &'static str,
    /// An operation (ns of processor time), one figure a round.
    pub ns: Vec<f64>,
}

/// Times all in turn, A B C A B C, each for at least `batch` a round.
pub fn time(runners: &mut [Runner], n_rounds: usize, batch: Duration) -> Vec<Series> {
    let sizes: Vec<usize> = runners.iter_mut().map(|runner| batch_size(runner, batch)).collect();
    let mut series: Vec<Series> =
        runners.iter().map(|runner| Series { name: runner.name, ns: Vec::with_capacity(n_rounds) }).collect();
    for _ in 0..n_rounds {
        for ((runner, size), series) in runners.iter_mut().zip(&sizes).zip(&mut series) {
            series.ns.push(ns_each(runner, *size));
        }
    }
    series
}

/// How many operations take as long as a batch shall; warms up on the way.
fn batch_size(runner: &mut Runner, batch: Duration) -> usize {
    let batch_ns = batch.as_secs_f64() * 1.0e9;
    let mut size = LEAST_IN_BATCH;
    loop {
        let took_ns = ns_each(runner, size) * to_f64(size);
        if batch_ns <= took_ns {
            return size;
        }
        // Towards the goal, but never far past it on the basis of a short measurement.
        let factor = (1.2 * batch_ns / took_ns.max(1.0)).clamp(1.1, 8.0);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a positive count")]
        let larger = (to_f64(size) * factor).ceil() as usize;
        size = larger;
    }
}

/// Processor time, of all threads together: what a batch takes must not depend on what else runs.
fn ns_each(runner: &mut Runner, size: usize) -> f64 {
    let start = ProcessTime::now();
    black_box((runner.run)(black_box(size)));
    start.elapsed().as_secs_f64() * 1.0e9 / to_f64(size)
}

#[allow(clippy::cast_precision_loss, reason = "counts far below 2^53")]
fn to_f64(n: usize) -> f64 {
    n as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::RefCell;

    #[test]
    fn contenders_take_turns_and_each_round_is_kept() {
        let order = &RefCell::new(Vec::new());
        let runner = |name: &'static str| Runner {
            name,
            run: Box::new(move |n| {
                order.borrow_mut().push(name);
                to_f64(n)
            }),
        };
        let series = time(&mut [runner("a"), runner("b")], 3, Duration::from_nanos(1));
        // However often each was run to find the size of its batches, three rounds follow.
        assert!(order.borrow().ends_with(&["a", "b", "a", "b", "a", "b"]));
        assert_eq!(
            series.iter().map(|series| (series.name, series.ns.len())).collect::<Vec<_>>(),
            [("a", 3), ("b", 3)]
        );
    }
}
