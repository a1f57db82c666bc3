//! Melt-fraction criterion: a partly molten particle is sticky between the share of liquid at which
//! it begins to stick and that at which it flows (Backman, Hupa & Uppstu 1987; Mueller et al.
//! 2005).
//!
//! `P = (f - f_0)/(f_1 - f_0)`, within 0 and 1. `f` share of liquid in the mass [1] at the
//! temperature of what is judged, `f_0` (`sticky_from`) share below which nothing sticks, `f_1`
//! (`flows_from`) share from which everything does; 0.15 and 0.70 unless given. With `f_0 = f_1` it
//! is a step.
//!
//! 15 %: Troiano et al. give nearly 15 % of the mass as the criterion for synthetic and alkali-rich
//! ash (their references 21 and 22). 15 and 70 %: deposits of alkali salts in recovery boilers
//! (Backman, Hupa & Uppstu, Tappi J. 70 (1987) 123) and the model of Mueller et al., Proc. Combust.
//! Inst. 30 (2005) 2991, for alkali-rich fly ash (neither re-read). *Assumed*, as sources differ or
//! were not read: the straight line in between. Some works count all above 15 % as sticky, which is
//! `flows_from = 0.15`.
//!
//! Valid for salts and alkali-rich ash of biomass, waste and black liquor, whose melt is thin and
//! whose melting range is wide. A silicate ash softens as a glass: use the viscosity criterion.
//! Above 70 % a layer on the wall runs off; a particle that arrives still sticks. Neglected: the
//! speed of the impact (sticking temperature falls with size and with liquid content, Tran et al.,
//! abstract); faster than [`FASTEST_WITHOUT_SPEED`] the outcome is marked.

use super::StickinessCriterion;
use super::viscosity::FASTEST_WITHOUT_SPEED;
use crate::impact::{Impact, ImpactError};
use crate::input::{InputError, Section};
use crate::material::Material;

/// Share of liquid [1] below which a particle does not stick.
pub const STICKY_FROM: f64 = 0.15;
/// Share of liquid [1] from which an ash flows.
pub const FLOWS_FROM: f64 = 0.70;

/// Probability of sticking [1] from the share of liquid and the shares at which sticking begins and
/// is complete [all 1].
///
/// ```
/// use nearwall::capture::{FLOWS_FROM, STICKY_FROM, melt_fraction_stickiness};
///
/// assert_eq!(melt_fraction_stickiness(0.1, STICKY_FROM, FLOWS_FROM), 0.0);
/// assert_eq!(melt_fraction_stickiness(0.8, STICKY_FROM, FLOWS_FROM), 1.0);
/// ```
pub fn melt_fraction_stickiness(melt_fraction: f64, sticky_from: f64, flows_from: f64) -> f64 {
    if melt_fraction >= flows_from {
        return 1.0;
    }
    // The width is positive: the fraction lies between its ends.
    if melt_fraction <= sticky_from {
        0.0
    } else {
        (melt_fraction - sticky_from) / (flows_from - sticky_from)
    }
}

/// All temperatures [K].
const ALL: [f64; 2] = [0.0, f64::INFINITY];

/// The melt-fraction criterion of a `[capture]` table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeltFractionCriterion {
    sticky_from: f64,
    flows_from: f64,
}

impl MeltFractionCriterion {
    pub(super) fn read(section: &Section<'_>) -> Result<Self, InputError> {
        let sticky_from = section.number_within("sticky_from", 0.0, 1.0)?.unwrap_or(STICKY_FROM);
        let flows_from = section.number_within("flows_from", 0.0, 1.0)?.unwrap_or(FLOWS_FROM);
        if flows_from < sticky_from {
            return Err(section.fault("flows_from", format!("below `sticky_from`, {sticky_from}")));
        }
        Ok(Self { sticky_from, flows_from })
    }

