//! Text -> rows of signs: what separates the cells of a row, headers, lists, and blocks of two characters.

use super::{MAX_BLOCKS, MAX_LINE, MAX_SIDE, MAX_SIGNS, Place, TextError};

/// The sign of a cell without a character: a blank.
pub(super) const BLANK: u8 = 0;

/// Most characters of a sign: a number, or a symbol.
const MAX_SIGN: usize = 8;

/// A rectangle of cells, row by row from the top, each with a sign.
/// Invariant: `cells`, `columns` and `lines` have `width * height`, `width * height` and `height` entries; each cell is an
/// index into `signs`.
#[derive(Debug)]
pub(super) struct Grid {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) cells: Vec<u8>,
    /// What stands for a cell; the first one is a blank.
    pub(super) signs: Vec<String>,
    /// How the rows were read, where it is more than a character a cell.
    pub(super) form: Option<&'static str>,
    columns: Vec<u16>,
    lines: Vec<u32>,
}

impl Grid {
    /// Cells in one row, without places.
    pub(super) fn of_row(cells: Vec<u8>, signs: Vec<String>) -> Self {
        let width = cells.len();
        Self { width, height: 1, columns: vec![1; width], cells, signs, form: None, lines: vec![1] }
    }

    /// Where a cell stands in the file.
    pub(super) fn place(&self, cell: usize) -> Place {
        let line = self.lines[cell / self.width] as usize;
        Place { line, column: usize::from(self.columns[cell]) }
    }

    /// The cells of one sign.
    pub(super) fn cells_of(&self, sign: u8) -> impl Iterator<Item = usize> {
        self.cells.iter().enumerate().filter(move |(_, found)| **found == sign).map(|(cell, _)| cell)
    }

    /// The cells above, below, left and right of a cell.
    pub(super) fn neighbours(&self, cell: usize) -> impl Iterator<Item = usize> + use<> {
        let (width, height) = (self.width, self.height);
        let (x, y) = (cell % width, cell / width);
        let around = [
            (0 < x).then(|| cell - 1),
            (x + 1 < width).then(|| cell + 1),
            (0 < y).then(|| cell - width),
            (y + 1 < height).then(|| cell + width),
        ];
        around.into_iter().flatten()
    }

    /// Whether a cell lies at the border.
    pub(super) fn is_border(&self, cell: usize) -> bool {
        let (x, y) = (cell % self.width, cell / self.width);
        x == 0 || y == 0 || x + 1 == self.width || y + 1 == self.height
    }
}

/// A line of a text with its number, counted from 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line<'a> {
    pub(super) number: usize,
    pub(super) content: &'a str,
}

impl Line<'_> {
    pub(super) fn is_blank(&self) -> bool {
        self.content.is_empty()
    }
}

/// The lines of a text without blanks at their ends, from the first to the last that is not blank.
///
/// # Errors
/// A text without characters, and one with a line that no maze has.
pub(super) fn lines(text: &str) -> Result<Vec<Line<'_>>, TextError> {
    // Old Macintoshes ended lines with a carriage return alone.
    let end = if text.contains('\n') { '\n' } else { '\r' };
    let mut lines: Vec<Line> = Vec::new();
    for (index, content) in text.trim_end().split(end).enumerate() {
        let line = Line { number: index + 1, content: content.trim_end() };
        if MAX_LINE < line.content.len() {
            return Err(TextError::TooWide { place: Place { line: line.number, column: MAX_SIDE + 1 } });
        }
        if !line.is_blank() || !lines.is_empty() {
            lines.push(line);
        }
        if 2 * MAX_SIDE < lines.len() {
            let n_lines = text.trim_end().split(end).count();
            return Err(TextError::TooLarge {
                n_lines,
                width: lines.iter().map(|line| line.content.len()).max().unwrap_or(0),
            });
        }
    }
    if lines.is_empty() { Err(TextError::Empty) } else { Ok(lines) }
}

