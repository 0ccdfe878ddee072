//! Named scenes of a ball that touches two features at once, or rolls over an edge.

use super::pieces::{R, ball, scene, spec, wall};
use super::{Family, Gravity, Scene, Walls};
use crate::engine::{Motion, Stretch};
use maze_core::{BallSpec, Bounds};
use nalgebra::Vector2;

/// The board's tilt that presses the ball onto a floor: 3.4 units/s².
const PRESSED: Gravity = Gravity::Constant { tilt_deg: [0.0, -20.0] };

/// The top of a block below y = 0, up to an edge at the origin.
fn ledge() -> Bounds {
    wall([-5.0, -3.0], [0.0, 0.0])
}

fn rolling() -> BallSpec {
    BallSpec { rolling: BallSpec::ROLLING_SPHERE, ..spec(BallSpec::RESTITUTION) }
}

/// Slits in a floor, half a unit apart.
const N_SLITS: i8 = 6;

/// All of them, family by family.
pub(super) fn scenes() -> Vec<Scene> {
    let groups = [wedges(), roll_overs(), steps(), slits(), free_ends(), narrows()];
    groups.into_iter().flatten().collect()
}

/// Where a ball lies on the floor y = 0 and touches the corner of a block `height` above it, R < `height` < 2 R.
fn under_corner(height: f64) -> Vector2<f64> {
    let above = height - R;
    Vector2::new(-((R - above) * (R + above)).sqrt(), R)
}

fn wedges() -> Vec<Scene> {
    // Closed behind the wedge: who gets through stays there.
    let (floor, end) = (wall([-9.0, -1.0], [6.0, 0.0]), wall([5.0, 0.0], [6.0, 2.0]));
    let into = Gravity::Constant { tilt_deg: [20.0, -24.0] };
    let wedge = |name: &str, about: String, height: f64, restitution: f64| Scene {
        walls: Walls::Rectangles(vec![floor, wall([0.0, height], [5.0, 2.0]), end]),
        ball: ball([-1.5, R], [1.0, 0.0]),
        spec: spec(restitution),
        gravity: into,
        duration_s: 8.0,
        rest: Some(under_corner(height)),
        ..scene(name, about, Family::Wedge)
    };
    let under = |name: &str, height: f64| {
        let about = format!("Into the wedge between a floor and a corner {height} above it.");
        wedge(name, about, height, BallSpec::RESTITUTION)
    };
    // From corner to corner, and from corner to wall: narrower than the ball.
    let (two_corners, corner_and_wall): (f64, f64) = (0.3, 0.4);
    let rise = |beside: f64| ((R - beside) * (R + beside)).sqrt();
    let beside_wall = corner_and_wall - R;
    let onto_wall = Gravity::Constant { tilt_deg: [7.0, -14.0] };
    vec![
        under("wedge-0.4", 0.4),
        Scene { duration_s: 12.0, ..under("wedge-0.3", 0.3) },
        under("wedge-0.499", 0.499),
        under("wedge-0.4999999", 0.499_999_9),
        Scene { spec: rolling(), ..under("wedge-rolling", 0.4) },
        wedge("wedge-plastic", "Into a wedge, with restitution 0.".to_owned(), 0.4, 0.0),
        Scene {
            walls: Walls::Rectangles(vec![
                wall([-5.0, -3.0], [-two_corners / 2.0, 0.0]),
                wall([two_corners / 2.0, -3.0], [5.0, 0.0]),
            ]),
            // Lower than the way out over a corner.
            ball: ball([0.01, 0.24], [0.0, 0.0]),
            gravity: PRESSED,
            duration_s: 5.0,
            rest: Some(Vector2::new(0.0, rise(two_corners / 2.0))),
            ..scene("wedge-two-corners", "Dropped between two corners of equal height.", Family::Wedge)
        },
        Scene {
            walls: Walls::Rectangles(vec![
                wall([-6.0, -3.0], [0.0, 0.0]),
                wall([corner_and_wall, -3.0], [2.0, 3.0]),
            ]),
            ball: ball([-0.5, 0.5], [0.0, 0.0]),
            gravity: onto_wall,
            duration_s: 10.0,
            rest: Some(Vector2::new(beside_wall, rise(beside_wall))),
            ..scene(
                "wedge-corner-wall",
                "Between a corner and a wall nearer than the ball is wide.",
                Family::Wedge,
            )
        },
        Scene {
            walls: Walls::Rectangles(vec![wall([-6.0, -3.0], [0.0, 0.0]), wall([R, -3.0], [2.0, 3.0])]),
            ball: ball([-0.9, R], [0.0, 0.0]),
            gravity: Gravity::Constant { tilt_deg: [10.0, -8.0] },
            duration_s: 10.0,
            rest: Some(Vector2::new(0.0, R)),
            ..scene("wedge-one-radius", "A floor that ends exactly one radius before a wall.", Family::Wedge)
        },
    ]
}

