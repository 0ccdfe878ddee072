//! Wavefront OBJ, read with tobj.

use crate::polygons::PolygonMesh;
use nalgebra::Vector3;
use std::fmt::Write;
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
    #[error("line {line}: face uses vertex {index}, but only {n_vertices} are defined, counted from 1")]
    VertexOutOfRange {
        /// Counted from 1.
        line: usize,
        /// As in the file.
        index: i64,
        /// In the whole file.
        n_vertices: usize,
    },
    /// A face that is no polygon, or one too large to cut into triangles.
    #[error("line {line}: a face of {n_corners} corners: expected 3 to {max}", max = MAX_CORNERS)]
    Corners {
        /// Counted from 1.
        line: usize,
        /// How many.
        n_corners: usize,
    },
    /// A face that runs in circles.
    #[error("line {line}: a face names vertex {vertex} more than {max} times", max = MAX_REPEATS)]
    Repeated {
        /// Counted from 1.
        line: usize,
        /// Counted from 1.
        vertex: usize,
    },
    /// Faces for the last vertices are missing.
    #[error("line {line}: the file is cut off here: faces for its last vertices are missing")]
    CutOff {
        /// The last one, counted from 1.
        line: usize,
    },
    /// Anything else that the reader refuses.
    #[error("not a Wavefront OBJ: {reason}")]
    Other {
        /// The reader's words.
        reason: String,
    },
}

/// Most corners of a face: cutting a larger one into triangles takes seconds, and no wall has as many.
const MAX_CORNERS: usize = 4096;

/// How often a face may name a vertex. A polygon with holes names the ends of the bridges to them twice; one that goes round
/// and round would take minutes to cut into triangles.
const MAX_REPEATS: usize = 4;

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
    let mut text = String::from_utf8_lossy(bytes);
    if !text.contains('\n') {
        // Line ends of old Macintoshes.
        text = text.replace('\r', "\n").into();
    }
    let geometry = geometry(&text)?;
    let options = LoadOptions { ignore_lines: true, ignore_points: true, ..LoadOptions::default() };
    let no_materials = |_: &std::path::Path| Err(LoadError::OpenFileFailed);
    let other = |reason: String| ObjError::Other { reason };
    let (models, _) = tobj::load_obj_buf(&mut geometry.as_bytes(), &options, no_materials)
        .map_err(|error| other(error.to_string()))?;
    // Without objects and groups there is one model at most.
    let Some(model) = models.first() else { return Ok(PolygonMesh::default()) };
    let positions = model.mesh.positions.chunks_exact(3).map(|p| Vector3::new(p[0], p[1], p[2])).collect();
    let mut mesh = PolygonMesh::new(positions).ok_or_else(|| other("too many vertices".to_owned()))?;
    let mut rest = &model.mesh.indices[..];
    let mut arities = model.mesh.face_arities.iter().map(|arity| *arity as usize);
    while !rest.is_empty() {
        // Without arities every face is a triangle.
        let n_corners = arities.next().unwrap_or(3);
        let Some((face, tail)) = rest.split_at_checked(n_corners).filter(|(face, _)| mesh.push_face(face))
        else {
            return Err(other(format!("a face of {n_corners} corners is cut short")));
        };
        debug_assert_eq!(face.len(), n_corners);
        rest = tail;
    }
    Ok(mesh)
}

/// The lines that make the maze and nothing else, checked: vertices with three numbers, and faces with the vertex part of
/// their indices. What the reader never sees cannot confuse it (it takes long `l` elements for faces), and each fault is
/// told with its line.
fn geometry(text: &str) -> Result<String, ObjError> {
    let is_vertex = |line: &&str| line.split_whitespace().next() == Some("v");
    let n_vertices = text.lines().filter(is_vertex).count();
    let mut geometry = String::with_capacity(text.len());
    let (mut n_so_far, mut last_used, mut n_faces) = (0, 0, 0_usize);
    for (index, content) in text.lines().enumerate() {
        let line = index + 1;
        let found = || content.chars().take(60).collect::<String>();
        let mut words = content.split_whitespace();
        match words.next() {
            Some("v") => {
                let mut numbers =
                    words.map(|word| word.parse::<f64>().ok().filter(|value| value.is_finite()));
                let [Some(Some(x)), Some(Some(y)), Some(Some(z))] =
                    [numbers.next(), numbers.next(), numbers.next()]
                else {
                    return Err(ObjError::Vertex { line, found: found() });
                };
                n_so_far += 1;
                // Writing to a String cannot fail; f64 is written so that it reads back to the same bits.
                let _ = writeln!(geometry, "v {x} {y} {z}");
            }
            Some("f") => {
                n_faces += 1;
                let mut corners = Vec::new();
                for word in words {
                    let vertex = word.split('/').next().and_then(|vertex| vertex.parse::<i64>().ok());
                    let vertex = vertex.ok_or_else(|| ObjError::Face { line, found: found() })?;
                    let absolute = absolute_index(vertex, n_so_far, n_vertices);
                    let absolute =
                        absolute.ok_or(ObjError::VertexOutOfRange { line, index: vertex, n_vertices })?;
                    corners.push(absolute);
                    last_used = if last_used < absolute { absolute } else { last_used };
                }
                if corners.len() < 3 || MAX_CORNERS < corners.len() {
                    // The last line of a file that is cut off gets the truer reason below.
                    if corners.len() < 3 && index + 1 == text.lines().count() && !text.ends_with('\n') {
                        return Err(ObjError::CutOff { line });
                    }
                    return Err(ObjError::Corners { line, n_corners: corners.len() });
                }
                if let Some(vertex) = named_too_often(&corners) {
                    return Err(ObjError::Repeated { line, vertex });
                }
                let words: Vec<String> = corners.iter().map(usize::to_string).collect();
                let _ = writeln!(geometry, "f {}", words.join(" "));
            }
            _ => {}
        }
    }
    match is_cut_off(text, n_faces, n_vertices - last_used, n_vertices) {
        true => Err(ObjError::CutOff { line: text.lines().count() }),
        false => Ok(geometry),
    }
}

