//! What a maze looks like, as triangles: wall, top and floor surfaces with planar texture coordinates.

use crate::assembly::polygons::doubled_area;
use crate::physics::bounds::Bounds;
use crate::physics::wall::Plane;
use earcut::Earcut;
use nalgebra::Vector3;

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

    /// `wall`, `top` or `floor`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Wall => "wall",
            Self::Top => "top",
            Self::Floor => "floor",
        }
    }
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

/// Collects polygons into a [`SurfaceMesh`].
#[derive(Default)]
pub(crate) struct SurfaceBuilder {
    mesh: SurfaceMesh,
    earcut: Earcut<f64>,
}

/// How high the bar across an opening stands, as a fraction of the wall height: seen, and not taken for a wall.
const THRESHOLD_FRACTION: f64 = 0.4;
/// How thick it is (units): about a wall of a generated maze.
const THRESHOLD_DEPTH: f64 = 0.15;
/// How far inwards of an opening a floor is laid (units), because some files end the floor at the inside of the wall.
const DOORSTEP: f64 = 1.0;
/// How far below the file's own floor it lies (units): hidden wherever there is one.
const DOORSTEP_DROP: f64 = 0.01;

impl SurfaceBuilder {
    /// A flat polygon of any shape, counter-clockwise seen from outside. One without area adds nothing.
    pub(crate) fn polygon(&mut self, surface: Surface, corners: &[Vector3<f64>]) {
        let Some(normal) = doubled_area(corners).try_normalize(0.0) else { return };
        // Seen along the axis that the normal follows most, in a right-handed pair of the other two.
        let axis = normal.iamax();
        let [mut u, mut v] = [(axis + 1) % 3, (axis + 2) % 3];
        if normal[axis] < 0.0 {
            (u, v) = (v, u);
        }
        let mut triangles: Vec<u32> = Vec::new();
        self.earcut.earcut(corners.iter().map(|corner| [corner[u], corner[v]]), &[], &mut triangles);
        let Ok(base) = u32::try_from(self.mesh.vertices.len()) else { return };
        let uv = |corner: &Vector3<f64>| match (surface, axis) {
            (Surface::Wall, 0) => [corner.y, corner.z],
            (Surface::Wall, 1) => [corner.x, corner.z],
            _ => [corner.x, corner.y],
        };
        let vertices = corners.iter().map(|corner| SurfaceVertex {
            position: to_f32(corner.as_ref()),
            normal: to_f32(normal.as_ref()),
            uv: to_f32(&uv(corner)),
        });
        self.mesh.vertices.extend(vertices);
        let indices = &mut self.mesh.indices[surface as usize];
        // Earcut does not promise a direction: turn each triangle to face along the normal.
        for triangle in triangles.chunks_exact(3) {
            let [a, b, c] = [0, 1, 2].map(|corner| corners[triangle[corner] as usize]);
            let faces_out = 0.0 <= (b - a).cross(&(c - a)).dot(&normal);
            let order = if faces_out { [0, 1, 2] } else { [0, 2, 1] };
            indices.extend(order.map(|corner| base + triangle[corner]));
        }
    }

    /// Makes room for so many corners of triangles and quads.
    pub(crate) fn reserve(&mut self, n_corners: usize) {
        self.mesh.vertices.reserve_exact(n_corners);
    }

    /// A wall face from the floor up.
    pub(crate) fn side(&mut self, plane: &Plane, height: f64) {
        let axis = plane.facing.axis();
        let mut corners = [(plane.start, 0.0), (plane.end, 0.0), (plane.end, height), (plane.start, height)]
            .map(|(along, z)| {
                let mut corner = Vector3::new(0.0, 0.0, z);
                corner[axis] = plane.offset;
                corner[1 - axis] = along;
                corner
            });
        let outward = (corners[1] - corners[0]).cross(&(corners[2] - corners[0]))[axis];
        if outward * plane.facing.sign() < 0.0 {
            corners.reverse();
        }
        self.polygon(Surface::Wall, &corners);
    }

    /// A floor under the whole maze.
    pub(crate) fn floor(&mut self, bounds: Bounds) {
        let corner = |x, y| Vector3::new(x, y, 0.0);
        let (low, high) = (bounds.low, bounds.high);
        let corners =
            [corner(low.x, low.y), corner(high.x, low.y), corner(high.x, high.y), corner(low.x, high.y)];
        self.polygon(Surface::Floor, &corners);
    }

