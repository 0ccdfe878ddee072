//! Wavefront OBJ (B1 of the Advanced Visualizer's manual, 1995): the polygons of it, and nothing else.
//!
//! Of every line only the corners' positions count. A general reader would also look at normals, materials and groups,
//! refuse a good maze for a fault in them, and take several times the memory.

use crate::polygons::PolygonMesh;
use nalgebra::Vector3;
use std::borrow::Cow;

/// Why bytes are no OBJ.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
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
}

/// Most corners of a face: cutting a larger one into triangles takes seconds, and no wall has as many.
const MAX_CORNERS: usize = 4096;

/// How often a face may name a vertex. A polygon with holes names the ends of the bridges to them twice; one that goes round
/// and round would take minutes to cut into triangles.
const MAX_REPEATS: usize = 4;

/// Polygons of an OBJ file; objects and groups are joined; lines, points, curves, normals and materials are not looked at.
///
/// A face of fewer than three corners is kept as it is: some programs write loose edges so, and it has no area.
///
/// # Errors
/// Bytes that are not an OBJ, with the line where there is one.
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
    let mut positions = Vec::with_capacity(counts.n_vertices);
    for line in Lines::new(text).filter(|line| line.keyword() == b"v") {
        positions.push(vertex(&line)?);
    }
    let mut mesh = PolygonMesh::new(positions).ok_or(ObjError::TooMany)?;
    if u32::try_from(counts.n_corners).is_err() {
        return Err(ObjError::TooMany);
    }
    mesh.reserve(counts.n_faces, counts.n_corners);
    let (mut n_so_far, mut last_used, mut corners) = (0, 0, Vec::new());
    for line in Lines::new(text) {
        match line.keyword() {
            b"v" => n_so_far += 1,
            b"f" | b"fo" => {
                face(&line, [n_so_far, counts.n_vertices], &mut corners)?;
                let cut_off = || ObjError::CutOff { line: line.number };
                if corners.len() < 3 && line.number == counts.n_lines && !text.ends_with(b"\n") {
                    return Err(cut_off());
                }
                for corner in &corners {
                    last_used = if last_used <= *corner { *corner + 1 } else { last_used };
                }
                // Every corner was checked against the number of positions.
                if !mesh.push_face(&corners) {
                    return Err(ObjError::TooMany);
                }
            }
            _ => {}
        }
    }
    match counts.is_cut_off(text, counts.n_vertices - last_used as usize) {
        true => Err(ObjError::CutOff { line: counts.n_lines }),
        false => Ok(mesh),
    }
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

/// A line, joined with those that it says it goes on in.
struct Line<'a> {
    number: usize, // counted from 1
    content: Cow<'a, [u8]>,
}

/// The words of a line up to a comment.
fn words(content: &[u8]) -> impl Iterator<Item = &[u8]> {
    let code = content.split(|byte| *byte == b'#').next().unwrap_or_default();
    code.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty())
}

/// A line for a message: shortened, and in whatever encoding.
fn found(content: &[u8]) -> String {
    String::from_utf8_lossy(content).trim_end().chars().take(60).collect()
}

impl Line<'_> {
    /// Its first word; nothing for a comment.
    fn keyword(&self) -> &[u8] {
        words(&self.content).next().unwrap_or_default()
    }

    /// What comes after the first word.
    fn arguments(&self) -> impl Iterator<Item = &[u8]> {
        words(&self.content).skip(1)
    }
}

/// Every line of a file.
struct Lines<'a> {
    rest: &'a [u8],
    line_end: u8,
    number: usize,
}

impl<'a> Lines<'a> {
    fn new(text: &'a [u8]) -> Self {
        // Line ends of old Macintoshes are a carriage return alone.
        let line_end = if text.contains(&b'\n') { b'\n' } else { b'\r' };
        Self { rest: text, line_end, number: 0 }
    }

    /// Up to the next line end, which is left out.
    fn next_raw(&mut self) -> Option<&'a [u8]> {
        if self.rest.is_empty() {
            return None;
        }
        self.number += 1;
        let end = self.rest.iter().position(|byte| *byte == self.line_end).unwrap_or(self.rest.len());
        let line = &self.rest[..end];
        self.rest = self.rest.get(end + 1..).unwrap_or_default();
        Some(line)
    }
}

/// A vertex or face that goes on in the next line, without the backslash that says so. Comments do not: some end with the
/// path of a Windows directory.
fn unfinished(line: &[u8]) -> Option<&[u8]> {
    let line = line.trim_ascii_end().strip_suffix(b"\\")?;
    matches!(words(line).next(), Some(b"v" | b"f" | b"fo")).then_some(line)
}

impl<'a> Iterator for Lines<'a> {
    type Item = Line<'a>;

