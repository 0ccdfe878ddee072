//! The cross-check: our engines beside rapier3d and closed-form mechanics.
//!
//! Without the feature `report` there are only walls ([`Board`]) and engines, all behind maze-core's [`maze_core::Engine`]:
//! what a game needs that wants to be played under rapier. With it, scenes go one way:
//!
//! ```text
//! Scene -> Stage -> Track (an engine's run) -> Metrics -> SceneResult -> Results: verdicts -> table, results.json, report.html
//! ```
#![forbid(unsafe_code)]

mod board;
pub mod engine;

#[cfg(feature = "bench")]
pub mod bench;
#[cfg(feature = "report")]
mod contender;
#[cfg(feature = "report")]
pub mod metrics;
#[cfg(feature = "report")]
pub mod model_error;
#[cfg(feature = "report")]
pub mod report;
#[cfg(feature = "report")]
pub mod results;
#[cfg(feature = "report")]
mod run;
#[cfg(feature = "report")]
pub mod scene;
#[cfg(feature = "report")]
pub mod tolerances;

pub use board::{Board, WallMesh};
#[cfg(feature = "report")]
pub use contender::{Build, Contender, build};
pub use engine::{ClosedForm, Motion, RapierEngine, RollingEngine, Stretch, Walls};
#[cfg(feature = "report")]
pub use run::{RunError, run};
