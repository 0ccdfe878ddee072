//! F11 on the command line: how a text is read can be stated, beside the file and by flags, and a recording keeps it.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod program;

use program::maze_app_in;
use std::path::Path;

/// The walls of this one could be either sign.
const STRIPES: &str = "00000\n11111\n00000\n11111\n00000\n";

/// Runs in a directory; exit status, stdout and stderr.
fn run(directory: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = maze_app_in(directory, arguments).output().unwrap();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (output.status.code(), text(&output.stdout), text(&output.stderr))
}

fn directory(files: &[(&str, &str)]) -> tempfile::TempDir {
    let directory = tempfile::tempdir().unwrap();
    for (name, text) in files {
        std::fs::write(directory.path().join(name), text).unwrap();
    }
    directory
}

#[test]
fn f11_what_is_ambiguous_names_the_key_that_decides_and_the_key_decides() {
    let directory = directory(&[("m.txt", "0101\n0101\n0101\n0101\n")]);
    let (status, _, stderr) = run(directory.path(), &["info", "m.txt"]);
    assert_eq!(status, Some(2));
    assert_eq!(stderr, "maze-app: m.txt: wall can be `0` or `1`: expected text.wall to say which\n");
    let (_, stdout, _) = run(directory.path(), &["info", "m.txt", "--text", "wall=0"]);
    assert!(stdout.contains("wall `0`, free `1`"), "{stdout}");
    std::fs::write(directory.path().join("m.toml"), "text.wall = '1'\n").unwrap();
    let (_, stdout, _) = run(directory.path(), &["info", "m.txt"]);
    assert!(stdout.contains("wall `1`, free `0`"), "{stdout}");
    // A flag goes before what stands beside the file.
    let (_, stdout, _) = run(directory.path(), &["info", "m.txt", "--text=wall=0"]);
    assert!(stdout.contains("wall `0`, free `1`"), "{stdout}");
}

#[test]
fn f11_a_recording_keeps_how_the_text_was_read() {
    let directory = directory(&[("m.txt", STRIPES)]);
    let record = ["autopilot", "m.txt", "--text", "wall=0", "--text", "free=1", "--record", "r.maze"];
    let (status, _, stderr) = run(directory.path(), &record);
    assert_eq!(status, Some(0), "{stderr}");
    let (status, stdout, stderr) = run(directory.path(), &["replay", "r.maze"]);
    assert_eq!(status, Some(0), "{stdout}{stderr}");
}

#[test]
fn f11_signs_that_say_nothing_are_refused() {
    let directory = directory(&[
        ("m.txt", STRIPES),
        ("m.svg", "<svg/>"),
        ("n.txt", "###\n"),
        ("n.toml", "[text]\nwalls = '#'\n"),
    ]);
    let cases: [(&[&str], &str); 5] = [
        (&["m.txt", "--text", "walls=#"], "expected wall=SIGNS, free=SIGNS, start=SIGN or goal=SIGN"),
        (&["m.txt", "--text", "wall="], "expected wall=SIGNS"),
        (&["m.txt", "--text", "start=q"], "text.start is `q`, which is nowhere in the file"),
        (&["m.svg", "--text", "wall=#"], "text signs are for .txt files"),
        (&["n.txt"], "line 2: unknown field `walls`"),
    ];
    for (arguments, expected) in cases {
        let (status, _, stderr) = run(directory.path(), &[&["info"], arguments].concat());
        assert_eq!((status, stderr.lines().count()), (Some(2), 1), "{stderr}");
        assert!(stderr.contains(expected), "{stderr}");
    }
}
