//! Vertex buffers: the maze's surfaces, with the board's rim.

use std::collections::BTreeMap;
use std::ops::Range;

use maze_core::surface::{Surface, SurfaceMesh, SurfaceVertex};

use crate::{Gpu, GpuError};

/// How far the board's rim hangs below its floor, in maze units: about a plank.
pub(crate) const RIM_DEPTH: f32 = 0.35;

/// Edges this close to the floor get a rim (maze units). Walls stand on `z = 0` exactly, up to rounding.
const FLOOR_TOLERANCE: f32 = 1.0e-3;

/// A corner of a drawn triangle. Keep in sync with `Vertex` in `shader/maze.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub(crate) struct Vertex {
    pub(crate) position: [f32; 3],
    pub(crate) normal: [f32; 3],
    pub(crate) uv: [f32; 2],
}

impl Vertex {
    pub(crate) const LAYOUT: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
        array_stride: size_of::<Self>() as u64,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x2],
    };
}

/// Triangles on the GPU.
pub(crate) struct Mesh {
    pub(crate) vertices: wgpu::Buffer,
    pub(crate) indices: wgpu::Buffer,
    /// What to draw with which material: wall, top, floor, rim.
    pub(crate) groups: [Range<u32>; 4],
    /// Strips along the tops' edges, see `vertex_edge` in `shader/plain.wgsl`; none unless asked for.
    pub(crate) edges: Range<u32>,
    /// Strips up the corners between them, see `vertex_soft` in `shader/floor_light.wgsl`.
    pub(crate) corners: Range<u32>,
}

impl Mesh {
    /// The maze's surfaces, and a rim below every open edge on the floor. `None` for a maze without triangles: a buffer
    /// without bytes cannot be bound.
    pub(crate) fn of_maze(gpu: &Gpu, mesh: &SurfaceMesh, with_edges: bool) -> Result<Option<Self>, GpuError> {
        let max_bytes = gpu.device.limits().max_buffer_size;
        let (n_vertices, n_indices) = (mesh.vertices.len(), mesh.indices.iter().map(Vec::len).sum());
        // Once before any triangle, so that this bounds the work too, and once with the rim.
        check_size(n_vertices, n_indices, max_bytes)?;
        check_indices(mesh)?;
        let rim_edges = floor_edges(mesh);
        let top_edges = if with_edges {
            open_edges(mesh, mesh.indices_of(Surface::Top).iter(), |_| true)
        } else {
            Vec::new()
        };
        let n_strips = rim_edges.len() + 3 * top_edges.len();
        let (n_vertices, n_indices) = (n_vertices + 4 * n_strips, n_indices + 6 * n_strips);
        check_size(n_vertices, n_indices, max_bytes)?;
        if n_indices == 0 {
            return Ok(None);
        }
        let mut vertices = Vec::with_capacity(n_vertices);
        vertices.extend(mesh.vertices.iter().map(|v| Vertex {
            position: v.position,
            normal: v.normal,
            uv: v.uv,
        }));
        let mut indices = Vec::with_capacity(n_indices);
        let mut start = 0;
        let mut group_up_to = |end: usize| {
            let end = u32::try_from(end).unwrap_or(u32::MAX);
            std::mem::replace(&mut start, end)..end
        };
        let surfaces = Surface::ALL.map(|surface| {
            indices.extend_from_slice(mesh.indices_of(surface));
            group_up_to(indices.len())
        });
        add_rim(&rim_edges, &mut vertices, &mut indices);
        let rim = group_up_to(indices.len());
        add_edge_strips(&top_edges, &mut vertices, &mut indices);
        let edges = group_up_to(indices.len());
        add_corner_strips(&top_edges, &mut vertices, &mut indices);
        let corners = group_up_to(indices.len());
        let [wall, top, floor] = surfaces;
        let buffer = |contents: &[u8], usage| maze_buffer(gpu, contents, usage);
        Ok(Some(Self {
            vertices: buffer(bytemuck::cast_slice(&vertices), wgpu::BufferUsages::VERTEX)?,
            indices: buffer(bytemuck::cast_slice(&indices), wgpu::BufferUsages::INDEX)?,
            groups: [wall, top, floor, rim],
            edges,
            corners,
        }))
    }

    /// Binds the buffers; the vertices go to slot 0.
    pub(crate) fn bind(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_vertex_buffer(0, self.vertices.slice(..));
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
    }
}

