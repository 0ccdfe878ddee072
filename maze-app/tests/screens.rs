//! The screens in a real window, see `desk`: from the title to a key that is bound anew and works after another start.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod desk;

use desk::{Session, output_of, until};
use std::time::Duration;

impl Session {
    fn window_title(&self) -> String {
        output_of("xdotool", &self.screen.display, &["getwindowname", &self.window]).unwrap_or_default()
    }

    fn wait_for_title(&mut self, part: &str) {
        until(part, || self.window_title().contains(part).then_some(()));
    }

    /// One after the other: a press moves the focus for the next frame.
    fn presses(&mut self, keys: &[&str]) {
        for key in keys {
            self.xdotool(&["key", key]);
            std::thread::sleep(Duration::from_millis(400));
        }
    }
}

#[test]
fn from_the_title_to_the_goal_and_a_key_that_is_bound_for_good() {
    let mut session = Session::open_at_title(&["--demo"]);
    // Levels, the first one; the autopilot plays it to the goal.
    session.presses(&["Down", "Return", "Return"]);
    session.wait_for_title("Level 1 ");
    session.wait_for("the goal of level 1", |state| state.phase == "finished");
    // The result is shown a moment later; Enter goes on.
    std::thread::sleep(Duration::from_millis(1500));
    session.presses(&["Return"]);
    session.wait_for_title("Level 2 ");
    session.wait_for("level 2", |state| state.phase != "finished");
    session.presses(&["Escape"]);
    std::thread::sleep(Duration::from_millis(300));
    let tick = session.last().tick;
    std::thread::sleep(Duration::from_millis(600));
    assert_eq!(session.last().tick, tick, "the pause menu holds the clock");
    // Settings, page keys; the third line below it is the first control: go down to restart, and press K for it.
    session.presses(&["Down", "Down", "Return"]);
    session.presses(&["Right", "Right", "Return"]);
    let lines = ["Down"; 7];
    session.presses(&lines);
    session.presses(&["Return", "k"]);
    let settings = session.directory.path().join("maze/settings.toml");
    until("the settings file", || {
        let text = std::fs::read_to_string(&settings).ok()?;
        (text.contains("bound") && text.contains("KeyK")).then_some(())
    });
    let text = std::fs::read_to_string(&settings).unwrap();
    let line = text.lines().find(|line| line.contains("KeyK")).unwrap();
    assert_eq!(line, "restart = [\"KeyK\"]", "{text}");
    // Back, resume, and end.
    session.presses(&["Escape", "Escape"]);
    session.expect_alive("the pause menu's end");
    session.close();
    assert!(session.exit_status().success());

    let mut session = session.open_again(&["--level", "1"]);
    session.xdotool(&["keydown", "Right"]);
    session.wait_for("the clock to start", |state| 0 < state.clock_ticks);
    session.xdotool(&["keyup", "Right"]);
    let before = session.last().clock_ticks;
    assert!(0 < before);
    session.xdotool(&["key", "r"]);
    session.expect_alive("R");
    assert!(before <= session.last().clock_ticks, "R is no longer bound");
    session.xdotool(&["key", "k"]);
    session.wait_for("K to restart", |state| state.clock_ticks == 0);
    session.close();
    assert!(session.exit_status().success());
}
