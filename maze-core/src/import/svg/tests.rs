use super::*;
use crate::export;
use crate::layout::{Door, Side, recursive_backtracker};

/// The smallest maze with a turn, as the site writes it: 2 x 2 cells, in at the top left, out at the bottom right.
const SMALL: &str = r##"<?xml version="1.0" standalone="no"?>
<!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" "http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd">
<svg width="36" height="36" version="1.1" xmlns="http://www.w3.org/2000/svg">
  <title>2 by 2 orthogonal maze</title>
  <g fill="none" stroke="#000000" stroke-width="2" stroke-linecap="square">
    <line x1="18" y1="2" x2="34" y2="2" />
    <line x1="2" y1="34" x2="18" y2="34" />
    <line x1="2" y1="2" x2="2" y2="34" />
    <line x1="18" y1="2" x2="18" y2="18" />
    <line x1="34" y1="2" x2="34" y2="34" />
  </g>
</svg>
"##;

const SOLUTION: &str = r##"<polyline fill="none" stroke="#ff0000" points="10,2 10,26 26,26 26,34" />"##;

fn loaded(text: &str) -> SvgMaze {
    read_cells(text.as_bytes()).unwrap()
}

fn message(text: &str) -> String {
    read_cells(text.as_bytes()).unwrap_err().to_string()
}

/// The small maze with something before the end.
fn with(extra: &str) -> String {
    SMALL.replace("</svg>", &format!("{extra}\n</svg>"))
}

/// Other strokes instead of the lines.
fn drawn(elements: &str) -> String {
    format!("<svg xmlns=\"http://www.w3.org/2000/svg\" fill=\"none\" stroke=\"black\">\n{elements}\n</svg>")
}

fn lines_of(text: &str) -> Vec<&str> {
    text.lines()
        .map(str::trim)
        .filter(|line| line.starts_with("<line") || line.starts_with("<polyline"))
        .collect()
}

#[test]
fn walls_doors_and_cells_are_found() {
    let maze = loaded(SMALL);
    let layout = &maze.layout;
    assert_eq!((layout.width(), layout.height()), (2, 2));
    assert_eq!((maze.cell, maze.corner), ([16.0; 2], [2.0; 2]));
    let doors: Vec<Door> = layout.doors().collect();
    assert_eq!(doors, [Door { side: Side::Bottom, index: 1 }, Door { side: Side::Top, index: 0 }]);
    assert!(!layout.is_open_east(0, 1) && layout.is_open_east(0, 0));
    assert!(layout.is_open_north(0, 0) && layout.is_open_north(1, 0));
}

#[test]
fn the_same_walls_in_other_words_are_the_same_maze() {
    let layout = loaded(SMALL).layout;
    let body = SMALL.split("linecap=\"square\">\n").nth(1).unwrap().split("  </g>").next().unwrap();
    let path = "M18,2H34M2 34h16M2,2V34M18 2L18 18M34,2l0,32";
    let others = [
        SMALL.replace('\n', "\r\n"),
        format!("\u{feff}{SMALL}"),
        SMALL.replace(" xmlns=\"http://www.w3.org/2000/svg\"", ""),
        SMALL.replace("<g fill", "<g transform=\"translate(-7.5 3) scale(0.625)\" fill"),
        SMALL.replace("<g fill", "<g transform=\"matrix(2 0 0 3 1 1)\" fill"),
        SMALL.replace("<g fill=\"none\" stroke=\"#000000\"", "<g style=\"fill:none; stroke: black\""),
        SMALL.replace(" />", " style=\"stroke:#000;stroke-width:2px\"></line>"),
        SMALL.replace("x1=\"18\"", "x1=\"18px\"").replace("y2=\"34\"", "y2='34.000'"),
        SMALL.replace("x1=\"18\" y1=\"2\" x2=\"34\" y2=\"2\"", "x1=\"34\" y1=\"2.1\" x2=\"18.3\" y2=\"2\""),
        SMALL.replace("  <title>", "<rect width=\"100%\" height=\"100%\" fill=\"white\"/><title>"),
        SMALL.replace("  <title>", "<!-- <line x1=\"nonsense\"/> --><defs><line x1=\"5\"/></defs><title>"),
        with(
            "<circle cx=\"10\" cy=\"10\" r=\"4\"/><text x=\"3\">line</text><g display=\"none\"><line x2=\"1\"/></g>",
        ),
        with("<line x1=\"3\" y1=\"4\" x2=\"9\" y2=\"5\" stroke=\"none\"/>"),
        drawn(&format!("<g>{}</g>", body.replace("<line", "<g><line").replace(" />", " /></g>"))),
        drawn(&format!("<path d=\"{path}\"/>")),
        drawn(&format!("<path stroke=\"black\" d=\"{path}\"/>{SOLUTION}")),
        drawn(
            "<polyline points=\"18,2 34,2 34,34\"/><polyline points=\"18,34 2,34 2,2\"/><polyline points=\"18,2 18,18\"/>",
        ),
        drawn(&format!("{body}<path d=\"M2 2v32h16\"/>")),
    ];
    for text in others {
        let other = loaded(&text);
        assert_eq!(other.layout, layout, "{text}");
    }
    let stretched = loaded(&SMALL.replace("<g fill", "<g transform=\"scale(1 1.5)\" fill"));
    assert_eq!((stretched.cell, stretched.corner), ([16.0, 24.0], [2.0, 3.0]));
}

