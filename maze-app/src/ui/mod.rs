//! What is written over the picture, with egui.

mod frames_panel;
mod hud;
mod letters;
pub(crate) mod menu;
mod notes_panel;

pub(crate) use frames_panel::FramesPanel;
pub(crate) use hud::{GOLD, Hud, Labels, clock_text, plan_of, room, seconds};
pub(crate) use letters::{readable, window_title};
pub(crate) use notes_panel::covered_width;

use crate::numbers::to_points;
use crate::overlay::Notes;
use egui::ClippedPrimitive;
use egui::epaint::{ImageData, Primitive};
use image::RgbaImage;
use maze_render::{Gpu, GpuError, PaintBatch, PaintVertex, Painter, Renderer, Scene};
use wgpu::{CommandEncoder, TextureFormat, TextureView};

/// Draws egui over a finished frame. The library's own wgpu renderer asks a texture in two ways and picks one by a
/// uniform, which a software driver pays for at every pixel: 6 ms of the processor a frame instead of 2.
pub(crate) struct Overlay {
    context: egui::Context,
    painter: Painter,
}

impl Overlay {
    pub(crate) fn new(gpu: &Gpu, format: TextureFormat) -> Self {
        let context = egui::Context::default();
        hud::style(&context);
        Self { context, painter: Painter::new(gpu, format) }
    }

    /// Lays out what `show` adds and encodes a pass that draws it over `view`.
    pub(crate) fn draw(
        &mut self,
        gpu: &Gpu,
        encoder: &mut CommandEncoder,
        (view, size, scale): (&TextureView, [u32; 2], f32),
        mut input: egui::RawInput,
        mut show: impl FnMut(&mut egui::Ui),
    ) -> egui::PlatformOutput {
        let points_per_pixel = scale * self.context.zoom_factor();
        let [width, height] = size.map(|pixels| to_points(pixels, points_per_pixel));
        input.screen_rect = Some(egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(width, height)));
        if let Some(viewport) = input.viewports.get_mut(&input.viewport_id) {
            viewport.native_pixels_per_point = Some(scale);
        }
        let mut output = self.context.run_ui(input, |ui| show(ui));
        // Only the letters have a texture.
        for delta in output.textures_delta.set.drain().flat_map(|(_, deltas)| deltas) {
            let ImageData::Color(image) = &delta.image;
            let pixels: Vec<u8> = image.pixels.iter().flat_map(|pixel| pixel.to_array()).collect();
            self.painter.set_atlas(
                gpu,
                image.size.map(to_u32),
                delta.pos.map(|pos| pos.map(to_u32)),
                &pixels,
            );
        }
        output.textures_delta.free.clear();
        let shapes = self.context.tessellate(output.shapes, output.pixels_per_point);
        let batches: Vec<_> = shapes.into_iter().filter_map(batch).collect();
        self.painter.draw(gpu, encoder, view, size, output.pixels_per_point, &batches);
        output.platform_output
    }

    pub(crate) fn context(&self) -> &egui::Context {
        &self.context
    }

    /// Focus, scroll and zoom of another one that this one replaces.
    pub(crate) fn continue_from(&self, other: &Self) {
        let memory = other.context.memory(Clone::clone);
        self.context.memory_mut(|own| *own = memory);
        self.context.set_zoom_factor(other.context.zoom_factor());
    }
}

/// A scene as a picture, and over it the method's notes.
pub(crate) fn picture(
    gpu: &Gpu,
    renderer: &mut Renderer,
    size: [u32; 2],
    scale: f32,
    scene: &Scene,
    notes: &Notes,
) -> Result<RgbaImage, GpuError> {
    let mut overlay = Overlay::new(gpu, renderer.target_format());
    maze_render::capture_over(gpu, renderer, size, scene, |encoder, view| {
        if *notes != Notes::default() {
            overlay.draw(gpu, encoder, (view, size, scale), egui::RawInput::default(), |ui| {
                notes.show_tags(ui);
                notes.show_panels(ui, hud::MARGIN);
            });
        }
    })
}

fn batch(shape: ClippedPrimitive) -> Option<PaintBatch> {
    let Primitive::Mesh(mesh) = shape.primitive else { return None };
    let vertex = |v: &egui::epaint::Vertex| PaintVertex {
        position: v.pos.into(),
        uv: v.uv.into(),
        colour: v.color.to_array(),
    };
    let clip = shape.clip_rect;
    Some(PaintBatch {
        clip: [clip.left(), clip.top(), clip.right(), clip.bottom()],
        vertices: mesh.vertices.iter().map(vertex).collect(),
        indices: mesh.indices,
    })
}

fn to_u32(side: usize) -> u32 {
    u32::try_from(side).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine_kind::EngineKind;
    use crate::input::Keyboard;
    use crate::session::Session;
    use maze_core::layout;

    fn maze() -> maze_core::Maze {
        layout::recursive_backtracker(3, 2, 1).unwrap().maze(&Default::default()).unwrap()
    }

    #[test]
    fn the_first_frame_shows_all_that_the_second_does() {
        let context = egui::Context::default();
        hud::style(&context);
        let (labels, notes, keyboard) = (Labels::default(), Notes::default(), Keyboard::default());
        let session = Session::new(maze(), EngineKind::Continuous).unwrap();
        let hud =
            Hud { notice: Some("maze.txt: no such file"), ..Hud::of(&session, &labels, &keyboard, &notes) };
        let frame = || {
            let screen = egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(1280.0, 720.0));
            let input = egui::RawInput { screen_rect: Some(screen), ..Default::default() };
            let mut output = context.run_ui(input, |ui| hud.show(ui));
            output.textures_delta.set.drain().for_each(drop);
            let shapes = context.tessellate(output.shapes, output.pixels_per_point);
            shapes.into_iter().filter_map(batch).collect::<Vec<_>>()
        };
        let first = frame();
        assert!(!first.is_empty() && first == frame());
    }
}
