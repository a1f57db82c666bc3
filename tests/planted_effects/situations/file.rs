//! The files of a set: data, fresh impacts and model.

use crate::campaign::cell;
use crate::set_rng::SetRng;

use super::lab::{Lab, Outcome, Row};

/// The model file.
pub fn model(lab: &Lab) -> String {
    lab.campaign.system.model_of(&lab.model.contact, lab.model.tangential) + &lab.effects
}

/// The file of measurements.
pub fn measurements(lab: &Lab, rows: &[Row], rng: &mut SetRng) -> String {
    let any = |wanted: fn(&Row) -> bool| rows.iter().any(wanted);
    let mut observed: Vec<(&str, Cell)> = vec![];
    if any(|row| row.measured[0].is_some()) {
        observed.push(("e_n", |row| number(row.measured[0])));
    }
    if any(|row| row.measured[1].is_some()) {
        observed.push(("e_t", |row| number(row.measured[1])));
    }
    if lab.stated {
        observed.extend(observed.clone().iter().map(|(name, _)| match *name {
            "e_n" => ("e_n_err", error_of_e_n as Cell),
            _ => ("e_t_err", error_of_e_t as Cell),
        }));
    }
    if any(|row| matches!(row.outcome, Outcome::Stuck | Outcome::Rebound)) {
        observed.push(("outcome", outcome));
    }
    if any(|row| matches!(row.outcome, Outcome::Counts { .. })) {
        observed.push(("n_impacts", |row| counts(row).0));
        observed.push(("captured", |row| counts(row).1));
    }
    table(lab, rows, &observed, rng)
}

/// The file of inputs alone.
pub fn inputs(lab: &Lab, rows: &[Row], rng: &mut SetRng) -> String {
    table(lab, rows, &[], rng)
}

type Cell = fn(&Row) -> String;

fn table(lab: &Lab, rows: &[Row], observed: &[(&str, Cell)], rng: &mut SetRng) -> String {
    let inputs = lab.campaign.header().into_iter().filter(|name| !lab.given.contains(name));
    let inputs: Vec<&str> = inputs.collect();
    let averaged = lab.averaged.filter(|_| !observed.is_empty());
    let names = inputs.iter().chain(&lab.given).copied().chain(observed.iter().map(|(name, _)| *name));
    let mut header: Vec<&str> = names.collect();
    header.extend(averaged.map(|_| "n_impacts"));
    let mut text = header.join(",");
    for row in rows {
        let mut cells: Vec<String> = inputs.iter().map(|name| cell(name, &row.seen, rng)).collect();
        cells.iter_mut().filter(|cell| *cell == "NaN").for_each(String::clear);
        cells.extend(row.given.clone());
        cells.extend(observed.iter().map(|(_, cell)| cell(row)));
        cells.extend(averaged.map(|impacts| impacts.to_string()));
        assert_eq!(cells.len(), header.len(), "{header:?}");
        text += "\n";
        text += &cells.join(",");
    }
    text + "\n"
}

fn number(value: Option<f64>) -> String {
    value.map(|value| format!("{value:.6}")).unwrap_or_default()
}

fn error_of_e_n(row: &Row) -> String {
    number(row.measured[0].map(|_| row.sigma[0]))
}

fn error_of_e_t(row: &Row) -> String {
    number(row.measured[1].map(|_| row.sigma[1]))
}

fn outcome(row: &Row) -> String {
    if row.outcome == Outcome::Stuck { "stick" } else { "rebound" }.into()
}

fn counts(row: &Row) -> (String, String) {
    match row.outcome {
        Outcome::Counts { impacts, captured } => (impacts.to_string(), captured.to_string()),
        _ => Default::default(),
    }
}
