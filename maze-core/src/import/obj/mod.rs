//! Wavefront OBJ (B1 of the Advanced Visualizer's manual, 1995): the polygons of it, and nothing else.
//!
//! tobj reads the vertices and faces. What it gets is checked and cleaned line by line in `clean`, so that no fault in
//! normals, materials or names makes it refuse a good maze, and every fault that matters is reported with its line.

mod clean;

use crate::assembly::polygons::PolygonMesh;
use clean::{Counts, Faces, LineReader, Lines, found, vertices};
use nalgebra::Vector3;
use std::io::BufReader;
use std::path::Path;
use tobj::{LoadError, LoadOptions, Model};

/// Why bytes are no OBJ.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ObjError {
    /// Nothing to read.
    #[error("the file is empty: expected a Wavefront OBJ")]
    Empty,
    /// Zero bytes never occur in text.
    #[error("not a text file (zero byte at offset {offset}{kind}): expected a Wavefront OBJ")]
    NotText {
        /// Of the first zero byte.
        offset: usize,
        /// What it looks like instead: empty, or a clause to go on with.
        kind: &'static str,
    },
    /// Text of another kind.
    #[error("not a Wavefront OBJ: no line begins with `v` or `f`; the first one is `{found}`")]
    NotObj {
        /// The first line that is not empty, shortened.
        found: String,
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
    /// A face too large to cut into triangles.
    #[error("line {line}: a face of {n_corners} corners: expected at most {max}", max = MAX_CORNERS)]
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
    /// More than can be counted in 32 bits.
    #[error("too many vertices or corners: expected fewer than 2^32 of each")]
    TooMany,
    /// Anything else that the reader refuses.
    #[error("not a Wavefront OBJ: {0}")]
    Reader(String),
}

/// Most corners of a face: cutting a larger one into triangles takes seconds, and no wall has as many.
const MAX_CORNERS: usize = 4096;

/// How often a face may name a vertex. A polygon with holes names the ends of the bridges to them twice; one that goes round
/// and round would take minutes to cut into triangles.
const MAX_REPEATS: usize = 4;

/// Polygons of an OBJ file; objects and groups are joined; lines, points, curves, normals and materials are not read.
///
/// A face of fewer than three corners is kept as it is: some programs write loose edges so, and it has no area. Positions
/// are those that faces use; in a large file some come more than once.
///
/// # Errors
/// Bytes that are not an OBJ, with the line where there is one.
///
/// ```
/// use maze_core::{AssembleOptions, Maze, import};
///
/// // A maze would have more than one upright face: this one is refused with the reason.
/// let mesh = import::obj::read(b"v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nf 1 2 3 4\n")?;
/// let error = Maze::from_polygons(&mesh, &AssembleOptions::default()).unwrap_err();
/// println!("{error}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn read(bytes: &[u8]) -> Result<PolygonMesh, ObjError> {
    if bytes.iter().all(u8::is_ascii_whitespace) {
        return Err(ObjError::Empty);
    }
    let decoded = from_utf16(bytes);
    let text = match &decoded {
        Some(text) => text.as_bytes(),
        None => bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes),
    };
    if let Some(offset) = text.iter().position(|byte| *byte == 0) {
        return Err(ObjError::NotText { offset, kind: binary_kind(bytes) });
    }
    let counts = Counts::of(text);
    if counts.n_vertices == 0 && counts.n_faces == 0 {
        let mut lines = Lines::new(text).map(|line| found(&line.content));
        return Err(ObjError::NotObj {
            found: lines.find(|line| !line.trim().is_empty()).unwrap_or_default(),
        });
    }
    if u32::try_from(counts.n_vertices).is_err() || u32::try_from(counts.n_corners).is_err() {
        return Err(ObjError::TooMany);
    }
    let mut lines = LineReader::new(vertices(text).chain(Faces::new(text, &counts)));
    let no_materials = |_: &Path| Err(LoadError::OpenFileFailed);
    let loaded = tobj::load_obj_buf(&mut BufReader::new(&mut lines), &LoadOptions::default(), no_materials);
    match (lines.fault, loaded) {
        (Some(fault), _) => Err(fault),
        (None, Ok((models, _))) => joined(models, &counts).ok_or(ObjError::TooMany),
        (None, Err(error)) => Err(ObjError::Reader(error.to_string())),
    }
}

/// All models in one mesh; `None` where 32 bits cannot count its positions or corners.
fn joined(models: Vec<Model>, counts: &Counts) -> Option<PolygonMesh> {
    let n_positions = models.iter().map(|model| model.mesh.positions.len() / 3).sum();
    let mut positions = Vec::with_capacity(n_positions);
    let mut faces = Vec::with_capacity(models.len());
    for model in models {
        // A model counts its own positions from 0.
        faces.push((u32::try_from(positions.len()).ok()?, model.mesh.indices, model.mesh.face_arities));
        let own = model.mesh.positions.chunks_exact(3);
        positions.extend(own.map(|position| Vector3::new(position[0], position[1], position[2])));
    }
    let mut mesh = PolygonMesh::new(positions).ok()?;
    mesh.reserve(counts.n_faces, counts.n_corners);
    for (first_position, mut corners, mut arities) in faces {
        corners.iter_mut().for_each(|corner| *corner += first_position);
        if arities.is_empty() {
            // A model of triangles alone comes without.
            arities = vec![3; corners.len() / 3];
        }
        let mut rest = &corners[..];
        for arity in arities {
            let (face, tail) = rest.split_at_checked(arity as usize)?;
            rest = tail;
            mesh.push_face(face).ok()?;
        }
    }
    Some(mesh)
}

