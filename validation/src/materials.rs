//! Where every number of the material library comes from.

use crate::Result;
use nearwall::material::{Library, Material, Property};
use nearwall_lab::report::{BarChart, Figure, Table, number};

use crate::claim::Claim;
use crate::study::{self, Extent, SourceStudy, StudyPart};

/// Where a number comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum NumberOrigin {
    Published,
    PartlyAssumed,
    NotReRead,
    Assumed,
}

impl NumberOrigin {
    const ALL: [Self; 4] = [Self::Published, Self::PartlyAssumed, Self::NotReRead, Self::Assumed];

    /// As the source's own words tell it.
    fn of(source: &str) -> Self {
        if source.starts_with("assumed") || source.starts_with("estimated") {
            Self::Assumed
        } else if source.contains("not re-read") || source.contains("not checked") {
            Self::NotReRead
        } else if source.contains("assumed") {
            Self::PartlyAssumed
        } else {
            Self::Published
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Published => "published",
            Self::PartlyAssumed => "published, range assumed",
            Self::NotReRead => "cited, not re-read here",
            Self::Assumed => "assumed",
        }
    }
}

/// The study.
///
/// # Errors
/// When the built-in library cannot be read.
pub fn study(_: Extent) -> Result<SourceStudy> {
    let library = Library::built_in()?;
    let materials: Vec<&Material> = library.names().iter().filter_map(|name| library.get(name)).collect();
    let part = StudyPart {
        text: vec!["`nearwall materials NAME` prints the same values.".to_owned()],
        figures: vec![origins(&materials)],
        claims: vec![named(&materials)],
        tables: vec![table(&materials)],
        ..StudyPart::default()
    };
    Ok(SourceStudy {
        title: "Materials".to_owned(),
        source: "src/material/materials.toml".to_owned(),
        lead: lead(&materials),
        parts: vec![part],
    })
}

/// How many values of a material come from there.
fn count(material: &Material, origin: NumberOrigin) -> usize {
    let of = |property: &Property| NumberOrigin::of(property.source().unwrap_or(""));
    material.properties().filter(|(_, _, property)| of(property) == origin).count()
}

fn lead(materials: &[&Material]) -> String {
    let total = |origin| materials.iter().map(|material| count(material, origin)).sum::<usize>();
    let all: usize = NumberOrigin::ALL.map(total).iter().sum();
    let assumed = total(NumberOrigin::Assumed);
    format!(
        "Of {all} property values {} are published, in part or from sources that were not re-read, and \
         {assumed} are assumed. The most important assumed values are the yield strength of hot tungsten \
         and every mechanical number of char, ash and slag above 1000 K.",
        all - assumed
    )
}

fn origins(materials: &[&Material]) -> Figure {
    let names: Vec<String> = materials.iter().map(|material| material.name().to_owned()).collect();
    let mut bars = BarChart::new("Origin of the values", "property values", &names).stacked();
    for origin in NumberOrigin::ALL {
        let counts: Vec<f64> = materials.iter().map(|material| count(material, origin) as f64).collect();
        bars = bars.series(origin.name(), &counts);
    }
    bars.figure(
        "materials-origin",
        "One bar per material. A calculation with mostly assumed properties is a study of assumptions.",
    )
}

/// Whether every value says what it is.
fn named(materials: &[&Material]) -> Claim {
    let properties = || materials.iter().flat_map(|material| material.properties());
    let all = properties().count();
    let nameless = properties()
        .filter(|(_, unit, p)| unit.is_empty() || p.valid().is_none() || p.source().is_none_or(str::is_empty))
        .count();
    Claim::derived_statement(
        "library",
        "every number names unit, range of temperature and source, or says \"assumed\"",
        "all",
        &format!("{} of {all}", all - nameless),
        nameless == 0,
    )
}

fn table(materials: &[&Material]) -> Table {
    let row = |material: &Material, key: &str, unit: &str, property: &Property| {
        let [low, high] = property.valid().unwrap_or([f64::NAN; 2]);
        let at = |temperature| property.at(temperature).map_or_else(|_| "–".to_owned(), number);
        let value = if property.is_constant() { at(low) } else { format!("{} to {}", at(low), at(high)) };
        let uncertainty = property.uncertainty().map_or(String::new(), |u| format!(" ± {}", number(u)));
        let source = property.source().unwrap_or("");
        [
            material.name(),
            key,
            format!("{value}{uncertainty} {unit}").trim_end_matches(" 1"),
            &format!("{} to {}", number(low), number(high)),
            NumberOrigin::of(source).name(),
        ]
        .map(str::to_owned)
        .to_vec()
    };
    let rows = materials.iter().flat_map(|material| {
        material.properties().map(|(key, unit, property)| row(material, key, unit, property))
    });
    study::table(
        "Temperature-dependent properties are given at both ends of their range.",
        5,
        "material | property | value | range [K] | origin",
        rows.collect(),
    )
}
