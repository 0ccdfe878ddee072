//! From raw wall faces to the ground plan: noise merged, faces summed up, what does not close refused.

use crate::assembly::occupancy::Occupancy;
use crate::assembly::winding::{Coordinates, Edge, FaceRun, Repeats, edges, runs, used_coordinates, votes};
use crate::physics::numbers::{greater, lesser};
use crate::physics::wall::{Facing, Plane};

/// Coordinates nearer than this fraction of the plan's size are one coordinate: between the rounding of a file with six
/// decimals (1e-6) and the thinnest wall of a maze of a thousand corridors (1e-4).
const MERGE_FRACTION: f64 = 1.0e-5;

/// Coordinates nearer than this fraction of the plan's size are noise and one coordinate, ...
const NOISE_FRACTION: f64 = 1.0e-3;
/// ... but never more than this fraction of a wall's thickness ...
const NOISE_OF_THICKNESS: f64 = 0.25;
/// ... nor than this fraction of a corridor.
const NOISE_OF_CORRIDOR: f64 = 1.0 / 16.0;

/// A wall nearer to the rim of the plan than this fraction of a corridor is the rim.
const RIM_OF_CORRIDOR: f64 = 1.0 / 8.0;

/// Most rectangles of any plan: a maze of 1024 x 1024 cells has 2050 x 2050 distinct coordinates.
const MAX_CELLS: usize = 2050 * 2050;
/// Most rectangles of the plan of a few faces, and how many more for each end of a face: a maze of n x n cells has some 4 n²
/// rectangles and 3 n² ends. A rectangle takes some 60 bytes to find the paths through, so no small file takes much memory.
const MAX_CELLS_ANYWAY: usize = 1 << 19;
const MAX_CELLS_PER_EDGE: usize = 4;

/// Thickness of walls that have none, as a fraction of the corridor.
const THICKENED_FRACTION: f64 = 0.1;
/// What they get to find the corridor by, as a fraction of the plan's size.
const THICKENED_FIRST: f64 = 1.0e-4;

/// Fraction of the ties above which the walls have two sides and only lack their ends.
const ENDLESS_FRACTION: f64 = 0.9;

/// Fraction of the faces' ends that meet no other face from which on the faces are walls without thickness, seen from one side.
const LOOSE_FRACTION: f64 = 0.5;

/// Fraction of the plan in doubt from which on faces are counted in other ways too.
const MAX_DOUBT: f64 = 0.02;

/// Most pairs of a face and a thin_wall that are compared.
const MAX_PAIRS: usize = 1 << 26;

/// Percent of the walls' length that may be faces without thickness, which are no walls, before the file is refused.
const MAX_SHEET_PERCENT: f64 = 1.0;

/// A face without thickness longer than this fraction of a corridor is met all the same.
const SHEET_OF_CORRIDOR: f64 = 0.25;

/// Percent of the plan that may count as solid from two sides and free from the other two before the walls count as open.
/// A careless modeller's forgotten face stays below it.
const MAX_TIED_PERCENT: f64 = 1.0;

/// Why wall faces make no ground plan.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PlanError {
    /// The walls do not close.
    #[error(
        "the walls are not closed: {percent:.1} % of the plan counts as solid from two sides and free from the other two, \
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
    /// Faces with free space on both sides.
    #[error(
        "{percent:.1} % of the walls' length has the same on both sides, first near ({x}, {y}) across the up axis; \
         expected walls around a corridor"
    )]
    ThinWalls {
        /// Share of the length of all wall faces.
        percent: f64,
        /// File units, up axis turned to z.
        x: f64,
        /// File units, up axis turned to z.
        y: f64,
    },
    /// All walls stand in one line.
    #[error("the walls enclose nothing: all stand in one line")]
    Nothing,
    /// More wall coordinates than a maze has.
    #[error("{n_x} x {n_y} distinct wall coordinates: expected at most {max} rectangles for so many faces")]
    TooFine {
        /// Along x.
        n_x: usize,
        /// Along y.
        n_y: usize,
        /// Most rectangles.
        max: usize,
    },
}

