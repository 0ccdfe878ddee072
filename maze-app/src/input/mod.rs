//! Mouse and keys -> the maze's tilt.

mod arcball;
mod bindings;
mod keyboard;
mod letters;
mod tilt_control;

pub(crate) use arcball::{drag_tangents, relative_tangents};
pub(crate) use bindings::{Action, Bindings, Control, HINTS, Key, KeySet, MAX_KEYS, TABLE, entry_of};
pub(crate) use keyboard::{Effect, Keyboard, Stroke};
pub(crate) use letters::{Layout, Letters, lettered_places};
#[cfg(test)]
pub(crate) use tilt_control::Direction;
pub(crate) use tilt_control::TiltControl;
