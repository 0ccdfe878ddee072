//! Walls drawn as lines: `+--+` and `|`, `o---o`, `_|`, and the characters for boxes.

use super::grid::{BLANK, Grid, Line};
use super::sides::{End, Sides};
use super::signs::{self, quoted};
use super::{Place, TextError, TextOptions};

/// Where a character's strokes lead from its middle: up, right, down, left.
type Arms = [bool; 4];

const UP: usize = 0;
const RIGHT: usize = 1;
const DOWN: usize = 2;
const LEFT: usize = 3;

const UPRIGHT: Arms = [true, false, true, false];
const LEVEL: Arms = [false, true, false, true];

/// The strokes of a character; `None` when it draws no wall. Source: the Unicode chart of box drawing, U+2500 to U+257F.
fn arms(character: char) -> Option<Arms> {
    let [up, right, down, left] = [1, 2, 4, 8];
    let arms = match character {
        '-' | '─' | '━' | '═' | '┄' | '┅' | '┈' | '┉' | '╌' | '╍' | '—' | '–' | '―' | '╼' | '╾' => {
            right | left
        }
        '|' | '│' | '┃' | '║' | '┆' | '┇' | '┊' | '┋' | '╎' | '╏' | '¦' | '╽' | '╿' => {
            up | down
        }
        '┌'..='┏' | '╒'..='╔' | '╭' => right | down,
        '┐'..='┓' | '╕'..='╗' | '╮' => down | left,
        '└'..='┗' | '╘'..='╚' | '╰' => up | right,
        '┘'..='┛' | '╛'..='╝' | '╯' => up | left,
        '├'..='┣' | '╞'..='╠' => up | right | down,
        '┤'..='┫' | '╡'..='╣' => up | down | left,
        '┬'..='┳' | '╤'..='╦' => right | down | left,
        '┴'..='┻' | '╧'..='╩' => up | right | left,
        '┼'..='╋' | '╪'..='╬' | '+' => up | right | down | left,
        '╴' | '╸' => left,
        '╵' | '╹' => up,
        '╶' | '╺' => right,
        '╷' | '╻' => down,
        _ => return None,
    };
    Some([up, right, down, left].map(|arm| arms & arm != 0))
}

/// Characters that stand at the corners of cells in some files, and for something else in others.
const POSTS: &str = "oO*.'`,°•●#@";

/// Whether these lines draw walls: strokes along both axes, and hardly anything else.
pub(super) fn is_drawn(lines: &[Line]) -> bool {
    let (mut n_level, mut n_upright, mut n_other, mut n_boxes) = (0_usize, 0_usize, 0_usize, 0_usize);
    for character in lines.iter().flat_map(|line| line.content.chars()).filter(|c| !c.is_whitespace()) {
        match arms(character) {
            Some([up, right, down, left]) => {
                n_level += usize::from(right || left);
                n_upright += usize::from(up || down);
                n_boxes += usize::from(!character.is_ascii());
            }
            None if character == '_' => n_level += 1,
            None if POSTS.contains(character) => {}
            None => n_other += 1,
        }
    }
    // A free `-` or `|` among blocks of another sign is no stroke.
    let is_block = |c: char| signs::is_block(c);
    let n_blocks = lines.iter().flat_map(|line| line.content.chars()).filter(|c| is_block(*c)).count();
    let starts_with_post = || {
        lines.first().is_some_and(|line| {
            let mut characters = line.content.trim_start().chars();
            let first = characters.next();
            first.is_some_and(|first| POSTS.contains(first))
                && characters.next().is_some_and(|next| next == '-')
        })
    };
    let n_strokes = n_level + n_upright;
    0 < n_level
        && 0 < n_upright
        && n_other < n_strokes
        && (n_blocks == 0 || 0 < n_boxes || starts_with_post())
}

/// The strokes of a text, line by line; each row of cells of a text of `_` and `|` is two lines here.
struct Canvas<'a> {
    lines: &'a [Line<'a>],
    rows: Vec<Vec<char>>,
    /// Whether the walls below cells are drawn by `_` in the line of the cells.
    is_underscored: bool,
    post: Option<char>,
}

