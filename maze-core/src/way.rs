//! Where a run starts and where it has to get.

use crate::plane::Plane;
use crate::reach::{Distances, Reach};
use nalgebra::Vector2;

/// Most separate regions with openings that are searched for the farthest pair; a maze has one.
const MAX_REGIONS: usize = 16;

/// Start and goal.
pub(crate) struct Way {
    pub(crate) start: Vector2<f64>,
    pub(crate) goal: Vector2<f64>,
    pub(crate) solvable: bool,
}

impl Way {
    /// Two openings of the outer wall, the farthest apart of those joined by a way; with one opening, it is the goal and
    /// the start is as far as can be; without any, the two ends of the longest way. `None` when the ball fits nowhere.
    pub(crate) fn choose(reach: &Reach, openings: &[Plane], radius: f64) -> Option<Self> {
        let doors: Vec<(Vector2<f64>, usize)> = openings
            .iter()
            .filter_map(|opening| {
                let mut door = opening.facing.normal() * radius;
                door[opening.facing.axis()] += opening.offset;
                door[1 - opening.facing.axis()] = (opening.start + opening.end) / 2.0;
                reach.cell_at(door).map(|cell| (door, cell))
            })
            .collect();
        if let [first, second, ..] = doors[..] {
            return Some(Self::between_doors(reach, &doors, [first.0, second.0]));
        }
        let (near_end, goal) = match doors.first() {
            Some(&(door, cell)) => (cell, door),
            None => {
                let any = reach.largest_region()?;
                let end = reach.distances_from(any).farthest();
                (end, reach.middle(end))
            }
        };
        let far_end = reach.middle(reach.distances_from(near_end).farthest());
        Some(match doors.is_empty() {
            true => Self::upper_left_first(far_end, goal, true),
            false => Self { start: far_end, goal, solvable: true },
        })
    }

    /// The way with an end moved to where the user wants it. `None` when the ball does not fit there: the place.
    pub(crate) fn moved(
        self,
        reach: &Reach,
        start: Option<Vector2<f64>>,
        goal: Option<Vector2<f64>>,
    ) -> Result<Self, Vector2<f64>> {
        if start.is_none() && goal.is_none() {
            return Ok(self);
        }
        let (start, goal) = (start.unwrap_or(self.start), goal.unwrap_or(self.goal));
        let cell = |point: Vector2<f64>| reach.cell_at(point).ok_or(point);
        let (from, to) = (cell(start)?, cell(goal)?);
        let solvable = reach.distances_from(from).to(to).is_finite();
        Ok(Self { start, goal, solvable })
    }

    fn between_doors(reach: &Reach, doors: &[(Vector2<f64>, usize)], unjoined: [Vector2<f64>; 2]) -> Self {
        let mut longest = None;
        let mut seen = vec![false; doors.len()];
        for _ in 0..MAX_REGIONS {
            let Some(first) = seen.iter().position(|seen| !seen) else { break };
            // Two sweeps: the farthest from anywhere is one end of the longest way (exact where ways do not branch).
            // Only one set of distances at a time: they are the largest thing there is.
            let one = {
                let from_first = reach.distances_from(doors[first].1);
                for (seen, (_, cell)) in seen.iter_mut().zip(doors) {
                    *seen |= from_first.to(*cell).is_finite();
                }
                farthest_door(&from_first, doors).1
            };
            let (distance, other) = farthest_door(&reach.distances_from(doors[one].1), doors);
            if one != other && longest.is_none_or(|(known, _, _)| known < distance) {
                longest = Some((distance, doors[one].0, doors[other].0));
            }
        }
        match longest {
            Some((_, from, to)) => Self::upper_left_first(from, to, true),
            None => Self::upper_left_first(unjoined[0], unjoined[1], false),
        }
    }

    /// Reading order: the higher one is the start, the left one when they are level.
    fn upper_left_first(a: Vector2<f64>, b: Vector2<f64>, solvable: bool) -> Self {
        let swap = a.y < b.y || (a.y == b.y && b.x < a.x);
        let (start, goal) = if swap { (b, a) } else { (a, b) };
        Self { start, goal, solvable }
    }
}

/// Distance and index of the farthest door that has a way, the first one on a tie.
fn farthest_door(distances: &Distances, doors: &[(Vector2<f64>, usize)]) -> (f64, usize) {
    let reached = doors.iter().enumerate().map(|(index, (_, cell))| (distances.to(*cell), index));
    reached
        .filter(|(distance, _)| distance.is_finite())
        .rev()
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .unwrap_or((0.0, 0))
}
