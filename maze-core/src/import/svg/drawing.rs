//! SVG -> chains of straight strokes.

use super::SvgError;
use super::numbers::{self, Token, Tokens, Transform};
use quick_xml::Reader as XmlReader;
use quick_xml::events::{BytesStart, Event};
use std::collections::BTreeMap;

/// Most elements inside each other: a drawing has a handful, and each takes memory until it ends.
const MAX_DEPTH: usize = 1000;

/// Which element a stroke comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Source {
    Line,
    /// `path` and `rect`.
    Path,
    Polyline,
}

/// Points joined by straight strokes, after all transforms.
#[derive(Clone, Debug)]
pub(super) struct Chain {
    pub(super) source: Source,
    /// Chains of one colour have one number.
    pub(super) stroke: usize,
    pub(super) points: Vec<[f64; 2]>,
    /// Of the file, counted from 1.
    pub(super) line: usize,
}

/// What an element hands down to those inside it.
#[derive(Clone, Copy)]
struct Style {
    transform: Transform,
    stroke: usize,
    /// Whether areas are not filled, or filled like paper.
    is_pale: bool,
    /// Nothing in it is drawn.
    is_hidden: bool,
}

/// Numbers of the strokes that mean something.
const NO_STROKE_GIVEN: usize = 0;
const NONE: usize = 1;

/// Elements that draw nothing, or nothing that could be a wall.
const UNSEEN: [&str; 16] = [
    "title",
    "desc",
    "metadata",
    "defs",
    "style",
    "text",
    "symbol",
    "marker",
    "clipPath",
    "mask",
    "pattern",
    "script",
    "circle",
    "ellipse",
    "linearGradient",
    "radialGradient",
];

/// All strokes of a file, in its order.
pub(super) fn read(bytes: &[u8]) -> Result<Vec<Chain>, SvgError> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    if bytes.iter().all(u8::is_ascii_whitespace) {
        return Err(SvgError::Empty);
    }
    let line_at = |offset: usize| 1 + bytes[..offset].iter().filter(|byte| **byte == b'\n').count();
    let text = std::str::from_utf8(bytes)
        .map_err(|error| SvgError::NotText { line: line_at(error.valid_up_to()) })?;
    // The parser does not expand them; a drawing that needs them would be another one than it shows.
    if let Some(offset) = text.find("<!ENTITY") {
        return Err(SvgError::Entity { line: line_at(offset) });
    }
    let strokes = BTreeMap::from([(String::new(), NO_STROKE_GIVEN), ("none".to_owned(), NONE)]);
    let mut reader = Reader { chains: Vec::new(), strokes, line: 1 };
    let style =
        Style { transform: Transform::IDENTITY, stroke: NO_STROKE_GIVEN, is_pale: false, is_hidden: false };
    let mut xml = XmlReader::from_str(text);
    let mut open: Vec<Style> = Vec::new();
    let (mut has_root, mut offset) = (false, 0);
    loop {
        let event = xml.read_event();
        let not_xml = |line, reason: &str| SvgError::Xml { line, reason: reason.to_owned() };
        match event.map_err(|error| not_xml(reader.line, &error.to_string()))? {
            Event::Start(element) => {
                let inherited = open.last().copied().unwrap_or(style);
                open.push(reader.element(&element, inherited, std::mem::replace(&mut has_root, true))?);
                if MAX_DEPTH < open.len() {
                    return Err(not_xml(reader.line, "more than 1000 elements inside each other"));
                }
            }
            Event::Empty(element) => {
                let inherited = open.last().copied().unwrap_or(style);
                reader.element(&element, inherited, std::mem::replace(&mut has_root, true))?;
            }
            Event::End(_) => drop(open.pop()),
            Event::Text(words) if open.is_empty() && !words.iter().all(u8::is_ascii_whitespace) => {
                return Err(not_xml(reader.line, "text outside the root element"));
            }
            Event::Eof if !open.is_empty() => {
                return Err(not_xml(reader.line, "the file ends inside an element"));
            }
            Event::Eof => return Ok(reader.chains),
            _ => {}
        }
        let end = usize::try_from(xml.buffer_position()).unwrap_or(bytes.len());
        reader.line += bytes[offset..end].iter().filter(|byte| **byte == b'\n').count();
        offset = end;
    }
}

