//! The table that the board floats over: one triangle over the whole picture, behind everything.

use super::{PassPipeline, Shared};
use crate::shader;

pub(crate) struct Background {
    pipeline: wgpu::RenderPipeline,
}

impl Background {
    pub(crate) fn new(shared: &Shared<'_>) -> Self {
        let pipeline = shared.pipeline(&PassPipeline {
            shader: shader::BACKGROUND,
            constants: &[],
            groups: &[Some(shared.frame_layout)],
            vertices: &[],
            cull: None,
            writes_depth: false,
        });
        Self { pipeline }
    }

    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_pipeline(&self.pipeline);
        pass.draw(0..3, 0..1);
    }
}
