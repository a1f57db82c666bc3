//! Maw, Barber & Fawcett: an elastic sphere whose contact gives along the wall, sticks in the middle and slips outside.
//!
//! The slip of the contact point `s = u1 - omega1 d/2` and the speed towards the wall `v_n` count only through
//!
//! ```text
//! psi = 2 k s/(f (1+e_n) v_n)
//! u2  = u1 - J,  omega2 = omega1 + 5 J/d,  J = s rho(psi, k)
//! ```
//!
//! `J` is the impulse along the wall per mass [m/s], `u` speed along the wall [m/s], `omega` spin
//! [rad/s], `d` diameter [m], `f` friction coefficient [1], `k` Mindlin's ratio of tangential to
//! normal stiffness [1] (2/3 to 4/3 for any pair of solids; the papers' `kappa` is `7k/4` for a
//! solid sphere, their `psi_1` is `psi`), `rho` the share of the slip that the wall takes [1].
//! Angular momentum about the contact point is kept. From `psi = 7k - 1` on friction acts through
//! the whole contact: `J = f (1+e_n) v_n`, as in `sliding`. Below it the stretched contact gives
//! part of its energy back: `e_t` falls past the end of sliding and rises again towards head-on.
//!
//! # Solution
//! `rho` is integrated over the impact: Hertz's contact as a row of springs over the contact
//! radius, each with its own friction (exact for Hertz and for Cattaneo's and Mindlin's partial
//! slip under any history of loads), over the phase `theta` of `v = v_n cos(theta)`. A row of
//! `NODES` values of `psi` for one of `TABLE_ROWS` values of `k` is computed when it is first
//! needed (1 ms) and kept; between them linear interpolation. Error of `e_t`: below 1e-3 (tests
//! compare with a finer integration; the independent integration of `validation/run`, "Independent
//! checks", agrees as well).
//!
//! # Sources
//! N. Maw, J. R. Barber, J. N. Fawcett, Wear 38 (1976) 101–114 and ASME J. Lubrication Technology
//! 103 (1981) 74–80 (theory; discs of steel and of rubber). K. L. Johnson, "Contact Mechanics",
//! 1985, section 11.4.
//!
//! # Range
//! The theory is elastic (`e_n = 1`), quasi-static, with one friction coefficient and without
//! adhesion, and for similar solids. For `e_n < 1` the impulses are scaled with the normal impulse,
//! `(1+e_n)/2` (usual, assumed): the end of sliding is then that of `sliding-rolling`, and no
//! energy is made. How a plastically flattened contact gives up its stretch is not described.
//! Measured: 5 mm alumina spheres on glass, `e_n` = 0.98 (Kharaz, Gorham & Salman 2001):
//! `tests/library/oblique_impact.rs`.

use std::f64::consts::PI;
use std::sync::OnceLock;

use super::{ImpactKinematics, ListedTangentialLaw, Rebound};
use crate::law::{Origin, Parameter, ParameterValues, QuantityKind, Search};

/// The law.
pub(super) static MAW_BARBER_FAWCETT: ListedTangentialLaw = ListedTangentialLaw {
    name: "maw-barber-fawcett",
    origin: &Origin {
        source: "Maw, Barber & Fawcett 1976, 1981",
        case: "elastic spheres with friction and partial slip",
        range: &[],
    },
    parameters: &[Parameter::new("friction", "1", (0.0, 10.0), Search::Linear(0.03, 0.9))
        .kind(QuantityKind::Share)
        .about("friction coefficient of the contact")],
    rebound,
};

/// Values of `psi` in a row, from 0 to the end of partial slip.
const NODES: usize = 49;

/// Values of `k` for which there is a row.
const TABLE_ROWS: usize = 17;

/// The `k` of the first and of the last row: Poisson's ratio one half and minus one.
const STIFFNESS: [f64; 2] = [2.0 / 3.0, 4.0 / 3.0];

/// Springs over the largest contact radius.
const SPRINGS: usize = 50;

/// Steps over the impact.
const INTEGRATION_STEPS: usize = 200;

static TABLE: [OnceLock<[f64; NODES]>; TABLE_ROWS] = [const { OnceLock::new() }; TABLE_ROWS];

