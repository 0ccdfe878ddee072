//! `maze-verify` as other programs see it: exit status, what is printed, what is written.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};

fn verify(directory: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_maze-verify")).args(arguments).current_dir(directory).output().unwrap()
}

fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

/// Exit status 2 and one line on stderr that holds all of these.
fn assert_refused(output: &Output, words: &[&str]) {
    let line = String::from_utf8(output.stderr.clone()).unwrap();
    assert_eq!(output.status.code(), Some(2), "{line}");
    assert_eq!(line.trim_end().lines().count(), 1, "{line}");
    assert!(output.stdout.is_empty());
    for word in words {
        assert!(line.contains(word), "{word} in: {line}");
    }
}

#[test]
fn list_names_scenes_and_engines() {
    let directory = tempfile::tempdir().unwrap();
    let output = verify(directory.path(), &["list"]);
    assert!(output.status.success());
    for name in
        ["head-on", "corner-10", "maze-100", "level-default", "continuous", "rapier-rolling", "bit grid"]
    {
        assert!(stdout(&output).lines().any(|line| line.trim_start().starts_with(name)), "{name}");
    }
}

#[test]
fn run_writes_a_report_and_prints_a_table() {
    let directory = tempfile::tempdir().unwrap();
    let output =
        verify(directory.path(), &["run", "--scene", "head-on", "--scene", "corner-0?", "--out", "out/deep"]);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    assert!(stdout(&output).contains("tolerances hold; out/deep/report.html"));
    assert!(output.stderr.is_empty(), "no progress bar without a terminal");
    let out = directory.path().join("out/deep");
    let results: Value = serde_json::from_slice(&std::fs::read(out.join("results.json")).unwrap()).unwrap();
    assert_eq!((&results["schema"], &results["n_scenes"]), (&1.into(), &10.into()));
    assert_eq!(results["scenes"][0]["name"], "head-on");
    assert_eq!(results["scenes"][0]["cases"].as_array().unwrap().len(), 5);
    let page = std::fs::read_to_string(out.join("report.html")).unwrap();
    assert!(page.starts_with("<!doctype html>") && page.ends_with("</html>\n"));
    for foreign in ["http://", "https://", "<script", "@import", "NaN"] {
        assert!(!page.contains(foreign), "{foreign}");
    }
    for tag in ["svg", "g", "table", "details", "div", "tr", "ul"] {
        let count = |what: String| page.matches(&what).count();
        let opened = count(format!("<{tag} ")) + count(format!("<{tag}>"));
        assert_eq!(opened, count(format!("</{tag}>")), "{tag}");
    }
    assert_eq!(std::fs::read_dir(&out).unwrap().count(), 2, "nothing half-written beside");
}

#[test]
fn json_is_one_object_and_nothing_else() {
    let directory = tempfile::tempdir().unwrap();
    let output = verify(directory.path(), &["run", "--scene", "rest", "--engine", "continuous", "--json"]);
    assert!(output.status.success());
    let results: Value = serde_json::from_slice(&output.stdout).unwrap();
    let runs = results["scenes"][0]["cases"][0]["runs"].as_array().unwrap().clone();
    assert_eq!(runs.len(), 1);
    assert_eq!(runs[0]["engine"], "continuous");
    assert!(
        runs[0]["metrics"]["errors"]["position"].is_number(),
        "compared with the truth though not asked for"
    );
}

#[test]
fn parts_on_several_machines_join() {
    let directory = tempfile::tempdir().unwrap();
    for part in ["1/2", "2/2"] {
        let out = part.replace('/', "-");
        let output =
            verify(directory.path(), &["run", "--scene", "oblique", "--partition", part, "--out", &out]);
        assert!(output.status.success(), "{output:?}");
    }
    let output = verify(directory.path(), &["merge", "1-2", "2-2", "--out", "whole"]);
    assert!(output.status.success(), "{output:?}");
    assert!(stdout(&output).contains("4 scenes, all"));
    assert_refused(&verify(directory.path(), &["merge", "1-2"]), &["part 2/2 is missing"]);
    assert_refused(&verify(directory.path(), &["merge", "nowhere"]), &["nowhere/results.json"]);
    std::fs::write(directory.path().join("1-2/results.json"), "{\"schema\": 99}").unwrap();
    assert_refused(&verify(directory.path(), &["merge", "1-2", "2-2"]), &["1-2/results.json", "schema 99"]);
}

const OWN: &str = r#"
[[scene]]
name = "lane"
duration_s = 1.0
ticks_s = [0.01]
walls = [[1.0, -5.0, 2.0, 5.0]]
ball = { position = [0, 0], velocity = [2, 0], radius = 0.3 }
truth.room = { right = 1.0 }
"#;

