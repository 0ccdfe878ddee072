//! The table on the terminal.

use crate::results::Results;
use std::fmt::Write;

/// x
pub fn table(results: &Results) -> String {
    let mut text = String::new();
    for v in &results.verdicts {
        let _ = writeln!(
            text,
            "{:20} {:?} limit {:e} checked {} worst {:?} missed {}",
            v.metric,
            v.engines,
            v.limit,
            v.n_checked,
            v.worst,
            v.missed.len()
        );
    }
    text
}
