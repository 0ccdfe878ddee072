//! SVG -> what is painted: straight strokes, areas and dots, in the order of painting.

use super::SvgError;
use super::numbers::{self, Token, Tokens, Transform};
use super::style::{Named, PROPERTIES, Rgb, Sheets, Style};
use crate::physics::numbers::{greater, lesser};
use quick_xml::Reader as XmlReader;
use quick_xml::events::{BytesStart, Event};
use std::collections::BTreeMap;

/// Most elements inside each other: a drawing has a handful, and each takes memory until it ends.
const MAX_DEPTH: usize = 1000;

/// Most points of all shapes: a maze of 1000 x 1000 cells has some, and each takes 16 bytes.
const MAX_POINTS: usize = 1_500_000;

/// Most elements that copies (`use`) may draw, and how deep copies of copies go.
const MAX_COPIED: usize = 1 << 16;
const MAX_COPIES: usize = 8;

/// Colours nearer than this, in each channel, are one to the eye: nothing of the one is seen on the other.
const SAME_COLOUR: u8 = 24;

/// The largest of red, green and blue less the smallest from which on something has a colour.
const COLOURED: u8 = 80;

/// Fraction of its rectangle that the ground of a page fills.
const PAGE_FRACTION: f64 = 0.9;

/// Which element a stroke comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Source {
    Line,
    /// `path`, `rect` and `polygon`.
    Path,
    Polyline,
}

/// What an element draws, after all transforms.
#[derive(Clone, Debug)]
pub(super) enum Form {
    /// Points joined by straight strokes; several for a path of several moves.
    Straight(Vec<Vec<[f64; 2]>>),
    /// A circle, or whatever is inside that rectangle and not straight.
    Round([[f64; 2]; 2]),
}

/// One element as it is painted.
#[derive(Clone, Debug)]
pub(super) struct Shape {
    pub(super) source: Source,
    pub(super) form: Form,
    pub(super) stroke: Option<(Rgb, f64)>,
    pub(super) fill: Option<Rgb>,
    pub(super) is_even_odd: bool,
    /// Whether a stroke without a length is a dot.
    pub(super) has_caps: bool,
    /// Why a form that is not straight can be no wall.
    pub(super) curve: Option<fn(usize) -> SvgError>,
    /// Of the file, counted from 1.
    pub(super) line: usize,
}

impl Shape {
    /// The rectangle around it: low and high corner.
    pub(super) fn bounds(&self) -> Option<[[f64; 2]; 2]> {
        match &self.form {
            Form::Round(bounds) => Some(*bounds),
            Form::Straight(chains) => {
                let points = chains.iter().flatten();
                points.fold(None, |bounds: Option<[[f64; 2]; 2]>, point| {
                    let [low, high] = bounds.unwrap_or([*point; 2]);
                    Some([
                        [0, 1].map(|axis| lesser(low[axis], point[axis])),
                        [0, 1].map(|axis| greater(high[axis], point[axis])),
                    ])
                })
            }
        }
    }
}

/// Whether the eye takes two colours for one.
pub(super) fn is_same(one: Rgb, other: Rgb) -> bool {
    one.iter().zip(other).all(|(a, b)| a.abs_diff(b) <= SAME_COLOUR)
}

/// Whether something is neither black nor white nor grey.
pub(super) fn is_coloured([r, g, b]: Rgb) -> bool {
    COLOURED <= r.max(g).max(b) - r.min(g).min(b)
}

/// All that is painted.
#[derive(Clone, Debug)]
pub(super) struct Drawing {
    pub(super) shapes: Vec<Shape>,
    /// The ground: white, or the colour of what is painted first and under everything.
    pub(super) paper: Rgb,
}

/// Points joined by straight strokes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chain<'a> {
    pub(super) source: Source,
    /// Chains of one colour have one number.
    pub(super) stroke: usize,
    /// Whether that is a colour: marks and solutions are where walls are grey.
    pub(super) is_coloured: bool,
    pub(super) points: &'a [[f64; 2]],
    /// Of the file, counted from 1.
    pub(super) line: usize,
}

