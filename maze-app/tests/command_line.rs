//! The command line: what it prints, what it refuses, and that nothing is left half-written.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod program;

use program::{DEFAULT_MAZE, maze_app, refused, stdout};
use std::path::Path;
use std::process::Command;

fn json(arguments: &[&str]) -> serde_json::Value {
    program::json(&mut maze_app(arguments))
}

/// A directory with one file in it.
fn file(name: &str, bytes: &[u8]) -> (tempfile::TempDir, String) {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    let path = path.display().to_string();
    (directory, path)
}

fn names_in(directory: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(directory).unwrap();
    entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned()).collect()
}

#[test]
fn info_says_what_was_found() {
    let output = maze_app(&["info", DEFAULT_MAZE, "--json"]).output().unwrap();
    assert!(output.status.success());
    let info: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(info["planes"], serde_json::json!({ "+x": 37, "-x": 36, "+y": 37, "-y": 36 }));
    assert_eq!(info["up_axis"], "z");
    assert_eq!((&info["scale"], &info["ball_radius"]), (&serde_json::json!(1.0), &serde_json::json!(0.35)));
    assert_eq!((&info["solvable"], &info["has_floor"]), (&serde_json::json!(true), &serde_json::json!(true)));
    let text = stdout(&maze_app(&["info", DEFAULT_MAZE]).output().unwrap());
    assert!(text.starts_with("planes       146 (+x 37, -x 36, +y 37, -y 36)\n"), "{text}");
}

#[test]
fn info_prints_the_sorted_table_of_a_group() {
    let output = maze_app(&["info", DEFAULT_MAZE, "--planes", "-x", "--json"]).output().unwrap();
    let table: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let rows: Vec<[f64; 3]> = serde_json::from_value(table["planes"].clone()).unwrap();
    assert_eq!(rows.len(), 36);
    assert!(rows.windows(2).all(|pair| pair[0] < pair[1]), "sorted by offset, start, end");
    let text = stdout(&maze_app(&["info", DEFAULT_MAZE, "--planes", "-x"]).output().unwrap());
    assert_eq!(text.lines().count(), 36 + 2);
}

#[test]
fn a_maze_without_a_way_is_told_by_exit_status_1() {
    // Two rooms with a wall between them and a door to the outside each.
    let wall = |n: usize, [x0, y0, x1, y1]: [f64; 4]| {
        let corner = |k: usize| {
            let pick = |bit: usize, low: f64, high: f64| if k >> bit & 1 == 0 { low } else { high };
            format!("v {} {} {}\n", pick(0, x0, x1), pick(1, y0, y1), pick(2, 0.0, 1.0))
        };
        let quads = [[1, 3, 4, 2], [5, 6, 8, 7], [1, 2, 6, 5], [3, 7, 8, 4], [1, 5, 7, 3], [2, 4, 8, 6]];
        let face = |quad: [usize; 4]| format!("f {}\n", quad.map(|k| (k + 8 * n).to_string()).join(" "));
        (0..8).map(corner).chain(quads.map(face)).collect::<String>()
    };
    let walls = [[0.0, 0.0, 9.0, 1.0], [0.0, 2.0, 9.0, 3.0], [4.0, 1.0, 5.0, 2.0]];
    let text: String = walls.into_iter().enumerate().map(|(n, rectangle)| wall(n, rectangle)).collect();
    let (_directory, path) = file("rooms.obj", text.as_bytes());
    let output = maze_app(&["info", &path]).output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(stdout(&output).contains("solvable     false"));
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(stderr.ends_with("rooms.obj: no path leads from start to goal\n"), "{stderr}");
}

#[test]
fn generate_gives_the_same_file_for_the_same_seed() {
    let directory = tempfile::tempdir().unwrap();
    let make = |name: &str, seed: &str| {
        let path = directory.path().join(name);
        let arguments = ["generate", "--size", "8x5", "--seed", seed, "--out", path.to_str().unwrap()];
        assert!(maze_app(&arguments).status().unwrap().success());
        std::fs::read(path).unwrap()
    };
    assert_eq!(make("a.obj", "7"), make("b.obj", "7"));
    assert_ne!(make("a.obj", "7"), make("c.obj", "8"));
}

const TEXT_MAZE: &str = "#######\n#S    #\n# ### #\n#   #G#\n#######\n";

