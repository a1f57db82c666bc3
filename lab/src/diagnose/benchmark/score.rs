//! Scores on the readings that every contestant decides, each source with a fit to the others.

use std::sync::Arc;

use super::super::constants::FIRST_SCATTER;
use super::super::evaluation::Evaluation;
use super::super::forecast::Forecast;
use super::super::likelihood::{Offset, Scatter};
use super::super::observable::Observable;
use super::contestant::{Contestant, Trial, prediction};
use super::read_set::ReadSet;
use super::{Benchmark, EntryKind};

/// Half width of a 95 % band in standard deviations.
const BAND: f64 = 1.96;

/// The result of a benchmark.
#[derive(Debug, Clone)]
pub struct BenchmarkResult {
    /// Readings of all sets, and of these those that all laws, models and programs decide.
    pub readings: [usize; 2],
    /// The sources that have scored readings.
    pub sources: Vec<String>,
    /// The level first, then the laws, then what was added.
    pub entries: Vec<BenchmarkEntry>,
}

/// The scores of a law, a model or a program.
#[derive(Debug, Clone)]
pub struct BenchmarkEntry {
    /// Its name.
    pub name: String,
    /// What it is.
    pub kind: EntryKind,
    /// On all readings.
    pub whole: BenchmarkMeasure,
    /// On the readings of `e_n`, `e_t` and captures; `None` without any.
    pub by_observable: [Option<BenchmarkMeasure>; 3],
    /// Share of the readings of `e_n` and `e_t` in its own bands; `None` without bands.
    pub own_coverage: Option<f64>,
    /// Its fitted numbers, each with the least and the largest value that a source was predicted with.
    pub numbers: Vec<(&'static str, [f64; 2])>,
    /// Why it does not decide a set.
    pub refusal: Option<String>,
    /// Readings that it does not decide.
    pub undecided: usize,
    /// Of a law of capture by a melt: what adhesion alone scores on the same readings.
    pub without: Option<BenchmarkMeasure>,
    /// By set and observable.
    pub sets: Vec<SetMeasure>,
    pub(super) readings: Vec<ScoredReading>,
}

/// Means over the sources, each of which counts once.
#[derive(Debug, Clone, Copy)]
pub struct BenchmarkMeasure {
    /// Readings.
    pub readings: usize,
    /// Mean log score of a reading [nats].
    pub score: f64,
    /// The same beyond that of the level [nats]; negative if the level is better.
    pub gain: f64,
    /// Root mean square error of `e_n` or `e_t` [1]; NaN for captures and for all together.
    pub rms: f64,
    /// Share of the readings of `e_n` and `e_t` in the 95 % band of the scatter [1]; NaN without any.
    pub coverage: f64,
}

/// A set and an observable.
#[derive(Debug, Clone)]
pub struct SetMeasure {
    /// Name of the set.
    pub set: String,
    /// Its source.
    pub source: String,
    /// `e_n`, `e_t` or `outcome`.
    pub observable: &'static str,
    /// The measure.
    pub measure: BenchmarkMeasure,
    /// Mean measured and mean predicted value [1].
    pub means: [f64; 2],
}

/// A reading with its score.
#[derive(Debug, Clone, Copy)]
pub(super) struct ScoredReading {
    pub set: usize,
    /// Place of the reading in its set.
    pub row: usize,
    pub observable: Observable,
    pub score: f64,
    /// Beyond the score of the level [nats].
    pub gain: f64,
    /// Measured and predicted value; `None` where the measurement is a limit.
    pub pair: Option<[f64; 2]>,
    inside: Option<bool>,
    in_own_band: Option<bool>,
}

/// A trial under evaluation, with the scatter of each set about it.
struct Fitted<'a> {
    numbers: &'a [(&'static str, f64)],
    sets: Vec<Evaluation<'a>>,
    /// By set: scatter and number of readings of `e_n` and `e_t`.
    scatter: Vec<[[f64; 2]; 2]>,
}

/// The readings that are scored.
struct Common<'a> {
    sets: &'a [ReadSet],
    /// By set.
    rows: Vec<Vec<usize>>,
    sources: usize,
}

