//! Polygon meshes: what importers and the generator hand to the assembly of a maze.

use nalgebra::Vector3;

/// Which axis of a file points out of the board.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UpAxis {
    /// +x.
    X,
    /// +y, as most modelling programs write it.
    Y,
    /// +z, as slicers and CAD programs write it.
    Z,
}

impl UpAxis {
    /// `x`, `y` or `z`.
    pub fn name(self) -> &'static str {
        match self {
            Self::X => "x",
            Self::Y => "y",
            Self::Z => "z",
        }
    }

    /// The point turned so that this axis becomes +z. A rotation: nothing gets mirrored.
    pub fn turned_to_z(self, point: Vector3<f64>) -> Vector3<f64> {
        match self {
            Self::X => Vector3::new(point.y, point.z, point.x),
            Self::Y => Vector3::new(point.x, -point.z, point.y),
            Self::Z => point,
        }
    }
}

/// Twice the area of a polygon as a vector along its normal (Newell's method: exact for flat polygons, a mean for others).
///
/// Taken from the first corner, so that a polygon far from the origin loses no digits.
pub(crate) fn doubled_area(corners: &[Vector3<f64>]) -> Vector3<f64> {
    let Some(&first) = corners.first() else { return Vector3::zeros() };
    corners.windows(2).map(|pair| (pair[0] - first).cross(&(pair[1] - first))).sum()
}

/// Why a mesh is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum MeshError {
    /// A coordinate is NaN or infinite.
    #[error("position {index}: a coordinate is not finite")]
    NotFinite {
        /// Which one, counted from 0.
        index: usize,
    },
    /// A corner that is no position.
    #[error("corner {index}: expected less than {n_positions}, the number of positions")]
    NoPosition {
        /// As given.
        index: u32,
        /// How many there are.
        n_positions: usize,
    },
    /// More than 32 bits can count.
    #[error("more than 2^32 positions or corners")]
    TooMany,
}

/// Polygons of any number of corners, counter-clockwise seen from outside.
///
/// ```
/// use maze_core::nalgebra::Vector3;
/// use maze_core::{AssembleOptions, Maze, PolygonMesh};
///
/// // Four walls around a room of 4 x 3 units, as boxes without top and bottom.
/// let boxes = [[0.0, 0.0, 4.2, 0.2], [0.0, 3.2, 4.2, 3.4], [0.0, 0.2, 0.2, 3.2], [4.0, 0.2, 4.2, 3.2]];
/// let corners = |[left, low, right, high]: [f64; 4]| {
///     let plan = [[left, low], [right, low], [right, high], [left, high]];
///     [0.0, 0.5].map(|z| plan.map(|[x, y]| Vector3::new(x, y, z))).concat()
/// };
/// let mut mesh = PolygonMesh::new(boxes.into_iter().flat_map(corners).collect())?;
/// for first in [0, 8, 16, 24] {
///     for side in [[0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]] {
///         mesh.push_face(&side.map(|corner| first + corner))?;
///     }
/// }
/// let maze = Maze::from_polygons(&mesh, &AssembleOptions::default())?;
/// assert_eq!(maze.planes.len(), 4); // those that the ball can meet
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// Invariant: every corner is an index into `positions`, and every position is finite.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PolygonMesh {
    positions: Vec<Vector3<f64>>,
    corners: Vec<u32>,
    face_ends: Vec<u32>,
}

impl PolygonMesh {
    /// A mesh without faces.
    ///
    /// # Errors
    /// A position that is not finite, or more than `u32::MAX` of them.
    pub fn new(positions: Vec<Vector3<f64>>) -> Result<Self, MeshError> {
        if u32::try_from(positions.len()).is_err() {
            return Err(MeshError::TooMany);
        }
        let is_bad = |position: &Vector3<f64>| !position.iter().all(|value| value.is_finite());
        match positions.iter().position(is_bad) {
            Some(index) => Err(MeshError::NotFinite { index }),
            None => Ok(Self { positions, corners: Vec::new(), face_ends: Vec::new() }),
        }
    }

    /// Makes room, so that faces can be appended without moving those that are there.
    pub fn reserve(&mut self, n_faces: usize, n_corners: usize) {
        self.face_ends.reserve_exact(n_faces);
        self.corners.reserve_exact(n_corners);
    }

    /// Appends a polygon, as indices of its corners' positions.
    ///
    /// # Errors
    /// An index of no position, or more than 2^32 corners in all; nothing is appended.
    pub fn push_face(&mut self, corners: &[u32]) -> Result<(), MeshError> {
        if let Some(&index) = corners.iter().find(|corner| self.positions.len() <= **corner as usize) {
            return Err(MeshError::NoPosition { index, n_positions: self.positions.len() });
        }
        let end = u32::try_from(self.corners.len() + corners.len()).map_err(|_| MeshError::TooMany)?;
        self.corners.extend_from_slice(corners);
        self.face_ends.push(end);
        Ok(())
    }

    /// All corners' positions.
    pub fn positions(&self) -> &[Vector3<f64>] {
        &self.positions
    }

    /// Number of polygons.
    pub fn n_faces(&self) -> usize {
        self.face_ends.len()
    }

    /// The polygons as indices into [`PolygonMesh::positions`].
    pub fn faces(&self) -> impl Iterator<Item = &[u32]> {
        let starts = std::iter::once(0).chain(self.face_ends.iter().copied());
        starts.zip(&self.face_ends).map(|(start, &end)| &self.corners[start as usize..end as usize])
    }
}