fn shortened(text: &str) -> String {
    text.chars().take(40).collect()
}

/// The attributes that matter, of one element.
#[derive(Default)]
struct Attributes {
    known: BTreeMap<&'static str, String>,
}

/// Their names.
const KNOWN: [&str; 16] = [
    "x1",
    "y1",
    "x2",
    "y2",
    "x",
    "y",
    "width",
    "height",
    "points",
    "d",
    "transform",
    "style",
    "stroke",
    "fill",
    "display",
    "visibility",
];

impl Attributes {
    fn get(&self, name: &str) -> Option<&str> {
        self.known.get(name).map(String::as_str)
    }

    /// A property: a declaration in `style` is stronger than an attribute of that name.
    fn property(&self, name: &str) -> Option<&str> {
        let declarations = self.get("style").unwrap_or_default().split(';');
        let values =
            declarations.filter_map(|one| one.split_once(':')).map(|(key, value)| (key.trim(), value.trim()));
        let declared = values.rev().find(|(key, _)| *key == name).map(|(_, value)| value);
        declared.or_else(|| self.get(name)).filter(|value| *value != "inherit")
    }
}

struct Reader {
    chains: Vec<Chain>,
    strokes: BTreeMap<String, usize>,
    /// Of the element being read.
    line: usize,
}

impl Reader {
    fn wrong(&self, element: &str, attribute: &'static str, found: &str, expected: &'static str) -> SvgError {
        let (element, found) = (shortened(element), shortened(found));
        SvgError::Attribute { line: self.line, element, attribute, found, expected }
    }

    fn attributes(&self, element: &BytesStart) -> Result<Attributes, SvgError> {
        let mut attributes = Attributes::default();
        // Without the parser's search for duplicates, which takes as long as the square of their number.
        for attribute in element.attributes().with_checks(false) {
            let attribute =
                attribute.map_err(|error| SvgError::Xml { line: self.line, reason: error.to_string() })?;
            if let Some(name) = KNOWN.iter().find(|name| name.as_bytes() == attribute.key.as_ref()) {
                // The whole file is UTF-8.
                attributes.known.insert(name, String::from_utf8_lossy(&attribute.value).into_owned());
            }
        }
        Ok(attributes)
    }

    /// Draws one element and says what those inside it inherit.
    fn element(&mut self, element: &BytesStart, inherited: Style, has_root: bool) -> Result<Style, SvgError> {
        let name = String::from_utf8_lossy(element.local_name().as_ref()).into_owned();
        if !has_root && name != "svg" {
            return Err(SvgError::NotSvg { line: self.line, found: shortened(&name) });
        }
        let mut style = inherited;
        if style.is_hidden || UNSEEN.contains(&&name[..]) {
            return Ok(Style { is_hidden: true, ..style });
        }
        let attributes = self.attributes(element)?;
        if let Some(list) = attributes.get("transform") {
            style.transform = inherited.transform.after_list(list).ok_or_else(|| {
                let expected = "translate(X, Y), scale(X, Y) or matrix(A, B, C, D, E, F)";
                self.wrong(&name, "transform", list, expected)
            })?;
        }
        if let Some(stroke) = attributes.property("stroke") {
            let next = self.strokes.len();
            style.stroke = match self.strokes.get(stroke) {
                Some(known) => *known,
                None => *self.strokes.entry(stroke.to_owned()).or_insert(next),
            };
        }
        if let Some(fill) = attributes.property("fill") {
            style.is_pale = ["none", "white", "#fff", "#ffffff"].contains(&&fill.to_ascii_lowercase()[..]);
        }
        style.is_hidden = attributes.property("display") == Some("none")
            || matches!(attributes.property("visibility"), Some("hidden" | "collapse"));
        if !style.is_hidden {
            self.draw(&name, &attributes, &style)?;
        }
        Ok(style)
    }