impl Benchmark {
    /// Scores everything on the readings that all decide.
    #[must_use]
    pub fn run(&self) -> BenchmarkResult {
        let common = self.common(|set, row| self.contestants.iter().all(|one| one.decided[set][row]));
        let level = common.level();
        let mut entries = vec![common.entry("level", EntryKind::Level, &level, &level, &self.sources)];
        for one in &self.contestants {
            let readings = common.scored(one, &level);
            let entry = common.entry(&one.name, one.kind, &readings, &level, &self.sources);
            let undecided = one.decided.iter().flatten().filter(|decided| !**decided).count();
            entries.push(BenchmarkEntry { undecided, refusal: one.refusal.clone(), ..entry });
        }
        entries.extend(self.capture_entries());
        let all = self.sets.iter().map(ReadSet::count).sum();
        let used = common.rows.iter().map(Vec::len).sum();
        let has_rows = |source: &usize| common.places(*source).any(|set| !common.rows[set].is_empty());
        let sources = (0..self.sources.len()).filter(has_rows).map(|source| self.sources[source].clone());
        BenchmarkResult { readings: [all, used], sources: sources.collect(), entries }
    }

    /// The readings of these sets and rows that can be scored.
    fn common(&self, is_scored: impl Fn(usize, usize) -> bool) -> Common<'_> {
        let rows = self.sets.iter().enumerate();
        let rows = rows.map(|(place, set)| (0..set.count()).filter(|&row| is_scored(place, row)).collect());
        let mut common = Common { sets: &self.sets, rows: rows.collect(), sources: self.sources.len() };
        common.leave_out_lone_observables();
        common
    }

    /// Each law of capture by a melt, beside adhesion alone, on the captures that it decides and of which any of these
    /// laws says something else than adhesion does.
    fn capture_entries(&self) -> Vec<BenchmarkEntry> {
        let Some((alone, laws)) = self.captures.split_first() else { return Vec::new() };
        let entry = |one: &Contestant| {
            let is_of_melt = |set: usize, row: usize| {
                self.sets[set].observables[row] == Observable::Capture
                    && laws.iter().any(|law| law.captures_otherwise(alone, set, row))
            };
            let common = self.common(|set, row| one.decided[set][row] && is_of_melt(set, row));
            let level = common.level();
            let of = |one: &Contestant| {
                common.entry(&one.name, one.kind, &common.scored(one, &level), &level, &self.sources)
            };
            BenchmarkEntry { without: of(alone).by_observable[Observable::Capture as usize], ..of(one) }
        };
        laws.iter().map(entry).collect()
    }
}

