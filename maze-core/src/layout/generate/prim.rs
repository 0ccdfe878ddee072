//! Prim's algorithm, randomised: the maze grows through a random wall of its rim.

use super::{below, neighbours, rng};
use crate::layout::{Layout, LayoutSizeError};

/// A perfect maze that spreads from the middle, with many short dead ends and a direct solution.
///
/// R. C. Prim, "Shortest connection networks and some generalizations", 1957; instead of the shortest, any wall between
/// the maze and the rest is taken next, each with the same probability.
pub(super) fn prim(width: usize, height: usize, seed: u64) -> Result<Layout, LayoutSizeError> {
    let mut layout = Layout::walled(width, height)?;
    let mut rng = rng(seed);
    let mut is_joined = vec![false; width * height];
    let mut rim: Vec<(usize, usize)> = Vec::new(); // (cell of the maze, its neighbour)
    let mut newest = height / 2 * width + width / 2;
    is_joined[newest] = true;
    loop {
        let outside =
            neighbours(newest, [width, height]).into_iter().flatten().filter(|next| !is_joined[*next]);
        rim.extend(outside.map(|next| (newest, next)));
        // Walls to cells that have joined meanwhile are dropped when drawn.
        (newest, _) = loop {
            if rim.is_empty() {
                return Ok(layout);
            }
            let (cell, next) = rim.swap_remove(below(&mut rng, rim.len()));
            if !is_joined[next] {
                layout.join(cell, next);
                is_joined[next] = true;
                break (next, cell);
            }
        };
    }
}
