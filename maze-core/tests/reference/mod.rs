//! The motion of a circle among wall faces, from mechanics and by brute force, in numbers of 192 bits.

pub(crate) mod big;
mod crossing;
mod roll;
mod series;
mod touch;
mod world;

pub(crate) use world::{Feature, Reference, World};
