//! F2 to F6, F13, F15, F16, F18: random mazes as other programs export them, beside the plain maze.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test that cannot go on has failed")]
#![allow(clippy::disallowed_methods, reason = "test files are made with sines and cosines")]

use maze_core::layout::{Algorithm, Recipe};
use maze_core::{
    AssembleOptions, Autopilot, Blocks, Continuous, Engine, FaceReason, Maze, Phase, Radius, Run, import,
};
use proptest::prelude::*;

type Point = [f64; 3];
type Polygon = Vec<Point>;

/// Thickness and height of walls; corridors are 1 wide.
const THICK: f64 = 0.2;
const HIGH: f64 = 0.8;

/// A box without its bottom, counter-clockwise seen from outside.
fn block([x0, y0, x1, y1]: [f64; 4], [z0, z1]: [f64; 2]) -> Vec<Polygon> {
    let outline = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]];
    let side = |k: usize| {
        let [[ax, ay], [bx, by]] = [outline[k], outline[(k + 1) % 4]];
        vec![[ax, ay, z0], [bx, by, z0], [bx, by, z1], [ax, ay, z1]]
    };
    let top = outline.iter().map(|[x, y]| [*x, *y, z1]).collect();
    (0..4).map(side).chain([top]).collect()
}

fn line(k: usize) -> f64 {
    k.div_ceil(2) as f64 * THICK + (k / 2) as f64
}

/// A maze of a layout: a box for each piece of wall, and its size.
fn boxes(seed: u64, braid: f64) -> (Vec<Polygon>, [f64; 2]) {
    let layout = Recipe { braid, ..Recipe::new(6, 5, Algorithm::Wilson, seed) }.layout().unwrap();
    let blocks = Blocks::of_layout(&layout);
    let all = (0..blocks.height()).flat_map(|y| (0..blocks.width()).map(move |x| (x, y)));
    let walls = all.filter(|(x, y)| blocks.is_wall(*x, *y));
    let walls = walls.flat_map(|(x, y)| block([line(x), line(y), line(x + 1), line(y + 1)], [0.0, HIGH]));
    (walls.collect(), [line(blocks.width()), line(blocks.height())])
}

/// The same maze as one shape: no face lies between two walls.
fn outline(seed: u64) -> Vec<Polygon> {
    let layout = Recipe::new(6, 5, Algorithm::Wilson, seed).layout().unwrap();
    let mesh = maze_core::extrude::extrude(&layout);
    let corner = |corner: &u32| mesh.positions()[*corner as usize].into();
    mesh.faces().map(|face| face.iter().map(corner).collect()).collect()
}

fn floor([width, height]: [f64; 2]) -> Polygon {
    vec![[0.0, 0.0, 0.0], [width, 0.0, 0.0], [width, height, 0.0], [0.0, height, 0.0]]
}

fn text(faces: &[Polygon]) -> String {
    let (mut text, mut n_vertices) = (String::new(), 0);
    for face in faces {
        text.extend(face.iter().map(|[x, y, z]| format!("v {x:.6} {y:.6} {z:.6}\n")));
        let corners: Vec<String> = (1..=face.len()).map(|corner| (n_vertices + corner).to_string()).collect();
        text += &format!("f {}\n", corners.join(" "));
        n_vertices += face.len();
    }
    text
}

fn maze_with(faces: &[Polygon], options: &AssembleOptions) -> Maze {
    let mesh = import::obj::read(text(faces).as_bytes()).unwrap();
    Maze::from_polygons(&mesh, options).unwrap_or_else(|error| panic!("{error}"))
}

fn maze(faces: &[Polygon]) -> Maze {
    maze_with(faces, &AssembleOptions::default())
}

fn reversed(face: &Polygon) -> Polygon {
    face.iter().rev().copied().collect()
}

