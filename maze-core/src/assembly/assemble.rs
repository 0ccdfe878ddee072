//! Polygons -> Maze: one procedure for files and for generated mazes.

use crate::assembly::board;
use crate::assembly::error::{AssembleError, CORRIDORS};
use crate::assembly::frame::Frame;
use crate::assembly::occupancy::Occupancy;
use crate::assembly::polygons::{PolygonMesh, UpAxis};
use crate::assembly::survey::{Survey, extent};
use crate::maze::{FaceReason, ImportReport, Maze, Route};
use crate::navigation::ends::{self, Ends, Requested, RouteError};
use crate::navigation::space::ConfigurationSpace;
use crate::physics::ball::{BallKind, BallSpec, Radius};
use crate::physics::bounds::Bounds;
use crate::physics::sorted_planes::SortedPlanes;
use nalgebra::{Vector2, Vector3};
use std::ops::RangeInclusive;
use std::sync::Arc;

/// How near the ball's centre must come to the goal (units): within the goal's corridor, whatever the ball's size.
const GOAL_RADIUS: f64 = 0.35;

/// Thickness of the rim that is laid around a surface without one, as a fraction of the file's size.
const RING_FRACTION: f64 = 0.02;

/// An axis may point out of the board if the file is at most so many times as deep along it as along the flattest one.
const MAX_DEPTH_RATIO: f64 = 2.0;

/// The radii that are tried, in hundredths of a corridor, where the usual ball finds no path; below the first one a ball is hard to
/// see.
const TRIED_RADII: RangeInclusive<u8> = 2..=48;

/// By how much a larger ball must pass too (corridors): through a gate in a flat wall that a ball fits to a hair nobody gets.
const PLAY: f64 = 0.005;

/// Fraction of the plan that low walls may bring into doubt before they are left out.
const MAX_ADDED_DOUBT: f64 = 0.01;

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

/// What is known of a file besides its polygons, in its units across the up axis.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Given {
    /// Start and goal; what the options say goes before them.
    pub(crate) ends: [Option<Vector2<f64>>; 2],
    /// Width of a corridor, else it is found.
    pub(crate) corridor: Option<f64>,
}

/// What the assembly of a maze is doing, for a user who waits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Stage {
    /// Looking at every face.
    Faces,
    /// Summing up wall faces to the ground plan.
    Plan,
    /// Looking for start, goal and the path.
    Path,
    /// Triangles to draw.
    Surface,
}

impl Stage {
    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Faces => "sorting faces",
            Self::Plan => "drawing up the ground plan",
            Self::Path => "looking for the path",
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

    /// [`Maze::from_polygons`] that reports each stage as it begins; stages come again where an axis was wrong.
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
        let Ground { survey, plan: raw_plan, covers, corridor } =
            Ground::of(mesh, up_axis, options, given, tell)?;
        let frame = Frame::new(&raw_plan, [survey.floor_z, survey.top_z], corridor, options.scale);
        if let Some(scale) = options.scale.filter(|scale| !CORRIDORS.contains(&(scale * corridor))) {
            return Err(AssembleError::Scale { scale, corridor: scale * corridor });
        }
        let plan = raw_plan.map(|x| frame.x(x), |y| frame.y(y));
        let [low, high] = plan.corners().map(|[x, y]| Vector2::new(x, y));
        tell(Stage::Path);
        let requested = Requested {
            exact: [options.start, options.goal],
            near: given.ends.map(|end| end.map(|end| Vector2::new(frame.x(end.x), frame.y(end.y)))),
        };
        // In corridors, which are 1 unit wide unless a scale was asked for.
        let width = options.scale.map_or(1.0, |scale| scale * corridor);
        let asked = options.ball_radius.unwrap_or(BallSpec::RADIUS).units();
        // What the ball does not fit through is a chink, not an opening.
        let mut openings = plan.openings();
        openings.retain(|opening| 2.0 * asked * width <= opening.end - opening.start);
        let find = |radius: f64| {
            let space = ConfigurationSpace::new(&plan, radius * width);
            Ends::find(&space, &openings, radius * width, &requested).map(|ends| (space, ends))
        };
        let found = find(asked);
        let is_solvable = found.as_ref().is_ok_and(|(_, ends)| ends.is_joined);
        let passing = if is_solvable { None } else { largest_passing(asked, &find) };
        let (in_corridors, found) = match (passing, options.ball_radius) {
            (Some(passing), None) => (passing, find(passing)),
            _ => (asked, found),
        };
        let (space, ends) = found.map_err(|error| AssembleError::of_route(error, asked))?;
        // A notch in the outer wall that the ball does not fit into is no opening either.
        openings.retain(|opening| ends::door(&space, opening, in_corridors * width).is_some());
        tell(Stage::Surface);
        Ok(Self {
            planes: Arc::new(SortedPlanes::new(plan.faces())?),
            surface: board::surface(&survey, &plan, &frame, &openings, &covers),
            openings,
            bounds: Bounds { low, high },
            wall_height: frame.z(survey.top_z),
            ball: BallKind::default(),
            ball_radius: Radius::new(in_corridors * width)
                .map_err(|_| AssembleError::NoRoom { radius: asked })?,
            report: report(up_axis, survey, &plan, &frame, passing),
            route: Route {
                start: ends.start,
                goal: ends.goal,
                goal_radius: GOAL_RADIUS,
                is_solvable: ends.is_joined,
                space: Arc::new(space),
            },
        })
    }
}

