//! Keyboards, the mouse, and what window systems do, see `desk`.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod desk;

use desk::{MAZE, Screen, Session, State, output_of, until};
use std::os::unix::net::UnixListener;
use std::process::{Command, Output};
use std::time::Duration;

/// Tilted as far as a held key tilts: 19.7 degrees of 20.
const FAR_DEGREES: f64 = 19.0;

/// Where keys lie, as X11 numbers them.
const PLACES: [(&str, &str); 8] =
    [("a", "38"), ("s", "39"), ("d", "40"), ("b", "56"), ("n", "57"), ("r", "27"), ("p", "33"), ("w", "25")];

fn place(letter: &str) -> &'static str {
    PLACES.iter().find(|(known, _)| *known == letter).unwrap().1
}

fn right_degrees(state: &State) -> f64 {
    2.0 * state.orientation[2].asin().to_degrees()
}

fn away_degrees(state: &State) -> f64 {
    -2.0 * state.orientation[1].asin().to_degrees()
}

impl Session {
    fn layout(&mut self, words: &[&str]) {
        self.tool("setxkbmap", words);
        // The game hears of it by an event.
        std::thread::sleep(Duration::from_millis(500));
    }

    /// States of the next second or so.
    fn next_states(&mut self) -> Vec<State> {
        let n = self.states().len();
        self.expect_alive("time to go on");
        std::thread::sleep(Duration::from_millis(700));
        self.states().split_off(n)
    }

    fn expect_still(&mut self, what: &str) {
        std::thread::sleep(Duration::from_millis(600));
        let tick = self.last().tick;
        std::thread::sleep(Duration::from_millis(600));
        assert_eq!(self.last().tick, tick, "{what}");
    }

    fn title(&self) -> String {
        output_of("xdotool", &self.screen.display, &["getwindowname", &self.window]).unwrap()
    }
}

#[test]
fn i1_i10_held_keys_tilt_across_a_second_key_restart_level_and_pause() {
    let mut session = Session::open(&MAZE);
    session.xdotool(&["keydown", "Right"]);
    session.wait_for("a key to tilt", |state| FAR_DEGREES < right_degrees(state));
    session.xdotool(&["keydown", "d", "keyup", "d"]);
    assert!(session.next_states().iter().all(|state| FAR_DEGREES < right_degrees(state)), "I1");
    for key in ["r", "t"] {
        session.xdotool(&["key", key]);
        let level = session.wait_for(key, |state| right_degrees(state) < FAR_DEGREES - 5.0);
        session.wait_for(key, |state| level.tick < state.tick && FAR_DEGREES < right_degrees(state));
        assert!(session.next_states().iter().all(|state| FAR_DEGREES < right_degrees(state)), "after {key}");
    }
    session.xdotool(&["key", "p"]);
    session.expect_still("a pause");
    session.xdotool(&["key", "p"]);
    let window = session.window.clone();
    session.xdotool(&["windowsize", &window, "800", "600"]);
    assert!(session.next_states().iter().all(|state| FAR_DEGREES < right_degrees(state)), "after a pause");
    session.xdotool(&["keydown", "Left"]);
    session.wait_for("opposite keys to cancel", |state| state.tilt_degrees() == 0.0);
    session.xdotool(&["keyup", "Right", "keyup", "Left"]);
    session.xdotool(&["key", "ctrl+d", "alt+a", "super+a", "shift+d", "ctrl+Right"]);
    assert!(session.next_states().iter().all(|state| state.tilt_degrees() == 0.0), "with Ctrl and the like");
}

#[test]
fn i2_i3_keys_work_by_their_place_on_every_layout_and_do_one_thing() {
    let mut session = Session::open(&[&MAZE[..], &["--keys", "report"]].concat());
    let layouts: [&[&str]; 9] = [
        &["ru"],
        &["ua"],
        &["gr"],
        &["il"],
        &["ara"],
        &["fr"],
        &["de"],
        &["us", "-variant", "colemak"],
        &["us", "-variant", "dvorak"],
    ];
    for layout in layouts {
        session.layout(&[&["-layout"], layout].concat());
        let whole = session.last().camera_distance;
        session.xdotool(&["key", place("b"), place("b")]);
        session.wait_for("B to zoom in", |state| state.camera_distance < 0.9 * whole);
        session.xdotool(&["key", place("s"), place("s")]);
        session.wait_for("S to zoom out", |state| 0.99 * whole < state.camera_distance);
        session.expect_alive("the zoom");
        let zoomed = session.last().camera_distance;
        for (key, sign) in [("d", 1.0), ("a", -1.0)] {
            session.xdotool(&["keydown", place(key)]);
            session.wait_for(key, |state| FAR_DEGREES < sign * right_degrees(state));
            session.xdotool(&["keyup", place(key)]);
            session.wait_for("the board to return", |state| state.tilt_degrees() == 0.0);
        }
        assert!(
            (session.last().camera_distance - zoomed).abs() < 0.01 * whole,
            "{layout:?}: a tilt key zooms"
        );
        assert!(0 < session.last().clock_ticks);
        session.xdotool(&["key", place("r")]);
        session.wait_for("R to restart", |state| state.clock_ticks == 0);
        let title = session.title();
        session.xdotool(&["key", place("n")]);
        until("N to bring another maze", || (session.title() != title).then_some(()));
        session.xdotool(&["key", place("p")]);
        session.expect_still("P to pause");
        session.xdotool(&["key", place("p")]);
        session.expect_alive("P to go on");
    }
    session.layout(&["-layout", "us"]);
    session.xdotool(&["key", "Caps_Lock"]);
    session.xdotool(&["keydown", place("d")]);
    session.wait_for("Caps Lock to change nothing", |state| FAR_DEGREES < right_degrees(state));
    session.xdotool(&["keyup", place("d"), "key", "Caps_Lock"]);
}

