//! Every real SVG, if the directory with them is there: what is expected of it was written down after looking at its picture.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]
#![allow(clippy::disallowed_methods, reason = "a test may read files")]

use maze_core::layout::{Door, Side};
use maze_core::{AssembleOptions, Facing, export, import};
use std::path::Path;

/// What a file is expected to be.
enum Expected {
    /// Cells on a side; planes facing +x, -x, +y, -y; the columns of the doors at the top and at the bottom; cells of the path
    /// between them, and whether the file draws it.
    Maze { side: usize, planes: [usize; 4], doors: [usize; 2], path: usize, drawn: bool },
    /// Refused, with these words.
    Refused(&'static str),
}

use Expected::{Maze, Refused};

const TABLE: [(&str, Expected); 8] = [
    (
        "JureBajc_maze.svg",
        Maze { side: 20, planes: [140, 141, 142, 139], doors: [9, 10], path: 83, drawn: false },
    ),
    (
        "JureBajc_maze_solution.svg",
        Maze { side: 20, planes: [140, 141, 142, 139], doors: [9, 10], path: 83, drawn: true },
    ),
    (
        "cjhi_20x20.svg",
        Maze { side: 20, planes: [150, 143, 145, 148], doors: [9, 10], path: 75, drawn: false },
    ),
    ("interfaceguy_theta20.svg", Refused("line 7: a circular (theta) maze")),
    ("norden_10x10.svg", Maze { side: 10, planes: [41, 37, 41, 37], doors: [4, 5], path: 43, drawn: false }),
    ("paraf0x_20x20.svg", Refused("draws the passages, not the walls")),
    (
        "skubin_25x25.svg",
        Maze { side: 25, planes: [220, 231, 224, 227], doors: [12, 12], path: 93, drawn: false },
    ),
    ("sonder_7x7.svg", Maze { side: 7, planes: [21, 18, 20, 19], doors: [3, 3], path: 29, drawn: false }),
];

fn lines(text: &str) -> Vec<&str> {
    text.lines().map(str::trim).filter(|line| line.starts_with("<line ")).collect()
}

fn points(text: &str) -> Option<&str> {
    text.split("points=\"").nth(1)?.split('"').next()
}

#[test]
fn every_real_svg_is_what_the_table_says() {
    let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/data/svg");
    let Ok(entries) = std::fs::read_dir(directory) else { return };
    let mut names: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    names.sort();
    let known: Vec<&str> = TABLE.iter().map(|(name, _)| *name).collect();
    let found: Vec<_> = names.iter().map(|path| path.file_name().unwrap().to_str().unwrap()).collect();
    assert_eq!(found, known, "every file has its line in the table");
    for (path, (name, expected)) in names.iter().zip(&TABLE) {
        let text = std::fs::read_to_string(path).unwrap();
        match (import::svg::read_cells(text.as_bytes()), expected) {
            (Err(error), Refused(words)) => assert!(error.to_string().starts_with(words), "{name}: {error}"),
            (Ok(svg), &Maze { side, planes, doors, path, drawn }) => {
                let layout = &svg.layout;
                assert_eq!((layout.width(), layout.height(), svg.cell), (side, side, [16.0; 2]), "{name}");
                assert_eq!(layout.n_passages(), side * side - 1, "{name} is perfect");
                let [top, bottom] = doors;
                let doors =
                    [Door { side: Side::Bottom, index: bottom }, Door { side: Side::Top, index: top }];
                assert_eq!(layout.doors().collect::<Vec<_>>(), doors, "{name}");
                let maze = layout.maze(&AssembleOptions::default()).unwrap();
                assert_eq!(Facing::ALL.map(|facing| maze.planes.n_planes(facing)), planes, "{name}");
                assert!(maze.is_solvable() && maze.goal().y < maze.start().y, "{name}: in at the top");
                let solution = layout.solution().unwrap();
                assert_eq!((solution.len(), svg.solution.is_some()), (path, drawn), "{name}");
                // Written, it has the same lines and the same solution.
                let written = export::svg::write(layout, svg.solution.as_deref(), "");
                assert_eq!(lines(&written), lines(&text), "{name}");
                assert_eq!(points(&written), points(&text), "{name}");
                assert!(!drawn || svg.solution == Some(solution), "{name}: the only path");
            }
            (outcome, _) => {
                panic!("{name}: {:?}", outcome.map(|_| "a maze").map_err(|error| error.to_string()))
            }
        }
    }
}
