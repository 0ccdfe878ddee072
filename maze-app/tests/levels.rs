//! Every level that comes with the game can be finished, in the time that its par says.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod program;

use program::maze_app;

fn json(arguments: &[&str]) -> serde_json::Value {
    program::json(&mut maze_app(arguments))
}

/// The `par_ticks` of assets/levels.toml, in their order.
fn pars() -> Vec<u64> {
    let text = include_str!("../../assets/levels.toml");
    text.lines()
        .filter_map(|line| line.strip_prefix("par_ticks = "))
        .map(|par| par.parse().unwrap())
        .collect()
}

#[test]
fn the_autopilot_finishes_every_level_in_its_par() {
    let pars = pars();
    assert!(12 <= pars.len());
    let played = (1..=pars.len()).map(|number| {
        let run = json(&["autopilot", "--level", &number.to_string(), "--json"]);
        assert_eq!(run["finished"], true, "level {number}");
        run["ticks"].as_u64().unwrap()
    });
    assert_eq!(
        played.collect::<Vec<_>>(),
        pars,
        "the autopilot's ticks are not the levels' par: if intended, update par_ticks in assets/levels.toml"
    );
    let number = (pars.len() + 1).to_string();
    let output = maze_app(&["autopilot", "--level", &number]).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(stderr.contains(&format!("expected 1 to {}", pars.len())), "{stderr}");
}

#[test]
fn a_recorded_level_or_recipe_is_played_again() {
    let directory = tempfile::tempdir().unwrap();
    let record = directory.path().join("run.maze").display().to_string();
    let recipe = ["--size=6x5", "--seed=3", "--elitism=40", "--river=70", "--braid=0.3"];
    for maze in [&["--level=2"][..], &["--level=2", "--up=y"], &recipe, &["--algorithm=eller", "--size=6x5"]]
    {
        let arguments = [&["autopilot", "--record", &record, "--json"], maze].concat();
        let run = json(&arguments);
        let replay = json(&["replay", &record, "--json"]);
        assert_eq!((&replay["same"], &replay["ticks"]), (&true.into(), &run["ticks"]), "{maze:?}");
    }
}
