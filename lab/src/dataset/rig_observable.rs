//! What a rig measures: the columns `NAME@WALL` of rig-level data.
//!
//! | `NAME` | meaning | counts |
//! |---|---|---|
//! | `captured` | mass that the wall caught / mass injected [1] | |
//! | `captured_from_Z1_to_Z2` | the same between two coordinates of the wall [m]: z of a pipe, distance from the middle of a disc | |
//! | `captured_d_D1_to_D2` | the same of particles whose diameter at capture lies between two values [m] | |
//! | `capture_efficiency` | particles caught / particles that hit the wall at least once [1] | particles that hit |
//! | `mean_e_n`, `mean_e_t` | mean over the rebounds from the wall [1] | rebounds |
//! | `share_e_n_below_X`, `share_e_t_below_X` | share of the rebounds below a threshold [1] | rebounds |
//! | `quantile_Q_e_n`, `quantile_Q_e_t` | quantile of the rebounds, `Q` from 0 to 1 [1] | rebounds |
//! | `mean_conversion` | mean carbon conversion of what was caught, by mass at capture [1] | particles caught |

/// A restitution of a rebound.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Restitution {
    /// `e_n`.
    Normal,
    /// `e_t`.
    Tangential,
}

/// A quantity that a wall of a rig shows; module table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RigQuantity {
    /// Mass caught over mass injected.
    Captured,
    /// The same between two coordinates along the wall [m].
    CapturedAlong([f64; 2]),
    /// The same between two diameters [m].
    CapturedBySize([f64; 2]),
    /// Particles caught over particles that arrived.
    CaptureEfficiency,
    /// Mean over the rebounds.
    Mean(Restitution),
    /// Share of the rebounds below a threshold [1].
    ShareBelow(Restitution, f64),
    /// Quantile of the rebounds, with its probability [1].
    Quantile(Restitution, f64),
    /// Mean carbon conversion of what was caught.
    MeanConversion,
}

/// The names for a message.
pub(super) const OBSERVABLE_NAMES: &str = "captured, capture_efficiency, mean_e_n, mean_e_t, share_e_n_below_0.6, \
    quantile_0.5_e_n, mean_conversion, captured_from_Z1_to_Z2 and captured_d_D1_to_D2";

impl RigQuantity {
    /// Reads a name without its wall; `None` for another name.
    pub fn parse(name: &str) -> Option<Self> {
        let restitution = |name: &str| match name {
            "e_n" => Some(Restitution::Normal),
            "e_t" => Some(Restitution::Tangential),
            _ => None,
        };
        let range = |text: &str| {
            let (low, high) = text.split_once("_to_")?;
            let [low, high] = [low.parse::<f64>().ok()?, high.parse::<f64>().ok()?];
            (low < high).then_some([low, high])
        };
        match name {
            "captured" => return Some(Self::Captured),
            "capture_efficiency" => return Some(Self::CaptureEfficiency),
            "mean_conversion" => return Some(Self::MeanConversion),
            _ => {}
        }
        if let Some(rest) = name.strip_prefix("captured_from_") {
            return range(rest).map(Self::CapturedAlong);
        }
        if let Some(rest) = name.strip_prefix("captured_d_") {
            return range(rest).map(Self::CapturedBySize);
        }
        if let Some(rest) = name.strip_prefix("mean_") {
            return restitution(rest).map(Self::Mean);
        }
        if let Some((which, threshold)) = name.strip_prefix("share_").and_then(|s| s.split_once("_below_")) {
            let threshold = threshold.parse::<f64>().ok().filter(|t| t.is_finite())?;
            return restitution(which).map(|which| Self::ShareBelow(which, threshold));
        }
        let (probability, which) = name.strip_prefix("quantile_")?.split_once('_')?;
        let probability = probability.parse::<f64>().ok().filter(|q| *q > 0.0 && *q < 1.0)?;
        restitution(which).map(|which| Self::Quantile(which, probability))
    }

    /// What a finding and a gain call it: readings of one kind share a scatter where the file states no errors.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Captured | Self::CapturedAlong(_) | Self::CapturedBySize(_) => "captured",
            Self::CaptureEfficiency => "capture_efficiency",
            Self::Mean(Restitution::Normal) => "mean_e_n",
            Self::Mean(Restitution::Tangential) => "mean_e_t",
            Self::ShareBelow(Restitution::Normal, _) => "share_e_n_below",
            Self::ShareBelow(Restitution::Tangential, _) => "share_e_t_below",
            Self::Quantile(Restitution::Normal, _) => "quantile_e_n",
            Self::Quantile(Restitution::Tangential, _) => "quantile_e_t",
            Self::MeanConversion => "mean_conversion",
        }
    }

    /// Whether it is a share of counted particles, which is binomial where the count is given.
    pub fn is_share(&self) -> bool {
        !matches!(self, Self::Mean(_) | Self::Quantile(..) | Self::MeanConversion)
    }

    /// The largest value that it can have [1]; restitution along the wall may exceed 1.
    pub(super) fn largest(&self) -> f64 {
        match self {
            Self::Mean(_) | Self::Quantile(..) => 2.0,
            _ => 1.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read() {
        let parse = RigQuantity::parse;
        assert_eq!(parse("captured"), Some(RigQuantity::Captured));
        assert_eq!(parse("share_e_n_below_0.6"), Some(RigQuantity::ShareBelow(Restitution::Normal, 0.6)));
        assert_eq!(parse("captured_d_1e-5_to_2e-5"), Some(RigQuantity::CapturedBySize([1e-5, 2e-5])));
        assert_eq!(parse("captured_from_-0.1_to_0.2"), Some(RigQuantity::CapturedAlong([-0.1, 0.2])));
        assert_eq!(parse("quantile_0.9_e_t"), Some(RigQuantity::Quantile(Restitution::Tangential, 0.9)));
        assert_eq!(parse("mean_e_t"), Some(RigQuantity::Mean(Restitution::Tangential)));
        for wrong in ["captured_from_2_to_1", "mean_e", "quantile_2_e_n", "share_e_n_below_x", "capture"] {
            assert_eq!(parse(wrong), None, "{wrong}");
        }
    }
}