#[test]
fn a_text_and_its_picture_are_the_same_maze() {
    let lines: Vec<&[u8]> = TEXT_MAZE.lines().map(str::as_bytes).collect();
    let is_wall = |x: u32, y: u32| lines[y as usize / 3][x as usize / 3] == b'#';
    let picture =
        image::GrayImage::from_fn(21, 15, |x, y| image::Luma([if is_wall(x, y) { 0 } else { 255 }]));
    let (directory, text) = file("maze.txt", TEXT_MAZE.as_bytes());
    let text = json(&["info", &text, "--json"]);
    assert_eq!(
        (&text["start"], &text["goal"]),
        (&serde_json::json!([-2.0, 1.0]), &serde_json::json!([2.0, -1.0]))
    );
    for name in ["maze.png", "maze.BMP"] {
        let path = directory.path().join(name);
        picture.save(&path).unwrap();
        let picture = json(&["info", path.to_str().unwrap(), "--json"]);
        assert_eq!(picture["planes"], text["planes"]);
        assert_eq!(picture["found"], "21 x 15 pixels, 7 x 5 cells of 3 x 3 pixels");
    }
    let path = directory.path().join("maze.txt").display().to_string();
    assert_eq!(json(&["autopilot", &path, "--json"])["finished"], true);
    refused(&mut maze_app(&["info", &path, "--up", "y"]), "an up axis is for .obj files");
}

#[test]
fn generated_files_of_all_kinds_are_mazes_of_the_same_passages() {
    let directory = tempfile::tempdir().unwrap();
    let path = |name: &str| directory.path().join(name).display().to_string();
    let generate = |name: &str, more: &[&str]| {
        let out = path(name);
        let arguments =
            [&["generate", "--size", "6x5", "--seed", "3", "--doors", "--out", &out], more].concat();
        assert!(maze_app(&arguments).output().unwrap().status.success());
        json(&["info", &out, "--json"])
    };
    let svg = generate("maze.svg", &["--solution"]);
    assert!(
        svg["found"].as_str().unwrap().starts_with("6 x 5 cells of 16 x 16; the solution drawn in it, "),
        "{svg}"
    );
    let (obj, text) = (generate("maze.obj", &[]), generate("maze.txt", &[]));
    assert_eq!((&obj["planes"], &obj["start"], &obj["goal"]), (&svg["planes"], &svg["start"], &svg["goal"]));
    assert_eq!((&text["planes"], &text["openings"].as_array().unwrap().len()), (&svg["planes"], &2));
    let mut names = names_in(directory.path());
    names.sort();
    assert_eq!(names, ["maze-app.mtl", "maze.obj", "maze.svg", "maze.txt"]);
    let text = std::fs::read_to_string(path("maze.obj")).unwrap();
    assert!(text.contains("\nmtllib maze-app.mtl\n") && text.contains("\ng wall\nusemtl wall\n"));
    refused(&mut maze_app(&["generate", "--out", &path("maze.stl")]), "ends in .obj, .svg or .txt");
    let with_solution = ["generate", "--out", &path("way.txt"), "--solution"];
    refused(&mut maze_app(&with_solution), "--solution is drawn in .svg files only");
}

#[test]
fn generate_knows_every_algorithm_and_prints_what_info_finds() {
    let directory = tempfile::tempdir().unwrap();
    let out = directory.path().join("maze.obj").display().to_string();
    let algorithms: [&[&str]; 7] = [
        &["--algorithm", "wilson", "--braid", "0.5"],
        &["--algorithm", "kruskal"],
        &["--algorithm", "prim"],
        &["--algorithm", "eller", "--braid", "1"],
        &["--algorithm", "growing-tree"],
        &["--elitism", "40"],
        &["--river", "90", "--algorithm", "growing-tree"],
    ];
    for algorithm in algorithms {
        let arguments = ["generate", "--size", "7x6", "--seed", "3", "--out", &out];
        let generated = stdout(&maze_app(&arguments).args(algorithm).output().unwrap());
        let found = stdout(&maze_app(&["info", &out]).output().unwrap());
        let (_, numbers) = generated.split_once('\n').unwrap();
        assert!(numbers.starts_with("path ") && numbers.contains("\ndifficulty "), "{generated}");
        assert!(found.contains(numbers), "{algorithm:?}: {numbers} in {found}");
        let metrics = json(&["info", &out, "--json"])["metrics"].clone();
        assert_eq!(metrics["loops"] == 0, !algorithm.contains(&"--braid"), "{algorithm:?}: {metrics}");
        // The first line of the file makes it again.
        let before = std::fs::read_to_string(&out).unwrap();
        let again = before.lines().next().unwrap().strip_prefix("# maze-app ").unwrap();
        let arguments: Vec<&str> = again.split(' ').chain(["--out", &out]).collect();
        assert!(maze_app(&arguments).output().unwrap().status.success());
        assert_eq!(std::fs::read_to_string(&out).unwrap(), before);
    }
}

