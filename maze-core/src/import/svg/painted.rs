//! What is painted -> blocks: every edge of a stroke or an area is a line of the plan, and the paint on top decides.

use super::SvgError;
use super::drawing::{Drawing, Form, Shape, has_area, is_coloured, is_same};
use super::style::Rgb;
use crate::layout::blocks::Blocks;
use crate::physics::numbers::{greater, lesser};

/// Edges nearer than this fraction of the drawing's size are one.
const SAME_FRACTION: f64 = 1.0e-5;

/// How much a wall may lean, as a fraction of its length.
const LEAN: f64 = 0.01;

/// Fraction of the walls' length that may be slanted decoration.
const MAX_SLANTED: f64 = 0.02;

/// A round mark of less than this fraction of the drawing's size is decoration.
const MAX_ROUND: f64 = 0.1;

/// Colours whose channels differ by at most this are walls of one kind, such as black and dark grey.
const SAME_WALLS: u8 = 64;

/// Most rectangles of the plan, and most of them that are painted in all.
const MAX_CELLS: usize = 1 << 22;
const MAX_PAINTED: usize = 1 << 27;

/// A spot that is start or goal is at most this fraction of the drawing's size.
const MAX_SPOT: f64 = 0.2;

/// What was found in a drawing.
pub(super) struct Painted {
    pub(super) blocks: Blocks,
    pub(super) words: String,
}

/// A rectangle or an area of walls, or of paper over them.
struct Area {
    is_wall: bool,
    rings: Vec<Vec<[f64; 2]>>,
    is_even_odd: bool,
}

/// The walls that are painted.
///
/// # Errors
/// Walls that are slanted or curved, none, and more detail than a maze has.
pub(super) fn walls(drawing: &Drawing) -> Result<Painted, SvgError> {
    let wall = wall_colour(drawing).ok_or(SvgError::NoWalls)?;
    let is_wall = |colour: Rgb| {
        drawing.is_seen(colour) && colour.iter().zip(wall).all(|(a, b)| a.abs_diff(b) <= SAME_WALLS)
    };
    let size = drawing_size(drawing);
    let mut areas: Vec<Area> = Vec::new();
    let (mut length, mut slanted, mut first_slanted) = (0.0, 0.0, None);
    let (mut n_slanted, mut n_strokes, mut n_round) = (0, 0, 0);
    for shape in &drawing.shapes {
        let Form::Straight(chains) = &shape.form else {
            let paints = [shape.stroke.map(|(colour, _)| colour), shape.fill];
            if paints.into_iter().flatten().any(is_wall) {
                expect_small(shape, size)?;
                n_round += 1;
            }
            continue;
        };
        if let Some(fill) = shape.fill.filter(|fill| is_wall(*fill) || !drawing.is_seen(*fill)) {
            let rings: Vec<_> = chains.iter().filter(|points| has_area(points)).cloned().collect();
            let is_upright = |ring: &Vec<[f64; 2]>| sides(ring).all(|side| axis(side).is_some());
            if rings.iter().all(is_upright) && !rings.is_empty() {
                areas.push(Area { is_wall: is_wall(fill), rings, is_even_odd: shape.is_even_odd });
            } else if !rings.is_empty() && is_wall(fill) {
                expect_small(shape, size)?;
                n_round += 1;
            }
        }
        let Some((colour, width)) = shape.stroke else { continue };
        let is_wall = is_wall(colour);
        if !is_wall && drawing.is_seen(colour) {
            continue;
        }
        for points in chains {
            for side in points.windows(2).map(|pair| [pair[0], pair[1]]) {
                let [from, to] = side;
                let stroke_length = (0..2).map(|axis| (to[axis] - from[axis]).abs()).sum::<f64>();
                if from == to && !shape.has_caps {
                    continue;
                }
                if axis(side).is_none() && from != to {
                    if is_wall {
                        slanted += stroke_length;
                        n_slanted += 1;
                        first_slanted = first_slanted.or(Some(shape.line));
                    }
                    continue;
                }
                n_strokes += 1;
                length += if is_wall { stroke_length } else { 0.0 };
                let low = [0, 1].map(|axis| lesser(to[axis], from[axis]) - width / 2.0);
                let high = [0, 1].map(|axis| greater(from[axis], to[axis]) + width / 2.0);
                let ring = vec![low, [high[0], low[1]], high, [low[0], high[1]]];
                areas.push(Area { is_wall, rings: vec![ring], is_even_odd: false });
            }
        }
    }
    if let Some(line) = first_slanted.filter(|_| MAX_SLANTED * (length + slanted) < slanted) {
        return Err(SvgError::Slanted { line, n_slanted, n_walls: n_strokes + n_slanted });
    }
    let plan = Plan::paint(&areas, size)?;
    let ends = spots(drawing).map(|spot| spot.and_then(|point| plan.free_cell_at(point)));
    let blocks = plan.blocks(ends).ok_or(SvgError::NoWalls)?;
    let [r, g, b] = wall;
    let mut words = format!("walls as painted in #{r:02x}{g:02x}{b:02x}") + &spot_words(ends);
    if n_slanted + n_round != 0 {
        words += &format!(", {} slanted or round marks not met", n_slanted + n_round);
    }
    Ok(Painted { blocks, words })
}