    fn draw(&mut self, name: &str, attributes: &Attributes, style: &Style) -> Result<(), SvgError> {
        let is_drawn = style.stroke != NONE;
        let number = |attribute: &'static str| {
            // What is not given is 0.
            let Some(text) = attributes.get(attribute) else { return Ok(0.0) };
            let number = numbers::length(text);
            number.ok_or_else(|| self.wrong(name, attribute, text, "a number of at most 1e12"))
        };
        match name {
            "line" if is_drawn => {
                let points = [[number("x1")?, number("y1")?], [number("x2")?, number("y2")?]];
                self.push(Source::Line, style, &points);
            }
            "polyline" if is_drawn => {
                let list = attributes.get("points").unwrap_or_default();
                let points = numbers::points(list);
                let points = points.ok_or_else(|| self.wrong(name, "points", list, "pairs of numbers"))?;
                self.push(Source::Polyline, style, &points);
            }
            "path" if is_drawn => self.path(attributes.get("d").unwrap_or_default(), style)?,
            "rect" if is_drawn && style.stroke != NO_STROKE_GIVEN => {
                let [x, y] = [number("x")?, number("y")?];
                let [right, bottom] = [x + number("width")?, y + number("height")?];
                self.push(Source::Path, style, &[[x, y], [right, y], [right, bottom], [x, bottom], [x, y]]);
            }
            // A background, as long as it comes before all walls.
            "rect" if self.chains.is_empty() || style.is_pale => {}
            "rect" | "polygon" | "use" | "image" | "foreignObject" => {
                return Err(SvgError::Element { line: self.line, element: name.to_owned() });
            }
            _ => {}
        }
        Ok(())
    }

    fn push(&mut self, source: Source, style: &Style, points: &[[f64; 2]]) {
        let points = points.iter().map(|point| style.transform.apply(*point)).collect();
        self.chains.push(Chain { source, stroke: style.stroke, points, line: self.line });
    }

    /// Moves, lines and closings; each move begins a chain.
    fn path(&mut self, data: &str, style: &Style) -> Result<(), SvgError> {
        const EXPECTED: &str = "path data such as M 2 2 L 18 2 or M 2 2 h 16";
        let wrong = || self.wrong("path", "d", data, EXPECTED);
        let mut tokens = Tokens(data).peekable();
        let (mut chains, mut points): (Vec<Vec<[f64; 2]>>, Vec<[f64; 2]>) = (Vec::new(), Vec::new());
        let (mut at, mut first) = ([0.0; 2], [0.0; 2]);
        let mut command = None;
        while let Some(token) = tokens.peek() {
            if let Token::Command(next) = *token {
                tokens.next();
                command = Some(next);
                if next.eq_ignore_ascii_case(&'z') {
                    points.push(first);
                    at = first;
                    continue;
                }
            }
            let name = command.ok_or_else(wrong)?;
            let mut number = || match tokens.next() {
                Some(Token::Number(number)) => Ok(number),
                _ => Err(wrong()),
            };
            let from = if name.is_ascii_lowercase() { at } else { [0.0; 2] };
            at = match name.to_ascii_lowercase() {
                'm' | 'l' => [from[0] + number()?, from[1] + number()?],
                'h' => [from[0] + number()?, at[1]],
                'v' => [at[0], from[1] + number()?],
                'a' => return Err(SvgError::Circular { line: self.line }),
                'c' | 's' | 'q' | 't' => return Err(SvgError::Curved { line: self.line }),
                _ => return Err(wrong()),
            };
            if name.eq_ignore_ascii_case(&'m') {
                chains.push(std::mem::take(&mut points));
                first = at;
                // Further pairs after a move are lines.
                command = Some(if name == 'm' { 'l' } else { 'L' });
            } else if points.is_empty() {
                points.push(first);
            }
            points.push(at);
        }
        chains.push(points);
        for points in chains.iter().filter(|points| 1 < points.len()) {
            self.push(Source::Path, style, points);
        }
        Ok(())
    }
}
