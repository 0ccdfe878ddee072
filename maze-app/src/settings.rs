//! What a player can choose and what lasts from one start to the next: plain data and its text.
//!
//! A setting is a field here and a line in `screen/settings.rs`.

use crate::input::{Bindings, Control, Key, KeySet, MAX_KEYS, TABLE, entry_of};
use crate::numbers::to_f32;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::PathBuf;
use toml::{Table, Value};

/// Of the text; each change of what a key means is a new version and a step in [`STEPS`].
const VERSION: i64 = 1;

/// From version i + 1 to i + 2.
const STEPS: [fn(&mut Table); 0] = [];

/// How many files are remembered.
const MAX_RECENT: usize = 6;

#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, rename_all = "kebab-case")]
pub(crate) struct Settings {
    pub(crate) video: Video,
    pub(crate) controls: Controls,
    pub(crate) accessibility: Accessibility,
    pub(crate) game: Play,
    pub(crate) memory: Memory,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, rename_all = "kebab-case")]
pub(crate) struct Video {
    pub(crate) quality: QualitySetting,
    pub(crate) fullscreen: bool,
    /// Frames in step with the screen.
    pub(crate) vsync: bool,
    /// Most frames a second; 0 is what suits the adapter.
    pub(crate) frame_cap: u32,
    /// Of everything that is written.
    pub(crate) ui_scale: f32,
    pub(crate) camera: CameraMode,
    pub(crate) reduced_motion: bool,
    /// Whether a slow machine gets a cheaper picture by itself.
    pub(crate) lower_quality_when_slow: bool,
}

impl Default for Video {
    fn default() -> Self {
        Self {
            quality: QualitySetting::Auto,
            fullscreen: false,
            vsync: true,
            frame_cap: 0,
            ui_scale: 1.0,
            camera: CameraMode::Fixed,
            reduced_motion: false,
            lower_quality_when_slow: true,
        }
    }
}

/// A name on screen for each value of a setting.
pub(crate) trait Named: Copy + PartialEq + 'static {
    /// With what it is called.
    const ALL: &'static [(Self, &'static str)];
}

macro_rules! choice {
    ($(#[$doc:meta])* $name:ident { $($(#[$variant_doc:meta])* $variant:ident = $text:literal),+ $(,)? }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
        #[serde(rename_all = "kebab-case")]
        pub(crate) enum $name { $($(#[$variant_doc])* $variant),+ }
        impl Named for $name {
            const ALL: &'static [(Self, &'static str)] = &[$((Self::$variant, $text)),+];
        }
    };
}

choice!(
    /// How much is spent on the picture.
    QualitySetting {
        #[default]
        Auto = "auto",
        Low = "low",
        Medium = "medium",
        High = "high",
    }
);
choice!(
    /// Where the board is seen from.
    CameraMode {
        #[default]
        Fixed = "fixed",
        Follow = "follow the ball",
        Above = "from above",
    }
);
choice!(
    /// What a drag of the mouse means.
    Drag {
        /// The report's: by the size of the window.
        #[default]
        Arcball = "arcball",
        /// By pixels, whatever the window.
        Relative = "relative",
    }
);
choice!(
    /// How strongly a small movement tilts.
    Curve {
        #[default]
        Linear = "linear",
        Gentle = "gentle",
        Finest = "finest",
    }
);

impl Named for KeySet {
    const ALL: &'static [(Self, &'static str)] = &[(Self::Wasd, "W A S D"), (Self::Report, "the report's")];
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, rename_all = "kebab-case")]
pub(crate) struct Controls {
    pub(crate) drag: Drag,
    pub(crate) sensitivity: f64,
    pub(crate) invert_x: bool,
    pub(crate) invert_y: bool,
    pub(crate) curve: Curve,
    /// How fast keys tip the board; 1 is the usual speed.
    pub(crate) key_speed: f64,
    pub(crate) set: KeySet,
    /// What differs from the set: names of keys for the id of a control.
    bound: BTreeMap<String, Vec<String>>,
}

