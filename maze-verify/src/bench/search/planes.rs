//! maze-core's own searches.

use super::{BenchError, Case, Query, Search};
use crate::bench::case::RADIUS;
use maze_core::engine::SUBSTEP;
use maze_core::sweep::{self, Impact};
use maze_core::{Facing, SortedPlanes, SweepQuery};
use std::sync::Arc;

/// A search that gives the first impact.
struct Planes<F> {
    planes: Arc<SortedPlanes>,
    find: F,
}

impl<F: Fn(&SortedPlanes, &SweepQuery) -> Option<Impact>> Search for Planes<F> {
    fn first_touch(&mut self, query: &Query) -> Option<f64> {
        (self.find)(&self.planes, &query.sweep).map(|impact| impact.time_s)
    }
}

fn planes(case: &Case) -> Result<Arc<SortedPlanes>, BenchError> {
    SortedPlanes::new(case.planes_in()).map(Arc::new).map_err(BenchError::set_up)
}

/// The search that the game uses.
pub(super) fn sorted(case: &Case) -> Result<Box<dyn Search>, BenchError> {
    Ok(Box::new(Planes { planes: planes(case)?, find: sweep::first_impact }))
}

/// The same by bisection alone.
pub(super) fn without_bucket_index(case: &Case) -> Result<Box<dyn Search>, BenchError> {
    let planes = SortedPlanes::new(case.planes_in()).map_err(BenchError::set_up)?.without_bucket_index();
    Ok(Box::new(Planes { planes: Arc::new(planes), find: sweep::first_impact }))
}

/// Every plane of every group.
pub(super) fn scan(case: &Case) -> Result<Box<dyn Search>, BenchError> {
    Ok(Box::new(Planes { planes: planes(case)?, find: sweep::first_impact_scan }))
}

/// What the report's engine asks: an overlap at the end of a step, or after every 0.02 units of one longer than the radius.
struct Published(Arc<SortedPlanes>);

impl Search for Published {
    fn first_touch(&mut self, query: &Query) -> Option<f64> {
        let displacement = query.mean_velocity() * query.until_s;
        let length = displacement.norm();
        let n_steps = if RADIUS < length { (length / SUBSTEP).ceil() } else { 1.0 };
        let overlaps = |part: f64| {
            let centre = query.path.position + displacement * part;
            let mut facings = Facing::opposing(displacement);
            facings.any(|facing| self.0.first_overlap(facing, centre, RADIUS).is_some())
        };
        let mut step = 1.0;
        while step <= n_steps {
            if overlaps(step / n_steps) {
                return Some(step / n_steps * query.until_s);
            }
            step += 1.0;
        }
        None
    }
}

/// The search of the report's engine.
pub(super) fn published(case: &Case) -> Result<Box<dyn Search>, BenchError> {
    Ok(Box::new(Published(planes(case)?)))
}
