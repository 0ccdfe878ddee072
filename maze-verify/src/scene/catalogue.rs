//! The named scenes.

use super::pieces::{R, TICKS_S, ball, scene, spec, wall};
use super::{Family, Gravity, Scene, Walls, contacts, levels};
use crate::engine::Motion;
use maze_core::layout::{Algorithm, Recipe};
use maze_core::{BallSpec, Bounds};
use nalgebra::Vector2;

/// Usual speed (units/s): some corridors a second, as in play.
const SPEED: f64 = 3.0;

/// Random tilts (s, degrees): at the rim of the largest maze, 8 units out, the board accelerates by at most
/// 8 · 6 · 20° / (2 s)² = 4 units/s², so that it does not throw a real ball over the walls.
const HOLD_S: f64 = 2.0;
const MAX_DEG: f64 = 10.0;

/// The largest level reaches three times as far out.
const LEVEL_MAX_DEG: f64 = MAX_DEG / 3.0;

/// How many random mazes.
const N_MAZES: u64 = 100;

/// A long wall below y = 0.
fn ground() -> Vec<Bounds> {
    vec![wall([-30.0, -1.0], [30.0, 0.0])]
}

const ABOVE_GROUND: Motion = Motion::Room { low: [None, Some(0.0)], high: [None; 2] };

/// Every named scene, in the order of the report.
///
/// # Errors
/// The game's levels, compiled in, that can't be read.
pub fn catalogue() -> Result<Vec<Scene>, String> {
    let groups =
        [tilts(), bounces(), drops(), corners(), slides(), speeds(), contacts::scenes(), mazes(), levels()?];
    Ok(groups.into_iter().flatten().collect())
}

fn tilts() -> Vec<Scene> {
    let free =
        |name: &str, about: &str| Scene { truth: Some(Motion::FREE), ..scene(name, about, Family::Tilt) };
    let rolling = BallSpec { rolling: BallSpec::ROLLING_SPHERE, ..spec(BallSpec::RESTITUTION) };
    let constant = Gravity::Constant { tilt_deg: [8.0, -5.0] };
    let sinusoidal = Gravity::Sinusoidal { amplitude_deg: [8.0, 6.0], frequency_hz: 0.5 };
    let room = vec![
        wall([-3.0, -3.0], [-2.0, 3.0]),
        wall([2.0, -3.0], [3.0, 3.0]),
        wall([-2.0, -3.0], [2.0, -2.0]),
        wall([-2.0, 2.0], [2.0, 3.0]),
    ];
    vec![
        Scene {
            ball: ball([0.0, 0.0], [2.0, 1.0]),
            ..free("tilt-flat", "A level board: straight on for ever.")
        },
        Scene {
            ball: ball([0.0, 0.0], [-1.0, 1.0]),
            gravity: constant,
            ..free("tilt-constant", "A board held at a tilt: a parabola.")
        },
        Scene {
            ball: ball([0.0, 0.0], [0.0, 0.0]),
            gravity: constant,
            spec: rolling,
            ..free("tilt-rolling", "A solid sphere rolls down a tilted board: 5/7 of the acceleration.")
        },
        Scene {
            ball: ball([0.0, 0.0], [0.0, 0.0]),
            gravity: sinusoidal,
            duration_s: 4.0,
            ..free("tilt-sinusoidal", "The board swings to and fro under a ball that touches nothing.")
        },
        Scene {
            walls: Walls::Rectangles(room),
            ball: ball([0.3, -0.4], [1.0, 2.0]),
            gravity: sinusoidal,
            duration_s: 6.0,
            truth: Some(Motion::Room { low: [Some(-2.0); 2], high: [Some(2.0); 2] }),
            ..scene(
                "tilt-sinusoidal-room",
                "The board swings; the ball bounces about a square room.",
                Family::Tilt,
            )
        },
    ]
}

