//! Numbers in cells: their notation, their unit, and markers of missing values.

use super::row_error::RowFault;
use super::unit::Unit;

/// The notation of numbers in a file.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct NumberStyle {
    /// Whether the decimal separator is a comma.
    pub(super) decimal_comma: bool,
    /// Whether the [`MISSING_MARKERS`] denote a missing value.
    pub(super) markers: bool,
}

/// Markers of missing values.
const MISSING_MARKERS: [&str; 7] = ["NA", "NaN", "nan", "-", "n/a", "N/A", "#N/A"];

/// Whether a cell is blank or a marker of a missing value.
pub(super) fn is_blank(cell: &str) -> bool {
    cell.is_empty() || (cell.len() <= 4 && MISSING_MARKERS.contains(&cell))
}

impl NumberStyle {
    /// The number in a cell, or `None` if it is not a number.
    pub(super) fn parse(self, cell: &str) -> Option<f64> {
        match self.decimal_comma {
            false => cell.parse().ok(),
            true if cell.contains('.') => None,
            true if cell.contains(',') => cell.replace(',', ".").parse().ok(),
            true => cell.parse().ok(),
        }
    }

    /// The cell with a decimal point, if it is a number with a decimal comma.
    pub(super) fn with_point(self, cell: &str) -> String {
        match self.decimal_comma && self.parse(cell).is_some() {
            true => cell.replace(',', "."),
            false => cell.to_owned(),
        }
    }

    /// The error of a cell that is not a number, with the remedy if a column map can help.
    pub(super) fn not_a_number(self, name: &str, cell: &str) -> RowFault {
        let other = Self { decimal_comma: !self.decimal_comma, ..self };
        let hint = match (self.markers && other.parse(cell).is_some(), self.decimal_comma) {
            (false, _) => "",
            (true, false) => "; for a decimal comma set decimal = \",\" in the column map",
            (true, true) => "; numbers have decimal commas here, or set decimal = \".\" in the column map",
        };
        RowFault::NotANumber { name: name.to_owned(), cell: cell.to_owned(), hint }
    }
}

/// A column of numbers.
#[derive(Debug, Clone, Copy)]
pub(super) struct NumberColumn {
    /// Its name in nearwall.
    pub(super) name: &'static str,
    /// Its index in a row.
    pub(super) index: usize,
    /// Unit of the cells.
    pub(super) unit: Unit,
    /// Notation of its numbers.
    pub(super) style: NumberStyle,
}

impl NumberColumn {
    /// The value in SI units (angles in degrees), or `None` where the cell is blank. It may be NaN or infinite.
    ///
    /// # Errors
    /// The reason, for a cell that is not a number.
    pub(super) fn read(&self, cells: &csv::StringRecord) -> Result<Option<f64>, RowFault> {
        let cell = cells.get(self.index).unwrap_or("");
        if if self.style.markers { is_blank(cell) } else { cell.is_empty() } {
            return Ok(None);
        }
        let number = self.style.parse(cell).ok_or_else(|| self.style.not_a_number(self.name, cell))?;
        Ok(Some(self.unit.to_si(number)))
    }

    /// The limit [SI] of a censored value, and whether the value is below it; `None` where the cell is not censored.
    ///
    /// # Errors
    /// The reason, for a limit that is not a finite number.
    pub(super) fn read_limit(&self, cells: &csv::StringRecord) -> Result<Option<(f64, bool)>, RowFault> {
        let cell = cells.get(self.index).unwrap_or("");
        let below = match cell.chars().next() {
            Some('<' | '≤') => true,
            Some('>' | '≥') => false,
            _ => return Ok(None),
        };
        let limit = self.style.parse(cell.trim_start_matches(['<', '≤', '>', '≥', '=', ' ']));
        match limit.map(|limit| self.unit.to_si(limit)).filter(|limit| limit.is_finite()) {
            Some(limit) => Ok(Some((limit, below))),
            None => Err(self.style.not_a_number(self.name, cell)),
        }
    }

    /// As [`Self::read`], without NaN and infinity.
    pub(super) fn read_finite(&self, cells: &csv::StringRecord) -> Result<Option<f64>, RowFault> {
        match self.read(cells)? {
            Some(value) if !value.is_finite() => Err(RowFault::NotFinite(self.name.to_owned())),
            other => Ok(other),
        }
    }
}

/// The columns of a file to which a column map gives a name.
pub(super) struct NamedColumns {
    pub(super) columns: Vec<NumberColumn>,
}

impl NamedColumns {
    /// The column of this name.
    pub(super) fn column(&self, name: &str) -> Option<NumberColumn> {
        self.columns.iter().find(|column| column.name == name).copied()
    }

    /// The index of the column of this name.
    pub(super) fn index(&self, name: &str) -> Option<usize> {
        self.column(name).map(|column| column.index)
    }

    /// The name of the column with this index.
    pub(super) fn name_of(&self, index: usize) -> Option<&'static str> {
        self.columns.iter().find(|column| column.index == index).map(|column| column.name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimal_commas_are_read_if_the_map_sets_them() {
        let comma = NumberStyle { decimal_comma: true, markers: true };
        assert_eq!(comma.parse("-1,5e-3"), Some(-1.5e-3));
        assert_eq!(comma.parse("12"), Some(12.0));
        assert_eq!(comma.parse("1.234,5"), None);
        assert_eq!(comma.parse("1,234,5"), None);
        assert!(
            comma.not_a_number("d", "1.5").to_string().contains("decimal"),
            "{}",
            comma.not_a_number("d", "1.5").to_string()
        );
        let point = NumberStyle { decimal_comma: false, markers: true };
        assert!(point.not_a_number("d", "1,5").to_string().contains("decimal = \",\""));
        assert_eq!(NumberStyle::default().not_a_number("d", "1,5").to_string(), "d `1,5` is not a number");
    }

    #[test]
    fn sodium_is_not_a_missing_value() {
        assert!(is_blank("NA") && is_blank("") && is_blank("-") && is_blank("nan"));
        assert!(!is_blank("Na") && !is_blank("-1") && !is_blank("0"));
    }
}
