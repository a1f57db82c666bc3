//! The lists of a cloud's parcels: their places, and the values of one property of all.
//!
//! v1912 writes Cartesian places to `positions` and barycentric coordinates to `coordinates`;
//! OpenFOAM of the Foundation writes the latter to `positions`.

use std::path::Path;

use super::foam_file::{FoamError, FoamFile, Numbers, is_written};

/// Where a parcel is within a tetrahedron of a cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TetPlace {
    /// Weights of the four corners, whose sum is 1: centre of the cell, base point of the face, and
    /// two further corners.
    pub weights: [f64; 4],
    pub cell: usize,
    pub face: usize,
    /// Number of the second corner of the triangle, from the base point of the face on.
    pub corner: usize,
}

impl TetPlace {
    /// From `(a b c d) cell face corner`.
    fn of(row: &[f64]) -> Option<Self> {
        let [a, b, c, d, labels @ ..] = row else { return None };
        let label = |place: usize| labels.get(place).filter(|label| **label >= 0.0).map(|one| *one as usize);
        Some(Self { weights: [*a, *b, *c, *d], cell: label(0)?, face: label(1)?, corner: label(2)? })
    }
}

/// Places of all parcels.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum ParcelPlaces {
    /// In m.
    Cartesian(Vec<[f64; 3]>),
    Barycentric(Vec<TetPlace>),
}

/// Places of all parcels [m].
///
/// # Errors
/// [`FoamError::NoList`] or [`FoamError::Barycentric`].
pub(super) fn positions(folder: &Path) -> Result<Vec<[f64; 3]>, FoamError> {
    let path = folder.join("positions");
    match places_in(&path)? {
        ParcelPlaces::Cartesian(places) => Ok(places),
        ParcelPlaces::Barycentric(_) => Err(FoamError::Barycentric(path.display().to_string())),
    }
}

/// Places of all parcels, from `positions` or else from `coordinates`.
///
/// # Errors
/// [`FoamError::NoList`].
pub(super) fn places(folder: &Path) -> Result<ParcelPlaces, FoamError> {
    let [positions, coordinates] = ["positions", "coordinates"].map(|name| folder.join(name));
    let has_other = !is_written(&positions) && is_written(&coordinates);
    places_in(if has_other { &coordinates } else { &positions })
}

fn places_in(path: &Path) -> Result<ParcelPlaces, FoamError> {
    let rows = FoamFile::open(path).and_then(|mut file| file.rows(&[[3, 1], [4, 3]])).ok();
    let places = rows.and_then(|rows| {
        if rows.first().is_some_and(|row| row.len() >= 7) {
            return rows
                .iter()
                .map(|row| TetPlace::of(row))
                .collect::<Option<_>>()
                .map(ParcelPlaces::Barycentric);
        }
        let place = |row: &Vec<f64>| row.get(..3)?.try_into().ok();
        rows.iter().map(place).collect::<Option<_>>().map(ParcelPlaces::Cartesian)
    });
    places.ok_or_else(|| FoamError::NoList(path.display().to_string()))
}

/// Values of a property of all parcels. Of more equal values than parcels the others are cut off: a short text must not
/// fill the memory.
///
/// # Errors
/// [`FoamError::NoList`].
pub(super) fn numbers(folder: &Path, name: &str, parcels: usize) -> Result<Vec<f64>, FoamError> {
    let path = folder.join(name);
    let list = FoamFile::open(&path).and_then(|mut file| file.list(file.entries()));
    match list {
        Ok(Numbers::Each(numbers)) => Ok(numbers),
        Ok(Numbers::Same(count, entry)) => Ok(entry.repeat(count.min(parcels))),
        Err(_) => Err(FoamError::NoList(path.display().to_string())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_form_of_a_list_is_read() {
        let folder = tempfile::tempdir().unwrap();
        let read = |body: &str, parcels: usize| {
            let text = format!("FoamFile\n{{\n format ascii;\n}}\n// * * * * //\n\n{body}\n\n// ***\n");
            std::fs::write(folder.path().join("d"), &text).unwrap();
            std::fs::write(folder.path().join("positions"), text).unwrap();
            (numbers(folder.path(), "d", parcels).ok(), positions(folder.path()).ok())
        };
        let places = read("2\n(\n(0 1 2) 7\n(3 4 5) 8\n)", 2).1;
        assert_eq!(places.unwrap(), [[0.0, 1.0, 2.0], [3.0, 4.0, 5.0]]);
        assert_eq!(read("3{1e-3}", 3).0.unwrap(), [1e-3; 3]);
        assert_eq!(read("268435455{1e-3}", 2).0.unwrap(), [1e-3; 2]);
        assert_eq!(read("268435455{(0 0 0)}", 2).1, None);
        assert_eq!(read("2(0 1)", 2).0.unwrap(), [0.0, 1.0]);
        assert_eq!(read("0()", 0), (Some(Vec::new()), Some(Vec::new())));
        assert_eq!(read("no list", 2), (None, None));
    }

    /// As OpenFOAM v1912 writes them.
    #[test]
    fn binary_lists_are_read() {
        let folder = tempfile::tempdir().unwrap();
        let write = |name: &str, class: &str, body: &[u8]| {
            let header = format!(
                "FoamFile\n{{\n    version     2.0;\n    format      binary;\n    class       {class};\n    arch        \
                 \"LSB;label=32;scalar=64\";\n    object      {name};\n}}\n// * * //\n\n"
            );
            std::fs::write(folder.path().join(name), [header.as_bytes(), body, b"\n\n// ** //\n"].concat())
                .unwrap();
        };
        let doubles =
            |values: &[f64]| values.iter().flat_map(|value| value.to_le_bytes()).collect::<Vec<u8>>();
        write("d", "scalarField", &[b"\n2\n(".as_slice(), &doubles(&[1.5, -2e-4]), b")"].concat());
        let labels = [1, 0, 0, 0, 255, 255, 255, 255];
        write("active", "labelField", &[b"\n2\n(".as_slice(), &labels, b")"].concat());
        let place = |values: &[f64]| [b"(".as_slice(), &doubles(values), &[7, 0, 0, 0], b")"].concat();
        let body = [b"2\n(\n".as_slice(), &place(&[0.1, 0.2, 0.3]), b"\n", &place(&[4.0, 5.0, 6.0]), b"\n)"];
        write("positions", "Cloud<coalParcel>", &body.concat());
        assert_eq!(numbers(folder.path(), "d", 2).unwrap(), [1.5, -2e-4]);
        assert_eq!(numbers(folder.path(), "active", 2).unwrap(), [1.0, -1.0]);
        assert_eq!(positions(folder.path()).unwrap(), [[0.1, 0.2, 0.3], [4.0, 5.0, 6.0]]);
        write("d", "scalarField", b"\n9\n(short)");
        assert!(numbers(folder.path(), "d", 9).is_err());
    }
}
