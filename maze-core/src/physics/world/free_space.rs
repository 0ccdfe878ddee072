//! The free-space cache: a box around the ball that is known to be empty. Most ticks stay in it, and need no search.

use crate::physics::ball::Ball;
use crate::physics::sorted_planes::{SortedPlanes, WIDENED};
use crate::physics::time_of_impact::Path;
use crate::physics::wall::{Facing, Plane};
use nalgebra::Vector2;

/// How far the box may extend in the direction of motion (radii): as far as a slow ball rolls in some thirty ticks. A larger one
/// lasts longer, and more planes must be visited to make it.
const EXTENT_AHEAD: f64 = 3.0;

/// How far it may extend against the direction of motion (radii), for a ball that turns.
const EXTENT_BEHIND: f64 = 0.25;

/// How far inside of the ends of a face that supports the ball the box ends (radii): large against rounding, so that the corner
/// there is not touched.
const INSET: f64 = 1.0e-3;

/// A stronger acceleration (units/s²) is left to the searched tick, which refuses it when squares leave the range of floats. Below
/// this limit the squares stay finite even at the end of the longest tick.
const MAX_ACCELERATION: f64 = 1.0e140;

/// While the ball's centre is inside this box, the ball touches nothing but its supports, and does not slide off them. A path that stays inside has no
/// impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct FreeSpace {
    low: Vector2<f64>,
    high: Vector2<f64>,
    /// For each axis the sign of the face that supports the ball, 0 for none. The box has zero width on that axis.
    support: Vector2<f64>,
}

impl FreeSpace {
    /// The free space around a ball; `None` when it touches more than its supports.
    pub(super) fn around(
        planes: &SortedPlanes,
        ball: Ball,
        radius: f64,
        supports: &[Option<Plane>; 2],
    ) -> Option<Self> {
        let (reach, centre) = (radius * WIDENED, ball.position);
        let [behind, ahead] = [EXTENT_BEHIND, EXTENT_AHEAD].map(|extent| extent * radius);
        let below = ball.velocity.map(|speed| if speed < 0.0 { ahead } else { behind });
        let above = ball.velocity.map(|speed| if 0.0 < speed { ahead } else { behind });
        let mut free = Self { low: centre - below, high: centre + above, support: Vector2::zeros() };
        for face in supports.iter().flatten() {
            let (axis, along) = (face.facing.axis(), 1 - face.facing.axis());
            free.support[axis] = face.facing.sign();
            (free.low[axis], free.high[axis]) = (centre[axis], centre[axis]);
            free.stay_above(along, face.start + INSET * radius);
            free.stay_below(along, face.end - INSET * radius);
        }
        let ranks = [0, 1].map(|axis| planes.ranks(axis, [free.low[axis] - reach, free.high[axis] + reach]));
        for facing in Facing::ALL {
            let (across, along) = (facing.axis(), 1 - facing.axis());
            let support = supports[across].filter(|face| face.facing == facing);
            for row in planes.rows(facing, planes.rows_at(facing, &ranks[across])) {
                // The box may have shrunk since the rows were chosen.
                if free.high[across] <= row.offset() - reach || row.offset() + reach <= free.low[across] {
                    continue;
                }
                for face in row.at(ranks[along].clone()) {
                    if support.is_none_or(|support| support != face.plane) {
                        free.stay_away(&face.plane, centre, reach)?;
                    }
                }
            }
        }
        free.holds(0, centre.x).then_some(())?;
        free.holds(1, centre.y).then_some(free)
    }

    fn stay_above(&mut self, axis: usize, limit: f64) {
        if self.low[axis] < limit {
            self.low[axis] = limit;
        }
    }

    fn stay_below(&mut self, axis: usize, limit: f64) {
        if limit < self.high[axis] {
            self.high[axis] = limit;
        }
    }

    fn holds(&self, axis: usize, coordinate: f64) -> bool {
        self.low[axis] <= coordinate && coordinate <= self.high[axis]
    }

