//! Results of finished OpenFOAM cases as columns.

use std::path::{Path, PathBuf};

use nearwall_lab::results::openfoam::{impact_history, surfaces, table};
use pyo3::prelude::*;

use crate::table::{ForPython, TableCells, floats};
use crate::work::{Failure, run};

/// Folder of the tables in a case.
const TABLE_FOLDER: &str = "postProcessing/nearWallInteraction";

/// The clouds of a case that have tables.
#[pyfunction]
pub fn clouds(py: Python<'_>, case: PathBuf) -> PyResult<Vec<String>> {
    run(py, |_| {
        if !case.is_dir() {
            let problem = "there is no such folder; give the folder of a finished OpenFOAM case";
            return Err(format!("{}: {problem}", case.display()).into());
        }
        let folders = std::fs::read_dir(case.join(TABLE_FOLDER)).into_iter().flatten().flatten();
        let folders = folders.filter(|entry| entry.path().is_dir());
        let mut names: Vec<String> =
            folders.filter_map(|entry| entry.file_name().into_string().ok()).collect();
        names.sort();
        Ok(names)
    })
}

/// The tables `<name><ending>` of a cloud over all starts of the solver: the name, and its columns.
#[pyfunction]
pub fn tables(
    py: Python<'_>,
    case: PathBuf,
    cloud: &str,
    ending: &str,
    unlike: Vec<String>,
) -> PyResult<Vec<(String, Vec<ForPython>)>> {
    let folder = case.join(TABLE_FOLDER).join(cloud);
    let unlike: Vec<&str> = unlike.iter().map(String::as_str).collect();
    let found = run(py, |_| {
        let rows = table::histories(&folder, ending, &unlike, |row| {
            let cells: Vec<(String, String)> =
                row.cells().map(|(column, cell)| (column.to_owned(), cell.to_owned())).collect();
            Some((row.number("time_s")?, cells))
        });
        Ok::<_, Failure>(rows)
    })?;
    found
        .into_iter()
        .map(|history| {
            // A later start may have columns that an earlier one had not.
            let mut header: Vec<String> = Vec::new();
            for (column, _) in history.rows.iter().flat_map(|(_, row)| row) {
                if !header.contains(column) {
                    header.push(column.clone());
                }
            }
            let mut cells = TableCells::new(header.iter().cloned());
            for (_, row) in &history.rows {
                let cell = |name: &String| row.iter().find(|(column, _)| column == name);
                cells.push(header.iter().map(|name| cell(name).map_or("", |(_, cell)| cell.as_str())));
            }
            Ok((history.wall, cells.for_python(py)?))
        })
        .collect()
}

/// The fields `<cloud>:*` on the faces of the walls at a time [s], or at the last one.
#[pyfunction]
pub fn wall_fields(
    py: Python<'_>,
    case: PathBuf,
    cloud: &str,
    time: Option<f64>,
) -> PyResult<(f64, Vec<Option<String>>, Vec<ForPython>)> {
    let walls = run(py, |_| Ok(surfaces::read_fields(&case, cloud, time)?))?;
    let time = walls.first().map_or(f64::NAN, |wall| wall.time);
    let of_face = |wall: &surfaces::WallFields| vec![Some(wall.wall.clone()); wall.faces.len()];
    let patches = walls.iter().flat_map(of_face).collect();
    let faces = || walls.iter().flat_map(|wall| &wall.faces);
    let mut columns: Vec<(String, Vec<f64>)> = Vec::new();
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
        columns.push((name.to_owned(), faces().map(|face| face.centre[axis]).collect()));
    }
    columns.push(("area".to_owned(), faces().map(|face| face.area).collect()));
    let mut before = 0;
    for wall in &walls {
        for (field, values) in &wall.fields {
            let column = match columns.iter_mut().find(|(name, _)| name == field) {
                Some((_, column)) => column,
                None => {
                    columns.push((field.clone(), vec![f64::NAN; faces().count()]));
                    let Some((_, column)) = columns.last_mut() else { continue };
                    column
                }
            };
            column.iter_mut().skip(before).zip(values).for_each(|(place, value)| *place = *value);
        }
        before += wall.faces.len();
    }
    let columns = columns.into_iter().map(|(name, values)| (name, floats(py, &values))).collect();
    Ok((time, patches, columns))
}

/// The newest record of impacts of a case or a cloud: the path of its `impacts.csv`.
#[pyfunction]
pub fn record_file(py: Python<'_>, case: PathBuf, cloud: Option<String>) -> PyResult<PathBuf> {
    run(py, |_| Ok(impact_history::find(Path::new(&case), cloud.as_deref())?))
}
