//! The maze's ground plan: which rectangles between the wall coordinates are solid and which are free.
//!
//! Raw wall faces come in pieces, doubled, and hidden where two walls meet. The plan is their sum: walking along x, each
//! face that looks towards -x enters a wall and each that looks towards +x leaves one (the winding number), so whatever
//! lies inside any wall is solid, and what remains between solid and free is exactly the faces that a ball can touch.
//! The walk is made from all four sides; where a file lacks a face they disagree, and three of four decide.

use crate::plane::{Facing, Plane};
use crate::winding::{Coordinates, Edge, FaceRun, edges, runs, used_coordinates, votes};
use std::collections::BTreeMap;

/// Coordinates nearer than this part of the plan's size are one coordinate: between the rounding of a file with six
/// decimals (1e-6) and the thinnest wall of a maze of a thousand corridors (1e-4).
const MERGE_PART: f64 = 1.0e-5;

/// Most rectangles of a plan: 2048 x 2048, a maze of 1000 x 1000 cells. It takes some 200 MB to find the way through one.
const MAX_CELLS: usize = 1 << 22;

/// Percent of the walls' length that may be faces without thickness, which are no walls, before the file is refused.
const MAX_SHEET_PERCENT: f64 = 1.0;

/// Percent of the plan that may look solid from two sides and free from the other two before the walls count as open.
/// A careless modeller's forgotten face stays below it.
const MAX_TIED_PERCENT: f64 = 1.0;

/// Why wall faces make no ground plan.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum SectionError {
    /// The walls do not close.
    #[error(
        "the walls are not closed: {percent:.1} % of the plan looks solid from two sides and free from the other two, \
         first near ({x}, {y}) across the up axis; expected walls with two sides and closed ends"
    )]
    Open {
        /// Share of the plan's area.
        percent: f64,
        /// File units, up axis turned to z.
        x: f64,
        /// File units, up axis turned to z.
        y: f64,
    },
    /// Walls without thickness.
    #[error(
        "{percent:.1} % of the walls' length has no thickness, first near ({x}, {y}) across the up axis; expected walls \
         with two sides that stand apart"
    )]
    Sheets {
        /// Share of the length of all wall faces.
        percent: f64,
        /// File units, up axis turned to z.
        x: f64,
        /// File units, up axis turned to z.
        y: f64,
    },
    /// More wall coordinates than a maze has.
    #[error("{n_x} x {n_y} distinct wall coordinates: expected at most {max} rectangles", max = MAX_CELLS)]
    TooFine {
        /// Along x.
        n_x: usize,
        /// Along y.
        n_y: usize,
    },
}

/// How common a gap must be, as a part of the commonest, to be a corridor's width.
const COMMON_PART: f64 = 0.25;

/// The ground plan. Cell (i, j) is `xs[i]..xs[i + 1]` by `ys[j]..ys[j + 1]`.
/// Invariant: `xs` and `ys` strictly ascend and have at least two entries.
#[derive(Clone, Debug)]
pub(crate) struct Section {
    pub(crate) xs: Vec<f64>,
    pub(crate) ys: Vec<f64>,
    solid: Vec<bool>, // row by row: [j * (xs.len() - 1) + i]
    /// Part of the area on which not every direction agreed, because a face is missing.
    pub(crate) doubtful_part: f64,
    /// Whether the faces look into the walls: the file is inside out.
    pub(crate) inverted: bool,
}

