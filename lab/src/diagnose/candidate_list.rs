//! The list of candidates of a round: everything that the data could tell apart from what the hypothesis already has.

use super::candidate::Candidate;
use super::constant_capture::CaptureConstant;
use super::data_split::DataSplit;
use super::hypothesis::Hypothesis;
use super::observable::Observable;
use super::part::{LawParameter, Part};
use crate::dataset::ColumnValues;

/// Least number of measurements for a curve.
const LEAST_CURVE_ROWS: usize = 4;

/// The columns of a curve, by index: none for a level, one, or two for a surface.
type Sides = [Option<usize>; 2];

/// All candidates; with `few` readings no surfaces and no changes of the scatter.
pub(super) fn candidates(hypothesis: &Hypothesis<'_>, few: bool) -> Vec<Candidate> {
    let mut all = parts(hypothesis);
    for observable in Observable::ALL.into_iter().filter(|observable| varies(hypothesis, *observable)) {
        let sides = sides(hypothesis, observable, few);
        let open = sides.into_iter().filter(|sides| !has_curve(hypothesis, *sides, observable));
        all.extend(open.map(|sides| Candidate::Curve { sides, observable }));
    }
    if !few {
        all.extend(scatter_trends(hypothesis));
    }
    if varies(hypothesis, Observable::Capture) {
        let open = CaptureConstant::ALL.into_iter().filter(|one| !hypothesis.captures.has(*one));
        all.extend(open.map(Candidate::Captures));
    }
    all
}

/// The effects and the parameters of the base's laws that the hypothesis does not have yet.
fn parts(hypothesis: &Hypothesis<'_>) -> Vec<Candidate> {
    let taken = |name: String| hypothesis.parts.iter().any(|part| part.part.name() == name);
    let all = Part::all(&hypothesis.data.base).into_iter();
    all.filter(|part| !taken(part.name())).map(Candidate::Part).collect()
}

/// Whether there are enough different measurements of an observable for a curve.
fn varies(hypothesis: &Hypothesis<'_>, observable: Observable) -> bool {
    let data = hypothesis.data;
    let measured = |&row: &usize| observable.measured(&data.rows[row]);
    let values: Vec<f64> = data.search.iter().filter_map(measured).collect();
    values.len() >= LEAST_CURVE_ROWS && values.iter().any(|value| *value != values[0])
}

/// The columns of the curves of an observable: a level, every column, and unless readings are `few`
/// those on which the hypothesis depends with another one.
fn sides(hypothesis: &Hypothesis<'_>, observable: Observable, few: bool) -> Vec<Sides> {
    let data = hypothesis.data;
    let level = (!has_level(hypothesis, observable)).then_some([None; 2]);
    let single = (0..data.covariates.len()).map(|column| [Some(column), None]);
    let mut all: Vec<Sides> = level.into_iter().chain(single).collect();
    if !few {
        all.extend(
            hypothesis.columns_of(observable).into_iter().flat_map(|one| pairs(data, one, observable)),
        );
    }
    all.dedup();
    all
}

/// The pairs of a column with each other one; both hold numbers.
fn pairs(data: &DataSplit, one: usize, observable: Observable) -> Vec<Sides> {
    // How e_t depends on the speeds is a matter of the tangential law.
    let speed = |column: usize| ["v_n", "v_t"].contains(&data.covariates[column].name.as_str());
    let free = |column: &usize| {
        let covariate = &data.covariates[*column];
        let numeric = matches!(covariate.values, ColumnValues::Numbers(_)) && !covariate.is_group();
        numeric && (observable != Observable::TangentialRestitution || !speed(*column))
    };
    if !free(&one) {
        return Vec::new();
    }
    let others = (0..data.covariates.len()).filter(|other| *other != one && free(other));
    others.map(|other| [Some(one.min(other)), Some(one.max(other))]).collect()
}

/// Whether another candidate is the level of an observable: a law's own constant, or the rate of captures.
fn has_level(hypothesis: &Hypothesis<'_>, observable: Observable) -> bool {
    let base = &hypothesis.data.base;
    match observable {
        Observable::NormalRestitution => LawParameter::NormalRestitution.of(base).is_some(),
        Observable::TangentialRestitution => LawParameter::TangentialRestitution.of(base).is_some(),
        Observable::Capture => true,
    }
}

/// Whether a curve of the hypothesis contains one over these columns.
fn has_curve(hypothesis: &Hypothesis<'_>, sides: Sides, observable: Observable) -> bool {
    hypothesis.curves.iter().any(|curve| {
        let own: Vec<usize> = curve.form.sides.iter().map(|side| side.0).collect();
        curve.form.observable == observable
            && (!own.is_empty() || sides == [None; 2])
            && sides.iter().flatten().all(|side| own.contains(side))
    })
}

/// The columns of numbers with which the scatter may change.
fn scatter_trends(hypothesis: &Hypothesis<'_>) -> impl Iterator<Item = Candidate> {
    let known = |covariate: usize| hypothesis.scatter_trends.iter().any(|trend| trend.covariate == covariate);
    let columns = hypothesis.data.covariates.iter().enumerate();
    let open = columns.filter(move |(covariate, column)| {
        matches!(column.values, ColumnValues::Numbers(_)) && !column.is_group() && !known(*covariate)
    });
    open.map(|(covariate, _)| Candidate::ScatterTrend { covariate })
}
