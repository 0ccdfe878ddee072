//! What the faces of a mesh are: floor, walls, tops, and what fits no maze of axis-aligned walls.

use crate::assembly::error::{AssembleError, MAX_OFF_AXIS_FRACTION, Misfit, SIZES};
use crate::assembly::polygons::{PolygonMesh, UpAxis, doubled_area};
use crate::assembly::slice::{self, COS_SNAP, FaceKind, SIN_SNAP};
use crate::maze::{FaceNote, FaceReason};
use crate::physics::numbers::{greater, lesser};
use crate::physics::wall::Plane;
use nalgebra::{Vector2, Vector3};

/// Where between floor and wall tops the walls are cut: below the middle, where many files have a seam.
const CUT_FRACTION: f64 = 0.47;

/// A ball climbs what is lower than this fraction of its radius: at the game's steepest tilt of 20 degrees 0.06, some more with
/// speed.
const CLIMBED_FRACTION: f64 = 0.2;

/// What rises less than this fraction of the wall height above the floor is not noted.
const SEEN_FRACTION: f64 = 0.01;

/// Upward faces nearer to the floor than this fraction of the wall height are floor, the others are tops of walls.
const FLOOR_FRACTION: f64 = 0.25;

/// Fraction of the plan's rectangle that upward faces at one height must cover to be a floor: corridors alone cover twice as much
/// and more, the tops of low blocks and pillars less.
const FLOOR_SHARE: f64 = 0.2;

/// Sine of the smallest angle (0.2 degrees) by which a whole maze is turned back: careless placing of each wall leaves as
/// much, and no wall of thirty corridors moves by more than a twentieth of one.
const SIN_TURN: f64 = 3.5e-3;

/// Sine of the angle from which on a wall counts as snapped: what six decimals in a file leave stays far below it.
const SIN_SNAPPED: f64 = 2.0e-4;

/// From the file's frame to one whose z is up and whose x and y run along the walls. A rotation: nothing is mirrored.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turn {
    up_axis: UpAxis,
    /// The walls' own x axis across the up axis; unit length.
    pub(crate) walls_x: Vector2<f64>,
}

impl Turn {
    fn upright(up_axis: UpAxis) -> Self {
        Self { up_axis, walls_x: Vector2::new(1.0, 0.0) }
    }

    fn apply(&self, point: Vector3<f64>) -> Vector3<f64> {
        let p = self.up_axis.turned_to_z(point);
        let x = self.walls_x;
        // Without a turn the coordinates keep their bits.
        if x.y == 0.0 { p } else { Vector3::new(x.x * p.x + x.y * p.y, x.x * p.y - x.y * p.x, p.z) }
    }
}

/// What the faces of a mesh are; everything in file units, turned by `turn`.
pub(crate) struct Survey<'a> {
    mesh: &'a PolygonMesh,
    pub(crate) turn: Turn,
    reversed: bool,
    kinds: Vec<FaceKind>,
    pub(crate) floor_z: f64,
    pub(crate) top_z: f64,
    pub(crate) has_floor: bool,
    /// Of all faces.
    pub(crate) area: f64,
    pub(crate) ignored: Vec<FaceNote>,
    pub(crate) adjusted: Vec<FaceNote>,
}

impl<'a> Survey<'a> {
    /// `reversed` takes every face for its other side.
    pub(crate) fn new(mesh: &'a PolygonMesh, up_axis: UpAxis, reversed: bool) -> Result<Self, AssembleError> {
        let size = extent(mesh.positions()).amax();
        if size != 0.0 && !SIZES.contains(&size) {
            return Err(AssembleError::Size { size });
        }
        if mesh.n_faces() == 0 {
            return Err(AssembleError::NoFaces);
        }
        let mut survey = Self {
            mesh,
            turn: Turn::upright(up_axis),
            reversed,
            kinds: Vec::new(),
            floor_z: 0.0,
            top_z: 0.0,
            has_floor: false,
            area: 0.0,
            ignored: Vec::new(),
            adjusted: Vec::new(),
        };
        if let Some(walls_x) = survey.common_direction() {
            survey.turn.walls_x = walls_x;
        }
        survey.classify(size)?;
        Ok(survey)
    }

