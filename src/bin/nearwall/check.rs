//! `nearwall check`: whether a model file is accepted, and what it says.

use std::path::PathBuf;

use nearwall::Model;

use crate::CommandResult;

/// Checks a model file and says what it contains
#[derive(clap::Args)]
#[command(after_help = "Example:\n  nearwall check wax.toml")]
pub struct Arguments {
    /// The model file
    model: PathBuf,
}

pub fn run(arguments: &Arguments) -> CommandResult {
    let model = Model::from_file(&arguments.model)?;
    let mut lines = vec![format!("{}: accepted", arguments.model.display())];
    lines.extend(model.describe().into_iter().map(|(what, text)| format!("  {what:<11} {text}")));
    lines.push(String::new());
    crate::print(&lines.join("\n"))
}
