//! `maze-verify`: the cross-check on the command line.

mod benchmark;
mod files;

use clap::{Args, Parser, Subcommand, builder::PossibleValuesParser};
use indicatif::{ProgressBar, ProgressStyle};
use maze_core::printable;
use maze_verify::results::{Partition, Results};
use maze_verify::scene::{self, Scene};
use maze_verify::{Contender, bench, build, model_error, report, run};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Our engines, rapier3d and closed form on the same scenes.
#[derive(Parser)]
#[command(name = "maze-verify", version)]
struct CommandLine {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Lists the scenes, the engines and the contenders of the benchmark
    List,
    /// Runs scenes and says whether every tolerance holds (exit status 1 when not)
    ///
    /// Example: maze-verify run --scene 'corner-*' --out target/report
    Run(RunArguments),
    /// Times our searches beside what else a user would pick (exit status 1 when answers differ that must not)
    ///
    /// Example: maze-verify bench --quick --out target/bench
    Bench(benchmark::BenchArguments),
    /// Joins the parts of a run that was split with --partition
    ///
    /// Example: maze-verify merge part1 part2 --out whole
    Merge {
        /// Directories with a results.json each
        #[arg(required = true, value_name = "DIR")]
        parts: Vec<PathBuf>,
        #[command(flatten)]
        output: OutputArguments,
    },
}

#[derive(Args)]
struct RunArguments {
    /// Scenes of one's own (see docs/verification.md) instead of the named ones
    #[arg(value_name = "FILE.toml")]
    files: Vec<PathBuf>,
    /// Only scenes whose name holds this, or matches it when it has * or ? [repeatable]
    #[arg(long, value_name = "NAME")]
    scene: Vec<String>,
    /// Only this engine [repeatable]
    #[arg(long, value_name = "NAME", value_parser = PossibleValuesParser::new(Contender::ALL.map(Contender::name)))]
    engine: Vec<String>,
    /// Only every N-th scene, from the K-th on: one part of N for N machines
    #[arg(long, value_name = "K/N", value_parser = parse_partition, default_value = "1/1")]
    partition: Partition,
    #[command(flatten)]
    output: OutputArguments,
}

#[derive(Args)]
struct OutputArguments {
    /// Writes results.json and report.html there
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Prints results.json instead of the table
    #[arg(long)]
    json: bool,
}

/// Why there is no result: one line, exit status 2.
struct BadInput(String);

fn main() -> ExitCode {
    let command_line = match CommandLine::try_parse() {
        Ok(command_line) => command_line,
        Err(error) => return usage(&error),
    };
    let done = match command_line.command {
        Command::List => list(),
        Command::Run(arguments) => run_scenes(&arguments),
        Command::Bench(arguments) => benchmark::bench(&arguments),
        Command::Merge { parts, output } => merge(&parts, &output),
    };
    match done {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(1),
        Err(BadInput(reason)) => refuse(&reason),
    }
}

/// One line that does no harm, and exit status 2; where nobody can read it the status still tells.
fn refuse(reason: &str) -> ExitCode {
    let _ = writeln!(std::io::stderr(), "error: {}", printable(reason));
    ExitCode::from(2)
}

/// Help and version go to stdout as they are; what is wrong becomes one line.
fn usage(error: &clap::Error) -> ExitCode {
    if !error.use_stderr() {
        return files::print(&error.to_string())
            .map_or_else(|BadInput(reason)| refuse(&reason), |()| ExitCode::SUCCESS);
    }
    let text = error.to_string();
    let reason = text.split("\n\n").next().unwrap_or_default();
    refuse(&format!("{} (see --help)", reason.trim_start().trim_start_matches("error:")))
}

