//! `maze-app generate`: a random maze as a file.

use crate::failure::Failure;
use crate::measures;
use crate::platform::native::{files, maze_file};
use crate::recipe::{self, RecipeArguments};
use clap::Args;
use maze_core::{AssembleOptions, printable};
use std::path::PathBuf;

#[derive(Args)]
#[command(after_help = "Examples:\n  maze-app generate --size 20x12 --seed 7 --out my_maze.obj\n  \
                        maze-app generate --size 20x12 --algorithm wilson --braid 0.5 --out loops.obj\n  \
                        maze-app generate --size 20x12 --elitism 30 --river 80 --out rivers.txt\n  \
                        maze-app generate --size 20x20 --doors --solution --out my_maze.svg")]
pub(crate) struct Arguments {
    #[command(flatten)]
    recipe: RecipeArguments,
    /// Open the outer wall in the middle of the top and the bottom: start and goal, as on mazegenerator.net
    #[arg(long)]
    doors: bool,
    /// Draw the shortest path from start to goal too (.svg)
    #[arg(long)]
    solution: bool,
    /// Where to write it; the name ends in .obj (gets maze-app.mtl beside it), .svg or .txt
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let recipe = arguments.recipe.recipe();
    let n_cells = recipe.width.saturating_mul(recipe.height);
    maze_file::expect_writable(&arguments.out, n_cells, arguments.solution)?;
    let materials = maze_file::written_beside(&arguments.out);
    let materials = materials.as_deref().map(|path| ("its materials", path));
    let outputs: Vec<files::Named> =
        [("--out", arguments.out.as_path())].into_iter().chain(materials).collect();
    files::expect_outputs(&outputs, &[])?;
    let layout = recipe.layout().map_err(Failure::bad_input)?;
    let layout = if arguments.doors { layout.with_doors_top_and_bottom() } else { layout };
    // The numbers are those of the maze as it is played.
    let maze = layout.maze(&AssembleOptions::default()).map_err(Failure::bad_input)?;
    let doors = if arguments.doors { " --doors" } else { "" };
    let words = recipe::words(&recipe).join(" ").replace('=', " ") + doors;
    let solution = if arguments.solution { layout.solution() } else { None };
    maze_file::write(&arguments.out, &layout, solution.as_deref(), &format!("maze-app generate {words}"))?;
    let mut lines = vec![printable(&format!("{}: {words}", arguments.out.display()))];
    lines.extend(measures::lines(&maze));
    files::print(&(lines.join("\n") + "\n"))
}
