//! The game in a real window, see `desk`.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod desk;

use desk::{MAX_TILT_DEGREES, MAZE, Screen, Session, State, output_of, until};
use std::path::Path;
use std::process::Command;
use std::time::Duration;

#[test]
fn mouse_and_keys_play_the_game() {
    let mut session = Session::open(&MAZE);
    let start = session.last();
    assert_eq!((start.phase.as_str(), start.clock_ticks), ("ready", 0));
    assert_eq!(start.orientation, [1.0, 0.0, 0.0, 0.0]);

    // Drag to the right: the right side goes down, and a ball that is free to move runs there.
    let window = session.window.clone();
    session.xdotool(&["mousemove", "--window", &window, "500", "360", "mousedown", "1"]);
    session.xdotool(&["mousemove_relative", "60", "0"]);
    let dragged = session.wait_for("a drag to tilt the board", |state| 3.0 < state.tilt_degrees());
    assert!(0.0 < dragged.orientation[2], "down towards +x is a turn about +y: {dragged:?}");
    assert_eq!(dragged.phase, "playing");

    // Drag in a circle far beyond the limit: it holds all the way round, and downhill the ball gets fast.
    for (x, y) in [(400, 0), (0, 400), (-800, 0), (0, -800), (800, 0)] {
        session.xdotool(&["mousemove_relative", "--", &x.to_string(), &y.to_string()]);
        std::thread::sleep(Duration::from_millis(150));
    }
    session.wait_for("the limit to be nearly reached", |state| 18.0 < state.tilt_degrees());
    let states = session.states();
    let steepest = states.iter().map(State::tilt_degrees).fold(0.0, f64::max);
    assert!(steepest <= MAX_TILT_DEGREES, "{steepest} degrees");
    for pair in states.windows(2).filter(|pair| pair[0].speed() == 0.0 && pair[1].speed() != 0.0) {
        let [_, x, y, _] = pair[1].orientation.map(|part| part * 2.0);
        let downhill = pair[1].velocity[0] * y - pair[1].velocity[1] * x;
        assert!(0.0 < downhill, "from rest the ball moves downhill: {:?}", pair[1]);
    }
    assert!(states.iter().any(|state| 0.5 < state.speed()), "the ball accelerates");
    session.xdotool(&["mouseup", "1"]);

    session.xdotool(&["key", "t"]);
    session.wait_for("T to level the board", |state| state.orientation == [1.0, 0.0, 0.0, 0.0]);

    session.xdotool(&["key", "r"]);
    let restarted = session.wait_for("R to restart", |state| state.clock_ticks == 0);
    assert_eq!((restarted.position, restarted.velocity), (start.position, [0.0, 0.0]));

    session.xdotool(&["keydown", "Up"]);
    let up = session.wait_for("an arrow key to tilt", |state| 10.0 < state.tilt_degrees());
    assert!(up.orientation[1] < 0.0, "down towards +y is a turn about -x: {up:?}");
    session.xdotool(&["keyup", "Up"]);
    session.wait_for("the board to return", |state| state.orientation == [1.0, 0.0, 0.0, 0.0]);
    session.xdotool(&["key", "d"]);
    session.wait_for("a tap on D to be felt", |state| 0.5 < state.tilt_degrees());

    session.close();
    assert!(session.exit_status().success());
}

#[test]
fn the_goal_stops_the_clock_r_starts_again_and_keys_go_on_to_other_mazes() {
    // Two cells: the goal is at the other end of a straight corridor.
    let scratch = tempfile::tempdir().unwrap();
    let run = scratch.path().join("run.maze").display().to_string();
    let mut session = Session::open(&["--size", "2x1", "--record", &run]);
    let start = session.last();
    let key = if start.position[0] < 0.0 { "Right" } else { "Left" };
    session.xdotool(&["keydown", key]);
    let finished = session.wait_for("the goal", |state| state.phase == "finished");
    session.xdotool(&["keyup", key]);
    session.expect_alive("the goal");
    assert_eq!(session.last().clock_ticks, finished.clock_ticks);
    assert!(start.position[0] * finished.position[0] < 0.0, "the goal is on the other side");
    session.xdotool(&["key", "r"]);
    let again = session.wait_for("R to start again", |state| state.phase == "ready");
    assert_eq!((again.position, again.clock_ticks), (start.position, 0));

    session.xdotool(&["key", "Return"]);
    session.expect_alive("Enter before the goal");
    assert_eq!(session.last().position, start.position, "Enter goes on from the goal only");
    session.xdotool(&["keydown", key]);
    session.wait_for("the goal again", |state| state.phase == "finished");
    session.xdotool(&["keyup", key]);
    session.xdotool(&["key", "Return"]);
    session.wait_for("Enter to bring a new maze", |state| state.phase != "finished");
    for (key, title) in [("Next", "Level 1 "), ("Next", "Level 2 "), ("n", "Level 3 "), ("Prior", "Level 2 ")]
    {
        session.xdotool(&["key", key]);
        until(title, || {
            let windows =
                Command::new("wmctrl").arg("-l").env("DISPLAY", &session.screen.display).output().unwrap();
            String::from_utf8_lossy(&windows.stdout).contains(title).then_some(())
        });
        session.expect_alive(title);
    }
    session.close();
    assert!(session.exit_status().success());
    // The run that reached the goal was kept, and ends there again.
    let replay = Command::new(env!("CARGO_BIN_EXE_maze-app")).args(["replay", &run]).output().unwrap();
    let said = String::from_utf8(replay.stdout).unwrap();
    assert!(replay.status.success() && said.contains("same final state  true"), "{said}");
    assert!(said.contains("finished"), "{said}");
}