/// A corner that a face names more than [`MAX_REPEATS`] times.
fn named_too_often(corners: &[usize]) -> Option<usize> {
    let mut sorted = corners.to_vec();
    sorted.sort_unstable();
    sorted.chunk_by(|a, b| a == b).find(|same| MAX_REPEATS < same.len()).map(|same| same[0])
}

/// An index counted from 1, or back from the vertices so far; `None` when there is no such vertex.
fn absolute_index(index: i64, n_so_far: usize, n_vertices: usize) -> Option<usize> {
    let distance = usize::try_from(index.unsigned_abs()).ok()?;
    if index < 0 {
        return n_so_far.checked_sub(distance).map(|before| before + 1);
    }
    (1..=n_vertices).contains(&distance).then_some(distance)
}

/// Part of a file's vertices, at its end, that may be without a face in a whole file.
const MAX_UNUSED_PART: f64 = 0.05;

/// Whether a file that could be read is only the beginning of one: faces for many of its last vertices are missing, or for
/// any of them where the last line does not end either (many good files lack the last line break, so that alone says
/// nothing).
fn is_cut_off(text: &str, n_faces: usize, n_unused: usize, n_vertices: usize) -> bool {
    #[allow(clippy::cast_precision_loss, reason = "a file has far fewer than 2^53 vertices")]
    let unused_part = n_unused as f64 / n_vertices as f64;
    // Vertices behind the last face may also belong to lines and points.
    let has_lines = || text.lines().any(|line| matches!(line.split_whitespace().next(), Some("l" | "p")));
    let suspicious = if text.ends_with('\n') { MAX_UNUSED_PART < unused_part } else { 0 < n_unused };
    0 < n_faces && suspicious && !has_lines()
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
            "line 5: face uses vertex 9, but only 4 are defined, counted from 1"
        );
        assert_eq!(
            message(&format!("{SQUARE}f 1 2 -5\n")),
            "line 5: face uses vertex -5, but only 4 are defined, counted from 1"
        );
        assert_eq!(
            message(&format!("{SQUARE}f 1 2 0\n")),
            "line 5: face uses vertex 0, but only 4 are defined, counted from 1"
        );
        assert!(
            message(&format!("{SQUARE}f 1 b 3\n")).starts_with("line 5: expected `f` and vertex indices")
        );
    }

    #[test]
    fn a_file_that_ends_in_the_middle_is_told_from_one_without_a_last_line_break() {
        assert_eq!(
            message(&format!("{SQUARE}f 1 2 3\nf 1 3")),
            "line 6: the file is cut off here: faces for its last vertices are missing"
        );
        assert!(message(&format!("{SQUARE}f 1 2 3\n")).starts_with("line 5: the file is cut off here"));
        assert!(read(format!("{SQUARE}f 1 2 3\nf 1 3 4").as_bytes()).is_ok());
        assert!(read(format!("{SQUARE}f 1 2 3\nf -1 -2 -4").as_bytes()).is_ok());
    }

    #[test]
    fn a_face_that_goes_round_and_round_is_refused_at_once() {
        let rounds = format!("{SQUARE}f {}\n", "1 2 4 3 ".repeat(1000));
        assert_eq!(message(&rounds), "line 5: a face names vertex 1 more than 4 times");
        let large = format!("{SQUARE}f {}\n", "1 2 4 3 ".repeat(1025));
        assert_eq!(message(&large), "line 5: a face of 4100 corners: expected 3 to 4096");
    }

    #[test]
    fn what_is_no_wall_is_not_looked_at() {
        let whole = read(format!("{SQUARE}f 1 2 3 4\n").as_bytes()).unwrap();
        let noise = "vt x\nvn 1\nl 1 2 99\np 7\nusemtl\n";
        let huge = "f 1/18446744073709551615/-3 2//6148914691236517206 3/-9 4\n";
        assert_eq!(read(format!("{SQUARE}{noise}{huge}").as_bytes()).unwrap(), whole);
        let old = format!("{SQUARE}f 1 2 3 4\n").replace('\n', "\r");
        assert_eq!(read(old.as_bytes()).unwrap(), whole);
        // Vertices that only lines use do not make a file look cut off.
        assert!(read(format!("{SQUARE}f 1 2 3\nl 3 4").as_bytes()).is_ok());
        // A weight or colours after the coordinates are ignored.
        let coloured = SQUARE.replace('\n', " 1 0 0\n");
        assert_eq!(read(format!("{coloured}f 1 2 3 4\n").as_bytes()).unwrap(), whole);
    }

    #[test]
    fn a_file_cut_anywhere_never_panics() {
        let text = format!("{SQUARE}vn 0 0 1\nf 1//1 2//1 3//1 4//1\nf 1 2 3\n");
        for end in 0..text.len() {
            let _ = read(&text.as_bytes()[..end]);
        }
    }
}
