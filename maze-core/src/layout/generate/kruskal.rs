//! Kruskal's algorithm: passages opened in random order wherever they join two parts.

use super::{below, rng};
use crate::layout::{Layout, LayoutSizeError};

/// A perfect maze with many short dead ends, even in all directions: a minimum spanning tree of random weights.
///
/// J. B. Kruskal, "On the shortest spanning subtree of a graph and the traveling salesman problem", 1956.
pub(super) fn kruskal(width: usize, height: usize, seed: u64) -> Result<Layout, LayoutSizeError> {
    let mut layout = Layout::walled(width, height)?;
    let mut rng = rng(seed);
    let mut walls: Vec<(usize, usize)> = Vec::with_capacity(2 * width * height);
    for cell in 0..width * height {
        walls.extend((cell % width + 1 < width).then_some((cell, cell + 1)));
        walls.extend((cell / width + 1 < height).then_some((cell, cell + width)));
    }
    let mut parts = Parts::new(width * height);
    // Fisher and Yates' shuffle, drawn as it is used.
    for n_left in (1..=walls.len()).rev() {
        let (a, b) = walls.swap_remove(below(&mut rng, n_left));
        if parts.join(a, b) {
            layout.join(a, b);
        }
    }
    Ok(layout)
}

/// Disjoint sets with path halving.
pub(super) struct Parts {
    parents: Vec<usize>,
}

impl Parts {
    pub(super) fn new(n: usize) -> Self {
        Self { parents: (0..n).collect() }
    }

    /// One member that stands for all of its set.
    pub(super) fn root(&mut self, mut member: usize) -> usize {
        while self.parents[member] != member {
            self.parents[member] = self.parents[self.parents[member]];
            member = self.parents[member];
        }
        member
    }

    /// False when the two are in one set already.
    pub(super) fn join(&mut self, a: usize, b: usize) -> bool {
        let (a, b) = (self.root(a), self.root(b));
        // The lower root stays: with random pairs and path halving no ranks are needed.
        let (low, high) = if a < b { (a, b) } else { (b, a) };
        self.parents[high] = low;
        a != b
    }
}
