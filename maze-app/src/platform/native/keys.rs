//! Keys and mouse: each input becomes a tilt or an action, or goes to the screen in front.

use super::{App, layout};
use crate::failure::Failure;
use crate::input::{self, Action, Control, Effect, Key, Stroke};
use crate::screen::Screen;
use crate::settings::Drag;
use winit::dpi::PhysicalPosition;
use winit::event::WindowEvent;
use winit::event_loop::ActiveEventLoop;
use winit::keyboard::NamedKey;

/// Keys that change what others mean: they are bound to nothing.
const MODIFIERS: [NamedKey; 7] = [
    NamedKey::Shift,
    NamedKey::Control,
    NamedKey::Alt,
    NamedKey::AltGraph,
    NamedKey::Super,
    NamedKey::CapsLock,
    NamedKey::NumLock,
];

impl App {
    pub(super) fn key(&mut self, event_loop: &ActiveEventLoop, event: &WindowEvent) -> Result<(), Failure> {
        let WindowEvent::KeyboardInput { event: key, is_synthetic, .. } = event else { return Ok(()) };
        let Some(stroke) = Stroke::new(key, *is_synthetic) else { return Ok(()) };
        // A press does one thing: what opens a screen is not for that screen, too.
        let is_playing = self.game.screens.is_playing();
        if is_playing || !stroke.is_pressed {
            self.play_key(event_loop, &stroke)?;
        }
        if is_playing {
            return Ok(());
        }
        if stroke.is_pressed && !key.repeat && self.menu_key(event_loop, &stroke)? {
            return Ok(());
        }
        self.idle.wake();
        if let Some(graphics) = &mut self.graphics {
            graphics.feed(event);
        }
        Ok(())
    }

    fn play_key(&mut self, event_loop: &ActiveEventLoop, stroke: &Stroke) -> Result<(), Failure> {
        let effect = self.game.keyboard.stroke(stroke);
        if self.game.keyboard.take_unknown() && self.presence.is_on_x11() {
            self.game.keyboard.set_layouts(layout::read(), Some(stroke));
        }
        self.game.control.hold(self.game.keyboard.directions());
        match effect {
            Some(Effect::Tilt(direction)) => self.game.control.tap(direction),
            Some(Effect::Act(action)) => self.act(event_loop, action)?,
            None => {}
        }
        Ok(())
    }

    fn act(&mut self, event_loop: &ActiveEventLoop, action: Action) -> Result<(), Failure> {
        let order = self.game.act(action)?;
        if !self.game.screens.is_playing() {
            // Releases are for the screen now.
            self.game.keyboard.release_all();
            self.game.control.release_all();
        }
        self.obey(event_loop, order)
    }

    /// What a key means on every screen; false for one that the screen in front gets.
    fn menu_key(&mut self, event_loop: &ActiveEventLoop, stroke: &Stroke) -> Result<bool, Failure> {
        let key = stroke.bound_key();
        if self.game.screens.captures.is_some() && key != Key::Name(NamedKey::Escape) {
            let is_modifier = matches!(key, Key::Name(name) if MODIFIERS.contains(&name));
            if !is_modifier {
                self.game.screens.capture(key, &mut self.game.settings);
                self.idle.wake();
            }
            return Ok(true);
        }
        if key == Key::Name(NamedKey::Escape) {
            let order = self.game.back()?;
            self.obey(event_loop, order)?;
            return Ok(true);
        }
        let Some(Control::Act(action)) = self.game.keyboard.bindings().control_of(key) else {
            return Ok(false);
        };
        let is_wanted = match action {
            Action::ToggleFullscreen | Action::Screenshot | Action::ToggleFrames => true,
            Action::Restart | Action::GoOn | Action::NextLevel | Action::PreviousLevel => {
                self.game.screens.top() == Screen::Result
            }
            _ => false,
        };
        if is_wanted {
            self.act(event_loop, action)?;
        }
        Ok(is_wanted)
    }

    pub(super) fn pointer(&mut self, position: PhysicalPosition<f64>) {
        let from = self.cursor.replace(position);
        if let (Some(from), Some(graphics)) = (from, &self.graphics) {
            let (from, to) = (from.into(), position.into());
            self.game.control.drag_by(match self.game.settings.controls.drag {
                Drag::Arcball => input::drag_tangents(graphics.size(), from, to),
                Drag::Relative => input::relative_tangents(from, to),
            });
        }
    }

    /// The window got the keyboard, or lost it: then no release will come.
    pub(super) fn focus(&mut self, has_it: bool) {
        self.presence.focus(has_it);
        if !has_it {
            self.game.keyboard.release_all();
            self.game.control.release_all();
        }
    }
}
