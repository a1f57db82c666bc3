//! What the page's figures share: running means, and ranges that gross errors do not stretch.

use super::super::chart::{Chart, ErrorBars, Figure, round_edges};
use super::super::format::whole_percent;
use super::axis::{ColumnAxis, DISTINCT};
use crate::diagnose::{Sample, SampleRow};

/// Up to this many rows each is drawn with its own error bar; more are drawn as a cloud with running means.
pub(in crate::report) const FEW_DRAWN: usize = 40;
/// Most running means along an axis.
const MOST_MEANS: usize = 12;
const ROWS_A_VALUE: usize = 4;
/// Fewest rows of a running mean, where there are enough.
const ROWS_A_BIN: usize = 12;
/// Least probability of a capture or a rebound in an expected error.
const RARE: f64 = 0.005;
/// Largest share of the points beyond each end of an axis.
const BEYOND_WINDOW: f64 = 0.005;

/// Place of each model's value in a row's three numbers; the measured value is at 0.
pub(super) const BASE: usize = 1;
pub(super) const EXTENDED: usize = 2;

/// Observables in the order of the page.
pub(super) const OBSERVABLES: [&str; 3] = ["e_n", "e_t", "outcome"];

/// An observable's name on the page.
pub(super) fn title(observable: &str) -> &str {
    if observable == "outcome" { "capture" } else { observable }
}

/// Measured value, base model, extended model; the last may be NaN.
pub(super) fn triple(row: &SampleRow, observable: &str) -> Option<[f64; 3]> {
    let place = OBSERVABLES.iter().position(|one| *one == observable)?;
    row.values[place].filter(|numbers| numbers[0].is_finite() && numbers[BASE].is_finite())
}

/// Letters, digits and hyphens, different for every column name.
pub(in crate::report) fn identifier(name: &str) -> String {
    let letter = |letter: char| match letter {
        '_' => "-".to_owned(),
        letter if letter.is_ascii_alphanumeric() => letter.to_string(),
        letter => format!("x{:x}-", u32::from(letter)),
    };
    name.chars().map(letter).collect()
}

/// Sets the y axis of a chart of shares, with room for markers at both ends.
pub(in crate::report) fn share_axis(chart: Chart) -> Chart {
    chart.y_range(-0.04, 1.04).y_step(0.2)
}

/// Round edges that cover `low` to `high`, which may be one value.
pub(in crate::report) fn span(low: f64, high: f64, count: usize) -> Vec<f64> {
    let room = if high - low > 1e-6 { 0.0 } else { 0.05 };
    round_edges(low - room, high + room, count)
}

/// Measured minus model over a column. Up to [`FEW_DRAWN`] rows with stated errors are drawn with
/// their own error bars; others as a cloud of the base model's rows with means for each of
/// `models`.
pub(super) fn residuals(
    sample: &Sample,
    [observable, column]: [&str; 2],
    models: &[(usize, &str)],
    [id, heading]: [&str; 2],
) -> Option<Figure> {
    let axis = ColumnAxis::new(sample, column)?;
    let rows = sample.rows.iter().filter_map(|row| {
        let numbers = triple(row, observable)?;
        Some((axis.at(row)?, stated_error(row, observable), numbers))
    });
    let rows: Vec<PlotRow> = rows.collect();
    if rows.is_empty() {
        return None;
    }
    let label = match observable {
        "outcome" => "captured, measured − model [1]".to_owned(),
        _ => format!("{observable}, measured − model [1]"),
    };
    let chart = axis.chart(heading, &label);
    let stated = rows.iter().filter(|(_, error, _)| *error > 0.0).count();
    let (chart, caption) = if rows.len() <= FEW_DRAWN && 2 * stated > rows.len() {
        single_residuals(chart, &rows, models)
    } else {
        mean_residuals(chart, &rows, models, observable, axis.has_words())
    };
    Some(chart.figure(id, &format!("{} rows; {caption}{}", rows.len(), agreement(&rows, models))))
}

/// A row's place on the axis, its stated standard error (0 where there is none) and its three numbers.
pub(super) type PlotRow = (f64, f64, [f64; 3]);

