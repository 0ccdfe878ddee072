//! What each key does.

use super::tilt_control::Direction;
use winit::keyboard::KeyCode;

/// A key's effect that is not a tilt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Action {
    ZoomIn,
    ZoomOut,
    /// The maze lies flat again.
    Level,
    /// Ball to the start, clock to zero.
    Restart,
    /// Another random maze.
    NewMaze,
    /// Show or hide the list of keys.
    ToggleHelp,
    Quit,
}

/// The report's keys (B and S zoom, T and R reset), and those that a player of today tries.
pub(crate) fn action_of(key: KeyCode) -> Option<Action> {
    Some(match key {
        KeyCode::KeyB => Action::ZoomIn,
        KeyCode::KeyS => Action::ZoomOut,
        KeyCode::KeyT => Action::Level,
        KeyCode::KeyR => Action::Restart,
        KeyCode::KeyN => Action::NewMaze,
        KeyCode::KeyH => Action::ToggleHelp,
        KeyCode::Escape => Action::Quit,
        _ => return None,
    })
}

/// Arrow keys, and W A D with X below them: S is taken by the report's zoom.
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
        let keys = [
            KeyCode::KeyA,
            KeyCode::KeyB,
            KeyCode::KeyD,
            KeyCode::KeyH,
            KeyCode::KeyN,
            KeyCode::KeyR,
            KeyCode::KeyS,
            KeyCode::KeyT,
            KeyCode::KeyW,
            KeyCode::KeyX,
            KeyCode::ArrowUp,
            KeyCode::Escape,
        ];
        for key in keys {
            let n_effects =
                usize::from(action_of(key).is_some()) + usize::from(tilt_direction_of(key).is_some());
            assert_eq!(n_effects, 1, "{key:?}");
        }
    }
}
