//! The game in a real window: Xvfb, a window manager, the software driver, and xdotool's hands on mouse and keys.
//!
//! Needs Xvfb, xdotool, openbox, wmctrl and setxkbmap, which `./check` installs; without them a test fails and says so.
#![allow(dead_code, unreachable_pub, missing_docs, reason = "each test uses a part of it")]

use serde::Deserialize;
use std::io::{BufRead, BufReader};
use std::path::PathBuf;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// Long enough for a software driver on a busy machine; a condition that holds ends the wait at once.
pub const PATIENCE: Duration = Duration::from_secs(30);

/// The default limit of the tilt, and the rounding of one quantised step.
pub const MAX_TILT_DEGREES: f64 = 20.0 + 0.01;

#[derive(Clone, Debug, Deserialize)]
pub struct State {
    pub tick: u64,
    pub orientation: [f64; 4],
    pub position: [f64; 2],
    pub velocity: [f64; 2],
    pub camera_distance: f64,
    pub phase: String,
    pub clock_ticks: u64,
}

impl State {
    pub fn tilt_degrees(&self) -> f64 {
        2.0 * self.orientation[0].abs().min(1.0).acos().to_degrees()
    }

    pub fn speed(&self) -> f64 {
        self.velocity[0].hypot(self.velocity[1])
    }
}

/// A child process that does not outlive the test.
pub struct Killed(pub Child);

impl Drop for Killed {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

pub fn start(command: &mut Command) -> Killed {
    let name = command.get_program().to_string_lossy().into_owned();
    Killed(
        command.spawn().unwrap_or_else(|error| panic!("{name}: {error}; ./check installs what tests need")),
    )
}

/// The first line that a tool prints; `None` when it fails.
pub fn output_of(program: &str, display: &str, arguments: &[&str]) -> Option<String> {
    let output = Command::new(program).args(arguments).env("DISPLAY", display).output();
    let output = output.unwrap_or_else(|error| panic!("{program}: {error}; ./check installs it"));
    let text = String::from_utf8_lossy(&output.stdout);
    output.status.success().then(|| text.lines().next().unwrap_or_default().to_owned())
}

/// Asks again and again until there is an answer.
pub fn until<T>(what: &str, mut ask: impl FnMut() -> Option<T>) -> T {
    let begun = Instant::now();
    loop {
        if let Some(answer) = ask() {
            return answer;
        }
        assert!(begun.elapsed() < PATIENCE, "waited in vain for {what}");
        std::thread::sleep(Duration::from_millis(30));
    }
}

/// A screen of its own with a window manager.
pub struct Screen {
    pub display: String,
    _window_manager: Killed,
    pub server: Killed,
}

impl Screen {
    pub fn start() -> Self {
        Self::start_with(&[])
    }

    /// With more words for the server.
    pub fn start_with(arguments: &[&str]) -> Self {
        // Without -noreset the server begins anew when its last client leaves, which throws out a window manager that is just
        // arriving while wmctrl asks for it.
        let mut server = start(
            Command::new("Xvfb")
                .args(["-displayfd", "1", "-screen", "0", "1400x900x24", "-nolisten", "tcp", "-noreset"])
                .args(arguments)
                .stdout(Stdio::piped())
                .stderr(Stdio::null()),
        );
        // Xvfb picks a free display and prints its number when it is ready.
        let mut number = String::new();
        BufReader::new(server.0.stdout.take().unwrap()).read_line(&mut number).unwrap();
        let display = format!(":{}", number.trim());
        let window_manager = start(
            Command::new("openbox").env("DISPLAY", &display).stdout(Stdio::null()).stderr(Stdio::null()),
        );
        // A window that opens while the manager starts is never shown.
        until("the window manager", || output_of("wmctrl", &display, &["-l"]));
        Self { display, _window_manager: window_manager, server }
    }
}

/// The game on a screen of its own.
pub struct Session {
    pub game: Killed,
    pub screen: Screen,
    log: PathBuf,
    /// Number of states that had been logged when the last input was sent.
    n_before_input: usize,
    /// Where the game works.
    pub directory: tempfile::TempDir,
    pub window: String,
}

impl Session {
    pub fn open(arguments: &[&str]) -> Self {
        Self::open_with(&[&["--seed", "5"], arguments].concat())
    }

