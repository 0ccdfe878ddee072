//! What a command writes: checked before the work, never over its input, and readable again.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod program;

use program::{DEFAULT_MAZE, maze_app_in};
use std::path::Path;
use std::process::Command;

fn refused(directory: &Path, arguments: &[&str], expected: &str) {
    program::refused(&mut maze_app_in(directory, arguments), expected);
}

fn works(directory: &Path, arguments: &[&str]) -> String {
    program::works(&mut maze_app_in(directory, arguments))
}

/// A directory with a maze `m.obj`.
fn with_maze() -> tempfile::TempDir {
    let directory = tempfile::tempdir().unwrap();
    std::fs::copy(DEFAULT_MAZE, directory.path().join("m.obj")).unwrap();
    directory
}

/// A recording that only its words tell from another: no ticks, other hashes.
fn recording(words: &[&str]) -> Vec<u8> {
    let name = |name: &str| [&(name.len() as u64).to_le_bytes()[..], name.as_bytes()].concat();
    let constants: Vec<u8> = [0.35, 0.8, 1.0, 0.0, 0.03_f64].into_iter().flat_map(f64::to_le_bytes).collect();
    let version = maze_core::replay::VERSION.to_le_bytes();
    let head = [b"MAZERUN\n", &version[..], &name(&words.join("\n")), &name("continuous"), &[0; 8]].concat();
    [head, constants, vec![0; 16]].concat()
}

#[test]
fn r4_a_game_that_never_began_leaves_the_old_recording() {
    let directory = tempfile::tempdir().unwrap();
    let run = directory.path().join("r.maze");
    std::fs::write(&run, "OLD").unwrap();
    refused(directory.path(), &["play", "--seed", "7", "--record", "r.maze"], "no display");
    refused(directory.path(), &["play", "--record", "r.maze", "--state-log", "no/log"], "no/log");
    assert_eq!(std::fs::read_to_string(&run).unwrap(), "OLD");
}

#[test]
fn r5_an_output_is_no_input_and_no_other_output_by_whatever_name() {
    let scratch = with_maze();
    let directory = scratch.path();
    let before = std::fs::read(directory.join("m.obj")).unwrap();
    std::fs::create_dir(directory.join("sub")).unwrap();
    let mut names = vec!["m.obj", "./m.obj", "sub/../m.obj"];
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("m.obj", directory.join("link")).unwrap();
        std::os::unix::fs::symlink("new", directory.join("to-new")).unwrap();
        std::fs::hard_link(directory.join("m.obj"), directory.join("hard")).unwrap();
        names.extend(["link", "hard"]);
    }
    for name in names {
        let same = "are one file: expected two";
        refused(directory, &["autopilot", "m.obj", "--record", name], same);
        refused(directory, &["play", "m.obj", "--record", name], same);
        refused(directory, &["play", "m.obj", "--state-log", name], same);
        refused(directory, &["frames", "m.obj", "--offscreen", "--csv", name], same);
        assert_eq!(std::fs::read(directory.join("m.obj")).unwrap(), before, "{name}");
    }
    // What a maze brings with it is an input too, and so is a material that is written beside one.
    std::fs::write(directory.join("m.toml"), "").unwrap();
    refused(directory, &["autopilot", "m.obj", "--record", "./m.toml"], "are one file");
    std::fs::write(directory.join("sub/wall.png"), "").unwrap();
    let render = ["render", "m.obj", "--textures", "sub", "--out", "./sub/wall.png"];
    refused(directory, &render, "--out and a texture are one file");
    std::fs::create_dir(directory.join("sub/maze-app.mtl")).unwrap();
    refused(
        directory,
        &["generate", "--size", "1024x1024", "--out", "sub/x.obj"],
        "maze-app.mtl: cannot write",
    );
    // Of two outputs none needs to be there yet.
    let mut pairs = vec![["n.svg", "./n.svg"], ["n.svg", "sub/../n.svg"]];
    if cfg!(unix) {
        pairs.push(["new", "to-new"]);
    }
    for [one, other] in pairs {
        refused(directory, &["play", "--record", one, "--state-log", other], "are one file");
    }
    refused(directory, &["frames", "--offscreen", "--csv", "n.svg", "--plot", "./n.svg"], "are one file");
    assert!(!directory.join("n.svg").exists() && !directory.join("new").exists());
}

