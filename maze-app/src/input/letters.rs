//! What is printed on the keys of the player's keyboard, as far as the window system reports it.

use super::bindings;
use winit::keyboard::KeyCode;

/// Letters of the places in the table of bindings, for one layout.
pub(crate) type Layout = Vec<(KeyCode, String)>;

/// What is known of the player's layout: all of it where the window system can be asked, else key by key as they are pressed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Letters {
    /// Those that the player can switch between.
    layouts: Vec<Layout>,
    current: usize,
    /// Pressed, and in none of the layouts.
    seen: Layout,
}

impl Letters {
    /// The window system's answer, with the letters in capitals.
    pub(crate) fn set_layouts(&mut self, layouts: Vec<Layout>) {
        *self = Self { layouts, ..Self::default() };
    }

    /// A key was pressed and prints a letter. False when no known layout explains it.
    pub(super) fn see(&mut self, place: KeyCode, letter: &str) -> bool {
        if us_letter(place).is_none() || letter.trim().is_empty() {
            return true;
        }
        let is_news = self.name(place) != letter;
        if is_news
            && let Some(layout) = self.layouts.iter().position(|layout| find(layout, place) == Some(letter))
        {
            self.current = layout;
            self.seen.clear();
            return true;
        }
        if find(&self.seen, place).is_some_and(|seen| seen != letter) {
            // The player has changed the layout: what was seen before is that of another.
            self.seen.clear();
        }
        if find(&self.seen, place).is_none() && (is_news || self.layouts.is_empty()) {
            self.seen.push((place, letter.to_owned()));
        }
        !is_news
    }

    /// What is printed on the key at a place.
    pub(crate) fn name(&self, place: KeyCode) -> String {
        let layout = self.layouts.get(self.current);
        if let Some(letter) = find(&self.seen, place).or_else(|| find(layout?, place)) {
            return letter.to_owned();
        }
        let us = us_letter(place).unwrap_or("?");
        // A letter that is somewhere else on this keyboard, as far as is known, would mislead.
        let is_letter = |name: &str| name.chars().all(|letter| letter.is_ascii_alphabetic());
        let differs = |us: &str, letter: &str| is_letter(us) && us != letter;
        let mut seen = self.seen.iter();
        let is_other = seen.any(|(place, letter)| us_letter(*place).is_some_and(|us| differs(us, letter)));
        if layout.is_none() && is_other && is_letter(us) { format!("US {us}") } else { us.to_owned() }
    }
}

fn find(layout: &Layout, place: KeyCode) -> Option<&str> {
    layout.iter().find(|(known, _)| *known == place).map(|(_, letter)| letter.as_str())
}

/// The places whose letters are shown.
pub(crate) fn lettered_places() -> impl Iterator<Item = KeyCode> {
    bindings::places().filter(|place| us_letter(*place).is_some())
}

/// What a US keyboard prints at the places of the table; digits are printed on the caps of almost every layout.
pub(super) fn us_letter(place: KeyCode) -> Option<&'static str> {
    Some(match place {
        KeyCode::KeyA => "A",
        KeyCode::KeyB => "B",
        KeyCode::KeyD => "D",
        KeyCode::KeyG => "G",
        KeyCode::KeyH => "H",
        KeyCode::KeyN => "N",
        KeyCode::KeyP => "P",
        KeyCode::KeyQ => "Q",
        KeyCode::KeyR => "R",
        KeyCode::KeyS => "S",
        KeyCode::KeyT => "T",
        KeyCode::KeyW => "W",
        KeyCode::KeyX => "X",
        KeyCode::Period => ".",
        KeyCode::Minus => "-",
        KeyCode::Equal => "=",
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn layout(letters: &[(KeyCode, &str)]) -> Layout {
        letters.iter().map(|(place, letter)| (*place, (*letter).to_owned())).collect()
    }

    #[test]
    fn i2_a_layout_that_is_told_is_shown_at_once_and_a_press_tells_which_one_is_used() {
        let mut letters = Letters::default();
        let us = layout(&[(KeyCode::KeyR, "R"), (KeyCode::KeyN, "N"), (KeyCode::KeyT, "T")]);
        let ru = layout(&[(KeyCode::KeyR, "К"), (KeyCode::KeyN, "Т"), (KeyCode::KeyT, "Е")]);
        letters.set_layouts(vec![us, ru]);
        assert_eq!(letters.name(KeyCode::KeyN), "N");
        assert!(letters.see(KeyCode::KeyR, "К"));
        assert_eq!([KeyCode::KeyN, KeyCode::KeyT].map(|place| letters.name(place)), ["Т", "Е"]);
        assert!(letters.see(KeyCode::KeyT, "T"));
        assert_eq!(letters.name(KeyCode::KeyR), "R");
        // Another layout than those that were reported.
        assert!(!letters.see(KeyCode::KeyT, "ק"));
        assert_eq!(letters.name(KeyCode::KeyT), "ק");
    }

    #[test]
    fn i3_no_letter_is_shown_for_two_keys_when_the_layout_is_seen_key_by_key() {
        let mut letters = Letters::default();
        assert_eq!(letters.name(KeyCode::KeyT), "T");
        // Dvorak: R prints p, and P something that is not known yet.
        assert!(!letters.see(KeyCode::KeyR, "P"));
        assert_eq!([KeyCode::KeyR, KeyCode::KeyP].map(|place| letters.name(place)), ["P", "US P"]);
        // German has other marks and the same letters.
        let mut letters = Letters::default();
        letters.see(KeyCode::Minus, "ß");
        assert_eq!([KeyCode::Minus, KeyCode::KeyP].map(|place| letters.name(place)), ["ß", "P"]);
    }
}
