//! The engines by name, and how each is set up for a scene.

use crate::engine::{ClosedForm, RapierEngine, RollingEngine, Walls};
use crate::scene::Stage;
use maze_core::{Continuous, Engine, OutOfRange, Published};
use serde::{Deserialize, Serialize};

/// An engine of the cross-check.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Contender {
    /// The truth, where there is one.
    ClosedForm,
    /// maze-core's exact engine.
    Continuous,
    /// maze-core's engine after the report.
    Published,
    /// rapier3d, held in the plane, a cuboid a wall.
    RapierCuboids,
    /// rapier3d, held in the plane, the walls as one triangle mesh.
    RapierMesh,
    /// rapier3d in three dimensions on a tilting board.
    RapierRolling,
}

impl Contender {
    /// In the order of tables and legends.
    pub const ALL: [Self; 6] = [
        Self::ClosedForm,
        Self::Continuous,
        Self::Published,
        Self::RapierCuboids,
        Self::RapierMesh,
        Self::RapierRolling,
    ];

    /// As on the command line and in results.json.
    pub fn name(self) -> &'static str {
        match self {
            Self::ClosedForm => "closed-form",
            Self::Continuous => "continuous",
            Self::Published => "published",
            Self::RapierCuboids => "rapier-cuboids",
            Self::RapierMesh => "rapier-mesh",
            Self::RapierRolling => "rapier-rolling",
        }
    }

    /// What it is, for people.
    pub fn about(self) -> &'static str {
        match self {
            Self::ClosedForm => "the motion by formula, where there is one",
            Self::Continuous => "maze-core's exact engine, the game's default",
            Self::Published => "the report's method, step for step",
            Self::RapierCuboids => "rapier3d in the plane, walls as cuboids",
            Self::RapierMesh => "rapier3d in the plane, walls as a triangle mesh",
            Self::RapierRolling => "rapier3d in three dimensions: a tilting board, a rolling ball",
        }
    }

    /// Whether it is one of rapier's that solve the same problem as ours: in the plane, under projected gravity.
    pub fn is_planar_rapier(self) -> bool {
        matches!(self, Self::RapierCuboids | Self::RapierMesh)
    }
}

/// Sets an engine up on a stage; `None` when the scene has no closed form to ask.
///
/// Tests hand in a function of their own that breaks something, and expect the run to notice.
pub type Build = dyn Fn(Contender, &Stage, f64) -> Result<Option<Box<dyn Engine>>, OutOfRange> + Sync;

/// The engines as they are.
///
/// # Errors
/// A scene that the engine refuses.
pub fn build(
    contender: Contender,
    stage: &Stage,
    tick_s: f64,
) -> Result<Option<Box<dyn Engine>>, OutOfRange> {
    let (board, spec, ball) = (&stage.board, stage.scene.spec, stage.ball);
    let planes = board.planes().clone();
    let rapier = |walls| RapierEngine::new(board, walls, spec, ball, tick_s);
    Ok(Some(match contender {
        Contender::ClosedForm => match &stage.scene.truth {
            Some(motion) => Box::new(ClosedForm::new(motion.clone(), spec, ball, tick_s)?),
            None => return Ok(None),
        },
        Contender::Continuous => Box::new(Continuous::new(planes, spec, ball, tick_s)?),
        Contender::Published => Box::new(Published::new(planes, spec, ball, tick_s)?),
        Contender::RapierCuboids => Box::new(rapier(Walls::Cuboids)?),
        Contender::RapierMesh => Box::new(rapier(Walls::TriangleMesh)?),
        Contender::RapierRolling => Box::new(RollingEngine::new(board, spec, ball, tick_s)?),
    }))
}
