//! `nearwall materials`: the built-in materials and those of a model file, with the source of each number.

use std::path::PathBuf;

use nearwall::input::Document;
use nearwall::material::{Library, Material, built_in_toml};
use nearwall::slag::critical_viscosity_temperature::watt;
use nearwall::slag::{Composition, SlagViscosity, VISCOSITY_LAWS, surface_tension};

use super::CommandResult;

/// Lists the materials, or shows one with its sources
#[derive(clap::Args)]
#[command(
    after_help = "Examples:\n  nearwall materials\n  nearwall materials tungsten --temperature 2000\n  \
nearwall materials coal-slag --toml\n  nearwall materials my-ash --model plant.toml --temperature 1600"
)]
pub struct Arguments {
    /// The material to show
    name: Option<String>,
    /// Temperature [K] at which to evaluate
    #[arg(long, value_name = "K", default_value_t = 293.15)]
    temperature: f64,
    /// A model file: its own materials, too
    #[arg(long, value_name = "MODEL.toml")]
    model: Option<PathBuf>,
    /// Print a built-in material as a block for a model file
    #[arg(long, requires = "name", conflicts_with_all = ["temperature", "model"])]
    toml: bool,
}

pub fn run(arguments: &Arguments) -> CommandResult {
    let library = match &arguments.model {
        Some(file) => Library::of_file(&Document::from_file(file)?)?,
        None => Library::built_in()?,
    };
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

/// Digits of a property.
const DIGITS: usize = 6;

/// A number with so many digits; powers of ten where they are needed.
fn short(value: f64, digits: usize) -> String {
    let rounded: f64 = format!("{value:.*e}", digits - 1).parse().unwrap_or(value);
    if (1e-3..1e5).contains(&rounded.abs()) { format!("{rounded}") } else { format!("{rounded:e}") }
}

fn show(material: &Material, temperature: f64) -> String {
    let mut lines = vec![
        format!("{}: {}", material.name(), material.about().unwrap_or("")),
        format!("at {temperature} K"),
    ];
    for (key, unit, property) in material.properties() {
        let value = match property.at(temperature) {
            Ok(value) => format!("{} {unit}", short(value, DIGITS)),
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
        lines.push(format!("  {:<16} {} N/m", "surface_tension", short(tension, DIGITS)));
        lines.push(format!("  {:<16}   source: {}", "", surface_tension::ORIGIN));
    }
    if let Some(composition) = material.composition() {
        let oxides: Vec<String> =
            composition.oxides().map(|(oxide, share)| format!("{} {share:.1}", oxide.name())).collect();
        lines.push(format!("  {:<16} {} (wt%)", "composition", oxides.join(", ")));
        lines.extend(melt_table(composition));
    }
    let fusion = material.given_or_estimated_fusion();
    let fusion = fusion.map(|found| found.map_or_else(|none| none.to_string(), |known| known.describe()));
    lines.extend(fusion.map(|fusion| format!("  {:<16} {fusion}", "fusion")));
    lines.push(String::new());
    lines.join("\n")
}

/// Digits of a viscosity, which laws know within a factor.
const MELT_DIGITS: usize = 3;
/// Temperatures [K] of the table of viscosities.
const MELT_TEMPERATURES: [f64; 7] = [1300.0, 1400.0, 1500.0, 1600.0, 1700.0, 1800.0, 1900.0];
/// Viscosity of tapping [Pa s]: the temperature at which a slag has it is the "T250" (250 poise).
const TAPPING: f64 = 25.0;
/// That temperature is sought between these [K].
const MELT_RANGE: [f64; 2] = [900.0, 2500.0];

/// The viscosity of a composition by every law over temperature, and where it is stiff.
fn melt_table(composition: &Composition) -> Vec<String> {
    let laws: Vec<SlagViscosity> =
        VISCOSITY_LAWS.iter().filter_map(|law| SlagViscosity::new(law, composition).ok()).collect();
    if laws.is_empty() {
        return Vec::new();
    }
    let row = |first: &str, cell: &dyn Fn(&SlagViscosity) -> String| {
        let cells = laws.iter().map(|law| format!("{:>1$}", cell(law), law.law().name.len().max(9) + 2));
        format!("  {:<16} {first:>8}{}", "", cells.collect::<String>())
    };
    let marked = |law: &SlagViscosity, temperature: f64, text: String| {
        if law.holds_at(temperature) { format!("{text} ") } else { format!("{text}*") }
    };
    let mut lines = vec![
        format!("  {:<16} [Pa s] by the laws of [capture]; * outside their stated range", "viscosity"),
        row("T [K]", &|law| format!("{} ", law.law().name)),
    ];
    lines.extend(MELT_TEMPERATURES.map(|temperature| {
        row(&temperature.to_string(), &|law| {
            marked(law, temperature, short(law.at(temperature), MELT_DIGITS))
        })
    }));
    lines.push(row("T250 [K]", &|law| match temperature_of(law, TAPPING) {
        Some(temperature) => marked(law, temperature, format!("{temperature:.0}")),
        None => "- ".to_owned(),
    }));
    lines.push(format!("  {:<16}   T250: {TAPPING} Pa s, the limit of tapping", ""));
    lines.extend(watt(composition).map(|stiff| {
        format!("  {:<16} stiff below {stiff:.0} K (temperature of critical viscosity, Watt)", "")
    }));
    lines
}

/// The temperature [K] at which a slag has a viscosity [Pa s]: viscosity falls with temperature.
fn temperature_of(slag: &SlagViscosity, viscosity: f64) -> Option<f64> {
    let [mut low, mut high] = MELT_RANGE;
    if !(slag.at(low) > viscosity && slag.at(high) < viscosity) {
        return None;
    }
    while high - low > 0.1 {
        let middle = 0.5 * (low + high);
        if slag.at(middle) > viscosity { low = middle } else { high = middle }
    }
    Some(low)
}