#[test]
fn r6_what_a_recording_cannot_hold_is_refused_before_the_work_and_the_longest_it_can_is_read() {
    let scratch = with_maze();
    let at = |n: usize| format!("{}m.obj", "./".repeat(n));
    // "--" and the name make 4094 bytes; with "--ball-radius=0.35" they are too many.
    let longest = at(2043);
    refused(
        scratch.path(),
        &["autopilot", &longest, "--ball-radius", "0.35", "--record", "r.maze"],
        "bytes to name this maze: a recording takes at most 4096",
    );
    refused(scratch.path(), &["play", &longest, "--up", "z", "--record", "r.maze"], "at most 4096");
    works(scratch.path(), &["autopilot", &longest, "--record", "r.maze"]);
    works(scratch.path(), &["replay", "r.maze"]);
}

#[cfg(target_os = "linux")]
#[test]
fn r6_a_name_that_a_recording_cannot_write_is_refused_before_the_work() {
    use std::os::unix::ffi::OsStrExt;
    let scratch = with_maze();
    for name in [&b"\xff.obj"[..], b"a\nb.obj"] {
        let name = std::ffi::OsStr::from_bytes(name);
        std::fs::copy(DEFAULT_MAZE, scratch.path().join(name)).unwrap();
        let mut command = Command::new(env!("CARGO_BIN_EXE_maze-app"));
        command.current_dir(scratch.path()).arg("autopilot").arg(name).args(["--record", "run.maze"]);
        let output = command.output().unwrap();
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.code() == Some(2) && stderr.contains("UTF-8"), "{stderr}");
        assert!(output.stdout.is_empty() && !scratch.path().join("run.maze").exists());
    }
}

#[cfg(target_os = "linux")]
#[test]
fn r11_a_file_is_measured_while_it_is_read() {
    let scratch = with_maze();
    // It says to be empty, and gives as much as is asked for.
    std::os::unix::fs::symlink("/proc/self/pagemap", scratch.path().join("p.obj")).unwrap();
    refused(scratch.path(), &["info", "p.obj"], "p.obj: ");
    std::fs::write(scratch.path().join("m.toml"), "\n".repeat((1 << 16) + 1)).unwrap();
    refused(scratch.path(), &["info", "m.obj"], "m.toml: 65537 bytes, expected at most 65536");
    std::fs::write(scratch.path().join("m.toml"), "\n".repeat(1 << 16)).unwrap();
    works(scratch.path(), &["info", "m.obj"]);
}

#[test]
fn r12_a_recording_asks_for_no_more_than_can_be_recorded() {
    let scratch = tempfile::tempdir().unwrap();
    for (size, expected) in [
        ("--size=1023x1023", "r.maze: a random maze of 1046529 cells: a recording takes at most 65536"),
        ("--size=257x256", "at most 65536"),
        ("--size=8x8", "another maze"),
    ] {
        let words = [size, "--seed=1", "--algorithm=wilson"];
        std::fs::write(scratch.path().join("r.maze"), recording(&words)).unwrap();
        refused(scratch.path(), &["replay", "r.maze"], expected);
    }
    let too_large = ["autopilot", "--size", "257x256", "--seed", "1", "--record", "r.maze"];
    refused(scratch.path(), &too_large, "a recording takes at most 65536");
}

#[test]
fn r13_r17_nothing_from_outside_reaches_the_terminal_as_it_is() {
    let scratch = tempfile::tempdir().unwrap();
    let harmful = "\u{1b}[2J\u{9b}31m\u{7}\u{7f}\u{202e}\u{2028}";
    let long = "9".repeat(4000);
    let file = |name: &str, text: &str| std::fs::write(scratch.path().join(name), text).unwrap();
    file("e.obj", &format!("v {harmful} 0 0\n"));
    file("e.svg", &format!("<svg><line x1=\"{harmful}\"/></svg>"));
    file("e.txt", &format!("###\n#{harmful}#\n###\n"));
    file("l.obj", &format!("v {long} x 0\n"));
    std::fs::write(scratch.path().join("r.maze"), recording(&["--bogus", harmful])).unwrap();
    for name in ["e.obj", "e.svg", "e.txt", "l.obj"] {
        refused(scratch.path(), &["info", name], name);
    }
    refused(scratch.path(), &["replay", "r.maze"], "damaged");
    let named = format!("x{}\u{1b}]0;x\u{7}.obj", "\u{202e}");
    refused(scratch.path(), &["info", &named], "x\\u{202e}\\u{1b}]0;x\\u{7}.obj: no such file");
    for flag in [["--seed", harmful], ["--seed", &long], ["--size", harmful], ["--engine", harmful]] {
        refused(scratch.path(), &[&["generate", "--out", "x.txt"], &flag[..]].concat(), "(see --help)");
    }
    let line = maze_app_in(scratch.path(), &["info", "l.obj"]).output().unwrap().stderr;
    assert!(line.len() < 1500, "{}", String::from_utf8_lossy(&line));
}

