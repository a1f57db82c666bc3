//! The table of the inputs of an impact.
//!
//! Everything that lists the inputs follows from [`for_each_input!`]: [`Impact`], [`INPUTS`], the C structs
//! `nw_impact` and `nw_impacts`, `nearwall.h`, the bindings, the columns of data files and recorders, and the table
//! of `docs/reference/data-file.md`. After a change, `NEARWALL_BLESS=1 cargo test --test library interface` writes the
//! generated files; `cargo test` fails until they agree.

/// Calls a macro with one row for each input, in the order of the C structs: description, name in files and in C,
/// field of [`Impact`], constant with its place in [`INPUTS`], SI unit, [`Bounds`], default.
macro_rules! for_each_input {
    ($define:ident) => {
        $define! {
            // Motion
            /// Speed towards the wall [m/s], not negative.
            v_n, normal_speed, NORMAL_SPEED, "m/s", NOT_NEGATIVE, 0.0;
            /// Speed along the wall [m/s], not negative.
            v_t, tangential_speed, TANGENTIAL_SPEED, "m/s", NOT_NEGATIVE, 0.0;
            /// Spin before the impact [rad/s], positive when the particle rolls forward along `v_t`.
            omega, spin, SPIN, "rad/s", ANY, 0.0;
            // Particle
            /// Particle diameter [m], positive.
            d, diameter, DIAMETER, "m", POSITIVE, 1e-4;
            /// Particle temperature [K], positive.
            T_p, particle_temperature, PARTICLE_TEMPERATURE, "K", POSITIVE, 293.15;
            /// Density of the particle [kg/m3], not negative; 0 takes that of its material.
            rho_p, particle_density, PARTICLE_DENSITY, "kg/m3", NOT_NEGATIVE, 0.0;
            /// Carbon conversion [1], 0 to 1; 1 for a particle without carbon.
            conversion, conversion, CONVERSION, "1", SHARE, 1.0;
            // Wall
            /// Wall temperature [K], positive.
            T_w, wall_temperature, WALL_TEMPERATURE, "K", POSITIVE, 293.15;
            /// Temperature of the wall's own material under a deposit [K], not negative; 0 takes `T_w`.
            T_under, temperature_under, TEMPERATURE_UNDER, "K", NOT_NEGATIVE, 0.0;
            /// Roughness of the wall [m], not negative; kept for diagnosis, used by no built-in law.
            roughness, roughness, ROUGHNESS, "m", NOT_NEGATIVE, 0.0;
            /// Share of the wall that non-sticky char covers [1], 0 to 1.
            coverage, coverage, COVERAGE, "1", SHARE, 0.0;
            /// Thickness of the powder layer on the wall [m], not negative.
            layer_thickness, layer_thickness, LAYER_THICKNESS, "m", NOT_NEGATIVE, 0.0;
            /// Thickness of a liquid film [m], not negative; `liquid-film` uses it, or the melt if thicker.
            film_thickness, film_thickness, FILM_THICKNESS, "m", NOT_NEGATIVE, 0.0;
            /// Thickness of the melt in the deposit of earlier particles [m], not negative.
            melt_thickness, melt_thickness, MELT_THICKNESS, "m", NOT_NEGATIVE, 0.0;
            // Gas
            /// Speed of the gas along the wall [m/s], not negative.
            v_gas, gas_speed, GAS_SPEED, "m/s", NOT_NEGATIVE, 0.0;
        }
    };
}

use super::ExtraInputs;
pub(crate) use for_each_input;

/// One input of an impact.
pub struct Input {
    /// Name in data files, model files and C, for instance `v_n`.
    pub name: &'static str,
    /// Description with unit and bounds, one sentence.
    pub about: &'static str,
    /// SI unit.
    pub unit: &'static str,
    /// The values it may have.
    pub bounds: Bounds,
    /// Reads it from an impact.
    pub value: fn(&Impact) -> f64,
    /// Sets it in an impact.
    pub set: fn(&mut Impact, f64),
}

