//! Wall faces summed up along lines: where they start and end, and how often a wall is entered and left.

use crate::physics::wall::{Facing, Plane};

/// Sorted coordinates in which near ones are one.
pub(crate) struct Coordinates {
    pub(crate) values: Vec<f64>, // one of each cluster
    tolerance: f64,
}

impl Coordinates {
    pub(crate) fn new(mut all: Vec<f64>, tolerance: f64) -> Self {
        all.sort_by(f64::total_cmp);
        let mut values: Vec<f64> = Vec::new();
        let mut first = 0;
        for index in 1..=all.len() {
            if index == all.len() || tolerance < all[index] - all[first] {
                // The middle one of the cluster is a coordinate that the file really has.
                values.push(all[(first + index - 1) / 2]);
                first = index;
            }
        }
        Self { values, tolerance }
    }

    /// Fewer than 2^32: a file holds no more corners.
    #[allow(clippy::cast_possible_truncation, reason = "see above")]
    fn index_of(&self, value: f64) -> u32 {
        let above = self.values.partition_point(|known| *known < value - self.tolerance);
        let is_nearer = |index: usize| {
            let distance = |index: usize| (self.values[index] - value).abs();
            index + 1 < self.values.len() && distance(index + 1) < distance(index)
        };
        let index = if is_nearer(above) { above + 1 } else { above.min(self.values.len() - 1) };
        index as u32
    }
}

/// A change of the winding number along a row of equal offset: +1 where a face starts, -1 where it ends.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Edge {
    facing: Facing,
    offset: u32,
    along: u32,
    change: i32,
}

impl Edge {
    /// The point in the plan, and how many outlines, walls on their left, come to it less those that leave it.
    pub(crate) fn point_and_turn(&self) -> ([u32; 2], i32) {
        // A wall face with normal +x is passed upwards, one with normal +y to the left.
        let ends_there = match self.facing {
            Facing::PlusX | Facing::MinusY => -self.change,
            Facing::MinusX | Facing::PlusY => self.change,
        };
        let point =
            if self.facing.axis() == 0 { [self.offset, self.along] } else { [self.along, self.offset] };
        (point, ends_there)
    }
}

/// What a face counts for that is there several times.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Repeats {
    /// Each time: walls that overlap have such faces, one for each wall.
    Count,
    /// Once: a file may hold some faces twice for no reason.
    Once,
    /// Of two that face opposite ways at one place the first one: a file may hold every face with its back.
    Fronts,
}

/// Starts and ends of all faces; a start and an end of the same row that meet cancel, so pieces become one.
pub(crate) fn edges(raw: &[Plane], coordinates: &[Coordinates; 2], repeats: Repeats) -> Vec<Edge> {
    let ends_of = |plane: &Plane| {
        let axis = plane.facing.axis();
        let offset = coordinates[axis].index_of(plane.offset);
        [(plane.start, 1), (plane.end, -1)].map(|(along, change)| Edge {
            facing: plane.facing,
            offset,
            along: coordinates[1 - axis].index_of(along),
            change,
        })
    };
    let mut ends: Vec<Edge> = match repeats {
        Repeats::Count => raw.iter().flat_map(ends_of).collect(),
        Repeats::Once => {
            let mut faces: Vec<[Edge; 2]> = raw.iter().map(ends_of).collect();
            faces.sort_unstable();
            faces.dedup();
            faces.into_flattened()
        }
        Repeats::Fronts => fronts(raw.iter().map(ends_of).collect()).into_flattened(),
    };
    ends.sort_unstable();
    let same_place = |a: &Edge, b: &Edge| (a.facing, a.offset, a.along) == (b.facing, b.offset, b.along);
    let summed = ends
        .chunk_by(same_place)
        .map(|place| Edge { change: place.iter().map(|edge| edge.change).sum(), ..place[0] });
    summed.filter(|edge| edge.change != 0).collect()
}