/// The stated standard error of a row; 0 where there is none.
pub(super) fn stated_error(row: &SampleRow, observable: &str) -> f64 {
    let place = OBSERVABLES.iter().position(|one| *one == observable);
    place.and_then(|place| row.errors.get(place).copied().flatten()).unwrap_or(0.0)
}

/// Measured minus model.
fn differences(rows: &[PlotRow], which: usize) -> Vec<[f64; 2]> {
    let all = rows.iter().map(|(x, _, numbers)| [*x, numbers[0] - numbers[which]]);
    all.filter(|point| point[1].is_finite()).collect()
}

/// Each row with its stated error, for each of `models`.
fn single_residuals(chart: Chart, rows: &[PlotRow], models: &[(usize, &str)]) -> (Chart, String) {
    let of = |which: usize| {
        let drawn = rows.iter().filter(|(_, _, numbers)| numbers[which].is_finite());
        let errors: ErrorBars = drawn.map(|(_, error, _)| (*error, *error)).collect();
        Means::single(differences(rows, which), errors)
    };
    let series: Vec<Means> = models.iter().map(|(which, _)| of(*which)).collect();
    let window = Window::new(&[], series.iter().flat_map(Means::reach).chain([0.0]));
    let (chart, _) = window.draw(chart, "", &[]);
    let add = |chart: Chart, ((_, model), one): (&(usize, &str), &Means)| {
        chart.points_with_errors(&format!("measured − {model} model"), &one.points, &one.errors)
    };
    let chart = models.iter().zip(&series).fold(chart.mark_y(0.0, ""), add);
    (chart, "bars are the stated standard errors.".to_owned())
}

fn mean_residuals(
    chart: Chart,
    rows: &[PlotRow],
    models: &[(usize, &str)],
    observable: &str,
    words: bool,
) -> (Chart, String) {
    let capture = observable == "outcome";
    let of = |which: usize| {
        let means = Means::new(&differences(rows, which), words);
        if capture { means.with_expected_errors(rows, which, words) } else { means }
    };
    let means: Vec<Means> = models.iter().map(|(which, _)| of(*which)).collect();
    // Single captures lie at two heights only: a cloud of them shows nothing.
    let cloud = if capture { Vec::new() } else { differences(rows, BASE) };
    let window = Window::new(&cloud, means.iter().flat_map(Means::reach).chain([0.0]));
    let (chart, note) = window.draw(chart, "single rows, base model", &cloud);
    let add = |chart: Chart, ((_, model), one): (&(usize, &str), &Means)| {
        chart.points_with_errors(&format!("mean, {model} model"), &one.points, &one.errors)
    };
    let chart = models.iter().zip(&means).fold(chart.mark_y(0.0, ""), add);
    let off = models.iter().zip(&means).filter_map(|((_, model), means)| {
        let (off, all) = means.off_zero();
        (all > 0).then(|| format!("of the {model} model {off} of {all}"))
    });
    let off = off.collect::<Vec<_>>().join(", ");
    let over = if words { "each word" } else { "neighbouring rows" };
    let bars =
        if capture { "bars are standard errors if the model were right" } else { "bars are standard errors" };
    let mut caption = format!("means over {over}, {bars}.");
    if !off.is_empty() {
        caption += &format!(" Means more than 2 standard errors from zero: {off}; by chance 1 in 20.");
    }
    (chart, caption + &note)
}

/// The shares of the rows within 1 and 2 stated standard errors of each model, as a sentence for a
/// caption; nothing where no errors are stated.
pub(super) fn agreement(rows: &[PlotRow], models: &[(usize, &str)]) -> String {
    let share = |which: usize, most: f64| {
        let stated = rows.iter().filter(|(_, error, numbers)| *error > 0.0 && numbers[which].is_finite());
        let inside: Vec<bool> =
            stated.map(|(_, error, numbers)| (numbers[0] - numbers[which]).abs() <= most * error).collect();
        let count = inside.iter().filter(|inside| **inside).count();
        (!inside.is_empty()).then(|| whole_percent(count as f64 / inside.len() as f64))
    };
    let shares = models.iter().filter_map(|(which, model)| {
        Some(format!("{} and {} for the {model} model", share(*which, 1.0)?, share(*which, 2.0)?))
    });
    let shares: Vec<String> = shares.collect();
    if shares.is_empty() {
        return String::new();
    }
    format!(
        " Within 1 and 2 stated standard errors lie {}; if model and errors are right, 68 % and 95 % do.",
        shares.join(", ")
    )
}

