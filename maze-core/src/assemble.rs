//! Polygons -> Maze: one way for files and for generated mazes.

use crate::ball::{BallSpec, Radius};
use crate::frame::Frame;
use crate::maze::{Bounds, Ignored, Maze};
use crate::plane::{Plane, PlaneError};
use crate::polygons::{PolygonMesh, UpAxis};
use crate::reach::{Distances, Reach};
use crate::section::{Section, SectionError};
use crate::slice::{self, FaceKind};
use crate::sorted_planes::SortedPlanes;
use crate::surface::{Surface, SurfaceBuilder, SurfaceMesh};
use nalgebra::{Vector2, Vector3};
use std::ops::RangeInclusive;
use std::sync::Arc;

/// Where between floor and wall tops the walls are cut: below the middle, where many files have a seam.
const CUT_PART: f64 = 0.47;

/// Share of the upright area that may be off axis (and is then ignored) before the file is no maze of axis-aligned walls.
const MAX_OFF_AXIS_PART: f64 = 0.05;

/// Upward faces nearer to the floor than this part of the wall height are floor, the others are tops of walls.
const FLOOR_PART: f64 = 0.25;

/// How near the ball's centre must come to the goal (units): within the goal's corridor, whatever the ball's size.
const GOAL_RADIUS: f64 = 0.35;

/// Extents of a file that can be computed with (file units): squares and products of areas stay finite and above 0.
const SIZES: RangeInclusive<f64> = 1.0e-12..=1.0e12;

/// Most separate regions with openings that are searched for the farthest pair; a maze has one.
const MAX_REGIONS: usize = 16;

/// What the user may decide instead of us.
#[derive(Clone, Copy, Debug, Default)]
pub struct AssembleOptions {
    /// Else the axis of the smallest extent, y on a tie.
    pub up_axis: Option<UpAxis>,
    /// In corridors; else [`BallSpec::RADIUS`].
    pub ball_radius: Option<Radius>,
}

