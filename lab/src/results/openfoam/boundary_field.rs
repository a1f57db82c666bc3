//! The values of a `volScalarField` on the patches of a mesh.

use std::collections::BTreeMap;
use std::path::Path;

use super::foam_file::{Entries, FoamFile};

/// Values on the faces of patches, by their names.
pub(super) type PatchValues = BTreeMap<String, Vec<f64>>;

/// The values on the faces of each patch that has any, by its name; `faces` is the number of faces of each patch.
///
/// # Errors
/// File, fault and remedy.
pub(super) fn read(path: &Path, faces: &BTreeMap<String, usize>) -> Result<PatchValues, String> {
    let mut file = FoamFile::open(path)?;
    while let Some(key) = file.word() {
        if key == "boundaryField" {
            return patches(&mut file, faces);
        }
        file.skip_value()?;
    }
    Err(file.fault("has no boundaryField"))
}

fn patches(file: &mut FoamFile, faces: &BTreeMap<String, usize>) -> Result<PatchValues, String> {
    let mut values = BTreeMap::new();
    file.expect("{")?;
    loop {
        let patch = file.some_word()?;
        if patch == "}" {
            return Ok(values);
        }
        match faces.get(&patch) {
            Some(faces) => values.extend(value(file, *faces)?.map(|value| (patch, value))),
            None => file.skip_value()?,
        }
    }
}

/// The entry `value` of a patch with so many faces.
fn value(file: &mut FoamFile, faces: usize) -> Result<Option<Vec<f64>>, String> {
    let mut value = None;
    file.expect("{")?;
    loop {
        match file.some_word()?.as_str() {
            "}" => return Ok(value),
            "value" => value = Some(numbers(file, faces)?),
            _ => file.skip_value()?,
        }
    }
}

/// `uniform 1;` or `nonuniform List<scalar> 2(1 2);`, which may lack the type where the list is empty.
fn numbers(file: &mut FoamFile, faces: usize) -> Result<Vec<f64>, String> {
    let numbers = match file.some_word()?.as_str() {
        "uniform" => vec![file.number()?; faces],
        "nonuniform" => {
            if file.peek() == Some(b'L') {
                file.expect("List<scalar>")?;
            }
            file.list(Entries::Scalars(1))?.all(faces).unwrap_or_default()
        }
        other => {
            let fault = format!("has a value `{other}`, which is neither uniform nor nonuniform");
            return Err(file.fault(&fault));
        }
    };
    if numbers.len() != faces {
        return Err(file.fault(&format!("has {} values for {faces} faces", numbers.len())));
    }
    file.expect(";")?;
    Ok(numbers)
}
