//! Whether the player is there: the game's time stands while it is not visible, and while another window has the keyboard.

use super::watch::Watch;
use crate::setup::Unfocused;

/// What the window system has reported about the window.
#[derive(Default)]
pub(super) struct Presence {
    unfocused: Unfocused,
    is_occluded: bool,
    /// None before it had the keyboard for the first time: without a window manager it never gets it, and plays.
    has_keyboard: Option<bool>,
    /// Where events do not report everything.
    watch: Option<Watch>,
}

impl Presence {
    pub(super) fn new(unfocused: Unfocused) -> Self {
        Self { unfocused, ..Self::default() }
    }

    /// The player has chosen otherwise.
    pub(super) fn set(&mut self, unfocused: Unfocused) {
        self.unfocused = unfocused;
    }

    pub(super) fn watch(&mut self, watch: Option<Watch>) {
        self.watch = watch;
    }

    /// Whether there is an X server to ask.
    pub(super) fn is_on_x11(&self) -> bool {
        self.watch.is_some()
    }

    pub(super) fn occlude(&mut self, is_occluded: bool) {
        self.is_occluded = is_occluded;
    }

    pub(super) fn focus(&mut self, has_it: bool) {
        if has_it || self.has_keyboard.is_some() {
            self.has_keyboard = Some(has_it);
        }
    }

    /// Behind other windows, minimised, or on another workspace.
    pub(super) fn is_hidden(&self) -> bool {
        self.is_occluded || self.watch.as_ref().is_some_and(Watch::is_hidden)
    }

    /// In view, and waiting for the keyboard.
    pub(super) fn waits(&self) -> bool {
        self.unfocused == Unfocused::Pause && self.has_keyboard == Some(false)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn i11_a_window_waits_for_the_keyboard_that_it_had_unless_it_is_to_run_on() {
        let mut presence = Presence::new(Unfocused::Pause);
        presence.focus(false);
        assert!(!presence.waits(), "there may be no window manager that would ever give it");
        for has_it in [true, false, true] {
            presence.focus(has_it);
            assert_eq!(presence.waits(), !has_it);
        }
        let mut presence = Presence::new(Unfocused::Run);
        presence.focus(true);
        presence.focus(false);
        assert!(!presence.waits());
    }
}