    /// Shrinks the box so that it lies outside of the plane's reach, on the side that leaves the centre more room; `None` when the centre
    /// itself is within reach.
    fn stay_away(&mut self, plane: &Plane, centre: Vector2<f64>, reach: f64) -> Option<()> {
        let (across, along) = (plane.facing.axis(), 1 - plane.facing.axis());
        let (below, above) = (plane.offset - reach, plane.offset + reach);
        let (before, behind) = (plane.start - reach, plane.end + reach);
        let is_clear = self.high[across] <= below
            || above <= self.low[across]
            || self.high[along] <= before
            || behind <= self.low[along];
        if is_clear {
            return Some(());
        }
        let is_below = centre[across] < plane.offset;
        let is_before = centre[along] < plane.start;
        // How far the centre is from the plane along either axis; `gap` is negative when the centre is alongside the face.
        let away = if is_below { plane.offset - centre[across] } else { centre[across] - plane.offset };
        let gap = if is_before { plane.start - centre[along] } else { centre[along] - plane.end };
        // If one axis alone clears the plane, the box is cut along it; otherwise along both, at the circle around the corner.
        let (ends_across, ends_along) = if reach <= away && gap <= away {
            (Some(reach), None)
        } else if reach <= gap {
            (None, Some(reach))
        } else if 0.0 < gap && reach * reach < away * away + gap * gap {
            let fraction = reach / (away * away + gap * gap).sqrt();
            (Some(away * fraction), Some(gap * fraction))
        } else {
            return None;
        };
        match (ends_across, is_below) {
            (Some(distance), true) => self.stay_below(across, plane.offset - distance),
            (Some(distance), false) => self.stay_above(across, plane.offset + distance),
            (None, _) => {}
        }
        match (ends_along, is_before) {
            (Some(distance), true) => self.stay_below(along, plane.start - distance),
            (Some(distance), false) => self.stay_above(along, plane.end + distance),
            (None, _) => {}
        }
        Some(())
    }

    /// The ball after a time under an acceleration, and its path, if it stays in the box and is pressed onto its supports.
    #[inline(always)] // A call would send the ball through memory, which costs as much as the rest.
    pub(super) fn pass(&self, ball: Ball, acceleration: Vector2<f64>, time_s: f64) -> Option<(Ball, Path)> {
        let is_usual = acceleration.x.abs() + acceleration.y.abs() < MAX_ACCELERATION;
        if !is_usual {
            return None;
        }
        let (x, x_speed) = self.pass_along(0, ball, acceleration.x, time_s)?;
        let (y, y_speed) = self.pass_along(1, ball, acceleration.y, time_s)?;
        let along = |axis: usize| if self.support[axis] == 0.0 { acceleration[axis] } else { 0.0 };
        let path = Path {
            position: ball.position,
            velocity: ball.velocity,
            acceleration: Vector2::new(along(0), along(1)),
        };
        Some((Ball { position: Vector2::new(x, y), velocity: Vector2::new(x_speed, y_speed) }, path))
    }

