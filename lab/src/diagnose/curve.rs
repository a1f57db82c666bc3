//! A smooth curve over one column or a surface over two, for a dependence that no effect explains;
//! without a column, a level shift.

use nalgebra::DMatrix;

use super::closed_form::ClosedForm;
use super::data_split::DataSplit;
use super::evaluation::Evaluation;
use super::likelihood::Offset;
use super::observable::Observable;
use super::smooth::{Basis, Entry, Smoothed, WeightedResidual, evident, product, ridge, sum};
use nearwall::effect::{EFFECTS, EffectInfo};

/// The cause of readings that all lie as far from the model.
pub(super) const LEVEL_SHIFT: &str = "level-shift";
/// Rounds of the iteratively reweighted fit of capture.
const ROUNDS: usize = 5;
/// Largest constant offset of capture [log odds].
const WIDEST_ODDS: f64 = 10.0;

/// What a curve is: its columns, its observable, and how it acts.
#[derive(Debug, Clone)]
pub(super) struct ColumnCurveForm {
    /// Index among the covariates and basis of each side: none for a level shift, one for a curve, two for a surface.
    pub sides: Vec<(usize, Basis)>,
    pub observable: Observable,
    /// Whether it is multiplied with the prediction rather than added.
    pub multiplicative: bool,
}

impl ColumnCurveForm {
    /// A constant.
    pub fn level(observable: Observable, multiplicative: bool) -> Self {
        Self { sides: Vec::new(), observable, multiplicative }
    }

    /// The basis functions at a row.
    pub fn entry(&self, data: &DataSplit, row: usize) -> Entry {
        match self.sides.as_slice() {
            [] => vec![(0, 1.0)],
            [(column, basis)] => side(data, *column, basis, row),
            [(one, first), (two, second), ..] => {
                product(&side(data, *one, first, row), &side(data, *two, second, row), second.len())
            }
        }
    }

    /// The penalty on the heights: bends along each side.
    fn penalty(&self) -> DMatrix<f64> {
        match self.sides.as_slice() {
            [] => DMatrix::identity(1, 1) * 1e-6,
            [(_, basis)] => basis.penalty(),
            [(_, one), (_, two), ..] => {
                let [a, b] = [one, two].map(|basis| DMatrix::<f64>::identity(basis.len(), basis.len()));
                one.penalty().kronecker(&b) + a.kronecker(&two.penalty())
            }
        }
    }

    /// The id of the cause.
    pub fn name(&self, data: &DataSplit) -> String {
        if self.sides.is_empty() {
            return LEVEL_SHIFT.to_owned();
        }
        format!("unknown:{}", self.columns(data).join("*"))
    }

    /// Tells it from all other curves: a column may act on several observables.
    pub fn key(&self, data: &DataSplit) -> String {
        format!("{} on {}", self.name(data), self.observable.name())
    }

    /// The names of its columns.
    pub fn columns(&self, data: &DataSplit) -> Vec<String> {
        self.sides.iter().map(|(column, _)| data.covariates[*column].name.clone()).collect()
    }

    /// Ids of the effects that depend on its columns alone: their laws are forms over them.
    pub fn laws(&self, data: &DataSplit) -> Vec<String> {
        let columns = self.columns(data);
        let is_over = |effect: &&EffectInfo| !columns.is_empty() && effect.inputs.iter().eq(columns.iter());
        EFFECTS.into_iter().filter(is_over).map(|effect| effect.id.to_owned()).collect()
    }

    fn smooth(&self, evaluation: &Evaluation<'_>, points: &[WeightedResidual]) -> Option<Smoothed> {
        let entry = |row: usize| self.entry(evaluation.data, row);
        let [(_, Basis::Hats(first)), (_, Basis::Hats(second))] = self.sides.as_slice() else {
            return ridge(&self.penalty(), points, entry);
        };
        let free = evident(&self.penalty(), points, entry)?;
        let products: Vec<f64> = first.iter().flat_map(|x| second.iter().map(move |y| x * y)).collect();
        let plain = as_product(&products, points, entry).filter(|plain| plain.criterion < free.criterion);
        Some(plain.unwrap_or(free))
    }

