//! The report's method, step for step. Its weaknesses (corners reflect about a face's normal, push-out changes the
//! energy, the cost grows with the speed) are kept and measured, not hidden.

use super::Engine;
use crate::physics::ball::{Ball, BallSpec, OutOfRange};
use crate::physics::contact::{self, Contact};
use crate::physics::numbers::lesser;
use crate::physics::sorted_planes::SortedPlanes;
use crate::physics::tick::{Hit, Log, Observer, Tick};
use crate::physics::wall::Facing;
use crate::physics::world::check_tick_s;
use nalgebra::Vector2;
use std::sync::Arc;

/// Length of one step (units) when a tick would move the ball by more than its radius; the report's value.
pub const SUBSTEP: f64 = 0.02;

/// Most substeps in a tick: 2000 units, which is 66,000 units/s at the report's tick length. What lies beyond is dropped and
/// reported in [`Tick::dropped_s`].
pub const MAX_SUBSTEPS: u32 = 100_000;

/// Most contacts resolved in one step: one a facing group, twice, because a push-out may lead into another wall.
const MAX_CONTACTS_PER_STEP: u32 = 4;

/// The report's engine: explicit Euler, then closest point, penetration, push-out and reflection. The same inputs give the same bits
/// on every platform.
#[derive(Clone, Debug)]
pub struct Published {
    planes: Arc<SortedPlanes>,
    spec: BallSpec,
    ball: Ball,
    tick_s: f64,
}

impl Published {
    /// The report's tick length (s).
    pub const TICK_S: f64 = 0.03;

    /// A ball among planes; `tick_s` is the length of a tick (s), the report's is [`Published::TICK_S`].
    ///
    /// # Errors
    /// What [`crate::World::new`] and [`crate::BallState::new`] refuse.
    pub fn new(
        planes: Arc<SortedPlanes>,
        spec: BallSpec,
        ball: Ball,
        tick_s: f64,
    ) -> Result<Self, OutOfRange> {
        Ok(Self { planes, spec: spec.checked()?, ball: ball.checked()?, tick_s: check_tick_s(tick_s)? })
    }

    /// The contact to resolve next: of the first overlap in each opposing group, the nearer one.
    fn next_contact(&self) -> Option<Contact> {
        let radius = self.spec.radius.units();
        Facing::opposing(self.ball.velocity)
            .filter_map(|facing| self.planes.first_overlap(facing, self.ball.position, radius))
            .filter_map(|plane| contact::find(self.ball.position, radius, &plane))
            .min_by(|a, b| a.distance.total_cmp(&b.distance))
    }

    /// Moves by `step_s` until `time_s` within the tick, then resolves what is overlapped.
    fn step<O: Observer + ?Sized>(&mut self, step_s: f64, time_s: f64, log: &mut Log<O>) {
        self.ball.position += self.ball.velocity * step_s;
        for _ in 0..MAX_CONTACTS_PER_STEP {
            let Some(contact) = self.next_contact() else { return };
            let (facing, before) = (contact.plane.facing, self.ball);
            self.ball = contact.respond(before, &self.spec);
            let Contact { closest: point, penetration, .. } = contact;
            let hit = Hit { time_s, point, normal: facing.normal(), penetration, before, after: self.ball };
            log.note_hit(before.velocity[facing.axis()].abs(), &hit);
            log.note_penetration(penetration);
        }
        log.tick.n_unresolved += u32::from(self.next_contact().is_some());
    }
}

/// In how many equal steps a displacement is divided, and the fraction of the tick that is left out (0 unless bounded).
fn steps_for(displacement: f64, radius: f64) -> (u32, f64) {
    if displacement <= radius {
        return (1, 0.0);
    }
    let wanted = displacement / SUBSTEP;
    if f64::from(MAX_SUBSTEPS) <= wanted {
        return (MAX_SUBSTEPS, 1.0 - f64::from(MAX_SUBSTEPS) / wanted);
    }
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 < wanted < MAX_SUBSTEPS")]
    let whole = wanted as u32;
    (whole + u32::from(f64::from(whole) < wanted), 0.0)
}

