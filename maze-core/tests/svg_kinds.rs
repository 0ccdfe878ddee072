//! F1, F7, F9, F12, F19, R11: SVG as people draw it, beside the plain lines of the same maze.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test that cannot go on has failed")]

use maze_core::import::svg::{self, SvgPlan};
use maze_core::layout::{Algorithm, Recipe};
use maze_core::{AssembleOptions, Blocks, Layout, Maze, export};
use proptest::prelude::*;
use proptest::sample::select;
use std::fmt::Write;

const CELL: f64 = 20.0;

fn layout(seed: u64) -> Layout {
    Recipe::new(6, 5, Algorithm::Wilson, seed).layout().unwrap().with_doors_top_and_bottom()
}

/// The walls of a layout, one a side of a cell, from the upper left; ends in cells.
fn walls(layout: &Layout) -> Vec<[[usize; 2]; 2]> {
    let blocks = Blocks::of_layout(layout);
    let (n_x, n_y) = (blocks.width(), blocks.height());
    let sides = (0..n_y).flat_map(|y| (0..n_x).map(move |x| (x, y))).filter(|(x, y)| (x + y) % 2 == 1);
    let walls = sides.filter(|(x, y)| blocks.is_wall(*x, n_y - 1 - y));
    walls
        .map(|(x, y)| {
            if y % 2 == 0 {
                [[x / 2, y / 2], [x / 2 + 1, y / 2]]
            } else {
                [[x / 2, y / 2], [x / 2, y / 2 + 1]]
            }
        })
        .collect()
}

/// How each wall is written.
#[derive(Clone, Copy, Debug)]
enum Form {
    Line,
    Polyline,
    Polygon,
    Path,
    RelativePath,
    OnePath,
    FilledRect,
    FilledPath,
    Used,
}

const FORMS: [Form; 9] = [
    Form::Line,
    Form::Polyline,
    Form::Polygon,
    Form::Path,
    Form::RelativePath,
    Form::OnePath,
    Form::FilledRect,
    Form::FilledPath,
    Form::Used,
];

