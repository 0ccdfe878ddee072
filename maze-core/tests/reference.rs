//! The exact engine against a reference that shares nothing with it: brute force, in numbers of 192 bits.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]
#![allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "counts, small and not negative")]
#![allow(clippy::disallowed_methods, reason = "the truth that a test compares with may use any function")]

#[path = "reference/chains.rs"]
mod chains;
#[path = "reference/found.rs"]
mod found;
#[path = "reference/gaps.rs"]
mod gaps;
mod irregular;
mod noise;
#[path = "reference/mod.rs"]
mod reference_model;
#[path = "reference/rolls.rs"]
mod rolls;
#[path = "reference/wedges.rs"]
mod wedges;