fn list() -> Result<bool, BadInput> {
    let mut text = String::from("Engines\n");
    for engine in Contender::ALL {
        text += &format!("  {:<22} {}\n", engine.name(), engine.about());
    }
    text += "\nScenes\n";
    for scene in scene::catalogue().map_err(BadInput)? {
        text += &format!("  {:<22} {}\n", scene.name, scene.about);
    }
    text += "\nContenders of the benchmark\n";
    for contender in bench::search::CONTENDERS {
        text += &format!("  {:<22} {}\n", contender.name, contender.about);
    }
    files::print(&text).map(|()| true)
}

fn run_scenes(arguments: &RunArguments) -> Result<bool, BadInput> {
    let all = chosen_scenes(arguments)?;
    let n_scenes = all.len();
    let part: Vec<(usize, Scene)> =
        all.into_iter().enumerate().filter(|(index, _)| arguments.partition.has(*index)).collect();
    let engines: Vec<Contender> = Contender::ALL
        .into_iter()
        .filter(|engine| {
            arguments.engine.is_empty() || arguments.engine.iter().any(|name| name == engine.name())
        })
        .collect();
    if let Some(out) = &arguments.output.out {
        files::make_directory(out)?;
    }
    let bar = ProgressBar::new(part.len() as u64);
    // The template is ours and known to be good; a plain bar is no harm either.
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {pos}/{len} {msg}") {
        bar.set_style(style);
    }
    let on_scene = |name: &str| {
        bar.set_message(name.to_owned());
        bar.inc(1);
    };
    let scenes = run(&part, &engines, &build, &on_scene).map_err(|error| BadInput(error.to_string()))?;
    // It is about the method and not about scenes: once a run, when the whole catalogue is asked for.
    let wants_model_error = arguments.partition.k == 1
        && arguments.files.is_empty()
        && arguments.scene.is_empty()
        && engines.contains(&Contender::RapierRolling);
    let model_error = match wants_model_error {
        true => Some(model_error::measure().map_err(|error| BadInput(error.to_string()))?),
        false => None,
    };
    bar.finish_and_clear();
    deliver(&Results::new(arguments.partition, n_scenes, scenes, model_error), &arguments.output)
}

fn chosen_scenes(arguments: &RunArguments) -> Result<Vec<Scene>, BadInput> {
    let mut scenes =
        if arguments.files.is_empty() { scene::catalogue().map_err(BadInput)? } else { Vec::new() };
    for path in &arguments.files {
        let text = files::read_text(path)?;
        let read = scene::read(&text).map_err(|error| files::in_file(path, error))?;
        for scene in read {
            // Told with the file's name before anything runs.
            scene.set_up().map_err(|error| files::in_file(path, format!("scene {}: {error}", scene.name)))?;
            if scenes.iter().any(|known| known.name == scene.name) {
                return Err(files::in_file(path, format!("there is a scene {} already", scene.name)));
            }
            scenes.push(scene);
        }
    }
    let wanted = |scene: &Scene| {
        arguments.scene.is_empty() || arguments.scene.iter().any(|pattern| is_match(pattern, &scene.name))
    };
    scenes.retain(wanted);
    if scenes.is_empty() {
        return Err(BadInput("no scene has such a name: `maze-verify list` shows all".to_owned()));
    }
    Ok(scenes)
}

/// A name holds a plain pattern; one with * (anything) or ? (one letter) has to match it whole.
fn is_match(pattern: &str, name: &str) -> bool {
    if !pattern.contains(['*', '?']) {
        return name.contains(pattern);
    }
    let (pattern, name) = (pattern.as_bytes(), name.as_bytes());
    let (mut p, mut n) = (0, 0);
    // The last star, and where what it stands for ends: only that star has to take back, so the time is a product.
    let mut star: Option<(usize, usize)> = None;
    while n < name.len() {
        match (pattern.get(p), star) {
            (Some(b'*'), _) => {
                star = Some((p, n));
                p += 1;
            }
            (Some(letter), _) if *letter == b'?' || *letter == name[n] => {
                p += 1;
                n += 1;
            }
            (_, Some((at, end))) => {
                star = Some((at, end + 1));
                p = at + 1;
                n = end + 1;
            }
            _ => return false,
        }
    }
    pattern[p..].iter().all(|letter| *letter == b'*')
}

