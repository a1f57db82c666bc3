//! Fig 8: normal restitution against the normal speed.

use nearwall::Model;
use nearwall::normal::{Contact, NormalLaw, restitution, yield_velocity};
use nearwall_lab::report::{Chart, Figure};

use super::published::{
    DIAMETER_SPREAD, E_N_FIG_8, E_N_MEAN, FIGURE_SPEEDS, HARD_SPHERE, MODULUS_SPREAD, PYREX, SOLIDS, STEEP,
    STRENGTH_SPREAD, WAX_DIAMETER, YIELD_RATIO,
};
use super::{Result, arriving, contact, decide, mean_over_speeds, model, passes, thornton_ning};
use crate::steps::even;
use crate::{Claim, ClaimBasis, Published, StudyPart};

/// Speed between the ends of the figure [m/s] at which the door is tried.
const TYPICAL_SPEED: f64 = 1.25;
/// Where the `p_y/sigma_y` of a mean is looked for.
const FITTED_RATIOS: [f64; 2] = [0.3, 1.5];

/// The contact of wax and Pyrex with strength [Pa] and modulus [Pa] off by so much, and `c`.
fn wax(model: &Model, strength: f64, modulus: f64, c: f64) -> Result<Contact> {
    contact(model, "default", c, |wax| {
        wax.yield_strength += strength;
        wax.youngs_modulus += modulus;
    })
}

/// Mean `e_n` over the paper's speeds.
fn mean(contact: &Contact) -> f64 {
    mean_over_speeds(|v| thornton_ning(contact, WAX_DIAMETER, v))
}

/// Mean `e_n` on Pyrex with the paper's inputs.
pub(super) fn mean_on_pyrex() -> Result<f64> {
    Ok(mean(&wax(&model!("wax-on-pyrex.toml")?, 0.0, 0.0, YIELD_RATIO.value)?))
}

/// The contact of the paper's inputs.
struct Centre(Contact);

impl Centre {
    fn e_n(&self, speed: f64) -> f64 {
        thornton_ning(&self.0, WAX_DIAMETER, speed)
    }

    /// With the paper's `v_s` as printed.
    fn printed(&self, speed: f64) -> f64 {
        restitution(speed, PYREX.sticking[0], yield_velocity(&self.0))
    }

    fn without_adhesion(&self, speed: f64) -> f64 {
        restitution(speed, 0.0, yield_velocity(&self.0))
    }

    fn adhesive_velocity(&self) -> f64 {
        NormalLaw::ThorntonNing.speeds(&self.0, WAX_DIAMETER).adhesive
    }

    fn with(&self, c: f64) -> Contact {
        Contact { yield_ratio: c, ..self.0 }
    }

    /// The `c` of the stated mean.
    fn best(&self) -> f64 {
        passes(|c| mean(&self.with(c)), E_N_MEAN.value, FITTED_RATIOS)
    }

    /// The same with `v_s` as printed.
    fn best_printed(&self) -> f64 {
        let mean = |c| mean_over_speeds(|v| Self(self.with(c)).printed(v));
        passes(mean, E_N_MEAN.value, FITTED_RATIOS)
    }

    /// What the range of diameters moves `e_n` by at a speed [m/s].
    fn by_size(&self, speed: f64) -> f64 {
        let at = |diameter| thornton_ning(&self.0, diameter, speed);
        at(WAX_DIAMETER + DIAMETER_SPREAD) - at(WAX_DIAMETER - DIAMETER_SPREAD)
    }
}

/// The contact with each uncertain input moved by its deviation, the others kept: what raises `e_n`, what lowers it.
struct Moved([[Contact; 2]; 2]);

impl Moved {
    fn new(model: &Model) -> Result<Self> {
        let moved = |strength: f64, modulus: f64| wax(model, strength, modulus, YIELD_RATIO.value);
        Ok(Self([
            [moved(STRENGTH_SPREAD, 0.0)?, moved(-STRENGTH_SPREAD, 0.0)?],
            [moved(0.0, -MODULUS_SPREAD)?, moved(0.0, MODULUS_SPREAD)?],
        ]))
    }

    /// Low and high end of a quantity: what the inputs move it by is added in quadrature.
    fn ends(&self, centre: &Centre, of: impl Fn(&Contact) -> f64) -> [f64; 2] {
        let middle = of(&centre.0);
        [(1, -1.0), (0, 1.0)].map(|(side, sign)| {
            let squares: f64 = self.0.iter().map(|pair| (of(&pair[side]) - middle).powi(2)).sum();
            middle + squares.sqrt() * sign
        })
    }
}

