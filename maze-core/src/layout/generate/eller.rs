//! Eller's algorithm: a maze row by row, with no more memory than a row takes.

use super::kruskal::Parts;
use super::{below, rng};
use crate::layout::{Layout, LayoutSizeError};
use rand_chacha::ChaCha8Rng;

/// One row of cells.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EllerRow {
    /// Whether a passage leads from each cell to the one on its right; the last one is false.
    pub east: Vec<bool>,
    /// Whether a passage leads from each cell to the one in the next row.
    pub north: Vec<bool>,
}

/// The rows of a perfect maze, made one at a time (M. Eller, 1982; described by J. Buck, "Mazes for Programmers", 2015).
///
/// Holds a few numbers a column, however many rows there are: what has been given out is not needed any more.
#[derive(Clone, Debug)]
pub struct EllerRows {
    n_rows_left: usize,
    sets: Vec<usize>, // of each column: cells of one set are joined by rows given out before; below the width
    rng: ChaCha8Rng,
}

impl EllerRows {
    /// Rows of `width` cells, `height` of them; none when either is 0.
    pub fn new(width: usize, height: usize, seed: u64) -> Self {
        let n_rows_left = if width == 0 { 0 } else { height };
        Self { n_rows_left, sets: (0..width).collect(), rng: rng(seed) }
    }

    #[cfg(test)]
    pub(super) fn n_sets(&self) -> usize {
        self.sets.capacity()
    }

    /// Opens passages within the row: half of those that close no ring; in the last row all of them.
    fn join_east(&mut self, parts: &mut Parts) -> Vec<bool> {
        let is_last = self.n_rows_left == 0;
        let mut east = vec![false; self.sets.len()];
        for x in 1..self.sets.len() {
            let wanted = is_last || below(&mut self.rng, 2) == 1;
            east[x - 1] = wanted && parts.join(self.sets[x - 1], self.sets[x]);
        }
        east
    }

    /// Opens passages to the next row: one at a random place of every set, and half of the others.
    fn join_north(&mut self) -> Vec<bool> {
        let width = self.sets.len();
        let mut n_members = vec![0; width];
        for set in &self.sets {
            n_members[*set] += 1;
        }
        // How many members of each set pass until the one that goes on in any case.
        let mut until_chosen: Vec<usize> = Vec::with_capacity(width);
        until_chosen.extend(n_members.iter().map(|n| if *n == 0 { 0 } else { below(&mut self.rng, *n) }));
        let mut north = Vec::with_capacity(width);
        for set in &self.sets {
            let is_chosen = until_chosen[*set] == 0;
            // Past the chosen one it wraps around to more than any count.
            until_chosen[*set] = until_chosen[*set].wrapping_sub(1);
            north.push(is_chosen || below(&mut self.rng, 2) == 1);
        }
        north
    }

    /// The next row's sets: those that go on keep theirs; the others get one of those that nobody has.
    fn carry_over(&mut self, north: &[bool]) {
        let width = self.sets.len();
        let mut is_used = vec![false; width];
        for (set, _) in self.sets.iter().zip(north).filter(|(_, goes_on)| **goes_on) {
            is_used[*set] = true;
        }
        let mut unused = (0..width).filter(|set| !is_used[*set]);
        for (set, _) in self.sets.iter_mut().zip(north).filter(|(_, goes_on)| !**goes_on) {
            // There are as many sets as columns, so one is left for each.
            *set = unused.next().unwrap_or_default();
        }
    }
}

impl Iterator for EllerRows {
    type Item = EllerRow;

    fn next(&mut self) -> Option<EllerRow> {
        self.n_rows_left = self.n_rows_left.checked_sub(1)?;
        let width = self.sets.len();
        let mut parts = Parts::new(width);
        let east = self.join_east(&mut parts);
        for set in &mut self.sets {
            *set = parts.root(*set);
        }
        if self.n_rows_left == 0 {
            return Some(EllerRow { east, north: vec![false; width] });
        }
        let north = self.join_north();
        self.carry_over(&north);
        Some(EllerRow { east, north })
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        (self.n_rows_left, Some(self.n_rows_left))
    }
}

/// A perfect maze of Eller's rows, the first one at the bottom.
pub(super) fn eller(width: usize, height: usize, seed: u64) -> Result<Layout, LayoutSizeError> {
    let mut layout = Layout::walled(width, height)?;
    for (y, row) in EllerRows::new(width, height, seed).enumerate() {
        layout.east[y * width..(y + 1) * width].copy_from_slice(&row.east);
        layout.north[y * width..(y + 1) * width].copy_from_slice(&row.north);
    }
    Ok(layout)
}
