//! A list file of a cloud: `positions`, or the values of one property of all parcels.
//!
//! ASCII: one entry a line between brackets, `n(a b c)`, or `n{value}` for `n` equal entries. Binary: `n(` and the bytes of the
//! numbers, for `positions` each parcel with brackets of its own; the widths of labels and scalars are in the header (`arch`).

use std::path::Path;

use super::foam_file::Arch;

/// Places of all parcels [m].
///
/// # Errors
/// Why they cannot be read, for the page.
pub(super) fn positions(folder: &Path) -> Result<Vec<[f64; 3]>, String> {
    let path = folder.join("positions");
    let read = || match Contents::of(&path)? {
        Contents::Text(text) => {
            let place = |entry: &String| {
                let entry = entry.trim_start_matches('(');
                let mut words = entry.split([' ', ')']).filter_map(|word| word.parse().ok());
                Some([words.next()?, words.next()?, words.next()?])
            };
            Some(list(&text, None)?.iter().filter_map(place).collect())
        }
        Contents::Binary(binary) => binary.positions(),
    };
    read().ok_or_else(|| unreadable(&path))
}

/// Values of a property of all parcels.
///
/// # Errors
/// Why they cannot be read, for the page.
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
    format!(
        "{} is absent, compressed or no list, so the places of captured parcels are unknown",
        path.display()
    )
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

    /// The places: each parcel has a line with a bracket, three scalars, its cell and a bracket.
    fn positions(&self) -> Option<Vec<[f64; 3]>> {
        let length = 3 * self.arch.scalar + self.arch.label + 3;
        let first = 1 + self.body.iter().skip(1).position(|byte| *byte == b'(')?;
        let place = |parcel: usize| {
            let at = first + parcel * length;
            (*self.body.get(at)? == b'(').then_some(())?;
            let coordinate =
                |axis: usize| self.number(at + 1 + axis * self.arch.scalar, self.arch.scalar, false);
            Some([coordinate(0)?, coordinate(1)?, coordinate(2)?])
        };
        (0..self.count).map(place).collect()
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
