//! Wavefront OBJ, read with tobj.

use crate::polygons::PolygonMesh;
use nalgebra::Vector3;
use tobj::{LoadError, LoadOptions};

/// Why bytes are no OBJ.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ObjError {
    /// Nothing to read.
    #[error("the file is empty: expected a Wavefront OBJ")]
    Empty,
    /// Zero bytes never occur in text.
    #[error("not a text file (zero byte at offset {offset}): expected a Wavefront OBJ")]
    NotText {
        /// Of the first zero byte.
        offset: usize,
    },
    /// A vertex that cannot be read.
    #[error("line {line}: expected `v X Y Z` with three finite numbers, found `{found}`")]
    Vertex {
        /// Counted from 1.
        line: usize,
        /// The line, shortened.
        found: String,
    },
    /// A face that cannot be read.
    #[error("line {line}: expected `f` and vertex indices such as 3, 3/1 or 3/1/2, found `{found}`")]
    Face {
        /// Counted from 1.
        line: usize,
        /// The line, shortened.
        found: String,
    },
    /// A face that names a vertex which is not there.
    #[error("line {line}: face uses vertex {index}, but only {n_vertices} are defined")]
    VertexOutOfRange {
        /// Counted from 1.
        line: usize,
        /// As in the file.
        index: i64,
        /// In the whole file.
        n_vertices: usize,
    },
    /// The file ends in the middle of a line, and faces for its last vertices are missing.
    #[error("line {line}: the file is cut off here: no face uses the last of its {n_vertices} vertices")]
    CutOff {
        /// Counted from 1.
        line: usize,
        /// In the whole file.
        n_vertices: usize,
    },
    /// Anything else that the reader refuses.
    #[error("not a Wavefront OBJ: {reason}")]
    Other {
        /// The reader's words.
        reason: String,
    },
}

/// Polygons of an OBJ file; objects and groups are joined, lines, points, normals and materials are not looked at.
///
/// # Errors
/// Bytes that are not an OBJ, with the line where there is one.
pub fn read(bytes: &[u8]) -> Result<PolygonMesh, ObjError> {
    if bytes.iter().all(u8::is_ascii_whitespace) {
        return Err(ObjError::Empty);
    }
    if let Some(offset) = bytes.iter().position(|byte| *byte == 0) {
        return Err(ObjError::NotText { offset });
    }
    // Names and comments may be in any old encoding.
    let text = String::from_utf8_lossy(bytes);
    let options = LoadOptions { ignore_lines: true, ignore_points: true, ..LoadOptions::default() };
    let no_materials = |_: &std::path::Path| Err(LoadError::OpenFileFailed);
    let (models, _) = tobj::load_obj_buf(&mut text.as_bytes(), &options, no_materials)
        .map_err(|error| locate(&text, error))?;
    if let Some(error) = cut_off(&text) {
        return Err(error);
    }
    let n_positions: usize = models.iter().map(|model| model.mesh.positions.len() / 3).sum();
    let mut positions = Vec::with_capacity(n_positions);
    for model in &models {
        positions.extend(model.mesh.positions.chunks_exact(3).map(|p| Vector3::new(p[0], p[1], p[2])));
    }
    let other = |reason: &str| ObjError::Other { reason: reason.to_owned() };
    let mut mesh = PolygonMesh::new(positions).ok_or_else(|| locate(&text, LoadError::PositionParseError))?;
    let mut base = 0;
    for model in &models {
        let arities = &model.mesh.face_arities;
        let mut rest = &model.mesh.indices[..];
        let mut arities = arities.iter().map(|arity| *arity as usize);
        while !rest.is_empty() {
            // Without arities every face is a triangle.
            let n_corners = arities.next().unwrap_or(3);
            let (face, tail) =
                rest.split_at_checked(n_corners).ok_or_else(|| other("a face is cut short"))?;
            let corners: Vec<u32> = face.iter().map(|corner| base + corner).collect();
            if !mesh.push_face(&corners) {
                return Err(other("a face uses a vertex that is not defined"));
            }
            rest = tail;
        }
        // `PolygonMesh::new` has checked that all positions together can be counted by a u32.
        base += u32::try_from(model.mesh.positions.len() / 3).unwrap_or(u32::MAX);
    }
    Ok(mesh)
}

/// Part of a file's vertices, at its end, that may be without a face in a whole file.
const MAX_UNUSED_PART: f64 = 0.05;

/// Whether a file that could be read is only the beginning of one.
///
/// The sign is a tail of vertices that no face uses: any at all when the last line does not end either (many good files
/// lack the last line break, so that alone says nothing), more than a few otherwise.
fn cut_off(text: &str) -> Option<ObjError> {
    let (mut n_vertices, mut last_used, mut n_faces) = (0, 0, 0_usize);
    for line in text.lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => n_vertices += 1,
            Some("f") => {
                n_faces += 1;
                let indices = words.filter_map(|word| word.split('/').next()?.parse::<i64>().ok());
                let absolute = indices.map(|index| if index < 0 { n_vertices + 1 + index } else { index });
                last_used = absolute.chain([last_used]).max().unwrap_or(last_used);
            }
            _ => {}
        }
    }
    #[allow(clippy::cast_precision_loss, reason = "a file has far fewer than 2^53 vertices")]
    let [n_unused, most] = [(n_vertices - last_used) as f64, n_vertices as f64 * MAX_UNUSED_PART];
    let most = if text.ends_with('\n') { most } else { 0.0 };
    (0 < n_faces && most < n_unused).then(|| ObjError::CutOff {
        line: text.lines().count(),
        n_vertices: usize::try_from(n_vertices).unwrap_or_default(),
    })
}

