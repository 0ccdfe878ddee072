//! Which keys are down, and what a press of one means.

use super::bindings::{self, Action, Bindings, Control};
use super::letters::{Layout, Letters};
use super::tilt_control::Direction;
use winit::event::KeyEvent;
use winit::keyboard::{Key, KeyCode, ModifiersState, NamedKey, PhysicalKey};
use winit::platform::modifier_supplement::KeyEventExtModifierSupplement;

/// A key went down or up.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Stroke {
    /// Where it lies.
    pub(crate) place: KeyCode,
    /// What it prints or is called, with the modifiers that are held.
    pub(crate) key: Key,
    /// What it prints without any.
    pub(crate) letter: Key,
    pub(crate) is_pressed: bool,
    /// Made up by the window system, for a key that was already down when the window got the keyboard.
    pub(crate) is_synthetic: bool,
}

impl Stroke {
    /// `None` for a key that has no place, such as one of a keyboard on the screen.
    pub(crate) fn new(event: &KeyEvent, is_synthetic: bool) -> Option<Self> {
        let PhysicalKey::Code(place) = event.physical_key else { return None };
        Some(Self {
            place,
            key: event.logical_key.clone(),
            letter: event.key_without_modifiers(),
            is_pressed: event.state.is_pressed(),
            is_synthetic,
        })
    }

    /// How a binding names it.
    pub(crate) fn bound_key(&self) -> bindings::Key {
        match self.key {
            Key::Named(name) => bindings::Key::Name(name),
            // With Shift it prints a narrow space on some layouts.
            _ if self.place == KeyCode::Space => bindings::Key::Name(NamedKey::Space),
            _ => bindings::Key::Place(self.place),
        }
    }
}

/// The player's bindings, the keys that are down, the modifiers, and the letters of the player's layout.
#[derive(Debug, Default)]
pub(crate) struct Keyboard {
    bindings: Bindings,
    /// With what each was for when it went down: a modifier that comes later changes nothing.
    held: Vec<(KeyCode, Option<Control>)>,
    modifiers: ModifiersState,
    letters: Letters,
    is_unknown: bool,
}

/// What a stroke asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Effect {
    /// A direction's first key went down.
    Tilt(Direction),
    Act(Action),
}

impl Keyboard {
    #[cfg(test)]
    pub(crate) fn with(bindings: Bindings) -> Self {
        Self { bindings, ..Self::default() }
    }

    pub(crate) fn bindings(&self) -> &Bindings {
        &self.bindings
    }

    /// From the next press on; what is held stays what it is.
    pub(crate) fn bind(&mut self, bindings: Bindings) {
        self.bindings = bindings;
    }

    pub(crate) fn set_modifiers(&mut self, modifiers: ModifiersState) {
        self.modifiers = modifiers;
    }

    /// Registers a stroke, and returns its effect.
    pub(crate) fn stroke(&mut self, stroke: &Stroke) -> Option<Effect> {
        let was = self.held.iter().position(|(place, _)| *place == stroke.place);
        if !stroke.is_pressed {
            was.map(|index| self.held.remove(index));
            return None;
        }
        if let Some(index) = was {
            // The keyboard repeats it.
            return match self.held[index].1 {
                Some(Control::Act(action)) if action.repeats() => Some(Effect::Act(action)),
                _ => None,
            };
        }
        self.learn(stroke);
        let control = self.bindings.control_of(stroke.bound_key()).filter(|control| self.allows(*control));
        self.held.push((stroke.place, control));
        match control? {
            Control::Tilt(direction) => Some(Effect::Tilt(direction)),
            // It was pressed for another window.
            Control::Act(_) if stroke.is_synthetic => None,
            Control::Act(action) => Some(Effect::Act(action)),
        }
    }

    /// Shortcuts of the desktop and the window system are not handled. Shift is needed to print some of the marks that
    /// are shown for actions.
    fn allows(&self, control: Control) -> bool {
        match control {
            Control::Tilt(_) => self.modifiers.is_empty(),
            Control::Act(_) => (self.modifiers - ModifiersState::SHIFT).is_empty(),
        }
    }

    /// The window lost the keyboard: no release will come.
    pub(crate) fn release_all(&mut self) {
        self.held.clear();
    }

    /// The directions in which any key is down.
    pub(crate) fn directions(&self) -> impl Iterator<Item = Direction> {
        self.held.iter().filter_map(|(_, control)| match control {
            Some(Control::Tilt(direction)) => Some(*direction),
            _ => None,
        })
    }

    /// Takes note of what is printed on a key, for [`Keyboard::name_of`].
    fn learn(&mut self, stroke: &Stroke) {
        if let Key::Character(letter) = &stroke.letter {
            self.is_unknown |= !self.letters.see(stroke.place, &letter.to_uppercase());
        }
    }

    /// Whether a key printed what no known layout explains, since the last call: then the window system may know more.
    pub(crate) fn take_unknown(&mut self) -> bool {
        std::mem::take(&mut self.is_unknown)
    }

    /// The layouts that the window system tells of, if any; what was seen of the last press stays true.
    pub(crate) fn set_layouts(&mut self, layouts: Vec<Layout>, last: Option<&Stroke>) {
        self.letters.set_layouts(layouts);
        if let Some(stroke) = last {
            self.learn(stroke);
            self.is_unknown = false;
        }
    }

    /// What is printed on a key.
    pub(crate) fn name_of(&self, key: bindings::Key) -> String {
        match key {
            bindings::Key::Place(place) => self.letters.name(place),
            bindings::Key::Name(name) => match name {
                NamedKey::ArrowLeft => "Left".to_owned(),
                NamedKey::ArrowRight => "Right".to_owned(),
                NamedKey::ArrowUp => "Up".to_owned(),
                NamedKey::ArrowDown => "Down".to_owned(),
                NamedKey::Escape => "Esc".to_owned(),
                NamedKey::PageUp => "Page Up".to_owned(),
                NamedKey::PageDown => "Page Down".to_owned(),
                name => format!("{name:?}"),
            },
        }
    }

    /// The keys of a control, by what is printed on them.
    pub(crate) fn names_of(&self, control: Control) -> Vec<String> {
        self.bindings.keys_of(control).iter().map(|key| self.name_of(*key)).collect()
    }

    /// The first keys of some controls in a few letters, and the second ones of the tilt: arrows / W A S D.
    pub(crate) fn hint_of(&self, controls: &[Control]) -> String {
        let names: Vec<_> = controls.iter().map(|control| self.names_of(*control)).collect();
        let row = |place: usize| {
            let row: Option<Vec<&str>> = names.iter().map(|keys| Some(keys.get(place)?.as_str())).collect();
            let row = row?;
            Some(if row == ["Up", "Left", "Down", "Right"] { "arrows".to_owned() } else { row.join(" ") })
        };
        let is_tilt = matches!(controls.first(), Some(Control::Tilt(_)));
        row(0).into_iter().chain(row(1).filter(|_| is_tilt)).collect::<Vec<_>>().join(" / ")
    }

    /// All letters, to be compared with those of another frame.
    pub(crate) fn letters(&self) -> &Letters {
        &self.letters
    }
}

#[cfg(test)]
mod tests;