impl Default for Controls {
    fn default() -> Self {
        Self {
            drag: Drag::Arcball,
            sensitivity: 1.0,
            invert_x: false,
            invert_y: false,
            curve: Curve::Linear,
            key_speed: 1.0,
            set: KeySet::Wasd,
            bound: BTreeMap::new(),
        }
    }
}

impl Controls {
    /// The keys of the set, and the player's own instead. Names that are not known are passed over.
    pub(crate) fn bindings(&self) -> Bindings {
        let mut bindings = Bindings::new(self.set);
        for (id, keys) in &self.bound {
            if let Some(entry) = entry_of(id) {
                let keys = keys.iter().filter_map(|key| Key::parse(key)).take(MAX_KEYS).collect();
                bindings.set(entry.control, keys);
            }
        }
        bindings
    }

    /// Keeps what differs from the set.
    pub(crate) fn set_bindings(&mut self, bindings: &Bindings) {
        let text = |keys: &[Key]| keys.iter().map(|key| key.text()).collect();
        let changes = bindings.changes_from(self.set);
        self.bound = changes.map(|(entry, keys)| (entry.id.to_owned(), text(keys))).collect();
    }

    /// One more key for a control, in its first or second place.
    pub(crate) fn bind(&mut self, control: Control, place: usize, key: Key) {
        let mut bindings = self.bindings();
        bindings.set_key(control, place, key);
        self.set_bindings(&bindings);
    }
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, rename_all = "kebab-case")]
pub(crate) struct Accessibility {
    pub(crate) high_contrast: bool,
    pub(crate) larger_text: bool,
    /// Speed of the game; what is played slower is marked in the result.
    pub(crate) speed_percent: u32,
    /// Menus on the right.
    pub(crate) left_handed: bool,
}

impl Default for Accessibility {
    fn default() -> Self {
        Self { high_contrast: false, larger_text: false, speed_percent: 100, left_handed: false }
    }
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, rename_all = "kebab-case")]
pub(crate) struct Play {
    pub(crate) pause_without_focus: bool,
}

impl Default for Play {
    fn default() -> Self {
        Self { pause_without_focus: true }
    }
}

/// Not chosen, but remembered.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, rename_all = "kebab-case")]
pub(crate) struct Memory {
    /// The level to continue with.
    pub(crate) level: Option<usize>,
    /// Files, the last one first.
    pub(crate) recent: Vec<PathBuf>,
}

impl Memory {
    pub(crate) fn remember_file(&mut self, path: PathBuf) {
        self.recent.retain(|known| *known != path);
        self.recent.insert(0, path);
        self.recent.truncate(MAX_RECENT);
    }
}

/// Scales of what is written.
pub(crate) const UI_SCALES: std::ops::RangeInclusive<f32> = 0.75..=2.0;
/// Of the mouse, and of keys.
pub(crate) const SENSITIVITIES: std::ops::RangeInclusive<f64> = 0.25..=4.0;
/// Speeds of the game.
pub(crate) const SPEEDS: [u32; 3] = [100, 75, 50];
/// Frames a second; 0 is what suits the adapter.
pub(crate) const FRAME_CAPS: [u32; 6] = [0, 30, 60, 120, 144, 240];

impl Settings {
    /// Numbers out of range, from a file that was edited, become the nearest in range or the usual one.
    fn in_range(mut self) -> Self {
        let usual = Self::default();
        let video = &mut self.video;
        video.ui_scale = to_f32(clamped(video.ui_scale.into(), 0.75, 2.0, 1.0));
        if !FRAME_CAPS.contains(&video.frame_cap) {
            video.frame_cap = usual.video.frame_cap;
        }
        for factor in [&mut self.controls.sensitivity, &mut self.controls.key_speed] {
            *factor = clamped(*factor, *SENSITIVITIES.start(), *SENSITIVITIES.end(), 1.0);
        }
        if !SPEEDS.contains(&self.accessibility.speed_percent) {
            self.accessibility.speed_percent = usual.accessibility.speed_percent;
        }
        self.memory.recent.truncate(MAX_RECENT);
        self
    }

