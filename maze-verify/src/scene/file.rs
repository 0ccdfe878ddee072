//! Scenes from a TOML file; the format is told in docs/verification.md.

use super::{Family, Gravity, Scene, TICKS_S, Walls};
use crate::engine::Motion;
use maze_core::layout::{Algorithm, Recipe};
use maze_core::{Ball, BallSpec, Bounds, Radius};
use nalgebra::Vector2;
use serde::de::Error;
use serde::{Deserialize, Deserializer};
use std::collections::BTreeSet;
use std::ops::Range;
use toml::Spanned;

/// Longest scene (s), shortest tick (s), and most ticks: a run keeps some 100 bytes a tick and engine.
const MAX_DURATION_S: f64 = 1000.0;
const MIN_TICK_S: f64 = 1.0e-4;
const MAX_TICKS: f64 = 1.0e6;

/// Most rectangles, and most cells into which all of their sides cut the plan: rapier's mesh takes a kilobyte for each.
const MAX_WALLS: usize = 2000;
const MAX_CELLS: usize = 1 << 16;

/// Largest coordinate (units) and speed (units/s) of a scene: rapier's f32 still tells 1e-3 units apart.
const MAX_COORDINATE: f64 = 1.0e4;
const MAX_SPEED: f64 = 1.0e4;

/// Why a file holds no scenes.
#[derive(Debug, PartialEq, Eq, thiserror::Error)]
#[error("line {line}: {reason}")]
pub struct SceneFileError {
    /// Counted from 1.
    pub line: usize,
    /// What was expected.
    pub reason: String,
}

/// So many numbers and no more: of a longer list serde's arrays cut off the end without a word.
#[derive(Clone, Copy, Debug)]
struct Exactly<const N: usize>([f64; N]);

