//! The column map: names, units, words and separators of a laboratory's own file, from a TOML file.

use std::path::Path;

use super::column_names::{ANGLE_ERROR, ONLY_MAPPED, SPEED_ERROR, is_error, names, names_groups};
use super::csv_table::Layout;
use super::detection::Detection;
use super::headings::{self, FoundColumn};
use super::impact_velocity::{AngleFrom, over_determined};
use super::number::{NamedColumns, NumberColumn, NumberStyle};
use super::observed::OutcomeWords;
use super::row_error::HeaderError;
use super::unit::{Dimension, Unit, read_unit};
use nearwall::input::{Document, InputError, Section, unknown};

/// The format of a file of impacts. The default is nearwall's own: names as in [`INPUTS`], SI units, commas.
///
/// [`INPUTS`]: nearwall::impact::INPUTS
#[derive(Debug, Clone, Default)]
pub struct ColumnMap {
    file: String,
    pub(super) layout: Layout,
    pub(super) style: NumberStyle,
    pub(super) words: OutcomeWords,
    /// The origin of the column `angle`.
    pub(super) from: Option<AngleFrom>,
    sources: Vec<MappedColumn>,
    pub(super) ignored: Vec<String>,
    pub(super) labels: Vec<String>,
    pub(super) detection: Detection,
}

/// One line of `[columns]`.
#[derive(Debug, Clone)]
struct MappedColumn {
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
            map.ignored = read_names(top, "ignore")?;
            map.labels = read_names(top, "labels")?;
            map.detection = Detection::read(top)?;
            if let Some(columns) = top.section("columns")? {
                for (name, dimension) in names() {
                    map.read_source(&columns, name, dimension)?;
                }
                map.check_errors(&columns)?;
                columns.finish()?;
                if let Some(problem) = over_determined(|key| map.source(key).is_some()) {
                    return Err(top.fault("columns", problem.to_string()));
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
        let is_section = columns.is_section(name);
        let (column, unit) = if is_section {
            let details = columns.required_section(name)?;
            let column = details.required_text("column")?;
            let unit = read_unit(&details, dimension)?;
            let unit = if is_error(name) { unit.of_difference() } else { unit };
            if name == "angle" {
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
        match name {
            "angle" if self.from.is_none() => {
                return Err(columns.fault(name, format!("state its unit and its origin: {ANGLE_EXAMPLE}")));
            }
            ANGLE_ERROR if !is_section => {
                return Err(columns.fault(name, "state its unit: { column = \"...\", unit = \"deg\" }"));
            }
            _ => {}
        }
        let column = column.trim().to_owned();
        self.check_unused(&column).map_err(|problem| columns.fault(name, problem))?;
        self.sources.push(MappedColumn { name, column, unit });
        Ok(())
    }

    /// Why a column cannot be mapped to a further name.
    fn check_unused(&self, column: &str) -> Result<(), String> {
        if let Some(other) = self.sources.iter().find(|other| other.column == column) {
            return Err(format!("column `{column}` is already used for {}", other.name));
        }
        if self.ignored.iter().any(|ignored| ignored == column) {
            return Err(format!("column `{column}` is also listed under [ignore]; remove one of the two"));
        }
        Ok(())
    }

    /// Refuses the error of a quantity that the map does not give.
    fn check_errors(&self, columns: &Section<'_>) -> Result<(), InputError> {
        for (error, of) in [(SPEED_ERROR, "speed"), (ANGLE_ERROR, "angle")] {
            if self.source(error).is_some() && self.source(of).is_none() {
                return Err(
                    columns.fault(error, format!("is the standard error of `{of}`, which has no column"))
                );
            }
        }
        Ok(())
    }

    /// Reads the numbers of this column, named as in the file or as in nearwall, as labels. Returns its name in
    /// [`super::Measurements::columns`], if it is one of them.
    pub fn label(&mut self, column: &str) -> String {
        match self.sources.iter().find(|source| source.column == column || source.name == column) {
            Some(source) => source.name.to_owned(),
            None => {
                self.labels.push(column.to_owned());
                column.to_owned()
            }
        }
    }

    fn source(&self, name: &str) -> Option<&MappedColumn> {
        self.sources.iter().find(|source| source.name == name)
    }

    /// Whether the numbers of this column are labels.
    pub(super) fn reads_labels(&self, column: &str) -> bool {
        names_groups(column) || self.labels.iter().any(|label| label == column)
    }

    /// The same map with the notation of a file's numbers.
    pub(super) fn with_style(&self, style: NumberStyle) -> Self {
        Self { style, ..self.clone() }
    }

    /// Whether the map names this column of the file, and with it the unit.
    pub(super) fn maps(&self, column: &str) -> bool {
        self.sources.iter().any(|source| source.column == column)
    }

    /// Whether this column is not used at all.
    pub(super) fn ignores(&self, column: &str) -> bool {
        column.is_empty() || self.ignored.iter().any(|ignored| ignored == column)
    }

    /// Finds the columns that the map names among `headers`.
    ///
    /// # Errors
    /// The reason, if a column of the map is missing or a name has two columns.
    pub(super) fn name_columns(&self, headers: &csv::StringRecord) -> Result<NamedColumns, HeaderError> {
        let columns = names().map(|(name, dimension)| self.name_column(name, dimension, headers));
        Ok(NamedColumns { columns: columns.filter_map(Result::transpose).collect::<Result<_, _>>()? })
    }

    fn name_column(
        &self,
        name: &'static str,
        dimension: Dimension,
        headers: &csv::StringRecord,
    ) -> Result<Option<NumberColumn>, HeaderError> {
        let place = |column: &str| headers.iter().position(|header| header == column);
        // In measured data, markers of missing values are blanks.
        let style = NumberStyle { markers: true, ..self.style };
        let found = |index, unit| Ok(Some(NumberColumn { name, index, unit, style }));
        let free = |header: &str| !self.ignores(header) && !self.maps(header);
        let own = if self.source(name).is_none() && !ONLY_MAPPED.contains(&name) {
            headings::find(name, dimension, headers, free)?
        } else {
            place(name).filter(|_| free(name)).map(|index| FoundColumn { index, unit: Unit::SI })
        };
        match (self.source(name), own) {
            (None, _) if ONLY_MAPPED.contains(&name) => Ok(None),
            (None, None) => Ok(None),
            (None, Some(own)) => found(own.index, own.unit),
            (Some(source), Some(_)) => {
                Err(HeaderError::TwoColumns { map: self.file.clone(), name, column: source.column.clone() })
            }
            (Some(source), None) => match place(&source.column) {
                Some(index) => found(index, source.unit),
                None => Err(self.absent(source, headers)),
            },
        }
    }

    fn absent(&self, source: &MappedColumn, headers: &csv::StringRecord) -> HeaderError {
        let known: Vec<&str> = headers.iter().filter(|header| !header.is_empty()).collect();
        let problem = unknown(&source.column, "column", &known);
        HeaderError::NoColumn { map: self.file.clone(), name: source.name, problem }
    }

    /// Parses a number of a possible cause.
    pub(super) fn parse(&self, cell: &str) -> Option<f64> {
        self.style.parse(cell).filter(|number| number.is_finite())
    }
}

/// An example of an angle's entry.
const ANGLE_EXAMPLE: &str = r#"angle = { column = "...", unit = "deg", from = "surface" } (0 is glancing) or from = "normal" (0 is head-on)"#;

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
        Some("tab") => Some(b'\t'),
        Some(",") => Some(b','),
        Some(word) => match word.as_bytes() {
            &[mark @ (b';' | b'\t' | b'|')] => Some(mark),
            _ => return Err(top.fault("separator", unknown(word, "separator", &[",", ";", "|", "tab"]))),
        },
    };
    let comment = match top.text("comment")?.as_deref() {
        None => plain.comment,
        Some("") => None,
        Some(word) => match word.as_bytes() {
            &[mark] if mark.is_ascii_punctuation() && Some(mark) != separator && mark != b'"' => Some(mark),
            _ => return Err(top.fault("comment", "must be one mark such as \"%\", or \"\" for none")),
        },
    };
    let decimal_comma = top.choice("decimal", &[".", ","])?.map(|mark| mark == ",");
    let header_line = top.number_within("header_line", 1.0, LAST_HEADER_LINE)?.unwrap_or(1.0);
    if header_line.fract() != 0.0 {
        return Err(top.fault("header_line", "must be a whole number"));
    }
    Ok(Layout { separator, decimal_comma, comment, header_line: header_line as u64 })
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
        let with_error = |entry: &str| {
            angle(&format!("{{ column = \"t\", unit = \"deg\", from = \"normal\" }}\nangle_err = {entry}"))
        };
        assert!(with_error("\"e\"").contains("columns.angle_err: state its unit"));
        assert!(with_error("{ column = \"e\" }").contains("columns.angle_err.unit: missing"));
        assert!(
            with_error("{ column = \"e\", unit = \"deg\", from = \"normal\" }")
                .contains("unknown key `from`")
        );
        assert!(
            fault("[columns]\nv_n = \"V\"\nspeed_err = \"s\"\n")
                .contains("standard error of `speed`, which has no")
        );
        assert!(angle("{ column = \"t\", unit = \"deg\", from = \"wall\" }").contains("surface, normal"));
    }