impl<'a> Canvas<'a> {
    fn new(lines: &'a [Line<'a>]) -> Self {
        let has = |wanted: char| lines.iter().any(|line| line.content.contains(wanted));
        let is_underscored = has('_') && has('|') && !has('-') && !has('+');
        let first = lines.first().and_then(|line| line.content.trim_start().chars().next());
        let post = first.filter(|first| POSTS.contains(*first));
        let rows = lines.iter().flat_map(|line| {
            let row: Vec<char> = line.content.chars().collect();
            match is_underscored {
                false => vec![row],
                true => {
                    let cells = row.iter().map(|c| if *c == '_' { ' ' } else { *c }).collect();
                    let below = row.iter().map(|c| match c {
                        '_' => '-',
                        '|' => '|',
                        _ => ' ',
                    });
                    vec![cells, below.collect()]
                }
            }
        });
        Self { lines, rows: rows.collect(), is_underscored, post }
    }

    fn character(&self, row: usize, column: usize) -> char {
        self.rows[row].get(column).copied().unwrap_or(' ')
    }

    fn arms(&self, row: usize, column: usize) -> Arms {
        let character = self.character(row, column);
        let post = (Some(character) == self.post).then_some([true; 4]);
        post.or_else(|| arms(character)).unwrap_or([false; 4])
    }

    fn place(&self, row: usize, column: usize) -> Place {
        let line = if self.is_underscored { row / 2 } else { row };
        Place { line: self.lines[line].number, column: column + 1 }
    }

    /// The columns and rows of the lattice on which the walls lie: where strokes pass, at even distances.
    fn lattice(&self) -> Result<[Vec<usize>; 2], TextError> {
        let width = self.rows.iter().map(Vec::len).max().unwrap_or(0);
        let mut columns = vec![None; width];
        let mut rows = vec![None; self.rows.len()];
        let at = |row: Option<usize>, column: Option<usize>| match (row, column) {
            (Some(row), Some(column)) if row < self.rows.len() => self.arms(row, column),
            _ => [false; 4],
        };
        for (row, row_mark) in rows.iter_mut().enumerate() {
            for (column, column_mark) in columns.iter_mut().enumerate() {
                let here = self.arms(row, column);
                let [up, right, down, left] = here;
                let before = [at(row.checked_sub(1), Some(column)), at(Some(row), column.checked_sub(1))];
                let behind = [at(Some(row + 1), Some(column)), at(Some(row), Some(column + 1))];
                // Where a stroke stops for a character and goes on, or ends within one, is a corner too.
                let stops = |axis: usize, stroke: Arms| {
                    here == [false; 4] && before[axis] == stroke && behind[axis] == stroke
                };
                // A run of `_` begins and ends beside a corner.
                let ends =
                    self.is_underscored && here == [false; 4] && (before[1] == LEVEL || behind[1] == LEVEL);
                if up || down || stops(1, LEVEL) || (right != left) || ends {
                    column_mark.get_or_insert((row, column));
                }
                if right || left || stops(0, UPRIGHT) || (up != down) {
                    row_mark.get_or_insert((row, column));
                }
            }
        }
        let columns = self.even(&columns)?;
        // Of so narrow cells each line is a row, whether there is a wall below any of its cells or not.
        if self.is_underscored && columns.windows(2).all(|pair| pair[1] - pair[0] <= 3) {
            let floors = (1..rows.len()).step_by(2).collect();
            return Ok([columns, floors]);
        }
        Ok([columns, self.even(&rows)?])
    }

    /// Even steps through all marked places; each mark says where in the file it is.
    fn even(&self, marks: &[Option<(usize, usize)>]) -> Result<Vec<usize>, TextError> {
        let marked: Vec<usize> = (0..marks.len()).filter(|at| marks[*at].is_some()).collect();
        let (Some(first), Some(last)) = (marked.first(), marked.last()) else {
            return Err(TextError::NoWalls { n_lines: self.lines.len() });
        };
        let steps = || marked.windows(2).map(|pair| pair[1] - pair[0]);
        let step = steps().fold(0, gcd);
        if step == 0 {
            return Err(TextError::NoWalls { n_lines: self.lines.len() });
        }
        // Where nearly all places are multiples of a larger step, a stroke is out of place; box characters may end anywhere.
        let mut sorted: Vec<usize> = steps().collect();
        sorted.sort_unstable();
        let usual = sorted[sorted.len() / 2];
        let mut stray = marked.iter().filter(|at| !(*at - first).is_multiple_of(usual)).peekable();
        if let Some((row, column)) = stray.peek().and_then(|at| marks[**at])
            && self.rows.iter().flatten().all(|c| c.is_ascii())
            && 4 * stray.count() <= marked.len()
        {
            return Err(TextError::OffGrid { place: self.place(row, column), step: usual });
        }
        Ok((*first..=*last).step_by(step).collect())
    }

    /// Whether a wall is drawn between two corners of the lattice, which are `row` and `columns` apart, or `rows` and `column`.
    fn is_level(&self, row: usize, [from, to]: [usize; 2]) -> bool {
        let n_drawn =
            (from + 1..to).filter(|column| self.arms(row, *column)[RIGHT] && self.arms(row, *column)[LEFT]);
        match to - from {
            1 => self.arms(row, from)[RIGHT] && self.arms(row, to)[LEFT],
            step => step - 1 < 2 * n_drawn.count(),
        }
    }

    fn is_upright(&self, [from, to]: [usize; 2], column: usize) -> bool {
        let n_drawn =
            (from + 1..to).filter(|row| self.arms(*row, column)[UP] && self.arms(*row, column)[DOWN]);
        match to - from {
            1 => self.arms(from, column)[DOWN] && self.arms(to, column)[UP],
            step => step - 1 < 2 * n_drawn.count(),
        }
    }
}

