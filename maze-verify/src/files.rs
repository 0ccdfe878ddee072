//! Files in and out; an output is whole or not there.

use crate::BadInput;
use std::fmt::Display;
use std::io::{Read, Write};
use std::path::Path;

/// Largest file that is read: a results.json of thousands of scenes.
const MAX_BYTES: u64 = 1 << 28;

/// Read beyond what is expected: some files of the system are read in whole blocks only.
const BLOCK: u64 = 4096;

/// Bad input, with the file's name in front.
pub(crate) fn in_file(path: &Path, reason: impl Display) -> BadInput {
    BadInput(format!("{}: {reason}", path.display()))
}

/// The whole file as text.
pub(crate) fn read_text(path: &Path) -> Result<String, BadInput> {
    let metadata = std::fs::metadata(path).map_err(|error| in_file(path, error))?;
    if !metadata.is_file() {
        return Err(in_file(path, "not an ordinary file"));
    }
    if MAX_BYTES < metadata.len() {
        return Err(in_file(path, format!("{} bytes, expected at most {MAX_BYTES}", metadata.len())));
    }
    // What a file says of its length is not what it gives.
    let mut bytes = Vec::new();
    let file = std::fs::File::open(path).map_err(|error| in_file(path, error))?;
    let most = metadata.len().saturating_add(1 << 20);
    file.take(most + BLOCK).read_to_end(&mut bytes).map_err(|error| in_file(path, error))?;
    if most < bytes.len() as u64 {
        return Err(in_file(path, "goes on after the bytes that it says to have: expected an ordinary file"));
    }
    String::from_utf8(bytes).map_err(|_| in_file(path, "not a text in UTF-8"))
}

/// The directory, if it is not there yet.
pub(crate) fn make_directory(path: &Path) -> Result<(), BadInput> {
    std::fs::create_dir_all(path)
        .map_err(|error| in_file(path, format!("expected a directory, or a place to make one: {error}")))
}

/// Writes beside the target under a temporary name, then renames.
pub(crate) fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), BadInput> {
    let failed = |error: std::io::Error| in_file(path, format!("cannot write: {error}"));
    let directory = path.parent().filter(|parent| !parent.as_os_str().is_empty());
    let mut file = tempfile::Builder::new();
    // A temporary file is private by default; the output is an ordinary file.
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        let mode = std::fs::metadata(path).map_or(0o644, |metadata| metadata.permissions().mode() & 0o777);
        file.permissions(std::fs::Permissions::from_mode(mode));
    }
    let mut file = file.tempfile_in(directory.unwrap_or(Path::new("."))).map_err(failed)?;
    file.write_all(bytes).map_err(failed)?;
    file.persist(path).map_err(|error| failed(error.error))?;
    Ok(())
}

/// Prints to stdout. A reader that has seen enough (`| head`) is no error.
pub(crate) fn print(text: &str) -> Result<(), BadInput> {
    match std::io::stdout().write_all(text.as_bytes()) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(BadInput(format!("cannot print: {error}")))
        }
        _ => Ok(()),
    }
}
