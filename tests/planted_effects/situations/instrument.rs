//! The base is right, and the instrument or the geometry of the measurement is not what the file says.

use crate::contact::Tangential;
use crate::plant;
use crate::set_rng::SetRng;
use crate::sets;
use crate::world::Inputs;

use super::exact;
use super::expected::Expected;
use super::lab::{Lab, Outcome, Row};
use super::nulls;
use super::set::Plan;

/// Tilt of wall or camera [rad].
const TILT: f64 = 5.0 * std::f64::consts::PI / 180.0;

/// Impacts that all rebound.
fn lab(rng: &mut SetRng) -> Lab {
    let mut lab = nulls::lab(rng);
    lab.fast();
    lab
}

fn plan(lab: Lab, rng: &mut SetRng) -> Plan {
    Plan { expected: Expected::instrument(), ..nulls::plan(lab, rng) }
}

/// Speeds `[v_n, v_t]` and restitutions in a frame that is turned by an angle [rad] against the wall; `None`
/// where the frame sees no impact or no rebound.
pub fn turned(x: &Inputs, [e_n, e_t]: [f64; 2], angle: f64) -> Option<([f64; 2], [f64; 2])> {
    let (sin, cos) = angle.sin_cos();
    let arrival = [x.v_n * cos - x.v_t * sin, x.v_t * cos + x.v_n * sin];
    let (out, along) = (e_n * x.v_n, e_t * x.v_t);
    let rebound = [out * cos + along * sin, along * cos - out * sin];
    let seen = arrival.iter().all(|speed| *speed > 0.0) && rebound[0] > 0.0;
    seen.then(|| (arrival, [rebound[0] / arrival[0], rebound[1] / arrival[1]]))
}

/// Wall or camera is tilted by 5°: all speeds are those in the tilted frame.
pub fn tilted(index: usize, rng: &mut SetRng) -> Plan {
    let mut lab = lab(rng);
    lab.campaign.theta = (8.0, 65.0);
    let angle = if index.is_multiple_of(2) { TILT } else { -TILT };
    plan(lab, rng).changed(move |rows, _| rows.retain_mut(|row| turn(row, angle)))
}

/// Turns a rebound; whether it is still seen.
fn turn(row: &mut Row, angle: f64) -> bool {
    let [Some(e_n), Some(e_t)] = row.measured else { return false };
    let measured = turned(&row.x, [e_n, e_t], angle);
    let truth = turned(&row.x, [row.truth.e_n, row.truth.e_t], angle);
    let (Some(([v_n, v_t], seen)), Some((_, [e_n, e_t]))) = (measured, truth) else { return false };
    (row.seen.v_n, row.seen.v_t) = (v_n, v_t);
    (row.truth.e_n, row.truth.e_t) = (e_n, e_t);
    row.measured = seen.map(Some);
    true
}

/// Gas slows the particles down between the camera's window and the wall, on both ways (Stokes): by 3 to
/// 12 % of the least speed, for the mean size. Rebounds that do not reach the window are missing.
pub fn drag(_: usize, rng: &mut SetRng) -> Plan {
    let lab = lab(rng);
    let lost = window(&lab, rng);
    plan(lab, rng).changed(move |rows, _| rows.retain_mut(|row| slow_down(row, lost / row.x.d.powi(2))))
}

/// The speed that drag takes on the way to the wall, times the diameter squared [m³/s].
fn window(lab: &Lab, rng: &mut SetRng) -> f64 {
    let (d, least) = (lab.campaign.d, lab.campaign.v_n.0);
    rng.uniform((0.03, 0.12)) * least * d.0 * d.1
}

/// Linear drag takes as much of the normal speed on each way and keeps the direction.
fn slow_down(row: &mut Row, lost: f64) -> bool {
    let Inputs { v_n, v_t, .. } = row.x;
    let faster = (v_n + lost) / v_n;
    let slower = |e_n: f64| 1.0 - lost / (e_n * v_n);
    let both = |[e_n, e_t]: [f64; 2]| [e_n, e_t].map(|e| e * slower(e_n) / faster);
    (row.seen.v_n, row.seen.v_t) = (v_n * faster, v_t * faster);
    let [Some(e_n), Some(e_t)] = row.measured else { return false };
    row.measured = both([e_n, e_t]).map(Some);
    [row.truth.e_n, row.truth.e_t] = both([row.truth.e_n, row.truth.e_t]);
    slower(e_n) > 0.0 && row.truth.e_n > 0.0
}

/// The speed that this share of the base's rebounds stays below [m/s].
fn slow(lab: &Lab, share: (f64, f64), rng: &mut SetRng) -> f64 {
    let impacts: Vec<Inputs> = (0..1000).map(|_| lab.campaign.inputs(rng)).collect();
    let mut speeds: Vec<f64> = impacts.iter().map(|x| x.v_n * lab.base(x).e_n).collect();
    speeds.sort_by(f64::total_cmp);
    speeds[(1000.0 * rng.uniform(share)) as usize]
}

fn is_slower(row: &Row, limit: f64) -> bool {
    row.measured[0].is_some_and(|e_n| row.x.v_n * e_n < limit)
}

/// Slow rebounds are noted as stuck.
pub fn noted_as_stuck(_: usize, rng: &mut SetRng) -> Plan {
    let lab = lab(rng);
    let limit = slow(&lab, (0.08, 0.25), rng);
    plan(lab, rng).each(move |row, _| {
        if is_slower(row, limit) {
            row.outcome = Outcome::Stuck;
            row.measured = [None; 2];
            row.truth.stick = 1.0;
        }
    })
}