/// The numbers of a line that says nothing but sizes: `5 7`, `5x7`, `rows=5, cols=7`.
pub(super) fn sizes(line: &str) -> Option<Vec<usize>> {
    const WORDS: [&str; 14] = [
        "rows", "row", "r", "columns", "column", "cols", "col", "c", "width", "height", "w", "h", "size", "x",
    ];
    let mut sizes: Vec<usize> = Vec::new();
    let is_number = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    for word in line.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty()) {
        match word.to_ascii_lowercase().split_once('x') {
            Some((a, b)) if !a.is_empty() && !b.is_empty() && is_number(a) && is_number(b) => {
                sizes.extend([a.parse::<usize>().ok()?, b.parse().ok()?]);
            }
            _ if is_number(word) => sizes.push(word.parse().ok()?),
            _ if WORDS.contains(&word.to_ascii_lowercase().as_str()) => {}
            _ => return None,
        }
    }
    let punctuation = |c: char| c.is_alphanumeric() || c.is_whitespace() || ",;:=*\u{d7}()".contains(c);
    ((1..=2).contains(&sizes.len()) && line.chars().all(punctuation)).then_some(sizes)
}

/// Whether these lines are an array of a programming language: `[[1, 0], [1, 1]]`, `{"###", "# #"}`.
pub(super) fn is_list(lines: &[Line]) -> bool {
    let Some(first) = lines.first() else { return false };
    let content = after_assignment(first.content).trim_start();
    content.starts_with(['[', '{', '(', '"', '\''])
}

/// What stands behind the `=` of a declaration, or all of it.
fn after_assignment(line: &str) -> &str {
    match line.split_once('=') {
        Some((_, value))
            if value.trim_start().is_empty() || value.trim_start().starts_with(['[', '{', '"']) =>
        {
            value
        }
        _ => line,
    }
}

/// Cells as they are found, row by row.
#[derive(Default)]
struct Rows {
    signs: Vec<String>,
    rows: Vec<Row>,
    row: Row,
    n_cells: usize,
}

#[derive(Default)]
struct Row {
    line: usize,
    cells: Vec<u8>,
    columns: Vec<u16>,
}

impl Rows {
    fn new() -> Self {
        Self { signs: vec![" ".to_owned()], ..Self::default() }
    }

    /// Adds a cell to the row at hand.
    fn push(&mut self, sign: &str, place: Place) -> Result<(), TextError> {
        let sign = if sign.is_empty() || sign == "\u{a0}" || sign == "\u{3000}" { " " } else { sign };
        if MAX_SIDE == self.row.cells.len() {
            return Err(TextError::TooWide { place });
        }
        let known = self.signs.iter().position(|known| known == sign);
        let index = match known {
            Some(index) => index,
            None if self.signs.len() < MAX_SIGNS && sign.chars().count() <= MAX_SIGN => {
                self.signs.push(sign.to_owned());
                self.signs.len() - 1
            }
            None => return Err(TextError::NoSign { place, found: sign.chars().take(MAX_SIGN).collect() }),
        };
        self.row.line = if self.row.cells.is_empty() { place.line } else { self.row.line };
        // Both fit: there are at most MAX_SIGNS signs, and lines are at most MAX_LINE long.
        self.row.cells.push(u8::try_from(index).unwrap_or(BLANK));
        self.row.columns.push(u16::try_from(place.column).unwrap_or(u16::MAX));
        self.n_cells += 1;
        Ok(())
    }

    /// Ends the row at hand, even one without a cell.
    fn end_row(&mut self, line: usize) {
        let mut row = std::mem::take(&mut self.row);
        row.line = if row.cells.is_empty() { line } else { row.line };
        self.rows.push(row);
    }

    /// The rows as a rectangle, filled up with blanks at the right.
    fn grid(self, form: Option<&'static str>) -> Result<Grid, TextError> {
        let width = self.rows.iter().map(|row| row.cells.len()).max().unwrap_or(0);
        let height = self.rows.len();
        if MAX_SIDE < height || MAX_BLOCKS < width.saturating_mul(height) {
            return Err(TextError::TooLarge { n_lines: height, width });
        }
        let mut grid = Grid {
            width,
            height,
            cells: Vec::with_capacity(width * height),
            signs: self.signs,
            form,
            columns: Vec::with_capacity(width * height),
            lines: Vec::with_capacity(height),
        };
        for row in self.rows {
            grid.lines.push(u32::try_from(row.line).unwrap_or(u32::MAX));
            grid.columns.extend_from_slice(&row.columns);
            grid.cells.extend_from_slice(&row.cells);
            for missing in row.cells.len()..width {
                grid.cells.push(BLANK);
                grid.columns.push(u16::try_from(missing + 1).unwrap_or(u16::MAX));
            }
        }
        Ok(grid)
    }
}