/// Where start and goal were found.
pub(super) fn spot_words(ends: [Option<[usize; 2]>; 2]) -> String {
    let named = [("green", "start"), ("red", "goal")].into_iter().zip(ends);
    named
        .filter(|(_, end)| end.is_some())
        .map(|((colour, name), _)| format!(", {name} at the {colour} spot"))
        .collect()
}

fn expect_small(shape: &Shape, size: f64) -> Result<(), SvgError> {
    let is_small = shape
        .bounds()
        .is_some_and(|[low, high]| (0..2).all(|axis| high[axis] - low[axis] <= MAX_ROUND * size));
    match shape.curve {
        _ if is_small => Ok(()),
        Some(curve) => Err(curve(shape.line)),
        None => Err(SvgError::Curved { line: shape.line }),
    }
}

/// The larger side of all that is painted.
fn drawing_size(drawing: &Drawing) -> f64 {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for [a, b] in drawing.shapes.iter().filter_map(Shape::bounds) {
        for axis in [0, 1] {
            low[axis] = lesser(low[axis], a[axis]);
            high[axis] = greater(high[axis], b[axis]);
        }
    }
    let [x, y] = [high[0] - low[0], high[1] - low[1]];
    greater(x, y)
}

/// The sides of a ring, the closing one included.
fn sides(ring: &[[f64; 2]]) -> impl Iterator<Item = [[f64; 2]; 2]> + '_ {
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).map(|(from, to)| [*from, *to]).filter(|[from, to]| from != to)
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

/// The colour that most is painted in, more so the more it differs from the paper; one without a colour where there is one.
fn wall_colour(drawing: &Drawing) -> Option<Rgb> {
    let mut weights: Vec<(Rgb, f64)> = Vec::new();
    for shape in &drawing.shapes {
        let Form::Straight(chains) = &shape.form else { continue };
        let length = |points: &Vec<[f64; 2]>| {
            points
                .windows(2)
                .map(|pair| (pair[1][0] - pair[0][0]).abs() + (pair[1][1] - pair[0][1]).abs())
                .sum::<f64>()
        };
        let area = |points: &Vec<[f64; 2]>| {
            sides(points).map(|[a, b]| a[0] * b[1] - b[0] * a[1]).sum::<f64>().abs() / 2.0
        };
        let stroked =
            shape.stroke.map(|(colour, width)| (colour, width * chains.iter().map(length).sum::<f64>()));
        let filled = shape.fill.map(|colour| (colour, chains.iter().map(area).sum::<f64>()));
        for (colour, amount) in
            stroked.into_iter().chain(filled).filter(|(colour, _)| drawing.is_seen(*colour))
        {
            let contrast =
                colour.iter().zip(drawing.paper).map(|(a, b)| f64::from(a.abs_diff(b))).sum::<f64>();
            let weight = amount * contrast * contrast;
            match weights.iter_mut().find(|(known, _)| is_same(*known, colour)) {
                Some((_, known)) => *known += weight,
                None => weights.push((colour, weight)),
            }
        }
    }
    let has_grey = weights.iter().any(|(colour, weight)| !is_coloured(*colour) && 0.0 < *weight);
    let usable =
        weights.into_iter().filter(|(colour, weight)| 0.0 < *weight && !(has_grey && is_coloured(*colour)));
    usable.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(colour, _)| colour)
}

/// The middles of a green and of a red mark: start and goal.
pub(super) fn spots(drawing: &Drawing) -> [Option<[f64; 2]>; 2] {
    let size = drawing_size(drawing);
    [1, 0].map(|channel| spot(drawing, channel, size))
}

/// The middle of the one small mark that is mainly of a channel: green or red.
fn spot(drawing: &Drawing, channel: usize, size: f64) -> Option<[f64; 2]> {
    let has_colour = |colour: &Rgb| {
        let others = (0..3).filter(|other| *other != channel).map(|other| colour[other]).max();
        others.is_some_and(|other| 60 <= colour[channel].saturating_sub(other))
    };
    let mut spots = drawing
        .shapes
        .iter()
        .filter(|shape| shape.fill.as_ref().is_some_and(has_colour))
        .filter_map(Shape::bounds);
    let [low, high] = spots.next()?;
    let is_small = (0..2).all(|axis| high[axis] - low[axis] <= MAX_SPOT * size);
    (is_small && spots.next().is_none()).then(|| [0, 1].map(|axis| (low[axis] + high[axis]) / 2.0))
}

