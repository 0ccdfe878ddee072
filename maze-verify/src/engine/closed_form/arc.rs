//! A ball that is pressed onto a point and moves around it: a pendulum on its head.
//!
//! With the angle θ from the top (the direction against the acceleration a), counted in the direction of motion, and
//! s = sin(θ/2), the energy is C = v² - V² s² with V² = 4 r |a|. For C > 0 the ball gets over the top, and with ε = √C / V the
//! substitution s = ε sinh w gives v = V ε cosh w; for C < 0 it stays on one side, and s = ± ε cosh w with ε = √-C / V gives
//! v = V ε |sinh w|. In both cases dt = 2 r / V · dw / √(1 - s²), which is smooth also where the ball turns back, and is
//! integrated numerically to rounding.

use nalgebra::Vector2;
use std::f64::consts::FRAC_PI_2;

/// Steps of the quadrature on each side of the middle, and their width (1): beyond them the weights are rounding.
const N_STEPS: i32 = 52;
const STEP: f64 = 1.0 / 16.0;

/// Most steps of Newton's method and bisection.
const MAX_ITERATIONS: u32 = 200;

/// The integral of a smooth function by the tanh-sinh rule (Takahasi and Mori 1974).
fn integral(from: f64, to: f64, function: impl Fn(f64) -> f64) -> f64 {
    let (middle, half) = (from.midpoint(to), (to - from) / 2.0);
    let terms = (-N_STEPS..=N_STEPS).map(|k| {
        let t = f64::from(k) * STEP;
        let u = FRAC_PI_2 * t.sinh();
        function(middle + half * u.tanh()) * FRAC_PI_2 * t.cosh() / (u.cosh() * u.cosh())
    });
    terms.sum::<f64>() * STEP * half
}

/// The unit vector turned by +90 degrees.
pub(super) fn turned(normal: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(-normal.y, normal.x)
}

/// One motion around a point, which begins with a speed other than 0.
pub(super) struct Arc {
    /// Unit vector against the acceleration.
    top: Vector2<f64>,
    /// 1 counter-clockwise, -1 clockwise: the direction at first.
    side: f64,
    radius: f64,
    /// V.
    full: f64,
    /// C (units²/s²).
    energy: f64,
    /// ε.
    scale: f64,
    /// s at first.
    begin: f64,
    /// w at first.
    from: f64,
}

/// Direction from the point to the centre, and the speed counter-clockwise (units/s).
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) normal: Vector2<f64>,
    pub(super) speed: f64,
}

impl Arc {
    /// From a direction (point to centre) and a speed counter-clockwise. `None` where the ball is not pressed onto the point,
    /// and where it would stand on top of it for ever.
    pub(super) fn new(from: Place, radius: f64, acceleration: Vector2<f64>) -> Option<Self> {
        let strength = acceleration.norm();
        let pressing = -acceleration.dot(&from.normal);
        let squared = from.speed * from.speed;
        if pressing * radius <= squared || from.speed == 0.0 {
            return None;
        }
        let (top, side) = (-acceleration / strength, from.speed.signum());
        let begin = half_sine(top, from.normal) * side;
        let full = (4.0 * radius * strength).sqrt();
        let energy = squared - full * full * begin * begin;
        let scale = energy.abs().sqrt() / full;
        let mut arc = Self { top, side, radius, full, energy, scale, begin, from: 0.0 };
        arc.from = match arc.is_over_the_top() {
            true => (begin / scale).asinh(),
            false => begin.signum() * (from.speed.abs() / (full * scale)).asinh(),
        };
        arc.from.is_finite().then_some(arc)
    }

    fn is_over_the_top(&self) -> bool {
        0.0 < self.energy
    }

    /// sin(θ/2) at w.
    fn sine(&self, w: f64) -> f64 {
        if self.is_over_the_top() {
            self.scale * w.sinh()
        } else {
            self.begin.signum() * self.scale * w.cosh()
        }
    }

    /// w where the ball gets to a direction that lies ahead, before it turns back. `None` if it does not.
    pub(super) fn reaches(&self, normal: Vector2<f64>) -> Option<f64> {
        let sine = half_sine(self.top, normal) * self.side;
        let w = if self.is_over_the_top() {
            (sine / self.scale).asinh()
        } else {
            // On the way up the top is ahead, and w less than 0.
            let far = self.begin.signum() * sine / self.scale;
            self.begin.signum() * (1.0 <= far).then(|| far.acosh())?
        };
        (self.from <= w).then_some(w)
    }

    /// w where the ball is back where it began. `None` if it does not turn back.
    pub(super) fn returns(&self) -> Option<f64> {
        (!self.is_over_the_top() && self.from < 0.0).then_some(-self.from)
    }

    /// w where the ball lifts off, on its way down: v² = r |a| cos θ.
    pub(super) fn lifts_off(&self) -> f64 {
        let sine = ((1.0 - 4.0 * self.energy / (self.full * self.full)) / 6.0).max(0.0).sqrt();
        if self.is_over_the_top() {
            (sine / self.scale).asinh()
        } else {
            (sine / self.scale).max(1.0).acosh()
        }
    }

    /// Time from w₁ to w₂ (s).
    fn time_between(&self, from: f64, to: f64) -> f64 {
        let rate = |w: f64| {
            let sine = self.sine(w);
            1.0 / ((1.0 - sine) * (1.0 + sine)).sqrt()
        };
        2.0 * self.radius / self.full * integral(from, to, rate)
    }

    /// Time from the start (s).
    pub(super) fn time_to(&self, w: f64) -> f64 {
        self.time_between(self.from, w)
    }

