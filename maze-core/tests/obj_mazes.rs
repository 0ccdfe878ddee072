//! Mazes from OBJ text: our own small oddities, and what is refused.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod obj_text;

use maze_core::{AssembleOptions, Facing, Maze, Radius, UpAxis, import};
use obj_text::block;

/// A 12 x 4 room, walls 1 thick and 2 high along +z, with a door 3.1 wide at the right end of the far wall.
fn room() -> String {
    let walls = [
        ([0.0, 0.0], [14.0, 1.0]),
        ([0.0, 1.0], [1.0, 6.0]),
        ([13.0, 1.0], [14.0, 6.0]),
        ([1.0, 5.0], [9.9, 6.0]),
    ];
    let blocks = walls
        .iter()
        .enumerate()
        .map(|(n, (low, high))| block(8 * n, [low[0], low[1], 0.0], [high[0], high[1], 2.0]));
    blocks.collect()
}

fn load(text: &str, options: &AssembleOptions) -> Result<Maze, String> {
    let mesh = import::obj::read(text.as_bytes()).map_err(|error| error.to_string())?;
    Maze::from_polygons(&mesh, options).map_err(|error| error.to_string())
}

fn loaded(text: &str) -> Maze {
    load(text, &AssembleOptions::default()).unwrap()
}

#[test]
fn a_room_has_its_inner_faces_a_door_and_a_laid_floor() {
    let maze = loaded(&room());
    // The commonest gap is the room's depth of 4 over a width of 12; scaled to 1.
    assert_eq!(maze.report.scale, 0.25);
    assert_eq!(maze.report.up_axis, UpAxis::Z);
    assert!(!maze.report.has_floor && maze.is_solvable());
    assert_eq!(maze.openings.len(), 1);
    assert_eq!((maze.openings[0].facing, maze.openings[0].offset), (Facing::MinusY, 0.75));
    // +x: the left wall and the door's left post; +y: the near wall; -y: the far wall and the closed door.
    let counts = Facing::ALL.map(|facing| maze.planes.n_planes(facing));
    assert_eq!(counts, [2, 1, 1, 2]);
    assert!((maze.wall_height - 0.5).abs() < 1.0e-12);
}

#[test]
fn y_up_is_the_same_maze_and_not_its_mirror_image() {
    let turned: String = room()
        .lines()
        .map(|line| match line.strip_prefix("v ") {
            Some(numbers) => {
                let numbers: Vec<f64> = numbers.split(' ').map(|word| word.parse().unwrap()).collect();
                format!("v {} {} {}\n", numbers[0], numbers[2], -numbers[1])
            }
            None => format!("{line}\n"),
        })
        .collect();
    let (z_up, y_up) = (loaded(&room()), loaded(&turned));
    assert_eq!(y_up.report.up_axis, UpAxis::Y);
    assert_eq!(y_up.planes, z_up.planes);
    assert_eq!((y_up.start(), y_up.goal()), (z_up.start(), z_up.goal()));
}

/// The room with every coordinate moved.
fn moved(scale: f64, offset: [f64; 3]) -> String {
    let line = |line: &str| match line.strip_prefix("v ") {
        Some(numbers) => {
            let numbers: Vec<f64> = numbers.split(' ').map(|word| word.parse().unwrap()).collect();
            let [x, y, z] = [0, 1, 2].map(|axis| numbers[axis] * scale + offset[axis]);
            format!("v {x} {y} {z}\n")
        }
        None => format!("{line}\n"),
    };
    room().lines().map(line).collect()
}

#[test]
fn a_maze_may_lie_far_from_the_origin_and_be_of_any_size() {
    let here = loaded(&room());
    for (scale, offset) in [(1.0, [1.0e6, -1.0e6, 512.0]), (1.0e6, [0.0; 3]), (1.0e-6, [0.0; 3])] {
        let there = loaded(&moved(scale, offset));
        let counts = |maze: &Maze| Facing::ALL.map(|facing| maze.planes.n_planes(facing));
        assert_eq!(counts(&there), counts(&here), "{scale} {offset:?}");
        assert!((there.goal() - here.goal()).norm() < 1.0e-6);
    }
    for scale in [1.0e90, 1.0e-90] {
        let error = load(&moved(scale, [0.0; 3]), &AssembleOptions::default()).unwrap_err();
        assert!(error.contains("units large: expected 1e-12 to 1e12"), "{error}");
    }
}

