//! The shortest way through a layout.

use super::Layout;
use std::collections::VecDeque;

impl Layout {
    /// A shortest way between two cells, both included, as indices `y * width + x`; `None` when there is none.
    pub fn shortest_way(&self, from: usize, to: usize) -> Option<Vec<usize>> {
        const UNSEEN: usize = usize::MAX;
        let mut before = vec![UNSEEN; self.width * self.height];
        // Searched from the end, so that the way comes out in order.
        *before.get_mut(to)? = to;
        let mut open = VecDeque::from([to]);
        while let Some(cell) = open.pop_front() {
            let (x, y) = (cell % self.width, cell / self.width);
            let beside = [
                self.is_open_east(x, y).then(|| cell + 1),
                (0 < x && self.is_open_east(x - 1, y)).then(|| cell - 1),
                self.is_open_north(x, y).then(|| cell + self.width),
                (0 < y && self.is_open_north(x, y - 1)).then(|| cell - self.width),
            ];
            for next in beside.into_iter().flatten() {
                if before[next] == UNSEEN {
                    before[next] = cell;
                    open.push_back(next);
                }
            }
        }
        let mut way = vec![from];
        let mut cell = from;
        while cell != to {
            cell = before.get(cell).copied().filter(|next| *next != UNSEEN)?;
            way.push(cell);
        }
        Some(way)
    }
}