impl<'de, const N: usize> Deserialize<'de> for Exactly<N> {
    fn deserialize<D: Deserializer<'de>>(list: D) -> Result<Self, D::Error> {
        let list = Vec::<f64>::deserialize(list)?;
        let numbers = <[f64; N]>::try_from(list);
        numbers.map(Self).map_err(|list| D::Error::invalid_length(list.len(), &&*format!("{N} numbers")))
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileToml {
    scene: Vec<Spanned<SceneToml>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SceneToml {
    name: Spanned<String>,
    #[serde(default)]
    about: String,
    duration_s: Spanned<f64>,
    ticks_s: Option<Spanned<Vec<f64>>>,
    walls: Option<Spanned<Vec<Exactly<4>>>>,
    maze: Option<Spanned<MazeToml>>,
    ball: Option<Spanned<BallToml>>,
    #[serde(default)]
    gravity: Option<Spanned<GravityToml>>,
    truth: Option<Spanned<TruthToml>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct MazeToml {
    width: usize,
    height: usize,
    seed: u64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct BallToml {
    position: Option<Exactly<2>>,
    velocity: Option<Exactly<2>>,
    radius: Option<f64>,
    restitution: Option<f64>,
    #[serde(default)]
    rolls: bool,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "snake_case")]
enum GravityToml {
    Flat,
    #[serde(rename_all = "snake_case")]
    Constant {
        tilt_deg: Exactly<2>,
    },
    Sinusoidal {
        amplitude_deg: Exactly<2>,
        frequency_hz: f64,
    },
    Random {
        seed: u64,
        hold_s: f64,
        max_deg: f64,
    },
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "snake_case")]
enum TruthToml {
    Room(RoomToml),
    Corner { point: Exactly<2> },
    Around { block: Exactly<4> },
    Rest { place: Exactly<2> },
}

/// What a file states as true.
enum Truth {
    Motion(Motion),
    /// The place at which the ball lies in the end.
    Rest(Vector2<f64>),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RoomToml {
    left: Option<f64>,
    right: Option<f64>,
    below: Option<f64>,
    above: Option<f64>,
}

/// Where in the text something stands, for errors.
struct Text<'a>(&'a str);

impl Text<'_> {
    fn line(&self, offset: usize) -> usize {
        1 + self.0.bytes().take(offset).filter(|byte| *byte == b'\n').count()
    }

    fn expect(&self, held: bool, span: Range<usize>, reason: &str) -> Result<(), SceneFileError> {
        if held { Ok(()) } else { Err(self.error(span, reason)) }
    }

    fn error(&self, span: Range<usize>, reason: &str) -> SceneFileError {
        SceneFileError { line: self.line(span.start), reason: reason.to_owned() }
    }
}

/// The scenes of a file.
///
/// # Errors
/// No TOML, an unknown key, or a value out of range, with its line.
pub fn read(text: &str) -> Result<Vec<Scene>, SceneFileError> {
    let place = Text(text);
    let file: FileToml = toml::from_str(text).map_err(|error| {
        let reason = error.message().split_whitespace().collect::<Vec<_>>().join(" ");
        SceneFileError { line: place.line(error.span().map_or(0, |span| span.start)), reason }
    })?;
    file.scene.into_iter().map(|scene| scene_from(&place, scene)).collect()
}

fn is_in(values: &[f64], limit: f64) -> bool {
    values.iter().all(|value| value.abs() <= limit)
}

fn scene_from(place: &Text<'_>, scene: Spanned<SceneToml>) -> Result<Scene, SceneFileError> {
    let span = scene.span();
    let scene = scene.into_inner();
    let name = scene.name.get_ref().clone();
    let usable = !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || "-_.".contains(c));
    place.expect(usable, scene.name.span(), "a name is letters, digits and - _ . only")?;
    let duration_s = *scene.duration_s.get_ref();
    place.expect(
        0.0 < duration_s && duration_s <= MAX_DURATION_S,
        scene.duration_s.span(),
        "duration_s: expected more than 0 and at most 1000 s",
    )?;
    let ticks_s = match scene.ticks_s {
        None => TICKS_S.to_vec(),
        Some(ticks) => {
            let good = ticks
                .get_ref()
                .iter()
                .all(|tick| MIN_TICK_S <= *tick && *tick <= duration_s && duration_s / tick <= MAX_TICKS);
            place.expect(
                good && !ticks.get_ref().is_empty(),
                ticks.span(),
                "ticks_s: expected one or more lengths from 0.0001 s to the scene's, a million ticks at most",
            )?;
            ticks.into_inner()
        }
    };
    let walls = walls_from(place, scene.walls, scene.maze, span.clone())?;
    let (ball, spec) = ball_from(place, scene.ball)?;
    place.expect(
        ball.is_some() || !matches!(walls, Walls::Rectangles(_)),
        span,
        "a scene with walls needs ball.position",
    )?;
    let gravity = scene.gravity.map_or(Ok(Gravity::Flat), |gravity| gravity_from(place, &gravity))?;
    let truth = scene.truth.map(|truth| truth_from(place, truth, gravity)).transpose()?;
    let (truth, rest) = match truth {
        None => (None, None),
        Some(Truth::Motion(motion)) => (Some(motion), None),
        Some(Truth::Rest(place)) => (None, Some(place)),
    };
    Ok(Scene {
        name,
        about: scene.about,
        family: Family::Own,
        walls,
        ball,
        spec,
        gravity,
        duration_s,
        ticks_s,
        truth,
        rest,
    })
}

