//! Captures that the file does not have, and blank temperatures.

use crate::campaign::System;
use crate::own_laws;
use crate::plant::Plant;
use crate::set_rng::SetRng;
use crate::sets;

use super::exact;
use super::expected::Expected;
use super::lab::{Common, Groups, Lab, Outcomes, Row, Shared};
use super::nulls;
use super::set::Plan;

/// Causes that capture by the state of the particle.
const CAPTURING: [&str; 2] = ["melting-transition", "conversion-transition"];
/// Known temperatures of a file of merged cells.
const KNOWN: usize = 5;

/// Rebounds alone, without a column of outcomes; e_n falls smoothly with the temperature and nothing sticks.
pub fn rebounds_only(index: usize, rng: &mut SetRng) -> Plan {
    let mut lab = warm(rng);
    lab.outcomes = Outcomes::Absent;
    lab.observed = [true, !index.is_multiple_of(2)];
    let (middle, width, most) =
        (rng.uniform((335.0, 365.0)), rng.uniform((6.0, 20.0)), rng.uniform((0.3, 0.8)));
    lab.plant(Plant::normal("unknown:T_p", move |x, _, n| {
        n.e_n *= 1.0 - most / (1.0 + ((middle - x.t_p) / width).exp());
    }));
    let expected = Expected::cause(&["unknown:T_p", "thermal-softening"]).never(&CAPTURING);
    Plan::new(lab, 200, Expected { no_captures: true, ..expected })
}

/// Without this share of the temperatures, or with merged cells: the first of each of five blocks is known.
fn blank(rows: &mut [Row], share: Option<f64>, rng: &mut SetRng) {
    let block = rows.len().div_ceil(KNOWN);
    for (place, row) in rows.iter_mut().enumerate() {
        if share.map_or(place % block != 0, |share| rng.chance(share)) {
            row.seen.t_p = f64::NAN;
        }
    }
}

/// 30 % of the temperatures are blank, or all but five of 200; the base is right.
pub fn null(index: usize, rng: &mut SetRng) -> Plan {
    let share = index.is_multiple_of(2).then_some(0.3);
    let plan = nulls::plan(nulls::lab(rng), rng);
    let count = if share.is_some() { plan.count } else { 200 };
    Plan { count, fresh_alike: false, ..plan.changed(move |rows, rng| blank(rows, share, rng)) }
}

/// Melting, and 30 % of the temperatures are blank.
pub fn melting(index: usize, rng: &mut SetRng) -> Plan {
    let plan = exact::plan("melting-transition", index, rng).changed(|rows, rng| blank(rows, Some(0.3), rng));
    let expected = Expected { gain_may_be_larger: true, ..plan.expected.clone() };
    Plan { expected, fresh_alike: false, count: plan.count.max(150), ..plan }
}

/// All but five of 200 temperatures are blank: known is the first of each of five blocks with one setting.
fn merged_cells(lab: Lab, expected: Expected) -> Plan {
    let groups = Groups { column: None, count: KNOWN, shared: Shared::Drawn(0.0), common: Common::Setting };
    let plan = Plan::new(lab, 200, expected.never(&CAPTURING)).grouped(groups);
    Plan { fresh_alike: false, ..plan }.changed(|rows, rng| blank(rows, None, rng))
}

fn warm(rng: &mut SetRng) -> Lab {
    let mut lab = Lab::new(System::Wax, sets::any_law(System::Wax, rng), rng);
    lab.fast();
    lab.campaign.t_p = (300.0, 390.0);
    lab
}

/// Some particles stick, whatever their temperature, which is blank.
pub fn merged_captures(_: usize, rng: &mut SetRng) -> Plan {
    let mut lab = warm(rng);
    let rate = rng.uniform((0.1, 0.5));
    lab.plant(Plant::normal("background-capture", move |_, _, n| n.stick = n.stick.max(rate)));
    merged_cells(lab, Expected::nothing().allowing(&["background-capture", "level*"]))
}

/// The particles melt, and five temperatures are too few to say so.
pub fn merged_melting(_: usize, rng: &mut SetRng) -> Plan {
    let mut lab = warm(rng);
    lab.plant(own_laws::melting(rng.uniform((340.0, 365.0)), rng.uniform((4.0, 12.0)), 0.5));
    merged_cells(lab, Expected::cause(&["melting-transition"]))
}
