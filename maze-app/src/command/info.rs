//! `maze-app info`: what was found in a maze file.

use crate::failure::Failure;
use crate::loaded::Loaded;
use crate::measures;
use crate::platform::native::files;
use crate::source::{KnownMazeArguments, Source};
use clap::Args;
use maze_core::{BallSpec, FaceNote, Facing, Maze, Plane, Radius};
use serde_json::{Map, Value, json};

#[derive(Args)]
#[command(after_help = "Examples:\n  maze-app info my_maze.obj\n  maze-app info my_maze.svg --json\n  \
                        maze-app info my_maze.obj --planes +y\n  maze-app info --level 3\n\n\
                        Exit status 1 when no path leads from start to goal.")]
pub(crate) struct Arguments {
    #[command(flatten)]
    maze: KnownMazeArguments,
    /// One JSON object instead of text
    #[arg(long)]
    json: bool,
    /// The sorted table of one group instead: +x, -x, +y or -y
    #[arg(long, value_name = "FACING", value_parser = parse_facing, allow_hyphen_values = true)]
    planes: Option<Facing>,
}

/// Most openings that are listed one by one in text: a maze has two or a few more.
const MOST_OPENINGS: usize = 12;

fn parse_facing(text: &str) -> Result<Facing, String> {
    let known = Facing::ALL.into_iter().find(|facing| facing.name() == text);
    known.ok_or_else(|| "expected +x, -x, +y or -y".to_owned())
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let source = Source::known(&arguments.maze)?;
    let Loaded { maze, found } = source.load_and_tell()?;
    let text = match (arguments.planes, arguments.json) {
        (Some(facing), true) => {
            format!("{}\n", json!({ "facing": facing.name(), "planes": table(&maze, facing) }))
        }
        (Some(facing), false) => table_text(&maze, facing),
        (None, true) => format!("{}\n", summary(&maze, found.as_deref())),
        (None, false) => {
            found.map_or_else(String::new, |found| format!("found        {found}\n")) + &summary_text(&maze)
        }
    };
    files::print(&text)?;
    if maze.is_solvable() { Ok(()) } else { Err(no_path(&source, &maze)) }
}

/// No path leads from start to goal; where a smaller ball has one, which.
pub(crate) fn no_path(source: &Source, maze: &Maze) -> Failure {
    let hint =
        maze.report.passing_radius.map(|radius| format!("; a ball of radius {} passes", radius.units()));
    let hint = hint.unwrap_or_default();
    Failure::not_held(format!("{}: no path leads from start to goal{hint}", source.name()))
}

fn table(maze: &Maze, facing: Facing) -> Vec<[f64; 3]> {
    maze.planes.planes(facing).map(|plane| [plane.offset, plane.start, plane.end]).collect()
}

/// The report's Fig. 5: the group in the order in which it is searched.
fn table_text(maze: &Maze, facing: Facing) -> String {
    let [across, along] = axes(facing);
    let mut lines = vec![
        format!("planes facing {}, sorted by offset, start, end (maze units)", facing.name()),
        format!(
            "{:>6} {across:>12} {:>12} {:>12}",
            "index",
            format!("{along} start"),
            format!("{along} end")
        ),
    ];
    lines.extend(maze.planes.planes(facing).enumerate().map(|(index, Plane { offset, start, end, .. })| {
        format!("{index:>6} {offset:>12.6} {start:>12.6} {end:>12.6}")
    }));
    lines.join("\n") + "\n"
}

/// Names of the axes along and across a facing's normal.
fn axes(facing: Facing) -> [&'static str; 2] {
    if facing.axis() == 0 { ["x", "y"] } else { ["y", "x"] }
}

fn by_facing(count: impl Fn(Facing) -> usize) -> Value {
    Value::Object(
        Facing::ALL
            .map(|facing| (facing.name().to_owned(), json!(count(facing))))
            .into_iter()
            .collect::<Map<_, _>>(),
    )
}

