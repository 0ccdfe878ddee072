//! The desktop: window, files, signals, the system's keyboard layouts.

mod app;
mod display;
pub(crate) mod files;
mod graphics;
mod idle;
pub(crate) mod keeper;
mod keys;
mod layout;
pub(crate) mod maze_file;
mod picture;
mod presence;
mod progress;
pub(crate) mod rescue;
pub(crate) mod sidecar;
pub(crate) mod state_log;
mod watch;

pub(crate) use app::{App, Options};
pub(crate) use display::{event_loop, leave_silent};
