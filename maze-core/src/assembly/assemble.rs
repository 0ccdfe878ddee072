//! Polygons -> Maze: one way for files and for generated mazes.

use crate::assembly::board;
use crate::assembly::draft::SectionError;
use crate::assembly::frame::Frame;
use crate::assembly::polygons::{PolygonMesh, UpAxis};
use crate::assembly::section::Section;
use crate::assembly::survey::{MAX_OFF_AXIS_PART, Misfit, SIZES, Survey, extent};
use crate::maze::{Bounds, Maze};
use crate::navigation::ends::{self, Way, WayError, Wishes};
use crate::navigation::reach::Reach;
use crate::physics::ball::{BallSpec, Radius};
use crate::physics::sorted_planes::SortedPlanes;
use crate::physics::wall::PlaneError;
use nalgebra::{Vector2, Vector3};
use std::ops::RangeInclusive;
use std::sync::Arc;

/// How near the ball's centre must come to the goal (units): within the goal's corridor, whatever the ball's size.
const GOAL_RADIUS: f64 = 0.35;

/// Thickness of the rim that is laid around a surface without one, as a part of the file's size.
const RING_PART: f64 = 0.02;

/// An axis may point out of the board if the file is at most so many times as deep along it as along the flattest one.
const MAX_DEPTH_RATIO: f64 = 2.0;

/// The radii that are tried, in hundredths of a corridor, where the usual ball finds no path; below the first one a ball is hard to
/// see.
const TRIED_RADII: RangeInclusive<u8> = 2..=48;

/// By how much a larger ball must pass too (corridors): through a gate in a flat wall that a ball fits to a hair nobody gets.
const PLAY: f64 = 0.005;

/// Part of the plan that low walls may bring into doubt before they are left out.
const MAX_ADDED_DOUBT: f64 = 0.01;

/// Widths of a corridor (units) that a scale given by the user may lead to.
const CORRIDORS: RangeInclusive<f64> = 0.1..=100.0;

/// What the user may decide instead of us.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AssembleOptions {
    /// Else the axis of the smallest extent, y on a tie.
    pub up_axis: Option<UpAxis>,
    /// In corridors; else [`BallSpec::RADIUS`].
    pub ball_radius: Option<Radius>,
    /// Maze units in a unit of the file; else such that a corridor is 1 wide.
    pub scale: Option<f64>,
    /// Where the ball's centre starts (maze units); else at an opening, or far from the goal.
    pub start: Option<Vector2<f64>>,
    /// Where it has to get (maze units); else at an opening, or far from the start.
    pub goal: Option<Vector2<f64>>,
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
        "not a maze of axis-aligned walls ({kind}): {percent:.1} % of the area that could be wall, {percent_of_all:.1} % of \
         all, is off axis by more than 1 degree; expected at most {max:.0} %",
        max = 100.0 * MAX_OFF_AXIS_PART
    )]
    OffAxis {
        /// What the off-axis part mostly is.
        kind: Misfit,
        /// Share of the upright and slanted area.
        percent: f64,
        /// Share of the area of all faces.
        percent_of_all: f64,
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
    /// The scale that was asked for makes corridors too narrow or too wide.
    #[error(
        "scale {scale} makes the corridors {corridor:.4} units wide: expected {low} to {high}",
        low = CORRIDORS.start(), high = CORRIDORS.end()
    )]
    Scale {
        /// Maze units in a unit of the file.
        scale: f64,
        /// The corridors' width with it.
        corridor: f64,
    },
    /// The ball does not fit where the file's start or goal is, nor near it.
    #[error("the ball does not fit at the {}: expected a free place between the walls", ["start", "goal"][*end])]
    NoRoomNear {
        /// 0 for the start, 1 for the goal.
        end: usize,
    },
    /// Start or goal lies in a wall, too near to one, or beyond the board.
    #[error(
        "the ball does not fit at ({x}, {y}): expected a start and a goal within the corridors, as `info` prints them"
    )]
    NotFree {
        /// Maze units.
        x: f64,
        /// Maze units.
        y: f64,
    },
}

/// What is known of a file besides its polygons, in its units across the up axis.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Given {
    /// Start and goal; what the options say goes before them.
    pub(crate) ends: [Option<Vector2<f64>>; 2],
    /// Width of a corridor, else it is found.
    pub(crate) corridor: Option<f64>,
}

impl AssembleError {
    /// Why there is no start or no goal for a ball of this radius, in corridors.
    fn of_way(error: WayError, radius: f64) -> Self {
        match error {
            WayError::NoRoom => Self::NoRoom { radius },
            WayError::NotFree(place) => Self::NotFree { x: place.x, y: place.y },
            WayError::NoRoomNear(end) => Self::NoRoomNear { end },
        }
    }
}

