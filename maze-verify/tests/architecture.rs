//! Which crate may depend on which: the arrows of ARCHITECTURE.md, read from cargo itself.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use serde_json::Value;
use std::collections::BTreeSet;
use std::process::Command;

/// Every arrow between our crates.
const ARROWS: [(&str, &str); 4] = [
    ("maze-app", "maze-core"),
    ("maze-app", "maze-render"),
    ("maze-render", "maze-core"),
    ("maze-verify", "maze-core"),
];

/// And the one that a feature adds: the engines without the report.
const OPTIONAL_ARROWS: [(&str, &str); 1] = [("maze-app", "maze-verify")];

/// What a crate must not reach, directly or through others: the physics has no window and no GPU.
const FORBIDDEN: [(&str, &[&str]); 2] = [
    ("maze-core", &["wgpu", "winit", "egui", "image", "rapier3d"]),
    ("maze-render", &["winit", "egui", "rapier3d"]),
];

fn metadata() -> Value {
    let output = Command::new(env!("CARGO"))
        .args(["metadata", "--format-version", "1", "--locked"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// (from, to) for every dependency that is not for development only: the optional ones, or the others.
fn dependencies(metadata: &Value, optional: bool) -> BTreeSet<(String, String)> {
    let mut arrows = BTreeSet::new();
    for package in metadata["packages"].as_array().unwrap() {
        for dependency in package["dependencies"].as_array().unwrap() {
            if dependency["kind"] != "dev" && dependency["optional"] == optional {
                let name = |value: &Value| value.as_str().unwrap().to_owned();
                arrows.insert((name(&package["name"]), name(&dependency["name"])));
            }
        }
    }
    arrows
}

#[test]
fn dependencies_point_one_way() {
    let metadata = metadata();
    for (optional, arrows) in [(false, &ARROWS[..]), (true, &OPTIONAL_ARROWS)] {
        let all = dependencies(&metadata, optional);
        let ours: BTreeSet<(&str, &str)> = all
            .iter()
            .map(|(from, to)| (from.as_str(), to.as_str()))
            .filter(|(from, to)| from.starts_with("maze-") && to.starts_with("maze-"))
            .collect();
        assert_eq!(ours, arrows.iter().copied().collect());
    }
    let packages = metadata["packages"].as_array().unwrap();
    let app = packages.iter().find(|package| package["name"] == "maze-app").unwrap();
    let mut to_verify =
        app["dependencies"].as_array().unwrap().iter().filter(|to| to["name"] == "maze-verify");
    assert!(to_verify.all(|to| to["uses_default_features"] == false), "the game takes the engines alone");
}

#[test]
fn physics_and_renderer_reach_nothing_they_must_not() {
    let metadata = metadata();
    let mut all = dependencies(&metadata, false);
    // Of the optional ones those count that our own features add.
    all.extend(dependencies(&metadata, true).into_iter().filter(|(from, _)| from.starts_with("maze-")));
    for (from, forbidden) in FORBIDDEN {
        let mut reached = BTreeSet::from([from.to_owned()]);
        let mut n_before = 0;
        while n_before != reached.len() {
            n_before = reached.len();
            let next: Vec<_> =
                all.iter().filter(|(from, _)| reached.contains(from)).map(|(_, to)| to.clone()).collect();
            reached.extend(next);
        }
        for name in forbidden {
            assert!(!reached.contains(*name), "{from} must not depend on {name}");
        }
    }
}
