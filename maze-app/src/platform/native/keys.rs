//! Keys and mouse: each input becomes a tilt or an action.

use super::{App, layout};
use crate::failure::Failure;
use crate::input::{self, Effect, Stroke};
use winit::dpi::PhysicalPosition;
use winit::event::KeyEvent;
use winit::event_loop::ActiveEventLoop;

impl App {
    pub(super) fn key(
        &mut self,
        event_loop: &ActiveEventLoop,
        event: &KeyEvent,
        is_synthetic: bool,
    ) -> Result<(), Failure> {
        let Some(stroke) = Stroke::new(event, is_synthetic) else { return Ok(()) };
        let effect = self.keyboard.stroke(&stroke);
        if self.keyboard.take_unknown() && self.presence.is_on_x11() {
            self.keyboard.set_layouts(layout::read(), Some(&stroke));
        }
        self.control.hold(self.keyboard.directions());
        match effect {
            Some(Effect::Tilt(direction)) => self.control.tap(direction),
            Some(Effect::Act(action)) => self.act(event_loop, action)?,
            None => {}
        }
        Ok(())
    }

    pub(super) fn pointer(&mut self, position: PhysicalPosition<f64>) {
        let from = self.cursor.replace(position);
        if let (Some(from), Some(graphics)) = (from, &self.graphics) {
            self.control.drag_by(input::drag_tangents(graphics.size(), from.into(), position.into()));
        }
    }

    /// The window got the keyboard, or lost it: then no release will come.
    pub(super) fn focus(&mut self, has_it: bool) {
        self.presence.focus(has_it);
        if !has_it {
            self.keyboard.release_all();
            self.control.release_all();
        }
    }
}