#[test]
fn r14_a_second_file_and_a_subcommand_that_comes_late_are_called_so() {
    let scratch = with_maze();
    refused(scratch.path(), &["m.obj", "n.obj"], "found a second file n.obj: expected one maze");
    refused(scratch.path(), &["--exit-after", "1", "info", "m.obj"], "the subcommand info must come first");
}

#[cfg(unix)]
#[test]
fn r15_where_nothing_can_be_written_is_said_before_the_work() {
    let scratch = with_maze();
    std::fs::create_dir(scratch.path().join("directory.png")).unwrap();
    for directory in ["no", "m.obj"] {
        let out = |name: &str| format!("{directory}/{name}");
        let (obj, png, run) = (out("x.obj"), out("x.png"), out("x.maze"));
        // None of these mazes can be read: only the output was looked at.
        refused(scratch.path(), &["render", "none.obj", "--out", &png], &png);
        refused(scratch.path(), &["autopilot", "none.obj", "--record", &run], &run);
        refused(scratch.path(), &["frames", "none.obj", "--offscreen", "--csv", &run], &run);
        refused(scratch.path(), &["play", "none.obj", "--state-log", &run], &run);
        refused(scratch.path(), &["generate", "--size", "1024x1024", "--out", &obj], &obj);
    }
    refused(scratch.path(), &["render", "none.obj", "--out", "directory.png"], "directory.png");
    // Nothing is left of having tried.
    assert_eq!(std::fs::read_dir(scratch.path()).unwrap().count(), 2);
}

#[cfg(unix)]
#[test]
fn r16_an_output_keeps_its_mode_and_a_link_stays_a_link() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let scratch = tempfile::tempdir().unwrap();
    let at = |name: &str| scratch.path().join(name);
    std::fs::write(at("target.txt"), "OLD").unwrap();
    std::fs::set_permissions(at("target.txt"), std::fs::Permissions::from_mode(0o600)).unwrap();
    symlink("target.txt", at("link.txt")).unwrap();
    symlink("between.txt", at("ahead.txt")).unwrap();
    symlink("later.txt", at("between.txt")).unwrap();
    for name in ["link.txt", "ahead.txt"] {
        works(scratch.path(), &["generate", "--seed", "1", "--size", "4x4", "--out", name]);
    }
    for name in ["link.txt", "ahead.txt", "between.txt"] {
        assert!(std::fs::symlink_metadata(at(name)).unwrap().file_type().is_symlink(), "{name}");
    }
    let text = |name: &str| std::fs::read_to_string(at(name)).unwrap();
    assert_eq!(text("target.txt"), text("later.txt"));
    assert!(text("target.txt").starts_with('#') || text("target.txt").starts_with('+'));
    assert_eq!(std::fs::metadata(at("target.txt")).unwrap().permissions().mode() & 0o777, 0o600);
    // A link to itself is no place to write to.
    symlink("round.txt", at("round.txt")).unwrap();
    refused(scratch.path(), &["generate", "--out", "round.txt"], "round.txt: ");
}

#[test]
fn f17_what_generate_writes_is_read_and_more_is_refused_before_the_work() {
    let scratch = tempfile::tempdir().unwrap();
    let limit = maze_core::MAX_GRID_CELLS;
    for name in ["m.txt", "m.svg"] {
        // Kruskal's mazes have the most faces.
        for [width, height] in [[256, 256], [64, 1024]] {
            assert_eq!(width * height, limit, "as much as there may be");
            let size = format!("{width}x{height}");
            let how = ["--algorithm", "kruskal", "--seed", "1", "--size", &size];
            works(scratch.path(), &[&["generate", "--out", name], &how[..]].concat());
            works(scratch.path(), &["info", name]);
        }
        std::fs::remove_file(scratch.path().join(name)).unwrap();
        refused(
            scratch.path(),
            &["generate", "--size", "257x256", "--out", name],
            "expected at most 65536 in a .",
        );
        assert!(!scratch.path().join(name).exists());
    }
    refused(scratch.path(), &["generate", "--size", "1025x2", "--out", "m.obj"], "at most 1024 on a side");
}
