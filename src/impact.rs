//! What arrives at a wall and what leaves it.

/// One particle as it reaches a wall. SI units throughout.
///
/// [`Impact::default`] is the state assumed for inputs that a caller does not know.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Impact {
    /// Speed towards the wall, `v_n` [m/s], not negative.
    pub normal_speed: f64,
    /// Speed along the wall, `v_t` [m/s], not negative.
    pub tangential_speed: f64,
    /// Particle diameter, `d` [m], positive.
    pub diameter: f64,
    /// Particle temperature, `T_p` [K], positive.
    pub particle_temperature: f64,
    /// Wall temperature, `T_w` [K], positive.
    pub wall_temperature: f64,
    /// Carbon conversion, `X_c` [1], 0 to 1; 1 where there is no carbon (left).
    pub conversion: f64,
    /// Thickness of the powder that lies on the wall [m].
    pub layer_thickness: f64,
    /// Thickness of the liquid film on the wall [m].
    pub film_thickness: f64,
    /// Speed of the gas along the wall, `v_gas` [m/s].
    pub gas_speed: f64,
    /// Roughness of the wall [m].
    pub roughness: f64,
    /// Spin before the impact, `omega` [rad/s]; positive when the particle rolls forward along `v_t`.
    pub spin: f64,
    /// Share of the wall that non-sticky char covers [1], 0 to 1.
    pub coverage: f64,
    /// Thickness of the melt that earlier particles left on the wall [m].
    pub melt_thickness: f64,
}

impl Default for Impact {
    fn default() -> Self {
        Self {
            normal_speed: 0.0,
            tangential_speed: 0.0,
            diameter: 1e-4,
            particle_temperature: 293.15,
            wall_temperature: 293.15,
            conversion: 1.0,
            layer_thickness: 0.0,
            film_thickness: 0.0,
            gas_speed: 0.0,
            roughness: 0.0,
            spin: 0.0,
            coverage: 0.0,
            melt_thickness: 0.0,
        }
    }
}

/// One input of an impact as the data file and the model file call it.
pub struct Input {
    /// Column name, for instance `v_n`.
    pub name: &'static str,
    /// SI unit.
    pub unit: &'static str,
    /// Its value in an impact.
    pub value: fn(&Impact) -> f64,
    /// Sets it.
    pub set: fn(&mut Impact, f64),
}

/// One line of [`INPUTS`]: column name, unit and field.
macro_rules! input {
    ($name:literal, $unit:literal, $field:ident) => {
        Input {
            name: $name,
            unit: $unit,
            value: |impact| impact.$field,
            set: |impact, value| impact.$field = value,
        }
    };
}

/// Every input of an impact, in the order of the data file.
pub const INPUTS: [Input; 13] = [
    input!("v_n", "m/s", normal_speed),
    input!("v_t", "m/s", tangential_speed),
    input!("d", "m", diameter),
    input!("T_p", "K", particle_temperature),
    input!("T_w", "K", wall_temperature),
    input!("conversion", "1", conversion),
    input!("layer_thickness", "m", layer_thickness),
    input!("film_thickness", "m", film_thickness),
    input!("v_gas", "m/s", gas_speed),
    input!("roughness", "m", roughness),
    input!("omega", "rad/s", spin),
    input!("coverage", "1", coverage),
    input!("melt_thickness", "m", melt_thickness),
];

/// Why an impact cannot be resolved.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ImpactError {
    /// A number of the impact is missing its physical meaning.
    #[error("{quantity} = {value}: {reason}")]
    Unusable {
        /// The input's name as in the data file, for instance `v_n`.
        quantity: &'static str,
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
    /// Checks that every number is finite and has a physical meaning.
    ///
    /// # Errors
    /// [`ImpactError::Unusable`] naming the first number at fault.
    pub fn check(&self) -> Result<(), ImpactError> {
        let positive = "must be positive and finite";
        let not_negative = "must be finite and not negative";
        let share = "must be between 0 and 1";
        let checks = [
            ("v_n", self.normal_speed, self.normal_speed >= 0.0, not_negative),
            ("v_t", self.tangential_speed, self.tangential_speed >= 0.0, not_negative),
            ("d", self.diameter, self.diameter > 0.0, positive),
            ("T_p", self.particle_temperature, self.particle_temperature > 0.0, positive),
            ("T_w", self.wall_temperature, self.wall_temperature > 0.0, positive),
            ("conversion", self.conversion, (0.0..=1.0).contains(&self.conversion), share),
            ("layer_thickness", self.layer_thickness, self.layer_thickness >= 0.0, not_negative),
            ("film_thickness", self.film_thickness, self.film_thickness >= 0.0, not_negative),
            ("v_gas", self.gas_speed, self.gas_speed >= 0.0, not_negative),
            ("roughness", self.roughness, self.roughness >= 0.0, not_negative),
            ("omega", self.spin, true, "must be finite"),
            ("coverage", self.coverage, (0.0..=1.0).contains(&self.coverage), share),
            ("melt_thickness", self.melt_thickness, self.melt_thickness >= 0.0, not_negative),
        ];
        match checks.iter().find(|(_, value, allowed, _)| !(value.is_finite() && *allowed)) {
            Some(&(quantity, value, _, reason)) => Err(ImpactError::Unusable { quantity, value, reason }),
            None => Ok(()),
        }
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

/// What leaves the wall.
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
