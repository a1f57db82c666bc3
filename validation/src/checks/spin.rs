//! Sliding and rolling beside a rigid sphere with spin, integrated over the impulse.

use nearwall::tangential::{ImpactKinematics, Rebound, TangentialLaw, critical_angle};
use nearwall_lab::report::{Chart, Figure, Table, number};

use super::{Result, WAX_ON_PYREX_FRICTION, WAX_PARTICLE_DIAMETER, wax_on_pyrex};
use crate::claim::{Claim, Published};
use crate::oracle::rigid_sphere::{RigidRebound, RigidSphere};
use crate::steps::even;
use crate::study::{Extent, StudyPart, table};
use crate::terms::term;

const PLACE: &str = "Routh's integration";

/// Normal restitution near which Troiano's 43° lies [1].
const E_N: f64 = 0.39;

/// `k` of a contact that is all but rigid [1].
const RIGID: f64 = 1e9;

/// Rounding of sums over the impulse.
const IMPULSE_ROUNDING: f64 = 1e-10;

/// A glancing impact of 1 m/s and what both make of it.
struct GlancingImpact {
    glance: ImpactKinematics,
    friction: f64,
    rigid: RigidRebound,
}

impl GlancingImpact {
    /// `degrees` from the surface, the rim as fast as `rim` times the particle along the wall at 45°.
    fn new(degrees: f64, rim: f64, friction: f64, e_n: f64, k: f64) -> Self {
        let (normal_speed, tangential_speed) = degrees.to_radians().sin_cos();
        let spin = 2.0 * rim * 0.5f64.sqrt() / WAX_PARTICLE_DIAMETER;
        let sphere = RigidSphere { normal_speed, tangential_speed, spin, diameter: WAX_PARTICLE_DIAMETER };
        let glance = ImpactKinematics {
            normal_speed,
            tangential_speed,
            diameter: WAX_PARTICLE_DIAMETER,
            spin,
            normal_restitution: e_n,
            stiffness_ratio: k,
        };
        Self { glance, friction, rigid: sphere.impact(friction, e_n, 200) }
    }

    /// Slip over what friction can do [1]: `|s|/(f (1+e_n) v_n)`; the rigid sphere sticks up to 7/2.
    fn slip(&self) -> f64 {
        let slip = self.glance.tangential_speed - 0.5 * self.glance.diameter * self.glance.spin;
        slip.abs() / (self.friction * (1.0 + self.glance.normal_restitution) * self.glance.normal_speed)
    }

    /// Difference of speed along the wall and of rim speed, in units of the impact speed [1].
    fn off(&self, rebound: Rebound) -> f64 {
        let u = rebound.restitution * self.glance.tangential_speed - self.rigid.tangential_speed;
        let rim = 0.5 * self.glance.diameter * (rebound.spin - self.rigid.spin);
        u.abs().max(rim.abs())
    }
}

/// All angles, spins both ways, frictions and normal restitutions.
fn cases(k: f64, extent: Extent) -> Vec<GlancingImpact> {
    let angles = even([0.5, 89.5], extent.count(1780));
    let mut cases = Vec::new();
    for rim in [-5.0, -1.0, -0.2, 0.0, 0.2, 1.0, 5.0] {
        for friction in [0.02, WAX_ON_PYREX_FRICTION, 1.0] {
            for e_n in [0.0, E_N, 1.0] {
                cases.extend(angles.clone().map(|angle| GlancingImpact::new(angle, rim, friction, e_n, k)));
            }
        }
    }
    cases
}

/// The rigid sphere sticks up to this slip over what friction can do [1].
const STICKS: f64 = 3.5;

/// Whether the library slides where the rigid sphere rolls.
fn in_window(case: &GlancingImpact, k: f64) -> bool {
    (0.5 * (7.0 - 1.0 / k)..=STICKS).contains(&case.slip())
}

/// Angles from the surface [degrees] at which sliding ends without spin: of the rigid sphere, and
/// as the library has it.
struct SlidingEnds {
    rigid: f64,
    library: f64,
}

