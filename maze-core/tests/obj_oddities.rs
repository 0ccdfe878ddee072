//! One small maze, written in every odd way that programs write an OBJ: each must give the maze, or say why not.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]
#![allow(clippy::disallowed_methods, reason = "test files are made with sines and cosines")]

use maze_core::surface::Surface;
use maze_core::{AssembleOptions, FaceReason, Facing, Maze, UpAxis, import};

type Point = [f64; 3];
type Polygon = Vec<Point>;

/// Near, far, left and right wall and one between, 1 thick, 2 high; the corridor is 2 wide and turns once.
const WALLS: [[f64; 4]; 5] = [
    [0.0, 0.0, 9.0, 1.0],
    [0.0, 6.0, 9.0, 7.0],
    [0.0, 1.0, 1.0, 6.0],
    [8.0, 1.0, 9.0, 6.0],
    [1.0, 3.0, 6.0, 4.0],
];
/// What is left of them: planes facing +x, -x, +y, -y.
const PLANES: [usize; 4] = [3, 1, 2, 2];
const HEIGHT: f64 = 2.0;

/// A box on [x0, y0, x1, y1] between two heights.
fn block([x0, y0, x1, y1]: [f64; 4], [z0, z1]: [f64; 2]) -> Vec<Polygon> {
    raised(&[[x0, y0], [x1, y0], [x1, y1], [x0, y1]], [z0, z1])
}

/// A prism over an outline that runs counter-clockwise.
fn raised(outline: &[[f64; 2]], [z0, z1]: [f64; 2]) -> Vec<Polygon> {
    let next = outline.iter().cycle().skip(1);
    let side = |([ax, ay], [bx, by]): (&[f64; 2], &[f64; 2])| {
        vec![[*ax, *ay, z0], [*bx, *by, z0], [*bx, *by, z1], [*ax, *ay, z1]]
    };
    let mut faces: Vec<Polygon> = outline.iter().zip(next).map(side).collect();
    faces.push(outline.iter().map(|[x, y]| [*x, *y, z1]).collect());
    faces.push(outline.iter().rev().map(|[x, y]| [*x, *y, z0]).collect());
    faces
}

fn walls() -> Vec<Polygon> {
    WALLS.into_iter().flat_map(|wall| block(wall, [0.0, HEIGHT])).collect()
}

fn floor() -> Polygon {
    vec![[0.0, 0.0, 0.0], [9.0, 0.0, 0.0], [9.0, 7.0, 0.0], [0.0, 7.0, 0.0]]
}

fn text(faces: &[Polygon]) -> String {
    let mut text = String::new();
    let mut n_vertices = 0;
    for face in faces {
        for [x, y, z] in face {
            text += &format!("v {x:.6} {y:.6} {z:.6}\n");
        }
        let corners: Vec<String> = (1..=face.len()).map(|corner| (n_vertices + corner).to_string()).collect();
        text += &format!("f {}\n", corners.join(" "));
        n_vertices += face.len();
    }
    text
}

fn moved(faces: &[Polygon], to: impl Fn(Point) -> Point) -> Vec<Polygon> {
    faces.iter().map(|face| face.iter().map(|point| to(*point)).collect()).collect()
}

/// Turned about (x, y).
fn turned([x, y]: [f64; 2], degrees: f64) -> impl Fn(Point) -> Point {
    let (sin, cos) = degrees.to_radians().sin_cos();
    move |[px, py, pz]| {
        let (dx, dy) = (px - x, py - y);
        [x + cos * dx - sin * dy, y + sin * dx + cos * dy, pz]
    }
}

fn load_with(text: &str, options: &AssembleOptions) -> Result<Maze, String> {
    let mesh = import::obj::read(text.as_bytes()).map_err(|error| error.to_string())?;
    Maze::from_polygons(&mesh, options).map_err(|error| error.to_string())
}

/// Loads what is flat along z.
fn load(faces: &[Polygon]) -> Result<Maze, String> {
    load_with(&text(faces), &AssembleOptions::default())
}