fn gcd(a: usize, b: usize) -> usize {
    if b == 0 { a } else { gcd(b, a % b) }
}

/// What was found.
pub(super) struct Drawing {
    pub(super) sides: Sides,
    pub(super) ends: [Option<End>; 2],
    pub(super) places: [Option<Place>; 2],
    /// Signs in cells that mean nothing.
    pub(super) n_marks: usize,
}

/// Reads walls that are drawn.
///
/// # Errors
/// Strokes on no lattice of even steps, and no strokes; several starts or goals.
pub(super) fn read(lines: &[Line], options: &TextOptions) -> Result<Drawing, TextError> {
    let canvas = Canvas::new(lines);
    let [xs, ys] = canvas.lattice()?;
    let [width, height] = [xs.len() - 1, ys.len() - 1];
    let mut sides = Sides::new(width, height)?;
    for (y, row) in ys.iter().enumerate() {
        for x in (0..width).filter(|x| canvas.is_level(*row, [xs[*x], xs[x + 1]])) {
            sides.add_level(x, y);
        }
    }
    for y in 0..height {
        for x in (0..=width).filter(|x| canvas.is_upright([ys[y], ys[y + 1]], xs[*x])) {
            sides.add_upright(x, y);
        }
    }
    if sides.n_walls() == 0 {
        return Err(TextError::NoWalls { n_lines: lines.len() });
    }
    let marks = Marks::new(&canvas, &xs, &ys)?;
    let (ends, places) = marks.ends(options)?;
    let n_end_signs: usize = ends.iter().flatten().map(|end| if end.is_square { 4 } else { 1 }).sum();
    Ok(Drawing { sides, ends, places, n_marks: marks.found.len().saturating_sub(n_end_signs) })
}

/// Start and goal, and where their signs stand.
type EndsAndPlaces = ([Option<End>; 2], [Option<Place>; 2]);

/// A sign in a cell.
struct Mark {
    cell: [usize; 2],
    sign: String,
    place: Place,
}

struct Marks {
    found: Vec<Mark>,
}

