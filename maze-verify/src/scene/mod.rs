//! Scenes: a maze, a ball and a tilting board as plain data.

mod catalogue;
mod contacts;
mod file;
mod gravity;
mod levels;
mod pieces;

pub use catalogue::catalogue;
pub use file::{SceneFileError, read};
pub use gravity::Gravity;
pub use pieces::TICKS_S;

use crate::board::Board;
use crate::engine::Motion;
use maze_core::layout::{Recipe, RecipeError};
use maze_core::{AssembleError, AssembleOptions, Ball, BallSpec, Bounds, Maze, PlaneError, extrude, import};
use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

/// What a scene is about; tolerances and summary speak of families.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Family {
    /// Nothing is touched: the board tilts and the ball runs.
    Tilt,
    /// A bounce without gravity: head-on, at an angle, to and fro.
    Bounce,
    /// Dropped onto a wall, bouncing until it rests.
    Drop,
    /// A convex corner.
    Corner,
    /// Past a convex corner by a hair's breadth, on either side.
    Graze,
    /// Resting, sliding, squeezing through.
    Slide,
    /// Along a wall made of many pieces.
    Seams,
    /// Fast, at a thin wall.
    Speed,
    /// Between two features nearer to each other than the ball is wide.
    Wedge,
    /// Slowly off the edge of a block.
    RollOver,
    /// Over small steps of a floor.
    Step,
    /// Over slits in a floor.
    Slit,
    /// Around the end of a thin wall.
    FreeEnd,
    /// In a corridor as wide as the ball, and at one that is too narrow.
    Narrow,
    /// A random maze with random tilts.
    Maze,
    /// A level of the game.
    Level,
    /// From a file of the user's.
    Own,
}

impl Family {
    /// In the order of the report.
    pub const ALL: [Self; 17] = [
        Self::Tilt,
        Self::Bounce,
        Self::Drop,
        Self::Corner,
        Self::Graze,
        Self::Slide,
        Self::Seams,
        Self::Speed,
        Self::Wedge,
        Self::RollOver,
        Self::Step,
        Self::Slit,
        Self::FreeEnd,
        Self::Narrow,
        Self::Maze,
        Self::Level,
        Self::Own,
    ];

    /// As in results.json.
    pub fn name(self) -> &'static str {
        match self {
            Self::Tilt => "tilt",
            Self::Bounce => "bounce",
            Self::Drop => "drop",
            Self::Corner => "corner",
            Self::Graze => "graze",
            Self::Slide => "slide",
            Self::Seams => "seams",
            Self::Speed => "speed",
            Self::Wedge => "wedge",
            Self::RollOver => "roll-over",
            Self::Step => "step",
            Self::Slit => "slit",
            Self::FreeEnd => "free-end",
            Self::Narrow => "narrow",
            Self::Maze => "maze",
            Self::Level => "level",
            Self::Own => "own",
        }
    }
}

/// Where the walls come from.
#[derive(Clone, Debug, PartialEq)]
pub enum Walls {
    /// Solid rectangles; they may touch and overlap.
    Rectangles(Vec<Bounds>),
    /// A generated maze.
    Generated(Recipe),
    /// The bytes of a Wavefront OBJ.
    Obj(Vec<u8>),
}

/// Everything that an engine needs, and what is known of the outcome.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// As on the command line.
    pub name: String,
    /// One sentence.
    pub about: String,
    /// What it is about.
    pub family: Family,
    /// The maze.
    pub walls: Walls,
    /// The ball at first; `None`: at rest at the maze's start.
    pub ball: Option<Ball>,
    /// Radius, restitution and whether it rolls.
    pub spec: BallSpec,
    /// How the board is tilted.
    pub gravity: Gravity,
    /// How long (s).
    pub duration_s: f64,
    /// Tick lengths it is run with (s).
    pub ticks_s: Vec<f64>,
    /// What the ball does by formula.
    pub truth: Option<Motion>,
    /// Where the ball lies at rest in the end (units), if that is known.
    pub rest: Option<Vector2<f64>>,
}

/// Why a scene cannot be set up.
#[derive(Debug, thiserror::Error)]
pub enum SceneError {
    /// No layout of this size.
    #[error(transparent)]
    Layout(#[from] RecipeError),
    /// No OBJ.
    #[error(transparent)]
    Obj(#[from] import::obj::ObjError),
    /// No maze.
    #[error(transparent)]
    Maze(#[from] AssembleError),
    /// No rectangle.
    #[error(transparent)]
    Plane(#[from] PlaneError),
    /// Rectangles know no place to start.
    #[error("walls given as rectangles need a ball with a position")]
    NoBall,
    /// The ball starts in a wall.
    #[error("the ball starts {depth} deep in a wall: expected a free place")]
    InWall {
        /// In units.
        depth: f64,
    },
}

/// A ball set down at its radius may read as this far inside (units): rounding.
const SET_DOWN: f64 = 1.0e-9;

/// A scene whose walls stand.
#[derive(Clone, Debug)]
pub struct Stage {
    /// As given.
    pub scene: Scene,
    /// Its walls.
    pub board: Board,
    /// The ball at first.
    pub ball: Ball,
}

impl Scene {
    /// Builds the walls and puts the ball down.
    ///
    /// # Errors
    /// Walls that are no maze; a ball without a place, or in a wall.
    pub fn set_up(&self) -> Result<Stage, SceneError> {
        let options = AssembleOptions { ball_radius: Some(self.spec.radius), ..AssembleOptions::default() };
        let maze = |mesh| Maze::from_polygons(&mesh, &options);
        let (board, start) = match &self.walls {
            Walls::Rectangles(walls) => (Board::from_rectangles(walls.clone())?, None),
            Walls::Generated(recipe) => {
                let maze = maze(extrude::extrude(&recipe.layout()?))?;
                (Board::from_planes(&maze.planes), Some(maze.start()))
            }
            Walls::Obj(bytes) => {
                let maze = maze(import::obj::read(bytes)?)?;
                (Board::from_planes(&maze.planes), Some(maze.start()))
            }
        };
        let ball = self.ball.or(start.map(Ball::at)).ok_or(SceneError::NoBall)?;
        let depth = board.penetration(ball.position, self.spec.radius.units());
        if SET_DOWN < depth || !board.can_have_moved(ball.position, ball.position, 0.0) {
            return Err(SceneError::InWall { depth });
        }
        Ok(Stage { scene: self.clone(), board, ball })
    }
}

impl Stage {
    /// Ticks of a length that the scene lasts.
    pub fn n_ticks(&self, tick_s: f64) -> u32 {
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "bounded by the scene file"
        )]
        let n_ticks = (self.scene.duration_s / tick_s).round() as u32;
        n_ticks.max(1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_scene_of_the_catalogue_stands_and_has_a_name_of_its_own() {
        let mut names = std::collections::BTreeSet::new();
        for scene in catalogue().unwrap() {
            let stage = scene.set_up().unwrap_or_else(|error| panic!("{}: {error}", scene.name));
            assert!(names.insert(scene.name.clone()), "{} twice", scene.name);
            assert!(!scene.about.is_empty() && !scene.ticks_s.is_empty() && 0 < stage.n_ticks(0.03));
        }
        assert!(190 < names.len());
    }

    #[test]
    fn a_ball_in_a_wall_is_refused() {
        let mut scene = catalogue().unwrap().swap_remove(0);
        scene.walls =
            Walls::Rectangles(vec![Bounds { low: Vector2::new(-9.0, -9.0), high: Vector2::new(9.0, 9.0) }]);
        assert!(matches!(scene.set_up(), Err(SceneError::InWall { .. })));
    }
}
