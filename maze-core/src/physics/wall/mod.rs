//! What a ball can touch: wall faces and their end points.

mod feature;
mod plane;

pub use feature::*;
pub use plane::*;
