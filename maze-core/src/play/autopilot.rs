//! A bot that plays any solvable maze to the goal by tilting: demo, soak test, rival.

use crate::maze::{Maze, Route};
use crate::navigation::space::{ConfigurationSpace, Distances};
use crate::physics::ball::{Ball, OutOfRange};
use crate::physics::gravity::{Tilt, WORLD_GRAVITY};
use crate::physics::numbers::lesser;
use nalgebra::Vector2;
use std::sync::Arc;

/// Fastest that the ball is wanted to go (units/s): a corridor takes a third of a second, and a wall is met gently.
const TOP_SPEED: f64 = 3.0;

/// Fraction of the strongest acceleration that braking may count on; the rest keeps the ball in the middle of the corridor.
const BRAKING_FRACTION: f64 = 0.6;

/// How fast a wrong speed is corrected (1/s): within some ten ticks, so that the tick's delay does not make it swing.
const GAIN_PER_S: f64 = 6.0;

/// Below this speed (units/s) resistance is against the start of a motion, not against the motion.
const SLOW: f64 = 0.05;

/// Ticks without coming nearer to the goal after which the ball is shaken loose, and for how many it is shaken.
const PATIENCE_TICKS: u32 = 300;
const SHAKE_TICKS: u32 = 40;

/// Why there is no autopilot for a maze.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum AutopilotError {
    /// There is nothing to follow.
    #[error("no path leads from start to goal")]
    NoPath,
    /// The tilt limit.
    #[error(transparent)]
    Limit(#[from] OutOfRange),
}

/// Steers towards the goal along the paths through one maze. Deterministic.
#[derive(Clone, Debug)]
pub struct Autopilot {
    space: Arc<ConfigurationSpace>,
    from_goal: Distances,
    goal: Vector2<f64>,
    /// The strongest drive of gravity in the plane, and what the ball makes of it (units/s²).
    steepest: f64,
    rolling: f64,
    resistance: f64,
    half_tangent_limit: f64,
    cell: Option<usize>,
    nearest: f64,
    n_ticks_without_progress: u32,
}

impl Autopilot {
    /// `half_tangent_limit` is the tangent of half the steepest tilt it may use, as the player's limit: from [`Tilt::STEP`] to 1, and
    /// rounded to the nearest step.
    ///
    /// # Errors
    /// A limit out of range; a maze without a path from start to goal.
    pub fn new(maze: &Maze, half_tangent_limit: f64) -> Result<Self, AutopilotError> {
        if !(Tilt::STEP..=1.0).contains(&half_tangent_limit) {
            let expected = "1/32768 to 1";
            return Err(OutOfRange { what: "the half-angle tangent of the steepest tilt", expected }.into());
        }
        let Route { goal, is_solvable, space, .. } = &maze.route;
        let cell = space.cell_at(*goal).filter(|_| *is_solvable).ok_or(AutopilotError::NoPath)?;
        let from_goal = space.distances_from(cell);
        // sin of twice the half angle: 2 t / (1 + t²).
        let sin = 2.0 * half_tangent_limit / (1.0 + half_tangent_limit * half_tangent_limit);
        Ok(Self {
            space: Arc::clone(space),
            from_goal,
            goal: *goal,
            steepest: -WORLD_GRAVITY.z * sin,
            rolling: maze.ball_spec().rolling,
            resistance: maze.ball_spec().resistance,
            half_tangent_limit,
            cell: None,
            nearest: f64::INFINITY,
            n_ticks_without_progress: 0,
        })
    }