/// What the assembly of a maze is at; for a reader who waits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Looking at every face.
    Faces,
    /// Summing up wall faces to the ground plan.
    Plan,
    /// Looking for start, goal and the way.
    Way,
    /// Triangles to draw.
    Surface,
}

impl Stage {
    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Faces => "sorting faces",
            Self::Plan => "drawing up the ground plan",
            Self::Way => "looking for the way",
            Self::Surface => "laying floor and walls",
        }
    }
}

impl Maze {
    /// Builds a maze from polygons: finds the up axis, cuts the walls, scales corridors to 1, chooses start and goal.
    ///
    /// # Errors
    /// Polygons that are no maze of axis-aligned walls, and a ball that does not fit.
    pub fn from_polygons(mesh: &PolygonMesh, options: &AssembleOptions) -> Result<Self, AssembleError> {
        Self::from_polygons_step_by_step(mesh, options, &mut |_| ())
    }

    /// [`Maze::from_polygons`] that tells each stage as it begins; stages come again where an axis was wrong.
    ///
    /// # Errors
    /// As there.
    pub fn from_polygons_step_by_step(
        mesh: &PolygonMesh,
        options: &AssembleOptions,
        tell: &mut dyn FnMut(Stage),
    ) -> Result<Self, AssembleError> {
        Self::assembled(mesh, options, &Given::default(), tell)
    }

    /// [`Maze::from_polygons_step_by_step`] with what is known of a file besides its polygons.
    ///
    /// # Errors
    /// As there.
    pub(crate) fn assembled(
        mesh: &PolygonMesh,
        options: &AssembleOptions,
        given: &Given,
        tell: &mut dyn FnMut(Stage),
    ) -> Result<Self, AssembleError> {
        let axes = match options.up_axis {
            Some(axis) => vec![axis],
            None => flat_axes(mesh.positions()),
        };
        let mut first_error = None;
        for axis in axes {
            match Self::standing(mesh, axis, options, given, tell) {
                // What the user asked for is meant for the axis that stands first: no other one is an answer to it.
                Err(
                    error @ (AssembleError::NotFree { .. }
                    | AssembleError::NoRoomNear { .. }
                    | AssembleError::Scale { .. }),
                ) => return Err(error),
                Err(error) => first_error = first_error.or(Some(error)),
                maze => return maze,
            }
        }
        Err(first_error.unwrap_or(AssembleError::NoFaces))
    }

    fn standing(
        mesh: &PolygonMesh,
        up_axis: UpAxis,
        options: &AssembleOptions,
        given: &Given,
        tell: &mut dyn FnMut(Stage),
    ) -> Result<Self, AssembleError> {
        tell(Stage::Faces);
        let mut survey = Survey::new(mesh, up_axis, false)?;
        let cut = survey.cut_walls()?;
        tell(Stage::Plan);
        let mut raw_section = Section::new(&cut)?;
        drop(cut);
        let mut covers = board::Covers::new(&survey, &raw_section);
        let is_turned_over = covers.is_turned_over();
        if is_turned_over {
            let size = extent(mesh.positions()).amax();
            raw_section = raw_section.turned_over(RING_PART * size);
            covers = board::Covers::new(&survey, &raw_section);
        } else if raw_section.inverted {
            // The walls look inwards, and so does all the rest: floors look down.
            survey = Survey::new(mesh, up_axis, true)?;
            raw_section = Section::new(&survey.cut_walls()?)?;
            covers = board::Covers::new(&survey, &raw_section);
        }
        covers.note_roof(&mut survey);
        let corridor_of = |section: &Section| section.corridor().map(|found| given.corridor.unwrap_or(found));
        let mut corridor = corridor_of(&raw_section).ok_or(AssembleError::NoCorridor)?;
        if !is_turned_over {
            let radius = options.ball_radius.unwrap_or(BallSpec::RADIUS).units() * corridor;
            if let Some(section) = with_low_walls(&mut survey, &raw_section, radius)? {
                raw_section = section;
                corridor = corridor_of(&raw_section).ok_or(AssembleError::NoCorridor)?;
                covers = board::Covers::new(&survey, &raw_section);
            }
        }
        let frame = Frame::new(&raw_section, [survey.floor_z, survey.top_z], corridor, options.scale);
        if let Some(scale) = options.scale.filter(|scale| !CORRIDORS.contains(&(scale * corridor))) {
            return Err(AssembleError::Scale { scale, corridor: scale * corridor });
        }
        let section = raw_section.map(|x| frame.x(x), |y| frame.y(y));
        let [low, high] = section.corners().map(|[x, y]| Vector2::new(x, y));
        let bounds = Bounds { low, high };
        tell(Stage::Way);
        let wishes = Wishes {
            exact: [options.start, options.goal],
            near: given.ends.map(|end| end.map(|end| Vector2::new(frame.x(end.x), frame.y(end.y)))),
        };
        // In corridors, which are 1 unit wide unless a scale was asked for.
        let width = options.scale.map_or(1.0, |scale| scale * corridor);
        let asked = options.ball_radius.unwrap_or(BallSpec::RADIUS).units();
        // What the ball does not fit through is a chink, not an opening.
        let mut openings = section.openings();
        openings.retain(|opening| 2.0 * asked * width <= opening.end - opening.start);
        let find = |radius: f64| {
            let reach = Reach::new(&section, radius * width);
            Way::find(&reach, &openings, radius * width, &wishes).map(|way| (reach, way))
        };
        let found = find(asked);
        let is_solvable = found.as_ref().is_ok_and(|(_, way)| way.solvable);
        let passing = if is_solvable { None } else { largest_passing(asked, &find) };
        let (in_corridors, found) = match (passing, options.ball_radius) {
            (Some(passing), None) => (passing, find(passing)),
            _ => (asked, found),
        };
        let (reach, way) = found.map_err(|error| AssembleError::of_way(error, asked))?;
        // A notch in the outer wall that the ball does not fit into is no opening either.
        openings.retain(|opening| ends::door(&reach, opening, in_corridors * width).is_some());
        let wall_height = frame.z(survey.top_z);
        tell(Stage::Surface);
        Ok(Self {
            planes: Arc::new(SortedPlanes::new(section.faces())?),
            surface: board::surface(&survey, &section, &frame, &openings, &covers),
            openings,
            bounds,
            wall_height,
            ball_radius: Radius::new(in_corridors * width).ok_or(AssembleError::NoRoom { radius: asked })?,
            passing_radius: passing.and_then(Radius::new),
            start: way.start,
            goal: way.goal,
            goal_radius: GOAL_RADIUS,
            solvable: way.solvable,
            reach: Arc::new(reach),
            up_axis,
            turned: survey.turn.walls_x,
            scale: frame.scale(),
            has_floor: survey.has_floor,
            ignored: survey.ignored,
            adjusted: survey.adjusted,
            merged_within: section.merged_within.map(|within| within * frame.scale()),
            thickened_to: section.thickened_to.map(|thickness| thickness * frame.scale()),
            doubtful_part: section.doubtful_part,
        })
    }
}

