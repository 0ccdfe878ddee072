//! Coloured lines and patches in maze space, drawn over everything: what the method sees.

use super::{PassPipeline, Shared};
use crate::Gpu;
use crate::paint::Growing;
use crate::scene::{Line, Patch};
use crate::shader;

/// A patch covers its pixels whatever the width says.
const PATCH_HALF_WIDTH: f32 = 1.0;

/// Keep in sync with `vertex` in `shader/lines.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
struct Vertex {
    position: [f32; 3],
    towards: [f32; 3],
    offset: [f32; 2],
    half_width: f32,
    colour: [u8; 4],
}

const ATTRIBUTES: [wgpu::VertexAttribute; 5] =
    wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x2, 3 => Float32, 4 => Unorm8x4];

pub(crate) struct Lines {
    pipeline: wgpu::RenderPipeline,
    vertices: Growing,
    n_vertices: u32,
}

impl Lines {
    pub(crate) fn new(shared: &Shared<'_>) -> Self {
        let layout = wgpu::VertexBufferLayout {
            array_stride: size_of::<Vertex>() as u64,
            step_mode: wgpu::VertexStepMode::Vertex,
            attributes: &ATTRIBUTES,
        };
        let pipeline = shared.pipeline(&PassPipeline {
            groups: &[Some(shared.frame_layout)],
            vertices: &[Some(layout)],
            writes_depth: false,
            is_over_all: true,
            blend: Some(wgpu::BlendState::ALPHA_BLENDING),
            ..PassPipeline::new(shader::LINES)
        });
        Self { pipeline, vertices: Growing::new(wgpu::BufferUsages::VERTEX), n_vertices: 0 }
    }

    /// Takes what the next [`Lines::draw`] shows.
    pub(crate) fn set(&mut self, gpu: &Gpu, lines: &[Line], patches: &[Patch]) {
        let patches = patches.iter().flat_map(patch_corners);
        let vertices: Vec<Vertex> = patches.chain(lines.iter().flat_map(line_corners)).collect();
        self.n_vertices = u32::try_from(vertices.len()).unwrap_or(0);
        if 0 < self.n_vertices {
            self.vertices.write(gpu, bytemuck::cast_slice(&vertices));
        }
    }

    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        if let Some(vertices) = self.vertices.buffer().filter(|_| 0 < self.n_vertices) {
            pass.set_pipeline(&self.pipeline);
            pass.set_vertex_buffer(0, vertices.slice(..));
            pass.draw(0..self.n_vertices, 0..1);
        }
    }
}

/// Two triangles.
fn patch_corners(patch: &Patch) -> [Vertex; 6] {
    [0, 1, 2, 0, 2, 3].map(|i| {
        let position = patch.corners[i];
        let (offset, half_width) = ([0.0; 2], PATCH_HALF_WIDTH);
        Vertex { position, towards: position, offset, half_width, colour: patch.colour }
    })
}

/// Two triangles, half a pixel wider than the line on either side so that it can fade out.
fn line_corners(line: &Line) -> [Vertex; 6] {
    let half_width = 0.5 * line.width;
    let out = half_width + 0.5;
    let at = |is_end: bool, side: f32| {
        let (position, towards) = if is_end { (line.to, line.from) } else { (line.from, line.to) };
        // Seen from the end, right is left.
        let sense = if is_end { -1.0 } else { 1.0 };
        Vertex { position, towards, offset: [sense * side * out, sense], half_width, colour: line.colour }
    };
    let [a, b, c, d] = [at(false, -1.0), at(false, 1.0), at(true, 1.0), at(true, -1.0)];
    [a, b, c, a, c, d]
}
