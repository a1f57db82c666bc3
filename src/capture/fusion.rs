//! Fusion criterion: an ash is sticky between the deformation and the flow temperature of its sheet.
//!
//! `P = 0` up to deformation, 1/3 at softening, 2/3 at hemisphere, 1 from flow, linear in between; a temperature that
//! the sheet lacks is no corner. *Assumed*: both ends (deformation is the first sign of melt on a cone of ash, at flow
//! the cone has spread), the shares 1/3 and 2/3, the straight lines. With deformation equal to flow it is a step.
//! The temperature is the particle's for a particle and the wall's for what lies there; the speed does not count.
//!
//! The temperatures are the material's `fusion_temperatures`, else they are estimated from its composition with a
//! band of some ± 130 to 270 K ([`crate::slag::ash_fusion`]); `nearwall check` shows which, with the 90 % band. A
//! composition outside the ashes of the estimate is refused. The band of the stickiness, which `predict --explain`
//! prints, has all temperatures at the upper or the lower end of theirs (assumed: they err together).
//!
//! Below the flow temperature what lies on a wall is solid: it does not flow, and particles that are caught there are
//! powder. Above it the melt has the material's viscosity, or that of the `law` for its composition; without either it
//! does not flow.
//!
//! Valid for ashes that resemble the laboratory's specimen in composition and gas. The sheet heats a pressed cone
//! for an hour; single minerals in a particle soften earlier or later.

use super::melt::{Melt, MeltLaws};
use super::{StickinessCriterion, Unsuitable};
use crate::impact::{Impact, ImpactError};
use crate::input::{InputError, Section};
use crate::material::Material;
use crate::slag::FusionTemperatures;

/// Stickiness [1] at a temperature [K] of an ash with these fusion temperatures.
///
/// ```
/// use nearwall::capture::fusion_stickiness;
/// use nearwall::slag::FusionTemperatures;
///
/// let sheet = FusionTemperatures {
///     deformation: 1400.0,
///     softening: None,
///     hemisphere: None,
///     flow: 1500.0,
///     half_widths: [40.0; 4],
///     estimated: false,
/// };
/// assert_eq!([1400.0, 1425.0, 1500.0].map(|kelvin| fusion_stickiness(&sheet, kelvin)), [0.0, 0.25, 1.0]);
/// ```
pub fn fusion_stickiness(sheet: &FusionTemperatures, temperature: f64) -> f64 {
    if temperature >= sheet.flow {
        return 1.0;
    }
    if temperature <= sheet.deformation {
        return 0.0;
    }
    let inner = [(sheet.softening, 1.0 / 3.0), (sheet.hemisphere, 2.0 / 3.0)];
    let inner = inner.into_iter().filter_map(|(corner, share)| Some((corner?, share)));
    let mut below = (sheet.deformation, 0.0);
    for corner in inner.chain([(sheet.flow, 1.0)]) {
        if temperature < corner.0 {
            let part = (temperature - below.0) / (corner.0 - below.0);
            return below.1 + (corner.1 - below.1) * part;
        }
        below = corner;
    }
    1.0
}

/// The fusion criterion of a `[capture]` table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FusionCriterion {
    laws: MeltLaws,
}

impl FusionCriterion {
    pub(super) fn read(section: &Section<'_>) -> Result<Self, InputError> {
        Ok(Self { laws: MeltLaws::read_law(section)? })
    }

    pub(super) fn describe(self) -> String {
        let law = self.laws.describe().map_or_else(String::new, |law| format!(", viscosity by {law}"));
        format!("fusion, from deformation to flow temperature{law}")
    }

    /// The criterion for a material; `None` for one with neither fusion temperatures nor a composition.
    ///
    /// # Errors
    /// [`Unsuitable`] for a composition unlike the ashes of the estimate, or one to which the law cannot be applied.
    pub fn prepare(self, material: &Material) -> Result<Option<FusionStickiness>, Unsuitable> {
        let Some(temperatures) = material.given_or_estimated_fusion() else { return Ok(None) };
        let no_estimate = |reason| Unsuitable::NoEstimate { material: material.name().to_owned(), reason };
        let temperatures = temperatures.map_err(no_estimate)?;
        let name = material.name().to_owned();
        Ok(Some(FusionStickiness { name, temperatures, melt: self.laws.prepare(material)? }))
    }
}

