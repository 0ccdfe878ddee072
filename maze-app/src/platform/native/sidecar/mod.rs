//! `NAME.toml` beside a maze file: what its author decides instead of the program.

mod text;

pub(crate) use text::{Sidecar, TextSigns, parse_tone, parse_up_axis, radius_in_range, tone_name};

use crate::failure::Failure;
use crate::platform::native::files;
use maze_render::TextureSet;
use std::path::Path;

/// Longest sidecar: a parser takes many times as much memory.
const MAX_BYTES: u64 = 1 << 16;

impl Sidecar {
    /// The one beside a maze file; the default where there is none.
    pub(crate) fn beside(maze: &Path) -> Result<Self, Failure> {
        let path = maze.with_extension("toml");
        if path == maze || !path.exists() {
            return Ok(Self::default());
        }
        let text = files::read_at_most(&path, MAX_BYTES)?;
        let text = String::from_utf8(text).map_err(|_| Failure::in_file(&path, "expected text in UTF-8"))?;
        let mut sidecar = Self::parse(&text)
            .map_err(|(line, reason)| Failure::in_file(&path, format!("line {line}: {reason}")))?;
        if let (Some(textures), Some(directory)) = (&mut sidecar.textures, path.parent()) {
            *textures = directory.join(&*textures);
        }
        Ok(sidecar)
    }
}

/// The textures that a flag names, else those of the maze's sidecar, else ours.
pub(crate) fn textures(flag: Option<&Path>, maze: Option<&Path>) -> Result<TextureSet, Failure> {
    let from_sidecar = match (flag, maze) {
        (None, Some(maze)) => Sidecar::beside(maze)?.textures,
        _ => None,
    };
    files::textures(flag.or(from_sidecar.as_deref()))
}
