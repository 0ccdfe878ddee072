//! Connects to the window system, or fails with one line that says why.
//!
//! winit decides by the environment alone, tries one system once, waits without end for one that does not answer, and
//! panics on settings that it cannot use. So each system is probed first, with a timeout.

use crate::failure::Failure;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::{Mutex, Once};
use winit::dpi::{LogicalSize, PhysicalSize, Size};
use winit::event::InnerSizeWriter;
use winit::event_loop::{ActiveEventLoop, EventLoop};

/// Scale factors that a screen may have. Window systems pass on what a user or a broken screen reports, 0 and 10
/// million too.
const SCALES: std::ops::RangeInclusive<f64> = 0.25..=8.0;

/// Whether a screen can be drawn for at this scale.
pub(super) fn is_scale(scale: f64) -> bool {
    SCALES.contains(&scale)
}

/// The size of a new window in pixels, if it is given, else in the units of the screen's scale.
pub(super) fn window_size(event_loop: &ActiveEventLoop, pixels: Option<[u32; 2]>, units: [u32; 2]) -> Size {
    // The library multiplies by the scale, and panics when it cannot.
    let is_scaled = event_loop.available_monitors().all(|monitor| is_scale(monitor.scale_factor()));
    match (pixels, is_scaled) {
        (None, true) => LogicalSize::<u32>::from(units).into(),
        (None, false) => PhysicalSize::<u32>::from(units).into(),
        (Some(pixels), _) => PhysicalSize::<u32>::from(pixels).into(),
    }
}

/// The window system has multiplied the window's size by a new scale. That is taken back for one that is not used.
pub(super) fn rescale(scale: f64, mut writer: InnerSizeWriter, pixels: [u32; 2]) {
    if !is_scale(scale) {
        // The writer may be gone: then the size stands.
        let _ = writer.request_inner_size(PhysicalSize::from(pixels));
    }
}

/// A window system that answers: Wayland, else X11.
pub(crate) fn event_loop() -> Result<EventLoop<()>, Failure> {
    let mut builder = EventLoop::builder();
    #[cfg(all(unix, not(target_os = "macos")))]
    let named = unix::choose(&mut builder)?;
    #[cfg(not(all(unix, not(target_os = "macos"))))]
    let named = "this system's".to_owned();
    // The error itself only adds a line of the library's source.
    guarded(|| builder.build())?.map_err(|_| no_display(&format!("{named}: refused")))
}

/// For drawing without a window: a driver may ask window systems too, and wait for one that does not answer.
pub(crate) fn leave_silent() {
    #[cfg(all(unix, not(target_os = "macos")))]
    unix::leave_silent();
}

fn no_display(why: &str) -> Failure {
    Failure::bad_input(format!("no display to open a window on ({why}); `maze-app render` draws without one"))
}

/// What the window system's library said when it panicked.
static SAID: Mutex<Option<String>> = Mutex::new(None);

/// Turns a panic of the window system's library into a failure; any other goes on.
pub(super) fn guarded<T>(work: impl FnOnce() -> T) -> Result<T, Failure> {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let usual = std::panic::take_hook();
        std::panic::set_hook(Box::new(move |panic| {
            let file = panic.location().map_or("", |location| location.file());
            match (is_window_system(file), SAID.lock()) {
                (true, Ok(mut said)) => {
                    let text = panic.payload_as_str().unwrap_or("it cannot go on");
                    *said = Some(text.to_owned());
                }
                _ => usual(panic),
            }
        }));
    });
    catch_unwind(AssertUnwindSafe(work)).map_err(|payload| {
        let said = SAID.lock().ok().and_then(|mut said| said.take());
        match said {
            Some(text) => Failure::bad_input(format!("the window system: {text}")),
            None => resume_unwind(payload),
        }
    })
}

fn is_window_system(file: &str) -> bool {
    [
        "/winit-",
        "/dpi-",
        "/x11rb-",
        "/x11-dl-",
        "/xkbcommon-dl-",
        "/wayland-",
        "/smithay-client-toolkit-",
        "/calloop",
    ]
    .iter()
    .any(|name| file.replace('\\', "/").contains(name))
}