    pub fn open_with(arguments: &[&str]) -> Self {
        let mut session = Self::start(Screen::start(), tempfile::tempdir().unwrap(), arguments);
        session.wait_for("the first ticks", |state| 3 <= state.tick);
        session.find_window();
        session
    }

    /// Before the title, where no ticks are logged.
    pub fn open_at_title(arguments: &[&str]) -> Self {
        let arguments = [&["--title"], arguments].concat();
        let mut session = Self::start(Screen::start(), tempfile::tempdir().unwrap(), &arguments);
        session.find_window();
        // Until the first frame is shown.
        std::thread::sleep(Duration::from_secs(3));
        session
    }

    /// The game once more, with what it has kept.
    pub fn open_again(self, arguments: &[&str]) -> Self {
        let Self { screen, directory, .. } = self;
        let mut session = Self::start(screen, directory, arguments);
        session.wait_for("the first ticks", |state| 3 <= state.tick);
        session.find_window();
        session
    }

    fn start(screen: Screen, directory: tempfile::TempDir, arguments: &[&str]) -> Self {
        let log = directory.path().join("state.jsonl");
        let game = start(
            Command::new(env!("CARGO_BIN_EXE_maze-app"))
                .args(["play", "--state-log"])
                .arg(&log)
                .args(arguments)
                .current_dir(directory.path())
                .env("DISPLAY", &screen.display)
                .env_remove("WAYLAND_DISPLAY")
                // Settings of its own.
                .env("XDG_CONFIG_HOME", directory.path())
                .env("XDG_RUNTIME_DIR", directory.path()),
        );
        Self { game, screen, log, n_before_input: 0, directory, window: String::new() }
    }

    fn find_window(&mut self) {
        self.window = until("the window to show", || {
            output_of("xdotool", &self.screen.display, &["search", "--onlyvisible", "--name", "^Maze"])
        });
        let window = self.window.clone();
        self.xdotool(&["windowfocus", &window]);
    }

    pub fn tool(&mut self, program: &str, arguments: &[&str]) {
        self.n_before_input = self.states().len();
        assert!(
            output_of(program, &self.screen.display, arguments).is_some(),
            "{program} {arguments:?} failed"
        );
    }

    pub fn xdotool(&mut self, arguments: &[&str]) {
        self.tool("xdotool", arguments);
    }

    pub fn states(&self) -> Vec<State> {
        let text = std::fs::read_to_string(&self.log).unwrap_or_default();
        let whole_lines = text.rsplit_once('\n').map_or("", |(whole, _)| whole);
        whole_lines.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
    }

    pub fn last(&self) -> State {
        self.states().pop().expect("a state has been logged")
    }

    /// The first state since the last input that is so: on a slow machine what is short passes between two looks.
    pub fn wait_for(&mut self, what: &str, condition: impl Fn(&State) -> bool) -> State {
        until(what, || {
            if let Some(status) = self.game.0.try_wait().unwrap() {
                panic!("the game ended ({status}) while waiting for {what}");
            }
            self.states().into_iter().skip(self.n_before_input).find(&condition)
        })
    }

    /// Ticks go on after now.
    pub fn expect_alive(&mut self, what: &str) {
        let tick = self.last().tick;
        self.wait_for(what, |state| tick + 5 <= state.tick);
    }

    /// Closes the window.
    pub fn close(&mut self) {
        self.tool("wmctrl", &["-c", "Maze"]);
    }

    pub fn exit_status(&mut self) -> ExitStatus {
        until("the game to end", || self.game.0.try_wait().unwrap())
    }
}

pub const MAZE: [&str; 2] = ["--size", "6x4"];
