//! Where a ball is free: most ticks touch nothing, and then nothing needs to be searched.

use crate::physics::ball::Ball;
use crate::physics::sorted_planes::{SortedPlanes, WIDENED};
use crate::physics::time_of_impact::Path;
use crate::physics::wall::{Facing, Plane};
use nalgebra::Vector2;

/// How far a clearing may extend where the ball is heading (radii): as far as a slow ball rolls in some thirty ticks. A
/// larger one lasts longer but has more planes to be kept away from.
const AHEAD: f64 = 3.0;

/// How far it may extend on the other side (radii), for a ball that turns.
const BEHIND: f64 = 0.25;

/// How far inside of the ends of a face that carries the ball a clearing ends (radii): large against rounding, so that the
/// corner there is not touched.
const INSET: f64 = 1.0e-3;

/// A pull from here on (units/s²) is the searched tick's to refuse, which it does when squares leave the range of floats;
/// below it, not even those of where it would lead in the longest tick do.
const STRONGEST: f64 = 1.0e140;

/// A box that a ball's centre can be anywhere in without touching anything, and without sliding off what carries it.
///
/// It tells nothing that a search would not: a path that stays inside has no impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Clearing {
    low: Vector2<f64>,
    high: Vector2<f64>,
    /// For each axis the sign of the face that carries the ball, 0 for none. The box has no extent there.
    carried: Vector2<f64>,
}

