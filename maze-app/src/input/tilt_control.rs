//! The tilt that mouse and keys ask for, held under its limit.

use super::arcball;
use maze_core::Tilt;
use nalgebra::{Quaternion, UnitQuaternion, Vector2, Vector3};

/// How fast held keys tip the board, and how fast it comes back when they are let go, as half-angle tangents a second:
/// 0.5 is about 57 degrees a second, so the limit of 20 degrees is reached in a third of a second.
const KEY_RATE_PER_S: f64 = 0.5;

/// A key counts as held for at least this long, so that a tap between two ticks is still felt.
const TAP_S: f64 = 0.1;

/// A drag may ask for this many times the limit; more is forgotten, so that dragging back answers at once.
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

/// A drag in progress: where it began on the sphere, and the orientation it began with.
#[derive(Clone, Copy, Debug)]
struct Drag {
    from: Vector3<f64>,
    world_from_maze: UnitQuaternion<f64>,
}

/// Half-angle tangents (towards +x, towards +y) that are asked for; what is given stays under the limit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TiltControl {
    asked: Vector2<f64>,
    limit: f64,
    drag: Option<Drag>,
    held: [bool; 4],
    tapped_left_s: [f64; 4],
    /// Whether keys moved the board last: then it comes back to level when they are let go.
    keys_lead: bool,
}

impl TiltControl {
    /// `max_tilt_rad` must lie between 0 and a right angle.
    pub(crate) fn new(max_tilt_rad: f64) -> Self {
        Self {
            asked: Vector2::zeros(),
            limit: (max_tilt_rad / 2.0).tan(),
            drag: None,
            held: [false; 4],
            tapped_left_s: [0.0; 4],
            keys_lead: false,
        }
    }

    /// The tilt to simulate and to draw.
    pub(crate) fn tilt(&self) -> Tilt {
        let given = soft_limited(self.asked, self.limit);
        Tilt::from_half_tangents(given.x, given.y)
    }

    /// Whether the mouse holds the board: then it is drawn where it is held, not interpolated.
    pub(crate) fn is_dragged(&self) -> bool {
        self.drag.is_some()
    }

    /// The board lies flat; a drag in progress ends.
    pub(crate) fn level(&mut self) {
        self.asked = Vector2::zeros();
        self.drag = None;
        self.keys_lead = false;
        self.tapped_left_s = [0.0; 4];
    }

    /// The mouse takes hold at a point of the arcball, given in world axes.
    pub(crate) fn begin_drag(&mut self, from: Vector3<f64>) {
        self.keys_lead = false;
        // Unlike `Tilt`, which is quantised: a drag of no length must change nothing.
        let world_from_maze =
            UnitQuaternion::new_normalize(Quaternion::new(1.0, -self.asked.y, self.asked.x, 0.0));
        self.drag = Some(Drag { from, world_from_maze });
    }

    /// The mouse has moved to another point, in world axes.
    pub(crate) fn drag_to(&mut self, to: Vector3<f64>) {
        let Some(drag) = self.drag else { return };
        let turned = arcball::rotation(drag.from, to) * drag.world_from_maze;
        self.asked = capped(swing_tangents(&turned), MAX_EXCESS * self.limit);
    }

    pub(crate) fn end_drag(&mut self) {
        self.drag = None;
    }

    /// A tilt key went down or up.
    pub(crate) fn key(&mut self, direction: Direction, pressed: bool) {
        self.held[direction as usize] = pressed;
        if pressed {
            self.tapped_left_s[direction as usize] = TAP_S;
            self.keys_lead = true;
        }
    }

    /// The window lost the keyboard: no release will come.
    pub(crate) fn release_all(&mut self) {
        self.held = [false; 4];
        self.drag = None;
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
        if !self.keys_lead || self.drag.is_some() {
            return;
        }
        // Opposite keys cancel; two neighbours tip diagonally, no further than one.
        let wanted = wanted.try_normalize(0.0).unwrap_or_default() * (MAX_EXCESS * self.limit);
        let way = wanted - self.asked;
        self.asked += capped(way, KEY_RATE_PER_S * tick_s);
    }
}

/// The vector, shortened to at most `longest`.
fn capped(vector: Vector2<f64>, longest: f64) -> Vector2<f64> {
    let length = vector.norm();
    if length <= longest { vector } else { vector * (longest / length) }
}

