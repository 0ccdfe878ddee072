//! Engines beyond maze-core's, all behind its [`maze_core::Engine`].

mod closed_form;
mod paced;
mod rapier;
mod rolling;

pub use closed_form::{ClosedForm, Motion};
pub use paced::PacedPublished;
pub use rapier::{RapierEngine, Walls};
pub use rolling::RollingEngine;
