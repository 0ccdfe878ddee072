//! Strokes -> cells, walls, doors and the solution.

use super::drawing::{Chain, Source};
use super::{SvgError, SvgMaze};
use crate::layout::{Door, Layout, Side};
use crate::physics::numbers::{greater, lesser, to_f64};

/// How far from a grid line, in cells, a wall may lie: drawings are rounded, to a tenth of a unit in cells of 16 or so.
const OFF_GRID: f64 = 0.03;

/// Gaps below this fraction of the widest one between two walls are rounding and not cells. It must be above [`OFF_GRID`], so that
/// a real cell that is so narrow is reported as off the grid and not lost.
const ROUNDING_FRACTION: f64 = 0.05;

/// Coordinates nearer than this fraction of the drawing's size are one: a tenth of a cell in the largest layout.
const SAME_FRACTION: f64 = 1.0e-4;

/// How much a wall may lean, as a fraction of its length.
const LEAN: f64 = 0.01;

/// The narrowest gap between walls is at most this many cells.
const MAX_DIVISOR: usize = 4;

/// The layout that these strokes draw.
pub(super) fn maze(chains: &[Chain<'_>]) -> Result<SvgMaze, SvgError> {
    let reference = reference(chains)?;
    let is_reference = |chain: &&Chain| (chain.source, chain.stroke) == reference;
    refuse_slanted(chains.iter().filter(is_reference))?;
    let grid = Grid::find(chains.iter().filter(is_reference))?;
    let mut walls = Walls::new(&grid)?;
    let mut solution = None;
    for chain in chains {
        if is_reference(&chain) || grid.is_on_lines(chain) {
            walls.draw(chain, &grid)?;
        } else if solution.is_none() && grid.is_in_cells(chain) {
            solution = Some(chain);
        } else {
            return Err(grid.off_grid(chain));
        }
    }
    let (n_open, n_border) = walls.open_border();
    if 2 < n_open && n_border < 4 * n_open {
        return Err(match reference.0 {
            Source::Line => SvgError::OpenBorder { n_open, n_border },
            _ => SvgError::Passages { n_open, n_border },
        });
    }
    let layout = walls.layout()?;
    let solution = solution.map(|chain| checked_solution(chain, &grid, &layout)).transpose()?;
    let posts = posts(chains, &grid);
    Ok(SvgMaze { layout, solution, cell: grid.cell, corner: grid.corner, posts, ends: [None; 2] })
}

/// Strokes without a length at corners of cells.
fn posts(chains: &[Chain<'_>], grid: &Grid) -> Vec<[usize; 2]> {
    let dots = chains.iter().filter(|chain| 1 < chain.points.len() && strokes(chain).next().is_none());
    let corner = |chain: &Chain| {
        let point = *chain.points.first()?;
        // Rows of blocks are counted from below.
        Some([2 * grid.line(point, 0)?, 2 * (grid.n_cells[1] - grid.line(point, 1)?)])
    };
    dots.filter_map(corner).collect()
}

/// What the walls are drawn with: black or grey if there is any, lines if there are any, else paths, else polylines, of the
/// colour of the first one.
fn reference(chains: &[Chain<'_>]) -> Result<(Source, usize), SvgError> {
    let first = chains
        .iter()
        .filter(|chain| 1 < chain.points.len())
        .min_by_key(|chain| (chain.is_coloured, chain.source));
    first.map(|chain| (chain.source, chain.stroke)).ok_or(SvgError::NoWalls)
}

/// The strokes of a chain that have a length.
fn strokes<'a>(chain: &Chain<'a>) -> impl Iterator<Item = [[f64; 2]; 2]> + 'a {
    chain.points.windows(2).map(|pair| [pair[0], pair[1]]).filter(|[from, to]| from != to)
}

/// The axis along which a stroke runs; `None` when it is slanted.
fn axis([from, to]: [[f64; 2]; 2]) -> Option<usize> {
    let [x, y] = [0, 1].map(|axis| (to[axis] - from[axis]).abs());
    match (y <= LEAN * x, x <= LEAN * y) {
        (true, _) => Some(0),
        (_, true) => Some(1),
        _ => None,
    }
}

fn refuse_slanted<'a>(chains: impl Iterator<Item = &'a Chain<'a>>) -> Result<(), SvgError> {
    let (mut n_walls, mut n_slanted, mut first) = (0, 0, None);
    for chain in chains {
        for stroke in strokes(chain) {
            n_walls += 1;
            if axis(stroke).is_none() {
                n_slanted += 1;
                first = first.or(Some(chain.line));
            }
        }
    }
    first.map_or(Ok(()), |line| Err(SvgError::Slanted { line, n_slanted, n_walls }))
}

