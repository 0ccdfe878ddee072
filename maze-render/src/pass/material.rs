//! What the maze is made of: each kind of surface's texture and finish.

use wgpu::util::DeviceExt;

use super::Shared;
use crate::Gpu;
use crate::texture::{Bytes, Mipmapped, TextureSet, normal_map};

/// Bricks: the picture shows one unit of wall, some eight courses, so that a brick is small beside the ball.
const WALL_REPEATS_PER_UNIT: f32 = 1.0;

/// Planks: three units a picture, so that a plank is about as wide as a wall is thick and rarely repeats in view.
const FLOOR_REPEATS_PER_UNIT: f32 = 1.0 / 3.0;

/// Stone: as fine as the bricks it lies on.
const TOP_REPEATS_PER_UNIT: f32 = 1.0;

/// How a surface answers light. Keep in sync with `Material` in `shader/material.wgsl`; checked by `tests/shaders.rs`.
#[repr(C)]
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Material {
    /// Mean colour of the texture, linear; unused.
    pub mean: [f32; 4],
    /// Texture repeats per maze unit.
    pub repeats_per_unit: f32,
    /// 0 mirrors, 1 is chalk.
    pub roughness: f32,
    /// Reflection straight on; 0.04 is varnish.
    pub reflectance: f32,
    /// WGSL's uniforms come in sixteens.
    pub unused: f32,
}

/// Group 2 of the passes that draw the maze.
pub(crate) struct Materials {
    pub(crate) layout: wgpu::BindGroupLayout,
    /// Wall, top, floor, rim: in the order of [`crate::mesh::Mesh::groups`].
    pub(crate) groups: [wgpu::BindGroup; 4],
    /// The floor's mean colour, linear.
    pub(crate) floor_mean: [f32; 3],
    /// Notes about pictures that were made smaller.
    pub(crate) notes: Vec<String>,
}

impl Materials {
    pub(crate) fn new(gpu: &Gpu, shared: &Shared<'_>, textures: &TextureSet) -> Self {
        let device = shared.device;
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("material"),
            entries: &[
                wgpu::BindGroupLayoutEntry {
                    binding: 0,
                    visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
                    ty: wgpu::BindingType::Buffer {
                        ty: wgpu::BufferBindingType::Uniform,
                        has_dynamic_offset: false,
                        min_binding_size: wgpu::BufferSize::new(size_of::<Material>() as u64),
                    },
                    count: None,
                },
                super::texture_entry(1, wgpu::TextureSampleType::Float { filterable: true }),
                super::sampler_entry(2, wgpu::SamplerBindingType::Filtering),
                super::texture_entry(3, wgpu::TextureSampleType::Float { filterable: true }),
            ],
        });
        let computes_in_light = shared.quality.wants_srgb_target();
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("surface"),
            address_mode_u: wgpu::AddressMode::Repeat,
            address_mode_v: wgpu::AddressMode::Repeat,
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            // On a software driver a second level costs as much as the rest of the floor.
            mipmap_filter: match computes_in_light {
                true => wgpu::MipmapFilterMode::Linear,
                false => wgpu::MipmapFilterMode::Nearest,
            },
            anisotropy_clamp: shared.detail.anisotropy.clamp(1, 16),
            ..Default::default()
        });
        let bytes = if computes_in_light { Bytes::Decoded } else { Bytes::Srgb };
        let load = |name, image| {
            let colour = Mipmapped::new(gpu, name, image, bytes);
            // Where light is computed at corners a normal map is of no use.
            let normal_map =
                computes_in_light.then(|| Mipmapped::new(gpu, name, &normal_map(image), Bytes::Linear).view);
            (colour, normal_map)
        };
        let wall = load("wall", &textures.wall);
        let floor = load("floor", &textures.floor);
        let top = load("top", &textures.top);
        let group = |(texture, normal_map): &(Mipmapped, Option<wgpu::TextureView>),
                     repeats_per_unit,
                     roughness,
                     reflectance| {
            let [r, g, b] = texture.mean;
            let material =
                Material { mean: [r, g, b, 0.0], repeats_per_unit, roughness, reflectance, unused: 0.0 };
            let uniform = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: Some("material"),
                contents: bytemuck::bytes_of(&material),
                usage: wgpu::BufferUsages::UNIFORM,
            });
            device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("material"),
                layout: &layout,
                entries: &[
                    wgpu::BindGroupEntry { binding: 0, resource: uniform.as_entire_binding() },
                    wgpu::BindGroupEntry {
                        binding: 1,
                        resource: wgpu::BindingResource::TextureView(&texture.view),
                    },
                    wgpu::BindGroupEntry { binding: 2, resource: wgpu::BindingResource::Sampler(&sampler) },
                    wgpu::BindGroupEntry {
                        binding: 3,
                        resource: wgpu::BindingResource::TextureView(
                            normal_map.as_ref().unwrap_or(&texture.view),
                        ),
                    },
                ],
            })
        };
        let groups = [
            group(&wall, WALL_REPEATS_PER_UNIT, 0.85, 0.03),
            group(&top, TOP_REPEATS_PER_UNIT, 0.65, 0.035),
            group(&floor, FLOOR_REPEATS_PER_UNIT, 0.38, 0.04),
            group(&floor, FLOOR_REPEATS_PER_UNIT, 0.45, 0.04),
        ];
        let notes = [&wall, &floor, &top].into_iter().filter_map(|(colour, _)| colour.note.clone()).collect();
        Self { groups, floor_mean: floor.0.mean, layout, notes }
    }
}
