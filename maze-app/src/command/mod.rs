//! The command line: one file per subcommand.

mod autopilot;
mod frames;
mod generate;
mod info;
mod play;
mod render;
mod replay;

use crate::failure::Failure;
use crate::platform::native::{files, rescue};
use clap::error::{ContextKind, ContextValue};
use clap::{CommandFactory, Parser, Subcommand};
use std::io::Write;
use std::process::ExitCode;
use std::time::Instant;

/// Tilt the maze, roll the ball, find the way.
///
/// Without a subcommand: play a new random maze.
#[derive(Parser)]
#[command(
    version,
    args_conflicts_with_subcommands = true,
    after_help = "Examples:\n  maze-app                              play a new random maze\n  \
                  maze-app play --seed 7 --size 20x12   play this one\n  \
                  maze-app play --level 3               play a level\n  \
                  maze-app play my_maze.obj             play your own\n\n\
                  Exit status: 0 done; 1 what was asked for did not hold; 2 bad input or usage."
)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    play: play::Arguments,
}

#[derive(Subcommand)]
enum Command {
    /// Open the game.
    Play(play::Arguments),
    /// Load a maze and say what was found in it.
    Info(info::Arguments),
    /// Make a random maze and write it to a file.
    Generate(generate::Arguments),
    /// Play to the goal without a window.
    Autopilot(autopilot::Arguments),
    /// Play a recording again and say whether it ends in the same state.
    Replay(replay::Arguments),
    /// Draw one picture of a maze, without a window.
    Render(render::Arguments),
    /// Measure frames while the autopilot plays.
    Frames(frames::Arguments),
}

/// The program: one subcommand, and an exit status.
pub fn main() -> ExitCode {
    let started = Instant::now();
    rescue::watch_signals();
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => return usage(&error),
    };
    let result = match cli.command.unwrap_or(Command::Play(cli.play)) {
        Command::Play(arguments) => play::run(arguments),
        Command::Info(arguments) => info::run(&arguments),
        Command::Generate(arguments) => generate::run(&arguments),
        Command::Autopilot(arguments) => autopilot::run(&arguments),
        Command::Replay(arguments) => replay::run(&arguments),
        Command::Render(arguments) => render::run(&arguments),
        Command::Frames(arguments) => frames::run(&arguments, started),
    };
    finish(result)
}

/// The one place that prints what went wrong.
fn finish(result: Result<(), Failure>) -> ExitCode {
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            // If stderr is closed, the exit status still reports it.
            let _ = writeln!(std::io::stderr(), "maze-app: {failure}");
            failure.exit_code()
        }
    }
}

/// What is wrong with an unexpected argument: flags and a file without a subcommand take no other word.
fn misplaced(word: &str) -> String {
    let cli = Cli::command();
    // Among the words before, one that follows a flag may be the flag's value: only a subcommand's name is certain.
    match std::env::args().skip(2).find(|word| cli.find_subcommand(word).is_some()) {
        Some(name) => format!("the subcommand {name} must come first, before every flag and file"),
        None => format!("found a second file {word}: expected one maze"),
    }
}

/// Help and version go to stdout as they are; what is wrong becomes one line.
fn usage(error: &clap::Error) -> ExitCode {
    if !error.use_stderr() {
        return finish(files::print(&error.to_string()));
    }
    if let Some(ContextValue::String(word)) = error.get(ContextKind::InvalidSubcommand) {
        return finish(Err(Failure::bad_input(format!("{} (see --help)", misplaced(word)))));
    }
    let text = error.to_string();
    let reason = text.split("\n\n").next().unwrap_or_default();
    let reason: Vec<&str> = reason.split_whitespace().skip_while(|word| *word == "error:").collect();
    finish(Err(Failure::bad_input(format!("{} (see --help)", reason.join(" ")))))
}