#[cfg(all(unix, not(target_os = "macos")))]
mod unix {
    use super::{Failure, SCALES, no_display};
    use std::ffi::{OsStr, OsString};
    use std::io::{Read, Write};
    use std::os::unix::net::UnixStream;
    use std::os::unix::process::CommandExt;
    use std::path::{Path, PathBuf};
    use std::process::Command;
    use std::sync::mpsc;
    use std::time::Duration;
    use winit::event_loop::EventLoopBuilder;
    use winit::platform::{wayland::EventLoopBuilderExtWayland, x11::EventLoopBuilderExtX11};
    use x11rb::protocol::xproto::ConnectionExt;
    use x11rb::rust_connection::RustConnection;

    /// A window system answers within this, or counts as dead. Long enough for a busy machine, or a network.
    const PATIENCE: Duration = Duration::from_secs(3);

    /// Overrides the scale of an X11 screen; the library refuses anything else with a panic.
    const SCALE_VARIABLE: &str = "WINIT_X11_SCALE_FACTOR";

    /// What the library cannot do without.
    const X11_EXTENSIONS: [&str; 3] = ["RANDR", "XInputExtension", "XKEYBOARD"];
    const WAYLAND_GLOBALS: [&str; 3] = ["wl_compositor", "wl_shm", "xdg_wm_base"];

    /// Objects of a Wayland connection; the first one is always there.
    const DISPLAY: u32 = 1;
    const REGISTRY: u32 = 2;
    const CALLBACK: u32 = 3;

    /// Tells the builder which system to use, and gives its name.
    pub(super) fn choose(builder: &mut EventLoopBuilder<()>) -> Result<String, Failure> {
        let mut refused = Vec::new();
        if let Some(value) = set("WAYLAND_SOCKET") {
            // An inherited connection can be used once only, so it cannot be probed. Where there is none, the library
            // aborts.
            if is_open(&value) {
                builder.with_wayland();
                return Ok(format!("WAYLAND_SOCKET is {}", value.display()));
            }
            start_again_without(&["WAYLAND_SOCKET"]);
        }
        if let Some(value) = set("WAYLAND_DISPLAY") {
            let named = format!("WAYLAND_DISPLAY is {}", value.display());
            match in_time(move || wayland_answers(&value)) {
                Ok(()) => {
                    builder.with_wayland();
                    return Ok(named);
                }
                Err(reason) => refused.push(format!("{named}: {reason}")),
            }
        }
        if let Some(value) = set("DISPLAY") {
            let named = format!("DISPLAY is {}", value.display());
            match in_time(x11_answers) {
                Ok(()) => {
                    if !refused.is_empty() {
                        // Mesa's layer for choosing a device asks it, too, and waits without end.
                        start_again_without(&["WAYLAND_DISPLAY"]);
                    }
                    expect_scale(std::env::var(SCALE_VARIABLE).ok().as_deref())?;
                    builder.with_x11();
                    return Ok(named);
                }
                Err(reason) => refused.push(format!("{named}: {reason}")),
            }
        }
        match refused.is_empty() {
            true => Err(no_display("neither WAYLAND_DISPLAY nor DISPLAY is set")),
            false => Err(no_display(&refused.join("; "))),
        }
    }

    fn set(name: &str) -> Option<OsString> {
        std::env::var_os(name).filter(|value| !value.is_empty())
    }

    /// Whether a file descriptor of this number is there.
    fn is_open(number: &OsStr) -> bool {
        let number = number.to_str().and_then(|text| text.parse::<u32>().ok());
        number.is_some_and(|number| Path::new("/dev/fd").join(number.to_string()).exists())
    }

    /// For drawing without a window: forgets window systems that do not answer, which a driver may ask.
    pub(super) fn leave_silent() {
        let is_silent = |ask: fn() -> Result<(), String>| within(PATIENCE, ask).is_none();
        let mut silent = Vec::new();
        if set("WAYLAND_DISPLAY").is_some()
            && is_silent(|| set("WAYLAND_DISPLAY").map_or(Ok(()), |value| wayland_answers(&value)))
        {
            silent.push("WAYLAND_DISPLAY");
        }
        if set("DISPLAY").is_some() && is_silent(x11_answers) {
            silent.push("DISPLAY");
        }
        if !silent.is_empty() {
            start_again_without(&silent);
        }
    }

    /// The same program with the same arguments in the same process, and without these variables: the environment of a program
    /// that runs cannot be changed safely. Comes back only if that cannot be done.
    fn start_again_without(variables: &[&str]) {
        let Ok(program) = std::env::current_exe() else { return };
        let mut again = Command::new(program);
        again.args(std::env::args_os().skip(1));
        for name in variables {
            again.env_remove(name);
        }
        // What is wrong will be seen where the variables are used.
        let _ = again.exec();
    }

