//! The reader of a sidecar's text, in a file of its own so that a fuzz target can include it.

use maze_core::import::picture::WallTone;
use maze_core::import::text::TextOptions;
use maze_core::{Radius, UpAxis};
use nalgebra::Vector2;
use serde::de::Error;
use serde::{Deserialize, Deserializer};
use std::path::PathBuf;

/// What a sidecar may say; everything is optional.
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct Sidecar {
    /// Axis of the file that points out of the board.
    #[serde(deserialize_with = "up_axis")]
    pub(crate) up: Option<UpAxis>,
    /// Corridors in a unit of the file.
    #[serde(deserialize_with = "scale")]
    pub(crate) scale: Option<f64>,
    /// In corridors.
    #[serde(deserialize_with = "ball_radius")]
    pub(crate) ball_radius: Option<Radius>,
    /// As `info` prints it.
    #[serde(deserialize_with = "point")]
    pub(crate) start: Option<Vector2<f64>>,
    /// As `info` prints it.
    #[serde(deserialize_with = "point")]
    pub(crate) goal: Option<Vector2<f64>>,
    /// Directory with wall.bmp, floor.bmp and top.bmp, from the sidecar's own.
    pub(crate) textures: Option<PathBuf>,
    /// Which signs of a text maze mean what.
    pub(crate) text: TextSigns,
    /// How a picture is read.
    pub(crate) picture: PictureTones,
}

/// How a picture is read, as a sidecar states it.
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct PictureTones {
    /// Which pixels are walls.
    #[serde(deserialize_with = "tone")]
    pub(crate) wall: Option<WallTone>,
}

fn tone<'de, D: Deserializer<'de>>(value: D) -> Result<Option<WallTone>, D::Error> {
    parse_tone(&String::deserialize(value)?).map(Some).map_err(Error::custom)
}

/// The signs of a text maze, as a sidecar or flags state them.
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct TextSigns {
    pub(crate) wall: Option<String>,
    pub(crate) free: Option<String>,
    pub(crate) start: Option<String>,
    pub(crate) goal: Option<String>,
}

impl TextSigns {
    /// These signs, and those of another statement for what these do not say.
    pub(crate) fn or(&self, other: &Self) -> TextOptions {
        let or = |one: &Option<String>, other: &Option<String>| one.as_ref().or(other.as_ref()).cloned();
        TextOptions {
            wall: or(&self.wall, &other.wall),
            free: or(&self.free, &other.free),
            start: or(&self.start, &other.start),
            goal: or(&self.goal, &other.goal),
        }
    }
}

fn up_axis<'de, D: Deserializer<'de>>(value: D) -> Result<Option<UpAxis>, D::Error> {
    parse_up_axis(&String::deserialize(value)?).map(Some).map_err(Error::custom)
}

fn ball_radius<'de, D: Deserializer<'de>>(value: D) -> Result<Option<Radius>, D::Error> {
    radius_in_range(f64::deserialize(value)?).map(Some).map_err(Error::custom)
}

fn scale<'de, D: Deserializer<'de>>(value: D) -> Result<Option<f64>, D::Error> {
    let scale = f64::deserialize(value)?;
    let usable = scale.is_finite() && 0.0 < scale;
    usable
        .then_some(Some(scale))
        .ok_or_else(|| Error::custom("expected corridors a unit of the file, above 0"))
}

fn point<'de, D: Deserializer<'de>>(value: D) -> Result<Option<Vector2<f64>>, D::Error> {
    // Not an array of two: of a longer one the end would be cut off silently.
    let values = Vec::<f64>::deserialize(value)?;
    let [x, y] = values[..] else {
        return Err(Error::custom(format!("expected two numbers, found {}", values.len())));
    };
    let usable = x.is_finite() && y.is_finite();
    usable.then(|| Some(Vector2::new(x, y))).ok_or_else(|| Error::custom("expected two finite numbers"))
}

impl Sidecar {
    /// What is wrong comes with its line, counted from 1.
    pub(crate) fn parse(text: &str) -> Result<Self, (usize, String)> {
        toml::from_str(text).map_err(|error| {
            let start = error.span().map_or(0, |span| span.start);
            let line = text.bytes().take(start).filter(|byte| *byte == b'\n').count() + 1;
            (line, error.message().to_owned())
        })
    }
}

/// Below the length of a substep a ball could pass through a wall between two of them; half a corridor fits nowhere.
const RADII: std::ops::RangeInclusive<f64> = 0.02..=0.49;

pub(crate) fn radius_in_range(radius: f64) -> Result<Radius, String> {
    let usable =
        Some(radius).filter(|radius| RADII.contains(radius)).and_then(|radius| Radius::new(radius).ok());
    usable.ok_or_else(|| format!("expected {} to {}, in corridors", RADII.start(), RADII.end()))
}

/// As a flag and a sidecar say it.
pub(crate) fn tone_name(tone: WallTone) -> &'static str {
    match tone {
        WallTone::Dark => "dark",
        WallTone::Light => "light",
    }
}

