//! The kinds of candidates: what can be added to a hypothesis.
//!
//! A new kind is a variant of [`Candidate`] and of [`Addition`]; the compiler then names the places
//! that treat it: its shapes in `shapes`, the list of candidates and the fits in `fitting`, its prior
//! in [`Class`], its finding in `finding`.

use super::constant_capture::{CaptureConstant, ConstantCapture};
use super::curve::{ColumnCurve, ColumnCurveForm};
use super::data_split::DataSplit;
use super::evaluation::Evaluation;
use super::hypothesis::{Hypothesis, ScatterTrend};
use super::observable::Observable;
use super::part::{FittedPart, Part};
use nearwall::effect::FORMS;

/// Largest correction for skewness, as a share of the mean.
const LARGEST_SKEW: f64 = 0.3;

/// Classes of additions: the candidates of a class share its prior probability.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Class {
    /// Another value of a number of the base's laws.
    Number,
    /// An effect of the library.
    Law,
    /// A constant shift.
    Level,
    /// A curve over a column that no law knows.
    Curve,
    /// A curve over a dimensionless group.
    Group,
    /// A curve over an input of laws, without a law.
    Input,
    /// A surface over two columns.
    Surface,
    /// A mistake in the numbers, an instrument or a geometry.
    Rival,
    /// A wrong number of the case of a rig.
    Case,
    /// Scatter, groups, captures at a constant rate or with a ceiling.
    Noise,
}

/// Prior odds of each addition after the first, over those of the one before [1].
pub(super) const FURTHER: f64 = 0.3;
/// Prior probability that a column which acts on one observable acts on another one, over that it does not [1].
pub(super) const SAME_CAUSE: f64 = 0.5;

impl Class {
    /// Of a curve over these columns.
    fn of_columns(columns: impl Iterator<Item = usize>, data: &DataSplit) -> Self {
        match columns.collect::<Vec<_>>()[..] {
            [] => Self::Level,
            [column] if data.covariates[column].is_group() => Self::Group,
            [column] if data.covariates[column].is_input() => Self::Input,
            [_] => Self::Curve,
            _ => Self::Surface,
        }
    }

    /// Logarithm of the prior probability of one addition of so many of this class, over that of none [nats].
    pub fn log_prior(self, candidates: usize) -> f64 {
        (self.prior() / candidates.max(1) as f64).ln()
    }

    /// Prior probability that data need an addition of this class, over that they do not [1].
    fn prior(self) -> f64 {
        match self {
            Self::Law => 1.0,
            Self::Noise | Self::Case => 0.5,
            Self::Number => 0.3,
            Self::Curve | Self::Rival => 0.2,
            Self::Level | Self::Group | Self::Input | Self::Surface => 0.06,
        }
    }
}

/// A kind of addition before its fit; covariates by index.
#[derive(Debug, Clone, Copy)]
pub(super) enum Candidate {
    Part(Part),
    /// A curve over one column, a surface over two, or a level shift without any.
    Curve {
        sides: [Option<usize>; 2],
        observable: Observable,
    },
    ScatterTrend {
        covariate: usize,
    },
    Captures(CaptureConstant),
}

impl Candidate {
    /// What is tried, for a reader who waits.
    pub fn title(&self, data: &DataSplit) -> String {
        let column = |column: &usize| data.covariates[*column].name.clone();
        match self {
            Self::Part(part) => part.name(),
            Self::Curve { sides, observable } => {
                let columns: Vec<String> = sides.iter().flatten().map(column).collect();
                format!("{} over {}", observable.name(), columns.join(" and "))
            }
            Self::ScatterTrend { covariate } => format!("scatter over {}", column(covariate)),
            Self::Captures(CaptureConstant::Rate) => "captures at a constant rate".to_owned(),
            Self::Captures(CaptureConstant::Ceiling) => "a ceiling of captures".to_owned(),
        }
    }

    pub fn class(&self, data: &DataSplit) -> Class {
        match self {
            Self::Part(Part::Effect(_)) => Class::Law,
            Self::Part(Part::LawParameter(_)) => Class::Number,
            Self::Curve { sides, .. } => Class::of_columns(sides.iter().flatten().copied(), data),
            Self::ScatterTrend { .. } | Self::Captures(_) => Class::Noise,
        }
    }