fn planes(maze: &Maze) -> [usize; 4] {
    Facing::ALL.map(|facing| maze.planes.n_planes(facing))
}

/// Expects the maze, and gives it back for more.
fn played(name: &str, faces: &[Polygon]) -> Maze {
    let maze = load(faces).unwrap_or_else(|reason| panic!("{name}: {reason}"));
    assert_eq!(planes(&maze), PLANES, "{name}");
    assert!(maze.is_solvable() && maze.openings.is_empty(), "{name}");
    maze
}

fn area(maze: &Maze, surface: Surface) -> f64 {
    let corner = |index: u32| nalgebra::Vector3::from(maze.surface.vertices[index as usize].position);
    let triangles = maze.surface.indices_of(surface).chunks(3);
    triangles
        .map(|t| f64::from((corner(t[1]) - corner(t[0])).cross(&(corner(t[2]) - corner(t[0]))).norm()) / 2.0)
        .sum()
}

/// In corridors of 2.
const TOPS: f64 = (9.0 * 7.0 - 7.0 * 5.0 + 5.0) / 4.0;

#[test]
fn plain() {
    let maze = played("plain", &walls());
    assert_eq!((maze.report.scale, maze.report.up_axis, maze.report.has_floor), (0.5, UpAxis::Z, false));
    assert!(
        maze.report.adjusted.is_empty()
            && maze.report.merged_within.is_none()
            && maze.report.thickened_to.is_none()
    );
    assert!((area(&maze, Surface::Top) - TOPS).abs() < 1.0e-4);
}

#[test]
fn any_axis_may_be_up_and_the_file_may_be_mirrored() {
    let y_up = |[x, y, z]: Point| [x, z, -y];
    let x_up = |[x, y, z]: Point| [z, x, y];
    for (axis, faces) in [(UpAxis::Y, moved(&walls(), y_up)), (UpAxis::X, moved(&walls(), x_up))] {
        assert_eq!(played(axis.name(), &faces).report.up_axis, axis);
    }
    // A mirror image has its faces inside out.
    let mirrored = load(&moved(&walls(), |[x, y, z]| [-x, y, z])).unwrap();
    assert_eq!(planes(&mirrored), [1, 3, 2, 2]);
    assert!((area(&mirrored, Surface::Top) - TOPS).abs() < 1.0e-4);
}

#[test]
fn triangles_concave_and_many_sided_polygons() {
    let triangles: Vec<Polygon> = walls()
        .iter()
        .flat_map(|quad| [vec![quad[0], quad[1], quad[2]], vec![quad[0], quad[2], quad[3]]])
        .collect();
    played("triangles", &triangles);
    // Four of the walls are one piece, like an E.
    let outline = [
        [0.0, 0.0],
        [8.0, 0.0],
        [8.0, 1.0],
        [1.0, 1.0],
        [1.0, 3.0],
        [6.0, 3.0],
        [6.0, 4.0],
        [1.0, 4.0],
        [1.0, 6.0],
        [8.0, 6.0],
        [8.0, 7.0],
        [0.0, 7.0],
    ];
    let right = block([8.0, 0.0, 9.0, 7.0], [0.0, HEIGHT]);
    let concave = [raised(&outline, [0.0, HEIGHT]), right.clone()].concat();
    assert!((area(&played("concave", &concave), Surface::Top) - TOPS).abs() < 1.0e-4);
    // The same with 25 corners on every edge: a top of 300.
    let next = outline.iter().cycle().skip(1);
    let fine: Vec<[f64; 2]> = outline
        .iter()
        .zip(next)
        .flat_map(|(a, b)| {
            let at = |part: f64| [a[0] + (b[0] - a[0]) * part, a[1] + (b[1] - a[1]) * part];
            (0..25).map(move |n| at(f64::from(n) / 25.0))
        })
        .collect();
    let many_sided = [raised(&fine, [0.0, HEIGHT]), right].concat();
    assert!((area(&played("300 corners", &many_sided), Surface::Top) - TOPS).abs() < 1.0e-3);
}