/// A plan that has not been judged yet, and what it was summed up from.
struct Draft {
    plan: Occupancy,
    edges: Vec<Edge>,
    used: [Vec<Option<usize>>; 2],
    tied_percent: f64,
    first_tie: Option<[f64; 2]>,
    /// Fraction of the tied area that counts as solid from both sides along one axis and free from both along the other.
    endless_part: f64,
    endless: Vec<usize>,
}

impl Occupancy {
    /// Sums up wall faces. `raw` must not be empty.
    pub(crate) fn new(raw: &[Plane]) -> Result<Self, PlanError> {
        // How far a plan is from one without a doubt.
        let doubt = |plan: &Result<Self, PlanError>| match plan {
            Ok(plan) if plan.thickened_to.is_none() => plan.doubtful_fraction,
            _ => f64::INFINITY,
        };
        let mut best = Self::summed(raw, Repeats::Count);
        // Faces that are there several times for no reason, or with their backs, may be what is wrong.
        for repeats in [Repeats::Once, Repeats::Fronts] {
            if doubt(&best) <= MAX_DOUBT {
                break;
            }
            let other = Self::summed(raw, repeats);
            if doubt(&other) < doubt(&best) {
                best = other;
            }
        }
        best
    }

    fn summed(raw: &[Plane], repeats: Repeats) -> Result<Self, PlanError> {
        let size = size(raw);
        let fine = Draft::new(raw, size * MERGE_FRACTION, repeats)?;
        let within = fine.plan.noise(size);
        let draft = if fine.plan.narrowest_gap() < within {
            let merged = Draft::new(raw, within, repeats)?;
            // Noise is merged to help; where that does not, the file is taken as it is.
            match (fine.fault(), merged.fault()) {
                (None, Some(_)) => fine,
                _ => Draft { plan: Self { merged_within: Some(within), ..merged.plan }, ..merged },
            }
        } else {
            fine
        };
        let fault = draft.fault();
        let max = MAX_CELLS_ANYWAY + MAX_CELLS_PER_EDGE * draft.edges.len();
        if fault.is_none() && max < draft.plan.solid.len() {
            return Err(draft.plan.too_fine(max));
        }
        let (solid, thin_walls) = match fault {
            _ if LOOSE_FRACTION < draft.loose_part() => {
                if ENDLESS_FRACTION < draft.endless_part {
                    return draft.with_ends();
                }
                // Faces seen from one side must not count for winding; those of both sides cancel.
                (&[][..], joined(raw))
            }
            None => return Ok(draft.with_sheets(raw, size, max)),
            Some(PlanError::ThinWalls { .. }) => (raw, draft.thin_walls().2),
            Some(fault) => return Err(fault),
        };
        thickened(solid, &thin_walls, size, max)?.ok_or(fault.unwrap_or(PlanError::Nothing))
    }

    fn too_fine(&self, max: usize) -> PlanError {
        PlanError::TooFine { n_x: self.xs.len(), n_y: self.ys.len(), max }
    }

    /// The tolerance within which coordinates are noise.
    fn noise(&self, size: f64) -> f64 {
        let [thin, narrow] = self.thin_and_narrow();
        let of = |width: Option<f64>, fraction: f64| width.map(|width| width * fraction);
        let limits = [of(thin, NOISE_OF_THICKNESS), of(narrow, NOISE_OF_CORRIDOR)];
        limits.into_iter().flatten().fold(size * NOISE_FRACTION, lesser)
    }

    /// Between two coordinates next to each other.
    fn narrowest_gap(&self) -> f64 {
        let gaps = [&self.xs, &self.ys].into_iter().flat_map(|values| values.windows(2));
        gaps.map(|pair| pair[1] - pair[0]).fold(f64::INFINITY, lesser)
    }
}

/// The plan's larger extent.
fn size(raw: &[Plane]) -> f64 {
    let extent = |axis: usize| {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for plane in raw {
            let ends = if plane.facing.axis() == axis { [plane.offset; 2] } else { [plane.start, plane.end] };
            low = lesser(low, ends[0]);
            high = greater(high, ends[1]);
        }
        if low < high { high - low } else { 0.0 }
    };
    let [x, y] = [0, 1].map(extent);
    greater(x, y)
}

