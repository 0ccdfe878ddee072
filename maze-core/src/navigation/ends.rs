//! Where a run starts and where it has to get.

use crate::navigation::space::{ConfigurationSpace, Distances};
use crate::physics::wall::Plane;
use nalgebra::Vector2;
use std::fmt::{Display, Formatter};

/// Most separate regions with openings that are searched for the farthest pair; a maze has one.
const MAX_REGIONS: usize = 16;

/// How far from a requested start or goal the ball may be put (units): where a corridor is several blocks wide, the ball's
/// centre does not get to the middle of the blocks beside a wall.
const MAX_SHIFT: f64 = 0.5;

/// Openings lead into a pocket, and not into the maze, where the longest path between them, or from the only one, is shorter than
/// this (corridors).
const POCKET: f64 = 2.0;

/// Start or goal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Endpoint {
    /// Where a run begins.
    Start,
    /// Where it has to get.
    Goal,
}

impl Endpoint {
    /// Both, in this order.
    pub(crate) const BOTH: [Self; 2] = [Self::Start, Self::Goal];
}

impl Display for Endpoint {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(match self {
            Self::Start => "start",
            Self::Goal => "goal",
        })
    }
}

/// Start and goal.
pub(crate) struct Ends {
    pub(crate) start: Vector2<f64>,
    pub(crate) goal: Vector2<f64>,
    /// Whether a path leads from one to the other.
    pub(crate) is_joined: bool,
}

/// Where start and goal should be (units); what is exact goes before what is near.
pub(crate) struct Requested {
    /// There and nowhere else.
    pub(crate) exact: [Option<Vector2<f64>>; 2],
    /// There, or at the nearest place where the ball fits.
    pub(crate) near: [Option<Vector2<f64>>; 2],
}

/// Why there is no start or no goal.
#[derive(Clone, Copy, Debug)]
pub(crate) enum RouteError {
    /// The ball fits nowhere.
    NoRoom,
    /// The ball does not fit there.
    NotFree(Vector2<f64>),
    /// The ball fits nowhere near where the start or the goal should be.
    NoRoomNear(Endpoint),
}

impl Ends {
    /// Start and goal where they should be, else as [`Ends::choose`] chooses them.
    pub(crate) fn find(
        space: &ConfigurationSpace,
        openings: &[Plane],
        radius: f64,
        requested: &Requested,
    ) -> Result<Self, RouteError> {
        let mut ends: [Option<(usize, Vector2<f64>)>; 2] = [None; 2];
        for end in Endpoint::BOTH {
            let index = end as usize;
            ends[index] = match (requested.exact[index], requested.near[index]) {
                (Some(exact), _) => Some((space.cell_at(exact).ok_or(RouteError::NotFree(exact))?, exact)),
                (None, Some(near)) => {
                    Some(space.nearest(near, MAX_SHIFT).ok_or(RouteError::NoRoomNear(end))?)
                }
                (None, None) => None,
            };
        }
        if let [Some((from, start)), Some((to, goal))] = ends {
            let is_joined = space.distances_from(from).to(to).is_finite();
            return Ok(Self { start, goal, is_joined });
        }
        let chosen = Self::choose(space, openings, radius).ok_or(RouteError::NoRoom)?;
        let Some((cell, given)) = ends[0].or(ends[1]) else { return Ok(chosen) };
        // Of the two that would have been chosen the one farther away becomes the other end.
        let distances = space.distances_from(cell);
        let length = |point: Vector2<f64>| {
            let length = space.cell_at(point).map_or(f64::INFINITY, |cell| distances.to(cell));
            if length.is_finite() { length } else { -1.0 }
        };
        let nearer_goal = length(chosen.goal) < length(chosen.start);
        let other = if nearer_goal { chosen.start } else { chosen.goal };
        let is_joined = 0.0 <= length(other);
        Ok(match ends[0] {
            Some(_) => Self { start: given, goal: other, is_joined },
            None => Self { start: other, goal: given, is_joined },
        })
    }

