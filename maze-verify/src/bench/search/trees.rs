//! Trees of boxes: rstar and bvh find what is near, maze-core's functions compute when it is touched.
//!
//! A long path is asked for piece by piece, so that what lies behind the first touch is not asked for.

use super::{BenchError, Case, Query, Search};
use crate::bench::case::{RADIUS, WallFace};
use bvh::aabb::{Aabb, Bounded};
use bvh::bounding_hierarchy::BHShape;
use bvh::bvh::Bvh;
use maze_core::time_of_impact;
use nalgebra::{Point2, Vector2};
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

/// How far from the centre something can be that is touched; wider than any rounding.
const REACH: f64 = RADIUS * (1.0 + 1.0e-6);

/// Longest stretch whose box is asked for at once (units): about a corridor.
const PIECE: f64 = 1.0;

/// Lower left and upper right of a face.
fn ends(face: &WallFace) -> [Vector2<f64>; 2] {
    [face.plane.start, face.plane.end].map(|along| face.plane.facing.point(face.plane.offset, along))
}

/// The earliest touch, from what `near` finds in the box around each piece of the path.
fn first_touch(query: &Query, near: impl Fn([Vector2<f64>; 2], &mut dyn FnMut(&WallFace))) -> Option<f64> {
    let Query { path, until_s, .. } = query;
    // A parabola strays this far from its chord.
    let sag = path.acceleration.abs() * (until_s * until_s / 8.0);
    let n_pieces = (query.mean_velocity().norm() * until_s / PIECE).ceil().max(1.0);
    let mut best = f64::INFINITY;
    let (mut piece, mut from) = (0.0, path.position);
    while piece < n_pieces {
        piece += 1.0;
        let end_s = piece / n_pieces * until_s;
        let to = path.at(end_s);
        let around = sag.add_scalar(REACH);
        near([from.inf(&to) - around, from.sup(&to) + around], &mut |face| {
            best = best.min(touch(query, face));
        });
        if best <= end_s {
            break;
        }
        from = to;
    }
    (best <= *until_s).then_some(best)
}

/// When a face or one of its corners is touched (s), without end when it is not.
fn touch(query: &Query, face: &WallFace) -> f64 {
    let Query { path, until_s, .. } = query;
    let mut best = time_of_impact::face(path, RADIUS, &face.plane).unwrap_or(f64::INFINITY);
    for (point, is_corner) in ends(face).into_iter().zip(face.is_corner) {
        if is_corner && can_touch(query, point) {
            best = best.min(time_of_impact::corner(path, RADIUS, point, *until_s).unwrap_or(f64::INFINITY));
        }
    }
    best
}

/// Whether a point lies as near to the chord as the path and the circle can come: culls most of those that are passed.
fn can_touch(query: &Query, point: Vector2<f64>) -> bool {
    let chord = query.mean_velocity() * query.until_s;
    let sag = query.path.acceleration.norm() * (query.until_s * query.until_s / 8.0);
    let aside = (point - query.path.position).perp(&chord);
    aside * aside <= (REACH + sag) * (REACH + sag) * chord.norm_squared()
}

type Leaf = GeomWithData<Rectangle<[f64; 2]>, WallFace>;

impl Search for RTree<Leaf> {
    fn first_touch(&mut self, query: &Query) -> Option<f64> {
        first_touch(query, |[low, high], visit| {
            let around = AABB::from_corners(low.into(), high.into());
            self.locate_in_envelope_intersecting(around).for_each(|leaf| visit(&leaf.data));
        })
    }
}

pub(super) fn rstar(case: &Case) -> Result<Box<dyn Search>, BenchError> {
    let leaf = |face: &WallFace| {
        let [low, high] = ends(face);
        Leaf::new(Rectangle::from_corners(low.into(), high.into()), *face)
    };
    Ok(Box::new(RTree::bulk_load(case.faces().iter().map(leaf).collect())))
}

/// A face and its place in the tree.
struct Shape {
    face: WallFace,
    node: usize,
}

impl Bounded<f64, 2> for Shape {
    fn aabb(&self) -> Aabb<f64, 2> {
        let [low, high] = ends(&self.face).map(Point2::from);
        Aabb::with_bounds(low, high)
    }
}

impl BHShape<f64, 2> for Shape {
    fn set_bh_node_index(&mut self, node: usize) {
        self.node = node;
    }

    fn bh_node_index(&self) -> usize {
        self.node
    }
}

/// A tree of the crate bvh.
struct Tree {
    shapes: Vec<Shape>,
    tree: Bvh<f64, 2>,
}

impl Search for Tree {
    fn first_touch(&mut self, query: &Query) -> Option<f64> {
        first_touch(query, |[low, high], visit| {
            let around = Aabb::with_bounds(low.into(), high.into());
            self.tree.traverse_iterator(&around, &self.shapes).for_each(|shape| visit(&shape.face));
        })
    }
}

pub(super) fn bvh(case: &Case) -> Result<Box<dyn Search>, BenchError> {
    let mut shapes: Vec<Shape> = case.faces().iter().map(|face| Shape { face: *face, node: 0 }).collect();
    let tree = Bvh::build(&mut shapes);
    Ok(Box::new(Tree { shapes, tree }))
}