/// The part on speed.
pub(super) fn part() -> Result<StudyPart> {
    let model = model!("wax-on-pyrex.toml")?;
    let centre = Centre(wax(&model, 0.0, 0.0, YIELD_RATIO.value)?);
    let moved = Moved::new(&model)?;
    Ok(StudyPart {
        heading: "Fig 8: the speed".to_owned(),
        text: vec![inputs_text(&centre, &moved), slip_text(&centre)],
        figures: vec![chart(&model, &centre, &moved)?],
        claims: [fit_claims(&model, &centre)?, plastic_claims(&centre), adhesion_claims(&model, &centre)?]
            .concat(),
        ..StudyPart::default()
    })
}

/// What the inputs say, and how well they are known.
fn inputs_text(centre: &Centre, moved: &Moved) -> String {
    let [slow, fast] = FIGURE_SPEEDS;
    let [low, high] = moved.ends(centre, mean);
    let [(_, _, modulus, strength), ..] = SOLIDS;
    let sizes =
        [WAX_DIAMETER - DIAMETER_SPREAD, WAX_DIAMETER + DIAMETER_SPREAD].map(|diameter| 1e6 * diameter);
    format!(
        "Thornton and Ning's law with the paper's inputs and c = {} has a mean e_n of {:.3} between {slow} \
         and {fast} m/s, {:.3} at {slow}, {:.3} at 1 and {:.3} at {fast} m/s; the deviations of sigma_y \
         ({:.0} %) and E ({:.0} %) alone, in quadrature, make that mean {low:.2} to {high:.2}. Sizes of \
         {:.0} to {:.0} µm move it by {:.3} at {slow} m/s and {:.3} at {fast}. So c is known no better than \
         sigma_y: only p_y = c sigma_y = {:.1} MPa enters, and the fit cannot tell a soft contact from a \
         softer wax.",
        YIELD_RATIO.value,
        mean(&centre.0),
        centre.e_n(slow),
        centre.e_n(1.0),
        centre.e_n(fast),
        100.0 * strength[1] / strength[0],
        100.0 * modulus[1] / modulus[0],
        sizes[0],
        sizes[1],
        centre.by_size(slow),
        centre.by_size(fast),
        centre.0.limiting_pressure() / 1e6
    )
}

/// What Table 4's slip does.
fn slip_text(centre: &Centre) -> String {
    let [slow, fast] = FIGURE_SPEEDS;
    format!(
        "Table 4's slip of ten in v_s decides the form at the low end. With the mended {:.2} m/s adhesion \
         lowers e_n at {slow} m/s from {:.2} to {:.2} and the curve is nearly flat, as the paper says of \
         its data (\"about constant\"); with the printed {} it falls from {:.2} to {:.2} and its mean is \
         {:.3}. Which of the two the authors drew cannot be read from the text. The best c for a mean of {} \
         is {:.2} or {:.2}.",
        centre.adhesive_velocity(),
        centre.without_adhesion(slow),
        centre.e_n(slow),
        PYREX.sticking[0],
        centre.printed(slow),
        centre.printed(fast),
        mean_over_speeds(|v| centre.printed(v)),
        E_N_MEAN.value,
        centre.best(),
        centre.best_printed()
    )
}

fn chart(model: &Model, centre: &Centre, moved: &Moved) -> Result<Figure> {
    let speeds: Vec<f64> = even([0.1, 3.5], 171).collect();
    let ends: Vec<[f64; 2]> = speeds
        .iter()
        .map(|speed| moved.ends(centre, |contact| thornton_ning(contact, WAX_DIAMETER, *speed)))
        .map(|ends| ends.map(|end| end.max(0.0)))
        .collect();
    let end = |side: usize| ends.iter().map(|ends| ends[side]).collect::<Vec<f64>>();
    let curve = |of: &dyn Fn(f64) -> f64| -> Vec<[f64; 2]> { speeds.iter().map(|v| [*v, of(*v)]).collect() };
    let hard = wax(model, 0.0, 0.0, 0.5 * (HARD_SPHERE[0] + HARD_SPHERE[1]))?;
    let stated: Vec<[f64; 2]> = even(FIGURE_SPEEDS, 6).map(|speed| [speed, E_N_MEAN.value]).collect();
    Ok(Chart::new("Normal restitution over the normal speed", "normal impact speed [m/s]", "e_n [1]")
        .x_range(0.0, 3.5)
        .y_range(0.0, 1.0)
        .band(&speeds, &end(0), &end(1))
        .line("c = 0.7", &curve(&|v| centre.e_n(v)))
        .line("c = 0.7 with the printed v_s", &curve(&|v| centre.printed(v)))
        .line("c = 2.8, hard sphere", &curve(&|v| thornton_ning(&hard, WAX_DIAMETER, v)))
        .points("stated mean", &stated)
        .figure(
            "troiano-speed",
            "Wax of 75 µm on Pyrex. Band: sigma_y ± 2.5 MPa and E ± 66 MPa. The points are the stated mean, \
             not data.",
        ))
}

