//! Units of any quantity: a conversion to SI, and the powers of the SI base units.
//!
//! A unit is a product of symbols with whole powers, as in `Pa s`, `N/m`, `kg/m3` or `W/(m K)`; what follows the stroke
//! divides, several symbols there need brackets. Prefixes from n to G. Degrees Celsius and Fahrenheit stand alone.

use super::unit::{Dimension, Unit, scaled};

/// Powers of kilogram, metre, second and kelvin.
pub type UnitPowers = [i32; 4];

/// Symbols with their conversion to SI, factor and divisor, and their powers.
const SYMBOLS: [(&str, [f64; 2], UnitPowers); 21] = [
    ("1", [1.0, 1.0], [0; 4]),
    ("-", [1.0, 1.0], [0; 4]),
    ("%", [1.0, 100.0], [0; 4]),
    ("rad", [1.0, 1.0], [0; 4]),
    ("m", [1.0, 1.0], [0, 1, 0, 0]),
    ("cm", [1.0, 100.0], [0, 1, 0, 0]),
    ("g", [1.0, 1e3], [1, 0, 0, 0]),
    ("s", [1.0, 1.0], [0, 0, 1, 0]),
    ("min", [60.0, 1.0], [0, 0, 1, 0]),
    ("h", [3600.0, 1.0], [0, 0, 1, 0]),
    ("K", [1.0, 1.0], [0, 0, 0, 1]),
    ("Hz", [1.0, 1.0], [0, 0, -1, 0]),
    ("rpm", [std::f64::consts::TAU, 60.0], [0, 0, -1, 0]),
    ("N", [1.0, 1.0], [1, 1, -2, 0]),
    ("dyn", [1.0, 1e5], [1, 1, -2, 0]),
    ("Pa", [1.0, 1.0], [1, -1, -2, 0]),
    ("bar", [1e5, 1.0], [1, -1, -2, 0]),
    ("P", [1.0, 10.0], [1, -1, -1, 0]),
    ("cP", [1.0, 1e3], [1, -1, -1, 0]),
    ("J", [1.0, 1.0], [1, 2, -2, 0]),
    ("W", [1.0, 1.0], [1, 2, -3, 0]),
];

/// Prefixes with their factor and divisor.
const PREFIXES: [(&str, [f64; 2]); 7] = [
    ("n", [1.0, 1e9]),
    ("u", [1.0, 1e6]),
    ("µ", [1.0, 1e6]),
    ("m", [1.0, 1e3]),
    ("k", [1e3, 1.0]),
    ("M", [1e6, 1.0]),
    ("G", [1e9, 1.0]),
];
/// The symbols that take them.
const TAKE_PREFIXES: [&str; 8] = ["m", "g", "s", "Hz", "N", "Pa", "J", "W"];

/// Largest power of a symbol: a larger number is no power.
const LARGEST_POWER: i32 = 9;

/// The SI units that columns are given in.
const SI_UNITS: [&str; 22] = [
    "1", "m", "m2", "m3", "s", "kg", "K", "m/s", "1/s", "1/m", "m/s2", "m2/s", "kg/m3", "kg/s", "N", "N/m",
    "Pa", "Pa s", "J", "W", "W/m2", "W/(m K)",
];

/// A unit that a heading states.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct AnyUnit {
    /// The conversion to SI.
    pub conversion: Unit,
    /// The name of its SI unit.
    pub si: &'static str,
}

impl AnyUnit {
    /// The unit of this name; `None` where it is not known.
    pub(super) fn of(name: &str) -> Option<Self> {
        if let Some(conversion) = Dimension::Temperature.unit(name) {
            return Some(Self { conversion, si: "K" });
        }
        let ([factor, divisor], powers) = product(name)?;
        let si = SI_UNITS.into_iter().find(|si| unit_powers(si) == Some(powers))?;
        // Factor and divisor stay apart: 75/1e6 is 75e-6 exactly, 75 * 1e-6 is not.
        Some(Self { conversion: scaled("", factor, divisor), si })
    }
}

/// Factor and divisor to SI of a unit; `None` where it is not known.
pub(super) fn conversion(name: &str) -> Option<[f64; 2]> {
    Some(product(name)?.0)
}

/// The powers of a unit; `None` where it is not known.
pub fn unit_powers(name: &str) -> Option<UnitPowers> {
    Some(product(name)?.1)
}