impl Drawing {
    fn new(mut shapes: Vec<Shape>) -> Self {
        let bounds = |shapes: &[Shape]| {
            shapes.iter().filter_map(Shape::bounds).reduce(|[low, high], [a, b]| {
                let low = [0, 1].map(|axis| lesser(low[axis], a[axis]));
                [low, [0, 1].map(|axis| greater(high[axis], b[axis]))]
            })
        };
        let mut paper = [255; 3];
        // Under everything: the first areas that reach around all that comes after them.
        while let Some(first) = shapes.first() {
            let (Some(fill), Some([low, high])) = (first.fill, first.bounds()) else { break };
            let covers = bounds(&shapes[1..])
                .is_none_or(|[a, b]| (0..2).all(|axis| low[axis] <= a[axis] && b[axis] <= high[axis]));
            let fills = area(first) >= PAGE_FRACTION * (high[0] - low[0]) * (high[1] - low[1]);
            // Light areas on a dark one are corridors in a solid block, light strokes are walls on dark paper.
            let is_block = is_dark(fill) && shapes[1..].iter().all(|shape| shape.stroke.is_none());
            if !covers || !fills || is_block || first.stroke.is_some() || shapes.len() == 1 {
                break;
            }
            paper = fill;
            shapes.remove(0);
        }
        Self { shapes, paper }
    }

    /// Whether a colour is seen on the paper.
    pub(super) fn is_seen(&self, colour: Rgb) -> bool {
        !is_same(colour, self.paper)
    }

    /// The strokes that are seen, curves aside.
    ///
    /// # Errors
    /// A curved stroke that is no mark in a colour.
    pub(super) fn chains(&self) -> Result<Vec<Chain<'_>>, SvgError> {
        let mut colours: Vec<Rgb> = Vec::new();
        let mut chains = Vec::new();
        for shape in &self.shapes {
            let Some((colour, _)) = shape.stroke.filter(|(colour, _)| self.is_seen(*colour)) else {
                continue;
            };
            let stroke = colours.iter().position(|known| *known == colour).unwrap_or_else(|| {
                colours.push(colour);
                colours.len() - 1
            });
            match (&shape.form, shape.curve) {
                (Form::Straight(parts), _) => {
                    let is_seen = |points: &&Vec<[f64; 2]>| {
                        shape.has_caps || points.iter().any(|point| *point != points[0])
                    };
                    chains.extend(parts.iter().filter(is_seen).map(|points| Chain {
                        source: shape.source,
                        stroke,
                        is_coloured: is_coloured(colour),
                        points,
                        line: shape.line,
                    }));
                }
                (Form::Round(_), Some(error)) if !is_coloured(colour) => return Err(error(shape.line)),
                (Form::Round(_), _) => {}
            }
        }
        Ok(chains)
    }

    /// Whether areas are painted that can be walls: seen, without a colour where strokes have none either.
    pub(super) fn has_areas(&self) -> bool {
        let is_wall = |shape: &&Shape| {
            let encloses = match &shape.form {
                Form::Straight(chains) => chains.iter().any(|points| has_area(points)),
                Form::Round(_) => false,
            };
            encloses && shape.fill.is_some_and(|fill| self.is_seen(fill) && !is_coloured(fill))
        };
        self.shapes.iter().any(|shape| is_wall(&shape))
    }
}

/// What a shape encloses, seen as one ring after another.
fn area(shape: &Shape) -> f64 {
    let Form::Straight(chains) = &shape.form else { return 0.0 };
    let of_ring = |points: &Vec<[f64; 2]>| {
        let next = points.iter().cycle().skip(1);
        points.iter().zip(next).map(|(a, b)| a[0] * b[1] - b[0] * a[1]).sum::<f64>() / 2.0
    };
    chains.iter().map(of_ring).sum::<f64>().abs()
}

fn is_dark([r, g, b]: Rgb) -> bool {
    299 * u32::from(r) + 587 * u32::from(g) + 114 * u32::from(b) < 128 * 1000
}

/// Whether points go around something.
pub(super) fn has_area(points: &[[f64; 2]]) -> bool {
    let Some(first) = points.first() else { return false };
    let differs = |axis: usize| points.iter().any(|point| point[axis] != first[axis]);
    2 < points.len() && differs(0) && differs(1)
}

/// Elements that draw nothing by themselves, or nothing that could be a wall.
const UNSEEN: [&str; 15] = [
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
    "linearGradient",
    "radialGradient",
    "filter",
];