fn bounces() -> Vec<Scene> {
    let mut scenes = vec![Scene {
        walls: Walls::Rectangles(vec![wall([5.0, -10.0], [6.0, 10.0])]),
        ball: ball([0.0, 0.0], [SPEED, 0.0]),
        truth: Some(Motion::Room { low: [None; 2], high: [Some(5.0), None] }),
        ..scene("head-on", "Straight at a wall.", Family::Bounce)
    }];
    for degrees in [30.0_f64, 45.0, 60.0, 80.0] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        scenes.push(Scene {
            walls: Walls::Rectangles(ground()),
            ball: ball([-2.0, 1.0 + R], [SPEED * sin, -SPEED * cos]),
            truth: Some(ABOVE_GROUND),
            ..scene(
                format!("oblique-{degrees}"),
                format!("At a wall, {degrees} degrees off its normal."),
                Family::Bounce,
            )
        });
    }
    let concave = vec![wall([5.0, -10.0], [6.0, 4.0]), wall([-10.0, 3.0], [5.0, 4.0])];
    let truth = Some(Motion::Room { low: [None; 2], high: [Some(5.0), Some(3.0)] });
    scenes.push(Scene {
        walls: Walls::Rectangles(concave.clone()),
        ball: ball([2.0, 0.5], [SPEED, 2.0]),
        truth: truth.clone(),
        ..scene("concave-corner", "Into a concave corner, one wall after the other.", Family::Bounce)
    });
    scenes.push(Scene {
        walls: Walls::Rectangles(concave),
        // Not a whole number of any ticks away, so that both touches fall into one.
        ball: ball([4.0 - R, 2.0 - R], [2.1, 2.1]),
        duration_s: 1.5,
        truth,
        ..scene("concave-both", "Into a concave corner, both walls at once.", Family::Bounce)
    });
    scenes.push(Scene {
        walls: Walls::Rectangles(vec![wall([-1.0, -9.0], [0.0, 9.0]), wall([1.0, -9.0], [2.0, 9.0])]),
        ball: ball([0.5, 0.0], [2.0, 0.3]),
        duration_s: 4.0,
        truth: Some(Motion::Room { low: [Some(0.0), None], high: [Some(1.0), None] }),
        ..scene("corridor-rattle", "To and fro between the walls of a corridor.", Family::Bounce)
    });
    scenes
}

fn drops() -> Vec<Scene> {
    let drop = |restitution: f64| Scene {
        walls: Walls::Rectangles(ground()),
        ball: ball([0.0, 1.0 + R], [0.0, 0.0]),
        spec: spec(restitution),
        gravity: Gravity::Constant { tilt_deg: [0.0, -30.0] },
        // The longest, 0.8, rests after sqrt(2 / 4.905) (1 + 0.8) / (1 - 0.8) = 5.7 s.
        duration_s: 7.0,
        truth: Some(ABOVE_GROUND),
        ..scene(
            format!("drop-{restitution}"),
            format!("Dropped onto a wall from 1 unit; restitution {restitution}."),
            Family::Drop,
        )
    };
    [0.0, 0.3, 0.5, 0.8, 1.0].into_iter().map(drop).collect()
}

/// A ball flies towards +x at a block whose upper left corner is the origin, its centre `beside` above it.
fn corner(name: String, about: String, beside: f64, truth: Motion) -> Scene {
    Scene {
        walls: Walls::Rectangles(vec![wall([0.0, -5.0], [5.0, 0.0])]),
        ball: ball([-2.0, beside], [SPEED, 0.0]),
        duration_s: 1.5,
        truth: Some(truth),
        ..scene(name, about, Family::Corner)
    }
}

fn corners() -> Vec<Scene> {
    let at_origin = Motion::Corner { point: Vector2::zeros() };
    let parameter = |k: u8| {
        let part = (f64::from(k) - 0.5) / 10.0;
        corner(
            format!("corner-{k:02}"),
            format!("At a convex corner, its centre {part:.2} radii beside it."),
            part * R,
            at_origin.clone(),
        )
    };
    let mut scenes: Vec<Scene> = (1..=10).map(parameter).collect();
    for (name, about, excess, truth) in [
        ("graze-in", "Grazes a corner by a thousandth of its radius.", -1.0e-3, at_origin.clone()),
        ("graze-just-in", "Grazes a corner by a millionth of its radius.", -1.0e-6, at_origin.clone()),
        ("graze-out", "Misses a corner by a millionth of its radius.", 1.0e-6, Motion::FREE),
    ] {
        let grazing = corner(name.to_owned(), about.to_owned(), R * (1.0 + excess), truth);
        scenes.push(Scene { family: Family::Graze, ..grazing });
    }
    scenes
}

