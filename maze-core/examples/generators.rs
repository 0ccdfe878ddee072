//! How long each generator takes for a maze of 1000 x 1000 cells, and how long the longest path through it is.
//!
//! `cargo run --release -p maze-core --example generators`
#![allow(clippy::disallowed_methods, reason = "a clock beside the physics, not in it")]
#![allow(clippy::print_stdout, reason = "what it is for")]

use maze_core::layout::{Algorithm, CorridorGraph, Metrics, Recipe};
use std::time::Instant;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!(
        "{:<14} {:>8} {:>10} {:>10} {:>12}",
        "algorithm", "made", "measured", "dead ends", "longest path"
    );
    for algorithm in Algorithm::ALL {
        for braid in [0.0, 1.0] {
            let recipe = Recipe { braid, ..Recipe::new(1000, 1000, algorithm, 1) };
            let begun = Instant::now();
            let layout = recipe.layout()?;
            let made = begun.elapsed();
            let begun = Instant::now();
            let graph = CorridorGraph::of_layout(&layout);
            let ends = graph.ends().ok_or("a maze without cells")?;
            let metrics = Metrics::new(&graph, ends[0], ends[1]).ok_or("a maze without a path")?;
            let name = if braid == 0.0 { algorithm.name().to_owned() } else { "  braided".to_owned() };
            println!(
                "{name:<14} {:>6.0}ms {:>8.0}ms {:>10} {:>12}",
                made.as_secs_f64() * 1.0e3,
                begun.elapsed().as_secs_f64() * 1.0e3,
                metrics.n_dead_ends,
                metrics.solution_length
            );
        }
    }
    Ok(())
}