/// The cells of an array in brackets, of strings or of values.
///
/// # Errors
/// Rows of different lengths, and what [`read`] refuses.
pub(super) fn read_list(lines: &[Line]) -> Result<Grid, TextError> {
    let mut rows = Rows::new();
    let mut has_values = false;
    for (index, line) in lines.iter().enumerate() {
        let content = if index == 0 { after_assignment(line.content) } else { line.content };
        let skipped = line.content.chars().count() - content.chars().count();
        let mut quote = None;
        let mut string: Vec<(char, usize)> = Vec::new();
        let mut value: (String, usize) = (String::new(), 0);
        for (column, found) in content.chars().enumerate() {
            let column = skipped + column + 1;
            let place = |column| Place { line: line.number, column };
            match (found, quote) {
                (end, Some(open)) if end == open => {
                    quote = None;
                    let is_row = string.len() != 1;
                    for (sign, column) in string.drain(..) {
                        rows.push(sign.encode_utf8(&mut [0; 4]), place(column))?;
                    }
                    if is_row {
                        rows.end_row(line.number);
                    }
                }
                (sign, Some(_)) => string.push((sign, column)),
                ('"' | '\'', None) => quote = Some(found),
                _ if found.is_whitespace() || ",;[](){}".contains(found) => {
                    if !value.0.is_empty() {
                        has_values = true;
                        rows.push(&value.0, place(value.1))?;
                        value.0.clear();
                    }
                    if "])}".contains(found) && !rows.row.cells.is_empty() {
                        rows.end_row(line.number);
                    }
                }
                _ => {
                    value.1 = if value.0.is_empty() { column } else { value.1 };
                    value.0.push(found);
                }
            }
        }
        if !value.0.is_empty() {
            rows.push(&value.0, Place { line: line.number, column: value.1 })?;
        }
    }
    if !rows.row.cells.is_empty() {
        let line = rows.row.line;
        rows.end_row(line);
    }
    if has_values {
        expect_same_lengths(&rows.rows)?;
    }
    rows.grid(Some("a list"))
}

fn expect_same_lengths(rows: &[Row]) -> Result<(), TextError> {
    let expected = rows.first().map_or(0, |row| row.cells.len());
    match rows.iter().find(|row| row.cells.len() != expected) {
        Some(row) => Err(TextError::RowLength { line: row.line, n_cells: row.cells.len(), expected }),
        None => Ok(()),
    }
}

/// What lies between the cells of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Separator {
    /// Nothing: a character a cell.
    None,
    /// This character.
    Of(char),
    /// Blanks, as many as there are.
    Blanks,
    /// One blank behind each cell, which may be blank itself.
    EverySecond,
}

impl Separator {
    fn name(self) -> Option<&'static str> {
        match self {
            Self::None => None,
            Self::Of(',') => Some("separated by commas"),
            Self::Of(';') => Some("separated by semicolons"),
            Self::Of(_) => Some("separated by tabs"),
            Self::Blanks | Self::EverySecond => Some("separated by blanks"),
        }
    }

    /// What separates the cells in these lines, told by the lines alone.
    fn of(lines: &[Line]) -> Self {
        let filled = || lines.iter().filter(|line| !line.is_blank()).map(|line| line.content);
        for delimiter in [',', ';', '\t'] {
            let is_value = |value: &str| value.trim().chars().count() <= MAX_SIGN;
            if filled().all(|line| line.contains(delimiter) && line.split(delimiter).all(is_value)) {
                return Self::Of(delimiter);
            }
        }
        let n_values = |line: &str| line.split_whitespace().count();
        let is_sign = |value: &str| value.chars().count() == 1 || value.parse::<i32>().is_ok();
        let mut values = filled().flat_map(str::split_whitespace);
        let first = values.next();
        if filled().all(|line| 2 <= n_values(line) && line.split_whitespace().all(is_sign))
            && filled().map(n_values).min() == filled().map(n_values).max()
            && values.any(|value| Some(value) != first)
        {
            return Self::Blanks;
        }
        let indent = indent(lines);
        let every_second_is_blank = |line: &str| line.chars().skip(indent + 1).step_by(2).all(|c| c == ' ');
        // The outer wall, with openings.
        let is_full = |line: Option<&str>| {
            line.is_some_and(|line| {
                let cells = || line.chars().skip(indent).step_by(2);
                cells().count() <= 2 * cells().filter(|c| *c != ' ').count()
            })
        };
        let is_wide = |line: &str| indent + 5 <= line.chars().count();
        if 3 <= filled().count()
            && filled().all(|line| every_second_is_blank(line) && is_wide(line))
            && is_full(filled().next())
            && is_full(filled().next_back())
        {
            return Self::EverySecond;
        }
        Self::None
    }
}

