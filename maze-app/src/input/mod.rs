//! Mouse and keys -> the maze's tilt.

mod arcball;
mod keys;
mod tilt_control;

pub(crate) use arcball::sphere_point;
pub(crate) use keys::{Action, action_of, tilt_direction_of};
pub(crate) use tilt_control::TiltControl;