/// Factor and divisor to SI, and the powers.
fn product(name: &str) -> Option<([f64; 2], UnitPowers)> {
    let name = name.replace('μ', "µ").replace('²', "2").replace('³', "3").replace(['·', '*'], " ");
    let (above, below) = name.split_once('/').unwrap_or((&name, ""));
    let inner = below.trim().strip_prefix('(').and_then(|rest| rest.strip_suffix(')'));
    let is_clear = inner.is_some() || below.split_whitespace().count() <= 1;
    if !is_clear || below.contains('/') || name.trim().is_empty() {
        return None;
    }
    let mut scale = [1.0, 1.0];
    let mut powers = [0; 4];
    for (symbols, sign) in [(above, 1), (inner.unwrap_or(below), -1)] {
        for symbol in symbols.split_whitespace() {
            let ([factor, divisor], of_symbol, exponent) = power(symbol)?;
            let exponent = sign * exponent;
            let [up, down] = if exponent < 0 { [divisor, factor] } else { [factor, divisor] };
            scale = [scale[0] * up.powi(exponent.abs()), scale[1] * down.powi(exponent.abs())];
            powers.iter_mut().zip(of_symbol).for_each(|(power, of)| *power += exponent * of);
        }
    }
    Some((scale, powers))
}

/// A symbol with its exponent, as in `m2` or `s^-1`.
fn power(text: &str) -> Option<([f64; 2], UnitPowers, i32)> {
    let is_exponent = |mark: char| mark.is_ascii_digit() || ['^', '-'].contains(&mark);
    let end =
        text.char_indices().skip(1).find(|(_, mark)| is_exponent(*mark)).map_or(text.len(), |(at, _)| at);
    let (symbol, exponent) = text.split_at(end);
    let exponent = exponent.strip_prefix('^').unwrap_or(exponent);
    let exponent = if exponent.is_empty() { 1 } else { exponent.parse().ok()? };
    if !(-LARGEST_POWER..=LARGEST_POWER).contains(&exponent) {
        return None;
    }
    let known = |name: &str| SYMBOLS.iter().find(|(own, ..)| *own == name);
    if let Some((_, scale, powers)) = known(symbol) {
        return Some((*scale, *powers, exponent));
    }
    let prefixed = |(prefix, [up, down]): &(&str, [f64; 2])| {
        let rest = symbol.strip_prefix(prefix).filter(|rest| TAKE_PREFIXES.contains(rest))?;
        let (_, [factor, divisor], powers) = known(rest)?;
        // A kilogram is the SI unit itself.
        let scale = if symbol == "kg" { [1.0, 1.0] } else { [factor * up, divisor * down] };
        Some((scale, *powers, exponent))
    };
    PREFIXES.iter().find_map(prefixed)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_products_of_symbols() {
        let si =
            |name: &str, value: f64| AnyUnit::of(name).map(|unit| (unit.conversion.to_si(value), unit.si));
        assert_eq!(si("um", 75.0), Some((75e-6, "m")));
        assert_eq!(si("mPa s", 1.0), Some((1e-3, "Pa s")));
        assert_eq!(si("mPa·s", 1.0), Some((1e-3, "Pa s")));
        assert_eq!(si("mN/m", 72.0), Some((0.072, "N/m")));
        assert_eq!(si("dyn/cm", 72.0), Some((0.072, "N/m")));
        assert_eq!(si("g/cm3", 2.3), Some((2300.0, "kg/m3")));
        assert_eq!(si("°C", 20.0), Some((293.15, "K")));
        assert_eq!(si("s^-1", 3.0), Some((3.0, "1/s")));
        assert_eq!(si("kHz", 3.0), Some((3000.0, "1/s")));
        assert_eq!(si("W/(m K)", 2.0), Some((2.0, "W/(m K)")));
        assert_eq!(si("%", 40.0), Some((0.4, "1")));
        assert_eq!(si("min", 2.0), Some((120.0, "s")));
        for unknown in ["", "W/m K", "N2000000000", "s-2147483648", "of the bed", "A", "m/s/s", "weeks"] {
            assert_eq!(si(unknown, 1.0), None, "{unknown}");
        }
        assert!(SI_UNITS.iter().all(|name| unit_powers(name).is_some()));
    }
}
