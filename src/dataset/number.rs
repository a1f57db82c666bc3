//! Numbers in cells: how they are written, in which unit, and what stands for "not known".

use super::unit::Unit;

/// How numbers are written in a file.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct NumberStyle {
    /// Whether a comma stands before the decimals.
    pub(super) decimal_comma: bool,
    /// Whether the [`MARKERS`] stand for a blank cell.
    pub(super) markers: bool,
}

/// What laboratories and programs write where they have no value.
const MARKERS: [&str; 7] = ["NA", "NaN", "nan", "-", "n/a", "N/A", "#N/A"];

/// Whether a cell says that there is no value.
pub(super) fn is_blank(cell: &str) -> bool {
    cell.is_empty() || (cell.len() <= 4 && MARKERS.contains(&cell))
}

impl NumberStyle {
    /// The number in a cell, or `None` if it is not one.
    pub(super) fn parse(self, cell: &str) -> Option<f64> {
        match self.decimal_comma {
            false => cell.parse().ok(),
            true if cell.contains('.') => None,
            true if cell.contains(',') => cell.replace(',', ".").parse().ok(),
            true => cell.parse().ok(),
        }
    }

    /// Why a cell is not a number; where a column map can help, how.
    fn not_a_number(self, name: &str, cell: &str) -> String {
        let other = Self { decimal_comma: !self.decimal_comma, ..self };
        let hint = match (self.markers && other.parse(cell).is_some(), self.decimal_comma) {
            (false, _) => "",
            (true, false) => "; if it has a decimal comma, the column map has to say decimal = \",\"",
            (true, true) => ", for the column map says decimal = \",\"",
        };
        format!("{name} `{cell}` is not a number{hint}")
    }
}

/// A column of numbers.
#[derive(Debug, Clone, Copy)]
pub(super) struct NumberColumn {
    /// What nearwall calls it.
    pub(super) name: &'static str,
    /// Which cell of a row it is.
    pub(super) index: usize,
    /// Unit that the cells are in.
    pub(super) unit: Unit,
    /// How its numbers are written.
    pub(super) style: NumberStyle,
}

impl NumberColumn {
    /// The value in SI units (angles in degrees), or `None` where the cell is blank. It may be NaN or infinite.
    ///
    /// # Errors
    /// The reason, for a cell that is no number.
    pub(super) fn read(&self, cells: &csv::StringRecord) -> Result<Option<f64>, String> {
        let cell = cells.get(self.index).unwrap_or("");
        if if self.style.markers { is_blank(cell) } else { cell.is_empty() } {
            return Ok(None);
        }
        let number = self.style.parse(cell).ok_or_else(|| self.style.not_a_number(self.name, cell))?;
        Ok(Some(self.unit.to_si(number)))
    }

    /// As [`Self::read`], but NaN and infinity are refused.
    pub(super) fn read_finite(&self, cells: &csv::StringRecord) -> Result<Option<f64>, String> {
        match self.read(cells)? {
            Some(value) if !value.is_finite() => Err(format!("{} is not finite", self.name)),
            other => Ok(other),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimal_commas_are_read_where_they_are_announced() {
        let comma = NumberStyle { decimal_comma: true, markers: true };
        assert_eq!(comma.parse("-1,5e-3"), Some(-1.5e-3));
        assert_eq!(comma.parse("12"), Some(12.0));
        assert_eq!(comma.parse("1.234,5"), None);
        assert_eq!(comma.parse("1,234,5"), None);
        assert!(comma.not_a_number("d", "1.5").contains("decimal"), "{}", comma.not_a_number("d", "1.5"));
        let point = NumberStyle { decimal_comma: false, markers: true };
        assert!(point.not_a_number("d", "1,5").contains("decimal = \",\""));
        assert_eq!(NumberStyle::default().not_a_number("d", "1,5"), "d `1,5` is not a number");
    }

    #[test]
    fn sodium_is_no_missing_value() {
        assert!(is_blank("NA") && is_blank("") && is_blank("-") && is_blank("nan"));
        assert!(!is_blank("Na") && !is_blank("-1") && !is_blank("0"));
    }
}
