//! Closed forms over one input or group: what a `fitted-form` is made of. One row of [`FORMS`] a form.
//!
//! `x` is the input, in its unit, `f` the value [1]. A new form is a row of the table; tests demand its row
//! in the documents. A form holds for the data of its fit: beyond them it goes on.

use super::correction::LARGEST_VALUE;
use super::{Parameter, Search};

/// Largest size of a parameter.
const LARGEST: f64 = 1e30;
const ANY: (f64, f64) = (-LARGEST, LARGEST);
const POSITIVE: (f64, f64) = (f64::MIN_POSITIVE, LARGEST);
/// Of the values of a restitution.
const UNIT: Search = Search::Linear(-1.0, 1.0);
/// Of a place in the range of the input, which only a fit knows.
const PLACE: Search = Search::Log(1e-6, 1e6);

/// A closed form with its parameters. `Search` of a parameter in the unit of the input is nominal: a fit takes
/// the range of its data.
#[derive(Debug)]
pub struct FormInfo {
    /// Its name in model files.
    pub name: &'static str,
    /// One line of description.
    pub about: &'static str,
    /// Its right-hand side over `x`, with the names of its parameters.
    pub equation: &'static str,
    /// Its parameters; those with a default are left there by a fit unless another value is worth it. A unit
    /// `input` is that of `x`.
    pub parameters: &'static [Parameter],
    value: fn(&[f64], f64) -> f64,
}

/// Forms are equal when their names are.
impl PartialEq for FormInfo {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl FormInfo {
    /// The form of this name.
    pub fn from_name(name: &str) -> Option<&'static Self> {
        FORMS.iter().find(|form| form.name == name)
    }

    /// The value `f` [1], from -100 to 100, from the parameters in their order and `x`; NaN where it has none or
    /// the number of parameters is wrong.
    pub fn value(&self, parameters: &[f64], x: f64) -> f64 {
        (self.value)(parameters, x).clamp(-LARGEST_VALUE, LARGEST_VALUE)
    }
}

