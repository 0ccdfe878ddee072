//! Adapter, device and window surface: what to request, what to report when there is none, and when they are lost.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use wgpu::CurrentSurfaceTexture;

/// Why nothing can be drawn. Each message is one line for the person at the keyboard.
#[derive(Debug, thiserror::Error)]
pub enum GpuError {
    /// No driver offers an adapter that fits.
    #[error(
        "no graphics adapter found: install a Vulkan or OpenGL driver (Debian: apt-get install mesa-vulkan-drivers) [{0}]"
    )]
    NoAdapter(String),
    /// The adapter refused or dropped its device, or a command failed on it.
    #[error("graphics device: {0}")]
    Device(String),
    /// The window cannot be drawn to.
    #[error("window surface: {0}")]
    Surface(String),
    /// A picture larger than the adapter's textures.
    #[error("a picture of {width}x{height} pixels does not fit: each side may be 1 to {max} on this adapter")]
    PictureSize {
        /// Asked for.
        width: u32,
        /// Asked for.
        height: u32,
        /// Longest side the adapter allows.
        max: u32,
    },
    /// A maze whose triangles do not fit into one buffer.
    #[error(
        "the maze is too large to draw: it needs a buffer of {} MiB, this adapter allows {} MiB",
        .n_bytes.div_ceil(BYTES_PER_MIB), .max / BYTES_PER_MIB
    )]
    MazeTooLarge {
        /// Needed for the vertices, or for the indices.
        n_bytes: u64,
        /// Most bytes the adapter allows in one buffer.
        max: u64,
    },
    /// A maze with a triangle that has no such corner.
    #[error(
        "the maze cannot be drawn: a triangle uses vertex {index} (from 0), but there are only {n_vertices}"
    )]
    VertexOutOfRange {
        /// Used by the triangle.
        index: u32,
        /// Given.
        n_vertices: usize,
    },
}

/// For messages: 2^20.
const BYTES_PER_MIB: u64 = 1 << 20;

/// The graphics device and everything it came from.
pub struct Gpu {
    /// Name, driver and kind of the adapter.
    pub adapter_info: wgpu::AdapterInfo,
    /// Makes resources.
    pub device: wgpu::Device,
    /// Takes commands, and presents frames.
    pub queue: wgpu::Queue,
    /// The adapter, for its limits and formats.
    pub adapter: wgpu::Adapter,
    instance: wgpu::Instance,
    lost: Arc<AtomicBool>,
    error: Arc<Mutex<Option<String>>>,
}

impl Gpu {
    /// A device with no window. Honours `WGPU_BACKEND`, `WGPU_ADAPTER_NAME` is not read.
    ///
    /// # Errors
    ///
    /// [`GpuError::NoAdapter`] without a driver, [`GpuError::Device`] when the driver refuses.
    pub fn offscreen() -> Result<Self, GpuError> {
        let descriptor = wgpu::InstanceDescriptor::new_without_display_handle_from_env();
        pollster::block_on(Self::open(wgpu::Instance::new(descriptor), None, Kind::Any))
    }

    /// [`Gpu::offscreen`] on a driver that draws with the processor, whatever graphics cards there are and whatever
    /// the environment asks for: the same pictures on every machine, up to the driver's version.
    ///
    /// # Errors
    ///
    /// [`GpuError::NoAdapter`] without such a driver, [`GpuError::Device`] when it refuses.
    pub fn offscreen_software() -> Result<Self, GpuError> {
        let descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
        pollster::block_on(Self::open(wgpu::Instance::new(descriptor), None, Kind::Software))
    }

    /// A device that can draw to `window`, and the window as a target of `size` pixels. Blocks; the browser needs
    /// [`Gpu::for_window_async`].
    ///
    /// With winit, `window` is an `Arc<Window>` and `display` its `event_loop.owned_display_handle()`, boxed.
    ///
    /// # Errors
    ///
    /// [`GpuError::NoAdapter`] without a driver that can draw to the window, [`GpuError::Surface`] when the window
    /// cannot be drawn to although there is a driver, [`GpuError::Device`] when the driver refuses.
    pub fn for_window<W>(
        window: W,
        display: Box<dyn wgpu::wgt::WgpuHasDisplayHandle>,
        size: [u32; 2],
    ) -> Result<(Self, WindowTarget), GpuError>
    where
        W: wgpu::DisplayAndWindowHandle + Clone + 'static,
    {
        let descriptor = wgpu::InstanceDescriptor::new_with_display_handle_from_env(display);
        pollster::block_on(Self::for_window_async(wgpu::Instance::new(descriptor), window, size))
    }