#[test]
fn odd_ways_to_write_the_same() {
    let plain = text(&walls());
    let per_vertex = |more: &str| plain.replace('\n', &format!("{more}\n"));
    let exponents: String = plain
        .lines()
        .map(|line| match line.strip_prefix("v ") {
            Some(numbers) => {
                let numbers = numbers.split(' ').map(|word| format!("{:e}", word.parse::<f64>().unwrap()));
                format!("v {}\n", numbers.collect::<Vec<_>>().join("\t"))
            }
            None => format!("{line}\n"),
        })
        .collect();
    // Each face follows its four vertices.
    let relative: String = plain
        .lines()
        .map(|line| if line.starts_with('f') { "f -4 -3 -2 -1\n".to_owned() } else { format!("{line}\n") })
        .collect();
    let mut n_faces = 0;
    let mixed: String = plain
        .lines()
        .map(|line| {
            let Some(corners) = line.strip_prefix("f ") else { return format!("{line}\n") };
            n_faces += 1;
            let style = ["", "/1", "//1", "/1/1"][n_faces % 4];
            let corners: Vec<String> = corners.split(' ').map(|corner| format!("{corner}{style}")).collect();
            format!("f {}\n", corners.join(" "))
        })
        .collect();
    let cases = [
        ("CRLF", plain.replace('\n', "\r\n")),
        ("old Macintosh", plain.replace('\n', "\r")),
        ("exponents and tabs", exponents),
        ("comments", format!("# made by hand\n\n{}# end", per_vertex(" # here"))),
        (
            "lines, points, curves",
            format!("{plain}l 1 2 3\np 4\ncstype bezier\ndeg 3\ncurv 0 1 1 2 3 4\nend\n"),
        ),
        ("no such material", format!("mtllib gone.mtl\nusemtl oak\ns off\ng walls\n{plain}")),
        ("objects", plain.replace("f 5 ", "o second\nf 5 ")),
        ("negative indices", relative),
        ("mixed corners", format!("vt 0 0\nvn 0 0 1\n{mixed}")),
        ("lines that go on", plain.replace("f ", "f \\\n  ")),
        ("byte order mark", format!("\u{feff}{plain}")),
        ("colours", plain.replace(".000000\nv", ".000000 0.5 0.25 1\nv")),
        ("degenerate faces", format!("{plain}f 1 1 1\nf 1 2 1\nf 3 4\nf 1 2 2 1\n")),
        (
            "every face twice",
            format!(
                "{plain}{}",
                plain.lines().filter(|line| line.starts_with('f')).collect::<Vec<_>>().join("\n")
            ),
        ),
    ];
    for (name, text) in cases {
        let maze =
            load_with(&text, &AssembleOptions::default()).unwrap_or_else(|reason| panic!("{name}: {reason}"));
        assert_eq!(planes(&maze), PLANES, "{name}");
        let n_degenerate = maze
            .report
            .ignored
            .iter()
            .find(|note| note.reason == FaceReason::NoArea)
            .map(|note| note.n_faces);
        assert_eq!(n_degenerate, (name == "degenerate faces").then_some(4), "{name}");
    }
}

#[test]
fn a_roof_is_not_drawn() {
    let lid = block([0.0, 0.0, 9.0, 7.0], [HEIGHT, HEIGHT + 0.2]);
    let sheet = moved(&[floor()], |[x, y, _]| [x, y, HEIGHT]);
    for (name, roof) in [("lid", lid), ("sheet", sheet)] {
        let maze = played(name, &[walls(), vec![floor()], roof].concat());
        assert!(
            maze.report.ignored.iter().any(|note| note.reason == FaceReason::Roof && note.n_faces == 1),
            "{name}"
        );
        assert!((area(&maze, Surface::Top) - TOPS).abs() < 1.0e-3, "{name}: tops are laid instead");
        assert!(maze.report.has_floor, "{name}");
    }
}

