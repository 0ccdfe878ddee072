//! rapier3d as a [`maze_core::Engine`], without the projection's model error: gravity stays where it is, the board tilts, and a
//! ball rolls on it in three dimensions.

use super::rapier::{Walls, colliders, in_plane, to_f32, world};
use super::without_resistance;
use crate::board::Board;
use maze_core::gravity::WORLD_GRAVITY;
use maze_core::{Ball, BallSpec, Engine, Observer, OutOfRange, Tick};
use nalgebra::Vector2;
use rapier3d::prelude::*;

/// Friction between ball and floor: enough to roll without slipping on any tilt up to 60 degrees (tan 60 · 2/7 = 0.5).
const FLOOR_FRICTION: f32 = 1.0;

/// Half the sides of the floor (units): beyond any scene.
const FLOOR_HALF: f32 = 100.0;
const FLOOR_HALF_THICKNESS: f32 = 0.5;

/// A ball on a board that is moved like a tray: a kinematic body of a floor and walls, which tilts about its middle.
///
/// What is told as an acceleration in the plane becomes a tilt again, which the board reaches by the end of the tick.
/// The walls do not rub; the floor does when the ball is a rolling sphere and does not when it is a point mass.
/// Positions and velocities are those in the board's frame.
pub struct RollingEngine {
    world: PhysicsWorld,
    board: RigidBodyHandle,
    body: RigidBodyHandle,
    spec: BallSpec,
    tick_s: f64,
    /// Not on the board yet: how the board lies is known at the next tick.
    placed: Option<Ball>,
}

impl RollingEngine {
    /// `tick_s` is rapier's step (s).
    ///
    /// # Errors
    /// A position or velocity that is not finite; a ball that neither slides freely nor rolls as a solid sphere.
    pub fn new(board: &Board, spec: BallSpec, ball: Ball, tick_s: f64) -> Result<Self, OutOfRange> {
        let (ball, spec) = (ball.checked()?, without_resistance(spec)?);
        let rolls = spec.rolling == BallSpec::ROLLING_SPHERE;
        if !rolls && spec.rolling != BallSpec::POINT_MASS {
            return Err(OutOfRange {
                what: "the rolling factor",
                expected: "1 or 5/7 for a ball on a real floor",
            });
        }
        let mut world = world(tick_s);
        world.gravity = Vector::Z * to_f32(WORLD_GRAVITY.z);
        let (radius, restitution) = (to_f32(spec.radius.units()), to_f32(spec.restitution));
        let tray = RigidBodyBuilder::kinematic_position_based();
        let floor = ColliderBuilder::cuboid(FLOOR_HALF, FLOOR_HALF, FLOOR_HALF_THICKNESS)
            .translation(Vector::Z * -FLOOR_HALF_THICKNESS)
            .restitution(0.0)
            .restitution_combine_rule(CoefficientCombineRule::Min)
            .friction(if rolls { FLOOR_FRICTION } else { 0.0 })
            .friction_combine_rule(CoefficientCombineRule::Min);
        let (tray, _) = world.insert(tray, floor);
        for wall in colliders(board, Walls::Cuboids, 2.0 * radius, 2.0 * radius)? {
            let wall = wall
                .restitution(restitution)
                .friction(0.0)
                .friction_combine_rule(CoefficientCombineRule::Min);
            world.insert_collider(wall, Some(tray));
        }
        let body = RigidBodyBuilder::dynamic().can_sleep(false).ccd_enabled(true);
        let shape = ColliderBuilder::ball(radius).restitution(restitution).friction(FLOOR_FRICTION);
        let (body, _) = world.insert(body, shape);
        Ok(Self { world, board: tray, body, spec, tick_s, placed: Some(ball) })
    }

    /// How high the ball's lowest point is above the floor (units); less than 0 when it is pressed in.
    pub fn height(&self) -> f64 {
        let tray = &self.world.bodies[self.board];
        let local = tray.rotation().inverse() * self.world.bodies[self.body].translation();
        f64::from(local.z) - self.spec.radius.units()
    }

    /// Lays the board and puts the ball onto it; a ball that rolls turns as fast as it moves.
    fn begin(&mut self, ball: Ball, tilt: Rotation) {
        self.world.bodies[self.board].set_rotation(tilt, true);
        let radius = to_f32(self.spec.radius.units());
        let velocity = in_plane(ball.velocity);
        let spin = match self.spec.rolling == BallSpec::ROLLING_SPHERE {
            true => Vector::Z.cross(velocity) / radius,
            false => Vector::ZERO,
        };
        let body = &mut self.world.bodies[self.body];
        body.set_translation(tilt * (in_plane(ball.position) + Vector::Z * radius), true);
        body.set_linvel(tilt * velocity, true);
        body.set_angvel(tilt * spin, true);
    }
}

/// The tilt without a turn about the board's normal whose projected gravity this is; upright when it is more than g.
fn tilt_for(acceleration: Vector2<f64>) -> Rotation {
    let strength = acceleration.norm();
    if strength == 0.0 {
        return Rotation::IDENTITY;
    }
    let angle = (strength / -WORLD_GRAVITY.z).min(1.0).asin();
    // Down towards +x is a turn about +y, down towards +y one about -x.
    let axis = Vector2::new(-acceleration.y, acceleration.x) / strength;
    Rotation::from_scaled_axis(in_plane(axis * angle))
}

impl Engine for RollingEngine {
    /// Counts no hits: a ball on a floor is always in contact.
    fn tick_observed(
        &mut self,
        acceleration: Vector2<f64>,
        _observer: &mut dyn Observer,
    ) -> Result<Tick, OutOfRange> {
        if !acceleration.iter().all(|value| value.is_finite()) {
            return Err(OutOfRange::not_finite("the acceleration"));
        }
        let tilt = tilt_for(acceleration);
        if let Some(ball) = self.placed.take() {
            self.begin(ball, tilt);
        }
        self.world.bodies[self.board].set_next_kinematic_rotation(tilt);
        self.world.step();
        Ok(Tick { n_steps: 1, ..Tick::default() })
    }

    fn ball(&self) -> Ball {
        if let Some(ball) = self.placed {
            return ball;
        }
        let (tray, body) = (&self.world.bodies[self.board], &self.world.bodies[self.body]);
        let maze_from_world = tray.rotation().inverse();
        let carried = tray.angvel().cross(body.translation());
        let planar = |vector: Vector| Vector2::new(f64::from(vector.x), f64::from(vector.y));
        Ball {
            position: planar(maze_from_world * body.translation()),
            velocity: planar(maze_from_world * (body.linvel() - carried)),
        }
    }

    fn place(&mut self, ball: Ball) -> Result<(), OutOfRange> {
        self.placed = Some(ball.checked()?);
        Ok(())
    }

    fn spec(&self) -> &BallSpec {
        &self.spec
    }

    fn tick_s(&self) -> f64 {
        self.tick_s
    }
}
