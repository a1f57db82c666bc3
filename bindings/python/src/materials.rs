//! `materials`: the built-in materials with the source of each number.

use nearwall::input::unknown;
use nearwall::material::{Library, Material};
use pyo3::prelude::*;

use crate::work::error;

/// Key, unit, value, uncertainty, known range, stated range, source.
type PropertyOf = (
    &'static str,
    &'static str,
    Option<f64>,
    Option<f64>,
    Option<[f64; 2]>,
    Option<[f64; 2]>,
    Option<String>,
);
/// Name, description, properties, oxides with their shares [wt%].
type MaterialOf = (String, Option<String>, Vec<PropertyOf>, Vec<(String, f64)>);

/// All built-in materials, or the one named, at a temperature [K].
#[pyfunction]
pub fn materials(py: Python<'_>, name: Option<&str>, temperature: f64) -> PyResult<Vec<MaterialOf>> {
    let library = Library::built_in().map_err(|fault| error(py, &fault.to_string()))?;
    if !(temperature > 0.0 && temperature.is_finite()) {
        return Err(error(py, &format!("temperature {temperature}: a positive number of kelvin")));
    }
    let names = name.map_or_else(|| library.names(), |name| vec![name]);
    let found = names
        .into_iter()
        .map(|name| library.get(name).ok_or_else(|| error(py, &unknown(name, "material", &library.names()))));
    found.map(|material| material.map(|material| of(material, temperature))).collect()
}

fn of(material: &Material, temperature: f64) -> MaterialOf {
    let properties = material.properties().map(|(key, unit, property)| {
        let source = property.source().map(str::to_owned);
        let value = property.at(temperature).ok();
        (key, unit, value, property.uncertainty(), property.known_range(), property.valid(), source)
    });
    let oxides = material.composition().into_iter().flat_map(|composition| composition.oxides());
    let oxides = oxides.map(|(oxide, share)| (oxide.name().to_owned(), share)).collect();
    (material.name().to_owned(), material.about().map(str::to_owned), properties.collect(), oxides)
}
