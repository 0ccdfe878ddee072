//! Bytes -> polygons, layouts or blocks. The physics does not depend on this.

pub mod obj;
pub mod picture;
pub(crate) mod printable;
pub mod svg;
pub mod text;