/// The plan with walls around faces that have no thickness; `None` where that makes no maze either.
fn thickened(
    solid: &[Plane],
    thin_walls: &[Plane],
    size: f64,
    max_cells: usize,
) -> Result<Option<Occupancy>, PlanError> {
    let with = |thickness: f64| {
        let boxes = thin_walls.iter().flat_map(|thin_wall| around(thin_wall, thickness / 2.0));
        let raw: Vec<Plane> = solid.iter().copied().chain(boxes).collect();
        let draft = Draft::new(&raw, size * MERGE_FRACTION, Repeats::Count)?;
        match max_cells < draft.plan.solid.len() {
            true => Err(draft.plan.too_fine(max_cells)),
            false => Ok(draft.fault().is_none().then(|| draft.finish())),
        }
    };
    let Some(corridor) = with(size * THICKENED_FIRST)?.and_then(|plan| plan.corridor()) else {
        return Ok(None);
    };
    let thickness = THICKENED_FRACTION * corridor;
    Ok(with(thickness)?.map(|plan| Occupancy { thickened_to: Some(thickness), ..plan }))
}

/// Faces along the same lines, whichever way they face, as few as can be.
fn joined(raw: &[Plane]) -> Vec<Plane> {
    let mut joined = raw.to_vec();
    joined.sort_unstable_by(|a, b| {
        let axis = a.facing.axis().cmp(&b.facing.axis());
        axis.then(a.offset.total_cmp(&b.offset)).then(a.start.total_cmp(&b.start))
    });
    joined.dedup_by(|next, known| {
        let is_on = (next.facing.axis(), next.offset) == (known.facing.axis(), known.offset);
        let touches = is_on && next.start <= known.end;
        if touches && known.end < next.end {
            known.end = next.end;
        }
        touches
    });
    joined
}

/// A wall that reaches so far beyond a face on every side.
fn around(thin_wall: &Plane, by: f64) -> [Plane; 4] {
    let across = [thin_wall.offset - by, thin_wall.offset + by];
    let along = [thin_wall.start - by, thin_wall.end + by];
    let [x, y] = if thin_wall.facing.axis() == 0 { [across, along] } else { [along, across] };
    let plane = |facing, offset, [start, end]: [f64; 2]| Plane { facing, offset, start, end };
    [
        plane(Facing::MinusX, x[0], y),
        plane(Facing::PlusX, x[1], y),
        plane(Facing::MinusY, y[0], x),
        plane(Facing::PlusY, y[1], x),
    ]
}

impl Draft {
    fn new(raw: &[Plane], tolerance: f64, repeats: Repeats) -> Result<Self, PlanError> {
        let coordinates = [0, 1].map(|axis| {
            let mut values = Vec::with_capacity(2 * raw.len());
            for plane in raw {
                match plane.facing.axis() == axis {
                    true => values.push(plane.offset),
                    false => values.extend([plane.start, plane.end]),
                }
            }
            Coordinates::new(values, tolerance)
        });
        let edges = edges(raw, &coordinates, repeats);
        let used = used_coordinates(&edges, &coordinates);
        let [xs, ys] = [0, 1].map(|axis| {
            let of_axis: &Coordinates = &coordinates[axis];
            let kept = of_axis.values.iter().zip(&used[axis]).filter(|(_, new)| new.is_some());
            kept.map(|(value, _)| *value).collect::<Vec<_>>()
        });
        let (n_x, n_y) = (xs.len(), ys.len());
        if n_x.checked_mul(n_y).is_none_or(|cells| MAX_CELLS < cells) {
            return Err(PlanError::TooFine { n_x, n_y, max: MAX_CELLS });
        }
        if n_x < 2 || n_y < 2 {
            return Err(PlanError::Nothing);
        }
        let votes = [0, 1].map(|axis| {
            let n_cells = [n_x - 1, n_y - 1];
            votes(&edges, &used, axis, n_cells[axis], n_cells[1 - axis])
        });
        Ok(Self::from_votes([xs, ys], &votes, edges, used))
    }

