//! The cross-check: our engines beside rapier3d and closed-form mechanics.
//!
//! So far one engine, [`RapierEngine`], which puts rapier3d behind maze-core's [`maze_core::Engine`], so that a scene can
//! be run through both. `tests/head_on.rs` does so with a head-on bounce.
#![forbid(unsafe_code)]

mod rapier_engine;

pub use rapier_engine::RapierEngine;