fn body(layout: &Layout, form: Form) -> String {
    let at = |cells: usize| 3.0 + CELL * cells as f64;
    let mut text = String::new();
    let mut path = String::new();
    for [from, to] in walls(layout) {
        let [x1, y1, x2, y2] = [from[0], from[1], to[0], to[1]].map(at);
        let (left, top, right, bottom) = (x1 - 2.0, y1 - 2.0, x2 + 2.0, y2 + 2.0);
        let _ = match form {
            Form::Line => writeln!(text, r#"<line x1="{x1}" y1="{y1}" x2="{x2}" y2="{y2}"/>"#),
            Form::Polyline => writeln!(text, r#"<polyline points="{x1},{y1} {x2} {y2}"/>"#),
            Form::Polygon => writeln!(text, r#"<polygon points="{x1},{y1} {x2},{y2}"/>"#),
            Form::Path => writeln!(text, r#"<path d="M{x1} {y1}L{x2},{y2}"/>"#),
            Form::RelativePath => writeln!(text, r#"<path d="m {x1},{y1} {},{}"/>"#, x2 - x1, y2 - y1),
            Form::OnePath => {
                let _ = write!(path, "M{x1} {y1}");
                if y1 == y2 { write!(path, "H{x2}") } else { write!(path, "v{}", y2 - y1) }
            }
            Form::FilledRect => {
                let (width, height) = (right - left, bottom - top);
                writeln!(text, r#"<rect x="{left}" y="{top}" width="{width}" height="{height}"/>"#)
            }
            Form::FilledPath => {
                writeln!(text, r#"<path d="M{left},{top}H{right}V{bottom}H{left}z"/>"#)
            }
            Form::Used => {
                let id = if y1 == y2 { "level" } else { "upright" };
                writeln!(text, "<use xlink:href='#{id}' x='{x1}' y='{y1}'/>")
            }
        };
    }
    match form {
        Form::OnePath => format!("<path d=\"{path}\"/>"),
        Form::Used => format!(
            "<defs><line id='level' x2='{CELL}'/><g id='upright'><path d='M0 0V{CELL}'/></g></defs>{text}"
        ),
        _ => text,
    }
}

fn drawn(body: &str, form: Form, group: &str) -> String {
    let paint = match form {
        Form::FilledRect | Form::FilledPath => "fill=\"black\"",
        _ => "fill=\"none\" stroke=\"black\" stroke-width=\"4\" stroke-linecap=\"square\"",
    };
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" viewBox=\"0 0 126 106\">\n\
         {group}<g {paint}>\n{body}</g>\n</svg>"
    )
}

fn maze(text: &str) -> Maze {
    let plan = svg::read(text.as_bytes()).unwrap_or_else(|error| panic!("{error}: {text}"));
    plan.maze(&AssembleOptions::default()).unwrap()
}

/// The same passages: the same way and as many planes; walls may be of another thickness.
fn is_same(one: &Maze, other: &Maze) -> bool {
    let [a, b] =
        [one, other].map(|maze| maze.metrics().map(|metrics| (metrics.n_dead_ends, metrics.n_junctions)));
    a == b
        && one.planes.len() == other.planes.len()
        && one.openings.len() == other.openings.len()
        && one.is_solvable()
}

/// What is not painted, or in the paper's colour, in front of the walls: a grid that would close every cell.
const UNPAINTED: [&str; 14] = [
    "<style>.g{display:none}</style><g class='g' stroke='black'>GRID</g>",
    "<style>.g{stroke:none} .h{stroke:black}</style><g class='h'><g class='g'>GRID</g></g>",
    "<style>g.g > path{stroke:none}</style><g class='a g' stroke='black'>GRID</g>",
    "<style>#q{stroke:none;fill:none}</style><g id='q' stroke='#000'>GRID</g>",
    "<g style='stroke:#000;stroke-opacity:0'>GRID</g>",
    "<g opacity='0' stroke='#000'><g opacity='1'>GRID</g></g>",
    "<g stroke='#000' stroke-width='0'>GRID</g>",
    "<g stroke='transparent'>GRID</g>",
    "<g stroke='rgba(0,0,0,0)'>GRID</g>",
    "<g>GRID</g>",
    "<g stroke='#fff'>GRID</g>",
    "<g color='white' stroke='currentColor'>GRID</g>",
    "<g visibility='hidden' stroke='black'>GRID</g>",
    "<symbol stroke='black'>GRID</symbol><clipPath>GRID</clipPath><marker><path d='M0,0 L10,5 L0,10z'/></marker>",
];

proptest! {
    #![proptest_config(ProptestConfig { cases: 120, ..ProptestConfig::default() })]

    #[test]
    fn f7_f9_walls_in_any_form_are_the_walls_of_lines(seed in 0..1000_u64, form in select(&FORMS[..])) {
        let layout = layout(seed);
        let lines = maze(&drawn(&body(&layout, Form::Line), Form::Line, ""));
        let other = maze(&drawn(&body(&layout, form), form, ""));
        prop_assert!(is_same(&lines, &other), "{form:?}");
    }

    #[test]
    fn f19_what_is_not_painted_does_not_count(seed in 0..1000_u64, form in select(&FORMS[..]), unpainted in select(&UNPAINTED[..])) {
        let layout = layout(seed);
        let lines = maze(&drawn(&body(&layout, form), form, ""));
        let grid: String = (0..7).map(|k| format!("M3 {0}H123M{0} 3V103", 3 + 20 * k)).collect();
        let group = unpainted.replace("GRID", &format!("<path d='{grid}'/>"));
        let other = maze(&drawn(&body(&layout, form), form, &group));
        prop_assert!(is_same(&lines, &other), "{form:?} {unpainted}");
    }

    #[test]
    fn f9_backgrounds_marks_and_solutions_are_no_walls(seed in 0..1000_u64, form in select(&FORMS[..]), what in 0..7_usize) {
        let layout = layout(seed);
        let lines = maze(&drawn(&body(&layout, form), form, ""));
        let extra = [
            "<rect width='100%' height='100%' fill='white'/>",
            "<rect x='-9' y='-9' width='200' height='200' fill='#ffe0c0'/>",
            "<rect x='9' y='9' width='8' height='8' style='fill:blue'/>",
            "<circle cx='13' cy='13' r='5'/><text x='50' y='50' font-size='40'>S</text>",
            "<polyline points='63,3 63,13 53,13' style='stroke:red;stroke-width:3;fill:none'/>",
            "<ellipse cx='33' cy='33' rx='4' ry='3' fill='rgb(90,30,200)' stroke='navy'/>",
            "<g sodipodi:nodetypes='cc' inkscape:label='Layer' transform='translate(0 0)'/>",
        ][what];
        let other = maze(&drawn(&body(&layout, form), form, extra));
        prop_assert!(is_same(&lines, &other), "{form:?} {extra}");
    }
}

#[test]
fn f1_an_open_room_has_no_posts() {
    let room = "<svg><rect x='2' y='2' width='60' height='40' fill='none' stroke='black'/><path stroke='black' d='M22 2v20'/></svg>";
    let plan = svg::read(room.as_bytes()).unwrap();
    assert!(
        matches!(&plan, SvgPlan::Cells(cells) if cells.layout.width() == 3 || cells.layout.width() == 12)
    );
    let maze = plan.maze(&AssembleOptions::default()).unwrap();
    // Four walls and a stub with two sides and an end.
    assert_eq!(maze.planes.len(), 4 + 3 + 1, "{:?}", maze.planes.len());
    // A post that is drawn is there, and one that a generator leaves is drawn.
    let braided = Recipe { braid: 1.0, ..Recipe::new(12, 12, Algorithm::Prim, 4) }.layout().unwrap();
    let text = export::svg::write(&braided, None, "");
    assert!(
        text.contains("x1=")
            && text.lines().any(|line| {
                let number = |name: &str| {
                    line.split(&format!("{name}=\""))
                        .nth(1)
                        .and_then(|rest| rest.split('"').next().map(str::to_owned))
                };
                line.contains("<line") && number("x1") == number("x2") && number("y1") == number("y2")
            })
    );
    assert_eq!(self::maze(&text).planes, braided.maze(&AssembleOptions::default()).unwrap().planes);
}

#[test]
fn f12_a_polygon_around_a_maze_is_its_outer_wall() {
    let text = "<svg><polygon points='1,1 41,1 41,41 1,41' style='fill:white;stroke:black'/>\
                <path d='M1,21 L21,21 M21,11 L41,11 M21,31 L31,31' stroke='black' fill='none'/></svg>";
    let maze = maze(text);
    assert!(maze.is_solvable() && maze.openings.is_empty());
}

#[test]
fn f9_a_green_and_a_red_mark_are_start_and_goal() {
    let layout = layout(3);
    let marks = "<rect x='6' y='6' width='10' height='10' fill='#20b040'/><circle cx='113' cy='93' r='5' fill='#d02020'/>";
    for form in [Form::FilledRect, Form::Line] {
        let text = drawn(&format!("{}<g stroke='none'>{marks}</g>", body(&layout, form)), form, "");
        let plan = svg::read(text.as_bytes()).unwrap();
        assert!(plan.found().contains("start at the green spot, goal at the red spot"), "{}", plan.found());
        let maze = plan.maze(&AssembleOptions::default()).unwrap();
        let (start, goal) = (maze.start(), maze.goal());
        assert!(start.x < -2.5 && 2.0 < start.y && 2.5 < goal.x && goal.y < -2.0, "{start:?} {goal:?}");
    }
}

#[test]
fn f9_squares_of_a_bitmap_are_walls_and_white_squares_on_black_are_corridors() {
    let layout = layout(7);
    let blocks = Blocks::of_layout(&layout);
    let squares = |wall: bool, fill: &str| {
        let all = (0..blocks.height()).flat_map(|y| (0..blocks.width()).map(move |x| (x, y)));
        let of = all.filter(|(x, y)| blocks.is_wall(*x, blocks.height() - 1 - y) == wall);
        of.map(|(x, y)| format!("<rect x='{}' y='{}' width='10' height='10' fill='{fill}'/>", 10 * x, 10 * y))
            .collect::<String>()
    };
    let expected = blocks.maze(&AssembleOptions::default()).unwrap();
    let black = maze(&format!("<svg>{}</svg>", squares(true, "black")));
    let both = maze(&format!("<svg>{}{}</svg>", squares(false, "#f8f8f8"), squares(true, "#222")));
    let (width, height) = (10 * blocks.width(), 10 * blocks.height());
    let frame = format!("<path d='M0 0H{width}V{height}H0z'/>");
    let white = maze(&format!("<svg>{frame}{}</svg>", squares(false, "white")));
    for other in [black, both, white] {
        assert!(is_same(&expected, &other));
    }
}

#[test]
fn f7_walls_on_no_grid_are_taken_as_they_are_painted() {
    let text = "<svg><g stroke='black' fill='none' stroke-width='3'><polyline points='0,0 100,0 100,71 0,71 0,0'/>\
                <polyline points='0,23 77,23'/><polyline points='100,49 19,49'/></g></svg>";
    let plan = svg::read(text.as_bytes()).unwrap();
    assert!(matches!(plan, SvgPlan::Painted { .. }), "{plan:?}");
    assert!(plan.found().starts_with("walls as painted in #000000"));
    let maze = plan.maze(&AssembleOptions::default()).unwrap();
    assert!(maze.is_solvable() && maze.planes.len() == 6 + 6, "{}", maze.planes.len());
}

#[test]
fn f19_a_visible_child_of_a_hidden_group_is_seen_and_one_of_a_group_that_is_not_displayed_is_not() {
    let layout = layout(5);
    let lines = body(&layout, Form::Line);
    let plain = maze(&drawn(&lines, Form::Line, ""));
    let visible = lines.replace("<line", "<line visibility='visible'");
    let hidden = format!("<g visibility='hidden'>{visible}</g>");
    assert!(is_same(&plain, &maze(&drawn(&hidden, Form::Line, ""))));
    let gone = format!("<g display='none'>{visible}</g>");
    assert!(svg::read(drawn(&gone, Form::Line, "").as_bytes()).is_err());
}

#[test]
fn r11_much_of_anything_is_refused_with_its_line() {
    let cases = [
        (format!("<svg><path d=\"M0 0{}\"/></svg>", "h1v1".repeat(1 << 20)), "line 1: too many points"),
        (
            format!("<svg>\n<style>{}</style></svg>", "a{}".repeat(40_000)),
            "line 2: too many bytes of style sheets",
        ),
        (
            "<svg><g id='a'><use href='#a'/></g><use href='#a'/></svg>".to_owned(),
            "line 1: too many copies in copies",
        ),
        (
            format!(
                "<svg><g id='a'>{}</g>{}</svg>",
                "<line x2='1' stroke='black'/>".repeat(500),
                "<use href='#a'/>".repeat(500)
            ),
            "line 1: too many copied elements",
        ),
        (
            "<svg><use href='#nothing'/></svg>".to_owned(),
            "line 1: href=\"#nothing\" of <use>: expected the # and id",
        ),
    ];
    for (text, expected) in cases {
        let error = svg::read(text.as_bytes()).unwrap_err().to_string();
        assert!(error.starts_with(expected), "{error}");
    }
    // Closing what is closed adds nothing.
    let closed = format!("<svg><path d=\"M0 0{}\"/></svg>", "z".repeat(1 << 20));
    assert!(svg::read(closed.as_bytes()).unwrap_err().to_string().starts_with("no walls"));
}
