//! `nearwall check`: checks a model file and describes it.

use std::path::PathBuf;

use nearwall::Model;

use super::CommandResult;

/// Checks a model file and describes its content
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
    super::print(&lines.join("\n"))
}
