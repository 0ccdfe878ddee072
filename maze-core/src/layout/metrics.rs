//! What a maze is like: numbers about its corridors and its solution.

use super::corridors::{CorridorGraph, Step};
use super::solve::{MOST_COUNTED, Solution};
use crate::physics::numbers::to_f64;
use std::fmt::{Display, Formatter};

/// Numbers about all places that can be reached from the start. Lengths are in the unit of the [`CorridorGraph`]: cells for a layout,
/// corridors for a maze.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Metrics {
    /// Length of the shortest path from start to goal.
    pub solution_length: f64,
    /// Turns on it.
    pub n_turns: usize,
    /// Mean length of its straight stretches.
    pub straightness: f64,
    /// How far the goal is from the start without walls, along x plus along y, over the length of the solution: 1 when
    /// it goes no detour.
    pub directness: f64,
    /// How many paths are as short, at most [`super::MOST_COUNTED`].
    pub n_shortest: u64,
    /// Whether no other path leads to the goal, of whatever length, but for paths that cross themselves.
    pub is_unique: bool,
    /// Places other than start and goal that can be left only the way one has come.
    pub n_dead_ends: usize,
    /// Mean distance back from a dead end to the solution; 0 when there is none.
    pub dead_end_length: f64,
    /// Places where three corridors meet.
    pub n_junctions: usize,
    /// Places where four corridors meet.
    pub n_crossroads: usize,
    /// Independent loops: walls that would have to be added for there to be one path between any two places.
    pub n_loops: usize,
    /// After M. S. McClendon, "The complexity and difficulty of a maze", Bridges 2001, where a hallway's complexity grows with
    /// its length and with how sharply and how soon after each other its turns come, and the difficulty is the logarithm of a
    /// product over the hallways. What is computed here, exactly:
    ///
    /// - complexity of a hallway: its length D times the sum, over its turns, of θ / (π d), where θ is the angle of the turn
    ///   (always π / 2) and 1 / d the mean of 1 / (distance from the turn before) and 1 / (distance to the next turn), with the
    ///   hallway's ends in the place of missing turns, so that it is as complex from either end;
    /// - difficulty: ln(1 + complexity of the solution) + the sum, over all other hallways, of ln(1 + their complexity).
    ///
    /// The other hallways are the stretches, off the solution, between two places where corridors meet or one ends or the
    /// solution passes. 1 is added so that a straight hallway counts nothing. The scale does not matter: twice as
    /// wide a maze is as difficult. Made for mazes without loops; where there are loops, every hallway off the one shortest
    /// path counts as a wrong one, though it may lead to the goal as well.
    pub difficulty: f64,
}

impl Metrics {
    /// `None` when no path leads from start to goal, or when they are the same place.
    pub fn new(graph: &CorridorGraph, start: usize, goal: usize) -> Option<Self> {
        let solution = graph.solve(start, goal).filter(|_| start != goal)?;
        let distances_back = graph.distances_from(&solution.places);
        let reached: Vec<usize> =
            (0..graph.len()).filter(|place| distances_back[*place].is_finite()).collect();
        let mut n_with = [0; 5]; // places by how many steps lead from them
        for place in &reached {
            n_with[graph.n_steps(*place)] += 1;
        }
        let n_links = n_with.iter().enumerate().map(|(n, places)| n * places).sum::<usize>() / 2;
        let is_dead_end = |place: usize| graph.n_steps(place) == 1 && place != start && place != goal;
        let dead_ends: Vec<f64> =
            reached.iter().filter(|place| is_dead_end(**place)).map(|tip| distances_back[*tip]).collect();
        let steps = solution_steps(graph, &solution);
        let n_turns = n_turns(&steps);
        let [a, b] = [graph.point(start), graph.point(goal)];
        Some(Self {
            solution_length: solution.length,
            n_turns,
            straightness: solution.length / (to_f64(n_turns) + 1.0),
            directness: ((b[0] - a[0]).abs() + (b[1] - a[1]).abs()) / solution.length,
            n_shortest: solution.n_shortest,
            is_unique: solution.is_unique,
            n_dead_ends: dead_ends.len(),
            dead_end_length: mean(&dead_ends),
            n_junctions: n_with[3],
            n_crossroads: n_with[4],
            n_loops: n_links + 1 - reached.len(),
            difficulty: difficulty(graph, &solution, &steps, &reached),
        })
    }
}

