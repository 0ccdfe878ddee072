//! Corridors as a graph: places, and which of them lie side by side.

use super::Layout;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// No place in that direction.
const NONE: u32 = u32::MAX;

/// A maze as places in the plane joined to at most one neighbour to the right, to the left, above and below: the cells of
/// a layout, or the stretches of a corridor that a ball can be in.
#[derive(Clone, Debug, Default)]
pub struct CorridorGraph {
    points: Vec<[f64; 2]>,
    links: Vec<[u32; 4]>, // of each place; direction d leads back by d ^ 1; directions 0 and 1 along x, 2 and 3 along y
}

/// One step from a place to the one beside it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Step {
    /// 0 right, 1 left, 2 up, 3 down.
    pub(super) direction: usize,
    /// The place it leads to.
    pub(super) to: usize,
    pub(super) length: f64,
}

impl CorridorGraph {
    /// A layout's cells, `y * width + x`, one apart.
    #[allow(clippy::cast_precision_loss, reason = "a layout has at most 2^20 cells")]
    pub fn of_layout(layout: &Layout) -> Self {
        let (width, height) = (layout.width(), layout.height());
        let mut graph = Self::default();
        for cell in 0..width * height {
            graph.push([(cell % width) as f64, (cell / width) as f64]);
        }
        for cell in 0..width * height {
            let (x, y) = (cell % width, cell / width);
            if layout.is_open_east(x, y) {
                graph.join(cell, cell + 1, 0);
            }
            if layout.is_open_north(x, y) {
                graph.join(cell, cell + width, 2);
            }
        }
        graph
    }

    /// Adds a place without neighbours.
    pub(crate) fn push(&mut self, point: [f64; 2]) {
        self.points.push(point);
        self.links.push([NONE; 4]);
    }

    /// Joins two places; `direction` leads from the first to the second: 0 for right, 2 for up.
    #[allow(
        clippy::cast_possible_truncation,
        reason = "places are fewer than the cells of a ground plan, 2^25"
    )]
    pub(crate) fn join(&mut self, from: usize, to: usize, direction: usize) {
        self.links[from][direction] = to as u32;
        self.links[to][direction ^ 1] = from as u32;
    }

    /// Number of places.
    pub fn len(&self) -> usize {
        self.points.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// Where a place is.
    pub fn point(&self, place: usize) -> [f64; 2] {
        self.points[place]
    }

    pub(super) fn steps(&self, from: usize) -> impl Iterator<Item = Step> {
        let links = self.links[from].into_iter().enumerate().filter(|(_, to)| *to != NONE);
        links.map(move |(direction, to)| {
            let to = to as usize;
            let [a, b] = [self.points[from], self.points[to]];
            Step { direction, to, length: (b[0] - a[0]).abs() + (b[1] - a[1]).abs() }
        })
    }

    pub(super) fn n_steps(&self, from: usize) -> usize {
        self.links[from].iter().filter(|to| **to != NONE).count()
    }

    /// Length of the shortest path from the nearest of these places to every other one (Dijkstra); infinite where there is
    /// none.
    pub fn distances_from(&self, places: &[usize]) -> Vec<f64> {
        let mut distances = vec![f64::INFINITY; self.len()];
        // Bits of non-negative floats order as the floats do.
        let mut queue = BinaryHeap::new();
        for place in places {
            distances[*place] = 0.0;
            queue.push(Reverse((0.0_f64.to_bits(), *place)));
        }
        while let Some(Reverse((bits, place))) = queue.pop() {
            if bits != distances[place].to_bits() {
                continue; // reached earlier by a shorter path
            }
            for step in self.steps(place) {
                let distance = distances[place] + step.length;
                if distance < distances[step.to] {
                    distances[step.to] = distance;
                    queue.push(Reverse((distance.to_bits(), step.to)));
                }
            }
        }
        distances
    }

    /// The two ends of the longest path: from the first place to the farthest, and from there to the farthest. Exact where
    /// paths do not branch and meet again; the first place on a tie. `None` when there is no place.
    pub fn ends(&self) -> Option<[usize; 2]> {
        let farthest = |from: usize| {
            let distances = self.distances_from(&[from]).into_iter().enumerate();
            let reached = distances.filter(|(_, distance)| distance.is_finite()).rev();
            reached.max_by(|a, b| a.1.total_cmp(&b.1)).map_or(from, |(place, _)| place)
        };
        let one = (!self.is_empty()).then(|| farthest(0))?;
        Some([one, farthest(one)])
    }
}
