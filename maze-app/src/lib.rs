//! The game and its command line. The only crate with a window, files and a clock.
//!
//! Session, screens, input, HUD and overlays know none of them: what is bound to a window system, files or a clock stands in
//! `platform` and `command`. `source` reaches through to the native files.
#![forbid(unsafe_code)]

mod clock;
mod command;
mod demo;
mod engine_kind;
mod failure;
mod frame;
mod frame_log;
mod game;
mod input;
mod levels;
mod loaded;
mod measures;
mod numbers;
mod overlay;
mod picture;
mod platform;
mod plot;
mod quality;
mod recipe;
mod screen;
mod session;
mod settings;
mod setup;
mod slowness;
mod source;
mod ui;
mod view;

pub use command::main;
