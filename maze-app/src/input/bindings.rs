//! One table: what can be bound, what it is called, and its usual keys.
//!
//! The hints and the list of keys on screen, the settings and the README's table are made from it.
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
use clap::ValueEnum;
use serde::{Deserialize, Serialize};
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
    /// The pause menu.
    Menu,
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

impl Key {
    /// As a settings file has it: winit's name of the place or of the key.
    pub(crate) fn text(self) -> String {
        match self {
            Self::Place(place) => format!("{place:?}"),
            Self::Name(name) => format!("{name:?}"),
        }
    }

    /// `None` for a text that names no key. A name of both a place and a key, such as Enter, means the key.
    pub(crate) fn parse(text: &str) -> Option<Self> {
        use serde::de::IntoDeserializer;
        use serde::de::value::{Error, StrDeserializer};
        let named = |text: StrDeserializer<'_, Error>| NamedKey::deserialize(text).ok();
        let placed = |text: StrDeserializer<'_, Error>| KeyCode::deserialize(text).ok();
        named(text.into_deserializer()).map(Name).or_else(|| placed(text.into_deserializer()).map(Place))
    }
}

use Control::{Act, Tilt};
use Key::{Name, Place};

/// Two sets of usual keys, which differ in the keys of the left hand.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum KeySet {
    /// W A S D tilt, + and - zoom
    #[default]
    Wasd,
    /// The report's: B and S zoom, T and R reset; W A D and X tilt
    Report,
}

/// What can be bound: one line of the table.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Entry {
    pub(crate) control: Control,
    /// In a settings file.
    pub(crate) id: &'static str,
    /// On screen and in the README.
    pub(crate) name: &'static str,
    keys: &'static [Key],
    /// Where the report's keys are others.
    report_keys: Option<&'static [Key]>,
}

/// Most keys that a player binds to one control.
pub(crate) const MAX_KEYS: usize = 2;

const fn entry(control: Control, id: &'static str, name: &'static str, keys: &'static [Key]) -> Entry {
    Entry { control, id, name, keys, report_keys: None }
}

const fn entry_of_two(
    control: Control,
    id: &'static str,
    name: &'static str,
    keys: &'static [Key],
    report_keys: &'static [Key],
) -> Entry {
    Entry { control, id, name, keys, report_keys: Some(report_keys) }
}

