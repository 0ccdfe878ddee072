//! What people read: a table, results.json and report.html.

mod table;

pub use table::table;