impl Clearing {
    /// What is free around a ball; `None` when it touches more than what carries it.
    pub(super) fn around(
        planes: &SortedPlanes,
        ball: Ball,
        radius: f64,
        carriers: &[Option<Plane>; 2],
    ) -> Option<Self> {
        let (reach, centre) = (radius * WIDENED, ball.position);
        let [behind, ahead] = [BEHIND, AHEAD].map(|extent| extent * radius);
        let below = ball.velocity.map(|speed| if speed < 0.0 { ahead } else { behind });
        let above = ball.velocity.map(|speed| if 0.0 < speed { ahead } else { behind });
        let mut free = Self { low: centre - below, high: centre + above, carried: Vector2::zeros() };
        for face in carriers.iter().flatten() {
            let (axis, along) = (face.facing.axis(), 1 - face.facing.axis());
            free.carried[axis] = face.facing.sign();
            (free.low[axis], free.high[axis]) = (centre[axis], centre[axis]);
            free.stay_above(along, face.start + INSET * radius);
            free.stay_below(along, face.end - INSET * radius);
        }
        let ranks = [0, 1].map(|axis| planes.ranks(axis, [free.low[axis] - reach, free.high[axis] + reach]));
        for facing in Facing::ALL {
            let (across, along) = (facing.axis(), 1 - facing.axis());
            let carrier = carriers[across].filter(|carrier| carrier.facing == facing);
            for row in planes.rows(facing, planes.rows_at(facing, &ranks[across])) {
                // Planes met before have made the box smaller.
                if free.high[across] <= row.offset() - reach || row.offset() + reach <= free.low[across] {
                    continue;
                }
                for face in row.at(ranks[along].clone()) {
                    if carrier.is_none_or(|carrier| carrier != face.plane) {
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

    /// Takes away what is within reach of a plane, on the side that leaves the centre more room; `None` when the centre is.
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
        // How far the centre is from the plane along either axis; negative where it is beside it.
        let away = if is_below { plane.offset - centre[across] } else { centre[across] - plane.offset };
        let gap = if is_before { plane.start - centre[along] } else { centre[along] - plane.end };
        // Beyond reach along one axis, the box ends where the reach does; else both end on the circle around the corner.
        let (ends_across, ends_along) = match () {
            () if reach <= away && gap <= away => (Some(reach), None),
            () if reach <= gap => (None, Some(reach)),
            () if 0.0 < gap && reach * reach < away * away + gap * gap => {
                let part = reach / (away * away + gap * gap).sqrt();
                (Some(away * part), Some(gap * part))
            }
            () => return None,
        };
        if let Some(distance) = ends_across {
            match is_below {
                true => self.stay_below(across, plane.offset - distance),
                false => self.stay_above(across, plane.offset + distance),
            }
        }
        if let Some(distance) = ends_along {
            match is_before {
                true => self.stay_below(along, plane.start - distance),
                false => self.stay_above(along, plane.end + distance),
            }
        }
        Some(())
    }

    /// The ball after a time under an acceleration, and its path, if it stays in the clearing and is pressed onto what carries it.
    #[inline(always)] // A call would send the ball through memory, which costs as much as the rest.
    pub(super) fn pass(&self, ball: Ball, acceleration: Vector2<f64>, time_s: f64) -> Option<(Ball, Path)> {
        let is_usual = acceleration.x.abs() + acceleration.y.abs() < STRONGEST;
        if !is_usual {
            return None;
        }
        let (x, x_speed) = self.pass_along(0, ball, acceleration.x, time_s)?;
        let (y, y_speed) = self.pass_along(1, ball, acceleration.y, time_s)?;
        let along = |axis: usize| if self.carried[axis] == 0.0 { acceleration[axis] } else { 0.0 };
        let path = Path {
            position: ball.position,
            velocity: ball.velocity,
            acceleration: Vector2::new(along(0), along(1)),
        };
        Some((Ball { position: Vector2::new(x, y), velocity: Vector2::new(x_speed, y_speed) }, path))
    }

    /// Coordinate and speed along one axis, computed as [`crate::physics::time_of_impact::Path`] does.
    #[inline(always)] // As above.
    fn pass_along(&self, axis: usize, ball: Ball, pull: f64, time_s: f64) -> Option<(f64, f64)> {
        let (from, speed) = (ball.position[axis], ball.velocity[axis]);
        if self.carried[axis] != 0.0 {
            return (pull * self.carried[axis] < 0.0).then_some((from, 0.0));
        }
        let to = from + (speed + pull * (time_s / 2.0)) * time_s;
        let end_speed = speed + pull * time_s;
        // Where it turns, it goes no farther than it would have gone at its first speed.
        let stays =
            self.holds(axis, to) && (0.0 <= speed * end_speed || self.holds(axis, from + speed * time_s));
        stays.then_some((to, end_speed))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::time_of_impact;
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

        /// What stays in a clearing meets nothing, and is where the path leads, to the bit.
        #[test]
        fn a_path_in_a_clearing_has_no_impact(
            solid in prop::collection::vec(prop::bool::weighted(0.3), 25),
            centre in (1.0..6.0_f64, 1.0..6.0_f64),
            radius in 0.05..0.6_f64,
            velocities in prop::collection::vec((-9.0..9.0_f64, -9.0..9.0_f64), 20),
            pull in (-90.0..90.0_f64, -90.0..90.0_f64),
        ) {
            let planes = SortedPlanes::new(faces(&solid)).unwrap();
            let position = Vector2::new(centre.0, centre.1);
            let ball = Ball { position, velocity: Vector2::new(velocities[0].0, velocities[0].1) };
            let Some(clearing) = Clearing::around(&planes, ball, radius, &[None; 2]) else { return Ok(()) };
            for (x, y) in velocities {
                let (velocity, acceleration) = (Vector2::new(x, y), Vector2::new(pull.0, pull.1));
                if let Some((ball, _)) = clearing.pass(Ball { position, velocity }, acceleration, 0.05) {
                    let path = Path { position, velocity, acceleration };
                    prop_assert_eq!(time_of_impact::first_scan(&planes, &path, radius, 0.05, None), None);
                    prop_assert_eq!(ball, Ball { position: path.at(0.05), velocity: path.velocity_at(0.05) });
                }
            }
        }
    }

    #[test]
    fn a_clearing_ends_where_the_ball_would_touch() {
        let room = [(Facing::PlusX, 0.0), (Facing::MinusX, 1.0), (Facing::PlusY, 0.0), (Facing::MinusY, 1.0)];
        let planes =
            SortedPlanes::new(room.map(|(facing, offset)| Plane { facing, offset, start: 0.0, end: 1.0 }))
                .unwrap();
        let centre = Vector2::new(0.5, 0.4);
        let clearing = Clearing::around(
            &planes,
            Ball { position: centre, velocity: Vector2::repeat(1.0) },
            0.25,
            &[None; 2],
        )
        .unwrap();
        assert!((clearing.low - Vector2::new(0.4375, 0.3375)).amax() < 1.0e-6);
        assert!((clearing.high - Vector2::repeat(0.75)).amax() < 1.0e-6);
        // Carried by the floor it keeps its height and stays off the walls.
        let floor = planes.planes(Facing::PlusY).next();
        let centre = Vector2::new(0.5, 0.25);
        let clearing = Clearing::around(&planes, Ball::at(centre), 0.25, &[None, floor]).unwrap();
        assert_eq!((clearing.low.y, clearing.high.y, clearing.carried.y), (0.25, 0.25, 1.0));
        let roll = |pull: Vector2<f64>| clearing.pass(Ball::at(centre), pull, 0.03);
        assert!(roll(Vector2::new(1.0, -1.0)).is_some_and(|(ball, _)| ball.position.y == 0.25));
        // Let go, or rolled into the wall, it is the search's again.
        assert_eq!((roll(Vector2::new(1.0, 1.0)), roll(Vector2::new(1000.0, -1.0))), (None, None));
    }
}
