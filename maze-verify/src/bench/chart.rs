//! The chart: a panel a question, time against planes, both logarithmic.

use super::figures::{Figures, Group, distinct};
use crate::report::plot::{HEIGHT, Line, Plot, Scale, WIDTH, escaped};
use std::fmt::Write;

/// Panels side by side.
const N_ACROSS: usize = 3;

/// Around and between panels, and a line of the legend (SVG units).
const GAP: f64 = 16.0;
const LEGEND_LINE: f64 = 20.0;

/// Width of an entry of the legend (SVG units).
const LEGEND_ENTRY: f64 = 200.0;

/// Colours for light and for dark, in the order in which contenders come; what comes after has the first one again,
/// dashed otherwise.
const COLOURS: [[&str; 2]; 7] = [
    ["#0062a8", "#5bb4f0"],
    ["#c9510c", "#ff9257"],
    ["#00865f", "#35c99a"],
    ["#a3477f", "#e89ac6"],
    ["#a87900", "#eec04f"],
    ["#5b4bb0", "#a99cf5"],
    ["#7a5a3a", "#c9a27c"],
];

/// Dashes: none, long, dotted.
const DASHES: [&str; 3] = ["none", "7 4", "1.5 4"];

impl Figures {
    /// An SVG file that can be read by itself, in light and in dark.
    #[allow(clippy::cast_precision_loss, reason = "a handful of panels")]
    pub fn chart(&self) -> String {
        let questions = self.charted();
        let shown = self.groups.iter().filter(|group| questions.contains(&group.question));
        let leaders =
            distinct(shown.clone().filter_map(|group| group.series.first()).map(|series| series.name));
        let all = shown.flat_map(|group| group.series.iter().map(|series| series.name));
        let names = distinct(leaders.iter().copied().chain(all));
        let n_rows = questions.len().div_ceil(N_ACROSS);
        let across = N_ACROSS.min(questions.len().max(1)) as f64;
        let width = (across * (WIDTH + GAP) + GAP).max(3.0 * LEGEND_ENTRY + 2.0 * GAP);
        let legend_columns = ((width - 2.0 * GAP) / LEGEND_ENTRY).floor();
        let head = 52.0;
        let legend_top = head + n_rows as f64 * (HEIGHT + GAP) + GAP;
        let height = legend_top + (names.len() as f64 / legend_columns).ceil() * LEGEND_LINE + GAP;
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" \
             height=\"{height}\">{}<rect class=\"paper\" width=\"{width}\" height=\"{height}\"/>\
             <text class=\"head\" x=\"{GAP}\" y=\"24\">Time (ns) against number of planes</text>\
             <text x=\"{GAP}\" y=\"42\">{}</text>",
            style(names.len(), leaders.len()),
            escaped(&self.machine.lines().join("; "))
        );
        for (index, question) in questions.iter().enumerate() {
            let x = GAP + (index % N_ACROSS) as f64 * (WIDTH + GAP);
            let y = head + (index / N_ACROSS) as f64 * (HEIGHT + GAP);
            svg += &self.panel(question, &names).svg_at(x, y);
        }
        for (index, name) in names.iter().enumerate() {
            let x = GAP + (index as f64 % legend_columns) * LEGEND_ENTRY;
            let y = legend_top + (index as f64 / legend_columns).floor() * LEGEND_LINE;
            let _ = write!(
                svg,
                "<g class=\"{}\"><polyline points=\"{x},{y} {},{y}\"/><circle cx=\"{}\" cy=\"{y}\" r=\"3\"/></g>\
                 <text x=\"{}\" y=\"{}\">{}</text>",
                class(index),
                x + 28.0,
                x + 14.0,
                x + 36.0,
                y + 4.0,
                escaped(name)
            );
        }
        svg + "</svg>\n"
    }

    /// Questions asked in mazes of several sizes; all of them where there is but one size.
    fn charted(&self) -> Vec<&'static str> {
        let n_sizes =
            |question: &&str| self.groups.iter().filter(|group| group.question == *question).count();
        let mut questions = self.questions();
        if questions.iter().any(|question| 1 < n_sizes(question)) {
            questions.retain(|question| 1 < n_sizes(question));
        }
        questions
    }

    fn panel(&self, question: &str, names: &[&'static str]) -> Plot {
        let groups: Vec<&Group> = self.groups.iter().filter(|group| group.question == question).collect();
        let line = |(index, name): (usize, &&'static str)| {
            #[allow(clippy::cast_precision_loss, reason = "counts far below 2^53")]
            let points =
                groups.iter().filter_map(|group| Some([group.n_planes as f64, group.ns(name)?.median]));
            Line { class: class(index), name: (*name).to_owned(), points: points.collect(), dots: true }
        };
        let lines = names.iter().enumerate().map(line).filter(|line| !line.points.is_empty());
        Plot {
            title: question.to_owned(),
            x_label: "planes".to_owned(),
            x_scale: Scale::Log,
            y_scale: Scale::Log,
            x_ticks: powers(&groups),
            // The first contender comes last, over the others.
            lines: lines.collect::<Vec<_>>().into_iter().rev().collect(),
        }
    }
}

/// Ticks at the powers of ten that the sizes are near.
#[allow(clippy::cast_precision_loss, reason = "counts far below 2^53")]
fn powers(groups: &[&Group]) -> Vec<(f64, String)> {
    let power = |group: &&Group| (group.n_planes.max(1) as f64).log10().round();
    let mut powers: Vec<f64> = groups.iter().map(power).collect();
    powers.dedup();
    powers.into_iter().map(|power| (10.0_f64.powf(power), format!("1e{power}"))).collect()
}

fn class(index: usize) -> String {
    format!("c-{index}")
}

/// Those that the others are compared with come first, in broad lines.
fn style(n_contenders: usize, n_leaders: usize) -> String {
    let mut light = String::new();
    let mut dark = String::new();
    for index in 0..n_contenders {
        let [on_light, on_dark] = COLOURS[index % COLOURS.len()];
        let dashes = DASHES[index / COLOURS.len() % DASHES.len()];
        let _ = write!(light, ".c-{index}{{color:{on_light};stroke-dasharray:{dashes}}}");
        let _ = write!(dark, ".c-{index}{{color:{on_dark}}}");
        if index < n_leaders {
            let _ = write!(light, ".c-{index} polyline{{stroke-width:3}}");
        }
    }
    format!(
        "<style>.paper{{fill:#fbfaf7}}text{{fill:#5c626c;font:11.5px system-ui,sans-serif}}\
         .title,.head{{fill:#1d1f24;font-weight:600;font-size:12.5px}}.head{{font-size:16px}}\
         .grid{{stroke:#dedbd3}}polyline{{fill:none;stroke:currentColor;stroke-width:1.6}}\
         circle{{fill:currentColor}}{light}\
         @media(prefers-color-scheme:dark){{.paper{{fill:#15171b}}text{{fill:#a0a5ae}}\
         .title,.head{{fill:#e8e6e1}}.grid{{stroke:#343942}}{dark}}}</style>"
    )
}
