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

/// Polygons of any number of corners, counter-clockwise seen from outside.
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
    /// `None` when a position is not finite or there are more than `u32::MAX`.
    pub fn new(positions: Vec<Vector3<f64>>) -> Option<Self> {
        let usable = u32::try_from(positions.len()).is_ok()
            && positions.iter().all(|position| position.iter().all(|value| value.is_finite()));
        usable.then_some(Self { positions, corners: Vec::new(), face_ends: Vec::new() })
    }

    /// Makes room, so that faces can be appended without moving those that are there.
    pub fn reserve(&mut self, n_faces: usize, n_corners: usize) {
        self.face_ends.reserve_exact(n_faces);
        self.corners.reserve_exact(n_corners);
    }

    /// Appends a polygon; false (and nothing appended) when a corner is no position, or at 2^32 corners.
    #[must_use]
    pub fn push_face(&mut self, corners: &[u32]) -> bool {
        let known = corners.iter().all(|&corner| (corner as usize) < self.positions.len());
        let end = u32::try_from(self.corners.len() + corners.len());
        let (true, Ok(end)) = (known, end) else { return false };
        self.corners.extend_from_slice(corners);
        self.face_ends.push(end);
        true
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
