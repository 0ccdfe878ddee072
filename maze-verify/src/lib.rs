//! The cross-check: our engines beside rapier3d and closed-form mechanics.
#![forbid(unsafe_code)]

mod board;
pub mod engine;
#[cfg(feature = "report")]
pub mod scene;

pub use board::{Board, WallMesh};
pub use engine::{ClosedForm, Motion, PacedPublished, RapierEngine, RollingEngine, Walls};
