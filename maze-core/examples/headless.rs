//! A ball dropped into a random maze: `cargo run -p maze-core --example headless`.

use maze_core::{AssembleOptions, Engine, Tilt, gravity, layout};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let layout = layout::recursive_backtracker(10, 8, 2020)?;
    let maze = layout.maze(&AssembleOptions::default())?;
    let mut engine = maze.exact_engine(0.03)?;
    let tilt = Tilt::from_half_tangents(0.1, -0.05); // the sides towards +x and -y are down
    let acceleration = gravity::project(gravity::WORLD_GRAVITY, &tilt.world_from_maze());
    for _ in 0..100 {
        engine.tick(acceleration)?;
    }
    println!("after 3 s the ball is at {:?}", engine.ball().position);
    Ok(())
}