#[test]
fn walls_without_tops_are_given_some() {
    let open: Vec<Polygon> =
        walls().into_iter().filter(|face| !face.iter().all(|point| point[2] == HEIGHT)).collect();
    assert!((area(&played("no tops", &open), Surface::Top) - TOPS).abs() < 1.0e-3);
}

#[test]
fn walls_a_few_tenths_of_a_degree_off_axis_are_snapped() {
    let angles = [0.3, -0.2, 0.25, -0.3, 0.4];
    let crooked: Vec<Polygon> = WALLS
        .into_iter()
        .zip(angles)
        .flat_map(|([x0, y0, x1, y1], angle)| {
            let middle = [(x0 + x1) / 2.0, (y0 + y1) / 2.0];
            moved(&block([x0, y0, x1, y1], [0.0, HEIGHT]), turned(middle, angle))
        })
        .collect();
    let maze = load(&crooked).unwrap();
    assert!(maze.is_solvable() && maze.openings.is_empty());
    let snapped = maze.report.adjusted.iter().find(|note| note.reason == FaceReason::SnappedToAxis).unwrap();
    assert_eq!(snapped.n_faces, 20);
    // The corridor's two long sides are the same faces as ever, each within a hundredth of a corridor of its place.
    for (facing, offset) in [(Facing::PlusY, -1.25), (Facing::MinusY, 1.25)] {
        let longest = maze
            .planes
            .planes(facing)
            .max_by(|a, b| (a.end - a.start).total_cmp(&(b.end - b.start)))
            .unwrap();
        assert!((longest.offset - offset).abs() < 0.03 && 3.3 < longest.end - longest.start, "{longest:?}");
    }
}

#[test]
fn noise_of_duplicate_planes_is_merged() {
    let noisy: Vec<Polygon> = (0..8)
        .flat_map(|n| {
            let by = f64::from(n) * 0.001;
            moved(&walls(), |[x, y, z]| [x + by, y - by, z])
        })
        .collect();
    let maze = played("noise", &noisy);
    assert!(
        (maze.report.merged_within.unwrap() - 0.0045).abs() < 1.0e-4,
        "a thousandth of 9 units, in corridors of 2"
    );
}

#[test]
fn walls_without_thickness_are_given_some() {
    let sheet = |[x0, y0]: [f64; 2], [x1, y1]: [f64; 2]| {
        vec![[x0, y0, 0.0], [x1, y1, 0.0], [x1, y1, HEIGHT], [x0, y0, HEIGHT]]
    };
    let one_sided = vec![
        sheet([0.0, 0.0], [8.0, 0.0]),
        sheet([0.0, 6.0], [8.0, 6.0]),
        sheet([0.0, 0.0], [0.0, 6.0]),
        sheet([8.0, 0.0], [8.0, 6.0]),
        sheet([0.0, 2.0], [6.0, 2.0]),
        sheet([2.0, 4.0], [8.0, 4.0]),
    ];
    let two_sided =
        [one_sided.clone(), one_sided.iter().map(|face| face.iter().rev().copied().collect()).collect()]
            .concat();
    for (name, faces) in [("one-sided", one_sided), ("two-sided", two_sided)] {
        let maze = load(&faces).unwrap_or_else(|reason| panic!("{name}: {reason}"));
        // A tenth of the 2 units between the faces, in corridors of what is left.
        assert!(
            (maze.report.thickened_to.unwrap() - 0.2 / 1.8).abs() < 1.0e-3,
            "{name}: {:?}",
            maze.report.thickened_to
        );
        // Three corridors that join like an S.
        assert_eq!(planes(&maze), [3, 3, 3, 3], "{name}");
        assert!(maze.is_solvable() && maze.openings.is_empty(), "{name}");
        assert!(2.0 < (maze.start() - maze.goal()).norm(), "{name}");
    }
}