/// Keys of a number pad beside those of the letter block do the same; they are no second binding.
pub(crate) const TABLE: [Entry; 30] = {
    use KeyCode::*;
    use NamedKey::{ArrowDown, ArrowLeft, ArrowRight, ArrowUp, F3, F11, F12, PageDown, PageUp};
    [
        entry(Tilt(Direction::Left), "tilt-left", "tilt left", &[Name(ArrowLeft), Place(KeyA)]),
        entry(Tilt(Direction::Right), "tilt-right", "tilt right", &[Name(ArrowRight), Place(KeyD)]),
        entry(Tilt(Direction::Away), "tilt-away", "tilt away", &[Name(ArrowUp), Place(KeyW)]),
        entry_of_two(
            Tilt(Direction::Towards),
            "tilt-towards",
            "tilt towards you",
            &[Name(ArrowDown), Place(KeyS)],
            &[Name(ArrowDown), Place(KeyX)],
        ),
        entry(Act(Action::Restart), "restart", "restart", &[Place(KeyR)]),
        entry(Act(Action::Menu), "menu", "menu", &[Name(NamedKey::Escape)]),
        entry(Act(Action::TogglePause), "pause", "pause", &[Place(KeyP), Name(NamedKey::Space)]),
        entry(Act(Action::Level), "level", "level the board", &[Place(KeyT)]),
        entry_of_two(
            Act(Action::ZoomIn),
            "zoom-in",
            "zoom in",
            &[Place(Equal), Place(NumpadAdd)],
            &[Place(KeyB)],
        ),
        entry_of_two(
            Act(Action::ZoomOut),
            "zoom-out",
            "zoom out",
            &[Place(Minus), Place(NumpadSubtract)],
            &[Place(KeyS)],
        ),
        entry(Act(Action::GoOn), "next", "next maze", &[Place(KeyN)]),
        entry(
            Act(Action::GoOnFromGoal),
            "next-from-goal",
            "next maze, at the goal",
            &[Name(NamedKey::Enter)],
        ),
        entry(Act(Action::NextLevel), "next-level", "next level", &[Name(PageDown)]),
        entry(Act(Action::PreviousLevel), "previous-level", "previous level", &[Name(PageUp)]),
        entry(Act(Action::NextGhost), "ghost", "ghost", &[Place(KeyG)]),
        entry(Act(Action::NextQuality), "quality", "picture quality", &[Place(KeyQ)]),
        entry(Act(Action::ToggleHelp), "keys", "all keys", &[Place(KeyH)]),
        entry(Act(Action::ToggleFrames), "frames", "frame times", &[Name(F3)]),
        entry(Act(Action::ToggleFullscreen), "fullscreen", "full screen", &[Name(F11)]),
        entry(Act(Action::Screenshot), "screenshot", "screenshot", &[Name(F12)]),
        entry(Act(Action::Step), "step", "one tick", &[Place(Period), Place(NumpadDecimal)]),
        entry_of_two(
            Act(Action::Slower),
            "slower",
            "slower",
            &[Place(BracketLeft)],
            &[Place(Minus), Place(NumpadSubtract)],
        ),
        entry_of_two(
            Act(Action::Faster),
            "faster",
            "faster",
            &[Place(BracketRight)],
            &[Place(Equal), Place(NumpadAdd)],
        ),
        entry(
            Act(Action::ToggleLayer(Layer::ALL[0])),
            "layer-1",
            Layer::ALL[0].name(),
            &[Place(Digit1), Place(Numpad1)],
        ),
        entry(
            Act(Action::ToggleLayer(Layer::ALL[1])),
            "layer-2",
            Layer::ALL[1].name(),
            &[Place(Digit2), Place(Numpad2)],
        ),
        entry(
            Act(Action::ToggleLayer(Layer::ALL[2])),
            "layer-3",
            Layer::ALL[2].name(),
            &[Place(Digit3), Place(Numpad3)],
        ),
        entry(
            Act(Action::ToggleLayer(Layer::ALL[3])),
            "layer-4",
            Layer::ALL[3].name(),
            &[Place(Digit4), Place(Numpad4)],
        ),
        entry(
            Act(Action::ToggleLayer(Layer::ALL[4])),
            "layer-5",
            Layer::ALL[4].name(),
            &[Place(Digit5), Place(Numpad5)],
        ),
        entry(
            Act(Action::ToggleLayer(Layer::ALL[5])),
            "layer-6",
            Layer::ALL[5].name(),
            &[Place(Digit6), Place(Numpad6)],
        ),
        entry(Act(Action::HideLayers), "layer-0", "hide overlays", &[Place(Digit0), Place(Numpad0)]),
    ]
};

/// What is shown in the row of hints while playing, most needed first.
pub(crate) const HINTS: [(&[Control], &str); 6] = [
    (
        &[Tilt(Direction::Away), Tilt(Direction::Left), Tilt(Direction::Towards), Tilt(Direction::Right)],
        "tilt",
    ),
    (&[Act(Action::Restart)], "restart"),
    (&[Act(Action::TogglePause)], "pause"),
    (&[Act(Action::ZoomIn), Act(Action::ZoomOut)], "zoom"),
    (&[Act(Action::Menu)], "menu"),
    (&[Act(Action::ToggleHelp)], "all keys"),
];

/// The keys of a player.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Bindings(Vec<Vec<Key>>); // Invariant: a list for each line of the table.

impl Default for Bindings {
    fn default() -> Self {
        Self::new(KeySet::default())
    }
}

impl Bindings {
    pub(crate) fn new(set: KeySet) -> Self {
        Self(TABLE.iter().map(|entry| usual_keys(entry, set).to_vec()).collect())
    }

    /// What a key is for, if anything.
    pub(crate) fn control_of(&self, key: Key) -> Option<Control> {
        let bound = TABLE.iter().zip(&self.0).find(|(_, keys)| keys.contains(&key));
        bound.map(|(entry, _)| entry.control)
    }

    /// The keys of a control, the one to be shown first.
    pub(crate) fn keys_of(&self, control: Control) -> &[Key] {
        let line = TABLE.iter().position(|entry| entry.control == control);
        line.map_or(&[], |line| &self.0[line])
    }

    /// Gives a control these keys, and takes them from no other: see [`Bindings::conflicts`].
    pub(crate) fn set(&mut self, control: Control, keys: Vec<Key>) {
        if let Some(line) = TABLE.iter().position(|entry| entry.control == control) {
            self.0[line] = keys;
        }
    }

