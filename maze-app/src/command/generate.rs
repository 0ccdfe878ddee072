//! `maze-app generate`: a random maze as a file.

use crate::failure::Failure;
use crate::files;
use crate::maze_file;
use crate::source::{GridSize, fresh_seed, parse_grid_size};
use clap::{Args, ValueEnum};
use maze_core::layout;
use std::path::PathBuf;

#[derive(Args)]
#[command(after_help = "Examples:\n  maze-app generate --size 20x12 --seed 7 --out my_maze.obj\n  \
                        maze-app generate --size 20x20 --doors --solution --out my_maze.svg")]
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
    /// Open the outer wall in the middle of the top and the bottom: start and goal, as on mazegenerator.net
    #[arg(long)]
    doors: bool,
    /// Draw the shortest way from start to goal too (.svg)
    #[arg(long)]
    solution: bool,
    /// Where to write it; the name ends in .obj (gets maze-app.mtl beside it), .svg or .txt
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
}

#[derive(Clone, Copy, ValueEnum)]
enum Algorithm {
    /// Recursive backtracker: long winding corridors, few dead ends
    Backtracker,
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    maze_file::expect_writable(&arguments.out, arguments.solution)?;
    let seed = arguments.seed.unwrap_or_else(fresh_seed);
    let GridSize { width, height } = arguments.size;
    let layout = match arguments.algorithm {
        Algorithm::Backtracker => layout::recursive_backtracker(width, height, seed),
    }
    .map_err(Failure::bad_input)?;
    let layout = if arguments.doors { layout.with_doors_top_and_bottom() } else { layout };
    let doors = if arguments.doors { " --doors" } else { "" };
    let comment =
        format!("maze-app generate --size {width}x{height} --algorithm backtracker --seed {seed}{doors}");
    let solution = if arguments.solution { layout.solution() } else { None };
    maze_file::write(&arguments.out, &layout, solution.as_deref(), &comment)?;
    files::print(&format!("{}: {width}x{height} cells, seed {seed}\n", arguments.out.display()))
}
