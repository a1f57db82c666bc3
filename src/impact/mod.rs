//! What arrives at a wall and what leaves it.

mod block;
mod extra;
mod extra_input;
mod inputs;

use std::borrow::Cow;

pub use block::{BLOCK, Block, Outcomes};
pub use extra::{EXTRA_INPUTS, ExtraInputs};
pub use extra_input::ExtraInput;
pub(crate) use extra_input::read_extra_inputs;
pub(crate) use inputs::for_each_input;
pub use inputs::{Bounds, INPUTS, Impact, Input};

/// Why an impact cannot be resolved.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ImpactError {
    /// A number of the impact is missing its physical meaning.
    #[error("{quantity} = {value}: {reason}")]
    Unusable {
        /// The input's name as in the data file, for instance `v_n`.
        quantity: Cow<'static, str>,
        /// Its value.
        value: f64,
        /// What it has to be.
        reason: &'static str,
    },
    /// A property is not known at the temperature of the impact.
    #[error("{material}: {property} is given for {low} to {high} K, asked for {temperature} K")]
    OutOfRange {
        /// The material's name.
        material: String,
        /// The property's key.
        property: &'static str,
        /// The temperature that was asked for [K].
        temperature: f64,
        /// Lower end of the table [K].
        low: f64,
        /// Upper end of the table [K].
        high: f64,
    },
    /// The model has no wall with this index.
    #[error("the model has no wall number {0}")]
    NoSuchWall(usize),
}

impl Impact {
    /// Checks that every input of [`INPUTS`] is finite and has a physical meaning. A model checks
    /// the inputs that it declares.
    ///
    /// # Errors
    /// [`ImpactError::Unusable`] naming the first input that is not.
    #[inline(always)]
    pub fn check(&self) -> Result<(), ImpactError> {
        if self.is_allowed() { Ok(()) } else { self.first_fault() }
    }

    #[cold]
    fn first_fault(&self) -> Result<(), ImpactError> {
        for Input { name: quantity, bounds, value, .. } in &INPUTS {
            let value = value(self);
            if !bounds.allow(value) {
                let (quantity, reason) = (Cow::Borrowed(*quantity), bounds.reason);
                return Err(ImpactError::Unusable { quantity, value, reason });
            }
        }
        Ok(())
    }

    /// Which input is probably in another unit, if any: a temperature below 150 K, a diameter above 5 cm.
    pub fn unlikely(&self) -> Option<String> {
        if self.diameter > 0.05 {
            return Some(format!("d = {} m is unusually large; check its unit", self.diameter));
        }
        let temperatures = [("T_p", self.particle_temperature), ("T_w", self.wall_temperature)];
        let (name, cold) = temperatures.into_iter().find(|(_, temperature)| *temperature < 150.0)?;
        Some(format!("{name} = {cold} K; is that °C?"))
    }

    /// Impact speed `v` [m/s].
    pub fn speed(&self) -> f64 {
        self.normal_speed.hypot(self.tangential_speed)
    }

    /// Angle between path and surface, `alpha` [rad], 0 glancing to pi/2 head-on.
    pub fn angle_from_surface(&self) -> f64 {
        // A negative zero, which counts as a speed, would turn the angle round.
        self.normal_speed.abs().atan2(self.tangential_speed.abs())
    }

    /// Temperature of the wall's own material [K]: of what lies under a deposit, where it is given.
    #[inline(always)]
    pub fn own_wall_temperature(&self) -> f64 {
        if self.temperature_under > 0.0 { self.temperature_under } else { self.wall_temperature }
    }

    /// Mean of the temperatures of particle and wall [K].
    pub fn mean_temperature(&self) -> f64 {
        0.5 * self.particle_temperature + 0.5 * self.wall_temperature
    }
}

/// Which of particle and wall is sticky: the four regimes of Troiano et al.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u32)]
pub enum Regime {
    /// Non-sticky particle on a non-sticky wall.
    NspNsw = 0,
    /// Non-sticky particle on a sticky wall.
    NspSw = 1,
    /// Sticky particle on a non-sticky wall.
    SpNsw = 2,
    /// Sticky particle on a sticky wall.
    SpSw = 3,
}

impl Regime {
    /// All regimes in the order of their numbers.
    pub const ALL: [Self; 4] = [Self::NspNsw, Self::NspSw, Self::SpNsw, Self::SpSw];

    /// The regime of a particle and a wall.
    pub fn of(particle_sticky: bool, wall_sticky: bool) -> Self {
        Self::ALL[2 * usize::from(particle_sticky) + usize::from(wall_sticky)]
    }

    /// Short name, for instance `NSP-SW`.
    pub fn name(self) -> &'static str {
        ["NSP-NSW", "NSP-SW", "SP-NSW", "SP-SW"][self as usize]
    }
}

/// Result of an impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outcome {
    /// Normal restitution `e_n` [1] of a particle that rebounds.
    pub normal_restitution: f64,
    /// Tangential restitution `e_t` [1] of a particle that rebounds.
    pub tangential_restitution: f64,
    /// Probability of capture [1].
    pub sticking_probability: f64,
    /// Whether this particle is captured, drawn from the probability.
    pub stuck: bool,
    /// Spin after a rebound, `omega` [rad/s].
    pub spin: f64,
    /// Which of particle and wall is sticky.
    pub regime: Regime,
    /// Whether the impact lies outside the range that a fitted term or a constant property is valid for.
    pub outside_range: bool,
}

/// Global restitution `e_g = sqrt(e_n² sin²alpha + e_t² cos²alpha)` [1]: rebound speed over impact speed
/// (Troiano et al., Eq. 9).
///
/// `angle_from_surface` is `alpha` [rad]; both restitutions [1].
pub fn global_restitution(
    normal_restitution: f64,
    tangential_restitution: f64,
    angle_from_surface: f64,
) -> f64 {
    let (sine, cosine) = angle_from_surface.sin_cos();
    (normal_restitution * sine).hypot(tangential_restitution * cosine)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn global_restitution_tends_to_its_parts() {
        assert_relative_eq!(global_restitution(0.31, 0.76, 0.0), 0.76);
        assert_relative_eq!(
            global_restitution(0.31, 0.76, std::f64::consts::FRAC_PI_2),
            0.31,
            epsilon = 1e-15
        );
    }

    #[test]
    fn a_negative_zero_does_not_turn_the_angle_round() {
        let impact = Impact { tangential_speed: -0.0, ..Impact::default() };
        assert_eq!(Impact { normal_speed: -0.0, ..impact }.angle_from_surface(), 0.0);
        assert_eq!(Impact { normal_speed: 1.0, ..impact }.angle_from_surface(), std::f64::consts::FRAC_PI_2);
    }

    #[test]
    fn every_unusable_number_is_named() {
        let good = Impact { normal_speed: 1.0, ..Impact::default() };
        assert_eq!(good.check(), Ok(()));
        let bad = Impact { diameter: 0.0, ..good };
        assert_eq!(bad.check().unwrap_err().to_string(), "d = 0: must be positive and finite");
        let bad = Impact { particle_temperature: f64::NAN, ..good };
        assert!(bad.check().unwrap_err().to_string().starts_with("T_p = NaN"));
        let bad = Impact { spin: f64::INFINITY, ..good };
        assert!(bad.check().is_err());
    }

    #[test]
    fn regimes_have_their_numbers_and_names() {
        assert_eq!(Regime::of(false, true), Regime::NspSw);
        assert_eq!(Regime::of(true, false).name(), "SP-NSW");
        assert_eq!(Regime::SpSw as u32, 3);
    }
}
