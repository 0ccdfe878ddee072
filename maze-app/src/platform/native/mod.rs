//! The desktop: window, files, signals, the system's keyboard layouts.

mod app;
mod display;
pub(crate) mod files;
mod graphics;
mod idle;
pub(crate) mod keeper;
mod keys;
mod layout;
mod look;
pub(crate) mod maze_file;
mod outputs;
mod presence;
mod progress;
pub(crate) mod rescue;
pub(crate) mod settings_file;
pub(crate) mod sidecar;
pub(crate) mod state_log;
mod watch;

pub(crate) use app::App;
pub(crate) use display::{event_loop, leave_silent};
pub(crate) use look::Look;
pub(crate) use settings_file::SettingsFile;