/// The plan: which of the rectangles between all edges are wall; y as in the file, downwards.
struct Plan {
    lines: [Vec<f64>; 2],
    wall: Vec<bool>, // [j * n_x + i]
}

impl Plan {
    fn paint(areas: &[Area], size: f64) -> Result<Self, SvgError> {
        let lines = [0, 1].map(|axis| {
            let points = areas.iter().flat_map(|area| area.rings.iter().flatten());
            let mut values: Vec<f64> = points.map(|point| point[axis]).collect();
            values.sort_by(f64::total_cmp);
            values.dedup_by(|next, kept| *next - *kept <= SAME_FRACTION * size);
            values
        });
        let [n_x, n_y] = [0, 1].map(|axis| lines[axis].len().saturating_sub(1));
        if n_x == 0 || n_y == 0 {
            return Err(SvgError::NoWalls);
        }
        if MAX_CELLS < n_x.saturating_mul(n_y) {
            return Err(SvgError::TooFine { n_x, n_y });
        }
        let nearest = |axis: usize, value: f64| {
            let values: &Vec<f64> = &lines[axis];
            let above = values.partition_point(|known| *known < value).min(values.len() - 1);
            let is_below =
                above.checked_sub(1).filter(|below| value - values[*below] < values[above] - value);
            is_below.unwrap_or(above)
        };
        let mut wall = vec![false; n_x * n_y];
        // How often each rectangle of an area's rows is gone around, by changes from column to column.
        let mut changes = vec![0_i32; (n_x + 1) * n_y];
        let mut n_painted = 0_usize;
        for area in areas {
            let corners: Vec<Vec<[usize; 2]>> = area
                .rings
                .iter()
                .map(|ring| ring.iter().map(|point| [nearest(0, point[0]), nearest(1, point[1])]).collect())
                .collect();
            let all = || corners.iter().flatten();
            let range = |axis: usize| {
                let values = || all().map(|corner| corner[axis]);
                values().min().unwrap_or(0)..values().max().unwrap_or(0)
            };
            let (columns, rows) = (range(0), range(1));
            n_painted = n_painted.saturating_add(columns.len().saturating_mul(rows.len()));
            if MAX_PAINTED < n_painted {
                return Err(SvgError::TooFine { n_x, n_y });
            }
            for ring in &corners {
                for (from, to) in ring.iter().zip(ring.iter().cycle().skip(1)) {
                    // A side up or down; one that leans is where its lower end is.
                    let (range, change) =
                        if from[1] < to[1] { (from[1]..to[1], 1) } else { (to[1]..from[1], -1) };
                    for row in range {
                        changes[row * (n_x + 1) + from[0]] += change;
                    }
                }
            }
            for row in rows {
                let mut winding = 0;
                for column in columns.clone() {
                    winding += std::mem::take(&mut changes[row * (n_x + 1) + column]);
                    let is_inside = if area.is_even_odd { winding % 2 != 0 } else { winding != 0 };
                    if is_inside {
                        wall[row * n_x + column] = area.is_wall;
                    }
                }
                changes[row * (n_x + 1) + columns.end] = 0;
            }
        }
        Ok(Self { lines, wall })
    }

    fn size(&self) -> [usize; 2] {
        [0, 1].map(|axis| self.lines[axis].len() - 1)
    }

    /// The rectangle that holds a point, from the lower left, if it is free.
    fn free_cell_at(&self, point: [f64; 2]) -> Option<[usize; 2]> {
        let [n_x, n_y] = self.size();
        let [i, j] =
            [0, 1].map(|axis| self.lines[axis].partition_point(|line| *line <= point[axis]).checked_sub(1));
        let (i, j) = (i.filter(|i| *i < n_x)?, j.filter(|j| *j < n_y)?);
        (!self.wall[j * n_x + i]).then_some([i, n_y - 1 - j])
    }

    fn blocks(self, ends: [Option<[usize; 2]>; 2]) -> Option<Blocks> {
        let [n_x, n_y] = self.size();
        let wall = (0..n_y).rev().flat_map(|j| self.wall[j * n_x..(j + 1) * n_x].iter().copied()).collect();
        let [xs, ys] = self.lines;
        let ys = ys.into_iter().rev().map(|y| -y).collect();
        Blocks::new(n_x, n_y, wall, ends).map(|blocks| blocks.with_lines([xs, ys]))
    }
}