/// On the outside of one block.
fn around(family: Family, name: &str, about: &str, block: Bounds, gravity: Gravity) -> Scene {
    Scene {
        walls: Walls::Rectangles(vec![block]),
        gravity,
        truth: Some(Motion::Around { block }),
        ..scene(name, about, family)
    }
}

fn roll_overs() -> Vec<Scene> {
    let off =
        |name: &str, about: &str, gravity: Gravity| around(Family::RollOver, name, about, ledge(), gravity);
    let slowly = |name: &str, speed: f64| Scene {
        ball: ball([-speed, R], [speed, 0.0]),
        ..off(name, &format!("Off the edge of a block with {speed} units/s."), PRESSED)
    };
    // Pressed against the side behind the edge, so that the ball stays on the block all the way.
    let hugging = Gravity::Constant { tilt_deg: [-15.0, -15.0] };
    vec![
        slowly("roll-over-0.001", 0.001),
        slowly("roll-over-0.01", 0.01),
        slowly("roll-over-0.2", 0.2),
        slowly("roll-over-0.9", 0.9),
        slowly("roll-over-2", 2.0),
        Scene { spec: rolling(), ..slowly("roll-over-rolling", 0.2) },
        Scene {
            ball: ball([-0.1, R], [1.04, 0.0]),
            duration_s: 2.0,
            ..off("roll-over-side", "Over the edge and down the side of a block, pressed onto it.", hugging)
        },
        Scene {
            ball: ball([-0.1, R], [0.95, 0.0]),
            duration_s: 1.5,
            ..off("roll-over-back", "Onto the edge of a block, not over it, and back.", hugging)
        },
    ]
}

/// A floor of these stretches, and a ball at the start of it.
fn floor(
    family: Family,
    name: String,
    about: String,
    stretches: Vec<Stretch>,
    [x, speed]: [f64; 2],
) -> Scene {
    let walls = stretches.iter().map(|piece| wall([piece.start, -2.0], [piece.end, piece.height]));
    Scene {
        walls: Walls::Rectangles(walls.collect()),
        ball: ball([x, R], [speed, 0.0]),
        gravity: PRESSED,
        truth: Some(Motion::Floor { stretches }),
        ..scene(name, about, family)
    }
}

fn steps() -> Vec<Scene> {
    let step = |name: String, about: String, height: f64, speed: f64| {
        let stretches =
            vec![Stretch { start: -9.0, end: 0.0, height: 0.0 }, Stretch { start: 0.0, end: 9.0, height }];
        floor(Family::Step, name, about, stretches, [-speed, speed])
    };
    let down = |height: f64, speed: f64| {
        let about = format!("Down a step of {height:e} with {speed} units/s.");
        step(format!("step-down-{height:e}-{speed}"), about, -height, speed)
    };
    let up = |height: f64, speed: f64| {
        let about = format!("Up a step of {height:e} with {speed} units/s.");
        step(format!("step-up-{height:e}-{speed}"), about, height, speed)
    };
    let stairs: Vec<Stretch> = (0..12_i8)
        .map(f64::from)
        .map(|k| {
            let start = if k == 0.0 { -9.0 } else { k / 4.0 };
            Stretch { start, end: (k + 1.0) / 4.0, height: -k / 1000.0 }
        })
        .collect();
    vec![
        down(1.0e-12, 0.5),
        down(1.0e-9, 0.5),
        down(1.0e-6, 0.5),
        down(1.0e-3, 0.5),
        down(1.0e-3, 3.0),
        down(0.1, 0.5),
        up(1.0e-12, 1.0),
        up(1.0e-9, 1.0),
        up(1.0e-3, 1.0),
        up(0.05, 2.0),
        floor(
            Family::Step,
            "step-stairs".to_owned(),
            "Down eleven steps of a thousandth.".to_owned(),
            stairs,
            [0.0, 0.6],
        ),
    ]
}