/// Whether vertices and indices fit into a buffer each, and can be counted in the 32 bits that drawing has.
fn check_size(n_vertices: usize, n_indices: usize, max_bytes: u64) -> Result<(), GpuError> {
    for (n, n_bytes_each) in [(n_vertices, size_of::<Vertex>()), (n_indices, size_of::<u32>())] {
        let [n, n_bytes_each] = [n, n_bytes_each].map(|n| n as u64);
        let n_bytes = n.saturating_mul(n_bytes_each);
        let max = max_bytes.min(n_bytes_each * u64::from(u32::MAX));
        if max < n_bytes {
            return Err(GpuError::MazeTooLarge { n_bytes, max });
        }
    }
    Ok(())
}

fn check_indices(mesh: &SurfaceMesh) -> Result<(), GpuError> {
    let n_vertices = mesh.vertices.len();
    let beyond = mesh.indices.iter().flatten().find(|&&index| n_vertices <= index as usize);
    beyond.map_or(Ok(()), |&index| Err(GpuError::VertexOutOfRange { index, n_vertices }))
}

/// A buffer that holds `contents`. `create_buffer_init` would panic where the memory runs out or the device is lost.
fn maze_buffer(gpu: &Gpu, contents: &[u8], usage: wgpu::BufferUsages) -> Result<wgpu::Buffer, GpuError> {
    let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("maze"),
        size: contents.len() as u64,
        usage,
        mapped_at_creation: true,
    });
    match buffer.get_mapped_range_mut(..) {
        Ok(mut mapped) => mapped.copy_from_slice(contents),
        // The device's own error is more precise than that there is nothing to write to.
        Err(error) => {
            let unexplained = || GpuError::Device(format!("uploading the maze: {error}"));
            return Err(gpu.take_error().unwrap_or_else(unexplained));
        }
    }
    buffer.unmap();
    Ok(buffer)
}

/// An edge of a triangle, in its sense.
type Edge = [SurfaceVertex; 2];

/// Every edge at floor height that no second triangle shares: around the board and around holes. It does not matter
/// which surface brings them; one that is split differently on its two sides only grows a rim that is not visible, below the
/// floor.
fn floor_edges(mesh: &SurfaceMesh) -> Vec<Edge> {
    let is_at_floor = |v: &SurfaceVertex| v.position[2].abs() < FLOOR_TOLERANCE;
    open_edges(mesh, mesh.indices.iter().flatten(), |edge| edge.iter().all(is_at_floor))
}

/// Every wanted edge of these triangles that no second one of them shares, matched by position.
fn open_edges<'a>(
    mesh: &SurfaceMesh,
    indices: impl Iterator<Item = &'a u32>,
    is_wanted: impl Fn(&Edge) -> bool,
) -> Vec<Edge> {
    type Place = [u32; 3];
    let place = |v: &SurfaceVertex| -> Place { v.position.map(|x| (x + 0.0).to_bits()) };
    let mut open: BTreeMap<[Place; 2], Edge> = BTreeMap::new();
    let mut corners = indices.map(|&i| mesh.vertices[i as usize]);
    while let (Some(a), Some(b), Some(c)) = (corners.next(), corners.next(), corners.next()) {
        for edge in [[a, b], [b, c], [c, a]].into_iter().filter(&is_wanted) {
            let [from, to] = [place(&edge[0]), place(&edge[1])];
            if open.remove(&[to, from]).is_none() {
                open.insert([from, to], edge);
            }
        }
    }
    open.into_values().collect()
}

/// Lays a strip along each of `edges` of tops: four vertices and six indices, or none where an edge has no length. Both
/// its sides lie on the edge; the shader moves one outwards by a pixel.
fn add_edge_strips(edges: &[Edge], vertices: &mut Vec<Vertex>, indices: &mut Vec<u32>) {
    for [a, b] in edges {
        let Some(out) = outwards(a, b) else { continue };
        let Ok(first) = u32::try_from(vertices.len()) else { return };
        for (corner, side) in [(a, 0.0), (b, 0.0), (b, 1.0), (a, 1.0)] {
            let normal = [out[0], out[1], side];
            vertices.push(Vertex { position: corner.position, normal, uv: corner.uv });
        }
        indices.extend([0, 1, 2, 0, 2, 3].map(|i| first + i));
    }
}

