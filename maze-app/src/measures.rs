//! A maze's numbers in words and as JSON.

use maze_core::Maze;
use maze_core::layout::{MOST_COUNTED, Metrics};
use serde_json::{Value, json};

/// Lines for a person; only what is known of this maze.
pub(crate) fn lines(maze: &Maze) -> Vec<String> {
    let Some(path_length) = maze.path_length() else { return Vec::new() };
    let Some(metrics) = maze.metrics() else {
        return vec![format!("path         {path_length:.1} corridors long")];
    };
    let Metrics { n_turns, n_dead_ends, n_junctions, n_crossroads, n_loops, .. } = metrics;
    let dead_ends = match n_dead_ends {
        0 => "dead ends    none".to_owned(),
        n => format!("dead ends    {n}, on average {:.1} corridors off the path", metrics.dead_end_length),
    };
    vec![
        format!(
            "path         {path_length:.1} corridors long (without walls {:.1}), {n_turns} turns, {}",
            metrics.directness * metrics.solution_length,
            solutions(&metrics)
        ),
        format!("straightness {:.2} corridors from turn to turn", metrics.straightness),
        dead_ends,
        format!("junctions    {n_junctions}, crossroads {n_crossroads}, loops {n_loops}"),
        format!("difficulty   {:.1} (after McClendon 2001)", metrics.difficulty),
    ]
}

fn solutions(metrics: &Metrics) -> String {
    match (metrics.is_unique, metrics.n_shortest) {
        (true, _) => "the only one".to_owned(),
        (false, 1) => "the only one as short".to_owned(),
        (false, MOST_COUNTED) => format!("one of {MOST_COUNTED} or more as short"),
        (false, n) => format!("one of {n} as short"),
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
