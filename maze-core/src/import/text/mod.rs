//! Text mazes as people have them: blocks of any two or more signs, walls drawn as lines, a number of wall bits a cell.
//!
//! The form is told from the file alone: what separates cells, which signs are wall, where start and goal are. Where two
//! readings are equally good the text is refused with both, and [`TextOptions`] decide.

mod bits;
mod drawn;
mod grid;
mod sides;
mod signs;

use crate::assembly::assemble::AssembleOptions;
use crate::assembly::from_layout::BlocksError;
use crate::layout::blocks::Blocks;
use crate::maze::Maze;
use crate::navigation::ends::Endpoint;
use grid::{BLANK, Grid, Line};
use sides::Sides;
use std::borrow::Cow;
use std::fmt::{Display, Formatter};

/// Most cells of a row, and most rows: far above what the ground plan takes, so that no file asks for much memory.
const MAX_SIDE: usize = 4096;

/// Most bytes of a line: a row of [`MAX_SIDE`] cells with a separator of three characters between them.
const MAX_LINE: usize = 8 * MAX_SIDE;

/// Most blocks, ragged lines filled up.
const MAX_BLOCKS: usize = 1 << 22;

/// Most different signs, the blank among them.
const MAX_SIGNS: usize = 64;

/// A place in a text, both counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// Line.
    pub line: usize,
    /// Character of the line.
    pub column: usize,
}

impl Display for Place {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> std::fmt::Result {
        write!(formatter, "line {}, column {}", self.line, self.column)
    }
}

/// What the user says about the signs of a text; each is found where nothing is said.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TextOptions {
    /// The signs of walls, such as `#X`.
    pub wall: Option<String>,
    /// The signs of free blocks.
    pub free: Option<String>,
    /// The sign of the start.
    pub start: Option<String>,
    /// The sign of the goal.
    pub goal: Option<String>,
}

