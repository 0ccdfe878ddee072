//! The shortest path through a layout.

use super::{CorridorGraph, Layout};

impl Layout {
    /// The path from start to goal as indices `y * width + x`: of the shortest paths between any two doors the longest one,
    /// without two doors between any two cells. The start is the end that lies higher, the left one when they are level.
    /// `None` when no path joins the doors.
    pub fn solution(&self) -> Option<Vec<usize>> {
        let doors = self.doors().filter_map(|door| door.cell(self.width, self.height));
        let mut ends: Vec<usize> = doors.map(|(x, y)| y * self.width + x).collect();
        if ends.len() < 2 {
            ends.extend(0..self.width * self.height);
        }
        let graph = CorridorGraph::of_layout(self);
        // Two sweeps: the farthest from anywhere is one end of the longest path (exact where paths do not branch and join).
        let farthest_from = |cell: usize| {
            let distances = graph.distances_from(&[cell]);
            let reached = ends.iter().copied().filter(|end| distances[*end].is_finite());
            reached.max_by(|a, b| distances[*a].total_cmp(&distances[*b])).unwrap_or(cell)
        };
        let one = farthest_from(*ends.first()?);
        let other = farthest_from(one);
        let reading_order = |cell: usize| (self.height - cell / self.width, cell % self.width);
        let (from, to) = if reading_order(other) < reading_order(one) { (other, one) } else { (one, other) };
        Some(graph.solve(from, to)?.places).filter(|path| 1 < path.len())
    }

    /// A shortest path between two cells, both included, as indices `y * width + x`; `None` when there is none.
    pub fn shortest_path(&self, from: usize, to: usize) -> Option<Vec<usize>> {
        let n_cells = self.width * self.height;
        let known = from < n_cells && to < n_cells;
        known.then(|| CorridorGraph::of_layout(self).solve(from, to))?.map(|solution| solution.places)
    }
}

#[cfg(test)]
mod tests {
    use crate::layout::{Layout, recursive_backtracker};

    #[test]
    fn a_path_goes_from_cell_to_cell_through_passages() {
        let layout = recursive_backtracker(9, 6, 4).unwrap().with_doors_top_and_bottom();
        let path = layout.solution().unwrap();
        assert_eq!((path[0], path[path.len() - 1]), (5 * 9 + 4, 4));
        for pair in path.windows(2) {
            let (low, high) = (pair[0].min(pair[1]), pair[0].max(pair[1]));
            let (x, y) = (low % 9, low / 9);
            let is_open =
                if high - low == 1 { layout.is_open_east(x, y) } else { layout.is_open_north(x, y) };
            assert!(is_open && [1, 9].contains(&(high - low)), "{pair:?}");
        }
        let mut back = layout.shortest_path(path[path.len() - 1], path[0]).unwrap();
        back.reverse();
        assert_eq!(back, path);
    }

    #[test]
    fn without_doors_it_is_the_longest_of_the_shortest() {
        let layout = recursive_backtracker(7, 7, 9).unwrap();
        let n_cells = layout.solution().unwrap().len();
        let graph = (0..49).flat_map(|from| (0..49).map(move |to| (from, to)));
        let lengths = graph.map(|(from, to)| layout.shortest_path(from, to).unwrap().len());
        assert_eq!(Some(n_cells), lengths.max());
    }

    #[test]
    fn where_there_is_no_path_there_is_none() {
        let walled = Layout::walled(3, 1).unwrap();
        assert_eq!(walled.shortest_path(0, 2), None);
        assert_eq!(walled.shortest_path(0, 99), None);
        assert_eq!(walled.solution(), None);
        assert_eq!(walled.with_doors_top_and_bottom().shortest_path(1, 1), Some(vec![1]));
    }
}
