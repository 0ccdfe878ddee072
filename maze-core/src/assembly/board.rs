//! The board as it is drawn: the file's own faces where they show it, else the ground plan raised.

use crate::assembly::frame::Frame;
use crate::assembly::occupancy::Occupancy;
use crate::assembly::polygons::doubled_area;
use crate::assembly::slice::FaceKind;
use crate::assembly::surface::{Surface, SurfaceBuilder, SurfaceMesh};
use crate::assembly::survey::{Survey, Tally};
use crate::maze::FaceReason;
use crate::physics::bounds::Bounds;
use crate::physics::numbers::{greater, lesser};
use crate::physics::wall::Plane;
use nalgebra::{Vector2, Vector3};

/// A lid over more than this fraction of the corridors is a roof.
const ROOF_FRACTION: f64 = 0.5;

/// Where more than this fraction of the walls has no top in the file, tops are laid.
const BARE_FRACTION: f64 = 0.02;

/// How much more area must speak against the plan than for it before walls and corridors change places.
const CONTRARY_RATIO: f64 = 9.0;

/// How far below the wall tops they lie (units): hidden where the file has some after all.
const LAID_DROP: f64 = 0.005;

/// Most rectangles of the plan that are visited to find a roof: some seconds. Faces that overlap a thousandfold are no roof.
const MAX_VISITS: usize = 1 << 26;

/// Most corners that are drawn as the file has them, and the most work to cut them into triangles (squared corners of
/// polygons): a file with more is drawn from its ground plan. So many corners are 128 MiB of the 256 MiB that a graphics
/// card takes in one buffer.
const MAX_DRAWN_CORNERS: usize = 1 << 22;
const MAX_CUTTING: usize = 1 << 28;

/// A slanted face is wall when its normal rises less than this (sine), else it faces up or down.
const SIN_STEEP: f64 = 0.7;

/// What of the plan lies under which faces.
pub(crate) struct Covers {
    /// By cell, row by row: has a top above it.
    topped: Vec<bool>,
    /// Fraction of the corridors, and of the walls, that has a top.
    topped_parts: [f64; 2],
    /// Faces above the corridors.
    roof: Tally,
    /// Area on which floor and tops are where corridors and walls are, and on which they are the other way round.
    agrees: f64,
    disagrees: f64,
}

impl Covers {
    /// Visits every rectangle of the plan, which must be in file units.
    pub(crate) fn new(survey: &Survey, plan: &Occupancy) -> Self {
        let [n_x, n_y] = plan.n_cells();
        let [mut topped, mut lidded, mut floored] = [0; 3].map(|_| vec![false; n_x * n_y]);
        let (mut n_visits, mut roof) = (0_usize, Tally::default());
        let mut crossings = Vec::new();
        let (tops_from, seen_from) = (survey.tops_from(), survey.seen_from());
        let mut low_tops = Vec::new();
        survey.each(|face, kind, corners| {
            let is_high = corners.iter().all(|corner| tops_from < corner.z);
            let is_low_top = kind == FaceKind::Up && corners.iter().all(|corner| seen_from < corner.z);
            let cover = match kind {
                FaceKind::Up if is_high => &mut topped,
                FaceKind::Up => &mut floored,
                FaceKind::Down if is_high => &mut lidded,
                _ => return,
            };
            let columns = within(&plan.xs, corners.iter().map(|corner| corner.x));
            let rows = within(&plan.ys, corners.iter().map(|corner| corner.y));
            n_visits = n_visits.saturating_add(columns.len() * rows.len());
            if MAX_VISITS < n_visits {
                return;
            }
            let mut is_over_free = false;
            for j in rows {
                cross(corners, (plan.ys[j] + plan.ys[j + 1]) / 2.0, &mut crossings);
                for i in columns.clone() {
                    let middle = (plan.xs[i] + plan.xs[i + 1]) / 2.0;
                    let n_left = crossings.partition_point(|x| *x <= middle);
                    // Inside of a polygon an odd number of its sides lies to the right.
                    if (crossings.len() - n_left) % 2 == 1 {
                        // The top of a low wall is no floor.
                        if is_low_top && plan.is_solid(i, j) {
                            low_tops.push(j * n_x + i);
                        }
                        cover[j * n_x + i] = true;
                        is_over_free |= !plan.is_solid(i, j);
                    }
                }
            }
            if is_over_free && kind == FaceKind::Up && is_high {
                roof.add(face, doubled_area(corners).norm() / 2.0);
            }
        });
        for cell in low_tops {
            topped[cell] = true;
        }
        let mut covers = Self { topped, topped_parts: [0.0, 1.0], roof, agrees: 0.0, disagrees: 0.0 };
        if n_visits <= MAX_VISITS {
            covers.sum_up(plan, &lidded, &floored);
        }
        covers
    }

    fn sum_up(&mut self, plan: &Occupancy, lidded: &[bool], floored: &[bool]) {
        let [n_x, n_y] = plan.n_cells();
        let (mut areas, mut topped_areas) = ([0.0; 2], [0.0; 2]);
        for j in 0..n_y {
            for i in 0..n_x {
                let cell = j * n_x + i;
                let area = (plan.xs[i + 1] - plan.xs[i]) * (plan.ys[j + 1] - plan.ys[j]);
                let is_solid = plan.is_solid(i, j);
                areas[usize::from(is_solid)] += area;
                topped_areas[usize::from(is_solid)] += if self.topped[cell] { area } else { 0.0 };
                // A cell with both, or with none, decides nothing.
                let is_high = self.topped[cell] || lidded[cell];
                if is_high != floored[cell] {
                    *(if is_high == is_solid { &mut self.agrees } else { &mut self.disagrees }) += area;
                }
            }
        }
        self.topped_parts = [0, 1].map(|kind| match areas[kind] {
            0.0 => 0.0,
            area => topped_areas[kind] / area,
        });
    }

