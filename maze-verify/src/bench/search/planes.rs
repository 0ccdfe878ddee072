//! maze-core's own searches.

use super::{BenchError, Case, Query, Search};
use crate::bench::case::RADIUS;
use maze_core::SortedPlanes;
use maze_core::impact::{self, Impact, Path};
use nalgebra::Vector2;
use std::sync::Arc;

/// A search that maze-core offers.
struct Planes<F> {
    planes: Arc<SortedPlanes>,
    find: F,
}

impl<F: Fn(&SortedPlanes, &Path, f64, f64, Option<Vector2<f64>>) -> Option<Impact>> Search for Planes<F> {
    fn first_touch(&mut self, query: &Query) -> Option<f64> {
        (self.find)(&self.planes, &query.path, RADIUS, query.until_s, None).map(|impact| impact.time_s)
    }
}

/// The search that the game uses.
pub(super) fn sorted(case: &Case) -> Result<Box<dyn Search>, BenchError> {
    Ok(Box::new(Planes { planes: Arc::clone(case.planes()), find: impact::first }))
}

/// Every plane of every group.
pub(super) fn scan(case: &Case) -> Result<Box<dyn Search>, BenchError> {
    Ok(Box::new(Planes { planes: Arc::clone(case.planes()), find: impact::first_scan }))
}
