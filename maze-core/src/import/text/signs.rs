//! Which signs of a text are wall, free, start and goal.

use super::grid::{BLANK, Grid};
use super::{TextError, TextOptions};

/// Most signs of which every combination is tried; files have two or three.
const MAX_UNDECIDED: usize = 5;

/// Most cells times combinations that are tried: a second or two.
const MAX_LOOKS: usize = 1 << 26;

/// Signs that draw a wall, or free space, wherever they are used in that sense in most files.
const WALLS: &str = "#%█▓▒■◼▉▇▊＃🧱";
const FREE: &str = " ._·⋅∙░□▫◻,";

/// Signs that often do.
const OFTEN_WALLS: &str = "XxWwHM*@+|=&⬛";
const OFTEN_FREE: &str = "-oO:~'`⬜";

/// Signs of a start and of a goal, each the first that is there; letters in either case.
const STARTS: &str = "SIPA@^2RM🟢🟩";
const GOALS: &str = "GEFBTDXZCQK$*!3.🔴🟥🏁";

/// Signs that are start and goal together although they are not where [`STARTS`] and [`GOALS`] have them: begin and end, entry
/// and exit.
const PAIRS: [[char; 2]; 2] = [['B', 'E'], ['E', 'X']];

/// What each sign of a grid means.
#[derive(Clone, Debug)]
pub(super) struct Reading {
    /// By sign: whether it is wall.
    pub(super) is_wall: Vec<bool>,
    /// The cells of start and goal.
    pub(super) ends: [Option<usize>; 2],
}

impl Reading {
    /// In words, for a reader who wants to know how a file was taken.
    pub(super) fn words(&self, grid: &Grid) -> String {
        let counts = counts(grid);
        let end_signs = self.ends.map(|end| end.map(|cell| grid.cells[cell]));
        let list = |wanted: bool| {
            let is_meant = |sign: usize| {
                counts[sign] != 0
                    && self.is_wall[sign] == wanted
                    && !end_signs.contains(&u8::try_from(sign).ok())
            };
            let signs = (0..grid.signs.len()).filter(|sign| is_meant(*sign));
            let signs: Vec<String> = signs.map(|sign| quoted(&grid.signs[sign])).collect();
            if signs.is_empty() { "none".to_owned() } else { signs.join(" ") }
        };
        let mut words = format!("wall {}, free {}", list(true), list(false));
        for (name, sign) in ["start", "goal"].iter().zip(end_signs) {
            if let Some(sign) = sign {
                words += &format!(", {name} {}", quoted(&grid.signs[usize::from(sign)]));
            }
        }
        words
    }
}

/// A sign as a message shows it.
pub(super) fn quoted(sign: &str) -> String {
    match sign {
        " " => "blank".to_owned(),
        _ => format!("`{}`", sign.escape_debug()),
    }
}

/// The first cell of a sign, in reading order.
fn first_cell(grid: &Grid, sign: usize) -> Option<usize> {
    grid.cells.iter().position(|cell| usize::from(*cell) == sign)
}

/// How often each sign occurs.
fn counts(grid: &Grid) -> Vec<usize> {
    let mut counts = vec![0; grid.signs.len()];
    for cell in &grid.cells {
        counts[usize::from(*cell)] += 1;
    }
    counts
}

/// The only character of a sign, in upper case.
fn letter(sign: &str) -> Option<char> {
    let mut characters = sign.chars();
    let first = characters.next().filter(|_| characters.next().is_none())?;
    Some(first.to_ascii_uppercase())
}

/// Whether a text names a sign: it is the sign, or one of its characters is.
fn names(stated: Option<&str>, sign: &str) -> bool {
    stated.is_some_and(|stated| stated == sign || (sign.chars().count() == 1 && stated.contains(sign)))
}

