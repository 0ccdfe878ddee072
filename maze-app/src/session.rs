//! One maze being played: engine, rules, tilt, and what a frame shows of them.

use crate::engine_kind::EngineKind;
use crate::failure::Failure;
use crate::input::TiltControl;
use crate::numbers::to_f32;
use maze_core::replay::{self, Constants, Recording};
use maze_core::{Ball, Engine, Event, Hit, Maze, Phase, Run, Tick, Tilt, gravity};
use maze_render::{BallView, Camera, GhostView, Marker, Scene};
use nalgebra::{UnitQuaternion, Vector2, Vector3};

/// How strongly the goal shines before and after it is reached.
const GOAL_GLOW: [f32; 2] = [0.35, 1.0];

/// Fraction of its distance to the middle of the goal that the ball covers in a tick once it has got there.
const SETTLE_FRACTION: f64 = 0.2;

/// Owns what a run is made of; knows no window, file or clock.
pub(crate) struct Session {
    maze: Maze,
    kind: EngineKind,
    engine: Box<dyn Engine>,
    /// Another engine, whose ball gets the same tilts.
    ghost: Option<(EngineKind, Box<dyn Engine>)>,
    run: Run,
    last_tick: Tick,
    last_hit: Option<Hit>,
    tilt: Tilt,
    /// One for each tick of the engine since the start, and where the last of them left the ball.
    tilts: Vec<Tilt>,
    played_to: Ball,
    previous: Pose,
    current: Pose,
}

/// What moves, at one moment.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pose {
    position: Vector2<f64>,
    ghost: Option<Vector2<f64>>,
    /// Maze from ball: how the pattern has rolled.
    rotation: UnitQuaternion<f64>,
    world_from_maze: UnitQuaternion<f64>,
}

impl Pose {
    /// Where the ball touches the floor, in the world.
    pub(crate) fn ball_in_world(&self) -> Vector3<f64> {
        self.world_from_maze * self.position.push(0.0)
    }

    /// Of the ball, maze frame.
    pub(crate) fn position(&self) -> Vector2<f64> {
        self.position
    }

    fn at_start(maze: &Maze) -> Self {
        let level = UnitQuaternion::identity();
        Self { position: maze.start(), ghost: None, rotation: level, world_from_maze: level }
    }
}

impl Session {
    pub(crate) fn new(maze: Maze, kind: EngineKind) -> Result<Self, Failure> {
        let engine = kind.build(&maze, Ball::at(maze.start()))?;
        let start = Pose::at_start(&maze);
        Ok(Self {
            kind,
            engine,
            ghost: None,
            run: Run::new(&maze),
            last_tick: Tick::default(),
            last_hit: None,
            tilt: Tilt::LEVEL,
            tilts: Vec::new(),
            played_to: Ball::at(maze.start()),
            previous: start,
            current: start,
            maze,
        })
    }

    /// The engine of the ghost.
    pub(crate) fn ghost_kind(&self) -> Option<EngineKind> {
        self.ghost.as_ref().map(|(kind, _)| *kind)
    }

    /// From now on another engine's ball, which starts as the ball is now, gets the same tilts.
    pub(crate) fn set_ghost(&mut self, kind: Option<EngineKind>) -> Result<(), Failure> {
        let built = kind.map(|kind| Ok((kind, kind.build(&self.maze, self.engine.ball())?)));
        self.ghost = built.transpose()?;
        let shows = self.ghost.is_some();
        for pose in [&mut self.previous, &mut self.current] {
            pose.ghost = shows.then_some(pose.position);
        }
        Ok(())
    }

    /// The next of the other engines as the ghost, and after the last none.
    pub(crate) fn next_ghost(&mut self) -> Result<(), Failure> {
        let mut others = EngineKind::BUILT.iter().copied().filter(|kind| *kind != self.kind);
        let next = match &self.ghost {
            None => others.next(),
            Some((shown, _)) => others.skip_while(|kind| kind != shown).nth(1),
        };
        self.set_ghost(next)
    }

    /// The ghost's engine, and how far its ball is from the ball (corridors).
    pub(crate) fn ghost(&self) -> Option<(&'static str, f64)> {
        let (kind, engine) = self.ghost.as_ref()?;
        Some((kind.name(), (engine.ball().position - self.ball().position).norm()))
    }

    pub(crate) fn maze(&self) -> &Maze {
        &self.maze
    }

    /// What the engine reported about the last tick.
    pub(crate) fn last_tick(&self) -> &Tick {
        &self.last_tick
    }

