//! How the picture is drawn, and pictures into files.

use super::App;
use crate::clock;
use crate::failure::Failure;
use crate::input::{Action, Control};
use crate::platform::native::files;
use crate::platform::native::sidecar;
use crate::source::Source;
use maze_render::{Quality, TextureSet};
use std::path::Path;
use std::time::{Duration, Instant};

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
        // From now on it is the player's.
        self.quality_is_chosen = true;
        self.set_quality(quality)?;
        self.notify(format!("quality: {}", quality.name()));
        Ok(())
    }

    fn set_quality(&mut self, quality: Quality) -> Result<(), Failure> {
        if let Some(graphics) = &mut self.graphics {
            graphics.set_look(quality, &self.textures);
        }
        self.slowness.forget();
        self.load_into_graphics()
    }

    /// Where frames come too slowly for the game, the picture gets cheaper, and never dearer again by itself.
    pub(super) fn keep_up(&mut self, elapsed: Duration) -> Result<(), Failure> {
        if self.clock.pace() == Some(clock::PAUSED) || self.presence.waits() || self.demo.is_some() {
            self.slowness.forget();
            return Ok(());
        }
        self.slowness.push(elapsed, self.clock.lost());
        let Some(graphics) = &self.graphics else { return Ok(()) };
        let remedy = self.slowness.remedy(graphics.quality(), self.quality_is_chosen);
        if let (Some(told), Some(quality)) = (self.slowness.told(), remedy) {
            self.set_quality(quality)?;
            self.notify(format!("slow: {told}; quality: {} from now on", quality.name()));
        }
        Ok(())
    }

    /// The text shown while the game does not run at its usual speed.
    pub(super) fn pace(&self) -> Option<String> {
        if self.presence.waits() {
            return Some("paused: click here to go on".to_owned());
        }
        let slow = |told| {
            let hint = match self.graphics.as_ref().and_then(|graphics| graphics.quality().cheaper()) {
                Some(_) => {
                    let key = self.keyboard.letter_of(Control::Act(Action::NextQuality));
                    format!("; {key} changes the quality")
                }
                None => "; a smaller window is faster".to_owned(),
            };
            format!("slow: {told}{hint}")
        };
        self.slowness.told().map(slow).or(self.clock.pace().map(str::to_owned))
    }

    /// What is shown of maze and method, without the rest of the HUD, into the working directory. That this may fail is no reason to end the game.
    pub(super) fn screenshot(&mut self) {
        let (Some(graphics), Some((scene, notes))) = (&mut self.graphics, self.idle.picture()) else {
            return;
        };
        let saved = graphics
            .screenshot(&scene, &notes)
            .and_then(|picture| files::write_numbered(Path::new(""), "maze", "png", &files::png(picture)?));
        self.notify(match saved {
            Ok(path) => format!("saved {}", path.display()),
            Err(failure) => failure.to_string(),
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine_kind::EngineKind;
    use crate::platform::native::Options;
    use crate::quality::QualityChoice;
    use crate::setup::Setup;
    use crate::source::MazeArguments;
    use clap::Parser;

    #[derive(Parser)]
    struct Cli {
        #[command(flatten)]
        maze: MazeArguments,
    }

    /// Without a window.
    fn app() -> App {
        let source = Source::new(&Cli::parse_from(["", "--level", "1"]).maze).unwrap();
        let maze = source.load().unwrap();
        let setup = Setup {
            source,
            textures: files::textures(None).unwrap(),
            textures_flag: None,
            engine: EngineKind::Continuous,
            max_tilt_rad: 0.3,
            state_log: None,
            record: None,
            csv: None,
            exit_after: None,
            unfocused: None,
            quality: QualityChoice::Auto,
        };
        App::new(setup, Options::default(), maze).unwrap()
    }

    #[test]
    fn a_dropped_file_brings_its_sidecar_s_textures_and_the_next_level_has_ours() {
        let directory = tempfile::tempdir().unwrap();
        let file = |name: &str| directory.path().join(name);
        let write = |name: &str, bytes: &[u8]| std::fs::write(file(name), bytes).unwrap();
        let floor = concat!(env!("CARGO_MANIFEST_DIR"), "/../assets/textures/floor.bmp");
        for name in ["wall.bmp", "floor.bmp", "top.bmp"] {
            std::fs::copy(floor, file(name)).unwrap();
        }
        write("maze.txt", b"#####\n#S G#\n#####\n");
        write("maze.toml", b"textures = '.'\n");
        let mut app = app();
        let ours = app.textures.clone();

        app.drop_file(file("maze.txt")).unwrap();
        assert_eq!(app.notice, None);
        assert!(app.textures.wall == ours.floor && app.textures.floor == ours.floor, "its own");

        write("maze.toml", b"textures = 'nowhere'\n");
        app.drop_file(file("maze.txt")).unwrap();
        assert!(app.notice.as_ref().is_some_and(|(text, _)| text.contains("nowhere")), "{:?}", app.notice);
        assert!(app.textures.wall == ours.floor, "what is shown stays");

        let changed = app.source.change_level(true).unwrap();
        app.load(changed).unwrap();
        assert!(changed && app.textures == ours, "a level has none of its own");
    }
}
