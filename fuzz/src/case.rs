//! A case file of `simulate`.

use std::path::Path;

use nearwall_lab::report::standalone_page;
use nearwall_lab::results::standalone::{Run, run, summary};
use nearwall_lab::simulate::Case;

use super::bytes::file;
use super::{place, whole};

const FILE: &str = "c.toml";

/// Cases that are accepted, with their models.
const WHOLE_CASE: [(&str, &str); 3] = [
    (
        include_str!("../../tutorials/standalone/waxRig.toml"),
        include_str!("../../tutorials/standalone/waxRig.model.toml"),
    ),
    (
        include_str!("../../tutorials/standalone/gasifier.toml"),
        include_str!("../../tutorials/standalone/gasifier.model.toml"),
    ),
    (
        include_str!("../../tutorials/standalone/tungstenDust.toml"),
        include_str!("../../tutorials/standalone/tungstenDust.model.toml"),
    ),
];

/// The case with its model under `[model]`.
fn in_one_file(case: &str, model: &str) -> String {
    let case = case.lines().filter(|line| !line.starts_with("model = "));
    let model = model.lines().map(|line| match line.strip_prefix("[[") {
        Some(rest) => format!("[[model.{rest}"),
        None => line.strip_prefix('[').map_or_else(|| line.to_owned(), |rest| format!("[model.{rest}")),
    });
    case.map(str::to_owned).chain(model).map(|line| line + "\n").collect()
}

/// Any text is refused with its place, or is a case that runs to a page. What only makes a run long is cut short.
pub fn case(bytes: &[u8]) {
    let texts: Vec<String> = WHOLE_CASE.iter().map(|(case, model)| in_one_file(case, model)).collect();
    let texts: Vec<&str> = texts.iter().map(String::as_str).collect();
    let Some(text) = file(&texts, bytes) else { return };
    let text = text.as_ref();
    let mut case = match Case::from_toml(FILE, text, Path::new("/nowhere")) {
        Err(error) => return place(&error.to_string(), FILE, text),
        Ok(case) => case,
    };
    for injection in &mut case.injections {
        injection.count = injection.count.min(2);
    }
    if let Some(deposit) = &mut case.deposit {
        deposit.steps = deposit.steps.min(3);
        deposit.bins = deposit.bins.min(3);
    }
    case.hit_limit = case.hit_limit.min(4);
    case.time_limit = case.time_limit.min(1e-2);
    case.tolerance = case.tolerance.max(1e-4);
    if let Some(sweep) = &mut case.sweep {
        sweep.values.truncate(2);
    }
    let runs: Result<Vec<Run>, String> = run(&mut case, |_, _, _, _| Ok(()));
    // A swept value that cannot be set is named.
    let Ok(runs) = runs else { return };
    for run in &runs {
        let totals = &run.totals.ends;
        let ends = [totals.captured, totals.escaped, totals.airborne, totals.given_up, totals.unusable];
        assert_eq!(ends.iter().map(|end| end.count).sum::<u64>(), totals.injected.count);
    }
    let _ = summary(&case, &runs);
    whole(&standalone_page(&case, &runs, 0).expect("a page"));
}
