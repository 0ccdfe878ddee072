//! `maze-app render`: one picture, no window.

use crate::engine_kind::EngineKind;
use crate::failure::{self, Failure};
use crate::numbers::to_f32;
use crate::numbers::to_points;
use crate::overlay::{self, Layers};
use crate::platform::native;
use crate::platform::native::files;
use crate::platform::native::sidecar;
use crate::quality::QualityChoice;
use crate::recipe::parse_pixel_size;
use crate::session::Session;
use crate::setup::{STEEPEST_DEGREES, parse_max_tilt};
use crate::source::{KnownMazeArguments, Source};
use crate::ui;
use crate::view::{self, ZOOM_RANGE, zoomed};
use clap::Args;
use maze_core::BallKind;
use maze_core::Tilt;
use maze_render::{Gpu, Renderer};
use std::path::PathBuf;

/// Most ticks that are simulated before the picture: an hour of play.
const MAX_TICKS: u32 = 120_000;

#[derive(Args)]
#[command(
    after_help = "Examples:\n  maze-app render my_maze.obj --out picture.png --tilt 8,-5 --ticks 60\n  \
                        maze-app render --level 3 --out level3.png\n  \
                        maze-app render --level 3 --tilt 9,-7 --ticks 40 --zoom 4 --show search,contact --out search.png"
)]
pub(crate) struct Arguments {
    #[command(flatten)]
    maze: KnownMazeArguments,
    /// Where to write the picture; the name ends in .png
    #[arg(long, value_name = "PNG")]
    out: PathBuf,
    /// Pixels
    #[arg(long, value_name = "WxH", value_parser = parse_pixel_size, default_value = "1280x720")]
    size: [u32; 2],
    /// Degrees by which the board goes down towards +x and towards +y, together at most 45
    #[arg(long, value_name = "X,Y", value_parser = parse_tilt, default_value = "0,0", allow_hyphen_values = true)]
    tilt: Tilt,
    /// How many times nearer than a view of the whole maze, 0.5 to 6; from 2 on with the ball in the middle
    #[arg(long, value_name = "Z", value_parser = parse_zoom, default_value = "1")]
    zoom: f64,
    /// Degrees of tilt that the view has room for: 20 for a picture as in the game [default: the tilt]
    #[arg(long, value_name = "DEGREES", value_parser = parse_max_tilt)]
    max_tilt: Option<f64>,
    /// Ticks of 0.03 s under that tilt before the picture, at most 120000
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u32).range(..=i64::from(MAX_TICKS)))]
    ticks: u32,
    /// How the ball's motion is computed
    #[arg(long, value_enum, default_value_t = EngineKind::Continuous)]
    engine: EngineKind,
    /// What is shown of the method: any of gravity, planes, search, contact, velocity, clearance, with commas between them
    #[arg(long, value_name = "LIST", value_parser = Layers::parse)]
    show: Option<Layers>,
    /// Another engine's ball under the same tilt, as a ghost
    #[arg(long, value_enum, value_name = "ENGINE")]
    ghost: Option<EngineKind>,
    /// How much is spent on the picture, which may take its time on any driver
    #[arg(long, value_enum, default_value_t = QualityChoice::High)]
    quality: QualityChoice,
    /// Directory with wall.bmp, floor.bmp and top.bmp (24-bit, uncompressed) [default: built in]
    #[arg(long, value_name = "DIR")]
    textures: Option<PathBuf>,
}

fn parse_zoom(text: &str) -> Result<f64, String> {
    let [least, most] = ZOOM_RANGE;
    let zoom = text.parse().ok().filter(|zoom| (least..=most).contains(zoom));
    zoom.ok_or_else(|| format!("expected {least} to {most}"))
}

/// Two angles; the board turns about the axis across their direction by the length of the pair.
fn parse_tilt(text: &str) -> Result<Tilt, String> {
    let expected = || format!("expected X,Y in degrees, such as 8,-5, together at most {STEEPEST_DEGREES}");
    let (x, y) = text.split_once(',').ok_or_else(expected)?;
    let [x, y]: [f64; 2] = [x, y].map(|word| word.trim().parse().unwrap_or(f64::NAN));
    let degrees = (x * x + y * y).sqrt();
    if degrees.is_nan() || STEEPEST_DEGREES < degrees {
        return Err(expected());
    }
    if degrees == 0.0 {
        return Ok(Tilt::LEVEL);
    }
    let tangent = (degrees.to_radians() / 2.0).tan();
    Ok(Tilt::from_half_tangents(x / degrees * tangent, y / degrees * tangent))
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    files::expect_extension(&arguments.out, "png")?;
    native::leave_silent();
    let source = Source::known(&arguments.maze)?;
    let mut inputs = source.inputs();
    inputs.extend(arguments.textures.as_deref().map(files::texture_files).into_iter().flatten());
    files::expect_outputs(&[("--out", &arguments.out)], &inputs)?;
    let textures = sidecar::textures(arguments.textures.as_deref(), source.file())?;
    let mut game = Session::new(source.load_for(arguments.engine, BallKind::Report)?, arguments.engine)?;
    game.set_ghost(arguments.ghost)?;
    for _ in 0..arguments.ticks {
        game.tick(arguments.tilt)?;
    }
    game.show_tilt(arguments.tilt);
    let gpu = Gpu::offscreen().map_err(Failure::bad_input)?;
    let quality = arguments.quality.on(&gpu);
    let mut renderer = Renderer::with_quality(&gpu, quality.picture_format(), &textures, quality);
    for note in renderer.notes() {
        failure::note(note);
    }
    renderer.set_maze(&gpu, &game.maze().surface).map_err(Failure::bad_input)?;
    let aspect = to_points(arguments.size[0], 1.0) / to_points(arguments.size[1], 1.0);
    let [x, y] = arguments.tilt.half_tangents().map(to_f32);
    let tilt_rad = 2.0 * (x * x + y * y).sqrt().atan();
    let tilt_rad = arguments.max_tilt.map_or(tilt_rad, |degrees| to_f32(degrees.to_radians()));
    let pose = game.pose(1.0, None);
    let layers = arguments.show.unwrap_or_default();
    let left = ui::covered_width(layers, arguments.size.map(|side| to_points(side, 1.0)));
    let whole = view::fitted(maze_render::PITCH_RAD, game.half_size(), aspect, tilt_rad, left);
    let camera = zoomed(whole, arguments.zoom, pose.ball_in_world().cast());
    let mut scene = game.scene(&pose, view::beside(camera, aspect, left));
    let notes = overlay::add(layers, &game, &mut scene, arguments.size);
    let picture = ui::picture(&gpu, &mut renderer, arguments.size, 1.0, &scene, &notes);
    let picture = picture.map_err(Failure::bad_input)?;
    files::write_whole(&arguments.out, &files::png(picture)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tilt_is_read_in_degrees() {
        let tilt = parse_tilt("0,-10").unwrap();
        assert!((tilt.world_from_maze().angle().to_degrees() - 10.0).abs() < 0.01);
        assert!(tilt.towards_y < 0 && tilt.towards_x == 0);
        for bad in ["", "1", "a,b", "1,2,3", "nan,0", "40,40", "inf,0"] {
            assert!(parse_tilt(bad).is_err(), "{bad}");
        }
    }
}
