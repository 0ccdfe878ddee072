//! The table on the terminal.

use super::agreement::{Agreement, Comparison};
use super::figures::{Figures, Group, Spread, distinct};
use crate::report::number::plain;
use std::fmt::Write;

/// Letters of a contender's name and of a cell.
const NAME: usize = 32;
const CELL: usize = 22;

impl Figures {
    /// A block a question, a line a contender, a column a size.
    pub fn table(&self) -> String {
        let mut text = String::new();
        for line in self.machine.lines() {
            let _ = writeln!(text, "{line}");
        }
        for question in self.questions() {
            self.block(question, &mut text);
        }
        let mut rest = &self.comparisons[..];
        while let Some(first) = rest.first() {
            let (block, others) = rest.split_at(rest.partition_point(|found| found.limit == first.limit));
            agreement_block(block, first.limit, &mut text);
            rest = others;
        }
        text
    }

    fn block(&self, question: &str, text: &mut String) {
        let groups: Vec<&Group> = self.groups.iter().filter(|group| group.question == question).collect();
        let names = distinct(groups.iter().flat_map(|group| group.series.iter().map(|series| series.name)));
        let Some((reference, others)) = names.split_first() else { return };
        let _ =
            writeln!(text, "\n{question}: {reference} in ns, the others as multiples of it (middle half)");
        let mut line = |name: &str, cell: &dyn Fn(&Group) -> String| {
            let cells: Vec<String> = groups.iter().map(|group| format!("{:>CELL$}", cell(group))).collect();
            let _ = writeln!(text, "  {name:<NAME$}{}", cells.concat());
        };
        line("planes", &|group| group.n_planes.to_string());
        if groups.iter().any(|group| group.touches.is_some()) {
            line("touches", &|group| group.touches.map_or_else(String::new, plain));
        }
        line(reference, &|group| shown(group.ns(reference)));
        for name in others {
            line(name, &|group| shown(group.ratio(name)));
        }
    }
}

/// A line a contender, a column a kind of query: over all sizes together, what is apart by more than the same limit (units).
fn agreement_block(comparisons: &[Comparison], limit: f64, text: &mut String) {
    let queries = distinct(comparisons.iter().map(|found| found.queries));
    let contenders = distinct(comparisons.iter().map(|found| found.contender));
    let _ = writeln!(
        text,
        "\nAnswers beside those of the first contender, all sizes together: more than {limit} units off, missed or \
         touched alone, worst (units)"
    );
    let heads: Vec<String> = queries.iter().map(|queries| format!("{queries:>CELL$}")).collect();
    let _ = writeln!(text, "  {:<NAME$}{}", "", heads.concat());
    for name in contenders {
        let of = |queries: &str| {
            let all = comparisons.iter().filter(|found| found.contender == name);
            format!("{:>CELL$}", told(&all.filter(|found| found.queries == queries).collect::<Vec<_>>()))
        };
        let cells: Vec<String> = queries.iter().map(|queries| of(queries)).collect();
        let _ = writeln!(text, "  {name:<NAME$}{}", cells.concat());
    }
    for (names, reason) in reasons(comparisons) {
        let _ = writeln!(text, "  {names}: {reason}");
    }
    for found in comparisons.iter().filter(|found| !found.holds) {
        let _ = writeln!(
            text,
            "WRONG: {}, {}, {} planes: of {} answers {} differ, {} by more than {limit} units (worst {}), {} missed",
            found.contender,
            found.queries,
            found.n_planes,
            found.n_asked,
            found.n_different,
            found.n_apart,
            plain(found.worst),
            found.n_missed,
        );
    }
}

/// Why answers may differ: the contenders with each reason.
fn reasons(comparisons: &[Comparison]) -> Vec<(String, &'static str)> {
    let reason = |found: &Comparison| match found.agreement {
        Agreement::Exact => None,
        Agreement::Mostly { reason, .. } | Agreement::OtherQuestion(reason) => Some(reason),
    };
    let names = |reason_of_all: &'static str| {
        let found = comparisons.iter().filter(|found| reason(found) == Some(reason_of_all));
        distinct(found.map(|found| found.contender)).join(", ")
    };
    let reasons = distinct(comparisons.iter().filter_map(reason));
    reasons.into_iter().map(|reason| (names(reason), reason)).collect()
}

/// What is off in several comparisons together.
fn told(found: &[&Comparison]) -> String {
    match found.first().map(|found| found.agreement) {
        None => String::new(),
        Some(Agreement::OtherQuestion(_)) => "other question".to_owned(),
        Some(_) if found.iter().all(|found| found.n_different == 0) => "the same bits".to_owned(),
        Some(_) => {
            #[allow(clippy::cast_precision_loss, reason = "counts far below 2^53")]
            let part = |count: fn(&Comparison) -> usize| {
                let sum: usize = found.iter().map(|found| count(found)).sum();
                100.0 * sum as f64 / found.iter().map(|found| found.n_asked).sum::<usize>() as f64
            };
            let worst = found.iter().map(|found| found.worst).fold(0.0, f64::max);
            format!(
                "{:.2} % {:.3} % {}",
                part(|found| found.n_apart),
                part(|found| found.n_missed),
                plain(worst)
            )
        }
    }
}

/// What was measured but once has no spread.
fn shown(spread: Option<Spread>) -> String {
    let Some(Spread { low, median, high }) = spread else { return "-".to_owned() };
    if low < high { format!("{} ({}..{})", plain(median), plain(low), plain(high)) } else { plain(median) }
}