/// Lines of text: a name and its figures each. Lengths are in the unit of the graph.
impl Display for Metrics {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> std::fmt::Result {
        let shortest_without_walls = self.directness * self.solution_length;
        let uniqueness = match (self.is_unique, self.n_shortest) {
            (true, _) => "the only one".to_owned(),
            (false, 1) => "the only one as short".to_owned(),
            (false, MOST_COUNTED) => format!("one of {MOST_COUNTED} or more as short"),
            (false, n) => format!("one of {n} as short"),
        };
        let Self { solution_length, n_turns, straightness, n_dead_ends, dead_end_length, .. } = self;
        write!(
            formatter,
            "path         {solution_length:.1} long (without walls {shortest_without_walls:.1}), "
        )?;
        writeln!(formatter, "{n_turns} turns, {uniqueness}")?;
        writeln!(formatter, "straightness {straightness:.2} from turn to turn")?;
        match n_dead_ends {
            0 => writeln!(formatter, "dead ends    none")?,
            n => writeln!(formatter, "dead ends    {n}, on average {dead_end_length:.1} off the path")?,
        }
        let Self { n_junctions, n_crossroads, n_loops, difficulty, .. } = self;
        writeln!(formatter, "junctions    {n_junctions}, crossroads {n_crossroads}, loops {n_loops}")?;
        write!(formatter, "difficulty   {difficulty:.1} (after McClendon 2001)")
    }
}

/// 0 for no values.
fn mean(values: &[f64]) -> f64 {
    if values.is_empty() { 0.0 } else { values.iter().sum::<f64>() / to_f64(values.len()) }
}

/// The steps between a solution's places.
fn solution_steps(graph: &CorridorGraph, solution: &Solution) -> Vec<Step> {
    let steps = solution.places.windows(2);
    steps.filter_map(|pair| graph.steps(pair[0]).find(|step| step.to == pair[1])).collect()
}

fn n_turns(steps: &[Step]) -> usize {
    steps.windows(2).filter(|pair| pair[0].direction != pair[1].direction).count()
}

/// Complexity of a hallway, see [`Metrics::difficulty`].
fn complexity(steps: &[Step]) -> f64 {
    let straight = steps.chunk_by(|a, b| a.direction == b.direction);
    let stretches: Vec<f64> = straight.map(|stretch| stretch.iter().map(|step| step.length).sum()).collect();
    let turns = stretches.windows(2).map(|pair| 0.5 * (1.0 / pair[0] + 1.0 / pair[1]) / 2.0);
    // A sum of nothing is -0.
    stretches.iter().sum::<f64>() * (0.0 + turns.sum::<f64>())
}