/// Slow rebounds are missing.
pub fn unseen(_: usize, rng: &mut SetRng) -> Plan {
    let mut lab = lab(rng);
    lab.campaign.noise_e_n = rng.uniform((0.05, 0.1));
    let limit = slow(&lab, (0.15, 0.35), rng);
    plan(lab, rng).changed(move |rows: &mut Vec<Row>, _| rows.retain(|row| !is_slower(row, limit)))
}

/// One camera sees the projection of `v_t` on its own plane; the plane of impact has any direction.
pub fn projected(_: usize, rng: &mut SetRng) -> Plan {
    let mut lab = lab(rng);
    let law = Tangential::SlidingRolling { friction: sets::rounded(rng.uniform((0.1, 0.35))) };
    (lab.model.tangential, lab.truth.tangential) = (law, law);
    lab.campaign.theta = (15.0, 75.0);
    plan(lab, rng).each(|row, rng| row.seen.v_t = row.x.v_t * rng.uniform((-1.4, 1.4)).cos())
}

/// The readings of e_n drift in the order of the file by 1.5 to 4 deviations of the noise: about the truth, or
/// away from it.
pub fn drift(index: usize, rng: &mut SetRng) -> Plan {
    let lab = lab(rng);
    let size = lab.campaign.noise_e_n * rng.uniform((1.5, 4.0)) * if rng.chance(0.5) { 1.0 } else { -1.0 };
    let right_at = if index.is_multiple_of(2) { 0.5 } else { 0.0 };
    plan(lab, rng).changed(move |rows, _| {
        let last = rows.len() as f64 - 1.0;
        for (place, row) in rows.iter_mut().enumerate() {
            let off = size * (place as f64 / last - right_at);
            row.measured[0] = row.measured[0].map(|e_n| (e_n + off).max(0.0));
        }
    })
}

/// Nothing drifts: the rows are sorted by speed, over which e_n falls by a law of the library or by one like it.
pub fn sorted(index: usize, rng: &mut SetRng) -> Plan {
    let plan = if index.is_multiple_of(2) {
        exact::plan("viscoelastic-loss", index, rng)
    } else {
        let mut lab = lab(rng);
        lab.plant(plant::viscoelastic_loss(rng.unit(), 2.0 * lab.campaign.v_n.1));
        let alike = ["viscoelastic-loss", "strain-rate-hardening", "unknown:v_n"];
        Plan::new(lab, 150 + rng.below(301), Expected::cause(&alike))
    };
    Plan { expected: plan.expected.clone().never(&["artefact:drift"]), ..plan }
        .changed(|rows, _| rows.sort_by(|one, other| one.seen.v_n.total_cmp(&other.seen.v_n)))
}

/// The laws that act beside an instrument.
const BESIDE: [&str; 4] = ["powder-layer", "size-dependent-yield", "thermal-softening", "viscoelastic-loss"];

/// A law of the library beside an instrument: the law, or a curve over its own input, may be said, and the instrument.
fn beside(index: usize, rng: &mut SetRng) -> Plan {
    let plan = exact::plan(BESIDE[index % BESIDE.len()], index, rng);
    let expected = Expected { parameters: vec![], ..plan.expected.clone() }.allowing(&["artefact:*"]);
    Plan { expected, ..plan }
}

/// A law of the library, measured with a wall or camera that is tilted by 5°.
pub fn tilted_law(index: usize, rng: &mut SetRng) -> Plan {
    let mut plan = beside(index, rng);
    plan.lab.campaign.theta = (8.0, 65.0);
    let angle = if rng.chance(0.5) { TILT } else { -TILT };
    plan.changed(move |rows, _| rows.retain_mut(|row| turn(row, angle)))
}

/// A law of the library, measured behind a window where drag takes 3 to 12 % of the least speed.
pub fn dragged_law(index: usize, rng: &mut SetRng) -> Plan {
    let plan = beside(index, rng);
    let lost = window(&plan.lab, rng);
    plan.changed(move |rows, _| rows.retain_mut(|row| slow_down(row, lost / row.x.d.powi(2))))
}

/// A law of the library whose slow rebounds are missing.
pub fn unseen_law(index: usize, rng: &mut SetRng) -> Plan {
    let mut plan = beside(index, rng);
    plan.lab.campaign.noise_e_n = rng.uniform((0.05, 0.1));
    let limit = slow(&plan.lab, (0.15, 0.35), rng);
    plan.changed(move |rows: &mut Vec<Row>, _| rows.retain(|row| !is_slower(row, limit)))
}

/// An effect, and every e_n is too large or too small by a constant.
pub fn bias(index: usize, rng: &mut SetRng) -> Plan {
    let plan = exact::plan(BESIDE[index % BESIDE.len()], index, rng);
    let size = rng.uniform((0.03, 0.08)) * if rng.chance(0.5) { 1.0 } else { -1.0 };
    let allowed = ["level*", "artefact:*", "instrument:*", "slip:*"];
    Plan { expected: plan.expected.clone().allowing(&allowed), ..plan }
        .each(move |row, _| row.measured[0] = row.measured[0].map(|e_n| (e_n + size).max(0.0)))
}
