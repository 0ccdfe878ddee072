//! All passes in order, and the textures they share.

use maze_core::surface::SurfaceMesh;

use crate::light::Bounds;
use crate::mesh::Mesh;
use crate::occlusion::OcclusionMap;
use crate::pass::background::Background;
use crate::pass::ball::Ball;
use crate::pass::floor_light::{FloorLight, FloorLightMap};
use crate::pass::ghost::Ghost;
use crate::pass::lines::Lines;
use crate::pass::material::Materials;
use crate::pass::maze::Maze;
use crate::pass::plain::Plain;
use crate::pass::shadow::Shadow;
use crate::pass::{self, Board, DEPTH_FORMAT, Frame, Shared};
use crate::scene::Scene;
use crate::texture::TextureSet;
use crate::{Gpu, GpuError, Quality};

/// Draws scenes of one maze at a time into targets of one format.
pub struct Renderer {
    target_format: wgpu::TextureFormat,
    n_samples: u32,
    frame_buffer: wgpu::Buffer,
    frame_group: wgpu::BindGroup,
    light_layout: wgpu::BindGroupLayout,
    quality: Quality,
    materials: Materials,
    background: Background,
    shadow: Shadow,
    maze: Surfaces,
    ball: Ball,
    ghost: Ghost,
    lines: Lines,
    board: Board,
    /// Made by [`Renderer::set_maze`]; nothing but the table is drawn before.
    content: Option<Content>,
    targets: Option<Targets>,
}

/// How the maze is drawn.
enum Surfaces {
    /// Lit at every pixel.
    Lit(Maze),
    /// Lit at corners and by a map of the floor.
    Plain(Plain, FloorLight),
}

struct Content {
    mesh: Mesh,
    light_group: wgpu::BindGroup,
    /// None where surfaces are lit at every pixel.
    floor_light: Option<FloorLightMap>,
}

/// What is drawn into before it is resolved into the caller's view.
struct Targets {
    size: [u32; 2],
    /// None when the adapter cannot multisample the format: the view is drawn to directly.
    colour: Option<wgpu::TextureView>,
    depth: wgpu::TextureView,
}

impl Renderer {
    /// Builds all pipelines and uploads the textures, once, for targets of `target_format`; at the quality that
    /// suits the adapter.
    pub fn new(gpu: &Gpu, target_format: wgpu::TextureFormat, textures: &TextureSet) -> Self {
        Self::with_quality(gpu, target_format, textures, Quality::for_adapter(&gpu.adapter_info))
    }

