//! The maze: walls, tops, floor and the board's rim, each with its own texture and finish.

use super::material::Materials;
use super::{PassPipeline, Shared};
use crate::mesh::{Mesh, Vertex};
use crate::shader;

/// Mipmap levels by which walls are sharper where samples are not spread along their long side.
const UNSPREAD_WALL_BIAS: f64 = -1.2;

pub(crate) struct Maze {
    /// In the order of [`Mesh::groups`]: each kind of surface has its own pipeline, so that none pays for another.
    pipelines: [wgpu::RenderPipeline; 4],
}

impl Maze {
    pub(crate) fn new(shared: &Shared<'_>, materials: &Materials) -> Self {
        let wall_bias = if 1 < shared.detail.anisotropy { 0.0 } else { UNSPREAD_WALL_BIAS };
        // The numbers stand for `WALL`, `TOP`, `FLOOR` and `RIM` in the shader.
        let pipelines = [0.0, 1.0, 2.0, 3.0].map(|kind| {
            shared.pipeline(&PassPipeline {
                constants: &[
                    ("kind", kind),
                    ("pcf_taps", shared.detail.pcf_taps.into()),
                    ("wall_bias", wall_bias),
                ],
                groups: &[Some(shared.frame_layout), Some(shared.light_layout), Some(&materials.layout)],
                vertices: &[Some(Vertex::LAYOUT)],
                cull: Some(wgpu::Face::Back),
                ..PassPipeline::new(shader::MAZE)
            })
        });
        Self { pipelines }
    }

    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, materials: &Materials, mesh: &Mesh) {
        mesh.bind(pass);
        // Walls and tops first: they hide much of the floor, which then is not shaded.
        for ((group, pipeline), material) in mesh.groups.iter().zip(&self.pipelines).zip(&materials.groups) {
            super::draw_group(pass, pipeline, material, group);
        }
    }
}