    /// Whether it is a surface of the same observable over the column of a curve and another one.
    pub fn is_surface_over(&self, curve: &ColumnCurveForm) -> bool {
        match (self, curve.sides.as_slice()) {
            (Self::Curve { sides: [Some(one), Some(two)], observable }, [(column, _)]) => {
                *observable == curve.observable && [one, two].contains(&column)
            }
            _ => false,
        }
    }
}

/// A fitted addition.
#[derive(Debug, Clone)]
pub(super) enum Addition {
    /// A part, and the earlier parts as they fit best beside it.
    Part { part: FittedPart, others: Vec<FittedPart> },
    /// A curve over a column: a dependence that no effect explains.
    Curve(ColumnCurve),
    /// Heteroscedastic noise.
    ScatterTrend(ScatterTrend),
    /// A constant of captures that no column explains, with the other one and the parts as they fit best beside it.
    Captures { constant: CaptureConstant, all: ConstantCapture, others: Vec<FittedPart> },
}

impl Addition {
    /// The id of the cause.
    pub fn name(&self, data: &DataSplit) -> String {
        let column = |covariate: usize| &data.covariates[covariate].name;
        match self {
            Self::Part { part, .. } => part.part.name(),
            Self::Curve(curve) => curve.form.name(data),
            Self::ScatterTrend(trend) => format!("scatter:{}", column(trend.covariate)),
            Self::Captures { constant, .. } => constant.name().to_owned(),
        }
    }

    /// The id of the cause, and of a curve the laws that describe the same dependence; none for what is noise. With
    /// `law_or_curve` of a law the curve, too.
    pub fn names(&self, data: &DataSplit, law_or_curve: bool) -> Vec<String> {
        let same = match self {
            Self::Curve(curve) => curve.form.laws(data),
            Self::Part { part: FittedPart { part: Part::Effect(effect), .. }, .. } if law_or_curve => {
                vec![format!("unknown:{}", effect.inputs.join("*"))]
            }
            _ => Vec::new(),
        };
        let own = self.is_systematic().then(|| self.name(data));
        own.into_iter().chain(same).collect()
    }

    /// The columns that it depends on.
    pub fn variables(&self, data: &DataSplit) -> Vec<String> {
        match self {
            Self::Part { part, .. } => part.part.inputs().iter().map(|&input| input.to_owned()).collect(),
            Self::Curve(curve) => curve.form.columns(data),
            Self::ScatterTrend(_) | Self::Captures { .. } => Vec::new(),
        }
    }

    /// Whether it is another value of a parameter of the base model rather than a cause.
    pub fn is_calibration(&self) -> bool {
        matches!(self, Self::Part { part: FittedPart { part: Part::LawParameter(_), .. }, .. })
    }

    /// Whether it is a cause or a calibration rather than noise.
    pub fn is_systematic(&self) -> bool {
        matches!(self, Self::Part { .. } | Self::Curve(_))
    }

    /// Tells it from all other additions.
    pub fn key(&self, data: &DataSplit) -> String {
        match self {
            Self::Curve(curve) => curve.form.key(data),
            _ => self.name(data),
        }
    }

    pub fn class(&self, data: &DataSplit) -> Class {
        match self {
            Self::Part { part, .. } => Candidate::Part(part.part).class(data),
            Self::Curve(curve) => Class::of_columns(curve.form.sides.iter().map(|side| side.0), data),
            Self::ScatterTrend(_) | Self::Captures { .. } => Class::Noise,
        }
    }

    /// Logarithm of the prior probability of its shape: closed forms share that of the free curve [nats].
    pub fn shape_prior(&self) -> f64 {
        match self {
            Self::Curve(ColumnCurve { closed: Some(_), .. }) => -(FORMS.len() as f64).ln(),
            _ => 0.0,
        }
    }

    /// The number of its fitted parameters, which its gain pays for.
    pub fn freedom(&self) -> f64 {
        match self {
            Self::Part { part, .. } => part.at.len() as f64,
            Self::Curve(curve) => curve.freedom,
            Self::ScatterTrend(_) | Self::Captures { .. } => 1.0,
        }
    }

