//! The shortest path from one place to another, and whether it is the only one.

use super::corridors::{CorridorGraph, Step};

/// Paths whose lengths differ by less are equally long (in the unit of the graph: cells, or corridors): far above the rounding
/// of a sum of 2^20 lengths (1e-10), far below anything one can see.
const SAME_LENGTH: f64 = 1.0e-6;

/// Shortest paths are counted up to this number; a bare field of 30 by 30 cells has more.
pub const MOST_COUNTED: u64 = 1_000_000_000_000_000;

/// A shortest path.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    /// Places of the [`CorridorGraph`] from start to goal, both included.
    pub places: Vec<usize>,
    /// In the unit of the places' coordinates.
    pub length: f64,
    /// How many paths are as short, at most [`MOST_COUNTED`]. (All paths that cross no place twice cannot be counted in any
    /// reasonable time: L. G. Valiant, "The complexity of enumeration and reliability problems", 1979.)
    pub n_shortest: u64,
    /// Whether it is the only path of whatever length that crosses no place twice; always so in a perfect maze.
    pub is_unique: bool,
}

impl CorridorGraph {
    /// A shortest path between two places; of several the one that turns right, left, up, down in this order of preference,
    /// seen from the goal. `None` when there is none.
    pub fn solve(&self, start: usize, goal: usize) -> Option<Solution> {
        let distances = self.distances_from(&[start]);
        let length = distances[goal];
        if !length.is_finite() {
            return None;
        }
        let n_shortest = self.count_shortest(goal, &distances);
        let mut places = vec![goal];
        let mut place = goal;
        while let Some(step) = self.steps_back(place, &distances).next() {
            place = step.to;
            places.push(place);
        }
        places.reverse();
        let is_unique = self.is_only_path(&places);
        Some(Solution { places, length, n_shortest, is_unique })
    }

    /// The steps from a place to those before it on a shortest path.
    fn steps_back<'a>(&'a self, place: usize, distances: &'a [f64]) -> impl Iterator<Item = Step> + 'a {
        let here = distances[place];
        self.steps(place).filter(move |step| {
            let before = distances[step.to];
            before < here && (before + step.length - here).abs() < SAME_LENGTH
        })
    }

    fn count_shortest(&self, goal: usize, distances: &[f64]) -> u64 {
        let mut order: Vec<usize> =
            (0..self.len()).filter(|place| distances[*place] <= distances[goal]).collect();
        order.sort_by(|a, b| distances[*a].total_cmp(&distances[*b]));
        let mut counts = vec![0_u64; self.len()];
        for place in order {
            let count = self.steps_back(place, distances).map(|step| counts[step.to]);
            let count = count.fold(0_u64, |sum, count| (sum + count).min(MOST_COUNTED));
            // Only the start has nothing before it.
            counts[place] = if distances[place] == 0.0 { 1 } else { count };
        }
        counts[goal]
    }

    /// A path is the only one when, with its own steps taken out, no two of its places are joined.
    fn is_only_path(&self, places: &[usize]) -> bool {
        let mut position = vec![usize::MAX; self.len()];
        for (n, place) in places.iter().enumerate() {
            position[*place] = n;
        }
        let mut seen = vec![false; self.len()];
        let mut open: Vec<usize> = Vec::new();
        for (n, first) in places.iter().enumerate() {
            let off_the_way = self
                .steps(*first)
                .filter(|step| position[step.to] == usize::MAX || 1 < position[step.to].abs_diff(n));
            open.extend(off_the_way.map(|step| step.to));
            while let Some(place) = open.pop() {
                if position[place] != usize::MAX {
                    return false;
                }
                if std::mem::replace(&mut seen[place], true) {
                    continue;
                }
                let beside = self.steps(place).map(|step| step.to);
                // Back to where this search left the path, or to where it has been.
                open.extend(beside.filter(|next| position[*next] != n && !seen[*next]));
            }
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::layout::{Algorithm, CorridorGraph, Layout, Recipe};

    /// All passages open.
    fn bare_field(width: usize, height: usize) -> CorridorGraph {
        let mut layout = Layout::walled(width, height).unwrap();
        layout.east.fill(true);
        layout.north.fill(true);
        CorridorGraph::of_layout(&layout)
    }

    #[test]
    fn a_perfect_maze_has_one_way() {
        for algorithm in Algorithm::ALL {
            let graph = CorridorGraph::of_layout(&Recipe::new(12, 9, algorithm, 5).layout().unwrap());
            for (start, goal) in [(0, 107), (50, 3), (7, 7)] {
                let solution = graph.solve(start, goal).unwrap();
                assert!(solution.is_unique && solution.n_shortest == 1, "{algorithm}: {solution:?}");
                assert_eq!((solution.places[0], *solution.places.last().unwrap()), (start, goal));
                assert_eq!(solution.length, solution.places.len() as f64 - 1.0);
                for pair in solution.places.windows(2) {
                    assert!(graph.steps(pair[0]).any(|step| step.to == pair[1]), "{algorithm}");
                }
            }
        }
    }

    #[test]
    fn a_bare_field_has_as_many_shortest_ways_as_there_are_orders_of_steps() {
        // 3 steps right and 2 up in any order: 5! / (3! 2!).
        let solution = bare_field(4, 3).solve(0, 11).unwrap();
        assert_eq!((solution.n_shortest, solution.length, solution.is_unique), (10, 5.0, false));
        let solution = bare_field(40, 40).solve(0, 1599).unwrap();
        assert_eq!(solution.n_shortest, MOST_COUNTED);
    }

    #[test]
    fn a_longer_way_around_makes_the_shortest_one_not_the_only_one() {
        // A ring of 2x3 cells: 0 - 1 directly, or all the way around.
        let mut layout = Layout::walled(2, 3).unwrap();
        for (a, b) in [(0, 1), (0, 2), (2, 4), (4, 5), (5, 3), (3, 1)] {
            layout.join(a, b);
        }
        let solution = CorridorGraph::of_layout(&layout).solve(0, 1).unwrap();
        assert_eq!((solution.places, solution.n_shortest, solution.is_unique), (vec![0, 1], 1, false));
        // Halfway around both paths are as long.
        let solution = CorridorGraph::of_layout(&layout).solve(0, 5).unwrap();
        assert_eq!((solution.n_shortest, solution.is_unique), (2, false));
    }

    #[test]
    fn a_ring_off_the_way_leaves_it_the_only_one() {
        // 0 - 1 - 2 below; a ring of four cells above 1 hangs on it by one passage.
        let mut layout = Layout::walled(3, 3).unwrap();
        for (a, b) in [(0, 1), (1, 2), (1, 4), (4, 5), (5, 8), (8, 7), (7, 4)] {
            layout.join(a, b);
        }
        let solution = CorridorGraph::of_layout(&layout).solve(0, 2).unwrap();
        assert!(solution.is_unique && solution.n_shortest == 1);
        assert_eq!(CorridorGraph::of_layout(&layout).solve(0, 3), None, "cell 3 is walled in");
    }
}
