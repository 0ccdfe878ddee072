//! What was measured on, and what was measured: figures without these mean little.

use std::process::Command;

/// The machine and the program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Machine {
    /// As it calls itself.
    pub cpu: String,
    /// For threads to run on.
    pub n_cores: usize,
    /// Its version.
    pub compiler: &'static str,
    /// Target, optimisation and flags.
    pub flags: String,
    /// Of the tree that the program is run in, when that is ours.
    pub commit: String,
}

impl Machine {
    /// This one.
    pub fn here() -> Self {
        let assertions = if cfg!(debug_assertions) { ", debug assertions" } else { "" };
        Self {
            cpu: cpu().unwrap_or_else(unknown),
            n_cores: std::thread::available_parallelism().map_or(1, usize::from),
            compiler: env!("MAZE_VERIFY_RUSTC_VERSION"),
            flags: format!(
                "{}, opt-level {}{assertions}, RUSTFLAGS {}",
                env!("MAZE_VERIFY_TARGET"),
                env!("MAZE_VERIFY_OPT_LEVEL"),
                env!("MAZE_VERIFY_RUSTFLAGS")
            ),
            commit: commit().unwrap_or_else(unknown),
        }
    }

    /// One thing a line.
    pub fn lines(&self) -> [String; 3] {
        [
            format!("{}, {} cores", self.cpu, self.n_cores),
            format!("{}, {}", self.compiler, self.flags),
            format!("commit {}", self.commit),
        ]
    }
}

fn unknown() -> String {
    "unknown".to_owned()
}

/// Read on Linux; elsewhere the model stays unknown.
fn cpu() -> Option<String> {
    let text = std::fs::read_to_string("/proc/cpuinfo").ok()?;
    let model = text.lines().find_map(|line| line.strip_prefix("model name")?.split_once(':'))?;
    Some(model.1.trim().to_owned())
}

fn commit() -> Option<String> {
    // Somebody else's repository has no such file.
    git(&["ls-files", "--error-unmatch", ":/maze-verify/src/bench/machine.rs"])?;
    git(&["describe", "--always", "--dirty", "--abbrev=10", "--exclude=*"])
}

fn git(arguments: &[&str]) -> Option<String> {
    let output = Command::new("git").args(arguments).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    (output.status.success() && !text.trim().is_empty()).then(|| text.trim().to_owned())
}
