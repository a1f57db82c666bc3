//! The readings of a measured set, and what another program is told of each.

use nearwall::impact::{INPUTS, Impact};
use nearwall::material::Mechanical;
use nearwall::model::Model;

use super::super::constants::ROW_DRAWS;
use super::super::data_split::DataSplit;
use super::super::fitted_rows::{FittedRows, first_line};
use super::super::observable::Observable;
use super::BenchmarkError;
use super::measured_set::MeasuredSet;
use super::reading::readings;
use crate::dataset::{Measurement, Measurements};

/// A measured set as readings.
pub(super) struct ReadSet {
    pub name: String,
    /// Place of its source.
    pub source: usize,
    /// The text of its base model: materials and walls.
    pub base: String,
    /// A row for each reading.
    pub data: DataSplit,
    /// What each reading is of.
    pub observables: Vec<Observable>,
    /// The table.
    measured: Measurements,
}

impl ReadSet {
    /// Reads a set; `sources` are those so far.
    pub fn new(set: MeasuredSet, sources: &mut Vec<String>) -> Result<Self, BenchmarkError> {
        let fault = |problem: String| BenchmarkError::Set { set: set.name.clone(), problem };
        let model = Model::from_toml("base.toml", &set.base).map_err(|error| fault(error.to_string()))?;
        let read = set.read(&model)?;
        if let Some(bad) = read.rejected.first() {
            return Err(fault(format!("data.csv:{}: {}", bad.line, bad.reason)));
        }
        let (observables, rows): (Vec<_>, Vec<_>) = read.rows.iter().flat_map(readings).unzip();
        let source = sources.iter().position(|known| *known == set.source).unwrap_or_else(|| {
            sources.push(set.source.clone());
            sources.len() - 1
        });
        let data = DataSplit::bare(&model, &rows, ROW_DRAWS);
        Ok(Self { name: set.name, source, base: set.base.into_owned(), data, observables, measured: read })
    }

    /// Number of readings.
    pub fn count(&self) -> usize {
        self.observables.len()
    }

    /// Whether the table states an input, with which a law may fail.
    pub fn states(&self, input: &str) -> bool {
        self.measured.given.contains(&input)
    }

    /// Whether some of its rows are among those that fitted a model.
    pub fn fitted(&self, rows: &FittedRows) -> bool {
        let first = first_line(&self.measured);
        self.measured.rows.iter().any(|row| rows.contains(row, first))
    }
}

/// Mechanical properties in the columns of particle (`_p`) and wall (`_w`) [SI]; the density is `rho_p`.
const PROPERTIES: [&str; 4] = ["youngs_modulus", "poisson_ratio", "yield_strength", "surface_energy"];

fn properties(of: &Mechanical) -> [f64; 4] {
    [of.youngs_modulus, of.poisson_ratio, of.yield_strength, of.surface_energy]
}

/// Every reading as a table for another program: set, materials, inputs and mechanical properties [SI].
pub(super) fn impacts(sets: &[ReadSet]) -> Result<String, BenchmarkError> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let mut header: Vec<String> = ["set", "particle", "wall"].map(str::to_owned).to_vec();
    header.extend(INPUTS.iter().map(|input| input.name.to_owned()));
    header.extend(["p", "w"].iter().flat_map(|of| PROPERTIES.map(|name| format!("{name}_{of}"))));
    writer.write_record(&header)?;
    for set in sets {
        for row in set.data.rows.iter() {
            writer.write_record(line(set, row))?;
        }
    }
    let text = writer.into_inner().map_err(csv::IntoInnerError::into_error).map_err(csv::Error::from)?;
    Ok(String::from_utf8_lossy(&text).into_owned())
}

fn line(set: &ReadSet, row: &Measurement) -> Vec<String> {
    let model = &set.data.base;
    let wall = &model.walls()[row.wall];
    let density = model.particle_density(&row.impact).unwrap_or(0.0);
    let impact = Impact { particle_density: density, ..row.impact };
    let mut cells =
        vec![set.name.clone(), model.particle().name().to_owned(), wall.material().name().to_owned()];
    cells.extend(INPUTS.iter().map(|input| (input.value)(&impact).to_string()));
    let solids =
        [(model.particle(), impact.particle_temperature), (wall.material(), impact.wall_temperature)];
    for (material, temperature) in solids {
        // Blank where the material is not known at this temperature.
        let known = material.mechanical(temperature).ok();
        let cell =
            |place: usize| known.as_ref().map_or_else(String::new, |one| properties(one)[place].to_string());
        cells.extend((0..PROPERTIES.len()).map(cell));
    }
    cells
}