    /// Coordinate and speed along one axis, computed as [`crate::physics::time_of_impact::Path`] does.
    #[inline(always)] // As above.
    fn pass_along(&self, axis: usize, ball: Ball, acceleration: f64, time_s: f64) -> Option<(f64, f64)> {
        let (from, speed) = (ball.position[axis], ball.velocity[axis]);
        if self.support[axis] != 0.0 {
            return (acceleration * self.support[axis] < 0.0).then_some((from, 0.0));
        }
        let to = from + (speed + acceleration * (time_s / 2.0)) * time_s;
        let end_speed = speed + acceleration * time_s;
        // If the velocity reverses, the end of the motion without acceleration bounds the turning point.
        let stays =
            self.holds(axis, to) && (0.0 <= speed * end_speed || self.holds(axis, from + speed * time_s));
        stays.then_some((to, end_speed))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::sweep::{self, SweepQuery};
    use proptest::prelude::*;

    /// Solid unit cells of a plan of five by five.
    fn faces(solid: &[bool]) -> Vec<Plane> {
        let is_solid =
            |i: usize, j: usize| (1..=5).contains(&i) && (1..=5).contains(&j) && solid[(j - 1) * 5 + i - 1];
        let at = |k: usize| k as f64;
        let mut faces = Vec::new();
        for across in 1..=5 {
            for step in 0..=5 {
                let [offset, start, end] = [step + 1, across, across + 1].map(at);
                let mut face = |before, after, axis: usize| {
                    let [plus, minus] = Facing::across(axis);
                    if before != after {
                        let facing = if before { plus } else { minus };
                        faces.push(Plane { facing, offset, start, end });
                    }
                };
                face(is_solid(step, across), is_solid(step + 1, across), 0);
                face(is_solid(across, step), is_solid(across, step + 1), 1);
            }
        }
        faces
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 5000, failure_persistence: None, ..ProptestConfig::default() })]

        /// What stays in the free space meets nothing, and is where the path leads, to the bit.
        #[test]
        fn a_path_in_free_space_has_no_impact(
            solid in prop::collection::vec(prop::bool::weighted(0.3), 25),
            centre in (1.0..6.0_f64, 1.0..6.0_f64),
            radius in 0.05..0.6_f64,
            velocities in prop::collection::vec((-9.0..9.0_f64, -9.0..9.0_f64), 20),
            acceleration in (-90.0..90.0_f64, -90.0..90.0_f64),
        ) {
            let planes = SortedPlanes::new(faces(&solid)).unwrap();
            let position = Vector2::new(centre.0, centre.1);
            let ball = Ball { position, velocity: Vector2::new(velocities[0].0, velocities[0].1) };
            let Some(free_space) = FreeSpace::around(&planes, ball, radius, &[None; 2]) else { return Ok(()) };
            for (x, y) in velocities {
                let (velocity, acceleration) = (Vector2::new(x, y), Vector2::new(acceleration.0, acceleration.1));
                if let Some((ball, _)) = free_space.pass(Ball { position, velocity }, acceleration, 0.05) {
                    let path = Path { position, velocity, acceleration };
                    prop_assert_eq!(sweep::first_impact_scan(&planes, &SweepQuery { path, radius, until_s: 0.05, left: None }), None);
                    prop_assert_eq!(ball, Ball { position: path.at(0.05), velocity: path.velocity_at(0.05) });
                }
            }
        }
    }

    #[test]
    fn free_space_ends_where_the_ball_would_touch() {
        let room = [(Facing::PlusX, 0.0), (Facing::MinusX, 1.0), (Facing::PlusY, 0.0), (Facing::MinusY, 1.0)];
        let planes =
            SortedPlanes::new(room.map(|(facing, offset)| Plane { facing, offset, start: 0.0, end: 1.0 }))
                .unwrap();
        let centre = Vector2::new(0.5, 0.4);
        let free_space = FreeSpace::around(
            &planes,
            Ball { position: centre, velocity: Vector2::repeat(1.0) },
            0.25,
            &[None; 2],
        )
        .unwrap();
        assert!((free_space.low - Vector2::new(0.4375, 0.3375)).amax() < 1.0e-6);
        assert!((free_space.high - Vector2::repeat(0.75)).amax() < 1.0e-6);
        // Supported by the floor it keeps its height and stays off the walls.
        let floor = planes.planes(Facing::PlusY).next();
        let centre = Vector2::new(0.5, 0.25);
        let free_space = FreeSpace::around(&planes, Ball::at(centre), 0.25, &[None, floor]).unwrap();
        assert_eq!((free_space.low.y, free_space.high.y, free_space.support.y), (0.25, 0.25, 1.0));
        let roll = |acceleration: Vector2<f64>| free_space.pass(Ball::at(centre), acceleration, 0.03);
        assert!(roll(Vector2::new(1.0, -1.0)).is_some_and(|(ball, _)| ball.position.y == 0.25));
        // Lifted off, or rolled into the wall, it needs a search.
        assert_eq!((roll(Vector2::new(1.0, 1.0)), roll(Vector2::new(1000.0, -1.0))), (None, None));
    }
}
