//! F11: one random maze, written in any of the ways in which people write them, is read as the same maze.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test that cannot go on has failed")]

use maze_core::import::text::{self, TextMaze, TextOptions};
use maze_core::layout::{Algorithm, Recipe};
use maze_core::{AssembleOptions, Blocks, Layout};
use proptest::prelude::*;
use proptest::sample::select;

/// A maze of cells with start and goal, or with doors at the top and the bottom.
#[derive(Clone, Debug)]
struct Case {
    layout: Layout,
    ends: Option<[[usize; 2]; 2]>, // cells as x and y, counted from the upper left
}

impl Case {
    /// Whether block (x, y) from the upper left is wall; posts and cells in turn.
    fn is_wall(&self, x: usize, y: usize) -> bool {
        Blocks::of_layout(&self.layout).is_wall(x, 2 * self.layout.height() - y)
    }

    /// Without loops: in a hall nothing shows where cells are, unless corners are drawn.
    fn is_perfect(&self) -> bool {
        self.layout.n_passages() + 1 == self.layout.width() * self.layout.height()
    }

    fn size(&self) -> [usize; 2] {
        [self.layout.width(), self.layout.height()]
    }
}

fn case() -> impl Strategy<Value = Case> {
    let algorithms = vec![Algorithm::Backtracker, Algorithm::Prim, Algorithm::Wilson, Algorithm::Eller];
    let ends = ([0_usize..1000, 0..1000], [0_usize..1000, 0..1000]);
    let what = (3..14_usize, 3..12_usize, select(algorithms), any::<u64>(), select(&[0.0, 0.3][..]));
    (what, proptest::option::of(ends)).prop_map(|((width, height, algorithm, seed, braid), ends)| {
        let recipe = Recipe { braid, ..Recipe::new(width, height, algorithm, seed) };
        let layout = recipe.layout().unwrap();
        let ends = ends.map(|ends| {
            let cell = |[x, y]: [usize; 2]| [x % width, y % height];
            let (start, goal) = (cell(ends.0), cell(ends.1));
            [start, if start == goal { [(goal[0] + 1) % width, goal[1]] } else { goal }]
        });
        let layout = if ends.is_some() { layout } else { layout.with_doors_top_and_bottom() };
        Case { layout, ends }
    })
}

/// The signs of wall, free, start and goal.
type Signs = [&'static str; 4];

const SIGNS: [Signs; 18] = [
    ["#", " ", "S", "G"],
    ["#", ".", "S", "E"],
    ["#", " ", "A", "B"],
    ["#", "_", "a", "b"],
    ["#", " ", "I", "O"],
    ["%", " ", "P", "."],
    ["X", "_", "S", "G"],
    ["X", " ", "P", "K"],
    ["x", ".", "s", "f"],
    ["█", " ", "S", "E"],
    ["■", "□", "S", "T"],
    ["⬛", "⬜", "🟩", "🟥"],
    ["1", "0", "2", "3"],
    ["0", "1", "2", "3"],
    ["1", "0", "S", "G"],
    ["*", " ", "@", "$"],
    ["w", "c", "S", "E"],
    ["#", "-", "1", "2"],
];

/// Rows of one sign a block.
fn rows(case: &Case, [wall, free, start, goal]: Signs) -> Vec<Vec<&'static str>> {
    let [width, height] = case.size();
    let at = |ends: [usize; 2]| [2 * ends[0] + 1, 2 * ends[1] + 1];
    let sign = |x: usize, y: usize| match case.ends.map(|ends| ends.map(at)) {
        _ if case.is_wall(x, y) => wall,
        Some([end, _]) if end == [x, y] => start,
        Some([_, end]) if end == [x, y] => goal,
        _ => free,
    };
    (0..=2 * height).map(|y| (0..=2 * width).map(|x| sign(x, y)).collect()).collect()
}

