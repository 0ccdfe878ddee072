//! Files in and out; an output is whole or not there.

use crate::failure::Failure;
use maze_render::{TextureSet, decode_texture};
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Largest file that is read: far above any maze (a million faces are 60 MB).
const MAX_BYTES: u64 = 1 << 28;

/// The whole file.
pub(crate) fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    let metadata = fs::metadata(path).map_err(|error| Failure::in_file(path, plain(&error)))?;
    if !metadata.is_file() {
        // A pipe or a device may never end.
        let what = if metadata.is_dir() { "a directory" } else { "no ordinary file" };
        return Err(Failure::in_file(path, format!("is {what}, expected a file")));
    }
    if MAX_BYTES < metadata.len() {
        let n_bytes = metadata.len();
        return Err(Failure::in_file(path, format!("{n_bytes} bytes, expected at most {MAX_BYTES}")));
    }
    fs::read(path).map_err(|error| Failure::in_file(path, plain(&error)))
}

/// Writes beside the target under a temporary name, then renames.
pub(crate) fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    write_all_whole(&[(path, bytes)])
}

/// Writes several files that belong together; none gets its name before all are written, and the first, which refers to the
/// others, gets its name last.
pub(crate) fn write_all_whole(outputs: &[(&Path, &[u8])]) -> Result<(), Failure> {
    let failed = |path: &Path, error: std::io::Error| {
        Failure::in_file(path, format!("cannot write: {}", plain(&error)))
    };
    let mut written = Vec::with_capacity(outputs.len());
    for (path, bytes) in outputs {
        expect_replaceable(path)?;
        written.push((path, temporary(path, bytes).map_err(|error| failed(path, error))?));
    }
    for (path, file) in written.into_iter().rev() {
        file.persist(path).map_err(|error| failed(path, error.error))?;
    }
    Ok(())
}

/// Most files that [`write_numbered`] tells apart.
const MAX_NUMBER: u32 = 9999;

/// Writes `NAME-0001.ENDING` in a directory, or with the next number that is free: no file is ever replaced.
pub(crate) fn write_numbered(
    directory: &Path,
    name: &str,
    ending: &str,
    bytes: &[u8],
) -> Result<PathBuf, Failure> {
    for number in 1..=MAX_NUMBER {
        let path = directory.join(format!("{name}-{number:04}.{ending}"));
        if path.exists() {
            continue;
        }
        let failed =
            |error: &std::io::Error| Failure::in_file(&path, format!("cannot write: {}", plain(error)));
        // Somebody else may have taken the name by now.
        match temporary(&path, bytes).map_err(|error| failed(&error))?.persist_noclobber(&path) {
            Ok(_) => return Ok(path),
            Err(error) if error.error.kind() == std::io::ErrorKind::AlreadyExists => {}
            Err(error) => return Err(failed(&error.error)),
        }
    }
    Err(Failure::in_file(directory, format!("{MAX_NUMBER} files {name}-....{ending} are there already")))
}

/// A file beside `path` that goes away unless it is persisted.
fn temporary(path: &Path, bytes: &[u8]) -> std::io::Result<tempfile::NamedTempFile> {
    let mut file = tempfile::Builder::new();
    // A temporary file is private by default; the output is an ordinary file.
    #[cfg(unix)]
    file.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o644));
    let mut file = file.tempfile_in(directory_of(path))?;
    file.write_all(bytes)?;
    Ok(file)
}

/// Checks that an output would not take the place of a device, a pipe or a directory.
pub(crate) fn expect_replaceable(path: &Path) -> Result<(), Failure> {
    match fs::metadata(path) {
        Ok(metadata) if !metadata.is_file() => {
            Err(Failure::in_file(path, "cannot write: is no ordinary file"))
        }
        _ => Ok(()),
    }
}

