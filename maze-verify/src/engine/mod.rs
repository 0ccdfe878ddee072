//! Engines beyond maze-core's, all behind its [`maze_core::Engine`].

mod closed_form;
mod rapier;
mod rolling;

pub use closed_form::{ClosedForm, Motion, Stretch};
pub use rapier::{RapierEngine, Walls};
pub use rolling::RollingEngine;

use maze_core::{BallSpec, OutOfRange};

/// Neither rapier on a tilting board nor closed form knows rolling resistance: a ball that has some is refused, not taken for one without.
fn without_resistance(spec: BallSpec) -> Result<BallSpec, OutOfRange> {
    let spec = spec.checked()?;
    let expected = "0, for an engine other than ours";
    if spec.resistance == 0.0 {
        Ok(spec)
    } else {
        Err(OutOfRange { what: "the rolling resistance", expected })
    }
}