/// Means over parts of the x axis with their standard errors.
#[derive(Default)]
pub(super) struct Means {
    pub points: Vec<[f64; 2]>,
    pub errors: ErrorBars,
    /// Number of rows of each mean.
    counts: Vec<usize>,
}

impl Means {
    /// Single rows with their stated errors.
    pub fn single(points: Vec<[f64; 2]>, errors: ErrorBars) -> Self {
        let counts = vec![1; points.len()];
        Self { points, errors, counts }
    }

    /// One mean for each word, for each value where there are few, else over equally many neighbouring rows each.
    pub fn new(points: &[[f64; 2]], words: bool) -> Self {
        let mut sorted = points.to_vec();
        sorted.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
        let groups: Vec<&[[f64; 2]]> = sorted.chunk_by(|a, b| a[0] == b[0]).collect();
        let few = groups.len() <= DISTINCT && sorted.len() >= ROWS_A_VALUE * groups.len();
        let most = (sorted.len() / MOST_MEANS).max(ROWS_A_BIN).min(sorted.len() / 3).max(1);
        let most = if words || few { 1 } else { most };
        let mut means = Self::default();
        let (mut from, mut to) = (0, 0);
        for group in groups {
            to += group.len();
            let rest = sorted.len() - to;
            // The last part includes what would be too few for another.
            if to - from >= most && (rest == 0 || rest >= most.div_ceil(2) || most == 1) {
                means.push(&sorted[from..to]);
                from = to;
            }
        }
        if from < to {
            means.push(&sorted[from..to]);
        }
        means
    }

    /// Sets the errors to those that a model of captures expects, √(p(1-p)/n): where all or none
    /// are captured, the spread of the rows says nothing.
    fn with_expected_errors(mut self, rows: &[PlotRow], which: usize, words: bool) -> Self {
        let variance = |(x, _, numbers): &PlotRow| {
            let p = numbers[which].clamp(RARE, 1.0 - RARE);
            [*x, p * (1.0 - p)]
        };
        let rows = rows.iter().filter(|(_, _, numbers)| numbers[which].is_finite());
        // The same rows make up the same means.
        let variances = Self::new(&rows.map(variance).collect::<Vec<_>>(), words);
        let errors = variances.points.iter().zip(&self.counts);
        self.errors = errors.map(|(mean, count)| (mean[1] / *count as f64).sqrt()).map(|e| (e, e)).collect();
        self
    }

    fn push(&mut self, points: &[[f64; 2]]) {
        let count = points.len() as f64;
        let mean = |of: usize| points.iter().map(|point| point[of]).sum::<f64>() / count;
        let (x, y) = (mean(0), mean(1));
        let square = points.iter().map(|point| (point[1] - y).powi(2)).sum::<f64>();
        // The error of a single row is unknown.
        let error = if points.len() > 1 { (square / (count - 1.0) / count).sqrt() } else { 0.0 };
        self.points.push([x, y]);
        self.errors.push((error, error));
        self.counts.push(points.len());
    }

    /// Number of means more than two standard errors from zero, and of all with a standard error.
    fn off_zero(&self) -> (usize, usize) {
        let known = self.points.iter().zip(&self.errors).filter(|(_, (error, _))| *error > 0.0);
        let off = known.clone().filter(|(mean, (error, _))| mean[1].abs() > 2.0 * error);
        (off.count(), known.count())
    }

    /// The ends of the error bars.
    pub fn reach(&self) -> impl Iterator<Item = f64> {
        let bars = self.points.iter().zip(&self.errors);
        bars.flat_map(|(mean, (below, above))| [mean[1] - below, mean[1] + above])
    }
}

/// A range of the y axis that holds `always` and all but a few of the points.
pub(in crate::report) struct Window {
    low: f64,
    high: f64,
    step: f64,
}

