//! report.html: one file that opens from disk, without scripts and without anything from elsewhere.

use super::drawing::{self, class_of};
use super::model_error;
use super::number::{percent, plain, tick};
use super::plot::{Line, Plot, Scale, escaped};
use super::summary::{Finding, findings};
use crate::contender::Contender;
use crate::metrics::Metrics;
use crate::results::{CaseResult, Results, SceneResult};
use crate::scene::Family;
use std::fmt::Write;

const STYLE: &str = include_str!("style.css");

/// Scenes and mazes that stand open: the worst ones.
const N_OPEN: usize = 4;

const N_OPEN_MAZES: usize = 2;

/// Rows of the list of worst cases.
const N_WORST: usize = 12;

/// The whole page.
pub fn html(results: &Results) -> String {
    let mut scenes: Vec<(f64, &SceneResult)> =
        results.scenes.iter().map(|scene| (badness(scene), scene)).collect();
    scenes.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.index.cmp(&b.1.index)));
    let mut page = format!(
        "<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\">\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"><link rel=\"icon\" href=\"data:,\">\
         <title>Maze cross-check</title><style>{STYLE}</style></head><body>"
    );
    header(results, &mut page);
    legend(&mut page);
    page += "<h2>In plain words</h2><p class=\"soft\">Made from this run's numbers: each engine with its worst scene and tick. What is told of \
             mazes holds for the game's tick of 0.03 s.</p>";
    page += "<div class=\"findings\">";
    for finding in findings(results) {
        card(&finding, &mut page);
    }
    page += "</div>";
    model_error::section(results, &mut page);
    verdicts(results, &mut page);
    worst_cases(results, &mut page);
    let [told, mazes]: [Vec<_>; 2] = [false, true].map(|is_maze| {
        scenes
            .iter()
            .map(|(_, scene)| *scene)
            .filter(|scene| (scene.family == Family::Maze) == is_maze)
            .collect()
    });
    scene_list("Scenes, worst first", &told, N_OPEN, &mut page);
    if let Some(plot) = parting(&mazes) {
        let _ = write!(
            page,
            "<h2>Random mazes: when engines part</h2><p class=\"soft\">Before they part, the first bounces agree (see the tolerances); \
             after that only distributions can.</p><div class=\"views\">{}{}</div>",
            plot.svg(),
            liveliness(&mazes).svg()
        );
    }
    scene_list("Random mazes, earliest parted first", &mazes, N_OPEN_MAZES, &mut page);
    page += "<p class=\"soft\">Definitions of all metrics, the reasons of all tolerances and what cannot be matched with rapier: \
             docs/verification.md.</p></body></html>\n";
    page
}

/// How far the planar engines are off: with a truth by the distance covered, else by how early they part.
fn badness(scene: &SceneResult) -> f64 {
    let runs = scene.first_case().into_iter().flat_map(|case| &case.runs);
    let planar = runs.filter(|run| run.engine != Contender::RapierRolling);
    let off = planar.map(|run| match (&run.metrics.errors, run.metrics.diverged_s) {
        (Some(errors), _) => 1.0 + errors.position_part,
        (None, Some(diverged_s)) => 1.0 - diverged_s / scene.duration_s,
        (None, None) => 0.0,
    });
    off.fold(0.0, f64::max)
}

fn header(results: &Results, page: &mut String) {
    let n_missed: usize = results.verdicts.iter().filter(|verdict| !verdict.missed.is_empty()).count();
    let n_runs: usize =
        results.scenes.iter().flat_map(|scene| &scene.cases).map(|case| case.runs.len()).sum();
    let (class, verdict) = match n_missed {
        0 => ("good", format!("All {} tolerances hold", results.verdicts.len())),
        _ => ("bad", format!("{n_missed} of {} tolerances missed", results.verdicts.len())),
    };
    let part = match results.partition.n {
        1 => String::new(),
        n => format!(" (part {}/{n} of {} scenes)", results.partition.k, results.n_scenes),
    };
    let _ = write!(
        page,
        "<h1>Maze cross-check</h1><p class=\"soft\">Our engines, rapier3d 0.36 and closed-form mechanics on the same scenes: \
         {} scenes, {n_runs} runs{part}. Closed form is the truth where there is one; rapier is a respected peer; everybody's \
         errors stand side by side. {}</p><div class=\"verdict {class}\">{verdict}</div>",
        results.scenes.len(),
        escaped(&results.program)
    );
}