/// Equal cells from the upper left corner of the walls.
struct Grid {
    corner: [f64; 2],
    cell: [f64; 2],
    n_cells: [usize; 2],
}

impl Grid {
    fn find<'a>(chains: impl Iterator<Item = &'a Chain<'a>>) -> Result<Self, SvgError> {
        let mut values: [Vec<f64>; 2] = [Vec::new(), Vec::new()];
        let mut first = 0;
        for chain in chains {
            first = if first == 0 { chain.line } else { first };
            for [from, to] in strokes(chain) {
                for axis in [0, 1] {
                    values[axis].extend([from[axis], to[axis]]);
                }
            }
        }
        let mut size = 0.0;
        for values in &mut values {
            values.sort_by(f64::total_cmp);
            let (Some(low), Some(high)) = (values.first(), values.last()) else {
                return Err(SvgError::NoWalls);
            };
            size = if size < high - low { high - low } else { size };
        }
        values
            .iter_mut()
            .for_each(|values| values.dedup_by(|next, kept| *next - *kept <= SAME_FRACTION * size));
        let corner = [values[0][0], values[1][0]];
        let extents = [0, 1].map(|axis| values[axis][values[axis].len() - 1] - corner[axis]);
        // One size for both axes; where there is none, the drawing is stretched, or no two walls are one cell apart, or what
        // looks like rounding is none.
        let [x, y] = [0, 1].map(|axis| &values[axis][..]);
        let both = |divisor, rounding| cell_size(&[x, y], divisor, rounding).map(|cell| [cell, cell]);
        let each = || Some([cell_size(&[x], 1, ROUNDING_FRACTION)?, cell_size(&[y], 1, ROUNDING_FRACTION)?]);
        let cell = both(1, ROUNDING_FRACTION).or_else(each);
        let cell = cell.or_else(|| (2..=MAX_DIVISOR).find_map(|divisor| both(divisor, ROUNDING_FRACTION)));
        let cell = cell.or_else(|| both(1, 0.0)).ok_or(SvgError::NoGrid { line: first })?;
        let n_cells = [0, 1].map(|axis| nearest(extents[axis] / cell[axis]));
        if n_cells.contains(&0) {
            return Err(SvgError::NoGrid { line: first });
        }
        Ok(Self { corner, cell, n_cells })
    }

    /// Where a coordinate lies, in cells from the corner.
    fn position(&self, point: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|axis| (point[axis] - self.corner[axis]) / self.cell[axis])
    }

    /// Whether every point of a chain is a corner of cells.
    fn is_on_lines(&self, chain: &Chain) -> bool {
        let is_on_line = |point: &[f64; 2]| self.position(*point).into_iter().all(is_near_whole);
        chain.points.iter().all(is_on_line)
    }

    /// Whether every point of a chain is the middle of a cell; the first and the last may also be the middle of a side.
    fn is_in_cells(&self, chain: &Chain) -> bool {
        let last = chain.points.len().saturating_sub(1);
        1 < chain.points.len()
            && chain.points.iter().enumerate().all(|(index, point)| {
                let position = self.position(*point);
                let n_middle = position.into_iter().filter(|at| is_near_whole(at + 0.5)).count();
                let n_on_line = position.into_iter().filter(|at| is_near_whole(*at)).count();
                n_middle == 2 || ((index == 0 || index == last) && n_middle == 1 && n_on_line == 1)
            })
    }

    /// The grid line next to a point, along an axis.
    fn line(&self, point: [f64; 2], axis: usize) -> Option<usize> {
        let position = self.position(point)[axis];
        is_near_whole(position).then(|| nearest(position)).filter(|line| *line <= self.n_cells[axis])
    }

    fn off_grid_at(&self, line: usize, [x, y]: [f64; 2]) -> SvgError {
        let ([cell_x, cell_y], [left, top]) = (self.cell, self.corner);
        SvgError::OffGrid { line, x, y, cell_x, cell_y, left, top }
    }

    /// The first point of a chain that is neither a corner of cells nor a middle.
    fn off_grid(&self, chain: &Chain) -> SvgError {
        let is_off =
            |point: &&[f64; 2]| !self.position(**point).into_iter().all(|at| is_near_whole(2.0 * at));
        let point = chain.points.iter().find(is_off).or(chain.points.first());
        self.off_grid_at(chain.line, point.copied().unwrap_or_default())
    }
}