impl Marks {
    /// What stands in the cells, blanks aside.
    fn new(canvas: &Canvas, xs: &[usize], ys: &[usize]) -> Result<Self, TextError> {
        let mut found: Vec<Mark> = Vec::new();
        for y in 0..ys.len() - 1 {
            for row in ys[y] + 1..ys[y + 1] {
                for x in 0..xs.len() - 1 {
                    let columns = xs[x] + 1..xs[x + 1];
                    let text: String = columns.clone().map(|column| canvas.character(row, column)).collect();
                    let sign = text.trim();
                    if sign.is_empty() {
                        continue;
                    }
                    let blanks = text.chars().take_while(|c| c.is_whitespace()).count();
                    let place = canvas.place(row, columns.start + blanks);
                    found.push(Mark { cell: [x, y], sign: sign.to_owned(), place });
                }
            }
        }
        Ok(Self { found })
    }

    /// The places of start and goal among them.
    fn ends(&self, options: &TextOptions) -> Result<EndsAndPlaces, TextError> {
        let mut groups: Vec<(&str, Vec<&Mark>)> = Vec::new();
        for mark in &self.found {
            match groups.iter().position(|(sign, _)| *sign == mark.sign) {
                Some(known) => groups[known].1.push(mark),
                None if groups.len() < super::MAX_SIGNS - 1 => groups.push((mark.sign.as_str(), vec![mark])),
                // So many signs are numbers of cells: no start and no goal among them.
                None => return Ok(Default::default()),
            }
        }
        // What stands in one cell, or in a square of four, may be an end.
        let is_end = |marks: &[&Mark]| marks.len() == 1 || square(marks).is_some();
        let stated = [&options.start, &options.goal];
        let is_stated = |sign: &str| stated.iter().any(|stated| stated.as_deref() == Some(sign));
        let mut cells = Vec::new();
        let mut signs = vec![" ".to_owned()];
        for (sign, marks) in &groups {
            let is_letter = sign.len() == 1 && "SGEF".contains(&sign.to_ascii_uppercase());
            if !is_end(marks) && (is_stated(sign) || (is_letter && marks.len() <= 4)) {
                let [first, second] = [marks[0].place, marks[1].place];
                return Err(TextError::Twice { place: second, first, name: (*sign).to_owned() });
            }
            if is_end(marks) {
                signs.push((*sign).to_owned());
                cells.push(u8::try_from(signs.len() - 1).unwrap_or(BLANK));
            }
        }
        let grid = Grid::of_row(cells, signs);
        let counts: Vec<usize> = (0..grid.signs.len()).map(|sign| usize::from(sign != 0)).collect();
        let found = signs::find_ends(&grid, &counts, options)?;
        let group =
            |cell: usize| groups.iter().find(|(sign, _)| *sign == grid.signs[usize::from(grid.cells[cell])]);
        let marks = found.map(|cell| cell.and_then(group).map(|(_, marks)| marks));
        let end = |marks: &Vec<&Mark>| match square(marks) {
            Some(cell) => End { cell, is_square: true },
            None => End { cell: marks[0].cell, is_square: false },
        };
        Ok((marks.map(|marks| marks.map(end)), marks.map(|marks| marks.map(|marks| marks[0].place))))
    }
}

/// The upper left of four cells that make a square.
fn square(marks: &[&Mark]) -> Option<[usize; 2]> {
    let [a, b, c, d] = marks else { return None };
    let [x, y] = a.cell;
    ([b, c, d].map(|mark| mark.cell) == [[x + 1, y], [x, y + 1], [x + 1, y + 1]]).then_some([x, y])
}

impl Drawing {
    /// In words.
    pub(super) fn words(&self) -> String {
        let mut words = "walls drawn as lines".to_owned();
        if self.n_marks != 0 {
            words += &format!(", {} signs in cells ignored", self.n_marks);
        }
        words
    }

    /// The signs of start and goal.
    pub(super) fn end_words(lines: &[Line], places: [Option<Place>; 2]) -> String {
        let sign = |place: Place| {
            let line = lines.iter().find(|line| line.number == place.line);
            line.and_then(|line| line.content.chars().nth(place.column - 1)).unwrap_or(' ')
        };
        let named = ["start", "goal"].into_iter().zip(places);
        named
            .filter_map(|(name, place)| Some(format!(", {name} {}", quoted(&sign(place?).to_string()))))
            .collect()
    }
}
