//! The physics and the maze of a tilt-the-maze ball game.
//!
//! # Conventions
//!
//! - **Maze frame**: right-handed; the board lies in x-y, its centre is the origin, the floor is z = 0 and +z points out
//!   of the board towards the player. Walls rise along +z.
//! - **World frame**: +z is up, so gravity is (0, 0, -9.81). An orientation `world_from_maze` turns maze coordinates into
//!   world coordinates.
//! - **Units**: a corridor (of the common widths the narrowest) is 1 maze unit wide; seconds; hence g = 9.81 units/s².
//! - **Ball**: a circle in the maze plane, held on the floor. That z is trivial is the method's central relaxation.
//! - **Ranges**: everything is `f64` and must be finite; what is not is refused.
//!
//! # Invariants
//!
//! No GPU, window, clock, thread, file or `unsafe`. The physics uses + - * / and sqrt only, so that the same inputs give
//! the same bits in debug, in release and in a browser; `clippy.toml` beside this crate's manifest enforces it.
//!
//! # One tick
//!
//! ```
//! use std::sync::Arc;
//! use maze_core::{Ball, BallSpec, Continuous, Engine, Facing, Plane, SortedPlanes, Tilt, gravity};
//! use nalgebra::Vector2;
//!
//! let wall = Plane { facing: Facing::MinusX, offset: 5.0, start: -1.0, end: 1.0 };
//! let planes = Arc::new(SortedPlanes::new([wall])?);
//! let ball = Ball { position: Vector2::zeros(), velocity: Vector2::zeros() };
//! let mut engine = Continuous::new(planes, BallSpec::default(), ball, 0.03)?;
//!
//! let tilt = Tilt::from_half_tangents(0.1, 0.0); // the board's +x side is down
//! let acceleration = gravity::project(gravity::WORLD_GRAVITY, &tilt.world_from_maze());
//! engine.tick(acceleration)?;
//! assert!(0.0 < engine.ball().velocity.x);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![forbid(unsafe_code)]

mod assembly;
pub mod export;
pub mod import;
pub mod layout;
mod maze;
mod navigation;
mod physics;
mod play;

pub use assembly::assemble::{AssembleOptions, Stage};
pub use assembly::draft::SectionError;
pub use assembly::error::{AssembleError, Misfit};
pub use assembly::from_layout::BlocksError;
pub use assembly::from_recipe::GenerateError;
pub use assembly::polygons::{PolygonMesh, UpAxis};
pub use assembly::{extrude, surface};
pub use import::printable::printable;
pub use layout::Layout;
pub use layout::blocks::{Blocks, MAX_GRID_CELLS};
pub use maze::{FaceNote, FaceReason, ImportReport, Maze};
pub use nalgebra;
pub use navigation::ends::Endpoint;
pub use physics::ball::{Ball, BallSpec, OutOfRange, Radius};
pub use physics::bounds::Bounds;
pub use physics::engine::{Continuous, Engine, Published};
pub use physics::gravity::Tilt;
pub use physics::sorted_planes::{Clearance, SortedPlanes};
pub use physics::sweep::{Sweep, SweepQuery};
pub use physics::tick::{Hit, Observer, RolledArc, Tick};
pub use physics::time_of_impact::Path;
pub use physics::wall::{Facing, Feature, Plane, PlaneError};
pub use physics::world::{BallState, BatchError, Contact, Contacts, MAX_EVENTS, MAX_TICK_S, World};
pub use physics::{contact, engine, gravity, sweep, time_of_impact, trace};
pub use play::autopilot::{Autopilot, AutopilotError};
pub use play::replay;
pub use play::rules::{Event, Phase, Run};
