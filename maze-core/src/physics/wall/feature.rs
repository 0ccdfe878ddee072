//! Contact features: what of a wall a circle can touch.

use crate::physics::wall::Plane;
use nalgebra::Vector2;

/// What of a wall a circle can touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Feature {
    /// A face, within its extent.
    Face(Plane),
    /// The end of a face: the corner of a wall, or the free end of one without thickness.
    Point(Vector2<f64>),
}

impl Feature {
    /// The unit normal towards a circle's centre that touches it; `None` for a centre on the point itself.
    pub fn normal_at(&self, centre: Vector2<f64>) -> Option<Vector2<f64>> {
        match self {
            Self::Face(plane) => Some(plane.facing.normal()),
            Self::Point(point) => (centre - point).try_normalize(0.0),
        }
    }

    /// The point of it at which a circle there touches it.
    pub fn contact_point(&self, centre: Vector2<f64>) -> Vector2<f64> {
        match self {
            Self::Face(plane) => plane.facing.point(plane.offset, centre[1 - plane.facing.axis()]),
            Self::Point(point) => *point,
        }
    }

    /// Orders features at one distance from a centre, as two an ulp apart may be: less is farther towards the centre. The order is
    /// the same in a scene that is mirrored or turned.
    pub(crate) fn prominence(&self, centre: Vector2<f64>) -> [f64; 4] {
        let point = self.contact_point(centre);
        let away = centre - point;
        let [large, small] = if away.x.abs() < away.y.abs() { [1, 0] } else { [0, 1] };
        let inward = |axis: usize| match away[axis] {
            away if 0.0 < away => -point[axis],
            away if away < 0.0 => point[axis],
            _ => 0.0,
        };
        [away[large].abs(), away[small].abs(), inward(large), inward(small)]
    }

    /// The centre of the circle that touches it exactly, from one that does so but for rounding.
    ///
    /// On a face never inside by an ulp: else each point of a neighbour on the same line would be hit.
    pub(crate) fn touching(&self, centre: Vector2<f64>, normal: Vector2<f64>, radius: f64) -> Vector2<f64> {
        match self {
            Self::Face(plane) => {
                let (axis, sign) = (plane.facing.axis(), plane.facing.sign());
                let mut centre = centre;
                centre[axis] = plane.offset + sign * radius;
                if (centre[axis] - plane.offset) * sign < radius {
                    centre[axis] = if sign < 0.0 { centre[axis].next_down() } else { centre[axis].next_up() };
                }
                centre
            }
            Self::Point(point) => point + normal * radius,
        }
    }
}
