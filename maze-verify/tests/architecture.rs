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

/// (from, to) for every dependency that is neither optional nor for development only.
fn dependencies(metadata: &Value) -> BTreeSet<(String, String)> {
    let mut arrows = BTreeSet::new();
    for package in metadata["packages"].as_array().unwrap() {
        for dependency in package["dependencies"].as_array().unwrap() {
            if dependency["kind"] != "dev" && dependency["optional"] == false {
                let name = |value: &Value| value.as_str().unwrap().to_owned();
                arrows.insert((name(&package["name"]), name(&dependency["name"])));
            }
        }
    }
    arrows
}

#[test]
fn dependencies_point_one_way() {
    let all = dependencies(&metadata());
    let ours: BTreeSet<(&str, &str)> = all
        .iter()
        .map(|(from, to)| (from.as_str(), to.as_str()))
        .filter(|(from, to)| from.starts_with("maze-") && to.starts_with("maze-"))
        .collect();
    assert_eq!(ours, BTreeSet::from(ARROWS));
}

#[test]
fn physics_and_renderer_reach_nothing_they_must_not() {
    let all = dependencies(&metadata());
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