/// Half-angle tangents of a rotation's swing, its turn about the board's own normal left out.
fn swing_tangents(world_from_maze: &UnitQuaternion<f64>) -> Vector2<f64> {
    let q = world_from_maze.quaternion();
    // q = swing * twist with twist = (w, 0, 0, z) normalised; a half turn has no swing part left to divide by.
    let Some(twist) = UnitQuaternion::try_new(Quaternion::new(q.w, 0.0, 0.0, q.k), 1.0e-9) else {
        return Vector2::zeros();
    };
    let swing = (world_from_maze * twist.inverse()).into_inner();
    Vector2::new(swing.j / swing.w, -swing.i / swing.w)
}

/// `limit` must be greater than 0. Nearly the identity up to 2/3 of the limit, then smoothly up to it: t / (1 + (t / L)^4)^(1/4).
fn soft_limited(asked: Vector2<f64>, limit: f64) -> Vector2<f64> {
    let part = asked.norm_squared() / (limit * limit);
    asked / (1.0 + part * part).sqrt().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use maze_core::gravity;

    const LIMIT_RAD: f64 = 0.349;
    const TICK_S: f64 = 0.03;

    fn angle(control: &TiltControl) -> f64 {
        control.tilt().world_from_maze().angle()
    }

    #[test]
    fn dragging_to_the_right_runs_the_ball_to_the_right() {
        let mut control = TiltControl::new(LIMIT_RAD);
        control.begin_drag(Vector3::z());
        assert_eq!(control.tilt(), Tilt::LEVEL, "a drag begins where the board is");
        control.drag_to(Vector3::new(0.05, 0.0, 1.0).normalize());
        let p = gravity::project(gravity::WORLD_GRAVITY, &control.tilt().world_from_maze());
        assert!(0.5 < p.x && p.y.abs() < 1.0e-3, "{p}");
        assert!((angle(&control) - 0.1).abs() < 2.0e-3, "twice the arc: {}", angle(&control));
    }

    #[test]
    fn the_limit_is_never_passed_and_dragging_back_answers_at_once() {
        let mut control = TiltControl::new(LIMIT_RAD);
        control.begin_drag(Vector3::z());
        let mut last = 0.0;
        for step in 0..=100 {
            let arc = f64::from(step) * 0.015;
            control.drag_to(Vector3::new(arc.sin(), 0.0, arc.cos()));
            let now = angle(&control);
            assert!(last <= now && now < LIMIT_RAD, "step {step}: {now}");
            last = now;
        }
        assert!(0.97 * LIMIT_RAD < last);
        control.end_drag();
        control.begin_drag(Vector3::z());
        control.drag_to(Vector3::new(-0.15, 0.0, 1.0).normalize());
        assert!(angle(&control) < 0.9 * LIMIT_RAD);
    }

    #[test]
    fn turning_about_the_normal_is_no_tilt() {
        let mut control = TiltControl::new(LIMIT_RAD);
        control.begin_drag(Vector3::x());
        control.drag_to(Vector3::new(0.8, 0.6, 0.0));
        assert_eq!(control.tilt(), Tilt::LEVEL);
    }

    #[test]
    fn a_key_tips_while_it_is_held_and_the_board_comes_back() {
        let mut control = TiltControl::new(LIMIT_RAD);
        control.key(Direction::Away, true);
        for _ in 0..40 {
            control.tick(TICK_S);
        }
        assert!(0.95 * LIMIT_RAD < angle(&control) && angle(&control) < LIMIT_RAD);
        assert!(0 < control.tilt().towards_y && control.tilt().towards_x == 0);
        control.key(Direction::Away, false);
        for _ in 0..40 {
            control.tick(TICK_S);
        }
        assert_eq!(control.tilt(), Tilt::LEVEL);
    }

    #[test]
    fn a_tap_between_two_ticks_is_felt() {
        let mut control = TiltControl::new(LIMIT_RAD);
        control.key(Direction::Left, true);
        control.key(Direction::Left, false);
        control.tick(TICK_S);
        assert!(control.tilt().towards_x < 0);
    }

    #[test]
    fn a_dragged_board_stays_where_it_is_left() {
        let mut control = TiltControl::new(LIMIT_RAD);
        control.begin_drag(Vector3::z());
        control.drag_to(Vector3::new(0.05, 0.05, 1.0).normalize());
        control.end_drag();
        let left = control.tilt();
        control.tick(TICK_S);
        assert_eq!(control.tilt(), left);
        control.level();
        assert_eq!(control.tilt(), Tilt::LEVEL);
    }
}
