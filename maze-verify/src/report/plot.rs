//! Line plots as inline SVG. Colours come from the page's style by class, so that light and dark both fit.

use super::number::plain;
use std::fmt::Write;

/// Size of a plot (SVG units, pixels at full width).
pub(crate) const WIDTH: f64 = 360.0;
pub(crate) const HEIGHT: f64 = 230.0;
/// Room for labels: left, right, top, bottom.
const MARGIN: [f64; 4] = [52.0, 12.0, 26.0, 38.0];

/// Least positive value on a logarithmic axis: rounding of f64 in the scenes.
const LOG_FLOOR: f64 = 1.0e-16;

/// How an axis runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Scale {
    /// From 0 or the least value.
    Linear,
    /// Powers of ten; what is not above 0 lies on the lower edge.
    Log,
}

/// One line.
pub(crate) struct Line {
    /// Style class, as `e-continuous`.
    pub(crate) class: String,
    /// For a tooltip.
    pub(crate) name: String,
    /// x, y.
    pub(crate) points: Vec<[f64; 2]>,
    /// Whether each point gets a dot.
    pub(crate) dots: bool,
}

/// A plot.
pub(crate) struct Plot {
    pub(crate) title: String,
    pub(crate) x_label: String,
    pub(crate) x_scale: Scale,
    pub(crate) y_scale: Scale,
    /// Where ticks of the x axis stand; empty: round numbers.
    pub(crate) x_ticks: Vec<(f64, String)>,
    pub(crate) lines: Vec<Line>,
}

/// Values to places along an axis.
struct Axis {
    scale: Scale,
    low: f64,
    high: f64,
    from: f64,
    to: f64,
}

impl Axis {
    fn new(scale: Scale, values: impl Iterator<Item = f64>, from: f64, to: f64) -> Self {
        let value = |value: f64| if scale == Scale::Log { value.max(LOG_FLOOR).log10() } else { value };
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for value in values.filter(|value| value.is_finite()).map(value) {
            low = low.min(value);
            high = high.max(value);
        }
        if !low.is_finite() {
            (low, high) = (0.0, 1.0);
        }
        match scale {
            Scale::Log => (low, high) = (low.floor(), high.ceil().max(low.floor() + 1.0)),
            Scale::Linear => {
                low = if 0.0 < low && low < 0.5 * high { 0.0 } else { low };
                high = if high - low < 1.0e-12 { low + 1.0 } else { high };
            }
        }
        Self { scale, low, high, from, to }
    }

    /// The same axis for what lies between two values, whichever is the larger, and a little air.
    fn between(self, a: f64, b: f64) -> Self {
        let value = |value: f64| if self.scale == Scale::Log { value.max(LOG_FLOOR).log10() } else { value };
        let (low, high) = (value(a.min(b)), value(a.max(b)));
        let air = 0.04 * (high - low);
        Self { low: low - air, high: high + air, ..self }
    }

    fn place(&self, value: f64) -> f64 {
        let value = if self.scale == Scale::Log { value.max(LOG_FLOOR).log10() } else { value };
        let part = ((value - self.low) / (self.high - self.low)).clamp(0.0, 1.0);
        self.from + part * (self.to - self.from)
    }

    fn ticks(&self) -> Vec<(f64, String)> {
        if self.scale == Scale::Log {
            let step = ((self.high - self.low) / 5.0).ceil().max(1.0);
            let n_steps = ((self.high - self.low) / step).floor();
            return counted(n_steps)
                .map(|k| {
                    let power = self.low + k * step;
                    (10.0_f64.powf(power), format!("1e{power}"))
                })
                .collect();
        }
        let rough = (self.high - self.low) / 4.0;
        let power = 10.0_f64.powf(rough.log10().floor());
        let step =
            [1.0, 2.0, 5.0, 10.0].map(|k| k * power).into_iter().find(|step| rough <= *step).unwrap_or(rough);
        let first = (self.low / step).ceil();
        let n_steps = ((self.high / step).floor() - first).max(0.0);
        counted(n_steps)
            .map(|k| {
                let value = (first + k) * step;
                let rounded = (value / power).round() * power;
                (value, if rounded == 0.0 { "0".to_owned() } else { trimmed(rounded) })
            })
            .collect()
    }
}

/// 0 to n.
fn counted(n: f64) -> impl Iterator<Item = f64> {
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a handful of ticks")]
    let n = n.clamp(0.0, 100.0) as u8;
    (0..=n).map(f64::from)
}

