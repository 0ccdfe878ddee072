//! Whether contenders give the same answers, and by how much those differ that do not.

use super::case::QuerySet;
use super::search::{Contender, Search};

/// Answers that differ by more than this (units along the path) count as different: what the game would show.
pub const APART: f64 = 1.0e-3;

/// What is asked of a contender's answers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Agreement {
    /// The same times to the bit.
    Exact,
    /// At most this fraction of the answers is more than [`APART`] off or missed; the reason why not all are the same.
    Mostly {
        /// 0 to 1.
        part: f64,
        /// Why they differ.
        reason: &'static str,
    },
    /// It answers another question, which this says: its time is printed, its answers are not compared.
    OtherQuestion(&'static str),
}

/// How a contender's answers compare with those of the sorted planes.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// Whose answers.
    pub contender: &'static str,
    /// What is asked of them.
    pub agreement: Agreement,
    /// To which queries, or of which question about ticks.
    pub queries: &'static str,
    /// In a maze of so many planes.
    pub n_planes: usize,
    /// Compared; 0 for a contender that answers another question.
    pub n_asked: usize,
    /// Not the same to the bit.
    pub n_different: usize,
    /// What counts as apart (units).
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

/// Contenders and what they have built.
pub type Built<'a> = (&'a Contender, Box<dyn Search>);

/// All answer the first `n` queries: how the others' answers compare with the first one's, and which fraction of those are touches.
pub fn check(built: &mut [Built], n_planes: usize, set: &QuerySet, n: usize) -> (Vec<Comparison>, f64) {
    let Some(((_, reference), others)) = built.split_first_mut() else { return (Vec::new(), 0.0) };
    let answers = |search: &mut dyn Search| -> Vec<Option<f64>> {
        set.queries.iter().take(n).map(|query| search.first_touch(query)).collect()
    };
    let truth = answers(reference.as_mut());
    let comparisons = others.iter_mut().map(|(contender, search)| {
        let given = match contender.agreement {
            Agreement::OtherQuestion(_) => Vec::new(),
            _ => answers(search.as_mut()),
        };
        compare(contender.name, contender.agreement, n_planes, set, [&truth, &given])
    });
    #[allow(clippy::cast_precision_loss, reason = "counts far below 2^53")]
    let touches = truth.iter().flatten().count() as f64 / truth.len().max(1) as f64;
    (comparisons.collect(), touches)
}

/// Compares answers.
fn compare(
    contender: &'static str,
    agreement: Agreement,
    n_planes: usize,
    set: &QuerySet,
    [truth, given]: [&[Option<f64>]; 2],
) -> Comparison {
    let mut found = Comparison::new(contender, agreement, set.name, n_planes, APART);
    for ((query, truth), given) in set.queries.iter().zip(truth).zip(given) {
        match (truth, given) {
            (Some(truth), Some(given)) => {
                let apart = (query.path.at(*truth) - query.path.at(*given)).norm();
                found.note(truth.to_bits() == given.to_bits(), apart);
            }
            (None, None) => found.note(true, 0.0),
            _ => {
                found.note(false, 0.0);
                found.n_missed += 1;
            }
        }
    }
    found.judged()
}

impl Comparison {
    /// Nothing compared yet.
    pub(super) fn new(
        contender: &'static str,
        agreement: Agreement,
        queries: &'static str,
        n_planes: usize,
        limit: f64,
    ) -> Self {
        Self {
            contender,
            agreement,
            queries,
            n_planes,
            n_asked: 0,
            limit,
            n_different: 0,
            n_apart: 0,
            n_missed: 0,
            worst: 0.0,
            holds: true,
        }
    }

    /// Counts two answers that lie so far apart (units), and are the same to the bit or not.
    pub(super) fn note(&mut self, is_same: bool, apart: f64) {
        // What is no number is as far apart as can be.
        let apart = if apart.is_nan() { f64::INFINITY } else { apart };
        self.n_asked += 1;
        self.n_different += usize::from(!is_same);
        self.n_apart += usize::from(self.limit < apart);
        self.worst = self.worst.max(apart);
    }

    /// With the verdict on what was counted.
    pub(super) fn judged(self) -> Self {
        let holds = match self.agreement {
            Agreement::Exact => self.n_different == 0,
            Agreement::Mostly { part, .. } => self.part_off() <= part,
            Agreement::OtherQuestion(_) => true,
        };
        Self { holds, ..self }
    }

    /// Fraction of the answers that are off by more than the limit or missed.
    #[allow(clippy::cast_precision_loss, reason = "counts far below 2^53")]
    pub fn part_off(&self) -> f64 {
        (self.n_apart + self.n_missed) as f64 / self.n_asked.max(1) as f64
    }
}
