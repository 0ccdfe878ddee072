//! Whether the balls of all contenders follow the same path, for as long as it can be compared.

use super::super::agreement::{Agreement, Comparison};
use super::super::case::turning_accelerations;
use super::{Built, Course, Mover};
use maze_core::Ball;
use nalgebra::Vector2;

/// Balls are compared for so long: a fall across a corridor and the first bounce. Later every corner multiplies what little
/// differs.
const N_TICKS: usize = 40;

/// Balls that are compared, each at rest in another cell: 10⁴ positions.
const N_BALLS: usize = 250;

/// Positions of the exact engine itself, with bucket indexes and without, are compared for this many ticks on end.
const N_TICKS_EXACT: usize = 10_000;

/// Positions farther apart than this (units) count as different: a fifth of the ball's radius.
///
/// Both move in steps of first order, which is v dt / 2 = 0.02 off at 1 unit/s; a bounce is seen up to a tick late, which is
/// (1 + e) v dt = 0.05; rapier's contacts begin 0.02 early.
pub const APART: f64 = 0.05;

/// What is asked of engines that move in steps.
pub const FIRST_ORDER: Agreement =
    Agreement::Mostly { part: 0.01, reason: "steps of first order; bounces at the end of a tick" };

/// And of the report's, whose ball is reflected at corners as if they were faces.
pub const REPORT: Agreement = Agreement::Mostly {
    part: 0.03,
    reason: "steps of first order; bounces at the end of a tick; corners reflected about a face's normal",
};

/// Compares all with the first, and leaves the balls somewhere.
pub(super) fn compare_all(course: &Course, built: &mut [Built]) -> Vec<Comparison> {
    let mut found = Vec::new();
    let Some(((_, reference), others)) = built.split_first_mut() else { return found };
    for (contender, mover) in others {
        let pair: [&mut dyn Mover; 2] = [reference.as_mut(), mover.as_mut()];
        let (name, agreement, n_planes) = (contender.name, contender.agreement, course.n_planes());
        let mut compared = Comparison::new(name, agreement, super::ROLLING_BALL, n_planes, APART);
        match agreement {
            Agreement::OtherQuestion(_) => {}
            Agreement::Exact => exact(&mut compared, course, pair),
            Agreement::Mostly { .. } => first_bounces(&mut compared, course, pair),
        }
        found.push(compared.judged());
    }
    found
}

/// One ball on and on.
fn exact(found: &mut Comparison, course: &Course, [truth, given]: [&mut dyn Mover; 2]) {
    truth.place(course.starts[0]);
    given.place(course.starts[0]);
    for acceleration in turning_accelerations().into_iter().cycle().take(N_TICKS_EXACT) {
        tick_both(found, [truth, given], acceleration * STRONG);
    }
}

/// Strong enough to throw the ball about (a acceleration of 1 unit/s² times this).
const STRONG: f64 = 5.0;

/// Many balls, each from rest to its first bounce.
fn first_bounces(found: &mut Comparison, course: &Course, [truth, given]: [&mut dyn Mover; 2]) {
    let accelerations = turning_accelerations();
    for (n, start) in course.case.scattered(N_BALLS).into_iter().map(Ball::at).enumerate() {
        truth.place(start);
        given.place(start);
        // Each in another direction.
        for acceleration in accelerations.iter().cycle().skip(n * 31 % accelerations.len()).take(N_TICKS) {
            tick_both(found, [truth, given], *acceleration);
        }
    }
}

fn tick_both(found: &mut Comparison, [truth, given]: [&mut dyn Mover; 2], acceleration: Vector2<f64>) {
    truth.tick(acceleration);
    given.tick(acceleration);
    let [truth, given] = [truth.ball(), given.ball()];
    found.note(truth == given, (truth.position - given.position).norm());
}

#[cfg(test)]
mod tests {
    use super::super::{CONTINUOUS, Contender, movers};
    use super::*;
    use crate::bench::case::Case;

    /// The exact engine, whose ball is reported somewhere else.
    struct Shifted(Box<dyn Mover>, f64);

    impl Mover for Shifted {
        fn tick(&mut self, acceleration: Vector2<f64>) {
            self.0.tick(acceleration);
        }

        fn n_balls(&self) -> usize {
            self.0.n_balls()
        }

        fn ball(&self) -> Ball {
            let ball = self.0.ball();
            Ball { position: ball.position.map(|x| x + self.1), ..ball }
        }

        fn place(&mut self, ball: Ball) {
            self.0.place(ball);
        }
    }

    fn holds(agreement: Agreement, shift: f64) -> bool {
        let case = Case::new(9, 1).unwrap();
        let course = Course::middle(&case);
        let exact = || movers::exact(&course).unwrap();
        let shifted: Box<dyn Mover> = Box::new(Shifted(exact(), shift));
        let mut built = [(CONTINUOUS, exact()), (Contender { agreement, ..CONTINUOUS }, shifted)];
        compare_all(&course, &mut built)[0].holds
    }

    #[test]
    fn a_ball_elsewhere_is_found() {
        assert!(holds(Agreement::Exact, 0.0));
        assert!(!holds(Agreement::Exact, 1.0e-14));
        assert!(holds(FIRST_ORDER, 0.03));
        assert!(!holds(FIRST_ORDER, 0.04), "0.04 along both axes is more than 0.05");
        assert!(!holds(REPORT, f64::NAN));
    }
}
