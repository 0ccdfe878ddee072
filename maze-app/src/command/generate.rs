//! `maze-app generate`: a random maze as a file.

use crate::failure::Failure;
use crate::recipe::{self, RecipeArguments};
use crate::{files, measures};
use clap::Args;
use maze_core::{AssembleOptions, Maze, export, extrude};
use std::path::PathBuf;

#[derive(Args)]
#[command(after_help = "Examples:\n  maze-app generate --size 20x12 --seed 7 --out my_maze.obj\n  \
                        maze-app generate --size 20x12 --algorithm wilson --braid 0.5 --out loops.obj\n  \
                        maze-app generate --size 20x12 --elitism 30 --river 80 --out rivers.obj")]
pub(crate) struct Arguments {
    #[command(flatten)]
    recipe: RecipeArguments,
    /// Where to write it; the name ends in .obj
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    files::expect_extension(&arguments.out, "obj")?;
    let recipe = arguments.recipe.recipe();
    let mesh = extrude::extrude(&recipe.layout().map_err(Failure::bad_input)?);
    // The numbers are those of the maze as it is played.
    let maze = Maze::from_polygons(&mesh, &AssembleOptions::default()).map_err(Failure::bad_input)?;
    let words = recipe::words(&recipe).join(" ").replace('=', " ");
    let text = export::to_obj(&mesh, &format!("maze-app generate {words}"));
    files::write_whole(&arguments.out, text.as_bytes())?;
    let mut lines = vec![format!("{}: {words}", arguments.out.display())];
    lines.extend(measures::lines(&maze));
    files::print(&(lines.join("\n") + "\n"))
}
