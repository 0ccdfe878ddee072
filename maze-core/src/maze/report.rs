//! What was found in a file, changed and left out.

use crate::assembly::polygons::UpAxis;
use crate::physics::ball::Radius;
use nalgebra::Vector2;
use std::fmt::{Display, Formatter};

/// Why faces of a file are not used, or used otherwise than they are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FaceReason {
    /// The lower sides of walls and board.
    LooksDown,
    /// Fewer than three corners in different places, or all on one line.
    NoArea,
    /// Not along an axis, and above or below the height at which the plan is sliced.
    OffAxisBeyondCut,
    /// Nearly along an axis.
    SnappedToAxis,
    /// Not along an axis: replaced by steps.
    SteppedAlongAxes,
    /// A lid over the corridors.
    Roof,
    /// Walls so low that the ball rolls over them.
    RolledOver,
    /// Low walls that are not closed.
    LowAndOpen,
}

impl Display for FaceReason {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(match self {
            Self::LooksDown => "looks down: never seen and never met",
            Self::NoArea => "no area",
            Self::OffAxisBeyondCut => "off axis, above or below where the walls are met: drawn, never met",
            Self::SnappedToAxis => "off axis by up to 1 degree: snapped to it",
            Self::SteppedAlongAxes => "off axis by more than 1 degree: met as steps along the axes",
            Self::Roof => "a roof over the corridors: not drawn",
            Self::RolledOver => "lower than a fifth of the ball's radius: drawn, and rolled over",
            Self::LowAndOpen => "lower than the walls are cut, and not closed: drawn, never met",
        })
    }
}

/// Faces of a file that the maze does not use, or not as they are.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct FaceNote {
    /// Why they are ignored, or how they were changed.
    pub reason: FaceReason,
    /// How many.
    pub n_faces: usize,
    /// The first of them, counted from 0 in the order of the mesh.
    pub first_face: usize,
    /// Their fraction of the area of all faces, 0..=1.
    pub area_fraction: f64,
    /// Whether they are drawn although the ball never meets them, which a player has to know.
    pub is_unmet: bool,
}

/// What was found in the file of a maze, changed and left out; for a generated maze it holds the defaults.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ImportReport {
    /// Which axis of the file points out of the board.
    pub up_axis: UpAxis,
    /// Maze units in a unit of the file.
    pub scale: f64,
    /// Whether the file has a floor; else one was laid.
    pub has_floor: bool,
    /// Where the walls' x axis points in the file, across its up axis, before they were turned back; unit length, (1, 0)
    /// when they were not turned.
    pub turned: Vector2<f64>,
    /// Faces that were not used, and why.
    pub ignored: Vec<FaceNote>,
    /// Faces that were used otherwise than they are, and how.
    pub adjusted: Vec<FaceNote>,
    /// Wall coordinates nearer than this (units) were merged.
    pub merged_within: Option<f64>,
    /// Walls of the file without thickness were made this thick (units).
    pub thickened_to: Option<f64>,
    /// Fraction of the plan, 0..=1, on which a face is missing in the file and the other sides decided what is wall.
    pub doubtful_fraction: f64,
    /// Where no path leads from start to goal for the requested ball, or for the usual one: the largest ball that has one, in
    /// corridors and steps of 0.01, with 0.01 to spare. The maze is played with it unless another one was requested.
    pub passing_radius: Option<Radius>,
}
