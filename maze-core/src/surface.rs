//! What a maze looks like, as triangles: wall, top and floor surfaces with planar texture coordinates.

/// The three kinds of surface; each has its own texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Surface {
    /// Upright sides of walls.
    Wall,
    /// Upper ends of walls.
    Top,
    /// What the ball rolls on.
    Floor,
}

impl Surface {
    /// Every surface, in the order of [`SurfaceMesh::indices`].
    pub const ALL: [Self; 3] = [Self::Wall, Self::Top, Self::Floor];
}

/// A corner of a drawn triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceVertex {
    /// Maze units, maze frame (x right, y away, z out of the board).
    pub position: [f32; 3],
    /// Unit length, out of the surface.
    pub normal: [f32; 3],
    /// Texture coordinates in maze units: walls run along x or y and z, floor and tops along x and y.
    pub uv: [f32; 2],
}

/// Triangles to draw, grouped by [`Surface`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SurfaceMesh {
    /// Shared by all three groups.
    pub vertices: Vec<SurfaceVertex>,
    /// Three indices a triangle, counter-clockwise seen from outside; one list per [`Surface::ALL`] entry.
    pub indices: [Vec<u32>; 3],
}

impl SurfaceMesh {
    /// The triangle indices of one surface.
    pub fn indices_of(&self, surface: Surface) -> &[u32] {
        &self.indices[surface as usize]
    }
}
