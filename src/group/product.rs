//! Groups that a model file declares: products of powers of inputs.
//!
//! `x = prod_i a_i^k_i` with inputs `a_i`, each in its SI unit, and exponents `k_i` [1]. That the
//! product has no unit is not checked. `rho_p` is that of the particle's material where the impact
//! states none, `T_under` is `T_w` there.

use super::{Circumstances, GroupInfo, Quantity, finite};
use crate::impact::{ExtraInput, INPUTS, Impact};
use crate::input::{InputError, Section, unknown};

/// An input of a product.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ProductInput {
    /// One of [`INPUTS`], by place.
    Input(usize),
    /// A number that the model file declares, by place in [`Impact::extra`].
    Extra(usize),
}

impl ProductInput {
    /// Its value, in its SI unit; NaN where it is not stated.
    fn value(self, of: &dyn Circumstances) -> f64 {
        let impact = of.impact();
        match self {
            Self::Input(Impact::PARTICLE_DENSITY) => of.quantity(Quantity::Density),
            Self::Input(Impact::TEMPERATURE_UNDER) => impact.own_wall_temperature(),
            Self::Input(place) => INPUTS.get(place).map_or(f64::NAN, |input| (input.value)(impact)),
            Self::Extra(place) => impact.extra.get(place).copied().unwrap_or(f64::NAN),
        }
    }

    fn name(self, extra: &[ExtraInput]) -> &str {
        match self {
            Self::Input(place) => INPUTS.get(place).map_or("?", |input| input.name),
            Self::Extra(place) => extra.get(place).map_or("?", |input| &input.name),
        }
    }
}

/// A product of powers of inputs.
#[derive(Debug, Clone, PartialEq)]
pub struct ProductGroup {
    /// Its name in the model file.
    pub name: String,
    /// Its inputs with their exponents [1].
    pub factors: Vec<(ProductInput, f64)>,
}

impl ProductGroup {
    /// Its value for an impact, in the unit that the powers have; NaN where an input is not stated or the product
    /// is not finite.
    pub fn value(&self, of: &dyn Circumstances) -> f64 {
        finite(self.factors.iter().map(|(input, exponent)| input.value(of).powf(*exponent)).product())
    }

    /// Its name and formula, as in `pi_1 = d v_n^2`; `extra` are the inputs that the model file declares.
    pub(crate) fn describe(&self, extra: &[ExtraInput]) -> String {
        let power = |(input, exponent): &(ProductInput, f64)| match *exponent {
            1.0 => input.name(extra).to_owned(),
            exponent => format!("{}^{exponent}", input.name(extra)),
        };
        format!("{} = {}", self.name, self.factors.iter().map(power).collect::<Vec<_>>().join(" "))
    }

    /// Why a group cannot have this name; `extra` are the inputs that the model file declares.
    pub fn refusal(name: &str, extra: &[ExtraInput]) -> Option<&'static str> {
        if GroupInfo::place(name).is_some() {
            return Some("is a built-in group; give this one another name");
        }
        if extra.iter().any(|input| input.name == name) {
            return Some("is an input of this file; give the group another name");
        }
        ExtraInput::refusal(name)
    }

    fn read(name: &str, section: &Section<'_>, extra: &[ExtraInput]) -> Result<Self, InputError> {
        if let Some(reason) = Self::refusal(name, extra) {
            return Err(section.fault("", format!("`{name}` {reason}")));
        }
        let keys = section.keys();
        if keys.is_empty() {
            return Err(section.fault("", "the group is empty; add inputs with their exponents"));
        }
        let factor = |key: &String| Ok((find(key, section, extra)?, section.required_number(key)?));
        Ok(Self { name: name.to_owned(), factors: keys.iter().map(factor).collect::<Result<_, _>>()? })
    }
}

/// The input of this name.
fn find(name: &str, section: &Section<'_>, extra: &[ExtraInput]) -> Result<ProductInput, InputError> {
    let own = INPUTS.iter().position(|input| input.name == name).map(ProductInput::Input);
    let numbers = || extra.iter().enumerate().filter(|(_, input)| !input.is_label());
    let declared = || numbers().find(|(_, input)| input.name == name);
    own.or_else(|| Some(ProductInput::Extra(declared()?.0))).ok_or_else(|| {
        let names = INPUTS.iter().map(|input| input.name);
        let known: Vec<&str> = names.chain(numbers().map(|(_, input)| input.name.as_str())).collect();
        section.fault(name, format!("{}; declare it in [inputs.{name}]", unknown(name, "input", &known)))
    })
}

/// Reads `[groups]`, where the file has it; `extra` are the inputs that it declares.
///
/// # Errors
/// [`InputError`] naming line, column and key.
pub(crate) fn read_products(
    top: &Section<'_>,
    extra: &[ExtraInput],
) -> Result<Vec<ProductGroup>, InputError> {
    let Some(table) = top.section("groups")? else { return Ok(Vec::new()) };
    let one = |name: &String| ProductGroup::read(name, &table.required_section(name)?, extra);
    table.keys().iter().map(one).collect()
}
