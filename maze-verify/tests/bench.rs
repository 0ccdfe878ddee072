//! The benchmark as a whole, on a small maze: all contenders take part, and one that answers wrongly is found.
#![cfg(feature = "bench")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use maze_verify::bench::search::CONTENDERS;
use maze_verify::bench::{Agreement, Case, Contender, Figures, Group, Plan, Query, REFERENCE, Search};
use maze_verify::bench::{measure, tick};
use std::process::Command;
use std::time::Duration;

fn tiny() -> Plan {
    Plan {
        n_checked: 500,
        n_queries: 500,
        n_rounds: 3,
        batch: Duration::from_micros(20),
        ..Plan::quick().up_to(200)
    }
}

fn figures(contenders: &[Contender]) -> Figures {
    measure(&tiny(), contenders, &|_| {}).unwrap()
}

#[test]
fn all_take_part_and_agree() {
    let figures = figures(&CONTENDERS);
    assert!(figures.held(), "{}", figures.table());
    let (table, csv) = (figures.table(), figures.csv());
    let mut lines = csv.lines().skip_while(|line| line.starts_with('#'));
    assert_eq!(lines.next(), Some("question,n_planes,touches,contender,round,ns,ratio"));
    let rows: Vec<Vec<&str>> = lines.map(|line| line.split(',').collect()).collect();
    for group in &figures.groups {
        assert!(group.touches.is_none_or(|part| 0.0 < part), "{}", group.question);
        for contender in &CONTENDERS {
            let of = |row: &&Vec<&str>| row[0] == group.question && row[3] == contender.name;
            let rounds: Vec<&Vec<&str>> = rows.iter().filter(of).collect();
            assert_eq!(rounds.len(), 3, "{} {}", group.question, contender.name);
            for (round, row) in rounds.into_iter().enumerate() {
                let [ns, ratio]: [f64; 2] = [row[5], row[6]].map(|figure| figure.parse().unwrap());
                assert!(row.len() == 7 && row[1] == "112" && row[4] == round.to_string());
                assert!(0.0 < ns && 0.0 <= ratio && (contender.name != REFERENCE || ratio == 1.0), "{row:?}");
            }
            assert!(table.contains(contender.name) && figures.chart().contains(contender.name));
        }
    }
    assert!(rows.iter().all(|row| row.len() == 7));
    let misses = figures.groups.iter().filter_map(|group| group.touches).filter(|part| *part < 1.0);
    assert!(0 < misses.count(), "both touches and none");
}

#[test]
fn all_engines_tick_and_agree() {
    let mut figures = figures(&[]);
    tick::measure(&tiny(), &mut figures, &|_| {}).unwrap();
    assert!(figures.held(), "{}", figures.table());
    for contender in tick::ROLLING {
        let is_timed = |group: &Group| group.ns(contender.name).is_some_and(|ns| 0.0 < ns.median);
        assert!(figures.groups.iter().any(is_timed), "{}", contender.name);
        assert!(figures.table().contains(contender.name));
    }
    let csv = figures.csv();
    assert!(csv.lines().skip_while(|line| line.starts_with('#')).all(|line| line.split(',').count() == 7));
}

/// Sorted planes that answer one fast query, the first they meet, a little too late.
struct Wrong {
    right: Box<dyn Search>,
    about: Option<Query>,
}

impl Search for Wrong {
    fn first_touch(&mut self, query: &Query) -> Option<f64> {
        if self.about.is_none() && 5.0 < query.path.velocity.norm() {
            self.about = Some(*query);
        }
        let late = if self.about == Some(*query) { 1.0e-15 } else { 0.0 };
        self.right.first_touch(query).map(|time_s| time_s + late)
    }
}

#[test]
fn one_answer_that_is_off_in_its_last_bits_is_found() {
    let exact = CONTENDERS[0];
    let wrong = Contender {
        name: "wrong",
        agreement: Agreement::Exact,
        build: |case: &Case| Ok(Box::new(Wrong { right: (CONTENDERS[0].build)(case)?, about: None })),
        ..exact
    };
    let figures = figures(&[exact, wrong]);
    assert!(!figures.held());
    let line = figures.table().lines().find(|line| line.starts_with("WRONG")).map(str::to_owned).unwrap();
    assert!(line.contains("wrong, random 10, 112 planes: of 500 answers 1 differ"), "{line}");
}

#[test]
fn blind_casts_are_not_mostly_right() {
    let blind = Contender {
        name: "blind",
        agreement: Agreement::Mostly { part: 0.01, reason: "" },
        build: |_| {
            struct Blind;
            impl Search for Blind {
                fn first_touch(&mut self, _: &Query) -> Option<f64> {
                    None
                }
            }
            Ok(Box::new(Blind))
        },
        ..CONTENDERS[0]
    };
    let figures = figures(&[CONTENDERS[0], blind]);
    assert!(!figures.held());
    assert!(figures.comparisons.iter().all(|found| found.holds == (found.part_off() <= 0.01)));
}

#[test]
fn the_program_prints_a_table_and_writes_its_files() {
    let directory = tempfile::tempdir().unwrap();
    let bench = |arguments: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_maze-verify"));
        command.arg("bench").args(arguments).current_dir(directory.path()).output().unwrap()
    };
    let output = bench(&["--quick", "--max-planes", "112", "--out", "out/deep"]);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let table = String::from_utf8(output.stdout).unwrap();
    assert!(table.contains("rolling ball") && table.contains("the same bits"), "{table}");
    assert!(table.contains("commit unknown"), "no repository of ours around it");
    let note = String::from_utf8(output.stderr).unwrap();
    assert_eq!(note.lines().count(), usize::from(cfg!(debug_assertions)), "{note}");
    let out = directory.path().join("out/deep");
    let read = |name: &str| std::fs::read_to_string(out.join(name)).unwrap();
    assert!(read("bench.svg").starts_with("<svg xmlns=") && read("bench.svg").ends_with("</svg>\n"));
    assert!(read("bench.csv").contains("\nrandom 0.01,112,"));
    assert_eq!(
        read("agreement.csv").lines().next(),
        Some("contender,queries,n_planes,asked,different,apart,apart_by_units,missed,worst_units,holds")
    );
    assert_eq!(std::fs::read_dir(&out).unwrap().count(), 3, "nothing half-written beside");

    let refused = bench(&["--max-planes", "10"]);
    assert_eq!(refused.status.code(), Some(2));
    assert_eq!(String::from_utf8(refused.stderr).unwrap().lines().count(), 1);
}