/// The same walls to the rounding of the file, the same start and goal.
fn is_same(one: &Maze, other: &Maze) -> bool {
    let near = |a: f64, b: f64| (a - b).abs() < 1.0e-4;
    let [a, b] = [one, other].map(|maze| {
        let planes = maze_core::Facing::ALL.into_iter().flat_map(|facing| maze.planes.planes(facing));
        planes.collect::<Vec<_>>()
    });
    a.len() == b.len()
        && a.iter().zip(&b).all(|(a, b)| {
            a.facing == b.facing && near(a.offset, b.offset) && near(a.start, b.start) && near(a.end, b.end)
        })
        && one.report.thickened_to == other.report.thickened_to
}

/// The autopilot's ticks to the goal; `None` when it does not get there in an hour of play.
fn ticks_to_goal(maze: &Maze) -> Option<u64> {
    let spec = maze_core::BallSpec { radius: maze.ball_radius, ..maze_core::BallSpec::default() };
    let ball = maze_core::Ball::at(maze.start());
    let mut engine = Continuous::new(maze.planes.clone(), spec, ball, 0.03).unwrap();
    let mut autopilot = Autopilot::new(maze, 0.17).ok()?;
    let mut run = Run::new(maze);
    for _ in 0..120_000 {
        let from = engine.ball();
        let tilt = autopilot.tilt(from);
        let acceleration =
            maze_core::gravity::project(maze_core::gravity::WORLD_GRAVITY, &tilt.world_from_maze());
        let tick = engine.tick(acceleration).unwrap();
        run.observe(tilt, [from.position, engine.ball().position], &tick).count();
        if run.phase() == Phase::Finished {
            return Some(run.n_ticks());
        }
    }
    None
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, ..ProptestConfig::default() })]

    #[test]
    fn f2_faces_with_their_backs_are_one_sided(seed in 0..500_u64, which in 0..4_usize, hair in prop_oneof![Just(0.0), Just(2.0e-6)]) {
        // Boxes side by side hide faces that are each other's backs: there some backs alone are not to be told apart.
        let faces = if which < 2 { boxes(seed, 0.0).0 } else { outline(seed) };
        let plain = maze(&faces);
        let back = |index: usize, face: &Polygon| {
            let has_back = match which {
                0 | 1 => true,
                2 => !index.is_multiple_of(3),
                _ => index.is_multiple_of(7),
            };
            let moved = reversed(face).into_iter().map(|[x, y, z]| [x + hair, y + hair, z]).collect();
            has_back.then_some(moved)
        };
        let two_sided: Vec<Polygon> = match which {
            // Each behind its front, or all backs at the end.
            0 => faces.iter().enumerate().flat_map(|(i, face)| [Some(face.clone()), back(i, face)]).flatten().collect(),
            _ => faces.iter().cloned().chain(faces.iter().enumerate().filter_map(|(i, face)| back(i, face))).collect(),
        };
        prop_assert!(is_same(&plain, &maze(&two_sided)), "{which} {hair}");
    }

    #[test]
    fn f3_low_blocks_and_pillars_are_no_floor(seed in 0..500_u64, top in 0.3..0.79_f64, sunk in 0.0..0.2_f64) {
        let (mut faces, _) = boxes(seed, 0.0);
        let plain = maze(&faces);
        prop_assert!(!plain.report.has_floor);
        // In the corner of the first cell, beside the wall: it makes a wall wider and blocks nothing.
        faces.extend(block([0.1, 0.1, 0.3, 0.3], [-sunk, top]));
        let with = maze(&faces);
        prop_assert!(!with.report.has_floor && with.is_solvable());
        // Two of its sides stand out of the outer wall's corner.
        prop_assert_eq!(with.planes.len(), plain.planes.len() + 2);
    }

    #[test]
    fn f4_a_sheet_across_a_corridor_is_met(seed in 0..500_u64, looks in any::<bool>(), sides in 1..3_usize) {
        let (mut faces, size) = boxes(seed, 1.0);
        faces.push(floor(size));
        let plain = maze(&faces);
        // Across the first cell's upper side, if that is open; from wall to wall.
        let y = THICK + 0.97;
        let sheet = vec![[0.15, y, 0.0], [THICK + 1.05, y, 0.0], [THICK + 1.05, y, HIGH], [0.15, y, HIGH]];
        let sheet = if looks { reversed(&sheet) } else { sheet };
        faces.extend([sheet.clone(), reversed(&sheet)].into_iter().take(sides));
        let with = maze(&faces);
        let half = [size[0] / 2.0, size[1] / 2.0];
        // The ball that goes straight up from the first cell's middle meets the sheet.
        let spec = maze_core::BallSpec::default();
        let start = nalgebra::Vector2::new(THICK + 0.5 - half[0], THICK + 0.4 - half[1]) * with.report.scale;
        let mut engine = Continuous::new(with.planes.clone(), spec, maze_core::Ball::at(start), 0.03).unwrap();
        for _ in 0..100 {
            engine.tick(nalgebra::Vector2::new(0.0, 3.0)).unwrap();
        }
        let reached = engine.ball().position.y / with.report.scale + half[1];
        prop_assert!(reached < y - 0.3, "{reached} {y} {}", plain.planes.len());
    }

    #[test]
    fn f6_the_largest_ball_that_passes_a_gate_is_found_and_played(seed in 0..500_u64, gate in 0.12..0.69_f64) {
        // Two rooms with a gate between them, openings at both ends; corridors of 1 around.
        let wall = |rect: [f64; 4]| block(rect, [0.0, HIGH]);
        let mut faces = Vec::new();
        let place = 0.05 + (seed % 7) as f64 / 7.0 * (0.9 - gate);
        for rect in [
            [0.0, 0.0, 9.0, 0.2],
            [0.0, 1.2, 9.0, 1.4],
            [0.0, 2.4, 9.0, 2.6],
            // The middle wall opens at the right, the gate is in the upper corridor.
            [4.0, 1.4, 4.2, 1.4 + place],
            [4.0, 1.4 + place + gate, 4.2, 2.4],
            [9.0, 0.0, 9.2, 2.6],
        ] {
            faces.extend(wall(rect));
        }
        // Cut the middle wall short at the right.
        faces.drain(5..10);
        faces.extend(wall([0.0, 1.2, 8.0, 1.4]));
        faces.push(floor([9.2, 2.6]));
        let found = maze(&faces);
        prop_assert_eq!(found.openings.len(), 2);
        let expected = (gate * found.report.scale * 50.0 - 0.5).floor() / 100.0;
        prop_assert!(found.is_solvable(), "gate {gate}");
        let radius = found.ball_radius.units();
        prop_assert!((radius - expected).abs() < 0.0051 && 2.0 * radius <= gate * found.report.scale + 1.0e-9, "{radius} {expected}");
        prop_assert_eq!(found.report.passing_radius, Some(found.ball_radius));
        if 0.08 < radius {
            prop_assert!(ticks_to_goal(&found).is_some(), "radius {radius}");
        }
        // Asked for, the usual ball is kept, and which one passes is told.
        let usual = AssembleOptions { ball_radius: Radius::new(0.35).ok(), ..Default::default() };
        let kept = maze_with(&faces, &usual);
        prop_assert_eq!((kept.is_solvable(), kept.ball_radius.units()), (false, 0.35));
        prop_assert_eq!(kept.report.passing_radius, Some(found.ball_radius));
    }

    #[test]
    fn f13_f15_walls_of_any_height_that_stop_a_ball_are_met(seed in 0..500_u64, part in 0.12..1.0_f64) {
        let (mut faces, size) = boxes(seed, 0.0);
        faces.push(floor(size));
        let plain = maze(&faces);
        // A stub from the outer wall into the first cell.
        faces.extend(block([0.1, 0.5, 0.5, 0.6], [0.0, part * HIGH]));
        let with = maze(&faces);
        prop_assert_eq!(with.planes.len(), plain.planes.len() + 3 + 1, "{}", part);
        prop_assert!(with.report.ignored.iter().all(|note| !note.is_unmet));
    }
}