impl Section {
    /// Sums up wall faces. `raw` must not be empty.
    pub(crate) fn new(raw: &[Plane]) -> Result<Self, SectionError> {
        let [xs, ys] = [0, 1].map(|axis| {
            let values = raw.iter().flat_map(|plane| match plane.facing.axis() == axis {
                true => [plane.offset, plane.offset],
                false => [plane.start, plane.end],
            });
            values.collect::<Vec<_>>()
        });
        let extent = |values: &[f64]| {
            let low = values.iter().copied().reduce(|a, b| if b < a { b } else { a });
            let high = values.iter().copied().reduce(|a, b| if a < b { b } else { a });
            high.unwrap_or(0.0) - low.unwrap_or(0.0)
        };
        let size = if extent(&xs) < extent(&ys) { extent(&ys) } else { extent(&xs) };
        let coordinates = [xs, ys].map(|values| Coordinates::new(values, size * MERGE_PART));
        let edges = edges(raw, &coordinates);
        let used = used_coordinates(&edges, &coordinates);
        let [xs, ys] = [0, 1].map(|axis| {
            let of_axis: &Coordinates = &coordinates[axis];
            let kept = of_axis.values.iter().zip(&used[axis]).filter(|(_, new)| new.is_some());
            kept.map(|(value, _)| *value).collect::<Vec<_>>()
        });
        let (n_x, n_y) = (xs.len(), ys.len());
        if n_x.checked_mul(n_y).is_none_or(|cells| MAX_CELLS < cells) {
            return Err(SectionError::TooFine { n_x, n_y });
        }
        if n_x < 2 || n_y < 2 {
            let (x, y) = (xs.first().copied().unwrap_or(0.0), ys.first().copied().unwrap_or(0.0));
            return Err(SectionError::Open { percent: 100.0, x, y });
        }
        let votes = [0, 1].map(|axis| {
            let n_cells = [n_x - 1, n_y - 1];
            votes(&edges, &used, axis, n_cells[axis], n_cells[1 - axis])
        });
        let mut section = Self::from_votes(xs, ys, &votes)?;
        section.refuse_sheets(&edges, &used)?;
        section.inverted = section.enters_more_than_leaves(&edges, &used) < 0;
        Ok(section)
    }

    /// `votes[0][j * n_x + i]` and `votes[1][i * n_y + j]` say how often cell (i, j) looked solid, 0 to 2 times each.
    fn from_votes(xs: Vec<f64>, ys: Vec<f64>, votes: &[Vec<u8>; 2]) -> Result<Self, SectionError> {
        let (n_x, n_y) = (xs.len() - 1, ys.len() - 1);
        let inverted = false;
        let mut section = Self { xs, ys, solid: vec![false; n_x * n_y], doubtful_part: 0.0, inverted };
        let (mut doubtful_area, mut tied_area, mut first_tie) = (0.0, 0.0, None);
        for j in 0..n_y {
            for i in 0..n_x {
                let n_solid = votes[0][j * n_x + i] + votes[1][i * n_y + j];
                section.solid[j * n_x + i] = 3 <= n_solid;
                let area = (section.xs[i + 1] - section.xs[i]) * (section.ys[j + 1] - section.ys[j]);
                if !matches!(n_solid, 0 | 4) {
                    doubtful_area += area;
                }
                if n_solid == 2 {
                    tied_area += area;
                    first_tie = first_tie.or(Some((section.xs[i], section.ys[j])));
                }
            }
        }
        let [low, high] = section.corners();
        let area = (high[0] - low[0]) * (high[1] - low[1]);
        section.doubtful_part = doubtful_area / area;
        let percent = 100.0 * tied_area / area;
        match first_tie {
            Some((x, y)) if MAX_TIED_PERCENT < percent => Err(SectionError::Open { percent, x, y }),
            _ => Ok(section),
        }
    }

    /// On how many pieces of face, walked upwards from free into solid, a wall is entered as it should be, less those on which
    /// it is left.
    fn enters_more_than_leaves(&self, edges: &[Edge], used: &[Vec<Option<usize>>; 2]) -> i64 {
        let all = [0, 1].into_iter().flat_map(|axis| runs(edges, used, axis));
        let of_run = |run: FaceRun| {
            let is_solid = move |step, across| self.at_step(run.axis, step, across).unwrap_or(false);
            let into_solid =
                move |across: &usize| !is_solid(run.step, *across) && is_solid(run.step + 1, *across);
            i64::from(run.change.signum()) * run.across.filter(into_solid).map(|_| 1).sum::<i64>()
        };
        all.map(of_run).sum()
    }

