//! A material property and its dependence on temperature.

use super::table::PropertyTable;
use crate::input::{InputError, Limits, Section};

/// Number of steps at which the limits of a formula are checked within its `valid` range.
const CHECKED_STEPS: u32 = 200;

/// Dependence of a property on temperature.
#[derive(Debug, Clone, PartialEq)]
enum Form {
    /// The same number at every temperature.
    Constant(f64),
    /// Linear between the points of a table, unknown beyond its ends.
    Table(PropertyTable),
    /// `sum c_i (T - T0)^i`.
    Polynomial { coefficients: Vec<f64>, origin: f64 },
    /// `A exp(B / T)`.
    Arrhenius { factor: f64, temperature: f64 },
}

/// A property with its source and its valid range.
#[derive(Debug, Clone, PartialEq)]
pub struct Property {
    form: Form,
    valid: Option<[f64; 2]>,
    uncertainty: Option<f64>,
    source: Option<String>,
    /// The property of the melt, above the upper end of the solid.
    melt: Option<Box<Property>>,
}

/// A temperature outside the known range of a property.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OutOfRange {
    /// Lower end of the known range [K].
    pub low: f64,
    /// Upper end of the known range [K].
    pub high: f64,
}

impl Property {
    /// The same number at every temperature.
    pub fn constant(value: f64) -> Self {
        Self { form: Form::Constant(value), valid: None, uncertainty: None, source: None, melt: None }
    }

    /// A table of temperature [K] and value, valid in a range [K], that a law gave; `None` for fewer than two points.
    /// The source starts with "estimated".
    pub(super) fn estimated(points: &[[f64; 2]], valid: [f64; 2], source: &str) -> Option<Self> {
        let [temperatures, values] =
            [0, 1].map(|part| points.iter().map(|point| point[part]).collect::<Vec<_>>());
        let form = match values.first() {
            Some(first) if values.iter().all(|value| value == first) => Form::Constant(*first),
            _ => Form::Table(PropertyTable::new(&temperatures, &values)?),
        };
        Some(Self {
            form,
            valid: Some(valid),
            uncertainty: None,
            source: Some(source.to_owned()),
            melt: None,
        })
    }

    /// Whether a law gave the value, not the material's data.
    pub fn is_estimated(&self) -> bool {
        self.source.as_deref().is_some_and(|source| source.starts_with("estimated"))
    }

    /// Reads `key`: a number, `{ value }`, `{ T, value }`, `{ polynomial, T0 }` or `{ arrhenius }`,
    /// each with `valid` (the last two need it), and optional `uncertainty`, `unit`, `source` and
    /// `melt`. `unit` has to be the SI unit of the key; `melt` is written like the property itself
    /// and applies above its upper end.
    ///
    /// # Errors
    /// [`InputError::Fault`] for anything else, and for values outside the limits.
    pub fn read(section: &Section<'_>, key: &str, limits: &Limits) -> Result<Option<Self>, InputError> {
        if !section.is_section(key) {
            return Ok(section.quantity(key, limits)?.map(Self::constant));
        }
        let property = Self::read_table(&section.required_section(key)?, limits.unit)?;
        match property.first_outside(limits) {
            Some((temperature, value)) => Err(section.outside(key, value, temperature, limits)),
            None => Ok(Some(property)),
        }
    }

    fn read_table(table: &Section<'_>, unit: &str) -> Result<Self, InputError> {
        let form = Form::read(table)?;
        if let Some(given) = table.text("unit")?
            && given != unit
        {
            return Err(table.fault("unit", format!("`{given}`: this key is in {unit}")));
        }
        let melt = table.section("melt")?.map(|melt| Self::read_table(&melt, unit)).transpose()?;
        let property = Self {
            form,
            valid: table.range("valid")?,
            uncertainty: table.number("uncertainty")?,
            source: table.text("source")?,
            melt: melt.map(Box::new),
        };
        table.finish()?;
        if matches!(property.form, Form::Polynomial { .. } | Form::Arrhenius { .. })
            && property.valid.is_none()
        {
            return Err(table.missing("valid", "[low, high], the temperatures [K] that the formula is for,"));
        }
        if property.melt.is_some() && property.solid_end() == f64::INFINITY {
            return Err(table.missing("valid", "a range [K]; `melt` takes over above its end"));
        }
        Ok(property)
    }