    /// The last hit since the start, in this tick or an earlier one.
    pub(crate) fn last_hit(&self) -> Option<&Hit> {
        self.last_hit.as_ref()
    }

    pub(crate) fn phase(&self) -> Phase {
        self.run.phase()
    }

    pub(crate) fn n_ticks(&self) -> u64 {
        self.run.n_ticks()
    }

    /// How many ticks the engine has made since the start.
    pub(crate) fn n_played(&self) -> usize {
        self.tilts.len()
    }

    /// What was played since the start, up to the goal; `words` give the maze again on the command line.
    pub(crate) fn recording(&self, words: String) -> Result<Recording, Failure> {
        if replay::MAX_TICKS < self.tilts.len() {
            return Err(Failure::not_held(format!(
                "the run is too long for a recording: {} ticks, at most {} fit",
                self.tilts.len(),
                replay::MAX_TICKS
            )));
        }
        Ok(Recording {
            source: words,
            maze_hash: replay::maze_hash(&self.maze),
            engine: self.kind.name().to_owned(),
            constants: Constants::of(self.engine.as_ref()),
            tilts: self.tilts.clone(),
            final_hash: replay::state_hash(self.played_to),
        })
    }

    /// Adds to a recording of this game what was played since; one of an earlier start is replaced.
    pub(crate) fn continue_recording(&self, recording: &mut Recording) {
        if self.tilts.len() < recording.tilts.len() {
            recording.tilts.clear();
        }
        let n_known = recording.tilts.len();
        let n_fitting = self.tilts.len().min(replay::MAX_TICKS);
        recording.tilts.extend(self.tilts.get(n_known..n_fitting).unwrap_or_default());
        if n_fitting == self.tilts.len() {
            recording.final_hash = replay::state_hash(self.played_to);
        }
    }

    pub(crate) fn tick_s(&self) -> f64 {
        self.engine.tick_s()
    }

    pub(crate) fn ball(&self) -> Ball {
        self.engine.ball()
    }

    pub(crate) fn tilt(&self) -> Tilt {
        self.tilt
    }

    /// Ball to the start, board level, clock to zero.
    pub(crate) fn restart(&mut self) -> Result<(), Failure> {
        self.engine.place(Ball::at(self.maze.start())).map_err(Failure::bad_input)?;
        self.run = Run::new(&self.maze);
        self.tilt = Tilt::LEVEL;
        self.tilts.clear();
        self.last_hit = None;
        self.played_to = self.engine.ball();
        self.current = Pose::at_start(&self.maze);
        self.previous = self.current;
        self.set_ghost(self.ghost_kind())
    }

    /// Turns the board without simulating: for a picture of the start.
    pub(crate) fn show_tilt(&mut self, tilt: Tilt) {
        self.tilt = tilt;
        self.current.world_from_maze = tilt.world_from_maze();
        self.previous.world_from_maze = self.current.world_from_maze;
    }

    /// One tick under a tilt. Once the goal is reached the ball settles there and only the board moves.
    pub(crate) fn tick(&mut self, tilt: Tilt) -> Result<Vec<Event>, Failure> {
        self.tilt = tilt;
        let world_from_maze = tilt.world_from_maze();
        self.previous = self.current;
        self.current.world_from_maze = world_from_maze;
        if self.run.phase() == Phase::Finished {
            return self.settle().map(|()| Vec::new());
        }
        let acceleration = gravity::project(gravity::WORLD_GRAVITY, &world_from_maze);
        let last_hit = &mut self.last_hit;
        let mut observer = |hit: &Hit| *last_hit = Some(*hit);
        let tick = self.engine.tick_observed(acceleration, &mut observer).map_err(Failure::bad_input)?;
        if let Some((_, ghost)) = &mut self.ghost {
            ghost.tick(acceleration).map_err(Failure::bad_input)?;
            self.current.ghost = Some(ghost.ball().position);
        }
        self.tilts.push(tilt);
        self.played_to = self.engine.ball();
        let position = self.played_to.position;
        self.roll_to(position);
        self.last_tick = tick;
        Ok(self.run.observe(tilt, [self.previous.position, position], &tick).collect())
    }

    /// The ball comes to rest in the middle of the goal.
    fn settle(&mut self) -> Result<(), Failure> {
        let step = (self.maze.goal() - self.previous.position) * SETTLE_FRACTION;
        self.roll_to(self.previous.position + step);
        self.engine.place(Ball::at(self.current.position)).map_err(Failure::bad_input)
    }