fn slides() -> Vec<Scene> {
    let pressed = Gravity::Constant { tilt_deg: [0.0, -20.0] };
    let along = Gravity::Constant { tilt_deg: [10.0, -20.0] };
    // Quarter units, so that no seam lies where the ball lands.
    let seams: Vec<Bounds> =
        (-40..80_i8).map(f64::from).map(|k| wall([k / 4.0, -1.0], [(k + 1.0) / 4.0, 0.0])).collect();
    let on_ground = |name: &str, about: &str| Scene {
        walls: Walls::Rectangles(ground()),
        ball: ball([0.0, R], [0.0, 0.0]),
        duration_s: 2.0,
        truth: Some(ABOVE_GROUND),
        ..scene(name, about, Family::Slide)
    };
    let gap = 1.0e-3;
    vec![
        Scene { gravity: pressed, ..on_ground("rest", "Pressed onto a wall: it stays.") },
        Scene { gravity: along, ..on_ground("slide", "Pressed onto a wall and pulled along it.") },
        Scene {
            ball: ball([0.0, R], [SPEED, 0.0]),
            ..on_ground("graze-wall", "Along a wall, touching it, without acceleration.")
        },
        Scene {
            walls: Walls::Rectangles(seams.clone()),
            ball: ball([-2.0, R], [SPEED, 0.0]),
            gravity: pressed,
            duration_s: 3.0,
            family: Family::Seams,
            ..on_ground("seams-slide", "Slides over a wall made of 120 pieces: no bump.")
        },
        Scene {
            walls: Walls::Rectangles(seams),
            ball: ball([-2.0, 1.0 + R], [SPEED, -1.0]),
            gravity: pressed,
            duration_s: 3.0,
            family: Family::Seams,
            ..on_ground("seams-bounce", "Bounces along a wall made of 120 pieces.")
        },
        Scene {
            walls: Walls::Rectangles(vec![
                wall([-2.0, -1.0], [20.0, 0.0]),
                wall([-2.0, 2.0 * R + gap], [20.0, 2.0]),
            ]),
            ball: ball([0.0, R + gap / 2.0], [4.0, 0.05]),
            duration_s: 3.0,
            truth: Some(Motion::Room { low: [None, Some(0.0)], high: [None, Some(2.0 * R + gap)] }),
            ..scene("squeeze", "Down a corridor a thousandth wider than the ball.", Family::Slide)
        },
    ]
}

fn speeds() -> Vec<Scene> {
    // A closed hall, cut in two by a wall 0.02 thin: beyond it is only who went through.
    let hall = vec![
        wall([-11.0, -11.0], [-10.0, 11.0]),
        wall([10.0, -11.0], [11.0, 11.0]),
        wall([-10.0, -11.0], [10.0, -10.0]),
        wall([-10.0, 10.0], [10.0, 11.0]),
        wall([5.0, -10.0], [5.02, 10.0]),
    ];
    let fast = |(speed, duration_s): (f64, f64)| Scene {
        walls: Walls::Rectangles(hall.clone()),
        ball: ball([0.0, 0.3], [speed, speed / 50.0]),
        duration_s,
        truth: Some(Motion::Room { low: [Some(-10.0); 2], high: [Some(5.0), Some(10.0)] }),
        ..scene(format!("speed-{speed}"), format!("At a wall 0.02 thin with {speed} units/s."), Family::Speed)
    };
    [(1.0, 6.0), (3.0, 3.0), (10.0, 3.0), (30.0, 2.0), (100.0, 1.0), (300.0, 1.0), (1000.0, 0.6)]
        .into_iter()
        .map(fast)
        .collect()
}

fn mazes() -> Vec<Scene> {
    let maze = |seed: u64| {
        let rolls = seed.is_multiple_of(2);
        let sides = [6, 8, 10, 12];
        let [width, height] = [(seed % 4) as usize, (seed / 4 % 4) as usize].map(|index| sides[index]);
        let rolling = if rolls { BallSpec::ROLLING_SPHERE } else { BallSpec::POINT_MASS };
        Scene {
            walls: Walls::Generated(Recipe::new(width, height, Algorithm::Backtracker, seed)),
            spec: BallSpec { rolling, ..spec(BallSpec::RESTITUTION) },
            gravity: Gravity::Random { seed, hold_s: HOLD_S, max_deg: MAX_DEG },
            duration_s: 20.0,
            ticks_s: vec![TICKS_S[0], TICKS_S[3]],
            ..scene(
                format!("maze-{seed:03}"),
                format!(
                    "A random {width}x{height} maze under random tilts, {}.",
                    if rolls { "rolling" } else { "sliding" }
                ),
                Family::Maze,
            )
        }
    };
    (1..=N_MAZES).map(maze).collect()
}

fn levels() -> Result<Vec<Scene>, String> {
    let level = |name: String, title: &str, walls: Walls| Scene {
        walls,
        gravity: Gravity::Random { seed: 1, hold_s: HOLD_S, max_deg: LEVEL_MAX_DEG },
        duration_s: 20.0,
        ticks_s: vec![TICKS_S[0], TICKS_S[3]],
        ..scene(name, format!("The game's {title} under random tilts."), Family::Level)
    };
    let default = include_bytes!("../../../assets/mazes/default.obj").to_vec();
    let default = level("level-default".to_owned(), "default maze", Walls::Obj(default));
    let numbered = (1..).zip(levels::recipes()?).map(|(number, (title, recipe))| {
        level(format!("level-{number:02}"), &format!("level {number}, {title},"), Walls::Generated(recipe))
    });
    Ok(std::iter::once(default).chain(numbered).collect())
}