    /// The value at a temperature [K].
    ///
    /// # Errors
    /// [`OutOfRange`] beyond the ends of a table, or beyond `valid` for a polynomial or Arrhenius form: nothing
    /// is extrapolated. A constant answers at every temperature; see [`Property::holds_at`].
    pub fn at(&self, temperature: f64) -> Result<f64, OutOfRange> {
        if let Some([low, high]) = self.known_range()
            && !(low..=high).contains(&temperature)
        {
            return Err(OutOfRange { low, high });
        }
        Ok(self.within_range(temperature))
    }

    /// The value at a temperature [K] that [`Property::at`] knows; without meaning at any other.
    pub(crate) fn within_range(&self, temperature: f64) -> f64 {
        if let Some(melt) = self.melt_at(temperature) {
            return melt.within_range(temperature);
        }
        match &self.form {
            Form::Constant(value) => *value,
            Form::Table(table) => table.at(temperature),
            Form::Polynomial { coefficients, origin } => {
                let shifted = temperature - origin;
                coefficients.iter().rev().fold(0.0, |sum, c| sum * shifted + c)
            }
            Form::Arrhenius { factor, temperature: activation } => factor * (activation / temperature).exp(),
        }
    }

    /// As [`Property::within_range`] for many temperatures [K]: one pass over them for each segment
    /// of a table or each coefficient of a polynomial, which the compiler turns into vector
    /// instructions. The same bits.
    #[inline(always)]
    pub(crate) fn within_range_each(&self, temperatures: &[f64], out: &mut [f64]) {
        let pairs = || temperatures.iter().copied();
        match &self.form {
            _ if self.melt.is_some() => {
                out.iter_mut().zip(pairs()).for_each(|(value, t)| *value = self.within_range(t));
            }
            Form::Constant(value) => out.fill(*value),
            Form::Table(table) => table.each(temperatures, out),
            Form::Polynomial { coefficients, origin } => {
                out.fill(0.0);
                for c in coefficients.iter().rev() {
                    out.iter_mut().zip(pairs()).for_each(|(sum, t)| *sum = *sum * (t - origin) + c);
                }
            }
            Form::Arrhenius { factor, temperature } => {
                let pairs = out.iter_mut().zip(pairs());
                pairs.for_each(|(value, t)| *value = factor * (temperature / t).exp());
            }
        }
    }

    /// Temperatures [K] at which the source states the value, where they are one range: `None` for
    /// a property with a melt.
    pub(crate) fn stated_range(&self) -> Option<[f64; 2]> {
        self.melt.is_none().then(|| self.valid.unwrap_or([0.0, f64::INFINITY]))
    }

    /// Whether the source states the value for this temperature [K].
    pub fn holds_at(&self, temperature: f64) -> bool {
        if let Some(melt) = self.melt_at(temperature) {
            return melt.holds_at(temperature);
        }
        self.valid.is_none_or(|[low, high]| (low..=high).contains(&temperature))
    }

    /// Temperature range of the source [K].
    pub fn valid(&self) -> Option<[f64; 2]> {
        let solid = self.valid.or(self.solid_range());
        match self.melt.as_deref().and_then(Self::valid) {
            Some([_, high]) => solid.map(|[low, _]| [low, high]),
            None => solid,
        }
    }

    /// Stated uncertainty, in the property's own unit.
    pub fn uncertainty(&self) -> Option<f64> {
        self.uncertainty
    }

    /// Stated uncertainty [1] as a share of the value at the lower end of its range.
    pub(crate) fn relative_uncertainty(&self) -> Option<f64> {
        let [low, _] = self.valid().unwrap_or([293.15; 2]);
        Some((self.uncertainty? / self.within_range(low)).abs())
    }

    /// The property multiplied by a factor [1]; its values stay within the limits.
    pub(crate) fn scaled(self, factor: f64, limits: &Limits) -> Self {
        let within = |value: f64| (value * factor).clamp(limits.low, limits.high);
        let form = match self.form {
            Form::Constant(value) => Form::Constant(within(value)),
            Form::Table(table) => Form::Table(table.mapped(within)),
            Form::Polynomial { coefficients, origin } => {
                Form::Polynomial { coefficients: coefficients.iter().map(|c| c * factor).collect(), origin }
            }
            Form::Arrhenius { factor: before, temperature } => {
                Form::Arrhenius { factor: before * factor, temperature }
            }
        };
        let melt = self.melt.map(|melt| Box::new(melt.scaled(factor, limits)));
        Self { form, melt, ..self }
    }

