//! The maze on a software driver: few operations a pixel, edges smoothed by drawing over them.

use super::material::Materials;
use super::{PassPipeline, Shared};
use crate::mesh::{Mesh, Vertex};
use crate::shader;

/// Corners of a square drawn as a strip.
const SQUARE: std::ops::Range<u32> = 0..4;

pub(crate) struct Plain {
    /// In the order of [`Mesh::groups`].
    surfaces: [wgpu::RenderPipeline; 4],
    marks: wgpu::RenderPipeline,
    edges: wgpu::RenderPipeline,
}

impl Plain {
    pub(crate) fn new(shared: &Shared<'_>, materials: &Materials) -> Self {
        let groups = &[Some(shared.frame_layout), Some(shared.light_layout), Some(&materials.layout)];
        let vertices = &[Some(Vertex::LAYOUT)];
        // The numbers stand for `WALL`, `TOP`, `FLOOR` and `RIM` in the shader.
        let surfaces = [0.0, 1.0, 2.0, 3.0].map(|kind| {
            shared.pipeline(&PassPipeline {
                entry_points: if kind == 2.0 {
                    ["vertex_floor", "fragment_floor"]
                } else {
                    ["vertex", "fragment"]
                },
                constants: &[("kind", kind)],
                groups,
                vertices,
                cull: Some(wgpu::Face::Back),
                ..PassPipeline::new(shader::PLAIN)
            })
        });
        let over = PassPipeline {
            groups,
            writes_depth: false,
            blend: Some(wgpu::BlendState::ALPHA_BLENDING),
            ..PassPipeline::new(shader::PLAIN)
        };
        let marks = shared.pipeline(&PassPipeline {
            entry_points: ["vertex_mark", "fragment_mark"],
            topology: wgpu::PrimitiveTopology::TriangleStrip,
            ..over
        });
        let edges = shared.pipeline(&PassPipeline {
            entry_points: ["vertex_edge", "fragment_edge"],
            vertices,
            ..over
        });
        Self { surfaces, marks, edges }
    }

    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, materials: &Materials, mesh: &Mesh) {
        mesh.bind(pass);
        for ((group, pipeline), material) in mesh.groups.iter().zip(&self.surfaces).zip(&materials.groups) {
            super::draw_group(pass, pipeline, material, group);
        }
    }

    /// What blends with the picture beneath it: marks and edges.
    pub(crate) fn draw_over(&self, pass: &mut wgpu::RenderPass<'_>, materials: &Materials, mesh: &Mesh) {
        mesh.bind(pass);
        let [_, top, floor, _] = &materials.groups;
        pass.set_pipeline(&self.marks);
        pass.set_bind_group(2, floor, &[]);
        // Start and goal.
        pass.draw(SQUARE, 0..2);
        super::draw_group(pass, &self.edges, top, &mesh.edges);
    }
}