/// All that a file paints.
///
/// # Errors
/// What is no SVG, with the line, and more than a drawing has.
pub(super) fn read(bytes: &[u8]) -> Result<Drawing, SvgError> {
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
    let (css, css_line) = style_sheets(text)?;
    let ids = if text.contains("<use") || text.contains(":use") { ids(text) } else { BTreeMap::new() };
    let mut reader = Reader {
        text,
        ids,
        sheets: Sheets::new(&css, css_line)?,
        shapes: Vec::new(),
        n_points: 0,
        n_copied: 0,
        line: 1,
        page: None,
    };
    reader.document()?;
    Ok(Drawing::new(reader.shapes))
}

/// The text of all `style` elements, and the line of the first one.
fn style_sheets(text: &str) -> Result<(String, usize), SvgError> {
    let (mut css, mut first, mut rest) = (String::new(), 1, text);
    while let Some(start) = rest.find("<style") {
        let line = 1 + text[..text.len() - rest.len() + start].matches('\n').count();
        first = if css.is_empty() { line } else { first };
        let Some((head, tail)) = rest[start..].split_once('>') else { break };
        if head.ends_with('/') {
            rest = tail;
            continue;
        }
        let (body, tail) = tail.split_once("</style").unwrap_or((tail, ""));
        css += body.trim().trim_start_matches("<![CDATA[").trim_end_matches("]]>");
        css.push('\n');
        rest = tail;
    }
    Ok((css, first))
}

/// Where elements with an id begin, for copies.
fn ids(text: &str) -> BTreeMap<&str, usize> {
    let mut ids = BTreeMap::new();
    let (mut rest, mut tag) = (text, 0);
    while let Some(start) = rest.find(['<', ' ', '\n', '\t']) {
        let at = text.len() - rest.len() + start;
        if text.as_bytes()[at] == b'<' {
            tag = at;
        } else if let Some(value) = text[at + 1..].strip_prefix("id=")
            && let Some(quote) = value.chars().next().filter(|quote| matches!(quote, '"' | '\''))
            && let Some((id, _)) = value[1..].split_once(quote)
        {
            ids.entry(id).or_insert(tag);
        }
        rest = &text[at + 1..];
    }
    ids
}

fn shortened(text: &str) -> String {
    text.chars().take(40).collect()
}

/// The attributes that matter, of one element.
#[derive(Default)]
struct Attributes {
    known: BTreeMap<&'static str, String>,
}

/// Their names, but for those that decide about paint.
const GEOMETRY: [&str; 19] = [
    "x1",
    "y1",
    "x2",
    "y2",
    "x",
    "y",
    "cx",
    "cy",
    "r",
    "rx",
    "ry",
    "width",
    "height",
    "points",
    "d",
    "transform",
    "style",
    "viewBox",
    "href",
];

impl Attributes {
    fn get(&self, name: &str) -> Option<&str> {
        self.known.get(name).map(String::as_str)
    }
}

struct Reader<'a> {
    text: &'a str,
    ids: BTreeMap<&'a str, usize>,
    sheets: Sheets<'a>,
    shapes: Vec<Shape>,
    n_points: usize,
    n_copied: usize,
    /// Of the element being read.
    line: usize,
    /// Width and height that percentages are of.
    page: Option<[f64; 2]>,
}

impl<'a> Reader<'a> {
    fn document(&mut self) -> Result<(), SvgError> {
        self.elements(0, &Style::initial(), 0)
    }

    fn not_xml(&self, reason: impl Into<String>) -> SvgError {
        SvgError::Xml { line: self.line, reason: reason.into() }
    }

