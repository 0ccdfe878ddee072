//! The configuration space: where the ball's centre can be (the Minkowski sum of the walls and the ball), and paths through it.
//!
//! The sum is with a square and not with a disc, so a gap that the ball could only take diagonally counts as closed.

use crate::assembly::occupancy::Occupancy;
use crate::layout::{self, CorridorGraph};
use nalgebra::Vector2;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Rectangles of possible centres between all wall coordinates ± the radius.
#[derive(Debug)]
pub(crate) struct ConfigurationSpace {
    xs: Vec<f64>,
    ys: Vec<f64>,
    free: Vec<bool>, // row by row
}

/// Length of the path to every cell (units, from centre to centre); infinite where there is none.
#[derive(Clone, Debug)]
pub(crate) struct Distances(Vec<f64>);

/// Widest cell (units): a corridor, so that the ends of a bare one are cells of their own, and its middle stays whole ...
const MAX_CELL: f64 = 1.0;
/// ... unless the board is so wide that it would take more pieces than this.
const MAX_PIECES: f64 = 512.0;

/// The coordinates with wide gaps split evenly.
fn split(coordinates: &[f64]) -> Vec<f64> {
    let (Some(low), Some(high)) = (coordinates.first(), coordinates.last()) else { return vec![0.0] };
    let extent = high - low;
    let widest = if MAX_CELL * MAX_PIECES < extent { extent / MAX_PIECES } else { MAX_CELL };
    let mut pieces = Vec::with_capacity(coordinates.len());
    for pair in coordinates.windows(2) {
        let mut n_pieces = 1.0;
        while widest * n_pieces < pair[1] - pair[0] {
            n_pieces += 1.0;
        }
        let mut piece = 0.0;
        while piece < n_pieces {
            pieces.push(pair[0] + (pair[1] - pair[0]) * (piece / n_pieces));
            piece += 1.0;
        }
    }
    pieces.extend(coordinates.last());
    pieces
}

impl ConfigurationSpace {
    pub(crate) fn new(plan: &Occupancy, radius: f64) -> Self {
        let grown = |values: &[f64]| {
            let mut grown: Vec<f64> =
                values.iter().flat_map(|value| [value - radius, value + radius]).collect();
            grown.sort_by(f64::total_cmp);
            grown.dedup();
            // The outermost ones lie outside the board; between the others nothing is left when the ball is too large.
            split(grown.get(1..grown.len().saturating_sub(1)).unwrap_or_default())
        };
        let (xs, ys) = (grown(&plan.xs), grown(&plan.ys));
        let n_solid = SolidCounts::new(plan);
        // The plan's cells that a square of that radius around the middle of [low, high] overlaps.
        let covered = |coordinates: &[f64], low: f64, high: f64| {
            let middle = (low + high) / 2.0;
            let first = coordinates.partition_point(|value| *value <= middle - radius);
            let last = coordinates.partition_point(|value| *value < middle + radius);
            (first > 0 && last < coordinates.len()).then(|| (first - 1, last))
        };
        let columns: Vec<_> = xs.windows(2).map(|pair| covered(&plan.xs, pair[0], pair[1])).collect();
        let rows: Vec<_> = ys.windows(2).map(|pair| covered(&plan.ys, pair[0], pair[1])).collect();
        let mut free = Vec::with_capacity(rows.len() * columns.len());
        for row in rows {
            free.extend(columns.iter().map(|column| match (*column, row) {
                (Some(column), Some(row)) => n_solid.within(column, row) == 0,
                _ => false,
            }));
        }
        Self { xs, ys, free }
    }

    fn n_x(&self) -> usize {
        self.xs.len() - 1
    }

    /// The middle of a cell.
    pub(crate) fn middle(&self, cell: usize) -> Vector2<f64> {
        let (i, j) = (cell % self.n_x(), cell / self.n_x());
        Vector2::new((self.xs[i] + self.xs[i + 1]) / 2.0, (self.ys[j] + self.ys[j + 1]) / 2.0)
    }

    /// The free cell that holds a point, border included.
    pub(crate) fn cell_at(&self, point: Vector2<f64>) -> Option<usize> {
        // A point on a border belongs to both sides: take the free one.
        let sides = |values: &[f64], value: f64| {
            let above = values.partition_point(|known| *known < value);
            [above.checked_sub(1), (values.get(above) == Some(&value)).then_some(above)]
        };
        let in_x = sides(&self.xs, point.x).into_iter().flatten().filter(|i| *i < self.n_x());
        in_x.flat_map(|i| {
            let in_y = sides(&self.ys, point.y).into_iter().flatten().filter(|j| *j + 1 < self.ys.len());
            in_y.map(move |j| (i, j))
        })
        .map(|(i, j)| j * self.n_x() + i)
        .find(|cell| self.free[*cell])
    }

    /// The free cell nearest to a point, and the place in it that is; `None` when it is farther away than `within`.
    pub(crate) fn nearest(&self, point: Vector2<f64>, within: f64) -> Option<(usize, Vector2<f64>)> {
        let into = |value: f64, low: f64, high: f64| match value {
            _ if value < low => low,
            _ if high < value => high,
            _ => value,
        };
        let mut nearest: Option<(f64, usize, Vector2<f64>)> = None;
        for (cell, _) in self.free.iter().enumerate().filter(|(_, free)| **free) {
            let (i, j) = (cell % self.n_x(), cell / self.n_x());
            let x = into(point.x, self.xs[i], self.xs[i + 1]);
            let place = Vector2::new(x, into(point.y, self.ys[j], self.ys[j + 1]));
            let distance = (place - point).norm();
            if distance <= within && nearest.is_none_or(|(known, _, _)| distance < known) {
                nearest = Some((distance, cell, place));
            }
        }
        nearest.map(|(_, cell, place)| (cell, place))
    }

