//! The ball: a sphere with a pattern that turns with it, lit like the maze and with the room mirrored in it.

use super::material::Materials;
use super::{PassPipeline, Shared};
use crate::shader;

pub(crate) struct Ball {
    pipeline: wgpu::RenderPipeline,
}

impl Ball {
    pub(crate) fn new(shared: &Shared<'_>, materials: &Materials) -> Self {
        let is_plain = !shared.quality.wants_srgb_target();
        let pipeline = shared.pipeline(&PassPipeline {
            constants: &[
                ("pcf_taps", shared.detail.pcf_taps.into()),
                ("is_plain", f64::from(u8::from(is_plain))),
            ],
            groups: &[Some(shared.frame_layout), Some(shared.light_layout), Some(&materials.layout)],
            topology: wgpu::PrimitiveTopology::TriangleStrip,
            // The outline covers parts of pixels.
            blend: Some(wgpu::BlendState::ALPHA_BLENDING),
            ..PassPipeline::new(shader::BALL)
        });
        Self { pipeline }
    }

    /// Draws over what is there.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, materials: &Materials) {
        pass.set_pipeline(&self.pipeline);
        // The floor, which the ball mirrors.
        pass.set_bind_group(2, &materials.groups[2], &[]);
        pass.draw(0..4, 0..1);
    }
}