    /// Source of the number; a text that starts with "assumed" means that there is none.
    pub fn source(&self) -> Option<&str> {
        self.source.as_deref()
    }

    /// Whether the value is the same at every temperature.
    pub fn is_constant(&self) -> bool {
        matches!(self.form, Form::Constant(_)) && self.melt.is_none()
    }

    /// Temperatures [K] at which the value is known; `None` for all.
    pub fn known_range(&self) -> Option<[f64; 2]> {
        let solid = self.solid_range();
        let Some(melt) = &self.melt else { return solid };
        let low = solid.map_or(0.0, |[low, _]| low);
        Some([low, melt.known_range().map_or(f64::INFINITY, |[_, high]| high)])
    }

    /// The melt's property, if the material is molten at a temperature [K].
    fn melt_at(&self, temperature: f64) -> Option<&Self> {
        self.melt.as_deref().filter(|_| temperature > self.solid_end())
    }

    /// Temperature [K] at which the property of the solid ends; infinite where it has no end.
    fn solid_end(&self) -> f64 {
        self.solid_range().or(self.valid).map_or(f64::INFINITY, |[_, high]| high)
    }

    /// As [`Property::known_range`], without the melt.
    fn solid_range(&self) -> Option<[f64; 2]> {
        match &self.form {
            Form::Constant(_) => None,
            Form::Table(table) => Some(table.range()),
            Form::Polynomial { .. } | Form::Arrhenius { .. } => self.valid,
        }
    }

    /// The first value outside the limits, with its temperature [K] where it depends on that.
    fn first_outside(&self, limits: &Limits) -> Option<(Option<f64>, f64)> {
        let at = |temperature: f64| self.at(temperature).ok().map(|value| (Some(temperature), value));
        let values: Vec<_> = match (&self.form, self.valid) {
            (Form::Constant(value), _) => vec![(None, *value)],
            (Form::Table(table), _) => table.points().map(|[t, value]| (Some(t), value)).collect(),
            (Form::Polynomial { .. } | Form::Arrhenius { .. }, Some([low, high])) => {
                let along = (0..CHECKED_STEPS)
                    .map(|step| low + (high - low) * (f64::from(step) / f64::from(CHECKED_STEPS)));
                along.chain([high]).filter_map(at).collect()
            }
            (_, None) => Vec::new(),
        };
        let outside = values.into_iter().find(|(_, value)| !limits.allow(*value));
        outside.or_else(|| self.melt.as_ref()?.first_outside(limits))
    }
}