#[test]
fn knobs_out_of_range_are_refused_and_nothing_is_written() {
    let directory = tempfile::tempdir().unwrap();
    let out = directory.path().join("maze.obj").display().to_string();
    for (arguments, expected) in [
        (&["--algorithm", "warp"][..], "expected backtracker, wilson, kruskal, prim, growing-tree, eller"),
        (&["--braid", "1.5"], "expected a probability, 0 to 1"),
        (&["--braid=-1"], "expected a probability, 0 to 1"),
        (&["--elitism", "101"], "expected a whole number, 0 to 100"),
        (&["--river", "x"], "expected a whole number, 0 to 100"),
        (
            &["--river", "20", "--algorithm", "prim"],
            "elitism and river are knobs of growing-tree, not of prim",
        ),
        (&["--size", "2000x3"], "a maze of 2000x3 cells: expected at least 2 cells and at most 1024"),
    ] {
        refused(maze_app(&["generate", "--out", &out]).args(arguments), expected);
    }
    assert!(names_in(directory.path()).is_empty());
}

#[test]
fn the_default_maze_is_what_its_first_line_says() {
    let text = std::fs::read_to_string(DEFAULT_MAZE).unwrap();
    let arguments = text.lines().next().unwrap().strip_prefix("# maze-app ").unwrap();
    let (directory, path) = file("other.txt", b"");
    let out = Path::new(&path).with_file_name("default.obj");
    let mut arguments: Vec<&str> = arguments.split(' ').collect();
    arguments.extend(["--out", out.to_str().unwrap()]);
    assert!(maze_app(&arguments).status().unwrap().success());
    assert_eq!(std::fs::read_to_string(out).unwrap(), text);
    drop(directory);
}

/// Runs, expects success, and reads the JSON object that it prints.
#[test]
fn the_autopilot_reaches_the_goal_and_its_recording_ends_in_the_same_state() {
    let directory = tempfile::tempdir().unwrap();
    let record = directory.path().join("run.maze").display().to_string();
    for engine in ["continuous", "published"] {
        let run = json(&[
            "autopilot",
            "--seed",
            "7",
            "--size",
            "8x6",
            "--engine",
            engine,
            "--record",
            &record,
            "--json",
        ]);
        assert_eq!(run["finished"], true);
        let replay = json(&["replay", &record, "--json"]);
        assert_eq!((&replay["same"], &replay["phase"]), (&true.into(), &"finished".into()));
        assert_eq!(replay["ticks"], run["ticks"]);
    }
    let run = json(&["autopilot", DEFAULT_MAZE, "--ball-radius=0.3", "--record", &record, "--json"]);
    assert_eq!(run["finished"], true);
    assert_eq!(json(&["replay", &record, "--json"])["same"], true);
}

#[test]
fn rapier_plays_and_replays_where_it_is_built_in_and_is_refused_where_not() {
    let directory = tempfile::tempdir().unwrap();
    let record = directory.path().join("run.maze").display().to_string();
    let play =
        ["autopilot", "--seed", "7", "--size", "5x4", "--engine", "rapier", "--record", &record, "--json"];
    if cfg!(feature = "rapier") {
        let run = json(&play);
        assert_eq!(run["finished"], true);
        assert_eq!(json(&["replay", &record, "--json"])["same"], true);
    } else {
        refused(&mut maze_app(&play), "built without rapier");
        assert!(names_in(directory.path()).is_empty());
    }
}