    /// Reads elements from an offset on: the whole file, or for a copy the one element that begins there.
    fn elements(&mut self, from: usize, style: &Style, n_copies: usize) -> Result<(), SvgError> {
        let text = &self.text[from..];
        let is_copy = 0 < n_copies;
        let mut xml = XmlReader::from_str(text);
        // A copy ends where its element does, in the middle of the file.
        xml.config_mut().check_end_names = !is_copy;
        let mut open: Vec<Style> = Vec::new();
        let mut named: Vec<Named> = Vec::new();
        let (mut has_root, mut offset) = (is_copy, 0);
        loop {
            let event = xml.read_event();
            match event.map_err(|error| self.not_xml(error.to_string()))? {
                Event::Start(element) => {
                    let around = open.last().unwrap_or(style);
                    named.push(self.named(&element)?);
                    let is_copied = is_copy && open.is_empty();
                    let next = self.element(&element, &named, around, has_root, is_copied, n_copies)?;
                    has_root = true;
                    open.push(next);
                    if MAX_DEPTH < open.len() {
                        return Err(self.not_xml("more than 1000 elements inside each other"));
                    }
                }
                Event::Empty(element) => {
                    let around = open.last().unwrap_or(style);
                    named.push(self.named(&element)?);
                    let is_copied = is_copy && open.is_empty();
                    self.element(&element, &named, around, has_root, is_copied, n_copies)?;
                    has_root = true;
                    named.pop();
                    if is_copied {
                        return Ok(());
                    }
                }
                Event::End(_) => {
                    named.pop();
                    if open.pop().is_none() || (is_copy && open.is_empty()) {
                        return Ok(());
                    }
                }
                Event::Text(words) if open.is_empty() && !words.iter().all(u8::is_ascii_whitespace) => {
                    return Err(self.not_xml("text outside the root element"));
                }
                Event::Eof if !open.is_empty() => {
                    return Err(self.not_xml("the file ends inside an element"));
                }
                Event::Eof => return Ok(()),
                _ => {}
            }
            if !is_copy {
                let end = usize::try_from(xml.buffer_position()).unwrap_or(text.len());
                self.line += text.as_bytes()[offset..end].iter().filter(|byte| **byte == b'\n').count();
                offset = end;
            }
        }
    }

    fn wrong(&self, element: &str, attribute: &'static str, found: &str, expected: &'static str) -> SvgError {
        let (element, found) = (shortened(element), shortened(found));
        SvgError::Attribute { line: self.line, element, attribute, found, expected }
    }

    /// Name, id and class of an element.
    fn named(&self, element: &BytesStart) -> Result<Named, SvgError> {
        let mut named = Named {
            name: String::from_utf8_lossy(element.local_name().as_ref()).into_owned(),
            ..Named::default()
        };
        for attribute in element.attributes().with_checks(false) {
            let attribute = attribute.map_err(|error| self.not_xml(error.to_string()))?;
            let value = || Some(String::from_utf8_lossy(&attribute.value).into_owned());
            match attribute.key.as_ref() {
                b"id" => named.id = value(),
                b"class" => named.class = value(),
                _ => {}
            }
        }
        Ok(named)
    }

    fn attributes(&self, element: &BytesStart) -> Result<Attributes, SvgError> {
        let mut attributes = Attributes::default();
        // Without the parser's search for duplicates, which takes as long as the square of their number.
        for attribute in element.attributes().with_checks(false) {
            let attribute = attribute.map_err(|error| self.not_xml(error.to_string()))?;
            let key = attribute.key.as_ref();
            let key = if key == b"xlink:href" { b"href" } else { key };
            if let Some(name) = GEOMETRY.iter().chain(&PROPERTIES).find(|name| name.as_bytes() == key) {
                // The whole file is UTF-8.
                attributes.known.insert(name, String::from_utf8_lossy(&attribute.value).into_owned());
            }
        }
        Ok(attributes)
    }

    /// Draws one element and says what those inside it inherit.
    fn element(
        &mut self,
        element: &BytesStart,
        nested: &[Named],
        inherited: &Style,
        has_root: bool,
        is_copied: bool,
        n_copies: usize,
    ) -> Result<Style, SvgError> {
        let name = nested.last().map_or("", |named| named.name.as_str());
        if !has_root && name != "svg" {
            return Err(SvgError::NotSvg { line: self.line, found: shortened(name) });
        }
        // A symbol is drawn as a copy.
        let is_unseen = UNSEEN.contains(&name) && !(is_copied && name == "symbol");
        if inherited.is_gone || is_unseen {
            let mut gone = inherited.clone();
            gone.is_gone = true;
            return Ok(gone);
        }
        if 0 < n_copies {
            self.n_copied += 1;
            if MAX_COPIED < self.n_copied {
                return Err(SvgError::TooMuch { line: self.line, what: "copied elements", most: MAX_COPIED });
            }
        }
        let attributes = self.attributes(element)?;
        if self.page.is_none() {
            self.page = Some(page(&attributes));
        }
        let attribute = |name: &str| attributes.get(name).map(str::to_owned);
        let mut style = inherited.of_child(attribute, nested, &mut self.sheets, self.line)?;
        if let Some(list) = attributes.get("transform").filter(|list| !list.trim().is_empty()) {
            style.transform = inherited.transform.after_list(list).ok_or_else(|| {
                let expected = "translate(X, Y), scale(X, Y), rotate(A) or matrix(A, B, C, D, E, F)";
                self.wrong(name, "transform", list, expected)
            })?;
        }
        if !style.is_gone {
            self.draw(name, &attributes, &style, n_copies)?;
        }
        Ok(style)
    }