fn walls_from(
    place: &Text<'_>,
    walls: Option<Spanned<Vec<Exactly<4>>>>,
    maze: Option<Spanned<MazeToml>>,
    span: Range<usize>,
) -> Result<Walls, SceneFileError> {
    match (walls, maze) {
        (Some(walls), None) => {
            let good = |Exactly([x0, y0, x1, y1]): &Exactly<4>| {
                x0 < x1 && y0 < y1 && is_in(&[*x0, *y0, *x1, *y1], MAX_COORDINATE)
            };
            let reason = "walls: expected [left, below, right, above] with left < right and below < above, up to 10000";
            let few = walls.get_ref().len() <= MAX_WALLS;
            place.expect(few, walls.span(), "walls: expected at most 2000 rectangles")?;
            place.expect(walls.get_ref().iter().all(good), walls.span(), reason)?;
            let bounds = |Exactly([x0, y0, x1, y1]): &Exactly<4>| Bounds {
                low: Vector2::new(*x0, *y0),
                high: Vector2::new(*x1, *y1),
            };
            let rectangles: Vec<Bounds> = walls.get_ref().iter().map(bounds).collect();
            let [n_x, n_y] = [0, 1].map(|axis| {
                let sides = rectangles.iter().flat_map(|wall| [wall.low[axis], wall.high[axis]]);
                // Bits of equal numbers are equal, but for the sign of 0.
                sides.map(|side| (side + 0.0).to_bits()).collect::<BTreeSet<u64>>().len()
            });
            let reason = format!(
                "walls: {n_x} x {n_y} distinct sides: expected at most {MAX_CELLS} rectangles between them"
            );
            place.expect(n_x * n_y <= MAX_CELLS, walls.span(), &reason)?;
            Ok(Walls::Rectangles(rectangles))
        }
        (None, Some(maze)) => {
            let MazeToml { width, height, seed } = *maze.get_ref();
            let fits = |side: usize| (1..=100).contains(&side);
            let good = fits(width) && fits(height) && 2 <= width * height;
            place.expect(good, maze.span(), "maze: expected 2 cells or more and at most 100 on a side")?;
            Ok(Walls::Generated(Recipe::new(width, height, Algorithm::Backtracker, seed)))
        }
        _ => Err(place.error(span, "a scene has either `walls` or `maze`")),
    }
}

fn ball_from(
    place: &Text<'_>,
    ball: Option<Spanned<BallToml>>,
) -> Result<(Option<Ball>, BallSpec), SceneFileError> {
    let mut spec = BallSpec::default();
    let Some(ball) = ball else { return Ok((None, spec)) };
    let span = || ball.span();
    let given = ball.get_ref();
    if let Some(units) = given.radius {
        let radius = Radius::new(units).ok().filter(|_| (1.0e-3..=1.0e3).contains(&units));
        spec.radius = radius.ok_or_else(|| place.error(span(), "radius: expected 0.001 to 1000 units"))?;
    }
    if let Some(restitution) = given.restitution {
        spec.restitution = restitution;
    }
    if given.rolls {
        spec.rolling = BallSpec::ROLLING_SPHERE;
    }
    spec.checked().map_err(|error| place.error(span(), &error.to_string()))?;
    let velocity = given.velocity.map_or([0.0; 2], |Exactly(velocity)| velocity);
    place.expect(is_in(&velocity, MAX_SPEED), span(), "velocity: expected at most 10000 units/s")?;
    let Some(Exactly(position)) = given.position else {
        let reason = "a ball with a velocity needs a position";
        place.expect(given.velocity.is_none(), span(), reason)?;
        return Ok((None, spec));
    };
    place.expect(is_in(&position, MAX_COORDINATE), span(), "position: expected at most 10000 units")?;
    Ok((Some(Ball { position: position.into(), velocity: velocity.into() }), spec))
}

fn gravity_from(place: &Text<'_>, gravity: &Spanned<GravityToml>) -> Result<Gravity, SceneFileError> {
    let angles =
        |angles: &[f64]| place.expect(is_in(angles, 60.0), gravity.span(), "a tilt is at most 60 degrees");
    let positive = |value: f64, reason| place.expect(0.0 < value && value < 1.0e3, gravity.span(), reason);
    match *gravity.get_ref() {
        GravityToml::Flat => Ok(Gravity::Flat),
        GravityToml::Constant { tilt_deg: Exactly(tilt_deg) } => {
            angles(&tilt_deg).map(|()| Gravity::Constant { tilt_deg })
        }
        GravityToml::Sinusoidal { amplitude_deg: Exactly(amplitude_deg), frequency_hz } => {
            angles(&amplitude_deg)?;
            positive(frequency_hz, "frequency_hz: expected more than 0 and less than 1000")?;
            Ok(Gravity::Sinusoidal { amplitude_deg, frequency_hz })
        }
        GravityToml::Random { seed, hold_s, max_deg } => {
            angles(&[max_deg])?;
            positive(hold_s, "hold_s: expected more than 0 and less than 1000")?;
            Ok(Gravity::Random { seed, hold_s, max_deg })
        }
    }
}

