//! Where the centre of the ball can be (the configuration space), and paths through it.

pub(crate) mod ends;
pub(crate) mod space;
