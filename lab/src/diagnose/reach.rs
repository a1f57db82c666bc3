//! The ranges that a laboratory states for the next measurement: `NAME=LOW:HIGH`.

use std::str::FromStr;

/// What can be varied, and how far.
#[derive(Debug, Clone, PartialEq)]
pub struct Reach {
    /// An input, or a dotted key of a case.
    pub name: String,
    /// Least and largest value [SI units].
    pub range: [f64; 2],
}

/// A text that states no range.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("`{0}` is no range: write NAME=LOW:HIGH with LOW < HIGH, as T_p=290:400")]
pub struct ReachError(String);

impl FromStr for Reach {
    type Err = ReachError;

    fn from_str(text: &str) -> Result<Self, ReachError> {
        let read = || {
            let (name, ends) = text.split_once('=')?;
            let (low, high) = ends.split_once(':')?;
            let range = [low.trim().parse::<f64>().ok()?, high.trim().parse::<f64>().ok()?];
            let usable =
                !name.trim().is_empty() && range[0] < range[1] && range.iter().all(|end| end.is_finite());
            usable.then(|| Self { name: name.trim().to_owned(), range })
        };
        read().ok_or_else(|| ReachError(text.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_are_read_or_refused() {
        let read = "particles.speed = 0.5:2e1".parse::<Reach>();
        assert_eq!(read, Ok(Reach { name: "particles.speed".into(), range: [0.5, 20.0] }));
        for wrong in ["v_n", "v_n=3", "v_n=5:2", "=1:2", "v_n=1:inf", "v_n=a:b"] {
            assert_eq!(wrong.parse::<Reach>(), Err(ReachError(wrong.to_owned())));
        }
    }
}