/// What the signs of a grid mean: as stated, else by start and goal, by the border, by what is connected, and by custom.
///
/// # Errors
/// Signs of two meanings, of none, and several starts or goals.
pub(super) fn read(grid: &Grid, options: &TextOptions) -> Result<Reading, TextError> {
    let counts = counts(grid);
    let ends = find_ends(grid, &counts, options)?;
    let is_end = |sign: usize| ends.iter().flatten().any(|cell| usize::from(grid.cells[*cell]) == sign);
    let mut is_wall = vec![false; grid.signs.len()];
    let mut undecided = Vec::new();
    for sign in (1..grid.signs.len()).filter(|sign| counts[*sign] != 0 && !is_end(*sign)) {
        let text = grid.signs[sign].as_str();
        match (names(options.wall.as_deref(), text), names(options.free.as_deref(), text)) {
            (true, true) => return Err(TextError::StatedTwice { sign: text.to_owned() }),
            (true, false) => is_wall[sign] = true,
            (false, true) => {}
            // One of the two is stated: all others are the other one.
            _ if options.wall.is_some() && options.free.is_none() => {}
            _ if options.wall.is_none() && options.free.is_some() => is_wall[sign] = true,
            _ => undecided.push(sign),
        }
    }
    if names(options.wall.as_deref(), " ") {
        is_wall[usize::from(BLANK)] = true;
    }
    if !undecided.is_empty() {
        decide(grid, &counts, ends, &undecided, &mut is_wall)?;
    }
    if !grid.cells.iter().any(|cell| is_wall[usize::from(*cell)]) {
        return Err(TextError::NoWalls { n_lines: grid.height });
    }
    Ok(Reading { is_wall, ends })
}

/// Sets which of the undecided signs are wall.
fn decide(
    grid: &Grid,
    counts: &[usize],
    ends: [Option<usize>; 2],
    undecided: &[usize],
    is_wall: &mut [bool],
) -> Result<(), TextError> {
    let custom: Vec<i32> = undecided.iter().map(|sign| custom(&grid.signs[*sign])).collect();
    let is_strict = |value: &i32| *value == 2;
    let has_blanks = counts[usize::from(BLANK)] != 0;
    // The usual case, and the largest files: walls of `#` in blanks, nothing else.
    if let ([sign], true) = (undecided, has_blanks || ends.iter().any(Option::is_some)) {
        is_wall[*sign] = true;
        return Ok(());
    }
    if let ([sign], [2]) = (undecided, custom.as_slice()) {
        is_wall[*sign] = true;
        return Ok(());
    }
    let is_hole = |sign: &&usize| grid.signs[**sign] == "O" && has_blanks && custom.iter().any(is_strict);
    if let Some(cell) = undecided.iter().find(is_hole).and_then(|sign| first_cell(grid, *sign)) {
        return Err(TextError::Hole { place: grid.place(cell) });
    }
    // What fits no convention is reported first: it may be a slip of the pen.
    let unknown = |index: &usize| {
        let (text, n) = (grid.signs[undecided[*index]].as_str(), counts[undecided[*index]]);
        let is_known_otherwise =
            custom.iter().any(is_strict) && (has_blanks || custom.iter().any(|value| *value < 0));
        custom[*index] == 0 && is_known_otherwise && (n == 1 || letter(text).is_some_and(char::is_alphabetic))
    };
    let n_tried = grid.cells.len().saturating_mul(1 << undecided.len().min(MAX_UNDECIDED));
    let is_too_much = MAX_UNDECIDED < undecided.len() || MAX_LOOKS < n_tried;
    if let Some(index) = (0..undecided.len()).find(unknown).or(is_too_much.then_some(0)) {
        let sign = undecided[index];
        let found = grid.signs[sign].clone();
        let n = counts[sign];
        let place = grid.place(first_cell(grid, sign).unwrap_or(0));
        return Err(TextError::Unknown { place, found, n });
    }
    let mut best: Option<(Rank, u32)> = None;
    let mut second: Option<(Rank, u32)> = None;
    let all = (1_u32 << undecided.len()) - 1;
    for walls in 1..=all {
        if walls == all && !has_blanks {
            continue;
        }
        for (bit, sign) in undecided.iter().enumerate() {
            is_wall[*sign] = walls >> bit & 1 == 1;
        }
        let agreement = custom.iter().enumerate().map(
            |(bit, custom)| {
                if walls >> bit & 1 == 1 { *custom } else { -*custom }
            },
        );
        let rank = Rank::new(grid, is_wall, ends, agreement.sum(), walls.count_ones());
        if best.is_none_or(|(known, _)| known < rank) {
            second = best;
            best = Some((rank, walls));
        } else if second.is_none_or(|(known, _)| known < rank) {
            second = Some((rank, walls));
        }
    }
    let Some((rank, walls)) = best else { return Err(TextError::NoWalls { n_lines: grid.height }) };
    if let Some((_, other)) = second.filter(|(other, _)| *other == rank) {
        let signs = |walls: u32| {
            let is_meant = |bit: &usize| walls >> bit & 1 == 1;
            let signs = (0..undecided.len()).filter(is_meant).map(|bit| quoted(&grid.signs[undecided[bit]]));
            signs.collect::<Vec<_>>().join(" ")
        };
        return Err(TextError::Ambiguous { what: "wall", one: signs(walls), other: signs(other) });
    }
    for (bit, sign) in undecided.iter().enumerate() {
        is_wall[*sign] = walls >> bit & 1 == 1;
    }
    Ok(())
}

