//! A ball that rolls through a maze of axis-aligned walls: exact collision without substeps, mazes from files and generators,
//! the rules of a run.
//!
//! A ball dropped into a random maze, on a board tilted by 5 degrees:
//!
//! ```
//! use maze_core::layout::{Algorithm, Recipe};
//! use maze_core::{Engine, Tilt};
//!
//! let maze = Recipe::new(20, 20, Algorithm::Wilson, 3).maze()?;
//! let mut engine = maze.exact_engine(0.01)?; // ticks of 0.01 s
//! for hit in engine.simulate(Tilt::degrees(5.0, 0.0), 10.0)? {
//!     println!("after {:.3} s: {:.2} units/s onto the wall at {:?}", hit.time_s, hit.normal_speed(), hit.point);
//! }
//! println!("the ball is at {:?}", engine.ball().position);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Where to go on
//!
//! | to | start with |
//! | --- | --- |
//! | make a maze | [`layout::Recipe`] by seed, [`import`] from a file, [`Maze::from_polygons`] |
//! | move a ball | [`Maze::exact_engine`], or [`Continuous::new`] among walls of your own |
//! | move many balls | [`World::tick_all`] |
//! | ask what is in the way | [`Maze::sweep`], [`Maze::is_free`], [`SortedPlanes::sweep`] |
//! | play a run to the goal | [`Run`], [`Autopilot`], [`replay::Recording`] |
//! | compare with the report's method | [`Published`], [`contact`], [`trace`] |
//!
//! # Conventions
//!
//! - **Maze frame**: right-handed; the board lies in x-y, its centre is the origin, the floor is z = 0 and +z points out
//!   of the board towards the player. Walls rise along +z.
//! - **World frame**: +z is up, so gravity is (0, 0, -9.81). An orientation `world_from_maze` turns maze coordinates into
//!   world coordinates.
//! - **Units**: a corridor (of the common widths the narrowest) is 1 maze unit wide; seconds; hence g = 9.81 units/s².
//! - **Ball**: a circle in the maze plane, held on the floor. Gravity is projected onto the plane; ignoring z is the model error of
//!   the planar projection.
//! - **Ranges**: everything is `f64` and must be finite; other numbers are refused.
//!
//! # Invariants
//!
//! No GPU, window, clock, thread, file or `unsafe`. The physics uses + - * / and sqrt only, so that the same inputs give
//! the same bits in debug, in release and in a browser; `clippy.toml` beside this crate's manifest enforces it.
//!
//! # Features
//!
//! `import` (mazes from OBJ, SVG, text and pictures) and `generate` (random mazes) are on by default; both need `maze` (layouts,
//! assembly, navigation, rules, recordings, export). Without any of them the physics depends on nalgebra and thiserror only.
#![forbid(unsafe_code)]
#![cfg_attr(
    not(all(feature = "import", feature = "generate")),
    allow(dead_code, reason = "some of what both features share serves one of them only")
)]

#[cfg(feature = "maze")]
mod assembly;
#[cfg(feature = "maze")]
pub mod export;
#[cfg(feature = "import")]
pub mod import;
#[cfg(feature = "maze")]
pub mod layout;
#[cfg(feature = "maze")]
mod maze;
#[cfg(feature = "maze")]
mod navigation;
mod physics;
#[cfg(feature = "maze")]
mod play;

pub use nalgebra;
pub use physics::ball::{Ball, BallKind, BallSpec, OutOfRange, Radius, UnknownBall};
pub use physics::engine::{Continuous, Engine, Published};
pub use physics::gravity::Tilt;
pub use physics::sorted_planes::{Clearance, SortedPlanes};
pub use physics::sweep::{Sweep, SweepQuery};
pub use physics::tick::{Hit, Observer, RolledArc, Tick};
pub use physics::time_of_impact::Path;
pub use physics::wall::{Facing, Feature, Plane, PlaneError};
pub use physics::world::{BallState, BatchError, Contact, Contacts, MAX_EVENTS, MAX_TICK_S, World};
pub use physics::{contact, engine, gravity, sweep, time_of_impact, trace};

#[cfg(feature = "generate")]
pub use assembly::from_recipe::GenerateError;
#[cfg(feature = "import")]
pub use import::printable::printable;
#[cfg(feature = "maze")]
pub use {
    assembly::assemble::{AssembleOptions, Stage},
    assembly::draft::PlanError,
    assembly::error::{AssembleError, Misfit},
    assembly::from_layout::BlocksError,
    assembly::polygons::{MeshError, PolygonMesh, UpAxis},
    assembly::{extrude, surface},
    layout::Layout,
    layout::blocks::{Blocks, MAX_GRID_CELLS},
    maze::{FaceNote, FaceReason, ImportReport, Maze},
    navigation::ends::Endpoint,
    physics::bounds::Bounds,
    play::autopilot::{Autopilot, AutopilotError},
    play::replay,
    play::rules::{Event, Phase, Run},
};

/// The examples of README.md, as tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
