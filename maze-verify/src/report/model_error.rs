//! The report's section on the model error of the planar projection.

use super::number::{percent, plain};
use super::plot::{Line, Plot, Scale};
use crate::model_error::{ModelError, Swing};
use crate::results::Results;
use std::fmt::Write;

/// Style classes for the amplitudes, which are no engines: the engines' colours in their order.
const CLASSES: [&str; 5] = ["s-1", "s-2", "s-3", "s-4", "s-5"];

/// Plots over tilt and rate, and the table behind them.
pub(super) fn section(results: &Results, page: &mut String) {
    let Some(model_error) = &results.model_error else { return };
    *page += "<h2>Project gravity, forget z: how far from a real rolling ball?</h2>\
              <p class=\"soft\">Against rapier in three dimensions: world gravity stays, the board swings about its middle from its \
              largest tilt on, a solid sphere of radius 0.25 rolls from the middle for 4 s. The equation of the rolling sphere, \
              x″ = 5/7 (g sin θ + θ′² x) − r θ″, which knows the board's turning, follows rapier all the way. Swings that throw \
              the ball off the board end there.</p><div class=\"views\">";
    for plot in [
        by_frequency(model_error, "Projected gravity off by (corridors)", |swing| swing.projected_off),
        by_frequency(model_error, "Equation off by (corridors)", |swing| swing.equation_off),
    ] {
        *page += &plot.svg();
    }
    *page += "</div>";
    swings(model_error, page);
    *page += "<div class=\"scroll\"><table><tr><th>Board held still at</th>";
    for held in &model_error.held {
        let _ = write!(page, "<th>{}°</th>", held.tilt_deg);
    }
    *page += "</tr><tr><td>acceleration by g sin θ (5/7 = 0.71429)</td>";
    for held in &model_error.held {
        let _ = write!(page, "<td>{:.5}</td>", held.part);
    }
    *page +=
        "</tr></table></div><div class=\"scroll\"><table><tr><th>A rolling ball at a wall, restitution</th>";
    for bounce in &model_error.bounces {
        let _ = write!(page, "<th>{}</th>", bounce.restitution);
    }
    *page += "</tr><tr><td>returns with</td>";
    for bounce in &model_error.bounces {
        let _ = write!(page, "<td>{:.4}</td>", bounce.measured);
    }
    *page += "</tr><tr><td>theory, (5 e − 2) / 7</td>";
    for bounce in &model_error.bounces {
        let _ = write!(page, "<td>{:.4}</td>", bounce.formula);
    }
    *page += "</tr></table></div>";
}

fn by_frequency(model_error: &ModelError, title: &str, value: impl Fn(&Swing) -> f64) -> Plot {
    let groups = model_error.swings.chunk_by(|a, b| a.amplitude_deg == b.amplitude_deg);
    let line = |(swings, class): (&[Swing], &str)| Line {
        class: class.to_owned(),
        name: format!("±{}°", swings[0].amplitude_deg),
        points: swings.iter().map(|swing| [swing.frequency_hz, value(swing)]).collect(),
        dots: true,
    };
    Plot {
        title: title.to_owned(),
        x_label: "swings a second (Hz)".to_owned(),
        x_scale: Scale::Log,
        y_scale: Scale::Log,
        x_ticks: model_error
            .swings
            .first()
            .map(|first| {
                let same =
                    model_error.swings.iter().filter(|swing| swing.amplitude_deg == first.amplitude_deg);
                same.map(|swing| (swing.frequency_hz, swing.frequency_hz.to_string())).collect()
            })
            .unwrap_or_default(),
        lines: groups.zip(CLASSES).map(line).collect(),
    }
}

/// Rows: amplitudes; columns: frequencies; in each the distance and its part of the travel.
fn swings(model_error: &ModelError, page: &mut String) {
    let groups: Vec<&[Swing]> =
        model_error.swings.chunk_by(|a, b| a.amplitude_deg == b.amplitude_deg).collect();
    let Some(first) = groups.first() else { return };
    *page += "<p class=\"soft\">Projected gravity off by, in corridors, and as a part of how far the ball got:</p>\
              <div class=\"scroll\"><table><tr><th>Swing</th>";
    for swing in *first {
        let _ = write!(page, "<th>{} Hz</th>", swing.frequency_hz);
    }
    *page += "</tr>";
    for (group, class) in groups.iter().zip(CLASSES) {
        let _ =
            write!(page, "<tr><td><span class=\"swatch {class}\"></span>±{}°</td>", group[0].amplitude_deg);
        for swing in *group {
            let thrown =
                swing.thrown_s.map_or_else(String::new, |time_s| format!(", thrown at {time_s:.1} s"));
            let _ = write!(
                page,
                "<td>{} <span class=\"soft\">({}{thrown})</span></td>",
                plain(swing.projected_off),
                percent(swing.projected_off / swing.travel)
            );
        }
        *page += "</tr>";
    }
    *page += "</table></div>";
}