    /// Whether a parameter is at the bound of its range: no law then, whatever it gains.
    pub fn at_bound(&self) -> bool {
        match self {
            Self::Part { part, .. } => part.at_bound(),
            Self::Captures { all, .. } => all.at_bound(),
            Self::Curve(_) | Self::ScatterTrend(_) => false,
        }
    }

    /// Adds it to a hypothesis.
    pub fn add_to(&self, hypothesis: &mut Hypothesis<'_>) {
        match self {
            Self::Part { part, others } => {
                hypothesis.parts = others.iter().chain([part]).cloned().collect();
            }
            Self::Curve(curve) => hypothesis.curves.push(curve.clone()),
            Self::ScatterTrend(trend) => hypothesis.scatter_trends.push(*trend),
            Self::Captures { all, others, .. } => {
                hypothesis.captures = *all;
                hypothesis.parts.clone_from(others);
            }
        }
    }

    /// The rows of `evaluation`, which are predicted by `hypothesis`, with this addition.
    pub fn evaluate<'b>(&self, hypothesis: &Hypothesis<'b>, evaluation: &Evaluation<'b>) -> Evaluation<'b> {
        let mut offsets = evaluation.offsets.to_vec();
        match self {
            Self::Part { .. } | Self::Captures { .. } => {
                let mut joint = hypothesis.clone();
                self.add_to(&mut joint);
                return joint.evaluate(evaluation.rows.clone(), offsets).with_scatter(evaluation.scatter);
            }
            Self::Curve(curve) => curve.add_to(&mut offsets, evaluation),
            Self::ScatterTrend(trend) => trend.add_to(&mut offsets, evaluation.data),
        }
        evaluation.with_offsets(offsets)
    }
}

/// An addition with its gain.
#[derive(Debug, Clone)]
pub(super) struct ScoredCandidate {
    pub addition: Addition,
    /// Gain in log score of each row of [`DataSplit::search`], less its share of the number of parameters [nats].
    pub differences: Vec<f64>,
    /// Gain beyond that of a level shift, for a curve; otherwise the whole gain [nats].
    pub own_gain: f64,
    /// Corrected for the candidate's own shapes.
    pub p_value: f64,
    /// Corrected for the number of candidates.
    pub q_value: f64,
    /// Logarithm of its prior probability over that of no addition [nats].
    pub log_prior: f64,
}

impl ScoredCandidate {
    /// An addition that is fitted and tested later, beside another one.
    pub fn unproven(addition: Addition, differences: Vec<f64>, log_prior: f64) -> Self {
        let own_gain = differences.iter().sum();
        Self { addition, differences, own_gain, p_value: 1.0, q_value: 1.0, log_prior }
    }

    /// Its gain [nats] and its candidate, if it is a law that draws nothing at random.
    pub fn plain_law(&self) -> Option<(f64, Candidate)> {
        match &self.addition {
            Addition::Part { part, .. } if !part.part.is_stochastic() => {
                Some((self.gain(), Candidate::Part(part.part)))
            }
            _ => None,
        }
    }

    /// Gain in log score of all rows [nats].
    pub fn gain(&self) -> f64 {
        self.differences.iter().sum()
    }
}

/// Mean over its standard error, corrected for skewness (Johnson 1978): a rare kind of impact gains much in few rows.
pub(super) fn t_statistic(differences: &[f64]) -> f64 {
    let count = differences.len() as f64;
    let mean = differences.iter().sum::<f64>() / count;
    let moment = |power: i32| differences.iter().map(|d| (d - mean).powi(power)).sum::<f64>() / count;
    let (variance, third) = (moment(2), moment(3));
    if variance <= 0.0 {
        return 0.0;
    }
    let skew = third / (6.0 * variance * count) + third * mean * mean / (3.0 * variance * variance);
    // The correction is the first term of a series: where it is large, the mean is significant without it.
    let skew = skew.clamp(-LARGEST_SKEW * mean.abs(), LARGEST_SKEW * mean.abs());
    (mean + skew) / (variance / (count - 1.0).max(1.0)).sqrt()
}
