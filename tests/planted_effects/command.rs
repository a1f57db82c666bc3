//! Runs the command under test.

use std::path::Path;
use std::process::{Command, Output};

/// The command in this folder: that of this build, or the one that `NEARWALL_COMMAND` names.
pub fn nearwall(folder: &Path, arguments: &[&str]) -> Output {
    let command = std::env::var_os("NEARWALL_COMMAND");
    let command = command.unwrap_or_else(|| env!("CARGO_BIN_EXE_nearwall").into());
    Command::new(command).current_dir(folder).args(arguments).output().unwrap()
}