    /// [`Renderer::new`] at a quality of the caller's choice.
    pub fn with_quality(
        gpu: &Gpu,
        target_format: wgpu::TextureFormat,
        textures: &TextureSet,
        quality: Quality,
    ) -> Self {
        let detail = quality.detail(gpu.adapter_info.device_type);
        let device = &gpu.device;
        let features = gpu.adapter.get_texture_format_features(target_format).flags;
        let n_samples = if features.sample_count_supported(detail.n_samples) { detail.n_samples } else { 1 };
        let frame_layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("frame"),
            entries: &[wgpu::BindGroupLayoutEntry {
                binding: 0,
                visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
                ty: wgpu::BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Uniform,
                    has_dynamic_offset: false,
                    min_binding_size: wgpu::BufferSize::new(size_of::<Frame>() as u64),
                },
                count: None,
            }],
        });
        let light_layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("light"),
            entries: &[
                pass::texture_entry(0, wgpu::TextureSampleType::Depth),
                pass::sampler_entry(1, wgpu::SamplerBindingType::Comparison),
                pass::texture_entry(2, wgpu::TextureSampleType::Float { filterable: true }),
                pass::sampler_entry(3, wgpu::SamplerBindingType::Filtering),
                pass::texture_entry(4, wgpu::TextureSampleType::Float { filterable: true }),
            ],
        });
        let frame_buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("frame"),
            size: size_of::<Frame>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let frame_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("frame"),
            layout: &frame_layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: frame_buffer.as_entire_binding() }],
        });
        let shared = Shared {
            device,
            frame_layout: &frame_layout,
            light_layout: &light_layout,
            target_format,
            n_samples,
            quality,
            detail,
        };
        let materials = Materials::new(gpu, &shared, textures);
        let maze = match quality {
            Quality::Low => Surfaces::Plain(Plain::new(&shared, &materials), FloorLight::new(&shared)),
            Quality::Medium | Quality::High => Surfaces::Lit(Maze::new(&shared, &materials)),
        };
        let board = Board {
            bounds: Bounds::around(std::iter::empty()),
            uv_from_maze: [1.0, 1.0, 0.0, 0.0],
            floor_mean: materials.floor_mean,
            sun_map_side: detail.sun_map_side,
            softness: 0.0,
        };
        Self {
            background: Background::new(&shared),
            shadow: Shadow::new(&shared),
            ball: Ball::new(&shared, &materials),
            ghost: Ghost::new(&shared),
            lines: Lines::new(&shared),
            maze,
            quality,
            materials,
            board,
            content: None,
            targets: None,
            target_format,
            n_samples,
            frame_buffer,
            frame_group,
            light_layout,
        }
    }

    /// Uploads the maze that the next scenes show; a refused one leaves the last one in place.
    ///
    /// The soft darkness at the foot of walls takes a bounded time: should the wall tops cover 2^25 rows of its map
    /// (a texel high, counted for each triangle; tops that do not overlap come to a seventh), the rest cast none.
    ///
    /// # Errors
    ///
    /// [`GpuError::MazeTooLarge`] when the vertices or the indices, the board's rim included, take more bytes than the
    /// adapter allows in a buffer; [`GpuError::VertexOutOfRange`] for an index beyond the vertices; both before
    /// anything is allocated on the adapter. [`GpuError::Device`] when it is out of memory or lost.
    pub fn set_maze(&mut self, gpu: &Gpu, mesh: &SurfaceMesh) -> Result<(), GpuError> {
        let uploaded = Mesh::of_maze(gpu, mesh, matches!(self.maze, Surfaces::Plain(..)))?;
        self.board.bounds = Bounds::around(mesh.vertices.iter().map(|v| v.position));
        let occlusion = OcclusionMap::new(mesh, &self.board.bounds);
        self.board.uv_from_maze = occlusion.uv_from_maze;
        self.content = uploaded.map(|mesh| self.content(gpu, mesh, &occlusion));
        let floor_light = self.content.as_ref().and_then(|content| content.floor_light.as_ref());
        self.board.softness = floor_light.map_or(0.0, |map| map.softness(&occlusion.uv_from_maze));
        Ok(())
    }

    fn content(&self, gpu: &Gpu, mesh: Mesh, occlusion: &OcclusionMap) -> Content {
        let size =
            wgpu::Extent3d { width: occlusion.width, height: occlusion.height, depth_or_array_layers: 1 };
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("occlusion"),
            size,
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rg8Unorm,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        gpu.queue.write_texture(
            texture.as_image_copy(),
            occlusion.texels.as_flattened(),
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(2 * occlusion.width),
                rows_per_image: None,
            },
            size,
        );
        let linear = wgpu::SamplerDescriptor {
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            ..Default::default()
        };
        let compare = wgpu::SamplerDescriptor {
            label: Some("shadow map"),
            compare: Some(wgpu::CompareFunction::LessEqual),
            ..linear.clone()
        };
        let view = texture.create_view(&Default::default());
        let linear = gpu.device.create_sampler(&linear);
        let floor_light = match &self.maze {
            Surfaces::Plain(_, pass) => {
                Some(pass.map(&gpu.device, [occlusion.width, occlusion.height], &view, &linear))
            }
            Surfaces::Lit(_) => None,
        };
        let light_group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("light"),
            layout: &self.light_layout,
            entries: &[
                wgpu::BindGroupEntry {
                    binding: 0,
                    resource: wgpu::BindingResource::TextureView(&self.shadow.map),
                },
                wgpu::BindGroupEntry {
                    binding: 1,
                    resource: wgpu::BindingResource::Sampler(&gpu.device.create_sampler(&compare)),
                },
                wgpu::BindGroupEntry { binding: 2, resource: wgpu::BindingResource::TextureView(&view) },
                wgpu::BindGroupEntry { binding: 3, resource: wgpu::BindingResource::Sampler(&linear) },
                wgpu::BindGroupEntry {
                    binding: 4,
                    // Where the floor's light is not sampled, any picture will do.
                    resource: wgpu::BindingResource::TextureView(
                        floor_light.as_ref().map_or(&view, |map| &map.view),
                    ),
                },
            ],
        });
        Content { mesh, light_group, floor_light }
    }

    /// What is spent on a picture.
    pub fn quality(&self) -> Quality {
        self.quality
    }

    /// What is drawn differently from what was asked for, a line each: textures beyond the adapter's limit.
    pub fn notes(&self) -> &[String] {
        &self.materials.notes
    }

    /// The format of the views that [`Renderer::draw`] takes.
    pub fn target_format(&self) -> wgpu::TextureFormat {
        self.target_format
    }

    /// Records the whole picture of `scene` into `view`, which is `size` pixels; overwrites what was there.
    ///
    /// Submit the encoder before the next call: the frame's numbers are in one buffer, written at submission.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        view: &wgpu::TextureView,
        size: [u32; 2],
        scene: &Scene,
    ) {
        let size = size.map(|n| n.max(1));
        let frame = Frame::new(scene, &self.board, size);
        gpu.queue.write_buffer(&self.frame_buffer, 0, bytemuck::bytes_of(&frame));
        self.lines.set(gpu, &scene.lines, &scene.patches);
        let shows_ball = 0.0 < scene.ball.radius;
        if let Some(Content { mesh, floor_light, .. }) = &mut self.content {
            match (&self.maze, floor_light) {
                (Surfaces::Plain(_, pass), Some(map)) => {
                    pass.draw(encoder, &self.frame_group, map, mesh, shows_ball);
                }
                _ => self.shadow.draw(encoder, &self.frame_group, mesh),
            }
        }
        let targets = match self.targets.take() {
            Some(targets) if targets.size == size => targets,
            _ => Targets::new(gpu, self.target_format, self.n_samples, size),
        };
        let targets = self.targets.insert(targets);
        let (attached, resolve_target) = match &targets.colour {
            Some(colour) => (colour, Some(view)),
            None => (view, None),
        };
        // The samples are of no use once resolved; without them the view itself is kept.
        let store = if resolve_target.is_some() { wgpu::StoreOp::Discard } else { wgpu::StoreOp::Store };
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("picture"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: attached,
                depth_slice: None,
                resolve_target,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &targets.depth,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: wgpu::StoreOp::Discard,
                }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_bind_group(0, &self.frame_group, &[]);
        if let Some(content) = &self.content {
            pass.set_bind_group(1, &content.light_group, &[]);
            match &self.maze {
                _ if !scene.shows_maze => {}
                Surfaces::Lit(maze) => maze.draw(&mut pass, &self.materials, &content.mesh),
                Surfaces::Plain(plain, _) => plain.draw(&mut pass, &self.materials, &content.mesh),
            }
        }
        // After the maze: only what nothing covers is shaded.
        self.background.draw(&mut pass);
        if let Some(content) = &self.content {
            if let Surfaces::Plain(plain, _) = &self.maze
                && scene.shows_maze
            {
                plain.draw_over(&mut pass, &self.materials, &content.mesh);
            }
            if shows_ball {
                self.ball.draw(&mut pass, &self.materials);
            }
            // After all that is solid.
            if scene.ghost.is_some_and(|ghost| 0.0 < ghost.radius) {
                self.ghost.draw(&mut pass);
            }
        }
        self.lines.draw(&mut pass);
    }
}

impl Targets {
    fn new(gpu: &Gpu, format: wgpu::TextureFormat, n_samples: u32, size: [u32; 2]) -> Self {
        let make = |label, format| {
            let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count: n_samples,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
                view_formats: &[],
            });
            texture.create_view(&Default::default())
        };
        Self {
            size,
            colour: (1 < n_samples).then(|| make("samples", format)),
            depth: make("depth", DEPTH_FORMAT),
        }
    }
}
