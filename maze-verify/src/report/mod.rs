//! What people read: a table on the terminal and report.html. (results.json is [`crate::results::Results`] itself.)

mod drawing;
mod html;
mod model_error;
pub(crate) mod number;
pub(crate) mod plot;
mod summary;
mod table;

pub use html::html;
pub use summary::{Finding, findings};
pub use table::table;
