//! What it takes to make each contender's structure: `cargo bench -p maze-verify --bench build`.
//!
//! Prints the bytes a plane that stay and the most that were held on the way, as a counting allocator sees them, then times.
//! The counting costs each allocation a few nanoseconds.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use maze_verify::bench::search::{CONTENDERS, Contender, Search};
use maze_verify::bench::{BenchError, Case, Plan};
use std::time::Duration;

fn build(criterion: &mut Criterion) {
    if let Err(error) = all_sizes(criterion) {
        panic!("{error}");
    }
}

fn all_sizes(criterion: &mut Criterion) -> Result<(), BenchError> {
    let mut group = criterion.benchmark_group("build");
    for [tile, n_tiles] in &Plan::quick().sizes {
        let case = Case::new(*tile, *n_tiles)?;
        let n_planes = case.planes().len();
        group.throughput(Throughput::Elements(n_planes as u64));
        for contender in CONTENDERS.iter().filter(|contender| n_planes <= contender.max_planes) {
            let [resident, most] = bytes_a_plane(contender, &case)?;
            println!("{}, {n_planes} planes: {resident:.1} bytes a plane, at most {most:.1}", contender.name);
            group.bench_function(BenchmarkId::new(contender.name, n_planes), |bencher| {
                bencher.iter_with_large_drop(|| (contender.build)(&case));
            });
        }
    }
    group.finish();
    Ok(())
}

/// What stays allocated, and the most that was at once.
#[allow(clippy::cast_precision_loss, reason = "counts far below 2^53")]
fn bytes_a_plane(contender: &Contender, case: &Case) -> Result<[f64; 2], BenchError> {
    let mut built: Option<Result<Box<dyn Search>, BenchError>> = None;
    let info = allocation_counter::measure(|| built = Some((contender.build)(case)));
    built.transpose()?;
    let n_planes = case.planes().len() as f64;
    Ok([info.bytes_current as f64 / n_planes, info.bytes_max as f64 / n_planes])
}

criterion_group! {
    name = builds;
    config = Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_secs(1));
    targets = build
}
criterion_main!(builds);