/// The faces without those that are the back of one before them.
fn fronts(faces: Vec<[Edge; 2]>) -> Vec<[Edge; 2]> {
    let place = |[start, end]: &[Edge; 2]| (start.facing.axis(), start.offset, start.along, end.along);
    let mut order: Vec<usize> = (0..faces.len()).collect();
    // Stable: faces of one place stay in the order of the file.
    order.sort_by_key(|face| place(&faces[*face]));
    let mut fronts = Vec::with_capacity(faces.len());
    for same in order.chunk_by(|a, b| place(&faces[*a]) == place(&faces[*b])) {
        let mut unpaired = [0_usize; 2]; // faces kept so far without a back, by the way they face
        for face in same.iter().map(|face| faces[*face]) {
            let side = usize::from(0.0 < face[0].facing.sign());
            match unpaired[1 - side] {
                0 => {
                    unpaired[side] += 1;
                    fronts.push(face);
                }
                _ => unpaired[1 - side] -= 1,
            }
        }
    }
    fronts
}

/// For each axis, the new index of every coordinate that an edge uses.
pub(crate) fn used_coordinates(edges: &[Edge], coordinates: &[Coordinates; 2]) -> [Vec<Option<usize>>; 2] {
    let mut used = [0, 1].map(|axis: usize| vec![None; coordinates[axis].values.len()]);
    for edge in edges {
        let axis = edge.facing.axis();
        used[axis][edge.offset as usize] = Some(0);
        used[1 - axis][edge.along as usize] = Some(0);
    }
    for of_axis in &mut used {
        for (new, slot) in of_axis.iter_mut().filter(|slot| slot.is_some()).enumerate() {
            *slot = Some(new);
        }
    }
    used
}

/// A stretch of wall faces in one row.
pub(crate) struct FaceRun {
    pub(crate) axis: usize,
    /// Index of the coordinate across which they stand.
    pub(crate) step: usize,
    /// The cells along which.
    pub(crate) across: std::ops::Range<usize>,
    /// How many walls are entered there on the way up, less those left.
    pub(crate) change: i32,
}

/// All stretches of faces across an axis; where faces of a facing overlap they count together.
pub(crate) fn runs(
    edges: &[Edge],
    used: &[Vec<Option<usize>>; 2],
    axis: usize,
) -> impl Iterator<Item = FaceRun> {
    let same_row = |a: &Edge, b: &Edge| (a.facing, a.offset) == (b.facing, b.offset);
    edges.chunk_by(same_row).filter(move |row| row[0].facing.axis() == axis).flat_map(move |row| {
        let enters = if row[0].facing.sign() < 0.0 { 1 } else { -1 };
        let depths = row.iter().scan(0, |depth, edge| {
            *depth += edge.change;
            Some(*depth)
        });
        row.windows(2).zip(depths).filter_map(move |(pair, depth)| {
            let index = |along: u32| used[1 - axis][along as usize];
            let across = index(pair[0].along)?..index(pair[1].along)?;
            let step = used[axis][pair[0].offset as usize]?;
            (depth != 0).then_some(FaceRun { axis, step, across, change: enters * depth })
        })
    })
}

/// How often each cell counts as solid by the faces across `axis`, coming from the low side and coming from the high side:
/// `[across * n_steps + step]`, 0 to 2. The two differ only on a line where a face is missing or extra.
pub(crate) fn votes(
    edges: &[Edge],
    used: &[Vec<Option<usize>>; 2],
    axis: usize,
    n_steps: usize,
    n_across: usize,
) -> Vec<u8> {
    // Change of the winding number at each coordinate, `n_steps + 1` of them a line.
    let mut changes = vec![0; (n_steps + 1) * n_across];
    for run in runs(edges, used, axis) {
        for across in run.across {
            changes[across * (n_steps + 1) + run.step] += run.change;
        }
    }
    let mut votes = Vec::with_capacity(n_steps * n_across);
    for line in changes.chunks(n_steps + 1) {
        let total: i32 = line.iter().sum();
        let mut from_low = 0;
        votes.extend(line[..n_steps].iter().map(|change| {
            from_low += change;
            u8::from(from_low != 0) + u8::from(from_low != total)
        }));
    }
    votes
}
