//! Set 6: molten molybdenum, 13 of 13 stuck.

use nearwall::capture::{DropletNumbers, SPLASH_K};
use nearwall::normal::NormalLaw;
use nearwall::{Impact, ImpactRng, Model};
use nearwall_lab::report::number;

use super::published::{MOLTEN, MOLTEN_SIZE, MOLTEN_TEMPERATURES, RATIO, SETS};
use super::sample::{Sampler, Spread};
use super::statistics::binomial;
use super::{MOLYBDENUM, Result, model};
use crate::claim::{Claim, Published};
use crate::study::{StudyPart, table};

const SEED: u64 = 16;
/// Temperatures [K]: below melting (2896 K), the paper's "> 2900", and the upper end of the melt's properties.
const MELT_TEMPERATURES: [f64; 3] = [2890.0, 2900.0, 3200.0];

/// An impact of the sweep over temperatures [K] and speeds [m/s].
struct MeltTried {
    temperature: f64,
    speed: f64,
    /// Of the drop, where it is one.
    numbers: Option<DropletNumbers>,
    probability: f64,
}

impl MeltTried {
    fn new(model: &Model, temperature: f64, speed: f64) -> Result<Self> {
        let impact = Impact {
            particle_temperature: temperature,
            wall_temperature: MOLTEN_TEMPERATURES[1],
            ..super::impact(MOLTEN_SIZE[2] * 1e-6, speed, 0.0)
        };
        let particle = model.particle();
        let numbers = if particle.is_molten(temperature)? {
            Some(DropletNumbers::new(&particle.molten(temperature)?, speed, impact.diameter))
        } else {
            None
        };
        let probability = model.resolve_with(0, &impact, |_| 0.5)?.sticking_probability;
        Ok(Self { temperature, speed, numbers, probability })
    }

    fn row(&self) -> Vec<String> {
        let mut row = vec![number(self.temperature), number(self.speed)];
        match self.numbers {
            Some(numbers) => row.extend([numbers.weber, numbers.reynolds, numbers.splash].map(number)),
            None => row.extend(["–", "–", "–"].map(str::to_owned)),
        }
        row.push(number(self.probability));
        row
    }
}

/// Temperatures by speeds. The speeds of set 6 are not printed; those of set 5, the same size in
/// the same plasma, stand in.
fn sweep(model: &Model) -> Result<Vec<MeltTried>> {
    let [slowest, fastest] = SETS[4].normal;
    let mut tried = Vec::new();
    for temperature in MELT_TEMPERATURES {
        for speed in [slowest, 4.0, fastest, 50.0, 150.0] {
            tried.push(MeltTried::new(model, temperature, speed)?);
        }
    }
    Ok(tried)
}

pub fn part() -> Result<StudyPart> {
    let model = model(MOLYBDENUM)?;
    let tried = sweep(&model)?;
    let [stuck, impacts] = [MOLTEN[1], MOLTEN[0]];
    let [low, _] = binomial(stuck, impacts, 0.05)?;
    // Molten, at speeds of set 5.
    let within = || tried.iter().filter(|tried| tried.numbers.is_some() && tried.speed <= SETS[4].normal[1]);
    let least = within().map(|tried| tried.probability).fold(f64::INFINITY, f64::min);
    let splash = within().filter_map(|tried| tried.numbers).map(|numbers| numbers.splash).fold(0.0, f64::max);
    Ok(StudyPart {
        heading: "Molten molybdenum sticks (set 6, Fig 7b)".to_owned(),
        text: vec![format!(
            "[capture] model = \"droplet\" calls a particle above the melting point of its material a \
             droplet and keeps it unless K = We^½ Re^¼ exceeds {SPLASH_K}. Molybdenum's surface tension and \
             viscosity are of the library; speeds of set 6 are not printed and those of set 5 stand in. \
             {stuck} of {impacts} says that p lies above {low:.3} (95 %, one-sided), not that it is 1."
        )],
        tables: vec![table(
            "16 µm molybdenum on tungsten at 1000 K; 50 and 150 m/s lie far outside the experiment and show \
             where the criterion changes its mind.",
            0,
            "T_p [K] | v_n [m/s] | We [1] | Re [1] | K [1] | p_stick [1]",
            tried.iter().map(MeltTried::row).collect(),
        )],
        figures: Vec::new(),
        claims: vec![capture(low, least, splash), droplets(&model, least)?, shape()],
    })
}

/// From the lower bound, the least capture found, and the largest K beside it.
fn capture(low: f64, least: f64, splash: f64) -> Claim {
    let [slowest, fastest] = SETS[4].normal;
    let [_, coolest, hottest] = MELT_TEMPERATURES;
    Claim::predicted(
        "set 6",
        &format!(
            "probability of capture, {} of {} (95 % lower bound), smallest over {slowest} to {fastest} m/s \
             and {coolest} to {hottest} K",
            MOLTEN[1], MOLTEN[0]
        ),
        Published::Between(low, 1.0),
        least,
    )
    .because(&format!("K is at most {splash:.1}: nothing is fitted, and the margin is large."))
}

/// Whether droplets are consistent with the counts, and solid grains, too.
fn droplets(model: &Model, least: f64) -> Result<Claim> {
    let flattened = model.with_laws(NormalLaw::PlasticJkr, model.tangential_law());
    let solid = [solid_share(model, Spread::Even)?, solid_share(model, Spread::Slow)?];
    let raised = [solid_share(&flattened, Spread::Even)?, solid_share(&flattened, Spread::Slow)?];
    let [solid_at, ..] = MELT_TEMPERATURES;
    let [impacts, stuck] = MOLTEN;
    let claim = Claim::predicted_statement(
        "section 4, sticking events (iii)",
        "droplets are consistent with all 13 sticking",
        "formation of droplets is consistent with the observation",
        &format!("p = {}", number(least)),
        least == 1.0,
    );
    Ok(claim.because(&format!(
        "It does not exclude solid grains: at {solid_at} K and the speeds of set 5 adhesion holds {:.0} to \
         {:.0} % of them by the closed form ({stuck} of {impacts} then has a probability of at most {:.2}), \
         but {:.0} % with the pull-off that yielding raises. Clean metal, {} x {:.0} MPa, v_n even or even \
         in its logarithm (all assumed, seed {SEED}). The SEM images of re-solidified grains are the strong \
         evidence.",
        100.0 * solid[0],
        100.0 * solid[1],
        solid[1].powi(stuck as i32),
        100.0 * raised[0].min(raised[1]),
        RATIO[0],
        model.particle().mechanical(solid_at)?.yield_strength / 1e6
    )))
}

fn shape() -> Claim {
    Claim::unchecked(
        "Fig 7b",
        "flattening, recoil and freezing from below",
        "described in words",
        "The droplet criterion has no shape. Freezing, which arrests a drop, counts where `contact_angle` lets drops bounce.",
    )
}

/// Share of solid grains at 2890 K that stick at the speeds of set 5.
fn solid_share(model: &Model, spread: Spread) -> Result<f64> {
    const COUNT: u64 = 2000;
    let sampler = Sampler::new(SETS[4], spread)?;
    let mut held = 0;
    for key in 0..COUNT {
        let draw = ImpactRng::new(SEED, key);
        let impact = Impact { particle_temperature: MELT_TEMPERATURES[0], ..sampler.impact(draw) };
        held += u64::from(model.resolve(0, &impact, draw)?.stuck);
    }
    Ok(held as f64 / COUNT as f64)
}
