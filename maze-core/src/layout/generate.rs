//! Seeded generators: the same maze for the same seed, everywhere and for ever.

use super::{Layout, LayoutSizeError};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// A perfect maze (one way between any two cells) with long winding corridors, by depth-first search from a corner.
///
/// # Errors
/// See [`Layout::walled`].
pub fn recursive_backtracker(width: usize, height: usize, seed: u64) -> Result<Layout, LayoutSizeError> {
    let mut layout = Layout::walled(width, height)?;
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut visited = vec![false; width * height];
    visited[0] = true;
    let mut trail = vec![0];
    while let Some(&cell) = trail.last() {
        let (x, y) = (cell % width, cell / width);
        let neighbours = [
            (x + 1 < width).then(|| cell + 1),
            (0 < x).then(|| cell - 1),
            (y + 1 < height).then(|| cell + width),
            (0 < y).then(|| cell - width),
        ];
        let mut unvisited = [0; 4];
        let mut n_unvisited = 0;
        for next in neighbours.into_iter().flatten().filter(|next| !visited[*next]) {
            unvisited[n_unvisited] = next;
            n_unvisited += 1;
        }
        if n_unvisited == 0 {
            trail.pop();
            continue;
        }
        let next = unvisited[below(&mut rng, n_unvisited)];
        visited[next] = true;
        layout.join(cell, next);
        trail.push(next);
    }
    Ok(layout)
}

/// A number in `0..bound` (Lemire's multiply-shift; its bias is below 2^-30 for bounds up to 4).
///
/// Written out, because a library's own choice from a range may change between its versions and with it every maze.
#[allow(clippy::cast_possible_truncation, reason = "the product's upper half is below `bound`")]
fn below(rng: &mut impl Rng, bound: usize) -> usize {
    ((u64::from(rng.next_u32()) * bound as u64) >> 32) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    /// FNV-1a over size and passages.
    fn hash(layout: &Layout) -> u64 {
        let sizes = [layout.width as u64, layout.height as u64];
        let passages = layout.east.iter().chain(&layout.north).map(|open| u64::from(*open));
        sizes
            .into_iter()
            .chain(passages)
            .fold(0xcbf2_9ce4_8422_2325, |hash, value| (hash ^ value).wrapping_mul(0x0100_0000_01b3))
    }

    #[test]
    fn every_cell_is_joined_by_exactly_one_way() {
        for (width, height) in [(1, 2), (2, 1), (1, 9), (9, 1), (7, 5), (30, 20)] {
            let layout = recursive_backtracker(width, height, 42).unwrap();
            assert_eq!(layout.n_passages(), width * height - 1, "{width}x{height}");
            let mut reached = vec![false; width * height];
            let mut open = vec![(0, 0)];
            while let Some((x, y)) = open.pop() {
                if std::mem::replace(&mut reached[y * width + x], true) {
                    continue;
                }
                open.extend(layout.is_open_east(x, y).then(|| (x + 1, y)));
                open.extend(layout.is_open_north(x, y).then(|| (x, y + 1)));
                open.extend((0 < x && layout.is_open_east(x - 1, y)).then(|| (x - 1, y)));
                open.extend((0 < y && layout.is_open_north(x, y - 1)).then(|| (x, y - 1)));
            }
            assert!(reached.into_iter().all(|reached| reached), "{width}x{height}");
        }
    }

    #[test]
    fn a_seed_gives_the_same_maze_for_ever() {
        let hashes = [1, 2, 3].map(|seed| hash(&recursive_backtracker(20, 20, seed).unwrap()));
        assert_eq!(
            hashes, PINNED,
            "a seed gives another maze: if intended, update PINNED and say so in CHANGELOG under Behaviour"
        );
    }

    const PINNED: [u64; 3] =
        [4_628_328_809_867_570_934, 15_282_668_417_015_849_356, 17_227_198_759_725_265_064];

    #[test]
    fn impossible_sizes_are_refused() {
        for (width, height) in [(0, 0), (1, 1), (0, 5), (5000, 5000), (usize::MAX, 2)] {
            let error = recursive_backtracker(width, height, 1).unwrap_err();
            assert_eq!(error, LayoutSizeError { width, height });
        }
    }
}
