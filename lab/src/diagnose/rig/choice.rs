//! The choice of causes: round after round the candidate that explains most beside what was found.

use std::cell::LazyCell;
use std::sync::{Arc, Mutex, PoisonError};

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use super::super::search::descend;
use super::addition::{RigAddition, moved};
use super::candidates::{candidates, unchanged_inputs};
use super::noise::{Data, PreparedReadings, ReadingValues};
use super::prediction_table::{PredictionTable, TabledCandidate, predict};
use super::significance::NullGains;
use crate::rig::{Forward, PredictedReading, PredictionError};

/// Resamples for the certainty of a cause.
const CERTAINTY_RESAMPLES: usize = 200;
/// A resample names a cause that gains this share of what the best candidate does [1].
const NEARLY_BEST: f64 = 0.75;
/// Candidates whose best place gains less than the best one by more than this are not fitted [nats].
const SHORTLIST: f64 = 4.0;
/// Most laws, and most curves that are fitted.
const MOST_FITTED: [(bool, usize); 2] = [(false, 7), (true, 2)];
/// And those that gain this share of the best are fitted.
const PROMISING_SHARE: f64 = 0.4;
/// Gain below which no candidate of a usual list is significant [nats].
const LEAST_THRESHOLD: f64 = 2.0;
/// Gain by which a cause must lead another one to be told from it [nats]: a ratio of likelihoods of 7.
pub(super) const DISTINGUISHABLE_GAIN: f64 = 2.0;
/// What a curve must gain beyond a law to be named before it [nats].
const BEYOND_LAWS: f64 = 3.0;
/// What is left to gain from which on causes are exchanged [nats].
const ROOM_TO_EXCHANGE: f64 = 6.0;
/// Largest number of other first causes that are tried. A start with the numbers that are usually
/// fitted is tried beside them.
const OTHER_STARTS: usize = 3;
/// Gain for which a cause is exchanged [nats].
const EXCHANGED: f64 = 1.5;
/// Difference in gain below which the candidate with fewer parameters is taken, and of these a
/// number of the base's own laws [nats].
const EQUAL_GAIN: f64 = 0.5;
/// What a law that is not in the model yet must gain beyond one of its numbers to be named first,
/// and what it must gain beyond that if no experiment changes one of its inputs on purpose [nats]:
/// odds of 3 to 1 each. Over such an input a law is hardly more than a level.
const NEW_LAW: f64 = 1.1;
const UNCHANGED: f64 = 1.1;
/// One cause, and one more for so many readings; and most causes.
const READINGS_A_CAUSE: usize = 3;
const MOST_RIG_CAUSES: usize = 5;
/// Most candidates kept of a round that finds none significant.
const HINTS: usize = 4;
/// First size of the simplex, and iterations a parameter: for a law that is to be compared with
/// others first, and for one that is promising.
const FIT_SIMPLEX: f64 = 0.08;
const FIRST_ITERATIONS: u64 = 8;
const FIT_ITERATIONS: u64 = 25;

/// A fitted candidate.
#[derive(Debug, Clone)]
pub(super) struct Scored {
    /// Fitted together with what was found before.
    pub addition: RigAddition,
    /// What was found before, with the numbers of that fit; empty before it.
    beside: Vec<RigAddition>,
    /// Gain in log likelihood less the number of parameters [nats].
    pub gain: f64,
    /// Corrected for all candidates.
    pub p_value: f64,
    /// Its predictions.
    prepared: Option<Arc<PreparedReadings>>,
}

/// A round that found a cause.
#[derive(Debug, Clone)]
pub(super) struct RigRound {
    pub winner: Scored,
    /// The other fitted candidates, the best first.
    pub others: Vec<Scored>,
    /// Share of resampled experiments that name the winner.
    pub certainty: f64,
}

impl RigRound {
    /// Whether a candidate can be another cause than the winner, and not only a freer form of it.
    pub fn is_rival(&self, other: &Scored) -> bool {
        // A free curve over an input contains the laws over it.
        let own = self.winner.addition.variables();
        let inputs = other.addition.variables();
        let freer = inputs.is_empty() || inputs.iter().any(|input| own.contains(input));
        !(other.addition.is_curve() && freer)
    }

