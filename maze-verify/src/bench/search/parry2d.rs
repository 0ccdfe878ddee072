//! parry2d's shape casts, in f32, along straight lines.

use super::{BenchError, Case, Query, Search};
use crate::bench::case::RADIUS;
use parry2d::math::{Pose, Vector};
use parry2d::query::{ShapeCastOptions, cast_shapes};
use parry2d::shape::{Ball, Compound, Shape, SharedShape, TriMesh};

/// Walls as one shape.
struct Walls<S> {
    shape: S,
    ball: Ball,
}

impl<S: Shape> Search for Walls<S> {
    fn first_touch(&mut self, query: &Query) -> Option<f64> {
        let (from, velocity) = (query.path.position, query.mean_velocity());
        let options = ShapeCastOptions::with_max_time_of_impact(to_f32(query.until_s));
        let (walls, ball) = (&self.shape, &self.ball);
        let at = Pose::translation(to_f32(from.x), to_f32(from.y));
        let velocity = Vector::new(to_f32(velocity.x), to_f32(velocity.y));
        let hit = cast_shapes(&Pose::IDENTITY, Vector::ZERO, walls, &at, velocity, ball, options);
        // The pair of shapes is one that parry casts.
        hit.ok().flatten().map(|hit| f64::from(hit.time_of_impact))
    }
}

/// A cuboid a wall under one tree.
pub(super) fn compound(case: &Case) -> Result<Box<dyn Search>, BenchError> {
    let cuboid = |wall: &maze_core::Bounds| {
        let (half, middle) = (wall.size() / 2.0, (wall.low + wall.high) / 2.0);
        let at = Pose::translation(to_f32(middle.x), to_f32(middle.y));
        (at, SharedShape::cuboid(to_f32(half.x), to_f32(half.y)))
    };
    let shape = Compound::new(case.rectangles().iter().map(cuboid).collect());
    Ok(Box::new(Walls { shape, ball: Ball::new(to_f32(RADIUS)) }))
}

/// Two triangles a wall.
pub(super) fn mesh(case: &Case) -> Result<Box<dyn Search>, BenchError> {
    let mut vertices = Vec::new();
    let mut triangles = Vec::new();
    for wall in case.rectangles() {
        let first = u32::try_from(vertices.len()).map_err(BenchError::set_up)?;
        let [[x0, y0], [x1, y1]] = [wall.low, wall.high].map(|corner| [to_f32(corner.x), to_f32(corner.y)]);
        vertices.extend([(x0, y0), (x1, y0), (x1, y1), (x0, y1)].map(|(x, y)| Vector::new(x, y)));
        triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    }
    let shape = TriMesh::new(vertices, triangles).map_err(BenchError::set_up)?;
    Ok(Box::new(Walls { shape, ball: Ball::new(to_f32(RADIUS)) }))
}

#[allow(clippy::cast_possible_truncation, reason = "parry computes in f32")]
fn to_f32(value: f64) -> f32 {
    value as f32
}
