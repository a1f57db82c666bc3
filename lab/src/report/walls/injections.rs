//! What is captured of each injection, in a case with several.

use super::{RunComparison, Table, number, percent};
use crate::results::share;

pub(super) fn table(comparison: &RunComparison<'_>) -> Option<Table> {
    let [run] = comparison.runs else { return None };
    let header =
        ["injection", "particles", "mass [kg]", "captured particles", "captured mass [kg]", "captured mass"];
    let rows = run.injections.iter().map(|(name, injected, captured)| {
        vec![
            name.clone(),
            injected.count.to_string(),
            number(injected.mass()),
            captured.count.to_string(),
            number(captured.mass()),
            percent(share(captured.mass(), injected.mass())),
        ]
    });
    let caption = "Captured mass as a share of the mass that the injection started with.".to_owned();
    Some(Table { caption, header: header.map(str::to_owned).to_vec(), rows: rows.collect(), text_columns: 1 })
}