    /// Every face's index and corners, turned, in order.
    fn each_face(&self, mut see: impl FnMut(usize, &[Vector3<f64>])) {
        let mut corners = Vec::new();
        for (index, face) in self.mesh.faces().enumerate() {
            let turned = face.iter().map(|&corner| self.turn.apply(self.mesh.positions()[corner as usize]));
            corners.clear();
            corners.extend(turned);
            if self.reversed {
                corners.reverse();
            }
            see(index, &corners);
        }
    }

    /// Every face's index, kind and corners.
    pub(crate) fn each(&self, mut see: impl FnMut(usize, FaceKind, &[Vector3<f64>])) {
        self.each_face(|face, corners| {
            if let Some(kind) = self.kinds.get(face) {
                see(face, *kind, corners);
            }
        });
    }

    /// Where the walls' x axis points when nearly all upright area is turned by one angle from the file's axes.
    ///
    /// Directions at right angles agree in the fourth power of the normal taken as a complex number; its mean is the
    /// fourth power of the answer, and two complex square roots give that.
    fn common_direction(&self) -> Option<Vector2<f64>> {
        let mut sum = Vector2::zeros();
        let mut total = 0.0;
        let upright = |corners: &[Vector3<f64>]| {
            let doubled = doubled_area(corners);
            let flat = doubled.xy().norm();
            // A face without area, or one whose area is not finite, has no direction.
            let is_upright = doubled.z.abs() <= SIN_SNAP * flat && 0.0 < flat && flat.is_finite();
            is_upright.then(|| (doubled.xy() / flat, flat))
        };
        self.each_face(|_, corners| {
            if let Some((normal, area)) = upright(corners) {
                sum += area * squared(squared(normal));
                total += area;
            }
        });
        let mean = sum.try_normalize(0.0)?;
        let direction = root(root(mean));
        if direction.y.abs() <= SIN_TURN {
            return None;
        }
        let mut fits = 0.0;
        self.each_face(|_, corners| {
            if let Some((normal, area)) = upright(corners) {
                let across = direction.perp(&normal).abs();
                let along = direction.dot(&normal).abs();
                fits += if across <= SIN_SNAP || along <= SIN_SNAP { area } else { 0.0 };
            }
        });
        ((1.0 - MAX_OFF_AXIS_FRACTION) * total <= fits).then_some(direction)
    }

    fn classify(&mut self, size: f64) -> Result<(), AssembleError> {
        let mut kinds = Vec::with_capacity(self.mesh.n_faces());
        let mut areas = Areas::default();
        let mut levels = Levels::with_room_for(self.mesh.n_faces());
        let [mut low, mut high] = [f64::INFINITY, f64::NEG_INFINITY].map(|value| Vector2::new(value, value));
        self.each_face(|face, corners| {
            let (kind, area, normal) = slice::classify(corners, size);
            areas.add(face, kind, area, normal);
            levels.add(kind, area, corners);
            if matches!(kind, FaceKind::Wall(_)) {
                for corner in corners {
                    (low, high) = (low.inf(&corner.xy()), high.sup(&corner.xy()));
                }
            }
            kinds.push(kind);
        });
        let refused = areas.refuse();
        let plan = high - low;
        (self.floor_z, self.top_z, self.has_floor) = levels.floor_and_top(FLOOR_SHARE * plan.x * plan.y);
        if let Err(error) = refused {
            // What lies above or below the height at which the walls are cut is never met, and makes no maze of it, nor spoils one.
            areas = self.areas_at(self.cut_height(), &kinds, size);
            areas.refuse().map_err(|_| error)?;
        }
        (self.ignored, self.adjusted) = areas.notes();
        self.area = areas.all.area;
        self.kinds = kinds;
        Ok(())
    }

    /// The areas of the faces that cross a height; those off axis that do not are counted as beyond it.
    fn areas_at(&self, height: f64, kinds: &[FaceKind], size: f64) -> Areas {
        let mut areas = Areas::default();
        self.each_face(|face, corners| {
            let Some(kind) = kinds.get(face) else { return };
            let (_, area, normal) = slice::classify(corners, size);
            let is_below = |corner: &Vector3<f64>| corner.z < height;
            let crosses = corners.iter().any(is_below) && !corners.iter().all(is_below);
            match kind {
                FaceKind::OffAxis if !crosses => areas.beyond(face, area),
                _ => areas.add(face, *kind, area, normal),
            }
        });
        areas
    }

    /// The height at which the walls are cut.
    fn cut_height(&self) -> f64 {
        self.floor_z + CUT_FRACTION * (self.top_z - self.floor_z)
    }

