//! The column map: names, units, words and separators of a laboratory's own file, from a TOML file.

use std::path::Path;

use super::csv_table::Layout;
use super::impact_velocity::{AngleFrom, over_determined};
use super::number::{NamedColumns, NumberColumn, NumberStyle};
use super::observed::OutcomeWords;
use super::unit::{Dimension, Unit, names};
use crate::input::{Document, InputError, Section, unknown};

/// The format of a file of impacts. The default is nearwall's own: names as in [`INPUTS`], SI units, commas.
///
/// [`INPUTS`]: crate::impact::INPUTS
#[derive(Debug, Clone, Default)]
pub struct ColumnMap {
    file: String,
    pub(super) layout: Layout,
    pub(super) style: NumberStyle,
    pub(super) words: OutcomeWords,
    /// The origin of the column `angle`.
    pub(super) from: Option<AngleFrom>,
    sources: Vec<Source>,
    pub(super) ignored: Vec<String>,
    pub(super) labels: Vec<String>,
}

/// One line of `[columns]`.
#[derive(Debug, Clone)]
struct Source {
    name: &'static str,
    column: String,
    unit: Unit,
}

/// Largest line number of a header.
const LAST_HEADER_LINE: f64 = 10_000.0;

impl ColumnMap {
    /// Reads a column map.
    ///
    /// # Errors
    /// [`InputError`] naming file, line, column and key.
    pub fn from_file(path: &Path) -> Result<Self, InputError> {
        Self::from_document(&Document::from_file(path)?)
    }

    /// Reads a column map from TOML text; `name` names the file in messages.
    ///
    /// # Errors
    /// [`InputError`] naming line, column and key.
    pub fn from_toml(name: &str, text: &str) -> Result<Self, InputError> {
        Self::from_document(&Document::new(name, text))
    }

    fn from_document(document: &Document) -> Result<Self, InputError> {
        document.read(|top| {
            let mut map = Self { file: document.name().to_owned(), ..Self::default() };
            map.layout = read_layout(top)?;
            map.style.decimal_comma = top.choice("decimal", &[".", ","])?.is_some_and(|mark| mark == ",");
            map.ignored = read_names(top, "ignore")?;
            map.labels = read_names(top, "labels")?;
            if let Some(columns) = top.section("columns")? {
                for (name, dimension) in names() {
                    map.read_source(&columns, name, dimension)?;
                }
                columns.finish()?;
                if let Some(problem) = over_determined(|key| map.source(key).is_some()) {
                    return Err(top.fault("columns", problem));
                }
            }
            Ok(map)
        })
    }

    /// Reads the map's entry of one name, if any.
    fn read_source(
        &mut self,
        columns: &Section<'_>,
        name: &'static str,
        dimension: Dimension,
    ) -> Result<(), InputError> {
        if !columns.has(name) {
            return Ok(());
        }
        let (column, unit) = if columns.is_section(name) {
            let details = columns.required_section(name)?;
            let column = details.required_text("column")?;
            let unit = read_unit(&details, dimension)?;
            if dimension == Dimension::Angle {
                self.from = Some(read_from(&details)?);
            }
            if name == "outcome" {
                self.words = OutcomeWords::read(&details)?;
            }
            details.finish()?;
            (column, unit)
        } else {
            (columns.required_text(name)?, Unit::SI)
        };
        if dimension == Dimension::Angle && self.from.is_none() {
            return Err(columns.fault(name, format!("state its unit and its origin: {ANGLE_EXAMPLE}")));
        }
        let column = column.trim().to_owned();
        if let Some(other) = self.sources.iter().find(|other| other.column == column) {
            return Err(columns.fault(name, format!("column `{column}` is already used for {}", other.name)));
        }
        if self.ignored.contains(&column) {
            return Err(columns.fault(
                name,
                format!("column `{column}` is also listed under [ignore]; remove one of the two"),
            ));
        }
        self.sources.push(Source { name, column, unit });
        Ok(())
    }

    fn source(&self, name: &str) -> Option<&Source> {
        self.sources.iter().find(|source| source.name == name)
    }

