//! Questions about ticks, with criterion's statistics.

use cpu_time::ProcessTime;
use criterion::{BenchmarkId, Criterion, Throughput};
use maze_verify::bench::BenchError;
use maze_verify::bench::tick::Question;
use std::time::Duration;

/// Short, since there are many.
pub(crate) fn config() -> Criterion {
    Criterion::default()
        .sample_size(20)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(800))
}

/// Says how the answers compare, and times all contenders: ticks of one ball are what the throughput counts.
pub(crate) fn ask(criterion: &mut Criterion, question: Result<Question, BenchError>) {
    let question = question.unwrap_or_else(|error| panic!("{error}"));
    for found in &question.comparisons {
        assert!(found.holds, "{found:?}");
        if 0 < found.n_apart {
            let (contender, limit, worst) = (found.contender, found.limit, found.worst);
            println!(
                "{contender}: {} of {} off by more than {limit}, by up to {worst:.1e} units",
                found.n_apart, found.n_asked
            );
        }
    }
    let mut parameter = format!("{} planes", question.n_planes);
    if let Some(hits) = question.hits_a_tick {
        parameter += &format!(" {hits:.2} hits a tick");
    }
    let mut group = criterion.benchmark_group(question.name);
    for mut entrant in question.entrants {
        group.throughput(Throughput::Elements(entrant.n_balls as u64));
        group.bench_function(BenchmarkId::new(entrant.runner.name, &parameter), |bencher| {
            bencher.iter_custom(|n| {
                let start = ProcessTime::now();
                std::hint::black_box((entrant.runner.run)(usize::try_from(n).unwrap_or(usize::MAX)));
                start.elapsed()
            });
        });
    }
}