    /// From the text of a file: missing keys have their usual values, unknown ones are passed over.
    ///
    /// # Errors
    /// No TOML, a value of another kind, or a version that is newer than this program; in words.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        let mut table: Table = text.parse().map_err(|error: toml::de::Error| one_line(&error))?;
        migrate(&mut table, &STEPS)?;
        table.remove("version");
        let settings: Self = Value::Table(table).try_into().map_err(|error| one_line(&error))?;
        Ok(settings.in_range())
    }

    /// As a table, with the version.
    pub(crate) fn table(&self) -> Table {
        let mut table = Table::try_from(self).unwrap_or_default();
        table.insert("version".to_owned(), Value::Integer(VERSION));
        table
    }

    /// The menus' scale on a window of a height (points of the window system): 14 points on 720, growing with the window.
    pub(crate) fn zoom(&self, height_points: f32) -> f32 {
        let larger = if self.accessibility.larger_text { 1.25 } else { 1.0 };
        (height_points / 720.0).clamp(0.95, 3.0) * self.video.ui_scale * larger
    }

    /// What differs from the usual keys, for a test.
    #[cfg(test)]
    pub(crate) fn n_bound(&self) -> usize {
        self.controls.bound.len()
    }
}

fn clamped(value: f64, least: f64, most: f64, usual: f64) -> f64 {
    if value.is_finite() { value.clamp(least, most) } else { usual }
}

fn one_line(error: &toml::de::Error) -> String {
    error.message().lines().collect::<Vec<_>>().join(" ")
}

/// Brings a table to the current version, step by step. A file without a version is of the first.
fn migrate(table: &mut Table, steps: &[fn(&mut Table)]) -> Result<(), String> {
    let newest = 1 + i64::try_from(steps.len()).unwrap_or(i64::MAX - 1);
    let version = match table.get("version") {
        None => 1,
        Some(version) => version.as_integer().unwrap_or(0),
    };
    if !(1..=newest).contains(&version) {
        return Err(format!("version {version}: expected 1 to {newest}"));
    }
    let done = usize::try_from(version - 1).unwrap_or(0);
    steps.iter().skip(done).for_each(|step| step(table));
    table.insert("version".to_owned(), Value::Integer(newest));
    Ok(())
}

/// What is in the file now, with what this program has changed since it read or wrote `base`: another program's changes, and
/// keys that this one does not know, stay.
pub(crate) fn merged(mut file: Table, base: &Table, ours: &Table) -> Table {
    for (key, value) in ours {
        match (file.get(key), base.get(key), value) {
            (Some(Value::Table(theirs)), Some(Value::Table(base)), Value::Table(ours)) => {
                let both = merged(theirs.clone(), base, ours);
                file.insert(key.clone(), Value::Table(both));
            }
            (Some(_), Some(base), ours) if base == ours => {}
            _ => {
                file.insert(key.clone(), value.clone());
            }
        }
    }
    let gone = base.keys().filter(|key| !ours.contains_key(*key));
    gone.for_each(|key| {
        file.remove(key);
    });
    file
}

