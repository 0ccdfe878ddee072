//! What the benchmark says about how it was built: the compiler, the profile, the flags.

use std::process::Command;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-env-changed=RUSTC");
    if std::env::var_os("CARGO_FEATURE_BENCH").is_none() {
        return;
    }
    let rustc = std::env::var("RUSTC").unwrap_or_else(|_| "rustc".to_owned());
    let version = Command::new(rustc).arg("--version").output().ok();
    let version = version.and_then(|output| String::from_utf8(output.stdout).ok());
    tell("RUSTC_VERSION", version.as_deref().map(str::trim));
    tell("OPT_LEVEL", std::env::var("OPT_LEVEL").ok().as_deref());
    tell("TARGET", std::env::var("TARGET").ok().as_deref());
    // Flags with places of this machine in them say nothing to others.
    let flags = std::env::var("CARGO_ENCODED_RUSTFLAGS").unwrap_or_default();
    let flags: Vec<&str> = flags.split('\u{1f}').filter(|flag| !flag.contains(['/', '\\'])).collect();
    let flags = flags.join(" ");
    tell("RUSTFLAGS", (!flags.is_empty()).then_some(flags.as_str()).or(Some("none")));
}

fn tell(name: &str, value: Option<&str>) {
    println!("cargo::rustc-env=MAZE_VERIFY_{name}={}", value.unwrap_or("unknown"));
}