/// The narrowest gap between values, divided: `None` unless all distances from the first value, on each axis, are multiples
/// of that. Gaps below `rounding`, a fraction of the widest, do not count. Values ascend and differ.
fn cell_size(axes: &[&[f64]], divisor: usize, rounding: f64) -> Option<f64> {
    let gaps = || axes.iter().flat_map(|values| values.windows(2)).map(|pair| pair[1] - pair[0]);
    let widest_gap = gaps().reduce(greater)?;
    let cells = gaps().filter(|gap| rounding * widest_gap <= *gap);
    let narrowest = cells.reduce(lesser)?;
    let extents = axes.iter().map(|values| values[values.len() - 1] - values[0]);
    let widest = extents.reduce(greater)?;
    // The many cells of the whole side tell the size better than one of them.
    let cell = widest / to_f64(nearest(widest * to_f64(divisor) / narrowest));
    let fits = |values: &&[f64]| values.iter().all(|value| is_near_whole((value - values[0]) / cell));
    axes.iter().all(fits).then_some(cell)
}

/// The whole number next to a position; 0 for what lies before it.
#[allow(clippy::cast_possible_truncation, reason = "saturates, and what is too large is refused as a size")]
fn nearest(position: f64) -> usize {
    (position + 0.5) as usize
}

#[allow(clippy::cast_precision_loss, reason = "beyond 2^53 every number is whole")]
fn is_near_whole(position: f64) -> bool {
    -OFF_GRID <= position && (position - nearest(position) as f64).abs() <= OFF_GRID
}

/// Which sides of cells are drawn. Row 0 is at the top, as in the file.
struct Walls {
    width: usize,
    height: usize,
    horizontal: Vec<bool>, // [line * width + x]: above row `line`
    vertical: Vec<bool>,   // [line * height + row]: left of column `line`
    empty: Layout,
}

impl Walls {
    fn new(grid: &Grid) -> Result<Self, SvgError> {
        let [width, height] = grid.n_cells;
        // Before anything is allocated: the size may be any number.
        let empty = Layout::walled(width, height)?;
        let (horizontal, vertical) = (vec![false; width * (height + 1)], vec![false; (width + 1) * height]);
        Ok(Self { width, height, horizontal, vertical, empty })
    }

    fn draw(&mut self, chain: &Chain, grid: &Grid) -> Result<(), SvgError> {
        for stroke in strokes(chain) {
            let [from, to] = stroke;
            // What is slanted was refused, or joins two corners of cells and is refused here.
            let along =
                axis(stroke).ok_or(SvgError::Slanted { line: chain.line, n_slanted: 1, n_walls: 1 })?;
            let on_grid =
                |point, axis| grid.line(point, axis).ok_or_else(|| grid.off_grid_at(chain.line, point));
            let (across, start, end) =
                (on_grid(from, 1 - along)?, on_grid(from, along)?, on_grid(to, along)?);
            let (start, end) = if start < end { (start, end) } else { (end, start) };
            let (walls, n) = match along {
                0 => (&mut self.horizontal, self.width),
                _ => (&mut self.vertical, self.height),
            };
            walls[across * n + start..across * n + end].fill(true);
        }
        Ok(())
    }

    /// Sides at the border without a wall, of how many.
    fn open_border(&self) -> (usize, usize) {
        let (width, height) = (self.width, self.height);
        let rows = self.horizontal[..width].iter().chain(&self.horizontal[height * width..]);
        let columns = self.vertical[..height].iter().chain(&self.vertical[width * height..]);
        (rows.chain(columns).filter(|wall| !**wall).count(), 2 * (width + height))
    }

