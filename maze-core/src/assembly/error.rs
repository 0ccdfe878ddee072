//! Why polygons are no maze.

use crate::assembly::draft::PlanError;
use crate::navigation::ends::{Endpoint, RouteError};
use crate::physics::wall::PlaneError;
use std::fmt::{Display, Formatter};
use std::ops::RangeInclusive;

/// Fraction of the upright and slanted area that may be off axis (and is then met as steps) before the file is no maze of
/// axis-aligned walls. Rounded corners and a crooked piece stay below it.
pub(crate) const MAX_OFF_AXIS_FRACTION: f64 = 0.1;

/// Extents of a file that can be computed with (file units): squares and products of areas stay finite and above 0.
pub(crate) const SIZES: RangeInclusive<f64> = 1.0e-12..=1.0e12;

/// Widths of a corridor (units) that a scale given by the user may lead to.
pub(crate) const CORRIDORS: RangeInclusive<f64> = 0.1..=100.0;

/// What the off-axis part of a mesh mostly is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Misfit {
    /// Walls along the axes that do not stand upright.
    Leaning,
    /// Upright walls in other directions than two at right angles.
    Slanted,
    /// Faces in all directions.
    Curved,
}

impl Display for Misfit {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(match self {
            Self::Leaning => "its walls lean",
            Self::Slanted => "round or slanted walls",
            Self::Curved => "curved in all directions, as a ball or a sculpture is",
        })
    }
}

/// Why polygons are no maze.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AssembleError {
    /// There is nothing.
    #[error("no faces: expected walls")]
    NoFaces,
    /// Products of such coordinates would be infinite or nothing.
    #[error("the file is {size:e} units large: expected {low:e} to {high:e}", low = SIZES.start(), high = SIZES.end())]
    Size {
        /// Largest extent, in file units.
        size: f64,
    },
    /// No upright face along an axis.
    #[error("no walls among {n_faces} faces: expected upright faces along two axes")]
    NoWalls {
        /// Faces in the file.
        n_faces: usize,
    },
    /// It is something else than a maze of axis-aligned walls.
    #[error(
        "not a maze of axis-aligned walls ({kind}): {percent:.1} % of the area that could be wall, {percent_of_all:.1} % of \
         all, is off axis by more than 1 degree; expected at most {max:.0} %",
        max = 100.0 * MAX_OFF_AXIS_FRACTION
    )]
    OffAxis {
        /// What the off-axis part mostly is.
        kind: Misfit,
        /// Fraction of the upright and slanted area.
        percent: f64,
        /// Fraction of the area of all faces.
        percent_of_all: f64,
    },
    /// The walls stand elsewhere than on the floor.
    #[error("no wall stands at height {height} above the floor (file units, along the up axis)")]
    NothingCut {
        /// Where the walls were cut.
        height: f64,
    },
    /// A wall face is not usable.
    #[error(transparent)]
    Plane(#[from] PlaneError),
    /// The faces make no ground plan.
    #[error(transparent)]
    Occupancy(#[from] PlanError),
    /// Walls, but no space between them.
    #[error("no corridor: no two walls face each other across free space")]
    NoCorridor,
    /// The ball is too large.
    #[error("a ball of radius {radius} corridors fits nowhere in this maze: expected less than 0.5")]
    NoRoom {
        /// In corridors.
        radius: f64,
    },
    /// The scale that was asked for makes corridors too narrow or too wide.
    #[error(
        "scale {scale} makes the corridors {corridor:.4} units wide: expected {low} to {high}",
        low = CORRIDORS.start(), high = CORRIDORS.end()
    )]
    Scale {
        /// Maze units in a unit of the file.
        scale: f64,
        /// The corridors' width with it.
        corridor: f64,
    },
    /// The ball does not fit where the file's start or goal is, nor near it.
    #[error("the ball does not fit at the {end}: expected a free place between the walls")]
    NoRoomNear {
        /// Which of the two.
        end: Endpoint,
    },
    /// Start or goal lies in a wall, too near to one, or beyond the board.
    #[error(
        "the ball does not fit at ({x}, {y}): expected a start and a goal within the corridors, as `info` prints them"
    )]
    NotFree {
        /// Maze units.
        x: f64,
        /// Maze units.
        y: f64,
    },
}

impl AssembleError {
    /// Why there is no start or no goal for a ball of this radius, in corridors.
    pub(super) fn of_route(error: RouteError, radius: f64) -> Self {
        match error {
            RouteError::NoRoom => Self::NoRoom { radius },
            RouteError::NotFree(place) => Self::NotFree { x: place.x, y: place.y },
            RouteError::NoRoomNear(end) => Self::NoRoomNear { end },
        }
    }
}