/// The plan with the walls that end below the height at which the others are cut; `None` where there are none. Where they spoil
/// the plan they are not met, and noted.
fn with_low_walls(
    survey: &mut Survey,
    section: &Section,
    radius: f64,
) -> Result<Option<Section>, AssembleError> {
    let low = survey.low_walls(radius);
    survey.note_unmet(low.climbed, "lower than a fifth of the ball's radius: drawn, and rolled over");
    if low.planes.is_empty() {
        return Ok(None);
    }
    let mut cut = survey.cut_walls()?;
    cut.extend(low.planes);
    match Section::new(&cut) {
        Ok(with)
            if with.thickened_to.is_some() == section.thickened_to.is_some()
                && with.doubtful_part <= section.doubtful_part + MAX_ADDED_DOUBT
                && with.corridor().is_some() =>
        {
            Ok(Some(with))
        }
        _ => {
            survey.note_unmet(low.walls, "lower than the walls are cut, and not closed: drawn, never met");
            Ok(None)
        }
    }
}

/// The largest radius below the one asked for, in corridors, for which a path leads from start to goal. What a ball passes a
/// smaller one does too, so it is found by bisection.
fn largest_passing<T>(asked: f64, find: &impl Fn(f64) -> Result<(T, Way), WayError>) -> Option<f64> {
    let radius = |hundredths: u8| f64::from(hundredths) / 100.0;
    let passes = |hundredths: u8| find(radius(hundredths) + PLAY).is_ok_and(|(_, way)| way.solvable);
    let mut tried = TRIED_RADII.filter(|hundredths| radius(*hundredths) < asked);
    let (mut low, mut high) = (*TRIED_RADII.start(), tried.next_back()?);
    if !passes(low) {
        return None;
    }
    while low < high {
        let middle = (low + high).div_ceil(2);
        if passes(middle) {
            low = middle;
        } else {
            high = middle - 1;
        }
    }
    Some(radius(low))
}

/// A board is flat: the axis of the smallest extent, y (the custom of modelling programs) before z before x on a tie; then
/// those along which the file is not much deeper.
fn flat_axes(positions: &[Vector3<f64>]) -> Vec<UpAxis> {
    let extent = extent(positions);
    let mut by_extent = [(extent.y, UpAxis::Y), (extent.z, UpAxis::Z), (extent.x, UpAxis::X)];
    by_extent.sort_by(|a, b| a.0.total_cmp(&b.0));
    let deepest = MAX_DEPTH_RATIO * by_extent[0].0;
    by_extent.into_iter().filter(|(depth, _)| *depth <= deepest).map(|(_, axis)| axis).collect()
}
