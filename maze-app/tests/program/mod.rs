//! The program on its command line, as tests run it.
#![allow(dead_code, unreachable_pub, missing_docs, reason = "each test uses a part of it")]

use std::path::Path;
use std::process::{Command, Output};

pub const DEFAULT_MAZE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../assets/mazes/default.obj");

/// The program, with no display to open a window on.
pub fn maze_app(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_maze-app"));
    command.args(arguments).env("XDG_RUNTIME_DIR", std::env::temp_dir());
    command.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY");
    command
}

/// The same in a directory.
pub fn maze_app_in(directory: &Path, arguments: &[&str]) -> Command {
    let mut command = maze_app(arguments);
    command.current_dir(directory).env("XDG_RUNTIME_DIR", directory);
    command
}

/// Runs, and expects success; what it printed.
pub fn works(command: &mut Command) -> String {
    let output = command.output().expect("the program starts");
    assert!(output.status.success(), "{command:?}: {}", String::from_utf8_lossy(&output.stderr));
    stdout(&output)
}

/// Runs, and expects exit status 2, nothing on stdout, and one line on stderr that holds `expected`.
pub fn refused(command: &mut Command, expected: &str) {
    let output = command.output().expect("the program starts");
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{command:?}: {stderr}");
    assert_eq!(stderr.lines().count(), 1, "{command:?}: {stderr}");
    assert!(stderr.starts_with("maze-app: "), "{stderr}");
    assert!(stderr.contains(expected), "expected `{expected}` in: {stderr}");
    assert!(!stderr.trim_end().contains(char::is_control), "{stderr:?}");
    assert!(output.stdout.is_empty(), "{command:?}");
}

pub fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).expect("UTF-8")
}

/// Runs, and expects success and one JSON object.
pub fn json(command: &mut Command) -> serde_json::Value {
    serde_json::from_str(&works(command)).expect("JSON")
}
