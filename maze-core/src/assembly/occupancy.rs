//! The maze's ground plan: which rectangles between the wall coordinates are solid and which are free.
//!
//! Raw wall faces come in pieces, doubled, and hidden where two walls meet. The plan is their sum: walking along x, each
//! face with normal -x enters a wall and each with normal +x leaves one (the winding number), so whatever
//! lies inside any wall is solid, and what remains between solid and free is exactly the faces that a ball can touch.
//! The walk is made from all four sides; where a file lacks a face they disagree, and three of four decide (`draft.rs`).

use crate::physics::numbers::greater;
use crate::physics::wall::{Facing, Plane};
use std::collections::BTreeMap;

/// How common a gap must be, as a fraction of the commonest, to be a corridor's width.
const COMMON_FRACTION: f64 = 0.25;

/// A gap narrower than this fraction of the narrow corridors is a slit between walls, however long.
const SLIT_FRACTION: f64 = 0.25;

/// The ground plan. Cell (i, j) is `xs[i]..xs[i + 1]` by `ys[j]..ys[j + 1]`.
/// Invariant: `xs` and `ys` strictly ascend and have at least two entries.
#[derive(Clone, Debug)]
pub(crate) struct Occupancy {
    pub(crate) xs: Vec<f64>,
    pub(crate) ys: Vec<f64>,
    pub(crate) solid: Vec<bool>, // row by row: [j * (xs.len() - 1) + i]
    /// Fraction of the area on which not every direction agreed, because a face is missing.
    pub(crate) doubtful_fraction: f64,
    /// Whether the normals point into the walls: the file is inside out.
    pub(crate) inverted: bool,
    /// Coordinates nearer than this became one, where there were such beyond the rounding of a file.
    pub(crate) merged_within: Option<f64>,
    /// How thick walls without thickness were made, where there were such.
    pub(crate) thickened_to: Option<f64>,
}

impl Occupancy {
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
    pub(crate) fn at_step(&self, axis: usize, step: usize, across: usize) -> Option<bool> {
        let cell = step.checked_sub(1).filter(|cell| *cell < self.n_cells()[axis])?;
        Some(if axis == 0 { self.is_solid(cell, across) } else { self.is_solid(across, cell) })
    }

    /// Every face between a solid and a free cell, the frame included; pieces that touch are joined.
    pub(crate) fn faces(&self) -> impl Iterator<Item = Plane> {
        self.outlines(|axis, step, across| self.is_solid_framed(axis, step, across))
    }

    /// Every face between a solid and a free cell, what is beyond the plan being free: what one sees of the walls.
    pub(crate) fn sides(&self) -> impl Iterator<Item = Plane> {
        self.outlines(|axis, step, across| self.at_step(axis, step, across).unwrap_or(false))
    }

    /// Faces between solid and free, joined; `is_solid` is asked for an axis, a step along it and a cell across.
    fn outlines(&self, is_solid: impl Fn(usize, usize, usize) -> bool + Copy) -> impl Iterator<Item = Plane> {
        [0, 1].into_iter().flat_map(move |axis| {
            let (offsets, alongs) = if axis == 0 { (&self.xs, &self.ys) } else { (&self.ys, &self.xs) };
            let facing = move |step: usize, across: usize| match (
                is_solid(axis, step, across),
                is_solid(axis, step + 1, across),
                axis,
            ) {
                (true, false, 0) => Some(Facing::PlusX),
                (false, true, 0) => Some(Facing::MinusX),
                (true, false, _) => Some(Facing::PlusY),
                (false, true, _) => Some(Facing::MinusY),
                _ => None,
            };
            (0..offsets.len()).flat_map(move |step| {
                let mut across = 0;
                std::iter::from_fn(move || {
                    let n_across = alongs.len() - 1;
                    while across < n_across && facing(step, across).is_none() {
                        across += 1;
                    }
                    let (first, facing_here) = (across, (across < n_across).then(|| facing(step, across))??);
                    while across < n_across && facing(step, across) == Some(facing_here) {
                        across += 1;
                    }
                    let (start, end) = (alongs[first], alongs[across]);
                    Some(Plane { facing: facing_here, offset: offsets[step], start, end })
                })
            })
        })
    }