impl Window {
    pub fn new(points: &[[f64; 2]], always: impl Iterator<Item = f64>) -> Self {
        let mut sorted: Vec<f64> = points.iter().map(|point| point[1]).collect();
        sorted.sort_by(f64::total_cmp);
        let beyond = (BEYOND_WINDOW * sorted.len() as f64) as usize;
        let ends = [sorted.get(beyond), sorted.get(sorted.len().saturating_sub(1 + beyond))];
        let reach = |[low, high]: [f64; 2], y: f64| [low.min(y), high.max(y)];
        let nothing = [f64::INFINITY, f64::NEG_INFINITY];
        let [low, high] = always.filter(|y| y.is_finite()).fold(nothing, reach);
        // The axis begins at zero unless that would take half of it.
        let low = if (0.0..0.5 * high).contains(&low) { 0.0 } else { low };
        // Room for the markers at the ends, but none beyond zero.
        let room = (0.06 * (high - low)).max(0.0);
        let low = if low < 0.0 { low - room } else { (low - room).max(0.0) };
        let high = if high > 0.0 { high + room } else { (high + room).min(0.0) };
        let [low, high] = ends.into_iter().flatten().copied().fold([low, high], reach);
        let edges = if low <= high { span(low, high, 6) } else { span(0.0, 1.0, 6) };
        Self { low: edges[0], high: edges[edges.len() - 1], step: edges[1] - edges[0] }
    }

    /// Adds the points inside to a chart over this range; and a sentence for the caption about the others.
    pub fn draw(&self, chart: Chart, name: &str, points: &[[f64; 2]]) -> (Chart, String) {
        let inside: Vec<[f64; 2]> = points.iter().filter(|point| self.contains(point)).copied().collect();
        let note = match points.len() - inside.len() {
            0 => String::new(),
            1 => " One row lies outside the figure.".to_owned(),
            count => format!(" {count} rows lie outside the figure."),
        };
        // Slightly wider, so that rounding does not lose the ticks at the ends.
        let touch = 1e-9 * self.step;
        let chart = chart.y_range(self.low - touch, self.high + touch).y_step(self.step);
        (if points.is_empty() { chart } else { chart.cloud(name, &inside) }, note)
    }

    /// Numbers with those outside at its ends.
    pub fn clamped(&self, numbers: &[f64]) -> Vec<f64> {
        numbers.iter().map(|number| number.clamp(self.low, self.high)).collect()
    }

    fn contains(&self, point: &[f64; 2]) -> bool {
        (self.low..=self.high).contains(&point[1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn running_means_hold_every_row_once_and_have_its_standard_error() {
        let points: Vec<[f64; 2]> =
            (0..100).map(|i| [f64::from(i), if i % 2 == 0 { 1.0 } else { 3.0 }]).collect();
        let found = Means::new(&points, false);
        assert!((6..=MOST_MEANS).contains(&found.points.len()), "{}", found.points.len());
        assert!(found.points.iter().all(|mean| (mean[1] - 2.0).abs() < 0.2));
        // 0.5 sqrt(n/(n-1)) 2 / sqrt(n): a spread of 1 over some 12 rows.
        assert!(found.errors.iter().all(|(below, above)| below == above && (0.2..0.4).contains(below)));
        let few = Means::new(&[[1.0, 0.0], [1.0, 2.0], [2.0, 5.0]], true);
        assert_eq!(few.points, [[1.0, 1.0], [2.0, 5.0]]);
        assert_eq!(few.errors, [(1.0, 1.0), (0.0, 0.0)]);
    }

    #[test]
    fn a_gross_error_does_not_stretch_the_window() {
        let mut points: Vec<[f64; 2]> = (0..400).map(|i| [0.0, 0.001 * f64::from(i % 100) - 0.05]).collect();
        points.push([0.0, 40.0]);
        let window = Window::new(&points, std::iter::once(0.0));
        let inside = points.iter().filter(|point| window.contains(point)).count();
        assert!(window.high < 0.11 && inside == 400, "{}", window.high);
    }

    #[test]
    fn names_of_columns_stay_apart() {
        assert_eq!(identifier("v_n"), "v-n");
        assert_ne!(identifier("v n"), identifier("v-n"));
    }
}