    /// `votes[0][j * n_x + i]` and `votes[1][i * n_y + j]` say how often cell (i, j) counted as solid, 0 to 2 times each.
    fn from_votes(
        [xs, ys]: [Vec<f64>; 2],
        votes: &[Vec<u8>; 2],
        edges: Vec<Edge>,
        used: [Vec<Option<usize>>; 2],
    ) -> Self {
        let (n_x, n_y) = (xs.len() - 1, ys.len() - 1);
        let (mut solid, mut endless) = (vec![false; n_x * n_y], Vec::new());
        let (mut doubtful_area, mut tied_area, mut endless_area, mut first_tie) = (0.0, 0.0, 0.0, None);
        for j in 0..n_y {
            for i in 0..n_x {
                let [along_x, along_y] = [votes[0][j * n_x + i], votes[1][i * n_y + j]];
                let n_solid = along_x + along_y;
                solid[j * n_x + i] = 3 <= n_solid;
                let area = || (xs[i + 1] - xs[i]) * (ys[j + 1] - ys[j]);
                if !matches!(n_solid, 0 | 4) {
                    doubtful_area += area();
                }
                if n_solid == 2 {
                    tied_area += area();
                    endless_area += if along_x == along_y { 0.0 } else { area() };
                    endless.extend((along_x != along_y).then_some(j * n_x + i));
                    first_tie = first_tie.or(Some([xs[i], ys[j]]));
                }
            }
        }
        let area = (xs[n_x] - xs[0]) * (ys[n_y] - ys[0]);
        let plan = Occupancy {
            xs,
            ys,
            solid,
            doubtful_fraction: doubtful_area / area,
            inverted: false,
            merged_within: None,
            thickened_to: None,
        };
        let tied_percent = 100.0 * tied_area / area;
        let endless_part = if 0.0 < tied_area { endless_area / tied_area } else { 0.0 };
        Self { plan, edges, used, tied_percent, first_tie, endless_part, endless }
    }

    /// Why this is no plan.
    fn fault(&self) -> Option<PlanError> {
        if let Some([x, y]) = self.first_tie.filter(|_| MAX_TIED_PERCENT < self.tied_percent) {
            return Some(PlanError::Open { percent: self.tied_percent, x, y });
        }
        let (percent, first, _) = self.thin_walls();
        let [x, y] = first.filter(|_| MAX_SHEET_PERCENT < percent)?;
        Some(PlanError::ThinWalls { percent, x, y })
    }

    /// The plan of walls whose ends are missing: solid between two sides.
    fn with_ends(mut self) -> Result<Occupancy, PlanError> {
        for cell in std::mem::take(&mut self.endless) {
            self.plan.solid[cell] = true;
        }
        self.first_tie = None;
        match self.fault() {
            None => Ok(self.finish()),
            Some(fault) => Err(fault),
        }
    }

    /// The plan with the few faces without thickness that stand in it, where that makes a maze.
    fn with_sheets(self, raw: &[Plane], size: f64, max_cells: usize) -> Occupancy {
        let mut thin_walls = self.thin_walls().2;
        let plain = self.finish();
        let [_, narrow] = plain.thin_and_narrow();
        let least = SHEET_OF_CORRIDOR * narrow.unwrap_or(0.0);
        thin_walls.retain(|thin_wall| least < thin_wall.end - thin_wall.start);
        if thin_walls.is_empty() || MAX_PAIRS < raw.len().saturating_mul(thin_walls.len()) {
            return plain;
        }
        // The faces themselves would count for winding.
        let within = size * NOISE_FRACTION;
        let is_sheet = |face: &&Plane| {
            let lies_on = |thin_wall: &Plane| {
                thin_wall.facing.axis() == face.facing.axis()
                    && (thin_wall.offset - face.offset).abs() <= within
                    && thin_wall.start - within <= face.start
                    && face.end <= thin_wall.end + within
            };
            thin_walls.iter().any(lies_on)
        };
        let solid: Vec<Plane> = raw.iter().filter(|face| !is_sheet(face)).copied().collect();
        match thickened(&solid, &thin_walls, size, max_cells) {
            Ok(Some(plan)) => plan,
            _ => plain,
        }
    }

