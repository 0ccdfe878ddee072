//! Bytes -> polygons. Nothing in the physics knows of this.

pub mod obj;
