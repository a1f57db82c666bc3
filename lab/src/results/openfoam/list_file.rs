//! A list file of a cloud: `positions`, or the values of one property of all parcels.
//!
//! ASCII: one entry a line between brackets, `n(a b c)`, or `n{value}` for `n` equal entries. Binary: `n(` and the bytes of the
//! numbers, for `positions` each parcel with brackets of its own; the widths of labels and scalars are in the header (`arch`).
//!
//! v1912 writes Cartesian places to `positions` and barycentric coordinates to `coordinates`; OpenFOAM of the Foundation writes the
//! latter to `positions`.

use std::path::Path;

use super::foam_file::{Arch, is_written};

/// Where a parcel is within a tetrahedron of a cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TetPlace {
    /// Weights of the four corners, whose sum is 1: centre of the cell, base point of the face, and two further corners.
    pub weights: [f64; 4],
    pub cell: usize,
    pub face: usize,
    /// Number of the second corner of the triangle, from the base point of the face on.
    pub corner: usize,
}

/// Places of all parcels.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Places {
    /// In m.
    Cartesian(Vec<[f64; 3]>),
    Barycentric(Vec<TetPlace>),
}

/// Places of all parcels [m].
///
/// # Errors
/// Why they cannot be read.
pub(super) fn positions(folder: &Path) -> Result<Vec<[f64; 3]>, String> {
    let path = folder.join("positions");
    match places_in(&path)? {
        Places::Cartesian(places) => Ok(places),
        Places::Barycentric(_) => Err(format!("{} has barycentric coordinates", path.display())),
    }
}

/// Places of all parcels, from `positions` or else from `coordinates`.
///
/// # Errors
/// Why they cannot be read.
pub(super) fn places(folder: &Path) -> Result<Places, String> {
    let positions = folder.join("positions");
    let coordinates = folder.join("coordinates");
    let has_other = !is_written(&positions) && is_written(&coordinates);
    places_in(if has_other { &coordinates } else { &positions })
}

fn places_in(path: &Path) -> Result<Places, String> {
    let read = || match Contents::of(path)? {
        Contents::Text(text) => places_of_text(&list(&text, None)?),
        Contents::Binary(binary) => binary.places(),
    };
    read().ok_or_else(|| unreadable(path))
}

/// `(x y z) cell`, or `(a b c d) cell face corner`.
fn places_of_text(entries: &[String]) -> Option<Places> {
    let rows: Vec<Vec<f64>> = entries
        .iter()
        .map(|entry| entry.split(['(', ' ', ')']).filter_map(|word| word.parse().ok()).collect())
        .collect();
    if rows.first().is_some_and(|row| row.len() >= 7) {
        return rows.iter().map(|row| tet_place(row)).collect::<Option<_>>().map(Places::Barycentric);
    }
    let place = |row: &Vec<f64>| Some([*row.first()?, *row.get(1)?, *row.get(2)?]);
    Some(Places::Cartesian(rows.iter().filter_map(place).collect()))
}

fn tet_place(row: &[f64]) -> Option<TetPlace> {
    let [a, b, c, d, labels @ ..] = row else { return None };
    let label = |place: usize| labels.get(place).filter(|label| **label >= 0.0).map(|label| *label as usize);
    Some(TetPlace { weights: [*a, *b, *c, *d], cell: label(0)?, face: label(1)?, corner: label(2)? })
}

/// Values of a property of all parcels.
///
/// # Errors
/// Why they cannot be read.
pub(super) fn numbers(folder: &Path, name: &str, parcels: usize) -> Result<Vec<f64>, String> {
    let path = folder.join(name);
    let read = || match Contents::of(&path)? {
        Contents::Text(text) => {
            Some(list(&text, Some(parcels))?.iter().filter_map(|entry| entry.parse().ok()).collect())
        }
        Contents::Binary(binary) => binary.numbers(),
    };
    read().ok_or_else(|| unreadable(&path))
}

fn unreadable(path: &Path) -> String {
    format!("{} is absent, compressed or no list", path.display())
}

/// The contents of a file.
enum Contents {
    Text(String),
    Binary(Binary),
}

impl Contents {
    fn of(path: &Path) -> Option<Self> {
        let bytes = std::fs::read(path).ok()?;
        match Binary::of(&bytes) {
            Some(binary) => Some(Self::Binary(binary)),
            None => String::from_utf8(bytes).ok().map(Self::Text),
        }
    }
}

/// The list of a binary file, after its header.
struct Binary {
    count: usize,
    /// From the opening bracket on.
    body: Vec<u8>,
    arch: Arch,
    /// Whether the list holds labels.
    labels: bool,
}

impl Binary {
    /// `None` for a file of another format.
    fn of(bytes: &[u8]) -> Option<Self> {
        let end = bytes.windows(2).position(|pair| pair == b"}\n")? + 2;
        let header = std::str::from_utf8(&bytes[..end]).ok()?;
        let value = |key: &str| {
            let (_, rest) = header.split_once(&format!("\n    {key} "))?;
            Some(rest.split_once(';')?.0.trim().trim_matches('"'))
        };
        if value("format") != Some("binary") {
            return None;
        }
        let arch = header.lines().find(|line| line.trim_start().starts_with("arch")).unwrap_or_default();
        let rest = &bytes[end..];
        let mut from = 0;
        // The line of stars is a comment.
        while let Some(length) = rest[from..].iter().position(|byte| *byte == b'\n') {
            let line = std::str::from_utf8(&rest[from..from + length]).ok()?.trim();
            from += length + 1;
            if let Ok(count) = line.parse() {
                return Some(Self {
                    count,
                    body: rest[from..].to_vec(),
                    arch: Arch::of(arch),
                    labels: value("class").is_some_and(|class| class.starts_with("label")),
                });
            }
        }
        None
    }