    /// The faces of the frame: where the outer wall is open.
    pub(crate) fn openings(&self) -> Vec<Plane> {
        let [low, high] = self.corners();
        let on_rim = |face: &Plane| {
            let axis = face.facing.axis();
            face.offset == if 0.0 < face.facing.sign() { low[axis] } else { high[axis] }
        };
        let mut openings: Vec<Plane> = self.faces().filter(on_rim).collect();
        openings.sort_by(|a, b| {
            let axis = a.facing.axis().cmp(&b.facing.axis());
            axis.then(a.start.total_cmp(&b.start)).then(a.offset.total_cmp(&b.offset))
        });
        openings
    }

    /// The corridor's width: the narrowest of the common gaps between opposing faces. `None` when nothing is free.
    ///
    /// A gap counts by how far it extends; gaps within 2 % of each other are one width. Not simply the commonest, because
    /// in a maze of many turns a run of two cells can be commoner than a corridor's width; nor the narrowest, because of
    /// slits: a width must be a quarter as common as the commonest.
    pub(crate) fn corridor(&self) -> Option<f64> {
        let [_, narrow] = self.thin_and_narrow();
        let slit = SLIT_FRACTION * narrow?;
        let mut gaps = self.gaps(|axis, step, across| self.is_solid_framed(axis, step, across));
        gaps.retain(|(gap, _)| slit <= *gap);
        let extent = |width: &[(f64, f64)]| width.iter().map(|(_, extent)| extent).sum::<f64>();
        // Where walls were up to that much out of line, so are gaps.
        let noise = 2.0 * self.merged_within.unwrap_or(0.0);
        let widths = || gaps.chunk_by(|a, b| b.0 <= a.0 * 1.02 + noise);
        let most = widths().map(extent).reduce(greater)?;
        let narrowest = widths().find(|width| COMMON_FRACTION * most <= extent(width))?;
        narrowest.iter().rev().max_by(|a, b| a.1.total_cmp(&b.1)).map(|(gap, _)| *gap)
    }

    /// Makes solid what is free for less than `depth` behind the frame: a wall that is a little out of line there has no
    /// opening along its whole length.
    pub(crate) fn fill_rim(&mut self, depth: f64) {
        let n_cells = self.n_cells();
        for axis in [0, 1] {
            let n_steps = n_cells[axis];
            for across in 0..n_cells[1 - axis] {
                let cell = |step: usize| match axis {
                    0 => across * n_cells[0] + step,
                    _ => step * n_cells[0] + across,
                };
                let offsets = if axis == 0 { &self.xs } else { &self.ys };
                let n_free = (0..n_steps).take_while(|step| !self.solid[cell(*step)]).count();
                let n_free_above = (0..n_steps).rev().take_while(|step| !self.solid[cell(*step)]).count();
                let is_sliver = n_free < n_steps && offsets[n_free] - offsets[0] < depth;
                let is_sliver_above =
                    n_free < n_steps && offsets[n_steps] - offsets[n_steps - n_free_above] < depth;
                for step in 0..n_steps {
                    let fills =
                        (is_sliver && step < n_free) || (is_sliver_above && n_steps - n_free_above <= step);
                    self.solid[cell(step)] |= fills;
                }
            }
        }
    }

    /// Walls and corridors in each other's place, in a ring of wall of this thickness.
    pub(crate) fn turned_over(self, ring: f64) -> Self {
        let [n_x, n_y] = self.n_cells();
        let widened = |values: &[f64]| {
            let ends = [values[0] - ring, values[values.len() - 1] + ring];
            std::iter::once(ends[0]).chain(values.iter().copied()).chain(std::iter::once(ends[1])).collect()
        };
        let (xs, ys) = (widened(&self.xs), widened(&self.ys));
        let mut solid = vec![true; (n_x + 2) * (n_y + 2)];
        for j in 0..n_y {
            for i in 0..n_x {
                solid[(j + 1) * (n_x + 2) + i + 1] = !self.is_solid(i, j);
            }
        }
        Self { xs, ys, solid, inverted: false, ..self }
    }