    /// [`Gpu::for_window`] for an instance of the caller's making.
    ///
    /// # Errors
    ///
    /// As [`Gpu::for_window`].
    pub async fn for_window_async<W>(
        instance: wgpu::Instance,
        window: W,
        size: [u32; 2],
    ) -> Result<(Self, WindowTarget), GpuError>
    where
        W: wgpu::DisplayAndWindowHandle + Clone + 'static,
    {
        let make_surface = move |instance: &wgpu::Instance| {
            instance.create_surface(window.clone()).map_err(|e| GpuError::Surface(one_line(&e)))
        };
        let surface = match make_surface(&instance) {
            Ok(surface) => surface,
            Err(error) => {
                // Without any driver no surface can be made either: then it is the driver that is missing.
                find_adapter(&instance, None, Kind::Any).await?;
                return Err(error);
            }
        };
        let gpu = Self::open(instance, Some(&surface), Kind::Any).await?;
        let target = WindowTarget::new(&gpu, surface, Box::new(make_surface), size)?;
        Ok((gpu, target))
    }

    async fn open(
        instance: wgpu::Instance,
        surface: Option<&wgpu::Surface<'static>>,
        kind: Kind,
    ) -> Result<Self, GpuError> {
        let adapter = find_adapter(&instance, surface, kind).await?;
        let adapter_info = adapter.get_info();
        // What WebGL2 offers, with this adapter's texture size and buffer alignment.
        let mut required_limits = wgpu::Limits::downlevel_webgl2_defaults()
            .using_resolution(adapter.limits())
            .using_alignment(adapter.limits());
        // A browser's 256 MiB hold 8 million vertices; natively a maze may fill what the adapter takes.
        if cfg!(not(target_arch = "wasm32")) {
            required_limits.max_buffer_size = adapter.limits().max_buffer_size;
        }
        let (device, queue) = adapter
            .request_device(&wgpu::DeviceDescriptor {
                label: Some("maze"),
                required_features: adapter.features() & crate::timer::FEATURES,
                required_limits,
                ..Default::default()
            })
            .await
            .map_err(|e| GpuError::Device(format!("{}: {}", adapter_info.name, one_line(&e))))?;

        let lost = Arc::new(AtomicBool::new(false));
        let error = Arc::new(Mutex::new(None));
        device.set_device_lost_callback({
            let (lost, error) = (Arc::clone(&lost), Arc::clone(&error));
            move |reason, message| {
                lost.store(true, Ordering::Relaxed);
                keep_first(&error, format!("device lost ({reason:?}): {}", message.trim()));
            }
        });
        device.on_uncaptured_error({
            let error = Arc::clone(&error);
            Arc::new(move |e: wgpu::Error| keep_first(&error, one_line(&e)))
        });
        Ok(Self { adapter_info, device, queue, adapter, instance, lost, error })
    }

    /// True once the device is gone (driver reset, adapter unplugged): drop it and everything made with it, then
    /// make a new [`Gpu`]. Checks again at each call.
    pub fn is_lost(&self) -> bool {
        // Polling is what runs the device-lost callback; its own failure adds nothing.
        let _ = self.device.poll(wgpu::PollType::Poll);
        self.lost.load(Ordering::Relaxed)
    }

    /// The first error the driver reported outside any call's result since the last call.
    pub fn take_error(&self) -> Option<GpuError> {
        let taken = self.error.lock().unwrap_or_else(PoisonError::into_inner).take();
        taken.map(GpuError::Device)
    }

    /// Longest side of a texture, and so of a window or a picture.
    pub fn max_side(&self) -> u32 {
        self.device.limits().max_texture_dimension_2d
    }

    /// One line for a log: adapter, backend, driver.
    pub fn describe(&self) -> String {
        let info = &self.adapter_info;
        format!("{} ({:?}, {} {})", info.name, info.backend, info.driver, info.driver_info).trim().to_owned()
    }
}

/// Which adapters will do.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Any,
    Software,
}

async fn find_adapter(
    instance: &wgpu::Instance,
    surface: Option<&wgpu::Surface<'static>>,
    kind: Kind,
) -> Result<wgpu::Adapter, GpuError> {
    let options = wgpu::RequestAdapterOptions {
        power_preference: wgpu::PowerPreference::from_env().unwrap_or(wgpu::PowerPreference::HighPerformance),
        compatible_surface: surface,
        force_fallback_adapter: kind == Kind::Software,
        ..Default::default()
    };
    instance.request_adapter(&options).await.map_err(|e| GpuError::NoAdapter(one_line(&e)))
}