/// See [`Metrics::difficulty`].
#[allow(
    clippy::disallowed_methods,
    reason = "a score that is shown; nothing that moves depends on its last bit"
)]
fn difficulty(graph: &CorridorGraph, solution: &Solution, steps: &[Step], reached: &[usize]) -> f64 {
    let mut walked = vec![[false; 4]; graph.len()];
    let mut is_end: Vec<bool> = (0..graph.len()).map(|place| graph.n_steps(place) != 2).collect();
    for place in &solution.places {
        is_end[*place] = true;
    }
    for (from, step) in solution.places.iter().zip(steps) {
        walked[*from][step.direction] = true;
        walked[step.to][step.direction ^ 1] = true;
    }
    let mut difficulty = complexity(steps).ln_1p();
    let mut hallway = Vec::new();
    for from in reached.iter().filter(|place| is_end[**place]) {
        for first in graph.steps(*from) {
            if walked[*from][first.direction] {
                continue;
            }
            hallway.clear();
            let (mut place, mut next) = (*from, Some(first));
            while let Some(step) = next {
                walked[place][step.direction] = true;
                walked[step.to][step.direction ^ 1] = true;
                hallway.push(step);
                place = step.to;
                let onwards = graph.steps(place).find(|step| !walked[place][step.direction]);
                next = onwards.filter(|_| !is_end[place]);
            }
            difficulty += complexity(&hallway).ln_1p();
        }
    }
    difficulty
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::layout::Layout;

    /// Cells joined in this order, two at a time.
    fn layout(width: usize, height: usize, passages: &[(usize, usize)]) -> CorridorGraph {
        let mut layout = Layout::walled(width, height).unwrap();
        for (a, b) in passages {
            layout.join(*a, *b);
        }
        CorridorGraph::of_layout(&layout)
    }

    #[test]
    fn a_straight_corridor_is_no_challenge() {
        let metrics = Metrics::new(&layout(4, 1, &[(0, 1), (1, 2), (2, 3)]), 0, 3).unwrap();
        assert_eq!((metrics.solution_length, metrics.n_turns, metrics.straightness), (3.0, 0, 3.0));
        assert_eq!((metrics.directness, metrics.n_shortest, metrics.is_unique), (1.0, 1, true));
        assert_eq!((metrics.n_dead_ends, metrics.dead_end_length, metrics.n_loops), (0, 0.0, 0));
        assert_eq!((metrics.n_junctions, metrics.n_crossroads), (0, 0));
        assert_eq!(metrics.difficulty.to_bits(), 0.0_f64.to_bits(), "0, and not -0");
    }

    #[test]
    fn numbers_of_a_maze_counted_by_hand() {
        // 6 - 7 - 8      The path 0 1 4 3 6 7 8 turns four times; 2 - 5 is a dead end off cell 1, with one turn.
        // |
        // 3 - 4   5
        //     |   |
        // 0 - 1 - 2
        let passages = [(0, 1), (1, 4), (4, 3), (3, 6), (6, 7), (7, 8), (1, 2), (2, 5)];
        let metrics = Metrics::new(&layout(3, 3, &passages), 0, 8).unwrap();
        assert_eq!((metrics.solution_length, metrics.n_turns), (6.0, 4));
        assert_eq!((metrics.straightness, metrics.directness), (6.0 / 5.0, 4.0 / 6.0));
        assert_eq!((metrics.n_dead_ends, metrics.dead_end_length), (1, 2.0));
        assert_eq!((metrics.n_junctions, metrics.n_crossroads, metrics.n_loops), (1, 0, 0));
        // Solution: 6 long in stretches of 1, 1, 1, 1, 2: 6 (3 / 2 + 3 / 8). Dead end: 2 long, in stretches of 1, 1: 2 / 2.
        let expected = 3.198_673_117_550_615; // ln 12.25 + ln 2
        assert!((metrics.difficulty - expected).abs() < 1.0e-12, "{}", metrics.difficulty);
    }

    #[test]
    fn loops_are_counted_and_walked_once() {
        // A bare field of 3x3: 12 passages among 9 cells; all hallways beside the solution are one step long.
        let passages: Vec<(usize, usize)> =
            (0..9).flat_map(|cell| [(cell, cell + 1), (cell, cell + 3)]).collect();
        let passages: Vec<_> =
            passages.into_iter().filter(|(a, b)| *b < 9 && (b - a == 3 || b % 3 != 0)).collect();
        let metrics = Metrics::new(&layout(3, 3, &passages), 0, 8).unwrap();
        assert_eq!((metrics.n_loops, metrics.n_crossroads, metrics.n_junctions), (4, 1, 4));
        assert_eq!((metrics.n_shortest, metrics.is_unique, metrics.n_dead_ends), (6, false, 0));
    }

    #[test]
    fn no_way_and_no_distance_have_no_numbers() {
        let graph = layout(3, 1, &[(0, 1)]);
        assert!(Metrics::new(&graph, 0, 2).is_none() && Metrics::new(&graph, 1, 1).is_none());
    }
}
