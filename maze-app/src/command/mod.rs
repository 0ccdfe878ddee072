//! One file per subcommand.

pub(crate) mod autopilot;
pub(crate) mod frames;
pub(crate) mod generate;
pub(crate) mod info;
pub(crate) mod play;
pub(crate) mod render;
pub(crate) mod replay;