/// Whether a character draws blocks of wall, and never lines.
pub(super) fn is_block(character: char) -> bool {
    WALLS.contains(character)
}

/// By custom: above 0 wall, below 0 free.
fn custom(sign: &str) -> i32 {
    match sign {
        _ if WALLS.contains(sign) => 2,
        _ if FREE.contains(sign) => -2,
        _ if OFTEN_WALLS.contains(sign) => 1,
        _ if OFTEN_FREE.contains(sign) => -1,
        _ => 0,
    }
}

/// How much a reading looks like a maze; what comes first decides.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Rank {
    /// Start and goal are connected, and more than half of what is free is in one piece.
    is_playable: bool,
    /// At most an eighth of the border is free, or two cells.
    is_closed: bool,
    /// Less than half of what is free is in squares of 2 x 2: corridors, no halls.
    is_narrow: bool,
    /// Nine tenths of what is free are in one piece.
    is_connected: bool,
    /// For corridors, that few signs are wall (others are marks in them); for halls, how far it agrees with custom.
    first: i32,
    /// The other one.
    second: i32,
}

impl Rank {
    fn new(grid: &Grid, is_wall: &[bool], ends: [Option<usize>; 2], custom: i32, n_walls: u32) -> Self {
        let is_free = |cell: usize| !is_wall[usize::from(grid.cells[cell])];
        let n_cells = grid.cells.len();
        let n_free = (0..n_cells).filter(|cell| is_free(*cell)).count();
        let (largest, joined) = largest_region(grid, is_free, ends);
        let is_border_free =
            |cell: &usize| grid.is_border(*cell) && is_free(*cell) && !ends.contains(&Some(*cell));
        let n_border = (0..n_cells).filter(|cell| grid.is_border(*cell)).count();
        let n_open = (0..n_cells).filter(is_border_free).count();
        let is_square = |cell: &usize| {
            let (x, y) = (cell % grid.width, cell / grid.width);
            x + 1 < grid.width
                && y + 1 < grid.height
                && [*cell, cell + 1, cell + grid.width, cell + grid.width + 1].into_iter().all(is_free)
        };
        let n_squares = (0..n_cells).filter(is_square).count();
        let is_narrow = 2 * n_squares < n_free;
        let few = 0_i32.saturating_sub_unsigned(n_walls);
        Self {
            is_playable: joined && n_free < 2 * largest,
            is_closed: n_open <= 2 || 8 * n_open <= n_border,
            is_narrow,
            is_connected: 9 * n_free <= 10 * largest,
            first: if is_narrow { few } else { custom },
            second: if is_narrow { custom } else { few },
        }
    }
}

/// The number of free cells in the largest piece, and whether both ends, where they are known, are in one.
fn largest_region(grid: &Grid, is_free: impl Fn(usize) -> bool, ends: [Option<usize>; 2]) -> (usize, bool) {
    const NONE: u32 = 0;
    let mut region = vec![NONE; grid.cells.len()];
    let (mut largest, mut next) = (0, NONE);
    let mut open = Vec::new();
    for first in 0..region.len() {
        if region[first] != NONE || !is_free(first) {
            continue;
        }
        next += 1;
        region[first] = next;
        open.push(first);
        let mut size = 0;
        while let Some(cell) = open.pop() {
            size += 1;
            for beside in grid.neighbours(cell) {
                if region[beside] == NONE && is_free(beside) {
                    region[beside] = next;
                    open.push(beside);
                }
            }
        }
        largest = largest.max(size);
    }
    let joined = match ends {
        [Some(start), Some(goal)] => region[start] == region[goal],
        _ => true,
    };
    (largest, joined)
}

