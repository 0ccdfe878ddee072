//! Flat triangles over a finished picture, for letters and panels: what a user interface library hands over.

use crate::pass::{sampler_entry, texture_entry};
use crate::{Gpu, shader};

/// A corner of a flat triangle. Keep in sync with `vertex` in `shader/paint.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct PaintVertex {
    /// From the upper left (points).
    pub position: [f32; 2],
    /// In the atlas, 0 to 1.
    pub uv: [f32; 2],
    /// sRGB with premultiplied alpha; multiplies the atlas.
    pub colour: [u8; 4],
}

/// Triangles that show inside a rectangle only.
#[derive(Clone, Debug, PartialEq)]
pub struct PaintBatch {
    /// Left, top, right, bottom (points).
    pub clip: [f32; 4],
    /// Corners.
    pub vertices: Vec<PaintVertex>,
    /// Three for each triangle, into `vertices`.
    pub indices: Vec<u32>,
}

/// Draws [`PaintBatch`]es with one atlas of letters.
pub struct Painter {
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
    screen: wgpu::Buffer,
    sampler: wgpu::Sampler,
    /// None before the first picture of it.
    atlas: Option<(wgpu::Texture, wgpu::BindGroup)>,
    vertices: Growing,
    indices: Growing,
}

/// A buffer that is replaced by a larger one when it has to be.
pub(crate) struct Growing {
    usage: wgpu::BufferUsages,
    buffer: Option<wgpu::Buffer>,
}

impl Growing {
    pub(crate) fn new(usage: wgpu::BufferUsages) -> Self {
        Self { usage: usage | wgpu::BufferUsages::COPY_DST, buffer: None }
    }

    /// What was written last; none before.
    pub(crate) fn buffer(&self) -> Option<&wgpu::Buffer> {
        self.buffer.as_ref()
    }

    pub(crate) fn write(&mut self, gpu: &Gpu, bytes: &[u8]) -> &wgpu::Buffer {
        let n_bytes = bytes.len() as u64;
        let fitting = self.buffer.take().filter(|buffer| n_bytes <= buffer.size());
        let buffer = fitting.unwrap_or_else(|| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("paint"),
                size: n_bytes.next_power_of_two(),
                usage: self.usage,
                mapped_at_creation: false,
            })
        });
        gpu.queue.write_buffer(&buffer, 0, bytes);
        self.buffer.insert(buffer)
    }
}

impl Painter {
    /// For targets of `format`.
    pub fn new(gpu: &Gpu, format: wgpu::TextureFormat) -> Self {
        let device = &gpu.device;
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("paint"),
            entries: &[
                wgpu::BindGroupLayoutEntry {
                    binding: 0,
                    visibility: wgpu::ShaderStages::VERTEX,
                    ty: wgpu::BindingType::Buffer {
                        ty: wgpu::BufferBindingType::Uniform,
                        has_dynamic_offset: false,
                        min_binding_size: wgpu::BufferSize::new(16),
                    },
                    count: None,
                },
                texture_entry(1, wgpu::TextureSampleType::Float { filterable: true }),
                sampler_entry(2, wgpu::SamplerBindingType::Filtering),
            ],
        });
        let linear = wgpu::FilterMode::Linear;
        Self {
            pipeline: pipeline(device, &layout, format),
            layout,
            screen: device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("paint"),
                size: 16,
                usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            }),
            sampler: device.create_sampler(&wgpu::SamplerDescriptor {
                label: Some("paint"),
                mag_filter: linear,
                min_filter: linear,
                ..Default::default()
            }),
            atlas: None,
            vertices: Growing::new(wgpu::BufferUsages::VERTEX),
            indices: Growing::new(wgpu::BufferUsages::INDEX),
        }
    }

    /// Replaces the atlas, or with `origin` a part of it; `rgba` has 4 bytes for each of `size` pixels, row by row.
    pub fn set_atlas(&mut self, gpu: &Gpu, size: [u32; 2], origin: Option<[u32; 2]>, rgba: &[u8]) {
        let extent = wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 };
        if origin.is_none() {
            let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
                label: Some("paint"),
                size: extent,
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: wgpu::TextureFormat::Rgba8Unorm,
                usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
                view_formats: &[],
            });
            let view = texture.create_view(&Default::default());
            let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("paint"),
                layout: &self.layout,
                entries: &[
                    wgpu::BindGroupEntry { binding: 0, resource: self.screen.as_entire_binding() },
                    wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::TextureView(&view) },
                    wgpu::BindGroupEntry {
                        binding: 2,
                        resource: wgpu::BindingResource::Sampler(&self.sampler),
                    },
                ],
            });
            self.atlas = Some((texture, group));
        }
        let Some((texture, _)) = &self.atlas else { return };
        let [x, y] = origin.unwrap_or_default();
        gpu.queue.write_texture(
            wgpu::TexelCopyTextureInfo { origin: wgpu::Origin3d { x, y, z: 0 }, ..texture.as_image_copy() },
            rgba,
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * size[0]), rows_per_image: None },
            extent,
        );
    }

    /// Records a pass that draws over `view`, which is `size` pixels. Submit the encoder before the next call.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        view: &wgpu::TextureView,
        size: [u32; 2],
        pixels_per_point: f32,
        batches: &[PaintBatch],
    ) {
        let Some((_, group)) = &self.atlas else { return };
        let vertices: Vec<PaintVertex> = batches.iter().flat_map(|batch| &batch.vertices).copied().collect();
        let indices: Vec<u32> = batches.iter().flat_map(|batch| &batch.indices).copied().collect();
        if indices.is_empty() {
            return;
        }
        let [width, height] = size.map(|side| side as f32 / pixels_per_point);
        gpu.queue.write_buffer(&self.screen, 0, bytemuck::cast_slice(&[width, height, 0.0, 0.0]));
        let vertices = self.vertices.write(gpu, bytemuck::cast_slice(&vertices));
        let indices = self.indices.write(gpu, bytemuck::cast_slice(&indices));
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("paint"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Load, store: wgpu::StoreOp::Store },
            })],
            ..Default::default()
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, group, &[]);
        pass.set_vertex_buffer(0, vertices.slice(..));
        pass.set_index_buffer(indices.slice(..), wgpu::IndexFormat::Uint32);
        let (mut first_index, mut first_vertex) = (0, 0);
        for batch in batches {
            let end = first_index + u32::try_from(batch.indices.len()).unwrap_or(0);
            if let Some([x, y, width, height]) = scissor(batch.clip, pixels_per_point, size) {
                pass.set_scissor_rect(x, y, width, height);
                pass.draw_indexed(first_index..end, first_vertex, 0..1);
            }
            first_index = end;
            first_vertex += i32::try_from(batch.vertices.len()).unwrap_or(0);
        }
    }
}