#[test]
fn the_size_of_a_cell_is_the_one_that_all_gaps_are_multiples_of() {
    // A room of 5 x 2: nowhere are two walls one cell apart.
    let room = drawn(
        "<rect x=\"0\" y=\"0\" width=\"50\" height=\"20\" stroke=\"black\" fill=\"none\"/><path stroke=\"black\" d=\"M20 0v20\"/>",
    );
    let layout = loaded(&room).layout;
    assert_eq!((layout.width(), layout.height()), (5, 2));
    // Coordinates of a cell of 10/3, rounded to two digits.
    let thirds = recursive_backtracker(30, 20, 5).unwrap().with_doors_top_and_bottom();
    let text = export::svg::write(&thirds, None, "");
    let rounded = text.replace("<g ", "<g transform=\"scale(0.20833333)\" ");
    assert_eq!(loaded(&rounded).layout, thirds);
    let rounded: String = text
        .split('"')
        .enumerate()
        .map(|(n, word)| match word.parse::<f64>() {
            Ok(number) if n % 2 == 1 && 20 < n => format!("\"{:.2}\"", number * 0.208_333_33),
            _ if n % 2 == 1 => format!("\"{word}\""),
            _ => word.to_owned(),
        })
        .collect();
    assert_eq!(loaded(&rounded).layout, thirds);
}

#[test]
fn written_and_read_again_it_is_the_same_with_the_same_lines() {
    for (width, height, seed) in [(1, 2, 1), (2, 1, 1), (7, 5, 3), (20, 20, 4), (200, 200, 5)] {
        let layout = recursive_backtracker(width, height, seed).unwrap().with_doors_top_and_bottom();
        let path = layout.shortest_path((height - 1) * width + (width - 1) / 2, width / 2).unwrap();
        let text = export::svg::write(&layout, Some(&path), "a <b> & c");
        let maze = loaded(&text);
        assert_eq!((&maze.layout, maze.cell, maze.corner), (&layout, [16.0; 2], [2.0; 2]));
        assert_eq!(maze.solution.as_ref(), Some(&path));
        assert_eq!(export::svg::write(&maze.layout, maze.solution.as_deref(), "a <b> & c"), text);
    }
}

#[test]
fn the_small_maze_is_written_as_it_was_read() {
    let maze = loaded(&with(SOLUTION));
    let text = export::svg::write(&maze.layout, maze.solution.as_deref(), "");
    assert_eq!(lines_of(&text)[..5], lines_of(SMALL)[..]);
    assert!(text.contains("points=\"10,2 10,26 26,26 26,34\""), "{text}");
}

#[test]
fn the_drawn_solution_must_be_a_shortest_way() {
    assert_eq!(loaded(&with(SOLUTION)).solution, Some(vec![2, 0, 1]));
    // Its ends may be the middles of the end cells.
    assert_eq!(loaded(&with(&SOLUTION.replace("10,2 ", "10,10 "))).solution, Some(vec![2, 0, 1]));
    let through = with(&SOLUTION.replace("10,26 26,26", "10,10 26,10"));
    assert_eq!(message(&through), "line 12: the solution line goes through a wall at (26, 10)");
    let no_door = with(&SOLUTION.replace("10,2 ", "26,2 26,10 26,26 "));
    assert_eq!(message(&no_door), "line 12: the solution line goes through a wall at (26, 2)");
    let there_and_back = with(&SOLUTION.replace("26,26 26,34", "26,26 26,10 26,26 26,34"));
    assert_eq!(
        message(&there_and_back),
        "line 12: the solution line is 5 cells long, the shortest path between its ends 3"
    );
    assert!(
        message(&with(&SOLUTION.replace("26,26", "26,29"))).starts_with("line 12: (26, 29) lies on no grid")
    );
}

#[test]
fn other_kinds_of_maze_are_refused_by_name() {
    let arcs = with("<path stroke=\"black\" d=\"M 147,241 A 80,80 0 1,1 163,243\"/>");
    assert_eq!(
        message(&arcs),
        "line 12: a circular (theta) maze, its walls are arcs: expected a rectangular maze"
    );
    let slanted = with("<line x1=\"2\" y1=\"2\" x2=\"10\" y2=\"16\" stroke=\"#000000\" />");
    assert!(
        message(&slanted).contains("line 12: a maze of other cells than squares"),
        "{}",
        message(&slanted)
    );
    assert!(message(&slanted).contains("hexagonal (sigma) or triangular (delta) ones: 1 of 6 walls"));
    let passages = drawn(
        "<polyline points=\"26,2 26,10 10,10 10,42 42,42 42,26\"/><polyline points=\"26,42 26,50\"/>\
         <polyline points=\"26,10 42,10\"/><polyline points=\"26,42 26,26\"/>",
    );
    assert!(message(&passages).starts_with("draws the passages, not the walls"), "{}", message(&passages));
    assert!(message(&drawn("<path d=\"M0 0C1 1 2 2 3 3\"/>")).contains("a drawing of curves"));
    assert!(message(&drawn("<path d=\"M2 2h16\"/><image width=\"4\"/>")).contains("<image>: expected walls"));
    let half = SMALL
        .replace("<line x1=\"34\"", "<path x1=\"34\"")
        .replace("x2=\"18\" y2=\"34\"", "x2=\"2\" y2=\"34\"");
    assert!(message(&half).starts_with("the outer wall is open at"), "{}", message(&half));
}

