//! The tilt that mouse and keys ask for, held under its limit.

use crate::settings::{Controls, Curve};
use maze_core::Tilt;
use nalgebra::Vector2;

/// How fast held keys tip the board, and how fast it returns when they are released, as half-angle tangents a second:
/// 0.5 is about 57 degrees a second, so the limit of 20 degrees is reached in a third of a second.
const KEY_RATE_PER_S: f64 = 0.5;

/// A key counts as held for at least this long, so that a tap between two ticks is still felt.
const TAP_S: f64 = 0.1;

/// What of that rate a key begins with, and after how long it has all of it (s): a tap tips a little, a held key more.
const FIRST_RATE: f64 = 0.4;
const FULL_RATE_AFTER_S: f64 = 0.3;

/// A drag or a key may ask for this many times the limit, where 98.5 % of it are given; more is forgotten.
const MAX_EXCESS: f64 = 2.0;

/// Where a key tips the board: the side that goes down.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Direction {
    Left,
    Right,
    Away,
    Towards,
}

impl Direction {
    const ALL: [Self; 4] = [Self::Left, Self::Right, Self::Away, Self::Towards];

    fn downhill(self) -> Vector2<f64> {
        match self {
            Self::Left => -Vector2::x(),
            Self::Right => Vector2::x(),
            Self::Away => Vector2::y(),
            Self::Towards => -Vector2::y(),
        }
    }
}

/// Half-angle tangents (towards +x, towards +y) that are requested; the result stays under the limit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TiltControl {
    asked: Vector2<f64>,
    limit: f64,
    is_dragged: bool,
    held: [bool; 4],
    tapped_left_s: [f64; 4],
    /// How long any key has tipped the board.
    held_s: f64,
    /// Whether keys moved the board last: then it returns to level when they are released.
    keys_lead: bool,
    tuning: Tuning,
}

/// What the player has chosen of it.
#[derive(Clone, Copy, Debug)]
struct Tuning {
    /// Of the mouse along x and y; negative where an axis is inverted.
    drag: Vector2<f64>,
    /// Power of the response.
    power: f64,
    keys: f64,
}

impl TiltControl {
    /// `max_tilt_rad` must lie between 0 and a right angle.
    pub(crate) fn new(max_tilt_rad: f64) -> Self {
        Self {
            asked: Vector2::zeros(),
            limit: (max_tilt_rad / 2.0).tan(),
            is_dragged: false,
            held: [false; 4],
            tapped_left_s: [0.0; 4],
            held_s: 0.0,
            keys_lead: false,
            tuning: Tuning { drag: Vector2::new(1.0, 1.0), power: 1.0, keys: 1.0 },
        }
    }

    pub(crate) fn tune(&mut self, controls: &Controls) {
        let sign = |is_inverted: bool| if is_inverted { -1.0 } else { 1.0 };
        let drag = Vector2::new(sign(controls.invert_x), sign(controls.invert_y)) * controls.sensitivity;
        let power = match controls.curve {
            Curve::Linear => 1.0,
            Curve::Gentle => 1.5,
            Curve::Finest => 2.0,
        };
        self.tuning = Tuning { drag, power, keys: controls.key_speed };
    }

    /// The tilt to simulate and to draw.
    pub(crate) fn tilt(&self) -> Tilt {
        let given = soft_limited(self.asked, self.limit);
        let given = match self.keys_lead || self.tuning.power == 1.0 {
            true => given,
            false => given * (given.norm() / self.limit).powf(self.tuning.power - 1.0),
        };
        Tilt::from_half_tangents(given.x, given.y)
    }

    /// Whether the mouse holds the board: then it is drawn where it is held, not interpolated.
    pub(crate) fn is_dragged(&self) -> bool {
        self.is_dragged
    }

    /// The board lies flat; a drag in progress ends, keys that are held go on.
    pub(crate) fn level(&mut self) {
        self.asked = Vector2::zeros();
        self.is_dragged = false;
        self.keys_lead = self.held.contains(&true);
        self.tapped_left_s = [0.0; 4];
    }

    /// The mouse takes hold of the board.
    pub(crate) fn begin_drag(&mut self) {
        self.keys_lead = false;
        self.is_dragged = true;
    }

    /// The mouse has moved, by so much in half-angle tangents; does nothing without a drag.
    pub(crate) fn drag_by(&mut self, tangents: Vector2<f64>) {
        if !self.is_dragged {
            return;
        }
        let step = tangents.component_mul(&self.tuning.drag);
        let is_back = step.dot(&self.asked) < 0.0;
        let asked = match is_back && self.limit < self.asked.norm() {
            // Beyond the limit the board follows little; on the way back it follows at once.
            true => asked_for(soft_limited(self.asked, self.limit) + step, self.limit),
            false => self.asked + step,
        };
        self.asked = capped(asked, MAX_EXCESS * self.limit);
    }

    pub(crate) fn end_drag(&mut self) {
        self.is_dragged = false;
    }