fn legend(page: &mut String) {
    *page += "<div class=\"legend\">";
    for engine in Contender::ALL {
        let _ = write!(
            page,
            "<label title=\"{}\"><input type=\"checkbox\" id=\"show-{name}\" checked>\
             <svg class=\"key\" viewBox=\"0 0 30 12\"><g class=\"{}\"><polyline points=\"0,6 30,6\"/></g></svg>{name}</label>",
            engine.about(),
            class_of(engine),
            name = engine.name()
        );
    }
    *page += "</div>";
}

fn card(finding: &Finding, page: &mut String) {
    let wide = if finding.ranking.is_empty() { " wide" } else { "" };
    let _ = write!(
        page,
        "<div class=\"finding{wide}\"><h3>{}</h3><p>{}</p>",
        escaped(&finding.title),
        escaped(&finding.text)
    );
    let largest = finding.ranking.last().map_or(0.0, |ranked| ranked.worst);
    if 1.0e-8 < largest {
        *page += "<ul class=\"bars\">";
        for (ranked, shown) in finding.ranking.iter().zip(&finding.shown) {
            let _ = write!(
                page,
                "<li><span>{name}</span><span class=\"{class}\"><i style=\"width:{:.1}%\"></i></span><span>{}</span></li>",
                100.0 * ranked.worst / largest,
                escaped(shown),
                name = ranked.engine.name(),
                class = class_of(ranked.engine)
            );
        }
        *page += "</ul>";
    }
    *page += "</div>";
}

fn verdicts(results: &Results, page: &mut String) {
    *page += "<h2>Bars</h2><p class=\"soft\">What must hold, why this much, and how near the worst run came.</p>\
              <div class=\"scroll\"><table><tr><th>Metric</th><th>Holds</th><th>Limit</th><th>Worst</th><th class=\"words\">where\
              </th><th>Runs</th><th class=\"words\">Who, and why this much</th></tr>";
    for verdict in &results.verdicts {
        let engines: Vec<&str> = verdict.engines.iter().map(|engine| engine.name()).collect();
        let holds = if verdict.missed.is_empty() {
            "<td class=\"good\">yes</td>"
        } else {
            "<td class=\"bad\">missed</td>"
        };
        let worst = verdict.worst.as_ref();
        // Where nobody is off by anything, nobody is worst.
        let place = worst.filter(|worst| worst.value != 0.0).map_or_else(String::new, |worst| {
            let at = if worst.tick_s == 0.0 { String::new() } else { format!(", {}", tick(worst.tick_s)) };
            format!("{}{at}", escaped(&worst.scene))
        });
        let _ = write!(
            page,
            "<tr><td>{}</td>{holds}<td>{}</td><td>{}</td><td class=\"words\">{place}</td><td>{}</td><td class=\"words\">{}: {}</td></tr>",
            escaped(&verdict.metric),
            plain(verdict.limit),
            worst.map_or_else(String::new, |worst| plain(worst.value)),
            verdict.n_checked,
            engines.join(", "),
            escaped(&verdict.reason)
        );
        for missed in &verdict.missed {
            let _ = write!(
                page,
                "<tr class=\"missed\"><td></td><td>missed</td><td></td><td>{}</td><td class=\"words\">{}, {}</td><td></td>\
                 <td class=\"words\">{}</td></tr>",
                plain(missed.value),
                escaped(&missed.scene),
                tick(missed.tick_s),
                missed.engine.name()
            );
        }
    }
    *page += "</table></div>";
}

fn worst_cases(results: &Results, page: &mut String) {
    let mut cases: Vec<(f64, &SceneResult, &CaseResult, Contender)> = Vec::new();
    for scene in &results.scenes {
        for case in &scene.cases {
            for run in &case.runs {
                let off = run.metrics.errors.as_ref().map(|errors| errors.position_part);
                cases.extend(off.map(|off| (off, scene, case, run.engine)));
            }
        }
    }
    cases.sort_by(|a, b| b.0.total_cmp(&a.0));
    if cases.is_empty() {
        return;
    }
    *page += "<h2>Worst cases</h2><p class=\"soft\">Farthest from closed form, by the distance that the true ball covered. One row a \
              scene and engine, with its worst tick.</p><div class=\"scroll\"><table><tr><th>Scene</th><th>Engine</th>\
              <th>Tick</th><th>Off by</th><th class=\"words\">What it is</th></tr>";
    let mut seen: Vec<(&str, Contender)> = Vec::new();
    for (off, scene, case, engine) in cases {
        if seen.contains(&(&scene.name, engine)) {
            continue;
        }
        if seen.len() == N_WORST {
            break;
        }
        seen.push((&scene.name, engine));
        let _ = write!(
            page,
            "<tr><td><a href=\"#{name}\">{name}</a></td><td>{}</td><td>{}</td><td>{}</td><td class=\"words\">{}</td></tr>",
            swatch(engine),
            tick(case.tick_s),
            percent(off),
            escaped(&scene.about),
            name = escaped(&scene.name)
        );
    }
    *page += "</table></div>";
}