#[test]
fn f13_walls_that_a_ball_climbs_are_told() {
    let (mut faces, size) = boxes(3, 0.0);
    faces.push(floor(size));
    let plain = maze(&faces);
    faces.extend(block([0.1, 0.5, 0.5, 0.6], [0.0, 0.05]));
    let with = maze(&faces);
    assert_eq!(with.planes, plain.planes);
    let unmet: Vec<_> = with.report.ignored.iter().filter(|note| note.is_unmet).collect();
    assert_eq!((unmet.len(), unmet[0].n_faces), (1, 4));
    assert!(unmet[0].reason == FaceReason::RolledOver, "{}", unmet[0].reason);
}

#[test]
fn f13_two_mazes_of_two_heights_on_one_floor_are_both_met() {
    let at = |seed: u64, dx: f64, height: f64| {
        let moved = move |point: Point| [point[0] + dx, point[1], point[2] * height / HIGH];
        boxes(seed, 0.0).0.into_iter().map(move |face| face.into_iter().map(moved).collect::<Polygon>())
    };
    let size = boxes(1, 0.0).1;
    let both: Vec<Polygon> = at(1, 0.0, 0.3)
        .chain(at(2, size[0] + 2.0, 1.0))
        .chain([floor([2.0 * size[0] + 2.0, size[1]])])
        .collect();
    let [one, other] = [1, 2].map(|seed| maze(&boxes(seed, 0.0).0).planes.len());
    // Between them is a hall: four more faces, the outer sides of both and the frame.
    assert_eq!(maze(&both).planes.len(), one + other + 4);
}

