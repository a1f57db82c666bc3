//! How the cells of a file are separated and its numbers written, told from its first lines.

use super::csv_table::Layout;
use super::number::NumberStyle;

/// Separators that a file may have; of equally likely ones the first.
const SEPARATORS: [u8; 4] = [b',', b';', b'\t', b'|'];
/// Rows from which the notation is told.
const ROWS: usize = 100;

/// How a file is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Notation {
    pub(super) separator: u8,
    pub(super) decimal_comma: bool,
}

/// Why a notation is ambiguous: the line, counted from that of the header, and the problem with its remedy.
pub(super) type Ambiguity = (u64, String);

impl Notation {
    /// The notation of a file whose text begins so; what the layout states takes precedence.
    ///
    /// # Errors
    /// What is ambiguous.
    pub(super) fn of(head: &str, layout: &Layout) -> Result<Self, Ambiguity> {
        let text = head.replace("\r\n", "\n").replace('\r', "\n");
        let comment = |line: &str| layout.comment.is_some_and(|mark| line.as_bytes().first() == Some(&mark));
        let lines = text.split('\n').zip(1_u64..).skip(layout.header_line as usize - 1);
        let mut lines = lines.filter(|(line, _)| !line.trim().is_empty() && !comment(line));
        let header = lines.next().map_or("", |(line, _)| line);
        let rows: Vec<(&str, u64)> = lines.take(ROWS).collect();
        let separator = layout.separator.unwrap_or_else(|| separator(header, &rows));
        let decimal_comma = match layout.decimal_comma {
            Some(stated) => stated,
            None if separator == b',' => {
                unquoted_commas(header, &rows)?;
                decimal_comma(&rows, separator)?
            }
            None => decimal_comma(&rows, separator)?,
        };
        Ok(Self { separator, decimal_comma })
    }

    /// What is said of it; nothing of nearwall's own notation.
    pub(super) fn note(self) -> Option<String> {
        let separated = match self.separator {
            b';' => Some("semicolons"),
            b'\t' => Some("tabs"),
            b'|' => Some("bars"),
            _ => None,
        };
        let words: Vec<&str> =
            separated.into_iter().chain(self.decimal_comma.then_some("decimal commas")).collect();
        (!words.is_empty()).then(|| format!("read with {}", words.join(" and ")))
    }
}

/// Number of separators outside of quotation marks.
fn count(line: &str, separator: u8) -> usize {
    let quoted = |open: &mut bool, byte: u8| {
        *open ^= byte == b'"';
        Some(!*open && byte == separator)
    };
    line.bytes().scan(false, quoted).filter(|found| *found).count()
}

/// The separator of which most rows have as many as the header has.
fn separator(header: &str, rows: &[(&str, u64)]) -> u8 {
    let fits = |separator: u8| {
        let own = count(header, separator);
        let same = rows.iter().filter(|(row, _)| count(row, separator) == own).count();
        (own > 0).then_some((same, own))
    };
    let mut best = (b',', fits(b','));
    for other in SEPARATORS {
        let found = fits(other);
        if found > best.1 {
            best = (other, found);
        }
    }
    best.0
}

/// A number with this mark in it, and digits on both sides.
fn has_mark(cell: &str, mark: char) -> bool {
    let digits = |part: &str| part.chars().next().is_some_and(|digit| digit.is_ascii_digit());
    let split = cell.split_once(mark);
    let number = |cell: &str| {
        NumberStyle { decimal_comma: mark == ',', ..NumberStyle::default() }.parse(cell).is_some()
    };
    split.is_some_and(|(before, after)| {
        before.ends_with(|digit: char| digit.is_ascii_digit()) && digits(after) && number(cell)
    })
}

/// Whether numbers have decimal commas.
fn decimal_comma(rows: &[(&str, u64)], separator: u8) -> Result<bool, Ambiguity> {
    let (mut commas, mut points) = (Vec::new(), Vec::new());
    for (row, line) in rows {
        let mut reader =
            csv::ReaderBuilder::new().delimiter(separator).has_headers(false).from_reader(row.as_bytes());
        for cell in reader
            .records()
            .flatten()
            .flat_map(|record| record.iter().map(|cell| cell.trim().to_owned()).collect::<Vec<_>>())
        {
            if has_mark(&cell, ',') {
                commas.push((*line, cell));
            } else if has_mark(&cell, '.') {
                points.push((*line, cell));
            }
        }
    }
    match (commas.first(), points.first()) {
        (Some((line, comma)), Some((other, point))) if commas.len() == points.len() => Err((
            *line,
            format!(
                "`{comma}` and, on line {other}, `{point}`: set decimal = \",\" or decimal = \".\" in a column map"
            ),
        )),
        _ => Ok(commas.len() > points.len()),
    }
}

/// Refuses decimal commas between cells that are separated by commas, too.
fn unquoted_commas(header: &str, rows: &[(&str, u64)]) -> Result<(), Ambiguity> {
    let own = count(header, b',');
    let is_split = |(row, _): &&(&str, u64)| {
        let whole = row.split(',').filter(|cell| cell.trim().parse::<i64>().is_ok()).count();
        count(row, b',') > own && !row.contains('.') && 2 * whole > own + 1
    };
    match rows.first() {
        Some((_, line)) if rows.iter().filter(is_split).count() == rows.len() => Err((
            *line,
            "more cells than the header, all without decimal points: are these decimal commas? Separate the cells by \
             semicolons or tabs, or write decimal points"
                .to_owned(),
        )),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(head: &str) -> Result<(char, bool), Ambiguity> {
        let found = Notation::of(head, &Layout::default())?;
        Ok((char::from(found.separator), found.decimal_comma))
    }

    #[test]
    fn separators_and_decimal_marks_are_told_from_the_rows() {
        assert_eq!(of("v_n,e_n\n1.5,0.5\n"), Ok((',', false)));
        assert_eq!(of("v_n;e_n\n1,5;0,5\n"), Ok((';', true)));
        assert_eq!(of("v_n;e_n\r\n1.5;0.5\r\n"), Ok((';', false)));
        assert_eq!(of("# a;b,c\n\nv_n\te_n\n1,5\t0,5\n"), Ok(('\t', true)));
        assert_eq!(of("v_n|e_n\n1|1\n"), Ok(('|', false)));
        assert_eq!(of("v_n,\"a;b;c;d\"\n1.5,0.5\n"), Ok((',', false)));
        assert_eq!(of("speed, normal;e_n\n1,5;0,5\n2,5;0,5\n"), Ok((';', true)));
        assert_eq!(of("v_n,e_n\n\"1,5\",\"0,5\"\n"), Ok((',', true)));
        assert_eq!(of("v_n\n1.5\n"), Ok((',', false)));
        assert_eq!(of(""), Ok((',', false)));
        // The odd one out is a slip of one cell.
        assert_eq!(of("v_n;e_n\n1,5;0,5\n1,5;0.5\n"), Ok((';', true)));
    }

    #[test]
    fn what_is_ambiguous_is_refused_with_line_and_remedy() {
        let (line, problem) = of("# x\nv_n,d,e_n\n1,5,75,0,5\n2,5,75,0,4\n").unwrap_err();
        assert!(
            line == 3 && problem.contains("decimal commas?") && problem.contains("semicolons"),
            "{problem}"
        );
        let (line, problem) = of("v_n;e_n\n1,5;1\n1;0.5\n").unwrap_err();
        assert!(line == 2 && problem.contains("line 3") && problem.contains("decimal = "), "{problem}");
        assert_eq!(of("v_n,e_n\n1,0.5,\n"), Ok((',', false)), "a ragged row is not ambiguous");
    }
}