impl SlidingEnds {
    fn new(k: f64) -> Self {
        Self { rigid: transition(k), library: critical_angle(WAX_ON_PYREX_FRICTION, E_N, k).to_degrees() }
    }
}

/// How far `e_t` falls below rolling in the window: `2k/(7k-1) - 2/7`.
fn jump(k: f64) -> f64 {
    2.0 * k / (7.0 * k - 1.0) - 2.0 / 7.0
}

fn sliding(case: &GlancingImpact) -> Rebound {
    TangentialLaw::Sliding { friction: case.friction }.rebound(&case.glance)
}

fn sliding_rolling(case: &GlancingImpact) -> Rebound {
    TangentialLaw::SlidingRolling { friction: case.friction }.rebound(&case.glance)
}

/// The law for a contact that is all but rigid.
fn stiff(case: &GlancingImpact) -> Rebound {
    let glance = ImpactKinematics { stiffness_ratio: RIGID, ..case.glance };
    TangentialLaw::SlidingRolling { friction: case.friction }.rebound(&glance)
}

/// The effect after some other rebound, which it has to replace.
fn by_effect(case: &GlancingImpact) -> Result<Rebound> {
    let before = Rebound { restitution: 0.1, spin: 7.0 };
    Ok(term("sliding-to-rolling", &[case.friction])?.effect().tangential(&case.glance, before))
}

fn largest(off: impl Iterator<Item = f64>) -> f64 {
    off.fold(0.0, f64::max)
}

pub fn part(extent: Extent) -> Result<StudyPart> {
    let k = wax_on_pyrex()?.stiffness_ratio;
    let cases = cases(k, extent);
    let (window, plain): (Vec<&GlancingImpact>, Vec<&GlancingImpact>) =
        cases.iter().partition(|case| in_window(case, k));
    let ends = SlidingEnds::new(k);
    let mut claims = rigid_sphere(&cases, &plain)?;
    claims.extend([end_of_sliding(&ends), within_the_window(k), reversals(&cases), energy(&cases)]);
    Ok(StudyPart {
        heading: "Impulse with spin: a rigid sphere with Coulomb friction".to_owned(),
        text: vec![cases_text(&cases), window_text(k, &ends, window.len())],
        tables: vec![windows()],
        figures: vec![over_angle(k, &ends), over_spin(k)],
        claims,
    })
}

fn cases_text(cases: &[GlancingImpact]) -> String {
    format!(
        "{} impacts: angles 0.5° to 89.5°, rim speeds up to five times the speed, both ways round, friction \
         0.02 to 1, e_n 0 to 1. The friction follows the slip s = u - omega d/2 of the contact point as the \
         normal impulse grows.",
        cases.len()
    )
}

/// `window` impacts lie in it.
fn window_text(k: f64, ends: &SlidingEnds, window: usize) -> String {
    format!(
        "The rigid sphere sticks where |s| <= 7/2 f (1+e_n) v_n. The library takes (7k-1)/(2k) in place of \
         7/2, as the paper does, which allows for an elastic contact. Between the two the library slides on \
         where the rigid sphere already rolls: for wax on Pyrex without spin (k = {}, f = {WAX_ON_PYREX_FRICTION}, e_n = \
         {E_N}) from {:.1}° to {:.1}°, a window of {:.1}°, in which e_t falls to {} in place of 5/7. \
         {window} of the impacts lie in it. That is no fault: an elastic contact (e_n = 1) slips throughout \
         from (7k-1)/(2k) on (next part); only the rolling above it is the rigid sphere's.",
        number(k),
        ends.rigid,
        ends.library,
        ends.library - ends.rigid,
        number(5.0 / 7.0 - jump(k))
    )
}