    /// Shows the ball there, its pattern turned by the distance from where it was a tick ago.
    fn roll_to(&mut self, position: Vector2<f64>) {
        let step = position - self.previous.position;
        self.current.position = position;
        self.current.rotation = rolled(step, self.maze.ball_radius.units()) * self.previous.rotation;
    }

    /// Between the last two ticks, `alpha` of the step. A board in the player's hand is shown where the hand is.
    pub(crate) fn pose(&self, alpha: f64, held: Option<&TiltControl>) -> Pose {
        let (a, b) = (&self.previous, &self.current);
        Pose {
            position: a.position.lerp(&b.position, alpha),
            ghost: a.ghost.zip(b.ghost).map(|(a, b)| a.lerp(&b, alpha)),
            rotation: a.rotation.nlerp(&b.rotation, alpha),
            world_from_maze: match held {
                Some(control) => control.tilt().world_from_maze(),
                None => a.world_from_maze.nlerp(&b.world_from_maze, alpha),
            },
        }
    }

    /// A frame, as plain data.
    pub(crate) fn scene(&self, pose: &Pose, camera: Camera) -> Scene {
        let radius = self.maze.ball_radius.units();
        let marker = |position: Vector2<f64>| Marker {
            position: position.map(to_f32).into(),
            radius: to_f32(self.maze.goal_radius()),
        };
        Scene {
            camera,
            world_from_maze: pose.world_from_maze.cast(),
            ball: BallView {
                position: pose.position.push(radius).map(to_f32).into(),
                radius: to_f32(radius),
                rotation: pose.rotation.cast(),
            },
            ghost: pose.ghost.map(|position| GhostView {
                position: position.push(radius).map(to_f32).into(),
                radius: to_f32(radius),
            }),
            start: marker(self.maze.start()),
            goal: marker(self.maze.goal()),
            goal_glow: GOAL_GLOW[usize::from(self.phase() == Phase::Finished)],
            lines: Vec::new(),
            patches: Vec::new(),
            shows_maze: true,
        }
    }

    /// Half width, half depth and wall height: what the camera has to show.
    pub(crate) fn half_size(&self) -> [f32; 3] {
        let size = self.maze.bounds.size();
        [size.x / 2.0, size.y / 2.0, self.maze.wall_height].map(to_f32)
    }
}