    /// A number of this many bytes at a place of the body.
    fn number(&self, at: usize, width: usize, label: bool) -> Option<f64> {
        self.arch.number(self.body.get(at..at + width)?, label)
    }

    /// The numbers between the brackets.
    fn numbers(&self) -> Option<Vec<f64>> {
        let width = if self.labels { self.arch.label } else { self.arch.scalar };
        (0..self.count).map(|place| self.number(1 + place * width, width, self.labels)).collect()
    }

    /// The places: each parcel has a line with a bracket, three scalars and its cell, or four scalars and three labels, and a bracket.
    fn places(&self) -> Option<Places> {
        if self.count == 0 {
            return Some(Places::Cartesian(Vec::new()));
        }
        if let Some(rows) = self.rows(3, 1) {
            return Some(Places::Cartesian(rows.iter().map(|row| [row[0], row[1], row[2]]).collect()));
        }
        self.rows(4, 3)?.iter().map(|row| tet_place(row)).collect::<Option<_>>().map(Places::Barycentric)
    }

    /// Lines of so many scalars and labels between brackets; `None` when they are of another form.
    fn rows(&self, scalars: usize, labels: usize) -> Option<Vec<Vec<f64>>> {
        let [scalar, label] = [self.arch.scalar, self.arch.label];
        let length = scalars * scalar + labels * label;
        let first = 1 + self.body.iter().skip(1).position(|byte| *byte == b'(')?;
        let row = |parcel: usize| {
            let at = first + parcel * (length + 3);
            let is_whole = *self.body.get(at)? == b'(' && *self.body.get(at + 1 + length)? == b')';
            is_whole.then_some(())?;
            let scalar_at = |place: usize| self.number(at + 1 + place * scalar, scalar, false);
            let label_at = |place: usize| self.number(at + 1 + scalars * scalar + place * label, label, true);
            (0..scalars).map(scalar_at).chain((0..labels).map(label_at)).collect()
        };
        // The bracket that closes the list tells rows of this form from longer ones, also where there is but one.
        let is_end = self.body.get(first + self.count * (length + 3)) == Some(&b')');
        if is_end { (0..self.count).map(row).collect() } else { None }
    }
}

/// The entries of an OpenFOAM list file: one a line between brackets, or `n{value}` for `n` equal entries. More equal
/// entries than parcels are cut off, and without a number of parcels such a list is refused: a short text must not fill
/// the memory.
fn list(text: &str, parcels: Option<usize>) -> Option<Vec<String>> {
    let body = text.split_once("// * *").map_or(text, |(_, rest)| rest);
    let body: Vec<&str> = body
        .lines()
        .map(str::trim)
        .filter(|line| !line.is_empty() && !line.starts_with(['/', '*']))
        .collect();
    let first = body.first()?;
    if let Some((count, value)) = first.split_once('{') {
        let count: usize = count.trim().parse().ok()?;
        return Some(vec![value.trim_end_matches('}').to_owned(); count.min(parcels?)]);
    }
    if let Some((count, rest)) = first.split_once('(') {
        count.trim().parse::<usize>().ok()?;
        return Some(rest.trim_end_matches(')').split_whitespace().map(str::to_owned).collect());
    }
    first.parse::<usize>().ok()?;
    let inside =
        body.iter().skip(1).skip_while(|line| **line != "(").skip(1).take_while(|line| **line != ")");
    Some(inside.map(|line| (*line).to_owned()).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_form_of_a_list_is_read() {
        let head = "FoamFile\n{\n format ascii;\n}\n// * * * * //\n\n";
        assert_eq!(
            list(&format!("{head}2\n(\n(0 1 2) 7\n(3 4 5) 8\n)\n\n// ***\n"), None).unwrap(),
            ["(0 1 2) 7", "(3 4 5) 8"]
        );
        assert_eq!(list(&format!("{head}3{{1e-3}}\n"), Some(3)).unwrap(), ["1e-3"; 3]);
        assert_eq!(list(&format!("{head}268435455{{1e-3}}\n"), Some(2)).unwrap(), ["1e-3"; 2]);
        assert_eq!(list(&format!("{head}268435455{{(0 0 0)}}\n"), None), None);
        assert_eq!(list(&format!("{head}2(0 1)\n"), Some(2)).unwrap(), ["0", "1"]);
        assert_eq!(list(&format!("{head}0()\n"), Some(0)).unwrap(), Vec::<String>::new());
        assert_eq!(list("no list", Some(2)), None);
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
        write(
            "active",
            "labelField",
            &[b"\n2\n(".as_slice(), &[1, 0, 0, 0, 255, 255, 255, 255], b")"].concat(),
        );
        let place = |values: &[f64]| [b"(".as_slice(), &doubles(values), &[7, 0, 0, 0], b")"].concat();
        let body = [b"2\n(\n".as_slice(), &place(&[0.1, 0.2, 0.3]), b"\n", &place(&[4.0, 5.0, 6.0]), b"\n)"]
            .concat();
        write("positions", "Cloud<coalParcel>", &body);
        assert_eq!(numbers(folder.path(), "d", 2).unwrap(), [1.5, -2e-4]);
        assert_eq!(numbers(folder.path(), "active", 2).unwrap(), [1.0, -1.0]);
        assert_eq!(positions(folder.path()).unwrap(), [[0.1, 0.2, 0.3], [4.0, 5.0, 6.0]]);
        write("d", "scalarField", b"\n9\n(short)");
        assert!(numbers(folder.path(), "d", 9).is_err());
    }
}