    /// Whether this column is not used at all.
    pub(super) fn ignores(&self, column: &str) -> bool {
        column.is_empty() || self.ignored.iter().any(|ignored| ignored == column)
    }

    /// Finds the columns that the map names among `headers`.
    ///
    /// # Errors
    /// The reason, if a column of the map is missing or a name has two columns.
    pub(super) fn name_columns(&self, headers: &csv::StringRecord) -> Result<NamedColumns, String> {
        let columns = names().map(|(name, _)| self.name_column(name, headers));
        Ok(NamedColumns { columns: columns.filter_map(Result::transpose).collect::<Result<_, _>>()? })
    }

    fn name_column(
        &self,
        name: &'static str,
        headers: &csv::StringRecord,
    ) -> Result<Option<NumberColumn>, String> {
        let place = |column: &str| headers.iter().position(|header| header == column);
        // In measured data, markers of missing values are blanks.
        let style = NumberStyle { markers: true, ..self.style };
        let found = |index, unit| Ok(Some(NumberColumn { name, index, unit, style }));
        let taken = self.ignores(name) || self.sources.iter().any(|source| source.column == name);
        let own = if taken { None } else { place(name) };
        match (self.source(name), own) {
            (None, _) if name == "speed" || name == "angle" => Ok(None),
            (None, None) => Ok(None),
            (None, Some(index)) => found(index, Unit::SI),
            (Some(source), Some(_)) => Err(format!(
                "{} reads {name} from column `{}`, but a column `{name}` exists too; list it under [ignore] or use it",
                self.file, source.column
            )),
            (Some(source), None) => match place(&source.column) {
                Some(index) => found(index, source.unit),
                None => Err(self.absent(source, headers)),
            },
        }
    }

    fn absent(&self, source: &Source, headers: &csv::StringRecord) -> String {
        let known: Vec<&str> = headers.iter().filter(|header| !header.is_empty()).collect();
        let problem = unknown(&source.column, "column", &known);
        format!("{} reads {} from a missing column: {problem}", self.file, source.name)
    }

    /// Parses a number of a possible cause.
    pub(super) fn parse(&self, cell: &str) -> Option<f64> {
        self.style.parse(cell).filter(|number| number.is_finite())
    }
}

/// An example of an angle's entry.
const ANGLE_EXAMPLE: &str = r#"angle = { column = "...", unit = "deg", from = "surface" } (0 is glancing) or from = "normal" (0 is head-on)"#;

fn read_unit(details: &Section<'_>, dimension: Dimension) -> Result<Unit, InputError> {
    let units = dimension.units();
    if units.is_empty() {
        return Ok(Unit::SI);
    }
    match details.text("unit")? {
        Some(word) => dimension.unit(&word).ok_or_else(|| {
            let known: Vec<&str> = units.iter().map(|unit| unit.name).collect();
            details.fault("unit", unknown(&word, "unit", &known))
        }),
        None if dimension == Dimension::Angle => Err(details.missing("unit", "\"deg\" or \"rad\"")),
        None => Ok(Unit::SI),
    }
}

fn read_from(details: &Section<'_>) -> Result<AngleFrom, InputError> {
    let word = details.choice("from", &AngleFrom::WORDS)?;
    let word = word
        .ok_or_else(|| details.missing("from", "\"surface\" (0 is glancing) or \"normal\" (0 is head-on)"))?;
    Ok(AngleFrom::of(&word))
}

/// The list `columns` of `[key]`.
fn read_names(top: &Section<'_>, key: &str) -> Result<Vec<String>, InputError> {
    let Some(section) = top.section(key)? else { return Ok(Vec::new()) };
    let names = section.texts("columns")?.ok_or_else(|| section.missing("columns", "a list of columns"))?;
    section.finish()?;
    Ok(names.iter().map(|name| name.trim().to_owned()).collect())
}

