//! One table: what each key does. The list of keys on screen (`ui/hud.rs`) takes the letters from it, and has words of its own.
//!
//! A press is looked up once, so no key can do two things, whatever the layout. Keys that print something are identified by
//! their place on the keyboard, all others by their name:
//!
//! - letters, digits and marks by place ([`Key::Place`]): R is the fourth key of the upper letter row, whether it prints
//!   r, p, к or ק. Places are named as on a US keyboard.
//! - arrows, Esc, Enter, Page Up and the like by name ([`Key::Name`]): they exist once on every layout, and a player who
//!   has moved Esc to Caps Lock, or switches Num Lock off for arrows, finds them where they were put.

use super::tilt_control::Direction;
use crate::overlay::Layer;
use winit::keyboard::{KeyCode, NamedKey};

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

impl Action {
    /// Whether it is done again and again while its key is held; everything else happens once a press.
    pub(crate) fn repeats(self) -> bool {
        matches!(self, Self::ZoomIn | Self::ZoomOut | Self::Step)
    }
}

/// What a key is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Control {
    /// Tips the board while the key is held.
    Tilt(Direction),
    Act(Action),
}

/// How a key is identified.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Key {
    /// One that prints something, by its place.
    Place(KeyCode),
    /// One that does not, by its name.
    Name(NamedKey),
}

use Control::{Act, Tilt};
use Key::{Name, Place};

/// The report's keys (B and S zoom, T and R reset), and those that a player of today tries. S is taken by the report's
/// zoom, so X below it tips the board towards the player. The first key of a control is the one that is shown.
const BINDINGS: [(Control, &[Key]); 30] = [
    (Tilt(Direction::Left), &[Name(NamedKey::ArrowLeft), Place(KeyCode::KeyA)]),
    (Tilt(Direction::Right), &[Name(NamedKey::ArrowRight), Place(KeyCode::KeyD)]),
    (Tilt(Direction::Away), &[Name(NamedKey::ArrowUp), Place(KeyCode::KeyW)]),
    (Tilt(Direction::Towards), &[Name(NamedKey::ArrowDown), Place(KeyCode::KeyX)]),
    (Act(Action::ZoomIn), &[Place(KeyCode::KeyB)]),
    (Act(Action::ZoomOut), &[Place(KeyCode::KeyS)]),
    (Act(Action::Level), &[Place(KeyCode::KeyT)]),
    (Act(Action::Restart), &[Place(KeyCode::KeyR)]),
    (Act(Action::GoOn), &[Place(KeyCode::KeyN)]),
    (Act(Action::GoOnFromGoal), &[Name(NamedKey::Enter)]),
    (Act(Action::NextLevel), &[Name(NamedKey::PageDown)]),
    (Act(Action::PreviousLevel), &[Name(NamedKey::PageUp)]),
    (Act(Action::ToggleHelp), &[Place(KeyCode::KeyH)]),
    (Act(Action::NextGhost), &[Place(KeyCode::KeyG)]),
    (Act(Action::NextQuality), &[Place(KeyCode::KeyQ)]),
    (Act(Action::ToggleFrames), &[Name(NamedKey::F3)]),
    (Act(Action::ToggleFullscreen), &[Name(NamedKey::F11)]),
    (Act(Action::Screenshot), &[Name(NamedKey::F12)]),
    // Shift and Space print a narrow space on some layouts.
    (Act(Action::TogglePause), &[Place(KeyCode::KeyP), Name(NamedKey::Space), Place(KeyCode::Space)]),
    (Act(Action::Step), &[Place(KeyCode::Period), Place(KeyCode::NumpadDecimal)]),
    (Act(Action::Slower), &[Place(KeyCode::Minus), Place(KeyCode::NumpadSubtract)]),
    (Act(Action::Faster), &[Place(KeyCode::Equal), Place(KeyCode::NumpadAdd)]),
    (Act(Action::HideLayers), &[Place(KeyCode::Digit0), Place(KeyCode::Numpad0)]),
    (Act(Action::ToggleLayer(Layer::ALL[0])), &[Place(KeyCode::Digit1), Place(KeyCode::Numpad1)]),
    (Act(Action::ToggleLayer(Layer::ALL[1])), &[Place(KeyCode::Digit2), Place(KeyCode::Numpad2)]),
    (Act(Action::ToggleLayer(Layer::ALL[2])), &[Place(KeyCode::Digit3), Place(KeyCode::Numpad3)]),
    (Act(Action::ToggleLayer(Layer::ALL[3])), &[Place(KeyCode::Digit4), Place(KeyCode::Numpad4)]),
    (Act(Action::ToggleLayer(Layer::ALL[4])), &[Place(KeyCode::Digit5), Place(KeyCode::Numpad5)]),
    (Act(Action::ToggleLayer(Layer::ALL[5])), &[Place(KeyCode::Digit6), Place(KeyCode::Numpad6)]),
    (Act(Action::Quit), &[Name(NamedKey::Escape)]),
];

/// What a key is for, if anything.
pub(crate) fn control_of(key: Key) -> Option<Control> {
    BINDINGS.iter().find(|(_, keys)| keys.contains(&key)).map(|(control, _)| *control)
}

/// The keys of a control, the one to be shown first.
pub(crate) fn keys_of(control: Control) -> &'static [Key] {
    BINDINGS.iter().find(|(bound, _)| *bound == control).map_or(&[], |(_, keys)| keys)
}

/// All places in the table.
pub(super) fn places() -> impl Iterator<Item = KeyCode> {
    BINDINGS.iter().flat_map(|(_, keys)| keys.iter()).filter_map(|key| match key {
        Place(place) => Some(*place),
        Name(_) => None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn i3_each_key_stands_once_in_the_table() {
        let keys: Vec<Key> = BINDINGS.iter().flat_map(|(_, keys)| keys.iter().copied()).collect();
        for (i, key) in keys.iter().enumerate() {
            assert!(!keys[..i].contains(key), "{key:?} is bound twice");
            assert!(control_of(*key).is_some());
        }
        let n_tilts = keys.iter().filter(|key| matches!(control_of(**key), Some(Tilt(_)))).count();
        assert_eq!(n_tilts, 8, "arrows, W A D X");
    }
}
