//! What a swept circle touches first: `cargo bench -p maze-verify --bench broad_phase`.
//!
//! The bodies of `maze-verify bench` with criterion's statistics, up to a million planes. Nothing is timed before all
//! contenders have answered ten thousand queries of the kind; what differs and may is printed, what may not ends the run.
//! `-- 'rolling ball'` or `-- '/1012$'` chooses.

use cpu_time::ProcessTime;
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use maze_verify::bench::agreement::check;
use maze_verify::bench::search::{CONTENDERS, in_turn};
use maze_verify::bench::{BenchError, Case, Plan};
use std::time::Duration;

fn first_touch(criterion: &mut Criterion) {
    if let Err(error) = all_sizes(criterion) {
        panic!("{error}");
    }
}

fn all_sizes(criterion: &mut Criterion) -> Result<(), BenchError> {
    let plan = Plan::quick();
    for [tile, n_tiles] in &plan.sizes {
        let case = Case::new(*tile, *n_tiles)?;
        let n_planes = case.planes().len();
        let mut built = Vec::new();
        for contender in CONTENDERS.iter().filter(|contender| n_planes <= contender.max_planes) {
            built.push((contender, (contender.build)(&case)?));
        }
        for set in plan.query_sets(&case)? {
            let (comparisons, hit_part) = check(&mut built, n_planes, &set, plan.n_checked);
            println!("{}, {n_planes} planes: {:.1} % touch something", set.name, 100.0 * hit_part);
            for found in comparisons {
                assert!(found.holds, "{found:?}");
                if 0 < found.n_apart + found.n_missed {
                    let (contender, n_apart, n_missed) = (found.contender, found.n_apart, found.n_missed);
                    println!(
                        "  {contender}: {n_apart} off by up to {:.1e} units, {n_missed} missed",
                        found.worst
                    );
                }
            }
            let mut group = criterion.benchmark_group(set.name);
            group.throughput(Throughput::Elements(1));
            for (contender, search) in &mut built {
                let mut ask = in_turn(search.as_mut(), &set.queries);
                group.bench_function(BenchmarkId::new(contender.name, n_planes), |bencher| {
                    bencher.iter_custom(|n| {
                        let start = ProcessTime::now();
                        std::hint::black_box(ask(usize::try_from(n).unwrap_or(usize::MAX)));
                        start.elapsed()
                    });
                });
            }
        }
    }
    Ok(())
}

criterion_group! {
    name = broad_phase;
    config = Criterion::default()
        .sample_size(20)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(800));
    targets = first_touch
}
criterion_main!(broad_phase);
