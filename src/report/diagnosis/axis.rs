//! Columns as axes: numbers even or by their logarithm, words side by side.

use super::super::chart::Chart;
use super::plot::DISTINCT;
use crate::diagnose::{Sample, SampleRow};

/// Words along an axis at most.
const WORDS: usize = 16;
/// Letters of a word along an axis at most.
const LETTERS: usize = 16;
/// A column of positive numbers is drawn over its logarithm when nine tenths of its rows span more than this factor.
const LOG_SPAN: f64 = 30.0;

/// A column along the x axis.
pub(super) struct Axis<'a> {
    pub name: &'a str,
    unit: &'a str,
    place: usize,
    scale: Scale,
}

enum Scale {
    Numbers {
        low: f64,
        high: f64,
        wide: bool,
        /// Whether its values are few: markers stand at its ends.
        few: bool,
    },
    /// Labels, and by place of the word where it stands.
    Words { labels: Vec<String>, stands: Vec<Option<usize>> },
}

impl<'a> Axis<'a> {
    /// The axis of a column; `None` where the sample does not vary in it.
    pub fn new(sample: &'a Sample, column: &str) -> Option<Self> {
        let place = sample.columns.iter().position(|(name, _)| name == column)?;
        let (name, unit) = &sample.columns[place];
        let cells = || sample.rows.iter().filter_map(|row| row.cells.get(place).copied());
        let scale = match sample.words.get(place) {
            Some(Some(words)) => of_words(words, cells()),
            _ => of_numbers(cells()),
        }?;
        Some(Self { name, unit, place, scale })
    }

    /// Name and unit.
    pub fn label(&self) -> String {
        if self.unit.is_empty() { self.name.to_owned() } else { format!("{} [{}]", self.name, self.unit) }
    }

    /// Where a row stands; `None` where its cell is blank or its word is not shown.
    pub fn at(&self, row: &SampleRow) -> Option<f64> {
        let cell = row.cells.get(self.place).copied().filter(|cell| cell.is_finite())?;
        match &self.scale {
            Scale::Numbers { .. } => Some(cell),
            Scale::Words { stands, .. } => {
                stands.get(cell as usize).copied().flatten().map(|place| place as f64)
            }
        }
    }

    /// Where a word or a number of a fitted curve stands.
    pub fn find(&self, sample: &Sample, text: &str) -> Option<f64> {
        match &self.scale {
            Scale::Numbers { .. } => text.parse().ok(),
            Scale::Words { stands, .. } => {
                let words = sample.words.get(self.place)?.as_ref()?;
                let place = words.iter().position(|word| word == text)?;
                stands.get(place).copied().flatten().map(|place| place as f64)
            }
        }
    }

    pub fn has_words(&self) -> bool {
        matches!(self.scale, Scale::Words { .. })
    }

    /// The ends of a numeric axis.
    pub fn ends(&self) -> Option<[f64; 2]> {
        match self.scale {
            Scale::Numbers { low, high, .. } => Some([low, high]),
            Scale::Words { .. } => None,
        }
    }

    /// An empty chart over this column.
    pub fn chart(&self, title: &str, y_label: &str) -> Chart {
        let chart = Chart::new(title, &self.label(), y_label);
        match &self.scale {
            Scale::Words { labels, .. } => chart.words(labels),
            Scale::Numbers { wide: true, .. } => chart.log_x(),
            // Room for markers at the ends, but no speeds below zero.
            Scale::Numbers { low, high, few, .. } => {
                let room = if *few { 0.015 * (high - low) } else { 0.0 };
                let from = if *low >= 0.0 { (low - room).max(0.0) } else { low - room };
                chart.x_range(from, high + room)
            }
        }
    }
}

fn of_numbers(cells: impl Iterator<Item = f64>) -> Option<Scale> {
    let mut sorted: Vec<f64> = cells.filter(|cell| cell.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    let (low, high) = (*sorted.first()?, *sorted.last()?);
    let beyond = sorted.len() / 20;
    let wide = low > 0.0 && sorted[sorted.len() - 1 - beyond] > LOG_SPAN * sorted[beyond];
    let few = sorted.chunk_by(|a, b| a == b).count() <= DISTINCT;
    (low < high).then_some(Scale::Numbers { low, high, wide, few })
}

/// The words with the most rows, in their own order.
fn of_words(words: &[String], cells: impl Iterator<Item = f64>) -> Option<Scale> {
    let mut counts = vec![0_usize; words.len()];
    for cell in cells.filter(|cell| cell.is_finite()) {
        if let Some(count) = counts.get_mut(cell as usize) {
            *count += 1;
        }
    }
    let mut order: Vec<usize> = (0..words.len()).filter(|&word| counts[word] > 0).collect();
    order.sort_by_key(|&word| (std::cmp::Reverse(counts[word]), word));
    order.truncate(WORDS);
    order.sort_unstable();
    let mut stands = vec![None; words.len()];
    for (place, &word) in order.iter().enumerate() {
        stands[word] = Some(place + 1);
    }
    let labels: Vec<String> = order.iter().map(|&word| short(&words[word])).collect();
    (labels.len() > 1).then_some(Scale::Words { labels, stands })
}

fn short(word: &str) -> String {
    if word.chars().count() <= LETTERS {
        return word.to_owned();
    }
    let mut short: String = word.chars().take(LETTERS - 1).collect();
    short.push('…');
    short
}
