//! The maze: walls, tops, floor and the board's rim, each with its own texture and finish.

use wgpu::util::DeviceExt;

use super::{PassPipeline, Shared};
use crate::mesh::{Mesh, Vertex};
use crate::shader;
use crate::texture::{Mipmapped, TextureSet};

/// Bricks: the picture shows one unit of wall, some eight courses, so that a brick is small beside the ball.
const WALL_REPEATS_PER_UNIT: f32 = 1.0;

/// Planks: three units a picture, so that a plank is about as wide as a wall is thick and rarely repeats in view.
const FLOOR_REPEATS_PER_UNIT: f32 = 1.0 / 3.0;

/// Stone: as fine as the bricks it lies on.
const TOP_REPEATS_PER_UNIT: f32 = 1.0;

/// How a surface answers light. Keep in sync with `Material` in `shader/maze.wgsl`; checked by `tests/shaders.rs`.
#[repr(C)]
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Material {
    /// Texture repeats per maze unit.
    pub repeats_per_unit: f32,
    /// 0 mirrors, 1 is chalk.
    pub roughness: f32,
    /// Reflection straight on; 0.04 is varnish.
    pub reflectance: f32,
    /// WGSL's uniforms come in sixteens.
    pub unused: f32,
}

pub(crate) struct Maze {
    /// In the order of [`Mesh::groups`]: each kind of surface has its own pipeline, so that none pays for another.
    pipelines: [wgpu::RenderPipeline; 4],
    materials: [wgpu::BindGroup; 4],
    /// The floor's mean colour, linear.
    pub(crate) floor_mean: [f32; 3],
}

impl Maze {
    pub(crate) fn new(gpu: &crate::Gpu, shared: &Shared<'_>, textures: &TextureSet) -> Self {
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
            ],
        });
        // The numbers stand for `WALL`, `TOP`, `FLOOR` and `RIM` in the shader.
        let pipelines = [0.0, 1.0, 2.0, 3.0].map(|kind| {
            shared.pipeline(&PassPipeline {
                shader: shader::MAZE,
                constants: &[("kind", kind), ("sun_looks", shared.detail.sun_looks.into())],
                groups: &[Some(shared.frame_layout), Some(shared.light_layout), Some(&layout)],
                vertices: &[Some(Vertex::LAYOUT)],
                cull: Some(wgpu::Face::Back),
                writes_depth: true,
            })
        });
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("surface"),
            address_mode_u: wgpu::AddressMode::Repeat,
            address_mode_v: wgpu::AddressMode::Repeat,
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            anisotropy_clamp: shared.detail.anisotropy.clamp(1, 16),
            ..Default::default()
        });
        let wall = Mipmapped::new(gpu, "wall", &textures.wall);
        let floor = Mipmapped::new(gpu, "floor", &textures.floor);
        let top = Mipmapped::new(gpu, "top", &textures.top);
        let material = |texture: &Mipmapped, repeats_per_unit, roughness, reflectance| {
            let material = Material { repeats_per_unit, roughness, reflectance, unused: 0.0 };
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
                ],
            })
        };
        let materials = [
            material(&wall, WALL_REPEATS_PER_UNIT, 0.85, 0.03),
            material(&top, TOP_REPEATS_PER_UNIT, 0.65, 0.035),
            material(&floor, FLOOR_REPEATS_PER_UNIT, 0.38, 0.04),
            material(&floor, FLOOR_REPEATS_PER_UNIT, 0.45, 0.04),
        ];
        Self { pipelines, materials, floor_mean: floor.mean }
    }

    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, mesh: &Mesh) {
        mesh.bind(pass);
        // Walls and tops first: they hide much of the floor, which then is not shaded.
        for ((group, pipeline), material) in mesh.groups.iter().zip(&self.pipelines).zip(&self.materials) {
            if !group.is_empty() {
                pass.set_pipeline(pipeline);
                pass.set_bind_group(2, material, &[]);
                pass.draw_indexed(group.clone(), 0, 0..1);
            }
        }
    }
}
