//! Braiding: dead ends opened, so that the maze gets loops.

use super::{below, chance, rng};
use crate::layout::{Layout, neighbours};

/// Opens each dead end, with this probability (0 to 1), to a random one of the neighbours behind its walls.
///
/// With 1 no dead end is left, except in a maze one cell wide, whose ends have nowhere to go.
pub(super) fn braid(layout: &mut Layout, probability: f64, seed: u64) {
    let mut rng = rng(seed);
    // Numbers of their own: the maze beneath is the one that the seed gives without braiding.
    rng.set_stream(1);
    for cell in 0..layout.width() * layout.height() {
        if layout.open_neighbours(cell).count() != 1 || !chance(&mut rng, probability) {
            continue;
        }
        let behind_walls = neighbours(cell, [layout.width, layout.height]).into_iter().flatten();
        let behind_walls: Vec<usize> = behind_walls.filter(|next| !layout.is_joined(cell, *next)).collect();
        if !behind_walls.is_empty() {
            layout.join(cell, behind_walls[below(&mut rng, behind_walls.len())]);
        }
    }
}