/// Start and goal: as stated, or signs that occur once and are known as such.
pub(super) fn find_ends(
    grid: &Grid,
    counts: &[usize],
    options: &TextOptions,
) -> Result<[Option<usize>; 2], TextError> {
    let stated = [stated_end(grid, "start", &options.start)?, stated_end(grid, "goal", &options.goal)?];
    let is_stated = |sign: usize| {
        let text = grid.signs[sign].as_str();
        names(options.wall.as_deref(), text) || names(options.free.as_deref(), text)
    };
    let has_walls = (1..counts.len()).any(|sign| counts[sign] != 0 && custom(&grid.signs[sign]) == 2);
    let mut alone = Vec::new();
    for sign in (1..grid.signs.len()).filter(|sign| counts[*sign] != 0 && !is_stated(*sign)) {
        let name = grid.signs[sign].as_str();
        let is_letter = letter(name).is_some_and(|letter| "SGEFAB".contains(letter));
        if counts[sign] == 1 && custom(name) != 2 {
            alone.push(sign);
        } else if counts[sign] <= 4 && is_letter && has_walls && stated == [None, None] {
            let mut cells = grid.cells_of(u8::try_from(sign).unwrap_or(BLANK)).map(|cell| grid.place(cell));
            if let (Some(first), Some(place)) = (cells.next(), cells.next()) {
                return Err(TextError::Twice { place, first, name: name.to_owned() });
            }
        }
    }
    alone.retain(|sign| stated.iter().flatten().all(|cell| usize::from(grid.cells[*cell]) != *sign));
    let found = match (stated, alone.as_slice()) {
        ([Some(_), Some(_)], _) => [None, None],
        ([Some(_), None] | [None, Some(_)], [one]) => [Some(*one), None],
        _ => known_ends(grid, &alone)?,
    };
    let [start, goal] = found.map(|sign| sign.and_then(|sign| first_cell(grid, sign)));
    // What is stated leaves to the other end what is left.
    Ok(match stated {
        [None, None] => [start, goal],
        [Some(given), None] => [Some(given), goal.or(start)],
        [None, Some(given)] => [start.or(goal), Some(given)],
        both => both,
    })
}

/// The only cell of a sign that the user says is an end.
fn stated_end(grid: &Grid, name: &'static str, sign: &Option<String>) -> Result<Option<usize>, TextError> {
    let Some(sign) = sign else { return Ok(None) };
    let index = grid.signs.iter().position(|known| known == sign);
    let mut cells = grid.cells_of(index.and_then(|index| u8::try_from(index).ok()).unwrap_or(u8::MAX));
    match (cells.next(), cells.next()) {
        (None, _) => Err(TextError::NotThere { name, sign: sign.clone() }),
        (Some(first), Some(place)) => {
            Err(TextError::Twice { place: grid.place(place), first: grid.place(first), name: sign.clone() })
        }
        (Some(cell), None) => Ok(Some(cell)),
    }
}

/// Which of the signs that occur once are start and goal.
fn known_ends(grid: &Grid, alone: &[usize]) -> Result<[Option<usize>; 2], TextError> {
    let letter = |sign: usize| letter(&grid.signs[sign]);
    let find = |wanted: char| alone.iter().copied().find(|sign| letter(*sign) == Some(wanted));
    let order = |names: &str, sign: usize| letter(sign).and_then(|letter| names.find(letter));
    let best = |names: &str, besides: Option<usize>| {
        let known =
            alone.iter().copied().filter(|sign| Some(*sign) != besides && order(names, *sign).is_some());
        known.min_by_key(|sign| order(names, *sign))
    };
    let number = |sign: usize| grid.signs[sign].parse::<i64>().ok();
    if let [one, other] = alone
        && let (Some(a), Some(b)) = (number(*one), number(*other))
    {
        return Ok(if a < b { [*one, *other] } else { [*other, *one] }.map(Some));
    }
    // In and out; an `O` without an `I` is something else.
    if let (Some(way_in), Some(way_out)) = (find('I'), find('O')) {
        return Ok([Some(way_in), Some(way_out)]);
    }
    if let Some(start) = best(STARTS, None) {
        // The best goal, or else what is left when there are two.
        let is_other = |sign: &usize| *sign != start && alone.len() == 2 && letter(*sign) != Some('O');
        let other = alone.iter().copied().find(is_other);
        return Ok([Some(start), best(GOALS, Some(start)).or(other)]);
    }
    for [begin, end] in PAIRS {
        if let (Some(begin), Some(end)) = (find(begin), find(end)) {
            return Ok([Some(begin), Some(end)]);
        }
    }
    match alone {
        [one] if letter(*one).is_some_and(|letter| "GEFBD$*".contains(letter)) => Ok([None, Some(*one)]),
        [one, other] => match best(GOALS, None) {
            Some(goal) if best(GOALS, Some(goal)).is_none() => {
                let start = if goal == *one { *other } else { *one };
                Ok([Some(start), Some(goal)])
            }
            _ => Err(TextError::Ambiguous {
                what: "start",
                one: quoted(&grid.signs[*one]),
                other: quoted(&grid.signs[*other]),
            }),
        },
        _ => Ok([None, None]),
    }
}
