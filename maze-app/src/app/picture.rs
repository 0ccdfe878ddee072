//! How the picture is drawn, and pictures into files.

use super::App;
use crate::failure::Failure;
use crate::files;
use image::ImageFormat;
use std::io::Cursor;
use std::path::Path;
use std::time::Instant;

impl App {
    pub(super) fn notify(&mut self, notice: String) {
        self.notice = Some((notice, Instant::now()));
    }

    pub(super) fn next_quality(&mut self) -> Result<(), Failure> {
        let Some(graphics) = &mut self.graphics else { return Ok(()) };
        let quality = graphics.quality().next();
        graphics.set_quality(quality, &self.textures);
        self.notify(format!("quality: {}", quality.name()));
        self.load_into_graphics()
    }

    /// What is shown of maze and method, without the rest of the HUD, into the working directory. That this may fail is no reason to end the game.
    pub(super) fn screenshot(&mut self) {
        let (Some(graphics), Some((scene, notes))) = (&mut self.graphics, self.idle.picture()) else {
            return;
        };
        let saved = graphics.screenshot(&scene, &notes).and_then(|picture| {
            let mut png = Cursor::new(Vec::new());
            picture.write_to(&mut png, ImageFormat::Png).map_err(Failure::bad_input)?;
            files::write_numbered(Path::new(""), "maze", "png", png.get_ref())
        });
        self.notify(match saved {
            Ok(path) => format!("saved {}", path.display()),
            Err(failure) => failure.to_string(),
        });
    }
}
