//! The map of the floor's light, for software drivers: sun and sky that reach the floor, drawn once a frame in a map
//! with few texels, so that a pixel of the floor needs a single look.

use super::{PassPipeline, Shared};
use crate::mesh::{Mesh, Vertex};
use crate::shader;

/// Longest side of the map in texels: as fine as the occlusion map on a board of 21 units. On larger boards shadows
/// get softer.
const MAX_SIDE: u32 = 512;

/// Samples a texel: a shadow's edge moves by half a pixel at a time, not by two.
const N_SAMPLES: u32 = 4;

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

pub(crate) struct FloorLight {
    layout: wgpu::BindGroupLayout,
    sky: wgpu::RenderPipeline,
    walls: wgpu::RenderPipeline,
    ball: wgpu::RenderPipeline,
}

/// The map of one maze.
pub(crate) struct FloorLightMap {
    samples: wgpu::TextureView,
    pub(crate) view: wgpu::TextureView,
    occlusion: wgpu::BindGroup,
}

impl FloorLight {
    pub(crate) fn new(shared: &Shared<'_>) -> Self {
        // The light layout without the map that is drawn here.
        let layout = shared.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("floor light"),
            entries: &[
                super::texture_entry(2, wgpu::TextureSampleType::Float { filterable: true }),
                super::sampler_entry(3, wgpu::SamplerBindingType::Filtering),
            ],
        });
        let base = PassPipeline {
            groups: &[Some(shared.frame_layout), Some(&layout)],
            target: Some((FORMAT, N_SAMPLES)),
            ..PassPipeline::new(shader::FLOOR_LIGHT)
        };
        let sky = shared.pipeline(&PassPipeline { entry_points: ["vertex_sky", "fragment_sky"], ..base });
        let walls = shared.pipeline(&PassPipeline {
            entry_points: ["vertex_wall", "fragment_wall"],
            vertices: &[Some(Vertex::LAYOUT)],
            writes: wgpu::ColorWrites::RED,
            ..base
        });
        let times = wgpu::BlendComponent {
            src_factor: wgpu::BlendFactor::Dst,
            dst_factor: wgpu::BlendFactor::Zero,
            operation: wgpu::BlendOperation::Add,
        };
        let ball = shared.pipeline(&PassPipeline {
            entry_points: ["vertex_ball", "fragment_ball"],
            blend: Some(wgpu::BlendState { color: times, alpha: wgpu::BlendComponent::REPLACE }),
            topology: wgpu::PrimitiveTopology::TriangleStrip,
            ..base
        });
        Self { layout, sky, walls, ball }
    }

    /// A map for a board, over the same part of the plane as its occlusion map of `size` texels.
    pub(crate) fn map(
        &self,
        device: &wgpu::Device,
        size: [u32; 2],
        occlusion: &wgpu::TextureView,
        sampler: &wgpu::Sampler,
    ) -> FloorLightMap {
        let longest = size[0].max(size[1]).max(1);
        let [width, height] = size.map(|side| match MAX_SIDE < longest {
            true => (side * MAX_SIDE / longest).max(1),
            false => side.max(1),
        });
        let make = |label, sample_count, usage| {
            let texture = device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count,
                dimension: wgpu::TextureDimension::D2,
                format: FORMAT,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT | usage,
                view_formats: &[],
            });
            texture.create_view(&Default::default())
        };
        let occlusion = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("floor light"),
            layout: &self.layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 2, resource: wgpu::BindingResource::TextureView(occlusion) },
                wgpu::BindGroupEntry { binding: 3, resource: wgpu::BindingResource::Sampler(sampler) },
            ],
        });
        FloorLightMap {
            samples: make("floor light samples", N_SAMPLES, wgpu::TextureUsages::empty()),
            view: make("floor light", 1, wgpu::TextureUsages::TEXTURE_BINDING),
            occlusion,
        }
    }

    pub(crate) fn draw(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        frame: &wgpu::BindGroup,
        map: &FloorLightMap,
        mesh: &Mesh,
        with_ball: bool,
    ) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("floor light"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &map.samples,
                depth_slice: None,
                resolve_target: Some(&map.view),
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::WHITE),
                    store: wgpu::StoreOp::Discard,
                },
            })],
            ..Default::default()
        });
        pass.set_bind_group(0, frame, &[]);
        pass.set_bind_group(1, &map.occlusion, &[]);
        pass.set_pipeline(&self.sky);
        pass.draw(0..3, 0..1);
        pass.set_pipeline(&self.walls);
        mesh.bind(&mut pass);
        let [wall, top, ..] = &mesh.groups;
        for group in [wall, top] {
            if !group.is_empty() {
                pass.draw_indexed(group.clone(), 0, 0..1);
            }
        }
        if with_ball {
            pass.set_pipeline(&self.ball);
            pass.draw(0..4, 0..1);
        }
    }
}