    /// The tilt for the next tick.
    pub fn tilt(&mut self, ball: Ball) -> Tilt {
        // On an arc around a corner the ball is where a square of its size would overlap the wall: then the last cell counts.
        self.cell = self
            .space
            .cell_at(ball.position)
            .filter(|cell| self.from_goal.to(*cell).is_finite())
            .or(self.cell);
        let Some(cell) = self.cell else { return Tilt::LEVEL };
        if self.is_stuck(cell) {
            return self.shake();
        }
        let (target, is_last) = self.target(cell);
        let to_target = target - ball.position;
        if is_last && to_target == Vector2::zeros() && ball.velocity == Vector2::zeros() {
            // It starts on the goal: the least tilt starts the clock, and the run is done.
            return Tilt { towards_x: 1, towards_y: 0 };
        }
        let distance = to_target.norm();
        let braking = BRAKING_FRACTION * self.rolling * self.steepest;
        let fastest = (2.0 * braking * distance).sqrt();
        // The goal may be passed at any speed.
        let speed = if is_last || TOP_SPEED < fastest { TOP_SPEED } else { fastest };
        let wanted = to_target.try_normalize(0.0).unwrap_or_default() * speed;
        self.tilt_for(self.drive((wanted - ball.velocity) * GAIN_PER_S, ball.velocity))
    }

    /// The end of the straight stretch that begins in a cell: its middle, and whether that is the goal.
    fn target(&self, cell: usize) -> (Vector2<f64>, bool) {
        let Some(first) = self.next(cell) else { return (self.goal, true) };
        let (from, mut end) = (self.space.middle(cell), first);
        let is_straight = |to: usize| {
            let offset = self.space.middle(to) - from;
            offset.x == 0.0 || offset.y == 0.0
        };
        while let Some(next) = self.next(end) {
            if !is_straight(next) {
                return (self.space.middle(end), false);
            }
            end = next;
        }
        (self.goal, true)
    }

    /// The neighbour from which the goal is nearest, `None` at the goal.
    fn next(&self, cell: usize) -> Option<usize> {
        let here = self.from_goal.to(cell);
        let nearer = self.space.neighbours(cell).filter(|next| self.from_goal.to(*next) < here);
        nearer.min_by(|a, b| self.from_goal.to(*a).total_cmp(&self.from_goal.to(*b)))
    }

    fn is_stuck(&mut self, cell: usize) -> bool {
        let here = self.from_goal.to(cell);
        if here < self.nearest {
            self.nearest = here;
            self.n_ticks_without_progress = 0;
        } else {
            self.n_ticks_without_progress += 1;
        }
        let over = self.n_ticks_without_progress % PATIENCE_TICKS;
        PATIENCE_TICKS <= self.n_ticks_without_progress && over < SHAKE_TICKS
    }

    /// Turns through the four directions, another one first each time.
    fn shake(&self) -> Tilt {
        let round = self.n_ticks_without_progress / PATIENCE_TICKS;
        let quarter = (self.n_ticks_without_progress % PATIENCE_TICKS) / (SHAKE_TICKS / 4);
        let limit = self.half_tangent_limit;
        match (round + quarter) % 4 {
            0 => Tilt::from_half_tangents(limit, 0.0),
            1 => Tilt::from_half_tangents(0.0, limit),
            2 => Tilt::from_half_tangents(-limit, 0.0),
            _ => Tilt::from_half_tangents(0.0, -limit),
        }
    }

    /// The part of gravity in the plane that accelerates a ball so, against the resistance to its motion or to its start.
    fn drive(&self, acceleration: Vector2<f64>, velocity: Vector2<f64>) -> Vector2<f64> {
        if self.resistance == 0.0 {
            return acceleration / self.rolling;
        }
        let moves = SLOW < velocity.norm();
        let resisted = if moves { velocity } else { acceleration };
        let against = resisted.try_normalize(0.0).unwrap_or_default() * self.resistance;
        (acceleration + against) / self.rolling
    }

    /// The tilt under which gravity drives so, or as strongly as it may in that direction.
    fn tilt_for(&self, drive: Vector2<f64>) -> Tilt {
        let strength = drive.norm();
        if strength == 0.0 {
            return Tilt::LEVEL;
        }
        let sin = lesser(self.steepest, strength) / -WORLD_GRAVITY.z;
        let half_tangent = sin / (1.0 + (1.0 - sin * sin).sqrt());
        let direction = drive / strength;
        Tilt::from_half_tangents(direction.x * half_tangent, direction.y * half_tangent)
    }
}