impl TextOptions {
    /// Whether nothing is said.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

/// Why a text is no maze.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TextError {
    /// There is nothing.
    #[error("the file is empty: expected a maze, such as one of `#`, blanks, `S` and `G`")]
    Empty,
    /// No walls.
    #[error("{n_lines} lines without a wall: expected a maze, such as one of `#`, blanks, `S` and `G`")]
    NoWalls {
        /// Lines read.
        n_lines: usize,
    },
    /// Not UTF-8.
    #[error("{place}: not a text file (byte {byte:#04x}): expected a maze in UTF-8")]
    NotText {
        /// Of the byte.
        place: Place,
        /// Which is not UTF-8.
        byte: u8,
    },
    /// A sign without a meaning.
    #[error(
        "{place}: `{found}`, {n} in all, is neither wall nor free nor start nor goal: expected text.wall, text.free, text.start or \
         text.goal to say what it is", found = found.escape_debug()
    )]
    Unknown {
        /// Of the first one.
        place: Place,
        /// The sign.
        found: String,
        /// How many.
        n: usize,
    },
    /// No sign of a maze, or one too many.
    #[error("{place}: `{found}`: expected a maze of at most {max} different signs", found = found.escape_debug(), max = MAX_SIGNS - 1)]
    NoSign {
        /// Of the sign.
        place: Place,
        /// The sign, shortened.
        found: String,
    },
    /// Reserved.
    #[error(
        "{place}: `O` is reserved for holes, which this game does not have yet: expected text.free or text.wall to say what it is"
    )]
    Hole {
        /// Of the first.
        place: Place,
    },
    /// Two readings are equally good.
    #[error(
        "{what} can be {one} or {other}: expected {key} to say which", key = match *what {
            "bits" => "numbers that fit one order of bits",
            "start" => "text.start",
            _ => "text.wall",
        }
    )]
    Ambiguous {
        /// What has two readings.
        what: &'static str,
        /// One.
        one: String,
        /// The other.
        other: String,
    },
    /// Two starts or two goals.
    #[error("{place}: a second `{name}`: the first one is at {first}", name = name.escape_debug())]
    Twice {
        /// Of the second.
        place: Place,
        /// Of the first.
        first: Place,
        /// The sign.
        name: String,
    },
    /// A sign that was stated does not occur.
    #[error("text.{name} is `{sign}`, which is nowhere in the file", sign = sign.escape_debug())]
    NotThere {
        /// Start or goal.
        name: &'static str,
        /// The sign.
        sign: String,
    },
    /// Said to be wall and free.
    #[error("`{sign}` is both in text.wall and in text.free", sign = sign.escape_debug())]
    StatedTwice {
        /// The sign.
        sign: String,
    },
    /// Start or goal has no room.
    #[error("{place}: the ball does not fit at the {end}: expected a free place between the walls")]
    NoRoomAt {
        /// Of the sign.
        place: Place,
        /// Which of the two.
        end: Endpoint,
    },
    /// Too wide.
    #[error("{place}: the line goes on: expected at most {max} cells", max = MAX_SIDE)]
    TooWide {
        /// Of the first cell too many.
        place: Place,
    },
    /// Too high, or too large altogether.
    #[error("{n_lines} lines of up to {width} characters: expected at most {max} lines and {blocks} characters in all",
        max = MAX_SIDE, blocks = MAX_BLOCKS)]
    TooLarge {
        /// Lines, without empty ones at the end.
        n_lines: usize,
        /// The longest.
        width: usize,
    },
    /// Too many cells with walls at their sides.
    #[error("{width} x {height} cells: expected at most {max} in all", max = MAX_BLOCKS / 4)]
    TooManyCells {
        /// Cells in a row.
        width: usize,
        /// Rows.
        height: usize,
    },
    /// A row of another length.
    #[error("line {line}: a row of {n_cells} cells: expected {expected}, as in the first one")]
    RowLength {
        /// Of the row.
        line: usize,
        /// Its cells.
        n_cells: usize,
        /// Those of the first row.
        expected: usize,
    },
    /// The first line says another size.
    #[error("line 1 says {said}: the maze below it has {n_rows} rows of {n_columns}")]
    Header {
        /// What it says.
        said: String,
        /// Rows.
        n_rows: usize,
        /// Cells in a row.
        n_columns: usize,
    },
    /// A stroke beside the others.
    #[error("{place}: a wall at no corner of the cells, which are {step} characters apart")]
    OffGrid {
        /// Of the stroke.
        place: Place,
        /// From one wall to the next.
        step: usize,
    },
    /// Two neighbours say different things about the wall between them.
    #[error(
        "{place}: the cell and its neighbour disagree whether a wall is between them, as {n} pairs do: expected wall bits that agree"
    )]
    Disagree {
        /// Of the first such cell.
        place: Place,
        /// How many.
        n: usize,
    },
    /// Something behind the cells.
    #[error(
        "line {line}: expected start and goal as `x,y` within the maze, and a path of N, E, S and W between them"
    )]
    Trailer {
        /// Of the line.
        line: usize,
    },
    /// The walls make no maze.
    #[error(transparent)]
    Blocks(#[from] BlocksError),
}

/// A maze that was read from a text.
#[derive(Clone, Debug)]
pub struct TextMaze {
    /// Its walls.
    pub blocks: Blocks,
    /// How the text was read, in words.
    pub found: String,
    /// Where start and goal stand in the text.
    places: [Option<Place>; 2],
}

impl TextMaze {
    /// The maze in maze units.
    ///
    /// # Errors
    /// Walls that make no maze, and a start or goal where the ball does not fit.
    pub fn maze(&self, options: &AssembleOptions) -> Result<Maze, TextError> {
        self.blocks.maze(options).map_err(|error| match error {
            BlocksError::NoRoomAt { end } => match self.places[end as usize] {
                Some(place) => TextError::NoRoomAt { place, end },
                None => error.into(),
            },
            other => other.into(),
        })
    }
}

