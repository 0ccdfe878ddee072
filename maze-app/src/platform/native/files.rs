//! Files in and out; an output is whole or not there.

use crate::failure::Failure;
use crate::platform::native::rescue;
use image::{DynamicImage, ImageFormat};
use maze_render::{TextureSet, decode_texture};
use std::fs;
use std::io::Cursor;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};

/// Largest file that is read: an .obj of 1024 x 1024 cells has 300 MB.
const MAX_BYTES: u64 = 1 << 29;

/// How much longer than its metadata says a file may be, that grows while it is read.
const MAX_GROWTH: u64 = 1 << 20;

/// The whole file.
pub(crate) fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    read_at_most(path, MAX_BYTES)
}

/// The whole file, if it is not longer than that.
pub(crate) fn read_at_most(path: &Path, most: u64) -> Result<Vec<u8>, Failure> {
    let metadata = fs::metadata(path).map_err(|error| Failure::in_file(path, plain(&error)))?;
    if !metadata.is_file() {
        // A pipe or a device may never end.
        let what = if metadata.is_dir() { "a directory" } else { "no ordinary file" };
        return Err(Failure::in_file(path, format!("is {what}, expected a file")));
    }
    let n_bytes = metadata.len();
    if most < n_bytes {
        return Err(Failure::in_file(path, format!("{n_bytes} bytes, expected at most {most}")));
    }
    // The length in the metadata may be wrong: for files in /proc it is 0.
    let promised = n_bytes.saturating_add(MAX_GROWTH).min(most);
    let mut bytes = Vec::with_capacity(usize::try_from(n_bytes).unwrap_or(0));
    let file = fs::File::open(path).map_err(|error| Failure::in_file(path, plain(&error)))?;
    let read = file.take(promised + 1).read_to_end(&mut bytes);
    read.map_err(|error| Failure::in_file(path, plain(&error)))?;
    if promised < bytes.len() as u64 {
        let reason =
            format!("goes on after the {n_bytes} bytes that it says to have: expected an ordinary file");
        return Err(Failure::in_file(path, reason));
    }
    Ok(bytes)
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
        let target = target_of(path);
        let file = Temporary::new(&target, bytes).map_err(|error| failed(path, error))?;
        written.push((path, target, file));
    }
    for (path, target, file) in written.into_iter().rev() {
        file.persist(&target).map_err(|error| failed(path, error))?;
    }
    Ok(())
}

/// Most files that [`write_numbered`] numbers.
const MAX_NUMBER: u32 = 9999;

/// A picture as the content of a .png file.
pub(crate) fn png(picture: impl Into<DynamicImage>) -> Result<Vec<u8>, Failure> {
    let mut bytes = Cursor::new(Vec::new());
    picture.into().write_to(&mut bytes, ImageFormat::Png).map_err(Failure::bad_input)?;
    Ok(bytes.into_inner())
}

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
        match Temporary::new(&path, bytes).and_then(|file| file.persist_as_new(&path)) {
            Ok(()) => return Ok(path),
            Err(error) if error.kind() == std::io::ErrorKind::AlreadyExists => {}
            Err(error) => return Err(failed(&error)),
        }
    }
    Err(Failure::in_file(directory, format!("{MAX_NUMBER} files {name}-....{ending} are there already")))
}

/// A file beside its target that goes away unless it gets the target's name, also when the program is ended.
struct Temporary {
    file: Option<tempfile::NamedTempFile>,
    path: PathBuf,
}

impl Temporary {
    fn new(target: &Path, bytes: &[u8]) -> std::io::Result<Self> {
        let file = rescue::temporary(|| {
            let mut file = tempfile::Builder::new();
            // A temporary file is private by default; the output is an ordinary file, and stays what it was.
            #[cfg(unix)]
            {
                use std::os::unix::fs::PermissionsExt;
                let mode =
                    fs::metadata(target).map_or(0o644, |metadata| metadata.permissions().mode() & 0o777);
                file.permissions(fs::Permissions::from_mode(mode));
            }
            file.tempfile_in(directory_of(target))
        })?;
        let mut temporary = Self { path: file.path().to_path_buf(), file: Some(file) };
        if let Some(file) = &mut temporary.file {
            file.write_all(bytes)?;
        }
        Ok(temporary)
    }

    fn persist(mut self, target: &Path) -> std::io::Result<()> {
        let Some(file) = self.file.take() else { return Ok(()) };
        file.persist(target).map(|_| ()).map_err(|error| error.error)
    }