/// The line of the table for each control, in order, for the settings screen.
pub(crate) fn controls() -> impl Iterator<Item = (Control, &'static str)> {
    TABLE.iter().map(|entry| (entry.control, entry.name))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::Action;
    use winit::keyboard::KeyCode;

    const RESTART: Control = Control::Act(Action::Restart);

    fn changed() -> Settings {
        let video = Video {
            quality: QualitySetting::Medium,
            fullscreen: true,
            vsync: false,
            frame_cap: 120,
            ui_scale: 1.5,
            camera: CameraMode::Follow,
            reduced_motion: true,
            lower_quality_when_slow: false,
        };
        let mut settings = Settings { video, ..Settings::default() };
        settings.controls.set = KeySet::Report;
        settings.controls.drag = Drag::Relative;
        settings.controls.curve = Curve::Gentle;
        settings.controls.bind(RESTART, 1, Key::Place(KeyCode::KeyK));
        settings.accessibility.speed_percent = 50;
        settings.game.pause_without_focus = false;
        settings.memory.level = Some(3);
        settings.memory.remember_file("a 'strange' \"name\".obj".into());
        settings
    }

    #[test]
    fn settings_are_the_same_after_a_round_trip() {
        for settings in [Settings::default(), changed()] {
            let text = settings.table().to_string();
            assert_eq!(Settings::parse(&text).unwrap(), settings, "{text}");
        }
        let bindings = Settings::parse(&changed().table().to_string()).unwrap().controls.bindings();
        assert_eq!(bindings.keys_of(RESTART), [KeyCode::KeyR, KeyCode::KeyK].map(Key::Place));
    }

    #[test]
    fn missing_keys_have_defaults_and_what_is_out_of_range_is_brought_into_it() {
        assert_eq!(Settings::parse("").unwrap(), Settings::default());
        let settings =
            Settings::parse("later = 1\n[video]\nui-scale = 100.0\nframe-cap = 7\nnew = 'x'").unwrap();
        assert_eq!((settings.video.ui_scale, settings.video.frame_cap), (2.0, 0));
        let settings = Settings::parse("[controls]\nsensitivity = nan\nkey-speed = -3.0\n").unwrap();
        assert_eq!((settings.controls.sensitivity, settings.controls.key_speed), (1.0, 0.25));
        let unknown = "[controls.bound]\nrestart = ['KeyK', 'NoKey']\nnothing = ['KeyJ']\n";
        let settings = Settings::parse(unknown).unwrap();
        assert_eq!(settings.controls.bindings().keys_of(RESTART), [Key::Place(KeyCode::KeyK)]);
        assert_eq!(settings.n_bound(), 2, "what a newer version means is not thrown away");
    }

    #[test]
    fn what_is_no_settings_file_is_an_error_in_one_line() {
        for text in
            ["[video", "video = 3", "[video]\nvsync = 'perhaps'", "version = 99", "version = 'x'", "\0"]
        {
            let error = Settings::parse(text).unwrap_err();
            assert!(!error.is_empty() && !error.contains('\n'), "{text}: {error}");
        }
    }

    #[test]
    fn an_old_file_is_brought_to_the_newest_version_step_by_step() {
        let rename: fn(&mut Table) = |table| {
            if let Some(old) = table.remove("speed") {
                table.insert("pace".to_owned(), old);
            }
        };
        let double: fn(&mut Table) = |table| {
            let pace = table.get("pace").and_then(Value::as_integer).unwrap_or(0);
            table.insert("pace".to_owned(), Value::Integer(2 * pace));
        };
        for (text, pace) in [
            ("speed = 3", 6),
            ("version = 1\nspeed = 3", 6),
            ("version = 2\npace = 3", 6),
            ("version = 3\npace = 3", 3),
        ] {
            let mut table: Table = text.parse().unwrap();
            migrate(&mut table, &[rename, double]).unwrap();
            assert_eq!(table["pace"], Value::Integer(pace), "{text}");
            assert_eq!(table["version"], Value::Integer(3));
        }
        assert_eq!(1 + STEPS.len(), usize::try_from(VERSION).unwrap());
    }

    #[test]
    fn two_programs_change_different_settings_and_both_are_kept() {
        let base = Settings::default();
        let (mut one, mut other) = (base.clone(), base.clone());
        one.video.ui_scale = 1.25;
        other.controls.invert_y = true;
        other.controls.bind(RESTART, 0, Key::Place(KeyCode::KeyJ));
        let file = merged(base.table(), &base.table(), &one.table());
        let file = merged(file, &base.table(), &other.table());
        let both = Settings::parse(&file.to_string()).unwrap();
        assert!(both.video.ui_scale == 1.25 && both.controls.invert_y && both.n_bound() == 1);
        // A key that was bound is given back.
        let file = merged(file, &other.table(), &base.table());
        assert_eq!(Settings::parse(&file.to_string()).unwrap().n_bound(), 0);
    }
}
