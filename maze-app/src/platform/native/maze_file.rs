//! Maze files: which kinds there are, and how each is read and written.

use crate::failure::Failure;
use crate::loaded::Loaded;
use crate::picture;
use crate::platform::native::files;
use crate::platform::native::progress::Progress;
use maze_core::import::picture::WallTone;
use maze_core::import::text::TextOptions;
use maze_core::{AssembleOptions, Layout, MAX_GRID_CELLS, Maze, Stage, export, extrude, import};
use std::path::{Path, PathBuf};

/// What a file holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Obj,
    Svg,
    Text,
    Png,
    Bmp,
}

const KINDS: [Kind; 5] = [Kind::Obj, Kind::Svg, Kind::Text, Kind::Png, Kind::Bmp];

impl Kind {
    /// How its files' names end.
    fn ending(self) -> &'static str {
        match self {
            Self::Obj => "obj",
            Self::Svg => "svg",
            Self::Text => "txt",
            Self::Png => "png",
            Self::Bmp => "bmp",
        }
    }

    /// By the name's ending, which must be one of these.
    fn of_name(path: &Path, known: &[Self]) -> Result<Self, Failure> {
        let has_ending =
            |kind: &&Self| path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case(kind.ending()));
        known.iter().find(has_ending).copied().ok_or_else(|| {
            let endings: Vec<String> = known.iter().map(|kind| format!(".{}", kind.ending())).collect();
            let (last, others) =
                endings.split_last().map_or(("", &[][..]), |(last, others)| (last.as_str(), others));
            let expected =
                if others.is_empty() { last.to_owned() } else { format!("{} or {last}", others.join(", ")) };
            Failure::in_file(path, format!("not a maze file: expected a name that ends in {expected}"))
        })
    }

    /// By the first bytes; `None` for what has no mark of its own.
    fn of_content(bytes: &[u8]) -> Option<Self> {
        let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
        match bytes {
            _ if bytes.starts_with(b"\x89PNG\r\n\x1a\n") => Some(Self::Png),
            _ if bytes.starts_with(b"BM") && bytes.contains(&0) => Some(Self::Bmp),
            _ if text.starts_with(b"<") => Some(Self::Svg),
            _ => None,
        }
    }
}

/// What the user states about the content of a file, where it is ambiguous.
#[derive(Clone, Debug, Default)]
pub(crate) struct Hints {
    /// What the signs of a text mean.
    pub(crate) signs: TextOptions,
    /// Which pixels of a picture are walls.
    pub(crate) wall: Option<WallTone>,
}

/// Reads a maze file; the file extension gives the kind.
pub(crate) fn load(path: &Path, options: &AssembleOptions, hints: &Hints) -> Result<Loaded, Failure> {
    let kind = Kind::of_name(path, &KINDS)?;
    let progress = Progress::of_file(path);
    progress.tell("reading");
    let bytes = files::read(path)?;
    if let Some(content) = Kind::of_content(&bytes)
        && content != kind
    {
        let (named, is) = (kind.ending(), content.ending());
        return Err(Failure::in_file(
            path,
            format!("is named .{named}, but what it holds is .{is}: rename it"),
        ));
    }
    let read = move || -> Result<Loaded, String> {
        match kind {
            _ if kind != Kind::Text && !hints.signs.is_empty() => {
                Err(format!("text signs are for .txt files: a .{} has none", kind.ending()))
            }
            _ if !matches!(kind, Kind::Png | Kind::Bmp) && hints.wall.is_some() => {
                Err(format!("dark or light walls are for pictures: a .{} has none", kind.ending()))
            }
            Kind::Obj => {
                let mesh = import::obj::read(&bytes).map_err(|error| error.to_string())?;
                // The bytes are gone before the maze is put together: both are large.
                drop(bytes);
                let tell = &mut |stage: Stage| progress.tell(stage.name());
                let maze = Maze::from_polygons_step_by_step(&mesh, options, tell);
                Ok(Loaded { maze: maze.map_err(|error| error.to_string())?, found: None })
            }
            _ if options.up_axis.is_some() => {
                Err(format!("an up axis is for .obj files: a .{} lies flat", kind.ending()))
            }
            _ if options.scale.is_some() => {
                Err(format!("a scale is for .obj files: a .{} has cells", kind.ending()))
            }
            Kind::Text => {
                let text = import::text::read(&bytes, &hints.signs).map_err(|error| error.to_string())?;
                let maze = text.maze(options).map_err(|error| error.to_string())?;
                Ok(Loaded { maze, found: Some(text.found) })
            }
            Kind::Svg => svg(&bytes, options),
            Kind::Png | Kind::Bmp => picture::maze(&bytes, options, hints.wall),
        }
    };
    read().map_err(|reason| Failure::in_file(path, reason))
}

fn svg(bytes: &[u8], options: &AssembleOptions) -> Result<Loaded, String> {
    let svg = import::svg::read(bytes).map_err(|error| error.to_string())?;
    let maze = svg.maze(options).map_err(|error| error.to_string())?;
    Ok(Loaded { maze, found: Some(svg.found()) })
}

/// Checks before the work that a file of that name can hold a maze of so many cells, and be read again; `solution` must be
/// possible there.
pub(crate) fn expect_writable(path: &Path, n_cells: usize, solution: bool) -> Result<(), Failure> {
    let kind = Kind::of_name(path, &KINDS[..3])?;
    if kind != Kind::Obj && MAX_GRID_CELLS < n_cells {
        let reason = format!(
            "{n_cells} cells: expected at most {MAX_GRID_CELLS} in a .{}, as 256x256; larger mazes are written as .obj",
            kind.ending()
        );
        return Err(Failure::in_file(path, reason));
    }
    if solution && kind != Kind::Svg {
        return Err(Failure::in_file(path, "--solution is drawn in .svg files only"));
    }
    Ok(())
}

/// The materials beside an .obj. Always of this name, so that the same maze is the same file whatever its name.
const MATERIALS: &str = "maze-app.mtl";

/// The file that [`write()`] writes beside one of that name, if any.
pub(crate) fn written_beside(path: &Path) -> Option<PathBuf> {
    let is_obj = Kind::of_name(path, &KINDS[..3]).is_ok_and(|kind| kind == Kind::Obj);
    is_obj.then(|| path.with_file_name(MATERIALS))
}

/// Writes a layout; the file extension gives the kind. An .obj gets its [`MATERIALS`] beside it.
pub(crate) fn write(
    path: &Path,
    layout: &Layout,
    solution: Option<&[usize]>,
    comment: &str,
) -> Result<(), Failure> {
    match Kind::of_name(path, &KINDS[..3])? {
        Kind::Svg => files::write_whole(path, export::svg::write(layout, solution, comment).as_bytes()),
        Kind::Text => {
            files::write_whole(path, export::text::write(&maze_core::Blocks::of_layout(layout)).as_bytes())
        }
        _ => {
            let text = export::obj::write(&extrude::extrude(layout), MATERIALS, comment);
            let materials = path.with_file_name(MATERIALS);
            files::write_all_whole(&[
                (path, text.as_bytes()),
                (&materials, export::obj::MATERIALS.as_bytes()),
            ])
        }
    }
}
