//! What is written over the picture, with egui.

mod frames_panel;
mod hud;

pub(crate) use frames_panel::FramesPanel;
pub(crate) use hud::Hud;

use egui_wgpu::{Renderer, RendererOptions, ScreenDescriptor};
use maze_render::Gpu;
use wgpu::{CommandEncoder, TextureFormat, TextureView};

/// Draws egui over a finished frame.
pub(crate) struct Overlay {
    context: egui::Context,
    renderer: Renderer,
}

impl Overlay {
    pub(crate) fn new(gpu: &Gpu, format: TextureFormat) -> Self {
        let context = egui::Context::default();
        hud::style(&context);
        Self { context, renderer: Renderer::new(&gpu.device, format, RendererOptions::default()) }
    }

    /// Lays out the HUD and encodes a pass that draws it over `view`.
    #[allow(
        clippy::iter_over_hash_type,
        reason = "each texture is set or freed by itself, in whatever order"
    )]
    pub(crate) fn draw(
        &mut self,
        gpu: &Gpu,
        encoder: &mut CommandEncoder,
        view: &TextureView,
        size: [u32; 2],
        scale: f32,
        hud: &Hud,
    ) {
        let screen = ScreenDescriptor { size_in_pixels: size, pixels_per_point: scale };
        let [width, height] = size.map(|pixels| to_points(pixels, scale));
        let mut input = egui::RawInput {
            screen_rect: Some(egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(width, height))),
            ..Default::default()
        };
        if let Some(viewport) = input.viewports.get_mut(&input.viewport_id) {
            viewport.native_pixels_per_point = Some(scale);
        }
        let mut output = self.context.run_ui(input, |ui| hud.show(ui));
        for (id, deltas) in output.textures_delta.set.drain() {
            for delta in deltas {
                self.renderer.update_texture(&gpu.device, &gpu.queue, id, &delta);
            }
        }
        let shapes = self.context.tessellate(output.shapes, output.pixels_per_point);
        // egui returns command buffers only for paint callbacks, of which there are none.
        let _ = self.renderer.update_buffers(&gpu.device, &gpu.queue, encoder, &shapes, &screen);
        let pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("hud"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Load, store: wgpu::StoreOp::Store },
            })],
            ..Default::default()
        });
        self.renderer.render(&mut pass.forget_lifetime(), &shapes, &screen);
        for id in output.textures_delta.free.drain() {
            self.renderer.free_texture(&id);
        }
    }
}

/// Pixels in the units of the HUD: the window system's scale taken out.
#[allow(clippy::cast_precision_loss, reason = "no window is 2^24 pixels wide")]
pub(crate) fn to_points(pixels: u32, scale: f32) -> f32 {
    pixels as f32 / scale
}
