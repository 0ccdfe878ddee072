//! The contenders: everything that finds what a swept circle touches first.

mod parry2d;
mod planes;

use super::agreement::Agreement;
use super::case::{Case, Query};
use super::measure::BenchError;
use std::hint::black_box;

/// Finds what a circle of [`super::case::RADIUS`] touches first.
pub trait Search {
    /// When (s); `None` when it touches nothing in the time.
    fn first_touch(&mut self, query: &Query) -> Option<f64>;

    /// Answers all and adds the answers up: one call through the trait for many queries.
    fn answer_all(&mut self, queries: &[Query]) -> f64 {
        queries.iter().filter_map(|query| self.first_touch(black_box(query))).sum()
    }
}

/// Makes a contender's structure from a maze.
pub type Build = fn(&Case) -> Result<Box<dyn Search>, BenchError>;

/// One way to find the first touch.
#[derive(Clone, Copy)]
pub struct Contender {
    /// As in the table.
    pub name: &'static str,
    /// What it is.
    pub about: &'static str,
    /// What is asked of its answers.
    pub agreement: Agreement,
    /// It is left out of larger mazes: too slow to wait for, or too large for a usual memory.
    pub max_planes: usize,
    /// Makes it.
    pub build: Build,
}

/// Measured at every size.
const ANY: usize = usize::MAX;

/// All of them; the first is what the others are compared with.
pub fn contenders() -> Vec<Contender> {
    vec![
        Contender {
            name: super::REFERENCE,
            about: "maze-core: impact::first",
            agreement: Agreement::Exact,
            max_planes: ANY,
            build: planes::sorted,
        },
        Contender {
            name: "naive scan",
            about: "maze-core: impact::first_scan, every plane",
            agreement: Agreement::Exact,
            max_planes: 20_000,
            build: planes::scan,
        },
        Contender {
            name: "parry2d compound",
            about: "parry2d 0.31.1: cast_shapes, ball against a Compound of cuboids",
            agreement: Agreement::Mostly { part: 0.05, reason: "f32" },
            max_planes: ANY,
            build: parry2d::compound,
        },
    ]
}