fn rebound(kinematics: &ImpactKinematics, values: &ParameterValues) -> Rebound {
    let slip = kinematics.slip();
    let sliding = super::sliding::impulse(values[0], kinematics);
    let change = impulse(slip.abs(), sliding, kinematics.stiffness_ratio).copysign(slip);
    let left = Rebound { restitution: 1.0, spin: kinematics.spin + 5.0 * change / kinematics.diameter };
    if kinematics.tangential_speed > 0.0 {
        Rebound { restitution: 1.0 - change / kinematics.tangential_speed, ..left }
    } else {
        Rebound { restitution: 1.0 - share(0.0, kinematics.stiffness_ratio), ..left }
    }
}

/// Impulse along the wall per mass [m/s] for a slip [m/s], where gross sliding would give `sliding` [m/s].
fn impulse(slip: f64, sliding: f64, stiffness_ratio: f64) -> f64 {
    let end = 7.0 * stiffness_ratio - 1.0;
    let psi = 2.0 * stiffness_ratio * slip / sliding;
    // Also without friction, where `psi` is infinite or not a number.
    if psi < end { slip * share(psi / end, stiffness_ratio) } else { sliding }
}

/// Share of the slip that the wall takes [1], at `psi/(7k-1)`, 0 to 1.
fn share(along: f64, stiffness_ratio: f64) -> f64 {
    let [low, high] = STIFFNESS;
    let (row, above) = place((stiffness_ratio - low) / (high - low), TABLE_ROWS);
    let (node, past) = place(along, NODES);
    let in_row = |row: usize| {
        let values = TABLE[row].get_or_init(|| tabulate(row));
        values[node] + past * (values[node + 1] - values[node])
    };
    let first = in_row(row);
    (first + above * (in_row(row + 1) - first)) * share_at_end(stiffness_ratio)
}

/// Share of the slip that the wall takes where partial slip ends [1]: that of gross sliding at `psi = 7k - 1`.
fn share_at_end(stiffness_ratio: f64) -> f64 {
    2.0 * stiffness_ratio / (7.0 * stiffness_ratio - 1.0)
}

/// The node below a place between 0 and 1, and how far the place is on the way to the next node.
fn place(along: f64, nodes: usize) -> (usize, f64) {
    let scaled = along.clamp(0.0, 1.0) * (nodes - 1) as f64;
    let below = (scaled as usize).min(nodes - 2);
    (below, scaled - below as f64)
}

/// One row of the table: `rho` over its value at the end of partial slip [1], so that the law joins
/// gross sliding exactly.
fn tabulate(row: usize) -> [f64; NODES] {
    let [low, high] = STIFFNESS;
    let k = low + (high - low) * row as f64 / (TABLE_ROWS - 1) as f64;
    let end = 7.0 * k - 1.0;
    std::array::from_fn(|node| match node {
        // The integral is singular without slip, where `rho` has a limit.
        0 => integrate::<SPRINGS>(k, 1e-6 * end, INTEGRATION_STEPS) / share_at_end(k),
        _ if node == NODES - 1 => 1.0,
        _ => {
            integrate::<SPRINGS>(k, end * node as f64 / (NODES - 1) as f64, INTEGRATION_STEPS)
                / share_at_end(k)
        }
    })
}

/// Integrates the impact: the share of the slip that the wall takes [1].
///
/// Lengths along the normal are in units of the deepest approach `D`, stretch along the wall in
/// units of `f D/k`, so that the spring at `x` (in contact radii) holds at most `depth - x²`; slip
/// in units of `f v_n/k`, impulse of `f m v_n`.
fn integrate<const SPRINGS: usize>(k: f64, psi: f64, steps: usize) -> f64 {
    let places: [f64; SPRINGS] = std::array::from_fn(|i| ((i as f64 + 0.5) / SPRINGS as f64).powi(2));
    let mut stretch = [0.0; SPRINGS];
    let (mut slip, mut impulse, mut depth) = (psi, 0.0, 0.0);
    let step = PI / steps as f64;
    for index in 0..steps {
        let phase = (index as f64 + 0.5) * step;
        // From v = cos(theta), Hertz gives depth = sin(theta)^(4/5) and dt = (4/5) sin(theta)^(-1/5) dtheta.
        let before = depth;
        depth = phase.sin().powf(0.8);
        let time = if index == 0 { depth } else { 0.8 * (phase - 0.5 * step).sin().powf(-0.2) * step };
        let ratio = shear(&mut stretch, &places, [before, depth], slip * time);
        let pressed = (phase - 0.5 * step).cos() - (phase + 0.5 * step).cos();
        slip -= 3.5 * k * ratio * pressed;
        impulse += ratio * pressed;
    }
    impulse * k / psi
}

