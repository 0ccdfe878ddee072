//! What the picture is drawn with: textures and quality, and whether it keeps up.

use super::App;
use super::sidecar;
use crate::clock;
use crate::failure::Failure;
use crate::input::{Action, Control};
use crate::platform::native::files;
use crate::quality::QualityChoice;
use crate::settings::QualitySetting;
use crate::slowness::Slowness;
use crate::source::Source;
use maze_render::{Quality, TextureSet};
use std::path::{Path, PathBuf};
use std::time::Duration;

pub(crate) struct Look {
    pub(super) textures: TextureSet,
    /// Where they come from whatever the maze.
    textures_flag: Option<PathBuf>,
    pub(super) quality: QualityChoice,
    slowness: Slowness,
}

impl Look {
    pub(crate) fn new(textures: TextureSet, textures_flag: Option<PathBuf>, quality: QualityChoice) -> Self {
        Self { textures, textures_flag, quality, slowness: Slowness::default() }
    }

    /// What a maze's surfaces look like: as its sidecar says, where no flag does.
    pub(super) fn textures_of(&self, source: &Source) -> Result<TextureSet, Failure> {
        sidecar::textures(self.textures_flag.as_deref(), source.file())
    }

    /// Whether a choice of the quality is one that the picture has to follow: an automatic one may have been lowered.
    pub(super) fn is_wanted(&self, choice: QualityChoice) -> bool {
        choice.is_chosen() || self.slowness.told().is_none()
    }
}

impl App {
    /// The maze has to be set again afterwards.
    pub(super) fn cover_with(&mut self, textures: TextureSet) {
        if textures != self.look.textures {
            self.look.textures = textures;
            if let Some(graphics) = &mut self.graphics {
                graphics.set_look(graphics.quality(), &self.look.textures);
            }
        }
    }

    /// From now on it is the player's.
    pub(super) fn next_quality(&mut self) {
        let Some(graphics) = &self.graphics else { return };
        let quality = graphics.quality().next();
        self.game.settings.video.quality = match quality {
            Quality::Low => QualitySetting::Low,
            Quality::Medium => QualitySetting::Medium,
            Quality::High => QualitySetting::High,
        };
        self.notify(format!("quality: {}", quality.name()));
    }

    pub(super) fn set_quality(&mut self, quality: Quality) {
        if let Some(graphics) = &mut self.graphics {
            graphics.set_look(quality, &self.look.textures);
        }
        self.look.slowness.forget();
        if let Err(failure) = self.load_into_graphics() {
            self.notify(failure.to_string());
        }
    }

    /// Where frames come too slowly for the game, the picture gets cheaper, and never dearer again by itself.
    pub(super) fn keep_up(&mut self, elapsed: Duration) -> Result<(), Failure> {
        let is_still = self.game.clock.pace() == Some(clock::PAUSED) || !self.game.moves();
        if is_still || self.presence.waits() || self.game.board.is_demo() {
            self.look.slowness.forget();
            return Ok(());
        }
        self.look.slowness.push(elapsed, self.game.clock.lost());
        let Some(graphics) = &self.graphics else { return Ok(()) };
        let stays = self.look.quality.is_chosen() || !self.game.settings.video.lower_quality_when_slow;
        let remedy = self.look.slowness.remedy(graphics.quality(), stays);
        if let (Some(told), Some(quality)) = (self.look.slowness.told(), remedy) {
            self.set_quality(quality);
            self.notify(format!("slow machine: {told}; quality: {} from now on", quality.name()));
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
                    let key = self.game.keyboard.hint_of(&[Control::Act(Action::NextQuality)]);
                    format!("; {key} changes the quality")
                }
                None => "; a smaller window is faster".to_owned(),
            };
            format!("slow machine: {told}{hint}")
        };
        self.look.slowness.told().map(slow).or(self.game.clock.pace().map(str::to_owned))
    }

    /// What is shown of maze and method, without the rest of the HUD, into the working directory. That this may fail is no
    /// reason to end the game.
    pub(super) fn screenshot(&mut self) {
        let picture = self.picture([0.0; 2]);
        let (Some(graphics), Some((scene, notes))) = (&mut self.graphics, picture) else { return };
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
    use crate::game::{Board, Role, Rules};
    use crate::platform::native::SettingsFile;
    use crate::screen::{Date, Screen};
    use crate::settings::Settings;
    use crate::setup::{Options, Setup};

    /// Without a window.
    fn app() -> App {
        let rules = Rules {
            engine: EngineKind::Continuous,
            max_tilt_rad: 0.3,
            demo: false,
            rounds: false,
            seed: 1,
            today: Date::default(),
        };
        let source = Source::level(1).unwrap();
        let board = Board::new(source.load().unwrap(), source, Role::Play, &rules).unwrap();
        let setup = Setup {
            settings: Settings::default(),
            rules,
            first: Screen::Playing,
            look: Look::new(files::textures(None).unwrap(), None, QualityChoice::Auto),
            record: None,
            state_log: None,
            csv: None,
            exit_after: None,
            unfocused: None,
        };
        App::new(setup, Options::default(), board, SettingsFile::none(), None).unwrap()
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
        let ours = app.look.textures.clone();
        let drop_file = |app: &mut App| {
            let source = app.game.board.source.of_file(file("maze.txt"));
            app.load(source, Role::Play).unwrap();
        };

        drop_file(&mut app);
        assert_eq!(app.notice, None);
        assert!(app.look.textures.wall == ours.floor && app.look.textures.floor == ours.floor, "its own");

        write("maze.toml", b"textures = 'nowhere'\n");
        drop_file(&mut app);
        assert!(app.notice.as_ref().is_some_and(|(text, _)| text.contains("nowhere")), "{:?}", app.notice);
        assert!(app.look.textures.wall == ours.floor, "what is shown stays");

        let mut source = app.game.board.source.clone();
        let changed = source.change_level(true).unwrap();
        app.load(source, Role::Play).unwrap();
        assert!(changed && app.look.textures == ours, "a level has none of its own");
    }
}