/// The turn of a ball that rolls along `step` without slipping.
fn rolled(step: Vector2<f64>, radius: f64) -> UnitQuaternion<f64> {
    // About the horizontal axis on the left of the step: normal x step.
    UnitQuaternion::from_scaled_axis(Vector3::new(-step.y, step.x, 0.0) / radius)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clock::Clock;
    use maze_core::{AssembleOptions, Published, extrude, layout};

    /// rapier keeps positions, here below 8 units, in f32.
    const F32_ROUNDING: f64 = 1.0e-6;

    fn game() -> Session {
        game_with(EngineKind::Continuous)
    }

    fn game_with(engine: EngineKind) -> Session {
        let mesh = extrude::extrude(&layout::recursive_backtracker(6, 5, 11).unwrap());
        Session::new(Maze::from_polygons(&mesh, &AssembleOptions::default()).unwrap(), engine).unwrap()
    }

    /// Tilts that change with the tick, as a player's would.
    fn tilt_at(tick: u32) -> Tilt {
        let wave = |period: u32| f64::from(tick % period) / f64::from(period) - 0.5;
        Tilt::from_half_tangents(0.3 * wave(97), 0.3 * wave(61))
    }

    #[test]
    fn motion_is_equal_at_30_60_and_240_frames_a_second() {
        let after_300_ticks = |frames_per_s: u32| {
            let (mut game, mut clock, mut n_ticks) = (game(), Clock::new(Published::TICK_S), 0);
            while n_ticks < 300 {
                for _ in 0..clock.advance(1.0 / f64::from(frames_per_s)) {
                    if n_ticks < 300 {
                        game.tick(tilt_at(n_ticks)).unwrap();
                        n_ticks += 1;
                    }
                }
            }
            game.ball()
        };
        let at_60 = after_300_ticks(60);
        assert_ne!(at_60.position, game().maze().start());
        assert_eq!(after_300_ticks(30), at_60);
        assert_eq!(after_300_ticks(240), at_60);
    }

    #[test]
    fn drawing_moves_evenly_from_one_tick_to_the_next() {
        let mut game = game();
        for tick in 0..50 {
            game.tick(tilt_at(tick)).unwrap();
        }
        let camera = Camera { target: [0.0; 3], distance: 10.0, pitch_rad: maze_render::PITCH_RAD };
        let x_at = |alpha| game.scene(&game.pose(alpha, None), camera).ball.position[0];
        assert!((x_at(0.5) - (x_at(0.0) + x_at(1.0)) / 2.0).abs() < 1.0e-6);
        assert_eq!(x_at(1.0), to_f32(game.ball().position.x));
    }

    #[test]
    fn a_ball_rolls_once_around_over_its_circumference() {
        let radius = 0.35;
        let quarter = rolled(Vector2::new(std::f64::consts::FRAC_PI_2 * radius, 0.0), radius);
        // Rolling towards +x brings the top of the ball to the front.
        assert!((quarter * Vector3::z() - Vector3::x()).norm() < 1.0e-12);
    }

    #[test]
    fn both_engines_play_and_differ_only_a_little_before_the_first_wall() {
        let [exact, published] = [EngineKind::Continuous, EngineKind::Published].map(|kind| {
            let mut game = game_with(kind);
            for _ in 0..5 {
                game.tick(Tilt::from_half_tangents(0.02, -0.02)).unwrap();
            }
            game.ball().position
        });
        let moved = (exact - game().maze().start()).norm();
        let apart = (exact - published).norm();
        // Explicit Euler is ahead by half a tick's gain in speed each tick.
        assert!(0.0 < apart && apart < moved, "{apart} of {moved}");
    }

    #[test]
    fn a_ghost_of_the_same_engine_stays_with_the_ball() {
        for kind in [EngineKind::Continuous, EngineKind::Published] {
            let mut game = game_with(kind);
            for tick in 0..400 {
                if tick == 100 {
                    // In the middle of the run.
                    game.set_ghost(Some(kind)).unwrap();
                }
                game.tick(tilt_at(tick)).unwrap();
                assert_eq!(game.ghost(), (100 <= tick).then(|| (kind.name(), 0.0)));
            }
        }
    }

    #[test]
    fn ghosts_of_all_other_engines_follow_and_never_disturb_the_ball() {
        for kind in EngineKind::BUILT {
            let (mut game, mut alone) = (game_with(*kind), game_with(*kind));
            let mut seen = vec![];
            loop {
                game.next_ghost().unwrap();
                let Some((name, distance)) = game.ghost() else { break };
                assert!(distance < F32_ROUNDING, "{name}: {distance}");
                seen.push(name);
                for tick in 0..200 {
                    game.tick(tilt_at(tick)).unwrap();
                    alone.tick(tilt_at(tick)).unwrap();
                    assert_eq!(game.ball(), alone.ball());
                }
                let apart = game.ghost().unwrap().1;
                // The board's diagonal is below 10 corridors: further away it would have gone through a wall.
                assert!(0.0 < apart && apart < 10.0, "{name} beside {}: {apart}", kind.name());
                let camera = Camera { target: [0.0; 3], distance: 10.0, pitch_rad: maze_render::PITCH_RAD };
                let [then, now] = [0.0, 1.0].map(|alpha| game.scene(&game.pose(alpha, None), camera));
                assert_ne!(then.ghost, now.ghost);
                assert_ne!(now.ghost.unwrap().position, now.ball.position);
                game.restart().unwrap();
                alone.restart().unwrap();
                assert!(game.ghost().unwrap().1 < F32_ROUNDING);
            }
            let others = EngineKind::BUILT.iter().filter(|other| *other != kind);
            assert_eq!(seen, others.map(|other| other.name()).collect::<Vec<_>>());
            assert_eq!(
                game.scene(
                    &game.pose(1.0, None),
                    Camera { target: [0.0; 3], distance: 1.0, pitch_rad: maze_render::PITCH_RAD }
                )
                .ghost,
                None
            );
        }
    }

    #[cfg(not(feature = "rapier"))]
    #[test]
    fn without_rapier_it_is_refused() {
        let failure = game().set_ghost(Some(EngineKind::Rapier)).unwrap_err();
        assert!(failure.to_string().contains("built without rapier"));
    }

    #[test]
    fn restart_puts_the_ball_back() {
        let mut game = game();
        for tick in 0..50 {
            game.tick(tilt_at(tick)).unwrap();
        }
        assert_ne!(game.ball().position, game.maze().start());
        game.restart().unwrap();
        assert_eq!(game.ball(), Ball::at(game.maze().start()));
        assert_eq!((game.phase(), game.n_ticks()), (Phase::Ready, 0));
    }
}