#[test]
fn zoom_keys_move_the_camera_within_limits() {
    let mut session = Session::open(&[&MAZE[..], &["--keys", "report"]].concat());
    let whole = session.last().camera_distance;
    session.xdotool(&["key", "b"]);
    session.wait_for("B to zoom in", |state| state.camera_distance < 0.95 * whole);
    session.xdotool(&["key", "s", "s"]);
    session.wait_for("S to zoom out", |state| 1.05 * whole < state.camera_distance);
    session.xdotool(&["key", "--repeat", "40", "--delay", "15", "b"]);
    let near = session.wait_for("the near limit", |state| state.camera_distance < 0.17 * whole);
    session.expect_alive("zooming in");
    assert!(0.16 * whole < near.camera_distance.min(session.last().camera_distance));
    session.xdotool(&["key", "--repeat", "40", "--delay", "15", "s"]);
    session.wait_for("the far limit", |state| 1.95 * whole < state.camera_distance);
    session.expect_alive("zooming out");
    assert!(session.last().camera_distance < 2.05 * whole);
    session.tool("wmctrl", &["-c", "Maze"]);
    assert!(session.exit_status().success(), "closing the window is a good end");
}

#[test]
fn tiny_minimised_and_restored_windows_stay_alive() {
    let mut session = Session::open(&MAZE);
    let window = session.window.clone();
    for (width, height) in [("1", "1"), ("300", "60"), ("60", "700"), ("900", "600")] {
        session.xdotool(&["windowsize", &window, width, height]);
        session.expect_alive("a resized window");
    }
    session.xdotool(&["windowminimize", &window]);
    std::thread::sleep(Duration::from_millis(500));
    let hidden = session.last().tick;
    std::thread::sleep(Duration::from_millis(500));
    let later = session.last().tick;
    assert!(later <= hidden + 2, "a minimised game pauses: {hidden} to {later}");
    session.xdotool(&["windowmap", &window]);
    session.xdotool(&["windowactivate", &window]);
    session.expect_alive("the restored window");
    session.tool("wmctrl", &["-c", "Maze"]);
    assert!(session.exit_status().success());
}

#[test]
fn keys_show_ghosts_change_the_quality_show_frame_times_fill_the_screen_and_save_pictures() {
    let mut session = Session::open(&MAZE);
    for key in ["g", "r", "g", "n", "g", "g", "F3", "q", "q", "q", "F3", "F11"] {
        session.xdotool(&["key", key]);
        session.expect_alive(key);
    }
    for (number, [width, height]) in [("0001", [1400, 900]), ("0002", [1280, 720])] {
        until("the window's size", || {
            let line = output_of("wmctrl", &session.screen.display, &["-lG"])?;
            let words: Vec<&str> = line.split_whitespace().collect();
            (words.get(4..6)? == [width.to_string(), height.to_string()]).then_some(())
        });
        session.expect_alive("a window of another size");
        session.xdotool(&["key", "F12"]);
        let path = session.directory.path().join(format!("maze-{number}.png"));
        let size = until("a picture", || image::image_dimensions(&path).ok());
        assert_eq!(size, (width, height));
        session.xdotool(&["key", "F11"]);
    }
    assert!(!session.directory.path().join("maze-0003.png").exists());
    session.close();
    assert!(session.exit_status().success());
}

/// A pixel of the window and of the offscreen picture is the same within a rounding of colour; the formats differ.
const PIXEL_TOLERANCE: u8 = 6;

/// Most pixels that may differ by more: the ball came to rest from another bounce, so its pattern and what a contact's panel
/// says may differ in a last digit.
const MAX_DIFFERENT_FRACTION: f64 = 0.002;