/// Every closed form.
pub static FORMS: [FormInfo; 6] = [
    FormInfo {
        name: "constant",
        about: "the same at every x",
        equation: "a",
        parameters: &[Parameter::new("a", "1", ANY, UNIT).about("the value")],
        value: |parameters, _| match *parameters {
            [a] => a,
            _ => f64::NAN,
        },
    },
    FormInfo {
        name: "line",
        about: "a straight line",
        equation: "a + b x",
        parameters: &[
            Parameter::new("a", "1", ANY, UNIT).about("the value at x = 0"),
            Parameter::new("b", "1/input", ANY, UNIT).about("the slope"),
        ],
        value: |parameters, x| match *parameters {
            [a, b] => a + b * x,
            _ => f64::NAN,
        },
    },
    FormInfo {
        name: "power",
        about: "a power of x",
        equation: "a x^b",
        parameters: &[
            Parameter::new("a", "1/input^b", ANY, UNIT).about("the value at x = 1"),
            Parameter::new("b", "1", (-100.0, 100.0), Search::Linear(-3.0, 3.0)).about("the exponent"),
        ],
        value: |parameters, x| match *parameters {
            [a, b] => a * x.powf(b),
            _ => f64::NAN,
        },
    },
    FormInfo {
        name: "exponential",
        about: "a decay to a floor",
        equation: "floor + a exp(-x/x_0)",
        parameters: &[
            Parameter::new("a", "1", ANY, UNIT).about("the value at x = 0 above the floor"),
            Parameter::new("x_0", "input", POSITIVE, PLACE).about("the x in which it falls to 1/e"),
            Parameter::new("floor", "1", ANY, UNIT).default(0.0).about("the value at large x"),
        ],
        value: |parameters, x| match *parameters {
            [a, x_0, floor] => floor + a * (-x / x_0).exp(),
            _ => f64::NAN,
        },
    },
    FormInfo {
        name: "logistic",
        about: "a threshold with a width: from `low` to `high` at x_0; a large n is a step, a negative one falls",
        equation: "low + (high - low)/(1 + (x/x_0)^-n), x below 0 as 0",
        parameters: &[
            Parameter::new("x_0", "input", POSITIVE, PLACE).about("the x of the threshold"),
            Parameter::new("n", "1", (-1e4, 1e4), Search::Linear(-50.0, 50.0)).about("the steepness"),
            Parameter::new("low", "1", ANY, UNIT).default(0.0).about("the value far below x_0"),
            Parameter::new("high", "1", ANY, UNIT).default(1.0).about("the value far above x_0"),
        ],
        value: |parameters, x| match *parameters {
            [x_0, n, low, high] => {
                let x = if x < 0.0 { 0.0 } else { x };
                low + (high - low) / (1.0 + (x / x_0).powf(-n))
            }
            _ => f64::NAN,
        },
    },
    FormInfo {
        name: "saturating",
        about: "a rise that levels off",
        equation: "a x/(x + x_0) + floor",
        parameters: &[
            Parameter::new("a", "1", ANY, UNIT).about("the rise from x = 0 to large x"),
            Parameter::new("x_0", "input", POSITIVE, PLACE).about("the x of half of the rise"),
            Parameter::new("floor", "1", ANY, UNIT).default(0.0).about("the value at x = 0"),
        ],
        value: |parameters, x| match *parameters {
            [a, x_0, floor] => a * x / (x + x_0) + floor,
            _ => f64::NAN,
        },
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn value(form: &str, parameters: &[f64], x: f64) -> f64 {
        FormInfo::from_name(form).unwrap().value(parameters, x)
    }

    /// By hand: 9^-0.5 = 1/3; e^-2 = 0.1353352832366127; (2)^-3 = 1/8.
    #[test]
    fn every_form_has_the_value_of_its_equation() {
        let cases: [(&str, &[f64], f64, f64); 12] = [
            ("constant", &[0.4], 17.0, 0.4),
            ("line", &[0.9, -0.02], 10.0, 0.7),
            ("power", &[0.6, -0.5], 9.0, 0.2),
            ("power", &[2.0, 0.0], 0.0, 2.0),
            ("exponential", &[0.5, 3.0, 0.1], 6.0, 0.1 + 0.5 * 0.135_335_283_236_612_7),
            ("exponential", &[0.5, 3.0, 0.0], 0.0, 0.5),
            ("logistic", &[4.0, 2.0, 0.0, 1.0], 4.0, 0.5),
            ("logistic", &[4.0, 3.0, 0.2, 0.8], 8.0, 0.2 + 0.6 / 1.125),
            ("logistic", &[4.0, -3.0, 0.2, 0.8], 8.0, 0.2 + 0.6 / 9.0),
            ("logistic", &[4.0, 1e4, 0.0, 1.0], 4.1, 1.0),
            ("saturating", &[0.6, 2.0, 0.1], 6.0, 0.55),
            ("saturating", &[0.6, 2.0, 0.1], 0.0, 0.1),
        ];
        for (form, parameters, x, expected) in cases {
            assert_relative_eq!(value(form, parameters, x), expected, max_relative = 1e-14);
        }
    }

    #[test]
    fn a_threshold_has_both_sides_at_any_x_and_values_have_ends() {
        for x in [-5.0, -0.0, 0.0] {
            assert_eq!(value("logistic", &[4.0, 3.0, 0.2, 0.8], x), 0.2);
            assert_eq!(value("logistic", &[4.0, -3.0, 0.2, 0.8], x), 0.8);
        }
        assert_eq!(value("logistic", &[4.0, 3.0, 0.2, 0.8], f64::MAX), 0.8);
        assert_eq!(value("power", &[0.6, -0.5], 0.0), 100.0);
        assert_eq!(value("exponential", &[-0.6, 1.0, 0.0], -1e9), -100.0);
        assert!(value("power", &[0.6, -0.5], -1.0).is_nan());
        assert!(value("logistic", &[4.0, 3.0, 0.2, 0.8], f64::NAN).is_nan());
    }

    #[test]
    fn a_wrong_number_of_parameters_has_no_value() {
        for form in &FORMS {
            let count = form.parameters.len();
            assert!(form.value(&vec![1.0; count], 2.0).is_finite(), "{}", form.name);
            for wrong in [count - 1, count + 1] {
                assert!(form.value(&vec![1.0; wrong], 2.0).is_nan(), "{}", form.name);
            }
            for parameter in form.parameters {
                assert!(form.equation.contains(parameter.name) && !parameter.about.is_empty());
            }
        }
    }
}
