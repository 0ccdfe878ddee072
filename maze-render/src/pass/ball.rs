//! The ball: a sphere with a pattern that turns with it, lit like the maze and with the room mirrored in it.

use super::material::Materials;
use super::{PassPipeline, Shared};
use crate::mesh::{Mesh, Vertex};
use crate::shader;

pub(crate) struct Ball {
    pipeline: wgpu::RenderPipeline,
    mesh: Mesh,
}

impl Ball {
    pub(crate) fn new(shared: &Shared<'_>, materials: &Materials) -> Self {
        // Without more samples the outline is smoothed by hand.
        let fades_out = shared.n_samples == 1;
        let pipeline = shared.pipeline(&PassPipeline {
            constants: &[
                ("sun_looks", shared.detail.sun_looks.into()),
                ("fades_out", f64::from(u8::from(fades_out))),
                ("is_plain", f64::from(u8::from(!shared.quality.wants_srgb_target()))),
            ],
            groups: &[Some(shared.frame_layout), Some(shared.light_layout), Some(&materials.layout)],
            vertices: &[Some(Vertex::LAYOUT)],
            cull: Some(wgpu::Face::Back),
            blend: fades_out.then_some(wgpu::BlendState::ALPHA_BLENDING),
            ..PassPipeline::new(shader::BALL)
        });
        Self { pipeline, mesh: Mesh::ball(shared.device, shared.detail.n_ball_splits) }
    }

    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, materials: &Materials) {
        // The floor, which the ball mirrors.
        pass.set_bind_group(2, &materials.groups[2], &[]);
        pass.set_pipeline(&self.pipeline);
        self.mesh.bind(pass);
        pass.draw_indexed(self.mesh.groups[0].clone(), 0, 0..1);
    }
}
