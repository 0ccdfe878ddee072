//! The table on the terminal.

use super::number::{percent, plain, tick};
use crate::contender::Contender;
use crate::metrics::Metrics;
use crate::results::Results;
use crate::scene::Family;
use std::fmt::Write;

/// Most missed runs of a tolerance that are listed.
const MAX_LISTED: usize = 10;

/// A block of the table: one number a family and engine.
struct Block {
    title: &'static str,
    value: fn(&Metrics) -> Option<f64>,
    shown: fn(f64) -> String,
}

const BLOCKS: [Block; 5] = [
    Block {
        title: "Position error, by the distance covered",
        value: |m| Some(m.errors.as_ref()?.position_part),
        shown: percent,
    },
    Block { title: "Off the place where the ball must rest (units)", value: |m| m.rest_error, shown: plain },
    Block {
        title: "Angle error after the first bounce (degrees)",
        value: |m| m.errors.as_ref()?.angle_deg,
        shown: plain,
    },
    Block {
        title: "Deepest in a wall at a tick's end (units)",
        value: |m| Some(m.penetration_max),
        shown: plain,
    },
    Block { title: "Ticks that ended beyond a wall", value: |m| Some(f64::from(m.n_tunnels)), shown: plain },
];

/// Errors by family and engine with each scene's first tick length, then every tolerance.
pub fn table(results: &Results) -> String {
    let mut text = String::from("The worst of each family, with the longest tick of each scene\n\n");
    for block in &BLOCKS {
        block.write(results, &mut text);
    }
    let _ = writeln!(text, "Bars");
    for verdict in &results.verdicts {
        let engines: Vec<&str> = verdict.engines.iter().map(|engine| engine.name()).collect();
        let held = if verdict.missed.is_empty() { "holds " } else { "MISSED" };
        let worst = verdict.worst.as_ref();
        let _ = writeln!(
            text,
            "  {held} {:<34} <= {:<8} worst {:<8} {:<20} of {:>4} runs ({})",
            verdict.metric,
            plain(verdict.limit),
            worst.map_or_else(String::new, |worst| plain(worst.value)),
            worst.map_or("", |worst| &worst.scene),
            verdict.n_checked,
            engines.join(", "),
        );
        for missed in verdict.missed.iter().take(MAX_LISTED) {
            let at =
                if missed.tick_s == 0.0 { String::new() } else { format!(" at {}", tick(missed.tick_s)) };
            let _ = writeln!(
                text,
                "         {}{at}, {}: {} {}, limit {}",
                missed.scene,
                missed.engine.name(),
                verdict.metric,
                plain(missed.value),
                plain(verdict.limit)
            );
        }
        if MAX_LISTED < verdict.missed.len() {
            let _ = writeln!(text, "         and {} more", verdict.missed.len() - MAX_LISTED);
        }
    }
    text
}

impl Block {
    /// Nothing at all where no run has such a value.
    fn write(&self, results: &Results, text: &mut String) {
        let engines: Vec<Contender> =
            Contender::ALL.into_iter().filter(|engine| *engine != Contender::ClosedForm).collect();
        let mut rows = Vec::new();
        for family in Family::ALL {
            let worst = engines.iter().map(|engine| {
                let scenes = results.scenes.iter().filter(|scene| scene.family == family);
                let runs = scenes.filter_map(|scene| scene.first_case()?.run(*engine));
                runs.filter_map(|run| (self.value)(&run.metrics)).max_by(f64::total_cmp)
            });
            let worst: Vec<Option<f64>> = worst.collect();
            if worst.iter().any(Option::is_some) {
                rows.push((family, worst));
            }
        }
        if rows.is_empty() {
            return;
        }
        let _ = writeln!(text, "{}", self.title);
        let _ = write!(text, "  {:<9}", "");
        for engine in &engines {
            let _ = write!(text, " {:>15}", engine.name());
        }
        let _ = writeln!(text);
        for (family, worst) in rows {
            let _ = write!(text, "  {:<9}", family.name());
            for value in worst {
                let _ = write!(text, " {:>15}", value.map_or_else(|| "-".to_owned(), self.shown));
            }
            let _ = writeln!(text);
        }
        let _ = writeln!(text);
    }
}
