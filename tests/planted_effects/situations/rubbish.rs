//! A tenth of the values means nothing; several nuisances at once.

use crate::set_rng::SetRng;

use super::exact;
use super::lab::{Common, Groups, Lab, Noise, Row, Shared};
use super::nulls;
use super::set::Plan;

/// Share of e_n that is replaced.
const SHARE: f64 = 0.1;

fn replace(row: &mut Row, rng: &mut SetRng) {
    if rng.chance(SHARE) {
        row.measured[0] = row.measured[0].map(|_| rng.unit());
    }
}

/// A tenth of e_n is replaced by uniform values; the base is right.
pub fn null(_: usize, rng: &mut SetRng) -> Plan {
    nulls::or_instrument(nulls::plan(nulls::lab(rng), rng)).each(replace)
}

/// The same with one of the library's own laws.
pub fn law(index: usize, rng: &mut SetRng) -> Plan {
    exact::plan(["powder-layer", "size-dependent-yield", "thermal-softening"][index % 3], index, rng)
        .each(replace)
}

/// Heavy tails, sessions, steps of 0.02 and a few blank temperatures at once; the base is right.
pub fn everything(_: usize, rng: &mut SetRng) -> Plan {
    let lab = Lab { noise: Noise::HeavyTails, ..nulls::lab(rng) };
    let (count, shared) = (6 + rng.below(10), Shared::Drawn(rng.uniform((0.5, 1.0))));
    let groups = Groups { column: Some("session"), count, shared, common: Common::Setting };
    nulls::plan(lab, rng).grouped(groups).each(|row, rng| {
        row.measured = row.measured.map(|value| value.map(|value| (value / 0.02).round() * 0.02));
        if rng.chance(0.1) {
            row.seen.t_p = f64::NAN;
        }
    })
}
