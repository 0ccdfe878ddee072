//! Accidents: signals, a window system that is lost or stopped, and a system without room for another thread.
#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod desk;

use desk::{Killed, MAZE, PATIENCE, Session, output_of, start, until};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Signals that end a program, and their numbers.
const SIGNALS: [(&str, i32); 4] = [("INT", 2), ("TERM", 15), ("HUP", 1), ("QUIT", 3)];

fn maze_app(directory: &Path, arguments: &[&str]) -> Killed {
    let mut command = Command::new(env!("CARGO_BIN_EXE_maze-app"));
    command.args(arguments).current_dir(directory).env("XDG_RUNTIME_DIR", directory);
    start(command.stdout(Stdio::null()).stderr(Stdio::null()))
}

fn send(child: &Killed, signal: &str) {
    let id = child.0.id().to_string();
    // The shell's own: a bare system has no program of that name.
    let line = format!("kill -s {signal} {id}");
    assert!(output_of("sh", "", &["-c", &line]).is_some(), "{line}");
}

fn exit_code(child: &mut Killed) -> Option<i32> {
    until("the command to end", || child.0.try_wait().unwrap()).code()
}

/// Names and sizes of the files in a directory.
fn files(directory: &Path) -> Vec<(String, u64)> {
    let entries = std::fs::read_dir(directory).unwrap().map(Result::unwrap);
    // A temporary file may be gone by now.
    let sized = entries
        .filter_map(|entry| Some((entry.file_name().into_string().unwrap(), entry.metadata().ok()?.len())));
    sized.collect()
}

/// `generate` at the moment when its temporary file has some bytes; `None` when it ended before it was seen.
fn caught_while_writing(directory: &Path) -> Option<Killed> {
    let mut generate =
        maze_app(directory, &["generate", "--size", "500x500", "--seed", "1", "--out", "g.obj"]);
    let begun = Instant::now();
    while generate.0.try_wait().unwrap().is_none() {
        if files(directory).iter().any(|(name, n_bytes)| name.starts_with(".tmp") && 0 < *n_bytes) {
            return Some(generate);
        }
        assert!(begun.elapsed() < PATIENCE, "nothing is written");
        std::thread::sleep(Duration::from_millis(1));
    }
    None
}

#[test]
fn r1_a_signal_while_an_output_is_written_leaves_no_temporary_file() {
    // A fast disk may take the whole file between two looks, and the program may end before the signal arrives.
    const N_TRIES: usize = 50;
    for (signal, number) in SIGNALS {
        let ended_by_signal = (0..N_TRIES).any(|_| {
            let scratch = tempfile::tempdir().unwrap();
            let Some(mut generate) = caught_while_writing(scratch.path()) else { return false };
            send(&generate, signal);
            let code = exit_code(&mut generate);
            let left = files(scratch.path());
            assert!(left.iter().all(|(name, _)| !name.starts_with(".tmp")), "SIG{signal} left {left:?}");
            assert!([Some(0), Some(128 + number)].contains(&code), "SIG{signal} ended with {code:?}");
            code != Some(0)
        });
        assert!(ended_by_signal, "SIG{signal}: the output was written too fast {N_TRIES} times");
    }
}

#[test]
fn r2_frames_ended_by_a_signal_write_what_there_is() {
    for (signal, number) in SIGNALS {
        let scratch = tempfile::tempdir().unwrap();
        let csv = scratch.path().join("f.csv");
        let words = ["frames", "--offscreen", "--size", "64x64", "--seconds", "600", "--csv", "f.csv"];
        let mut frames = maze_app(scratch.path(), &words);
        // The first frame takes as long as the driver needs.
        std::thread::sleep(Duration::from_secs(4));
        send(&frames, signal);
        assert_eq!(exit_code(&mut frames), Some(128 + number), "SIG{signal}");
        assert!(std::fs::read_to_string(csv).unwrap().starts_with("frame,time_s"), "SIG{signal}");
    }
}