fn swatch(engine: Contender) -> String {
    format!("<span class=\"swatch {}\"></span>{}", class_of(engine), engine.name())
}

fn scene_list(title: &str, scenes: &[&SceneResult], n_open: usize, page: &mut String) {
    if scenes.is_empty() {
        return;
    }
    let _ = write!(page, "<h2>{}</h2>", escaped(title));
    for (number, scene) in scenes.iter().enumerate() {
        one_scene(scene, number < n_open, page);
    }
}

fn one_scene(scene: &SceneResult, open: bool, page: &mut String) {
    let off = badness(scene);
    let off = match off {
        off if 1.0 <= off => format!("worst planar engine off by {}", percent(off - 1.0)),
        off if 0.0 < off => format!("first parted after {} s", plain((1.0 - off) * scene.duration_s)),
        _ => "nobody parted".to_owned(),
    };
    let _ = write!(
        page,
        "<details class=\"scene\" id=\"{name}\"{}><summary><b>{name}</b><span>{}</span><span class=\"off\">{off}</span></summary>\
         <div class=\"inside\"><div class=\"views\">{}",
        if open { " open" } else { "" },
        escaped(&scene.about),
        drawing::svg(scene),
        name = escaped(&scene.name)
    );
    for plot in plots(scene).into_iter().flatten() {
        *page += &plot.svg();
    }
    *page += "</div>";
    numbers(scene, page);
    *page += "</div></details>";
}

/// Lines of all engines that have points.
fn lines(
    case: &CaseResult,
    dots: bool,
    points: impl Fn(&crate::results::RunResult) -> Vec<[f64; 2]>,
) -> Vec<Line> {
    let line = |run: &crate::results::RunResult| Line {
        class: class_of(run.engine),
        name: run.engine.name().to_owned(),
        points: points(run),
        dots,
    };
    case.runs.iter().map(line).filter(|line| !line.points.is_empty()).collect()
}

fn plots(scene: &SceneResult) -> [Option<Plot>; 4] {
    let Some(case) = scene.first_case() else { return [const { None }; 4] };
    let at = tick(case.tick_s);
    let reference = match case.runs.iter().any(|run| run.metrics.errors.is_some()) {
        true => "closed form",
        false => "continuous",
    };
    let over_time = Plot {
        title: format!("Distance to {reference}, tick {at}"),
        x_label: "time (s)".to_owned(),
        x_scale: Scale::Linear,
        y_scale: Scale::Log,
        x_ticks: Vec::new(),
        lines: lines(case, false, |run| run.distance.clone()),
    };
    let apexes = |run: &crate::results::RunResult| {
        let points =
            run.metrics.apexes.iter().enumerate().map(|(index, apex)| [index as f64 + 1.0, apex.max(1.0e-6)]);
        points.collect::<Vec<_>>()
    };
    let n_bounces = case.runs.iter().map(|run| run.metrics.apexes.len()).max().unwrap_or(0);
    let stride = n_bounces.div_ceil(8).max(1);
    let bounces = Plot {
        title: format!("Height of each bounce, tick {at}"),
        x_label: "bounce".to_owned(),
        x_scale: Scale::Linear,
        y_scale: Scale::Log,
        x_ticks: (1..=n_bounces).step_by(stride).map(|k| (k as f64, k.to_string())).collect(),
        lines: lines(case, true, apexes),
    };
    let energy = Plot {
        title: format!("Energy less the work of gravity, tick {at}"),
        x_label: "time (s)".to_owned(),
        x_scale: Scale::Linear,
        y_scale: Scale::Linear,
        x_ticks: Vec::new(),
        lines: lines(case, false, |run| run.energy.clone()),
    };
    let by_tick = Plot {
        title: "Largest distance to closed form, by tick".to_owned(),
        x_label: "tick length".to_owned(),
        x_scale: Scale::Log,
        y_scale: Scale::Log,
        x_ticks: scene.cases.iter().map(|case| (case.tick_s, tick(case.tick_s).replace(" s", ""))).collect(),
        lines: Contender::ALL.into_iter().filter_map(|engine| errors_by_tick(scene, engine)).collect(),
    };
    let has_lines = |plot: Plot| (!plot.lines.is_empty()).then_some(plot);
    let by_tick = if 1 < scene.cases.len() { has_lines(by_tick) } else { None };
    [has_lines(over_time), has_lines(bounces), by_tick, has_lines(energy)]
}

