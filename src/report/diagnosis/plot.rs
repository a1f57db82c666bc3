//! What the page's figures have in common: running means, ranges that gross errors do not stretch.

use super::super::chart::{Chart, ErrorBars, round_edges};
use crate::diagnose::SampleRow;

/// Running means along an axis at most.
const BINS: usize = 12;
/// Values of a column up to which each has a running mean of its own, if it has so many rows on average.
pub(super) const DISTINCT: usize = 12;
/// See [`DISTINCT`].
const ROWS_A_VALUE: usize = 4;
/// Rows that a running mean takes at least where there are enough.
const ROWS_A_BIN: usize = 12;
/// Share of the points beyond each end of an axis, at most.
const BEYOND: f64 = 0.005;

/// Which of a row's three numbers.
pub(super) const BASE: usize = 1;
/// The extended model's.
pub(super) const EXTENDED: usize = 2;

/// Observables in the order of the page.
pub(super) const OBSERVABLES: [&str; 3] = ["e_n", "e_t", "outcome"];

/// An observable for a reader.
pub(super) fn title(observable: &str) -> &str {
    match observable {
        "outcome" => "capture",
        other => other,
    }
}

/// Measured, base model, extended model; the last may be no number.
pub(super) fn triple(row: &SampleRow, observable: &str) -> Option<[f64; 3]> {
    let triple = match observable {
        "e_n" => row.e_n,
        "e_t" => row.e_t,
        _ => row.captured,
    };
    triple.filter(|numbers| numbers[0].is_finite() && numbers[BASE].is_finite())
}

/// Letters, digits and hyphens that no other column's name comes to.
pub(super) fn identifier(name: &str) -> String {
    let mut id = String::new();
    for letter in name.chars() {
        match letter {
            '_' => id.push('-'),
            letter if letter.is_ascii_alphanumeric() => id.push(letter),
            letter => id += &format!("x{:x}-", u32::from(letter)),
        }
    }
    id
}

/// Round edges about `low` to `high`, which may be one value.
pub(super) fn span(low: f64, high: f64, count: usize) -> Vec<f64> {
    let room = if high - low > 1e-6 { 0.0 } else { 0.05 };
    round_edges(low - room, high + room, count)
}

/// Means over parts of the x axis, with their standard errors.
#[derive(Default)]
pub(super) struct Running {
    pub means: Vec<[f64; 2]>,
    pub errors: ErrorBars,
}

/// Running means of `points`: one for each word, for each value where there are few, else for equally many rows each.
pub(super) fn running(points: &[[f64; 2]], words: bool) -> Running {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let groups: Vec<&[[f64; 2]]> = sorted.chunk_by(|a, b| a[0] == b[0]).collect();
    let few = groups.len() <= DISTINCT && sorted.len() >= ROWS_A_VALUE * groups.len();
    let most =
        if words || few { 1 } else { (sorted.len() / BINS).max(ROWS_A_BIN).min(sorted.len() / 3).max(1) };
    let mut running = Running::default();
    let mut from = 0;
    let mut to = 0;
    for group in groups {
        to += group.len();
        let rest = sorted.len() - to;
        // The last part takes what would be too few for another.
        if to - from >= most && (rest == 0 || rest >= most.div_ceil(2) || most == 1) {
            running.push(&sorted[from..to]);
            from = to;
        }
    }
    if from < to {
        running.push(&sorted[from..to]);
    }
    running
}

impl Running {
    fn push(&mut self, points: &[[f64; 2]]) {
        let count = points.len() as f64;
        let mean = |of: usize| points.iter().map(|point| point[of]).sum::<f64>() / count;
        let (x, y) = (mean(0), mean(1));
        let square = points.iter().map(|point| (point[1] - y).powi(2)).sum::<f64>();
        // A single row says nothing of its own error.
        let error = if points.len() > 1 { (square / (count - 1.0) / count).sqrt() } else { 0.0 };
        self.means.push([x, y]);
        self.errors.push((error, error));
    }