#[test]
fn i4_a_far_drag_keeps_its_direction_beyond_the_window_too() {
    let mut session = Session::open(&MAZE);
    let window = session.window.clone();
    session.xdotool(&["mousemove", "--window", &window, "100", "360", "mousedown", "1"]);
    for x in ["500", "800", "1100", "1270", "1330"] {
        session.xdotool(&["mousemove", "--window", &window, x, "360"]);
        session.wait_for("a drag to tilt", |state| FAR_DEGREES + 0.5 < right_degrees(state));
        for state in session.next_states() {
            let [right, away] = [right_degrees(&state), away_degrees(&state)];
            assert!((right - 19.7).abs() < 0.1 && away.abs() < 0.02, "x = {x}: {right}, {away}");
        }
    }
    session.xdotool(&["mousemove", "--window", &window, "900", "360"]);
    session.wait_for("dragging back to answer", |state| right_degrees(state) < 0.0);
}

#[test]
fn i5_the_time_stands_on_another_workspace_and_minimised() {
    let mut session = Session::open(&MAZE);
    for (away, back) in [(["-s", "1"].as_slice(), ["-s", "0"].as_slice())] {
        for _ in 0..2 {
            session.tool("wmctrl", away);
            session.expect_still("another workspace");
            session.tool("wmctrl", back);
            let window = session.window.clone();
            session.xdotool(&["windowactivate", &window]);
            session.expect_alive("the way back");
        }
    }
    let mut session = Session::open(&[&MAZE[..], &["--unfocused", "run"]].concat());
    session.tool("wmctrl", &["-s", "1"]);
    session.expect_still("another workspace, whatever the focus");
    session.tool("wmctrl", &["-s", "0"]);
    session.expect_alive("the way back");
}

#[test]
fn i11_another_window_with_the_keyboard_pauses_the_game_or_does_not() {
    for (words, runs) in [
        (&[][..], false),
        (&["--unfocused", "run"], true),
        (&["--exit-after", "600"], true),
        (&["--unfocused", "pause", "--exit-after", "600"], false),
    ] {
        let mut session = Session::open(&[&MAZE[..], words].concat());
        session.expect_alive("a window with the keyboard");
        let mut other = Command::new(env!("CARGO_BIN_EXE_maze-app"));
        other
            .args(["frames", "--seconds", "60", "--size", "200x100"])
            .env("XDG_RUNTIME_DIR", session.directory.path());
        other.env("DISPLAY", &session.screen.display).env_remove("WAYLAND_DISPLAY");
        let mut other = desk::start(&mut other);
        let window = session.window.clone();
        until("another window to have the keyboard", || {
            output_of("xdotool", &session.screen.display, &["getwindowfocus"])
                .filter(|focused| *focused != window)
        });
        if runs {
            session.expect_alive("a game without the keyboard");
        } else {
            session.expect_still("a game without the keyboard");
        }
        other.0.kill().unwrap();
        session.xdotool(&["windowactivate", &window]);
        session.expect_alive("the keyboard to come back");
    }
}

/// The game for a second, in an environment.
fn played(directory: &std::path::Path, environment: &[(&str, &str)], words: &[&str]) -> Output {
    let mut game = Command::new(env!("CARGO_BIN_EXE_maze-app"));
    game.args(words).env_remove("WAYLAND_DISPLAY").env_remove("DISPLAY").env("XDG_RUNTIME_DIR", directory);
    game.envs(environment.iter().copied()).output().unwrap()
}

const PLAY: [&str; 5] = ["play", "--size", "4x4", "--exit-after", "1"];