    /// The key of that place in the list, 0 or 1; a place behind the last one adds a key.
    pub(crate) fn set_key(&mut self, control: Control, place: usize, key: Key) {
        let mut keys = self.keys_of(control).to_vec();
        keys.retain(|bound| *bound != key);
        keys.truncate(MAX_KEYS);
        match keys.get_mut(place) {
            Some(old) => *old = key,
            None => keys.push(key),
        }
        self.set(control, keys);
    }

    /// The other controls that have a key of this one: a press does the first of them in the table only.
    pub(crate) fn conflicts(&self, control: Control) -> impl Iterator<Item = &'static Entry> {
        let keys = self.keys_of(control);
        let others = TABLE.iter().zip(&self.0).filter(move |(entry, _)| entry.control != control);
        others.filter(|(_, other)| other.iter().any(|key| keys.contains(key))).map(|(entry, _)| entry)
    }

    /// What differs from a set of usual keys, for a settings file.
    pub(crate) fn changes_from(&self, set: KeySet) -> impl Iterator<Item = (&'static Entry, &[Key])> {
        let lines = TABLE.iter().zip(&self.0);
        lines
            .filter(move |(entry, keys)| usual_keys(entry, set) != *keys)
            .map(|(entry, keys)| (entry, &keys[..]))
    }
}

fn usual_keys(entry: &Entry, set: KeySet) -> &'static [Key] {
    match set {
        KeySet::Wasd => entry.keys,
        KeySet::Report => entry.report_keys.unwrap_or(entry.keys),
    }
}

/// The line of the table with that name in a settings file.
pub(crate) fn entry_of(id: &str) -> Option<&'static Entry> {
    TABLE.iter().find(|entry| entry.id == id)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::Keyboard;

    #[test]
    fn i3_each_key_stands_once_in_each_set() {
        for set in [KeySet::Wasd, KeySet::Report] {
            let bindings = Bindings::new(set);
            for entry in &TABLE {
                assert_eq!(bindings.conflicts(entry.control).count(), 0, "{set:?}: {}", entry.name);
                assert!((1..=MAX_KEYS).contains(&bindings.keys_of(entry.control).len()), "{}", entry.name);
                assert_eq!(
                    TABLE.iter().filter(|other| other.id == entry.id || other.name == entry.name).count(),
                    1
                );
                for key in bindings.keys_of(entry.control) {
                    assert_eq!(bindings.control_of(*key), Some(entry.control));
                    assert_eq!(Key::parse(&key.text()), Some(*key), "a settings file keeps it");
                }
            }
        }
        assert_eq!(Key::parse("no key"), None);
    }

    #[test]
    fn a_key_that_is_bound_anew_is_shown_as_a_conflict_until_one_gives_way() {
        let mut bindings = Bindings::default();
        let [restart, ghost] = [Act(Action::Restart), Act(Action::NextGhost)];
        bindings.set_key(ghost, 1, Place(KeyCode::KeyR));
        assert_eq!(bindings.keys_of(ghost), [Place(KeyCode::KeyG), Place(KeyCode::KeyR)]);
        assert_eq!(bindings.conflicts(ghost).map(|entry| entry.id).collect::<Vec<_>>(), ["restart"]);
        assert_eq!(bindings.conflicts(restart).map(|entry| entry.id).collect::<Vec<_>>(), ["ghost"]);
        bindings.set_key(restart, 0, Place(KeyCode::KeyK));
        assert_eq!(bindings.conflicts(ghost).count(), 0);
        assert_eq!(bindings.control_of(Place(KeyCode::KeyR)), Some(ghost));
        let changed: Vec<_> = bindings.changes_from(KeySet::Wasd).map(|(entry, _)| entry.id).collect();
        assert_eq!(changed, ["restart", "ghost"]);
    }

    /// The README's table, made from this one.
    fn readme_table() -> String {
        let keyboards = [KeySet::Wasd, KeySet::Report].map(|set| Keyboard::with(Bindings::new(set)));
        let mut table = "| does | keys | with `--keys report` |\n| --- | --- | --- |\n".to_owned();
        for entry in &TABLE {
            let [usual, report] = [0, 1].map(|i| keyboards[i].names_of(entry.control).join(", "));
            let report = if report == usual { "" } else { &report };
            table += &format!("| {} | {usual} | {report} |\n", entry.name);
        }
        table
    }

    #[test]
    fn the_readme_s_table_of_keys_is_this_one() {
        let readme = include_str!("../../../README.md");
        let table = readme_table();
        assert!(readme.contains(&table), "README.md, under Keys, must have this table:\n{table}");
    }
}