/// Of the fit of `c`.
fn fit_claims(model: &Model, centre: &Centre) -> Result<Vec<Claim>> {
    let mean_of = |c: f64| mean(&centre.with(c));
    let least_hard = mean(&wax(model, -STRENGTH_SPREAD, MODULUS_SPREAD, HARD_SPHERE[0])?);
    let c = YIELD_RATIO;
    let [low, high] = [c.value - c.tolerance, c.value + c.tolerance];
    Ok(vec![
        E_N_MEAN.beside(mean(&centre.0), ClaimBasis::Fitted).because(&format!(
            "c = {} is the paper's fit and printed to one digit; {low:.2} to {high:.2} gives {:.3} to \
             {:.3}. Equal weights over the speeds are an assumption.",
            c.value,
            mean_of(low),
            mean_of(high)
        )),
        E_N_FIG_8.beside(mean(&centre.0), ClaimBasis::Fitted),
        c.beside(centre.best(), ClaimBasis::Fitted)
            .because(&format!("c for a mean e_n of {} with the corrected v_s.", E_N_MEAN.value)),
        Claim::predicted_statement(
            "Fig 8",
            "c = 2.6 to 3 (hard sphere) does not fit: mean e_n",
            "about 0.3",
            &format!("{:.2} to {:.2}", mean_of(HARD_SPHERE[0]), mean_of(HARD_SPHERE[1])),
            least_hard > 0.4,
        )
        .because(&format!("Also not with sigma_y and E at the ends of their uncertainty: {least_hard:.2}.")),
    ])
}

/// Of the plastic regime.
fn plastic_claims(centre: &Centre) -> Vec<Claim> {
    let (yielding, adhesive) = (yield_velocity(&centre.0), centre.adhesive_velocity());
    let [slow, fast] = FIGURE_SPEEDS;
    let kept = centre.e_n(fast) / centre.e_n(slow);
    let kept_without = centre.without_adhesion(fast) / centre.without_adhesion(slow);
    let top = even([0.05, fast], 2951)
        .map(|speed| [speed, centre.e_n(speed)])
        .max_by(|a, b| a[1].total_cmp(&b[1]))
        .unwrap_or([0.0; 2]);
    vec![
        Claim::predicted_statement(
            "Sec 4.1",
            "\"v_y < v_s\", so every impact from 0.5 m/s on is plastic",
            "6.8e-3 < 1.15e-2 m/s",
            &format!("{yielding:.4} < {adhesive:.3} m/s"),
            yielding < adhesive,
        ),
        Claim::predicted(
            "Sec 4.1",
            "largest e_n at any speed, \"less than 1\"",
            Published::Below(1.0),
            top[1],
        )
        .because(&format!("At {:.2} m/s.", top[0])),
        Claim::predicted_statement(
            "Sec 4.1",
            "e_n falls less steeply with speed in the plastic regime: e_n at 3 over e_n at 0.5 m/s",
            "\"less pronounced\"",
            &format!("{kept:.2}; without adhesion {kept_without:.2}"),
            kept > 0.6,
        )
        .because(&format!(
            "Far above v_y the law tends to v^(-1/4): six times the speed lowers e_n to {:.2} at the least.",
            (fast / slow).powf(-0.25)
        )),
    ]
}

/// Of adhesion, and of the door that users take.
fn adhesion_claims(model: &Model, centre: &Centre) -> Result<Vec<Claim>> {
    let [slow, fast] = FIGURE_SPEEDS;
    let over = |speed: f64| centre.without_adhesion(speed) / centre.e_n(speed);
    let added = [slow, TYPICAL_SPEED, fast].map(|speed| format!("{:.0}", 100.0 * (over(speed) - 1.0)));
    let by_door = decide(model, "default", &arriving(TYPICAL_SPEED, STEEP))?.normal_restitution;
    Ok(vec![
        Claim::predicted_statement(
            "Sec 4.1",
            "e_n \"is a function of the yield velocity only\": increase of e_n without adhesion at 0.5, \
             1.25, 3 m/s [%]",
            "nothing",
            &added.join(", "),
            over(slow) < 1.05,
        )
        .because(&format!(
            "At {slow} m/s adhesion takes {:.0} % of the energy that plasticity leaves. With the printed \
             v_s, ten times too small, the effect would be invisible.",
            100.0 * (1.0 - (centre.e_n(slow) / centre.without_adhesion(slow)).powi(2))
        )),
        Claim::derived(
            "Fig 8",
            "e_n at 1.25 m/s: `Model::resolve` over the law with the contact of this part [1]",
            Published::within(1.0, 1e-12),
            by_door / centre.e_n(TYPICAL_SPEED),
        ),
    ])
}