    /// The curve that fits the residuals best, `None` where there are too few.
    ///
    /// The curve of capture is in log odds and fitted by iteratively reweighted least squares, from a constant on.
    pub fn fit(self, evaluation: &Evaluation<'_>) -> Option<ColumnCurve> {
        if self.observable != Observable::Capture {
            let points = evaluation.residuals(self.observable, self.multiplicative);
            let Smoothed { heights, freedom, .. } = self.smooth(evaluation, &points)?;
            return Some(ColumnCurve { form: self, heights, freedom, closed: None });
        }
        let constant = constant_odds(evaluation)?;
        if self.sides.is_empty() {
            return Some(ColumnCurve::constant(self, constant));
        }
        let mut fitted: Option<Smoothed> = None;
        // Where captures are apart from rebounds the rounds overshoot: the best one counts.
        let mut best: (f64, Option<Smoothed>) = (f64::NEG_INFINITY, None);
        let height = |fitted: &Option<Smoothed>, row: usize| {
            let height =
                fitted.as_ref().map_or(constant, |fit| sum(&self.entry(evaluation.data, row), &fit.heights));
            height.clamp(-WIDEST_ODDS, WIDEST_ODDS)
        };
        for round in 0..=ROUNDS {
            let mut offsets = evaluation.offsets.to_vec();
            for &row in evaluation.rows.iter() {
                offsets[row].capture += height(&fitted, row);
            }
            let moved = evaluation.with_offsets(offsets);
            let score = moved.score();
            if round > 0 && score > best.0 {
                best = (score, fitted.clone());
            }
            if round == ROUNDS {
                break;
            }
            let mut points = moved.residuals(self.observable, false);
            points.iter_mut().for_each(|point| point.residual += height(&fitted, point.row));
            fitted = Some(self.smooth(evaluation, &points)?);
        }
        let Smoothed { heights, freedom, .. } = best.1?;
        Some(ColumnCurve { form: self, heights, freedom, closed: None })
    }
}

/// The surface `a + b x y`, the simplest one of two columns, from the products at its knots.
fn as_product(
    products: &[f64],
    points: &[WeightedResidual],
    entry: impl Fn(usize) -> Entry,
) -> Option<Smoothed> {
    let largest = products.iter().fold(f64::MIN_POSITIVE, |most, product| most.max(product.abs()));
    let scaled: Vec<f64> = products.iter().map(|product| product / largest).collect();
    let pair = |row: usize| {
        let entry = entry(row);
        let constant = entry.iter().map(|(_, share)| share).sum();
        vec![(0, constant), (1, sum(&entry, &scaled))]
    };
    let fit = evident(&DMatrix::zeros(2, 2), points, pair)?;
    let heights = scaled.iter().map(|product| fit.heights[0] + fit.heights[1] * product).collect();
    Some(Smoothed { heights, ..fit })
}

/// The basis functions of a column at a row; where the row lacks an input, their mean over what the file shows of it.
fn side(data: &DataSplit, column: usize, basis: &Basis, row: usize) -> Entry {
    match data.shown_instead(column, row) {
        [] => basis.entry(data.values(column), row),
        shown => basis.mean_entry(shown),
    }
}

/// A fitted curve or surface.
#[derive(Debug, Clone)]
pub(super) struct ColumnCurve {
    pub form: ColumnCurveForm,
    /// Heights of the basis functions; of a surface those of the first side, for each the second side.
    pub heights: Vec<f64>,
    /// Effective number of parameters.
    pub freedom: f64,
    /// The closed form that stands in the place of the heights.
    pub closed: Option<ClosedForm>,
}

impl ColumnCurve {
    /// A level with this height.
    pub fn constant(form: ColumnCurveForm, height: f64) -> Self {
        Self { form, heights: vec![height], freedom: 1.0, closed: None }
    }

    /// The curve with a closed form in the place of its heights.
    pub fn closed_by(&self, closed: ClosedForm) -> Self {
        Self { freedom: closed.freedom(), closed: Some(closed), ..self.clone() }
    }

    /// Whether it is a constant shift of `e_n` or `e_t`.
    pub fn is_level(&self) -> bool {
        self.form.sides.is_empty() && self.form.observable != Observable::Capture
    }

    /// The same curve fitted again; `None` where there are too few points.
    pub fn again(&self, evaluation: &Evaluation<'_>) -> Option<Self> {
        let free = self.form.clone().fit(evaluation)?;
        match &self.closed {
            Some(closed) => Some(free.closed_by(closed.again(self, evaluation)?)),
            None => Some(free),
        }
    }

    /// What it adds to a prediction in a row; of capture to the log odds.
    fn change(&self, data: &DataSplit, row: usize, predicted: f64) -> f64 {
        if let (Some(closed), [(column, _)]) = (&self.closed, self.form.sides.as_slice()) {
            let cell = data.covariates.get(*column).map_or(f64::NAN, |column| column.cell(row));
            return if cell.is_nan() { 0.0 } else { closed.change(cell, predicted, self.form.observable) };
        }
        let scale = if self.form.multiplicative { predicted } else { 1.0 };
        sum(&self.form.entry(data, row), &self.heights) * scale
    }

    /// Adds the curve to the offsets of the evaluated rows.
    pub fn add_to(&self, offsets: &mut [Offset], evaluation: &Evaluation<'_>) {
        for (row, predicted) in evaluation.plain(self.form.observable) {
            let height = self.change(evaluation.data, row, predicted);
            let offset = &mut offsets[row];
            let which = self.form.observable as usize;
            *offset.restitution.get_mut(which).unwrap_or(&mut offset.capture) += height;
        }
    }
}

/// The constant offset of the log odds with which as many captures are predicted as were measured, by bisection.
fn constant_odds(evaluation: &Evaluation<'_>) -> Option<f64> {
    let (mut low, mut high) = (-WIDEST_ODDS, WIDEST_ODDS);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if evaluation.excess_captures(middle)? < 0.0 { low = middle } else { high = middle }
    }
    Some(0.5 * (low + high))
}
