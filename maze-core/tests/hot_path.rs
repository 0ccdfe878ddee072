//! A tick allocates nothing.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod noise;

use maze_core::{AssembleOptions, Ball, BallSpec, Continuous, Engine, Published, layout};
use noise::Noise;

/// Counts the allocations of 5000 ticks in which the ball flies, bounces, slides, rolls around corners and rests.
fn n_allocations(mut engine: impl Engine) -> u64 {
    let mut noise = Noise(3);
    let mut n_hits = 0;
    let counted = allocation_counter::measure(|| {
        for n in 0..5000 {
            let strength = if n % 1000 < 10 { 300.0 } else { 3.0 };
            n_hits += engine.tick(noise.vector() * strength).map_or(0, |tick| tick.n_hits);
        }
    });
    assert!(100 < n_hits, "{n_hits} hits");
    counted.count_total
}

#[test]
fn a_tick_of_either_engine_allocates_nothing() {
    let layout = layout::recursive_backtracker(8, 6, 1).unwrap();
    let maze = layout.maze(&AssembleOptions::default()).unwrap();
    let (planes, spec, ball) = (maze.planes.clone(), BallSpec::default(), Ball::at(maze.start()));
    assert_eq!(n_allocations(Continuous::new(planes.clone(), spec, ball, 0.03).unwrap()), 0);
    assert_eq!(n_allocations(Published::new(planes, spec, ball, Published::TICK_S).unwrap()), 0);
    // The counter does count.
    assert!(0 < allocation_counter::measure(|| drop(std::hint::black_box(vec![1_u8; 100]))).count_total);
}