fn keep_first(slot: &Mutex<Option<String>>, message: String) {
    slot.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(message);
}

/// wgpu's messages run over many lines; ours are one.
fn one_line(error: &dyn std::error::Error) -> String {
    let mut text = error.to_string();
    let mut source = error.source();
    while let Some(inner) = source {
        let inner_text = inner.to_string();
        if !text.contains(&inner_text) {
            text = format!("{text}: {inner_text}");
        }
        source = inner.source();
    }
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

type MakeSurface = Box<dyn Fn(&wgpu::Instance) -> Result<wgpu::Surface<'static>, GpuError>>;

/// A window's surface and how it is set up.
pub struct WindowTarget {
    surface: wgpu::Surface<'static>,
    config: wgpu::SurfaceConfiguration,
    /// Formats that the window takes.
    offered: Vec<wgpu::TextureFormat>,
    make_surface: MakeSurface,
    /// False while the window has no area: nothing may be configured or drawn.
    has_area: bool,
    suboptimal: Suboptimal,
}

/// What became of the driver's hint that the surface does not quite match the window. Setting it up anew usually helps;
/// where it does not (a rotated display), the hint comes with every frame and is answered once a resize.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Suboptimal {
    NotSeen,
    Seen,
    Answered,
}

impl Suboptimal {
    fn see(&mut self) {
        if *self == Self::NotSeen {
            *self = Self::Seen;
        }
    }

    /// True once after a first sight: set up the surface now.
    fn answer(&mut self) -> bool {
        let is_due = *self == Self::Seen;
        if is_due {
            *self = Self::Answered;
        }
        is_due
    }
}

/// What [`WindowTarget::acquire`] found.
pub enum Acquired {
    /// Draw to it, submit, then `gpu.queue.present(frame)`.
    Frame(wgpu::SurfaceTexture),
    /// Nothing to draw to right now (hidden, no area, late, or just set up anew): try at the next redraw.
    Skip,
    /// The device is gone: make a new [`Gpu`].
    DeviceLost,
}

impl WindowTarget {
    fn new(
        gpu: &Gpu,
        surface: wgpu::Surface<'static>,
        make_surface: MakeSurface,
        size: [u32; 2],
    ) -> Result<Self, GpuError> {
        let offered = surface.get_capabilities(&gpu.adapter).formats;
        let format = best_format(&offered, true).ok_or_else(|| {
            GpuError::Surface(format!("{} cannot draw to this window", gpu.adapter_info.name))
        })?;
        let mut config = surface
            .get_default_config(&gpu.adapter, 1, 1)
            .ok_or_else(|| GpuError::Surface("no configuration offered".to_owned()))?;
        config.format = format;
        config.present_mode = wgpu::PresentMode::Fifo; // The one mode that is offered everywhere.
        let mut target =
            Self { surface, config, offered, make_surface, has_area: false, suboptimal: Suboptimal::NotSeen };
        target.resize(gpu, size);
        match gpu.take_error() {
            Some(error) => Err(error),
            None => Ok(target),
        }
    }

    /// Follows the window's size in pixels. A size of zero (minimised, or a page not laid out yet) is waited out.
    pub fn resize(&mut self, gpu: &Gpu, size: [u32; 2]) {
        let [width, height] = size.map(|n| n.min(gpu.max_side()));
        self.has_area = 0 < width && 0 < height;
        if self.has_area {
            (self.config.width, self.config.height) = (width, height);
            self.suboptimal = Suboptimal::NotSeen;
            self.configure(gpu);
        }
    }

    /// Whether frames come in step with the screen; without it, as soon as they are ready where that is offered.
    pub fn set_vsync(&mut self, gpu: &Gpu, vsync: bool) {
        let mode = if vsync { wgpu::PresentMode::Fifo } else { wgpu::PresentMode::AutoNoVsync };
        if mode != self.config.present_mode {
            self.config.present_mode = mode;
            if self.has_area {
                self.configure(gpu);
            }
        }
    }

    /// Whether the window turns light into sRGB itself, as far as it can, see [`crate::Quality::wants_srgb_target`].
    /// Afterwards [`WindowTarget::format`] may be another one.
    pub fn set_srgb(&mut self, gpu: &Gpu, srgb: bool) {
        let format = best_format(&self.offered, srgb).unwrap_or(self.config.format);
        if format != self.config.format {
            self.config.format = format;
            if self.has_area {
                self.configure(gpu);
            }
        }
    }