    /// The walls as planes at one height.
    pub(crate) fn cut_walls(&self) -> Result<Vec<Plane>, AssembleError> {
        let height = self.cut_height();
        let is_cut = |kind: &&FaceKind| matches!(kind, FaceKind::Wall(_) | FaceKind::OffAxis);
        let mut cut = Vec::with_capacity(self.kinds.iter().filter(is_cut).count());
        self.each(|_, kind, corners| {
            if matches!(kind, FaceKind::Wall(_) | FaceKind::OffAxis) {
                slice::cut(corners, height, &mut cut);
            }
        });
        let above_floor = height - self.floor_z;
        if cut.is_empty() { Err(AssembleError::NothingCut { height: above_floor }) } else { Ok(cut) }
    }

    /// The walls that end below the height at which the others are cut, as planes at a height that a ball of this radius (file
    /// units) cannot climb, and those that are lower still.
    pub(crate) fn low_walls(&self, radius: f64) -> LowWalls {
        let (cut_height, low_height) = (self.cut_height(), self.floor_z + CLIMBED_FRACTION * radius);
        let seen_from = self.seen_from();
        let mut low = LowWalls::default();
        self.each(|face, kind, corners| {
            if !matches!(kind, FaceKind::Wall(_) | FaceKind::OffAxis) {
                return;
            }
            let top = corners.iter().map(|corner| corner.z).fold(f64::NEG_INFINITY, greater);
            let area = doubled_area(corners).norm() / 2.0;
            if low_height < top && top < cut_height {
                low.walls.add(face, area);
                slice::cut(corners, low_height, &mut low.planes);
            } else if seen_from < top && top < cut_height {
                low.climbed.add(face, area);
            }
        });
        low
    }

    /// What rises above this is more than the floor's unevenness.
    pub(crate) fn seen_from(&self) -> f64 {
        self.floor_z + SEEN_FRACTION * (self.top_z - self.floor_z)
    }

    /// Notes walls that are drawn and not met.
    pub(crate) fn note_unmet(&mut self, walls: Tally, reason: FaceReason) {
        let note = walls.note(reason, self.area);
        self.ignored.extend(note.map(|note| FaceNote { is_unmet: true, ..note }));
    }

    /// How many corners there are to draw, and how much work it is to cut them into triangles, in squared corners.
    pub(crate) fn drawing_costs(&self) -> (usize, usize) {
        let drawn = self
            .mesh
            .faces()
            .zip(&self.kinds)
            .filter(|(_, kind)| !matches!(kind, FaceKind::Down | FaceKind::Degenerate));
        drawn.fold((0, 0_usize), |(n_corners, cutting), (face, _)| {
            (n_corners + face.len(), cutting.saturating_add(face.len() * face.len()))
        })
    }

    /// Above this an upward face is the top of a wall.
    pub(crate) fn tops_from(&self) -> f64 {
        self.floor_z + FLOOR_FRACTION * (self.top_z - self.floor_z)
    }
}

/// A unit complex number times itself.
fn squared(z: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(z.x * z.x - z.y * z.y, 2.0 * z.x * z.y)
}

/// The root with the smaller turn of a unit complex number: half the angle, -90 to 90 degrees.
fn root(z: Vector2<f64>) -> Vector2<f64> {
    // Rounding can leave the number a little outside the circle.
    let half = |square: f64| if 0.0 < square { (square / 2.0).sqrt() } else { 0.0 };
    let (x, y) = (half(1.0 + z.x), half(1.0 - z.x));
    Vector2::new(x, if z.y < 0.0 { -y } else { y })
}

/// Size of the bounding box; 0 for nothing.
pub(crate) fn extent(positions: &[Vector3<f64>]) -> Vector3<f64> {
    let low = positions.iter().copied().reduce(|a, b| a.inf(&b)).unwrap_or_default();
    let high = positions.iter().copied().reduce(|a, b| a.sup(&b)).unwrap_or_default();
    high - low
}

/// Walls that end below the height at which the others are cut.
#[derive(Default)]
pub(crate) struct LowWalls {
    /// Cut near the floor.
    pub(crate) planes: Vec<Plane>,
    /// Those that are cut.
    pub(crate) walls: Tally,
    /// Those that end below that too: the ball climbs them.
    pub(crate) climbed: Tally,
}