/// What is the same as the rigid sphere's; `plain` are the cases outside the window.
fn rigid_sphere(cases: &[GlancingImpact], plain: &[&GlancingImpact]) -> Result<Vec<Claim>> {
    let none = |what: &str, ours| Claim::derived(PLACE, what, Published::within(0.0, IMPULSE_ROUNDING), ours);
    let mut effect = 0.0f64;
    for case in plain {
        effect = effect.max(case.off(by_effect(case)?));
    }
    let slips = cases.iter().filter(|case| !case.rigid.sticks);
    let away = cases.iter().filter(|case| (case.slip() - STICKS).abs() > 1e-6);
    Ok(vec![
        none(
            "`sliding` while the contact slips throughout: largest difference of speed and rim speed \
             [impact speeds]",
            largest(slips.map(|case| case.off(sliding(case)))),
        ),
        none(
            "`sliding-rolling` outside the window: largest difference",
            largest(plain.iter().map(|case| case.off(sliding_rolling(case)))),
        ),
        none("effect `sliding-to-rolling` outside the window: largest difference", effect),
        none(
            "`sliding-rolling` with k = 10⁹ (rigid), at every angle: largest difference",
            largest(away.map(|case| case.off(stiff(case)))),
        ),
    ])
}

fn end_of_sliding(ends: &SlidingEnds) -> Claim {
    Claim::derived(
        PLACE,
        "angle from the surface at which sliding ends for k → ∞, acot(7/2 f (1+e_n)) [°]; here k = 10⁹ in \
         Eq. 11",
        Published::within(ends.rigid, 1e-6),
        critical_angle(WAX_ON_PYREX_FRICTION, E_N, RIGID).to_degrees(),
    )
    .because("found for the rigid sphere by bisection")
}

fn within_the_window(k: f64) -> Claim {
    let off = |case: &GlancingImpact| {
        (sliding_rolling(case).restitution - case.rigid.tangential_speed / case.glance.tangential_speed).abs()
    };
    Claim::derived(
        PLACE,
        "`sliding-rolling` within the window, without spin: largest difference in e_t, 2k/(7k-1) - 2/7",
        Published::within(jump(k), 1e-3),
        largest(window_without_spin(k).iter().map(off)),
    )
}

fn reversals(cases: &[GlancingImpact]) -> Claim {
    let reversals: u32 = cases.iter().map(|case| case.rigid.reversals).sum();
    Claim::derived_statement(
        PLACE,
        "the slip of a sphere never reverses: its normal and tangential motion are not coupled",
        "0 reversals",
        &format!("{reversals} in {} impacts", cases.len()),
        reversals == 0,
    )
}

fn energy(cases: &[GlancingImpact]) -> Claim {
    let gains =
        |case: &GlancingImpact| [sliding(case), sliding_rolling(case)].map(|rebound| gain(case, rebound));
    Claim::derived(
        "energy",
        "largest gain of energy of motion and spin along the wall, `sliding` and `sliding-rolling` [m²/s² \
         per mass]",
        Published::Below(1e-12),
        largest(cases.iter().flat_map(gains)),
    )
    .because(
        "`sliding` is bounded beyond the end of slip; without the bound it would create energy at steep \
         angles and with forward spin",
    )
}

/// What a rebound gains along the wall.
fn gain(case: &GlancingImpact, rebound: Rebound) -> f64 {
    let ImpactKinematics { normal_speed, tangential_speed, spin, diameter, .. } = case.glance;
    let sphere = RigidSphere { normal_speed, tangential_speed, spin, diameter };
    sphere.energy(rebound.restitution * tangential_speed, rebound.spin)
        - sphere.energy(tangential_speed, spin)
}

fn window_without_spin(k: f64) -> Vec<GlancingImpact> {
    let angles =
        even([1.0, 89.0], 8801).map(|angle| GlancingImpact::new(angle, 0.0, WAX_ON_PYREX_FRICTION, E_N, k));
    angles.filter(|case| in_window(case, k)).collect()
}

