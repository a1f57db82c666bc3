//! `nearwall materials`: the built-in materials with the source of each number.

use nearwall::material::{Library, Material, built_in_toml};
use nearwall::slag::surface_tension;

use super::CommandResult;

/// Lists the built-in materials, or shows one with its sources
#[derive(clap::Args)]
#[command(
    after_help = "Examples:\n  nearwall materials\n  nearwall materials tungsten --temperature 2000\n  \
nearwall materials coal-slag --toml"
)]
pub struct Arguments {
    /// The material to show
    name: Option<String>,
    /// Temperature [K] at which to evaluate
    #[arg(long, value_name = "K", default_value_t = 293.15)]
    temperature: f64,
    /// Print the material as a block for a model file
    #[arg(long, requires = "name", conflicts_with = "temperature")]
    toml: bool,
}

pub fn run(arguments: &Arguments) -> CommandResult {
    let library = Library::built_in()?;
    if !(arguments.temperature > 0.0 && arguments.temperature.is_finite()) {
        return Err(format!("--temperature {}: a positive number of kelvin", arguments.temperature).into());
    }
    let Some(name) = &arguments.name else {
        let line = |name: &&str| {
            let about = library.get(name).and_then(Material::about).unwrap_or("");
            format!("{name:<26} {about}\n")
        };
        return super::print(&library.names().iter().map(line).collect::<String>());
    };
    let Some(material) = library.get(name) else {
        return Err(library.unknown(name).into());
    };
    if arguments.toml {
        return super::print(&built_in_toml(name).unwrap_or_default());
    }
    super::print(&show(material, arguments.temperature))
}

/// Six digits; powers of ten where they are needed.
fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.5e}").parse().unwrap_or(value);
    if (1e-3..1e5).contains(&rounded.abs()) { format!("{rounded}") } else { format!("{rounded:e}") }
}

fn show(material: &Material, temperature: f64) -> String {
    let mut lines = vec![
        format!("{}: {}", material.name(), material.about().unwrap_or("")),
        format!("at {temperature} K"),
    ];
    for (key, unit, property) in material.properties() {
        let value = match property.at(temperature) {
            Ok(value) => format!("{} {unit}", short(value)),
            Err(range) => format!("not known at {temperature} K ({} to {} K)", range.low, range.high),
        };
        let uncertainty = property.uncertainty().map_or(String::new(), |u| format!(" ± {u:e} {unit}"));
        lines.push(format!("  {key:<16} {value}{uncertainty}"));
        if let Some([low, high]) = property.valid().filter(|[low, high]| low < high) {
            let outside = if property.holds_at(temperature) { "" } else { "; OUTSIDE at this temperature" };
            lines.push(format!("  {:<16}   stated for {low} to {high} K{outside}", ""));
        }
        lines.push(format!("  {:<16}   source: {}", "", property.source().unwrap_or("none given")));
    }
    if material.property("surface_tension").is_none()
        && let Some(tension) = material.surface_tension_near(temperature)
    {
        lines.push(format!("  {:<16} {} N/m", "surface_tension", short(tension)));
        lines.push(format!("  {:<16}   source: {}", "", surface_tension::ORIGIN));
    }
    if let Some(composition) = material.composition() {
        let oxides: Vec<String> =
            composition.oxides().map(|(oxide, share)| format!("{} {share:.1}", oxide.name())).collect();
        lines.push(format!("  {:<16} {} (wt%)", "composition", oxides.join(", ")));
    }
    let fusion = material.given_or_estimated_fusion();
    let fusion = fusion.map(|found| found.map_or_else(|none| none.to_string(), |known| known.describe()));
    lines.extend(fusion.map(|fusion| format!("  {:<16} {fusion}", "fusion")));
    lines.push(String::new());
    lines.join("\n")
}
