//! The fields that a cloud's wall model writes on the faces of the walls, at the last time that has any.

use std::collections::BTreeMap;
use std::path::Path;

use super::foam_file::{FoamError, FoamFile, is_written};
use super::mesh::Patch;
use super::written_time::{WrittenTime, has_collated};
use crate::results::surface::{SurfaceQuantity, WallFace, WallSurface};

/// All fields of a cloud on the walls: those that are always written, then those of a wall with
/// memory; and the quantity that a page shows of them. Fields of one quantity are added up.
const WALL_FIELDS: [(&str, Option<SurfaceQuantity>); 17] = [
    ("depositedMass", Some(SurfaceQuantity::Captured)),
    ("hitCount", None),
    ("meanImpactSpeed", None),
    ("erodedDepth", None),
    ("moltenMass", Some(SurfaceQuantity::Deposit)),
    ("frozenMass", Some(SurfaceQuantity::Deposit)),
    ("powderMass", Some(SurfaceQuantity::Deposit)),
    ("enclosedShare", None),
    ("layerThickness", Some(SurfaceQuantity::Layer)),
    ("coverArea", None),
    ("coverage", None),
    ("depositConversion", None),
    ("wallTemperature", Some(SurfaceQuantity::Temperature)),
    ("closedVoids", None),
    ("wallHeatFlux", Some(SurfaceQuantity::HeatFlux)),
    ("underTemperature", None),
    ("resuspendedShare", None),
];

/// Quantities in the order of a page.
const SHOWN: [SurfaceQuantity; 5] = [
    SurfaceQuantity::Deposit,
    SurfaceQuantity::Captured,
    SurfaceQuantity::Layer,
    SurfaceQuantity::Temperature,
    SurfaceQuantity::HeatFlux,
];

/// Why there are no fields on the walls.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum SurfaceError {
    /// A file that is damaged or compressed.
    #[error(transparent)]
    Unreadable(#[from] FoamError),
    /// The same, for the page.
    #[error("{0}. Until then there are no maps of the walls")]
    NoMaps(FoamError),
    /// The fields of all ranks are in one file each.
    #[error(
        "{0}: the fields of all ranks are in one file each (collated), which are not read; run reconstructPar for \
            maps of the walls"
    )]
    Collated(String),
    /// The case has no fields of this cloud, at this time if one is wanted.
    #[error("{0}: no fields {1}:* on the walls{2}; nearWallInteraction writes them with `writeFields yes`")]
    NoFields(String, String, String),
}

/// The fields of a cloud on the faces of a wall, as they are written.
#[derive(Debug, Clone, PartialEq)]
pub struct WallFields {
    /// Name of the patch.
    pub wall: String,
    /// Time [s], or number of iterations.
    pub time: f64,
    /// Its faces.
    pub faces: Vec<WallFace>,
    /// Names of the fields without that of the cloud, and their values on each face.
    pub fields: Vec<(String, Vec<f64>)>,
}

/// Reads every field of a cloud on every patch of type `wall`, at a time [s] or at the last one with any.
///
/// # Errors
/// [`SurfaceError`].
pub fn read_fields(case: &Path, cloud: &str, time: Option<f64>) -> Result<Vec<WallFields>, SurfaceError> {
    let Some(source) = last(case, cloud, time)? else {
        let at = time.map_or(String::new(), |time| format!(" at time {time}"));
        return Err(SurfaceError::NoFields(case.display().to_string(), cloud.to_owned(), at));
    };
    Ok(read(&source, cloud, |_| true, |patch, _| patch.kind == "wall")?)
}

/// Reads the walls on which any of the fields is not zero; none when the case has no such fields.
///
/// # Errors
/// [`SurfaceError`].
pub fn read_last(case: &Path, cloud: &str) -> Result<Vec<WallSurface>, SurfaceError> {
    let Some(source) = last(case, cloud, None)? else { return Ok(Vec::new()) };
    let walls = read(&source, cloud, |quantity| quantity.is_some(), |_, has_values| has_values);
    let mut walls: Vec<WallSurface> =
        walls.map_err(SurfaceError::NoMaps)?.into_iter().map(with_quantities).collect();
    walls.retain(|wall| wall.quantities.iter().any(|(_, values)| values.iter().any(|value| *value != 0.0)));
    // A wall with memory shows its present deposit, not what was ever captured.
    for WallSurface { quantities, .. } in &mut walls {
        if quantities.iter().any(|(quantity, _)| *quantity == SurfaceQuantity::Deposit) {
            quantities.retain(|(quantity, _)| *quantity != SurfaceQuantity::Captured);
        }
    }
    Ok(walls)
}

