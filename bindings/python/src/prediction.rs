//! `predict`: what the command `nearwall predict` adds to a table of impacts.

use std::path::Path;

use nearwall::Model;
use nearwall::dataset::{ImpactReader, Row, WallChoice, assumed, unlikely};
use nearwall::model::ExtraInput;
use nearwall::rig::{Band, DrawnModels};
use pyo3::prelude::*;

use crate::table::{Cells, ForPython, Source, floats};
use crate::work::{Failure, run};

/// Draws of what a model draws by chance, for the mean of each row; the command's number.
const DRAWS: usize = 64;
/// The columns that are numbers; those of the bands are there with drawn models only.
const NUMBERS: [&str; 9] =
    ["e_n", "e_t", "p_stick", "e_n_low", "e_n_high", "e_t_low", "e_t_high", "p_stick_low", "p_stick_high"];

/// Columns of the file, if it was one; added columns of numbers; regimes; rows left out, with their lines; notes.
type Predicted =
    (Option<Vec<ForPython>>, Vec<ForPython>, Vec<Option<&'static str>>, Vec<(u64, String)>, Vec<String>);

/// The same before it becomes Python's.
#[derive(Default)]
struct Prediction {
    numbers: Vec<Vec<f64>>,
    regimes: Vec<Option<&'static str>>,
    left_out: Vec<(u64, String)>,
    notes: Vec<String>,
    outside: usize,
}

/// Predicts each row of a table. A row that cannot be used has NaN.
#[pyfunction]
pub fn predict(
    py: Python<'_>,
    model: (String, String),
    data: Source,
    wall: Option<String>,
    draws: Option<String>,
) -> PyResult<Predicted> {
    let (cells, predicted) =
        run(py, |tick| predict_rows(&model, &data, wall.as_deref(), draws.as_deref(), tick))?;
    let Prediction { numbers, regimes, left_out, notes, .. } = predicted;
    let columns = NUMBERS.iter().zip(&numbers).map(|(name, values)| ((*name).to_owned(), floats(py, values)));
    let columns = columns.collect();
    let cells = cells.map(|cells| cells.for_python(py)).transpose()?;
    Ok((cells, columns, regimes, left_out, notes))
}

fn predict_rows(
    (name, text): &(String, String),
    data: &Source,
    wall: Option<&str>,
    draws: Option<&str>,
    tick: &(dyn Fn() + Sync),
) -> Result<(Option<Cells>, Prediction), Failure> {
    let model = Model::from_toml(name, text)?;
    let file = data.name();
    let mut reader = ImpactReader::new(file, data.open()?)?.with_extra_inputs(model.extra_inputs());
    let (walls, column) = (WallChoice::new(&model, wall)?, reader.column("wall"));
    walls.check(column.is_some())?;
    let drawn = draws.map(|folder| DrawnModels::from_folder(Path::new(folder), &model)).transpose()?;
    let drawn = drawn.as_ref().map_or(&[][..], |drawn| &drawn.models);
    let mut cells = match data {
        Source::File(_) => Some(Cells::new(reader.headers().iter().map(str::to_owned))),
        Source::Columns(_) => None,
    };
    let width = if drawn.is_empty() { 3 } else { NUMBERS.len() };
    let mut found = Prediction {
        numbers: vec![Vec::new(); width],
        notes: assumptions(file, &reader),
        ..Prediction::default()
    };
    let (mut warning, mut unknown) = (None, None);
    while let Some(next) = reader.next_row()? {
        tick();
        let predicted = next.map_err(|bad| (bad.line, bad.reason)).and_then(|row| {
            warning = warning.take().or_else(|| unlikely(row.line, &row.impact));
            unknown = unknown.take().or_else(|| unknown_label(&model, &row));
            let wall = walls.of(column.and_then(|column| row.cells.get(column)));
            let wall = wall.map_err(|error| (row.line, error.to_string()))?;
            predict_row(&model, drawn, wall, &row, &mut found).map_err(|reason| (row.line, reason))?;
            Ok(row)
        });
        match predicted {
            Ok(row) => {
                if let Some(cells) = &mut cells {
                    cells.push(&row.cells);
                }
            }
            Err(bad) => {
                // The rows of a frame keep their places; those of a file are left out, as by the command.
                if cells.is_none() {
                    found.numbers.iter_mut().for_each(|column| column.push(f64::NAN));
                    found.regimes.push(None);
                }
                found.left_out.push(bad);
            }
        }
    }
    finish(&mut found, warning, unknown)?;
    Ok((cells, found))
}

fn predict_row(
    model: &Model,
    drawn: &[Model],
    wall: usize,
    row: &Row,
    found: &mut Prediction,
) -> Result<(), String> {
    let expect = |model: &Model| {
        let mean = model.expect(wall, &row.impact, DRAWS).map_err(|error| error.to_string())?;
        let values = [mean.normal_restitution, mean.tangential_restitution, mean.sticking_probability];
        Ok::<_, String>((values, mean))
    };
    let (values, mean) = expect(model)?;
    let mut numbers = values.to_vec();
    if !drawn.is_empty() {
        let of_draws = drawn.iter().map(|model| expect(model).map(|(values, _)| values));
        let of_draws: Vec<[f64; 3]> = of_draws.collect::<Result<_, _>>()?;
        for which in 0..values.len() {
            let Band { low, high, .. } = Band::of(of_draws.iter().map(|values| values[which]).collect());
            numbers.extend([low, high]);
        }
    }
    found.numbers.iter_mut().zip(numbers).for_each(|(column, number)| column.push(number));
    found.regimes.push(Some(mean.regime.name()));
    found.outside += usize::from(mean.outside_range);
    Ok(())
}

/// Unused columns that resemble an input, and the assumed values of absent inputs.
fn assumptions(file: &str, reader: &ImpactReader<impl std::io::Read>) -> Vec<String> {
    let near = |(column, input): (&str, &str)| {
        format!("{file}: column `{column}` is not used; rename it if it is the input `{input}` in SI units")
    };
    let mut notes: Vec<String> = reader.near_misses().into_iter().map(near).collect();
    let own = reader.absent_extra().filter_map(ExtraInput::describe_default);
    let assumed: Vec<String> = assumed(&reader.absent()).into_iter().chain(own).collect();
    if !assumed.is_empty() {
        notes.push(format!("not in {file}, assumed: {}", assumed.join(", ")));
    }
    notes
}

/// A warning if a row has a word that the model file does not list.
fn unknown_label(model: &Model, row: &Row) -> Option<String> {
    let mut extra = model.extra_inputs().iter().zip(row.impact.extra.iter());
    let (input, _) = extra.find(|(input, value)| input.is_unknown(**value))?;
    let (line, name, known) = (row.line, &input.name, input.labels.join(", "));
    Some(format!("line {line}: {name} is none of {known}; such rows are predicted without it"))
}

fn finish(found: &mut Prediction, warning: Option<String>, unknown: Option<String>) -> Result<(), Failure> {
    let done = found.regimes.iter().filter(|regime| regime.is_some()).count();
    found.notes.extend(warning.into_iter().chain(unknown));
    if found.outside > 0 {
        found.notes.push(format!(
            "{} of {done} rows lie outside the valid range of a property, a law or a fitted term",
            found.outside
        ));
    }
    if done == 0 {
        let first = found.left_out.first().map(|(line, reason)| format!("; line {line}: {reason}"));
        return Err(format!("no row could be used{}", first.unwrap_or_default()).into());
    }
    Ok(())
}
