//! The reader of all tables under `postProcessing`: a header line after `#` with the names of the columns, then one
//! line a row. Columns are found by name, so that older and newer tables can be read; an incomplete line is skipped.

use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

use super::super::{History, history_of};
use super::{entries, file_name, time_folders};

/// One line of a table with the names of its columns.
pub struct TableRow<'a> {
    header: &'a [String],
    cells: Vec<&'a str>,
}

impl TableRow<'_> {
    /// The names of the columns with their texts.
    pub fn cells(&self) -> impl Iterator<Item = (&str, &str)> {
        self.header.iter().map(String::as_str).zip(self.cells.iter().copied())
    }

    /// The text of a column.
    pub fn text(&self, name: &str) -> Option<&str> {
        self.header.iter().position(|column| column == name).map(|index| self.cells[index])
    }

    /// The number of a column, the first one of a list.
    pub fn number(&self, name: &str) -> Option<f64> {
        self.text(name).and_then(|cell| numbers(cell).first().copied())
    }

    /// The numbers of a list such as `(1 2 3)`.
    pub fn list(&self, name: &str) -> Option<Vec<f64>> {
        self.text(name).map(numbers)
    }

    /// The numbers of several columns; `None` when one is absent.
    pub fn all(&self, names: impl Iterator<Item = String>) -> Option<Vec<f64>> {
        names.map(|name| self.number(&name)).collect()
    }
}

/// The names of the columns, from the last header.
#[derive(Default)]
struct Header {
    names: Vec<String>,
}

impl Header {
    /// The row of a line; `None` for a header, which is kept, and for an incomplete line.
    fn row<'a>(&'a mut self, line: &'a str) -> Option<TableRow<'a>> {
        if let Some(names) = line.strip_prefix('#') {
            // v2412 quotes the names of a parcel's properties
            let names = names.replace('"', " ");
            self.names = pieces(&names).into_iter().map(base_name).collect();
            return None;
        }
        let cells = pieces(line);
        let complete = cells.len() == self.names.len() && !cells.is_empty();
        complete.then_some(TableRow { header: &self.names, cells })
    }
}

/// Converts each complete row of a table.
pub fn read<T>(text: &str, convert: impl Fn(&TableRow<'_>) -> Option<T>) -> Vec<T> {
    let mut header = Header::default();
    text.lines().filter_map(|line| convert(&header.row(line)?)).collect()
}

/// Passes each complete row of a file of any size to `take`, up to a line that cannot be read.
pub fn for_each(path: &Path, mut take: impl FnMut(&TableRow<'_>)) {
    let Ok(file) = File::open(path) else { return };
    let mut header = Header::default();
    let mut source = BufReader::with_capacity(1 << 16, file);
    let mut line = String::new();
    while source.read_line(&mut line).is_ok_and(|size| size > 0) {
        if let Some(row) = header.row(line.trim_end_matches(['\n', '\r'])) {
            take(&row);
        }
        line.clear();
    }
}

/// Reads `<folder>/<start time>/<wall><suffix>`, but no file that ends as one of `except`: the
/// history of each wall over all starts of the solver. What a start wrote replaces what earlier
/// starts had written after its time.
pub fn histories<T>(
    folder: &Path,
    suffix: &str,
    except: &[&str],
    convert: impl Fn(&TableRow<'_>) -> Option<(f64, T)>,
) -> Vec<History<T>> {
    let mut histories: Vec<History<T>> = Vec::new();
    for (start, folder) in time_folders(folder) {
        for path in entries(&folder, Path::is_file) {
            let name = file_name(&path);
            let Some(wall) = name.strip_suffix(suffix) else { continue };
            if except.iter().any(|ending| name.ends_with(ending)) {
                continue;
            }
            let rows = read(&std::fs::read_to_string(&path).unwrap_or_default(), &convert);
            let Some((first, _)) = rows.first() else { continue };
            // The folder's name may be rounded to six digits.
            let until = first.min(start * (1.0 + 1e-5));
            let history = &mut history_of(&mut histories, wall).rows;
            history.retain(|(time, _)| time < first && *time <= until);
            history.extend(rows);
        }
    }
    histories
}

/// Splits a line at blanks; what stands in brackets, with the count before them, is one piece.
fn pieces(line: &str) -> Vec<&str> {
    let mut pieces = Vec::new();
    let (mut depth, mut start) = (0_usize, None);
    for (index, symbol) in line.char_indices() {
        match symbol {
            '(' | '{' => depth += 1,
            ')' | '}' => depth = depth.saturating_sub(1),
            _ => {}
        }
        if symbol.is_whitespace() && depth == 0 {
            pieces.extend(start.take().map(|from| &line[from..index]));
        } else if start.is_none() {
            start = Some(index);
        }
    }
    pieces.extend(start.map(|from| &line[from..]));
    pieces
}

/// `position` for `(position0 position1 position2)`, `YSolid` for `N(YSolid0 YSolid1)`, `d` for `d`.
fn base_name(piece: &str) -> String {
    let Some((_, inside)) = piece.split_once('(') else { return piece.to_owned() };
    let first = inside.trim_end_matches(')').split_whitespace().next().unwrap_or_default();
    first.trim_end_matches(|c: char| c.is_ascii_digit()).to_owned()
}

/// The numbers of a cell: `(1 2 3)`, `2(0.1 0.9)`, `3{0}` (three zeros) or a plain number.
fn numbers(cell: &str) -> Vec<f64> {
    if let Some((count, value)) = cell.split_once('{') {
        let value = value.trim_end_matches('}').parse().unwrap_or(f64::NAN);
        return vec![value; count.parse::<usize>().unwrap_or(1).min(1000)];
    }
    let inside = cell.split_once('(').map_or(cell, |(_, rest)| rest.trim_end_matches(')'));
    inside.split_whitespace().filter_map(|word| word.parse().ok()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_found_by_name_and_incomplete_lines_skipped() {
        let text = "# time_s (U0 U1 U2) N(Y0 Y1) hits\n0.1 (1 2 3) 2(3 4) 5\n0.2 (1 2 3) 2{7} 9\n0.3 (4";
        let rows = read(text, |row| Some((row.number("time_s")?, row.list("Y")?, row.number("hits")?)));
        assert_eq!(rows, [(0.1, vec![3.0, 4.0], 5.0), (0.2, vec![7.0, 7.0], 9.0)]);
        assert_eq!(read(text, |row| row.list("U")), [[1.0, 2.0, 3.0]; 2]);
        let history = History { wall: "(hot|cold)Wall".to_owned(), rows: vec![(0.1, 1), (0.2, 2)] };
        assert!(history.covers("coldWall") && !history.covers("outlet"));
        assert_eq!((history.at(0.15), history.at(0.05)), (Some(&1), None));
    }
}
