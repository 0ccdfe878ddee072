//! The shortest way through a layout.

use super::Layout;
use std::collections::VecDeque;

/// Not reached.
const UNSEEN: usize = usize::MAX;

impl Layout {
    /// The way from start to goal as indices `y * width + x`: of the shortest ways between any two doors the longest one,
    /// without two doors between any two cells. The start is the end that lies higher, the left one when they are level.
    /// `None` when no way joins the doors.
    pub fn solution(&self) -> Option<Vec<usize>> {
        let doors = self.doors().filter_map(|door| door.cell(self.width, self.height));
        let mut ends: Vec<usize> = doors.map(|(x, y)| y * self.width + x).collect();
        if ends.len() < 2 {
            ends.extend(0..self.width * self.height);
        }
        // Two sweeps: the farthest from anywhere is one end of the longest way (exact where ways do not branch and join).
        let farthest_from = |cell: usize| {
            let (_, order) = self.search(cell);
            let mut is_end = vec![false; self.width * self.height];
            ends.iter().for_each(|end| is_end[*end] = true);
            order.into_iter().rfind(|cell| is_end[*cell]).unwrap_or(cell)
        };
        let one = farthest_from(*ends.first()?);
        let other = farthest_from(one);
        let reading_order = |cell: usize| (self.height - cell / self.width, cell % self.width);
        let (from, to) = if reading_order(other) < reading_order(one) { (other, one) } else { (one, other) };
        self.shortest_way(from, to).filter(|way| 1 < way.len())
    }

    /// For each cell the next one on the way to `to`, [`UNSEEN`] where there is none; and the cells in the order of their
    /// distance.
    fn search(&self, to: usize) -> (Vec<usize>, Vec<usize>) {
        let mut next_to = vec![UNSEEN; self.width * self.height];
        next_to[to] = to;
        let (mut open, mut order) = (VecDeque::from([to]), Vec::new());
        while let Some(cell) = open.pop_front() {
            order.push(cell);
            let (x, y) = (cell % self.width, cell / self.width);
            let beside = [
                self.is_open_east(x, y).then(|| cell + 1),
                (0 < x && self.is_open_east(x - 1, y)).then(|| cell - 1),
                self.is_open_north(x, y).then(|| cell + self.width),
                (0 < y && self.is_open_north(x, y - 1)).then(|| cell - self.width),
            ];
            for next in beside.into_iter().flatten() {
                if next_to[next] == UNSEEN {
                    next_to[next] = cell;
                    open.push_back(next);
                }
            }
        }
        (next_to, order)
    }

    /// A shortest way between two cells, both included, as indices `y * width + x`; `None` when there is none.
    pub fn shortest_way(&self, from: usize, to: usize) -> Option<Vec<usize>> {
        let n_cells = self.width * self.height;
        if n_cells <= from || n_cells <= to {
            return None;
        }
        // Searched from the end, so that the way comes out in order.
        let (next_to, _) = self.search(to);
        let mut way = vec![from];
        let mut cell = from;
        while cell != to {
            cell = Some(next_to[cell]).filter(|next| *next != UNSEEN)?;
            way.push(cell);
        }
        Some(way)
    }
}

#[cfg(test)]
mod tests {
    use crate::layout::{Layout, recursive_backtracker};

    #[test]
    fn a_way_goes_from_cell_to_cell_through_passages() {
        let layout = recursive_backtracker(9, 6, 4).unwrap().with_doors_top_and_bottom();
        let way = layout.solution().unwrap();
        assert_eq!((way[0], way[way.len() - 1]), (5 * 9 + 4, 4));
        for pair in way.windows(2) {
            let (low, high) = (pair[0].min(pair[1]), pair[0].max(pair[1]));
            let (x, y) = (low % 9, low / 9);
            let is_open =
                if high - low == 1 { layout.is_open_east(x, y) } else { layout.is_open_north(x, y) };
            assert!(is_open && [1, 9].contains(&(high - low)), "{pair:?}");
        }
        let mut back = layout.shortest_way(way[way.len() - 1], way[0]).unwrap();
        back.reverse();
        assert_eq!(back, way);
    }

    #[test]
    fn without_doors_it_is_the_longest_of_the_shortest() {
        let layout = recursive_backtracker(7, 7, 9).unwrap();
        let n_cells = layout.solution().unwrap().len();
        let ways = (0..49).flat_map(|from| (0..49).map(move |to| (from, to)));
        let lengths = ways.map(|(from, to)| layout.shortest_way(from, to).unwrap().len());
        assert_eq!(Some(n_cells), lengths.max());
    }

    #[test]
    fn where_there_is_no_way_there_is_none() {
        let walled = Layout::walled(3, 1).unwrap();
        assert_eq!(walled.shortest_way(0, 2), None);
        assert_eq!(walled.shortest_way(0, 99), None);
        assert_eq!(walled.solution(), None);
        assert_eq!(walled.with_doors_top_and_bottom().shortest_way(1, 1), Some(vec![1]));
    }
}
