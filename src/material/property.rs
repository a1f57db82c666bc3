//! One material property and how it depends on temperature.

use crate::input::{InputError, Section};

/// How a property follows temperature.
#[derive(Debug, Clone, PartialEq)]
enum Form {
    /// The same number at every temperature.
    Constant(f64),
    /// Linear between the points of a table, nothing beyond its ends.
    Table { temperatures: Vec<f64>, values: Vec<f64> },
    /// `sum c_i (T - T0)^i`.
    Polynomial { coefficients: Vec<f64>, origin: f64 },
    /// `A exp(B / T)`.
    Arrhenius { factor: f64, temperature: f64 },
}

/// A property with where it comes from and where it holds.
#[derive(Debug, Clone, PartialEq)]
pub struct Property {
    form: Form,
    valid: Option<[f64; 2]>,
    uncertainty: Option<f64>,
    source: Option<String>,
    /// What takes over above the upper end, where the solid has melted.
    melt: Option<Box<Property>>,
}

/// A temperature at which a property is not known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OutOfRange {
    /// Lower end of what is known [K].
    pub low: f64,
    /// Upper end of what is known [K].
    pub high: f64,
}

impl Property {
    /// The same number at every temperature.
    pub fn constant(value: f64) -> Self {
        Self { form: Form::Constant(value), valid: None, uncertainty: None, source: None, melt: None }
    }

    /// Reads `key`: a number, `{ value }`, `{ T, value }`, `{ polynomial, T0 }` or `{ arrhenius }`, each with
    /// optional `valid`, `uncertainty`, `unit`, `source` and `melt`. `unit` has to be the SI unit of the key; `melt` is written
    /// like the property itself and takes over above its upper end.
    ///
    /// # Errors
    /// [`InputError::Fault`] for anything else, and for values outside `low..=high`.
    pub fn read(
        section: &Section<'_>,
        key: &str,
        unit: &str,
        low: f64,
        high: f64,
    ) -> Result<Option<Self>, InputError> {
        if !section.is_section(key) {
            return Ok(section.number_within(key, low, high)?.map(Self::constant));
        }
        let property = Self::read_table(&section.required_section(key)?, unit)?;
        property.check_values(section, key, low, high)?;
        Ok(Some(property))
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
        if let Some(melt) = self.melt_at(temperature) {
            return melt.at(temperature);
        }
        Ok(match &self.form {
            Form::Constant(value) => *value,
            Form::Table { temperatures, values } => interpolate(temperatures, values, temperature),
            Form::Polynomial { coefficients, origin } => {
                let shifted = temperature - origin;
                coefficients.iter().rev().fold(0.0, |sum, c| sum * shifted + c)
            }
            Form::Arrhenius { factor, temperature: activation } => factor * (activation / temperature).exp(),
        })
    }

    /// Whether the number is stated to hold at this temperature [K].
    pub fn holds_at(&self, temperature: f64) -> bool {
        if let Some(melt) = self.melt_at(temperature) {
            return melt.holds_at(temperature);
        }
        self.valid.is_none_or(|[low, high]| (low..=high).contains(&temperature))
    }

    /// Range of temperature that the source states [K].
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

    /// Where the number comes from; a text that starts with "assumed" says it has no source.
    pub fn source(&self) -> Option<&str> {
        self.source.as_deref()
    }

    /// Whether the value is the same at every temperature.
    pub fn is_constant(&self) -> bool {
        matches!(self.form, Form::Constant(_)) && self.melt.is_none()
    }

    /// Temperatures [K] at which [`Property::at`] answers; `None` for all of them.
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

    /// Temperature [K] at which the form ends; infinite where nothing says so.
    fn solid_end(&self) -> f64 {
        self.solid_range().or(self.valid).map_or(f64::INFINITY, |[_, high]| high)
    }

    /// As [`Property::known_range`], without the melt.
    fn solid_range(&self) -> Option<[f64; 2]> {
        match &self.form {
            Form::Constant(_) => None,
            Form::Table { temperatures, .. } => Some([*temperatures.first()?, *temperatures.last()?]),
            Form::Polynomial { .. } | Form::Arrhenius { .. } => self.valid,
        }
    }

    /// Refuses values outside `low..=high` at the points that describe the form.
    fn check_values(&self, section: &Section<'_>, key: &str, low: f64, high: f64) -> Result<(), InputError> {
        let values = match &self.form {
            Form::Constant(value) => vec![*value],
            Form::Table { values, .. } => values.clone(),
            Form::Polynomial { .. } | Form::Arrhenius { .. } => {
                let ends = self.valid.unwrap_or([293.15, 293.15]);
                ends.iter().filter_map(|t| self.at(*t).ok()).collect()
            }
        };
        if let Some(melt) = &self.melt {
            melt.check_values(section, key, low, high)?;
        }
        match values.iter().find(|value| !(low..=high).contains(*value)) {
            Some(value) => {
                Err(section.fault(key, format!("{value} is outside the allowed range {low} to {high}")))
            }
            None => Ok(()),
        }
    }
}

impl Form {
    fn read(table: &Section<'_>) -> Result<Self, InputError> {
        if let Some(temperatures) = table.numbers("T")? {
            let values = table.numbers("value")?.ok_or_else(|| table.missing("value", "a list"))?;
            if values.len() != temperatures.len() || temperatures.len() < 2 {
                return Err(table.fault("value", "T and value need the same number of entries, two or more"));
            }
            if temperatures.windows(2).any(|pair| pair[0] >= pair[1]) || temperatures[0] <= 0.0 {
                return Err(table.fault("T", "temperatures [K] must be positive and rise"));
            }
            return Ok(Self::Table { temperatures, values });
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

/// Linear interpolation; `x` lies within the (rising) points `xs`.
fn interpolate(xs: &[f64], ys: &[f64], x: f64) -> f64 {
    let upper = xs.partition_point(|point| *point < x).clamp(1, xs.len() - 1);
    let (x0, x1, y0, y1) = (xs[upper - 1], xs[upper], ys[upper - 1], ys[upper]);
    y0 + (y1 - y0) * ((x - x0) / (x1 - x0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::Document;
    use approx::assert_relative_eq;

    fn property(text: &str) -> Result<Property, InputError> {
        Document::new("m.toml", text)
            .read(|top| Property::read(top, "p", "Pa", 0.0, f64::INFINITY))
            .map(Option::unwrap)
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
    fn the_melt_takes_over_where_the_solid_ends() {
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
}