fn different_part(a: &Path, b: &Path) -> f64 {
    let [a, b] = [a, b].map(|path| image::open(path).unwrap().into_rgb8());
    assert_eq!(a.dimensions(), b.dimensions());
    let differs = |(a, b): &(&image::Rgb<u8>, &image::Rgb<u8>)| {
        a.0.iter().zip(b.0).any(|(a, b)| PIXEL_TOLERANCE < a.abs_diff(b))
    };
    let n_different = a.pixels().zip(b.pixels()).filter(differs).count();
    n_different as f64 / f64::from(a.width() * a.height())
}

#[test]
fn a_pause_holds_the_ticks_and_each_overlay_is_as_render_draws_it() {
    // Held to the right, the ball of level 1 comes to rest at the wall beside its start.
    let mut session = Session::open_with(&["--level", "1", "--max-tilt", "10"]);
    session.xdotool(&["keydown", "Right"]);
    let resting = session.wait_for("the ball to have rested at the wall", |state| {
        let rests = state.velocity == [0.0, 0.0];
        rests && 9.0 < state.tilt_degrees() && 300 < state.clock_ticks
    });
    session.xdotool(&["key", "p"]);
    std::thread::sleep(Duration::from_millis(500));
    let paused = session.last().tick;
    std::thread::sleep(Duration::from_millis(500));
    assert_eq!(session.last().tick, paused, "a pause holds the ticks");
    for n in 1..=3 {
        session.xdotool(&["key", "period"]);
        until("a single step", || (session.last().tick == paused + n).then_some(()));
    }
    session.xdotool(&["key", "h"]);
    let layers = ["gravity", "planes", "search", "contact", "velocity", "clearance"];
    for (n, layer) in (1..).zip(layers) {
        session.xdotool(&["key", "0", &format!("{n}")]);
        // Until a frame shows it.
        std::thread::sleep(Duration::from_millis(700));
        session.xdotool(&["key", "F12"]);
        let shot = session.directory.path().join(format!("maze-{n:04}.png"));
        until("a picture", || image::image_dimensions(&shot).ok());
        let drawn = session.directory.path().join(format!("{layer}.png"));
        let status = Command::new(env!("CARGO_BIN_EXE_maze-app"))
            .args(["render", "--level", "1", "--ticks", "600", "--quality", "low", "--max-tilt", "10"])
            .args(["--tilt", &format!("{},0", resting.tilt_degrees())])
            .args(["--show", layer, "--out"])
            .arg(&drawn)
            .env("XDG_RUNTIME_DIR", session.directory.path())
            .status();
        assert!(status.unwrap().success());
        let part = different_part(&shot, &drawn);
        if MAX_DIFFERENT_FRACTION < part {
            let target = Path::new(env!("CARGO_TARGET_TMPDIR"));
            std::fs::copy(&shot, target.join(format!("{layer}.window.png"))).unwrap();
            std::fs::copy(&drawn, target.join(format!("{layer}.render.png"))).unwrap();
            panic!("{:.2} % of {layer} differs; see {}", 100.0 * part, target.display());
        }
    }
    assert_eq!(session.last().tick, paused + 3);
    session.xdotool(&["keyup", "Right"]);
    session.xdotool(&["key", "space", "bracketleft", "bracketright"]);
    session.expect_alive("the end of the pause");
    session.close();
    assert!(session.exit_status().success());
}

#[test]
fn frames_are_measured_in_a_window() {
    let directory = tempfile::tempdir().unwrap();
    let screen = Screen::start();
    let [csv, plot] = ["frames.csv", "frames.svg"].map(|name| directory.path().join(name));
    let output = Command::new(env!("CARGO_BIN_EXE_maze-app"))
        .args(["frames", "--seconds", "2", "--size", "320x180", "--csv"])
        .arg(&csv)
        .arg("--plot")
        .arg(&plot)
        .env("DISPLAY", &screen.display)
        .env_remove("WAYLAND_DISPLAY")
        .env("XDG_RUNTIME_DIR", directory.path())
        .output()
        .unwrap();
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success() && text.contains("320x180, quality low"), "{text}");
    assert!(10 < std::fs::read_to_string(csv).unwrap().lines().count());
    assert!(std::fs::read_to_string(plot).unwrap().starts_with("<svg"));
}

#[test]
fn exit_after_ends_by_itself() {
    let mut session = Session::open(&["--exit-after", "6"]);
    assert!(session.exit_status().success());
    let ticks: Vec<u64> = session.states().iter().map(|state| state.tick).collect();
    let counted: Vec<u64> = (1..).take(ticks.len()).collect();
    assert_eq!(ticks, counted, "one line a tick, none left out");
    // 6 s are 200 ticks of 0.03 s; the frame in which the time runs out may hold as many as are ever made up for, and on a
    // busy machine slow frames lose some.
    assert!((20..=200 + 8).contains(&ticks.len()), "{} ticks", ticks.len());
}