    fn layout(self) -> Result<Layout, SvgError> {
        let (width, height) = (self.width, self.height);
        let mut layout = self.empty;
        // From the top in the file, from the bottom in the layout.
        let cell = |x: usize, row: usize| (height - 1 - row) * width + x;
        let mut all_known = true;
        for row in 0..height {
            let y = height - 1 - row;
            for line in (0..=width).filter(|line| !self.vertical[line * height + row]) {
                match line {
                    0 => all_known &= layout.open_door(Door { side: Side::Left, index: y }).is_ok(),
                    _ if line == width => {
                        all_known &= layout.open_door(Door { side: Side::Right, index: y }).is_ok()
                    }
                    _ => layout.join(cell(line - 1, row), cell(line, row)),
                }
            }
        }
        for line in 0..=height {
            for x in (0..width).filter(|x| !self.horizontal[line * width + x]) {
                match line {
                    0 => all_known &= layout.open_door(Door { side: Side::Top, index: x }).is_ok(),
                    _ if line == height => {
                        all_known &= layout.open_door(Door { side: Side::Bottom, index: x }).is_ok()
                    }
                    _ => layout.join(cell(x, line - 1), cell(x, line)),
                }
            }
        }
        debug_assert!(all_known, "every door has its cell");
        Ok(layout)
    }
}

/// The cells of a drawn solution, which must be a shortest path; an end on the outer wall must be in a door.
fn checked_solution(chain: &Chain, grid: &Grid, layout: &Layout) -> Result<Vec<usize>, SvgError> {
    let through_wall = |[x, y]: [f64; 2]| SvgError::SolutionThroughWall { line: chain.line, x, y };
    let (width, height) = (layout.width(), layout.height());
    let mut cells: Vec<usize> = Vec::new();
    for &point in chain.points {
        let cell = cell_of_point(grid, layout, point).ok_or_else(|| through_wall(point))?;
        let Some(&last) = cells.last() else {
            cells.push(cell);
            continue;
        };
        let (mut x, mut y) = (last % width, last / width);
        let (to_x, to_y) = (cell % width, cell / width);
        while (x, y) != (to_x, to_y) {
            let is_open = match (x.cmp(&to_x), y.cmp(&to_y)) {
                (std::cmp::Ordering::Less, _) => layout.is_open_east(x, y),
                (std::cmp::Ordering::Greater, _) => layout.is_open_east(x - 1, y),
                (_, std::cmp::Ordering::Less) => layout.is_open_north(x, y),
                _ => layout.is_open_north(x, y - 1),
            };
            let slanted = x != to_x && y != to_y;
            if slanted || !is_open || width * height < cells.len() {
                return Err(through_wall(point));
            }
            match (x.cmp(&to_x), y.cmp(&to_y)) {
                (std::cmp::Ordering::Less, _) => x += 1,
                (std::cmp::Ordering::Greater, _) => x -= 1,
                (_, std::cmp::Ordering::Less) => y += 1,
                _ => y -= 1,
            }
            cells.push(y * width + x);
        }
    }
    let n_shortest = cells.first().zip(cells.last()).and_then(|(from, to)| layout.shortest_path(*from, *to));
    let n_shortest = n_shortest.map_or(0, |path| path.len());
    if cells.len() != n_shortest {
        return Err(SvgError::SolutionLonger { line: chain.line, n_cells: cells.len(), n_shortest });
    }
    Ok(cells)
}

/// The cell whose middle a point is; for a point in the outer wall the cell behind the door there.
fn cell_of_point(grid: &Grid, layout: &Layout, point: [f64; 2]) -> Option<usize> {
    let (width, height) = (layout.width(), layout.height());
    let position = grid.position(point);
    // The index of the cell, or on which outer wall the point lies.
    let index = |axis: usize, n: usize| {
        let at = position[axis];
        match is_near_whole(at + 0.5) {
            true => (nearest(at + 0.5).checked_sub(1).filter(|index| *index < n), None),
            false => (None, Some(nearest(at)).filter(|line| *line == 0 || *line == n)),
        }
    };
    let (x, row) = (index(0, width), index(1, height));
    let (x, row, door) = match (x, row) {
        ((Some(x), _), (Some(row), _)) => (x, row, None),
        ((Some(x), _), (_, Some(0))) => (x, 0, Some(Door { side: Side::Top, index: x })),
        ((Some(x), _), (_, Some(_))) => (x, height - 1, Some(Door { side: Side::Bottom, index: x })),
        ((_, Some(0)), (Some(row), _)) => (0, row, Some(Door { side: Side::Left, index: height - 1 - row })),
        ((_, Some(_)), (Some(row), _)) => {
            (width - 1, row, Some(Door { side: Side::Right, index: height - 1 - row }))
        }
        _ => return None,
    };
    let is_open = door.is_none_or(|door| layout.has_door(door.side, door.index));
    is_open.then_some((height - 1 - row) * width + x)
}