/// How the rows of blocks are written.
#[derive(Clone, Copy, Debug)]
enum Form {
    Plain,
    Joined(&'static str),
    Trailing(&'static str),
    List([&'static str; 5]), // before all, before a row, between cells, behind a row, behind all
    Strings([&'static str; 2]),
    Doubled,
}

const FORMS: [Form; 12] = [
    Form::Plain,
    Form::Joined(" "),
    Form::Joined(","),
    Form::Joined(", "),
    Form::Joined(";"),
    Form::Joined("\t"),
    Form::Trailing(" "),
    Form::List(["maze = [\n", "  [", ", ", "],\n", "]\n"]),
    Form::List(["int maze[9][9] = {\n", "{", ",", "},\n", "};\n"]),
    Form::List(["[[", "", " ", "]\n [", "]"]),
    Form::Strings(["[", "]"]),
    Form::Doubled,
];

fn write(rows: &[Vec<&'static str>], form: Form) -> String {
    let lines = |line: &dyn Fn(&[&str]) -> String| rows.iter().map(|row| line(row)).collect::<String>();
    match form {
        Form::Plain => lines(&|row| row.concat() + "\n"),
        Form::Joined(separator) => lines(&|row| row.join(separator) + "\n"),
        Form::Trailing(separator) => lines(&|row| row.join(separator) + separator + "\n"),
        Form::List([first, open, separator, close, last]) => {
            let body = lines(&|row| open.to_owned() + &row.join(separator) + close);
            first.to_owned() + body.strip_suffix("]\n [").unwrap_or(&body) + last
        }
        Form::Strings([first, last]) => {
            let body = rows.iter().map(|row| format!("\"{}\"", row.concat())).collect::<Vec<_>>();
            first.to_owned() + &body.join(",\n") + last
        }
        Form::Doubled => lines(&|row| row.iter().map(|sign| sign.repeat(2)).collect::<String>() + "\n"),
    }
}

/// What may stand above, below and around any text.
fn dressed(text: &str, case: &Case, dress: usize) -> Vec<u8> {
    let [width, height] = case.size().map(|n| 2 * n + 1);
    match dress {
        0 => text.replace('\n', "\r\n"),
        1 => format!("\u{feff}{text}\n\n  \n"),
        2 => format!("{height} {width}\n{text}"),
        3 => format!("{width}x{height}\n\n{text}"),
        4 => format!("rows: {height}, cols: {width}\n{text}"),
        5 => {
            return [b"\xff\xfe".to_vec(), text.encode_utf16().flat_map(u16::to_le_bytes).collect()].concat();
        }
        6 => format!("\n\n{text}"),
        7 => text.replace('\n', "\r"),
        _ => text.to_owned(),
    }
    .into_bytes()
}

fn read(bytes: &[u8]) -> TextMaze {
    let shown = String::from_utf8_lossy(bytes).into_owned();
    text::read(bytes, &TextOptions::default()).unwrap_or_else(|error| panic!("{error}\n{shown}"))
}

/// The same blocks with the same ends; where posts stand by themselves is not compared.
fn expect_same(read: &TextMaze, case: &Case, shown: &str) {
    let [width, height] = case.size().map(|n| 2 * n + 1);
    let blocks = &read.blocks;
    assert_eq!([blocks.width(), blocks.height()], [width, height], "{}\n{shown}", read.found);
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        let is_post = x % 2 == 0 && y % 2 == 0;
        let is_same = blocks.is_wall(x, height - 1 - y) == case.is_wall(x, y);
        assert!(is_post || is_same, "({x}, {y}): {}\n{shown}", read.found);
    }
    let block = |[x, y]: [usize; 2]| [2 * x + 1, height - 2 - 2 * y];
    let ends = case.ends.map_or([None; 2], |ends| ends.map(|cell| Some(block(cell))));
    assert_eq!(blocks.ends(), ends, "{}\n{shown}", read.found);
}

/// How walls are drawn: corners, level strokes, upright strokes, columns and lines from one corner to the next.
#[derive(Clone, Copy, Debug)]
struct Strokes {
    corner: char,
    level: char,
    upright: char,
    step: [usize; 2],
    /// Whether corners without a wall are drawn too.
    all_corners: bool,
}

fn drawn(case: &Case, strokes: Strokes) -> String {
    let [width, height] = case.size();
    let [step_x, step_y] = strokes.step;
    let mut rows = vec![vec![' '; width * step_x + 1]; height * step_y + 1];
    for (i, j) in (0..=2 * height).flat_map(|j| (0..=2 * width).map(move |i| (i, j))) {
        let (x, y) = (i / 2 * step_x, j / 2 * step_y);
        match (i % 2, j % 2) {
            (0, 0) => {
                let touches = (0 < i && case.is_wall(i - 1, j))
                    || (0 < j && case.is_wall(i, j - 1))
                    || (i < 2 * width && case.is_wall(i + 1, j))
                    || (j < 2 * height && case.is_wall(i, j + 1));
                if touches || strokes.all_corners {
                    rows[y][x] = strokes.corner;
                }
            }
            (1, 0) if case.is_wall(i, j) => rows[y][x + 1..x + step_x].fill(strokes.level),
            (0, 1) if case.is_wall(i, j) => {
                rows[y + 1..y + step_y].iter_mut().for_each(|row| row[x] = strokes.upright)
            }
            _ => {}
        }
    }
    for ([x, y], sign) in case.ends.into_iter().flatten().zip(['S', 'E']) {
        rows[y * step_y + step_y / 2][x * step_x + step_x / 2] = sign;
    }
    rows.into_iter().map(|row| row.into_iter().collect::<String>().trim_end().to_owned() + "\n").collect()
}

/// Cells as `_|`, with a line of `_` above.
fn underscored(case: &Case) -> String {
    let [width, height] = case.size();
    let mut text = String::new();
    for j in (0..=2 * height).step_by(2) {
        for i in 0..=2 * width {
            let is_wall = |x: usize, y: usize| case.is_wall(x, y);
            text.push(match (i % 2, j) {
                (0, 0) => ' ',
                (0, _) if is_wall(i, j - 1) => '|',
                (1, _) if is_wall(i, j) => '_',
                _ => ' ',
            });
        }
        text.push('\n');
    }
    text
}

/// Box characters, one for each corner, with as many level strokes between them.
fn boxes(case: &Case, n_between: usize, lines_between: usize) -> String {
    const BOXES: [char; 16] =
        [' ', '╵', '╶', '└', '╷', '│', '┌', '├', '╴', '┘', '─', '┴', '┐', '┤', '┬', '┼'];
    let [width, height] = case.size();
    let is_wall = |i: Option<usize>, j: Option<usize>| {
        i.zip(j).is_some_and(|(i, j)| i <= 2 * width && j <= 2 * height && case.is_wall(i, j))
    };
    let mut text = String::new();
    for j in 0..=height {
        for i in 0..=width {
            let (x, y) = (2 * i, 2 * j);
            let arms = [
                is_wall(Some(x), y.checked_sub(1)),
                is_wall(Some(x + 1), Some(y)),
                is_wall(Some(x), Some(y + 1)),
                is_wall(x.checked_sub(1), Some(y)),
            ];
            let index: usize = arms.iter().enumerate().map(|(bit, arm)| usize::from(*arm) << bit).sum();
            text.push(BOXES[index]);
            if i < width {
                text.extend(std::iter::repeat_n(if arms[1] { '─' } else { ' ' }, n_between));
            }
        }
        text.push('\n');
        for _ in 0..if j < height { lines_between } else { 0 } {
            for i in 0..=width {
                text.push(if is_wall(Some(2 * i), Some(2 * j + 1)) { '│' } else { ' ' });
                text.extend(std::iter::repeat_n(' ', if i < width { n_between } else { 0 }));
            }
            text.push('\n');
        }
    }
    text
}

/// A number a cell; bits for north, east, south and west.
fn numbers(case: &Case, bits: [u8; 4], are_walls: bool, style: usize) -> String {
    let [width, height] = case.size();
    let number = |x: usize, y: usize| {
        let (i, j) = (2 * x + 1, 2 * y + 1);
        let sides =
            [case.is_wall(i, j - 1), case.is_wall(i + 1, j), case.is_wall(i, j + 1), case.is_wall(i - 1, j)];
        sides.iter().zip(bits).map(|(wall, bit)| if *wall == are_walls { bit } else { 0 }).sum::<u8>()
    };
    let row = |y: usize| {
        let numbers = (0..width).map(|x| number(x, y));
        match style {
            0 => numbers.map(|n| format!("{n:x}")).collect::<String>(),
            1 => numbers.map(|n| format!("{n:X}")).collect(),
            2 => numbers.map(|n| n.to_string()).collect::<Vec<_>>().join(" "),
            _ => numbers.map(|n| n.to_string()).collect::<Vec<_>>().join(","),
        }
    };
    let rows: String = (0..height).map(|y| row(y) + "\n").collect();
    match case.ends {
        Some([[a, b], [c, d]]) => format!("{rows}\n{a},{b}\n{c},{d}\n"),
        None => rows,
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 600, max_global_rejects: 1_000_000, ..ProptestConfig::default() })]

    #[test]
    fn f11_blocks_of_any_signs(case in case(), signs in select(&SIGNS[..]), form in select(&FORMS[..]), dress in 0..12_usize) {
        // A comma is no separator beside itself, nor a blank beside a blank.
        let takes = |separator: &str| !signs.iter().any(|sign| separator.contains(sign) && *sign != " ");
        let usable = match form {
            Form::Joined(separator) | Form::Trailing(separator) => takes(separator) && (signs[1] != " " || separator == " "),
            Form::List(_) => signs[1] != " " && !signs.contains(&","),
            Form::Strings(_) | Form::Plain | Form::Doubled => true,
        };
        prop_assume!(usable);
        let text = write(&rows(&case, signs), form);
        // A list is no list behind a header.
        let dress = if matches!(form, Form::List(_) | Form::Strings(_)) && (2..5).contains(&dress) { 8 } else { dress };
        expect_same(&read(&dressed(&text, &case, dress)), &case, &text);
    }

    #[test]
    fn f11_walls_drawn_as_lines(
        case in case(),
        corner in select(&['+', 'o', '*', '.', ' '][..]),
        step in [2..6_usize, 2..4],
        all_corners in any::<bool>(),
        dress in 0..12_usize,
    ) {
        // Without corners, a narrow maze with few walls has columns that nothing shows.
        prop_assume!(corner != ' ' || (5 <= case.layout.width() && case.is_perfect()));
        let strokes = Strokes { corner, level: '-', upright: '|', step, all_corners };
        let text = drawn(&case, strokes);
        let dress = if (2..5).contains(&dress) { 8 } else { dress };
        expect_same(&read(&dressed(&text, &case, dress)), &case, &text);
    }

    #[test]
    fn f11_underscores(case in case()) {
        prop_assume!(case.is_perfect());
        let case = Case { ends: None, ..case };
        let text = underscored(&case);
        expect_same(&read(text.as_bytes()), &case, &text);
    }

    #[test]
    fn f11_box_characters(case in case(), step in [0..4_usize, 0..3], heavy in any::<bool>()) {
        prop_assume!(case.is_perfect());
        let case = Case { ends: None, ..case };
        let text = boxes(&case, step[0], step[1]);
        let text = if heavy { text.replace('─', "━").replace('│', "┃").replace('┌', "┏").replace('┼', "╋") } else { text };
        expect_same(&read(text.as_bytes()), &case, &text);
    }

    #[test]
    fn f11_a_number_a_cell(
        case in case(),
        bits in select(&[[1, 2, 4, 8], [1, 4, 2, 8], [8, 4, 2, 1]][..]),
        are_walls in any::<bool>(),
        style in 0..4_usize,
    ) {
        let text = numbers(&case, bits, are_walls, style);
        let distinct: std::collections::BTreeSet<&str> = text.split(|c: char| !c.is_alphanumeric()).collect();
        prop_assume!(style < 2 || 5 < distinct.len());
        expect_same(&read(text.as_bytes()), &case, &text);
    }
}

fn found(text: &str) -> String {
    text::read(text.as_bytes(), &TextOptions::default()).unwrap().found
}

fn message(text: &str) -> String {
    text::read(text.as_bytes(), &TextOptions::default()).unwrap_err().to_string()
}

#[test]
fn f11_how_a_text_was_read_is_told() {
    assert_eq!(
        found("#####B#\n#     #\n#A#####\n"),
        "7 x 3 blocks: wall `#`, free blank, start `A`, goal `B`"
    );
    assert_eq!(
        found("3 4\n1,1,1,1\n1,2,3,1\n1,1,1,1\n"),
        "4 x 3 blocks, separated by commas: wall `1`, free none, start `2`, goal `3`; line 1, `3 4`, is its size"
    );
    assert_eq!(
        found("+--+--+\n| S   |\n+--+  +\n|   E |\n+--+--+\n"),
        "2 x 2 cells, walls drawn as lines, start `S`, goal `E`"
    );
    assert!(found("0 1 0 0\n0 0 0 1\n1 0 1 1\n1 0 0 1\n").ends_with("a wall was laid around it"));
}

#[test]
fn f11_a_solution_and_visited_places_drawn_in_a_maze_are_free() {
    let plain = "#########\n#S#     #\n# # ### #\n#   #  G#\n#########\n";
    let marked = "#########\n#S#.....#\n#.#.###.#\n#...#++G#\n#########\n";
    let blocks = |text: &str| text::read(text.as_bytes(), &TextOptions::default()).unwrap().blocks;
    assert_eq!(blocks(marked), blocks(plain));
}

#[test]
fn f11_two_equal_readings_are_refused_with_both_and_decided_by_what_is_stated() {
    let text = "0101\n0101\n0101\n0101\n";
    assert_eq!(message(text), "wall can be `0` or `1`: expected text.wall to say which");
    let options = TextOptions { wall: Some("1".into()), ..Default::default() };
    let read = text::read(text.as_bytes(), &options).unwrap();
    assert!(read.found.contains("wall `1`, free `0`"), "{}", read.found);
    let text = "#####\n#Q Z#\n#####\n";
    assert_eq!(message(text), "start can be `Q` or `Z`: expected text.start to say which");
    let options = TextOptions { start: Some("Z".into()), ..Default::default() };
    assert_eq!(text::read(text.as_bytes(), &options).unwrap().blocks.ends(), [Some([3, 1]), Some([1, 1])]);
}

#[test]
fn f11_what_is_stated_goes_before_what_is_found() {
    let text = "#.#.#\n.S.G.\n#.#.#\n";
    let options = TextOptions { wall: Some(".".into()), ..Default::default() };
    let read = text::read(text.as_bytes(), &options).unwrap();
    assert!(read.found.contains("wall `.`, free `#`"), "{}", read.found);
    let options = TextOptions { goal: Some("q".into()), ..Default::default() };
    let error = text::read(text.as_bytes(), &options).unwrap_err().to_string();
    assert_eq!(error, "text.goal is `q`, which is nowhere in the file");
    let options = TextOptions { wall: Some("#".into()), free: Some("#".into()), ..Default::default() };
    let error = text::read(text.as_bytes(), &options).unwrap_err().to_string();
    assert_eq!(error, "`#` is both in text.wall and in text.free");
}

#[test]
fn f11_one_end_alone_is_kept_and_the_other_one_found() {
    let maze = text::read(b"#########\n#      S#\n#########\n", &TextOptions::default()).unwrap();
    assert_eq!(maze.blocks.ends(), [Some([7, 1]), None]);
    let maze = maze.maze(&AssembleOptions::default()).unwrap();
    assert!(
        maze.is_solvable() && maze.start().x == 3.0 && maze.goal().x < -2.5,
        "{:?} {:?}",
        maze.start(),
        maze.goal()
    );
}

#[test]
fn f11_a_goal_of_four_cells_is_its_middle() {
    let micromouse = "o---o---o---o\n| S         |\no   o   o   o\n|     G   G |\no   o   o   o\n|     G   G |\no---o---o---o\n";
    let read = text::read(micromouse.as_bytes(), &TextOptions::default()).unwrap();
    assert_eq!(read.blocks.ends(), [Some([1, 5]), Some([4, 2])]);
}

#[test]
fn f11_what_is_wrong_in_a_text_is_told_with_its_place() {
    let cases = [
        ("###\n#S#\n#S#\n#G#\n###\n", "line 3, column 2: a second `S`: the first one is at line 2, column 2"),
        ("5 5\n###\n# #\n###\n", "line 1 says 5 5: the maze below it has 3 rows of 3"),
        ("1,1,1\n1,0\n1,1,1\n", "line 2: a row of 2 cells: expected 3, as in the first one"),
        ("[[1,1,1],\n[1,0],\n[1,1,1]]\n", "line 2: a row of 2 cells: expected 3, as in the first one"),
        (
            "+--+--+--+\n|     |  |\n+--+--+--+\n|    |   |\n+--+--+--+\n",
            "line 4, column 6: a wall at no corner",
        ),
        ("###\n#\u{1b}#\n# #\n###\n", "line 2, column 2: `\\u{1b}`"),
    ];
    for (text, expected) in cases {
        let message = message(text);
        assert!(message.starts_with(expected), "{text}: {message}");
    }
}

#[test]
fn f11_a_wrong_bit_is_told_with_its_place() {
    let layout = Recipe::new(12, 9, Algorithm::Wilson, 5).layout().unwrap();
    let case = Case { layout, ends: None };
    let text = numbers(&case, [1, 2, 4, 8], true, 0);
    let wrong: String = text
        .lines()
        .enumerate()
        .map(|(y, line)| match y {
            4 => {
                line[..6].to_owned()
                    + &format!("{:x}", u8::from_str_radix(&line[6..7], 16).unwrap() ^ 2)
                    + &line[7..]
                    + "\n"
            }
            _ => line.to_owned() + "\n",
        })
        .collect();
    let message = message(&wrong);
    assert!(message.starts_with("line 5, column 8: the cell and its neighbour disagree"), "{message}");
}
