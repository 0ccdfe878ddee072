//! How the picture is drawn, and pictures into files.

use super::App;
use crate::failure::Failure;
use crate::files;
use crate::sidecar;
use crate::source::Source;
use image::ImageFormat;
use maze_render::TextureSet;
use std::io::Cursor;
use std::path::Path;
use std::time::Instant;

impl App {
    pub(super) fn notify(&mut self, notice: String) {
        self.notice = Some((notice, Instant::now()));
    }

    /// What a maze's surfaces look like: as its sidecar says, where no flag does.
    pub(super) fn textures_of(&self, source: &Source) -> Result<TextureSet, Failure> {
        sidecar::textures(self.textures_flag.as_deref(), source.file())
    }

    /// The maze has to be set again afterwards.
    pub(super) fn cover_with(&mut self, textures: TextureSet) {
        if textures != self.textures {
            self.textures = textures;
            if let Some(graphics) = &mut self.graphics {
                graphics.set_look(graphics.quality(), &self.textures);
            }
        }
    }

    pub(super) fn next_quality(&mut self) -> Result<(), Failure> {
        let Some(graphics) = &mut self.graphics else { return Ok(()) };
        let quality = graphics.quality().next();
        graphics.set_look(quality, &self.textures);
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
