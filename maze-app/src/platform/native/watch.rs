//! Asks the X server whether the window is in view. winit reports a window that others cover, but not of one that the
//! window manager has taken off the screen: minimised, or on another workspace.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;
use winit::raw_window_handle::{HasWindowHandle, RawWindowHandle};
use winit::window::Window;

/// How often to ask.
const EVERY: Duration = Duration::from_millis(100);

/// Asks from a thread and a connection of its own, so that a server that does not answer holds up nothing.
pub(super) struct Watch {
    is_hidden: Arc<AtomicBool>,
}

impl Watch {
    /// `None` where the window system is another one, which reports it in events, or cannot be queried.
    pub(super) fn new(window: &Window) -> Option<Self> {
        let id = x11_id(window)?;
        let is_hidden = Arc::new(AtomicBool::new(false));
        let told = Arc::downgrade(&is_hidden);
        let ask = move || {
            let Some(asked) = x11::Asked::new(id) else { return };
            let mut was_seen = false;
            // Until the window is gone, here or there.
            while let (Some(told), Some(is_hidden)) = (told.upgrade(), asked.is_hidden()) {
                // A new window is not there yet.
                was_seen |= !is_hidden;
                told.store(was_seen && is_hidden, Ordering::Relaxed);
                drop(told);
                std::thread::sleep(EVERY);
            }
        };
        std::thread::Builder::new().name("watch".to_owned()).spawn(ask).ok()?;
        Some(Self { is_hidden })
    }

    pub(super) fn is_hidden(&self) -> bool {
        self.is_hidden.load(Ordering::Relaxed)
    }
}

/// The window's number on its X server.
fn x11_id(window: &Window) -> Option<u32> {
    match window.window_handle().ok()?.as_raw() {
        RawWindowHandle::Xlib(handle) => u32::try_from(handle.window).ok(),
        RawWindowHandle::Xcb(handle) => Some(handle.window.get()),
        _ => None,
    }
}

#[cfg(all(unix, not(target_os = "macos")))]
mod x11 {
    use x11rb::connection::Connection;
    use x11rb::protocol::xproto::{AtomEnum, ConnectionExt, MapState};
    use x11rb::rust_connection::RustConnection;

    /// Value of _NET_WM_DESKTOP for a window on all of them.
    const ALL_DESKTOPS: u32 = u32::MAX;

    x11rb::atom_manager! {
        Atoms: AtomsCookie {
            _NET_WM_STATE,
            _NET_WM_STATE_HIDDEN,
            _NET_WM_DESKTOP,
            _NET_CURRENT_DESKTOP,
        }
    }

    pub(super) struct Asked {
        connection: RustConnection,
        root: u32,
        window: u32,
        atoms: Atoms,
    }

    impl Asked {
        pub(super) fn new(window: u32) -> Option<Self> {
            let (connection, screen) = RustConnection::connect(None).ok()?;
            let root = connection.setup().roots.get(screen)?.root;
            let atoms = Atoms::new(&connection).ok()?.reply().ok()?;
            Some(Self { connection, root, window, atoms })
        }

        /// `None` when there is no such window any more. Window managers differ in what they do to a window on another
        /// workspace: most take it or its frame off the screen, compositing ones may only report where it is.
        pub(super) fn is_hidden(&self) -> Option<bool> {
            let attributes = self.connection.get_window_attributes(self.window).ok()?.reply().ok()?;
            if attributes.map_state != MapState::VIEWABLE {
                return Some(true);
            }
            let atoms = &self.atoms;
            let state = self.property(self.window, atoms._NET_WM_STATE, AtomEnum::ATOM)?;
            if state.contains(&atoms._NET_WM_STATE_HIDDEN) {
                return Some(true);
            }
            let desktop = self.property(self.window, atoms._NET_WM_DESKTOP, AtomEnum::CARDINAL)?;
            let current = self.property(self.root, atoms._NET_CURRENT_DESKTOP, AtomEnum::CARDINAL)?;
            Some(match (desktop.first(), current.first()) {
                (Some(desktop), Some(current)) => *desktop != ALL_DESKTOPS && desktop != current,
                _ => false,
            })
        }

        /// Empty where it is not set.
        fn property(&self, window: u32, name: u32, kind: AtomEnum) -> Option<Vec<u32>> {
            let reply = self.connection.get_property(false, window, name, kind, 0, 64).ok()?.reply().ok()?;
            Some(reply.value32().map(Iterator::collect).unwrap_or_default())
        }
    }
}

#[cfg(not(all(unix, not(target_os = "macos"))))]
mod x11 {
    /// There is no X server to ask.
    pub(super) struct Asked;

    impl Asked {
        pub(super) fn new(_: u32) -> Option<Self> {
            None
        }

        pub(super) fn is_hidden(&self) -> Option<bool> {
            None
        }
    }
}
