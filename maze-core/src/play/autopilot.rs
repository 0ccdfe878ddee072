//! A bot that plays any solvable maze to the goal by tilting: demo, soak test, rival.

use crate::maze::Maze;
use crate::navigation::reach::{Distances, Reach};
use crate::physics::ball::Ball;
use crate::physics::gravity::{Tilt, WORLD_GRAVITY};
use nalgebra::Vector2;
use std::sync::Arc;

/// Fastest that the ball is wanted to go (units/s): a corridor takes a third of a second, and a wall is met gently.
const TOP_SPEED: f64 = 3.0;

/// Part of the strongest acceleration that braking may count on; the rest keeps the ball in the corridor's middle.
const BRAKING_PART: f64 = 0.6;

/// How fast a wrong speed is mended (1/s): within some ten ticks, so that the tick's delay does not make it swing.
const GAIN_PER_S: f64 = 6.0;

/// Ticks without coming nearer to the goal after which the ball is shaken loose, and for how many it is shaken.
const PATIENCE_TICKS: u32 = 300;
const SHAKE_TICKS: u32 = 40;

/// Steers towards the goal; holds the ways through one maze. Deterministic.
#[derive(Clone, Debug)]
pub struct Autopilot {
    reach: Arc<Reach>,
    from_goal: Distances,
    goal: Vector2<f64>,
    strongest: f64,
    half_tangent_limit: f64,
    cell: Option<usize>,
    nearest: f64,
    n_ticks_without_progress: u32,
}

impl Autopilot {
    /// `half_tangent_limit` is the tangent of half the steepest tilt it may use, as the player's limit, greater than 0; `None`
    /// when no way leads from start to goal.
    pub fn new(maze: &Maze, half_tangent_limit: f64) -> Option<Self> {
        let goal = maze.reach.cell_at(maze.goal)?;
        let from_goal = maze.reach.distances_from(goal);
        // sin of twice the half angle: 2 t / (1 + t²).
        let sin = 2.0 * half_tangent_limit / (1.0 + half_tangent_limit * half_tangent_limit);
        maze.solvable.then(|| Self {
            reach: Arc::clone(&maze.reach),
            from_goal,
            goal: maze.goal,
            strongest: -WORLD_GRAVITY.z * sin,
            half_tangent_limit,
            cell: None,
            nearest: f64::INFINITY,
            n_ticks_without_progress: 0,
        })
    }

    /// The tilt for the next tick.
    pub fn tilt(&mut self, ball: Ball) -> Tilt {
        // On an arc around a corner the ball stands where a square of its size would not: it still is on its way from
        // where it was.
        self.cell = self
            .reach
            .cell_at(ball.position)
            .filter(|cell| self.from_goal.to(*cell).is_finite())
            .or(self.cell);
        let Some(cell) = self.cell else { return Tilt::LEVEL };
        if self.is_stuck(cell) {
            return self.shake();
        }
        let (target, is_last) = self.target(cell);
        let way = target - ball.position;
        if is_last && way == Vector2::zeros() && ball.velocity == Vector2::zeros() {
            // It starts on the goal: the least tilt starts the clock, and the run is done.
            return Tilt { towards_x: 1, towards_y: 0 };
        }
        let distance = way.norm();
        let braking = BRAKING_PART * self.strongest;
        let fastest = (2.0 * braking * distance).sqrt();
        // The goal may be passed at any speed.
        let speed = if is_last || TOP_SPEED < fastest { TOP_SPEED } else { fastest };
        let wanted = way.try_normalize(0.0).unwrap_or_default() * speed;
        self.tilt_for((wanted - ball.velocity) * GAIN_PER_S)
    }

    /// The end of the straight way that begins in a cell: its middle, and whether that is the goal.
    fn target(&self, cell: usize) -> (Vector2<f64>, bool) {
        let Some(first) = self.next(cell) else { return (self.goal, true) };
        let (from, mut end) = (self.reach.middle(cell), first);
        let is_straight = |to: usize| {
            let way = self.reach.middle(to) - from;
            way.x == 0.0 || way.y == 0.0
        };
        while let Some(next) = self.next(end) {
            if !is_straight(next) {
                return (self.reach.middle(end), false);
            }
            end = next;
        }
        (self.goal, true)
    }

    /// The neighbour from which the goal is nearest, `None` at the goal.
    fn next(&self, cell: usize) -> Option<usize> {
        let here = self.from_goal.to(cell);
        let nearer = self.reach.neighbours(cell).filter(|next| self.from_goal.to(*next) < here);
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

    /// The tilt that accelerates so, or as strongly as it may in that direction.
    fn tilt_for(&self, acceleration: Vector2<f64>) -> Tilt {
        let strength = acceleration.norm();
        if strength == 0.0 {
            return Tilt::LEVEL;
        }
        let sin = if strength < self.strongest { strength } else { self.strongest } / -WORLD_GRAVITY.z;
        let half_tangent = sin / (1.0 + (1.0 - sin * sin).sqrt());
        let direction = acceleration / strength;
        Tilt::from_half_tangents(direction.x * half_tangent, direction.y * half_tangent)
    }
}
