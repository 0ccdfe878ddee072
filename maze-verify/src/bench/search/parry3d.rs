//! parry3d's shape casts, and rapier3d's around them: in f32, along straight lines, a ball between walls of some height.

use super::{BenchError, Case, Query, Search};
use crate::bench::case::{RADIUS, TICK_S, spec};
use crate::engine::{self, RapierEngine};
use maze_core::{Bounds, Facing, Plane};
use nalgebra::Vector2;
use rapier3d::parry::query::{ShapeCastOptions, cast_shapes};
use rapier3d::parry::shape::Compound;
use rapier3d::prelude::*;

/// Half the height of the walls (units).
const HALF_HEIGHT: f32 = 0.5;

/// Walls as one shape.
struct Walls<S> {
    shape: S,
    ball: Ball,
}

impl<S: Shape> Search for Walls<S> {
    fn first_touch(&mut self, query: &Query) -> Option<f64> {
        let (at, velocity, options) = cast(query);
        let hit = cast_shapes(&Pose::IDENTITY, Vector::ZERO, &self.shape, &at, velocity, &self.ball, options);
        // The pair of shapes is one that parry casts.
        hit.ok().flatten().map(|hit| f64::from(hit.time_of_impact))
    }
}

/// A cuboid a wall under one tree.
pub(super) fn compound(case: &Case) -> Result<Box<dyn Search>, BenchError> {
    let cuboid = |wall: &Bounds| {
        let half = wall.size() / 2.0;
        (middle(wall), SharedShape::cuboid(to_f32(half.x), to_f32(half.y), HALF_HEIGHT))
    };
    let shape = Compound::new(case.rectangles().iter().map(cuboid).collect());
    Ok(Box::new(Walls { shape, ball: ball() }))
}

/// Two triangles a face.
pub(super) fn mesh(case: &Case) -> Result<Box<dyn Search>, BenchError> {
    let mut vertices = Vec::new();
    let mut triangles = Vec::new();
    for Plane { facing, offset, start, end } in case.planes_in() {
        let first = u32::try_from(vertices.len()).map_err(BenchError::set_up)?;
        for along in [start, end] {
            let point = in_plane(facing.point(offset, along));
            vertices.extend([point - Vector::Z * HALF_HEIGHT, point + Vector::Z * HALF_HEIGHT]);
        }
        let [a, b, c, d] = [first, first + 1, first + 2, first + 3];
        // Counter-clockwise seen from the front.
        let flip = matches!(facing, Facing::PlusX | Facing::MinusY);
        triangles.extend(if flip { [[a, c, b], [b, c, d]] } else { [[a, b, c], [b, d, c]] });
    }
    let shape = TriMesh::new(vertices, triangles).map_err(BenchError::set_up)?;
    Ok(Box::new(Walls { shape, ball: ball() }))
}

/// A world with a fixed collider a wall.
fn world(case: &Case) -> PhysicsWorld {
    let mut world = PhysicsWorld::default();
    for wall in case.rectangles() {
        let half = wall.size() / 2.0;
        let cuboid = ColliderBuilder::cuboid(to_f32(half.x), to_f32(half.y), HALF_HEIGHT);
        world.insert_collider(cuboid.position(middle(wall)), None);
    }
    world.step();
    world
}

/// The query pipeline, over separate colliders.
struct Pipeline(PhysicsWorld);

impl Search for Pipeline {
    fn first_touch(&mut self, query: &Query) -> Option<f64> {
        let (at, velocity, options) = cast(query);
        let hit = self.0.query_pipeline().cast_shape(&at, velocity, &ball(), options);
        hit.map(|(_, hit)| f64::from(hit.time_of_impact))
    }
}

pub(super) fn pipeline(case: &Case) -> Result<Box<dyn Search>, BenchError> {
    Ok(Box::new(Pipeline(world(case))))
}

/// The broad phase alone: which colliders' boxes the moved ball's box meets now.
struct BroadPhase(RapierEngine);

impl Search for BroadPhase {
    fn first_touch(&mut self, query: &Query) -> Option<f64> {
        let at = query.path.position + query.mean_velocity() * query.until_s;
        (0 < self.0.update_broad_phase(at)).then_some(0.0)
    }
}

pub(super) fn broad_phase(case: &Case) -> Result<Box<dyn Search>, BenchError> {
    let ball = maze_core::Ball::at(case.centre(0, 0));
    let mut engine = RapierEngine::new(case.board(), engine::Walls::Cuboids, spec(), ball, TICK_S)
        .map_err(BenchError::set_up)?;
    engine.step(Vector2::zeros());
    Ok(Box::new(BroadPhase(engine)))
}

fn ball() -> Ball {
    Ball::new(to_f32(RADIUS))
}

/// Where the ball is, how it moves, for how long.
fn cast(query: &Query) -> (Pose, Vector, ShapeCastOptions) {
    let at = Pose::from_translation(in_plane(query.path.position));
    let options = ShapeCastOptions::with_max_time_of_impact(to_f32(query.until_s));
    (at, in_plane(query.mean_velocity()), options)
}

fn middle(wall: &Bounds) -> Pose {
    Pose::from_translation(in_plane((wall.low + wall.high) / 2.0))
}

fn in_plane(vector: Vector2<f64>) -> Vector {
    Vector::new(to_f32(vector.x), to_f32(vector.y), 0.0)
}

#[allow(clippy::cast_possible_truncation, reason = "rapier computes in f32")]
fn to_f32(value: f64) -> f32 {
    value as f32
}