    #[test]
    fn detection_limits_have_units_and_bounds() {
        let read = |text: &str| ColumnMap::from_toml("map.toml", text).unwrap().detection;
        let limits = read(
            "[detection]\ne_n = { value = 20, unit = \"%\" }\nrebound_speed = { value = 5, unit = \"cm/s\" }\n",
        );
        assert_eq!((limits.e_n, limits.rebound_speed), (Some(0.2), Some(0.05)));
        let impact = |normal_speed| nearwall::Impact { normal_speed, ..nearwall::Impact::default() };
        assert_eq!([0.1, 1.0].map(|speed| limits.least_e_n(&impact(speed))), [0.5, 0.2]);
        let limits = read("[detection]\nrebound_speed = 0.1\n");
        assert_eq!([0.5, 0.0].map(|speed| limits.least_e_n(&impact(speed))), [0.2, f64::INFINITY]);
        assert_eq!(Detection::default().least_e_n(&impact(0.0)), 0.0);
        assert!(fault("[detection]\n").contains("detection.e_n: missing"));
        assert!(fault("[detection]\ne_n = 0\n").contains("must be above 0"));
        assert!(fault("[detection]\nspeed = 0.2\n").contains("unknown key `speed`"));
        assert!(
            fault("[detection]\nrebound_speed = { value = 1, unit = \"m\" }\n").contains("unknown unit `m`")
        );
    }

    #[test]
    fn too_many_speeds_are_named() {
        let angle = "angle = { column = \"t\", unit = \"deg\", from = \"normal\" }\n";
        let message = fault(&format!("[columns]\nv_n = \"a\"\nspeed = \"b\"\n{angle}"));
        assert!(message.contains("v_n, speed, angle over-determine the velocity"), "{message}");
        assert!(fault("[columns]\nv_n = \"a\"\nspeed = \"b\"\n").contains("v_n, speed over-determine"));
    }
}
