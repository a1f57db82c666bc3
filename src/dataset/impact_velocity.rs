//! How the two speeds of an impact follow from what was measured: speeds, or one speed and an angle.

use super::inputs::{InputColumns, Stated, position};
use super::number::NumberColumn;
use crate::impact::Impact;

/// What an angle is measured from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum AngleFrom {
    /// 0° is glancing.
    Surface,
    /// 0° is head-on.
    Normal,
}

impl AngleFrom {
    /// Words of a column map.
    pub(super) const WORDS: [&str; 2] = ["surface", "normal"];

    /// The meaning of one of [`Self::WORDS`].
    pub(super) fn of(word: &str) -> Self {
        if word == Self::WORDS[0] { Self::Surface } else { Self::Normal }
    }
}

/// Path of a particle against the wall.
#[derive(Debug, Clone, Copy)]
struct Slope {
    /// Sine of the angle from the surface [1].
    towards: f64,
    /// Sine of the angle from the normal [1].
    along: f64,
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
    /// Angles this much above 90° [°] are 90°: 1.5708 rad is a right angle that somebody rounded.
    const SLACK: f64 = 0.06;

    fn read(&self, cells: &csv::StringRecord) -> Result<Option<Slope>, String> {
        let Some(angle) = self.column.read_finite(cells)? else { return Ok(None) };
        if !(0.0..=90.0 + Self::SLACK).contains(&angle) {
            return Err(format!("angle = {angle}°: must be between 0° and 90°"));
        }
        let angle = angle.min(90.0);
        // Sines of both, since the cosine of 90° is not exactly 0.
        let (near, far) = (angle.to_radians().sin(), (90.0 - angle).to_radians().sin());
        Ok(Some(match self.from {
            AngleFrom::Surface => Slope { towards: near, along: far },
            AngleFrom::Normal => Slope { towards: far, along: near },
        }))
    }
}

/// Where `v_n` and `v_t` come from.
#[derive(Debug, Clone, Copy)]
pub(super) enum Incidence {
    /// Both from their columns.
    Speeds,
    /// From the whole speed and the angle.
    SpeedAndAngle(NumberColumn, AngleColumn),
    /// `v_t` from `v_n` and the angle.
    NormalAndAngle(AngleColumn),
    /// `v_n` from `v_t` and the angle.
    TangentialAndAngle(AngleColumn),
}

/// What says how fast and how steep, and which sets of them do.
pub(super) const KEYS: [&str; 4] = ["v_n", "v_t", "speed", "angle"];

/// Which of [`KEYS`] are enough; more is too much.
const ENOUGH: &str = "v_n, or v_n and v_t, or angle with one of speed, v_n and v_t";

/// Why keys say too much, or `None` if they do not; `has` says which of [`KEYS`] there are.
pub(super) fn too_much(has: impl Fn(&str) -> bool) -> Option<String> {
    let given: Vec<&str> = KEYS.into_iter().filter(|key| has(key)).collect();
    let contradicts = given.len() > 2 || (has("speed") && (has("v_n") || has("v_t")));
    contradicts.then(|| format!("{} together say too much; keep {ENOUGH}", given.join(", ")))
}

/// Why there is no speed towards the wall; `has` says which of [`KEYS`] there are.
fn too_little(has: impl Fn(&str) -> bool) -> String {
    let given: Vec<&str> = KEYS.into_iter().filter(|key| has(key)).collect();
    if given.is_empty() {
        return "no column `v_n` (speed towards the wall, m/s)".to_owned();
    }
    format!(
        "{} alone does not say how fast the particle comes towards the wall; give {ENOUGH}",
        given.join(", ")
    )
}

impl Incidence {
    /// What follows from the columns there are.
    ///
    /// # Errors
    /// The reason, where they say too much or too little.
    pub(super) fn of(
        inputs: &InputColumns,
        speed: Option<NumberColumn>,
        angle: Option<AngleColumn>,
    ) -> Result<Self, String> {
        let has = |key: &str| match key {
            "speed" => speed.is_some(),
            "angle" => angle.is_some(),
            input => inputs.gives(input),
        };
        if let Some(problem) = too_much(has) {
            return Err(problem);
        }
        match (angle, speed) {
            (Some(angle), Some(speed)) => Ok(Self::SpeedAndAngle(speed, angle)),
            (Some(angle), None) if has("v_n") => Ok(Self::NormalAndAngle(angle)),
            (Some(angle), None) if has("v_t") => Ok(Self::TangentialAndAngle(angle)),
            (None, None) if has("v_n") => Ok(Self::Speeds),
            _ => Err(too_little(has)),
        }
    }

    /// Whether a row can state this input although no column has its name.
    pub(super) fn gives(&self, name: &str) -> bool {
        match self {
            Self::Speeds => false,
            _ => name == "v_n" || name == "v_t",
        }
    }

    /// Sets what follows from the angle.
    ///
    /// # Errors
    /// The reason, where a cell is no number or the wanted speed does not follow.
    pub(super) fn complete(
        &self,
        cells: &csv::StringRecord,
        impact: &mut Impact,
        stated: &mut Stated,
    ) -> Result<(), String> {
        match self {
            Self::Speeds => return Ok(()),
            Self::SpeedAndAngle(speed, angle) => {
                let speed = speed.read_finite(cells)?.ok_or("speed is blank")?;
                if speed < 0.0 {
                    return Err("speed is negative".to_owned());
                }
                let slope = angle.read(cells)?.ok_or("angle is blank")?;
                impact.normal_speed = speed * slope.towards;
                impact.tangential_speed = speed * slope.along;
            }
            Self::NormalAndAngle(angle) => {
                // Blank is the default of v_t, as in a column of its own.
                let Some(slope) = angle.read(cells)? else { return Ok(()) };
                impact.tangential_speed = follows(impact.normal_speed, slope.along, slope.towards, "v_n")?;
            }
            Self::TangentialAndAngle(angle) => {
                if !stated[position("v_t")] {
                    return Err("v_t is blank, and v_n follows from it".to_owned());
                }
                let slope = angle.read(cells)?.ok_or("angle is blank")?;
                impact.normal_speed = follows(impact.tangential_speed, slope.towards, slope.along, "v_t")?;
            }
        }
        stated[position("v_n")] = true;
        stated[position("v_t")] = true;
        Ok(())
    }
}

/// The one speed [m/s] from the other; both sines [1].
fn follows(other: f64, wanted: f64, given: f64, name: &str) -> Result<f64, String> {
    if given == 0.0 {
        return Err(format!(
            "the angle leaves no part of the speed to {name}, so the other part does not follow"
        ));
    }
    Ok(other * wanted / given)
}