    /// The place at w.
    pub(super) fn place(&self, w: f64) -> Place {
        let sine = self.sine(w);
        let (sin, cos) = (2.0 * sine * ((1.0 - sine) * (1.0 + sine)).sqrt(), 1.0 - 2.0 * sine * sine);
        let ahead = match self.is_over_the_top() {
            true => self.full * self.scale * w.cosh(),
            false => self.full * self.scale * self.begin.signum() * w.sinh(),
        };
        let normal = self.top * cos + turned(self.top) * (sin * self.side);
        Place { normal, speed: ahead * self.side }
    }

    /// The place after a time (s) within the motion up to w.
    pub(super) fn after(&self, time_s: f64, end: f64) -> Place {
        let (mut low, mut high) = (self.from, end);
        let mut w = low;
        let mut at_s = 0.0;
        for _ in 0..MAX_ITERATIONS {
            let sine = self.sine(w);
            let rate = 2.0 * self.radius / (self.full * ((1.0 - sine) * (1.0 + sine)).sqrt());
            if at_s < time_s {
                low = w
            } else {
                high = w
            }
            let newton = w + (time_s - at_s) / rate;
            let next = if low <= newton && newton <= high { newton } else { low.midpoint(high) };
            if (next - w).abs() <= 2.0 * f64::EPSILON * (1.0 + w.abs()) {
                w = next;
                break;
            }
            w = next;
            at_s = self.time_to(w);
        }
        self.place(w)
    }
}

/// sin(θ/2) of the angle from one unit vector to another, counter-clockwise.
fn half_sine(from: Vector2<f64>, to: Vector2<f64>) -> f64 {
    ((to - from).norm() / 2.0).copysign(from.perp(&to))
}

#[cfg(test)]
mod tests {
    use super::*;

    const RADIUS: f64 = 0.25;
    const DOWN: Vector2<f64> = Vector2::new(0.0, -3.0);

    fn arc(degrees: f64, speed: f64) -> Arc {
        let (sin, cos) = degrees.to_radians().sin_cos();
        Arc::new(Place { normal: Vector2::new(sin, cos), speed }, RADIUS, DOWN).unwrap()
    }

    /// The equation of motion of the pendulum, θ'' = |a| sin θ / r, in steps (Runge and Kutta).
    fn by_steps(degrees: f64, speed: f64, time_s: f64) -> (f64, f64) {
        let n_steps = 20_000;
        let step_s = time_s / f64::from(n_steps);
        let (mut angle, mut rate) = (degrees.to_radians(), -speed / RADIUS);
        let acceleration = |angle: f64| 3.0 / RADIUS * angle.sin();
        for _ in 0..n_steps {
            let (a1, r1) = (rate, acceleration(angle));
            let (a2, r2) = (rate + step_s / 2.0 * r1, acceleration(angle + step_s / 2.0 * a1));
            let (a3, r3) = (rate + step_s / 2.0 * r2, acceleration(angle + step_s / 2.0 * a2));
            let (a4, r4) = (rate + step_s * r3, acceleration(angle + step_s * a3));
            angle += step_s / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
            rate += step_s / 6.0 * (r1 + 2.0 * r2 + 2.0 * r3 + r4);
        }
        (angle, -rate * RADIUS)
    }

    #[test]
    fn it_is_the_motion_that_steps_of_the_equation_give() {
        // From the top; over the top; turning back before it, on both sides; outwards at once.
        for (degrees, speed, time_s) in
            [(0.0, -0.1, 0.5), (-40.0, -0.72, 0.4), (-40.0, -0.3, 0.3), (40.0, 0.3, 0.3), (10.0, -0.05, 0.3)]
        {
            let arc = arc(degrees, speed);
            let end = arc.lifts_off();
            assert!(time_s < arc.time_to(end), "{degrees} {speed}");
            let place = arc.after(time_s, end);
            let (angle, speed) = by_steps(degrees, speed, time_s);
            let wanted = Vector2::new(angle.sin(), angle.cos());
            assert!((place.normal - wanted).norm() < 1.0e-11, "{degrees}: {} {wanted}", place.normal);
            assert!((place.speed - speed).abs() < 1.0e-11, "{degrees}: {} {speed}", place.speed);
        }
    }

    #[test]
    fn from_the_top_a_ball_lifts_off_where_schoolbooks_tell() {
        for speed in [1.0e-6, 0.1, 0.8] {
            let arc = arc(0.0, -speed);
            let off = arc.place(arc.lifts_off());
            let cos = 2.0 / 3.0 + speed * speed / (3.0 * RADIUS * 3.0);
            assert!((off.normal.y - cos).abs() < 1.0e-14, "{speed}");
            assert!((off.speed * off.speed - RADIUS * 3.0 * cos).abs() < 1.0e-14, "{speed}");
        }
    }

    #[test]
    fn a_ball_that_turns_back_comes_back_as_fast() {
        let arc = arc(-40.0, -0.3);
        let back = arc.place(arc.returns().unwrap());
        assert!((back.speed - 0.3).abs() < 1.0e-15);
        assert!(
            (back.normal - Vector2::new(-0.642_787_609_686_539_4, 0.766_044_443_118_978)).norm() < 1.0e-15
        );
        assert!(arc.reaches(Vector2::new(0.0, 1.0)).is_none());
    }

    #[test]
    fn a_fast_ball_is_not_on_the_arc_at_all() {
        let place = Place { normal: Vector2::new(0.0, 1.0), speed: 0.9 };
        assert!(Arc::new(place, RADIUS, DOWN).is_none());
    }

    #[test]
    fn the_quadrature_is_good_to_rounding() {
        assert!((integral(0.0, 2.0, |x| x.exp()) - (2.0_f64.exp() - 1.0)).abs() < 1.0e-14);
        assert!((integral(-1.0, 1.0, |x| 1.0 / (2.0 - x)) - 3.0_f64.ln()).abs() < 1.0e-14);
    }
}
