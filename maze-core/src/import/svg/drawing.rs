//! SVG -> chains of straight strokes.

use super::SvgError;
use super::numbers::{self, Token, Tokens, Transform};
use roxmltree::{Document, Node, ParsingOptions};
use std::collections::BTreeMap;

/// Most elements and texts of a file: a maze of 1024 x 1024 cells has fewer walls in this form.
const MAX_NODES: u32 = 1 << 21;

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
struct Style<'a> {
    transform: Transform,
    stroke: &'a str,
    fill: &'a str,
    hidden: bool,
}

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
    if bytes.iter().all(u8::is_ascii_whitespace) {
        return Err(SvgError::Empty);
    }
    let line_at = |offset: usize| 1 + bytes[..offset].iter().filter(|byte| **byte == b'\n').count();
    let text = std::str::from_utf8(bytes)
        .map_err(|error| SvgError::NotText { line: line_at(error.valid_up_to()) })?;
    // Never expanded, so that no few bytes become many; a drawing has no use for them.
    if let Some(offset) = text.find("<!ENTITY") {
        return Err(SvgError::Entity { line: line_at(offset) });
    }
    let options = ParsingOptions { allow_dtd: true, nodes_limit: MAX_NODES, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options).map_err(|error| {
        let line = usize::try_from(error.pos().row).unwrap_or(0);
        SvgError::Xml { line, reason: error.to_string() }
    })?;
    let root = document.root_element();
    if root.tag_name().name() != "svg" {
        let found = shortened(root.tag_name().name());
        return Err(SvgError::NotSvg { line: line_at(root.range().start), found });
    }
    let lines = Lines { bytes, offset: 0, line: 1 };
    let mut reader = Reader { chains: Vec::new(), strokes: BTreeMap::new(), lines };
    let style = Style { transform: Transform::IDENTITY, stroke: "", fill: "", hidden: false };
    // Not recursive: a file may be nested deeper than the stack.
    let mut open = vec![(root, style)];
    while let Some((node, inherited)) = open.pop() {
        let name = node.tag_name().name();
        if UNSEEN.contains(&name) {
            continue;
        }
        reader.lines.advance(node.range().start);
        let style = reader.style(&node, inherited)?;
        if style.hidden {
            continue;
        }
        reader.element(&node, &style)?;
        open.extend(node.children().filter(Node::is_element).rev().map(|child| (child, style)));
    }
    Ok(reader.chains)
}

fn shortened(text: &str) -> String {
    text.chars().take(40).collect()
}

/// Counts lines as the offset moves on.
struct Lines<'a> {
    bytes: &'a [u8],
    offset: usize,
    line: usize,
}

impl Lines<'_> {
    fn advance(&mut self, offset: usize) {
        let passed = self.bytes.get(self.offset..offset).unwrap_or_default();
        self.line += passed.iter().filter(|byte| **byte == b'\n').count();
        self.offset = offset;
    }
}

struct Reader<'a> {
    chains: Vec<Chain>,
    strokes: BTreeMap<&'a str, usize>,
    lines: Lines<'a>,
}

impl<'a> Reader<'a> {
    fn wrong(&self, node: &Node, attribute: &'static str, found: &str, expected: &'static str) -> SvgError {
        SvgError::Attribute {
            line: self.lines.line,
            element: shortened(node.tag_name().name()),
            attribute,
            found: shortened(found),
            expected,
        }
    }

    fn style(&self, node: &Node<'a, '_>, inherited: Style<'a>) -> Result<Style<'a>, SvgError> {
        let mut style = inherited;
        if let Some(list) = node.attribute("transform") {
            style.transform = inherited.transform.after_list(list).ok_or_else(|| {
                self.wrong(
                    node,
                    "transform",
                    list,
                    "translate(X, Y), scale(X, Y) or matrix(A, B, C, D, E, F)",
                )
            })?;
        }
        // A declaration in `style` is stronger than an attribute of that name.
        let declared = |name: &str| {
            let declarations = node.attribute("style").unwrap_or_default().split(';');
            let values = declarations
                .filter_map(|one| one.split_once(':'))
                .map(|(key, value)| (key.trim(), value.trim()));
            values.filter(|(key, _)| *key == name).last().map(|(_, value)| value)
        };
        let value = |name: &'static str| declared(name).or_else(|| node.attribute(name));
        style.stroke = value("stroke").filter(|value| *value != "inherit").unwrap_or(style.stroke);
        style.fill = value("fill").filter(|value| *value != "inherit").unwrap_or(style.fill);
        style.hidden |= value("display") == Some("none") || value("visibility") == Some("hidden");
        Ok(style)
    }

    fn element(&mut self, node: &Node, style: &Style<'a>) -> Result<(), SvgError> {
        let name = node.tag_name().name();
        let is_drawn = style.stroke != "none";
        match name {
            "line" if is_drawn => {
                let ends = [["x1", "y1"], ["x2", "y2"]];
                let mut points = Vec::with_capacity(2);
                for [x, y] in ends {
                    points.push([self.number(node, x)?, self.number(node, y)?]);
                }
                self.push(Source::Line, style, &points);
            }
            "polyline" if is_drawn => {
                let list = node.attribute("points").unwrap_or_default();
                let points = numbers::points(list);
                let points = points.ok_or_else(|| self.wrong(node, "points", list, "pairs of numbers"))?;
                self.push(Source::Polyline, style, &points);
            }
            "path" if is_drawn => self.path(node, style)?,
            "rect" if is_drawn && !style.stroke.is_empty() => {
                let [x, y, width, height] = ["x", "y", "width", "height"];
                let [x, y] = [self.number(node, x)?, self.number(node, y)?];
                let [right, bottom] = [x + self.number(node, width)?, y + self.number(node, height)?];
                self.push(Source::Path, style, &[[x, y], [right, y], [right, bottom], [x, bottom], [x, y]]);
            }
            // A background, as long as it comes before all walls.
            "rect"
                if self.chains.is_empty() || matches!(style.fill, "none" | "white" | "#fff" | "#ffffff") => {}
            "rect" | "polygon" | "use" | "image" | "foreignObject" => {
                return Err(SvgError::Element { line: self.lines.line, element: name.to_owned() });
            }
            _ => {}
        }
        Ok(())
    }

    /// A coordinate; 0 where it is not given.
    fn number(&self, node: &Node, attribute: &'static str) -> Result<f64, SvgError> {
        let Some(text) = node.attribute(attribute) else { return Ok(0.0) };
        numbers::length(text).ok_or_else(|| self.wrong(node, attribute, text, "a number of at most 1e12"))
    }

    fn push(&mut self, source: Source, style: &Style<'a>, points: &[[f64; 2]]) {
        let points = points.iter().map(|point| style.transform.apply(*point)).collect();
        let next = self.strokes.len();
        let stroke = *self.strokes.entry(style.stroke).or_insert(next);
        self.chains.push(Chain { source, stroke, points, line: self.lines.line });
    }

    /// Moves, lines and closings; each move begins a chain.
    fn path(&mut self, node: &Node, style: &Style<'a>) -> Result<(), SvgError> {
        const EXPECTED: &str = "path data such as M 2 2 L 18 2 or M 2 2 h 16";
        let data = node.attribute("d").unwrap_or_default();
        let wrong = || self.wrong(node, "d", data, EXPECTED);
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
                'a' => return Err(SvgError::Circular { line: self.lines.line }),
                'c' | 's' | 'q' | 't' => return Err(SvgError::Curved { line: self.lines.line }),
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
