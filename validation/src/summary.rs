//! The page in short, as Markdown: what is kept beside the code and compared with every run.

use crate::claim::Verdict;
use crate::page::{self, ADVICE};
use crate::study::SourceStudy;

/// Every statement of every study, without pictures.
pub fn summary(studies: &[SourceStudy]) -> String {
    let all: usize = studies.iter().map(|study| study.claims().count()).sum();
    let total = |verdict| studies.iter().map(|study| study.count(verdict)).sum::<usize>();
    let mut text = format!(
        "# Validation\n\nWritten by `validation/run`, which also writes the page with figures, \
         `target/validation/report.html`. `tests/run` fails when this file and a run differ.\n\nOf {all} \
         statements {} agree, {} differ and {} cannot be checked. A statement agrees when the library's \
         number lies within the stated uncertainty, or within half of the last printed digit where none is \
         stated. \"Fitted\": a parameter was fitted to that number, so agreement proves little.\n",
        total(Verdict::Agrees),
        total(Verdict::Differs),
        total(Verdict::Unchecked)
    );
    for paragraph in ADVICE {
        text += &format!("\n{paragraph}\n");
    }
    let overview = page::overview(studies);
    text += &format!("\n{}", rows(&overview.header, &overview.rows));
    for study in studies {
        text += &format!("\n## {}\n{}\n", study.title, study.source);
        for part in study.parts.iter().filter(|part| !part.claims.is_empty()) {
            if !part.heading.is_empty() {
                text += &format!("\n### {}\n", part.heading);
            }
            let claims: Vec<_> = part.claims.iter().map(page::row).collect();
            text += &format!("\n{}", rows(&page::HEADER, &claims));
        }
    }
    text
}

/// A table in Markdown.
fn rows<T: AsRef<str>, R: AsRef<[T]>>(header: &[impl AsRef<str>], rows: &[R]) -> String {
    let mut text = line(header) + &"|---".repeat(header.len()) + "|\n";
    text.extend(rows.iter().map(|row| line(row.as_ref())));
    text
}

fn line(cells: &[impl AsRef<str>]) -> String {
    let cell = |cell: &dyn AsRef<str>| cell.as_ref().replace('|', "\\|").replace('*', "\\*");
    format!("| {} |\n", cells.iter().map(|text| cell(text)).collect::<Vec<_>>().join(" | "))
}

/// Whether two lines say the same: numbers may differ by the last digits, as another machine's mathematical functions do, and by all
/// digits where they are rounding errors.
pub fn alike(one: &str, other: &str) -> bool {
    const ROUNDING: f64 = 1e-6;
    let words = |line: &str| -> Vec<String> {
        let split = line.split([' ', '[', ']', '(', ')', ',', ';', '%', ':']);
        // The full stop behind a number is not its own.
        split.map(|word| word.trim_end_matches('.').to_owned()).collect()
    };
    let (one, other) = (words(one), words(other));
    let same = |(a, b): (&String, &String)| match (a.parse::<f64>(), b.parse::<f64>()) {
        (Ok(a), Ok(b)) => (a - b).abs() <= 0.005 * a.abs().max(b.abs()) || a.abs().max(b.abs()) < ROUNDING,
        _ => a == b,
    };
    one.len() == other.len() && one.iter().zip(&other).all(same)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]
    use super::alike;

    /// The README's counts of both papers are those of the kept summary.
    #[test]
    fn the_readme_counts_as_the_summary() {
        let root = concat!(env!("CARGO_MANIFEST_DIR"), "/..");
        let read = |name: &str| std::fs::read_to_string(format!("{root}/{name}")).unwrap();
        let (summary, readme) = (read("docs/validation.md"), read("README.md"));
        for (study, paper) in [("| Tungsten dust", "| tungsten paper"), ("| Wax on targets", "| wax paper")] {
            let row = summary.lines().find(|line| line.starts_with(study)).unwrap();
            let counts: Vec<&str> = row.split('|').skip(2).take(3).map(str::trim).collect();
            let line = readme.lines().find(|line| line.starts_with(paper)).unwrap();
            for (count, word) in counts.iter().zip([" agree", " differ", " cannot"]) {
                assert!(line.contains(&format!(" {count}{word}")), "{count}{word} is not in {line}");
            }
        }
    }

    #[test]
    fn lines_are_alike_up_to_rounding() {
        assert!(alike("| agrees | 0.2913 [1] | 4e-11 |", "| agrees | 0.2914 [1] | 9e-12 |"));
        assert!(alike("within 4.441e-16. 63 agree", "within 2.22e-16. 63 agree"));
        assert!(!alike("| agrees | 0.2913 |", "| differs | 0.2913 |"));
        assert!(!alike("| agrees | 0.2913 |", "| agrees | 0.30 |"));
        assert!(!alike("one", "one more"));
    }
}
