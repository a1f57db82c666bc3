//! The page: what agrees, what differs and why, what cannot be checked and why.

use nearwall::report::{Block, Mark, Page, Table};

use crate::claim::{Claim, Verdict};
use crate::study::{Part, Study};

/// Every verdict in the order of the page, with its colour.
const VERDICTS: [(Verdict, Mark); 3] =
    [(Verdict::Agrees, Mark::Good), (Verdict::Differs, Mark::Watch), (Verdict::Unchecked, Mark::Open)];

/// What the studies come to, for someone who decides whether to use it.
const TRUST: &str = "Trust it for: the normal rebound of solid, dry particles from a harder wall once p_y is known (Thornton–Ning to \
    rounding, wax on Pyrex within the scatter of its measured strength); sliding and rolling with any spin; silicate viscosities \
    within their stated errors; deposit or splash of the drops that both papers saw.";
const CALIBRATE: &str = "Calibrate before use: yield strength of hot dust, char and ash (a factor of 3 and more is open, and only p_y is \
    seen in a rebound); work of adhesion; the reference viscosity; melting and conversion thresholds; agglomerates, powder layers and \
    gas lift, which describe what was seen and do not explain it.";
const DOUBT: &str = "Do not expect: who sticks in Pilot-PSI (no adhesion explains all sets); equal rebound from soft and hard walls, as \
    measured with wax (the law says 1.5 times more from soft ones); small, soft, adhesive particles by the default law (it lets go what \
    the flattened contact holds; thornton-ning-raised-pull-off does not); trends of droplet capture with speed and angle.";

/// The page of all studies.
pub fn page(studies: &[Study]) -> Page {
    let mut page = Page::new("nearwall: where it agrees with its sources, and where it does not");
    summary(&mut page, studies);
    for study in studies {
        page.add(Block::Heading(study.title.clone()));
        page.add(Block::Note(study.source.clone()));
        page.add(Block::Lead(study.lead.clone()));
        study.parts.iter().for_each(|part| add_part(&mut page, part));
    }
    page.foot("Made by validation/run; the published numbers and their sources stand in validation/.");
    page
}

fn summary(page: &mut Page, studies: &[Study]) {
    let total = |verdict| studies.iter().map(|study| study.count(verdict)).sum::<usize>();
    let all: usize = studies.iter().map(|study| study.claims().count()).sum();
    page.add(Block::Verdict(vec![
        format!(
            "Of {all} statements {} agree, {} differ and {} cannot be checked.",
            total(Verdict::Agrees),
            total(Verdict::Differs),
            total(Verdict::Unchecked)
        ),
        "A statement agrees when our number lies within the uncertainty that the source states, or within half of its last \
         printed digit where it states none. \"Fitted\" marks numbers that a parameter was set to, so that their agreement \
         proves little; \"predicted\" and \"derived\" ones were not used."
            .to_owned(),
    ]));
    page.add(Block::Text(TRUST.to_owned()));
    page.add(Block::Text(CALIBRATE.to_owned()));
    page.add(Block::Text(DOUBT.to_owned()));
    let mut header = vec!["study".to_owned()];
    header.extend(VERDICTS.map(|(verdict, _)| verdict.name().to_owned()));
    header.push("in short".to_owned());
    let row = |study: &Study| {
        let mut row = vec![study.title.clone()];
        row.extend(VERDICTS.map(|(verdict, _)| study.count(verdict).to_string()));
        row.push(study.lead.clone());
        row
    };
    let table =
        Table { caption: String::new(), header, rows: studies.iter().map(row).collect(), text_columns: 0 };
    let marks =
        studies.iter().map(|study| if study.count(Verdict::Differs) == 0 { Mark::Good } else { Mark::Watch });
    page.add(Block::Marked(table, marks.collect()));
}

fn add_part(page: &mut Page, part: &Part) {
    if !part.heading.is_empty() {
        page.add(Block::Subheading(part.heading.clone()));
    }
    part.text.iter().for_each(|text| page.add(Block::Text(text.clone())));
    if !part.figures.is_empty() {
        page.add(Block::Figures(part.figures.clone()));
    }
    if !part.claims.is_empty() {
        let marks = part.claims.iter().map(|claim| mark(claim.verdict)).collect();
        page.add(Block::Marked(claims(&part.claims), marks));
    }
    part.tables.iter().for_each(|table| page.add(Block::Table(table.clone())));
}

fn mark(verdict: Verdict) -> Mark {
    VERDICTS.iter().find(|(known, _)| *known == verdict).map_or(Mark::Open, |(_, mark)| *mark)
}

fn claims(claims: &[Claim]) -> Table {
    let row = |claim: &Claim| {
        let cells: [&str; 7] = [
            claim.verdict.name(),
            &claim.place,
            &claim.what,
            &claim.published,
            &claim.ours,
            claim.basis_name(),
            &claim.why,
        ];
        cells.map(str::to_owned).to_vec()
    };
    let header = ["", "where", "what", "source", "here", "basis", "why, or what to know"];
    Table {
        caption: String::new(),
        header: header.map(str::to_owned).to_vec(),
        rows: claims.iter().map(row).collect(),
        text_columns: 7,
    }
}