    fn persist_as_new(mut self, target: &Path) -> std::io::Result<()> {
        let Some(file) = self.file.take() else { return Ok(()) };
        file.persist_noclobber(target).map(|_| ()).map_err(|error| error.error)
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        // The file itself first: what is forgotten is not there any more.
        self.file = None;
        rescue::forget(&self.path);
    }
}

/// Most links that lead to a file, as systems have it.
const MAX_LINKS: usize = 40;

/// The file that a path means: what a link leads to, which need not be there, so that the link stays one.
fn target_of(path: &Path) -> PathBuf {
    let mut target = path.to_path_buf();
    for _ in 0..MAX_LINKS {
        let Ok(next) = fs::read_link(&target) else { break };
        target = directory_of(&target).join(next);
    }
    target
}

/// A file that a command reads or writes, and what a message calls it.
pub(crate) type Named<'a> = (&'a str, &'a Path);

/// A file that a command may read, and what a message calls it.
pub(crate) type Input = (&'static str, PathBuf);

/// Checks before the work that every output can be written, and that none of them is an input or another output, by whatever
/// name.
pub(crate) fn expect_outputs(outputs: &[Named], inputs: &[Input]) -> Result<(), Failure> {
    let inputs: Vec<Named> = inputs.iter().map(|(name, path)| (*name, path.as_path())).collect();
    for (index, (name, path)) in outputs.iter().enumerate() {
        expect_directory_of(path)?;
        expect_replaceable(path)?;
        for (other, known) in inputs.iter().chain(&outputs[..index]) {
            if is_same_file(path, known) {
                return Err(Failure::in_file(path, format!("{name} and {other} are one file: expected two")));
            }
        }
    }
    Ok(())
}

/// Whether two paths mean one file, which need not be there yet.
fn is_same_file(one: &Path, other: &Path) -> bool {
    if let Ok(same) = same_file::is_same_file(one, other) {
        return same;
    }
    let place = |path: &Path| {
        let target = target_of(path);
        Some((fs::canonicalize(directory_of(&target)).ok()?, target.file_name()?.to_os_string()))
    };
    place(one).is_some() && place(one) == place(other)
}

/// Checks that an output would not take the place of a device, a pipe or a directory.
pub(crate) fn expect_replaceable(path: &Path) -> Result<(), Failure> {
    match fs::metadata(path) {
        Ok(metadata) if !metadata.is_file() => {
            Err(Failure::in_file(path, "cannot write: is no ordinary file"))
        }
        // Such as links that lead round in a circle.
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
            Err(Failure::in_file(path, format!("cannot write: {}", plain(&error))))
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
    let target = target_of(path);
    if !directory_of(&target).is_dir() || path.is_dir() || path.file_name().is_none() {
        return Err(Failure::in_file(
            path,
            "cannot write: expected a file's name in a directory that there is",
        ));
    }
    // A directory may be there and not be ours to write to.
    let probe = Temporary::new(&target, b"");
    probe.map(drop).map_err(|error| Failure::in_file(path, format!("cannot write: {}", plain(&error))))
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

/// Checks an output's name before the work is done for it.
pub(crate) fn expect_extension(path: &Path, wanted: &str) -> Result<(), Failure> {
    if path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(wanted)) {
        return Ok(());
    }
    Err(Failure::in_file(path, format!("expected a name that ends in .{wanted}")))
}

/// The files that [`textures`] reads from a directory.
pub(crate) fn texture_files(directory: &Path) -> [Input; 3] {
    ["wall", "floor", "top"].map(|name| ("a texture", texture_file(directory, name)))
}

fn texture_file(directory: &Path, name: &str) -> PathBuf {
    let [bmp, png] = ["bmp", "png"].map(|ending| directory.join(name).with_extension(ending));
    if !bmp.exists() && png.exists() { png } else { bmp }
}

/// Wall, floor and top from a directory, or the ones that come with the game.
pub(crate) fn textures(directory: Option<&Path>) -> Result<TextureSet, Failure> {
    let load = |name: &str, built_in: &'static [u8]| {
        let (shown, bytes) = match directory {
            Some(directory) => {
                let path = texture_file(directory, name);
                (path.display().to_string(), read(&path)?)
            }
            None => (name.to_owned(), built_in.to_vec()),
        };
        decode_texture(&shown, &bytes).map_err(Failure::bad_input)
    };
    Ok(TextureSet {
        wall: load("wall.bmp", include_bytes!("../../../../assets/textures/wall.bmp"))?,
        floor: load("floor.bmp", include_bytes!("../../../../assets/textures/floor.bmp"))?,
        top: load("top.bmp", include_bytes!("../../../../assets/textures/top.bmp"))?,
    })
}

/// The system's message without its number.
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