/// Where a file lies.
fn directory_of(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

/// Checks that there is a directory to write to, before there is something to lose.
pub(crate) fn expect_directory_of(path: &Path) -> Result<(), Failure> {
    if directory_of(path).is_dir() && !path.is_dir() {
        return Ok(());
    }
    Err(Failure::in_file(path, "cannot write: expected a file's name in a directory that there is"))
}

/// Prints to stdout. A reader that has seen enough (`| head`) is no error.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    match std::io::stdout().write_all(text.as_bytes()) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(Failure::bad_input(format!("cannot print: {}", plain(&error))))
        }
        _ => Ok(()),
    }
}

/// Tells something that is no failure, on stderr.
pub(crate) fn note(text: &str) {
    // Where nobody reads it, nothing is lost.
    let _ = writeln!(std::io::stderr(), "maze-app: {text}");
}

/// Checks an output's name before the work is done for it.
pub(crate) fn expect_extension(path: &Path, wanted: &str) -> Result<(), Failure> {
    if path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(wanted)) {
        return Ok(());
    }
    Err(Failure::in_file(path, format!("expected a name that ends in .{wanted}")))
}

/// Wall, floor and top from a directory, or the ones that come with the game.
pub(crate) fn textures(directory: Option<&Path>) -> Result<TextureSet, Failure> {
    let load = |name: &str, built_in: &'static [u8]| {
        let (shown, bytes) = match directory {
            Some(directory) => {
                let [bmp, png] = ["bmp", "png"].map(|ending| directory.join(name).with_extension(ending));
                let path = if !bmp.exists() && png.exists() { png } else { bmp };
                (path.display().to_string(), read(&path)?)
            }
            None => (name.to_owned(), built_in.to_vec()),
        };
        decode_texture(&shown, &bytes).map_err(Failure::bad_input)
    };
    Ok(TextureSet {
        wall: load("wall.bmp", include_bytes!("../../assets/textures/wall.bmp"))?,
        floor: load("floor.bmp", include_bytes!("../../assets/textures/floor.bmp"))?,
        top: load("top.bmp", include_bytes!("../../assets/textures/top.bmp"))?,
    })
}

/// The system's words without its number.
pub(crate) fn plain(error: &std::io::Error) -> String {
    let text = error.to_string();
    match text.find(" (os error") {
        Some(end) => text[..end].to_lowercase(),
        None => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_output_replaces_the_old_one_and_leaves_nothing_beside_it() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("out.txt");
        for text in ["one", "two"] {
            write_whole(&path, text.as_bytes()).unwrap();
            assert_eq!(fs::read_to_string(&path).unwrap(), text);
        }
        assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 1);
        let missing = directory.path().join("no/out.txt");
        let error = write_whole(&missing, b"").unwrap_err().to_string();
        assert!(error.ends_with("out.txt: cannot write: no such file or directory"), "{error}");
    }

    #[test]
    fn numbered_files_never_replace_another() {
        let directory = tempfile::tempdir().unwrap();
        fs::write(directory.path().join("maze-0002.png"), "old").unwrap();
        for expected in ["maze-0001.png", "maze-0003.png"] {
            let path = write_numbered(directory.path(), "maze", "png", b"new").unwrap();
            assert_eq!(path, directory.path().join(expected));
        }
        assert_eq!(fs::read_to_string(directory.path().join("maze-0002.png")).unwrap(), "old");
        assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 3);
        let error = write_numbered(&directory.path().join("no"), "maze", "png", b"").unwrap_err().to_string();
        assert!(error.ends_with("maze-0001.png: cannot write: no such file or directory"), "{error}");
    }

    #[test]
    fn built_in_textures_are_usable() {
        let set = textures(None).unwrap();
        for image in [&set.wall, &set.floor, &set.top] {
            assert_eq!(image.dimensions(), (512, 512));
        }
    }

    #[cfg(unix)]
    #[test]
    fn an_output_never_takes_the_place_of_a_pipe_or_a_device() {
        let scratch = tempfile::tempdir().unwrap();
        let pipe = scratch.path().join("pipe.maze");
        assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        let refused = write_whole(&pipe, b"maze").unwrap_err().to_string();
        assert!(refused.ends_with("is no ordinary file"), "{refused}");
        assert!(!fs::metadata(&pipe).unwrap().is_file());
    }
}
