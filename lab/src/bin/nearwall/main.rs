//! The command `nearwall`: one file for each subcommand. This file selects it and prints errors.

mod check;
mod compare;
mod diagnose;
mod diagnose_rig;
mod map;
mod materials;
mod predict;
mod progress;
mod report;
mod sensitivity;
mod simulate;

use std::io::Write;

use clap::Parser;

/// Result of a subcommand; the error's text names file, line or key and the remedy.
type CommandResult = Result<(), Box<dyn std::error::Error>>;

/// What happens when a particle hits a wall
#[derive(Parser)]
#[command(version, about, arg_required_else_help = true)]
enum Command {
    Predict(predict::Arguments),
    Diagnose(diagnose::Arguments),
    Compare(compare::Arguments),
    Simulate(simulate::Arguments),
    Sensitivity(sensitivity::Arguments),
    Map(map::Arguments),
    Report(report::Arguments),
    Materials(materials::Arguments),
    Check(check::Arguments),
}

/// Exit status 0: done, 1: the input is at fault, 2: wrong usage (from clap).
fn main() -> std::process::ExitCode {
    let done = match Command::parse() {
        Command::Predict(arguments) => predict::run(&arguments),
        Command::Diagnose(arguments) => diagnose::run(&arguments),
        Command::Compare(arguments) => compare::run(&arguments),
        Command::Simulate(arguments) => simulate::run(&arguments),
        Command::Sensitivity(arguments) => sensitivity::run(&arguments),
        Command::Map(arguments) => map::run(&arguments),
        Command::Report(arguments) => report::run(&arguments),
        Command::Materials(arguments) => materials::run(&arguments),
        Command::Check(arguments) => check::run(&arguments),
    };
    match done {
        Ok(()) => std::process::ExitCode::SUCCESS,
        Err(error) if is_broken_pipe(error.as_ref()) => std::process::ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("nearwall: {error}");
            std::process::ExitCode::FAILURE
        }
    }
}

/// Prints a text; a closed pipe is an error, not a panic.
fn print(text: &str) -> CommandResult {
    Ok(std::io::stdout().write_all(text.as_bytes())?)
}

/// Whether the reader of the output closed the pipe (`nearwall ... | head`), which is no fault of the input.
fn is_broken_pipe(error: &(dyn std::error::Error + 'static)) -> bool {
    let mut cause = Some(error);
    while let Some(error) = cause {
        if let Some(io) = error.downcast_ref::<std::io::Error>() {
            return io.kind() == std::io::ErrorKind::BrokenPipe;
        }
        if let Some(csv) = error.downcast_ref::<csv::Error>()
            && let csv::ErrorKind::Io(io) = csv.kind()
        {
            return io.kind() == std::io::ErrorKind::BrokenPipe;
        }
        cause = error.source();
    }
    false
}