#[test]
fn decoration_does_not_get_in_the_way() {
    let tower = block([0.2, 0.2, 0.7, 0.7], [HEIGHT, 8.0]);
    let ball = sphere([8.5, 6.5, 2.3], 0.3);
    let faces = [walls(), tower, ball].concat();
    let maze = load_with(&text(&faces), &AssembleOptions { up_axis: Some(UpAxis::Z), ..Default::default() })
        .unwrap();
    assert_eq!(planes(&maze), PLANES);
    assert!((maze.wall_height - 0.8).abs() < 1.0e-9);
}

fn sphere([x, y, z]: Point, radius: f64) -> Vec<Polygon> {
    let at = |i: u32, j: u32| {
        let (polar, azimuth) =
            (f64::from(i) * 0.1 * std::f64::consts::PI, f64::from(j) * 0.1 * std::f64::consts::PI);
        let ring = radius * polar.sin();
        [x + ring * azimuth.cos(), y + ring * azimuth.sin(), z - radius * polar.cos()]
    };
    (0..10)
        .flat_map(|i| (0..20).map(move |j| vec![at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)]))
        .collect()
}

#[test]
fn a_maze_turned_about_its_up_axis_is_turned_back() {
    for degrees in [1.5, 30.0, 45.0, -20.0, 88.0] {
        let maze = load(&moved(&walls(), turned([3.0, -4.0], degrees))).unwrap();
        let mut found = planes(&maze);
        found.sort_unstable();
        assert_eq!(found, [1, 2, 2, 3], "{degrees}");
        let told = maze.report.turned.y.atan2(maze.report.turned.x).to_degrees();
        // By quarter turns they are all alike.
        let off = (told - degrees) / 90.0;
        assert!((off - off.round()).abs() < 1.0e-4, "{degrees}: {told}");
        assert!(maze.is_solvable() && (maze.report.scale - 0.5).abs() < 1.0e-4, "{degrees}");
    }
}

#[test]
fn a_surface_without_undersides_is_a_maze() {
    // As a height map is written: floor, tops, and the steps between them.
    let seen: Vec<Polygon> =
        walls().into_iter().filter(|face| !face.iter().all(|point| point[2] == 0.0)).collect();
    let corridors = [[1.0, 1.0, 8.0, 3.0], [1.0, 4.0, 8.0, 6.0], [6.0, 3.0, 8.0, 4.0]];
    let floors =
        corridors.map(|[x0, y0, x1, y1]| vec![[x0, y0, 0.0], [x1, y0, 0.0], [x1, y1, 0.0], [x0, y1, 0.0]]);
    let maze = played("height map", &[seen, floors.to_vec()].concat());
    assert!(maze.report.has_floor && maze.report.ignored.is_empty());
}

#[test]
fn a_surface_that_ends_at_its_rim_has_its_walls_where_it_is_high() {
    // As above, but the board has no outer sides: every step looks into the corridor.
    let corridor =
        [[1.0, 1.0], [1.0, 3.0], [6.0, 3.0], [6.0, 4.0], [1.0, 4.0], [1.0, 6.0], [8.0, 6.0], [8.0, 1.0]];
    let steps: Vec<Polygon> = raised(&corridor, [0.0, HEIGHT]).into_iter().take(8).collect();
    let floor: Polygon = corridor.iter().rev().map(|[x, y]| [*x, *y, 0.0]).collect();
    let tops = walls().into_iter().filter(|face| face.iter().all(|point| point[2] == HEIGHT));
    let terrain: Vec<Polygon> = steps.iter().cloned().chain(tops).chain([floor.clone()]).collect();
    assert!(played("terrain", &terrain).report.has_floor);
    // The corridors alone, as a dungeon is drawn, without tops.
    let dungeon = [steps, vec![floor]].concat();
    // The middle wall, and a rim of a fiftieth of the size, in corridors of 2.
    let expected = (5.0 + 7.28 * 5.28 - 35.0) / 4.0;
    assert!((area(&played("dungeon", &dungeon), Surface::Top) - expected).abs() < 1.0e-3);
}

