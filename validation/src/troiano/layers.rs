//! Figs 10 and 11: powder on the target, dry and on syrup.

use nearwall::{Impact, Model, Outcome, global_restitution};
use nearwall_lab::report::{Chart, Figure, Table};

use super::published::{
    CAMERA, E_N_MEAN, E_N_SYRUP, E_N_THICK, E_N_THIN, FIGURE_SPEEDS, STEEP, StatedNumber, WAX_DENSITY,
    WAX_DIAMETER, YIELD_RATIO,
};
use super::{Result, arriving, decide, model};
use crate::steps::even;
use crate::study::table;
use crate::terms::first_value;
use crate::{Claim, ClaimBasis, StudyPart};

/// What lies on a wall of `layers.toml`, and the mean `e_n` that the paper states.
struct CoveringLayer {
    wall: &'static str,
    /// Thickness of the powder [mm].
    thickness: f64,
    /// Below the powder.
    below: &'static str,
    stated: StatedNumber,
}

/// Bare, thin, thick, on syrup.
const LAYERS: [CoveringLayer; 4] = [
    CoveringLayer { wall: "bare", thickness: 0.0, below: "", stated: E_N_MEAN },
    CoveringLayer { wall: "thin", thickness: 0.25, below: "", stated: E_N_THIN },
    CoveringLayer { wall: "thick", thickness: 1.4, below: "", stated: E_N_THICK },
    CoveringLayer { wall: "syrup", thickness: 0.2, below: " on syrup", stated: E_N_SYRUP },
];
/// Thickness of the syrup [m]: assumed, the paper gives none.
const FILM: f64 = 0.2e-3;
/// Speeds over which impacts on syrup are counted.
const COUNTED: usize = 26;

impl CoveringLayer {
    fn name(&self) -> String {
        if self.thickness == 0.0 {
            "Pyrex".to_owned()
        } else {
            format!("{} mm of powder{}", self.thickness, self.below)
        }
    }

    /// Its point in the chart.
    fn point(&self) -> [f64; 2] {
        [self.thickness, self.stated.value]
    }
}

/// Mean `e_n` and `e_g` over the speeds of Fig. 10.
fn means(outcome: &dyn Fn(f64) -> Result<Outcome>) -> Result<[f64; 2]> {
    let speeds: Vec<f64> = even(FIGURE_SPEEDS, 51).collect();
    let (mut e_n, mut e_g) = (0.0, 0.0);
    for speed in &speeds {
        let outcome = outcome(*speed)?;
        e_n += outcome.normal_restitution;
        e_g += global_restitution(
            outcome.normal_restitution,
            outcome.tangential_restitution,
            STEEP.to_radians(),
        );
    }
    Ok([e_n, e_g].map(|sum| sum / speeds.len() as f64))
}

/// Means on each of [`LAYERS`].
fn means_on_layers(model: &Model) -> Result<Vec<[f64; 2]>> {
    let on = |layer: &CoveringLayer| means(&|speed| decide(model, layer.wall, &arriving(speed, STEEP)));
    LAYERS.iter().map(on).collect()
}

/// How many impacts of the speeds of Fig. 10 are held for certain.
fn held(outcome: impl Fn(f64) -> Result<Outcome>) -> Result<usize> {
    let outcomes = even(FIGURE_SPEEDS, COUNTED).map(outcome).collect::<Result<Vec<_>>>()?;
    Ok(outcomes.iter().filter(|outcome| outcome.sticking_probability == 1.0).count())
}

/// The part on layers.
pub(super) fn part() -> Result<StudyPart> {
    let model = model!("layers.toml")?;
    let syrup = model!("syrup.toml")?;
    let means = means_on_layers(&model)?;
    Ok(StudyPart {
        heading: "Figs 10 and 11: powder on the target".to_owned(),
        text: text(first_value(&syrup, "liquid-film")?),
        tables: vec![layers(&means)],
        figures: vec![chart(&model)?],
        claims: [dry(&means), on_syrup(&model, &syrup, means[3])?, beside_the_mean(&model, &means)?].concat(),
    })
}

/// `viscosity` is that of the syrup [Pa s].
fn text(viscosity: f64) -> Vec<String> {
    let stokes = WAX_DENSITY * WAX_DIAMETER * FIGURE_SPEEDS[1] / (9.0 * viscosity);
    let diameter = 1e6 * WAX_DIAMETER;
    let slow = E_N_THICK.value * FIGURE_SPEEDS[0];
    let gravity = 9.81;
    let [low, high] = FIGURE_SPEEDS;
    vec![
        "`powder-layer` has two parameters, fitted to the two dry layers, so their e_n proves nothing. \
         Three points of a curve in two numbers do not test its form: any law that decreases fast and \
         levels off would fit. The row on syrup was not used, but its thickness lies between points that \
         were, so it tests that the liquid below has no influence."
            .to_owned(),
        format!(
            "That is a real test against the film's own law: bare syrup of {viscosity} Pa s would hold \
             every particle of {diameter} µm at {low} to {high} m/s (Stokes number at most {stokes:.2}, \
             some 10 to 25 needed). The measured {} shows that particles never reach it. The library does \
             not switch `liquid-film` off under powder by itself: a wall with both must have no film in the \
             model.",
            E_N_SYRUP.value
        ),
        format!(
            "The paper explains the loss by a softer, wider contact with more adhesion. Neither the effect \
             nor the paper's data (means of restitution) can tell that from the work of pushing powder \
             aside. At the low end the data are at the limit of the rig: e_n = {} at {low} m/s is a rebound \
             of {slow:.3} m/s, {:.1} pixels a frame ({:.0} µm, {} ms), that rises by {:.2} mm, less than \
             the particle's diameter.",
            E_N_THICK.value,
            1e6 * slow * CAMERA.frame / CAMERA.pixel(),
            CAMERA.pixel(),
            1e3 * CAMERA.frame,
            1e3 * slow * slow / (2.0 * gravity)
        ),
    ]
}