fn read_layout(top: &Section<'_>) -> Result<Layout, InputError> {
    let plain = Layout::default();
    let separator = match top.text("separator")?.as_deref() {
        None => plain.separator,
        Some("tab") => b'\t',
        Some(",") => b',',
        Some(word) => match word.as_bytes() {
            &[mark @ (b';' | b'\t' | b'|')] => mark,
            _ => return Err(top.fault("separator", unknown(word, "separator", &[",", ";", "|", "tab"]))),
        },
    };
    let comment = match top.text("comment")?.as_deref() {
        None => plain.comment,
        Some("") => None,
        Some(word) => match word.as_bytes() {
            &[mark] if mark.is_ascii_punctuation() && mark != separator && mark != b'"' => Some(mark),
            _ => return Err(top.fault("comment", "must be one mark such as \"%\", or \"\" for none")),
        },
    };
    let header_line = top.number_within("header_line", 1.0, LAST_HEADER_LINE)?.unwrap_or(1.0);
    if header_line.fract() != 0.0 {
        return Err(top.fault("header_line", "must be a whole number"));
    }
    Ok(Layout { separator, comment, header_line: header_line as u64 })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fault(text: &str) -> String {
        ColumnMap::from_toml("map.toml", text).unwrap_err().to_string()
    }

    #[test]
    fn faults_name_place_and_remedy() {
        let unit = fault("[columns]\nv_n = \"V\"\nd = { column = \"size\", unit = \"micron\" }\n");
        assert!(unit.starts_with("map.toml:3:24: columns.d.unit: unknown unit `micron`"), "{unit}");
        assert!(unit.contains("m, mm, um"), "{unit}");
        assert!(fault("[columns]\nn_impact = \"V\"\n").contains("did you mean `n_impacts`"));
        assert!(fault("[colums]\nv_n = \"V\"\n").contains("did you mean `columns`"));
        assert!(fault("[columns]\nv_n = 3\n").contains("columns.v_n: expected a text"));
        assert!(fault("[columns]\nd = { unit = \"m\" }\n").contains("columns.d.column: missing"));
        assert!(
            fault("[columns]\noutcome = { column = \"a\", unit = \"1\" }\n").contains("unknown key `unit`")
        );
        assert!(fault("[columns]\nd = \"a\"\nv_n = \"a\"\n").contains("column `a` is already used for v_n"));
        assert!(
            fault("[columns]\nd = \"a\"\n[ignore]\ncolumns = [\"a\"]\n")
                .contains("also listed under [ignore]")
        );
        assert!(fault("[ignore]\ncolumns = \"a\"\n").contains("a list of texts"));
        assert!(fault("[ignore]\n").contains("ignore.columns: missing"));
        assert!(fault("separator = \"and\"\n").contains("unknown separator"));
        assert!(fault("decimal = \";\"\n").contains("decimal"));
        assert!(fault("comment = \"a\"\n").contains("one mark"));
        assert!(fault("separator = \";\"\ncomment = \";\"\n").contains("one mark"));
        assert!(fault("header_line = 0\n").contains("header_line"));
        assert!(fault("header_line = 1.5\n").contains("whole"));
    }

    #[test]
    fn an_angle_needs_unit_and_origin() {
        let angle = |rest: &str| fault(&format!("[columns]\nspeed = \"V\"\nangle = {rest}\n"));
        for rest in [
            "\"theta\"",
            "{ column = \"theta\", unit = \"deg\" }",
            "{ column = \"theta\", from = \"normal\" }",
        ] {
            let message = angle(rest);
            assert!(
                message.contains("map.toml:3:") && message.contains("deg") | message.contains("from"),
                "{message}"
            );
        }
        assert!(angle("{ column = \"t\", unit = \"deg\", from = \"wall\" }").contains("surface, normal"));
    }

    #[test]
    fn too_many_speeds_are_named() {
        let angle = "angle = { column = \"t\", unit = \"deg\", from = \"normal\" }\n";
        let message = fault(&format!("[columns]\nv_n = \"a\"\nspeed = \"b\"\n{angle}"));
        assert!(message.contains("v_n, speed, angle over-determine the velocity"), "{message}");
        assert!(fault("[columns]\nv_n = \"a\"\nspeed = \"b\"\n").contains("v_n, speed over-determine"));
    }
}