/// What stands on one axis of a mesh, in file units.
struct Ground<'a> {
    survey: Survey<'a>,
    plan: Occupancy,
    covers: board::Covers,
    /// Width of a corridor.
    corridor: f64,
}

impl<'a> Ground<'a> {
    fn of(
        mesh: &'a PolygonMesh,
        up_axis: UpAxis,
        options: &AssembleOptions,
        given: &Given,
        tell: &mut dyn FnMut(Stage),
    ) -> Result<Self, AssembleError> {
        tell(Stage::Faces);
        let mut survey = Survey::new(mesh, up_axis, false)?;
        let cut = survey.cut_walls()?;
        tell(Stage::Plan);
        let mut plan = Occupancy::new(&cut)?;
        drop(cut);
        let mut covers = board::Covers::new(&survey, &plan);
        let is_turned_over = covers.is_turned_over();
        if is_turned_over {
            let size = extent(mesh.positions()).amax();
            plan = plan.turned_over(RING_FRACTION * size);
            covers = board::Covers::new(&survey, &plan);
        } else if plan.inverted {
            // The walls face inwards, and so does all the rest: floors face down.
            survey = Survey::new(mesh, up_axis, true)?;
            plan = Occupancy::new(&survey.cut_walls()?)?;
            covers = board::Covers::new(&survey, &plan);
        }
        covers.note_roof(&mut survey);
        let corridor_of = |plan: &Occupancy| {
            let corridor = plan.corridor().map(|found| given.corridor.unwrap_or(found));
            corridor.ok_or(AssembleError::NoCorridor)
        };
        let corridor = corridor_of(&plan)?;
        let radius = options.ball_radius.unwrap_or(BallSpec::RADIUS).units() * corridor;
        let with_low = if is_turned_over { None } else { with_low_walls(&mut survey, &plan, radius)? };
        let Some(plan) = with_low else { return Ok(Self { survey, plan, covers, corridor }) };
        let (covers, corridor) = (board::Covers::new(&survey, &plan), corridor_of(&plan)?);
        Ok(Self { survey, plan, covers, corridor })
    }
}

/// What was found, changed and left out; `plan` is in maze units.
fn report(
    up_axis: UpAxis,
    survey: Survey,
    plan: &Occupancy,
    frame: &Frame,
    passing: Option<f64>,
) -> ImportReport {
    ImportReport {
        up_axis,
        scale: frame.scale(),
        has_floor: survey.has_floor,
        turned: survey.turn.walls_x,
        ignored: survey.ignored,
        adjusted: survey.adjusted,
        merged_within: plan.merged_within.map(|within| within * frame.scale()),
        thickened_to: plan.thickened_to.map(|thickness| thickness * frame.scale()),
        doubtful_fraction: plan.doubtful_fraction,
        passing_radius: passing.and_then(|radius| Radius::new(radius).ok()),
    }
}

/// The plan with the walls that end below the height at which the others are cut; `None` where there are none. Where they spoil
/// the plan they are not met, and noted.
fn with_low_walls(
    survey: &mut Survey,
    plan: &Occupancy,
    radius: f64,
) -> Result<Option<Occupancy>, AssembleError> {
    let low = survey.low_walls(radius);
    survey.note_unmet(low.climbed, FaceReason::RolledOver);
    if low.planes.is_empty() {
        return Ok(None);
    }
    let mut cut = survey.cut_walls()?;
    cut.extend(low.planes);
    match Occupancy::new(&cut) {
        Ok(with)
            if with.thickened_to.is_some() == plan.thickened_to.is_some()
                && with.doubtful_fraction <= plan.doubtful_fraction + MAX_ADDED_DOUBT
                && with.corridor().is_some() =>
        {
            Ok(Some(with))
        }
        _ => {
            survey.note_unmet(low.walls, FaceReason::LowAndOpen);
            Ok(None)
        }
    }
}

/// The largest radius below the one asked for, in corridors, for which a path leads from start to goal. What a ball passes a
/// smaller one does too, so it is found by bisection.
fn largest_passing<T>(asked: f64, find: &impl Fn(f64) -> Result<(T, Ends), RouteError>) -> Option<f64> {
    let radius = |hundredths: u8| f64::from(hundredths) / 100.0;
    let passes = |hundredths: u8| find(radius(hundredths) + PLAY).is_ok_and(|(_, ends)| ends.is_joined);
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
