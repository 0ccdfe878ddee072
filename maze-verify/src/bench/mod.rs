//! The benchmark: our searches and engines beside what else a user would pick, timed in turn.
//!
//! ```text
//! Case (a maze, its walls in every form) -> queries -> contenders -> agreement -> paired timing -> Figures: table, csv, chart
//!                                        -> tick: Course -> Movers -> agree -> Question ->
//! ```
//!
//! Nothing is timed before all contenders have given the same answers. See docs/verification.md, "The benchmark".

pub mod agreement;
pub mod case;
mod chart;
mod figures;
pub mod machine;
mod measure;
pub mod paired;
pub mod search;
mod table;
pub mod tick;

pub use agreement::{Agreement, Comparison};
pub use case::{Case, Query, QuerySet};
pub use figures::{Figures, Group, REFERENCE};
pub use machine::Machine;
pub use measure::{BenchError, Plan, measure, n_steps};
pub use paired::{Runner, Series};
pub use search::{Contender, Search};