fn truth_from(
    place: &Text<'_>,
    truth: Spanned<TruthToml>,
    gravity: Gravity,
) -> Result<Truth, SceneFileError> {
    let span = truth.span();
    match truth.into_inner() {
        TruthToml::Room(RoomToml { left, right, below, above }) => {
            let all: Vec<f64> = [left, right, below, above].into_iter().flatten().collect();
            place.expect(is_in(&all, MAX_COORDINATE), span, "truth.room: expected at most 10000 units")?;
            Ok(Truth::Motion(Motion::Room { low: [left, below], high: [right, above] }))
        }
        TruthToml::Corner { point: Exactly(point) } => {
            let reason = "truth.corner holds without gravity only";
            place.expect(gravity == Gravity::Flat, span.clone(), reason)?;
            place.expect(
                is_in(&point, MAX_COORDINATE),
                span,
                "truth.corner: expected at most 10000 units",
            )?;
            Ok(Truth::Motion(Motion::Corner { point: point.into() }))
        }
        TruthToml::Around { block: Exactly([left, below, right, above]) } => {
            let reason = "truth.around holds on a board held still only";
            place.expect(gravity.is_constant(), span.clone(), reason)?;
            let all = [left, below, right, above];
            let reason = "truth.around: expected [left, below, right, above] of one wall";
            place.expect(is_in(&all, MAX_COORDINATE) && left < right && below < above, span, reason)?;
            let block = Bounds { low: Vector2::new(left, below), high: Vector2::new(right, above) };
            Ok(Truth::Motion(Motion::Around { block }))
        }
        TruthToml::Rest { place: Exactly(at) } => {
            let reason = "truth.rest holds on a board held still only";
            place.expect(gravity.is_constant(), span.clone(), reason)?;
            place.expect(is_in(&at, MAX_COORDINATE), span, "truth.rest: expected at most 10000 units")?;
            Ok(Truth::Rest(at.into()))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str = r#"
[[scene]]
name = "mine"
about = "Two walls."
duration_s = 2.5
ticks_s = [0.03, 0.01]
walls = [[0, 0, 1, 5], [3.0, 0, 4, 5]]
ball = { position = [2, 2], velocity = [1, 0], radius = 0.3, restitution = 0.5, rolls = true }
gravity.sinusoidal = { amplitude_deg = [5, 0], frequency_hz = 0.5 }
truth.room = { left = 1, right = 3 }

[[scene]]
name = "maze"
duration_s = 10.0
maze = { width = 5, height = 4, seed = 9 }
gravity.random = { seed = 1, hold_s = 0.5, max_deg = 8 }
"#;

    #[test]
    fn a_good_file_gives_its_scenes() {
        let scenes = read(GOOD).unwrap();
        assert_eq!(scenes.len(), 2);
        assert_eq!(
            scenes[0].ball,
            Some(Ball { position: Vector2::new(2.0, 2.0), velocity: Vector2::new(1.0, 0.0) })
        );
        assert_eq!(scenes[0].spec.rolling, BallSpec::ROLLING_SPHERE);
        assert_eq!(scenes[0].truth, Some(Motion::Room { low: [Some(1.0), None], high: [Some(3.0), None] }));
        assert_eq!(scenes[1].gravity, Gravity::Random { seed: 1, hold_s: 0.5, max_deg: 8.0 });
        assert_eq!(scenes[1].ticks_s, TICKS_S);
        for scene in scenes {
            scene.set_up().unwrap();
        }
    }

    #[test]
    fn a_place_of_rest_and_a_way_around_a_block_are_read() {
        let still = GOOD.replace("gravity.sinusoidal = { amplitude_deg = [5, 0], frequency_hz = 0.5 }", "");
        let with = |truth: &str| read(&still.replace("truth.room = { left = 1, right = 3 }", truth));
        let scene = with("truth.rest = { place = [1.3, 2] }").unwrap().swap_remove(0);
        assert_eq!((scene.truth, scene.rest), (None, Some(Vector2::new(1.3, 2.0))));
        let scene = with("truth.around = { block = [0, 0, 1, 5] }").unwrap().swap_remove(0);
        assert!(matches!(scene.truth, Some(Motion::Around { block }) if block.high.y == 5.0));
        assert!(with("truth.around = { block = [1, 0, 0, 5] }").unwrap_err().reason.contains("around"));
        let swinging =
            GOOD.replace("truth.room = { left = 1, right = 3 }", "truth.rest = { place = [1, 2] }");
        assert!(read(&swinging).unwrap_err().reason.contains("held still"));
    }

    #[test]
    fn the_example_of_the_documentation_is_good() {
        let page = include_str!("../../../docs/verification.md");
        let begin = page.find("```toml\n").unwrap() + "```toml\n".len();
        let example = &page[begin..begin + page[begin..].find("```").unwrap()];
        assert_eq!(read(example).unwrap()[0].name, "my-scene");
        // What it comments out is good as well.
        let other = example
            .replace("walls = ", "# walls = ")
            .replace("# maze = ", "maze = ")
            .replace("position = [0, 0], velocity = [3, 0], ", "")
            .replace("gravity.constant", "# gravity.constant")
            .replace("# gravity.random", "gravity.random")
            .replace("truth.room", "# truth.room");
        read(&other).unwrap()[0].set_up().unwrap();
    }

    #[test]
    fn what_is_wrong_is_named_with_its_line() {
        for (from, to, line, reason) in [
            ("restitution = 0.5", "restitution = 1.5", 8, "restitution"),
            ("restitution = 0.5", "restitution = nan", 8, "restitution"),
            ("rolls = true", "rools = true", 8, "rools"),
            ("about =", "abuot =", 4, "abuot"),
            ("frequency_hz = 0.5", "frequency_hz = -1", 9, "frequency_hz"),
            ("amplitude_deg = [5, 0]", "amplitude_deg = [5]", 9, "2 numbers"),
            // F22: of a list that is too long the end was cut off without a word.
            ("amplitude_deg = [5, 0]", "amplitude_deg = [5, 0, 1]", 9, "2 numbers"),
            ("[0, 0, 1, 5]", "[0, 0, 1, 5, 77]", 7, "4 numbers"),
            ("position = [2, 2]", "position = [2, 2, 55]", 8, "2 numbers"),
            ("velocity = [1, 0]", "velocity = [1, 0, 0]", 8, "2 numbers"),
            ("duration_s = 2.5", "duration_s = \"long\"", 5, "duration_s|string"),
            ("duration_s = 2.5", "duration_s = inf", 5, "duration_s"),
            ("[0, 0, 1, 5]", "[1, 0, 0, 5]", 7, "walls"),
            ("[0.03, 0.01]", "[]", 6, "ticks_s"),
            ("maze = { width = 5,", "maze = { width = 0,", 15, "maze"),
            ("maze = { width = 5,", "maze = { width = 9223372036854775807,", 15, "maze"),
            ("name = \"maze\"", "name = \"a b\"", 13, "name"),
        ] {
            let error = read(&GOOD.replace(from, to)).unwrap_err();
            assert_eq!(error.line, line, "{to}: {error}");
            assert!(reason.split('|').any(|reason| error.reason.contains(reason)), "{to}: {error}");
        }
        assert!(read("").is_err());
    }

    #[test]
    fn r9_walls_that_cut_the_plan_into_too_many_cells_are_refused() {
        let walls = |n: usize| {
            let wall = |k: usize| format!("[{k}.25, {k}.5, {}.0, {}.75]", k + 3, k + 3);
            let walls: Vec<String> = (0..n).map(wall).collect();
            GOOD.replace("[[0, 0, 1, 5], [3.0, 0, 4, 5]]", &format!("[{}]", walls.join(", ")))
                .replace("[2, 2]", "[-5, -5]")
        };
        assert!(read(&walls(128)).is_ok());
        let error = read(&walls(129)).unwrap_err();
        assert_eq!(error.line, 7);
        assert_eq!(
            error.reason,
            "walls: 258 x 258 distinct sides: expected at most 65536 rectangles between them"
        );
    }
}
