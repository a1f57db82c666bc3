//! The command `nearwall`: one file for each subcommand. This file selects it and prints errors. The binary and the
//! Python package call [`run`].

mod bench;
mod check;
mod compare;
mod diagnose;
mod init;
mod map;
mod materials;
mod predict;
mod progress;
mod report;
mod sensitivity;
mod simulate;

use std::ffi::OsString;
use std::io::Write;
use std::path::Path;

use clap::Parser;

use crate::dataset::RigMeasurements;

/// Result of a subcommand; the error's text names file, line or key and the remedy.
type CommandResult<T = ()> = Result<T, Box<dyn std::error::Error>>;

/// Defines [`Command`]; a subcommand has a line, with its name and its module, and there `Arguments` and `run`.
macro_rules! subcommands {
    ($($name:ident: $module:ident),* $(,)?) => {
        /// What happens when a particle hits a wall
        #[derive(Parser)]
        #[command(name = "nearwall", version, about, arg_required_else_help = true)]
        enum Command { $($name($module::Arguments),)* }

        impl Command {
            fn run(&self) -> CommandResult {
                match self { $(Self::$name(arguments) => $module::run(arguments),)* }
            }
        }
    };
}

subcommands! {
    Init: init,
    Predict: predict,
    Diagnose: diagnose,
    Compare: compare,
    Bench: bench,
    Simulate: simulate,
    Sensitivity: sensitivity,
    Map: map,
    Report: report,
    Materials: materials,
    Check: check,
}

/// Runs the command with its arguments, of which the first is its own name, and returns its exit status. 0: done, 1:
/// the input is at fault, 2: wrong usage.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    let command = match Command::try_parse_from(arguments) {
        Ok(command) => command,
        Err(usage) => {
            // A closed pipe is no fault of the usage.
            let _ = usage.print();
            return u8::try_from(usage.exit_code()).unwrap_or(2);
        }
    };
    match command.run() {
        Ok(()) => 0,
        Err(error) if is_broken_pipe(error.as_ref()) => 0,
        Err(error) => {
            eprintln!("nearwall: {error}");
            1
        }
    }
}

/// Prints a text; a closed pipe is an error, not a panic.
fn print(text: &str) -> CommandResult {
    Ok(std::io::stdout().write_all(text.as_bytes())?)
}

/// Prints a text and where a page is, as an absolute path for a browser.
fn print_page(text: &str, page: &Path) -> CommandResult {
    let page = std::path::absolute(page).unwrap_or_else(|_| page.to_owned());
    print(&format!("{text}open {}\n", page.display()))
}

/// Prints notes on standard error.
fn note<N: std::fmt::Display>(notes: impl IntoIterator<Item = N>) {
    for note in notes {
        eprintln!("nearwall: {note}");
    }
}

/// Keys and values of settings of a case, each given as `KEY=VALUE`.
fn case_settings(given: &[String]) -> Result<Vec<(String, String)>, String> {
    let one = |setting: &String| {
        let parts = setting.split_once('=').ok_or_else(|| format!("--set {setting}: give KEY=VALUE"))?;
        Ok((parts.0.trim().to_owned(), parts.1.trim().to_owned()))
    };
    given.iter().map(one).collect()
}

/// Reads the readings of a rig and prints the notes on them.
fn read_rig(path: &Path) -> Result<RigMeasurements, Box<dyn std::error::Error>> {
    let file = path.display().to_string();
    let source = std::fs::File::open(path).map_err(|error| format!("{file}: {error}"))?;
    let data = RigMeasurements::read(&file, source)?;
    note(&data.notes);
    Ok(data)
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