/// The first line that explains why the reader refused the file; the reader itself does not say.
fn locate(text: &str, error: LoadError) -> ObjError {
    let n_vertices = text.lines().filter(|line| line.trim_start().starts_with("v ")).count();
    let mut n_so_far = 0;
    for (index, line) in text.lines().enumerate() {
        let found = || line.chars().take(60).collect::<String>();
        let line_number = index + 1;
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                let numbers: Vec<_> = words.map(str::parse::<f64>).collect();
                let finite = |number: &Result<f64, _>| number.as_ref().is_ok_and(|value| value.is_finite());
                if numbers.len() < 3 || !numbers[..3].iter().all(finite) {
                    return ObjError::Vertex { line: line_number, found: found() };
                }
                n_so_far += 1;
            }
            Some("f") => {
                for word in words {
                    let Ok(vertex) = word.split('/').next().unwrap_or(word).parse::<i64>() else {
                        return ObjError::Face { line: line_number, found: found() };
                    };
                    // Negative indices count back from the vertices defined so far.
                    let known = if vertex < 0 { n_so_far } else { n_vertices };
                    if vertex == 0
                        || usize::try_from(vertex.unsigned_abs()).is_ok_and(|wanted| known < wanted)
                    {
                        return ObjError::VertexOutOfRange { line: line_number, index: vertex, n_vertices };
                    }
                }
            }
            _ => {}
        }
    }
    ObjError::Other { reason: error.to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

    fn message(text: &str) -> String {
        read(text.as_bytes()).unwrap_err().to_string()
    }

    #[test]
    fn polygons_are_read_as_they_are() {
        let text = format!(
            "# c\r\nmtllib no.mtl\no a\n{SQUARE}vt 0 0\nf 1 2 3 4\nf 1/1 2/1 3/1\no b\nl 1 2\nf -4 -3 -2\n"
        );
        let mesh = read(text.as_bytes()).unwrap();
        let faces: Vec<usize> = mesh.faces().map(<[u32]>::len).collect();
        assert_eq!(faces, [4, 3, 3]);
        let last = mesh.faces().last().unwrap();
        let corners: Vec<_> = last.iter().map(|&corner| mesh.positions()[corner as usize]).collect();
        assert_eq!(corners[2], Vector3::new(1.0, 1.0, 0.0));
    }

    #[test]
    fn bad_files_are_refused_with_the_line() {
        assert_eq!(message(""), "the file is empty: expected a Wavefront OBJ");
        assert!(message("v 0 0\0").starts_with("not a text file (zero byte at offset 5)"));
        assert_eq!(
            message("v 0 0 0\nv 1 x 0\n"),
            "line 2: expected `v X Y Z` with three finite numbers, found `v 1 x 0`"
        );
        assert_eq!(
            message("v 0 0 nan\nv 1 0 0\nv 1 1 0\nf 1 2 3"),
            "line 1: expected `v X Y Z` with three finite numbers, found `v 0 0 nan`"
        );
        assert_eq!(
            message(&format!("{SQUARE}f 1 2 9\n")),
            "line 5: face uses vertex 9, but only 4 are defined"
        );
        assert_eq!(
            message(&format!("{SQUARE}f 1 2 -5\n")),
            "line 5: face uses vertex -5, but only 4 are defined"
        );
        assert_eq!(
            message(&format!("{SQUARE}f 1 2 0\n")),
            "line 5: face uses vertex 0, but only 4 are defined"
        );
        assert!(
            message(&format!("{SQUARE}f 1 b 3\n")).starts_with("line 5: expected `f` and vertex indices")
        );
    }

    #[test]
    fn a_file_that_ends_in_the_middle_is_told_from_one_without_a_last_line_break() {
        assert_eq!(
            message(&format!("{SQUARE}f 1 2 3\nf 1 3")),
            "line 6: the file is cut off here: no face uses the last of its 4 vertices"
        );
        assert!(message(&format!("{SQUARE}f 1 2 3\n")).starts_with("line 5: the file is cut off here"));
        assert!(read(format!("{SQUARE}f 1 2 3\nf 1 3 4").as_bytes()).is_ok());
        assert!(read(format!("{SQUARE}f 1 2 3\nf -1 -2 -4").as_bytes()).is_ok());
    }

    #[test]
    fn a_file_cut_anywhere_never_panics() {
        let text = format!("{SQUARE}vn 0 0 1\nf 1//1 2//1 3//1 4//1\nf 1 2 3\n");
        for end in 0..text.len() {
            let _ = read(&text.as_bytes()[..end]);
        }
    }
}
