//! The table that the board floats over: a grid over the whole picture, behind everything.

use wgpu::util::DeviceExt;

use super::{PassPipeline, Shared};
use crate::shader;

/// Cells of the grid across and down: enough for the board's soft shadow, and no more, because a software driver draws the
/// pixels along a triangle's edge twice. Keep in sync with `CELLS` in `shader/background.wgsl`.
const CELLS: [u16; 2] = [24, 14];

pub(crate) struct Background {
    pipeline: wgpu::RenderPipeline,
    indices: wgpu::Buffer,
    n_indices: u32,
}

impl Background {
    pub(crate) fn new(shared: &Shared<'_>) -> Self {
        let pipeline = shared.pipeline(&PassPipeline {
            groups: &[Some(shared.frame_layout)],
            writes_depth: false,
            ..PassPipeline::new(shader::BACKGROUND)
        });
        let indices = grid(CELLS);
        Self {
            pipeline,
            indices: shared.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: Some("background"),
                contents: bytemuck::cast_slice(&indices),
                usage: wgpu::BufferUsages::INDEX,
            }),
            n_indices: u32::try_from(indices.len()).unwrap_or(0),
        }
    }

    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_pipeline(&self.pipeline);
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint16);
        pass.draw_indexed(0..self.n_indices, 0, 0..1);
    }
}

/// Two triangles a cell, whose corners are numbered in rows: each corner's light is computed once for all the cells
/// that it belongs to.
fn grid([across, down]: [u16; 2]) -> Vec<u16> {
    let row = across + 1;
    let cells = (0..down).flat_map(|y| (0..across).map(move |x| y * row + x));
    cells.flat_map(|corner| [0, 1, row, row, 1, row + 1].map(|step| corner + step)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grid_has_two_triangles_a_cell_that_share_corners() {
        assert_eq!(grid([2, 1]), [0, 1, 3, 3, 1, 4, 1, 2, 4, 4, 2, 5]);
        let [across, down] = CELLS.map(usize::from);
        assert_eq!(
            grid(CELLS).iter().max().map(|&last| usize::from(last)),
            Some((across + 1) * (down + 1) - 1)
        );
    }
}
