//! `maze-verify bench`.

use crate::{BadInput, files};
use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use maze_verify::bench::{BenchError, Plan, measure, n_steps, search, tick};
use std::io::Write;
use std::path::PathBuf;

#[derive(Args)]
pub(crate) struct BenchArguments {
    /// Under a minute: fewer rounds, and no maze of 10 million planes
    #[arg(long)]
    quick: bool,
    /// Only mazes of at most about this many planes
    #[arg(long, value_name = "N")]
    max_planes: Option<usize>,
    /// Writes bench.csv (every round), agreement.csv and bench.svg there
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// Measures and prints; whether all agree that must.
pub(crate) fn bench(arguments: &BenchArguments) -> Result<bool, BadInput> {
    let plan = if arguments.quick { Plan::quick() } else { Plan::full() };
    let plan = plan.up_to(arguments.max_planes.unwrap_or(usize::MAX));
    if plan.sizes.is_empty() {
        return Err(BadInput("--max-planes leaves no maze: the smallest has 112 planes".to_owned()));
    }
    if cfg!(debug_assertions) {
        let _ = writeln!(
            std::io::stderr(),
            "note: figures of a debug build mean nothing; cargo run --release -p maze-verify -- bench"
        );
    }
    if let Some(out) = &arguments.out {
        files::make_directory(out)?;
    }
    let bar = ProgressBar::new((n_steps(&plan) + tick::n_steps(&plan)) as u64);
    // The template is ours and known to be good; a plain bar is no harm either.
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {pos}/{len} {msg}") {
        bar.set_style(style);
    }
    let on_step = |what: &str| {
        bar.set_message(what.to_owned());
        bar.inc(1);
    };
    let bad = |error: BenchError| BadInput(error.to_string());
    let mut figures = measure(&plan, &search::CONTENDERS, &on_step).map_err(bad)?;
    tick::measure(&plan, &mut figures, &on_step).map_err(bad)?;
    bar.finish_and_clear();
    // First, so that minutes of measuring are not lost with a file that cannot be written.
    files::print(&figures.table())?;
    if let Some(out) = &arguments.out {
        files::write_whole(&out.join("bench.csv"), figures.csv().as_bytes())?;
        files::write_whole(&out.join("agreement.csv"), figures.agreement_csv().as_bytes())?;
        files::write_whole(&out.join("bench.svg"), figures.chart().as_bytes())?;
    }
    Ok(figures.held())
}
