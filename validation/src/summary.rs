//! The page in short, as Markdown: what is kept beside the code and compared with every run.

use std::fmt::Write;

use crate::claim::{Claim, Verdict};
use crate::study::Study;

/// Every statement of every study, without pictures.
pub fn summary(studies: &[Study]) -> String {
    let all: usize = studies.iter().map(|study| study.claims().count()).sum();
    let total = |verdict| studies.iter().map(|study| study.count(verdict)).sum::<usize>();
    let mut text = format!(
        "# Validation\n\nWritten by `validation/run`, which also makes the page with the pictures, `target/validation/report.html`; \
         `tests/run` fails when the two differ.\n\nOf {all} statements {} agree, {} differ and {} cannot be checked. A statement \
         agrees when our number lies within the uncertainty that the source states, or half of its last printed digit where it \
         states none. \"Fitted\": a parameter was set to that number, so its agreement proves little.\n",
        total(Verdict::Agrees),
        total(Verdict::Differs),
        total(Verdict::Unchecked)
    );
    for study in studies {
        let _ = write!(text, "\n## {}\n{}\n\n{}\n", study.title, study.source, study.lead);
        for part in &study.parts {
            if part.claims.is_empty() {
                continue;
            }
            if !part.heading.is_empty() {
                let _ = write!(text, "\n### {}\n", part.heading);
            }
            text += "\n| | where | what | source | here | basis | why, or what to know |\n|---|---|---|---|---|---|---|\n";
            text.extend(part.claims.iter().map(row));
        }
    }
    text
}

/// Whether two lines say the same: numbers may differ by the last digits, as another machine's mathematical functions do, and by all
/// digits where they are rounding errors.
pub fn alike(one: &str, other: &str) -> bool {
    const ROUNDING: f64 = 1e-6;
    let words = |line: &str| {
        line.split([' ', '[', ']', '(', ')', ',', ';', '%']).map(str::to_owned).collect::<Vec<_>>()
    };
    let (one, other) = (words(one), words(other));
    let same = |(a, b): (&String, &String)| match (a.parse::<f64>(), b.parse::<f64>()) {
        (Ok(a), Ok(b)) => (a - b).abs() <= 0.005 * a.abs().max(b.abs()) || a.abs().max(b.abs()) < ROUNDING,
        _ => a == b,
    };
    one.len() == other.len() && one.iter().zip(&other).all(same)
}

fn row(claim: &Claim) -> String {
    let cells = [
        claim.verdict.name(),
        &claim.place,
        &claim.what,
        &claim.published,
        &claim.ours,
        claim.basis_name(),
        &claim.why,
    ];
    format!("| {} |\n", cells.map(|cell| cell.replace('|', "\\|")).join(" | "))
}

#[cfg(test)]
mod tests {
    use super::alike;

    #[test]
    fn lines_are_alike_up_to_rounding() {
        assert!(alike("| agrees | 0.2913 [1] | 4e-11 |", "| agrees | 0.2914 [1] | 9e-12 |"));
        assert!(!alike("| agrees | 0.2913 |", "| differs | 0.2913 |"));
        assert!(!alike("| agrees | 0.2913 |", "| agrees | 0.30 |"));
        assert!(!alike("one", "one more"));
    }
}