    /// A tilt key went down.
    pub(crate) fn tap(&mut self, direction: Direction) {
        self.tapped_left_s[direction as usize] = TAP_S;
        self.keys_lead = true;
    }

    /// The directions whose keys are down, all of them.
    pub(crate) fn hold(&mut self, directions: impl Iterator<Item = Direction>) {
        self.held = [false; 4];
        directions.for_each(|direction| self.held[direction as usize] = true);
    }

    /// The window lost mouse and keyboard.
    pub(crate) fn release_all(&mut self) {
        self.held = [false; 4];
        self.is_dragged = false;
    }

    /// Moves the board by what keys ask for in one tick.
    pub(crate) fn tick(&mut self, tick_s: f64) {
        let mut wanted = Vector2::zeros();
        for direction in Direction::ALL {
            let left_s = &mut self.tapped_left_s[direction as usize];
            if self.held[direction as usize] || 0.0 < *left_s {
                wanted += direction.downhill();
            }
            *left_s = (*left_s - tick_s).max(0.0);
        }
        if !self.keys_lead || self.is_dragged {
            return;
        }
        // Opposite keys cancel; two neighbours tip diagonally, no further than one.
        let wanted = wanted.try_normalize(0.0).unwrap_or_default() * (MAX_EXCESS * self.limit);
        let direction = wanted - self.asked;
        self.held_s = if wanted == Vector2::zeros() { 0.0 } else { self.held_s + tick_s };
        let grown = (self.held_s / FULL_RATE_AFTER_S).min(1.0);
        let rate = if self.held_s == 0.0 { 1.0 } else { FIRST_RATE + (1.0 - FIRST_RATE) * grown };
        self.asked += capped(direction, KEY_RATE_PER_S * self.tuning.keys * rate * tick_s);
    }
}

/// The vector, shortened to at most `longest`.
fn capped(vector: Vector2<f64>, longest: f64) -> Vector2<f64> {
    let length = vector.norm();
    if length <= longest { vector } else { vector * (longest / length) }
}

/// `limit` must be greater than 0. Nearly the identity up to 2/3 of the limit, then smoothly up to it: t / (1 + (t / L)^4)^(1/4).
fn soft_limited(asked: Vector2<f64>, limit: f64) -> Vector2<f64> {
    let excess = asked.norm_squared() / (limit * limit);
    asked / (1.0 + excess * excess).sqrt().sqrt()
}

