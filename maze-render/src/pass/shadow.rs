//! The shadow map: how far its light reaches, seen from the sun, so that walls throw shadows.

use nalgebra::Matrix4;

use super::{DEPTH_FORMAT, Shared};
use crate::mesh::{Mesh, Vertex};
use crate::shader;

/// Half width of a shadow's soft edge (maze units), where the map is fine enough for it.
const SOFTNESS: f32 = 0.026;

/// Least softness in texels: hides the map's grid.
const MIN_SOFTNESS_TEXELS: f32 = 1.1;

/// How far to step off a lit surface before sampling the map, in texels of the map: more than the slope of any
/// surface in view makes up within the blur.
const STEP_OFF_TEXELS: f32 = 2.0;

/// The `shadow` entry of [`super::Frame`] for this view of the sun; `softness` is of the map of the floor's light.
pub(crate) fn blur(sun_clip_from_maze: &Matrix4<f32>, map_side: u32, softness: f32) -> [f32; 4] {
    // Clip space spans 2 over the map: half the row's length is map widths per unit.
    let widths_per_unit = [0, 1].map(|row| 0.5 * sun_clip_from_maze.fixed_view::<1, 3>(row, 0).norm());
    let texel = 1.0 / map_side as f32;
    let [u, v] = widths_per_unit.map(|w| (w * SOFTNESS).max(MIN_SOFTNESS_TEXELS * texel));
    let coarsest_texel = texel / widths_per_unit[0].min(widths_per_unit[1]);
    [u, v, STEP_OFF_TEXELS * coarsest_texel, softness]
}

pub(crate) struct Shadow {
    pipeline: wgpu::RenderPipeline,
    pub(crate) map: wgpu::TextureView,
}

impl Shadow {
    pub(crate) fn new(shared: &Shared<'_>) -> Self {
        let device = shared.device;
        let side = shared.detail.sun_map_side;
        let map = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("shadow map"),
            size: wgpu::Extent3d { width: side, height: side, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: DEPTH_FORMAT,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        });
        let module = shader::SHADOW.module(device);
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("shadow map"),
            bind_group_layouts: &[Some(shared.frame_layout)],
            immediate_size: 0,
        });
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("shadow map"),
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("vertex"),
                compilation_options: Default::default(),
                buffers: &[Some(Vertex::LAYOUT)],
            },
            primitive: Default::default(), // Both faces: walls may be open below.
            depth_stencil: Some(wgpu::DepthStencilState {
                format: DEPTH_FORMAT,
                depth_write_enabled: Some(true),
                depth_compare: Some(wgpu::CompareFunction::Less),
                stencil: Default::default(),
                bias: wgpu::DepthBiasState { constant: 0, slope_scale: 1.5, clamp: 0.0 },
            }),
            multisample: Default::default(),
            fragment: None,
            multiview_mask: None,
            cache: None,
        });
        Self { pipeline, map: map.create_view(&Default::default()) }
    }

    /// Draws walls and tops; the floor is below everything it could shade.
    pub(crate) fn draw(&self, encoder: &mut wgpu::CommandEncoder, frame: &wgpu::BindGroup, mesh: &Mesh) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("shadow map"),
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.map,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, frame, &[]);
        mesh.bind(&mut pass);
        let [wall, top, ..] = &mesh.groups;
        for group in [wall, top] {
            if !group.is_empty() {
                pass.draw_indexed(group.clone(), 0, 0..1);
            }
        }
    }
}