/// Number and area of some faces.
#[derive(Clone, Copy, Default)]
pub(crate) struct Tally {
    n_faces: usize,
    first_face: usize,
    area: f64,
}

impl Tally {
    pub(crate) fn add(&mut self, face: usize, area: f64) {
        if self.n_faces == 0 {
            self.first_face = face;
        }
        self.n_faces += 1;
        self.area += area;
    }

    pub(crate) fn note(self, reason: FaceReason, total: f64) -> Option<FaceNote> {
        let Self { n_faces, first_face, .. } = self;
        let area_fraction = if 0.0 < total { self.area / total } else { 0.0 };
        (0 < n_faces).then_some(FaceNote { reason, n_faces, first_face, area_fraction, is_unmet: false })
    }
}

/// Areas of a mesh by what the faces are.
#[derive(Default)]
struct Areas {
    all: Tally,
    walls: Tally,
    snapped: Tally,
    down: Tally,
    degenerate: Tally,
    off_axis: Tally,
    beyond: Tally,
    /// Of the off-axis ones: not upright, and of these those along an axis all the same.
    leaning: f64,
    leaning_on_axis: f64,
}

impl Areas {
    fn add(&mut self, face: usize, kind: FaceKind, area: f64, normal: Vector3<f64>) {
        self.all.add(face, area);
        match kind {
            FaceKind::Wall(facing) => {
                self.walls.add(face, area);
                let (across, up) = (normal[1 - facing.axis()], normal.z);
                if SIN_SNAPPED * SIN_SNAPPED < across * across + up * up {
                    self.snapped.add(face, area);
                }
            }
            FaceKind::Up => {}
            FaceKind::Down => self.down.add(face, area),
            FaceKind::Degenerate => self.degenerate.add(face, area),
            FaceKind::OffAxis => {
                self.off_axis.add(face, area);
                let flat = normal.xy();
                if SIN_SNAP < normal.z.abs() {
                    self.leaning += area;
                    if COS_SNAP * flat.norm() <= flat.amax() {
                        self.leaning_on_axis += area;
                    }
                }
            }
        }
    }

    /// Counts a face off axis that does not reach the height at which the walls are cut.
    fn beyond(&mut self, face: usize, area: f64) {
        self.all.add(face, area);
        self.beyond.add(face, area);
    }

    /// Refuses what is no maze of axis-aligned walls, by what most of it is.
    fn refuse(&self) -> Result<(), AssembleError> {
        let (walls, off_axis) = (self.walls.area, self.off_axis.area);
        if MAX_OFF_AXIS_FRACTION * (walls + off_axis) < off_axis {
            let kind = match self.leaning < off_axis / 2.0 {
                true => Misfit::Slanted,
                false if self.leaning < 1.5 * self.leaning_on_axis => Misfit::Leaning,
                false => Misfit::Curved,
            };
            let percent = 100.0 * off_axis / (walls + off_axis);
            return Err(AssembleError::OffAxis {
                kind,
                percent,
                percent_of_all: 100.0 * off_axis / self.all.area,
            });
        }
        if walls <= 0.0 {
            return Err(AssembleError::NoWalls { n_faces: self.all.n_faces });
        }
        Ok(())
    }

    /// What is ignored and what is adjusted.
    fn notes(&self) -> (Vec<FaceNote>, Vec<FaceNote>) {
        let total = self.all.area;
        let ignored = [
            self.down.note(FaceReason::LooksDown, total),
            self.degenerate.note(FaceReason::NoArea, total),
            self.beyond.note(FaceReason::OffAxisBeyondCut, total),
        ];
        let adjusted = [
            self.snapped.note(FaceReason::SnappedToAxis, total),
            self.off_axis.note(FaceReason::SteppedAlongAxes, total),
        ];
        (ignored.into_iter().flatten().collect(), adjusted.into_iter().flatten().collect())
    }
}

/// Heights of walls and upward faces.
struct Levels {
    walls: Vec<[f64; 3]>,    // lower end, upper end, area
    upward: Vec<(f64, f64)>, // z, area
}

/// A tower, or a shaft, of less than this fraction of the walls' area does not say how high they are where it is more than twice
/// as high.
const OUTLIER_FRACTION: f64 = 0.1;
/// How many sizes of tower are tried.
const MAX_OUTLIERS: usize = 32;