    /// Refuses wall faces that part nothing from nothing: both sides at one place, or one side alone.
    fn refuse_sheets(&self, edges: &[Edge], used: &[Vec<Option<usize>>; 2]) -> Result<(), SectionError> {
        let (mut length, mut sheets, mut first) = (0.0, 0.0, None);
        for run in [0, 1].into_iter().flat_map(|axis| runs(edges, used, axis)) {
            let alongs = if run.axis == 0 { &self.ys } else { &self.xs };
            for across in run.across {
                let extent = alongs[across + 1] - alongs[across];
                length += extent;
                // The frame is no wall here: beyond it all is free.
                let is_free = |step: usize| !self.at_step(run.axis, step, across).unwrap_or(false);
                if is_free(run.step) && is_free(run.step + 1) {
                    sheets += extent;
                    let (i, j) = if run.axis == 0 { (run.step, across) } else { (across, run.step) };
                    first = first.or(Some((self.xs[i], self.ys[j])));
                }
            }
        }
        let percent = 100.0 * sheets / length;
        match first {
            Some((x, y)) if MAX_SHEET_PERCENT < percent => Err(SectionError::Sheets { percent, x, y }),
            _ => Ok(()),
        }
    }

    /// Number of cells along x and along y.
    pub(crate) fn n_cells(&self) -> [usize; 2] {
        [self.xs.len() - 1, self.ys.len() - 1]
    }

    /// Lower left and upper right corner of the plan.
    pub(crate) fn corners(&self) -> [[f64; 2]; 2] {
        [[self.xs[0], self.ys[0]], [self.xs[self.xs.len() - 1], self.ys[self.ys.len() - 1]]]
    }

    /// Whether cell (i, j) is wall.
    pub(crate) fn is_solid(&self, i: usize, j: usize) -> bool {
        self.solid[j * (self.xs.len() - 1) + i]
    }

    /// The plan with every coordinate moved; both maps must be strictly increasing.
    pub(crate) fn map(mut self, x: impl Fn(f64) -> f64, y: impl Fn(f64) -> f64) -> Self {
        self.xs.iter_mut().for_each(|value| *value = x(*value));
        self.ys.iter_mut().for_each(|value| *value = y(*value));
        self
    }

    /// What lies at cell (i, j) of the plan framed by one ring of solid cells, so that no ball leaves the board.
    fn is_solid_framed(&self, axis: usize, step: usize, across: usize) -> bool {
        self.at_step(axis, step, across).unwrap_or(true)
    }

    /// Whether the cell before the `step`-th coordinate along an axis is solid; `None` beyond the plan.
    fn at_step(&self, axis: usize, step: usize, across: usize) -> Option<bool> {
        let cell = step.checked_sub(1).filter(|cell| *cell < self.n_cells()[axis])?;
        Some(if axis == 0 { self.is_solid(cell, across) } else { self.is_solid(across, cell) })
    }

    /// Every face between a solid and a free cell, in pieces one cell long; the frame included.
    pub(crate) fn faces(&self) -> impl Iterator<Item = Plane> {
        [0, 1].into_iter().flat_map(move |axis| {
            let (offsets, alongs) = if axis == 0 { (&self.xs, &self.ys) } else { (&self.ys, &self.xs) };
            (0..alongs.len() - 1).flat_map(move |across| {
                (0..offsets.len()).filter_map(move |step| {
                    let before = self.is_solid_framed(axis, step, across);
                    let after = self.is_solid_framed(axis, step + 1, across);
                    let facing = match (before, after, axis) {
                        (true, false, 0) => Facing::PlusX,
                        (false, true, 0) => Facing::MinusX,
                        (true, false, _) => Facing::PlusY,
                        (false, true, _) => Facing::MinusY,
                        _ => return None,
                    };
                    let (start, end) = (alongs[across], alongs[across + 1]);
                    Some(Plane { facing, offset: offsets[step], start, end })
                })
            })
        })
    }

