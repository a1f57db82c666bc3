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
    lines.push(format!("  particle    {}", model.particle().name()));
    for wall in model.walls() {
        lines.push(format!("  wall        {} of {}", wall.name(), wall.material().name()));
    }
    lines.push(format!("  normal      {}", model.normal_law().name()));
    lines.push(format!("  tangential  {}", model.tangential_law().name()));
    for term in model.terms() {
        let parameters: Vec<String> = term
            .kind()
            .parameters
            .iter()
            .zip(term.values())
            .map(|(parameter, value)| format!("{} = {value} {}", parameter.name, parameter.unit))
            .collect();
        lines.push(format!("  effect      {}: {}", term.kind().id, parameters.join(", ")));
    }
    lines.push(String::new());
    crate::print(&lines.join("\n"))
}
