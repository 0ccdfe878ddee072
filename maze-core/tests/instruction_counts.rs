//! The judge of `benches/instructions` can say no.

#[path = "../benches/instructions/counts.rs"]
mod counts;

use counts::Counts;

const FILE: &str = include_str!("../benches/instructions/counts.txt");

fn one(compiler: &str, count: f64) -> Counts {
    Counts { compiler: compiler.to_owned(), calls: vec![("tick".to_owned(), count)] }
}

fn fits(expected: &Counts, counted: &Counts) -> bool {
    expected.compare(counted).iter().all(|(_, fits)| *fits)
}

#[test]
fn growth_and_fall_beyond_the_slack_fail() {
    let expected = one("rustc 1", 1000.0);
    let verdicts =
        [960.0, 975.0, 1000.0, 1025.0, 1040.0].map(|count| fits(&expected, &one("rustc 1", count)));
    assert_eq!(verdicts, [false, true, true, true, false]);
}

#[test]
fn another_compiler_is_told_and_only_its_growth_fails() {
    let expected = one("rustc 1", 1000.0);
    let verdicts = [500.0, 1100.0, 1200.0].map(|count| fits(&expected, &one("rustc 2", count)));
    assert_eq!(verdicts, [true, true, false]);
    let terms = expected.terms(&one("rustc 2", 1000.0));
    assert!(terms.contains("rustc 1") && terms.contains("rustc 2"), "{terms}");
}

#[test]
fn a_call_without_an_expectation_fails_and_so_does_the_reverse() {
    let (none, some) = (Counts { calls: Vec::new(), ..one("rustc 1", 1.0) }, one("rustc 1", 1.0));
    assert!(!fits(&none, &some) && !fits(&some, &none));
}

#[test]
fn what_is_written_is_read() {
    let counts = one("rustc 1.95.0", 12.3);
    assert_eq!(Counts::from_text(&counts.to_text()), Ok(counts));
    for text in ["tick", "tick = fast", "tick = 0", "tick = NaN"] {
        assert!(Counts::from_text(text).unwrap_err().starts_with("line 1: expected"), "{text}");
    }
}

#[test]
fn the_file_is_as_the_command_writes_it() {
    let counts = Counts::from_text(FILE).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(counts.to_text(), FILE);
    assert!(5 <= counts.calls.len());
}
