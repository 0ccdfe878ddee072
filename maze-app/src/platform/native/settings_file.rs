//! Where settings are kept: one file in the player's configuration directory, read once and written whole.

use super::files;
use crate::settings::{Settings, merged};
use directories::ProjectDirs;
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use toml::Table;

const NAME: &str = "settings.toml";

/// Larger is no settings file.
const MAX_BYTES: u64 = 1 << 20;

/// The file, and what it held when it was read or written last.
pub(crate) struct SettingsFile {
    /// None where there is no home.
    path: Option<PathBuf>,
    base: Table,
    has_failed: bool,
}

impl SettingsFile {
    /// Reads the file of that name, or the one in the player's configuration directory. Also says, if so, why what is there is
    /// not used: it is put aside under the same name with `.bad` at its end, and the usual settings hold.
    pub(crate) fn open(path: Option<PathBuf>) -> (Self, Settings, Option<String>) {
        let path = path.or_else(|| Some(ProjectDirs::from("", "", "maze")?.config_dir().join(NAME)));
        let (settings, told) = match path.as_deref().map(read) {
            None => (Settings::default(), None),
            Some(Ok(settings)) => (settings, None),
            Some(Err(reason)) => (Settings::default(), Some(reason)),
        };
        (Self { path, base: settings.table(), has_failed: false }, settings, told)
    }

    /// Keeps nothing.
    pub(crate) fn none() -> Self {
        Self { path: None, base: Table::new(), has_failed: false }
    }

    /// These settings are not the player's choice, and are written only where they change.
    pub(crate) fn take_for_written(&mut self, settings: &Settings) {
        self.base = settings.table();
    }

    /// Writes what has changed since the last time, beside what others have changed. Returns why it cannot, once.
    pub(crate) fn save(&mut self, settings: &Settings) -> Option<String> {
        let ours = settings.table();
        if ours == self.base {
            return None;
        }
        let path = self.path.as_deref()?;
        let now = fs::read_to_string(path).ok().and_then(|text| {
            Settings::parse(&text).ok()?;
            text.parse().ok()
        });
        let table = now.map_or_else(|| ours.clone(), |now| merged(now, &self.base, &ours));
        let written = path.parent().map_or(Ok(()), fs::create_dir_all).map_err(|error| error.to_string());
        let written = written.and_then(|()| {
            files::write_whole(path, table.to_string().as_bytes()).map_err(|failure| failure.to_string())
        });
        match written {
            Ok(()) => {
                self.base = ours;
                None
            }
            Err(reason) if !self.has_failed => {
                self.has_failed = true;
                Some(format!("settings are not kept: {reason}"))
            }
            Err(_) => None,
        }
    }
}

/// A file that is not there holds the usual settings.
fn read(path: &Path) -> Result<Settings, String> {
    match fs::metadata(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Settings::default()),
        Err(error) => return Err(format!("settings are not read: {}: {error}", path.display())),
        Ok(_) => {}
    }
    let text = files::read_at_most(path, MAX_BYTES)
        .map_err(|failure| failure.to_string())
        .and_then(|bytes| String::from_utf8(bytes).map_err(|_| "no text in UTF-8".to_owned()));
    text.and_then(|text| Settings::parse(&text)).map_err(|reason| {
        let aside = PathBuf::from(format!("{}.bad", path.display()));
        let moved = match fs::rename(path, &aside) {
            Ok(()) => format!("put aside as {}", aside.display()),
            Err(error) => format!("it cannot be put aside: {error}"),
        };
        format!("{}: {reason}; {moved}", path.display())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn open(path: &Path) -> (SettingsFile, Settings, Option<String>) {
        SettingsFile::open(Some(path.to_path_buf()))
    }

    #[test]
    fn settings_last_from_one_start_to_the_next() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("not yet there/settings.toml");
        let (mut file, mut settings, told) = open(&path);
        assert_eq!((&settings, told), (&Settings::default(), None));
        assert_eq!(file.save(&settings), None);
        assert!(!path.exists(), "nothing has changed");
        settings.video.ui_scale = 1.5;
        assert_eq!(file.save(&settings), None);
        assert_eq!(open(&path).1, settings);
    }

    #[test]
    fn a_file_that_cannot_be_read_is_put_aside_and_told() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join(NAME);
        for bytes in [&b"[video"[..], b"version = 7", b"\xff\xfe", b"[video]\nvsync = 3"] {
            fs::write(&path, bytes).unwrap();
            let (mut file, mut settings, told) = open(&path);
            assert!(told.unwrap().contains("put aside as"));
            assert_eq!(fs::read(directory.path().join("settings.toml.bad")).unwrap(), bytes);
            assert!(settings == Settings::default() && !path.exists());
            settings.video.vsync = false;
            assert_eq!(file.save(&settings), None);
            assert_eq!(open(&path).2, None);
        }
        // A directory in its place: nothing is lost, and the game plays.
        fs::remove_file(&path).unwrap();
        fs::create_dir(&path).unwrap();
        assert!(open(&path).2.is_some());
    }

    #[test]
    fn where_nothing_can_be_written_that_is_told_once() {
        let directory = tempfile::tempdir().unwrap();
        let blocked = directory.path().join("a file");
        fs::write(&blocked, b"").unwrap();
        let (mut file, mut settings, _) = open(&blocked.join("settings.toml"));
        settings.video.vsync = false;
        assert!(file.save(&settings).unwrap().starts_with("settings are not kept: "));
        assert_eq!(file.save(&settings), None);
    }

    #[test]
    fn two_programs_at_once_keep_both_changes_and_never_half_a_file() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join(NAME);
        let (mut one, mut settings_one, _) = open(&path);
        let (mut other, mut settings_other, _) = open(&path);
        settings_one.video.vsync = false;
        settings_other.controls.invert_x = true;
        assert_eq!((one.save(&settings_one), other.save(&settings_other)), (None, None));
        let (_, both, told) = open(&path);
        assert!(!both.video.vsync && both.controls.invert_x && told.is_none());
        std::thread::scope(|scope| {
            for i in 0..2_u32 {
                let path = &path;
                scope.spawn(move || {
                    let (mut file, mut settings, told) = open(path);
                    for n in 0..100 {
                        settings.memory.level = Some(1 + n);
                        settings.video.frame_cap = [60, 120][i as usize];
                        assert_eq!((file.save(&settings), &told), (None, &None));
                        assert_eq!(open(path).2, None, "half a file");
                    }
                });
            }
        });
    }
}
