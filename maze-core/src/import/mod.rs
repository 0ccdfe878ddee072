//! Bytes -> polygons, layouts or blocks. Nothing in the physics knows of this.

pub mod obj;
pub mod picture;
pub(crate) mod printable;
pub mod svg;
pub mod text;
