//! A scene from above: its walls, and the paths of all engines over each other.

use super::plot::escaped;
use crate::contender::Contender;
use crate::results::SceneResult;
use std::fmt::Write;

/// What is shown around the paths at least (units).
const AROUND: f64 = 0.8;

/// Least side of what is shown (units).
const LEAST_SIDE: f64 = 2.0;

/// Style class of an engine.
pub(super) fn class_of(engine: Contender) -> String {
    format!("e-{}", engine.name())
}

/// Left, below, right, above of what is worth showing.
///
/// The paths tell, and not the walls, which may be long; a ball that has left the board does not count.
fn frame(scene: &SceneResult) -> [f64; 4] {
    let [mut left, mut below, mut right, mut above] =
        [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
    let runs = scene.first_case().into_iter().flat_map(|case| &case.runs);
    let in_plane = || runs.clone().filter(|run| run.engine != Contender::RapierRolling);
    let has_planar = in_plane().next().is_some();
    for run in runs.clone().filter(|run| !has_planar || run.engine != Contender::RapierRolling) {
        for [x, y] in &run.path {
            left = left.min(*x);
            right = right.max(*x);
            below = below.min(*y);
            above = above.max(*y);
        }
    }
    let around = scene.radius + AROUND;
    let widen = |low: f64, high: f64| {
        let more = ((LEAST_SIDE - (high - low)) / 2.0).max(around);
        [low - more, high + more]
    };
    let ([left, right], [below, above]) = (widen(left, right), widen(below, above));
    // Very long and thin pictures are unreadable: the short side is at least a third of the long one.
    let (width, height) = (right - left, above - below);
    let (x, y) = ((height / 3.0 - width).max(0.0) / 2.0, (width / 3.0 - height).max(0.0) / 2.0);
    [left - x, below - y, right + x, above + y]
}

/// The drawing as an SVG element; y points up.
pub(super) fn svg(scene: &SceneResult) -> String {
    let [left, below, right, above] = frame(scene);
    let (width, height) = (right - left, above - below);
    if !(width.is_finite() && height.is_finite()) {
        return String::new();
    }
    let thin = width.max(height) / 260.0;
    let mut svg = format!(
        "<svg class=\"board\" viewBox=\"{left:.3} {:.3} {width:.3} {height:.3}\" role=\"img\" aria-label=\"{}\" \
         style=\"--thin:{thin:.4}px\"><g transform=\"scale(1,-1)\">",
        -above,
        escaped(&format!("Walls and paths of {}", scene.name))
    );
    for [x0, y0, x1, y1] in &scene.walls {
        // A wall may reach far beyond the picture.
        let (x0, x1) = (x0.max(left - 1.0), x1.min(right + 1.0));
        let (y0, y1) = (y0.max(below - 1.0), y1.min(above + 1.0));
        if x0 < x1 && y0 < y1 {
            let _ = write!(
                svg,
                "<rect class=\"wall\" x=\"{x0:.3}\" y=\"{y0:.3}\" width=\"{:.3}\" height=\"{:.3}\"/>",
                x1 - x0,
                y1 - y0
            );
        }
    }
    for run in scene.first_case().into_iter().flat_map(|case| &case.runs) {
        let _ = write!(
            svg,
            "<g class=\"{}\"><title>{}</title><polyline points=\"",
            class_of(run.engine),
            run.engine.name()
        );
        for [x, y] in &run.path {
            let _ = write!(svg, "{x:.3},{y:.3} ");
        }
        svg += "\"/></g>";
    }
    let start = scene.first_case().and_then(|case| case.runs.first()).and_then(|run| run.path.first());
    if let Some([x, y]) = start {
        let _ = write!(svg, "<circle class=\"ball\" cx=\"{x:.3}\" cy=\"{y:.3}\" r=\"{}\"/>", scene.radius);
    }
    svg + "</g></svg>"
}