impl Levels {
    /// Room that is not used is not touched.
    fn with_room_for(n_faces: usize) -> Self {
        Self { walls: Vec::with_capacity(n_faces), upward: Vec::with_capacity(n_faces) }
    }

    fn add(&mut self, kind: FaceKind, area: f64, corners: &[Vector3<f64>]) {
        let heights = corners.iter().map(|corner| corner.z);
        match kind {
            FaceKind::Wall(_) => {
                let low = heights.clone().reduce(lesser);
                let high = heights.reduce(greater);
                self.walls.extend(low.zip(high).map(|(low, high)| [low, high, area]));
            }
            #[allow(clippy::cast_precision_loss, reason = "a polygon has far fewer than 2^53 corners")]
            FaceKind::Up => self.upward.push((heights.sum::<f64>() / corners.len() as f64, area)),
            _ => {}
        }
    }

    /// The walls' lower and upper end, without the few that reach far beyond the others.
    fn walls_low_and_high(&self) -> [f64; 2] {
        let lowest = |from: f64| {
            let lows = self.walls.iter().map(|wall| wall[0]).filter(|low| from <= *low);
            lows.fold(f64::INFINITY, lesser)
        };
        let highest = |to: f64| {
            let highs = self.walls.iter().map(|wall| wall[1]).filter(|high| *high <= to);
            highs.fold(f64::NEG_INFINITY, greater)
        };
        let area = |of: &dyn Fn(&[f64; 3]) -> bool| {
            self.walls.iter().filter(|wall| of(wall)).map(|[_, _, area]| area).sum::<f64>()
        };
        let few = OUTLIER_FRACTION * area(&|_| true);
        let (mut low, mut high) = (lowest(f64::NEG_INFINITY), highest(f64::INFINITY));
        for _ in 0..MAX_OUTLIERS {
            let middle = (low + high) / 2.0;
            if area(&|wall| middle < wall[1]) < few {
                high = highest(middle);
            } else if area(&|wall| wall[0] < middle) < few {
                low = lowest(middle);
            } else {
                break;
            }
        }
        [low, high]
    }

    /// How long the walls are, seen from above, that stand between two heights.
    fn length_between(&self, from: f64, to: f64) -> f64 {
        let within = |[low, high, area]: &[f64; 3]| {
            let (low_in, high_in) = (greater(*low, from), lesser(*high, to));
            if low_in < high_in { area * (high_in - low_in) / (high - low) } else { 0.0 }
        };
        self.walls.iter().map(within).sum::<f64>() / (to - from)
    }

    /// Height of the floor, of the wall tops, and whether there is a floor at all.
    ///
    /// The floor is the largest upward level from the walls' lower end to four fifths of their height, or above that if more
    /// wall stands on it than under it: the floor of a thick board. It has at least this area. Else it is their lower end, without
    /// the few that reach below the others.
    fn floor_and_top(mut self, least_area: f64) -> (f64, f64, bool) {
        let [low, high] = self.walls_low_and_high();
        let near = 1.0e-3 * (high - low);
        self.upward.sort_by(|a, b| a.0.total_cmp(&b.0));
        let is_floor = |z: f64| {
            let is_high = high - 0.2 * (high - low) <= z;
            low - near <= z
                && z < high - near
                && (!is_high || self.length_between(low, z) < self.length_between(z, high))
        };
        let floor = self
            .upward
            .chunk_by(|a, b| b.0 - a.0 <= near)
            .map(|level| (level[level.len() / 2].0, level.iter().map(|(_, area)| area).sum::<f64>()))
            .filter(|(z, area)| is_floor(*z) && least_area <= *area)
            .max_by(|a, b| a.1.total_cmp(&b.1));
        match floor {
            Some((z, _)) => (z, high, true),
            None => (self.common_low(low, near), high, false),
        }
    }

    /// The lowest height on which a wall stands, without those few that are sunk below it.
    fn common_low(&mut self, lowest: f64, near: f64) -> f64 {
        self.walls.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let mut sunk = 0.0;
        let few = OUTLIER_FRACTION * self.walls.iter().map(|[_, _, area]| area).sum::<f64>();
        for level in self.walls.chunk_by(|a, b| b[0] - a[0] <= near) {
            sunk += level.iter().map(|[_, _, area]| area).sum::<f64>();
            if few <= sunk {
                return greater(level[0][0], lowest);
            }
        }
        lowest
    }
}
