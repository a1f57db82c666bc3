//! No cause, but data as they are.

use crate::campaign::System;
use crate::set_rng::SetRng;
use crate::sets;

use super::expected::Expected;
use super::lab::{Common, Groups, Lab, Noise, Row, Shared};
use super::set::Plan;

/// Above this the camera sees a rebound.
const LIMIT: f64 = 0.2;

/// A base of any kind, with some irrelevant columns.
pub fn lab(rng: &mut SetRng) -> Lab {
    let system = sets::any_system(rng);
    Lab::new(system, sets::any_law(system, rng), rng)
}

/// Nothing is planted.
pub fn plan(lab: Lab, rng: &mut SetRng) -> Plan {
    Plan::new(lab, 150 + rng.below(451), Expected::nothing())
}

/// Normal errors.
pub fn clean(_: usize, rng: &mut SetRng) -> Plan {
    plan(lab(rng), rng)
}

/// The rows of a burst share an error as large as the noise; in half of the sets their inputs too.
pub fn bursts(index: usize, rng: &mut SetRng) -> Plan {
    let groups = Groups {
        column: Some("burst"),
        count: 8 + rng.below(13),
        shared: Shared::Drawn(1.0),
        common: [Common::Nothing, Common::Everything][index % 2],
    };
    plan(lab(rng), rng).grouped(groups)
}

/// The rows of a day share an error.
pub fn days(_: usize, rng: &mut SetRng) -> Plan {
    let size = rng.uniform((0.5, 1.5));
    let count = 4 + rng.below(5);
    let groups = Groups { column: Some("day"), count, shared: Shared::Drawn(size), common: Common::Nothing };
    plan(without(lab(rng), "day"), rng).grouped(groups).each(|row, _| {
        row.given[0] = format!("2021-03-{:0>2}", row.given[0]);
    })
}

/// A laboratory without this irrelevant column.
fn without(mut lab: Lab, column: &str) -> Lab {
    lab.campaign.extras.retain(|name| *name != column);
    lab
}

/// Every row stands in the file several times.
pub fn repeated(_: usize, rng: &mut SetRng) -> Plan {
    let times = 2 + rng.below(4);
    plan(lab(rng), rng).changed(move |rows, _| {
        let distinct = rows.len().div_ceil(times);
        rows.truncate(distinct);
        *rows = rows.iter().flat_map(|row| vec![row.clone(); times]).collect();
    })
}

/// Errors of 5 % in the speed and 10 % in the size, stated, where e_n changes fast over a narrow range of both.
pub fn input_errors(_: usize, rng: &mut SetRng) -> Plan {
    let mut plan = unstated_input_errors(0, rng);
    plan.lab.given = vec!["v_n_err", "d_err"];
    let misread = plan.change.take();
    plan.changed(move |rows, rng| {
        misread.iter().for_each(|misread| misread(rows, rng));
        for row in rows {
            row.given = vec![format!("{:e}", 0.05 * row.seen.v_n), format!("{:e}", 0.1 * row.seen.d)];
        }
    })
}

/// The same, not stated.
pub fn unstated_input_errors(_: usize, rng: &mut SetRng) -> Plan {
    let mut lab = lab(rng);
    let d = lab.campaign.d.1;
    lab.campaign.d = (0.85 * d, d);
    let speed = lab.truth.contact.sticking_speed(0.85 * d);
    lab.campaign.v_n = (1.4 * speed, 2.2 * speed);
    lab.campaign.noise_e_n = rng.uniform((0.01, 0.02));
    or_instrument(plan(lab, rng)).each(move |row, rng| {
        row.seen.v_n = row.x.v_n * (1.0 + 0.05 * rng.normal());
        row.seen.d = row.x.d * (1.0 + 0.1 * rng.normal()).max(0.2);
    })
}

/// With no cause, but with an instrument that may be named.
pub fn or_instrument(plan: Plan) -> Plan {
    Plan { expected: plan.expected.clone().allowing(&["artefact:*", "instrument:*"]), ..plan }
}

