//! Everything that a simulation of the ball needs, and nothing else: gravity in the plane, wall faces in sorted groups,
//! times of impact, contacts, the engines.

pub(crate) mod ball;
#[cfg(feature = "maze")]
pub(crate) mod bounds;
pub mod contact;
pub mod engine;
pub mod gravity;
pub(crate) mod numbers;
pub(crate) mod roots;
pub(crate) mod sorted_planes;
pub mod sweep;
pub(crate) mod tick;
pub mod time_of_impact;
pub(crate) mod tolerance;
pub mod trace;
pub(crate) mod wall;
pub(crate) mod world;