impl Input {
    /// What it is in a few words, without unit and bounds.
    pub fn words(&self) -> &'static str {
        self.about.split(" [").next().unwrap_or(self.about)
    }
}

/// The values that an input may have.
#[derive(Debug, Clone, Copy)]
pub struct Bounds {
    low: f64,
    high: f64,
    pub(super) reason: &'static str,
}

impl Bounds {
    const ANY: Self = Self { low: f64::MIN, high: f64::MAX, reason: "must be finite" };
    const NOT_NEGATIVE: Self = Self { low: 0.0, high: f64::MAX, reason: "must be finite and not negative" };
    /// From the smallest number above 0.
    const POSITIVE: Self =
        Self { low: f64::from_bits(1), high: f64::MAX, reason: "must be positive and finite" };
    const SHARE: Self = Self { low: 0.0, high: 1.0, reason: "must be between 0 and 1" };

    /// Whether a value is within the bounds; NaN never is.
    #[inline(always)]
    pub fn allow(&self, value: f64) -> bool {
        (value >= self.low) & (value <= self.high)
    }
}

macro_rules! define_impact {
    ($(
        #[doc = $about:literal]
        $name:ident, $field:ident, $place:ident, $unit:literal, $bounds:ident, $default:literal;
    )*) => {
        /// One particle as it reaches a wall. SI units throughout.
        ///
        /// [`Impact::default`] has the values assumed for inputs that a caller does not know.
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub struct Impact {
            $(
                #[doc = $about]
                #[doc = concat!("`", stringify!($name), "` in files and in C.")]
                pub $field: f64,
            )*
            /// Inputs that the model file declares.
            pub extra: ExtraInputs,
        }

        impl Default for Impact {
            fn default() -> Self {
                Self { $($field: $default,)* extra: ExtraInputs::default() }
            }
        }

        /// Every input of an impact, in the order of the C structs.
        pub const INPUTS: [Input; [$($unit),*].len()] = [$(
            Input {
                name: stringify!($name),
                about: $about.trim_ascii(),
                unit: $unit,
                bounds: Bounds::$bounds,
                value: |impact| impact.$field,
                set: |impact, value| impact.$field = value,
            },
        )*];

        #[allow(non_camel_case_types)]
        enum InputPlace {
            $($field,)*
        }

        impl Impact {
            $(#[doc = concat!("Place of `", stringify!($field), "` in [`INPUTS`].")]
            pub const $place: usize = InputPlace::$field as usize;)*
        }

        impl Impact {
            /// An impact from a function that gives each of [`INPUTS`] by its place.
            #[inline(always)]
            pub(super) fn from_inputs(value: impl Fn(usize) -> f64) -> Self {
                Self { $($field: value(Self::$place),)* extra: ExtraInputs::default() }
            }

            /// Whether every input is within its bounds, without branches: every impact is checked.
            #[inline(always)]
            pub(super) fn is_allowed(&self) -> bool {
                true $(& Bounds::$bounds.allow(self.$field))*
            }
        }
    };
}

for_each_input!(define_impact);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inputs_are_in_their_places() {
        let mut impact = Impact::default();
        for (number, input) in INPUTS.iter().enumerate() {
            (input.set)(&mut impact, number as f64);
        }
        let places = [
            (Impact::NORMAL_SPEED, "v_n", impact.normal_speed),
            (Impact::DIAMETER, "d", impact.diameter),
            (Impact::WALL_TEMPERATURE, "T_w", impact.wall_temperature),
            (Impact::GAS_SPEED, "v_gas", impact.gas_speed),
        ];
        for (place, name, value) in places {
            assert_eq!((INPUTS[place].name, value), (name, place as f64));
        }
        assert!(INPUTS.iter().enumerate().all(|(place, input)| (input.value)(&impact) == place as f64));
    }

    #[test]
    fn defaults_are_allowed_and_descriptions_state_units() {
        for Input { name, about, unit, bounds, value, .. } in &INPUTS {
            assert!(bounds.allow(value(&Impact::default())), "{name}");
            assert!(about.contains(&format!(" [{unit}]")) && about.ends_with('.'), "{name}: {about}");
        }
    }
}