/// Reads a text. Blanks at the end of a line and empty lines at the end of the file mean nothing, shorter lines are filled up
/// with free blocks; line ends may be those of any system.
///
/// # Errors
/// With line and column.
///
/// ```
/// use maze_core::import::text::{self, TextOptions};
/// use maze_core::AssembleOptions;
///
/// let text = "# ####\n# #  #\n#   ##\n### ##\n";
/// let maze = text::read(text.as_bytes(), &TextOptions::default())?.maze(&AssembleOptions::default())?;
/// assert_eq!(maze.openings.len(), 2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn read(bytes: &[u8], options: &TextOptions) -> Result<TextMaze, TextError> {
    let text = decode(bytes)?;
    let lines = grid::lines(&text)?;
    let header =
        lines.split_first().and_then(|(first, body)| Some((grid::sizes(first.content)?, first, body)));
    // A number as long as the next line is a row of digits.
    let is_row = |first: &Line, body: &[Line]| {
        let next = body.iter().find(|line| !line.is_blank());
        next.is_none_or(|next| {
            first.content.len() == next.content.len() && first.content.parse::<u64>().is_ok()
        })
    };
    let Some((sizes, first, body)) = header.filter(|(_, first, body)| !is_row(first, body)) else {
        return Ok(Read::new(&lines, options)?.maze);
    };
    let body = &body[body.iter().take_while(|line| line.is_blank()).count()..];
    let below = Read::new(body, options);
    if let Ok(mut below) = below.clone()
        && below.has_sizes(&sizes)
    {
        below.maze.found += &format!("; line {}, `{}`, is its size", first.number, first.content.trim());
        return Ok(below.maze);
    }
    let is_digit_below = |digit: char| body.iter().any(|line| line.content.contains(digit));
    if first.content.chars().any(|c| c.is_ascii_digit() && is_digit_below(c))
        && let Ok(all) = Read::new(&lines, options)
    {
        return Ok(all.maze);
    }
    let [n_columns, n_rows] = below?.sizes[0];
    Err(TextError::Header { said: first.content.trim().to_owned(), n_rows, n_columns })
}

/// The text of a file in UTF-8, or in UTF-16 with the mark by which it is known.
fn decode(bytes: &[u8]) -> Result<Cow<'_, str>, TextError> {
    let utf16 = match bytes {
        [0xff, 0xfe, rest @ ..] => Some((rest, u16::from_le_bytes as fn([u8; 2]) -> u16)),
        [0xfe, 0xff, rest @ ..] => Some((rest, u16::from_be_bytes as fn([u8; 2]) -> u16)),
        _ => None,
    };
    if let Some((rest, unit)) = utf16 {
        let units = rest.chunks_exact(2).map(|pair| unit([pair[0], pair[1]]));
        return Ok(char::decode_utf16(units)
            .map(|unit| unit.unwrap_or(char::REPLACEMENT_CHARACTER))
            .collect());
    }
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    std::str::from_utf8(bytes).map(Cow::from).map_err(|error| not_text(bytes, error.valid_up_to()))
}

/// The place of a byte that is not UTF-8.
fn not_text(bytes: &[u8], offset: usize) -> TextError {
    let before = String::from_utf8_lossy(&bytes[..offset]);
    let line = before.matches('\n').count() + 1;
    let column = before.chars().rev().take_while(|character| *character != '\n').count() + 1;
    TextError::NotText { place: Place { line, column }, byte: bytes[offset] }
}

/// A maze, and the sizes by which a header may call it: cells in a row and rows.
#[derive(Clone)]
struct Read {
    maze: TextMaze,
    sizes: Vec<[usize; 2]>,
}

impl Read {
    /// Reads lines that are a maze and nothing else.
    fn new(lines: &[Line], options: &TextOptions) -> Result<Self, TextError> {
        if grid::is_list(lines) {
            return Self::blocks(&grid::read_list(lines)?, options);
        }
        let (cells, trailer) = lines.split_at(lines.iter().position(Line::is_blank).unwrap_or(lines.len()));
        if options.is_empty()
            && let Ok(grid) = grid::read(cells)
            && bits::is_numbers(&grid)
        {
            match bits::read(&grid) {
                // So few that it is a slip and not another kind of file.
                Err(TextError::Disagree { n, .. }) if grid.cells.len() < 10 * n => {}
                numbers => return Self::numbers(&numbers?, trailer),
            }
        }
        if drawn::is_drawn(lines) {
            return Self::drawing(lines, options);
        }
        Self::blocks(&grid::read(lines)?, options)
    }

