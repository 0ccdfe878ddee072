//! What is printed on the keys of the player's keyboard, as far as the window system reports it.

use winit::keyboard::KeyCode;

/// What is printed at each place, for one layout.
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
        if let Some(name) = find_in(&EVERYWHERE, place) {
            return name.to_owned();
        }
        let Some(us) = us_letter(place) else { return format!("{place:?}") };
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
    US.iter().map(|(place, _)| *place)
}

/// What a US keyboard prints at the places whose letters differ from layout to layout.
const US: [(KeyCode, &str); 37] = [
    (KeyCode::KeyA, "A"),
    (KeyCode::KeyB, "B"),
    (KeyCode::KeyC, "C"),
    (KeyCode::KeyD, "D"),
    (KeyCode::KeyE, "E"),
    (KeyCode::KeyF, "F"),
    (KeyCode::KeyG, "G"),
    (KeyCode::KeyH, "H"),
    (KeyCode::KeyI, "I"),
    (KeyCode::KeyJ, "J"),
    (KeyCode::KeyK, "K"),
    (KeyCode::KeyL, "L"),
    (KeyCode::KeyM, "M"),
    (KeyCode::KeyN, "N"),
    (KeyCode::KeyO, "O"),
    (KeyCode::KeyP, "P"),
    (KeyCode::KeyQ, "Q"),
    (KeyCode::KeyR, "R"),
    (KeyCode::KeyS, "S"),
    (KeyCode::KeyT, "T"),
    (KeyCode::KeyU, "U"),
    (KeyCode::KeyV, "V"),
    (KeyCode::KeyW, "W"),
    (KeyCode::KeyX, "X"),
    (KeyCode::KeyY, "Y"),
    (KeyCode::KeyZ, "Z"),
    (KeyCode::Backquote, "`"),
    (KeyCode::Minus, "-"),
    (KeyCode::Equal, "="),
    (KeyCode::BracketLeft, "["),
    (KeyCode::BracketRight, "]"),
    (KeyCode::Backslash, "\\"),
    (KeyCode::Semicolon, ";"),
    (KeyCode::Quote, "'"),
    (KeyCode::Comma, ","),
    (KeyCode::Period, "."),
    (KeyCode::Slash, "/"),
];

/// Digits are printed on the caps of almost every layout, and a number pad is the same everywhere.
const EVERYWHERE: [(KeyCode, &str); 26] = [
    (KeyCode::Digit0, "0"),
    (KeyCode::Digit1, "1"),
    (KeyCode::Digit2, "2"),
    (KeyCode::Digit3, "3"),
    (KeyCode::Digit4, "4"),
    (KeyCode::Digit5, "5"),
    (KeyCode::Digit6, "6"),
    (KeyCode::Digit7, "7"),
    (KeyCode::Digit8, "8"),
    (KeyCode::Digit9, "9"),
    (KeyCode::Numpad0, "Num 0"),
    (KeyCode::Numpad1, "Num 1"),
    (KeyCode::Numpad2, "Num 2"),
    (KeyCode::Numpad3, "Num 3"),
    (KeyCode::Numpad4, "Num 4"),
    (KeyCode::Numpad5, "Num 5"),
    (KeyCode::Numpad6, "Num 6"),
    (KeyCode::Numpad7, "Num 7"),
    (KeyCode::Numpad8, "Num 8"),
    (KeyCode::Numpad9, "Num 9"),
    (KeyCode::NumpadAdd, "Num +"),
    (KeyCode::NumpadSubtract, "Num -"),
    (KeyCode::NumpadMultiply, "Num *"),
    (KeyCode::NumpadDivide, "Num /"),
    (KeyCode::NumpadDecimal, "Num ."),
    (KeyCode::IntlBackslash, "<"),
];

fn find_in(table: &[(KeyCode, &'static str)], place: KeyCode) -> Option<&'static str> {
    table.iter().find(|(known, _)| *known == place).map(|(_, letter)| *letter)
}

pub(super) fn us_letter(place: KeyCode) -> Option<&'static str> {
    find_in(&US, place)
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