    fn finish(mut self) -> Occupancy {
        self.plan.inverted = self.enters_more_than_leaves() < 0;
        if let [_, Some(narrow)] = self.plan.thin_and_narrow() {
            self.plan.fill_rim(RIM_OF_CORRIDOR * narrow);
        }
        self.plan
    }

    fn runs(&self) -> impl Iterator<Item = FaceRun> {
        [0, 1].into_iter().flat_map(|axis| runs(&self.edges, &self.used, axis))
    }

    /// Wall faces with free space on both sides, both sides at one place or one side alone: their percentage of all, where
    /// the first one is, and all of them.
    fn thin_walls(&self) -> (f64, Option<[f64; 2]>, Vec<Plane>) {
        let plan = &self.plan;
        let (mut length, mut thin_length, mut first) = (0.0, 0.0, None);
        let mut thin_walls: Vec<Plane> = Vec::new();
        for run in self.runs() {
            let (offsets, alongs) = if run.axis == 0 { (&plan.xs, &plan.ys) } else { (&plan.ys, &plan.xs) };
            for across in run.across {
                let extent = alongs[across + 1] - alongs[across];
                length += extent;
                // The frame is no wall here: beyond it all is free.
                let is_free = |step: usize| !plan.at_step(run.axis, step, across).unwrap_or(false);
                if is_free(run.step) && is_free(run.step + 1) {
                    thin_length += extent;
                    let (i, j) = if run.axis == 0 { (run.step, across) } else { (across, run.step) };
                    first = first.or(Some([plan.xs[i], plan.ys[j]]));
                    let facing = if run.axis == 0 { Facing::PlusX } else { Facing::PlusY };
                    let (start, end) = (alongs[across], alongs[across + 1]);
                    let thin_wall = Plane { facing, offset: offsets[run.step], start, end };
                    match thin_walls.last_mut() {
                        Some(Plane { facing, offset, end, .. })
                            if (*facing, *offset, *end)
                                == (thin_wall.facing, thin_wall.offset, thin_wall.start) =>
                        {
                            *end = thin_wall.end;
                        }
                        _ => thin_walls.push(thin_wall),
                    }
                }
            }
        }
        (100.0 * thin_length / length, first, thin_walls)
    }

    /// On how many pieces of face, walked upwards from free into solid, a wall is entered as it should be, less those on
    /// which it is left.
    fn enters_more_than_leaves(&self) -> i64 {
        let of_run = |run: FaceRun| {
            let is_solid = move |step, across| self.plan.at_step(run.axis, step, across).unwrap_or(false);
            let into_solid =
                move |across: &usize| !is_solid(run.step, *across) && is_solid(run.step + 1, *across);
            i64::from(run.change.signum()) * run.across.filter(into_solid).map(|_| 1).sum::<i64>()
        };
        self.runs().map(of_run).sum()
    }

    /// Fraction of the faces' ends at which the outline does not go on: nearly 0 for walls with two sides, nearly 1 for walls
    /// that are single faces.
    fn loose_part(&self) -> f64 {
        // Going round with the wall on the left, a face leaves one point and comes to another.
        let mut ends: Vec<(u32, u32, i32)> = Vec::with_capacity(self.edges.len());
        for edge in &self.edges {
            let ([x, y], turn) = edge.point_and_turn();
            ends.push((x, y, turn));
        }
        ends.sort_unstable();
        let points = ends.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1));
        let open_edges: i32 = points.map(|point| point.iter().map(|end| end.2).sum::<i32>().abs()).sum();
        let all: i32 = ends.iter().map(|end| end.2.abs()).sum();
        if all == 0 { 0.0 } else { f64::from(open_edges) / f64::from(all) }
    }
}
