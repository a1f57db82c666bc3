//! The normal and tangential speed of an impact, from two speeds or from one speed and an angle.

use super::inputs::{InputColumns, StatedInputs, position};
use super::number::NumberColumn;
use super::row_error::{HeaderError, RowFault};
use nearwall::impact::Impact;

/// The origin of an angle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum AngleFrom {
    /// 0° is glancing.
    Surface,
    /// 0° is head-on.
    Normal,
}

impl AngleFrom {
    /// The words of a column map.
    pub(super) const WORDS: [&str; 2] = ["surface", "normal"];

    /// The meaning of one of [`Self::WORDS`].
    pub(super) fn of(word: &str) -> Self {
        if word == Self::WORDS[0] { Self::Surface } else { Self::Normal }
    }
}

/// A column of angles.
#[derive(Debug, Clone, Copy)]
pub(super) struct AngleColumn {
    /// The cells, in degrees once read.
    pub(super) column: NumberColumn,
    /// What they are measured from.
    pub(super) from: AngleFrom,
}

impl AngleColumn {
    /// Excess over 90° [°] that is taken for rounding, as in 1.5708 rad.
    const SLACK: f64 = 0.06;

    /// Sines of the angles from the surface and from the normal [1]: the shares of `v_n` and `v_t` in the speed.
    fn read(&self, cells: &csv::StringRecord) -> Result<Option<[f64; 2]>, RowFault> {
        let Some(angle) = self.column.read_finite(cells)? else { return Ok(None) };
        if !(0.0..=90.0 + Self::SLACK).contains(&angle) {
            return Err(RowFault::Angle(angle));
        }
        let angle = angle.min(90.0);
        // Sines of both angles: the cosine of 90° is not exactly 0.
        let (near, far) = (angle.to_radians().sin(), (90.0 - angle).to_radians().sin());
        Ok(Some(match self.from {
            AngleFrom::Surface => [near, far],
            AngleFrom::Normal => [far, near],
        }))
    }
}

/// The columns that determine `v_n` and `v_t`.
#[derive(Debug, Clone, Copy)]
pub(super) enum ImpactVelocity {
    /// Both from their columns.
    Speeds,
    /// From the magnitude of the velocity and the angle.
    SpeedAndAngle(NumberColumn, AngleColumn),
    /// `v_t` from `v_n` and the angle.
    NormalAndAngle(AngleColumn),
    /// `v_n` from `v_t` and the angle.
    TangentialAndAngle(AngleColumn),
}

/// The columns that may determine the velocity.
pub(super) const KEYS: [&str; 4] = ["v_n", "v_t", "speed", "angle"];

/// The error if the keys over-determine the velocity; `has` tells which of [`KEYS`] are given.
pub(super) fn over_determined(has: impl Fn(&str) -> bool) -> Option<HeaderError> {
    let given: Vec<&str> = KEYS.into_iter().filter(|key| has(key)).collect();
    let contradicts = given.len() > 2 || (has("speed") && (has("v_n") || has("v_t")));
    contradicts.then(|| HeaderError::OverDetermined(given.join(", ")))
}

/// The error if the keys under-determine the velocity; `has` tells which of [`KEYS`] are given.
fn under_determined(has: impl Fn(&str) -> bool) -> HeaderError {
    let given: Vec<&str> = KEYS.into_iter().filter(|key| has(key)).collect();
    match given.is_empty() {
        true => HeaderError::NoNormalSpeed,
        false => HeaderError::UnderDetermined(given.join(", ")),
    }
}

