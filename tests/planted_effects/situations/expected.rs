//! What is right to say of a set.

use serde_json::Value;

/// What is planted, and what else may be said.
#[derive(Clone, Debug, Default)]
pub struct Expected {
    /// The planted causes, each with its right names; `level*` stands for every name that begins with `level`,
    /// `a*b` for a term over both columns.
    pub planted: Vec<Vec<&'static str>>,
    /// Names that are neither right nor false.
    pub allowed: Vec<&'static str>,
    /// Whether the user's slip is what is planted.
    pub slip: bool,
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

    /// A slip of the user.
    pub fn slip() -> Self {
        Self { slip: true, ..Self::default() }
    }

    /// With names that are neither right nor false.
    pub fn allowing(self, names: &[&'static str]) -> Self {
        Self { allowed: names.to_vec(), ..self }
    }

    /// With a verdict that is enough: the base is refuted.
    pub fn or_refuted(self) -> Self {
        Self { refuted_is_honest: true, ..self }
    }

    /// Whether a finding, a number of the base or an undecided cause is one of the planted causes.
    pub fn is_planted(&self, name: &str, variables: &[&str]) -> bool {
        self.planted.iter().any(|cause| is_one_of(cause, name, variables))
    }

    /// Whether it may be said.
    pub fn is_allowed(&self, name: &str) -> bool {
        is_one_of(&self.allowed, name, &[])
    }
}

/// Whether a name, with the columns that it depends on, is one of these.
pub fn is_one_of(names: &[&str], name: &str, variables: &[&str]) -> bool {
    names.iter().any(|one| match one.split_once('*') {
        Some((begin, "")) => name.starts_with(begin),
        Some((a, b)) => {
            name.starts_with("unknown:") && [a, b].iter().all(|column| variables.contains(column))
        }
        None => *one == name,
    })
}

/// The columns of a finding: those of its list and of its name.
pub fn variables(finding: &Value) -> Vec<&str> {
    let listed = finding["variables"].as_array().into_iter().flatten().filter_map(Value::as_str);
    let named = finding["cause"].as_str().and_then(|name| name.strip_prefix("unknown:"));
    listed.chain(named.into_iter().flat_map(|names| names.split('*'))).collect()
}
