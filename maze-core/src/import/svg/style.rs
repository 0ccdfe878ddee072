//! What is painted: colours and widths as attributes, classes and declarations give them, and what is inherited.

use super::SvgError;
use super::numbers::{self, Transform};
use crate::physics::numbers::lesser;
use simplecss::{AttributeOperator, Element, PseudoClass, StyleSheet};
use std::str::FromStr;
use svgtypes::Color;

/// Most bytes of style sheets, and most rules times elements that are compared.
const MAX_SHEET: usize = 1 << 16;
const MAX_MATCHES: usize = 1 << 26;

/// Paint that lets more than this fraction of the ground through is not seen.
const LEAST_OPACITY: f64 = 0.1;

/// A colour on white paper.
pub(super) type Rgb = [u8; 3];

/// The properties that decide about paint, as attributes and declarations name them.
pub(super) const PROPERTIES: [&str; 11] = [
    "stroke",
    "fill",
    "stroke-width",
    "stroke-opacity",
    "fill-opacity",
    "opacity",
    "display",
    "visibility",
    "color",
    "fill-rule",
    "stroke-linecap",
];

/// An element with what a selector asks for.
#[derive(Clone, Debug, Default)]
pub(super) struct Named {
    pub(super) name: String,
    pub(super) id: Option<String>,
    pub(super) class: Option<String>,
}

/// An element and those around it, for selectors.
#[derive(Clone, Copy)]
struct Nested<'a>(&'a [Named]);

impl Element for Nested<'_> {
    fn parent_element(&self) -> Option<Self> {
        let (_, around) = self.0.split_last()?;
        (!around.is_empty()).then_some(Self(around))
    }

    fn prev_sibling_element(&self) -> Option<Self> {
        None
    }

    fn has_local_name(&self, name: &str) -> bool {
        self.0.last().is_some_and(|element| element.name == name)
    }

    fn attribute_matches(&self, local_name: &str, operator: AttributeOperator) -> bool {
        let element = self.0.last();
        let value = element.and_then(|element| match local_name {
            "class" => element.class.as_deref(),
            "id" => element.id.as_deref(),
            _ => None,
        });
        value.is_some_and(|value| operator.matches(value))
    }

    fn pseudo_class_matches(&self, _: PseudoClass) -> bool {
        false
    }
}

/// The style sheets of a file.
pub(super) struct Sheets<'a> {
    sheet: StyleSheet<'a>,
    n_matches: usize,
}

impl<'a> Sheets<'a> {
    /// Of the text in all `style` elements.
    pub(super) fn new(text: &'a str, line: usize) -> Result<Self, SvgError> {
        if MAX_SHEET < text.len() {
            return Err(SvgError::TooMuch { line, what: "bytes of style sheets", most: MAX_SHEET });
        }
        Ok(Self { sheet: StyleSheet::parse(text), n_matches: 0 })
    }

    /// The declarations for the last of nested elements, the strongest last.
    fn declarations(
        &mut self,
        nested: &[Named],
        line: usize,
        mut set: impl FnMut(&str, &str),
    ) -> Result<(), SvgError> {
        self.n_matches = self.n_matches.saturating_add(self.sheet.rules.len());
        if MAX_MATCHES < self.n_matches {
            return Err(SvgError::TooMuch { line, what: "elements times style rules", most: MAX_MATCHES });
        }
        for important in [false, true] {
            for rule in self.sheet.rules.iter().filter(|rule| rule.selector.matches(&Nested(nested))) {
                for one in rule.declarations.iter().filter(|one| one.important == important) {
                    set(one.name, one.value);
                }
            }
        }
        Ok(())
    }
}

/// Paint, or none.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Paint {
    None,
    Current,
    Of { rgb: Rgb, alpha: f64 },
}

/// What an element hands down to those inside it.
#[derive(Clone, Debug)]
pub(super) struct Style {
    pub(super) transform: Transform,
    stroke: Paint,
    fill: Paint,
    colour: Paint,
    stroke_width: f64,
    stroke_opacity: f64,
    fill_opacity: f64,
    /// Of all groups around it and itself.
    opacity: f64,
    is_visible: bool,
    /// Not drawn, nor anything in it.
    pub(super) is_gone: bool,
    pub(super) is_even_odd: bool,
    /// Strokes without a length are dots.
    pub(super) has_caps: bool,
}

