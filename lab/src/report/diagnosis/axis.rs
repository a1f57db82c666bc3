//! Columns as x axes: numbers on a linear or logarithmic axis, words side by side.

use super::super::chart::Chart;
use super::super::format::{shown_unit, span, with_unit};
use crate::diagnose::{Sample, SampleRow};
use crate::rig::name_of;
use nearwall::group::GROUPS;
use nearwall::impact::INPUTS;

/// Up to this many values of a column each has a mean of its own, if it has so many rows on average.
pub(super) const DISTINCT: usize = 12;
/// Most words along an axis, and letters of each.
const WORDS: usize = 16;
const LETTERS: usize = 16;
/// Positive numbers get a logarithmic axis when nine tenths of the rows span more than this factor.
const LOGARITHMIC_SPAN: f64 = 30.0;

/// A column along the x axis.
pub(in crate::report) struct ColumnAxis<'a> {
    pub name: &'a str,
    unit: &'a str,
    place: usize,
    scale: Scale,
}

enum Scale {
    /// `few`: there are few values, so markers lie at the ends.
    Numbers { low: f64, high: f64, log: bool, few: bool },
    /// Labels, and the label of each of the column's words where it is shown.
    Words { labels: Vec<String>, label_of: Vec<Option<usize>> },
}

impl<'a> ColumnAxis<'a> {
    /// The axis of a column; `None` where the sample does not vary in it.
    pub fn new(sample: &'a Sample, column: &str) -> Option<Self> {
        let place = sample.columns.iter().position(|(name, _)| name == column)?;
        let (name, unit) = &sample.columns[place];
        let cells = sample
            .rows
            .iter()
            .filter_map(|row| row.cells.get(place).copied())
            .filter(|cell| cell.is_finite());
        let scale = match sample.words.get(place) {
            Some(Some(words)) => of_words(words, cells),
            _ => of_numbers(cells.collect()),
        }?;
        Some(Self { name, unit, place, scale })
    }

    /// The row's number or the place of its word; `None` where it is blank.
    pub fn cell(&self, row: &SampleRow) -> Option<f64> {
        row.cells.get(self.place).copied().filter(|cell| cell.is_finite())
    }

    /// The row's position on the axis; `None` where its cell is blank or its word is not shown.
    pub fn at(&self, row: &SampleRow) -> Option<f64> {
        self.position(self.cell(row)?)
    }

    /// The position of a word or a number.
    pub fn find(&self, sample: &Sample, text: &str) -> Option<f64> {
        match sample.words.get(self.place)? {
            Some(words) => self.position(words.iter().position(|word| word == text)? as f64),
            None => text.parse().ok(),
        }
    }

    fn position(&self, cell: f64) -> Option<f64> {
        match &self.scale {
            Scale::Numbers { .. } => Some(cell),
            Scale::Words { label_of, .. } => label_of.get(cell as usize)?.map(|label| (label + 1) as f64),
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

    /// A range of the column in words.
    pub fn describe(&self, [low, high]: [f64; 2]) -> String {
        match &self.scale {
            Scale::Words { labels, label_of } => {
                let label = label_of.get(low as usize).copied().flatten();
                format!("= {}", label.map_or("", |label| &labels[label]))
            }
            Scale::Numbers { .. } if low == high => format!("= {}", with_unit(low, self.unit)),
            Scale::Numbers { .. } => format!("from {}", span([low, high], self.unit)),
        }
    }

    /// An empty chart over this column, between these numbers.
    pub fn chart_between(&self, title: &str, y_label: &str, [low, high]: [f64; 2]) -> Chart {
        let chart = self.chart(title, y_label);
        match self.scale {
            Scale::Numbers { log: false, .. } => chart.x_range(low, high),
            _ => chart,
        }
    }

    /// The name of the column; of an input, a group or a number of a case with its meaning.
    fn words(&self) -> String {
        let input = INPUTS.iter().find(|input| input.name == self.name).map(|input| input.words().to_owned());
        let group = || GROUPS.iter().find(|group| group.name == self.name);
        // What follows a comma or a colon is an explanation.
        let group = || Some(group()?.words.split([',', ':']).next()?.to_owned());
        let is_of_case = ["gas.", "particles.", "walls."].iter().any(|table| self.name.starts_with(table));
        let number = || is_of_case.then(|| name_of(self.name));
        let words = input.or_else(group).or_else(number);
        words.map_or_else(|| self.name.to_owned(), |words| format!("{words}, {}", self.name))
    }

    /// An empty chart over this column.
    pub fn chart(&self, title: &str, y_label: &str) -> Chart {
        let (factor, unit) = shown_unit(self.unit, self.ends().map_or(f64::INFINITY, |[_, high]| high));
        let unit = if unit.is_empty() { String::new() } else { format!(" [{unit}]") };
        let chart = Chart::new(title, &format!("{}{unit}", self.words()), y_label).x_factor(factor);
        match &self.scale {
            Scale::Words { labels, .. } => chart.words(labels),
            Scale::Numbers { log: true, .. } => chart.log_x(),
            // Room for markers at the ends, but no speeds below zero.
            Scale::Numbers { low, high, few, .. } => {
                let room = if *few { 0.015 * (high - low) } else { 0.0 };
                let from = if *low >= 0.0 { (low - room).max(0.0) } else { low - room };
                chart.x_range(from, high + room)
            }
        }
    }
}

fn of_numbers(mut cells: Vec<f64>) -> Option<Scale> {
    cells.sort_by(f64::total_cmp);
    let (low, high) = (*cells.first()?, *cells.last()?);
    let beyond = cells.len() / 20;
    let log = low > 0.0 && cells[cells.len() - 1 - beyond] > LOGARITHMIC_SPAN * cells[beyond];
    let few = cells.chunk_by(|a, b| a == b).count() <= DISTINCT;
    (low < high).then_some(Scale::Numbers { low, high, log, few })
}

/// The words with the most rows, in their own order.
fn of_words(words: &[String], cells: impl Iterator<Item = f64>) -> Option<Scale> {
    let mut counts = vec![0_usize; words.len()];
    for cell in cells {
        if let Some(count) = counts.get_mut(cell as usize) {
            *count += 1;
        }
    }
    let mut order: Vec<usize> = (0..words.len()).filter(|&word| counts[word] > 0).collect();
    order.sort_by_key(|&word| (std::cmp::Reverse(counts[word]), word));
    order.truncate(WORDS);
    order.sort_unstable();
    let label_of = (0..words.len()).map(|word| order.iter().position(|&shown| shown == word)).collect();
    let labels: Vec<String> = order.iter().map(|&word| short(&words[word])).collect();
    (labels.len() > 1).then_some(Scale::Words { labels, label_of })
}

fn short(word: &str) -> String {
    if word.chars().count() <= LETTERS {
        return word.to_owned();
    }
    word.chars().take(LETTERS - 1).chain(['…']).collect()
}