    pub(super) fn expect_scale(value: Option<&str>) -> Result<(), Failure> {
        let Some(text) = value.filter(|text| !text.is_empty() && !text.eq_ignore_ascii_case("randr")) else {
            return Ok(());
        };
        if text.parse().is_ok_and(|scale: f64| SCALES.contains(&scale)) {
            return Ok(());
        }
        let [least, most] = [SCALES.start(), SCALES.end()];
        Err(Failure::bad_input(format!("{SCALE_VARIABLE} is '{text}': expected {least} to {most}, or randr")))
    }

    /// The answer; `None` when it does not come in time. A thread that still waits for it is abandoned.
    pub(super) fn within<T: Send + 'static>(
        time: Duration,
        ask: impl FnOnce() -> Result<T, String> + Send + 'static,
    ) -> Option<Result<T, String>> {
        let (sender, receiver) = mpsc::channel();
        let answer = move || {
            // Nobody listens any more when it was too late.
            let _ = sender.send(ask());
        };
        match std::thread::Builder::new().spawn(answer) {
            Ok(_) => receiver.recv_timeout(time).ok(),
            Err(error) => Some(Err(error.to_string())),
        }
    }

    fn in_time(ask: impl FnOnce() -> Result<(), String> + Send + 'static) -> Result<(), String> {
        within(PATIENCE, ask).unwrap_or_else(|| Err(format!("no answer in {} s", PATIENCE.as_secs())))
    }

    fn x11_answers() -> Result<(), String> {
        let (connection, _) = RustConnection::connect(None).map_err(|error| error.to_string())?;
        for name in X11_EXTENSIONS {
            let reply = connection.query_extension(name.as_bytes()).map_err(|error| error.to_string())?;
            if !reply.reply().map_err(|error| error.to_string())?.present {
                return Err(format!("the X server lacks the extension {name}"));
            }
        }
        Ok(())
    }

    /// Asks a Wayland server for its globals, in the wire protocol: all numbers have 32 bits in the machine's
    /// order, a message is the object, its size in the upper half of the next number and what is asked in the lower, and
    /// the arguments. See "Wire Format" in the Wayland book.
    pub(super) fn wayland_answers(name: &OsStr) -> Result<(), String> {
        let directory = std::env::var_os("XDG_RUNTIME_DIR").map(PathBuf::from).unwrap_or_default();
        let mut stream = UnixStream::connect(directory.join(name)).map_err(|error| error.to_string())?;
        stream.set_read_timeout(Some(PATIENCE)).map_err(|error| error.to_string())?;
        let [get_registry, sync] = [[DISPLAY, (12 << 16) | 1, REGISTRY], [DISPLAY, 12 << 16, CALLBACK]];
        let request: Vec<u8> = [get_registry, sync].concat().iter().flat_map(|n| n.to_ne_bytes()).collect();
        stream.write_all(&request).map_err(|error| error.to_string())?;
        let mut missing = WAYLAND_GLOBALS.to_vec();
        // A server has some dozens of globals.
        for _ in 0..10_000 {
            let mut head = [0; 8];
            stream.read_exact(&mut head).map_err(|error| error.to_string())?;
            let [a, b, c, d, e, f, g, h] = head;
            let [object, word] = [[a, b, c, d], [e, f, g, h]].map(u32::from_ne_bytes);
            let mut body = vec![0; (word >> 16).saturating_sub(8) as usize];
            stream.read_exact(&mut body).map_err(|error| error.to_string())?;
            match object {
                // Its number, the length of its name, and the name with a zero behind it.
                REGISTRY => missing.retain(|name| {
                    let known = body.get(8..8 + name.len() + 1).and_then(|known| known.strip_suffix(&[0]));
                    known != Some(name.as_bytes())
                }),
                CALLBACK if missing.is_empty() => return Ok(()),
                CALLBACK => return Err(format!("the Wayland server lacks {}", missing.join(", "))),
                DISPLAY if word & 0xffff == 0 => break,
                _ => {}
            }
        }
        Err("no Wayland server".to_owned())
    }
}

#[cfg(test)]
#[cfg(all(unix, not(target_os = "macos")))]
mod tests;