    fn next(&mut self) -> Option<Line<'a>> {
        let line = self.next_raw()?;
        let number = self.number;
        let Some(begun) = unfinished(line) else { return Some(Line { number, content: line.into() }) };
        let mut content = begun.to_vec();
        while let Some(line) = self.next_raw() {
            content.push(b' ');
            let trimmed = line.trim_ascii_end();
            let Some(more) = trimmed.strip_suffix(b"\\") else {
                content.extend_from_slice(trimmed);
                break;
            };
            content.extend_from_slice(more);
        }
        Some(Line { number, content: content.into() })
    }
}

/// Three finite numbers; a weight or colours after them are ignored.
fn vertex(line: &Line) -> Result<Vector3<f64>, ObjError> {
    let mut position = Vector3::zeros();
    let mut numbers = line.arguments();
    for value in position.iter_mut() {
        let number = numbers.next().and_then(|word| std::str::from_utf8(word).ok()?.parse().ok());
        *value = number
            .filter(|value: &f64| value.is_finite())
            .ok_or_else(|| ObjError::Vertex { line: line.number, found: found(&line.content) })?;
    }
    Ok(position)
}

/// The corners of a face, counted from 0. Indices count from 1 in the whole file, or back from the vertices so far.
fn face(line: &Line, [n_so_far, n_vertices]: [usize; 2], corners: &mut Vec<u32>) -> Result<(), ObjError> {
    corners.clear();
    for word in line.arguments() {
        let vertex = word.split(|byte| *byte == b'/').next().unwrap_or_default();
        let index: Option<i64> = std::str::from_utf8(vertex).ok().and_then(|word| word.parse().ok());
        let index = index.ok_or_else(|| ObjError::Face { line: line.number, found: found(&line.content) })?;
        let distance = usize::try_from(index.unsigned_abs()).ok();
        let absolute = match distance {
            Some(back) if index < 0 => n_so_far.checked_sub(back),
            Some(count) => count.checked_sub(1).filter(|corner| *corner < n_vertices),
            None => None,
        };
        let absolute = absolute.and_then(|corner| u32::try_from(corner).ok());
        corners.push(absolute.ok_or(ObjError::VertexOutOfRange { line: line.number, index, n_vertices })?);
    }
    if MAX_CORNERS < corners.len() {
        return Err(ObjError::Corners { line: line.number, n_corners: corners.len() });
    }
    match named_too_often(corners) {
        Some(vertex) => Err(ObjError::Repeated { line: line.number, vertex }),
        None => Ok(()),
    }
}

/// A corner, counted from 1, that a face names more than [`MAX_REPEATS`] times.
fn named_too_often(corners: &[u32]) -> Option<usize> {
    if corners.len() <= MAX_REPEATS {
        return None;
    }
    let mut sorted = corners.to_vec();
    sorted.sort_unstable();
    sorted.chunk_by(|a, b| a == b).find(|same| MAX_REPEATS < same.len()).map(|same| same[0] as usize + 1)
}

/// Part of a file's vertices, at its end, that may be without a face in a whole file.
const MAX_UNUSED_PART: f64 = 0.05;

/// How much of everything a file holds, so that room is made once.
#[derive(Default)]
struct Counts {
    n_lines: usize,
    n_vertices: usize,
    n_faces: usize,
    n_corners: usize,
    /// Lines, points, curves: vertices behind the last face may be theirs.
    n_others: usize,
}

impl Counts {
    fn of(text: &[u8]) -> Self {
        let mut counts = Self::default();
        for line in Lines::new(text) {
            counts.n_lines = line.number;
            match line.keyword() {
                b"v" => counts.n_vertices += 1,
                b"f" | b"fo" => {
                    counts.n_faces += 1;
                    counts.n_corners += line.arguments().count();
                }
                b"l" | b"p" | b"curv" | b"surf" => counts.n_others += 1,
                _ => {}
            }
        }
        counts
    }

    /// Whether a file that could be read is only the beginning of one: faces for many of its last vertices are missing, or
    /// for any of them where the last line does not end either (many good files lack the last line break, so that alone
    /// says nothing).
    fn is_cut_off(&self, text: &[u8], n_unused: usize) -> bool {
        #[allow(clippy::cast_precision_loss, reason = "a file has far fewer than 2^53 vertices")]
        let unused_part = n_unused as f64 / self.n_vertices as f64;
        let suspicious = if text.ends_with(b"\n") { MAX_UNUSED_PART < unused_part } else { 0 < n_unused };
        0 < self.n_faces && suspicious && self.n_others == 0
    }
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
        // A line that goes on is told by its first line's number.
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
    fn a_file_cut_anywhere_never_panics() {
        let text = format!("{SQUARE}vn 0 0 1\nf 1//1 2//1 3//1 4//1\nf 1 2 3\n");
        for end in 0..text.len() {
            let _ = read(&text.as_bytes()[..end]);
        }
    }
}