impl Published {
    /// A tick, for observers of any kind.
    fn advance_tick<O: Observer + ?Sized>(
        &mut self,
        acceleration: Vector2<f64>,
        observer: &mut O,
    ) -> Result<Tick, OutOfRange> {
        let velocity = self.ball.velocity + acceleration * (self.spec.rolling * self.tick_s);
        let is_finite = |vector: Vector2<f64>| vector.iter().all(|value| value.is_finite());
        if !is_finite(acceleration) {
            return Err(OutOfRange::not_finite("the acceleration"));
        }
        if !is_finite(velocity) {
            return Err(OutOfRange::not_finite("the ball's velocity"));
        }
        if !is_finite(self.ball.position + velocity * self.tick_s) {
            return Err(OutOfRange::not_finite("the ball's position"));
        }
        if self.spec.holds(self.ball.velocity, acceleration * self.spec.rolling, self.tick_s) {
            self.ball.velocity = Vector2::zeros();
            return Ok(Tick { n_steps: 1, ..Tick::default() });
        }
        self.ball.velocity = velocity;
        let displacement = velocity.norm() * self.tick_s;
        let (n_steps, dropped) = steps_for(displacement, self.spec.radius.units());
        let tick = Tick { n_steps, dropped_s: dropped * self.tick_s, ..Tick::default() };
        let step_s = (self.tick_s - tick.dropped_s) / f64::from(n_steps);
        let mut log = Log { tick, observer };
        for n in 1..=n_steps {
            self.step(step_s, lesser(f64::from(n) * step_s, self.tick_s), &mut log);
        }
        self.ball.velocity = self.spec.slowed(self.ball.velocity, self.tick_s);
        Ok(log.tick)
    }
}

impl Engine for Published {
    fn tick_observed(
        &mut self,
        acceleration: Vector2<f64>,
        observer: &mut dyn Observer,
    ) -> Result<Tick, OutOfRange> {
        self.advance_tick(acceleration, observer)
    }

    fn tick(&mut self, acceleration: Vector2<f64>) -> Result<Tick, OutOfRange> {
        self.advance_tick(acceleration, &mut ())
    }

    fn ball(&self) -> Ball {
        self.ball
    }

    fn place(&mut self, ball: Ball) -> Result<(), OutOfRange> {
        self.ball = ball.checked()?;
        Ok(())
    }

    fn spec(&self) -> &BallSpec {
        &self.spec
    }