/// How many blanks every line begins with.
fn indent(lines: &[Line]) -> usize {
    let blanks = |line: &Line| line.content.chars().take_while(|c| *c == ' ').count();
    lines.iter().filter(|line| !line.is_blank()).map(blanks).min().unwrap_or(0)
}

/// The cells of lines, one line a row.
///
/// # Errors
/// Too many cells, a row of another length than the others where cells are separated, and what is no sign.
pub(super) fn read(lines: &[Line]) -> Result<Grid, TextError> {
    let separator = Separator::of(lines);
    let indent = indent(lines);
    let mut rows = Rows::new();
    for line in lines {
        let place = |column| Place { line: line.number, column };
        match separator {
            _ if line.is_blank() => {}
            Separator::None => {
                for (index, sign) in line.content.chars().enumerate().skip(indent) {
                    // The selector of a symbol's colour has no width.
                    if sign != '\u{fe0f}' {
                        rows.push(sign.encode_utf8(&mut [0; 4]), place(index + 1))?;
                    }
                }
            }
            Separator::EverySecond => {
                for (index, sign) in line.content.chars().enumerate().skip(indent).step_by(2) {
                    rows.push(sign.encode_utf8(&mut [0; 4]), place(index + 1))?;
                }
            }
            Separator::Of(delimiter) => {
                let mut column = 1;
                let content = line.content.strip_suffix(delimiter).unwrap_or(line.content);
                for value in content.split(delimiter) {
                    rows.push(value.trim(), place(column))?;
                    column += value.chars().count() + 1;
                }
            }
            Separator::Blanks => {
                let mut column = 1;
                for value in line.content.split(char::is_whitespace) {
                    if !value.is_empty() {
                        rows.push(value, place(column))?;
                    }
                    column += value.chars().count() + 1;
                }
            }
        }
        if separator == Separator::None || separator == Separator::EverySecond || !line.is_blank() {
            rows.end_row(line.number);
        }
    }
    if matches!(separator, Separator::Of(_) | Separator::Blanks) {
        expect_same_lengths(&rows.rows)?;
    }
    let grid = rows.grid(separator.name())?;
    Ok(if separator == Separator::None { without_doubled_columns(grid) } else { grid })
}

/// A terminal's characters are twice as high as wide, so that many a maze is drawn with two characters a block: every column
/// comes twice, and not every row. A sign that stands beside a blank, such as `S`, means its block.
fn without_doubled_columns(grid: Grid) -> Grid {
    let width = grid.width.div_ceil(2);
    let at = |x: usize, y: usize| if x < grid.width { grid.cells[y * grid.width + x] } else { BLANK };
    let mut counts = vec![0_usize; grid.signs.len()];
    for cell in &grid.cells {
        counts[usize::from(*cell)] += 1;
    }
    // `S` or `SS`.
    let is_rare = |sign: u8| counts[usize::from(sign)] <= 2;
    let pair = |x: usize, y: usize| [at(2 * x, y), at(2 * x + 1, y)];
    let is_double = |[a, b]: [u8; 2]| a == b || (is_rare(a) && b == BLANK) || (is_rare(b) && a == BLANK);
    let columns_double = (0..grid.height).all(|y| (0..width).all(|x| is_double(pair(x, y))));
    let rows_double = grid.height.is_multiple_of(2)
        && grid.cells.chunks(2 * grid.width).all(|rows| {
            let (above, below) = rows.split_at(rows.len() / 2);
            above.iter().zip(below).all(|(above, below)| is_double([*above, *below]))
        });
    if width < 3 || !columns_double || rows_double {
        return grid;
    }
    let cells = (0..grid.height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let cells = cells.map(|(x, y)| {
        let [a, b] = pair(x, y);
        if a == BLANK { b } else { a }
    });
    let columns = (0..grid.height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let columns = columns.map(|(x, y)| grid.columns[y * grid.width + 2 * x]);
    Grid {
        width,
        cells: cells.collect(),
        columns: columns.collect(),
        form: Some("two characters a block"),
        height: grid.height,
        lines: grid.lines.clone(),
        signs: grid.signs.clone(),
    }
}
