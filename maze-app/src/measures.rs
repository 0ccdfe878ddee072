//! A maze's numbers in words and as JSON.

use maze_core::Maze;
use maze_core::layout::Metrics;
use serde_json::{Value, json};

/// Lines of text; only what is known of this maze.
pub(crate) fn lines(maze: &Maze) -> Vec<String> {
    match (maze.path_length(), maze.metrics()) {
        (None, _) => Vec::new(),
        (Some(length), None) => vec![format!("path         {length:.1} long")],
        (Some(_), Some(metrics)) => metrics.to_string().lines().map(str::to_owned).collect(),
    }
}

/// In the names of [`Metrics`].
pub(crate) fn json(metrics: &Metrics) -> Value {
    json!({
        "solution_length": metrics.solution_length,
        "turns": metrics.n_turns,
        "straightness": metrics.straightness,
        "directness": metrics.directness,
        "shortest_solutions": metrics.n_shortest,
        "unique": metrics.is_unique,
        "dead_ends": metrics.n_dead_ends,
        "dead_end_length": metrics.dead_end_length,
        "junctions": metrics.n_junctions,
        "crossroads": metrics.n_crossroads,
        "loops": metrics.n_loops,
        "difficulty": metrics.difficulty,
    })
}