#[test]
fn a_scene_of_ones_own_runs() {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("own.toml"), OWN).unwrap();
    let output = verify(directory.path(), &["run", "own.toml", "--json"]);
    assert!(output.status.success(), "{output:?}");
    let results: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(results["scenes"][0]["family"], "own");
    let runs = results["scenes"][0]["cases"][0]["runs"].as_array().unwrap().clone();
    assert_eq!(runs.len(), 6);
    let off = |engine: &str| {
        let run = runs.iter().find(|run| run["engine"] == engine).unwrap();
        run["metrics"]["errors"]["position"].as_f64().unwrap()
    };
    assert!(off("continuous") < 1.0e-9 && 1.0e-4 < off("rapier-cuboids"));
}

#[test]
fn what_is_wrong_with_a_scene_file_is_told_with_file_and_line() {
    let directory = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(directory.path().join(name), text).unwrap();
    write("key.toml", &OWN.replace("radius", "raduis"));
    assert_refused(&verify(directory.path(), &["run", "key.toml"]), &["key.toml: line 7", "raduis"]);
    write("wall.toml", &OWN.replace("position = [0, 0]", "position = [1.5, 0]"));
    assert_refused(&verify(directory.path(), &["run", "wall.toml"]), &["wall.toml", "lane", "in a wall"]);
    write("twice.toml", &format!("{OWN}{OWN}"));
    assert_refused(&verify(directory.path(), &["run", "twice.toml"]), &["twice.toml", "lane already"]);
    assert_refused(&verify(directory.path(), &["run", "missing.toml"]), &["missing.toml"]);
}

#[test]
fn bad_usage_ends_with_status_2() {
    let directory = tempfile::tempdir().unwrap();
    assert_refused(&verify(directory.path(), &["run", "--scene", "nothing-such"]), &["no scene"]);
    for arguments in [&["run", "--engine", "bullet"][..], &["run", "--partition", "3/2"], &["dance"], &[]] {
        assert_eq!(verify(directory.path(), arguments).status.code(), Some(2), "{arguments:?}");
    }
}

#[test]
fn r14_usage_errors_are_one_line() {
    let directory = tempfile::tempdir().unwrap();
    for arguments in [
        &["run", "--bogus"][..],
        &["run", "--engine", "none-such"],
        &["run", "--partition", "5/2"],
        &["merge"],
        &["walk"],
        &[],
    ] {
        let output = verify(directory.path(), arguments);
        assert_refused(&output, &["error: ", "(see --help)"]);
    }
}

#[test]
fn r13_r17_messages_do_a_terminal_no_harm_and_are_short() {
    let directory = tempfile::tempdir().unwrap();
    let long = format!("[[scene]]\nname = \"{}\"\n", "9".repeat(5000));
    std::fs::write(directory.path().join("long.toml"), long).unwrap();
    std::fs::write(directory.path().join("key.toml"), "[[scene]]\n\"\\u001b[31mred\" = 1\n").unwrap();
    for arguments in
        [&["run", "\u{1b}[31m\u{202e}.toml"][..], &["run", "long.toml"], &["run", "key.toml"], &["\u{7}"]]
    {
        let output = verify(directory.path(), arguments);
        assert_refused(&output, &[]);
        let line = String::from_utf8(output.stderr).unwrap();
        assert!(line.trim_end().chars().all(|c| !c.is_control() && c != '\u{202e}'), "{line:?}");
        assert!(line.len() < 1500, "{line}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn r8_where_nobody_can_read_it_the_status_tells_all_the_same() {
    let run = |line: &str| {
        let status = Command::new("sh")
            .args(["-c", &format!("\"$0\" {line}"), env!("CARGO_BIN_EXE_maze-verify")])
            .status();
        status.unwrap().code()
    };
    for (line, expected) in [
        ("run /nonexistent.toml 2>/dev/full", 2),
        ("run /nonexistent.toml 2>&-", 2),
        ("run --bogus 2>/dev/full", 2),
        ("list >/dev/full 2>/dev/full", 2),
        ("list >&- 2>&-", 0),
        ("run --scene head-on >/dev/null 2>/dev/full", 0),
    ] {
        let found = run(line);
        assert!(found == Some(expected) || (line.contains(">&-") && found == Some(2)), "{line}: {found:?}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn r11_a_file_that_goes_on_after_what_it_says_is_refused() {
    let directory = tempfile::tempdir().unwrap();
    std::os::unix::fs::symlink("/proc/self/pagemap", directory.path().join("p.toml")).unwrap();
    assert_refused(&verify(directory.path(), &["run", "p.toml"]), &["p.toml", "expected an ordinary file"]);
}