/// The readings of a contestant and the numbers that it was fitted with.
type Scored = (Vec<ScoredReading>, Vec<(&'static str, [f64; 2])>);

impl Common<'_> {
    /// The sets of a source.
    fn places(&self, source: usize) -> impl Iterator<Item = usize> {
        self.sets.iter().enumerate().filter(move |(_, set)| set.source == source).map(|(place, _)| place)
    }

    /// Leaves out what only one source has readings of: there is nothing to fit to.
    fn leave_out_lone_observables(&mut self) {
        for observable in Observable::ALL {
            let has =
                |set: usize| self.rows[set].iter().any(|&row| self.sets[set].observables[row] == observable);
            let count = (0..self.sources).filter(|source| self.places(*source).any(has)).count();
            if count < 2 {
                let others = |set: &ReadSet, row: usize| set.observables[row] != observable;
                self.rows
                    .iter_mut()
                    .zip(self.sets)
                    .for_each(|(rows, set)| rows.retain(|&row| others(set, row)));
            }
        }
    }

    /// The mean over the sources but one of the mean of their values; `None` without any.
    fn mean_of_others(&self, left_out: usize, of_set: impl Fn(usize) -> Vec<f64>) -> Option<f64> {
        let others = (0..self.sources).filter(|source| *source != left_out);
        let means = others.filter_map(|source| mean(self.places(source).flat_map(&of_set)));
        mean(means)
    }

    /// A trial on the common readings.
    fn fitted<'b>(&'b self, trial: &'b Trial) -> Fitted<'b> {
        let evaluate = |(place, set): (usize, &'b ReadSet)| {
            let rows = &self.rows[place];
            let forecast = Arc::new(trial.forecasts[place].select(rows));
            let offsets = vec![Offset::default(); set.count()];
            Evaluation::of_forecast(&set.data, forecast, rows.as_slice(), offsets, FIRST_SCATTER)
        };
        let sets: Vec<Evaluation<'b>> = self.sets.iter().enumerate().map(evaluate).collect();
        let scatter = sets.iter().enumerate().map(|(place, set)| {
            let fitted = set.clone().with_fitted_scatter().scatter;
            let count = |kind: Observable| {
                self.rows[place].iter().filter(|&&row| self.sets[place].observables[row] == kind).count()
                    as f64
            };
            let counts = [Observable::NormalRestitution, Observable::TangentialRestitution].map(count);
            [0, 1].map(|which| [fitted[which], counts[which]])
        });
        let scatter = scatter.collect();
        Fitted { numbers: &trial.numbers, sets, scatter }
    }

    /// The scatter about a trial on the other sources: the root of the mean square over the sources.
    fn scatter(&self, fitted: &Fitted<'_>, left_out: usize) -> Scatter {
        [0, 1].map(|which| {
            let squares = |set: usize| {
                let [scatter, count] = fitted.scatter[set][which];
                vec![scatter * scatter; count as usize]
            };
            self.mean_of_others(left_out, squares).map_or(FIRST_SCATTER[which], f64::sqrt)
        })
    }

    /// The trial with the highest score on the other sources.
    fn best<'b, 'c>(&self, trials: &'b [Fitted<'c>], left_out: usize) -> &'b Fitted<'c> {
        let score = |fitted: &Fitted<'_>| {
            let scatter = self.scatter(fitted, left_out);
            let of_set = |set: usize| fitted.sets[set].clone().with_scatter(scatter).scores();
            self.mean_of_others(left_out, of_set).unwrap_or(f64::NEG_INFINITY)
        };
        match trials {
            [only] => only,
            several => {
                let scores: Vec<f64> = several.iter().map(score).collect();
                let best = (0..several.len()).max_by(|&a, &b| scores[a].total_cmp(&scores[b]));
                &several[best.unwrap_or(0)]
            }
        }
    }

    /// The readings of the sources of a contestant, each under the fit to the others.
    fn scored(&self, one: &Contestant, level: &Scored) -> Scored {
        let trials: Vec<Fitted<'_>> = one.trials.iter().map(|trial| self.fitted(trial)).collect();
        let (mut readings, mut numbers) = (Vec::new(), Vec::<(&str, [f64; 2])>::new());
        for source in 0..self.sources {
            let best = self.best(&trials, source);
            readings.extend(self.of_source(best, source));
            for &(name, value) in best.numbers {
                match numbers.iter_mut().find(|(known, _)| *known == name) {
                    Some((_, [low, high])) => (*low, *high) = (low.min(value), high.max(value)),
                    None => numbers.push((name, [value; 2])),
                }
            }
        }
        for (reading, level) in readings.iter_mut().zip(&level.0) {
            reading.gain = reading.score - level.score;
            let band = one.bands.as_ref().map(|bands| bands[reading.set][reading.row]);
            reading.in_own_band = band.zip(reading.pair).and_then(|(band, [measured, _])| {
                let [low, high] = *band.get(reading.observable as usize)?;
                (low.is_finite() && high.is_finite()).then_some((low..=high).contains(&measured))
            });
        }
        (readings, numbers)
    }

    /// The readings of a source under a trial with the scatter of the other sources.
    fn of_source(&self, fitted: &Fitted<'_>, source: usize) -> Vec<ScoredReading> {
        let scatter = self.scatter(fitted, source);
        let mut readings = Vec::new();
        for set in self.places(source) {
            let evaluation = fitted.sets[set].clone().with_scatter(scatter);
            let standardised = evaluation.standardised();
            let pairs = Observable::ALL.map(|observable| evaluation.pairs(observable).collect::<Vec<_>>());
            for (place, score) in evaluation.scores().into_iter().enumerate() {
                let row = self.rows[set][place];
                let observable = self.sets[set].observables[row];
                readings.push(ScoredReading {
                    set,
                    row,
                    observable,
                    score,
                    gain: 0.0,
                    pair: pairs[observable as usize][place],
                    inside: standardised[place].map(|distance| distance.abs() <= BAND),
                    in_own_band: None,
                });
            }
        }
        readings
    }

    /// The reference: every reading is the mean of the other sources.
    fn level(&self) -> Scored {
        let mut readings = Vec::new();
        for source in 0..self.sources {
            let values = Observable::ALL.map(|observable| {
                let measured = |set: usize| {
                    let rows = self.rows[set].iter().map(|&row| &self.sets[set].data.rows[row]);
                    rows.filter_map(|row| observable.measured(row)).collect()
                };
                self.mean_of_others(source, measured).unwrap_or(0.5)
            });
            let forecasts =
                self.sets.iter().map(|set| Forecast::stated(vec![prediction(values); set.count()]));
            let trial = Trial { numbers: Vec::new(), forecasts: forecasts.collect() };
            readings.extend(self.of_source(&self.fitted(&trial), source));
        }
        (readings, Vec::new())
    }

    fn entry(
        &self,
        name: &str,
        kind: EntryKind,
        (readings, numbers): &Scored,
        level: &Scored,
        sources: &[String],
    ) -> BenchmarkEntry {
        let of = |wanted: &dyn Fn(&ScoredReading) -> bool| self.measure(readings, wanted);
        debug_assert_eq!(readings.len(), level.0.len(), "the same readings for all");
        let by_observable = Observable::ALL.map(|observable| of(&|one| one.observable == observable));
        let mut sets = Vec::new();
        for (place, set) in self.sets.iter().enumerate() {
            for observable in Observable::ALL {
                let own = |one: &ScoredReading| one.set == place && one.observable == observable;
                let Some(measure) = of(&own) else { continue };
                let pairs = || readings.iter().filter(|one| own(one)).filter_map(|one| one.pair);
                let means = [0, 1].map(|which| mean(pairs().map(|pair| pair[which])).unwrap_or(f64::NAN));
                let (set, source) = (set.name.clone(), sources[set.source].clone());
                sets.push(SetMeasure { set, source, observable: observable.name(), measure, means });
            }
        }
        let own_coverage = mean(readings.iter().filter_map(|one| one.in_own_band).map(f64::from));
        let nothing =
            BenchmarkMeasure { readings: 0, score: 0.0, gain: 0.0, rms: f64::NAN, coverage: f64::NAN };
        BenchmarkEntry {
            name: name.to_owned(),
            kind,
            whole: of(&|_| true).map_or(nothing, |whole| BenchmarkMeasure { rms: f64::NAN, ..whole }),
            by_observable,
            own_coverage,
            numbers: numbers.clone(),
            refusal: None,
            undecided: 0,
            without: None,
            sets,
            readings: readings.clone(),
        }
    }

    /// The means over the sources of some readings; `None` without any.
    fn measure(
        &self,
        readings: &[ScoredReading],
        wanted: &dyn Fn(&ScoredReading) -> bool,
    ) -> Option<BenchmarkMeasure> {
        let of_sources = |value: &dyn Fn(&ScoredReading) -> Option<f64>| {
            let of_source = |source: usize| {
                let own = readings.iter().filter(|one| self.sets[one.set].source == source && wanted(one));
                mean(own.filter_map(value))
            };
            mean((0..self.sources).filter_map(of_source))
        };
        let square = |one: &ScoredReading| {
            let [measured, predicted] = one.pair.filter(|_| one.observable != Observable::Capture)?;
            Some((measured - predicted).powi(2))
        };
        Some(BenchmarkMeasure {
            readings: readings.iter().filter(|one| wanted(one)).count(),
            score: of_sources(&|one| Some(one.score))?,
            gain: of_sources(&|one| Some(one.gain))?,
            rms: of_sources(&square).map_or(f64::NAN, f64::sqrt),
            coverage: of_sources(&|one| Some(f64::from(one.inside?))).unwrap_or(f64::NAN),
        })
    }
}

fn mean(values: impl Iterator<Item = f64>) -> Option<f64> {
    let (sum, count) = values.fold((0.0, 0), |(sum, count), value| (sum + value, count + 1));
    (count > 0).then(|| sum / f64::from(count))
}
