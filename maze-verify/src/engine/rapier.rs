//! rapier3d as a [`maze_core::Engine`], held in the plane: gravity is projected for it, as for our engines.

use super::without_resistance;
use crate::board::Board;
use maze_core::{Ball, BallSpec, Engine, OutOfRange, Tick};
use nalgebra::Vector2;
use rapier3d::prelude::*;

/// What rapier is given as walls.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Walls {
    /// A cuboid for each rectangle of the board.
    Cuboids,
    /// One triangle mesh, with the contacts at its inner edges mended ([`TriMeshFlags::FIX_INTERNAL_EDGES`]).
    TriangleMesh,
}

/// A ball among fixed walls, held in the plane: what rapier makes of the same scene.
///
/// rapier computes in f32. The ball neither turns nor sleeps, and nothing rubs, as in maze-core; rapier's restitution is
/// the mean of both colliders', so both get the ball's; its bound on the speed (400 units/s) is lifted.
pub struct RapierEngine {
    world: PhysicsWorld,
    body: RigidBodyHandle,
    collider: ColliderHandle,
    spec: BallSpec,
    tick_s: f64,
}

/// Half the height of walls (units): any height that the ball's centre stays well inside of.
const HALF_HEIGHT: f32 = 0.5;

impl RapierEngine {
    /// `tick_s` is rapier's step (s).
    ///
    /// # Errors
    /// A position or velocity that is not finite; walls that rapier makes no mesh of.
    pub fn new(
        board: &Board,
        walls: Walls,
        spec: BallSpec,
        ball: Ball,
        tick_s: f64,
    ) -> Result<Self, OutOfRange> {
        let (ball, spec) = (ball.checked()?, without_resistance(spec)?);
        let restitution = to_f32(spec.restitution);
        let mut world = world(tick_s);
        for wall in colliders(board, walls, HALF_HEIGHT, 0.0)? {
            world.insert_collider(wall.restitution(restitution).friction(0.0), None);
        }
        let body = RigidBodyBuilder::dynamic()
            .translation(in_plane(ball.position))
            .linvel(in_plane(ball.velocity))
            .enabled_translations(true, true, false)
            .lock_rotations()
            .can_sleep(false);
        let shape = ColliderBuilder::ball(to_f32(spec.radius.units())).restitution(restitution).friction(0.0);
        let (body, collider) = world.insert(body, shape);
        Ok(Self { world, body, collider, spec, tick_s })
    }

    /// How far off a wall its contacts begin (units), rapier's margin for fast bodies; 0.02 as it comes. At a corner such an
    /// early contact has the direction of a touch that has not happened yet.
    pub fn set_prediction_distance(&mut self, units: f64) {
        self.world.integration_parameters.normalized_prediction_distance = to_f32(units);
    }

    /// How deep the ball reaches into a wall now (units), by rapier's own contacts.
    pub fn penetration(&self) -> f64 {
        let pairs = self.world.narrow_phase.contact_pairs_with(self.collider);
        let depths = pairs.filter_map(|pair| pair.find_deepest_contact().map(|(_, contact)| -contact.dist));
        f64::from(depths.fold(0.0, f32::max))
    }
}

impl Engine for RapierEngine {
    /// `n_hits` is 1 when a velocity component changed its sign against the acceleration, as only a bounce makes it.
    fn tick(&mut self, acceleration: Vector2<f64>) -> Result<Tick, OutOfRange> {
        if !acceleration.iter().all(|value| value.is_finite()) {
            return Err(OutOfRange::not_finite("the acceleration"));
        }
        let before = self.ball().velocity;
        self.world.gravity = in_plane(acceleration * self.spec.rolling);
        self.world.step();
        let after = self.ball().velocity;
        let bounced =
            |axis: usize| before[axis] * after[axis] < 0.0 && 0.0 <= before[axis] * acceleration[axis];
        let speeds = [0, 1].into_iter().filter(|axis| bounced(*axis)).map(|axis| before[axis].abs());
        let hardest_hit_speed = speeds.fold(0.0, f64::max);
        Ok(Tick {
            n_steps: 1,
            n_hits: u32::from(0.0 < hardest_hit_speed),
            hardest_hit_speed,
            deepest_penetration: self.penetration(),
            ..Tick::default()
        })
    }

    fn ball(&self) -> Ball {
        let body = &self.world.bodies[self.body];
        let planar = |vector: Vector| Vector2::new(f64::from(vector.x), f64::from(vector.y));
        Ball { position: planar(body.translation()), velocity: planar(body.linvel()) }
    }

    fn place(&mut self, ball: Ball) -> Result<(), OutOfRange> {
        let ball = ball.checked()?;
        let body = &mut self.world.bodies[self.body];
        body.set_translation(in_plane(ball.position), true);
        body.set_linvel(in_plane(ball.velocity), true);
        Ok(())
    }

    fn spec(&self) -> &BallSpec {
        &self.spec
    }

    fn tick_s(&self) -> f64 {
        self.tick_s
    }
}

/// A world that steps by `tick_s`, as rapier comes, but without its bound on the speed.
pub(super) fn world(tick_s: f64) -> PhysicsWorld {
    let mut world = PhysicsWorld::default();
    world.integration_parameters.dt = to_f32(tick_s);
    world.integration_parameters.normalized_max_linear_velocity = f32::MAX;
    world
}

/// The walls of a board, from `middle - half_height` to `middle + half_height`.
pub(super) fn colliders(
    board: &Board,
    walls: Walls,
    half_height: f32,
    middle: f32,
) -> Result<Vec<ColliderBuilder>, OutOfRange> {
    if walls == Walls::Cuboids {
        let cuboid = |wall: &maze_core::Bounds| {
            let (half, at) = (wall.size() / 2.0, in_plane((wall.low + wall.high) / 2.0));
            ColliderBuilder::cuboid(to_f32(half.x), to_f32(half.y), half_height)
                .translation(at + Vector::Z * middle)
        };
        return Ok(board.rectangles().iter().map(cuboid).collect());
    }
    let mesh = board.mesh();
    if mesh.triangles.is_empty() {
        return Ok(Vec::new());
    }
    let vertex =
        |[x, y, z]: [f64; 3]| in_plane(Vector2::new(x, y)) + Vector::Z * (middle + half_height * to_f32(z));
    let vertices = mesh.vertices.into_iter().map(vertex).collect();
    let flags = TriMeshFlags::FIX_INTERNAL_EDGES;
    ColliderBuilder::trimesh_with_flags(vertices, mesh.triangles, flags).map(|mesh| vec![mesh]).map_err(
        |_| OutOfRange { what: "the walls", expected: "a shape that rapier makes a triangle mesh of" },
    )
}

pub(super) fn in_plane(vector: Vector2<f64>) -> Vector {
    Vector::new(to_f32(vector.x), to_f32(vector.y), 0.0)
}

#[allow(clippy::cast_possible_truncation, reason = "rapier computes in f32")]
pub(super) fn to_f32(value: f64) -> f32 {
    value as f32
}