/// Slow rebounds are not seen; nothing says so.
pub fn truncated(_: usize, rng: &mut SetRng) -> Plan {
    let mut lab = Lab::new(System::Wax, sets::any_law(System::Wax, rng), rng);
    lab.fast();
    lab.campaign.noise_e_n = rng.uniform((0.03, 0.06));
    or_instrument(plan(lab, rng)).changed(|rows: &mut Vec<Row>, _| {
        rows.retain(|row| row.measured[0].is_none_or(|e_n| e_n >= LIMIT));
    })
}

/// Slow rebounds are not seen; the column map says so.
pub fn truncated_stated(index: usize, rng: &mut SetRng) -> Plan {
    let map = format!("[detection]\ne_n = {LIMIT}\n");
    Plan { map: Some(map), ..truncated(index, rng) }
}

/// Errors are only downwards.
pub fn skewed(index: usize, rng: &mut SetRng) -> Plan {
    let noise = [Noise::HalfNormal, Noise::Exponential][index % 2];
    or_instrument(plan(Lab { noise, ..lab(rng) }, rng))
}

/// Values have steps of 0.05.
pub fn rounded(_: usize, rng: &mut SetRng) -> Plan {
    plan(lab(rng), rng).each(|row, _| {
        row.measured = row.measured.map(|value| value.map(|value| (value / 0.05).round() * 0.05));
    })
}

/// The camera drifts in time.
pub fn drift(_: usize, rng: &mut SetRng) -> Plan {
    let mut lab = lab(rng);
    lab.given = vec!["time"];
    let size = lab.campaign.noise_e_n * rng.uniform((1.0, 3.0));
    let expected = Expected::nothing().allowing(&["unknown:time", "artefact:drift"]);
    Plan { expected, ..plan(lab, rng) }.changed(move |rows, _| {
        let count = rows.len() as f64;
        for (index, row) in rows.iter_mut().enumerate() {
            let part = index as f64 / count;
            row.given = vec![format!("{:.1}", 3600.0 * part)];
            row.measured[0] = row.measured[0].map(|e_n| (e_n + size * (part - 0.5)).max(0.0));
        }
    })
}

/// Errors have heavy tails.
pub fn heavy_tails(_: usize, rng: &mut SetRng) -> Plan {
    plan(Lab { noise: Noise::HeavyTails, ..lab(rng) }, rng)
}

/// Errors grow with the speed.
pub fn growing(_: usize, rng: &mut SetRng) -> Plan {
    plan(Lab { noise: Noise::WithSpeed, ..lab(rng) }, rng)
}

/// Two laboratories that differ by an offset.
pub fn laboratories(_: usize, rng: &mut SetRng) -> Plan {
    let expected = Expected::nothing().allowing(&["unknown:laboratory"]);
    Plan { expected, ..plan(lab(rng), rng) }.grouped(two_laboratories(rng))
}

/// Two laboratories that differ by one or two deviations of the noise.
pub fn two_laboratories(rng: &mut SetRng) -> Groups {
    let shared = Shared::Alternating(rng.uniform((1.0, 2.0)));
    Groups { column: Some("laboratory"), count: 2, shared, common: Common::Nothing }
}

/// Columns that mean nothing: fourteen of numbers and six of labels.
const IRRELEVANT: [&str; 20] = [
    "x01", "x02", "x03", "x04", "x05", "x06", "x07", "x08", "x09", "x10", "x11", "x12", "x13", "x14",
    "tag_a", "tag_b", "tag_c", "tag_d", "tag_e", "tag_f",
];

/// Twenty irrelevant columns.
pub fn irrelevant(_: usize, rng: &mut SetRng) -> Plan {
    let mut lab = lab(rng);
    lab.given = IRRELEVANT.to_vec();
    plan(lab, rng).each(|row, rng| {
        row.given = IRRELEVANT
            .iter()
            .enumerate()
            .map(|(i, _)| match i {
                0..5 => format!("{:.4}", rng.normal()),
                5..10 => format!("{:.4}", rng.uniform((0.0, 100.0))),
                10..14 => format!("{:.5e}", rng.log_uniform((1e-3, 1e3))),
                _ => ["p", "q", "r", "s", "t"][rng.below(2 + i % 4)].into(),
            })
            .collect();
    })
}
