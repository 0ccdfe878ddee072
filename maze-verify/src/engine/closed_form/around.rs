//! Along the sides and around the corners of one solid rectangle.

use super::arc::{Arc, Place, turned};
use super::line::arrival;
use maze_core::{Ball, BallSpec, Bounds};
use nalgebra::Vector2;

/// Most sides and corners, one after the other.
const MAX_PIECES: u32 = 1000;

/// A ball this far (units) from touching a side at the start does not lie on it.
const NEAR: f64 = 1.0e-12;

/// The outward normal of a side: right, top, left, bottom. Its tangent counter-clockwise is the normal of the next one.
fn normal(side: usize) -> Vector2<f64> {
    [Vector2::new(1.0, 0.0), Vector2::new(0.0, 1.0), Vector2::new(-1.0, 0.0), Vector2::new(0.0, -1.0)]
        [side % 4]
}

/// Where a side meets the next one counter-clockwise.
fn corner(block: &Bounds, side: usize) -> Vector2<f64> {
    let (low, high) = (block.low, block.high);
    [high, Vector2::new(low.x, high.y), low, Vector2::new(high.x, low.y)][side % 4]
}

/// What the ball does next.
enum Piece {
    /// On a side: place and speed counter-clockwise.
    Slide { side: usize, along: f64, speed: f64 },
    /// Around the corner after a side, counter-clockwise, coming from the side itself or from the next one.
    Turn { side: usize, is_from_next: bool, speed: f64 },
}

fn flown(ball: Ball, acceleration: Vector2<f64>, time_s: f64) -> Ball {
    let position = ball.position + (ball.velocity + acceleration * (time_s / 2.0)) * time_s;
    Ball { position, velocity: ball.velocity + acceleration * time_s }
}

/// The ball after a time (s); `None` where it does not begin on a side, or stands still on a corner.
pub(super) fn at(
    from: Ball,
    block: &Bounds,
    spec: &BallSpec,
    acceleration: Vector2<f64>,
    time_s: f64,
) -> Option<Ball> {
    let radius = spec.radius.units();
    let is_on = |side: &usize| {
        let (height, along) = (from.position - corner(block, *side), from.position.dot(&normal(side + 1)));
        let (start, end) = ends(block, *side);
        (height.dot(&normal(*side)) - radius).abs() < NEAR && start <= along && along <= end
    };
    let side = (0..4).find(is_on)?;
    let tangent = normal(side + 1);
    let mut piece =
        Piece::Slide { side, along: from.position.dot(&tangent), speed: from.velocity.dot(&tangent) };
    let mut left_s = time_s;
    for _ in 0..MAX_PIECES {
        let (next, taken_s) = match piece {
            Piece::Slide { side, along, speed } => {
                match slide(block, side, along, speed, radius, acceleration, left_s) {
                    Next::Piece(next, taken_s) => (next, taken_s),
                    Next::Ball(ball) => return Some(ball),
                }
            }
            Piece::Turn { side, is_from_next, speed } => {
                match turn(block, side, is_from_next, speed, radius, acceleration, left_s) {
                    Next::Piece(next, taken_s) => (next, taken_s),
                    Next::Ball(ball) => return Some(ball),
                }
            }
        };
        piece = next;
        left_s -= taken_s;
    }
    None
}

/// The range of a side, along its tangent.
fn ends(block: &Bounds, side: usize) -> (f64, f64) {
    let tangent = normal(side + 1);
    (corner(block, side + 3).dot(&tangent), corner(block, side).dot(&tangent))
}

/// Either the time ends in a piece, or the next one begins.
enum Next {
    Ball(Ball),
    Piece(Piece, f64),
}

fn slide(
    block: &Bounds,
    side: usize,
    along: f64,
    speed: f64,
    radius: f64,
    acceleration: Vector2<f64>,
    left_s: f64,
) -> Next {
    let (outward, tangent) = (normal(side), normal(side + 1));
    let height = corner(block, side).dot(&outward) + radius;
    let ball = |along: f64, speed: f64| Ball {
        position: outward * height + tangent * along,
        velocity: tangent * speed,
    };
    if 0.0 <= acceleration.dot(&outward) {
        return Next::Ball(flown(ball(along, speed), acceleration, left_s));
    }
    let gain = acceleration.dot(&tangent);
    let (start, end) = ends(block, side);
    let high = arrival(end - along, speed, gain, end, -1.0).map(|hit| (hit, false));
    let low = arrival(along - start, -speed, -gain, start, 1.0).map(|hit| (hit, true));
    let first = [high, low].into_iter().flatten().min_by(|a, b| a.0.time_s.total_cmp(&b.0.time_s));
    match first.filter(|(hit, _)| hit.time_s <= left_s) {
        None => Next::Ball(ball(along + (speed + gain * left_s / 2.0) * left_s, speed + gain * left_s)),
        Some((hit, false)) => {
            Next::Piece(Piece::Turn { side, is_from_next: false, speed: hit.speed }, hit.time_s)
        }
        Some((hit, true)) => {
            Next::Piece(Piece::Turn { side: side + 3, is_from_next: true, speed: -hit.speed }, hit.time_s)
        }
    }
}

fn turn(
    block: &Bounds,
    side: usize,
    is_from_next: bool,
    speed: f64,
    radius: f64,
    acceleration: Vector2<f64>,
    left_s: f64,
) -> Next {
    let point = corner(block, side);
    let (here, beyond) = if is_from_next { (side + 1, side) } else { (side, side + 1) };
    let ball = |place: Place| Ball {
        position: point + place.normal * radius,
        velocity: turned(place.normal) * place.speed,
    };
    let start = Place { normal: normal(here), speed };
    let Some(arc) = Arc::new(start, radius, acceleration) else {
        return Next::Ball(flown(ball(start), acceleration, left_s));
    };
    let onto = |side: usize| {
        // The corner is the upper end of its own side and the lower one of the next.
        let along = point.dot(&normal(side + 1));
        move |speed: f64| Some(Piece::Slide { side: side % 4, along, speed })
    };
    let lift_off = arc.lifts_off();
    let across = arc.reaches(normal(beyond)).filter(|w| *w <= lift_off);
    let back = arc.returns().filter(|w| *w <= lift_off);
    // A ball that reaches the side beyond does so before it turns back.
    let (end, next) = match (across, back) {
        (Some(w), _) => (w, onto(beyond)(arc.place(w).speed)),
        (None, Some(w)) => (w, onto(here)(-speed)),
        (None, None) => (lift_off, None),
    };
    let taken_s = arc.time_to(end);
    if left_s < taken_s {
        return Next::Ball(ball(arc.after(left_s, end)));
    }
    match next {
        Some(next) => Next::Piece(next, taken_s),
        None => Next::Ball(flown(ball(arc.place(end)), acceleration, left_s - taken_s)),
    }
}
