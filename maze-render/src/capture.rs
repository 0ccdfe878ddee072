//! A frame as a picture, without a window.

use image::RgbaImage;

use crate::{Gpu, GpuError, Renderer, Scene};

/// Make a [`Renderer`] for this format when it draws pictures only.
pub const CAPTURE_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;

/// Draws `scene` offscreen and brings the picture back: sRGB, opaque, the top row first.
///
/// The same device, maze and scene give the same bytes. Takes a renderer of any 8-bit format, so also a window's. Waits
/// for the device, which a browser does not allow.
///
/// # Errors
///
/// [`GpuError::PictureSize`] for a side of zero or one longer than [`Gpu::max_side`]; [`GpuError::Device`] when the
/// renderer's format is no 8-bit one, and for whatever the device reported, also before.
pub fn capture(
    gpu: &Gpu,
    renderer: &mut Renderer,
    size: [u32; 2],
    scene: &Scene,
) -> Result<RgbaImage, GpuError> {
    capture_over(gpu, renderer, size, scene, |_, _| {})
}

/// [`capture`] with more recorded over the scene, such as the letters of a [`crate::Painter`].
///
/// # Errors
///
/// As [`capture`].
pub fn capture_over(
    gpu: &Gpu,
    renderer: &mut Renderer,
    size: [u32; 2],
    scene: &Scene,
    draw_over: impl FnOnce(&mut wgpu::CommandEncoder, &wgpu::TextureView),
) -> Result<RgbaImage, GpuError> {
    let [width, height] = size;
    let max = gpu.max_side();
    if width == 0 || height == 0 || max < width || max < height {
        return Err(GpuError::PictureSize { width, height, max });
    }
    let format = renderer.target_format();
    if format.block_copy_size(None) != Some(4) {
        return Err(GpuError::Device(format!("pictures are made in 8-bit formats, not {format:?}")));
    }
    let extent = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("picture"),
        size: extent,
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    let padded_row = (4 * width).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    if gpu.device.limits().max_buffer_size < u64::from(padded_row) * u64::from(height) {
        return Err(GpuError::Device(format!(
            "a picture of {width}x{height} pixels does not fit into a buffer"
        )));
    }
    let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("picture"),
        size: u64::from(padded_row) * u64::from(height),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let view = texture.create_view(&Default::default());
    renderer.draw(gpu, &mut encoder, &view, size, scene);
    draw_over(&mut encoder, &view);
    encoder.copy_texture_to_buffer(
        texture.as_image_copy(),
        wgpu::TexelCopyBufferInfo {
            buffer: &buffer,
            layout: wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(padded_row),
                rows_per_image: None,
            },
        },
        extent,
    );
    gpu.queue.submit([encoder.finish()]);
    let device_error = |e: &dyn std::fmt::Display| GpuError::Device(format!("reading the picture: {e}"));
    let (sender, receiver) = std::sync::mpsc::channel();
    // The receiver outlives the callback; a failed send would only mean that the receiver is gone.
    buffer.map_async(wgpu::MapMode::Read, .., move |result| drop(sender.send(result)));
    gpu.device.poll(wgpu::PollType::wait_indefinitely()).map_err(|e| device_error(&e))?;
    if let Some(error) = gpu.take_error() {
        return Err(error);
    }
    receiver.recv().map_err(|e| device_error(&e))?.map_err(|e| device_error(&e))?;
    let mapped = buffer.get_mapped_range(..).map_err(|e| device_error(&e))?;
    let is_bgra = matches!(format.remove_srgb_suffix(), wgpu::TextureFormat::Bgra8Unorm);
    let mut pixels = Vec::with_capacity(4 * width as usize * height as usize);
    for row in mapped.chunks_exact(padded_row as usize) {
        for &[r, g, b, _] in row[..4 * width as usize].as_chunks::<4>().0 {
            pixels.extend(if is_bgra { [b, g, r, u8::MAX] } else { [r, g, b, u8::MAX] });
        }
    }
    RgbaImage::from_raw(width, height, pixels)
        .ok_or_else(|| GpuError::Device("the picture came back with too few bytes".to_owned()))
}