fn assert_refused(output: &Output, parts: &[&str]) {
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert_eq!(said.lines().count(), 1, "{said}");
    for part in parts {
        assert!(said.contains(part), "{part} in {said}");
    }
}

#[test]
fn i6_a_window_system_that_is_gone_or_silent_is_passed_over() {
    let directory = tempfile::tempdir().unwrap();
    let screen = Screen::start();
    let display = screen.display.as_str();
    // Its connections wait in the queue for ever.
    let _silent = UnixListener::bind(directory.path().join("silent")).unwrap();
    std::fs::write(directory.path().join("file"), b"").unwrap();
    for wayland in ["stale", "file", "silent"] {
        let output = played(directory.path(), &[("WAYLAND_DISPLAY", wayland), ("DISPLAY", display)], &PLAY);
        assert!(output.status.success(), "{wayland}: {output:?}");
        let output = played(directory.path(), &[("WAYLAND_DISPLAY", wayland), ("DISPLAY", ":9999")], &PLAY);
        assert_refused(&output, &["WAYLAND_DISPLAY is ", wayland, "DISPLAY is :9999"]);
        assert_refused(&played(directory.path(), &[("WAYLAND_DISPLAY", wayland)], &PLAY), &[wayland]);
    }
    let output = played(directory.path(), &[("WAYLAND_SOCKET", "99"), ("DISPLAY", display)], &PLAY);
    assert!(output.status.success(), "{output:?}");
    assert_refused(
        &played(directory.path(), &[], &PLAY),
        &["no display", "neither WAYLAND_DISPLAY nor DISPLAY"],
    );
    let picture = directory.path().join("maze.png").display().to_string();
    let render = ["render", "--level", "1", "--size", "64x64", "--out", &picture];
    assert!(played(directory.path(), &[("WAYLAND_DISPLAY", "silent")], &render).status.success());
}

#[test]
fn i7_scales_servers_and_sizes_that_cannot_be_used_are_no_panic() {
    use x11rb::connection::Connection;
    use x11rb::protocol::xproto::{AtomEnum, ConnectionExt as _, PropMode};
    use x11rb::wrapper::ConnectionExt as _;
    let directory = tempfile::tempdir().unwrap();
    let screen = Screen::start();
    let display = screen.display.as_str();
    for scale in ["abc", "0", "inf", "-1", "1e9"] {
        let output =
            played(directory.path(), &[("DISPLAY", display), ("WINIT_X11_SCALE_FACTOR", scale)], &PLAY);
        assert_refused(&output, &["WINIT_X11_SCALE_FACTOR", scale]);
    }
    let (connection, number) = x11rb::connect(Some(display)).unwrap();
    let root = connection.setup().roots[number].root;
    let set_dpi = |dpi: &str| {
        let text = format!("Xft.dpi:\t{dpi}\n");
        let name = AtomEnum::RESOURCE_MANAGER;
        connection
            .change_property8(PropMode::REPLACE, root, name, AtomEnum::STRING, text.as_bytes())
            .unwrap();
        connection.get_input_focus().unwrap().reply().unwrap();
    };
    for dpi in ["0", "-1", "1e9", "inf", "NaN", "1", "abc"] {
        set_dpi(dpi);
        let output = played(directory.path(), &[("DISPLAY", display)], &PLAY);
        assert!(output.status.success(), "Xft.dpi {dpi}: {output:?}");
    }
    // While the game runs.
    set_dpi("96");
    let mut session = Session::open(&MAZE);
    for dpi in ["0", "1e9", "-1", "96"] {
        set_dpi(dpi);
        session.expect_alive("another scale");
    }
    for (size, place) in [("65536x100", None), ("100x65536", None), ("4000000000x9", Some("--offscreen"))] {
        let words = [&["frames", "--seconds", "1", "--size", size][..], place.as_slice()].concat();
        assert_refused(
            &played(directory.path(), &[("DISPLAY", display)], &words),
            &["--size", "pixels a side"],
        );
    }
    let bare = Screen::start_with(&["-extension", "RANDR"]);
    assert_refused(&played(directory.path(), &[("DISPLAY", &bare.display)], &PLAY), &["RANDR"]);
}

#[test]
fn i8_a_file_s_name_in_any_script_is_the_window_s_title() {
    let directory = tempfile::tempdir().unwrap();
    for name in ["迷路.txt", "متاهة.txt", "лабиринт.txt", "a\nb\u{202e}.txt"] {
        let path = directory.path().join(name);
        std::fs::write(&path, "#####\n#S G#\n#####\n").unwrap();
        let session = Session::open_with(&[path.to_str().unwrap()]);
        let shown = name.replace('\n', "[U+000A]").replace('\u{202e}', "[U+202E]");
        assert!(session.title().ends_with(&shown), "{} for {shown}", session.title());
    }
}
