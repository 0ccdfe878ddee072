//! The growing tree: where the maze grows next decides its character.

use super::{below, rng, unvisited_neighbour};
use crate::layout::{Layout, LayoutSizeError};
use std::collections::VecDeque;

/// A perfect maze that grows from its middle, each time from one of its cells that still has a free neighbour:
///
/// - in `elitism` of 100 cases from the oldest cell, so that the paths from the middle are direct and the solution is short
///   (at 100 nothing is left for river to decide);
/// - else in `river` of 100 cases from the newest cell, so that a corridor runs on for as long as it can, and dead ends are
///   few and long;
/// - else from any, with the same probability, so that corridors branch soon, and dead ends are many and short.
///
/// "Elitism" (how short the solution is for the maze's size) and "river" (few long dead ends instead of many short ones) are
/// W. D. Pullen's words (Think Labyrinth: Maze Classification), which mazegenerator.net calls E and R. The two scales run
/// from 0 to 100 as there; what lies between 0 and 100 is our own.
pub(super) fn growing_tree(
    width: usize,
    height: usize,
    seed: u64,
    elitism: u8,
    river: u8,
) -> Result<Layout, LayoutSizeError> {
    let mut layout = Layout::walled(width, height)?;
    let mut rng = rng(seed);
    let mut visited = vec![false; width * height];
    let first = height / 2 * width + width / 2;
    visited[first] = true;
    // Three orders of the same cells. A cell without a free neighbour leaves each of them when it is drawn there, so the
    // first order to be empty means that no cell has one.
    let (mut by_age, mut trail, mut bag) = (VecDeque::from([first]), vec![first], vec![first]);
    loop {
        let from_oldest = below(&mut rng, 100) < usize::from(elitism);
        let from_newest = !from_oldest && below(&mut rng, 100) < usize::from(river);
        let in_bag = if from_oldest || from_newest { 0 } else { below(&mut rng, bag.len()) };
        let drawn = match (from_oldest, from_newest) {
            (true, _) => by_age.front(),
            (false, true) => trail.last(),
            (false, false) => bag.get(in_bag),
        };
        let Some(&cell) = drawn else { return Ok(layout) };
        if let Some(next) = unvisited_neighbour(&layout, cell, &visited, &mut rng) {
            visited[next] = true;
            layout.join(cell, next);
            by_age.push_back(next);
            trail.push(next);
            bag.push(next);
        } else if from_oldest {
            by_age.pop_front();
        } else if from_newest {
            trail.pop();
        } else {
            bag.swap_remove(in_bag);
        }
    }
}