impl Style {
    pub(super) fn initial() -> Self {
        Self {
            transform: Transform::IDENTITY,
            stroke: Paint::None,
            fill: Paint::Of { rgb: [0; 3], alpha: 1.0 },
            colour: Paint::Of { rgb: [0; 3], alpha: 1.0 },
            stroke_width: 1.0,
            stroke_opacity: 1.0,
            fill_opacity: 1.0,
            opacity: 1.0,
            is_visible: true,
            is_gone: false,
            is_even_odd: false,
            has_caps: false,
        }
    }

    /// The style of an element in this one, from its attributes and the style sheets.
    pub(super) fn of_child(
        &self,
        attribute: impl Fn(&str) -> Option<String>,
        nested: &[Named],
        sheets: &mut Sheets,
        line: usize,
    ) -> Result<Self, SvgError> {
        let mut values: [Option<String>; PROPERTIES.len()] = PROPERTIES.map(&attribute);
        let mut set = |name: &str, value: &str| {
            if let Some(index) = PROPERTIES.iter().position(|property| *property == name) {
                values[index] = Some(value.trim().to_owned());
            }
        };
        sheets.declarations(nested, line, &mut set)?;
        let inline = attribute("style").unwrap_or_default();
        for (name, value) in inline.split(';').filter_map(|one| one.split_once(':')) {
            set(name.trim(), value.trim().trim_end_matches("!important"));
        }
        let mut style = Self { opacity: 1.0, ..self.clone() };
        let named = PROPERTIES.iter().zip(values);
        for (name, value) in named.filter_map(|(name, value)| Some((*name, value?))) {
            style.set(name, value.trim());
        }
        style.opacity *= self.opacity;
        Ok(style)
    }

    /// Sets a property; a value that is no value leaves it as it is.
    fn set(&mut self, name: &str, value: &str) {
        if value == "inherit" {
            return;
        }
        let part = || match value.strip_suffix('%') {
            Some(percent) => percent.trim().parse().map(|percent: f64| percent / 100.0).ok(),
            None => value.parse::<f64>().ok(),
        };
        let part = || part().filter(|part| part.is_finite());
        match name {
            "stroke" => self.stroke = paint(value).unwrap_or(self.stroke),
            "fill" => self.fill = paint(value).unwrap_or(self.fill),
            "color" => self.colour = paint(value).unwrap_or(self.colour),
            "stroke-width" => self.stroke_width = numbers::length(value).unwrap_or(self.stroke_width),
            "stroke-opacity" => self.stroke_opacity = part().unwrap_or(self.stroke_opacity),
            "fill-opacity" => self.fill_opacity = part().unwrap_or(self.fill_opacity),
            "opacity" => self.opacity = part().unwrap_or(1.0),
            "display" => self.is_gone |= value == "none",
            "visibility" => self.is_visible = value == "visible",
            "fill-rule" => self.is_even_odd = value == "evenodd",
            "stroke-linecap" => self.has_caps = value != "butt",
            _ => {}
        }
    }

    fn seen(&self, paint: Paint, opacity: f64) -> Option<Rgb> {
        let paint = if paint == Paint::Current { self.colour } else { paint };
        let Paint::Of { rgb, alpha } = paint else { return None };
        let opacity = alpha * opacity * self.opacity;
        if !self.is_visible || self.is_gone || opacity < LEAST_OPACITY {
            return None;
        }
        // Over white paper; more than all of it is all.
        let opacity = lesser(opacity, 1.0);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 255")]
        Some(rgb.map(|channel| (255.0 - (255.0 - f64::from(channel)) * opacity + 0.5) as u8))
    }

    /// Colour and width of strokes, after all transforms; `None` where none is seen.
    pub(super) fn stroke(&self) -> Option<(Rgb, f64)> {
        let width = self.stroke_width * self.transform.mean_scale();
        let colour = self.seen(self.stroke, self.stroke_opacity)?;
        (0.0 < width && width.is_finite()).then_some((colour, width))
    }

    /// Colour of areas; `None` where none is seen.
    pub(super) fn fill(&self) -> Option<Rgb> {
        self.seen(self.fill, self.fill_opacity)
    }
}

/// `None` for what is no paint. Gradients and patterns are seen, in whatever colour: grey.
fn paint(value: &str) -> Option<Paint> {
    match value {
        "none" | "transparent" => Some(Paint::None),
        "currentColor" | "currentcolor" => Some(Paint::Current),
        _ if value.starts_with("url(") => Some(Paint::Of { rgb: [0; 3], alpha: 1.0 }),
        _ => {
            let colour = Color::from_str(value).ok()?;
            let rgb = [colour.red, colour.green, colour.blue];
            Some(Paint::Of { rgb, alpha: f64::from(colour.alpha) / 255.0 })
        }
    }
}