fn layers(means: &[[f64; 2]]) -> Table {
    let row = |(layer, [e_n, e_g]): (&CoveringLayer, &[f64; 2])| {
        vec![layer.name(), format!("{}", layer.stated.value), format!("{e_n:.3}"), format!("{e_g:.3}")]
    };
    table(
        "wax of 75 µm at 84°, mean over 0.5 to 3 m/s",
        1,
        "target | e_n, stated | e_n | e_g",
        LAYERS.iter().zip(means).map(row).collect(),
    )
}

fn chart(model: &Model) -> Result<Figure> {
    let over = |thickness: f64| -> Result<f64> {
        let [e_n, _] = means(&|speed| {
            decide(model, "bare", &Impact { layer_thickness: thickness, ..arriving(speed, STEEP) })
        })?;
        Ok(e_n)
    };
    let curve = even([0.0, 1.5e-3], 76)
        .map(|thickness| Ok([1e3 * thickness, over(thickness)?]))
        .collect::<Result<Vec<_>>>()?;
    let [bare, thin, thick, syrup] = LAYERS.each_ref().map(CoveringLayer::point);
    Ok(Chart::new(
        "Normal restitution over powder",
        "thickness of the powder [mm]",
        "mean e_n, 0.5 to 3 m/s [1]",
    )
    .x_range(0.0, 1.5)
    .y_range(0.0, 0.35)
    .line("powder-layer", &curve)
    .reference("stated, dry", &[bare, thin, thick])
    .reference("stated, on syrup", &[syrup])
    .figure("troiano-layers", "Fitted to the two dry layers; the point on syrup was not used."))
}

/// Of the two dry layers.
fn dry(means: &[[f64; 2]]) -> Vec<Claim> {
    let [bare, thin, thick] = [0, 1, 2].map(|layer| means[layer][0]);
    vec![
        E_N_THIN.beside(thin, ClaimBasis::Fitted).because(&format!(
            "One of the effect's two parameters is fitted to it. With c = {} the bare e_n is {bare:.3}, \
             {:.0} % above {} (Fig. 8), and so are the layers. Band: {}, as {} beside it has two decimals.",
            YIELD_RATIO.value,
            100.0 * (bare / E_N_MEAN.value - 1.0),
            E_N_MEAN.value,
            E_N_THIN.tolerance,
            E_N_THICK.value
        )),
        E_N_THICK.beside(thick, ClaimBasis::Fitted).because("The other parameter is fitted to it."),
    ]
}

/// Of the powder on syrup, where e_n is `mean`.
fn on_syrup(model: &Model, syrup: &Model, [mean, _]: [f64; 2]) -> Result<Vec<Claim>> {
    let bare = held(|speed| {
        let impact = Impact { film_thickness: FILM, ..arriving(speed, STEEP) };
        decide(syrup, "default", &impact)
    })?;
    let under_powder = match held(|speed| decide(model, LAYERS[3].wall, &arriving(speed, STEEP)))? {
        0 => "none".to_owned(),
        some => some.to_string(),
    };
    Ok(vec![
        E_N_SYRUP.beside(mean, ClaimBasis::Predicted).because(&format!(
            "{} mm lies where the curve fitted to the other two is steep. \"The same regardless\" gives no \
             number; within ± {:.2} the two agree.",
            LAYERS[3].thickness,
            (mean - E_N_SYRUP.value).abs()
        )),
        Claim::predicted_statement(
            "Fig 10",
            &format!(
                "powder on syrup rebounds as on a dry target; syrup without powder: particles held, of \
                 {COUNTED} speeds"
            ),
            "\"the same regardless\"",
            &format!("{bare} held by bare syrup, {under_powder} under powder"),
            bare == COUNTED,
        )
        .because(&format!(
            "{} mm of syrup and asperities of 1 µm assumed; the film law is outside its range (film thicker \
             than the particle), but the margin is orders of magnitude.",
            1e3 * FILM
        )),
    ])
}

/// Of `e_g`, and of the speed.
fn beside_the_mean(model: &Model, means: &[[f64; 2]]) -> Result<Vec<Claim>> {
    let [bare, thin, thick] = [0, 1, 2].map(|layer| means[layer][1]);
    let end = |speed: f64| decide(model, LAYERS[0].wall, &arriving(speed, STEEP));
    let [slow, fast] = [end(FIGURE_SPEEDS[0])?.normal_restitution, end(FIGURE_SPEEDS[1])?.normal_restitution];
    Ok(vec![
        Claim::predicted_statement(
            "Fig 11",
            "e_g falls like e_n: e_g on bare Pyrex, thin and thick layer",
            "\"a similar result\"; no numbers in the text",
            &format!("{bare:.2}, {thin:.2}, {thick:.2}"),
            bare > thin && thin > thick,
        )
        .because(
            "With e_t = 5/7 throughout: the effect does not change e_t, and the paper gives no e_t over \
             powder.",
        ),
        Claim::predicted_statement(
            "Sec 4.1",
            "e_n and e_g on Pyrex \"about constant with the impact velocity\": e_n at 0.5 and 3 m/s",
            "about constant",
            &format!("{slow:.2}, {fast:.2}"),
            fast / slow > 0.75,
        )
        .because(
            "Taken as a change below a quarter over a sixfold range; with the printed v_s it would be more \
             than a third (Fig. 8).",
        ),
    ])
}
