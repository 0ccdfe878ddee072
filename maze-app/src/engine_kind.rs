//! The engines by name.

use crate::failure::Failure;
use clap::ValueEnum;
use maze_core::{Ball, BallSpec, Continuous, Engine, Maze, OutOfRange, Published};

/// How the ball's motion is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum EngineKind {
    /// Exact: from touch to touch on parabolas, no substeps, no penetration
    Continuous,
    /// The report's method, step for step
    Published,
    /// rapier3d, for comparison
    Rapier,
}

impl EngineKind {
    /// Those that this program was built with, in the order in which they are shown as ghosts.
    pub(crate) const BUILT: &[Self] = match cfg!(feature = "rapier") {
        true => &[Self::Rapier, Self::Continuous, Self::Published],
        false => &[Self::Continuous, Self::Published],
    };

    /// As on the command line.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Continuous => "continuous",
            Self::Published => "published",
            Self::Rapier => "rapier",
        }
    }

    /// Around a maze, with the maze's ball where it is given, at the game's tick.
    pub(crate) fn build(self, maze: &Maze, ball: Ball) -> Result<Box<dyn Engine>, Failure> {
        self.build_with(maze, maze.ball_spec(), ball, Published::TICK_S)
    }

    /// Around a maze, with any ball and any length of a tick (s).
    pub(crate) fn build_with(
        self,
        maze: &Maze,
        spec: BallSpec,
        ball: Ball,
        tick_s: f64,
    ) -> Result<Box<dyn Engine>, Failure> {
        let planes = maze.planes.clone();
        let built: Result<Box<dyn Engine>, OutOfRange> = match self {
            Self::Continuous => {
                Continuous::new(planes, spec, ball, tick_s).map(|engine| Box::new(engine) as _)
            }
            Self::Published => Published::new(planes, spec, ball, tick_s).map(|engine| Box::new(engine) as _),
            Self::Rapier => return rapier(maze, spec, ball, tick_s),
        };
        built.map_err(Failure::bad_input)
    }
}

#[cfg(feature = "rapier")]
fn rapier(maze: &Maze, spec: BallSpec, ball: Ball, tick_s: f64) -> Result<Box<dyn Engine>, Failure> {
    let board = maze_verify::Board::from_planes(&maze.planes);
    let walls = maze_verify::Walls::Cuboids;
    let engine = maze_verify::RapierEngine::new(&board, walls, spec, ball, tick_s);
    Ok(Box::new(engine.map_err(Failure::bad_input)?))
}

#[cfg(not(feature = "rapier"))]
fn rapier(_: &Maze, _: BallSpec, _: Ball, _: f64) -> Result<Box<dyn Engine>, Failure> {
    Err(Failure::bad_input("this maze-app was built without rapier; `--features rapier` builds it in"))
}
