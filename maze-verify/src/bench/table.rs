//! The table on the terminal.

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
        self.disagreement_block(&mut text);
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

    fn disagreement_block(&self, text: &mut String) {
        if self.disagreements.is_empty() {
            let _ = writeln!(text, "\nAll answers are the same to the bit.");
            return;
        }
        let _ = writeln!(text, "\nAnswers that differ from those of the first contender");
        for found in &self.disagreements {
            let _ = writeln!(
                text,
                "  {} {:<NAME$}{:<14}{:>9} planes: of {} answers {} differ, {} by more than {} units (worst {}), {} missed",
                if found.holds { "allowed" } else { "WRONG  " },
                found.contender,
                found.queries,
                found.n_planes,
                found.n_asked,
                found.n_different,
                found.n_apart,
                found.limit,
                plain(found.worst),
                found.n_missed,
            );
        }
    }
}

fn shown(spread: Option<Spread>) -> String {
    spread.map_or_else(
        || "-".to_owned(),
        |spread| format!("{} ({}..{})", plain(spread.median), plain(spread.low), plain(spread.high)),
    )
}
