//! The fields that a cloud's wall model writes on the faces of the walls, at the last time that has any.
//!
//! They are read from the case or, when it is decomposed and not reconstructed up to that time, from the folders of the ranks.

use std::path::{Path, PathBuf};

use super::boundary_field::PatchValues;
use super::foam_file::is_written;
use super::mesh::{Mesh, Patch};
use super::{boundary_field, entries, file_name, time_folders};
use crate::results::surface::{Quantity, WallFace, WallSurface};

/// Fields and what they are; those of one quantity are added up.
const FIELDS: [(&str, Quantity); 6] = [
    ("moltenMass", Quantity::Deposit),
    ("powderMass", Quantity::Deposit),
    ("depositedMass", Quantity::Captured),
    ("layerThickness", Quantity::Layer),
    ("wallTemperature", Quantity::Temperature),
    ("wallHeatFlux", Quantity::HeatFlux),
];

/// All fields of a cloud on the walls: those that are always written, then those of a wall with memory.
const ALL_FIELDS: [&str; 14] = [
    "depositedMass",
    "hitCount",
    "meanImpactSpeed",
    "erodedDepth",
    "moltenMass",
    "powderMass",
    "layerThickness",
    "coverArea",
    "coverage",
    "depositConversion",
    "wallTemperature",
    "closedVoids",
    "wallHeatFlux",
    "resuspendedShare",
];

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
/// File, fault and remedy; also when there are no such fields.
pub fn read_fields(case: &Path, cloud: &str, time: Option<f64>) -> Result<Vec<WallFields>, String> {
    let Some(source) = Source::of(case, cloud, time)? else {
        let at = time.map_or(String::new(), |time| format!(" at time {time}"));
        return Err(format!(
            "{}: no fields {cloud}:* on the walls{at}; nearWallInteraction writes them with `writeFields yes`",
            case.display()
        ));
    };
    let mut walls: Vec<WallFields> = Vec::new();
    for root in &source.roots {
        for wall in source.read_all(root, cloud)? {
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
    }
    Ok(walls)
}

/// Reads the walls on which any of the fields is not zero; none when the case has no such fields.
///
/// # Errors
/// File, fault and remedy, for the page.
pub fn read_last(case: &Path, cloud: &str) -> Result<Vec<WallSurface>, String> {
    let unreadable = |reason: String| format!("{reason}. Until then there are no maps of the walls");
    let Some(source) = Source::of(case, cloud, None)? else { return Ok(Vec::new()) };
    let mut walls: Vec<WallSurface> = Vec::new();
    for root in &source.roots {
        for wall in source.read(root, cloud).map_err(unreadable)? {
            match walls.iter_mut().find(|other| other.wall == wall.wall) {
                Some(other) => append(other, wall),
                None => walls.push(wall),
            }
        }
    }
    walls.retain(|wall| wall.quantities.iter().any(|(_, values)| values.iter().any(|value| *value != 0.0)));
    Ok(walls.into_iter().map(without_captured).collect())
}

/// Adds the faces of another rank.
fn append(wall: &mut WallSurface, more: WallSurface) {
    wall.faces.extend(more.faces);
    for ((_, values), (_, new)) in wall.quantities.iter_mut().zip(more.quantities) {
        values.extend(new);
    }
}

/// A wall with memory shows its present deposit, not what was ever captured.
fn without_captured(mut wall: WallSurface) -> WallSurface {
    if wall.quantities.iter().any(|(quantity, _)| *quantity == Quantity::Deposit) {
        wall.quantities.retain(|(quantity, _)| *quantity != Quantity::Captured);
    }
    wall
}

/// Where the last fields are: the folder of the case or those of its ranks, and the time.
struct Source {
    roots: Vec<PathBuf>,
    /// Time [s] and the name of its folder.
    time: f64,
    folder: String,
}

impl Source {
    /// The fields at a time or at the last one; `None` when there are none.
    fn of(case: &Path, cloud: &str, time: Option<f64>) -> Result<Option<Self>, String> {
        let ranks = ranks(case);
        let whole = last_time(case, cloud, time);
        let split = ranks.first().and_then(|rank| last_time(rank, cloud, time));
        let newer = |(time, _): &(f64, String)| whole.as_ref().is_none_or(|(other, _)| time > other);
        if let Some((time, folder)) = split.filter(newer) {
            return Ok(Some(Self { roots: ranks, time, folder }));
        }
        if whole.is_none() && has_collated(case) {
            return Err(format!(
                "{}: the fields of all ranks are in one file each (collated), which are not read; run reconstructPar for maps \
                 of the walls",
                case.display()
            ));
        }
        Ok(whole.map(|(time, folder)| Self { roots: vec![case.to_owned()], time, folder }))
    }

    /// The walls of the case or of one rank.
    fn read(&self, root: &Path, cloud: &str) -> Result<Vec<WallSurface>, String> {
        let mesh = Mesh { root, time: self.time };
        let patches = mesh.patches()?;
        let fields = self.fields(root, cloud, &patches)?;
        let has_values = |patch: &&Patch| fields.iter().any(|(_, values)| values.contains_key(&patch.name));
        let with_values: Vec<&Patch> = patches.iter().filter(has_values).collect();
        let mut outlines = mesh.outlines(&with_values)?;
        let wall = |patch: &&Patch| {
            let own = |(quantity, values): &(Quantity, PatchValues)| {
                let none = || vec![0.0; patch.faces];
                (*quantity, values.get(&patch.name).cloned().unwrap_or_else(none))
            };
            let faces = outlines.remove(&patch.name).unwrap_or_default();
            WallSurface {
                wall: patch.name.clone(),
                time: self.time,
                faces: faces.into_iter().map(WallFace::new).collect(),
                quantities: fields.iter().map(own).collect(),
                captured: None,
            }
        };
        Ok(with_values.iter().map(wall).collect())
    }

    /// All fields on the patches of type `wall` of the case or of one rank; where a patch has no values they are 0.
    fn read_all(&self, root: &Path, cloud: &str) -> Result<Vec<WallFields>, String> {
        let mesh = Mesh { root, time: self.time };
        let mut patches = mesh.patches()?;
        patches.retain(|patch| patch.kind == "wall");
        let faces = patches.iter().map(|patch| (patch.name.clone(), patch.faces)).collect();
        let mut fields = Vec::new();
        for field in ALL_FIELDS {
            let path = root.join(&self.folder).join(format!("{cloud}:{field}"));
            if is_written(&path) {
                fields.push((field.to_owned(), boundary_field::read(&path, &faces)?));
            }
        }
        let mut outlines = mesh.outlines(&patches.iter().collect::<Vec<_>>())?;
        let wall = |patch: &Patch| {
            let of_patch = |(field, values): &(String, PatchValues)| {
                let none = || vec![0.0; patch.faces];
                (field.clone(), values.get(&patch.name).cloned().unwrap_or_else(none))
            };
            let faces = outlines.remove(&patch.name).unwrap_or_default();
            WallFields {
                wall: patch.name.clone(),
                time: self.time,
                faces: faces.into_iter().map(WallFace::new).collect(),
                fields: fields.iter().map(of_patch).collect(),
            }
        };
        Ok(patches.iter().map(wall).collect())
    }

    /// The quantities that are written, by the name of the patch.
    fn fields(
        &self,
        root: &Path,
        cloud: &str,
        patches: &[Patch],
    ) -> Result<Vec<(Quantity, PatchValues)>, String> {
        let faces = patches.iter().map(|patch| (patch.name.clone(), patch.faces)).collect();
        let mut fields: Vec<(Quantity, PatchValues)> = Vec::new();
        for (field, quantity) in FIELDS {
            let path = root.join(&self.folder).join(format!("{cloud}:{field}"));
            if !is_written(&path) {
                continue;
            }
            let values = boundary_field::read(&path, &faces)?;
            match fields.iter_mut().find(|(other, _)| *other == quantity) {
                Some((_, sums)) => add(sums, values),
                None => fields.push((quantity, values)),
            }
        }
        Ok(fields)
    }
}

/// Adds the values of a field to those of another one.
fn add(sums: &mut PatchValues, values: PatchValues) {
    for (patch, values) in values {
        let sum = sums.entry(patch).or_insert_with(|| vec![0.0; values.len()]);
        sum.iter_mut().zip(values).for_each(|(sum, value)| *sum += value);
    }
}

/// The last time of a folder with any of the fields, or `wanted` [s] if it has any: time [s] and name.
fn last_time(root: &Path, cloud: &str, wanted: Option<f64>) -> Option<(f64, String)> {
    let has_fields =
        |folder: &Path| FIELDS.iter().any(|(field, _)| is_written(&folder.join(format!("{cloud}:{field}"))));
    // Names of folders are rounded.
    let is_wanted = |time: f64| wanted.is_none_or(|wanted| (time - wanted).abs() <= 1e-6 * wanted.abs());
    let mut times = time_folders(root).into_iter().rev();
    let (time, folder) = times.find(|(time, folder)| is_wanted(*time) && has_fields(folder))?;
    Some((time, file_name(&folder).to_owned()))
}

/// The folders of the ranks of a decomposed case, in their order.
pub(super) fn ranks(case: &Path) -> Vec<PathBuf> {
    let number = |path: &PathBuf| file_name(path).strip_prefix("processor")?.parse::<usize>().ok();
    let folders = entries(case, Path::is_dir).into_iter();
    let mut ranks: Vec<(usize, PathBuf)> = folders.filter_map(|path| Some((number(&path)?, path))).collect();
    ranks.sort();
    ranks.into_iter().map(|(_, path)| path).collect()
}

/// Whether there are folders `processors4`, which hold all ranks in one file.
pub(super) fn has_collated(case: &Path) -> bool {
    entries(case, Path::is_dir).iter().any(|path| file_name(path).starts_with("processors"))
}
