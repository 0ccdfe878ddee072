//! A run from start to goal: its rules, its recording, and a bot that plays it.

pub(crate) mod autopilot;
pub mod replay;
pub(crate) mod rules;
