//! Over a floor with steps and slits, towards +x.

use super::Stretch;
use super::arc::{Arc, Place, turned};
use super::line::{Line, arrival};
use maze_core::{Ball, BallSpec};
use nalgebra::Vector2;

/// Places of a flight at which it is checked that the ball does not touch the point that it came from again.
const N_CHECKS: u32 = 64;

/// A ball may seem this much nearer than its radius (units): rounding.
const ROUNDING: f64 = 1.0e-14;

/// Halvings of an interval of time: more than f64 has bits.
const N_HALVINGS: u32 = 80;

const UP: Vector2<f64> = Vector2::new(0.0, 1.0);

/// A ball on its way, bounces on one stretch included.
struct Flight<'a> {
    radius: f64,
    restitution: f64,
    acceleration: Vector2<f64>,
    stretches: &'a [Stretch],
}

/// What happens at an edge: the ball after some time, above the next stretch.
type Crossing = (Ball, f64);

/// The ball after a time (s); `None` where the motion is another one than [`super::Motion::Floor`] tells.
pub(super) fn at(
    from: Ball,
    stretches: &[Stretch],
    spec: &BallSpec,
    acceleration: Vector2<f64>,
    time_s: f64,
) -> Option<Ball> {
    let flight =
        Flight { radius: spec.radius.units(), restitution: spec.restitution, acceleration, stretches };
    let (mut ball, mut left_s) = (from, time_s);
    for (index, stretch) in stretches.iter().enumerate() {
        let Some(edge_s) = flight.time_to_edge(index, ball) else {
            return flight.above(stretch, ball, left_s);
        };
        if left_s < edge_s {
            return flight.above(stretch, ball, left_s);
        }
        left_s -= edge_s;
        ball = flight.above(stretch, ball, edge_s)?;
        let slides = ball.position.y == stretch.height + flight.radius && ball.velocity.y == 0.0;
        if !slides {
            return None;
        }
        match flight.cross(index, ball, left_s)? {
            Next::Ball(ball) => return Some(ball),
            Next::Crossed((after, taken_s)) => {
                ball = after;
                left_s -= taken_s;
            }
        }
    }
    None
}

enum Next {
    /// The time ends at the edge.
    Ball(Ball),
    Crossed(Crossing),
}

