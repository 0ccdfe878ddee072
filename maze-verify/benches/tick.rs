//! A whole tick: our engines, rapier3d's step and its broad phase alone: `cargo bench -p maze-verify --bench tick`.
//!
//! The bodies of `maze-verify bench` with criterion's statistics, up to a million planes: a ball that rolls, and balls all
//! over the maze in turn. `-- 'rolling tick'` or `-- '/1012 '` chooses.

mod questions;

use criterion::{Criterion, criterion_group, criterion_main};
use maze_verify::bench::tick::{Course, anywhere, rolling};
use maze_verify::bench::{Case, Plan};

fn ticks(criterion: &mut Criterion) {
    for [tile, n_tiles] in Plan::quick().tick_sizes {
        let case = Case::new(tile, n_tiles).unwrap_or_else(|error| panic!("{error}"));
        let course = Course::middle(&case);
        questions::ask(criterion, rolling(&course));
        questions::ask(criterion, anywhere(course));
    }
}

criterion_group! { name = tick; config = questions::config(); targets = ticks }
criterion_main!(tick);
