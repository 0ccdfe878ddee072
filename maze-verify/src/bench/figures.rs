//! What was measured, and how it is printed.

use super::agreement::Comparison;
use super::machine::Machine;
use super::paired::Series;
use std::fmt::Write;

/// The contender that all others are compared with.
pub const REFERENCE: &str = "sorted planes";

/// One question in one maze.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    /// As in the table.
    pub question: &'static str,
    /// Of the maze.
    pub n_planes: usize,
    /// Touches in answer to a query or within a tick, on average.
    pub touches: Option<f64>,
    /// One a contender; the others' times are printed as multiples of the first's.
    pub series: Vec<Series>,
}

/// All of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Figures {
    /// On which it was measured.
    pub machine: Machine,
    /// In the order of measuring.
    pub groups: Vec<Group>,
    /// Of every contender's answers with the first's, to every kind of query at every size.
    pub comparisons: Vec<Comparison>,
}

/// The middle of several figures and how far they spread.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// As many lie above as below.
    pub median: f64,
    /// A quarter lies below.
    pub low: f64,
    /// A quarter lies above.
    pub high: f64,
}

impl Spread {
    /// `None` of no figures.
    pub fn of(mut figures: Vec<f64>) -> Option<Self> {
        figures.sort_by(f64::total_cmp);
        let at = |quarter: usize| figures.get((figures.len().checked_sub(1)? * quarter).div_ceil(4)).copied();
        Some(Self { median: at(2)?, low: at(1)?, high: at(3)? })
    }
}

impl Group {
    /// A contender's times as multiples of the first's, round by round.
    pub fn ratio(&self, contender: &str) -> Option<Spread> {
        let (reference, series) = (self.series.first()?, self.series_of(contender)?);
        Spread::of(series.ns.iter().zip(&reference.ns).map(|(ns, reference)| ns / reference).collect())
    }

    /// A contender's times (ns).
    pub fn ns(&self, contender: &str) -> Option<Spread> {
        Spread::of(self.series_of(contender)?.ns.clone())
    }

    fn series_of(&self, contender: &str) -> Option<&Series> {
        self.series.iter().find(|series| series.name == contender)
    }
}

impl Figures {
    /// Whether all agree that must.
    pub fn held(&self) -> bool {
        self.comparisons.iter().all(|found| found.holds)
    }

    /// The questions, each once, in the order of measuring.
    pub fn questions(&self) -> Vec<&'static str> {
        distinct(self.groups.iter().map(|group| group.question))
    }

    /// All rounds, one a line.
    pub fn csv(&self) -> String {
        let mut text = String::new();
        for line in self.machine.lines() {
            let _ = writeln!(text, "# {line}");
        }
        text += "question,n_planes,touches,contender,round,ns,ratio\n";
        for group in &self.groups {
            let touches = group.touches.map_or_else(String::new, |part| part.to_string());
            let reference = group.series.first().map_or(&[][..], |series| &series.ns);
            for series in &group.series {
                for (round, (ns, reference)) in series.ns.iter().zip(reference).enumerate() {
                    let _ = writeln!(
                        text,
                        "{},{},{touches},{},{round},{ns:.3},{:.4}",
                        group.question,
                        group.n_planes,
                        series.name,
                        ns / reference
                    );
                }
            }
        }
        text
    }
}

impl Figures {
    /// How the answers compare, one line a contender, kind of query and size.
    pub fn agreement_csv(&self) -> String {
        let mut text = String::from(
            "contender,queries,n_planes,asked,different,apart,apart_by_units,missed,worst_units,holds\n",
        );
        for found in &self.comparisons {
            let Comparison { contender, queries, n_planes, n_asked, .. } = found;
            let Comparison { n_different, n_apart, limit, n_missed, worst, holds, .. } = found;
            let _ = writeln!(
                text,
                "{contender},{queries},{n_planes},{n_asked},{n_different},{n_apart},{limit},{n_missed},{worst:e},{holds}"
            );
        }
        text
    }
}

/// Each once, in the order in which they first come.
pub(super) fn distinct(names: impl Iterator<Item = &'static str>) -> Vec<&'static str> {
    names.fold(Vec::new(), |mut known, name| {
        if !known.contains(&name) {
            known.push(name);
        }
        known
    })
}