    /// A low bar across an opening of the outer wall, where the frame stops the ball, and a floor to stand on before it.
    pub(crate) fn threshold(&mut self, opening: &Plane, wall_height: f64) {
        let axis = opening.facing.axis();
        let height = THRESHOLD_FRACTION * wall_height;
        let outside = opening.offset - opening.facing.sign() * THRESHOLD_DEPTH;
        let inside = opening.offset + opening.facing.sign() * DOORSTEP;
        let corner = |across: f64, along: f64, z: f64| {
            let mut corner = Vector3::new(0.0, 0.0, z);
            corner[axis] = across;
            corner[1 - axis] = along;
            corner
        };
        let upright = |across: f64| {
            [(opening.start, 0.0), (opening.end, 0.0), (opening.end, height), (opening.start, height)]
                .map(|(along, z)| corner(across, along, z))
        };
        let top = [
            corner(opening.offset, opening.start, height),
            corner(opening.offset, opening.end, height),
            corner(outside, opening.end, height),
            corner(outside, opening.start, height),
        ];
        let doorstep = [
            corner(opening.offset, opening.start, -DOORSTEP_DROP),
            corner(opening.offset, opening.end, -DOORSTEP_DROP),
            corner(inside, opening.end, -DOORSTEP_DROP),
            corner(inside, opening.start, -DOORSTEP_DROP),
        ];
        for (surface, corners, normal) in [
            (Surface::Floor, doorstep, 1.0),
            (Surface::Wall, upright(opening.offset), opening.facing.sign()),
            (Surface::Wall, upright(outside), -opening.facing.sign()),
            (Surface::Top, top, 1.0),
        ] {
            let doubled = (corners[1] - corners[0]).cross(&(corners[2] - corners[0]));
            let faces = if surface == Surface::Wall { doubled[axis] } else { doubled.z };
            let corners = if faces * normal < 0.0 { [3, 2, 1, 0].map(|i| corners[i]) } else { corners };
            self.polygon(surface, &corners);
        }
    }

    pub(crate) fn finish(self) -> SurfaceMesh {
        self.mesh
    }
}

/// Drawing needs no more than f32.
#[allow(clippy::cast_possible_truncation, reason = "rounding to f32 is the purpose")]
fn to_f32<const N: usize>(values: &[f64; N]) -> [f32; N] {
    values.map(|value| value as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(mesh: &SurfaceMesh, surface: Surface) -> f32 {
        let corner = |index: u32| Vector3::from(mesh.vertices[index as usize].position);
        let of_triangle = |triangle: &[u32]| {
            let [a, b, c] = [0, 1, 2].map(|i| corner(triangle[i]));
            let normal = Vector3::from(mesh.vertices[triangle[0] as usize].normal);
            (b - a).cross(&(c - a)).dot(&normal) / 2.0
        };
        mesh.indices_of(surface).chunks(3).map(of_triangle).sum()
    }

    #[test]
    fn a_concave_polygon_keeps_its_area_and_direction() {
        let shape =
            [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [3.0, 4.0], [3.0, 1.0], [1.0, 1.0], [1.0, 4.0], [0.0, 4.0]];
        for (axis, sign) in [(0, 1.0), (0, -1.0), (1, 1.0), (1, -1.0), (2, 1.0)] {
            let mut corners = shape.map(|[u, v]| {
                let mut corner = Vector3::zeros();
                corner[(axis + 1) % 3] = u;
                corner[(axis + 2) % 3] = v;
                corner
            });
            if sign < 0.0 {
                corners.reverse();
            }
            let mut builder = SurfaceBuilder::default();
            builder.polygon(Surface::Wall, &corners);
            let mesh = builder.finish();
            assert_eq!(f64::from(mesh.vertices[0].normal[axis]), sign);
            assert!((area(&mesh, Surface::Wall) - 10.0).abs() < 1.0e-5, "axis {axis}, sign {sign}");
        }
    }

    #[test]
    fn texture_runs_along_the_wall_and_up() {
        let mut builder = SurfaceBuilder::default();
        let wall = [[2.0, 0.0, 0.0], [2.0, 3.0, 0.0], [2.0, 3.0, 1.0], [2.0, 0.0, 1.0]].map(Vector3::from);
        builder.polygon(Surface::Wall, &wall);
        let uv: Vec<_> = builder.finish().vertices.iter().map(|vertex| vertex.uv).collect();
        assert_eq!(uv, [[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [0.0, 1.0]]);
    }

    #[test]
    fn a_threshold_faces_inward_outward_and_up() {
        for facing in crate::Facing::ALL {
            let mut builder = SurfaceBuilder::default();
            builder.threshold(&Plane { facing, offset: 2.0, start: 0.0, end: 1.0 }, 0.5);
            let mesh = builder.finish();
            let inward = facing.normal();
            let normals: Vec<_> = mesh.vertices.iter().step_by(4).map(|vertex| vertex.normal).collect();
            let [x, y] = to_f32(inward.as_ref());
            assert_eq!(normals, [[0.0, 0.0, 1.0], [x, y, 0.0], [-x, -y, 0.0], [0.0, 0.0, 1.0]]);
            assert!((area(&mesh, Surface::Top) - 0.15).abs() < 1.0e-6);
        }
    }
}