/// Moves the springs along the wall by `moved` while the contact goes from one depth to another;
/// the tangential over friction times normal force [1].
fn shear(stretch: &mut [f64], places: &[f64], [before, depth]: [f64; 2], moved: f64) -> f64 {
    let (mut normal, mut tangential) = (0.0, 0.0);
    for (stretch, place) in stretch.iter_mut().zip(places) {
        let press = depth - place;
        if press <= 0.0 {
            *stretch = 0.0;
            continue;
        }
        // A spring that comes into contact on the way moves from there on.
        let touched = if depth > before { (press / (depth - before)).min(1.0) } else { 1.0 };
        *stretch = (*stretch + moved * touched).clamp(-press, press);
        normal += press;
        tangential += *stretch;
    }
    if normal > 0.0 { tangential / normal } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{kinematics, momentum_is_kept};
    use super::*;
    use approx::{assert_abs_diff_eq, assert_relative_eq};

    const WAX: ParameterValues = [0.28, 0.0, 0.0, 0.0];

    #[test]
    fn angular_momentum_about_the_contact_point_is_kept() {
        momentum_is_kept(|before| rebound(before, &WAX));
    }

    /// Table and interpolation against ten times the steps and four times the springs.
    #[test]
    fn the_table_is_as_accurate_as_stated() {
        for k in [2.0 / 3.0, 0.69, 0.78, 0.91, 1.0, 1.23, 4.0 / 3.0] {
            for along in [1e-4, 0.011, 0.05, 0.13, 0.21, 0.3, 0.47, 0.71, 0.93, 0.99, 1.0] {
                let fine = integrate::<200>(k, along * (7.0 * k - 1.0), 2000);
                assert_abs_diff_eq!(share(along, k), fine, epsilon = 1e-3);
            }
        }
    }

    /// A glancing sphere slides; the law joins gross sliding at the critical angle of `sliding-rolling`.
    #[test]
    fn glancing_spheres_slide() {
        let critical = super::super::critical_angle(0.28, 0.39, 0.676).to_degrees();
        for degrees in [1.0, 20.0, critical - 1e-6] {
            let before = kinematics(degrees, 0.0);
            let expected = super::super::sliding::rebound(0.28, &before);
            let found = rebound(&before, &WAX);
            assert_relative_eq!(found.restitution, expected.restitution, max_relative = 1e-9);
            assert_relative_eq!(found.spin, expected.spin, max_relative = 1e-9);
        }
    }

    /// Head-on nothing slips at first: only `k` counts, neither friction nor speed, and `e_t` has
    /// the limit of small speeds.
    #[test]
    fn head_on_friction_does_not_count() {
        let e_t = |friction: f64, degrees: f64| {
            rebound(&kinematics(degrees, 0.0), &[friction, 0.0, 0.0, 0.0]).restitution
        };
        assert_abs_diff_eq!(e_t(0.1, 89.9999), e_t(0.9, 89.9999), epsilon = 1e-4);
        let head_on = ImpactKinematics { tangential_speed: 0.0, ..kinematics(90.0, 0.0) };
        assert_abs_diff_eq!(rebound(&head_on, &WAX).restitution, e_t(0.28, 89.9999), epsilon = 1e-4);
    }

    /// A share of 4/7 would give the slip back whole; below it energy is lost. And friction bounds the impulse.
    #[test]
    fn no_share_makes_energy_or_exceeds_friction() {
        for k in [2.0 / 3.0, 0.8, 1.0, 1.2, 4.0 / 3.0] {
            for along in (0..=200).map(|i| f64::from(i) / 200.0) {
                let share = share(along, k);
                assert!(share > 0.0 && share < 4.0 / 7.0, "{k} {along}: {share}");
                assert!(share * along * (7.0 * k - 1.0) <= 2.0 * k * (1.0 + 1e-12), "{k} {along}: {share}");
            }
        }
    }

    /// The wall takes nothing without friction and nothing from a sphere that rolls; backspin is braked.
    #[test]
    fn without_friction_or_slip_nothing_changes() {
        let free = rebound(&kinematics(40.0, 100.0), &[0.0; 4]);
        assert_eq!((free.restitution, free.spin), (1.0, 100.0));
        let rolling = 2.0 * kinematics(60.0, 0.0).tangential_speed / 75e-6;
        let after = rebound(&kinematics(60.0, rolling), &WAX);
        assert_relative_eq!(after.restitution, 1.0, max_relative = 1e-12);
        assert!(rebound(&kinematics(60.0, -rolling), &WAX).spin > -rolling);
    }
}