impl Flight<'_> {
    /// Bouncing or sliding on a stretch as if it had no ends.
    fn above(&self, stretch: &Stretch, ball: Ball, time_s: f64) -> Option<Ball> {
        let line = Line {
            low: Some(stretch.height + self.radius),
            high: None,
            acceleration: self.acceleration.y,
            restitution: self.restitution,
        };
        let (y, speed) = line.at(ball.position.y, ball.velocity.y, time_s)?;
        let free = self.flown(ball, time_s);
        Some(Ball {
            position: Vector2::new(free.position.x, y),
            velocity: Vector2::new(free.velocity.x, speed),
        })
    }

    fn flown(&self, ball: Ball, time_s: f64) -> Ball {
        let position = ball.position + (ball.velocity + self.acceleration * (time_s / 2.0)) * time_s;
        Ball { position, velocity: ball.velocity + self.acceleration * time_s }
    }

    /// Where the centre of a ball that slides towards a step up touches its edge; `None` where there is no step up.
    fn touches_step(&self, index: usize) -> Option<f64> {
        let next = self.stretches.get(index + 1)?;
        let rise = next.height - self.stretches[index].height;
        (0.0 < rise).then(|| next.start - (rise * (2.0 * self.radius - rise)).sqrt())
    }

    /// When the ball gets to the end of a stretch, or to a step up before it; `None` if never.
    fn time_to_edge(&self, index: usize, ball: Ball) -> Option<f64> {
        self.stretches.get(index + 1)?;
        let end = self.stretches[index].end;
        let edge = self.touches_step(index).map_or(end, |step| step.min(end));
        let gap = edge - ball.position.x;
        arrival(gap, ball.velocity.x, self.acceleration.x, edge, -1.0).map(|hit| hit.time_s)
    }

    /// From the edge, where the ball slides, to the next stretch.
    fn cross(&self, index: usize, ball: Ball, left_s: f64) -> Option<Next> {
        let (stretch, next) = (&self.stretches[index], &self.stretches[index + 1]);
        let near = Vector2::new(next.start, next.height);
        if self.touches_step(index).is_some_and(|step| step <= stretch.end) {
            return self.reflected(ball, near, next, 0.0).map(Next::Crossed);
        }
        let point = Vector2::new(stretch.end, stretch.height);
        let ball = Ball { position: Vector2::new(point.x, ball.position.y), velocity: ball.velocity };
        let on_arc = |place: Place| Ball {
            position: point + place.normal * self.radius,
            velocity: turned(place.normal) * place.speed,
        };
        let start = Place { normal: UP, speed: -ball.velocity.x };
        let Some(arc) = Arc::new(start, self.radius, self.acceleration) else {
            return self.land(ball, near, next, 0.0, left_s);
        };
        let lift_off = arc.lifts_off();
        let touch = self.touch_on_arc(point, stretch, next);
        let reached = arc.reaches(touch.normal).filter(|w| *w <= lift_off);
        let end = reached.unwrap_or(lift_off);
        let taken_s = arc.time_to(end);
        if left_s < taken_s {
            return Some(Next::Ball(on_arc(arc.after(left_s, end))));
        }
        let ball = on_arc(arc.place(end));
        if reached.is_none() {
            return self.land(ball, near, next, taken_s, left_s);
        }
        if touch.is_point {
            return self.reflected(ball, near, next, taken_s).map(Next::Crossed);
        }
        let position = Vector2::new(ball.position.x, next.height + self.radius);
        let velocity = Vector2::new(ball.velocity.x, -self.restitution * ball.velocity.y);
        Some(Next::Crossed((Ball { position, velocity }, taken_s)))
    }

    /// What a ball that rolls around the end of a stretch touches first: the next stretch, or its edge.
    fn touch_on_arc(&self, point: Vector2<f64>, stretch: &Stretch, next: &Stretch) -> Touch {
        let drop = stretch.height - next.height;
        let sine = (drop * (2.0 * self.radius - drop)).max(0.0).sqrt() / self.radius;
        if 0.0 <= drop && next.start <= point.x + sine * self.radius {
            return Touch { normal: Vector2::new(sine, 1.0 - drop / self.radius), is_point: false };
        }
        let between = Vector2::new(next.start, next.height) - point;
        let half = between.norm() / (2.0 * self.radius);
        let along = between.normalize();
        Touch { normal: along * half + turned(along) * ((1.0 - half) * (1.0 + half)).sqrt(), is_point: true }
    }

    /// From the air: onto the next stretch, or onto its edge first.
    fn land(
        &self,
        ball: Ball,
        near: Vector2<f64>,
        next: &Stretch,
        taken_s: f64,
        left_s: f64,
    ) -> Option<Next> {
        let beside =
            arrival(near.x - ball.position.x, ball.velocity.x, self.acceleration.x, near.x, -1.0)?.time_s;
        let gap = |time_s: f64| (self.flown(ball, time_s).position - near).norm() - self.radius;
        if 0.0 <= gap(beside) {
            return Some(Next::Crossed((ball, taken_s)));
        }
        let (mut low, mut high) = (0.0, beside);
        for _ in 0..N_HALVINGS {
            let middle = high.midpoint(low);
            if gap(middle) < 0.0 { high = middle } else { low = middle }
        }
        if left_s < taken_s + low {
            return Some(Next::Ball(self.flown(ball, left_s - taken_s)));
        }
        self.reflected(self.flown(ball, low), near, next, taken_s + low).map(Next::Crossed)
    }

    /// Off a point and over it: `None` where the ball touches it again before it gets onto the stretch behind it.
    fn reflected(&self, ball: Ball, point: Vector2<f64>, next: &Stretch, taken_s: f64) -> Option<Crossing> {
        let normal = (ball.position - point).normalize();
        let approach = ball.velocity.dot(&normal);
        let after = Ball { velocity: ball.velocity - normal * ((1.0 + self.restitution) * approach), ..ball };
        let beside =
            arrival(point.x - ball.position.x, after.velocity.x, self.acceleration.x, point.x, -1.0)?.time_s;
        let is_clear = (1..=N_CHECKS).all(|k| {
            let place = self.flown(after, beside * f64::from(k) / f64::from(N_CHECKS)).position;
            self.radius - ROUNDING <= (place - point).norm()
        });
        let lands_behind = next.height + self.radius - ROUNDING <= self.flown(after, beside).position.y;
        (is_clear && lands_behind).then_some((after, taken_s))
    }
}

/// Where the ball on an arc touches something.
struct Touch {
    normal: Vector2<f64>,
    is_point: bool,
}
