//! Bytes -> polygons, layouts or blocks. Nothing in the physics knows of this.

pub mod obj;
pub mod picture;
pub mod svg;
pub mod text;