    /// The candidates that the winner could be mistaken for and that gain at most `behind` less
    /// than it [nats], the best first.
    pub fn rivals(&self, behind: f64) -> impl Iterator<Item = &Scored> {
        let close = move |one: &&Scored| one.gain > self.winner.gain - behind;
        self.others.iter().filter(close).filter(|one| self.is_rival(one))
    }

    /// All fitted candidates.
    fn all(&self) -> Vec<Scored> {
        std::iter::once(&self.winner).chain(&self.others).cloned().collect()
    }
}

/// What was chosen.
#[derive(Debug, Clone)]
pub(super) struct RigChoice {
    /// Fitted together.
    pub additions: Vec<RigAddition>,
    pub rounds: Vec<RigRound>,
    /// Smallest corrected p-value of a candidate beside the base model, and beside the additions.
    pub structure: [f64; 2],
    /// The best candidates of the last round, which found none significant; the best first.
    pub hints: Vec<Scored>,
}

/// What all choices share.
pub(super) struct RigStudy<'a> {
    pub forward: &'a dyn Forward,
    pub data: Data,
    /// Accepted share of false discoveries [1].
    pub level: f64,
    pub seed: u64,
    pub progress: &'a (dyn Fn() + Sync),
    /// Inputs that vary over the impacts of an experiment, but not from one experiment to the other.
    unchanged: Vec<&'static str>,
    /// Predictions of the candidates beside causes, by the names of these.
    tables: Mutex<Vec<(Vec<String>, Arc<PredictionTable>)>>,
}

impl<'a> RigStudy<'a> {
    /// The study of the readings of a forward model.
    ///
    /// # Errors
    /// Why the base model cannot decide an impact.
    pub fn new(
        forward: &'a dyn Forward,
        level: f64,
        seed: u64,
        progress: &'a (dyn Fn() + Sync),
    ) -> Result<Self, PredictionError> {
        let data = Data::new(forward.experiments(), &predict(forward, &[])?);
        let unchanged = unchanged_inputs(forward);
        Ok(Self { forward, data, level, seed, progress, unchanged, tables: Mutex::default() })
    }

