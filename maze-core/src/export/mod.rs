//! Polygons, layouts and blocks -> text of files.

pub mod obj;
pub mod svg;
pub mod text;