/// Text in UTF-16, as some shells write what a program prints; known by its byte order mark.
fn from_utf16(bytes: &[u8]) -> Option<String> {
    let unit = match bytes.first_chunk()? {
        [0xff, 0xfe] => u16::from_le_bytes,
        [0xfe, 0xff] => u16::from_be_bytes,
        _ => return None,
    };
    let units = bytes[2..].chunks_exact(2).map(|pair| unit([pair[0], pair[1]]));
    Some(char::decode_utf16(units).map(|decoded| decoded.unwrap_or(char::REPLACEMENT_CHARACTER)).collect())
}

/// What a file with zero bytes is, by its first ones.
fn binary_kind(bytes: &[u8]) -> &'static str {
    const COMPILED: &str = "; it begins like an object file of a compiler, which shares the ending .obj";
    let kinds: [(&[u8], &str); 9] = [
        (b"\x4c\x01", COMPILED), // COFF, 32-bit
        (b"\x64\x86", COMPILED), // COFF, 64-bit
        (b"\x00\x00\xff\xff", COMPILED),
        (b"\x7fELF", COMPILED),
        (b"PK\x03\x04", "; it begins like a ZIP archive"),
        (b"\x1f\x8b", "; it begins like a gzip archive"),
        (b"\x89PNG", "; it begins like a PNG picture"),
        (b"glTF", "; it begins like a binary glTF"),
        (b"Kaydara", "; it begins like an FBX"),
    ];
    kinds.iter().find(|(magic, _)| bytes.starts_with(magic)).map_or("", |(_, kind)| kind)
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
        assert_eq!(message(&large), "line 5: a face of 4100 corners: expected at most 4096");
    }

    #[test]
    fn what_is_no_wall_is_not_read() {
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
    fn lines_that_go_on_byte_order_marks_and_wide_text_are_read() {
        let whole = read(format!("{SQUARE}f 1 2 3 4\n").as_bytes()).unwrap();
        let broken = "v 0 0 \\\r\n 0\r\nv 1 0 0 # right \\\r\nv 1 1\\\r\n0\r\nv 0 1 0\r\n# C:\\\r\nf 1 2 \\\r\n3 \\\r\n4\r\n";
        // A comment swallows a backslash, so the second vertex is not joined with the third.
        assert_eq!(read(broken.replace(" # right \\", " # right").as_bytes()).unwrap(), whole);
        let text = format!("# caf\u{e9}\n{SQUARE}f 1 2 3 4 # a square\n");
        let with_mark = format!("\u{feff}{text}");
        assert_eq!(read(with_mark.as_bytes()).unwrap(), whole);
        let little: Vec<u8> = with_mark.encode_utf16().flat_map(u16::to_le_bytes).collect();
        let big: Vec<u8> = with_mark.encode_utf16().flat_map(u16::to_be_bytes).collect();
        assert_eq!((read(&little).unwrap(), read(&big).unwrap()), (whole.clone(), whole));
        // A continued line is reported by the number of its first line.
        assert!(message(&format!("{SQUARE}f 1 2 \\\n9\n")).starts_with("line 5: face uses vertex 9"));
    }

    #[test]
    fn what_is_no_obj_is_told_by_what_it_is() {
        assert_eq!(
            message("solid cube\n facet normal 0 0 1\n"),
            "not a Wavefront OBJ: no line begins with `v` or `f`; the first one is `solid cube`"
        );
        let compiled = read(b"\x4c\x01\x8a\x02\xd7\x9bVi\xea\xde\x03\0.drectve").unwrap_err().to_string();
        assert!(compiled.contains("an object file of a compiler"), "{compiled}");
    }

    #[test]
    fn an_edge_written_as_a_face_is_kept_and_has_no_area() {
        let mesh = read(format!("{SQUARE}f 1 2\nf 1 2 3 4\n").as_bytes()).unwrap();
        assert_eq!(mesh.faces().map(<[u32]>::len).collect::<Vec<_>>(), [2, 4]);
    }

    #[test]
    fn a_file_too_large_for_one_object_is_one_mesh() {
        // Vertices may come after the faces that name them; triangles alone are told apart from other polygons.
        let triangles = "f 2 3 4\n".repeat(40_000);
        let others = "f 4 3 2 1\nf 2 1\nf\n".repeat(30_000);
        let mesh = read(format!("{triangles}{SQUARE}{others}").as_bytes()).unwrap();
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, y]| Vector3::new(x, y, 0.0));
        let [a, b, c, d] = square;
        let expected: [&[Vector3<f64>]; 4] = [&[b, c, d], &[d, c, b, a], &[b, a], &[]];
        let faces = std::iter::repeat_n(expected[0], 40_000)
            .chain(std::iter::repeat_n(&expected[1..], 30_000).flatten().copied());
        assert_eq!(mesh.n_faces(), 130_000);
        for (face, expected) in mesh.faces().zip(faces) {
            assert!(face.iter().map(|&corner| &mesh.positions()[corner as usize]).eq(expected));
        }
        assert!(square.len() < mesh.positions().len() && mesh.positions().len() < 16, "some objects");
    }

    #[test]
    fn a_file_cut_anywhere_never_panics() {
        let text = format!("{SQUARE}vn 0 0 1\nf 1//1 2//1 3//1 4//1\nf 1 2 3\n");
        for end in 0..text.len() {
            let _ = read(&text.as_bytes()[..end]);
        }
    }
}