    fn tick_s(&self) -> f64 {
        self.tick_s
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::wall::Plane;

    fn engine(planes: &[Plane], ball: Ball) -> Published {
        let planes = Arc::new(SortedPlanes::new(planes.iter().copied()).unwrap());
        Published::new(planes, BallSpec::default(), ball, Published::TICK_S).unwrap()
    }

    fn ball(x: f64, y: f64, vx: f64, vy: f64) -> Ball {
        Ball { position: Vector2::new(x, y), velocity: Vector2::new(vx, vy) }
    }

    const WALL: Plane = Plane { facing: Facing::MinusX, offset: 5.0, start: -10.0, end: 10.0 };

    #[test]
    fn step_4_of_gravity_is_explicit_euler_with_a_tick_of_0_03_s() {
        let mut engine = engine(&[], Ball::default());
        engine.tick(Vector2::new(2.0, -1.0)).unwrap();
        assert_eq!(engine.ball().velocity, Vector2::new(0.06, -0.03));
        assert_eq!(engine.ball().position, Vector2::new(0.06, -0.03) * 0.03);
    }

    #[test]
    fn rolling_sphere_gets_five_sevenths_of_the_acceleration() {
        let planes = Arc::new(SortedPlanes::new([]).unwrap());
        let spec = BallSpec { rolling: BallSpec::ROLLING_SPHERE, ..BallSpec::default() };
        let mut engine = Published::new(planes, spec, Ball::default(), Published::TICK_S).unwrap();
        engine.tick(Vector2::new(7.0, 0.0)).unwrap();
        assert!((engine.ball().velocity.x - 5.0 * 0.03).abs() < 1.0e-15);
    }

    #[test]
    fn closed_form_first_bounce_head_on() {
        // Without gravity: v' = -e v, and the ball is outside the wall by no more than one tick's displacement.
        let mut engine = engine(&[WALL], ball(0.0, 0.0, 3.0, 0.5));
        let mut hits = 0;
        for _ in 0..60 {
            hits += engine.tick(Vector2::zeros()).unwrap().n_hits;
        }
        let after = engine.ball();
        assert_eq!(hits, 1);
        assert_eq!(after.velocity, Vector2::new(-0.8 * 3.0, 0.5));
        // The exact bounce happens at t = (5 - r) / 3; the method loses less than a tick's displacement in and out.
        let t_hit = (5.0 - 0.35) / 3.0;
        let exact = (5.0 - 0.35) - 2.4 * (60.0 * Published::TICK_S - t_hit);
        assert!((after.position.x - exact).abs() <= (3.0 + 2.4) * Published::TICK_S, "{}", after.position.x);
        assert!((after.position.y - 0.5 * 60.0 * Published::TICK_S).abs() < 1.0e-12);
    }

    #[test]
    fn closed_form_first_bounce_of_a_fall_reaches_e_squared_of_the_height() {
        // Height h above contact, acceleration a: the exact apex of the first bounce is e² h. Explicit Euler reaches the wall
        // faster by up to one tick's gain in speed, a dt, and the push-out gives back up to one tick's displacement: both first order.
        let (height, acceleration) = (4.0, 3.0);
        let mut engine = engine(&[WALL], ball(5.0 - 0.35 - height, 0.0, 0.0, 0.0));
        let mut bounced = false;
        let mut apex = f64::INFINITY;
        for _ in 0..200 {
            bounced |= 0 < engine.tick(Vector2::new(acceleration, 0.0)).unwrap().n_hits;
            if bounced {
                let gap = 5.0 - 0.35 - engine.ball().position.x;
                if 0.0 < engine.ball().velocity.x {
                    apex = gap;
                    break;
                }
            }
        }
        let exact = 0.8 * 0.8 * height;
        let impact_speed = (2.0 * acceleration * height).sqrt();
        let gain_of_speed = acceleration * Published::TICK_S;
        let from_speed = 0.8 * 0.8 * impact_speed * gain_of_speed / acceleration;
        let bound = from_speed + impact_speed * Published::TICK_S;
        assert!((apex - exact).abs() < bound, "apex {apex}, exact {exact} +- {bound}");
    }

    #[test]
    fn step_5_a_displacement_above_the_radius_is_walked_in_steps_of_0_02() {
        assert_eq!(steps_for(0.35, 0.35), (1, 0.0));
        assert_eq!(steps_for(0.36, 0.35), (18, 0.0));
        assert_eq!(steps_for(1.0, 0.35), (50, 0.0));
        let (n_steps, dropped) = steps_for(4000.0, 0.35);
        assert_eq!(n_steps, MAX_SUBSTEPS);
        assert!((dropped - 0.5).abs() < 1.0e-12);
    }

    #[test]
    fn fast_ball_does_not_tunnel_through_a_thin_wall() {
        for speed in [1.0, 12.0, 100.0, 1000.0, 10_000.0] {
            let back = Plane { facing: Facing::PlusX, offset: 5.02, ..WALL };
            let mut engine = engine(&[WALL, back], ball(0.0, 0.0, speed, 0.0));
            for _ in 0..200 {
                engine.tick(Vector2::zeros()).unwrap();
                assert!(engine.ball().position.x < 5.0, "speed {speed}");
            }
        }
    }

    #[test]
    fn time_beyond_the_bound_is_reported() {
        let mut engine = engine(&[], ball(0.0, 0.0, 1.0e6, 0.0));
        let tick = engine.tick(Vector2::zeros()).unwrap();
        assert!((tick.dropped_s - (0.03 - 2000.0 / 1.0e6)).abs() < 1.0e-12);
        assert!((engine.ball().position.x - 2000.0).abs() < 1.0e-6);
    }

    #[test]
    fn concave_corner_stops_both_components() {
        let side = Plane { facing: Facing::MinusY, offset: 3.0, start: -10.0, end: 5.0 };
        let mut engine = engine(&[WALL, side], ball(4.6, 2.6, 4.0, 4.0));
        let tick = engine.tick(Vector2::zeros()).unwrap();
        assert_eq!(tick.n_hits, 2);
        assert_eq!(engine.ball().velocity, Vector2::new(-3.2, -3.2));
        assert!((engine.ball().position - Vector2::new(4.65, 2.65)).norm() < 1.0e-12);
    }

    #[test]
    fn a_spec_out_of_range_is_refused() {
        let planes = Arc::new(SortedPlanes::new([]).unwrap());
        for restitution in [-0.1, 1.1, f64::NAN] {
            let spec = BallSpec { restitution, ..BallSpec::default() };
            let error = Published::new(planes.clone(), spec, Ball::default(), Published::TICK_S).unwrap_err();
            assert_eq!(error.to_string(), "the restitution: expected a fraction, 0 to 1");
        }
    }

    #[test]
    fn not_finite_input_is_refused_and_changes_nothing() {
        let mut engine = engine(&[WALL], ball(1.0, 2.0, 3.0, 4.0));
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert_eq!(engine.tick(Vector2::new(bad, 0.0)), Err(OutOfRange::not_finite("the acceleration")));
            assert_eq!(engine.ball(), ball(1.0, 2.0, 3.0, 4.0));
            assert!(engine.place(ball(bad, 0.0, 0.0, 0.0)).is_err());
        }
        assert!(engine.place(ball(0.0, 0.0, 0.0, f64::NAN)).is_err());
        assert_eq!(engine.ball(), ball(1.0, 2.0, 3.0, 4.0));
    }

    #[test]
    fn half_a_tick_moves_half_as_far() {
        let planes = Arc::new(SortedPlanes::new([]).unwrap());
        let ball = ball(0.0, 0.0, 2.0, 0.0);
        let mut engine = Published::new(planes, BallSpec::default(), ball, 0.015).unwrap();
        engine.tick(Vector2::new(0.0, 4.0)).unwrap();
        let after = engine.ball();
        assert!((after.velocity - Vector2::new(2.0, 0.06)).norm() < 1.0e-15);
        assert!((after.position - Vector2::new(0.03, 0.0009)).norm() < 1.0e-15);
    }
}
