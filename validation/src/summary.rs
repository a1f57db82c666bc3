//! The page in short, as Markdown: what is kept beside the code and compared with every run.

use crate::claim::{Claim, ClaimBasis, Verdict};
use crate::page::{self, ADVICE};
use crate::study::SourceStudy;

/// Columns of the statements that differ.
const SUMMARY_HEADER: [&str; 4] = ["statement", "source", "here", "reason"];

/// The counts, and every statement that differs.
pub fn summary(studies: &[SourceStudy]) -> String {
    let all: usize = studies.iter().map(|study| study.claims().count()).sum();
    let total = |verdict| studies.iter().map(|study| study.count(verdict)).sum::<usize>();
    let mut text = format!(
        "# Validation\n\nOf {all} statements {} agree, {} differ and {} cannot be checked. `validation/run` \
         computes them, writes\nthis file (`NEARWALL_BLESS=1`), and all statements with figures on \
         `target/validation/report.html`.\n`tests/run` fails when this file and a run differ.\n\n\
         A statement agrees when the library's number lies within the stated uncertainty, or within half of\n\
         the last printed digit where none is stated. \"Fitted\": a parameter was fitted to that number.\nSP and NSP: \
         sticky and non-sticky particle; SW and NSW: sticky and non-sticky wall.\n",
        total(Verdict::Agrees),
        total(Verdict::Differs),
        total(Verdict::Unchecked)
    );
    for paragraph in ADVICE {
        text += &format!("\n{}\n", wrapped(paragraph));
    }
    let overview = page::overview(studies);
    let counts = |cells: &[String]| cells[..4].to_vec();
    let studies_by_count: Vec<_> = overview.rows.iter().map(|cells| counts(cells)).collect();
    text += &format!("\n{}", rows(&counts(&overview.header), &studies_by_count));
    for study in studies {
        text += &misses(study);
    }
    text
}

/// The statements of a study that differ; empty if there are none.
fn misses(study: &SourceStudy) -> String {
    let mut claims: Vec<&Claim> = study.claims().filter(|claim| claim.verdict == Verdict::Differs).collect();
    // Statements that differ for one reason stand together.
    let reasons: Vec<&str> = claims.iter().map(|claim| first_sentence(&claim.why)).collect();
    claims.sort_by_key(|claim| reasons.iter().position(|reason| *reason == first_sentence(&claim.why)));
    let same = |a: &&Claim, b: &&Claim| first_sentence(&a.why) == first_sentence(&b.why);
    let differing: Vec<_> = claims.chunk_by(same).map(row).collect();
    if differing.is_empty() {
        return String::new();
    }
    format!("\n## {}\n{}\n\n{}", study.title, wrapped(&study.source), rows(&SUMMARY_HEADER, &differing))
}

/// Statements that differ for one reason; what is said alike of several places stands once, and so does a place.
fn row(claims: &[&Claim]) -> [String; 4] {
    let mut statements: Vec<String> = Vec::new();
    let mut previous = String::new();
    for alike in claims.chunk_by(|a, b| a.what == b.what) {
        let places = alike.iter().map(|claim| claim.place.as_str()).collect::<Vec<_>>().join(", ");
        let what = &alike[0].what;
        statements.push(if places == previous { what.clone() } else { format!("{places}: {what}") });
        previous = places;
    }
    let ours = |claim: &&Claim| {
        let fitted = if claim.basis == ClaimBasis::Fitted { " (fitted)" } else { "" };
        format!("{}{fitted}", claim.ours)
    };
    let published = claims.iter().map(|claim| claim.published.clone()).collect();
    let reason = first_sentence(&claims[0].why).to_owned();
    [statements.join("; "), listed(published), listed(claims.iter().map(ours).collect()), reason]
}

/// One value of each statement, in their order, or the value that all have.
fn listed(mut values: Vec<String>) -> String {
    if values.iter().all(|value| *value == values[0]) {
        values.truncate(1);
    }
    values.join("; ")
}

/// The text up to the first full stop before a capital letter or a quotation mark.
fn first_sentence(text: &str) -> &str {
    let begins = |rest: &str| rest.starts_with(|c: char| c.is_uppercase() || c == '"');
    let end = text.match_indices(". ").find(|(at, stop)| begins(&text[at + stop.len()..]));
    end.map_or(text, |(at, _)| &text[..=at])
}

/// Lines of at most 100 characters.
fn wrapped(text: &str) -> String {
    const WIDTH: usize = 100;
    let mut lines: Vec<String> = vec![String::new()];
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.is_empty() => line.push_str(word),
            Some(line) if line.chars().count() + 1 + word.chars().count() <= WIDTH => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines.join("\n")
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

/// Whether two lines say the same: numbers may differ by the last digits, as another machine's
/// mathematical functions do, and by all digits where they are rounding errors.
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
    use super::{alike, first_sentence};

    #[test]
    fn a_sentence_ends_before_a_capital_letter() {
        assert_eq!(first_sentence("See Eq. 3 and 1.5 m/s. Then more."), "See Eq. 3 and 1.5 m/s.");
        assert_eq!(first_sentence("no stop"), "no stop");
    }

    /// The README's counts of both papers are those of the kept summary.
    #[test]
    fn the_readme_counts_as_the_summary() {
        let root = concat!(env!("CARGO_MANIFEST_DIR"), "/..");
        let read = |name: &str| std::fs::read_to_string(format!("{root}/{name}")).unwrap();
        let (summary, readme) = (read("docs/why/validation.md"), read("README.md"));
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