/// The criterion for one material.
#[derive(Debug, Clone)]
pub struct FusionStickiness {
    name: String,
    temperatures: FusionTemperatures,
    melt: Option<Melt>,
}

impl StickinessCriterion for FusionStickiness {
    fn name(&self) -> &'static str {
        "fusion"
    }

    fn in_flight(&self, impact: &Impact) -> Result<f64, ImpactError> {
        Ok(fusion_stickiness(&self.temperatures, impact.particle_temperature))
    }

    /// With all temperatures of the sheet at the upper and at the lower end of their bands.
    fn in_flight_band(&self, impact: &Impact) -> Option<[f64; 2]> {
        let at = |part| fusion_stickiness(&self.temperatures.shifted(part), impact.particle_temperature);
        Some([at(1.0), at(-1.0)])
    }

    fn on_wall(&self, impact: &Impact) -> f64 {
        fusion_stickiness(&self.temperatures, impact.wall_temperature)
    }

    fn film_viscosity(&self, temperature: f64) -> f64 {
        let melt = self.melt.as_ref().filter(|_| temperature >= self.temperatures.flow);
        melt.map_or(f64::INFINITY, |melt| melt.film_viscosity(temperature))
    }

    fn glass_viscosity(&self, temperature: f64) -> f64 {
        let melt = self.melt.as_ref().and_then(|melt| melt.viscosity(temperature).ok());
        melt.unwrap_or(f64::INFINITY)
    }

    fn liquid_viscosity(&self, temperature: f64) -> Option<f64> {
        self.melt.as_ref()?.viscosity(temperature).ok()
    }

    fn stiff_below(&self) -> Option<f64> {
        Some(self.temperatures.flow)
    }

    fn describe(&self) -> Option<String> {
        Some(format!("{}: {}", self.name, self.temperatures.describe()))
    }

    fn known_range(&self) -> [f64; 2] {
        [0.0, f64::INFINITY]
    }

    fn holds_in_flight(&self, _temperature: f64) -> bool {
        true
    }

    /// Below flow it has no viscosity that could be out of range.
    fn holds_on_wall(&self, temperature: f64) -> bool {
        let melt = self.melt.as_ref().filter(|_| temperature >= self.temperatures.flow);
        melt.is_none_or(|melt| melt.holds_in_flight(temperature))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn sheet(deformation: f64, inner: [Option<f64>; 2], flow: f64) -> FusionTemperatures {
        let [softening, hemisphere] = inner;
        let half_widths = [40.0; 4];
        FusionTemperatures { deformation, softening, hemisphere, flow, half_widths, estimated: false }
    }

    #[test]
    fn a_third_at_softening_and_two_at_hemisphere() {
        let all = sheet(1400.0, [Some(1440.0), Some(1460.0)], 1500.0);
        let at = |kelvin| fusion_stickiness(&all, kelvin);
        assert_eq!([300.0, 1399.0, 1400.0, 1500.0, 2000.0].map(at), [0.0, 0.0, 0.0, 1.0, 1.0]);
        for (kelvin, share) in [(1420.0, 1.0 / 6.0), (1440.0, 1.0 / 3.0), (1450.0, 0.5), (1480.0, 5.0 / 6.0)]
        {
            assert_relative_eq!(at(kelvin), share, max_relative = 1e-12);
        }
        let no_hemisphere = sheet(1400.0, [Some(1440.0), None], 1500.0);
        assert_relative_eq!(fusion_stickiness(&no_hemisphere, 1470.0), 2.0 / 3.0, max_relative = 1e-12);
    }

    #[test]
    fn equal_temperatures_are_a_step() {
        let step = sheet(1400.0, [Some(1400.0), Some(1400.0)], 1400.0);
        assert_eq!([1399.9, 1400.0].map(|kelvin| fusion_stickiness(&step, kelvin)), [0.0, 1.0]);
        let half = sheet(1400.0, [Some(1400.0), Some(1500.0)], 1500.0);
        assert_eq!(fusion_stickiness(&half, 1400.0), 0.0);
        assert_relative_eq!(fusion_stickiness(&half, 1450.0), 0.5, max_relative = 1e-12);
        assert_eq!(fusion_stickiness(&half, 1500.0), 1.0);
    }
}