/// Left, top, width and height in pixels of what a clip leaves of the picture; `None` when nothing.
fn scissor(clip: [f32; 4], pixels_per_point: f32, size: [u32; 2]) -> Option<[u32; 4]> {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to the picture")]
    let pixel = |at: f32, side: u32| (at * pixels_per_point).round().clamp(0.0, side as f32) as u32;
    let [left, right] = [clip[0], clip[2]].map(|x| pixel(x, size[0]));
    let [top, bottom] = [clip[1], clip[3]].map(|y| pixel(y, size[1]));
    (left < right && top < bottom).then(|| [left, top, right - left, bottom - top])
}

fn pipeline(
    device: &wgpu::Device,
    layout: &wgpu::BindGroupLayout,
    format: wgpu::TextureFormat,
) -> wgpu::RenderPipeline {
    let module = shader::PAINT.module(device);
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("paint"),
        bind_group_layouts: &[Some(layout)],
        immediate_size: 0,
    });
    // Colours are sRGB: as they are where the target is plain.
    let encodes = f64::from(u8::from(!format.is_srgb()));
    let compilation_options =
        wgpu::PipelineCompilationOptions { constants: &[("encode_srgb", encodes)], ..Default::default() };
    let attributes = wgpu::vertex_attr_array![0 => Float32x2, 1 => Float32x2, 2 => Unorm8x4];
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("paint"),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vertex"),
            compilation_options: compilation_options.clone(),
            buffers: &[Some(wgpu::VertexBufferLayout {
                array_stride: size_of::<PaintVertex>() as u64,
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes: &attributes,
            })],
        },
        primitive: Default::default(),
        depth_stencil: None,
        multisample: Default::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("fragment"),
            compilation_options,
            targets: &[Some(wgpu::ColorTargetState {
                format,
                blend: Some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING),
                write_mask: wgpu::ColorWrites::ALL,
            })],
        }),
        multiview_mask: None,
        cache: None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clip_never_leaves_the_picture() {
        let size = [100, 50];
        assert_eq!(scissor([-10.0, 5.0, 20.0, 400.0], 2.0, size), Some([0, 10, 40, 40]));
        assert_eq!(scissor([60.0, 0.0, 90.0, 10.0], 2.0, size), None, "to the right of it");
        assert_eq!(scissor([f32::NAN, 0.0, f32::NAN, 10.0], 1.0, size), None);
    }
}
