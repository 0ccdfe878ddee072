//! What a tick costs as the ball's speed grows 1000 times, with the hits in a tick named: exact, in substeps, and rapier3d's
//! step: `cargo bench -p maze-verify --bench speed`.

mod questions;

use criterion::{Criterion, criterion_group, criterion_main};
use maze_verify::bench::Case;
use maze_verify::bench::tick::{FAST_SIZE, SPEEDS, fast};

fn speeds(criterion: &mut Criterion) {
    let case = Case::new(FAST_SIZE[0], FAST_SIZE[1]).unwrap_or_else(|error| panic!("{error}"));
    for speed in SPEEDS {
        questions::ask(criterion, fast(&case, speed));
    }
}

criterion_group! { name = speed; config = questions::config(); targets = speeds }
criterion_main!(speed);
