//! Where a maze comes from: a file, or a seed.

use crate::failure::Failure;
use crate::files;
use clap::Args;
use maze_core::{AssembleOptions, Maze, Radius, UpAxis, extrude, import, layout};
use std::path::Path;
use std::time::{SystemTime, UNIX_EPOCH};

/// How to read a maze file.
#[derive(Args, Clone, Debug)]
pub(crate) struct ReadArguments {
    /// Ball radius in corridors, 0.02 to 0.49 [default: 0.35]
    #[arg(long, value_name = "R", value_parser = parse_radius)]
    ball_radius: Option<Radius>,
    /// Axis of the file that points out of the board [default: the one along which the file is flattest]
    #[arg(long, value_name = "AXIS", value_parser = parse_up_axis)]
    up: Option<UpAxis>,
}

impl ReadArguments {
    fn options(&self) -> AssembleOptions {
        AssembleOptions { up_axis: self.up, ball_radius: self.ball_radius }
    }

    /// Reads a maze file; the kind is told by its name's ending.
    pub(crate) fn load(&self, path: &Path) -> Result<Maze, Failure> {
        if !path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("obj")) {
            return Err(Failure::in_file(path, "not a maze file: expected a name that ends in .obj"));
        }
        let bytes = files::read(path)?;
        let mesh = import::obj::read(&bytes).map_err(|error| Failure::in_file(path, error))?;
        Maze::from_polygons(&mesh, &self.options()).map_err(|error| Failure::in_file(path, error))
    }

    /// The maze of a seed.
    pub(crate) fn generate(&self, size: GridSize, seed: u64) -> Result<Maze, Failure> {
        let layout =
            layout::recursive_backtracker(size.width, size.height, seed).map_err(Failure::bad_input)?;
        Maze::from_polygons(&extrude::extrude(&layout), &self.options()).map_err(Failure::bad_input)
    }
}

/// Cells along x and y.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct GridSize {
    pub(crate) width: usize,
    pub(crate) height: usize,
}

impl GridSize {
    /// A maze of a few minutes that fits a wide window.
    pub(crate) const DEFAULT: &str = "14x9";
}

/// A seed nobody chose; short enough to read out.
pub(crate) fn fresh_seed() -> u64 {
    let since = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
    (since.as_secs() ^ u64::from(since.subsec_nanos())) % 1_000_000
}

/// `WxH`: two whole numbers.
fn parse_pair<N: std::str::FromStr>(text: &str) -> Option<[N; 2]> {
    let (width, height) = text.split_once(['x', 'X'])?;
    Some([width.parse().ok()?, height.parse().ok()?])
}

pub(crate) fn parse_grid_size(text: &str) -> Result<GridSize, String> {
    let [width, height] = parse_pair(text).ok_or("expected WxH in cells, such as 14x9")?;
    Ok(GridSize { width, height })
}

pub(crate) fn parse_pixel_size(text: &str) -> Result<[u32; 2], String> {
    let size = parse_pair(text).ok_or("expected WxH in pixels, such as 1280x720")?;
    if size.contains(&0) { Err("expected at least 1x1 pixels".to_owned()) } else { Ok(size) }
}

/// Below the length of a substep a ball could pass through a wall between two of them; half a corridor fits nowhere.
const RADII: std::ops::RangeInclusive<f64> = 0.02..=0.49;

fn parse_radius(text: &str) -> Result<Radius, String> {
    let radius = text.parse().ok().filter(|radius| RADII.contains(radius)).and_then(Radius::new);
    radius.ok_or_else(|| format!("expected {} to {}, in corridors", RADII.start(), RADII.end()))
}

fn parse_up_axis(text: &str) -> Result<UpAxis, String> {
    [UpAxis::X, UpAxis::Y, UpAxis::Z]
        .into_iter()
        .find(|axis| axis.name() == text)
        .ok_or_else(|| "expected x, y or z".to_owned())
}