fn slits() -> Vec<Scene> {
    let slit = |(width, speed): (f64, f64)| {
        let piece = |k: i8| {
            let start = f64::from(k) / 2.0;
            Stretch {
                start: if k == 0 { -9.0 } else { start + width },
                end: if k == N_SLITS { 20.0 } else { start + 0.5 },
                height: 0.0,
            }
        };
        let stretches = (0..=N_SLITS).map(piece).collect();
        let about = format!("Over {N_SLITS} slits of {width:e} with {speed} units/s.");
        floor(Family::Slit, format!("slit-{width:e}-{speed}"), about, stretches, [0.0, speed])
    };
    [(1.0e-12, 0.8), (1.0e-9, 0.8), (1.0e-6, 0.8), (1.0e-3, 0.8), (1.0e-3, 3.0), (0.01, 0.8)]
        .map(slit)
        .to_vec()
}

fn free_ends() -> Vec<Scene> {
    let thin = 1.0e-3;
    let upright = wall([0.0, -5.0], [thin, 0.0]);
    let level = wall([-5.0, -thin], [0.0, 0.0]);
    let steep = Gravity::Constant { tilt_deg: [20.0, -10.0] };
    let hugging = Gravity::Constant { tilt_deg: [-15.0, -15.0] };
    let end = |name: &str, about: &str, block: Bounds, gravity: Gravity| {
        around(Family::FreeEnd, name, about, block, gravity)
    };
    // Up the side of an upright wall.
    let climb = |name: &str, about: &str, speed: f64| Scene {
        ball: ball([-R, -0.3], [0.0, speed]),
        duration_s: 1.5,
        ..end(name, about, upright, steep)
    };
    vec![
        climb("free-end-over", "Up the side of a wall a thousandth thick and over its end.", 1.2),
        climb(
            "free-end-back",
            "Up the side of a wall a thousandth thick, onto its end, and back down.",
            1.05,
        ),
        Scene { spec: rolling(), ..climb("free-end-back-rolling", "The same by a rolling ball.", 0.9) },
        Scene {
            ball: ball([0.0005, R], [0.01, 0.0]),
            duration_s: 2.0,
            ..end("free-end-top", "From the top of a wall a thousandth thick.", upright, PRESSED)
        },
        Scene {
            ball: ball([-0.2, R], [0.2, 0.0]),
            duration_s: 2.0,
            ..end("free-end-off", "Off the end of a shelf a thousandth thick.", level, PRESSED)
        },
        Scene {
            ball: ball([-0.1, R], [1.04, 0.0]),
            duration_s: 2.0,
            ..end(
                "free-end-around",
                "Around the end of a shelf a thousandth thick, past both of its edges.",
                level,
                hugging,
            )
        },
    ]
}

fn narrows() -> Vec<Scene> {
    let width = 2.0 * R;
    let corridor = |name: &str, about: &str, height: f64| Scene {
        walls: Walls::Rectangles(vec![wall([0.0, -2.0], [9.0, 0.0]), wall([0.0, height], [9.0, 3.0])]),
        ball: ball([1.0, R], [2.0, 0.0]),
        truth: Some(Motion::Room { low: [None, Some(0.0)], high: [None, Some(height)] }),
        ..scene(name, about, Family::Narrow)
    };
    let along = Gravity::Constant { tilt_deg: [8.0, 0.0] };
    let askew = Gravity::Constant { tilt_deg: [8.0, -15.0] };
    let closed = |name: &str, speed: f64| {
        let gap = width - 1.0e-9;
        let beside = gap / 2.0;
        let about = format!("Into a corridor 1e-9 narrower than the ball, with {speed} units/s.");
        Scene {
            ball: ball([-1.0, beside], [speed, 0.0]),
            gravity: along,
            truth: None,
            rest: Some(Vector2::new(-((R - beside) * (R + beside)).sqrt(), beside)),
            duration_s: 6.0,
            ..corridor(name, &about, gap)
        }
    };
    vec![
        corridor("narrow-exact", "Down a corridor exactly as wide as the ball.", width),
        Scene {
            ball: ball([-1.0, R], [2.0, 0.0]),
            ..corridor("narrow-entry", "Into a corridor exactly as wide as the ball.", width)
        },
        Scene {
            ball: ball([1.0, R], [0.0, 0.0]),
            gravity: askew,
            duration_s: 2.0,
            ..corridor("narrow-askew", "The same corridor, the ball pressed onto one side and along.", width)
        },
        corridor("narrow-ulp", "Down a corridor wider than the ball by a rounding.", width.next_up()),
        Scene {
            ball: ball([1.0, R], [0.0, 0.0]),
            gravity: askew,
            duration_s: 2.0,
            ..corridor(
                "narrow-ulp-askew",
                "The same, the ball pressed onto one side and along.",
                width.next_up(),
            )
        },
        closed("narrow-closed-0", 0.0),
        closed("narrow-closed-1", 1.0),
        closed("narrow-closed-100", 100.0),
    ]
}
