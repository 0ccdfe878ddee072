//! `maze-app generate`: a random maze as a file.

use crate::failure::Failure;
use crate::files;
use crate::source::{GridSize, fresh_seed, parse_grid_size};
use clap::{Args, ValueEnum};
use maze_core::{export, extrude, layout};
use std::path::PathBuf;

#[derive(Args)]
#[command(after_help = "Example:\n  maze-app generate --size 20x12 --seed 7 --out my_maze.obj")]
pub(crate) struct Arguments {
    /// Cells along x and y
    #[arg(long, value_name = "WxH", value_parser = parse_grid_size, default_value = GridSize::DEFAULT)]
    size: GridSize,
    /// How the maze is made
    #[arg(long, value_enum, default_value_t = Algorithm::Backtracker)]
    algorithm: Algorithm,
    /// The same seed gives the same maze [default: a new one]
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// Where to write it; the name ends in .obj
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
}

#[derive(Clone, Copy, ValueEnum)]
enum Algorithm {
    /// Recursive backtracker: long winding corridors, few dead ends
    Backtracker,
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    files::expect_extension(&arguments.out, "obj")?;
    let seed = arguments.seed.unwrap_or_else(fresh_seed);
    let GridSize { width, height } = arguments.size;
    let layout = match arguments.algorithm {
        Algorithm::Backtracker => layout::recursive_backtracker(width, height, seed),
    }
    .map_err(Failure::bad_input)?;
    let comment = format!("maze-app generate --size {width}x{height} --algorithm backtracker --seed {seed}");
    let text = export::obj::to_obj(&extrude::extrude(&layout), &comment);
    files::write_whole(&arguments.out, text.as_bytes())?;
    files::print(&format!("{}: {width}x{height} cells, seed {seed}\n", arguments.out.display()))
}
