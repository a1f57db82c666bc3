//! What is right to say of a set.

use serde_json::Value;

/// What stands in the place of a cause.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rival {
    /// A slip of the user.
    Slip,
    /// The instrument, or the geometry of the measurement.
    Instrument,
}

impl Rival {
    /// Whether this id is the right one.
    pub fn is(self, id: &str) -> bool {
        id.starts_with("slip:") || self == Self::Instrument && is_rival(id)
    }
}

/// Whether a cause is none of physics, but a slip or the instrument.
pub fn is_rival(id: &str) -> bool {
    ["slip:", "artefact:", "instrument:"].iter().any(|begin| id.starts_with(begin))
}

/// A law whose parameter must not be at an end of its search range, where it is no law.
#[derive(Clone, Copy, Debug)]
pub struct Bound {
    pub cause: &'static str,
    pub parameter: &'static str,
    pub range: (f64, f64),
}

impl Bound {
    /// Whether a finding is this law at an end.
    pub fn is_met(&self, finding: &Value) -> bool {
        let (low, high) = self.range;
        let near = 1e-3 * (high - low);
        let value = finding["parameters"][self.parameter]["value"].as_f64();
        finding["cause"] == self.cause && value.is_some_and(|value| value < low + near || value > high - near)
    }
}

/// What is planted, and what else may be said.
#[derive(Clone, Debug, Default)]
pub struct Expected {
    /// The planted causes, each with its right names; `level*` stands for every name that begins with
    /// `level`, `a*b` for a term over both columns.
    pub planted: Vec<Vec<&'static str>>,
    /// Names that are neither right nor false.
    pub allowed: Vec<&'static str>,
    /// Names of findings and rivals that are false whatever is said beside them.
    pub never: Vec<&'static str>,
    /// What is planted in the place of a cause.
    pub rival: Option<Rival>,
    /// Whether it is false to predict captures.
    pub no_captures: bool,
    pub bound: Option<Bound>,
    /// Whether it is enough to say that the base is refuted.
    pub refuted_is_honest: bool,
    /// Whether the stated gain is only the least.
    pub gain_may_be_larger: bool,
    /// Cause, name and true value of parameters of the library's own laws.
    pub parameters: Vec<(&'static str, &'static str, f64)>,
    /// The cell in the table of weak effects.
    pub cell: Option<String>,
}

impl Expected {
    /// Nothing is planted.
    pub fn nothing() -> Self {
        Self::default()
    }

