//! The sorted table of one group as the report draws it: what each probe of a bisection compares.

use super::{Colour, GOLD, INK, QUIET, Span, span};
use maze_core::trace::{GroupVisit, Probe};
use maze_core::{Plane, SortedPlanes};
use std::collections::BTreeSet;

/// Tables up to this long are shown whole; of longer ones only what is visited.
const SHORT: usize = 10;

/// Most lines of a table.
const MAX_LINES: usize = 14;

/// Most probes, which are bisections of 2^12.
const MAX_LOOKS: usize = 12;

pub(super) fn lines(planes: &SortedPlanes, group: &GroupVisit, colour: Colour) -> Vec<Vec<Span>> {
    let facing = group.facing;
    let offsets: Vec<f64> = planes.offsets(facing).collect();
    let visited: Vec<usize> = group.rows.iter().map(|row| row.row).collect();
    let heading = format!("group {}: {} rows, sorted by offset", facing.name(), offsets.len());
    let [low, high] = group.offsets;
    let mut lines =
        vec![vec![span(colour, heading)], vec![span(QUIET, format!("sought: offset {low:.2} to {high:.2}"))]];
    let offset = |index: usize| format!("{:>8.2}", offsets[index]);
    lines.extend(probe_lines(offsets.len(), &group.probes, &visited, "  offset", offset));
    // The row in which planes were tested, or else the first.
    let row = group.rows.iter().find(|row| !row.planes.is_empty()).or(group.rows.first());
    let Some(row) = row else {
        lines.push(vec![span(QUIET, "no row within reach")]);
        return lines;
    };
    let known: Vec<Plane> = planes.planes(facing).filter(|plane| plane.offset == row.offset).collect();
    let handed: Vec<usize> = (0..known.len()).filter(|index| row.planes.contains(&known[*index])).collect();
    lines.push(vec![span(colour, format!("row {}, its planes sorted by end: {}", row.row, known.len()))]);
    let [low, high] = row.window;
    lines.push(vec![span(QUIET, format!("sought: {low:.2} to {high:.2} along it"))]);
    let extent = |index: usize| format!("{:>8.2}{:>8.2}", known[index].start, known[index].end);
    lines.extend(probe_lines(known.len(), &row.probes, &handed, "   start     end", extent));
    lines
}

/// A line an entry, a column a probe: L and H what is not excluded, M what is compared.
fn probe_lines(
    n: usize,
    probes: &[Probe],
    found: &[usize],
    heading: &str,
    words: impl Fn(usize) -> String,
) -> Vec<Vec<Span>> {
    let probes = &probes[..probes.len().min(MAX_LOOKS)];
    let columns = if probes.is_empty() { "" } else { "   probes" };
    let mut lines = vec![vec![span(QUIET, format!("    {heading}{columns}"))]];
    let mut last = None;
    for index in shown(n, probes, found) {
        if last.map_or(0, |last| last + 1) < index {
            lines.push(vec![span(QUIET, "   .")]);
        }
        last = Some(index);
        let is_found = found.contains(&index);
        let is_mid = probes.iter().any(|probe| probe.mid == index);
        let ink = if is_found { GOLD } else { [QUIET, INK][usize::from(is_mid)] };
        let sign = if is_found { '>' } else { ' ' };
        let mut line = vec![span(ink, format!("{sign}{index:>3}{}   ", words(index)))];
        line.extend(probes.iter().map(|probe| pointer(probe, index)));
        lines.push(line);
    }
    if last.is_some_and(|last| last + 1 < n) {
        lines.push(vec![span(QUIET, "   .")]);
    }
    lines
}

/// Which entries have a line.
fn shown(n: usize, probes: &[Probe], found: &[usize]) -> BTreeSet<usize> {
    if n <= SHORT {
        return (0..n).collect();
    }
    // The last probes come nearest to what is found, so they go first.
    let pointers = probes.iter().rev().flat_map(|probe| [probe.mid, probe.low, probe.high]);
    let mut indices = BTreeSet::new();
    for index in found.iter().copied().chain(pointers) {
        if index < n && indices.len() < MAX_LINES {
            indices.insert(index);
        }
    }
    indices
}

fn pointer(probe: &Probe, index: usize) -> Span {
    if index == probe.mid {
        span(GOLD, " M")
    } else if index == probe.low {
        span(INK, " L")
    } else if index == probe.high {
        span(INK, " H")
    } else if (probe.low..probe.high).contains(&index) {
        span(QUIET, " |")
    } else {
        span(QUIET, "  ")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(lines: &[Vec<Span>]) -> Vec<String> {
        let line = |spans: &Vec<Span>| spans.iter().map(|span| span.text.as_str()).collect::<String>();
        lines.iter().map(|spans| line(spans).trim_end().to_owned()).collect()
    }

    #[test]
    fn each_look_is_a_column_and_what_was_found_is_marked() {
        let probes = [Probe { low: 0, mid: 2, high: 4 }, Probe { low: 0, mid: 1, high: 2 }];
        let words = |index: usize| format!(" {index}.5");
        let lines = text(&probe_lines(4, &probes, &[1], " at", words));
        assert_eq!(
            lines,
            ["     at   probes", "   0 0.5    L L", ">  1 1.5    | M", "   2 2.5    M H", "   3 3.5    |"]
        );
    }

    #[test]
    fn of_a_long_table_only_what_is_looked_at_is_shown() {
        let probes = [Probe { low: 0, mid: 500, high: 1000 }, Probe { low: 501, mid: 750, high: 1000 }];
        let indices: Vec<usize> = shown(1000, &probes, &[751]).into_iter().collect();
        assert_eq!(indices, [0, 500, 501, 750, 751]);
        let lines = text(&probe_lines(1000, &probes, &[751], "", |_| String::new()));
        assert_eq!(lines.iter().filter(|line| line.as_str() == "   .").count(), 3);
    }
}