    /// Whether the walls are where the plan is free: the sides of a surface without outer sides all face its corridors.
    pub(crate) fn is_turned_over(&self) -> bool {
        CONTRARY_RATIO * self.agrees < self.disagrees
    }

    /// Notes a roof, if there is one, as ignored.
    pub(crate) fn note_roof(&self, survey: &mut Survey) {
        if self.has_roof() {
            survey.ignored.extend(self.roof.note(FaceReason::Roof, survey.area));
        }
    }

    fn has_roof(&self) -> bool {
        ROOF_FRACTION < self.topped_parts[0]
    }

    /// Whether this cell, a solid one, needs a top.
    fn is_bare(&self, cell: usize) -> bool {
        self.has_roof() || (self.topped_parts[1] < 1.0 - BARE_FRACTION && !self.topped[cell])
    }
}

/// The cells whose middles lie between the lowest and the highest of some values.
fn within(coordinates: &[f64], values: impl Iterator<Item = f64> + Clone) -> std::ops::Range<usize> {
    let low = values.clone().fold(f64::INFINITY, lesser);
    let high = values.fold(f64::NEG_INFINITY, greater);
    let first = coordinates.partition_point(|value| *value < low);
    let last = coordinates.partition_point(|value| *value <= high);
    // The cells at either end may still hold their middle.
    let n_cells = coordinates.len() - 1;
    let last = n_cells.min(last);
    first.saturating_sub(1)..last
}

/// Where a polygon seen from above crosses a line along x: ascending. Once a row and not once a cell, because a polygon may
/// have thousands of corners.
fn cross(corners: &[Vector3<f64>], y: f64, crossings: &mut Vec<f64>) {
    let next = corners.iter().cycle().skip(1);
    let sides = corners.iter().zip(next).filter(|(a, b)| (a.y <= y) != (b.y <= y));
    crossings.clear();
    crossings.extend(sides.map(|(a, b)| a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y))));
    crossings.sort_unstable_by(f64::total_cmp);
}

/// The board in maze units; `plan` is the plan in these.
pub(crate) fn surface(
    survey: &Survey,
    plan: &Occupancy,
    frame: &Frame,
    openings: &[Plane],
    covers: &Covers,
) -> SurfaceMesh {
    let [low, high] = plan.corners().map(|[x, y]| Vector2::new(x, y));
    let wall_height = frame.z(survey.top_z);
    let (n_corners, cutting) = survey.drawing_costs();
    let from_plan = plan.thickened_to.is_some() || MAX_DRAWN_CORNERS < n_corners || MAX_CUTTING < cutting;
    let mut builder = SurfaceBuilder::default();
    if !from_plan {
        builder.reserve(n_corners);
        own_faces(survey, frame, covers.has_roof(), &mut builder);
    }
    let drop = if from_plan || covers.has_roof() { 0.0 } else { LAID_DROP };
    let is_bare = |cell: usize| from_plan || covers.is_bare(cell);
    raised_tops(plan, is_bare, wall_height - drop, &mut builder);
    if from_plan {
        plan.sides().for_each(|side| builder.side(&side, wall_height));
    }
    if from_plan || !survey.has_floor {
        builder.floor(Bounds { low, high });
    }
    for opening in openings {
        builder.threshold(opening, wall_height);
    }
    builder.finish()
}

/// The file's faces but for those that face down, and the roof and what is under it.
fn own_faces(survey: &Survey, frame: &Frame, has_roof: bool, builder: &mut SurfaceBuilder) {
    let tops_from = survey.tops_from();
    let mut moved = Vec::new();
    survey.each(|_, kind, corners| {
        let is_high = || corners.iter().all(|corner| tops_from < corner.z);
        let kind = match kind {
            FaceKind::OffAxis => {
                let doubled = doubled_area(corners);
                match doubled.z / doubled.norm() {
                    rise if rise < -SIN_STEEP => FaceKind::Down,
                    rise if SIN_STEEP < rise => FaceKind::Up,
                    _ => FaceKind::OffAxis,
                }
            }
            kind => kind,
        };
        let surface = match kind {
            FaceKind::Wall(_) | FaceKind::OffAxis => Surface::Wall,
            FaceKind::Up if is_high() && has_roof => return,
            FaceKind::Up if is_high() => Surface::Top,
            FaceKind::Up => Surface::Floor,
            FaceKind::Down | FaceKind::Degenerate => return,
        };
        moved.clear();
        moved.extend(corners.iter().map(|corner| frame.point(*corner)));
        builder.polygon(surface, &moved);
    });
}

/// Tops over what is solid and bare, in strips along x.
fn raised_tops(plan: &Occupancy, is_bare: impl Fn(usize) -> bool, height: f64, builder: &mut SurfaceBuilder) {
    let [n_x, n_y] = plan.n_cells();
    for j in 0..n_y {
        let needs_top = |i: usize| plan.is_solid(i, j) && is_bare(j * n_x + i);
        let mut i = 0;
        while i < n_x {
            let first = i;
            while i < n_x && needs_top(i) {
                i += 1;
            }
            if first < i {
                let (x, y) = ([plan.xs[first], plan.xs[i]], [plan.ys[j], plan.ys[j + 1]]);
                let corners = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(i, j)| Vector3::new(x[i], y[j], height));
                builder.polygon(Surface::Top, &corners);
            }
            i += 1;
        }
    }
}