    fn draw(
        &mut self,
        name: &str,
        attributes: &Attributes,
        style: &Style,
        n_copies: usize,
    ) -> Result<(), SvgError> {
        let page = self.page.unwrap_or_default();
        let number = |attribute: &'static str| {
            // What is not given is 0.
            let Some(text) = attributes.get(attribute) else { return Ok(0.0) };
            let percent = text.trim().strip_suffix('%').and_then(numbers::length);
            let of = if matches!(attribute, "y" | "y1" | "y2" | "cy" | "ry" | "height") {
                page[1]
            } else {
                page[0]
            };
            let number = percent.map(|percent| percent / 100.0 * of).or_else(|| numbers::length(text));
            number.ok_or_else(|| self.wrong(name, attribute, text, "a number of at most 1e12"))
        };
        match name {
            "line" => {
                let points = vec![[number("x1")?, number("y1")?], [number("x2")?, number("y2")?]];
                self.push(Source::Line, style, vec![points])
            }
            "polyline" | "polygon" => {
                let list = attributes.get("points").unwrap_or_default();
                let points = numbers::points(list, MAX_POINTS - self.n_points);
                let mut points =
                    points.ok_or_else(|| self.wrong(name, "points", list, "pairs of numbers"))?;
                let is_closed = name == "polygon";
                points.extend(points.first().copied().filter(|_| is_closed));
                let source = if is_closed { Source::Path } else { Source::Polyline };
                self.push(source, style, vec![points])
            }
            "path" => self.path(attributes.get("d").unwrap_or_default(), style),
            "rect" => {
                let [x, y] = [number("x")?, number("y")?];
                let [right, bottom] = [x + number("width")?, y + number("height")?];
                if right <= x || bottom <= y {
                    return Ok(());
                }
                let around = vec![[x, y], [right, y], [right, bottom], [x, bottom], [x, y]];
                self.push(Source::Path, style, vec![around])
            }
            "circle" | "ellipse" => {
                let middle = [number("cx")?, number("cy")?];
                let radius = number("r")?;
                let radii = if name == "circle" { [radius; 2] } else { [number("rx")?, number("ry")?] };
                let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
                let around: Vec<[f64; 2]> = corners
                    .map(|corner| [0, 1].map(|axis| middle[axis] + corner[axis] * radii[axis]))
                    .to_vec();
                self.push_round(style, &around, None);
                Ok(())
            }
            "use" => self.copy(attributes, style, [number("x")?, number("y")?], n_copies),
            "image" | "foreignObject" => Err(SvgError::Element { line: self.line, element: name.to_owned() }),
            _ => Ok(()),
        }
    }

    /// Draws an element again.
    fn copy(
        &mut self,
        attributes: &Attributes,
        style: &Style,
        [x, y]: [f64; 2],
        n_copies: usize,
    ) -> Result<(), SvgError> {
        let href = attributes.get("href").unwrap_or_default();
        let at = href.strip_prefix('#').and_then(|id| self.ids.get(id).copied());
        let at =
            at.ok_or_else(|| self.wrong("use", "href", href, "the # and id of an element of this file"))?;
        if MAX_COPIES <= n_copies {
            return Err(SvgError::TooMuch { line: self.line, what: "copies in copies", most: MAX_COPIES });
        }
        let mut moved = style.clone();
        moved.transform = style.transform.after(&Transform::moved([x, y]));
        self.elements(at, &moved, n_copies + 1)
    }

    fn count(&mut self, n_points: usize) -> Result<(), SvgError> {
        self.n_points += n_points;
        if MAX_POINTS < self.n_points {
            return Err(SvgError::TooMuch { line: self.line, what: "points", most: MAX_POINTS });
        }
        Ok(())
    }

    fn push(&mut self, source: Source, style: &Style, mut parts: Vec<Vec<[f64; 2]>>) -> Result<(), SvgError> {
        self.count(parts.iter().map(Vec::len).sum())?;
        let (stroke, fill) = (style.stroke(), style.fill());
        if stroke.is_none() && fill.is_none() {
            return Ok(());
        }
        parts.iter_mut().flatten().for_each(|point| *point = style.transform.apply(*point));
        self.shapes.push(Shape {
            source,
            form: Form::Straight(parts),
            stroke,
            fill,
            is_even_odd: style.is_even_odd,
            has_caps: style.has_caps,
            curve: None,
            line: self.line,
        });
        Ok(())
    }

    /// A form that is not straight, within these points.
    fn push_round(&mut self, style: &Style, points: &[[f64; 2]], curve: Option<fn(usize) -> SvgError>) {
        let (stroke, fill) = (style.stroke(), style.fill());
        if stroke.is_none() && fill.is_none() {
            return;
        }
        let points = points.iter().map(|point| style.transform.apply(*point)).collect();
        let mut shape = Shape {
            source: Source::Path,
            form: Form::Straight(vec![points]),
            stroke,
            fill,
            is_even_odd: false,
            has_caps: false,
            curve,
            line: self.line,
        };
        if let Some(bounds) = shape.bounds() {
            shape.form = Form::Round(bounds);
            self.shapes.push(shape);
        }
    }

    /// Moves, lines and closings; each move begins a chain.
    fn path(&mut self, data: &str, style: &Style) -> Result<(), SvgError> {
        const EXPECTED: &str = "path data such as M 2 2 L 18 2 or M 2 2 h 16";
        let wrong = |line| {
            let (element, found) = ("path".to_owned(), shortened(data));
            SvgError::Attribute { line, element, attribute: "d", found, expected: EXPECTED }
        };
        let line = self.line;
        let mut tokens = Tokens(data).peekable();
        let (mut chains, mut points): (Vec<Vec<[f64; 2]>>, Vec<[f64; 2]>) = (Vec::new(), Vec::new());
        let (mut at, mut first) = ([0.0; 2], [0.0; 2]);
        let mut command = None;
        let mut curve: Option<fn(usize) -> SvgError> = None;
        let mut n_points = 0;
        while let Some(token) = tokens.peek() {
            if let Token::Command(next) = *token {
                tokens.next();
                command = Some(next);
                if next.eq_ignore_ascii_case(&'z') {
                    if points.last().is_some_and(|last| *last != first) {
                        points.push(first);
                    }
                    at = first;
                    continue;
                }
            }
            let name = command.ok_or_else(|| wrong(line))?;
            let mut number = || match tokens.next() {
                Some(Token::Number(number)) => Ok(number),
                _ => Err(wrong(line)),
            };
            let from = if name.is_ascii_lowercase() { at } else { [0.0; 2] };
            let kind = name.to_ascii_lowercase();
            let n_skipped = match kind {
                'a' => 5,
                'c' => 4,
                's' | 'q' => 2,
                _ => 0,
            };
            if n_skipped != 0 || kind == 't' {
                curve = curve.or(Some(match kind {
                    'a' => |line| SvgError::Circular { line },
                    _ => |line| SvgError::Curved { line },
                }));
                for _ in 0..n_skipped {
                    number()?;
                }
            }
            at = match kind {
                'm' | 'l' | 'a' | 'c' | 's' | 'q' | 't' => [from[0] + number()?, from[1] + number()?],
                'h' => [from[0] + number()?, at[1]],
                'v' => [at[0], from[1] + number()?],
                _ => return Err(wrong(line)),
            };
            if kind == 'm' {
                chains.push(std::mem::take(&mut points));
                first = at;
                // Further pairs after a move are lines.
                command = Some(if name == 'm' { 'l' } else { 'L' });
            } else if points.is_empty() {
                points.push(first);
            }
            points.push(at);
            n_points += 1;
            if MAX_POINTS < self.n_points + n_points {
                return self.count(n_points);
            }
        }
        chains.push(points);
        chains.retain(|points| 1 < points.len());
        if curve.is_some() {
            let points: Vec<[f64; 2]> = chains.into_iter().flatten().collect();
            self.push_round(style, &points, curve);
            return self.count(points.len());
        }
        if chains.is_empty() { Ok(()) } else { self.push(Source::Path, style, chains) }
    }
}

/// Width and height of the drawing in its own units.
fn page(root: &Attributes) -> [f64; 2] {
    let view = root.get("viewBox").and_then(|view| numbers::points(view, 4));
    let given = ["width", "height"].map(|name| root.get(name).and_then(numbers::length).unwrap_or(0.0));
    match view.as_deref() {
        Some([_, size]) => *size,
        _ => given,
    }
}
