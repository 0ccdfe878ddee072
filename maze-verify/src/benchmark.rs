//! `maze-verify bench`.

use crate::{BadInput, files};
use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use maze_verify::bench::{Plan, measure, search};
use std::path::PathBuf;

#[derive(Args)]
pub(crate) struct BenchArguments {
    /// Under a minute: fewer rounds, and no maze of 10 million planes
    #[arg(long)]
    quick: bool,
    /// Writes bench.csv, with every round, and bench.svg there
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// Measures and prints; whether all agree that must.
pub(crate) fn bench(arguments: &BenchArguments) -> Result<bool, BadInput> {
    if let Some(out) = &arguments.out {
        files::make_directory(out)?;
    }
    if cfg!(debug_assertions) {
        eprintln!("note: figures of a debug build mean nothing; cargo run --release -p maze-verify -- bench");
    }
    let plan = if arguments.quick { Plan::quick() } else { Plan::full() };
    let bar = ProgressBar::new(0);
    // The template is ours and known to be good; a plain bar is no harm either.
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {pos}/{len} {msg}") {
        bar.set_style(style);
    }
    let on_step = |what: &str, n_steps: usize| {
        bar.set_length(n_steps as u64);
        bar.set_message(what.to_owned());
        bar.inc(1);
    };
    let figures =
        measure(&plan, &search::CONTENDERS, &on_step).map_err(|error| BadInput(error.to_string()))?;
    bar.finish_and_clear();
    if let Some(out) = &arguments.out {
        files::write_whole(&out.join("bench.csv"), figures.csv().as_bytes())?;
    }
    files::print(&figures.table())?;
    Ok(figures.held())
}
