//! Text: one character a block, `#` wall, space free, `S` start, `G` goal.

use crate::blocks::Blocks;
use std::fmt::{Display, Formatter};

/// Most characters of a line, and most lines: far above what the ground plan takes, so that no file asks for much memory.
const MAX_SIDE: usize = 4096;

/// Most blocks, ragged lines filled up.
const MAX_BLOCKS: usize = 1 << 22;

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

/// Why a text is no maze.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TextError {
    /// There is nothing.
    #[error("the file is empty: expected a maze of `#`, space, `S` and `G`")]
    Empty,
    /// No walls.
    #[error("{n_lines} lines without a `#`: expected walls")]
    NoWalls {
        /// Lines read.
        n_lines: usize,
    },
    /// Not UTF-8.
    #[error("{place}: not a text file (byte {byte:#04x}): expected `#`, space, `S` or `G`")]
    NotText {
        /// Of the byte.
        place: Place,
        /// Which is not UTF-8.
        byte: u8,
    },
    /// Another character.
    #[error("{place}: found {found:?}: expected `#` (wall), space (free), `S` (start) or `G` (goal)")]
    Unknown {
        /// Of the character.
        place: Place,
        /// The character.
        found: char,
    },
    /// Reserved.
    #[error(
        "{place}: `O` is reserved for holes, which this game does not have yet: expected `#`, space, `S` or `G`"
    )]
    Hole {
        /// Of the first.
        place: Place,
    },
    /// Two starts or two goals.
    #[error("{place}: a second `{name}`: the first one is at {first}")]
    Twice {
        /// Of the second.
        place: Place,
        /// Of the first.
        first: Place,
        /// `S` or `G`.
        name: char,
    },
    /// A start without a goal or the other way round.
    #[error("{place}: `{name}` without `{other}`: expected both or neither")]
    Alone {
        /// Of the one.
        place: Place,
        /// Which is there.
        name: char,
        /// Which is not.
        other: char,
    },
    /// Too wide.
    #[error("{place}: the line goes on: expected at most {max} characters", max = MAX_SIDE)]
    TooWide {
        /// Of the first character too many.
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
}

/// The blocks of a text. Spaces at the end of a line and empty lines at the end of the file mean nothing, shorter lines are
/// filled up with free blocks; line ends may be those of any system.
///
/// # Errors
/// With line and column.
pub fn read(bytes: &[u8]) -> Result<Blocks, TextError> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let text = std::str::from_utf8(bytes).map_err(|error| not_text(bytes, error.valid_up_to()))?;
    if text.trim_ascii().is_empty() {
        return Err(TextError::Empty);
    }
    // Old Macintoshes ended lines with a carriage return alone.
    let line_end = if text.contains('\n') { '\n' } else { '\r' };
    let lines = || text.trim_ascii_end().split(line_end).map(str::trim_ascii_end);
    let (mut n_lines, mut width) = (0, 0);
    for content in lines() {
        n_lines += 1;
        // Bytes are enough to refuse by: a character of more than one is refused anyway.
        if MAX_SIDE < content.len() && content.is_ascii() {
            return Err(TextError::TooWide { place: Place { line: n_lines, column: MAX_SIDE + 1 } });
        }
        width = if width < content.len() { content.len() } else { width };
    }
    let mut ends: [Option<Place>; 2] = [None, None];
    let mut n_walls = 0_usize;
    // First all characters, so that a file that is no maze at all is told by its first wrong one and not by its size.
    for (index, content) in lines().enumerate() {
        for (column, found) in content.chars().enumerate() {
            let place = Place { line: index + 1, column: column + 1 };
            match found {
                '#' => n_walls += 1,
                ' ' => {}
                'S' | 'G' => {
                    let end = &mut ends[usize::from(found == 'G')];
                    if let Some(first) = end.replace(place) {
                        return Err(TextError::Twice { place, first, name: found });
                    }
                }
                'O' => return Err(TextError::Hole { place }),
                _ => return Err(TextError::Unknown { place, found }),
            }
        }
    }
    let ends = match ends {
        [Some(start), Some(goal)] => Some([start, goal]),
        [None, None] => None,
        [Some(place), None] => return Err(TextError::Alone { place, name: 'S', other: 'G' }),
        [None, Some(place)] => return Err(TextError::Alone { place, name: 'G', other: 'S' }),
    };
    if n_walls == 0 {
        return Err(TextError::NoWalls { n_lines });
    }
    let too_large = TextError::TooLarge { n_lines, width };
    if MAX_SIDE < n_lines || MAX_BLOCKS < n_lines * width {
        return Err(too_large);
    }
    let mut wall = vec![false; n_lines * width];
    for (index, content) in lines().enumerate() {
        let row = &mut wall[(n_lines - 1 - index) * width..];
        for (block, character) in row.iter_mut().zip(content.bytes()) {
            *block = character == b'#';
        }
    }
    let ends = ends.map(|ends| ends.map(|place| [place.column - 1, n_lines - place.line]));
    Blocks::new(width, n_lines, wall, ends).ok_or(too_large)
}