#[test]
fn a_board_may_be_thicker_than_its_walls_are_high() {
    let slab = block([0.0, 0.0, 9.0, 7.0], [-6.0, 0.0]);
    let faces = [walls(), slab].concat();
    let options = AssembleOptions { up_axis: Some(UpAxis::Z), ..Default::default() };
    let maze = load_with(&text(&faces), &options).unwrap();
    assert_eq!(planes(&maze), PLANES);
    assert!(maze.report.has_floor && (maze.wall_height - 0.8).abs() < 1.0e-9);
}

#[test]
fn what_fits_no_maze_is_refused_by_what_it_is() {
    let refused = |faces: &[Polygon]| {
        load_with(&text(faces), &AssembleOptions { up_axis: Some(UpAxis::Z), ..Default::default() })
            .unwrap_err()
    };
    let circle = |radius: f64, turn: f64| {
        (0..48).map(move |n| {
            let angle = turn * f64::from(n) / 48.0 * std::f64::consts::TAU;
            [radius * angle.cos(), radius * angle.sin()]
        })
    };
    // A ring: the outer side counter-clockwise, the inner one clockwise, on top of each other.
    let ring = |outer: f64, inner: f64| {
        let sides = |outline: Vec<[f64; 2]>| raised(&outline, [0.0, HEIGHT]).into_iter().take(48);
        sides(circle(outer, 1.0).collect()).chain(sides(circle(inner, -1.0).collect())).collect::<Vec<_>>()
    };
    let round = refused(&[ring(9.0, 8.0), ring(6.0, 5.0)].concat());
    assert!(round.contains("(round or slanted walls): 100.0 %"), "{round}");
    let leaning = refused(&moved(&walls(), |[x, y, z]| [x + 0.1 * z, y, z]));
    assert!(leaning.contains("(its walls lean): "), "{leaning}");
    let organic = refused(&sphere([0.0; 3], 5.0));
    assert!(organic.contains("(curved in all directions"), "{organic}");
    let triangular = [[0.0, 0.0], [9.0, 0.0], [4.5, 8.0]];
    let slanted = refused(&raised(&triangular, [0.0, HEIGHT]));
    assert!(slanted.contains("(round or slanted walls)"), "{slanted}");
}

#[test]
fn start_goal_and_scale_may_be_chosen() {
    let with = |options: AssembleOptions| load_with(&text(&walls()), &options);
    let point = |x: f64, y: f64| Some(nalgebra::Vector2::new(x, y));
    let maze =
        with(AssembleOptions { start: point(0.0, -0.75), goal: point(1.2, 0.75), ..Default::default() })
            .unwrap();
    assert_eq!(
        (Some(maze.start()), Some(maze.goal()), maze.is_solvable()),
        (point(0.0, -0.75), point(1.2, 0.75), true)
    );
    for (start, goal) in [(point(0.0, 0.0), None), (None, point(0.0, -1.3)), (point(99.0, 0.0), None)] {
        let refused = with(AssembleOptions { start, goal, ..Default::default() }).unwrap_err();
        assert!(refused.starts_with("the ball does not fit at ("), "{refused}");
    }
    let wide = with(AssembleOptions { scale: Some(1.0), ..Default::default() }).unwrap();
    assert_eq!((wide.report.scale, wide.bounds.size()), (1.0, nalgebra::Vector2::new(9.0, 7.0)));
    // The ball grows and shrinks with the corridors.
    let usual = with(AssembleOptions::default()).unwrap();
    for scale in [0.2 * usual.report.scale, 5.0 * usual.report.scale] {
        let scaled = with(AssembleOptions { scale: Some(scale), ..Default::default() }).unwrap();
        let part = scaled.ball_radius.units() / usual.ball_radius.units() / (scale / usual.report.scale);
        assert!((part - 1.0).abs() < 1.0e-9 && scaled.is_solvable(), "{part}");
    }
    for scale in [1.0e-3, 1.0e9] {
        let refused = with(AssembleOptions { scale: Some(scale), ..Default::default() }).unwrap_err();
        assert!(refused.contains("expected 0.1 to 100"), "{refused}");
    }
}
