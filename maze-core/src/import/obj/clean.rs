//! The lines of an OBJ that make the maze and nothing else, checked: `v X Y Z` and `f A B C ...`, vertices first.

use super::{MAX_CORNERS, MAX_REPEATS, ObjError};
use std::borrow::Cow;
use std::io::{self, Cursor, Read, Write};

/// A line, joined with those that continue it.
pub(super) struct Line<'a> {
    number: usize, // counted from 1
    pub(super) content: Cow<'a, [u8]>,
}

/// The words of a line up to a comment. A `#` within a word begins none: some programs write infinity as `1.#INF`.
fn words(content: &[u8]) -> impl Iterator<Item = &[u8]> {
    let words = content.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
    words.take_while(|word| !word.starts_with(b"#"))
}

/// A line for a message: shortened, and in whatever encoding.
pub(super) fn found(content: &[u8]) -> String {
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
pub(super) struct Lines<'a> {
    rest: &'a [u8],
    line_end: u8,
    number: usize,
}

impl<'a> Lines<'a> {
    pub(super) fn new(text: &'a [u8]) -> Self {
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

/// A vertex or face that continues in the next line, without the backslash that marks it. Comments do not: some end with the
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

/// Three finite numbers; a weight or colours after them are left out.
fn vertex(line: &Line) -> Result<Vec<u8>, ObjError> {
    let mut cleaned = b"v".to_vec();
    let mut numbers = line.arguments();
    for _ in 0..3 {
        let is_finite = |word: &&str| word.parse().is_ok_and(f64::is_finite);
        let number = numbers.next().and_then(|word| std::str::from_utf8(word).ok()).filter(is_finite);
        let number =
            number.ok_or_else(|| ObjError::Vertex { line: line.number, found: found(&line.content) })?;
        cleaned.push(b' ');
        cleaned.extend_from_slice(number.as_bytes());
    }
    cleaned.push(b'\n');
    Ok(cleaned)
}

/// Every vertex of a file.
pub(super) fn vertices(text: &[u8]) -> impl Iterator<Item = Result<Vec<u8>, ObjError>> {
    Lines::new(text).filter(|line| line.keyword() == b"v").map(|line| vertex(&line))
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

/// Faces and their corners that the reader gets as one object. It needs up to 160 bytes for each until the object ends, far
/// more than the two characters that a face or a corner may be in a file; so this is 20 MB, whatever the file.
const MAX_PENDING: usize = 1 << 17;

/// Every face of a file; a fault at the end where the file is cut off.
pub(super) struct Faces<'a> {
    lines: Lines<'a>,
    counts: &'a Counts,
    n_vertices: usize, // so far
    n_used: usize,     // vertices up to the last one that a face names
    n_pending: usize,  // at most MAX_PENDING
    corners: Vec<u32>, // of the last face
}

impl<'a> Faces<'a> {
    pub(super) fn new(text: &'a [u8], counts: &'a Counts) -> Self {
        let lines = Lines::new(text);
        Self { lines, counts, n_vertices: 0, n_used: 0, n_pending: 0, corners: Vec::new() }
    }

    fn cleaned(&mut self, line: &Line) -> Result<Vec<u8>, ObjError> {
        face(line, [self.n_vertices, self.counts.n_vertices], &mut self.corners)?;
        if self.corners.len() < 3 && line.number == self.counts.n_lines && !self.counts.ends_with_line_break {
            return Err(ObjError::CutOff { line: line.number });
        }
        let mut cleaned = Vec::new();
        self.n_pending += 1 + self.corners.len();
        if MAX_PENDING < self.n_pending {
            self.n_pending = 1 + self.corners.len();
            cleaned.extend_from_slice(b"o\n");
        }
        cleaned.push(b'f');
        for corner in &self.corners {
            let count = *corner as usize + 1;
            self.n_used = self.n_used.max(count);
            // Writing to a Vec cannot fail.
            let _ = write!(cleaned, " {count}");
        }
        cleaned.push(b'\n');
        Ok(cleaned)
    }
}

impl Iterator for Faces<'_> {
    type Item = Result<Vec<u8>, ObjError>;

    fn next(&mut self) -> Option<Self::Item> {
        while let Some(line) = self.lines.next() {
            match line.keyword() {
                b"v" => self.n_vertices += 1,
                b"f" | b"fo" => return Some(self.cleaned(&line)),
                _ => {}
            }
        }
        let is_cut_off = self.counts.is_cut_off(self.counts.n_vertices - self.n_used);
        is_cut_off.then_some(Err(ObjError::CutOff { line: self.counts.n_lines }))
    }
}

/// Lines as tobj takes them. It would not pass a fault on, so the first one is kept here.
pub(super) struct LineReader<I> {
    lines: I,
    line: Cursor<Vec<u8>>,
    pub(super) fault: Option<ObjError>,
}

impl<I> LineReader<I> {
    pub(super) fn new(lines: I) -> Self {
        Self { lines, line: Cursor::default(), fault: None }
    }
}

impl<I: Iterator<Item = Result<Vec<u8>, ObjError>>> Read for LineReader<I> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        loop {
            let n_bytes = self.line.read(buffer)?;
            if 0 < n_bytes || buffer.is_empty() {
                return Ok(n_bytes);
            }
            match self.lines.next() {
                Some(Ok(line)) => self.line = Cursor::new(line),
                Some(Err(fault)) => {
                    self.fault = Some(fault);
                    return Err(io::ErrorKind::InvalidData.into());
                }
                None => return Ok(0),
            }
        }
    }
}

/// Fraction of a file's vertices, at its end, that may be without a face in a whole file.
const MAX_UNUSED_FRACTION: f64 = 0.05;

/// How much of everything a file holds.
#[derive(Default)]
pub(super) struct Counts {
    pub(super) n_lines: usize,
    pub(super) n_vertices: usize,
    pub(super) n_faces: usize,
    pub(super) n_corners: usize,
    ends_with_line_break: bool,
    /// Lines, points, curves: vertices behind the last face may be theirs.
    n_others: usize,
}

impl Counts {
    pub(super) fn of(text: &[u8]) -> Self {
        let mut counts = Self { ends_with_line_break: text.ends_with(b"\n"), ..Self::default() };
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
    fn is_cut_off(&self, n_unused: usize) -> bool {
        #[allow(clippy::cast_precision_loss, reason = "a file has far fewer than 2^53 vertices")]
        let unused_part = n_unused as f64 / self.n_vertices as f64;
        let suspicious =
            if self.ends_with_line_break { MAX_UNUSED_FRACTION < unused_part } else { 0 < n_unused };
        0 < self.n_faces && suspicious && self.n_others == 0
    }
}