    /// How thin the thin walls are, and how narrow the narrow corridors, noise aside: the widths below which lies a tenth of
    /// the area. `None` when nothing is solid, or free.
    pub(crate) fn thin_and_narrow(&self) -> [Option<f64>; 2] {
        let tenth = |gaps: &[(f64, f64)]| {
            let mut rest = 0.1 * gaps.iter().map(|(gap, extent)| gap * extent).sum::<f64>();
            gaps.iter().map(|(gap, extent)| (*gap, gap * extent)).find_map(|(gap, area)| {
                rest -= area;
                (rest < 0.0).then_some(gap)
            })
        };
        let walls = self.gaps(|axis, step, across| !self.at_step(axis, step, across).unwrap_or(false));
        let corridors = self.gaps(|axis, step, across| self.is_solid_framed(axis, step, across));
        [tenth(&walls), tenth(&corridors)]
    }

    /// The gaps between what `is_edge` (both ends of the plan must be), ascending, and how far each extends.
    fn gaps(&self, is_edge: impl Fn(usize, usize, usize) -> bool) -> Vec<(f64, f64)> {
        let mut extents: BTreeMap<u64, f64> = BTreeMap::new(); // bits of a positive float order as the float
        for axis in [0, 1] {
            let (offsets, alongs) = if axis == 0 { (&self.xs, &self.ys) } else { (&self.ys, &self.xs) };
            for across in 0..alongs.len() - 1 {
                let mut first = 0;
                for step in 0..offsets.len() {
                    // Steps are counted from the frame: its far side ends the last gap.
                    if is_edge(axis, step + 1, across) {
                        if first < step {
                            let gap = offsets[step] - offsets[first];
                            *extents.entry(gap.to_bits()).or_default() += alongs[across + 1] - alongs[across];
                        }
                        first = step + 1;
                    }
                }
            }
        }
        extents.into_iter().map(|(bits, extent)| (f64::from_bits(bits), extent)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{PlanError, SortedPlanes};

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

    fn plan(blocks: &[[Plane; 4]]) -> Occupancy {
        Occupancy::new(&blocks.concat()).unwrap()
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
        let planes = SortedPlanes::new(plan(&ring()).faces()).unwrap();
        assert_eq!(planes.len(), 4, "only the four inner faces remain: {planes:?}");
        let inner: Vec<_> = Facing::ALL.into_iter().flat_map(|facing| planes.planes(facing)).collect();
        assert!(inner.iter().all(|plane| (plane.start, plane.end) == (1.0, 4.0)));
    }

    #[test]
    fn overlapping_walls_are_one() {
        let mut blocks = ring();
        blocks.push(block([0.5, 2.0], [2.0, 3.0])); // a stub that reaches into the left wall
        let planes = SortedPlanes::new(plan(&blocks).faces()).unwrap();
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
        let inverted = SortedPlanes::new(Occupancy::new(&raw).unwrap().faces()).unwrap();
        assert_eq!(inverted, SortedPlanes::new(plan(&ring()).faces()).unwrap());
    }

    #[test]
    fn openings_of_the_outer_wall_are_found_and_closed_by_the_frame() {
        let mut blocks = ring();
        // The far wall has a gap from x = 2 to 4.
        blocks[1] = block([0.0, 2.0], [4.0, 5.0]);
        blocks.push(block([4.0, 5.0], [4.0, 5.0]));
        let plan = plan(&blocks);
        let openings = plan.openings();
        assert_eq!(openings, [Plane { facing: Facing::MinusY, offset: 5.0, start: 2.0, end: 4.0 }]);
        assert!(plan.faces().any(|face| face.facing == Facing::MinusY && face.offset == 5.0));
    }

    #[test]
    fn the_narrowest_common_gap_is_the_corridor() {
        let mut blocks = vec![block([0.0, 10.0], [-1.0, 0.0])];
        blocks.push(block([0.0, 10.0], [1.5, 2.0])); // a corridor 1.5 wide and 10 long
        blocks.push(block([0.0, 3.0], [4.0, 5.0])); // and a space 2 wide and 3 long
        blocks.push(block([3.0, 4.0], [2.0, 5.0]));
        blocks.push(block([4.0, 4.5], [2.2, 5.0])); // and a slit
        assert_eq!(plan(&blocks).corridor(), Some(1.5));
    }

    #[test]
    fn rounding_in_the_file_does_not_split_a_coordinate() {
        let mut blocks = ring();
        blocks[2] = block([0.0, 1.000_001], [0.999_999, 4.0]);
        let planes = SortedPlanes::new(plan(&blocks).faces()).unwrap();
        assert_eq!(planes.len(), 4, "{planes:?}");
    }

    #[test]
    fn a_forgotten_face_is_outvoted() {
        let whole = SortedPlanes::new(plan(&ring()).faces()).unwrap();
        let raw = ring().concat();
        for missing in 0..raw.len() {
            let mut raw = raw.clone();
            raw.remove(missing);
            let plan = Occupancy::new(&raw).unwrap();
            assert_eq!(SortedPlanes::new(plan.faces()).unwrap(), whole, "without face {missing}");
        }
    }

    #[test]
    fn a_wall_without_thickness_is_given_one() {
        let face = |facing| Plane { facing, offset: 2.5, start: 1.0, end: 3.0 };
        let mut raw = ring().concat();
        raw.extend([Facing::MinusX, Facing::PlusX].map(face));
        let plan = Occupancy::new(&raw).unwrap();
        // Corridors of 1.5 on either side; a tenth of that, and half of it beyond the open end.
        let thickness = plan.thickened_to.unwrap();
        assert!((thickness - 0.15).abs() < 1.0e-4, "{thickness}");
        let planes = SortedPlanes::new(plan.faces()).unwrap();
        let end: Vec<_> = planes.planes(Facing::PlusY).map(|plane| plane.offset).collect();
        // The room's wall on either side, and the end.
        assert_eq!(end, [1.0, 1.0, 3.0 + thickness / 2.0]);
    }

    #[test]
    fn noise_of_many_near_planes_is_merged_and_a_thin_wall_is_not() {
        let noisy = |by: f64| {
            let mut blocks = ring();
            blocks[0] = block([0.0, 2.0], [0.0, 1.0]);
            blocks.push(block([2.0, 5.0], [0.0, 1.0 + by]));
            plan(&blocks)
        };
        // A thousandth of the size is 0.005.
        let merged = noisy(0.004);
        assert_eq!(SortedPlanes::new(merged.faces()).unwrap().len(), 4);
        assert_eq!(merged.merged_within, Some(0.005));
        let kept = noisy(0.02);
        assert_eq!((SortedPlanes::new(kept.faces()).unwrap().len(), kept.merged_within), (6, None));
        // Walls of a thousandth of the size stay two faces apart.
        let thin: Vec<_> = (0..5).map(|n| block([0.0, 10.0], [f64::from(n), f64::from(n) + 0.004])).collect();
        assert_eq!(plan(&thin).ys.len(), 10);
    }

    #[test]
    fn walls_that_lack_only_their_ends_are_solid_between_their_sides() {
        let raw: Vec<Plane> = ring().concat().into_iter().filter(|plane| plane.facing.axis() == 0).collect();
        let planes = SortedPlanes::new(Occupancy::new(&raw).unwrap().faces()).unwrap();
        assert_eq!(planes, SortedPlanes::new(plan(&ring()).faces()).unwrap());
    }

    #[test]
    fn walls_seen_from_one_side_are_given_two() {
        // A room of 4 x 4 with a wall from the left, all single faces, whichever way they face.
        let face = |facing, offset, start, end| Plane { facing, offset, start, end };
        for flip in [Facing::PlusY, Facing::MinusY] {
            let raw = [
                face(Facing::PlusX, 0.0, 0.0, 4.0),
                face(Facing::PlusX, 4.0, 0.0, 4.0),
                face(flip, 0.0, 0.0, 4.0),
                face(Facing::PlusY, 4.0, 0.0, 4.0),
                face(flip, 2.0, 0.0, 3.0),
            ];
            let plan = Occupancy::new(&raw).unwrap();
            assert!(plan.thickened_to.is_some());
            assert_eq!(SortedPlanes::new(plan.faces()).unwrap().len(), 8, "{flip:?}");
        }
    }

    #[test]
    fn walls_that_do_not_close_are_refused_with_the_place() {
        // The near wall has lost both its long sides.
        let raw: Vec<Plane> = ring()
            .concat()
            .into_iter()
            .enumerate()
            .filter(|(n, _)| !matches!(n, 2 | 3))
            .map(|(_, plane)| plane)
            .collect();
        let error = Occupancy::new(&raw).unwrap_err();
        assert!(matches!(error, PlanError::Open { .. }), "{error}");
    }
}