    /// The predictions of all candidates beside these additions. A later call with the same causes
    /// gets the same predictions, whatever the values of their parameters: where they were computed
    /// matters little to a choice.
    pub fn table(&self, additions: &[RigAddition]) -> Result<Arc<PredictionTable>, PredictionError> {
        let names: Vec<String> = additions.iter().map(RigAddition::key).collect();
        let mut tables = self.tables.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, table)) = tables.iter().find(|(known, _)| *known == names) {
            return Ok(Arc::clone(table));
        }
        let candidates = candidates(self.forward, &self.data, &names);
        let table =
            Arc::new(PredictionTable::new(self.forward, &self.data, additions, candidates, self.progress)?);
        tables.push((names, Arc::clone(&table)));
        Ok(table)
    }

    /// Log likelihood of the measured values with these additions [nats]; minus infinity where the
    /// model refuses an impact.
    pub fn score(&self, additions: &[RigAddition], weights: &[f64]) -> f64 {
        let Ok(predicted) = predict(self.forward, additions) else { return f64::NEG_INFINITY };
        self.score_of(&predicted, weights)
    }

    pub fn score_of(&self, predicted: &[PredictedReading], weights: &[f64]) -> f64 {
        self.data.score(&self.data.prepare(predicted), &self.data.values(), weights)
    }

    /// Chooses causes on experiments with these weights, 0 or 1.
    ///
    /// # Errors
    /// Why the base model cannot decide an impact.
    pub fn choose(&self, weights: &[f64]) -> Result<RigChoice, PredictionError> {
        let nothing =
            RigChoice { additions: Vec::new(), rounds: Vec::new(), structure: [1.0; 2], hints: Vec::new() };
        let first = self.grown(nothing.clone(), weights, &|_| true)?;
        if first.rounds.len() < 2 {
            return Ok(self.without_redundant(first, weights));
        }
        let numbers = LazyCell::new(|| self.grown(nothing.clone(), weights, &RigAddition::is_usual_number));
        let mut best = first;
        if best.additions.iter().any(RigAddition::is_curve) {
            // A curve over an input takes what several laws explain together.
            for start in [nothing.clone(), LazyCell::force(&numbers).clone()?] {
                let laws = self.grown(start, weights, &|one| !one.is_curve())?;
                let grown = self.grown(laws, weights, &|_| true)?;
                if self.worth(&grown.additions, weights) > self.worth(&best.additions, weights) - EXCHANGED {
                    best = grown;
                }
            }
        }
        if self.room(&best.additions, weights)? > ROOM_TO_EXCHANGE {
            let exchanged = self.exchanged(best.clone(), weights)?;
            let others = other_starts(&best);
            best = self.grown(exchanged, weights, &|_| true)?;
            let numbers_first = std::iter::once_with(|| LazyCell::force(&numbers).clone());
            let mut starts = numbers_first.chain(others.into_iter().take(OTHER_STARTS).map(Ok));
            while self.room(&best.additions, weights)? >= ROOM_TO_EXCHANGE
                && let Some(start) = starts.next()
            {
                let start = start?;
                let start = RigChoice { additions: self.fit(&start.additions, weights), ..start };
                let grown = self.grown(start, weights, &|_| true)?;
                if self.worth(&grown.additions, weights) > self.worth(&best.additions, weights) + EXCHANGED {
                    best = grown;
                }
            }
        }
        Ok(self.without_redundant(best, weights))
    }

    /// Log likelihood less the number of parameters and what each addition must gain to be believed [nats].
    fn worth(&self, additions: &[RigAddition], weights: &[f64]) -> f64 {
        let cost = |one: &RigAddition| one.axes.len() as f64 + self.surprise(one);
        self.score(additions, weights) - additions.iter().map(cost).sum::<f64>()
    }

    /// What an addition must gain beyond a number of the model's own laws to be named before it [nats].
    fn surprise(&self, addition: &RigAddition) -> f64 {
        let over = addition.variables();
        let idle = over.iter().filter(|input| self.unchanged.contains(&input.as_str())).count();
        let new = if addition.is_number() { 0.0 } else { NEW_LAW };
        new + UNCHANGED * idle as f64 + if addition.is_curve() { BEYOND_LAWS } else { 0.0 }
    }

    /// The choice with further causes of those `allowed`, one a round, until none is significant.
    fn grown(
        &self,
        mut choice: RigChoice,
        weights: &[f64],
        allowed: &dyn Fn(&RigAddition) -> bool,
    ) -> Result<RigChoice, PredictionError> {
        let most = MOST_RIG_CAUSES.min(1 + self.data.count(weights) / READINGS_A_CAUSE);
        let most = most.min(self.forward.most_causes());
        // What the largest gain without an effect has to be exceeded by; known after the first round.
        let mut threshold = LEAST_THRESHOLD;
        loop {
            if self.room(&choice.additions, weights)? < threshold {
                choice.structure[1] = 1.0;
                return Ok(choice);
            }
            let table = self.table(&choice.additions)?;
            let null = NullGains::new(&table, &self.data, weights, self.seed);
            threshold = null.quantile(1.0 - self.level);
            let mut scored = self.first_look(&table, &null, weights, &[]);
            scored.retain(|one| allowed(&one.addition));
            let least = scored.iter().map(|one| one.p_value).fold(1.0, f64::min);
            choice.structure[1] = least;
            if choice.rounds.is_empty() {
                choice.structure[0] = least;
            }
            if least > self.level || choice.rounds.len() >= most {
                choice.hints = scored.into_iter().filter(|one| one.gain > 0.0).take(HINTS).collect();
                return Ok(choice);
            }
            let fitted = self.fit_all(&choice.additions, &scored, weights);
            let Some(round) = self.decide(&table, fitted, weights) else { return Ok(choice) };
            choice.additions = round.winner.beside.clone();
            choice.additions.push(round.winner.addition.clone());
            choice.rounds.push(round);
        }
    }

    /// The choice with causes exchanged for others that explain more together with the rest: the
    /// first cause was chosen alone.
    fn exchanged(&self, mut choice: RigChoice, weights: &[f64]) -> Result<RigChoice, PredictionError> {
        let mut place = 0;
        while choice.additions.len() > 1 && place < choice.additions.len() {
            let mut rest = choice.additions.clone();
            let removed = rest.remove(place);
            let table = self.table(&rest)?;
            let null = NullGains::new(&table, &self.data, weights, self.seed);
            let scored = self.first_look(&table, &null, weights, &[]);
            let fitted = self.fit_all(&rest, &scored, weights);
            let now = self.worth(&choice.additions, weights);
            let better = fitted.iter().find(|one| one.addition.key() != removed.key()).and_then(|one| {
                let joint =
                    self.fit(&[rest.as_slice(), std::slice::from_ref(&one.addition)].concat(), weights);
                (self.worth(&joint, weights) > now + EXCHANGED).then_some(joint)
            });
            match better.and_then(|joint| Some((joint, self.decide(&table, fitted, weights)?))) {
                Some((joint, round))
                    if joint.last().map(RigAddition::key) == Some(round.winner.addition.key()) =>
                {
                    choice.rounds.remove(place);
                    choice.additions = joint;
                    choice.rounds.push(round);
                    place = 0;
                }
                _ => place += 1,
            }
        }
        Ok(choice)
    }

    /// What any candidate can still gain: up to predictions that equal the measured values [nats].
    fn room(&self, additions: &[RigAddition], weights: &[f64]) -> Result<f64, PredictionError> {
        let predicted = predict(self.forward, additions)?;
        Ok(self.data.room(&predicted, weights))
    }

    /// The causes that experiments with these weights name, one after the other as in the choice on
    /// all experiments: with the predictions that were computed for it, each cause at its best
    /// place, at most `most`. After a cause that the whole choice does not have there is no further
    /// one.
    ///
    /// # Errors
    /// Why the base model cannot decide an impact.
    pub fn choose_again(
        &self,
        whole: &RigChoice,
        most: usize,
        weights: &[f64],
    ) -> Result<Vec<RigAddition>, PredictionError> {
        let mut additions: Vec<RigAddition> = Vec::new();
        for round in 0..most.min(whole.rounds.len()) {
            let table = self.table(&additions)?;
            let null = NullGains::new(&table, &self.data, weights, self.seed);
            let known = whole.rounds.get(round).map_or(Vec::new(), RigRound::all);
            let scored = self.first_look(&table, &null, weights, &known);
            if scored.first().is_none_or(|best| best.p_value > self.level) {
                break;
            }
            let promising: Vec<Scored> = scored.into_iter().filter(|one| one.gain > 0.0).collect();
            let Some(winner) = self.winner(&promising) else { break };
            match whole.additions.iter().find(|known| known.key() == winner.addition.key()) {
                Some(known) => additions.push(known.clone()),
                None => {
                    additions.push(winner.addition);
                    break;
                }
            }
        }
        Ok(additions)
    }

    /// The candidates at their best places, of the table and of earlier fits.
    fn first_look(
        &self,
        table: &PredictionTable,
        null: &NullGains,
        weights: &[f64],
        known: &[Scored],
    ) -> Vec<Scored> {
        let values = self.data.values();
        let base = self.data.score(&table.base_prepared, &values, weights);
        let one = |candidate: &TabledCandidate| {
            let (score, at) = self.best(candidate, &values, weights, known);
            let gain = score - base - candidate.cost();
            let addition = candidate.addition.moved(at);
            Scored { addition, beside: Vec::new(), gain, p_value: null.p_value(gain), prepared: None }
        };
        let mut all: Vec<Scored> = table.candidates.iter().map(one).collect();
        all.sort_by(|a, b| b.gain.total_cmp(&a.gain));
        all
    }

    /// The best of the places of a candidate and of its earlier fit, with its log likelihood [nats].
    fn best<'b>(
        &self,
        candidate: &'b TabledCandidate,
        values: &ReadingValues,
        weights: &[f64],
        known: &'b [Scored],
    ) -> (f64, &'b [f64]) {
        let (score, place) = candidate.best(&self.data, values, weights);
        let key = candidate.addition.key();
        let fitted = known.iter().find(|one| one.addition.key() == key);
        let fitted = fitted.and_then(|one| {
            let prepared = one.prepared.as_ref()?;
            Some((self.data.score(prepared, values, weights), one.addition.at.as_slice()))
        });
        match fitted {
            Some((own, at)) if own > score => (own, at),
            _ => (score, &place.at),
        }
    }

    /// The promising candidates, each fitted together with the additions.
    fn fit_all(&self, additions: &[RigAddition], scored: &[Scored], weights: &[f64]) -> Vec<Scored> {
        let base = self.score(additions, weights);
        let improved = |one: &Scored, iterations: u64| {
            let joint = |at: &[f64]| {
                let mut all = additions.to_vec();
                all.push(one.addition.moved(at));
                -self.score(&all, weights)
            };
            let start = one.addition.at.clone();
            let (at, cost) = descend(joint, &start, FIT_SIMPLEX, iterations * start.len() as u64);
            (self.progress)();
            let gain = -cost - base - start.len() as f64;
            Scored { addition: one.addition.moved(&at), gain, ..one.clone() }
        };
        // The places are coarse: where an effect is strong, the best law may lie between them and seem worse than none.
        let mut scored: Vec<Scored> = scored
            .iter()
            .map(|one| if one.addition.is_curve() { one.clone() } else { improved(one, FIRST_ITERATIONS) })
            .collect();
        scored.sort_by(|a, b| b.gain.total_cmp(&a.gain));
        let promising = MOST_FITTED.map(|(curve, most)| {
            let mut own =
                scored.iter().filter(move |one| one.addition.is_curve() == curve).cloned().peekable();
            let best = own.peek().map_or(0.0, |one| one.gain);
            let least = (best - SHORTLIST).min(PROMISING_SHARE * best);
            own.filter(move |one| one.gain > least).take(most).collect::<Vec<Scored>>()
        });
        // A number of the base's own laws is the simplest explanation, and cheap to fit.
        let mut promising: Vec<Scored> = promising.into_iter().flatten().collect();
        let numbers = scored.iter().filter(|one| one.addition.is_number() && one.gain > 0.0);
        let left_out: Vec<Scored> = numbers
            .filter(|one| promising.iter().all(|p| p.addition.key() != one.addition.key()))
            .cloned()
            .collect();
        promising.extend(left_out);
        // What was found before took part of this candidate's effect: the numbers are only right together.
        let fit = |one: Scored| {
            let alone = improved(&one, FIT_ITERATIONS);
            let mut all = [additions, std::slice::from_ref(&alone.addition)].concat();
            if !additions.is_empty() {
                all = self.fit(&all, weights);
            }
            let predicted = predict(self.forward, &all).ok();
            let prepared = predicted.map(|predicted| Arc::new(self.data.prepare(&predicted)));
            let gain = self.score(&all, weights) - base - alone.addition.axes.len() as f64;
            let Some(addition) = all.pop() else { return alone };
            Scored { addition, beside: all, gain, prepared, ..alone }
        };
        let mut fitted: Vec<Scored> = promising.into_iter().map(fit).collect();
        fitted.retain(|one| one.gain > 0.0);
        fitted.sort_by(|a, b| b.gain.total_cmp(&a.gain));
        fitted
    }

    /// The round with its winner and all others.
    fn decide(&self, table: &PredictionTable, fitted: Vec<Scored>, weights: &[f64]) -> Option<RigRound> {
        let winner = self.winner(&fitted)?;
        let name = winner.addition.key();
        let certainty = self.certainty(table, &name, weights, &fitted);
        let others = fitted.into_iter().filter(|one| one.addition.key() != name).collect();
        Some(RigRound { winner, others, certainty })
    }

    /// The winner of a round; of equal ones that with fewest parameters.
    fn winner(&self, fitted: &[Scored]) -> Option<Scored> {
        let worth = |one: &Scored| one.gain - self.surprise(&one.addition);
        let best = fitted.iter().map(worth).fold(f64::NEG_INFINITY, f64::max);
        let equal = fitted.iter().filter(|one| worth(one) > best - EQUAL_GAIN);
        equal.min_by_key(|one| (one.addition.axes.len(), !one.addition.is_number())).cloned()
    }

    /// Share of resampled experiments in which the candidate gains nearly as much as the best one.
    fn certainty(&self, table: &PredictionTable, name: &str, weights: &[f64], fitted: &[Scored]) -> f64 {
        let values = self.data.values();
        let inside: Vec<usize> = (0..weights.len()).filter(|&i| weights[i] > 0.0).collect();
        let mut named = 0;
        for number in 0..CERTAINTY_RESAMPLES as u64 {
            let mut random = ChaCha8Rng::seed_from_u64(self.seed ^ 0x7265_7361);
            random.set_stream(number);
            let mut drawn = vec![0.0; weights.len()];
            for _ in 0..inside.len() {
                drawn[inside[(random.next_u64() % inside.len() as u64) as usize]] += 1.0;
            }
            let base = self.data.score(&table.base_prepared, &values, &drawn);
            let gain = |candidate: &TabledCandidate| {
                self.best(candidate, &values, &drawn, fitted).0 - base - candidate.cost()
            };
            // A free curve contains every law over its input, so it is no rival of them.
            let rivals =
                table.candidates.iter().filter(|c| !c.addition.is_curve() || c.addition.key() == name);
            let best = rivals.map(gain).fold(f64::NEG_INFINITY, f64::max);
            let own = table.candidates.iter().filter(|c| c.addition.key() == name).map(gain);
            let own = own.fold(f64::NEG_INFINITY, f64::max);
            named += u64::from(own > 0.0 && own >= NEARLY_BEST * best);
        }
        named as f64 / CERTAINTY_RESAMPLES as f64
    }

    /// Fits all parameters together, from their present values.
    pub fn fit(&self, additions: &[RigAddition], weights: &[f64]) -> Vec<RigAddition> {
        let start: Vec<f64> = additions.iter().flat_map(|addition| addition.at.clone()).collect();
        if start.is_empty() {
            return additions.to_vec();
        }
        let cost = |at: &[f64]| -self.score(&moved(additions, at), weights);
        let (at, _) = descend(cost, &start, 0.5 * FIT_SIMPLEX, FIT_ITERATIONS * start.len() as u64);
        moved(additions, &at)
    }

    /// The choice without causes that later ones made superfluous.
    fn without_redundant(&self, mut choice: RigChoice, weights: &[f64]) -> RigChoice {
        for place in (0..choice.additions.len().saturating_sub(1)).rev() {
            let mut rest = choice.additions.clone();
            let removed = rest.remove(place);
            let rest = self.fit(&rest, weights);
            let loss = self.score(&choice.additions, weights) - self.score(&rest, weights);
            if loss < 1.0 + removed.axes.len() as f64 {
                choice.additions = rest;
                choice.rounds.remove(place);
            }
        }
        choice
    }
}

/// For each round a choice that starts with the next best law in place of the winner.
fn other_starts(choice: &RigChoice) -> Vec<RigChoice> {
    let mut starts = Vec::new();
    for (place, round) in choice.rounds.iter().enumerate() {
        let laws = round.others.iter().filter(|other| !other.addition.is_curve() && other.gain > 0.0);
        if let Some(other) = laws.clone().next() {
            let mut rounds = choice.rounds[..place].to_vec();
            let mut additions: Vec<RigAddition> =
                rounds.iter().map(|round| round.winner.addition.clone()).collect();
            additions.push(other.addition.clone());
            let others = round.all().into_iter().filter(|one| one.addition.key() != other.addition.key());
            rounds.push(RigRound {
                winner: other.clone(),
                others: others.collect(),
                certainty: round.certainty,
            });
            starts.push(RigChoice { additions, rounds, ..choice.clone() });
        }
    }
    starts
}