#[test]
fn f5_an_opening_into_a_pocket_is_neither_start_nor_goal() {
    let (mut faces, size) = boxes(5, 0.0);
    faces.push(floor(size));
    let plain = maze(&faces);
    // A second outer wall with a gap, so that behind the gap there is a room of a corridor's width and no maze.
    let [w, h] = size;
    for rect in [[-0.2, -1.2, w / 2.0 - 0.5, -1.0], [w / 2.0 + 0.5, -1.2, w + 0.2, -1.0]] {
        faces.extend(block(rect, [0.0, HIGH]));
    }
    for rect in [[-0.2, -1.0, w / 2.0 - 0.7, 0.0], [w / 2.0 + 0.7, -1.0, w + 0.2, 0.0]] {
        faces.extend(block(rect, [0.0, HIGH]));
    }
    let with = maze(&faces);
    assert_eq!(with.openings.len(), 1);
    assert!(
        with.is_solvable() && (with.path_length().unwrap() - plain.path_length().unwrap()).abs() < 0.5,
        "{h}"
    );
}

#[test]
fn f16_what_is_off_axis_above_the_ball_refuses_nothing() {
    let (mut faces, size) = boxes(9, 0.0);
    faces.push(floor(size));
    let plain = maze(&faces);
    let studs = (0..400).map(|k| [0.1 + f64::from(k % 20) * 0.3, 0.1 + f64::from(k / 20) * 0.3]);
    for [x, y] in studs {
        let corner = |k: i32, z: f64| {
            let angle = std::f64::consts::TAU * f64::from(k) / 12.0;
            [x + 0.1 * angle.cos(), y + 0.1 * angle.sin(), z]
        };
        faces.extend(
            (0..12).map(|k| vec![corner(k, HIGH), corner(k + 1, HIGH), corner(k + 1, 1.0), corner(k, 1.0)]),
        );
    }
    let with = maze(&faces);
    assert_eq!(with.planes, plain.planes);
    assert!(
        with.report.ignored.iter().any(|note| note.reason == FaceReason::OffAxisBeyondCut),
        "{:?}",
        with.report.ignored
    );
}

#[test]
fn f18_a_number_that_is_none_is_told_with_its_line() {
    for number in ["1.#INF", "-1.#IND00", "1.#QNAN", "1.#J", "nan", "1e999"] {
        let text = format!("v 0 0 0\nv 1 0 {number}\nv 1 1 0\nf 1 2 3\n");
        let error = import::obj::read(text.as_bytes()).unwrap_err().to_string();
        assert!(
            error.starts_with("line 2: expected `v X Y Z` with three finite numbers"),
            "{number}: {error}"
        );
    }
    let commented = "v 0 0 0 # first\nv 1 0 0 #\nv 1 1 0\n#f 1 2 3\nf 1 2 3 # 1.#INF\n";
    assert_eq!(import::obj::read(commented.as_bytes()).unwrap().n_faces(), 1);
}
