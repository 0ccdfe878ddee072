//! The ghost: a second ball, translucent, for comparison.

use super::{PassPipeline, Shared};
use crate::scene::Scene;
use crate::shader;

/// A ghost is drawn larger than it is by this factor, so that it encloses a ball at the same place: two equal spheres would
/// contend for each pixel.
const GROWTH: f32 = 1.02;

/// Centre and radius as drawn; radius 0 when there is none.
pub(super) fn sphere(scene: &Scene) -> [f32; 4] {
    scene.ghost.map_or([0.0; 4], |ghost| {
        let [x, y, z] = ghost.position;
        [x, y, z, GROWTH * ghost.radius]
    })
}

pub(crate) struct Ghost {
    pipeline: wgpu::RenderPipeline,
}

impl Ghost {
    pub(crate) fn new(shared: &Shared<'_>) -> Self {
        let pipeline = shared.pipeline(&PassPipeline {
            groups: &[Some(shared.frame_layout)],
            topology: wgpu::PrimitiveTopology::TriangleStrip,
            blend: Some(wgpu::BlendState::ALPHA_BLENDING),
            writes_depth: false,
            ..PassPipeline::new(shader::GHOST)
        });
        Self { pipeline }
    }

    /// Draws over what is there and not nearer.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_pipeline(&self.pipeline);
        pass.draw(0..4, 0..1);
    }
}