    /// Key and value [1] of both shares.
    pub(super) fn numbers_mut(&mut self) -> [(&'static str, &mut f64); 2] {
        [("sticky_from", &mut self.sticky_from), ("flows_from", &mut self.flows_from)]
    }

    /// Moves the other share than `changed` along, where sticking would begin after it is complete.
    pub(super) fn order(&mut self, changed: &str) {
        if changed == "sticky_from" {
            self.flows_from = self.flows_from.max(self.sticky_from);
        } else {
            self.sticky_from = self.sticky_from.min(self.flows_from);
        }
    }

    pub(super) fn describe(self) -> String {
        format!("melt-fraction, sticky_from {}, flows_from {}", self.sticky_from, self.flows_from)
    }

    /// The criterion for a material; `None` for one without a melt fraction.
    pub fn prepare(self, material: &Material) -> Option<MeltFractionStickiness> {
        let known = material.property("melt_fraction")?.known_range();
        let complete = |temperature: f64| {
            material.melt_fraction_near(temperature).is_some_and(|fraction| [0.0, 1.0].contains(&fraction))
        };
        let stated = known.map_or(ALL, |[low, high]| {
            [if complete(low) { ALL[0] } else { low }, if complete(high) { ALL[1] } else { high }]
        });
        Some(MeltFractionStickiness { criterion: self, material: Box::new(material.clone()), stated })
    }
}

/// The criterion for one material.
#[derive(Debug, Clone)]
pub struct MeltFractionStickiness {
    criterion: MeltFractionCriterion,
    material: Box<Material>,
    /// Temperatures [K] of the table; beyond an end at which all is solid or liquid it holds too.
    stated: [f64; 2],
}

impl MeltFractionStickiness {
    /// Share of liquid [1] at a temperature [K]; beyond the ends of a table that of the nearest end.
    fn melt_fraction(&self, temperature: f64) -> f64 {
        self.material.melt_fraction_near(temperature).unwrap_or(0.0)
    }

    fn stickiness(&self, temperature: f64) -> f64 {
        let MeltFractionCriterion { sticky_from, flows_from } = self.criterion;
        melt_fraction_stickiness(self.melt_fraction(temperature), sticky_from, flows_from)
    }
}

impl StickinessCriterion for MeltFractionStickiness {
    fn name(&self) -> &'static str {
        "melt-fraction"
    }

    fn in_flight(&self, impact: &Impact) -> Result<f64, ImpactError> {
        Ok(self.stickiness(impact.particle_temperature))
    }

    fn on_wall(&self, impact: &Impact) -> f64 {
        self.stickiness(impact.wall_temperature)
    }

    /// That of the material's liquid where it flows; a material without a viscosity does not flow.
    fn film_viscosity(&self, temperature: f64) -> f64 {
        let flows = self.melt_fraction(temperature) >= self.criterion.flows_from;
        if flows { self.material.viscosity_near(temperature).unwrap_or(f64::INFINITY) } else { f64::INFINITY }
    }

    fn known_range(&self) -> [f64; 2] {
        ALL
    }

    fn stated_range(&self) -> [f64; 2] {
        self.stated
    }

    fn fastest(&self) -> f64 {
        FASTEST_WITHOUT_SPEED
    }

    fn holds_in_flight(&self, temperature: f64) -> bool {
        (self.stated[0]..=self.stated[1]).contains(&temperature)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::Document;
    use crate::material::Library;
    use approx::assert_relative_eq;

    /// By hand: 0.15 + 0.55/4 = 0.2875 is a quarter of the way.
    #[test]
    fn nothing_sticks_below_fifteen_percent_and_everything_from_seventy() {
        let stickiness = |f| melt_fraction_stickiness(f, STICKY_FROM, FLOWS_FROM);
        assert_eq!([0.0, 0.1499, 0.15].map(stickiness), [0.0; 3]);
        assert_eq!([0.70, 0.9, 1.0].map(stickiness), [1.0; 3]);
        assert_relative_eq!(stickiness(0.2875), 0.25, max_relative = 1e-12);
        assert_relative_eq!(stickiness(0.425), 0.5, max_relative = 1e-12);
    }

    /// The last row is not all liquid, so the criterion is not stated beyond it; the first is all solid.
    #[test]
    fn a_table_holds_beyond_an_end_that_is_solid_or_liquid() {
        let text = "[a]\nlike = \"straw-ash\"\n\
                    melt_fraction = { T = [1043, 1143, 1413], value = [0, 0.15, 0.8] }\n";
        let library = Document::new("m.toml", text).read(|top| Library::built_in()?.with(top)).unwrap();
        let criterion = MeltFractionCriterion { sticky_from: STICKY_FROM, flows_from: FLOWS_FROM };
        let ash = criterion.prepare(library.get("a").unwrap()).unwrap();
        assert_eq!(ash.stated_range(), [0.0, 1413.0]);
        assert_eq!([300.0, 1413.0, 1414.0].map(|kelvin| ash.holds_in_flight(kelvin)), [true, true, false]);
    }

    #[test]
    fn equal_ends_are_a_step() {
        let step = |f| melt_fraction_stickiness(f, 0.15, 0.15);
        assert_eq!((step(0.1499), step(0.15), step(1.0)), (0.0, 1.0, 1.0));
        assert_eq!(melt_fraction_stickiness(0.0, 0.0, 0.0), 1.0);
    }
}
