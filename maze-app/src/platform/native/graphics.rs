//! The window's GPU side: device, renderer, HUD; rebuilt when the device is lost.

use super::display;
use crate::failure::Failure;
use crate::frame::FramePainter;
use crate::frame_log::{FrameLog, Stopwatch};
use crate::numbers::to_f32;
use crate::overlay::Notes;
use crate::quality::QualityChoice;
use crate::settings::Settings;
use crate::ui;
use image::RgbaImage;
use maze_core::Maze;
use maze_render::{Acquired, Gpu, Quality, Scene, TextureSet, WindowTarget};
use std::sync::Arc;
use std::time::Duration;
use winit::event_loop::{ActiveEventLoop, OwnedDisplayHandle};
use winit::window::{Fullscreen, Window};

/// Frame caps: presenting in step with the screen is not reliable everywhere (a virtual display never waits), and a
/// software driver shares its cores with the game.
const FRAMES_PER_S: u32 = 240;
const SOFTWARE_FRAMES_PER_S: u32 = 60;

/// How often a lost device is replaced before the game gives up.
const MAX_REBUILDS: u32 = 3;

pub(super) enum Drawn {
    /// What our thread did (ms of the processor): recording and handing over; waiting for the window and giving back.
    Shown {
        encode: f64,
        present: f64,
    },
    /// Nothing to show it on just now.
    Hidden,
    DeviceLost,
}

pub(super) struct Graphics {
    window: Arc<Window>,
    display: OwnedDisplayHandle,
    gpu: Gpu,
    target: WindowTarget,
    painter: FramePainter,
    n_rebuilds: u32,
    /// Turns the window's events into those of the screens.
    input: egui_winit::State,
    /// Where the pointer is (pixels).
    cursor: [f64; 2],
}

impl Graphics {
    pub(super) fn new(
        event_loop: &ActiveEventLoop,
        window: Window,
        textures: &TextureSet,
        quality: QualityChoice,
    ) -> Result<Self, Failure> {
        Self::build(event_loop.owned_display_handle(), Arc::new(window), textures, |gpu| quality.on(gpu), 0)
    }

    fn build(
        display: OwnedDisplayHandle,
        window: Arc<Window>,
        textures: &TextureSet,
        quality: impl FnOnce(&Gpu) -> Quality,
        n_rebuilds: u32,
    ) -> Result<Self, Failure> {
        let size = window.inner_size().into();
        let (gpu, mut target) =
            Gpu::for_window(window.clone(), Box::new(display.clone()), size).map_err(Failure::bad_input)?;
        let quality = quality(&gpu);
        target.set_srgb(&gpu, quality.wants_srgb_target());
        let painter = FramePainter::new(&gpu, target.format(), textures, quality);
        let input = input_for(&painter, &window, &gpu);
        Ok(Self { window, display, gpu, target, painter, n_rebuilds, input, cursor: [0.0; 2] })
    }

    /// Draws at another quality or with other textures from now on. The maze has to be set again.
    pub(super) fn set_look(&mut self, quality: Quality, textures: &TextureSet) {
        self.target.set_srgb(&self.gpu, quality.wants_srgb_target());
        let painter = FramePainter::new(&self.gpu, self.target.format(), textures, quality);
        painter.overlay.continue_from(&self.painter.overlay);
        self.painter = painter;
        self.input = input_for(&self.painter, &self.window, &self.gpu);
    }

    /// An event of the window, for the screens.
    pub(super) fn feed(&mut self, event: &winit::event::WindowEvent) {
        if let winit::event::WindowEvent::CursorMoved { position, .. } = event {
            self.cursor = (*position).into();
        }
        // What it consumes is decided by the screen in front, not here.
        let _ = self.input.on_window_event(&self.window, event);
    }

    pub(super) fn set_vsync(&mut self, vsync: bool) {
        self.target.set_vsync(&self.gpu, vsync);
    }

    pub(super) fn quality_of(&self, choice: QualityChoice) -> Quality {
        choice.on(&self.gpu)
    }

    /// How large everything is written, by the window's height and the player's choice.
    pub(super) fn set_zoom(&self, settings: &Settings) {
        let height = crate::numbers::to_points(self.target.size()[1], self.scale());
        self.painter.overlay.context().set_zoom_factor(settings.zoom(height));
    }

    /// Until the adapter has drawn all that it was given.
    pub(super) fn wait(&self) {
        // A device that is lost instead is reported at the next frame.
        let _ = self.gpu.device.poll(wgpu::PollType::wait_indefinitely());
    }

    pub(super) fn quality(&self) -> Quality {
        self.painter.renderer.quality()
    }

    /// Name of the adapter, backend, driver.
    pub(super) fn adapter(&self) -> String {
        self.gpu.describe()
    }

    /// Width and height in pixels.
    pub(super) fn size(&self) -> [u32; 2] {
        self.target.size()
    }

    pub(super) fn set_fullscreen(&self, is_on: bool) {
        if is_on != self.window.fullscreen().is_some() {
            self.window.set_fullscreen(is_on.then_some(Fullscreen::Borderless(None)));
        }
    }