/// What [`soft_limited`] makes this of; only a little longer than the limit where there is no such vector.
fn asked_for(given: Vector2<f64>, limit: f64) -> Vector2<f64> {
    let given = capped(given, 0.99 * limit);
    let excess = given.norm_squared() / (limit * limit);
    given / (1.0 - excess * excess).sqrt().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::drag_tangents;
    use maze_core::gravity;
    use proptest::prelude::*;

    const LIMIT_RAD: f64 = 0.349;
    const TICK_S: f64 = 0.03;
    const SIZE: [u32; 2] = [1280, 720];

    fn angle(control: &TiltControl) -> f64 {
        control.tilt().world_from_maze().angle()
    }

    /// Degrees towards +x and towards +y.
    fn degrees(control: &TiltControl) -> [f64; 2] {
        let given = soft_limited(control.asked, control.limit);
        [given.x, given.y].map(|tangent| 2.0 * tangent.atan().to_degrees())
    }

    fn held(directions: &[Direction]) -> TiltControl {
        let mut control = TiltControl::new(LIMIT_RAD);
        directions.iter().for_each(|direction| control.tap(*direction));
        control.hold(directions.iter().copied());
        (0..40).for_each(|_| control.tick(TICK_S));
        control
    }

    #[test]
    fn dragging_to_the_right_runs_the_ball_to_the_right() {
        let mut control = TiltControl::new(LIMIT_RAD);
        control.drag_by(Vector2::x());
        assert_eq!(control.tilt(), Tilt::LEVEL, "nobody holds it");
        control.begin_drag();
        assert_eq!(control.tilt(), Tilt::LEVEL, "a drag begins where the board is");
        control.drag_by(drag_tangents(SIZE, [640.0, 360.0], [640.0 + 36.7, 360.0]));
        let p = gravity::project(gravity::WORLD_GRAVITY, &control.tilt().world_from_maze());
        assert!(0.5 < p.x && p.y.abs() < 1.0e-3, "{p}");
        assert!((angle(&control) - 0.1).abs() < 2.0e-3, "twice the arc: {}", angle(&control));
    }

    #[test]
    fn i4_a_far_drag_keeps_its_direction_and_the_limit() {
        for stops in [&[500.0, 800.0, 1100.0, 1270.0][..], &[1270.0], &[5000.0]] {
            let mut control = TiltControl::new(20_f64.to_radians());
            control.begin_drag();
            let mut at = [100.0, 360.0];
            for x in stops {
                control.drag_by(drag_tangents(SIZE, at, [*x, 360.0]));
                at = [*x, 360.0];
                let [right, away] = degrees(&control);
                assert!((right - 19.7).abs() < 0.1 && away == 0.0, "at {x}: {right}, {away}");
            }
        }
    }

    #[test]
    fn dragging_back_from_the_limit_answers_at_once() {
        let mut control = TiltControl::new(LIMIT_RAD);
        control.begin_drag();
        control.drag_by(Vector2::new(50.0, 0.0));
        let before = angle(&control);
        assert!(0.98 * LIMIT_RAD < before && before < LIMIT_RAD);
        control.drag_by(Vector2::new(-0.01, 0.0));
        assert!(angle(&control) < before);
        control.drag_by(Vector2::new(-2.0 * MAX_EXCESS * control.limit, 0.0));
        assert!(control.tilt().towards_x < 0);
    }

    proptest! {
        /// Whatever the window, the place, the direction, the board's tilt before, and the events that a drag comes in.
        #[test]
        fn i4_straight_drags_are_monotone_continuous_and_limited(
            size in [1_u32..4000, 1_u32..4000],
            from in [-5000.0..5000.0, -5000.0..5000.0],
            direction_rad in -4.0..4.0_f64,
            steps in prop::collection::vec(0.0..300.0, 1..40),
            before in [-9.0..9.0, -9.0..9.0],
            limit_degrees in 1.0..45.0_f64,
        ) {
            let mut control = TiltControl::new(limit_degrees.to_radians());
            control.begin_drag();
            control.drag_by(Vector2::new(before[0], before[1]));
            let direction = Vector2::new(direction_rad.cos(), direction_rad.sin());
            let (mut at, mut last) = (Vector2::new(from[0], from[1]), soft_limited(control.asked, control.limit));
            for step in steps {
                let to: Vector2<f64> = at + step * Vector2::new(direction.x, -direction.y);
                let tangents = drag_tangents(size, at.into(), to.into());
                control.drag_by(tangents);
                at = to;
                let now = soft_limited(control.asked, control.limit);
                let rounding = 1.0e-12 * (1.0 + at.norm());
                prop_assert!(last.dot(&direction) <= now.dot(&direction) + rounding, "{last} to {now}");
                prop_assert!(now.norm() < control.limit);
                prop_assert!((now - last).norm() <= tangents.norm() + rounding, "no leap");
                let twist = control.tilt().world_from_maze().k;
                prop_assert!(twist.abs() < 1.0e-12);
                last = now;
            }
        }

        /// A drag that closes on itself undoes itself, as long as it stays below the largest request.
        #[test]
        fn i4_a_closed_drag_undoes_itself(points in prop::collection::vec([0.0..180.0, 0.0..180.0], 1..20)) {
            let mut control = TiltControl::new(LIMIT_RAD);
            control.begin_drag();
            let points: Vec<[f64; 2]> = [&[[90.0; 2]][..], &points[..], &[[90.0; 2]][..]].concat();
            points.windows(2).for_each(|pair| control.drag_by(drag_tangents(SIZE, pair[0], pair[1])));
            prop_assert!(control.asked.norm() < 1.0e-12);
        }
    }

    #[test]
    fn a_key_tips_while_it_is_held_and_the_board_comes_back() {
        let mut control = held(&[Direction::Away]);
        assert!(0.95 * LIMIT_RAD < angle(&control) && angle(&control) < LIMIT_RAD);
        assert!(0 < control.tilt().towards_y && control.tilt().towards_x == 0);
        control.hold([].into_iter());
        (0..40).for_each(|_| control.tick(TICK_S));
        assert_eq!(control.tilt(), Tilt::LEVEL);
    }

    #[test]
    fn opposite_keys_cancel() {
        assert_eq!(held(&[Direction::Left, Direction::Right]).tilt(), Tilt::LEVEL);
        let control = held(&[Direction::Left, Direction::Right, Direction::Towards]);
        assert!(control.tilt().towards_y < 0 && control.tilt().towards_x == 0);
    }

    #[test]
    fn i10_a_key_held_across_level_and_restart_still_tilts() {
        let mut control = held(&[Direction::Right]);
        control.level();
        assert_eq!(control.tilt(), Tilt::LEVEL);
        (0..40).for_each(|_| control.tick(TICK_S));
        assert!(0.95 * LIMIT_RAD < angle(&control));
    }

    #[test]
    fn a_tap_between_two_ticks_is_felt() {
        let mut control = TiltControl::new(LIMIT_RAD);
        control.tap(Direction::Left);
        control.hold([].into_iter());
        control.tick(TICK_S);
        assert!(control.tilt().towards_x < 0);
    }

    #[test]
    fn a_dragged_board_stays_where_it_is_left() {
        let mut control = TiltControl::new(LIMIT_RAD);
        control.begin_drag();
        control.drag_by(Vector2::new(0.05, 0.05));
        control.end_drag();
        let left = control.tilt();
        control.tick(TICK_S);
        assert_eq!(control.tilt(), left);
        control.level();
        assert_eq!(control.tilt(), Tilt::LEVEL);
    }
}