#[test]
fn what_is_no_svg_is_told_with_the_line() {
    assert_eq!(message(" \n"), "the file is empty: expected an SVG");
    assert_eq!(message("<html>\n</html>"), "line 1: the root element is <html>: expected <svg>");
    assert!(message("hello").starts_with("line 1: not well-formed XML"));
    assert_eq!(
        message(&SMALL[..SMALL.len() - 8]),
        "line 11: not well-formed XML (the file ends inside an element): expected an SVG"
    );
    let mismatched = message(&SMALL.replace("</g>", "</h>"));
    assert!(
        mismatched.starts_with("line 11: not well-formed XML (") && mismatched.contains("`</h>`"),
        "{mismatched}"
    );
    assert_eq!(read_cells(b"<svg>\n\xff</svg>").unwrap_err(), SvgError::NotText { line: 2 });
    assert_eq!(message(&drawn("")), "no walls: expected lines or areas that are painted and seen");
    assert_eq!(message(&drawn("<line/>")).split(':').next(), Some("no walls"));
    assert_eq!(
        message(&SMALL.replace("y1=\"2\" x2=\"2\"", "y1=\"NaN\" x2=\"2\"")),
        "line 8: y1=\"NaN\" of <line>: expected a number of at most 1e12"
    );
    assert!(
        message(&SMALL.replace("x2=\"34\" y2=\"2\"", "x2=\"1e13\" y2=\"2\"")).contains("line 6: x2=\"1e13\"")
    );
    assert!(
        message(&SMALL.replace("<g fill", "<g transform=\"turn(45)\" fill"))
            .contains("transform=\"turn(45)\"")
    );
    assert!(message(&drawn("<path d=\"M 1 2 L 3\"/>")).contains("line 2: d=\"M 1 2 L 3\" of <path>"));
    assert!(message(&drawn("<polyline points=\"1,2 3\"/>")).contains("points=\"1,2 3\""));
    let far = SMALL.replace("x2=\"34\" y2=\"2\"", "x2=\"1000000000\" y2=\"2\"");
    assert!(message(&far).contains("lie on no grid of equal cells"), "{}", message(&far));
    let comb: String = (0..1500).map(|x| format!("M{x} 0v1")).collect();
    let error = message(&drawn(&format!("<path d=\"{comb}\"/>")));
    assert_eq!(error, "a maze of 1499x1 cells: expected at least 2 cells and at most 1024 on a side");
    assert!(
        message(&with("<line x1=\"5\" y1=\"2\" x2=\"34\" y2=\"2\" stroke=\"#000001\"/>"))
            .contains("line 12: (5, 2) lies on no grid")
    );
    let uneven = drawn("<path d=\"M0 0h100v100h-100zM0 3h100M0 11h100M7 0v100\"/>");
    assert!(message(&uneven).contains("lie on no grid of equal cells"), "{}", message(&uneven));
}

#[test]
fn entities_are_refused_before_they_grow() {
    let bomb =
        "<!DOCTYPE svg [\n<!ENTITY a \"aaaaaaaaaa\">\n<!ENTITY b \"&a;&a;&a;&a;&a;&a;\">\n]>\n<svg>&b;</svg>";
    assert_eq!(message(bomb), "line 2: declares an entity: expected an SVG without");
}

#[test]
fn depth_and_number_of_elements_do_no_harm() {
    let deep = |n: usize| with(&format!("{}{}", "<g>".repeat(n), "</g>".repeat(n)));
    assert_eq!(loaded(&deep(900)).layout, loaded(SMALL).layout);
    assert!(message(&deep(1000)).starts_with("line 12: not well-formed XML (more than 1000 elements inside"));
    let attributes: String = (0..50_000).map(|n| format!(" a{n}=\"1\"")).collect();
    assert_eq!(loaded(&with(&format!("<g{attributes}/>"))).layout, loaded(SMALL).layout);
    let many = "<line x1=\"2\" y1=\"2\" x2=\"2\" y2=\"34\" stroke=\"#000000\"/>".repeat(100_000);
    assert_eq!(loaded(&with(&many)).layout, loaded(SMALL).layout);
}

#[test]
fn a_file_cut_anywhere_is_a_maze_or_a_reason_and_never_a_panic() {
    let text = with(SOLUTION);
    for end in 0..text.len() {
        let _ = read_cells(&text.as_bytes()[..end]);
    }
}