    /// The scene and the method's notes, without the rest of the HUD.
    pub(super) fn screenshot(&mut self, scene: &Scene, notes: &Notes) -> Result<RgbaImage, Failure> {
        let (size, scale) = (self.target.size(), self.scale());
        ui::picture(&self.gpu, &mut self.painter.renderer, size, scale, scene, notes)
            .map_err(Failure::bad_input)
    }

    /// A new device in place of a lost one. The maze has to be set again.
    pub(super) fn rebuilt(self, textures: &TextureSet) -> Result<Self, Failure> {
        if self.n_rebuilds == MAX_REBUILDS {
            return Err(Failure::bad_input(format!(
                "the graphics device was lost {} times; is the driver all right?",
                MAX_REBUILDS + 1
            )));
        }
        let quality = self.quality();
        let Self { display, window, n_rebuilds, .. } = self;
        Self::build(display, window, textures, |_| quality, n_rebuilds + 1)
    }

    pub(super) fn set_maze(&mut self, maze: &Maze, title: &str) -> Result<(), Failure> {
        self.painter.renderer.set_maze(&self.gpu, &maze.surface).map_err(Failure::bad_input)?;
        self.window.set_title(title);
        Ok(())
    }

    /// Whether there is anything to draw on: some systems minimise a window to nothing.
    pub(super) fn has_area(&self) -> bool {
        self.target.has_area()
    }

    pub(super) fn resize(&mut self, size: [u32; 2]) {
        self.target.resize(&self.gpu, size);
    }

    pub(super) fn request_redraw(&self) {
        self.window.request_redraw();
    }

    /// Width over height.
    pub(super) fn aspect(&self) -> f32 {
        let [width, height] = self.target.size().map(|pixels| crate::numbers::to_points(pixels.max(1), 1.0));
        width / height
    }

    /// Width and height in the units of the HUD.
    pub(super) fn size_points(&self) -> [f32; 2] {
        let scale = self.scale() * self.painter.overlay.context().zoom_factor();
        self.target.size().map(|pixels| crate::numbers::to_points(pixels, scale))
    }

    fn scale(&self) -> f32 {
        let scale = self.window.scale_factor();
        to_f32(if display::is_scale(scale) { scale } else { 1.0 })
    }

    /// Shortest time from frame to frame in the game.
    pub(super) fn frame_time(&self) -> Duration {
        let software = self.gpu.adapter_info.device_type == wgpu::DeviceType::Cpu;
        Duration::from_secs(1) / if software { SOFTWARE_FRAMES_PER_S } else { FRAMES_PER_S }
    }

    /// Tells the log the adapter's times of earlier frames.
    pub(super) fn tell_times(&mut self, log: &mut FrameLog) {
        self.painter.note_times(log);
    }

    /// The library divides by the window system's scale, which may be one that is not used, such as 0.
    fn place_pointer(&self, input: &mut egui::RawInput) {
        let scale = f64::from(self.scale() * self.painter.overlay.context().zoom_factor());
        let at = egui::Pos2::from(self.cursor.map(|pixels| to_f32(pixels / scale)));
        for event in &mut input.events {
            match event {
                egui::Event::PointerMoved(pos) | egui::Event::PointerButton { pos, .. } => *pos = at,
                _ => {}
            }
        }
        if !display::is_scale(self.window.scale_factor()) {
            input
                .events
                .retain(|event| !matches!(event, egui::Event::MouseWheel { .. } | egui::Event::Touch { .. }));
        }
    }

    /// Draws and shows a frame with its number in the log, and over it what `show` writes.
    pub(super) fn draw(
        &mut self,
        scene: (&Scene, u64),
        show: impl FnMut(&mut egui::Ui),
    ) -> Result<Drawn, Failure> {
        let watch = Stopwatch::start();
        let frame = match self.target.acquire(&self.gpu).map_err(Failure::bad_input)? {
            Acquired::Frame(frame) => frame,
            Acquired::Skip => return Ok(Drawn::Hidden),
            Acquired::DeviceLost => return Ok(Drawn::DeviceLost),
        };
        let acquire = watch.ms();
        let watch = Stopwatch::start();
        let view = frame.texture.create_view(&wgpu::TextureViewDescriptor::default());
        let size = self.target.size();
        let scale = self.scale();
        let mut input = self.input.take_egui_input(&self.window);
        self.place_pointer(&mut input);
        let (_, output) = self.painter.draw(&self.gpu, (&view, size, scale), scene, input, show);
        self.input.handle_platform_output(&self.window, output);
        let encode = watch.ms();
        let watch = Stopwatch::start();
        self.window.pre_present_notify();
        self.gpu.queue.present(frame);
        match self.gpu.take_error() {
            Some(_) if self.gpu.is_lost() => Ok(Drawn::DeviceLost),
            Some(error) => Err(Failure::bad_input(error)),
            None => Ok(Drawn::Shown { encode, present: acquire + watch.ms() }),
        }
    }
}

fn input_for(painter: &FramePainter, window: &Window, gpu: &Gpu) -> egui_winit::State {
    let context = painter.overlay.context().clone();
    let most = usize::try_from(gpu.max_side()).ok();
    egui_winit::State::new(context, egui::ViewportId::ROOT, window, None, None, most)
}