    /// The free cells beside a cell.
    pub(crate) fn neighbours(&self, cell: usize) -> impl Iterator<Item = usize> {
        let [right, left, above, below] = layout::neighbours(cell, [self.n_x(), self.ys.len() - 1]);
        [left, right, below, above].into_iter().flatten().filter(|next| self.free[*next])
    }

    /// The corridors that lead from a free cell, and which place of theirs each of these two cells is; `None` when the ball
    /// has room to pass to the side somewhere (four free cells around a corner), so that it is no maze of corridors alone,
    /// and when no path leads from one cell to the other.
    pub(crate) fn corridors(&self, from: usize, to: usize) -> Option<(CorridorGraph, [usize; 2])> {
        let n_x = self.n_x();
        let mut graph = CorridorGraph::default();
        let mut place_of = vec![usize::MAX; self.free.len()];
        let mut cells = vec![from]; // by place
        place_of[from] = 0;
        let mut n_done = 0;
        while let Some(&cell) = cells.get(n_done) {
            graph.push(self.middle(cell).into());
            n_done += 1;
            for next in self.neighbours(cell) {
                if place_of[next] == usize::MAX {
                    place_of[next] = cells.len();
                    cells.push(next);
                }
            }
        }
        for (place, cell) in cells.into_iter().enumerate() {
            // Neighbours of a reached cell are reached.
            let right = Some(cell + 1).filter(|right| right % n_x != 0 && self.free[*right]);
            let above = Some(cell + n_x).filter(|above| self.free.get(*above) == Some(&true));
            if let (Some(right), Some(_)) = (right, above)
                && self.free[right + n_x]
            {
                return None;
            }
            right.inspect(|right| graph.join(place, place_of[*right], 0));
            above.inspect(|above| graph.join(place, place_of[*above], 2));
        }
        let goal = place_of[to];
        (goal != usize::MAX).then_some((graph, [0, goal]))
    }

    /// A cell of the connected region with the largest area; `None` when nothing is free.
    pub(crate) fn largest_region(&self) -> Option<usize> {
        let mut unseen = self.free.clone();
        let mut largest: Option<(f64, usize)> = None; // (area, one of its cells)
        for first in 0..unseen.len() {
            if !unseen[first] {
                continue;
            }
            unseen[first] = false;
            let (mut area, mut open) = (0.0, vec![first]);
            while let Some(cell) = open.pop() {
                area += self.cell_area(cell);
                for next in self.neighbours(cell) {
                    if std::mem::take(&mut unseen[next]) {
                        open.push(next);
                    }
                }
            }
            if largest.is_none_or(|(known, _)| known < area) {
                largest = Some((area, first));
            }
        }
        largest.map(|(_, cell)| cell)
    }

    /// Area of all cells that have a path (units squared).
    pub(crate) fn area(&self, distances: &Distances) -> f64 {
        let reached = distances.0.iter().enumerate().filter(|(_, distance)| distance.is_finite());
        reached.map(|(cell, _)| self.cell_area(cell)).sum()
    }

    fn cell_area(&self, cell: usize) -> f64 {
        let (i, j) = (cell % self.n_x(), cell / self.n_x());
        (self.xs[i + 1] - self.xs[i]) * (self.ys[j + 1] - self.ys[j])
    }

    /// Shortest paths from one free cell to all others (Dijkstra, between the cells' middles).
    pub(crate) fn distances_from(&self, start: usize) -> Distances {
        let mut distances = vec![f64::INFINITY; self.free.len()];
        distances[start] = 0.0;
        // Bits of non-negative floats order as the floats do.
        let mut queue = BinaryHeap::from([Reverse((0.0_f64.to_bits(), start))]);
        while let Some(Reverse((bits, cell))) = queue.pop() {
            if bits != distances[cell].to_bits() {
                continue; // reached earlier by a shorter path
            }
            for next in self.neighbours(cell) {
                let distance = distances[cell] + (self.middle(next) - self.middle(cell)).norm();
                if distance < distances[next] {
                    distances[next] = distance;
                    queue.push(Reverse((distance.to_bits(), next)));
                }
            }
        }
        Distances(distances)
    }
}

impl Distances {
    /// Length of the path to this cell; infinite when there is none.
    pub(crate) fn to(&self, cell: usize) -> f64 {
        self.0[cell]
    }

    /// The farthest cell that has a path, the first one on a tie.
    pub(crate) fn farthest(&self) -> usize {
        let reached = self.0.iter().enumerate().filter(|(_, distance)| distance.is_finite());
        reached.rev().max_by(|a, b| a.1.total_cmp(b.1)).map_or(0, |(cell, _)| cell)
    }
}

/// Prefix sums: how many solid cells lie in a rectangle of the plan, in O(1).
struct SolidCounts {
    sums: Vec<u32>,
    n_x: usize,
}

impl SolidCounts {
    fn new(plan: &Occupancy) -> Self {
        let [n_x, n_y] = plan.n_cells();
        let mut sums = vec![0; (n_x + 1) * (n_y + 1)];
        for j in 0..n_y {
            let mut in_row = 0;
            for i in 0..n_x {
                in_row += u32::from(plan.is_solid(i, j));
                sums[(j + 1) * (n_x + 1) + i + 1] = sums[j * (n_x + 1) + i + 1] + in_row;
            }
        }
        Self { sums, n_x }
    }

    fn within(&self, (left, right): (usize, usize), (low, high): (usize, usize)) -> u32 {
        let at = |i: usize, j: usize| self.sums[j * (self.n_x + 1) + i];
        at(right, high) + at(left, low) - at(left, high) - at(right, low)
    }
}