/// Stands two strips on the floor at the first end of each of `edges` of tops, up to the top: eight vertices and twelve
/// indices. Both sides of each lie on the corner; the shader moves one to the left or to the right. The tops' outlines
/// are closed, so that each corner is the first end of one edge.
fn add_corner_strips(edges: &[Edge], vertices: &mut Vec<Vertex>, indices: &mut Vec<u32>) {
    for [a, _] in edges {
        for side in [-1.0, 1.0] {
            let Ok(first) = u32::try_from(vertices.len()) else { return };
            let [x, y, z] = a.position;
            for (height, side) in [(0.0, 0.0), (z, 0.0), (z, side), (0.0, side)] {
                vertices.push(Vertex { position: [x, y, height], normal: [0.0, 0.0, side], uv: a.uv });
            }
            indices.extend([0, 1, 2, 0, 2, 3].map(|i| first + i));
        }
    }
}

/// Unit vector in the plane, to the right of the line from a to b: out of a triangle seen from above.
fn outwards(a: &SurfaceVertex, b: &SurfaceVertex) -> Option<[f32; 2]> {
    let along = [b.position[0] - a.position[0], b.position[1] - a.position[1]];
    let length = along[0].hypot(along[1]);
    (0.0 < length).then(|| [along[1] / length, -along[0] / length])
}

/// Hangs a plank's edge below each of `edges`: four vertices and six indices, or none where an edge has no length.
fn add_rim(edges: &[Edge], vertices: &mut Vec<Vertex>, indices: &mut Vec<u32>) {
    for [a, b] in edges {
        let Some([x, y]) = outwards(a, b) else { continue };
        let Ok(first) = u32::try_from(vertices.len()) else { return };
        let normal = [x, y, 0.0];
        let (a, b) = (a.position, b.position);
        // Wood grain runs along the plank: the floor's texture has it along its first axis.
        let run = |p: [f32; 3]| if normal[0].abs() < normal[1].abs() { p[0] } else { p[1] };
        for (corner, depth) in [(b, 0.0), (a, 0.0), (a, RIM_DEPTH), (b, RIM_DEPTH)] {
            let position = [corner[0], corner[1], corner[2] - depth];
            vertices.push(Vertex { position, normal, uv: [run(corner), -depth] });
        }
        indices.extend([0, 1, 2, 0, 2, 3].map(|i| first + i));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
        a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
    }

    fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    }

    #[test]
    fn a_maze_fits_up_to_the_last_byte() {
        let max = 320;
        assert!(check_size(10, 80, max).is_ok());
        let refused = |n_vertices, n_indices, max| match check_size(n_vertices, n_indices, max) {
            Err(GpuError::MazeTooLarge { n_bytes, max }) => [n_bytes, max],
            other => panic!("{other:?}"),
        };
        assert_eq!(refused(11, 80, max), [352, max], "vertices");
        assert_eq!(refused(10, 81, max), [324, max], "indices");
        let too_many = u64::from(u32::MAX) + 1;
        let n_indices = usize::try_from(too_many).unwrap_or(usize::MAX);
        assert_eq!(
            refused(0, n_indices, u64::MAX),
            [4 * too_many, 4 * (too_many - 1)],
            "more than 32 bits count"
        );
    }

    #[test]
    fn a_rim_hangs_around_a_floor_and_nowhere_inside_it() {
        let corner = |x, y| SurfaceVertex { position: [x, y, 0.0], normal: [0.0, 0.0, 1.0], uv: [x, y] };
        let mesh = SurfaceMesh {
            vertices: vec![corner(0.0, 0.0), corner(2.0, 0.0), corner(2.0, 1.0), corner(0.0, 1.0)],
            indices: [vec![], vec![], vec![0, 1, 2, 0, 2, 3]],
        };
        let (mut vertices, mut indices) = (vec![], vec![]);
        add_rim(&floor_edges(&mesh), &mut vertices, &mut indices);
        assert_eq!(indices.len(), 4 * 6, "four sides, not the diagonal");
        for triangle in indices.as_chunks::<3>().0 {
            let [a, b, c] = triangle.map(|i| vertices[i as usize]);
            let minus = |p: Vertex| std::array::from_fn(|i| p.position[i] - a.position[i]);
            let outward = cross(minus(b), minus(c));
            assert!(0.0 < dot(outward, a.normal), "wound as its normal says");
            let middle = [1.0, 0.5, 0.0];
            assert!(0.0 < dot(std::array::from_fn(|i| a.position[i] - middle[i]), a.normal), "points away");
        }
    }
}