    fn blocks(grid: &Grid, options: &TextOptions) -> Result<Self, TextError> {
        let reading = signs::read(grid, options)?;
        let too_large = TextError::TooLarge { n_lines: grid.height, width: grid.width };
        let (blocks, is_framed) = blocks(grid, &reading).ok_or(too_large)?;
        let (width, height) = (grid.width, grid.height);
        let mut found = format!("{width} x {height} blocks");
        if let Some(form) = grid.form {
            found += &format!(", {form}");
        }
        found += &format!(": {}", reading.words(grid));
        if is_framed {
            found += "; a wall was laid around it";
        }
        let places = reading.ends.map(|end| end.map(|cell| grid.place(cell)));
        let sizes = vec![[width, height], [width / 2, height / 2]];
        Ok(Self { maze: TextMaze { blocks, found, places }, sizes })
    }

    fn numbers(numbers: &bits::Numbers, trailer: &[Line]) -> Result<Self, TextError> {
        let bits::Trailer { ends, places } = bits::read_trailer(trailer, &numbers.sides)?;
        Self::sides(
            &numbers.sides,
            ends,
            places,
            numbers.words(),
            [numbers.sides.width, numbers.sides.height],
        )
    }

    fn drawing(lines: &[Line], options: &TextOptions) -> Result<Self, TextError> {
        let drawing = drawn::read(lines, options)?;
        let words = drawing.words() + &drawn::Drawing::end_words(lines, drawing.places);
        let width = lines.iter().map(|line| line.content.chars().count()).max().unwrap_or(0);
        Self::sides(&drawing.sides, drawing.ends, drawing.places, words, [width, lines.len()])
    }

    fn sides(
        sides: &Sides,
        ends: [Option<sides::End>; 2],
        places: [Option<Place>; 2],
        words: String,
        characters: [usize; 2],
    ) -> Result<Self, TextError> {
        let (width, height) = (sides.width, sides.height);
        let blocks = sides.blocks(ends).ok_or(TextError::TooManyCells { width, height })?;
        let found = format!("{width} x {height} cells, {words}");
        Ok(Self { maze: TextMaze { blocks, found, places }, sizes: vec![[width, height], characters] })
    }

    /// Whether these are the sizes of the maze, in whatever order.
    fn has_sizes(&self, sizes: &[usize]) -> bool {
        self.sizes.iter().any(|[width, height]| match sizes {
            [one] => one == width || one == height,
            [one, other] => [one, other] == [width, height] || [other, one] == [width, height],
            _ => false,
        })
    }
}

