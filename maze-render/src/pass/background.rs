//! The table that the board floats over: a grid over the whole picture, behind everything.

use super::{PassPipeline, Shared};
use crate::shader;

/// Six corners for each of the cells in `shader/background.wgsl`.
const N_CORNERS: u32 = 48 * 27 * 6;

pub(crate) struct Background {
    pipeline: wgpu::RenderPipeline,
}

impl Background {
    pub(crate) fn new(shared: &Shared<'_>) -> Self {
        let pipeline = shared.pipeline(&PassPipeline {
            groups: &[Some(shared.frame_layout)],
            writes_depth: false,
            ..PassPipeline::new(shader::BACKGROUND)
        });
        Self { pipeline }
    }

    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_pipeline(&self.pipeline);
        pass.draw(0..N_CORNERS, 0..1);
    }
}
