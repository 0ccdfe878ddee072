//! The recursive backtracker: depth-first search in random order.

use super::{rng, unvisited_neighbour};
use crate::layout::{Layout, LayoutSizeError};

/// A perfect maze (one path between any two cells) with long winding corridors, by depth-first search from a corner.
///
/// # Errors
/// See [`Layout::walled`].
pub fn recursive_backtracker(width: usize, height: usize, seed: u64) -> Result<Layout, LayoutSizeError> {
    let mut layout = Layout::walled(width, height)?;
    let mut rng = rng(seed);
    let mut visited = vec![false; width * height];
    visited[0] = true;
    let mut trail = vec![0];
    while let Some(&cell) = trail.last() {
        let Some(next) = unvisited_neighbour(&layout, cell, &visited, &mut rng) else {
            trail.pop();
            continue;
        };
        visited[next] = true;
        layout.join(cell, next);
        trail.push(next);
    }
    Ok(layout)
}
