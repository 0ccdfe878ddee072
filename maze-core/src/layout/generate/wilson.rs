//! Wilson's algorithm: every perfect maze is as likely as any other.

use super::{below, neighbours, rng};
use crate::layout::{Layout, LayoutSizeError};

/// A perfect maze drawn uniformly from all there are of that size, by loop-erased random walks.
///
/// D. B. Wilson, "Generating random spanning trees more quickly than the cover time", STOC 1996. The tree grows from the
/// middle, where a walk finds it soonest; the root has no influence on what is drawn.
pub(super) fn wilson(width: usize, height: usize, seed: u64) -> Result<Layout, LayoutSizeError> {
    let mut layout = Layout::walled(width, height)?;
    let mut rng = rng(seed);
    let n_cells = width * height;
    let mut is_joined = vec![false; n_cells];
    is_joined[height / 2 * width + width / 2] = true;
    // Where the walk last left each cell: following it from the walk's start leaves out every loop.
    let mut left_for = vec![0; n_cells];
    for first in 0..n_cells {
        let mut cell = first;
        while !is_joined[cell] {
            let beside = neighbours(cell, [width, height]);
            let next = loop {
                if let Some(next) = beside[below(&mut rng, 4)] {
                    break next;
                }
            };
            left_for[cell] = next;
            cell = next;
        }
        cell = first;
        while !is_joined[cell] {
            is_joined[cell] = true;
            layout.join(cell, left_for[cell]);
            cell = left_for[cell];
        }
    }
    Ok(layout)
}
