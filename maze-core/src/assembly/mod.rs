//! Polygons to a maze: the plan is cut at one height, merged, measured and drawn as a surface.

pub(crate) mod assemble;
pub(crate) mod board;
pub(crate) mod draft;
pub(crate) mod error;
pub mod extrude;
pub(crate) mod frame;
pub(crate) mod from_layout;
#[cfg(feature = "generate")]
pub(crate) mod from_recipe;
pub(crate) mod occupancy;
pub(crate) mod polygons;
pub(crate) mod slice;
pub mod surface;
pub(crate) mod survey;
pub(crate) mod winding;
