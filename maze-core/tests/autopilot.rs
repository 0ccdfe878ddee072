//! The autopilot against many mazes, on both engines.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use maze_core::{
    AssembleOptions, Autopilot, Ball, BallKind, BallSpec, Continuous, Engine, Maze, Phase, Published, Run,
    extrude, gravity, layout,
};

/// The player's limit: the tangent of 10 degrees, half of 20.
const LIMIT: f64 = 0.176;

/// Longest run that is waited for: an hour of play.
const MOST_TICKS: u64 = 120_000;

/// Ticks to the goal; `None` when it is not reached.
fn play(maze: &Maze, engine: &mut dyn Engine) -> Option<u64> {
    let mut autopilot = Autopilot::new(maze, LIMIT).unwrap();
    let mut run = Run::new(maze);
    for _ in 0..MOST_TICKS {
        let from = engine.ball();
        let tilt = autopilot.tilt(from);
        let tick = engine.tick(gravity::project(gravity::WORLD_GRAVITY, &tilt.world_from_maze())).unwrap();
        run.observe(tilt, [from.position, engine.ball().position], &tick).count();
        if run.phase() == Phase::Finished {
            return Some(run.n_ticks());
        }
    }
    None
}

fn maze(width: usize, height: usize, seed: u64) -> Maze {
    maze_of(&layout::Recipe::new(width, height, layout::Algorithm::Backtracker, seed))
}

fn maze_of(recipe: &layout::Recipe) -> Maze {
    let mesh = extrude::extrude(&recipe.layout().unwrap());
    Maze::from_polygons(&mesh, &AssembleOptions::default()).unwrap()
}

#[test]
fn finishes_200_of_200_random_mazes_on_both_engines() {
    let mut slowest = 0;
    for seed in 1..=200 {
        let maze = maze(20, 20, seed);
        let (spec, ball) = (BallSpec::default(), Ball::at(maze.start()));
        let mut exact = Continuous::new(maze.planes.clone(), spec, ball, Published::TICK_S).unwrap();
        let mut published = Published::new(maze.planes.clone(), spec, ball, Published::TICK_S).unwrap();
        for (name, engine) in [("continuous", &mut exact as &mut dyn Engine), ("published", &mut published)] {
            let n_ticks = play(&maze, engine);
            assert!(n_ticks.is_some(), "seed {seed}, {name}: stuck at {:?}", engine.ball());
            slowest = slowest.max(n_ticks.unwrap());
        }
    }
    println!("slowest: {slowest} ticks");
}

#[test]
fn finishes_mazes_of_every_algorithm_with_and_without_loops() {
    for algorithm in layout::Algorithm::ALL {
        for (seed, braid) in [(1, 0.0), (2, 0.0), (3, 0.5), (4, 1.0)] {
            let maze = maze_of(&layout::Recipe { braid, ..layout::Recipe::new(14, 11, algorithm, seed) });
            let ball = Ball::at(maze.start());
            let mut engine = Continuous::new(maze.planes.clone(), BallSpec::default(), ball, 0.03).unwrap();
            assert!(play(&maze, &mut engine).is_some(), "{algorithm}, seed {seed}: {:?}", engine.ball());
        }
    }
}

#[test]
fn a_ball_that_starts_on_the_goal_is_done_at_once() {
    let layout = layout::recursive_backtracker(6, 6, 3).unwrap();
    let start = maze(6, 6, 3).start();
    let options = AssembleOptions { start: Some(start), goal: Some(start), ..Default::default() };
    let maze = layout.maze(&options).unwrap();
    let ball = Ball::at(maze.start());
    let mut engine = Continuous::new(maze.planes.clone(), BallSpec::default(), ball, 0.03).unwrap();
    assert_eq!(play(&maze, &mut engine), Some(1));
}

#[test]
fn the_same_maze_is_played_the_same_way() {
    let maze = maze(6, 6, 3);
    let play = || {
        let ball = Ball::at(maze.start());
        let mut engine = Continuous::new(maze.planes.clone(), BallSpec::default(), ball, 0.03).unwrap();
        (play(&maze, &mut engine), engine.ball())
    };
    assert_eq!(play(), play());
}

#[test]
fn the_steel_ball_gets_to_the_goal_of_200_mazes() {
    for seed in 0..200_usize {
        let algorithm = layout::Algorithm::ALL[seed % layout::Algorithm::ALL.len()];
        let recipe = layout::Recipe::new(2 + seed % 11, 2 + seed % 7, algorithm, seed as u64);
        let mut maze = maze_of(&layout::Recipe { braid: (seed % 3) as f64 / 2.0, ..recipe });
        maze.ball = BallKind::Steel;
        let mut engine = maze.exact_engine(Published::TICK_S).unwrap();
        assert!(play(&maze, &mut engine).is_some(), "seed {seed}, {algorithm}: stuck at {:?}", engine.ball());
    }
}
