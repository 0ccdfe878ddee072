//! A number a cell: its bits say at which sides a wall is.

use super::grid::Grid;
use super::sides::{End, Sides};
use super::{Place, TextError};

/// A side's bit, for north, east, south and west.
type Bits = [u8; 4];

/// The orders in use, those of most files first: clockwise from north; north, south, east, west.
const CUSTOMS: [Bits; 3] = [[1, 2, 4, 8], [1, 4, 2, 8], [8, 4, 2, 1]];

/// What was found.
pub(super) struct Numbers {
    pub(super) sides: Sides,
    bits: Bits,
    are_walls: bool,
}

impl Numbers {
    /// In words.
    pub(super) fn words(&self) -> String {
        let [north, east, south, west] = self.bits;
        let what = if self.are_walls { "walls" } else { "passages" };
        format!(
            "a number a cell, its bits are {what}: north {north}, east {east}, south {south}, west {west}"
        )
    }
}

/// Whether every cell has a number from 0 to 15, and there are more of them than a file of wall and free has.
pub(super) fn is_numbers(grid: &Grid) -> bool {
    5 < grid.signs.len()
        && grid.signs[1..].iter().all(|sign| value(sign).is_some())
        && grid.cells_of(0).next().is_none()
}

fn value(sign: &str) -> Option<u8> {
    let value = match sign.len() {
        1 => u8::from_str_radix(sign, 16).ok()?,
        _ => sign.parse().ok()?,
    };
    (value < 16).then_some(value)
}

/// Reads the numbers: finds the order of bits in which neighbours agree about the wall between them.
///
/// # Errors
/// The place of a disagreement in the order that fits best, and several orders that fit.
pub(super) fn read(grid: &Grid) -> Result<Numbers, TextError> {
    let values: Vec<u8> = grid.signs.iter().map(|sign| value(sign).unwrap_or(0)).collect();
    let value = |x: usize, y: usize| values[usize::from(grid.cells[y * grid.width + x])];
    let has = |x: usize, y: usize, bit: u8| value(x, y) & bit != 0;
    let (width, height) = (grid.width, grid.height);
    // How many neighbours disagree about the wall between them, and the first such cell.
    let disagreements = |[north, east, south, west]: Bits| {
        let mut wrong: (usize, Option<usize>) = (0, None);
        for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
            let here = value(x, y);
            let beside = 0 < x && (value(x - 1, y) & east != 0) != (here & west != 0);
            let above = 0 < y && (value(x, y - 1) & south != 0) != (here & north != 0);
            wrong.0 += usize::from(beside) + usize::from(above);
            wrong.1 = wrong.1.or((beside || above).then_some(y * width + x));
        }
        wrong
    };
    let mut fitting: Vec<Bits> = Vec::new();
    let mut nearest: Option<(usize, usize)> = None; // disagreements, the first one's cell
    for bits in orders() {
        match disagreements(bits) {
            (_, None) => fitting.push(bits),
            (n, Some(cell)) => nearest = nearest.filter(|(known, _)| *known <= n).or(Some((n, cell))),
        }
    }
    let customary = CUSTOMS.iter().find(|custom| fitting.contains(custom));
    let bits = match (fitting.as_slice(), customary, nearest) {
        ([bits], _, _) | (_, Some(bits), _) => *bits,
        ([one, other, ..], None, _) => {
            let words = |bits: &Bits| {
                format!("north {}, east {}, south {}, west {}", bits[0], bits[1], bits[2], bits[3])
            };
            return Err(TextError::Ambiguous { what: "bits", one: words(one), other: words(other) });
        }
        ([], _, Some((n, cell))) => return Err(TextError::Disagree { place: grid.place(cell), n }),
        ([], _, None) => return Err(TextError::NoWalls { n_lines: height }),
    };
    let [north, east, south, west] = bits;
    let rim = (0..width).flat_map(|x| [has(x, 0, north), has(x, height - 1, south)]);
    let rim: Vec<bool> =
        rim.chain((0..height).flat_map(|y| [has(0, y, west), has(width - 1, y, east)])).collect();
    let n_set = rim.iter().filter(|set| **set).count();
    let are_walls = rim.len() <= 2 * n_set;
    let mut sides = Sides::new(width, height)?;
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        for (bit, [dx, dy]) in [(north, [0, 0]), (south, [0, 1])] {
            if has(x, y, bit) == are_walls {
                sides.add_level(x + dx, y + dy);
            }
        }
        for (bit, dx) in [(west, 0), (east, 1)] {
            if has(x, y, bit) == are_walls {
                sides.add_upright(x + dx, y);
            }
        }
    }
    Ok(Numbers { sides, bits, are_walls })
}

/// The 24 orders of four bits.
fn orders() -> impl Iterator<Item = Bits> {
    let all = (0..256_u32).map(|n| [n & 3, n >> 2 & 3, n >> 4 & 3, n >> 6].map(|bit| 1_u8 << bit));
    all.filter(|bits| bits.iter().fold(0, |sum, bit| sum | bit) == 15)
}

/// Start, goal and path as some files give them behind the cells: two lines `x,y` from the upper left, and one of the letters N,
/// E, S and W.
pub(super) struct Trailer {
    pub(super) ends: [Option<End>; 2],
    pub(super) places: [Option<Place>; 2],
}

/// Reads the lines behind the cells.
///
/// # Errors
/// Other lines, and a path that does not lead from the one to the other.
pub(super) fn read_trailer(lines: &[super::grid::Line], sides: &Sides) -> Result<Trailer, TextError> {
    let filled: Vec<_> = lines.iter().filter(|line| !line.is_blank()).collect();
    let none = Trailer { ends: [None; 2], places: [None; 2] };
    let (start, goal, path) = match filled.as_slice() {
        [] => return Ok(none),
        [start, goal] => (start, goal, None),
        [start, goal, path] => (start, goal, Some(path)),
        [.., line] => return Err(TextError::Trailer { line: line.number }),
    };
    let pair = |line: &super::grid::Line| {
        let numbers = line.content.trim_matches(|c| "()[]".contains(c)).split([',', ' ', ';']);
        let numbers: Option<Vec<usize>> = numbers.filter(|n| !n.is_empty()).map(|n| n.parse().ok()).collect();
        match numbers.as_deref() {
            Some([x, y]) => Ok([*x, *y]),
            _ => Err(TextError::Trailer { line: line.number }),
        }
    };
    let given = [pair(start)?, pair(goal)?];
    let is_inside =
        |cells: &[[usize; 2]; 2]| cells.iter().all(|[x, y]| *x < sides.width && *y < sides.height);
    let leads = |[from, to]: &[[usize; 2]; 2]| {
        let Some(path) = path else { return true };
        let mut steps = path.content.chars();
        let end = steps
            .try_fold(*from, |cell, step| sides.neighbour(cell, "NESW".find(step.to_ascii_uppercase())?));
        end == Some(*to)
    };
    // As x, y; else as row, column.
    let turned = given.map(|[x, y]| [y, x]);
    let ends = [given, turned].into_iter().find(|ends| is_inside(ends) && leads(ends));
    let Some(ends) = ends else {
        let line = path.filter(|_| is_inside(&given)).unwrap_or(start);
        return Err(TextError::Trailer { line: line.number });
    };
    let places = [start, goal].map(|line| Some(Place { line: line.number, column: 1 }));
    Ok(Trailer { ends: ends.map(|cell| Some(End { cell, is_square: false })), places })
}