    /// Two openings of the outer wall, the farthest apart of those joined by a path; with one opening, it is the goal and
    /// the start is as far as can be; without any, the two ends of the longest path. Openings into pockets outside of the maze
    /// are none. `None` when the ball fits nowhere.
    fn choose(space: &ConfigurationSpace, openings: &[Plane], radius: f64) -> Option<Self> {
        let doors: Vec<(Vector2<f64>, usize)> =
            openings.iter().filter_map(|opening| door(space, opening, radius)).collect();
        let main = space.largest_region()?;
        let doors = without_pockets(space, doors, main);
        if let [first, second, ..] = doors[..] {
            return Some(Self::between_doors(space, &doors, [first.0, second.0]));
        }
        let (near_end, goal) = match doors.first() {
            Some(&(door, cell)) => (cell, door),
            None => {
                let end = space.distances_from(main).farthest();
                (end, space.middle(end))
            }
        };
        let far_end = space.middle(space.distances_from(near_end).farthest());
        Some(match doors.is_empty() {
            true => Self::upper_left_first(far_end, goal, true),
            false => Self { start: far_end, goal, is_joined: true },
        })
    }

    fn between_doors(
        space: &ConfigurationSpace,
        doors: &[(Vector2<f64>, usize)],
        unjoined: [Vector2<f64>; 2],
    ) -> Self {
        let mut longest = None;
        let mut seen = vec![false; doors.len()];
        for _ in 0..MAX_REGIONS {
            let Some(first) = seen.iter().position(|seen| !seen) else { break };
            // Two sweeps: the farthest from anywhere is one end of the longest path (exact where paths do not branch).
            // Only one set of distances at a time: they are the largest thing there is.
            let one = {
                let from_first = space.distances_from(doors[first].1);
                for (seen, (_, cell)) in seen.iter_mut().zip(doors) {
                    *seen |= from_first.to(*cell).is_finite();
                }
                farthest_door(&from_first, doors).1
            };
            let (distance, other) = farthest_door(&space.distances_from(doors[one].1), doors);
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
    fn upper_left_first(a: Vector2<f64>, b: Vector2<f64>, is_joined: bool) -> Self {
        let swap = a.y < b.y || (a.y == b.y && b.x < a.x);
        let (start, goal) = if swap { (b, a) } else { (a, b) };
        Self { start, goal, is_joined }
    }
}

/// Where a ball in the middle of an opening touches the frame, and its cell; `None` when it does not fit there.
pub(crate) fn door(
    space: &ConfigurationSpace,
    opening: &Plane,
    radius: f64,
) -> Option<(Vector2<f64>, usize)> {
    let mut door = opening.facing.normal() * radius;
    door[opening.facing.axis()] += opening.offset;
    door[1 - opening.facing.axis()] = (opening.start + opening.end) / 2.0;
    space.cell_at(door).map(|cell| (door, cell))
}

/// The doors that lead into the maze: all when one of them leads into its largest region, but for those into pockets; else those
/// into regions that are no smaller than half of it.
fn without_pockets(
    space: &ConfigurationSpace,
    doors: Vec<(Vector2<f64>, usize)>,
    main: usize,
) -> Vec<(Vector2<f64>, usize)> {
    let from_main = space.distances_from(main);
    let is_main = |cell: usize| from_main.to(cell).is_finite();
    if doors.iter().all(|(_, cell)| is_main(*cell)) {
        return doors;
    }
    let has_main = doors.iter().any(|(_, cell)| is_main(*cell));
    let main_area = space.area(&from_main);
    drop(from_main);
    // Doors of one region are judged together.
    let mut judged: Vec<Option<bool>> = vec![None; doors.len()];
    for _ in 0..MAX_REGIONS {
        let Some(first) = judged.iter().position(Option::is_none) else { break };
        let distances = space.distances_from(doors[first].1);
        let longest = distances.to(distances.farthest());
        let is_large = main_area <= 2.0 * space.area(&distances);
        let leads = is_large || (has_main && POCKET <= longest);
        for (judged, (_, cell)) in judged.iter_mut().zip(&doors) {
            if distances.to(*cell).is_finite() {
                *judged = Some(leads);
            }
        }
    }
    let kept = doors.into_iter().zip(judged).filter(|(_, leads)| leads.unwrap_or(true));
    kept.map(|(door, _)| door).collect()
}

/// Distance and index of the farthest door that has a path, the first one on a tie.
fn farthest_door(distances: &Distances, doors: &[(Vector2<f64>, usize)]) -> (f64, usize) {
    let reached = doors.iter().enumerate().map(|(index, (_, cell))| (distances.to(*cell), index));
    reached
        .filter(|(distance, _)| distance.is_finite())
        .rev()
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .unwrap_or((0.0, 0))
}
