//! What draws a frame, in a window and without one: the maze, the HUD over it, and the adapter's time for both.

use crate::failure;
use crate::frame_log::FrameLog;
use crate::ui::Overlay;
use egui::{PlatformOutput, RawInput, Ui};
use maze_render::{Gpu, GpuTimer, Quality, Renderer, Scene, TextureSet};
use wgpu::{SubmissionIndex, TextureFormat, TextureView};

pub(crate) struct FramePainter {
    pub(crate) renderer: Renderer,
    pub(crate) overlay: Overlay,
    /// None where the adapter does not measure it.
    timer: Option<GpuTimer>,
}

impl FramePainter {
    /// For targets of a format. The maze has to be set.
    pub(crate) fn new(gpu: &Gpu, format: TextureFormat, textures: &TextureSet, quality: Quality) -> Self {
        let renderer = Renderer::with_quality(gpu, format, textures, quality);
        for note in renderer.notes() {
            failure::note(note);
        }
        let overlay = Overlay::new(gpu, renderer.target_format());
        Self { renderer, overlay, timer: GpuTimer::new(gpu) }
    }

    /// Draws the frame with the log's number `number` onto `view`, of a size in pixels and a scale of what is written, which
    /// `show` adds.
    pub(crate) fn draw(
        &mut self,
        gpu: &Gpu,
        (view, size, scale): (&TextureView, [u32; 2], f32),
        (scene, number): (&Scene, u64),
        input: RawInput,
        show: impl FnMut(&mut Ui),
    ) -> (SubmissionIndex, PlatformOutput) {
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        if let Some(timer) = &mut self.timer {
            timer.begin(&mut encoder, number);
        }
        self.renderer.draw(gpu, &mut encoder, view, size, scene);
        let output = self.overlay.draw(gpu, &mut encoder, (view, size, scale), input, show);
        if let Some(timer) = &mut self.timer {
            timer.end(&mut encoder);
        }
        let submitted = gpu.queue.submit([encoder.finish()]);
        if let Some(timer) = &mut self.timer {
            timer.submitted();
        }
        (submitted, output)
    }

    /// Writes the adapter's times of earlier frames into the log.
    pub(crate) fn note_times(&mut self, log: &mut FrameLog) {
        while let Some((number, seconds)) = self.timer.as_mut().and_then(GpuTimer::take) {
            log.set_gpu_time(number, seconds);
        }
    }
}
