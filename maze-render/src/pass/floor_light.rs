//! The map of the floor's light, for software drivers: sun and sky that reach the floor, drawn once a frame in a map
//! with few texels, so that a pixel of the floor needs a single look.

use super::{PassPipeline, Shared};
use crate::mesh::{Mesh, Vertex};
use crate::shader;

/// Longest side of the map in texels: as fine as the occlusion map on a board of 21 units. On larger boards shadows
/// get softer.
const MAX_SIDE: u32 = 512;

/// Width of a shadow's soft edge (maze units), where the map is fine enough for it.
const SOFTNESS: f32 = 0.05;

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

pub(crate) struct FloorLight {
    layout: wgpu::BindGroupLayout,
    sky: wgpu::RenderPipeline,
    day: wgpu::RenderPipeline,
    walls: wgpu::RenderPipeline,
    soft: wgpu::RenderPipeline,
    ball: wgpu::RenderPipeline,
}

/// The map of one maze.
pub(crate) struct FloorLightMap {
    pub(crate) view: wgpu::TextureView,
    occlusion: wgpu::BindGroup,
    size: [u32; 2],
    /// Set once the sky's part, which stays, has been drawn.
    has_sky: bool,
}

impl FloorLightMap {
    /// Width of a shadow's soft edge (maze units); `uv_from_maze` is the occlusion map's.
    pub(crate) fn softness(&self, uv_from_maze: &[f32; 4]) -> f32 {
        let texel = |i: usize| 1.0 / (uv_from_maze[i].abs() * self.size[i] as f32).max(f32::MIN_POSITIVE);
        SOFTNESS.max(texel(0)).max(texel(1))
    }
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
            target: Some((FORMAT, 1)),
            ..PassPipeline::new(shader::FLOOR_LIGHT)
        };
        let sky = shared.pipeline(&PassPipeline { entry_points: ["vertex_sky", "fragment_sky"], ..base });
        let day = shared.pipeline(&PassPipeline {
            entry_points: ["vertex_sky", "fragment_day"],
            writes: wgpu::ColorWrites::ALL.difference(wgpu::ColorWrites::GREEN),
            ..base
        });
        let walls = shared.pipeline(&PassPipeline {
            entry_points: ["vertex_wall", "fragment_wall"],
            vertices: &[Some(Vertex::LAYOUT)],
            writes: wgpu::ColorWrites::RED,
            ..base
        });
        let darker = wgpu::BlendComponent {
            src_factor: wgpu::BlendFactor::One,
            dst_factor: wgpu::BlendFactor::One,
            operation: wgpu::BlendOperation::Min,
        };
        let soft = shared.pipeline(&PassPipeline {
            entry_points: ["vertex_soft", "fragment_soft"],
            vertices: &[Some(Vertex::LAYOUT)],
            writes: wgpu::ColorWrites::RED,
            blend: Some(wgpu::BlendState { color: darker, alpha: darker }),
            ..base
        });
        let ball = shared.pipeline(&PassPipeline {
            entry_points: ["vertex_ball", "fragment_ball"],
            writes: wgpu::ColorWrites::BLUE | wgpu::ColorWrites::ALPHA,
            topology: wgpu::PrimitiveTopology::TriangleStrip,
            ..base
        });
        Self { layout, sky, day, walls, soft, ball }
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
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("floor light"),
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: FORMAT,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        });
        let occlusion = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("floor light"),
            layout: &self.layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 2, resource: wgpu::BindingResource::TextureView(occlusion) },
                wgpu::BindGroupEntry { binding: 3, resource: wgpu::BindingResource::Sampler(sampler) },
            ],
        });
        FloorLightMap {
            view: texture.create_view(&Default::default()),
            occlusion,
            size: [width, height],
            has_sky: false,
        }
    }

    pub(crate) fn draw(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        frame: &wgpu::BindGroup,
        map: &mut FloorLightMap,
        mesh: &Mesh,
        with_ball: bool,
    ) {
        let has_sky = std::mem::replace(&mut map.has_sky, true);
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("floor light"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &map.view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: if has_sky { wgpu::LoadOp::Load } else { wgpu::LoadOp::Clear(wgpu::Color::WHITE) },
                    store: wgpu::StoreOp::Store,
                },
            })],
            ..Default::default()
        });
        pass.set_bind_group(0, frame, &[]);
        pass.set_bind_group(1, &map.occlusion, &[]);
        pass.set_pipeline(if has_sky { &self.day } else { &self.sky });
        pass.draw(0..3, 0..1);
        pass.set_pipeline(&self.walls);
        mesh.bind(&mut pass);
        let draw = |pass: &mut wgpu::RenderPass<'_>, part: &std::ops::Range<u32>| {
            if !part.is_empty() {
                pass.draw_indexed(part.clone(), 0, 0..1);
            }
        };
        let [wall, top, ..] = &mesh.groups;
        draw(&mut pass, wall);
        draw(&mut pass, top);
        pass.set_pipeline(&self.soft);
        draw(&mut pass, &mesh.edges);
        draw(&mut pass, &mesh.corners);
        if with_ball {
            pass.set_pipeline(&self.ball);
            pass.draw(0..4, 0..1);
        }
    }
}