/// The quantities of the fields.
fn with_quantities(wall: WallFields) -> WallSurface {
    let WallFields { wall, time, faces, fields } = wall;
    let sum = |quantity: SurfaceQuantity| {
        let is_part = |name: &str| WALL_FIELDS.contains(&(name, Some(quantity)));
        let parts: Vec<&Vec<f64>> =
            fields.iter().filter(|(name, _)| is_part(name)).map(|(_, values)| values).collect();
        let total = |face: usize| parts.iter().map(|values| values[face]).sum();
        (!parts.is_empty()).then(|| (quantity, (0..faces.len()).map(total).collect()))
    };
    let quantities = SHOWN.into_iter().filter_map(sum).collect();
    WallSurface { wall, time, faces, quantities, captured: None }
}

/// The last time with any of the fields that a page shows, or `wanted` [s] if it has any.
fn last(case: &Path, cloud: &str, wanted: Option<f64>) -> Result<Option<WrittenTime>, SurfaceError> {
    let has_fields = |folder: &Path| {
        let mut shown = WALL_FIELDS.iter().filter(|(_, quantity)| quantity.is_some());
        shown.any(|(field, _)| is_written(&folder.join(format!("{cloud}:{field}"))))
    };
    // Names of folders are rounded.
    let is_wanted = |time: f64| wanted.is_none_or(|wanted| (time - wanted).abs() <= 1e-6 * wanted.abs());
    let source = WrittenTime::last(case, |time, folder| is_wanted(time) && has_fields(folder));
    if source.is_none() && has_collated(case) {
        return Err(SurfaceError::Collated(case.display().to_string()));
    }
    Ok(source)
}

/// The wanted fields on the wanted patches, which may depend on whether a patch has any value;
/// values that are absent are 0.
fn read(
    source: &WrittenTime,
    cloud: &str,
    is_field: impl Fn(Option<SurfaceQuantity>) -> bool,
    is_patch: impl Fn(&Patch, bool) -> bool,
) -> Result<Vec<WallFields>, FoamError> {
    let mut walls: Vec<WallFields> = Vec::new();
    for root in &source.roots {
        let mesh = source.mesh(root);
        let patches = mesh.patches()?;
        let mut fields = Vec::new();
        for (field, _) in WALL_FIELDS.iter().filter(|(_, quantity)| is_field(*quantity)) {
            let path = source.file(root, &format!("{cloud}:{field}"));
            if is_written(&path) {
                fields.push(((*field).to_owned(), patch_values(&path, &patches)?));
            }
        }
        let has_values = |patch: &Patch| fields.iter().any(|(_, values)| values.contains_key(&patch.name));
        let wanted: Vec<&Patch> = patches.iter().filter(|patch| is_patch(patch, has_values(patch))).collect();
        let mut faces = mesh.wall_faces(&wanted)?;
        for patch in wanted {
            let of_patch = |(field, values): &(String, PatchValues)| {
                let none = || vec![0.0; patch.faces];
                (field.clone(), values.get(&patch.name).cloned().unwrap_or_else(none))
            };
            let wall = WallFields {
                wall: patch.name.clone(),
                time: source.time,
                faces: faces.remove(&patch.name).unwrap_or_default(),
                fields: fields.iter().map(of_patch).collect(),
            };
            add(&mut walls, wall);
        }
    }
    Ok(walls)
}

/// Adds a wall, or to the same wall of another rank its faces.
fn add(walls: &mut Vec<WallFields>, wall: WallFields) {
    match walls.iter_mut().find(|other| other.wall == wall.wall) {
        Some(other) => {
            other.faces.extend(wall.faces);
            for ((_, values), (_, new)) in other.fields.iter_mut().zip(wall.fields) {
                values.extend(new);
            }
        }
        None => walls.push(wall),
    }
}

/// Values on the faces of patches, by their names.
type PatchValues = BTreeMap<String, Vec<f64>>;

/// The entries `value` of a `volScalarField` on the patches that have one.
fn patch_values(path: &Path, patches: &[Patch]) -> Result<PatchValues, FoamError> {
    let mut file = FoamFile::open(path)?;
    file.seek("boundaryField")?;
    file.expect("{")?;
    let mut values = BTreeMap::new();
    loop {
        let name = file.some_word()?;
        if name == "}" {
            return Ok(values);
        }
        let Some(patch) = patches.iter().find(|patch| patch.name == name) else {
            file.skip_value()?;
            continue;
        };
        file.expect("{")?;
        loop {
            match file.some_word()?.as_str() {
                "}" => break,
                "value" => {
                    values.insert(name.clone(), file.field_values(1, patch.faces, "faces")?);
                }
                _ => file.skip_value()?,
            }
        }
    }
}