impl ImpactVelocity {
    /// The velocity that the given columns determine.
    ///
    /// # Errors
    /// The reason, if they over- or under-determine it.
    pub(super) fn of(
        inputs: &InputColumns,
        speed: Option<NumberColumn>,
        angle: Option<AngleColumn>,
    ) -> Result<Self, HeaderError> {
        let has = |key: &str| match key {
            "speed" => speed.is_some(),
            "angle" => angle.is_some(),
            input => inputs.gives(input),
        };
        if let Some(problem) = over_determined(has) {
            return Err(problem);
        }
        match (angle, speed) {
            (Some(angle), Some(speed)) => Ok(Self::SpeedAndAngle(speed, angle)),
            (Some(angle), None) if has("v_n") => Ok(Self::NormalAndAngle(angle)),
            (Some(angle), None) if has("v_t") => Ok(Self::TangentialAndAngle(angle)),
            (None, None) if has("v_n") => Ok(Self::Speeds),
            _ => Err(under_determined(has)),
        }
    }

    /// Whether this input is computed.
    pub(super) fn gives(&self, name: &str) -> bool {
        match self {
            Self::Speeds => false,
            _ => name == "v_n" || name == "v_t",
        }
    }

    /// Sets the speeds that follow from the angle.
    ///
    /// # Errors
    /// The reason, if a cell is not a number or the angle does not determine the speed.
    pub(super) fn complete(
        &self,
        cells: &csv::StringRecord,
        impact: &mut Impact,
        stated: &mut StatedInputs,
    ) -> Result<(), RowFault> {
        match self {
            Self::Speeds => return Ok(()),
            Self::SpeedAndAngle(speed, angle) => {
                let speed = speed.read_finite(cells)?.ok_or(RowFault::Blank("speed"))?;
                if speed < 0.0 {
                    return Err(RowFault::Negative("speed"));
                }
                let shares = angle.read(cells)?.ok_or(RowFault::Blank("angle"))?;
                [impact.normal_speed, impact.tangential_speed] = shares.map(|share| speed * share);
            }
            Self::NormalAndAngle(angle) => {
                // A blank angle means the default of v_t, as a blank v_t does.
                let Some([normal, tangential]) = angle.read(cells)? else { return Ok(()) };
                impact.tangential_speed = other_speed(impact.normal_speed, tangential, normal, "v_n")?;
            }
            Self::TangentialAndAngle(angle) => {
                if !stated[position("v_t")] {
                    return Err(RowFault::NoTangentialSpeed);
                }
                let [normal, tangential] = angle.read(cells)?.ok_or(RowFault::Blank("angle"))?;
                impact.normal_speed = other_speed(impact.tangential_speed, normal, tangential, "v_t")?;
            }
        }
        stated[position("v_n")] = true;
        stated[position("v_t")] = true;
        Ok(())
    }

    /// Standard errors of `v_n` and `v_t` [m/s] of this impact, to first order, from those of the
    /// columns that determine them: of both speeds [m/s], of the magnitude `speed` [m/s] and of
    /// `angle` [rad].
    pub(super) fn propagate(&self, impact: &Impact, own: [f64; 2], speed: f64, angle: f64) -> [f64; 2] {
        let speeds = [impact.normal_speed, impact.tangential_speed];
        let magnitude = impact.speed();
        // A quotient of 0 and 0 belongs to a particle at rest.
        let ratio = |part: f64, of: f64| if of == 0.0 { 0.0 } else { part / of };
        // Error of `of`, which is the known speed times the tangent of an angle.
        let by_angle = |of: f64, known: f64, error: f64| {
            (ratio(of, known) * error).hypot(ratio(magnitude * magnitude, known) * angle)
        };
        match self {
            Self::Speeds => own,
            Self::SpeedAndAngle(..) => {
                let [n, t] = speeds;
                [(n, t), (t, n)].map(|(part, other)| (ratio(part, magnitude) * speed).hypot(other * angle))
            }
            Self::NormalAndAngle(_) => [own[0], by_angle(speeds[1], speeds[0], own[0])],
            Self::TangentialAndAngle(_) => [by_angle(speeds[0], speeds[1], own[1]), own[1]],
        }
    }
}

/// The wanted speed [m/s] from the given one; both sines [1].
fn other_speed(known: f64, wanted: f64, given: f64, name: &'static str) -> Result<f64, RowFault> {
    if given == 0.0 {
        return Err(RowFault::Undetermined(name));
    }
    Ok(known * wanted / given)
}