    /// The faces of the frame: where the outer wall is open. Pieces that touch are joined.
    pub(crate) fn openings(&self) -> Vec<Plane> {
        let [low, high] = self.corners();
        let mut openings: Vec<Plane> = Vec::new();
        for face in self.faces() {
            let axis = face.facing.axis();
            let rim = if 0.0 < face.facing.sign() { low[axis] } else { high[axis] };
            if face.offset != rim {
                continue;
            }
            match openings.iter_mut().find(|known| known.facing == face.facing && known.end == face.start) {
                Some(known) => known.end = face.end,
                None => openings.push(face),
            }
        }
        openings
    }

    /// The corridor's width: the narrowest of the common gaps between opposing faces. `None` when nothing is free.
    ///
    /// A gap counts by how far it extends; gaps within 2 % of each other are one width. Not simply the commonest, because
    /// in a maze of many turns a run of two cells can be commoner than a corridor's width; nor the narrowest, because of
    /// slits: a width must be a quarter as common as the commonest.
    pub(crate) fn corridor(&self) -> Option<f64> {
        let mut extents: BTreeMap<u64, f64> = BTreeMap::new(); // bits of a positive float order as the float
        for axis in [0, 1] {
            let (offsets, alongs) = if axis == 0 { (&self.xs, &self.ys) } else { (&self.ys, &self.xs) };
            for across in 0..alongs.len() - 1 {
                let mut first_free = 0;
                for step in 0..offsets.len() {
                    // Steps are counted from the frame: its far side ends the last gap.
                    if self.is_solid_framed(axis, step + 1, across) {
                        if first_free < step {
                            let gap = offsets[step] - offsets[first_free];
                            *extents.entry(gap.to_bits()).or_default() += alongs[across + 1] - alongs[across];
                        }
                        first_free = step + 1;
                    }
                }
            }
        }
        let gaps: Vec<(f64, f64)> =
            extents.into_iter().map(|(bits, extent)| (f64::from_bits(bits), extent)).collect();
        let extent = |width: &[(f64, f64)]| width.iter().map(|(_, extent)| extent).sum::<f64>();
        let widths = || gaps.chunk_by(|a, b| b.0 <= a.0 * 1.02);
        let most = widths().map(extent).reduce(|a, b| if a < b { b } else { a })?;
        let narrowest = widths().find(|width| COMMON_PART * most <= extent(width))?;
        narrowest.iter().rev().max_by(|a, b| a.1.total_cmp(&b.1)).map(|(gap, _)| *gap)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SortedPlanes;

    /// The four faces of a solid rectangle.
    fn block(x: [f64; 2], y: [f64; 2]) -> [Plane; 4] {
        let plane = |facing, offset, [start, end]: [f64; 2]| Plane { facing, offset, start, end };
        [
            plane(Facing::MinusX, x[0], y),
            plane(Facing::PlusX, x[1], y),
            plane(Facing::MinusY, y[0], x),
            plane(Facing::PlusY, y[1], x),
        ]
    }

    fn section(blocks: &[[Plane; 4]]) -> Section {
        Section::new(&blocks.concat()).unwrap()
    }

    /// A ring of walls, one unit thick, with a 3 x 3 hole.
    fn ring() -> Vec<[Plane; 4]> {
        vec![
            block([0.0, 5.0], [0.0, 1.0]),
            block([0.0, 5.0], [4.0, 5.0]),
            block([0.0, 1.0], [1.0, 4.0]),
            block([4.0, 5.0], [1.0, 4.0]),
        ]
    }

    #[test]
    fn faces_hidden_where_two_walls_meet_are_dropped() {
        let planes = SortedPlanes::new(section(&ring()).faces()).unwrap();
        assert_eq!(planes.len(), 4, "only the four inner faces remain: {planes:?}");
        let inner: Vec<_> = Facing::ALL.into_iter().flat_map(|facing| planes.planes(facing)).collect();
        assert!(inner.iter().all(|plane| (plane.start, plane.end) == (1.0, 4.0)));
    }

    #[test]
    fn overlapping_walls_are_one() {
        let mut blocks = ring();
        blocks.push(block([0.5, 2.0], [2.0, 3.0])); // a stub that reaches into the left wall
        let planes = SortedPlanes::new(section(&blocks).faces()).unwrap();
        let plus_x: Vec<_> = planes.planes(Facing::PlusX).map(|p| (p.offset, p.start, p.end)).collect();
        assert_eq!(plus_x, [(1.0, 1.0, 2.0), (1.0, 3.0, 4.0), (2.0, 2.0, 3.0)]);
    }

    #[test]
    fn inverted_walls_are_as_solid() {
        let flipped = |plane: Plane| Plane {
            facing: match plane.facing {
                Facing::PlusX => Facing::MinusX,
                Facing::MinusX => Facing::PlusX,
                Facing::PlusY => Facing::MinusY,
                Facing::MinusY => Facing::PlusY,
            },
            ..plane
        };
        let raw: Vec<Plane> = ring().concat().into_iter().map(flipped).collect();
        let inverted = SortedPlanes::new(Section::new(&raw).unwrap().faces()).unwrap();
        assert_eq!(inverted, SortedPlanes::new(section(&ring()).faces()).unwrap());
    }

    #[test]
    fn openings_of_the_outer_wall_are_found_and_closed_by_the_frame() {
        let mut blocks = ring();
        // The far wall has a gap from x = 2 to 4.
        blocks[1] = block([0.0, 2.0], [4.0, 5.0]);
        blocks.push(block([4.0, 5.0], [4.0, 5.0]));
        let section = section(&blocks);
        let openings = section.openings();
        assert_eq!(openings, [Plane { facing: Facing::MinusY, offset: 5.0, start: 2.0, end: 4.0 }]);
        assert!(section.faces().any(|face| face.facing == Facing::MinusY && face.offset == 5.0));
    }

    #[test]
    fn the_narrowest_common_gap_is_the_corridor() {
        let mut blocks = vec![block([0.0, 10.0], [-1.0, 0.0])];
        blocks.push(block([0.0, 10.0], [1.5, 2.0])); // a corridor 1.5 wide and 10 long
        blocks.push(block([0.0, 3.0], [4.0, 5.0])); // and a space 2 wide and 3 long
        blocks.push(block([3.0, 4.0], [2.0, 5.0]));
        blocks.push(block([4.0, 4.5], [2.2, 5.0])); // and a slit
        assert_eq!(section(&blocks).corridor(), Some(1.5));
    }

    #[test]
    fn rounding_in_the_file_does_not_split_a_coordinate() {
        let mut blocks = ring();
        blocks[2] = block([0.0, 1.000_001], [0.999_999, 4.0]);
        let planes = SortedPlanes::new(section(&blocks).faces()).unwrap();
        assert_eq!(planes.len(), 4, "{planes:?}");
    }

    #[test]
    fn a_forgotten_face_is_outvoted() {
        let whole = SortedPlanes::new(section(&ring()).faces()).unwrap();
        let raw = ring().concat();
        for missing in 0..raw.len() {
            let mut raw = raw.clone();
            raw.remove(missing);
            let section = Section::new(&raw).unwrap();
            assert_eq!(SortedPlanes::new(section.faces()).unwrap(), whole, "without face {missing}");
        }
    }

    #[test]
    fn walls_without_thickness_are_refused_with_the_place() {
        let mut raw = ring().concat();
        raw.push(Plane { facing: Facing::MinusX, offset: 2.5, start: 1.0, end: 3.0 });
        raw.push(Plane { facing: Facing::PlusX, offset: 2.5, start: 1.0, end: 3.0 });
        let error = Section::new(&raw).unwrap_err();
        assert!(matches!(error, SectionError::Sheets { x: 2.5, y: 1.0, .. }), "{error}");
    }

    #[test]
    fn walls_without_ends_are_refused_with_the_place() {
        let raw: Vec<Plane> = ring().concat().into_iter().filter(|plane| plane.facing.axis() == 0).collect();
        let raw = &raw;
        let error = Section::new(raw).unwrap_err();
        assert!(matches!(error, SectionError::Open { .. }), "{error}");
    }
}
