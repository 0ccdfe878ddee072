//! 10⁵ independent balls in one maze, on one and on two threads: `cargo bench -p maze-verify --bench balls`.
//!
//! The throughput is in ticks of one ball.

mod questions;

use criterion::{Criterion, criterion_group, criterion_main};
use maze_verify::bench::Case;
use maze_verify::bench::tick::{MANY_SIZE, many};

fn multitude(criterion: &mut Criterion) {
    let case = Case::new(MANY_SIZE[0], MANY_SIZE[1]).unwrap_or_else(|error| panic!("{error}"));
    questions::ask(criterion, many(&case));
}

criterion_group! { name = balls; config = questions::config(); targets = multitude }
criterion_main!(balls);
