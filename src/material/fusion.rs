//! `fusion_temperatures` of a material: the ash sheet of a laboratory.
//!
//! Laboratories that measure one ash differ by up to 50 to 80 K, so a temperature of a sheet without an
//! `uncertainty` has a 90 % band of ± [`SHEET_BAND`] (assumed; the reproducibilities of ISO 540 and ASTM D1857
//! were not re-read: of two laboratories that differ by less than 70 K in 95 % of cases, each is within 41 K of the
//! mean of all in 90 %).

use super::Material;
use crate::input::{InputError, Limits, Section};
use crate::slag::ash_fusion::{self, NAMES};
use crate::slag::{FusionTemperatures, OutsideAshes};

/// The key in files.
pub(super) const KEY: &str = "fusion_temperatures";

/// Half width of the 90 % band of a measured fusion temperature without an `uncertainty` [K]; assumed.
pub const SHEET_BAND: f64 = 40.0;

const LIMITS: Limits =
    Limits { unit: "K", low: 700.0, high: 3000.0, known: "ashes 1000 to 1900; add 273.15 to a sheet in °C" };

/// Reads the sheet of a material; `None` without one.
pub(super) fn read(section: &Section<'_>) -> Result<Option<FusionTemperatures>, InputError> {
    let Some(sheet) = section.section(KEY)? else { return Ok(None) };
    sheet.choice("unit", &["K"])?;
    sheet.text("source")?;
    let mut found = [None; NAMES.len()];
    for (name, temperature) in NAMES.into_iter().zip(&mut found) {
        *temperature = sheet.quantity(name, &LIMITS)?;
    }
    let band = sheet.number_within("uncertainty", 0.0, 500.0)?.unwrap_or(SHEET_BAND);
    sheet.finish()?;
    let [deformation, softening, hemisphere, flow] = found;
    let needed = |name| sheet.missing(name, "a temperature in K, as the laboratory's sheet gives it");
    let deformation = deformation.ok_or_else(|| needed("deformation"))?;
    let flow = flow.ok_or_else(|| needed("flow"))?;
    let half_widths = [band; NAMES.len()];
    let sheet_temperatures =
        FusionTemperatures { deformation, softening, hemisphere, flow, half_widths, estimated: false };
    check_order(&sheet, &sheet_temperatures)?;
    Ok(Some(sheet_temperatures))
}

fn check_order(sheet: &Section<'_>, temperatures: &FusionTemperatures) -> Result<(), InputError> {
    let known: Vec<_> = temperatures.known().collect();
    match known.windows(2).find(|pair| pair[1].1 < pair[0].1) {
        Some(&[(before, least, _), (name, found, _)]) => {
            let problem =
                format!("{found} K is below `{before}`, {least} K; the temperatures of a sheet ascend");
            Err(sheet.fault(name, problem))
        }
        _ => Ok(()),
    }
}

impl Material {
    /// The fusion temperatures of a laboratory's sheet.
    pub fn fusion_temperatures(&self) -> Option<&FusionTemperatures> {
        self.fusion_temperatures.as_ref()
    }

    /// Its fusion temperatures: those of the sheet, else estimated from its composition
    /// ([`ash_fusion::estimate`]); `None` for a material with neither.
    pub fn given_or_estimated_fusion(&self) -> Option<Result<FusionTemperatures, OutsideAshes>> {
        let estimated = || self.composition.as_ref().map(ash_fusion::estimate);
        self.fusion_temperatures.map(Ok).or_else(estimated)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::Document;

    fn sheet(numbers: &str) -> Result<FusionTemperatures, String> {
        let document = Document::new("m.toml", format!("fusion_temperatures = {{ {numbers} }}"));
        document.read(read).map(Option::unwrap).map_err(|error| error.to_string())
    }

    #[test]
    fn a_sheet_ascends_from_deformation_to_flow() {
        let found = sheet("deformation = 1400, softening = 1450, hemisphere = 1450, flow = 1500").unwrap();
        assert_eq!(
            found.describe(),
            "deformation 1400 ± 40 K, softening 1450 ± 40 K, hemisphere 1450 ± 40 K, flow 1500 ± 40 K (90 % band, \
                given)"
        );
        let two = sheet("deformation = 1400, flow = 1500, uncertainty = 15, source = \"own\"").unwrap();
        assert_eq!((two.softening, two.hemisphere, two.half_widths[0]), (None, None, 15.0));
        for (numbers, message) in [
            (
                "deformation = 1400, flow = 1300",
                "flow: 1300 K is below `deformation`, 1400 K; the temperatures",
            ),
            (
                "deformation = 1400, hemisphere = 1390, flow = 1500",
                "hemisphere: 1390 K is below `deformation`",
            ),
            ("flow = 1500", "deformation: missing"),
            ("deformation = 1400, softening = 1500", "flow: missing"),
            ("deformation = 650, flow = 1500", "add 273.15 to a sheet in °C"),
            ("deformation = 1400, flow = 1500, fluid = 1600", "fluid"),
            ("deformation = 1400, flow = 1500, unit = \"°C\"", "unit"),
        ] {
            let found = sheet(numbers).unwrap_err();
            assert!(found.contains("fusion_temperatures.") && found.contains(message), "{found}");
        }
    }
}