/// The game with a recording, after some ticks.
fn played(record: &str) -> Session {
    let mut session = Session::open(&[&MAZE[..], &["--record", record]].concat());
    session.xdotool(&["keydown", "Right"]);
    session.wait_for("some ticks", |state| 20 < state.clock_ticks);
    session
}

/// What was recorded ends in the same state.
fn expect_recording(session: &Session) {
    let mut replay = maze_app(session.directory.path(), &["replay", "r.maze"]);
    assert_eq!(exit_code(&mut replay), Some(0));
    let left = files(session.directory.path());
    assert!(left.iter().all(|(name, _)| !name.starts_with(".tmp")), "{left:?}");
}

#[test]
fn r2_a_game_ended_by_a_signal_saves_what_was_played() {
    for (signal, number) in SIGNALS {
        let mut session = played("r.maze");
        send(&session.game, signal);
        assert_eq!(session.exit_status().code(), Some(128 + number), "SIG{signal}");
        expect_recording(&session);
    }
}

#[test]
fn r3_a_lost_window_system_saves_what_was_played_and_is_exit_status_2() {
    for kill_server in [false, true] {
        let mut session = played("r.maze");
        if kill_server {
            send(&session.screen.server, "KILL");
        } else {
            let window = session.window.clone();
            session.xdotool(&["windowkill", &window]);
        }
        assert_eq!(session.exit_status().code(), Some(2));
        expect_recording(&session);
    }
}

#[test]
fn r18_exit_after_ends_with_a_window_system_that_has_stopped() {
    let mut session = Session::open(&[&MAZE[..], &["--record", "r.maze", "--exit-after", "5"]].concat());
    session.xdotool(&["keydown", "Right"]);
    session.wait_for("some ticks", |state| 20 < state.clock_ticks);
    send(&session.screen.server, "STOP");
    let status = session.exit_status();
    send(&session.screen.server, "CONT");
    assert_eq!(status.code(), Some(2));
    expect_recording(&session);
}

#[test]
fn r18_the_clock_stands_while_the_game_is_stopped() {
    let mut session = played("r.maze");
    send(&session.game, "STOP");
    // A tick may be on its way to the log.
    std::thread::sleep(Duration::from_millis(300));
    let before = session.last().tick;
    std::thread::sleep(Duration::from_secs(3));
    assert_eq!(session.last().tick, before);
    send(&session.game, "CONT");
    session.expect_alive("the game to go on");
    send(&session.game, "INT");
    assert_eq!(session.exit_status().code(), Some(130));
    expect_recording(&session);
}

#[cfg(target_os = "linux")]
#[test]
fn r7_without_room_for_a_thread_a_maze_is_read_all_the_same() {
    use std::os::unix::fs::{MetadataExt, PermissionsExt};
    let scratch = tempfile::tempdir().unwrap();
    let at = |name: &str| scratch.path().join(name);
    // Another user must be able to run it.
    std::fs::set_permissions(scratch.path(), std::fs::Permissions::from_mode(0o755)).unwrap();
    std::fs::copy(env!("CARGO_BIN_EXE_maze-app"), at("maze-app")).unwrap();
    let maze = concat!(env!("CARGO_MANIFEST_DIR"), "/../assets/mazes/default.obj");
    std::fs::copy(maze, at("m.obj")).unwrap();
    // The limit does not hold for root. A terminal is needed, as a spinner is shown on one only.
    let is_root = std::fs::metadata("/proc/self").unwrap().uid() == 0;
    let user = if is_root { "setpriv --reuid=65534 --regid=65534 --clear-groups " } else { "" };
    let line = format!("{user}prlimit --nproc=1 ./maze-app info m.obj");
    let mut script = Command::new("script");
    script.args(["--quiet", "--return", "--command", &line, "/dev/null"]).current_dir(scratch.path());
    let output = script.stdin(Stdio::null()).output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success() && text.contains("solvable     true"), "{text}");
}