#[test]
fn a_ground_far_below_the_walls_is_not_their_floor() {
    let ground = "v -99 -99 -10\nv 99 -99 -10\nv 99 99 -10\nv -99 99 -10\nf -4 -3 -2 -1\n";
    let maze = load(&(room() + ground), &AssembleOptions { up_axis: Some(UpAxis::Z), ..Default::default() })
        .unwrap();
    assert!(!maze.report.has_floor, "one is laid at the walls' feet");
    assert_eq!(maze.planes, loaded(&room()).planes);
}

#[test]
fn a_ball_of_any_size_is_answered() {
    for radius in [1.0e-300, 1.0e-9, 0.6, 1.0e17, 1.0e300] {
        let options = AssembleOptions { ball_radius: Radius::new(radius).ok(), ..Default::default() };
        let result = load(&room(), &options);
        assert_eq!(result.is_ok(), radius < 0.5, "{radius}: {:?}", result.err());
    }
}

#[test]
fn a_file_turned_inside_out_is_the_same_maze_and_looks_the_same() {
    let turned = |line: &str| match line.strip_prefix("f ") {
        Some(corners) => format!("f {}\n", corners.split(' ').rev().collect::<Vec<_>>().join(" ")),
        None => format!("{line}\n"),
    };
    let floor = "v 0 0 0\nv 14 0 0\nv 14 6 0\nv 0 6 0\nf -4 -3 -2 -1\n";
    let text = room() + floor;
    let inside_out: String = text.lines().map(turned).collect();
    let (one, other) = (loaded(&text), loaded(&inside_out));
    assert!(one.report.has_floor && other.report.has_floor);
    assert_eq!(one.planes, other.planes);
    for surface in maze_core::surface::Surface::ALL {
        let n_triangles = |maze: &Maze| maze.surface.indices_of(surface).len();
        assert_eq!(n_triangles(&one), n_triangles(&other), "{surface:?}");
    }
}

#[test]
fn a_chink_is_no_opening() {
    // The door's wall ends 0.1 before the right wall: too narrow for the ball.
    let text = room().replace("v 9.9 ", "v 12.9 ");
    let maze = loaded(&text);
    assert!(maze.openings.is_empty() && maze.is_solvable());
}

#[test]
fn every_surface_is_drawn() {
    let maze = loaded(&room());
    for surface in maze_core::surface::Surface::ALL {
        assert!(!maze.surface.indices_of(surface).is_empty(), "{surface:?}");
    }
}

#[test]
fn what_is_no_maze_is_refused_with_the_reason() {
    let refused = |text: &str| load(text, &AssembleOptions::default()).unwrap_err();
    assert_eq!(refused("v 0 0 0\n"), "no faces: expected walls");
    let floor = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
    let no_walls =
        load(floor, &AssembleOptions { up_axis: Some(UpAxis::Z), ..Default::default() }).unwrap_err();
    assert!(no_walls.starts_with("no walls among 1 faces"), "{no_walls}");
    let tetrahedron = "v 0 0 0\nv 4 1 0\nv 1 4 0\nv 1 1 3\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    let tetrahedron = refused(tetrahedron);
    assert!(tetrahedron.starts_with("not a maze of axis-aligned walls (curved"), "{tetrahedron}");
    assert!(tetrahedron.contains("100.0 % of the area"), "{tetrahedron}");
    let one_block = block(0, [0.0; 3], [3.0, 3.0, 1.0]);
    assert!(refused(&one_block).starts_with("no corridor"));
    let too_large = AssembleOptions { ball_radius: Radius::new(0.9).ok(), ..Default::default() };
    assert_eq!(
        load(&room(), &too_large).unwrap_err(),
        "a ball of radius 0.9 corridors fits nowhere in this maze: expected less than 0.5"
    );
}

#[test]
fn a_file_cut_anywhere_is_a_maze_or_a_reason_and_never_a_panic() {
    let text = room();
    for end in 0..text.len() {
        let _ = load(&text[..end], &AssembleOptions::default());
    }
}