fn trimmed(value: f64) -> String {
    let text = plain(value);
    if text.contains('.') && !text.contains('e') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

/// Text that is safe between tags and in attributes.
pub(crate) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

impl Plot {
    /// The plot as an SVG element.
    pub(super) fn svg(&self) -> String {
        self.element("")
    }

    /// The plot as a part of a larger picture, [`WIDTH`] by [`HEIGHT`].
    #[cfg(feature = "bench")]
    pub(crate) fn svg_at(&self, x: f64, y: f64) -> String {
        self.element(&format!(" x=\"{x}\" y=\"{y}\" width=\"{WIDTH}\" height=\"{HEIGHT}\""))
    }

    fn element(&self, place: &str) -> String {
        let [left, right, top, bottom] = MARGIN;
        let values =
            |axis: usize| self.lines.iter().flat_map(move |line| line.points.iter().map(move |p| p[axis]));
        let mut x = Axis::new(self.x_scale, values(0), left, WIDTH - right);
        if let [(first, _), .., (last, _)] = self.x_ticks[..] {
            x = x.between(first, last);
        }
        let y = Axis::new(self.y_scale, values(1), HEIGHT - bottom, top);
        let mut svg = format!(
            "<svg class=\"plot\"{place} viewBox=\"0 0 {WIDTH} {HEIGHT}\" role=\"img\" aria-label=\"{title}\">\
             <text class=\"title\" x=\"{left}\" y=\"14\">{title}</text>",
            title = escaped(&self.title)
        );
        for (value, label) in y.ticks() {
            let place = y.place(value);
            let _ = write!(
                svg,
                "<line class=\"grid\" x1=\"{left}\" x2=\"{:.0}\" y1=\"{place:.1}\" y2=\"{place:.1}\"/>\
                 <text class=\"tick\" text-anchor=\"end\" x=\"{:.0}\" y=\"{:.1}\">{label}</text>",
                WIDTH - right,
                left - 6.0,
                place + 3.5
            );
        }
        let x_ticks = if self.x_ticks.is_empty() { x.ticks() } else { self.x_ticks.clone() };
        for (value, label) in x_ticks {
            let _ = write!(
                svg,
                "<text class=\"tick\" text-anchor=\"middle\" x=\"{:.1}\" y=\"{:.0}\">{}</text>",
                x.place(value),
                HEIGHT - bottom + 15.0,
                escaped(&label)
            );
        }
        let _ = write!(
            svg,
            "<text class=\"tick\" text-anchor=\"end\" x=\"{:.0}\" y=\"{:.0}\">{}</text>",
            WIDTH - right,
            HEIGHT - 6.0,
            escaped(&self.x_label)
        );
        for line in &self.lines {
            svg += &line.svg(&x, &y);
        }
        svg + "</svg>"
    }
}

impl Line {
    fn svg(&self, x: &Axis, y: &Axis) -> String {
        let mut svg =
            format!("<g class=\"{}\"><title>{}</title><polyline points=\"", self.class, escaped(&self.name));
        for [a, b] in &self.points {
            let _ = write!(svg, "{:.1},{:.1} ", x.place(*a), y.place(*b));
        }
        svg += "\"/>";
        if self.dots {
            for [a, b] in &self.points {
                let _ = write!(svg, "<circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"3\"/>", x.place(*a), y.place(*b));
            }
        }
        svg + "</g>"
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_has_round_ticks_and_stays_within_its_places() {
        let axis = Axis::new(Scale::Linear, [0.0, 6.9].into_iter(), 10.0, 110.0);
        let labels: Vec<String> = axis.ticks().into_iter().map(|(_, label)| label).collect();
        assert_eq!(labels, ["0", "2", "4", "6"]);
        assert_eq!((axis.place(0.0), axis.place(6.9), axis.place(99.0)), (10.0, 110.0, 110.0));
        let axis = Axis::new(Scale::Log, [1.0e-9, 0.0, 3.0].into_iter(), 0.0, 1.0);
        assert!(axis.ticks().len() <= 7 && axis.place(0.0) == 0.0);
    }

    #[test]
    fn names_cannot_break_the_page() {
        assert_eq!(escaped("<a b=\"c\">&"), "&lt;a b=&quot;c&quot;&gt;&amp;");
    }
}