/// The blocks of a grid, and whether a wall was laid around them: where a whole outer row or column has no wall, or more than a
/// quarter of the border is free, what is outside would be open to the ball.
fn blocks(grid: &Grid, reading: &signs::Reading) -> Option<(Blocks, bool)> {
    let is_wall = |cell: usize| reading.is_wall[usize::from(grid.cells[cell])];
    let is_drawn = |cell: &usize| grid.cells[*cell] != BLANK || is_wall(*cell);
    let mut low = [grid.width, grid.height];
    let mut high = [0, 0];
    for cell in (0..grid.cells.len()).filter(is_drawn) {
        for (axis, at) in [cell % grid.width, cell / grid.width].into_iter().enumerate() {
            low[axis] = low[axis].min(at);
            high[axis] = high[axis].max(at);
        }
    }
    let sides = [
        (low[0]..=high[0]).map(|x| low[1] * grid.width + x).collect::<Vec<_>>(),
        (low[0]..=high[0]).map(|x| high[1] * grid.width + x).collect(),
        (low[1]..=high[1]).map(|y| y * grid.width + low[0]).collect(),
        (low[1]..=high[1]).map(|y| y * grid.width + high[0]).collect(),
    ];
    let is_open = |cell: &usize| is_drawn(cell) && !is_wall(*cell) && !reading.ends.contains(&Some(*cell));
    let n_open = sides.iter().flatten().filter(|cell| is_open(cell)).count();
    let n_border: usize = sides.iter().map(Vec::len).sum();
    let is_framed = n_border < 4 * n_open || sides.iter().any(|side| !side.iter().any(|cell| is_wall(*cell)));
    let (low, high) = if is_framed { (low, high) } else { ([0, 0], [grid.width - 1, grid.height - 1]) };
    let ring = usize::from(is_framed);
    let [width, height] = [0, 1].map(|axis| high[axis] + 1 - low[axis] + 2 * ring);
    let cell = |x: usize, y: usize| {
        // Row 0 of blocks is the lowest.
        let [x, y] = [(x + low[0]).checked_sub(ring)?, (height - 1 - y + low[1]).checked_sub(ring)?];
        (low[0] <= x && x <= high[0] && low[1] <= y && y <= high[1]).then(|| y * grid.width + x)
    };
    let wall = (0..width * height).map(|block| cell(block % width, block / width).is_none_or(is_wall));
    let ends = reading.ends.map(|end| {
        let [x, y] = end.map(|cell| [cell % grid.width, cell / grid.width])?;
        Some([x + ring - low[0], height - 1 - (y + ring - low[1])])
    });
    Some((Blocks::new(width, height, wall.collect(), ends)?, is_framed))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{AssembleOptions, Facing, Maze, export};

    const ROOMS: &str = "#######\n#S    #\n# ### #\n#   #G#\n#######\n";

    fn maze(text: &str) -> Maze {
        blocks(text).maze(&AssembleOptions::default()).unwrap()
    }

    fn blocks(text: &str) -> Blocks {
        read(text.as_bytes(), &TextOptions::default()).unwrap().blocks
    }

    fn message(text: &[u8]) -> String {
        read(text, &TextOptions::default()).unwrap_err().to_string()
    }

    #[test]
    fn walls_are_where_the_text_has_them_and_start_and_goal_too() {
        let maze = maze(ROOMS);
        assert_eq!(maze.report.scale, 1.0);
        assert!(maze.is_solvable() && maze.report.has_floor && maze.openings.is_empty());
        assert_eq!((maze.start().x, maze.start().y), (-2.0, 1.0));
        assert_eq!((maze.goal().x, maze.goal().y), (2.0, -1.0));
        let planes = Facing::ALL.map(|facing| maze.planes.n_planes(facing));
        // +x: the outer wall and the hook's right side; -x: the outer wall and the hook's two left ends; and so on.
        assert_eq!(planes, [2, 3, 3, 2]);
    }

    #[test]
    fn the_other_line_ends_a_mark_at_the_front_and_ragged_lines_are_the_same_maze() {
        let whole = blocks(ROOMS);
        for other in [
            ROOMS.replace('\n', "\r\n"),
            ROOMS.replace('\n', "\r"),
            ROOMS.replace('\n', "   \n"),
            format!("\u{feff}{ROOMS}"),
            format!("{ROOMS}\n \n\n"),
            ROOMS.trim_end().to_owned(),
        ] {
            assert_eq!(blocks(&other), whole, "{other:?}");
        }
        let ragged = blocks("###\n#\n###");
        assert_eq!((ragged.width(), ragged.height()), (3, 3));
        assert!(!ragged.is_wall(1, 1) && !ragged.is_wall(2, 1));
    }

    #[test]
    fn empty_lines_and_an_indent_move_the_maze_and_change_nothing_else() {
        let indented: String = ROOMS.lines().map(|line| format!("   {line}\n")).collect();
        let moved = maze(&format!("\n\n{indented}"));
        let maze = maze(ROOMS);
        assert_eq!(moved.planes, maze.planes);
        assert_eq!((moved.start(), moved.goal(), moved.bounds), (maze.start(), maze.goal(), maze.bounds));
    }

    #[test]
    fn wide_corridors_are_scaled_to_one_and_walls_keep_their_look() {
        let twice: String = ROOMS
            .lines()
            .map(|line| {
                line.chars().flat_map(|block| [block, if block == '#' { '#' } else { ' ' }]).collect()
            })
            .flat_map(|line: String| [line.clone() + "\n", line.replace(['S', 'G'], " ") + "\n"])
            .collect();
        let (maze, wide) = (maze(ROOMS), maze(&twice));
        assert_eq!((wide.report.scale, wide.wall_height), (0.5, maze.wall_height));
        assert_eq!(wide.planes, maze.planes);
    }

    #[test]
    fn without_letters_the_openings_are_start_and_goal() {
        let maze = maze("# ###\n# # #\n#   #\n### #\n");
        assert_eq!(maze.openings.len(), 2);
        assert!(maze.is_solvable() && maze.start().y > 1.0 && maze.goal().y < -1.0);
    }

    #[test]
    fn written_and_read_again_it_is_the_same() {
        for text in [ROOMS, "# ###\n# # #\n#   #\n### #\n", "  ##\n #\n##"] {
            let read = blocks(text);
            let written = export::text::write(&read);
            assert_eq!(blocks(&written), read);
            assert_eq!(written.trim_end(), text.trim_end());
        }
    }

    #[test]
    fn what_is_wrong_is_told_with_line_and_column() {
        assert!(message(b"").starts_with("the file is empty: expected a maze"));
        assert_eq!(message(b"  \r\n \n"), message(b""));
        assert!(message(b"S G\n").starts_with("1 lines without a wall"), "{}", message(b"S G\n"));
        assert_eq!(
            message(b"#####\n#q q#\n#####\n"),
            "line 2, column 2: `q`, 2 in all, is neither wall nor free nor start nor goal: expected text.wall, text.free, \
             text.start or text.goal to say what it is"
        );
        assert!(message(b"###\n# \x07 #\n#####").starts_with("line 2, column 3: `\\u{7}`, 1 in all"));
        assert!(message("###\n#\u{e9} #\u{e9}".as_bytes()).starts_with("line 2, column 2: `\u{e9}`"));
        assert!(message(b"###\n#\xff").starts_with("line 2, column 2: not a text file (byte 0xff)"));
        assert!(message(b"####\n# O#\n").starts_with("line 2, column 3: `O` is reserved for holes"));
        assert_eq!(
            message(b"#S#\n#S#"),
            "line 2, column 2: a second `S`: the first one is at line 1, column 2"
        );
        let wide = [b"#".repeat(4096), b"##".to_vec()].join(&b'\n');
        assert!(read(&wide, &TextOptions::default()).is_ok());
        assert!(message(&b"#".repeat(4097)).starts_with("line 1, column 4097: the line goes on"));
        assert!(message(&b"#\n".repeat(4097)).starts_with("4097 lines of up to 1 characters"));
        assert!(message(&[b"#".repeat(4096), b"\n#".repeat(4000)].concat()).starts_with("4001 lines"));
    }

    #[test]
    fn ends_where_no_ball_fits_are_told() {
        let [wall, hall] = ["#".repeat(42), format!("#{}#", " ".repeat(40))];
        let slit = wall.replacen("######", "##### ", 1);
        let goal = hall.replacen("# ", "#G", 1);
        let mut lines = vec![wall.clone(), hall.clone(), goal, hall];
        lines.extend([slit.clone(), slit.clone(), slit.clone(), slit.replacen(' ', "S", 1), wall]);
        let text = lines.join("\n");
        let read = read(text.as_bytes(), &TextOptions::default()).unwrap();
        // A ball that passes the slit is found; the usual one does not fit there.
        let maze = read.maze(&AssembleOptions::default()).unwrap();
        assert!(
            maze.is_solvable() && maze.report.passing_radius == crate::Radius::new(0.16).ok(),
            "{:?}",
            maze.report.passing_radius
        );
        let usual = AssembleOptions { ball_radius: crate::Radius::new(0.35).ok(), ..Default::default() };
        let error = read.maze(&usual).err().map(|error| error.to_string()).unwrap_or_default();
        assert!(error.starts_with("line 8, column 6: the ball does not fit at the start"), "{error}");
    }

    #[test]
    fn rooms_without_a_way_between_them_load_unsolvable() {
        let maze = maze("#####\n#S#G#\n# # #\n#####");
        assert!(!maze.is_solvable());
    }
}
