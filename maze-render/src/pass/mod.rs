//! One pass a file; the bytes that a pass gives to its shader stand beside it.

pub(crate) mod background;
pub(crate) mod ball;
pub(crate) mod floor_light;
pub(crate) mod ghost;
pub(crate) mod lines;
pub(crate) mod material;
pub(crate) mod maze;
pub(crate) mod plain;
pub(crate) mod shadow;

pub use material::Material;

use nalgebra::{Matrix4, Vector3};

use crate::light::{self, Bounds};
use crate::quality::{Detail, Quality};
use crate::scene::{Marker, Scene};

/// Depth buffer of the picture and of the shadow map.
pub(crate) const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// Where the sky is brightest, in the world: leaned towards the player, so that the wall sides in view, which the
/// sun does not reach, are still well lit.
const SKY_IN_WORLD: [f32; 3] = [0.10, -0.55, 0.85];

/// What every shader knows about a frame, in the maze frame. Keep in sync with `Frame` in `shader/frame.wgsl`;
/// checked by `tests/shaders.rs`.
#[repr(C)]
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Frame {
    /// To the picture.
    pub clip_from_maze: [[f32; 4]; 4],
    /// And back.
    pub maze_from_clip: [[f32; 4]; 4],
    /// To the shadow map.
    pub sun_clip_from_maze: [[f32; 4]; 4],
    /// Position; two over the picture's width.
    pub eye: [f32; 4],
    /// Unit vector towards the sun; two over the picture's height.
    pub sun: [f32; 4],
    /// Unit vector up in the world; depth of the table below the origin.
    pub up: [f32; 4],
    /// Unit vector towards the brightest sky; height of the walls.
    pub sky: [f32; 4],
    /// Centre; radius.
    pub ball: [f32; 4],
    /// Quaternion (i, j, k, w), maze from ball.
    pub ball_rotation: [f32; 4],
    /// x, y; radius; unused.
    pub start: [f32; 4],
    /// x, y; radius; glow.
    pub goal: [f32; 4],
    /// Smallest x, y; largest x, y.
    pub board: [f32; 4],
    /// Occlusion map from maze x, y: scale; offset.
    pub occlusion: [f32; 4],
    /// Blur of the shadow map in its own coordinates x, y; distance to move off a surface before sampling; width
    /// of a soft edge in the floor's light.
    pub shadow: [f32; 4],
    /// The floor's mean colour, linear; unused.
    pub floor: [f32; 4],
    /// Centre; radius, 0 without a ghost.
    pub ghost: [f32; 4],
}

/// What a frame needs beside the scene: known once a maze is set.
pub(crate) struct Board {
    pub(crate) bounds: Bounds,
    pub(crate) uv_from_maze: [f32; 4],
    pub(crate) floor_mean: [f32; 3],
    pub(crate) sun_map_side: u32,
    /// Of a shadow's edge in the map of the floor's light (maze units).
    pub(crate) softness: f32,
}

impl Frame {
    pub(crate) fn new(scene: &Scene, board: &Board, size: [u32; 2]) -> Self {
        let bounds = &board.bounds;
        let aspect = size[0] as f32 / size[1] as f32;
        let maze_from_world = scene.world_from_maze.inverse();
        let turned = |v: [f32; 3]| maze_from_world * Vector3::from(v).normalize();
        let clip_from_maze = scene.camera.clip_from_world(aspect) * scene.world_from_maze.to_homogeneous();
        let sun = turned(light::SUN_IN_WORLD);
        let sun_clip_from_maze = light::sun_clip_from_maze(&sun, bounds);
        let with = |v: Vector3<f32>, w: f32| [v.x, v.y, v.z, w];
        let marker = |m: Marker, w: f32| [m.position[0], m.position[1], m.radius, w];
        // The table is further below a larger board: its corners swing lower.
        let drop = 0.6 + 0.10 * bounds.extent();
        let [bx, by, bz] = scene.ball.position;
        Self {
            clip_from_maze: columns(&clip_from_maze),
            maze_from_clip: columns(&clip_from_maze.try_inverse().unwrap_or_else(Matrix4::identity)),
            sun_clip_from_maze: columns(&sun_clip_from_maze),
            eye: with(maze_from_world * scene.camera.eye().coords, 2.0 / size[0] as f32),
            sun: with(sun, 2.0 / size[1] as f32),
            up: with(turned([0.0, 0.0, 1.0]), drop),
            sky: with(turned(SKY_IN_WORLD), bounds.max[2]),
            ball: [bx, by, bz, scene.ball.radius],
            ball_rotation: scene.ball.rotation.coords.into(),
            start: marker(scene.start, 0.0),
            goal: marker(scene.goal, scene.goal_glow),
            board: [bounds.min[0], bounds.min[1], bounds.max[0], bounds.max[1]],
            occlusion: board.uv_from_maze,
            shadow: shadow::blur(&sun_clip_from_maze, board.sun_map_side, board.softness),
            floor: with(board.floor_mean.into(), 0.0),
            ghost: ghost::sphere(scene),
        }
    }
}

fn columns(matrix: &Matrix4<f32>) -> [[f32; 4]; 4] {
    (*matrix).into()
}