    /// The next frame to draw to, if there is one. Repairs what it can: an outdated or lost surface is set up anew.
    /// Drop or present the last frame first.
    ///
    /// # Errors
    ///
    /// [`GpuError::Surface`] when a lost surface cannot be made again.
    pub fn acquire(&mut self, gpu: &Gpu) -> Result<Acquired, GpuError> {
        if !self.has_area {
            return Ok(Acquired::Skip);
        }
        if self.suboptimal.answer() {
            self.configure(gpu);
        }
        match self.surface.get_current_texture() {
            CurrentSurfaceTexture::Success(texture) => return Ok(Acquired::Frame(texture)),
            // Drawn all the same. A surface cannot be configured while its texture lives: that waits for the next call.
            CurrentSurfaceTexture::Suboptimal(texture) => {
                self.suboptimal.see();
                return Ok(Acquired::Frame(texture));
            }
            CurrentSurfaceTexture::Outdated => self.configure(gpu),
            CurrentSurfaceTexture::Timeout | CurrentSurfaceTexture::Occluded => {}
            CurrentSurfaceTexture::Lost => {
                if gpu.is_lost() {
                    return Ok(Acquired::DeviceLost);
                }
                self.surface = (self.make_surface)(&gpu.instance)?;
                self.configure(gpu);
            }
            // A lost device shows as endless validation errors.
            CurrentSurfaceTexture::Validation => {
                if gpu.is_lost() {
                    return Ok(Acquired::DeviceLost);
                }
                self.configure(gpu);
            }
        }
        Ok(Acquired::Skip)
    }

    /// The format to make a [`crate::Renderer`] for.
    pub fn format(&self) -> wgpu::TextureFormat {
        self.config.format
    }

    /// Width and height in pixels; the last ones that were not zero.
    pub fn size(&self) -> [u32; 2] {
        [self.config.width, self.config.height]
    }

    /// False while the window has no area, as a minimised one on Windows: nothing is shown, so a game may pause.
    pub fn has_area(&self) -> bool {
        self.has_area
    }

    fn configure(&self, gpu: &Gpu) {
        self.surface.configure(&gpu.device, &self.config);
    }
}

/// The best of the formats that a window offers: sRGB if wanted, then a plain one, then any.
fn best_format(offered: &[wgpu::TextureFormat], srgb: bool) -> Option<wgpu::TextureFormat> {
    let find = |is_good: fn(&wgpu::TextureFormat) -> bool| offered.iter().copied().find(is_good);
    let (with, without) = (find(wgpu::TextureFormat::is_srgb), find(is_plain_8_bit));
    let best = if srgb { with.or(without) } else { without.or(with) };
    best.or_else(|| offered.first().copied())
}

fn is_plain_8_bit(format: &wgpu::TextureFormat) -> bool {
    matches!(format, wgpu::TextureFormat::Rgba8Unorm | wgpu::TextureFormat::Bgra8Unorm)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_suboptimal_surface_is_set_up_once_a_resize() {
        let mut state = Suboptimal::NotSeen;
        assert!(!state.answer(), "nothing to do");
        for expected in [true, false, false] {
            state.see();
            assert_eq!(state.answer(), expected);
        }
        state = Suboptimal::NotSeen; // As `resize` does.
        state.see();
        assert!(state.answer());
    }

    #[test]
    fn a_window_gets_the_format_that_a_quality_wants_or_the_next_best() {
        use wgpu::TextureFormat::{Bgra8Unorm, Bgra8UnormSrgb, Rgba8Unorm, Rgba16Float};
        let all = [Rgba16Float, Bgra8UnormSrgb, Bgra8Unorm];
        assert_eq!(best_format(&all, true), Some(Bgra8UnormSrgb));
        assert_eq!(best_format(&all, false), Some(Bgra8Unorm));
        assert_eq!(best_format(&[Rgba16Float, Rgba8Unorm], true), Some(Rgba8Unorm));
        assert_eq!(best_format(&[Rgba16Float], false), Some(Rgba16Float));
        assert_eq!(best_format(&[], true), None);
    }

    #[test]
    fn a_size_in_a_message_never_contradicts_itself() {
        let text = |n_bytes, max| GpuError::MazeTooLarge { n_bytes, max }.to_string();
        let max = 256 * BYTES_PER_MIB;
        let expected =
            "the maze is too large to draw: it needs a buffer of 257 MiB, this adapter allows 256 MiB";
        assert_eq!(text(max + 1, max), expected);
    }
}