/// The angle [°] above which the rigid sphere sticks.
fn transition(k: f64) -> f64 {
    let (mut low, mut high) = (1.0, 89.0);
    while high - low > 1e-9 {
        let middle = 0.5 * (low + high);
        if GlancingImpact::new(middle, 0.0, WAX_ON_PYREX_FRICTION, E_N, k).rigid.sticks {
            high = middle
        } else {
            low = middle
        }
    }
    0.5 * (low + high)
}

fn windows() -> Table {
    let row = |k: f64| {
        let angle = |k: f64| critical_angle(WAX_ON_PYREX_FRICTION, E_N, k).to_degrees();
        let rigid = angle(RIGID);
        [
            number(k),
            format!("{rigid:.2}"),
            format!("{:.2}", angle(k)),
            format!("{:.2}", angle(k) - rigid),
            number(jump(k)),
        ]
        .to_vec()
    };
    table(
        &format!(
            "The window for f = {WAX_ON_PYREX_FRICTION}, e_n = {E_N}, over Mindlin's k (Poisson's ratio 1/2, 0.3 and 0)"
        ),
        0,
        "k [1] | rigid [°] | library [°] | window [°] | largest difference in e_t [1]",
        [2.0 / 3.0, 0.7 / 0.85, 1.0].map(row).to_vec(),
    )
}

fn over_angle(k: f64, ends: &SlidingEnds) -> Figure {
    let of = |e_t: &dyn Fn(&GlancingImpact) -> f64| -> Vec<[f64; 2]> {
        let cases = even([5.0, 88.0], 831)
            .map(|angle| (angle, GlancingImpact::new(angle, 0.0, WAX_ON_PYREX_FRICTION, E_N, k)));
        cases.map(|(angle, case)| [angle, e_t(&case)]).collect()
    };
    let law = |law: TangentialLaw| of(&|case| law.rebound(&case.glance).restitution);
    Chart::new("e_t without spin, wax on Pyrex", "angle from the surface [°]", "e_t [1]")
        .line(
            "library, sliding-rolling",
            &law(TangentialLaw::SlidingRolling { friction: WAX_ON_PYREX_FRICTION }),
        )
        .line("rigid sphere", &of(&|case| case.rigid.tangential_speed / case.glance.tangential_speed))
        .line("library, sliding", &law(TangentialLaw::Sliding { friction: WAX_ON_PYREX_FRICTION }))
        .mark_x(ends.rigid, "")
        .mark_x(ends.library, "")
        .x_range(0.0, 90.0)
        .y_range(0.0, 1.0)
        .figure(
            "checks-spin-angle",
            "They part in the window between the thin lines only; `sliding` is not meant beyond it.",
        )
}

fn over_spin(k: f64) -> Figure {
    let rims = || even([-4.0, 4.0], 401);
    let library: Vec<[f64; 2]> = rims()
        .map(|rim| {
            let case = GlancingImpact::new(45.0, rim, WAX_ON_PYREX_FRICTION, E_N, k);
            [
                rim,
                TangentialLaw::SlidingRolling { friction: WAX_ON_PYREX_FRICTION }
                    .rebound(&case.glance)
                    .restitution,
            ]
        })
        .collect();
    let rigid: Vec<[f64; 2]> = rims()
        .map(|rim| {
            let case = GlancingImpact::new(45.0, rim, WAX_ON_PYREX_FRICTION, E_N, k);
            [rim, case.rigid.tangential_speed / case.glance.tangential_speed]
        })
        .collect();
    Chart::new("Spin at 45°, wax on Pyrex", "rim speed over speed along the wall [1]", "e_t [1]")
        .line("library, sliding-rolling", &library)
        .line("rigid sphere", &rigid)
        .mark_x(1.0, "")
        .y_range(0.5, 1.5)
        .figure(
            "checks-spin",
            "At 1 (thin line) it rolls as it comes. Positive spin rolls forward: fast forward spin drives \
             the particle on (e_t above 1), backspin brakes it. The jumps of the library are the two ends \
             of its window.",
        )
}
