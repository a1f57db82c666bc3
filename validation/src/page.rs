//! The page: what agrees, what differs and why, what cannot be checked and why.

use nearwall_lab::report::{Figure, Page, RowStatus, Table};

use crate::claim::{Claim, Verdict};
use crate::study::{SourceStudy, StudyPart, table};

/// Every verdict in the order of the page, with its colour.
const VERDICTS: [(Verdict, RowStatus); 3] = [
    (Verdict::Agrees, RowStatus::Good),
    (Verdict::Differs, RowStatus::Watch),
    (Verdict::Unchecked, RowStatus::Open),
];

const TRUST: &str = "Reliable: the normal rebound of solid, dry particles from a harder wall, if the \
    limiting pressure p_y is known (Thornton and Ning's law to rounding, wax on Pyrex within the scatter of \
    its measured strength); sliding and rolling with any spin, if the friction is known; silicate \
    viscosities within their stated errors; the capture of the molten drops of both papers.";
const CALIBRATE: &str = "Calibrate before use: yield strength of hot dust, char and ash (uncertain by a \
    factor of 3 or more; a rebound depends only on p_y); work of adhesion; the reference viscosity; melting \
    and conversion thresholds; agglomerates, powder layers and gas lift, which describe observations \
    without explaining them.";
const DOUBT: &str = "Not predicted: which particles stick in Pilot-PSI (no work of adhesion fits all sets); \
    equal rebound from soft and hard walls, as measured with wax (the law gives clearly more from soft \
    walls); the sticking of small, soft, adhesive particles by the default law (it omits the larger \
    pull-off of the flattened contact, which thornton-ning-raised-pull-off includes); trends of droplet \
    capture with speed and angle.";

/// What the studies come to, for someone who decides whether to use it.
pub const ADVICE: [&str; 3] = [TRUST, CALIBRATE, DOUBT];

/// The page of all studies.
pub fn page(studies: &[SourceStudy]) -> Page {
    let mut page = Page::new("nearwall: comparison with its sources");
    summary(&mut page, studies);
    for study in studies {
        page.heading(study.title.clone());
        page.note(study.source.clone());
        page.lead(study.lead.clone());
        study.parts.iter().for_each(|part| add_part(&mut page, part));
    }
    page.foot("Written by validation/run. The published numbers and their sources are in validation/.");
    page
}

fn summary(page: &mut Page, studies: &[SourceStudy]) {
    let total = |verdict| studies.iter().map(|study| study.count(verdict)).sum::<usize>();
    let all: usize = studies.iter().map(|study| study.claims().count()).sum();
    page.verdict(vec![
        format!(
            "Of {all} statements {} agree, {} differ and {} cannot be checked.",
            total(Verdict::Agrees),
            total(Verdict::Differs),
            total(Verdict::Unchecked)
        ),
        "A statement agrees when the library's number lies within the stated uncertainty, or within half of \
         the last printed digit where none is stated. \"Fitted\" marks numbers to which a parameter was \
         fitted, so agreement proves little. \"Predicted\" and \"derived\" numbers were not used."
            .to_owned(),
    ]);
    for text in ADVICE {
        page.text(text);
    }
    let marks = studies
        .iter()
        .map(|study| if study.count(Verdict::Differs) == 0 { RowStatus::Good } else { RowStatus::Watch });
    page.marked(overview(studies), marks.collect());
}

/// The studies with their verdicts.
pub fn overview(studies: &[SourceStudy]) -> Table {
    let [agree, differ, open] = VERDICTS.map(|(verdict, _)| verdict.name());
    let header = format!("study | {agree} | {differ} | {open} | summary");
    let row = |study: &SourceStudy| {
        let mut row = vec![study.title.clone()];
        row.extend(VERDICTS.map(|(verdict, _)| study.count(verdict).to_string()));
        row.push(study.lead.clone());
        row
    };
    table("", 0, &header, studies.iter().map(row).collect())
}

fn add_part(page: &mut Page, part: &StudyPart) {
    if !part.heading.is_empty() {
        page.subheading(part.heading.clone());
    }
    part.text.iter().for_each(|text| page.text(plain(text)));
    if !part.figures.is_empty() {
        let captioned = |figure: &Figure| Figure { caption: plain(&figure.caption), ..figure.clone() };
        page.figures(part.figures.iter().map(captioned));
    }
    if !part.claims.is_empty() {
        let marks = part.claims.iter().map(|claim| mark(claim.verdict)).collect();
        page.marked(claims(&part.claims), marks);
    }
    part.tables.iter().for_each(|table| page.table(table.clone()));
}

fn mark(verdict: Verdict) -> RowStatus {
    VERDICTS.iter().find(|(known, _)| *known == verdict).map_or(RowStatus::Open, |(_, mark)| *mark)
}

/// Columns of the statements.
pub const HEADER: [&str; 7] = ["", "where", "what", "source", "here", "basis", "reason or remark"];

/// One statement.
pub fn row(claim: &Claim) -> [&str; 7] {
    let verdict = claim.verdict.name();
    [verdict, &claim.place, &claim.what, &claim.published, &claim.ours, claim.basis_name(), &claim.why]
}

fn claims(claims: &[Claim]) -> Table {
    table("", 7, &HEADER.join(" | "), claims.iter().map(|claim| row(claim).map(plain).to_vec()).collect())
}

/// Without the marks of code, which only Markdown knows.
fn plain(text: &str) -> String {
    text.replace('`', "")
}
