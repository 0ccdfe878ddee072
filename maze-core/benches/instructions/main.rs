//! Instructions a hot call, against what `counts.txt` expects: `cargo bench -p maze-core --bench instructions`, and with
//! `-- --update` at the end it writes the file anew.
//!
//! Times vary from run to run; instructions under valgrind do not. Each call is made one
//! round long and two rounds long, and the difference counts, so that set-up does not. gungraun would do the same through
//! the same valgrind, but its runner has to be installed beside it in the same version.
//!
//! Exit status 1 when a count does not fit, 2 when nothing could be counted.
#![allow(clippy::disallowed_methods, reason = "a benchmark reads and writes a file")]

mod calls;
mod counts;

use calls::CALLS;
use counts::{Counts, UPDATE};
use std::error::Error;
use std::process::{Command, ExitCode};

const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/benches/instructions/counts.txt");

/// Copying memory takes other instructions on every kind of processor, unless glibc is told to use those that all have.
const PLAIN_COPIES: &str = "glibc.cpu.hwcaps=-AVX2,-AVX_Fast_Unaligned_Load,-ERMS,-FSRM,-SSSE3";

/// The architecture that the file is for: others have other instructions.
const ARCHITECTURE: &str = "x86_64";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|argument| argument != "--bench").collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let done = match arguments[..] {
        [] => check(),
        ["--update"] => update(),
        ["--make", name, n_rounds] => make(name, n_rounds),
        _ => Err("expected no argument or --update".into()),
    };
    done.unwrap_or_else(|error| {
        eprintln!("instructions: {error}");
        ExitCode::from(2)
    })
}

/// Below valgrind: makes the calls and says how many a round has.
fn make(name: &str, n_rounds: &str) -> Result<ExitCode, Box<dyn Error>> {
    let (_, prepare) = CALLS.iter().find(|(known, _)| *known == name).ok_or("no such call")?;
    let mut round = prepare()?;
    for _ in 0..n_rounds.parse::<u32>()? {
        (round.make)();
    }
    println!("{}", round.n_calls);
    Ok(ExitCode::SUCCESS)
}

fn check() -> Result<ExitCode, Box<dyn Error>> {
    let expected =
        Counts::from_text(&std::fs::read_to_string(FILE).map_err(|error| format!("{FILE}: {error}"))?)
            .map_err(|error| format!("{FILE}: {error}"))?;
    let counted = count()?;
    if std::env::consts::ARCH != ARCHITECTURE {
        println!("{}{FILE} is for {ARCHITECTURE}: counted, not compared", counted.to_text());
        return Ok(ExitCode::SUCCESS);
    }
    println!("instructions a call, {}", expected.terms(&counted));
    let lines = expected.compare(&counted);
    for (line, _) in &lines {
        println!("{line}");
    }
    if lines.iter().all(|(_, fits)| *fits) {
        return Ok(ExitCode::SUCCESS);
    }
    println!("when this is meant to be so, update the file and say why in the commit:\n  {UPDATE}");
    Ok(ExitCode::FAILURE)
}

fn update() -> Result<ExitCode, Box<dyn Error>> {
    if std::env::consts::ARCH != ARCHITECTURE {
        return Err(format!("{FILE} is for {ARCHITECTURE}").into());
    }
    let text = count()?.to_text();
    std::fs::write(FILE, &text).map_err(|error| format!("{FILE}: {error}"))?;
    print!("{text}");
    Ok(ExitCode::SUCCESS)
}

fn count() -> Result<Counts, Box<dyn Error>> {
    let mut calls = Vec::new();
    for (name, _) in CALLS {
        let ([one, n_calls], [two, _]) = (under_valgrind(name, "1")?, under_valgrind(name, "2")?);
        calls.push((name.to_owned(), (two - one) / n_calls));
    }
    Ok(Counts { compiler: compiler()?, calls })
}

/// Instructions of a whole run, and how many calls a round of it has.
fn under_valgrind(name: &str, n_rounds: &str) -> Result<[f64; 2], Box<dyn Error>> {
    let output = Command::new("valgrind")
        .args(["--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null"])
        .arg(std::env::current_exe()?)
        .args(["--make", name, n_rounds])
        .env("GLIBC_TUNABLES", PLAIN_COPIES)
        .output()
        .map_err(|error| format!("valgrind: {error} (Debian's package valgrind)"))?;
    let (told, said) = (String::from_utf8_lossy(&output.stderr), String::from_utf8_lossy(&output.stdout));
    if !output.status.success() {
        return Err(format!("{name} under valgrind: {}\n{told}", output.status).into());
    }
    // "==123== I   refs:      1,234,567"
    let refs = told
        .lines()
        .filter_map(|line| line.split_once("refs:"))
        .find(|(what, _)| what.trim_end().ends_with('I'));
    let (_, n_instructions) = refs.ok_or_else(|| format!("no count in what valgrind told:\n{told}"))?;
    Ok([n_instructions.trim().replace(',', "").parse()?, said.trim().parse()?])
}

/// The compiler that cargo calls here.
fn compiler() -> Result<String, Box<dyn Error>> {
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let output = Command::new(rustc).arg("--version").output().map_err(|error| format!("rustc: {error}"))?;
    Ok(String::from_utf8(output.stdout)?.trim().to_owned())
}