#[test]
fn a_recording_of_another_maze_or_a_cut_one_is_refused_and_a_changed_one_ends_elsewhere() {
    let directory = tempfile::tempdir().unwrap();
    let path = |name: &str| directory.path().join(name).display().to_string();
    let (maze, record, cut) = (path("maze.obj"), path("run.maze"), path("cut.maze"));
    let generate = |seed: &str| {
        let arguments = ["generate", "--size", "5x4", "--seed", seed, "--out", &maze];
        assert!(maze_app(&arguments).output().unwrap().status.success());
    };
    generate("1");
    assert!(maze_app(&["autopilot", &maze, "--record", &record]).output().unwrap().status.success());
    let bytes = std::fs::read(&record).unwrap();
    std::fs::write(&cut, &bytes[..bytes.len() - 20]).unwrap();
    refused(&mut maze_app(&["replay", &cut]), "the recording is cut off after");
    refused(&mut maze_app(&["replay", &maze]), "not a recording of a run");
    let mut changed = bytes;
    let tilt_of_an_early_tick = changed.len() - 8 - 4 * 40;
    changed[tilt_of_an_early_tick] ^= 0x55;
    std::fs::write(&cut, &changed).unwrap();
    let output = maze_app(&["replay", &cut]).output().unwrap();
    assert_eq!(output.status.code(), Some(1), "{output:?}");
    assert!(stdout(&output).starts_with("same final state  false"));
    generate("2");
    refused(&mut maze_app(&["replay", &record]), "recorded on another maze");
}

#[test]
fn help_is_complete_and_has_examples() {
    for command in ["play", "info", "generate", "render", "autopilot", "replay"] {
        let output = maze_app(&[command, "--help"]).output().unwrap();
        assert!(output.status.success());
        let text = stdout(&output);
        assert!(text.contains("Example"), "{command}: {text}");
    }
    let text = stdout(&maze_app(&["--help"]).output().unwrap());
    for word in ["play", "info", "generate", "render", "Exit status"] {
        assert!(text.contains(word), "{text}");
    }
}

#[test]
fn help_on_a_full_disk_is_one_line() {
    let full = std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let output = maze_app(&["--help"]).stdout(full).stderr(std::process::Stdio::piped()).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(String::from_utf8_lossy(&output.stderr).lines().count(), 1);
}

#[test]
fn a_reader_that_stops_early_is_no_error() {
    let mut child = maze_app(&["info", DEFAULT_MAZE, "--planes", "+x"])
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    assert!(output.stderr.is_empty());
}

#[test]
fn bad_usage_is_one_line() {
    refused(&mut maze_app(&["--frobnicate"]), "unexpected argument '--frobnicate'");
    refused(&mut maze_app(&["play", "--size", "0x"]), "expected WxH in cells");
    refused(&mut maze_app(&["play", "--size", "1x1"]), "expected at least 2 cells");
    refused(&mut maze_app(&["play", "--level", "0"]), "expected 1 to 14");
    refused(&mut maze_app(&["play", "--level", "3", "--seed", "1"]), "cannot be used with");
    refused(&mut maze_app(&["info", DEFAULT_MAZE, "--level", "3"]), "cannot be used with");
    refused(&mut maze_app(&["play", "--engine", "warp"]), "invalid value 'warp'");
    refused(&mut maze_app(&["play", "--max-tilt", "90"]), "expected 1 to 45 degrees");
    refused(&mut maze_app(&["play", "--exit-after", "nan"]), "expected a number of seconds");
    refused(&mut maze_app(&["play", DEFAULT_MAZE, "--seed", "3"]), "cannot be used with");
    refused(&mut maze_app(&["info"]), "required arguments were not provided");
    refused(&mut maze_app(&["info", DEFAULT_MAZE, "--ball-radius=-1"]), "expected 0.02 to 0.49");
    refused(&mut maze_app(&["info", DEFAULT_MAZE, "--planes", "up"]), "expected +x, -x, +y or -y");
    refused(&mut maze_app(&["render", DEFAULT_MAZE, "--out", "a.png", "--size", "0x9"]), "at least 1x1");
    refused(&mut maze_app(&["render", DEFAULT_MAZE, "--out", "a.jpg"]), "expected a name that ends in .png");
    refused(&mut maze_app(&["render", DEFAULT_MAZE, "--out", "a.png", "--tilt", "99,0"]), "in degrees");
    let known = "expected any of gravity, planes, search, contact, velocity, clearance";
    refused(&mut maze_app(&["render", DEFAULT_MAZE, "--out", "a.png", "--show", "search,quarks"]), known);
}

