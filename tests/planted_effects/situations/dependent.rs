//! No cause, and rows that are not independent without a label that says so.

use crate::set_rng::SetRng;

use super::expected::Expected;
use super::lab::{Common, Groups, Lab, Row, Shared};
use super::nulls::{lab, or_instrument, plan};
use super::set::Plan;

/// The lamp drifts in the order of the file, in which the temperature is swept: once up, or up and down.
pub fn swept(index: usize, rng: &mut SetRng) -> Plan {
    let lab = lab(rng);
    let (range, noise) = (lab.campaign.t_p, lab.campaign.noise_e_n);
    let (size, memory) = (noise * rng.uniform((0.8, 1.4)), rng.uniform((0.94, 0.98)));
    let sweeps = if index.is_multiple_of(2) { 1.0 } else { 2.0 + 2.0 * rng.unit() };
    or_instrument(plan(lab, rng)).changed(move |rows, rng| {
        let (count, mut drift) = (rows.len() as f64, rng.normal());
        for (place, row) in rows.iter_mut().enumerate() {
            let part = place as f64 / count * sweeps % 2.0;
            let t_p = range.0 + (range.1 - range.0) * if part < 1.0 { part } else { 2.0 - part };
            (row.x.t_p, row.seen.t_p) = (t_p, t_p);
            drift = memory * drift + (1.0 - memory * memory).sqrt() * rng.normal();
            row.measured[0] = row.measured[0].map(|e_n| (e_n + size * drift).max(0.0));
        }
    })
}

/// Bursts share temperatures, layers and the like, and an error as large as the noise; no column names them.
pub fn bursts(_: usize, rng: &mut SetRng) -> Plan {
    let count = 8 + rng.below(13);
    let groups = Groups { column: None, count, shared: Shared::Drawn(1.0), common: Common::Setting };
    or_instrument(plan(lab(rng), rng)).grouped(groups)
}

/// Every impact is read three times: the readings scatter less than the impacts.
pub fn three_readings(_: usize, rng: &mut SetRng) -> Plan {
    let lab = lab(rng);
    let reading = rng.uniform((0.1, 0.4)) * lab.campaign.noise_e_n;
    or_instrument(plan(lab, rng)).changed(move |rows, rng| {
        rows.truncate(rows.len().div_ceil(3));
        let mut read = |row: &Row| {
            let mut again = |value: f64| (value + reading * rng.normal()).max(0.0);
            Row { measured: row.measured.map(|value| value.map(&mut again)), ..row.clone() }
        };
        *rows = rows.iter().flat_map(|row| vec![row; 3]).map(&mut read).collect();
    })
}

/// Blocks that share an error, in half of the sets settings too; the column has an unusual name.
pub fn blocks(index: usize, rng: &mut SetRng) -> Plan {
    labelled(lab(rng), "block", &["unknown:block", "level*"], index, rng)
}

/// The same with dates.
pub fn measured_on(index: usize, rng: &mut SetRng) -> Plan {
    labelled(lab(rng), "measured_on", &["unknown:measured_on", "level*"], index, rng)
        .each(|row, _| row.given[0] = format!("2023-11-{:0>2}", row.given[0]))
}

fn labelled(lab: Lab, column: &'static str, itself: &[&'static str], index: usize, rng: &mut SetRng) -> Plan {
    let common = [Common::Nothing, Common::Setting][index % 2];
    let shared = Shared::Kept { size: 1.0, seed: rng.below(1 << 30) as u64 };
    let groups = Groups { column: Some(column), count: 5 + rng.below(8), shared, common };
    Plan { expected: Expected::nothing().allowing(itself), ..plan(lab, rng) }.grouped(groups)
}
