//! Where a maze comes from: a file, or a seed.

use crate::failure::Failure;
use crate::maze_file::{self, Loaded};
use crate::sidecar::Sidecar;
use clap::Args;
use maze_core::{AssembleOptions, Maze, Radius, UpAxis, extrude, layout};
use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};

/// How to read a maze file.
#[derive(Args, Clone, Debug)]
pub(crate) struct ReadArguments {
    /// Ball radius in corridors, 0.02 to 0.49 [default: 0.35]
    #[arg(long, value_name = "R", value_parser = parse_radius)]
    ball_radius: Option<Radius>,
    /// Axis of an .obj that points out of the board [default: the one along which the file is flattest]
    #[arg(long, value_name = "AXIS", value_parser = parse_up_axis)]
    up: Option<UpAxis>,
}

/// Which maze: a file, or a seed.
#[derive(Args, Clone, Debug)]
pub(crate) struct MazeArguments {
    /// A maze (.obj, .svg, .txt, .png or .bmp); without one, a random maze
    #[arg(conflicts_with_all = ["random", "seed", "size"])]
    file: Option<PathBuf>,
    #[command(flatten)]
    read: ReadArguments,
    /// A random maze (what happens anyway without a FILE)
    #[arg(long)]
    random: bool,
    /// The same seed gives the same maze [default: a new one]
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// Cells of a random maze
    #[arg(long, value_name = "WxH", value_parser = parse_grid_size, default_value = GridSize::DEFAULT)]
    size: GridSize,
}

impl ReadArguments {
    /// As on the command line.
    fn words(&self) -> Vec<String> {
        let radius = self.ball_radius.map(|radius| format!("--ball-radius={}", radius.units()));
        let up = self.up.map(|axis| format!("--up={}", axis.name()));
        [radius, up].into_iter().flatten().collect()
    }

    /// Flags win over what stands beside the file.
    fn options(&self, sidecar: &Sidecar) -> AssembleOptions {
        AssembleOptions {
            up_axis: self.up.or(sidecar.up),
            ball_radius: self.ball_radius.or(sidecar.ball_radius),
            scale: sidecar.scale,
            start: sidecar.start,
            goal: sidecar.goal,
        }
    }

    /// Reads a maze file and the sidecar beside it; the kind is told by its name's ending.
    pub(crate) fn load(&self, path: &Path) -> Result<Loaded, Failure> {
        maze_file::load(path, &self.options(&Sidecar::beside(path)?))
    }

    /// The maze of a seed.
    pub(crate) fn generate(&self, size: GridSize, seed: u64) -> Result<Maze, Failure> {
        let layout =
            layout::recursive_backtracker(size.width, size.height, seed).map_err(Failure::bad_input)?;
        Maze::from_polygons(&extrude::extrude(&layout), &self.options(&Sidecar::default()))
            .map_err(Failure::bad_input)
    }
}

/// What is played, and how to get the next maze of the same kind.
pub(crate) struct Source {
    read: ReadArguments,
    kind: Kind,
}

enum Kind {
    File(PathBuf),
    Random { size: GridSize, seed: u64 },
}

impl Source {
    /// Chooses a seed where none was given.
    pub(crate) fn new(arguments: &MazeArguments) -> Self {
        let kind = match &arguments.file {
            Some(path) => Kind::File(path.clone()),
            None => Kind::Random { size: arguments.size, seed: arguments.seed.unwrap_or_else(fresh_seed) },
        };
        Self { read: arguments.read.clone(), kind }
    }

    /// A file, read as the last one was.
    pub(crate) fn of_file(&self, path: PathBuf) -> Self {
        Self { read: self.read.clone(), kind: Kind::File(path) }
    }

    /// A file, or else the random maze of a size and a seed.
    pub(crate) fn file_or_random(
        read: &ReadArguments,
        file: Option<PathBuf>,
        size: GridSize,
        seed: u64,
    ) -> Self {
        let kind = match file {
            Some(path) => Kind::File(path),
            None => Kind::Random { size, seed },
        };
        Self { read: read.clone(), kind }
    }

    /// The words, one a line, that give this maze again on the command line.
    pub(crate) fn words(&self) -> Result<String, Failure> {
        let mut words = self.read.words();
        match &self.kind {
            Kind::Random { size, seed } => {
                words.extend([format!("--size={}x{}", size.width, size.height), format!("--seed={seed}")]);
            }
            Kind::File(path) => {
                let name = path.to_str().filter(|name| !name.contains('\n'));
                let name = name.ok_or_else(|| {
                    Failure::in_file(path, "a recording can only name a file in UTF-8 and on one line")
                })?;
                words.extend(["--".to_owned(), name.to_owned()]);
            }
        }
        Ok(words.join("\n"))
    }

    pub(crate) fn load(&self) -> Result<Maze, Failure> {
        match &self.kind {
            Kind::File(path) => Ok(self.read.load(path)?.maze),
            Kind::Random { size, seed } => self.read.generate(*size, *seed),
        }
    }

    /// The file it comes from.
    pub(crate) fn file(&self) -> Option<&Path> {
        match &self.kind {
            Kind::File(path) => Some(path),
            Kind::Random { .. } => None,
        }
    }

    /// What the screen calls it.
    pub(crate) fn title(&self) -> String {
        match &self.kind {
            Kind::File(path) => path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned(),
            Kind::Random { size, seed } => format!("{}x{}  seed {seed}", size.width, size.height),
        }
    }

    /// Moves on to another random maze; false for a file.
    pub(crate) fn next(&mut self) -> bool {
        match &mut self.kind {
            Kind::File(_) => false,
            Kind::Random { seed, .. } => {
                *seed = fresh_seed();
                true
            }
        }
    }

    /// Whether there is another maze of the same kind.
    pub(crate) fn has_next(&self) -> bool {
        matches!(self.kind, Kind::Random { .. })
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
    radius_in_range(text.parse().unwrap_or(f64::NAN))
}

pub(crate) fn radius_in_range(radius: f64) -> Result<Radius, String> {
    let usable = Some(radius).filter(|radius| RADII.contains(radius)).and_then(Radius::new);
    usable.ok_or_else(|| format!("expected {} to {}, in corridors", RADII.start(), RADII.end()))
}

pub(crate) fn parse_up_axis(text: &str) -> Result<UpAxis, String> {
    [UpAxis::X, UpAxis::Y, UpAxis::Z]
        .into_iter()
        .find(|axis| axis.name() == text)
        .ok_or_else(|| "expected x, y or z".to_owned())
}