    /// The ends of the error bars.
    pub fn reach(&self) -> impl Iterator<Item = f64> {
        let bars = self.means.iter().zip(&self.errors);
        bars.flat_map(|(mean, (below, above))| [mean[1] - below, mean[1] + above])
    }
}

/// A range of the y axis that holds `always` and all but a few of `points`, and the points inside.
pub(super) struct Window {
    pub low: f64,
    pub high: f64,
    pub step: f64,
    pub inside: Vec<[f64; 2]>,
    pub outside: usize,
}

impl Window {
    pub fn new(points: &[[f64; 2]], always: impl Iterator<Item = f64>) -> Self {
        let mut sorted: Vec<f64> = points.iter().map(|point| point[1]).collect();
        sorted.sort_by(f64::total_cmp);
        let beyond = (BEYOND * sorted.len() as f64) as usize;
        let ends = [sorted.get(beyond), sorted.get(sorted.len().saturating_sub(1 + beyond))];
        let reach = |[l, h]: [f64; 2], y: f64| [l.min(y), h.max(y)];
        let [low, high] = always.filter(|y| y.is_finite()).fold([0.0; 2], reach);
        // Room for the markers at the ends.
        let room = 0.06 * (high - low);
        let [low, high] =
            [low - if low < 0.0 { room } else { 0.0 }, high + if high > 0.0 { room } else { 0.0 }];
        let [low, high] = ends.into_iter().flatten().copied().fold([low, high], reach);
        let edges = span(low, high, 6);
        let (low, high) = (edges[0], edges[edges.len() - 1]);
        let inside: Vec<[f64; 2]> =
            points.iter().copied().filter(|point| (low..=high).contains(&point[1])).collect();
        let outside = points.len() - inside.len();
        Self { low, high, step: edges[1] - edges[0], inside, outside }
    }

    /// Sets the axis of a chart.
    pub fn on(&self, chart: Chart) -> Chart {
        // A touch wider, so that rounding does not lose the ticks at the ends.
        let touch = 1e-9 * self.step;
        chart.y_range(self.low - touch, self.high + touch).y_step(self.step)
    }

    /// What a caption has to say of points that are not drawn.
    pub fn note(&self) -> String {
        match self.outside {
            0 => String::new(),
            1 => " One row lies beyond the picture.".to_owned(),
            count => format!(" {count} rows lie beyond the picture."),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn running_means_hold_every_row_once_and_have_its_standard_error() {
        let points: Vec<[f64; 2]> =
            (0..100).map(|i| [f64::from(i), if i % 2 == 0 { 1.0 } else { 3.0 }]).collect();
        let found = running(&points, false);
        assert!((6..=BINS).contains(&found.means.len()), "{}", found.means.len());
        assert!(found.means.iter().all(|mean| (mean[1] - 2.0).abs() < 0.2));
        // 0.5 sqrt(n/(n-1)) 2 / sqrt(n): a spread of 1 over some 12 rows.
        assert!(found.errors.iter().all(|(below, above)| below == above && (0.2..0.4).contains(below)));
        let few = running(&[[1.0, 0.0], [1.0, 2.0], [2.0, 5.0]], true);
        assert_eq!(few.means, [[1.0, 1.0], [2.0, 5.0]]);
        assert_eq!(few.errors, [(1.0, 1.0), (0.0, 0.0)]);
    }

    #[test]
    fn a_gross_error_does_not_stretch_the_window() {
        let mut points: Vec<[f64; 2]> = (0..400).map(|i| [0.0, 0.001 * f64::from(i % 100) - 0.05]).collect();
        points.push([0.0, 40.0]);
        let window = Window::new(&points, std::iter::once(0.0));
        assert!(window.high < 0.11 && window.outside == 1, "{} {}", window.high, window.outside);
    }

    #[test]
    fn names_of_columns_stay_apart() {
        assert_eq!(identifier("v_n"), "v-n");
        assert_ne!(identifier("v n"), identifier("v-n"));
    }
}