/// The place of a byte that is not UTF-8.
fn not_text(bytes: &[u8], offset: usize) -> TextError {
    let before = String::from_utf8_lossy(&bytes[..offset]);
    let line = before.matches('\n').count() + 1;
    let column = before.chars().rev().take_while(|character| *character != '\n').count() + 1;
    TextError::NotText { place: Place { line, column }, byte: bytes[offset] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{AssembleOptions, Facing, Maze, export};

    const ROOMS: &str = "#######\n#S    #\n# ### #\n#   #G#\n#######\n";

    fn maze(text: &str) -> Maze {
        read(text.as_bytes()).unwrap().maze(&AssembleOptions::default()).unwrap()
    }

    fn message(text: &[u8]) -> String {
        read(text).unwrap_err().to_string()
    }

    #[test]
    fn walls_are_where_the_text_has_them_and_start_and_goal_too() {
        let maze = maze(ROOMS);
        assert_eq!(maze.scale, 1.0);
        assert!(maze.solvable && maze.has_floor && maze.openings.is_empty());
        assert_eq!((maze.start.x, maze.start.y), (-2.0, 1.0));
        assert_eq!((maze.goal.x, maze.goal.y), (2.0, -1.0));
        let planes = Facing::ALL.map(|facing| maze.planes.n_planes(facing));
        // +x: the outer wall and the hook's right side; -x: the outer wall and the hook's two left ends; and so on.
        assert_eq!(planes, [2, 3, 3, 2]);
    }

    #[test]
    fn the_other_line_ends_a_mark_at_the_front_and_ragged_lines_are_the_same_maze() {
        let whole = read(ROOMS.as_bytes()).unwrap();
        for other in [
            ROOMS.replace('\n', "\r\n"),
            ROOMS.replace('\n', "\r"),
            ROOMS.replace('\n', "   \n"),
            format!("\u{feff}{ROOMS}"),
            format!("{ROOMS}\n \n\n"),
            ROOMS.trim_end().to_owned(),
        ] {
            assert_eq!(read(other.as_bytes()).unwrap(), whole, "{other:?}");
        }
        let ragged = read(b"###\n#\n###").unwrap();
        assert_eq!((ragged.width(), ragged.height()), (3, 3));
        assert!(!ragged.is_wall(1, 1) && !ragged.is_wall(2, 1));
    }

    #[test]
    fn empty_lines_and_an_indent_move_the_maze_and_change_nothing_else() {
        let indented: String = ROOMS.lines().map(|line| format!("   {line}\n")).collect();
        let moved = maze(&format!("\n\n{indented}"));
        let maze = maze(ROOMS);
        assert_eq!(moved.planes, maze.planes);
        assert_eq!((moved.start, moved.goal, moved.bounds), (maze.start, maze.goal, maze.bounds));
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
        assert_eq!((wide.scale, wide.wall_height), (0.5, maze.wall_height));
        assert_eq!(wide.planes, maze.planes);
    }

    #[test]
    fn without_letters_the_openings_are_start_and_goal() {
        let maze = maze("# ###\n# # #\n#   #\n### #\n");
        assert_eq!(maze.openings.len(), 2);
        assert!(maze.solvable && maze.start.y > 1.0 && maze.goal.y < -1.0);
    }

    #[test]
    fn written_and_read_again_it_is_the_same() {
        for text in [ROOMS, "# ###\n# # #\n#   #\n### #\n", "  ##\n #\n##"] {
            let blocks = read(text.as_bytes()).unwrap();
            let written = export::text::write(&blocks);
            assert_eq!(read(written.as_bytes()).unwrap(), blocks);
            assert_eq!(written.trim_end(), text.trim_end());
        }
    }

    #[test]
    fn what_is_wrong_is_told_with_line_and_column() {
        assert_eq!(message(b""), "the file is empty: expected a maze of `#`, space, `S` and `G`");
        assert_eq!(message(b"  \r\n \n"), message(b""));
        assert_eq!(message(b"S G\n"), "1 lines without a `#`: expected walls");
        assert_eq!(
            message(b"###\n#x#\n"),
            "line 2, column 2: found 'x': expected `#` (wall), space (free), `S` (start) or `G` (goal)"
        );
        assert!(message(b"###\n#\t#\n").starts_with("line 2, column 2: found '\\t'"));
        assert!(message("###\n\u{e9}#\u{1f600}".as_bytes()).starts_with("line 2, column 1: found '\u{e9}'"));
        assert!(message(b"###\n#\xff").starts_with("line 2, column 2: not a text file (byte 0xff)"));
        assert!(message(b"###\n# O#\n").starts_with("line 2, column 3: `O` is reserved for holes"));
        assert_eq!(
            message(b"#S#\n#S#"),
            "line 2, column 2: a second `S`: the first one is at line 1, column 2"
        );
        assert_eq!(message(b"###\n#G#"), "line 2, column 2: `G` without `S`: expected both or neither");
        let wide = [b"#".repeat(4096), b"##".to_vec()].join(&b'\n');
        assert!(read(&wide).is_ok());
        assert!(message(&b"#".repeat(4097)).starts_with("line 1, column 4097: the line goes on"));
        assert!(message(&b"#\n".repeat(4097)).starts_with("4097 lines of up to 1 characters"));
        assert!(message(&[b"#".repeat(4096), b"\n#".repeat(4000)].concat()).starts_with("4001 lines"));
    }

    #[test]
    fn ends_where_no_ball_fits_are_told() {
        let outside = read(b"S ###\n  # #\n  #G#\n  ###").unwrap();
        let error = outside.maze(&AssembleOptions::default()).unwrap_err().to_string();
        assert!(error.starts_with("line 1, column 1: the ball does not fit at `S`"), "{error}");
    }

    #[test]
    fn rooms_without_a_way_between_them_load_unsolvable() {
        let maze = maze("#####\n#S#G#\n# # #\n#####");
        assert!(!maze.solvable);
    }
}