#[test]
fn bad_maze_files_are_refused_by_every_command_that_reads_one() {
    let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
    let slanted = format!("{square}v 0 0 1\nf 1 2 3 4\nf 2 3 5\n");
    let cases: [(&str, &[u8], &str); 19] = [
        ("empty.obj", b"", "empty.obj: the file is empty"),
        ("binary.obj", b"\x7fELF\0\0", "binary.obj: not a text file"),
        ("vertices_only.obj", square.as_bytes(), "no faces: expected walls"),
        ("range.obj", &[square.as_bytes(), b"f 1 2 9\n"].concat(), "line 5: face uses vertex 9, but only 4"),
        ("cut.obj", &[square.as_bytes(), b"v 1 2"].concat(), "line 5: expected `v X Y Z`"),
        ("words.obj", b"v one two three\n", "line 1: expected `v X Y Z`"),
        ("flat.obj", &[square.as_bytes(), b"f 1 2 3 4\n"].concat(), "no walls"),
        ("slanted.obj", slanted.as_bytes(), "not a maze of axis-aligned walls"),
        ("maze.stl", square.as_bytes(), "expected a name that ends in .obj, .svg, .txt, .png or .bmp"),
        ("maze", square.as_bytes(), "expected a name that ends in .obj, .svg, .txt, .png or .bmp"),
        ("page.svg", b"<html>\n</html>", "page.svg: line 1: the root element is <html>: expected <svg>"),
        ("cut.svg", b"<svg>\n<line x1=\"2\"/>", "line 2: not well-formed XML"),
        (
            "letters.txt",
            b"####\n#q #\n####\n",
            "letters.txt: line 2, column 2: `q`, 1 in all, is neither wall nor free",
        ),
        ("hole.txt", b"#####\n#SO #\n", "line 2, column 3: `O` is reserved for holes"),
        ("solid.txt", b"###\n###\n", "solid.txt: no corridor"),
        ("short.png", b"\x89PNG\r\n\x1a\n", "the picture is cut off after 8 bytes: expected a whole PNG"),
        ("text.bmp", b"###\n", "text.bmp: not a PNG or BMP picture"),
        ("drawing.txt", b"<svg/>", "drawing.txt: is named .txt, but what it holds is .svg: rename it"),
        ("picture.obj", b"\x89PNG\r\n\x1a\n", "is named .obj, but what it holds is .png: rename it"),
    ];
    for (name, bytes, expected) in cases {
        let (directory, path) = file(name, bytes);
        let out = directory.path().join("out.png").display().to_string();
        refused(&mut maze_app(&["info", &path]), expected);
        refused(&mut maze_app(&["play", &path]), expected);
        refused(&mut maze_app(&["render", &path, "--out", &out]), expected);
        assert_eq!(names_in(directory.path()), [name], "nothing was written");
    }
    refused(&mut maze_app(&["info", "/no/such/maze.obj"]), "/no/such/maze.obj: no such file or directory");
    refused(&mut maze_app(&["info", "/"]), "expected a name that ends in .obj");
    refused(&mut maze_app(&["info", "/dev/null"]), "expected a name that ends in .obj");
    let (directory, _) = file("x", b"");
    let fifo = directory.path().join("pipe.obj");
    assert!(Command::new("mkfifo").arg(&fifo).status().unwrap().success());
    refused(
        &mut maze_app(&["info", fifo.to_str().unwrap()]),
        "pipe.obj: is no ordinary file, expected a file",
    );
}

#[test]
fn truncated_maze_files_are_refused() {
    let whole = std::fs::read(DEFAULT_MAZE).unwrap();
    // The first half of the file holds no face.
    for (part, expected) in
        [(2, "no faces"), (3, "cut off"), (5, "cut off"), (10, "cut off"), (50, "cut off")]
    {
        let (_directory, path) = file("cut.obj", &whole[..whole.len() * (part - 1) / part]);
        refused(&mut maze_app(&["info", &path]), expected);
    }
}