fn summary(maze: &Maze, found: Option<&str>) -> Value {
    let point = |point: nalgebra::Vector2<f64>| json!([point.x, point.y]);
    let notes = |notes: &[FaceNote]| {
        let note = |note: &FaceNote| {
            json!({
                "reason": note.reason.to_string(),
                "faces": note.n_faces,
                "first_face": note.first_face,
                "area_part": note.area_fraction,
                "drawn_not_met": note.is_unmet,
            })
        };
        notes.iter().map(note).collect::<Vec<_>>()
    };
    let openings = maze.openings.iter().map(|opening| {
        json!({ "facing": opening.facing.name(), "offset": opening.offset, "start": opening.start, "end": opening.end })
    });
    json!({
        "found": found,
        "planes": by_facing(|facing| maze.planes.n_planes(facing)),
        "rows": by_facing(|facing| maze.planes.n_rows(facing)),
        "bounds": { "low": point(maze.bounds.low), "high": point(maze.bounds.high) },
        "wall_height": maze.wall_height,
        "up_axis": maze.report.up_axis.name(),
        "scale": maze.report.scale,
        "ball_radius": maze.ball_radius.units(),
        "passing_radius": maze.report.passing_radius.map(Radius::units),
        "start": point(maze.start()),
        "goal": point(maze.goal()),
        "solvable": maze.is_solvable(),
        "way_length": maze.path_length(),
        "metrics": maze.metrics().as_ref().map(measures::json),
        "openings": openings.collect::<Vec<_>>(),
        "has_floor": maze.report.has_floor,
        "doubtful_part": maze.report.doubtful_fraction,
        "ignored": notes(&maze.report.ignored),
        "adjusted": notes(&maze.report.adjusted),
        "merged_within": maze.report.merged_within,
        "thickened_to": maze.report.thickened_to,
        "turned_degrees": turned_degrees(maze),
    })
}

fn summary_text(maze: &Maze) -> String {
    let counts = |count: &dyn Fn(Facing) -> usize| {
        let each = Facing::ALL.map(|facing| format!("{} {}", facing.name(), count(facing)));
        each.join(", ")
    };
    let size = maze.bounds.size();
    let mut lines = vec![
        format!("planes       {} ({})", maze.planes.len(), counts(&|facing| maze.planes.n_planes(facing))),
        format!("rows         {}", counts(&|facing| maze.planes.n_rows(facing))),
        format!("bounds       {:.3} x {:.3} corridors, walls {:.3} high", size.x, size.y, maze.wall_height),
        format!(
            "up axis      {} (1 unit of the file is {:.6} corridors)",
            maze.report.up_axis.name(),
            maze.report.scale
        ),
        ball_line(maze),
        format!("start        {:.3}, {:.3}", maze.start().x, maze.start().y),
        format!("goal         {:.3}, {:.3}", maze.goal().x, maze.goal().y),
        format!("solvable     {}", maze.is_solvable()),
    ];
    lines.extend(measures::lines(maze));
    lines.extend(maze.openings.iter().take(MOST_OPENINGS).map(|opening| {
        let [across, along] = axes(opening.facing);
        format!(
            "opening      at {across} = {:.3}, {along} from {:.3} to {:.3} (closed to the ball by a low bar)",
            opening.offset, opening.start, opening.end
        )
    }));
    if let Some(n_more) = maze.openings.len().checked_sub(MOST_OPENINGS).filter(|n_more| 0 < *n_more) {
        lines.push(format!("opening      and {n_more} more"));
    }
    if !maze.report.has_floor {
        lines.push("floor        none in the file: one was laid".to_owned());
    }
    if 0.0 < maze.report.doubtful_fraction {
        lines.push(format!(
            "doubtful     on {:.2} % of the plan, for lack of a face, three of four sides decided what is wall",
            100.0 * maze.report.doubtful_fraction
        ));
    }
    lines.extend(adjustments(maze));
    lines.join("\n") + "\n"
}

fn ball_line(maze: &Maze) -> String {
    let radius = maze.ball_radius.units();
    match maze.report.passing_radius {
        Some(_) if maze.is_solvable() => format!(
            "ball radius  {radius} (the largest that passes, in hundredths of a corridor; the usual {} does not)",
            BallSpec::RADIUS.units()
        ),
        Some(passing) => {
            format!("ball radius  {radius} (does not pass; the largest that does has {})", passing.units())
        }
        None => format!("ball radius  {radius}"),
    }
}

/// By how much the walls were turned in the file, counter-clockwise seen from above.
fn turned_degrees(maze: &Maze) -> f64 {
    maze.report.turned.y.atan2(maze.report.turned.x).to_degrees()
}

/// What of the file is not as it was.
fn adjustments(maze: &Maze) -> Vec<String> {
    let mut lines = Vec::new();
    if maze.report.turned.y != 0.0 {
        let degrees = turned_degrees(maze);
        lines.push(format!(
            "turned       the walls stand {degrees:.2} degrees off the file's axes: turned back"
        ));
    }
    if let Some(within) = maze.report.merged_within {
        lines.push(format!("merged       walls less than {within:.4} corridors out of line are in one line"));
    }
    if let Some(thickness) = maze.report.thickened_to {
        lines.push(format!("thickened    walls without thickness are {thickness:.3} corridors thick"));
    }
    for (word, notes) in [("adjusted", &maze.report.adjusted), ("ignored", &maze.report.ignored)] {
        lines.extend(notes.iter().map(|note| {
            let percent = 100.0 * note.area_fraction;
            format!("{word:<12} {} faces, {percent:.1} % of the area: {}", note.n_faces, note.reason)
        }));
    }
    lines
}