/// Why polygons are no maze.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum AssembleError {
    /// There is nothing.
    #[error("no faces: expected walls")]
    NoFaces,
    /// Products of such coordinates would be infinite or nothing.
    #[error("the file is {size:e} units large: expected {low:e} to {high:e}", low = SIZES.start(), high = SIZES.end())]
    Size {
        /// Largest extent, in file units.
        size: f64,
    },
    /// No upright face along an axis.
    #[error("no walls among {n_faces} faces: expected upright faces along two axes")]
    NoWalls {
        /// Faces in the file.
        n_faces: usize,
    },
    /// It is something else than a maze of axis-aligned walls.
    #[error(
        "not a maze of axis-aligned walls: {percent:.1} % of the area that could be wall is off axis by more than 1 \
         degree (at most {max:.0} % can be ignored)",
        max = 100.0 * MAX_OFF_AXIS_PART
    )]
    OffAxis {
        /// Share of the upright and slanted area.
        percent: f64,
    },
    /// The walls stand elsewhere than on the floor.
    #[error("no wall stands at height {height} above the floor (file units, along the up axis)")]
    NothingCut {
        /// Where the walls were cut.
        height: f64,
    },
    /// A wall face is not usable.
    #[error(transparent)]
    Plane(#[from] PlaneError),
    /// The faces make no ground plan.
    #[error(transparent)]
    Section(#[from] SectionError),
    /// Walls, but no space between them.
    #[error("no corridor: no two walls face each other across free space")]
    NoCorridor,
    /// The ball is too large.
    #[error("a ball of radius {radius} corridors fits nowhere in this maze: expected less than 0.5")]
    NoRoom {
        /// In corridors.
        radius: f64,
    },
}

/// What the faces of a mesh are; everything in file units, up axis turned to z.
struct Survey {
    mesh: PolygonMesh,
    kinds: Vec<FaceKind>,
    floor_z: f64,
    top_z: f64,
    has_floor: bool,
    ignored: Vec<Ignored>,
}

impl Maze {
    /// Builds a maze from polygons: finds the up axis, cuts the walls, scales corridors to 1, chooses start and goal.
    ///
    /// # Errors
    /// Polygons that are no maze of axis-aligned walls, and a ball that does not fit.
    pub fn from_polygons(mesh: &PolygonMesh, options: &AssembleOptions) -> Result<Self, AssembleError> {
        let up_axis = options.up_axis.unwrap_or_else(|| flattest_axis(mesh.positions()));
        let mut survey = Survey::new(mesh, up_axis)?;
        let mut raw_section = Section::new(&survey.cut_walls()?)?;
        if raw_section.inverted {
            // The walls look inwards, and so does all the rest: floors look down.
            survey = Survey::new(&mesh.reversed(), up_axis)?;
            raw_section = Section::new(&survey.cut_walls()?)?;
        }
        let doubtful_part = raw_section.doubtful_part;
        let corridor = raw_section.corridor().ok_or(AssembleError::NoCorridor)?;
        let frame = Frame::new(&raw_section, [survey.floor_z, survey.top_z], corridor);
        let section = raw_section.map(|x| frame.x(x), |y| frame.y(y));
        let [low, high] = section.corners().map(|[x, y]| Vector2::new(x, y));
        let bounds = Bounds { low, high };
        let ball_radius = options.ball_radius.unwrap_or(BallSpec::RADIUS);
        // What the ball does not fit through is a chink, not an opening.
        let mut openings = section.openings();
        openings.retain(|opening| 2.0 * ball_radius.units() <= opening.end - opening.start);
        let reach = Reach::new(&section, ball_radius.units());
        let way = Way::choose(&reach, &openings, ball_radius.units())
            .ok_or(AssembleError::NoRoom { radius: ball_radius.units() })?;
        let wall_height = frame.z(survey.top_z);
        Ok(Self {
            planes: Arc::new(SortedPlanes::new(section.faces())?),
            surface: survey.surface(&frame, bounds, &openings, wall_height),
            openings,
            bounds,
            wall_height,
            ball_radius,
            start: way.start,
            goal: way.goal,
            goal_radius: GOAL_RADIUS,
            solvable: way.solvable,
            reach: Arc::new(reach),
            up_axis,
            scale: frame.scale(),
            has_floor: survey.has_floor,
            ignored: survey.ignored,
            doubtful_part,
        })
    }
}

/// A board is flat: the axis of the smallest extent, y (the custom of modelling programs) before z before x on a tie.
fn flattest_axis(positions: &[Vector3<f64>]) -> UpAxis {
    let extent = extent(positions);
    let by_extent = [(extent.y, UpAxis::Y), (extent.z, UpAxis::Z), (extent.x, UpAxis::X)];
    by_extent.into_iter().min_by(|a, b| a.0.total_cmp(&b.0)).map_or(UpAxis::Y, |(_, axis)| axis)
}

/// Size of the bounding box; 0 for nothing.
fn extent(positions: &[Vector3<f64>]) -> Vector3<f64> {
    let low = positions.iter().copied().reduce(|a, b| a.inf(&b)).unwrap_or_default();
    let high = positions.iter().copied().reduce(|a, b| a.sup(&b)).unwrap_or_default();
    high - low
}

impl Survey {
    fn new(file_mesh: &PolygonMesh, up_axis: UpAxis) -> Result<Self, AssembleError> {
        let mesh = file_mesh.map_positions(|position| up_axis.turned_to_z(position));
        let size = extent(mesh.positions()).amax();
        if size != 0.0 && !SIZES.contains(&size) {
            return Err(AssembleError::Size { size });
        }
        let mut kinds = Vec::with_capacity(mesh.n_faces());
        let mut areas = Vec::with_capacity(mesh.n_faces());
        for face in mesh.faces() {
            let (kind, area) = slice::classify(&corners(&mesh, face), size);
            kinds.push(kind);
            areas.push(area);
        }
        if kinds.is_empty() {
            return Err(AssembleError::NoFaces);
        }
        let area_of = |wanted: fn(FaceKind) -> bool| {
            kinds.iter().zip(&areas).filter(|(kind, _)| wanted(**kind)).map(|(_, area)| area).sum::<f64>()
        };
        let wall_area = area_of(|kind| matches!(kind, FaceKind::Wall(_)));
        let off_axis_area = area_of(|kind| kind == FaceKind::OffAxis);
        if MAX_OFF_AXIS_PART * (wall_area + off_axis_area) < off_axis_area {
            let percent = 100.0 * off_axis_area / (wall_area + off_axis_area);
            return Err(AssembleError::OffAxis { percent });
        }
        if wall_area <= 0.0 {
            return Err(AssembleError::NoWalls { n_faces: kinds.len() });
        }
        let total: f64 = areas.iter().sum();
        let ignored = [
            (FaceKind::Down, "looks down: never seen and never met"),
            (FaceKind::OffAxis, "off axis by more than 1 degree"),
            (FaceKind::Degenerate, "no area"),
        ];
        let ignored = ignored.into_iter().filter_map(|(unused, reason)| {
            let of_kind = || kinds.iter().zip(&areas).filter(|(kind, _)| **kind == unused);
            let area_part = of_kind().map(|(_, area)| area).sum::<f64>() / total;
            let n_faces = of_kind().count();
            (0 < n_faces).then_some(Ignored { reason, n_faces, area_part })
        });
        let ignored = ignored.collect();
        let (floor_z, top_z, has_floor) = levels(&mesh, &kinds, &areas);
        Ok(Self { mesh, kinds, floor_z, top_z, has_floor, ignored })
    }

    fn faces(&self) -> impl Iterator<Item = (FaceKind, Vec<Vector3<f64>>)> {
        self.kinds.iter().copied().zip(self.mesh.faces().map(|face| corners(&self.mesh, face)))
    }

    fn cut_walls(&self) -> Result<Vec<Plane>, AssembleError> {
        let height = self.floor_z + CUT_PART * (self.top_z - self.floor_z);
        let walls = self.faces().filter_map(|(kind, corners)| match kind {
            FaceKind::Wall(facing) => Some(slice::cut(&corners, facing, height)),
            _ => None,
        });
        let cut: Vec<Plane> = walls.flatten().collect();
        let above_floor = height - self.floor_z;
        if cut.is_empty() { Err(AssembleError::NothingCut { height: above_floor }) } else { Ok(cut) }
    }

    fn surface(&self, frame: &Frame, bounds: Bounds, openings: &[Plane], wall_height: f64) -> SurfaceMesh {
        let mut builder = SurfaceBuilder::default();
        let tops_from = self.floor_z + FLOOR_PART * (self.top_z - self.floor_z);
        for (kind, corners) in self.faces() {
            let surface = match kind {
                FaceKind::Wall(_) => Surface::Wall,
                FaceKind::Up if corners.iter().all(|corner| tops_from < corner.z) => Surface::Top,
                FaceKind::Up => Surface::Floor,
                _ => continue,
            };
            let corners: Vec<_> = corners.into_iter().map(|corner| frame.point(corner)).collect();
            builder.polygon(surface, &corners);
        }
        if !self.has_floor {
            builder.floor(bounds);
        }
        for opening in openings {
            builder.threshold(opening, wall_height);
        }
        builder.finish()
    }
}

fn corners(mesh: &PolygonMesh, face: &[u32]) -> Vec<Vector3<f64>> {
    face.iter().map(|&corner| mesh.positions()[corner as usize]).collect()
}

/// Height of the floor, of the wall tops, and whether there is a floor at all.
///
/// The floor is the largest upward level from the walls' lower end to four fifths of their height, else their lower end.
fn levels(mesh: &PolygonMesh, kinds: &[FaceKind], areas: &[f64]) -> (f64, f64, bool) {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    let mut upward: Vec<(f64, f64)> = Vec::new(); // (z, area)
    for ((face, kind), area) in mesh.faces().zip(kinds).zip(areas) {
        let heights = face.iter().map(|&corner| mesh.positions()[corner as usize].z);
        match kind {
            FaceKind::Wall(_) => heights.for_each(|z| {
                low = if z < low { z } else { low };
                high = if high < z { z } else { high };
            }),
            FaceKind::Up => upward.push((heights.clone().sum::<f64>() / heights.count() as f64, *area)),
            _ => {}
        }
    }
    let near = 1.0e-3 * (high - low);
    upward.sort_by(|a, b| a.0.total_cmp(&b.0));
    let floor = upward
        .chunk_by(|a, b| b.0 - a.0 <= near)
        .filter(|level| low - near <= level[0].0 && level[0].0 < high - 0.2 * (high - low))
        .map(|level| (level[level.len() / 2].0, level.iter().map(|(_, area)| area).sum::<f64>()))
        .max_by(|a, b| a.1.total_cmp(&b.1));
    match floor {
        Some((z, _)) => (z, high, true),
        None => (low, high, false),
    }
}

/// Start and goal.
struct Way {
    start: Vector2<f64>,
    goal: Vector2<f64>,
    solvable: bool,
}

impl Way {
    /// Two openings of the outer wall, the farthest apart of those joined by a way; with one opening, it is the goal and
    /// the start is as far as can be; without any, the two ends of the longest way. `None` when the ball fits nowhere.
    fn choose(reach: &Reach, openings: &[Plane], radius: f64) -> Option<Self> {
        let doors: Vec<(Vector2<f64>, usize)> = openings
            .iter()
            .filter_map(|opening| {
                let mut door = opening.facing.normal() * radius;
                door[opening.facing.axis()] += opening.offset;
                door[1 - opening.facing.axis()] = (opening.start + opening.end) / 2.0;
                reach.cell_at(door).map(|cell| (door, cell))
            })
            .collect();
        if let [first, second, ..] = doors[..] {
            return Some(Self::between_doors(reach, &doors, [first.0, second.0]));
        }
        let (near_end, goal) = match doors.first() {
            Some(&(door, cell)) => (cell, door),
            None => {
                let any = reach.largest_region()?;
                let end = reach.distances_from(any).farthest();
                (end, reach.middle(end))
            }
        };
        let far_end = reach.middle(reach.distances_from(near_end).farthest());
        Some(match doors.is_empty() {
            true => Self::upper_left_first(far_end, goal, true),
            false => Self { start: far_end, goal, solvable: true },
        })
    }

    fn between_doors(reach: &Reach, doors: &[(Vector2<f64>, usize)], unjoined: [Vector2<f64>; 2]) -> Self {
        let mut longest = None;
        let mut seen = vec![false; doors.len()];
        for _ in 0..MAX_REGIONS {
            let Some(first) = seen.iter().position(|seen| !seen) else { break };
            // Two sweeps: the farthest from anywhere is one end of the longest way (exact where ways do not branch).
            let from_first = reach.distances_from(doors[first].1);
            for (seen, (_, cell)) in seen.iter_mut().zip(doors) {
                *seen |= from_first.to(*cell).is_finite();
            }
            let (_, one) = farthest_door(&from_first, doors);
            let (distance, other) = farthest_door(&reach.distances_from(doors[one].1), doors);
            if one != other && longest.is_none_or(|(known, _, _)| known < distance) {
                longest = Some((distance, doors[one].0, doors[other].0));
            }
        }
        match longest {
            Some((_, from, to)) => Self::upper_left_first(from, to, true),
            None => Self::upper_left_first(unjoined[0], unjoined[1], false),
        }
    }

    /// Reading order: the higher one is the start, the left one when they are level.
    fn upper_left_first(a: Vector2<f64>, b: Vector2<f64>, solvable: bool) -> Self {
        let swap = a.y < b.y || (a.y == b.y && b.x < a.x);
        let (start, goal) = if swap { (b, a) } else { (a, b) };
        Self { start, goal, solvable }
    }
}

/// Distance and index of the farthest door that has a way, the first one on a tie.
fn farthest_door(distances: &Distances, doors: &[(Vector2<f64>, usize)]) -> (f64, usize) {
    let reached = doors.iter().enumerate().map(|(index, (_, cell))| (distances.to(*cell), index));
    reached
        .filter(|(distance, _)| distance.is_finite())
        .rev()
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .unwrap_or((0.0, 0))
}