pub(crate) fn parse_tone(text: &str) -> Result<WallTone, String> {
    [WallTone::Dark, WallTone::Light]
        .into_iter()
        .find(|tone| tone_name(*tone) == text)
        .ok_or_else(|| "expected dark or light".to_owned())
}

pub(crate) fn parse_up_axis(text: &str) -> Result<UpAxis, String> {
    [UpAxis::X, UpAxis::Y, UpAxis::Z]
        .into_iter()
        .find(|axis| axis.name() == text)
        .ok_or_else(|| "expected x, y or z".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::collection::vec;
    use proptest::prelude::*;

    /// Pieces of a sidecar in any order: nearer to one than any characters are.
    fn pieces() -> impl Strategy<Value = String> {
        const KNOWN: [&str; 31] = [
            "up = ",
            "scale = ",
            "ball_radius = ",
            "start = [",
            "goal = [",
            "textures = ",
            "colour = ",
            "text.wall = ",
            "[text]\n",
            "free = '.'\n",
            "up = 'z'\n",
            "scale = 2\n",
            "goal = [1, -2.5]\n",
            "=",
            "\n",
            "\r\n",
            "[",
            "]",
            ", ",
            "'z'",
            "\"y\"",
            "0.3",
            "-1",
            "inf",
            "nan",
            "1e999",
            "true",
            "#",
            "{",
            "}",
            " ",
        ];
        let piece = prop_oneof![
            9 => proptest::sample::select(&KNOWN[..]).prop_map(str::to_owned),
            1 => any::<String>(),
        ];
        vec(piece, 0..30).prop_map(|pieces| pieces.concat())
    }

    /// Nothing panics, what is read is in range, and what is not is reported in a line, with a line that is there.
    fn is_read_or_told(text: &str) {
        match Sidecar::parse(text) {
            Ok(sidecar) => {
                assert!(sidecar.scale.is_none_or(|scale| scale.is_finite() && 0.0 < scale));
                let mut points = [sidecar.start, sidecar.goal].into_iter().flatten();
                assert!(points.all(|point| point.iter().all(|value| value.is_finite())));
            }
            Err((line, reason)) => {
                assert!((1..=text.split('\n').count()).contains(&line), "{text:?}: line {line}");
                assert!(!reason.is_empty() && !reason.contains('\n'), "{text:?}: {reason:?}");
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 2000, ..ProptestConfig::default() })]

        #[test]
        fn any_bytes_are_read_or_told(bytes in vec(any::<u8>(), 0..200)) {
            is_read_or_told(&String::from_utf8_lossy(&bytes));
        }

        #[test]
        fn any_pieces_are_read_or_told(text in pieces()) {
            is_read_or_told(&text);
        }
    }

    #[test]
    fn everything_may_be_said() {
        let text = "up = 'z'\nscale = 2\nball_radius = 0.3\nstart = [1, -2.5]\ngoal = [0.0, 0.0]\ntextures = 'oak'\n\
                    [text]\nwall = '#%'\nstart = 'A'\n";
        let sidecar = Sidecar::parse(text).unwrap();
        assert_eq!(sidecar.up, Some(UpAxis::Z));
        assert_eq!((sidecar.scale, sidecar.ball_radius), (Some(2.0), Radius::new(0.3).ok()));
        assert_eq!((sidecar.start, sidecar.goal), (Some(Vector2::new(1.0, -2.5)), Some(Vector2::zeros())));
        assert_eq!(sidecar.textures, Some(PathBuf::from("oak")));
        let signs = TextSigns { wall: Some("#%".into()), start: Some("A".into()), ..Default::default() };
        assert_eq!(sidecar.text, signs);
        assert_eq!(Sidecar::parse("text.wall = '#%'\ntext.start = 'A'\n").unwrap().text, signs);
        assert_eq!(Sidecar::parse("# nothing\n"), Ok(Sidecar::default()));
    }

    #[test]
    fn what_is_wrong_is_told_with_its_line() {
        let cases = [
            ("up = 'y'\n\ncolour = 'red'\n", 3, "unknown field `colour`"),
            ("scale = 1\nup = 'w'\n", 2, "expected x, y or z"),
            ("\nball_radius = 0.7\n", 2, "expected 0.02 to 0.49, in corridors"),
            ("scale = -1", 1, "above 0"),
            ("scale = nan", 1, "above 0"),
            ("scale = 'big'", 1, "invalid type"),
            ("goal = [inf, 0]", 1, "two finite numbers"),
            ("up = 'y'\nup = 'z'\n", 2, "duplicate key"),
            ("up = 'y'\n\n= 3\n", 3, ""),
            ("[text]\nwalls = '#'\n", 2, "unknown field `walls`"),
            ("text.wall = 1\n", 1, "invalid type"),
            ("picture.wall = 'grey'\n", 1, "expected dark or light"),
            // F22: an array that is too long.
            ("up = 'y'\nstart = [1, 2, 3]\n", 2, "expected two numbers"),
            ("goal = [1]\n", 1, "expected two numbers"),
        ];
        for (text, line, expected) in cases {
            let (at, reason) = Sidecar::parse(text).unwrap_err();
            assert_eq!(at, line, "{text}: {reason}");
            assert!(reason.contains(expected), "{text}: {reason}");
        }
    }
}