    /// One cause with its right names.
    pub fn cause(names: &[&'static str]) -> Self {
        Self { planted: vec![names.to_vec()], ..Self::default() }
    }

    /// An effect whose planted law the library does not have: a curve over its inputs is honest.
    pub fn effect(effect: &'static str) -> Self {
        Self { planted: vec![names_of(effect)], ..Self::default() }
    }

    /// A slip of the user.
    pub fn slip() -> Self {
        Self { rival: Some(Rival::Slip), ..Self::default() }
    }

    /// The instrument, and no cause.
    pub fn instrument() -> Self {
        Self { rival: Some(Rival::Instrument), ..Self::default() }
    }

    /// With names that are neither right nor false.
    pub fn allowing(self, names: &[&'static str]) -> Self {
        Self { allowed: names.to_vec(), ..self }
    }

    /// With names that are false whatever is said beside them.
    pub fn never(self, names: &[&'static str]) -> Self {
        Self { never: names.to_vec(), ..self }
    }

    /// With a verdict that is enough: the base is refuted.
    pub fn or_refuted(self) -> Self {
        Self { refuted_is_honest: true, ..self }
    }

    /// Whether no effect acts, whatever the instrument does.
    pub fn is_null(&self) -> bool {
        self.planted.is_empty() && self.rival != Some(Rival::Slip)
    }

    /// Whether a finding, a number of the base or an undecided cause is one of the planted causes.
    pub fn is_planted(&self, name: &str, variables: &[&str]) -> bool {
        self.planted.iter().any(|cause| is_one_of(cause, name, variables)) || self.is_surface(&columns(name))
    }

    /// Whether each of several columns has a planted cause.
    fn is_surface(&self, columns: &[&str]) -> bool {
        let planted = |column: &&str| self.planted.iter().any(|cause| is_over(cause, column));
        columns.len() > 1 && columns.iter().all(planted)
    }

    /// Whether a cause is meant by a name: by one of its own, or by a surface over columns that all act.
    pub fn means(&self, name: &str, variables: &[&str], cause: &[&str]) -> bool {
        let columns = columns(name);
        let surface = self.is_surface(&columns) && columns.iter().any(|column| is_over(cause, column));
        surface || is_one_of(cause, name, variables) || is_one_of(cause, name, &columns)
    }

    /// Whether it may be said. How the scatter changes is no cause of anything.
    pub fn is_allowed(&self, name: &str) -> bool {
        name.starts_with("scatter:") || is_one_of(&self.allowed, name, &[])
    }

    /// Whether a law of the diagnosis is at an end of its range.
    pub fn is_at_bound(&self, diagnosis: &Value) -> bool {
        let findings = diagnosis["findings"].as_array().into_iter().flatten();
        self.bound.is_some_and(|bound| findings.into_iter().any(|finding| bound.is_met(finding)))
    }

    /// What is right to say of a diagnosis with a law at an end of its range: not this law.
    pub fn without_bound(mut self) -> Self {
        for cause in &mut self.planted {
            cause.retain(|name| self.bound.is_none_or(|bound| bound.cause != *name));
        }
        self
    }

    /// Whether a set of causes is the truth: all that is planted, and nothing else but what is allowed.
    pub fn is_truth(&self, causes: &[&str]) -> bool {
        let others =
            |right: &dyn Fn(&str) -> bool| causes.iter().all(|one| right(one) || self.is_allowed(one));
        match self.rival {
            Some(rival) => causes.iter().any(|one| rival.is(one)) && others(&|one| rival.is(one)),
            None => {
                self.planted.iter().all(|cause| causes.iter().any(|one| self.means(one, &[], cause)))
                    && others(&|one| self.planted.iter().any(|cause| self.means(one, &[], cause)))
            }
        }
    }

    /// The truth in words: the first name of each cause.
    pub fn words(&self) -> String {
        match self.rival {
            Some(rival) => format!("{rival:?}").to_lowercase(),
            None if self.planted.is_empty() => "none".into(),
            None => self.planted.iter().map(|names| names[0]).collect::<Vec<_>>().join("+"),
        }
    }
}

/// Whether a name, with the columns that it depends on, is one of these. A number of the base has the name
/// of its key, or this after `calibration:`.
pub fn is_one_of(names: &[&str], name: &str, variables: &[&str]) -> bool {
    names.iter().any(|one| match one.split_once('*') {
        Some((begin, "")) => name.starts_with(begin) || key(begin).is_some_and(|key| name.starts_with(key)),
        Some((a, b)) => {
            name.starts_with("unknown:") && [a, b].iter().all(|column| variables.contains(column))
        }
        None => *one == name || key(one) == Some(name),
    })
}

/// The effect, and curves over its inputs.
pub fn names_of(effect: &'static str) -> Vec<&'static str> {
    let curves: &[&str] = match effect {
        "powder-layer" => &["unknown:layer_thickness"],
        "thermal-softening" | "melting-transition" => &["unknown:T_p"],
        "size-dependent-yield" => &["unknown:d"],
        "oblique-angle" => &["unknown:v_t", "v_n*v_t"],
        "strain-rate-hardening" => &["unknown:v_n"],
        "liquid-film" => &["unknown:film_thickness"],
        "gas-lift" => &["unknown:v_gas", "v_gas*v_t"],
        _ => &[],
    };
    std::iter::once(effect).chain(curves.iter().copied()).collect()
}

/// Whether a cause may be a curve over a column.
fn is_over(cause: &[&str], column: &str) -> bool {
    cause.iter().any(|name| name.strip_prefix("unknown:") == Some(column))
}

/// Whether a name is a curve, or the pattern of a surface.
pub fn is_curve(name: &str) -> bool {
    name.starts_with("unknown:") || name.split_once('*').is_some_and(|(_, other)| !other.is_empty())
}

fn key(name: &str) -> Option<&str> {
    name.strip_prefix("calibration:")
}

/// The columns of a finding: those of its list and of its name.
pub fn variables(finding: &Value) -> Vec<&str> {
    let listed = finding["variables"].as_array().into_iter().flatten().filter_map(Value::as_str);
    listed.chain(finding["cause"].as_str().into_iter().flat_map(columns)).collect()
}

/// The columns in a name.
fn columns(name: &str) -> Vec<&str> {
    name.strip_prefix("unknown:").into_iter().flat_map(|names| names.split('*')).collect()
}