impl Form {
    fn read(table: &Section<'_>) -> Result<Self, InputError> {
        if let Some(temperatures) = table.numbers("T")? {
            let values = table.numbers("value")?.ok_or_else(|| table.missing("value", "a list"))?;
            let number = || table.fault("value", "T and value need the same number of entries, two or more");
            if values.len() != temperatures.len() {
                return Err(number());
            }
            if temperatures.windows(2).any(|pair| pair[0] >= pair[1]) || temperatures[0] <= 0.0 {
                return Err(table.fault("T", "temperatures [K] must be positive and rise"));
            }
            return Ok(Self::Table(PropertyTable::new(&temperatures, &values).ok_or_else(number)?));
        }
        if let Some(coefficients) = table.numbers("polynomial")? {
            return Ok(Self::Polynomial { coefficients, origin: table.number("T0")?.unwrap_or(0.0) });
        }
        match table.numbers("arrhenius")?.as_deref() {
            Some(&[factor, temperature]) => return Ok(Self::Arrhenius { factor, temperature }),
            Some(_) => return Err(table.fault("arrhenius", "expected [A, B] of A exp(B/T)")),
            None => {}
        }
        Ok(Self::Constant(table.required_number("value")?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::Document;
    use approx::assert_relative_eq;

    const LIMITS: Limits = Limits { unit: "Pa", low: 0.0, high: 1e3, known: "" };

    fn property(text: &str) -> Result<Property, InputError> {
        Document::new("m.toml", text).read(|top| Property::read(top, "p", &LIMITS)).map(Option::unwrap)
    }

    #[test]
    fn tables_are_linear_and_end_where_they_end() {
        let table = property("p = { T = [300, 400, 600], value = [10, 20, 0] }").unwrap();
        assert_relative_eq!(table.at(350.0).unwrap(), 15.0);
        assert_relative_eq!(table.at(500.0).unwrap(), 10.0);
        assert_relative_eq!(table.at(300.0).unwrap(), 10.0);
        assert_relative_eq!(table.at(600.0).unwrap(), 0.0);
        assert_eq!(table.at(601.0), Err(OutOfRange { low: 300.0, high: 600.0 }));
    }

    #[test]
    fn the_melt_applies_above_the_end_of_the_solid() {
        let text = "p = { polynomial = [1, 2], T0 = 300, valid = [300, 400], \
                    melt = { polynomial = [50, 1], T0 = 400, valid = [400, 500] } }";
        let both = property(text).unwrap();
        assert_relative_eq!(both.at(400.0).unwrap(), 201.0);
        assert_relative_eq!(both.at(410.0).unwrap(), 60.0);
        assert_eq!(both.at(501.0), Err(OutOfRange { low: 300.0, high: 500.0 }));
        assert_eq!((both.valid(), both.is_constant()), (Some([300.0, 500.0]), false));
        let held =
            property("p = { value = 3, valid = [290, 400], melt = { value = 4, valid = [400, 400] } }");
        let held = held.unwrap();
        assert_eq!((held.at(400.0), held.at(900.0)), (Ok(3.0), Ok(4.0)));
        assert!(held.holds_at(400.0) && !held.holds_at(401.0) && !held.is_constant());
        let endless = property("p = { value = 3, melt = { value = 4 } }").unwrap_err().to_string();
        assert!(endless.contains("p.valid: missing"), "{endless}");
        assert!(property("p = { value = 3, valid = [290, 400], melt = { value = -4 } }").is_err());
    }

    #[test]
    fn polynomial_and_arrhenius_follow_their_formula() {
        let text = "p = { polynomial = [1, 2, 3], T0 = 300, valid = [290, 310] }";
        assert_relative_eq!(property(text).unwrap().at(302.0).unwrap(), 1.0 + 4.0 + 12.0);
        let text = "p = { arrhenius = [2, 300], valid = [290, 310] }";
        assert_relative_eq!(property(text).unwrap().at(300.0).unwrap(), 2.0 * 1f64.exp());
        assert!(property(text).unwrap().at(320.0).is_err());
    }

    #[test]
    fn faults_are_named() {
        let message = property("p = { T = [300, 200], value = [1, 2] }").unwrap_err().to_string();
        assert!(message.contains("p.T: temperatures"), "{message}");
        let message = property("p = { value = 1, unit = \"MPa\" }").unwrap_err().to_string();
        assert!(message.contains("this key is in Pa"), "{message}");
        assert!(property("p = -1").is_err());
    }

    #[test]
    fn a_value_beyond_the_limits_is_found_wherever_it_is() {
        let outside = |text: &str| {
            let message = property(text).unwrap_err().to_string();
            let end = message.find(" is outside the allowed range 0 to 1000; check").unwrap();
            message["m.toml:1:1: p: ".len()..end].to_owned()
        };
        assert_eq!(outside("p = 70e90"), "7e91");
        assert_eq!(outside("p = { value = 1e4 }"), "10000");
        assert_eq!(outside("p = { T = [300, 400], value = [1, 1e300] }"), "1e300 at 400 K");
        // (T - 350)²/20 - 0.04 is positive at both ends, and from 349.1 to 350.9 K it is not.
        let parabola = "p = { polynomial = [-0.04, 0, 0.05], T0 = 350, valid = [250, 450] }";
        assert_eq!(outside(parabola), "-0.04 at 350 K");
        assert_eq!(outside("p = { arrhenius = [1, 1e6], valid = [1, 300] }"), "inf at 1 K");
        assert_eq!(
            outside(
                "p = { value = 1, valid = [300, 400], melt = { polynomial = [-1], valid = [400, 500] } }"
            ),
            "-1 at 400 K"
        );
        for form in ["polynomial = [1, 2]", "arrhenius = [1, 300]"] {
            let endless = property(&format!("p = {{ {form} }}")).unwrap_err().to_string();
            assert!(
                endless.starts_with("m.toml:1:5: p.valid: missing; add [low, high], the temperatures"),
                "{endless}"
            );
        }
    }
}
