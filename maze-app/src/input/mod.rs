//! Mouse and keys -> the maze's tilt.

mod arcball;
mod bindings;
mod keyboard;
mod letters;
mod tilt_control;

pub(crate) use arcball::drag_tangents;
pub(crate) use bindings::{Action, Control};
pub(crate) use keyboard::{Effect, Keyboard, Stroke};
pub(crate) use letters::{Layout, Letters, lettered_places};
pub(crate) use tilt_control::{Direction, TiltControl};
