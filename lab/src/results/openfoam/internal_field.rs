//! The values of a field in the cells of a mesh: the entry `internalField` of a `volScalarField` or `volVectorField`.

use std::path::Path;

use super::foam_file::{Entries, FoamFile};

/// The values in all cells of a field with so many `parts`: 1 of a scalar, 3 of a vector; the parts of a cell stand side by side.
///
/// # Errors
/// File, fault and remedy.
pub(super) fn read(path: &Path, parts: usize, cells: usize) -> Result<Vec<f64>, String> {
    let mut file = FoamFile::open(path)?;
    while let Some(key) = file.word() {
        if key == "internalField" {
            return values(&mut file, parts, cells);
        }
        file.skip_value()?;
    }
    Err(file.fault("has no internalField"))
}

/// `uniform 1;`, `uniform (1 2 3);` or `nonuniform List<scalar> 2(1 2);`
fn values(file: &mut FoamFile, parts: usize, cells: usize) -> Result<Vec<f64>, String> {
    let found = match file.some_word()?.as_str() {
        "uniform" => file.entry(Entries::Scalars(parts))?.repeat(cells),
        "nonuniform" => {
            if file.peek() == Some(b'L') {
                file.expect(if parts == 1 { "List<scalar>" } else { "List<vector>" })?;
            }
            file.list(Entries::Scalars(parts))?.all(cells).unwrap_or_default()
        }
        other => {
            let fault = format!("has a value `{other}`, which is neither uniform nor nonuniform");
            return Err(file.fault(&fault));
        }
    };
    if found.len() != parts * cells {
        return Err(file.fault(&format!("has {} values for {cells} cells", found.len() / parts)));
    }
    Ok(found)
}