fn parse_partition(text: &str) -> Result<Partition, String> {
    let pair = text.split_once('/').and_then(|(k, n)| Some((k.parse().ok()?, n.parse().ok()?)));
    let partition = pair.map(|(k, n)| Partition { k, n });
    partition
        .filter(|part| 1 <= part.k && part.k <= part.n && part.n <= Partition::MAX)
        .ok_or_else(|| "expected K/N with 1 <= K <= N, such as 2/4".to_owned())
}

fn merge(parts: &[PathBuf], output: &OutputArguments) -> Result<bool, BadInput> {
    let read = |directory: &PathBuf| {
        let path = directory.join("results.json");
        let text = files::read_text(&path)?;
        let schema: SchemaOnly = serde_json::from_str(&text).map_err(|error| files::in_file(&path, error))?;
        if schema.schema != maze_verify::results::SCHEMA {
            let expected = maze_verify::results::SCHEMA;
            return Err(files::in_file(&path, format!("schema {}, expected {expected}", schema.schema)));
        }
        serde_json::from_str::<Results>(&text).map_err(|error| files::in_file(&path, error))
    };
    let parts = parts.iter().map(read).collect::<Result<Vec<_>, _>>()?;
    let whole = Results::merge(parts).map_err(BadInput)?;
    if let Some(out) = &output.out {
        files::make_directory(out)?;
    }
    deliver(&whole, output)
}

/// What tells whether the rest can be read.
#[derive(serde::Deserialize)]
struct SchemaOnly {
    schema: u32,
}

/// Prints and writes; whether every tolerance holds.
fn deliver(results: &Results, output: &OutputArguments) -> Result<bool, BadInput> {
    let json =
        serde_json::to_string(results).map_err(|error| BadInput(format!("results.json: {error}")))? + "\n";
    if let Some(out) = &output.out {
        files::write_whole(&out.join("results.json"), json.as_bytes())?;
        files::write_whole(&out.join("report.html"), report::html(results).as_bytes())?;
    }
    if output.json {
        files::print(&json)?;
    } else {
        files::print(&report::table(results))?;
        files::print(&closing_line(results, output.out.as_deref()))?;
    }
    Ok(results.held())
}

fn closing_line(results: &Results, out: Option<&Path>) -> String {
    let n_missed = results.verdicts.iter().filter(|verdict| !verdict.missed.is_empty()).count();
    let n_tolerances = results.verdicts.len();
    let verdict = match n_missed {
        0 => format!("all {n_tolerances} tolerances hold"),
        _ => format!("{n_missed} of {n_tolerances} tolerances missed"),
    };
    let report = out.map_or_else(String::new, |out| format!("; {}", out.join("report.html").display()));
    format!("\n{} scenes, {verdict}{report}\n", results.scenes.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_match_by_part_or_by_pattern() {
        assert!(is_match("corner", "corner-01") && is_match("01", "corner-01"));
        assert!(is_match("corner-0?", "corner-01") && is_match("*-01", "corner-01") && is_match("*", "x"));
        assert!(!is_match("corner-*", "concave-corner") && !is_match("c?", "corner"));
        assert!(
            is_match("*a*b?", "xaxbxaby")
                && !is_match("*a*b?", "xaxb")
                && is_match("**", "")
                && !is_match("?", "")
        );
        // R10: with many stars the time grew without end.
        assert!(!is_match(&("*".repeat(40) + "zzz"), &"y".repeat(200)));
        assert!(!is_match(&"*a".repeat(40), &"a".repeat(39)));
    }

    #[test]
    fn partitions_are_read_and_checked() {
        assert_eq!(parse_partition("2/3"), Ok(Partition { k: 2, n: 3 }));
        for bad in ["0/3", "4/3", "1", "a/b", "1/0", "-1/2"] {
            assert!(parse_partition(bad).is_err(), "{bad}");
        }
    }
}