/// What the passes of one renderer share.
pub(crate) struct Shared<'a> {
    pub(crate) device: &'a wgpu::Device,
    /// Group 0: [`Frame`].
    pub(crate) frame_layout: &'a wgpu::BindGroupLayout,
    /// Group 1: the shadow map and the occlusion map.
    pub(crate) light_layout: &'a wgpu::BindGroupLayout,
    pub(crate) target_format: wgpu::TextureFormat,
    pub(crate) n_samples: u32,
    pub(crate) quality: Quality,
    pub(crate) detail: Detail,
}

/// How one pass differs from the others.
#[derive(Clone, Copy)]
pub(crate) struct PassPipeline<'a> {
    pub(crate) shader: crate::Shader,
    /// Of the vertex and of the fragment stage.
    pub(crate) entry_points: [&'a str; 2],
    /// For the shader's `override`s, beside `encode_srgb`.
    pub(crate) constants: &'a [(&'a str, f64)],
    pub(crate) groups: &'a [Option<&'a wgpu::BindGroupLayout>],
    pub(crate) vertices: &'a [Option<wgpu::VertexBufferLayout<'a>>],
    pub(crate) cull: Option<wgpu::Face>,
    /// False leaves the depth as it is: for what lies behind everything.
    pub(crate) writes_depth: bool,
    /// Shown whatever is nearer.
    pub(crate) is_over_all: bool,
    pub(crate) topology: wgpu::PrimitiveTopology,
    pub(crate) blend: Option<wgpu::BlendState>,
    pub(crate) writes: wgpu::ColorWrites,
    /// Format and samples of a target other than the picture; it has no depth.
    pub(crate) target: Option<(wgpu::TextureFormat, u32)>,
}

impl PassPipeline<'_> {
    /// Triangles that replace what is farther away in the picture.
    pub(crate) fn new(shader: crate::Shader) -> Self {
        Self {
            shader,
            entry_points: ["vertex", "fragment"],
            constants: &[],
            groups: &[],
            vertices: &[],
            cull: None,
            writes_depth: true,
            is_over_all: false,
            topology: wgpu::PrimitiveTopology::TriangleList,
            blend: None,
            writes: wgpu::ColorWrites::ALL,
            target: None,
        }
    }
}

impl Shared<'_> {
    /// A pipeline that draws into the picture, or into the target it names.
    pub(crate) fn pipeline(&self, of: &PassPipeline<'_>) -> wgpu::RenderPipeline {
        let module = of.shader.module(self.device);
        let layout = self.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(of.shader.name),
            bind_group_layouts: of.groups,
            immediate_size: 0,
        });
        let (format, n_samples) = of.target.unwrap_or((self.target_format, self.n_samples));
        // Surfaces without an sRGB format (some browsers) get it from the shader.
        let encodes = f64::from(u8::from(!self.target_format.is_srgb()));
        let with_encoding = [of.constants, &[("encode_srgb", encodes)]].concat();
        let compilation_options = wgpu::PipelineCompilationOptions {
            constants: match of.target {
                None => &with_encoding,
                Some(_) => of.constants,
            },
            ..Default::default()
        };
        self.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(of.shader.name),
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some(of.entry_points[0]),
                compilation_options: compilation_options.clone(),
                buffers: of.vertices,
            },
            primitive: wgpu::PrimitiveState {
                topology: of.topology,
                cull_mode: of.cull,
                ..Default::default()
            },
            depth_stencil: of.target.is_none().then(|| wgpu::DepthStencilState {
                format: DEPTH_FORMAT,
                depth_write_enabled: Some(of.writes_depth),
                depth_compare: Some(if of.is_over_all {
                    wgpu::CompareFunction::Always
                } else {
                    wgpu::CompareFunction::LessEqual
                }),
                stencil: Default::default(),
                bias: Default::default(),
            }),
            multisample: wgpu::MultisampleState { count: n_samples, ..Default::default() },
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some(of.entry_points[1]),
                compilation_options,
                targets: &[Some(wgpu::ColorTargetState { format, blend: of.blend, write_mask: of.writes })],
            }),
            multiview_mask: None,
            cache: None,
        })
    }
}

/// Draws a part of the bound mesh, if it has any triangles.
fn draw_group(
    pass: &mut wgpu::RenderPass<'_>,
    pipeline: &wgpu::RenderPipeline,
    material: &wgpu::BindGroup,
    group: &std::ops::Range<u32>,
) {
    if !group.is_empty() {
        pass.set_pipeline(pipeline);
        pass.set_bind_group(2, material, &[]);
        pass.draw_indexed(group.clone(), 0, 0..1);
    }
}

/// A texture that the fragment shader reads.
pub(crate) fn texture_entry(
    binding: u32,
    sample_type: wgpu::TextureSampleType,
) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::FRAGMENT,
        ty: wgpu::BindingType::Texture {
            sample_type,
            view_dimension: wgpu::TextureViewDimension::D2,
            multisampled: false,
        },
        count: None,
    }
}

/// How the fragment shader reads a texture.
pub(crate) fn sampler_entry(binding: u32, ty: wgpu::SamplerBindingType) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::FRAGMENT,
        ty: wgpu::BindingType::Sampler(ty),
        count: None,
    }
}
