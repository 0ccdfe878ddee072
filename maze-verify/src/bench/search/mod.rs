//! The contenders: everything that finds what a swept circle touches first.

mod bit_grid;
mod parry2d;
mod parry3d;
mod planes;
mod trees;

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

/// Asks query after query, from the first again after the last: as many at each call as it is told to.
pub fn in_turn<'a>(search: &'a mut dyn Search, queries: &'a [Query]) -> Box<dyn FnMut(usize) -> f64 + 'a> {
    let mut next = 0;
    Box::new(move |n| {
        let mut sum = 0.0;
        let mut left = if queries.is_empty() { 0 } else { n };
        while 0 < left {
            let end = queries.len().min(next + left);
            sum += search.answer_all(&queries[next..end]);
            left -= end - next;
            next = if end == queries.len() { 0 } else { end };
        }
        sum
    })
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

/// About 10⁶ planes: what takes hundreds of bytes a plane, or minutes to build, stops here.
const MILLION: usize = 2_000_000;

/// The reason why answers of parry differ, and how many may.
const CASTS: Agreement = Agreement::Mostly {
    part: 0.05,
    reason: "computed in f32, by iteration to a tolerance; along the chord of a parabola",
};

/// What is printed of one contender after the other.
const fn contender(name: &'static str, about: &'static str, agreement: Agreement, build: Build) -> Contender {
    Contender { name, about, agreement, max_planes: usize::MAX, build }
}

impl Contender {
    const fn up_to(self, max_planes: usize) -> Self {
        Self { max_planes, ..self }
    }
}

/// All of them; the first is what the others are compared with.
pub const CONTENDERS: [Contender; 13] = {
    use Agreement::{Exact, OtherQuestion};
    [
        contender(
            super::REFERENCE,
            "maze-core: impact::first, the search that the game uses",
            Exact,
            planes::sorted,
        ),
        contender("bisection alone", "the same without bucket indexes", Exact, planes::without_bucket_index),
        contender("naive scan", "maze-core: sweep::first_impact_scan, every plane", Exact, planes::scan)
            .up_to(2_000),
        contender(
            "bit grid",
            "4 bits a cell: the practical limit, for grid mazes alone",
            Exact,
            bit_grid::build,
        ),
        contender("rstar", "R*-tree of the faces, then maze-core's time of impact", Exact, trees::rstar)
            .up_to(MILLION),
        contender(
            "bvh",
            "the crate bvh: tree of the faces, then maze-core's time of impact",
            Exact,
            trees::bvh,
        )
        .up_to(MILLION),
        contender(
            "published",
            "what the report's engine asks: is there an overlap after each step",
            OtherQuestion("an overlap at the end of a step, not the time of a touch"),
            planes::published,
        ),
        contender("parry2d compound", "cast_shapes: a ball, a Compound of cuboids", CASTS, parry2d::compound),
        contender("parry2d mesh", "cast_shapes: a ball, a TriMesh of the walls", CASTS, parry2d::mesh)
            .up_to(MILLION),
        contender("parry3d compound", "the same in three dimensions", CASTS, parry3d::compound),
        contender("parry3d mesh", "a TriMesh of the walls' sides", CASTS, parry3d::mesh).up_to(MILLION),
        contender("rapier3d cast", "QueryPipeline::cast_shape, a collider a wall", CASTS, parry3d::pipeline)
            .up_to(MILLION),
        contender(
            "rapier3d broad phase",
            "BroadPhaseBvh::update with the ball moved, a collider a wall",
            OtherQuestion("pairs of boxes that meet, not the time of a touch"),
            parry3d::broad_phase,
        )
        .up_to(MILLION),
    ]
};

#[cfg(test)]
mod tests {
    use super::*;
    use maze_core::Path;

    #[test]
    fn the_exact_ones_agree_on_parabolas_over_several_cells_too() {
        let case = Case::new(9, 2).unwrap();
        let mut queries = case.random("", 2.0, 3000).unwrap().queries;
        for (index, acceleration) in
            super::super::case::turning_accelerations().into_iter().cycle().take(3000).enumerate()
        {
            let Query { path, until_s, .. } = queries[index];
            let acceleration = acceleration * [0.5, 4.0, 30.0][index % 3];
            queries[index] = Query::new(Path { acceleration, ..path }, until_s).unwrap();
        }
        let exact = CONTENDERS.iter().filter(|contender| contender.agreement == Agreement::Exact);
        let answers = exact.map(|contender| {
            let mut search = (contender.build)(&case).unwrap();
            let bits = |query| search.first_touch(query).map(f64::to_bits);
            (contender.name, queries.iter().map(bits).collect::<Vec<_>>())
        });
        let answers: Vec<_> = answers.collect();
        let (_, truth) = &answers[0];
        assert!(truth.iter().any(Option::is_some) && truth.iter().any(Option::is_none));
        for (name, given) in &answers {
            assert!(given == truth, "{name}");
        }
    }
}
