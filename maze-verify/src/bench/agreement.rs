//! Whether contenders give the same answers, and by how much those differ that do not.

use super::case::QuerySet;
use super::search::Search;

/// Answers that differ by more than this (units along the way) count as different: what the game would show.
pub const APART: f64 = 1.0e-3;

/// What is asked of a contender's answers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Agreement {
    /// The same times to the bit.
    Exact,
    /// At most this part of the answers is more than [`APART`] off or missed; the reason why not all are the same.
    Mostly {
        /// 0 to 1.
        part: f64,
        /// Why they differ.
        reason: &'static str,
    },
    /// It answers another question, which this says: its time is told, its answers are not compared.
    OtherQuestion(&'static str),
}

/// How a contender's answers compare with those of the sorted planes.
#[derive(Clone, Debug, PartialEq)]
pub struct Disagreement {
    /// Whose answers.
    pub contender: &'static str,
    /// To which queries, or of which question.
    pub queries: &'static str,
    /// In a maze of so many planes.
    pub n_planes: usize,
    /// Compared.
    pub n_asked: usize,
    /// Not the same to the bit.
    pub n_different: usize,
    /// What counts as apart (units): [`APART`] along the way of a query.
    pub limit: f64,
    /// Both answer, farther apart than that.
    pub n_apart: usize,
    /// One of them touches something and the other does not.
    pub n_missed: usize,
    /// Largest distance between two answers (units).
    pub worst: f64,
    /// Whether it is what was asked.
    pub holds: bool,
}

/// What the sorted planes answer: the truth that the others are held to.
pub fn answers(search: &mut dyn Search, set: &QuerySet, n: usize) -> Vec<Option<f64>> {
    set.queries.iter().take(n).map(|query| search.first_touch(query)).collect()
}

/// Compares answers; `None` for a contender that answers another question.
pub fn compare(
    contender: &'static str,
    agreement: Agreement,
    n_planes: usize,
    set: &QuerySet,
    [truth, given]: [&[Option<f64>]; 2],
) -> Option<Disagreement> {
    let queries = set.name;
    let n_asked = given.len();
    let mut found = Disagreement {
        contender,
        queries,
        n_planes,
        n_asked,
        limit: APART,
        n_different: 0,
        n_apart: 0,
        n_missed: 0,
        worst: 0.0,
        holds: true,
    };
    for ((query, truth), given) in set.queries.iter().zip(truth).zip(given) {
        match (truth, given) {
            (Some(truth), Some(given)) => {
                let apart = (query.path.at(*truth) - query.path.at(*given)).norm();
                found.n_different += usize::from(truth.to_bits() != given.to_bits());
                // A time that is no number is as far off as can be.
                let apart = if apart.is_nan() { f64::INFINITY } else { apart };
                found.n_apart += usize::from(APART < apart);
                found.worst = found.worst.max(apart);
            }
            (None, None) => {}
            _ => {
                found.n_different += 1;
                found.n_missed += 1;
            }
        }
    }
    #[allow(clippy::cast_precision_loss, reason = "counts far below 2^53")]
    let part = (found.n_apart + found.n_missed) as f64 / (n_asked.max(1)) as f64;
    found.holds = match agreement {
        Agreement::Exact => found.n_different == 0,
        Agreement::Mostly { part: most, .. } => part <= most,
        Agreement::OtherQuestion(_) => return None,
    };
    Some(found)
}
