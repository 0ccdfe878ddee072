//! Every OBJ of the collection of real ones, and what a player gets of it; written down after looking at its picture.
//!
//! The collection is not ours to give away. Where it is not there, the small files in `obj_mazes.rs` and
//! `obj_oddities.rs` stand for its oddities.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]
#![allow(clippy::disallowed_methods, reason = "this test reads files")]

use maze_core::{AssembleOptions, Facing, Maze, UpAxis, import};
use std::path::PathBuf;

enum Expected {
    /// Planes facing +x, -x, +y, -y after merging; up axis; openings of the outer wall; whether the file has a floor.
    Maze([usize; 4], UpAxis, usize, bool),
    /// Words of the refusal.
    Refused(&'static [&'static str]),
}
use Expected::{Maze as Played, Refused};

/// What the pictures show is told beside each.
const TABLE: [(&str, Expected); 10] = [
    // Upright along one axis; along the other every wall leans by 2.8 degrees.
    ("arc3d_maze", Refused(&["axis-aligned", "its walls lean", "42.2 %", "27.3 % of all"])),
    // 89 boxes put down by hand, up to 1.6 degrees askew: a hall of thin walls, doors in it narrower than the ball.
    ("dovahqueen_Maze", Played([93, 100, 88, 105], UpAxis::Y, 0, true)),
    // A board that is open on three sides, a round hole in its floor.
    ("ds9_labyrinth", Played([11, 10, 12, 9], UpAxis::Y, 4, true)),
    // A small maze with a wide rim and a door on either side.
    ("grapvle_maze", Played([17, 18, 16, 19], UpAxis::Y, 2, true)),
    // A large maze of thin walls with one exit.
    ("jeutsi_maze", Played([81, 81, 81, 81], UpAxis::Y, 1, true)),
    // A box of four boards that are a hundredth of its width out of line.
    ("lcwnvgp_maze", Played([3, 3, 3, 3], UpAxis::Y, 0, true)),
    // An object file of a compiler.
    ("mtintti_Maze", Refused(&["not a text file", "an object file of a compiler"])),
    // A board like that of a well-known arcade game, corners rounded, the rim without tops.
    ("p1rv_labyrinth", Played([75, 68, 71, 72], UpAxis::Y, 0, true)),
    // A ball maze for the printer, a square hole in its floor.
    ("risauce_maze", Played([20, 14, 18, 16], UpAxis::Z, 1, true)),
    // Wide blocks and an entrance on every side.
    ("ursina_maze", Played([18, 21, 21, 18], UpAxis::Y, 4, true)),
];

#[test]
fn every_real_maze_is_what_its_picture_shows() {
    let directory = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/data/obj"));
    let Ok(entries) = std::fs::read_dir(&directory) else {
        println!("no collection of real mazes beside the project: only our own small files are tested");
        return;
    };
    let mut names: Vec<String> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter_map(|name| name.strip_suffix(".obj").map(str::to_owned))
        .collect();
    names.sort();
    let listed: Vec<&str> = TABLE.iter().map(|(name, _)| *name).collect();
    assert_eq!(names, listed, "a file without an expectation: look at its picture and write down what it is");
    for (name, expected) in TABLE {
        let bytes = std::fs::read(directory.join(name).with_extension("obj")).unwrap();
        let maze = import::obj::read(&bytes).map_err(|error| error.to_string()).and_then(|mesh| {
            Maze::from_polygons(&mesh, &AssembleOptions::default()).map_err(|error| error.to_string())
        });
        match (maze, expected) {
            (Ok(maze), Played(planes, up_axis, n_openings, has_floor)) => {
                let n_planes = Facing::ALL.map(|facing| maze.planes.n_planes(facing));
                assert_eq!(n_planes, planes, "{name}: planes facing +x, -x, +y, -y");
                assert!(maze.is_solvable(), "{name}");
                let found = (maze.report.up_axis, maze.openings.len(), maze.report.has_floor);
                assert_eq!(found, (up_axis, n_openings, has_floor), "{name}");
            }
            (Err(reason), Refused(words)) => {
                for word in words {
                    assert!(reason.contains(word), "{name}: expected `{word}` in `{reason}`");
                }
            }
            (Ok(_), Refused(_)) => panic!("{name}: should be refused"),
            (Err(reason), Played(..)) => panic!("{name}: {reason}"),
        }
    }
}