fn errors_by_tick(scene: &SceneResult, engine: Contender) -> Option<Line> {
    let point = |case: &CaseResult| Some([case.tick_s, case.run(engine)?.metrics.errors.as_ref()?.position]);
    let points: Vec<[f64; 2]> = scene.cases.iter().filter_map(point).collect();
    (!points.is_empty()).then(|| Line {
        class: class_of(engine),
        name: engine.name().to_owned(),
        points,
        dots: true,
    })
}

/// Sorted values of all mazes and which part of them is not above each: the distribution as a line.
fn distribution(
    mazes: &[&SceneResult],
    engine: Contender,
    value: impl Fn(&Metrics) -> Option<f64>,
) -> Option<Line> {
    let runs = mazes.iter().filter_map(|scene| scene.first_case()?.run(engine));
    let all: Vec<Option<f64>> = runs.map(|run| value(&run.metrics)).collect();
    let mut values: Vec<f64> = all.iter().copied().flatten().collect();
    values.sort_by(f64::total_cmp);
    let n_all = all.len() as f64;
    let points =
        values.iter().enumerate().map(|(index, value)| [*value, 100.0 * (index as f64 + 1.0) / n_all]);
    let points: Vec<[f64; 2]> = points.collect();
    (!points.is_empty()).then(|| Line {
        class: class_of(engine),
        name: engine.name().to_owned(),
        points,
        dots: false,
    })
}

fn parting(mazes: &[&SceneResult]) -> Option<Plot> {
    let lines: Vec<Line> = Contender::ALL
        .into_iter()
        .filter_map(|engine| distribution(mazes, engine, |metrics| metrics.diverged_s))
        .collect();
    (!lines.is_empty()).then(|| Plot {
        title: "Mazes parted from continuous (%)".to_owned(),
        x_label: "time (s)".to_owned(),
        x_scale: Scale::Linear,
        y_scale: Scale::Linear,
        x_ticks: Vec::new(),
        lines,
    })
}

fn liveliness(mazes: &[&SceneResult]) -> Plot {
    let lines = Contender::ALL
        .into_iter()
        .filter_map(|engine| distribution(mazes, engine, |metrics| Some(metrics.mean_speed)));
    Plot {
        title: "Mazes with at most this mean speed (%)".to_owned(),
        x_label: "corridors/s".to_owned(),
        x_scale: Scale::Linear,
        y_scale: Scale::Linear,
        x_ticks: Vec::new(),
        lines: lines.collect(),
    }
}

/// A column of a scene's table.
type Column = (&'static str, fn(&Metrics) -> Option<String>);

const COLUMNS: [Column; 12] = [
    ("off by", |m| Some(plain(m.errors.as_ref()?.position))),
    ("of the way", |m| Some(percent(m.errors.as_ref()?.position_part))),
    ("bounces", |m| Some(m.n_bounces.to_string())),
    ("angle off", |m| Some(format!("{}°", plain(m.errors.as_ref()?.angle_deg?)))),
    ("restitution", |m| Some(format!("{:.4}", m.first_bounce?.restitution))),
    ("deepest", |m| Some(plain(m.penetration_max))),
    ("p99", |m| Some(plain(m.penetration_p99))),
    ("tunnels", |m| Some(m.n_tunnels.to_string())),
    ("parted", |m| Some(format!("{} s", plain(m.diverged_s?)))),
    ("ns a tick", |m| Some(plain(m.ns_per_tick))),
    ("rest off by", |m| Some(plain(m.rest_error?))),
    ("rests", |m| Some(format!("{} s", plain(m.rest_s?)))),
];

/// One row an engine, of the first tick.
fn numbers(scene: &SceneResult, page: &mut String) {
    let Some(case) = scene.first_case() else { return };
    let used: Vec<&Column> = COLUMNS
        .iter()
        .filter(|(_, shown)| case.runs.iter().any(|run| shown(&run.metrics).is_some()))
        .collect();
    *page += "<div class=\"scroll\"><table><tr><th>Engine</th>";
    for (title, _) in &used {
        let _ = write!(page, "<th>{title}</th>");
    }
    *page += "</tr>";
    for run in &case.runs {
        let _ = write!(page, "<tr><td>{}</td>", swatch(run.engine));
        for (_, shown) in &used {
            let _ = write!(page, "<td>{}</td>", shown(&run.metrics).unwrap_or_else(|| "–".to_owned()));
        }
        *page += "</tr>";
    }
    *page += "</table></div>";
}