#[test]
fn bad_textures_are_refused() {
    let bmp = std::fs::read(concat!(env!("CARGO_MANIFEST_DIR"), "/../assets/textures/wall.bmp")).unwrap();
    let cases: [(&[u8], &str); 3] =
        [(b"not a picture", "wall.bmp"), (b"", "wall.bmp"), (&bmp[..1000], "wall.bmp")];
    for (bytes, expected) in cases {
        let (directory, path) = file("wall.bmp", bytes);
        let textures = Path::new(&path).parent().unwrap().display().to_string();
        let out = directory.path().join("out.png").display().to_string();
        refused(&mut maze_app(&["render", DEFAULT_MAZE, "--out", &out, "--textures", &textures]), expected);
        refused(&mut maze_app(&["play", "--textures", &textures]), expected);
        assert_eq!(names_in(directory.path()), ["wall.bmp"], "nothing was written");
    }
    let (directory, _) = file("readme.txt", b"");
    let textures = directory.path().display().to_string();
    refused(&mut maze_app(&["play", "--textures", &textures]), "wall.bmp: no such file or directory");
}

#[test]
fn no_display_and_no_driver_are_one_line() {
    let mut play = maze_app(&["play"]);
    refused(
        play.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY").env_remove("WAYLAND_SOCKET"),
        "no display",
    );
    let directory = tempfile::tempdir().unwrap();
    let out = directory.path().join("out.png").display().to_string();
    let mut render = maze_app(&["render", DEFAULT_MAZE, "--out", &out]);
    let no_driver = [("WGPU_BACKEND", "vulkan"), ("VK_DRIVER_FILES", "/none"), ("VK_ICD_FILENAMES", "/none")];
    refused(render.envs(no_driver), "no graphics adapter found");
    assert!(names_in(directory.path()).is_empty(), "nothing was written");
}

#[test]
fn an_unwritable_output_is_refused() {
    refused(
        &mut maze_app(&["generate", "--seed", "1", "--out", "/no/such/directory/a.obj"]),
        "/no/such/directory/a.obj: cannot write: expected a file's name in a directory that there is",
    );
}

#[test]
fn a_sidecar_decides_flags_win_and_its_faults_are_told_with_the_line() {
    let directory = tempfile::tempdir().unwrap();
    let maze = directory.path().join("maze.obj");
    std::fs::copy(DEFAULT_MAZE, &maze).unwrap();
    let maze = maze.to_str().unwrap();
    let write = |text: &str| std::fs::write(directory.path().join("maze.toml"), text).unwrap();
    let info = |flags: &[&str]| {
        let output = maze_app(&["info", maze, "--json"]).args(flags).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        serde_json::from_slice::<serde_json::Value>(&output.stdout).unwrap()
    };
    let plain = info(&[]);
    write("up = 'z'\nscale = 1\nball_radius = 0.2\n");
    assert_eq!(info(&[])["ball_radius"], 0.2);
    assert_eq!(info(&["--ball-radius", "0.3"])["ball_radius"], 0.3);
    write(&format!("start = {}\ngoal = {}\n", plain["goal"], plain["start"]));
    let swapped = info(&[]);
    assert_eq!((&swapped["start"], &swapped["goal"]), (&plain["goal"], &plain["start"]));

    write("# mine\ncolour = 'red'\n");
    refused(&mut maze_app(&["info", maze]), "maze.toml: line 2: unknown field `colour`");
    write("ball_radius = 3\n");
    refused(&mut maze_app(&["info", maze]), "maze.toml: line 1: expected 0.02 to 0.49, in corridors");
    write("start = [99, 99]\n");
    refused(&mut maze_app(&["info", maze]), "maze.obj: the ball does not fit at (99, 99)");
    write("textures = 'nowhere'\n");
    refused(&mut maze_app(&["render", maze, "--out", "unused.png"]), "nowhere");
}

#[test]
fn a_negative_number_is_a_bad_value_not_an_unknown_flag() {
    for (flag, value) in [("--size", "-3x4"), ("--braid", "-0.1"), ("--seed", "-1"), ("--river", "-1")] {
        let arguments = ["generate", flag, value, "--out", "x.obj"];
        let output = maze_app(&arguments).output().unwrap();
        let said = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.code() == Some(2) && said.contains("invalid value '-"), "{said}");
    }
}
