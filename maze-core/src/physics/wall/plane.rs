//! One wall face as an axis-aligned plane.

use nalgebra::Vector2;
use std::cmp::Ordering;

/// The direction of a face's outward normal. The report colours them red, green, cyan and blue.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Facing {
    /// Red: stops a ball that moves towards -x.
    PlusX,
    /// Green: stops a ball that moves towards +x.
    MinusX,
    /// Cyan: stops a ball that moves towards -y.
    PlusY,
    /// Blue: stops a ball that moves towards +y.
    MinusY,
}

impl Facing {
    /// All four, in the order of the report.
    pub const ALL: [Self; 4] = [Self::PlusX, Self::MinusX, Self::PlusY, Self::MinusY];

    /// As on the command line: `+x`, `-x`, `+y`, `-y`.
    pub fn name(self) -> &'static str {
        match self {
            Self::PlusX => "+x",
            Self::MinusX => "-x",
            Self::PlusY => "+y",
            Self::MinusY => "-y",
        }
    }

    /// Those whose normal lies along an axis, the positive one first: 0 for x, else y.
    pub(crate) const fn across(axis: usize) -> [Self; 2] {
        if axis == 0 { [Self::PlusX, Self::MinusX] } else { [Self::PlusY, Self::MinusY] }
    }

    /// The coordinate along the normal: 0 for x, 1 for y. The face extends along the other one.
    pub const fn axis(self) -> usize {
        match self {
            Self::PlusX | Self::MinusX => 0,
            Self::PlusY | Self::MinusY => 1,
        }
    }

    /// +1 or -1: the normal's component along [`Facing::axis`].
    pub const fn sign(self) -> f64 {
        match self {
            Self::PlusX | Self::PlusY => 1.0,
            Self::MinusX | Self::MinusY => -1.0,
        }
    }

    /// Unit normal, out of the wall.
    pub fn normal(self) -> Vector2<f64> {
        let mut normal = Vector2::zeros();
        normal[self.axis()] = self.sign();
        normal
    }

    /// The point at an offset along the normal's axis and a coordinate along the other.
    pub fn point(self, offset: f64, along: f64) -> Vector2<f64> {
        let mut point = Vector2::zeros();
        point[self.axis()] = offset;
        point[1 - self.axis()] = along;
        point
    }

    /// The one or two facings that a ball of this velocity can run into: at least half of all planes are never visited.
    pub fn opposing(velocity: Vector2<f64>) -> impl Iterator<Item = Self> {
        Self::ALL.into_iter().filter(move |facing| velocity[facing.axis()] * facing.sign() < 0.0)
    }
}

/// A wall face: the points with `offset` along the normal's axis and `start..=end` along the other.
///
/// It stops a ball from its front only; from behind a ball passes. So give every wall all its faces: a block is four planes whose
/// normals point outwards, a wall without thickness two at one place with opposite normals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Its outward normal.
    pub facing: Facing,
    /// Coordinate along the normal's axis (maze units).
    pub offset: f64,
    /// Lower end along the other axis; less than `end`.
    pub start: f64,
    /// Upper end along the other axis.
    pub end: f64,
}

/// Why a plane cannot be used.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PlaneError {
    /// A coordinate is NaN or infinite.
    #[error("plane {index} ({facing}): a coordinate is not finite", facing = .plane.facing.name())]
    NonFinite {
        /// Which one, counted from 0 in the input.
        index: usize,
        /// As given.
        plane: Plane,
    },
    /// It has no extent.
    #[error("plane {index} ({facing}) starts at {start} and ends at {end}: expected start < end",
        facing = .plane.facing.name(), start = .plane.start, end = .plane.end)]
    Empty {
        /// Which one, counted from 0 in the input.
        index: usize,
        /// As given.
        plane: Plane,
    },
    /// More than an index can tell apart.
    #[error("more than 268435456 planes of one facing")]
    TooMany,
}

impl Plane {
    /// How far `along` lies outside the extent; 0 within.
    pub fn gap(&self, along: f64) -> f64 {
        if along < self.start {
            self.start - along
        } else if self.end < along {
            along - self.end
        } else {
            0.0
        }
    }

    /// Which of two planes of one row, that do not overlap, is nearer to `along`; the lower one on a tie.
    ///
    /// Told without rounding where both lie on the same side of it, however near they are to each other.
    pub(crate) fn compare_distance(&self, other: &Self, along: f64) -> Ordering {
        match (self.end < along, other.end < along, along < self.start, along < other.start) {
            (true, true, ..) => other.end.total_cmp(&self.end),
            (_, _, true, true) => self.start.total_cmp(&other.start),
            _ => self.gap(along).total_cmp(&other.gap(along)).then(self.start.total_cmp(&other.start)),
        }
    }

    /// Checks what [`crate::SortedPlanes`] relies on; `index` names the plane in the error.
    pub(crate) fn checked(self, index: usize) -> Result<Self, PlaneError> {
        if ![self.offset, self.start, self.end].iter().all(|value| value.is_finite()) {
            return Err(PlaneError::NonFinite { index, plane: self });
        }
        if self.start < self.end { Ok(self) } else { Err(PlaneError::Empty { index, plane: self }) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_faces_that_oppose_the_velocity_are_visited() {
        let names = |x, y| Facing::opposing(Vector2::new(x, y)).map(Facing::name).collect::<Vec<_>>();
        assert_eq!(names(-1.0, 0.0), ["+x"]);
        assert_eq!(names(1.0, 2.0), ["-x", "-y"]);
        assert_eq!(names(0.5, -2.0), ["-x", "+y"]);
        assert!(names(0.0, 0.0).is_empty());
    }
}
