//! What each key does.

use super::tilt_control::Direction;
use crate::overlay::Layer;
use winit::keyboard::{Key, KeyCode, NamedKey};

/// A key's effect that is not a tilt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Action {
    ZoomIn,
    ZoomOut,
    /// The maze lies flat again.
    Level,
    /// Ball to the start, clock to zero.
    Restart,
    /// Another random maze, or the next level.
    GoOn,
    /// The same, once the goal is reached.
    GoOnFromGoal,
    NextLevel,
    PreviousLevel,
    /// Show or hide the list of keys.
    ToggleHelp,
    /// The next of the other engines as a ghost, or none.
    NextGhost,
    /// The next quality of the picture.
    NextQuality,
    /// Show or hide what frames take.
    ToggleFrames,
    /// The picture into a file.
    Screenshot,
    /// The whole screen, or a window again.
    ToggleFullscreen,
    /// Show or hide one thing of the method.
    ToggleLayer(Layer),
    /// Hide all of them.
    HideLayers,
    /// Stop the game's time, or let it go on.
    TogglePause,
    /// One tick, and then a pause.
    Step,
    Slower,
    Faster,
    Quit,
}

/// The report's keys (B and S zoom, T and R reset), and those that a player of today tries; by what is printed on them.
pub(crate) fn action_of(key: &Key) -> Option<Action> {
    Some(match key {
        Key::Named(NamedKey::Escape) => Action::Quit,
        Key::Named(NamedKey::Enter) => Action::GoOnFromGoal,
        Key::Named(NamedKey::PageDown) => Action::NextLevel,
        Key::Named(NamedKey::PageUp) => Action::PreviousLevel,
        Key::Named(NamedKey::F3) => Action::ToggleFrames,
        Key::Named(NamedKey::F11) => Action::ToggleFullscreen,
        Key::Named(NamedKey::F12) => Action::Screenshot,
        Key::Named(NamedKey::Space) => Action::TogglePause,
        Key::Character(text) => match text.to_ascii_lowercase().as_str() {
            "b" => Action::ZoomIn,
            "s" => Action::ZoomOut,
            "t" => Action::Level,
            "r" => Action::Restart,
            "n" => Action::GoOn,
            "h" => Action::ToggleHelp,
            "g" => Action::NextGhost,
            "q" => Action::NextQuality,
            "p" | " " => Action::TogglePause,
            "." => Action::Step,
            "-" => Action::Slower,
            "=" | "+" => Action::Faster,
            "0" => Action::HideLayers,
            digit => {
                let number: usize = digit.parse().ok()?;
                Action::ToggleLayer(*Layer::ALL.get(number.checked_sub(1)?)?)
            }
        },
        _ => return None,
    })
}

/// Arrow keys, and W A D with X below them (S is taken by the report's zoom); by where they lie.
pub(crate) fn tilt_direction_of(key: KeyCode) -> Option<Direction> {
    Some(match key {
        KeyCode::ArrowLeft | KeyCode::KeyA => Direction::Left,
        KeyCode::ArrowRight | KeyCode::KeyD => Direction::Right,
        KeyCode::ArrowUp | KeyCode::KeyW => Direction::Away,
        KeyCode::ArrowDown | KeyCode::KeyX => Direction::Towards,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_key_does_two_things() {
        for (key, text) in
            [(KeyCode::KeyA, "a"), (KeyCode::KeyD, "d"), (KeyCode::KeyW, "w"), (KeyCode::KeyX, "x")]
        {
            assert!(tilt_direction_of(key).is_some() && action_of(&Key::Character(text.into())).is_none());
        }
        for (key, text) in
            [(KeyCode::KeyB, "B"), (KeyCode::KeyS, "s"), (KeyCode::KeyT, "t"), (KeyCode::KeyR, "R")]
        {
            assert!(tilt_direction_of(key).is_none() && action_of(&Key::Character(text.into())).is_some());
        }
    }
}
