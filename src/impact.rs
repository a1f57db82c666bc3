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

/// What a number may be.
#[derive(Debug, Clone, Copy)]
pub struct Bounds {
    low: f64,
    high: f64,
    reason: &'static str,
}

impl Bounds {
    const ANY: Self = Self { low: f64::MIN, high: f64::MAX, reason: "must be finite" };
    const NOT_NEGATIVE: Self = Self { low: 0.0, high: f64::MAX, reason: "must be finite and not negative" };
    /// From the least number above 0.
    const POSITIVE: Self =
        Self { low: f64::from_bits(1), high: f64::MAX, reason: "must be positive and finite" };
    const SHARE: Self = Self { low: 0.0, high: 1.0, reason: "must be between 0 and 1" };

    /// Whether a number is within them.
    #[inline(always)]
    pub fn allow(&self, value: f64) -> bool {
        (value >= self.low) & (value <= self.high)
    }
}

/// What each of [`INPUTS`] may be, in their order.
pub const BOUNDS: [Bounds; INPUTS.len()] = [
    Bounds::NOT_NEGATIVE,
    Bounds::NOT_NEGATIVE,
    Bounds::POSITIVE,
    Bounds::POSITIVE,
    Bounds::POSITIVE,
    Bounds::SHARE,
    Bounds::NOT_NEGATIVE,
    Bounds::NOT_NEGATIVE,
    Bounds::NOT_NEGATIVE,
    Bounds::NOT_NEGATIVE,
    Bounds::ANY,
    Bounds::SHARE,
    Bounds::NOT_NEGATIVE,
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
    // Places in `INPUTS` of what the laws look at.
    pub(crate) const NORMAL_SPEED: usize = 0;
    pub(crate) const TANGENTIAL_SPEED: usize = 1;
    pub(crate) const DIAMETER: usize = 2;
    pub(crate) const PARTICLE_TEMPERATURE: usize = 3;
    pub(crate) const WALL_TEMPERATURE: usize = 4;
    pub(crate) const CONVERSION: usize = 5;
    pub(crate) const SPIN: usize = 10;
    pub(crate) const MELT_THICKNESS: usize = 12;

    /// Checks that every number is finite and has a physical meaning.
    ///
    /// # Errors
    /// [`ImpactError::Unusable`] naming the first number at fault.
    #[inline(always)]
    pub fn check(&self) -> Result<(), ImpactError> {
        // Without branches: this is asked of every impact.
        let values = self.values();
        let allowed =
            values.iter().zip(&BOUNDS).fold(true, |all, (value, bounds)| all & bounds.allow(*value));
        if allowed { Ok(()) } else { self.fault() }
    }

    /// The first input at fault.
    #[cold]
    fn fault(&self) -> Result<(), ImpactError> {
        let fault =
            self.values().into_iter().zip(&BOUNDS).zip(&INPUTS).find(|((v, bounds), _)| !bounds.allow(*v));
        match fault {
            Some(((value, bounds), Input { name: quantity, .. })) => {
                Err(ImpactError::Unusable { quantity, value, reason: bounds.reason })
            }
            None => Ok(()),
        }
    }

    /// The values of [`INPUTS`].
    #[inline(always)]
    fn values(&self) -> [f64; INPUTS.len()] {
        [
            self.normal_speed,
            self.tangential_speed,
            self.diameter,
            self.particle_temperature,
            self.wall_temperature,
            self.conversion,
            self.layer_thickness,
            self.film_thickness,
            self.gas_speed,
            self.roughness,
            self.spin,
            self.coverage,
            self.melt_thickness,
        ]
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
    fn inputs_are_in_their_places() {
        for (place, input) in INPUTS.iter().enumerate() {
            let mut impact = Impact::default();
            (input.set)(&mut impact, 0.123);
            assert_eq!(impact.values()[place], 0.123, "{}", input.name);
        }
        let named = |place: usize| INPUTS[place].name;
        let [t_p, t_w] = [Impact::PARTICLE_TEMPERATURE, Impact::WALL_TEMPERATURE].map(named);
        assert_eq!(
            [t_p, t_w, named(Impact::CONVERSION), named(Impact::SPIN), named(Impact::MELT_THICKNESS)],
            ["T_p", "T_w", "conversion", "omega", "melt_thickness"]
        );
        let speeds = [Impact::NORMAL_SPEED, Impact::TANGENTIAL_SPEED, Impact::DIAMETER].map(named);
        assert_eq!(speeds, ["v_n", "v_t", "d"]);
    }

    #[test]
    fn regimes_have_their_numbers_and_names() {
        assert_eq!(Regime::of(false, true), Regime::NspSw);
        assert_eq!(Regime::of(true, false).name(), "SP-NSW");
        assert_eq!(Regime::SpSw as u32, 3);
    }
}
