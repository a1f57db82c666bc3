//! Where a law fails: the ranges of an input in which it scores least beside the level.

use nearwall::impact::{INPUTS, Impact};

use super::score::{BenchmarkEntry, ScoredReading};
use super::{Benchmark, read_set::ReadSet};

/// Parts of the range of an input, with equal shares of the sources.
const PARTS: usize = 3;
/// Least number of readings of a part.
const LEAST_READINGS: usize = 4;

/// A range of an input in which a law scores worse than the level.
#[derive(Debug, Clone)]
pub struct Shortfall {
    /// The input, or `angle from the surface`.
    pub input: &'static str,
    /// Its SI unit.
    pub unit: &'static str,
    /// Least and largest value of the readings in the range.
    pub range: [f64; 2],
    /// Number of readings.
    pub readings: usize,
    /// Mean log score of a reading beyond that of the level [nats], each source counted once.
    pub gain: f64,
}

/// An input over which failures are looked for.
struct Over {
    name: &'static str,
    unit: &'static str,
    /// The input that the table of a set must state.
    needs: &'static str,
    value: fn(&Impact) -> f64,
}

fn inputs() -> Vec<Over> {
    let own = INPUTS.iter().filter(|input| input.name != "v_t");
    let own =
        own.map(|input| Over { name: input.name, unit: input.unit, needs: input.name, value: input.value });
    let angle = |impact: &Impact| impact.angle_from_surface().to_degrees();
    own.chain([Over { name: "angle from the surface", unit: "degrees", needs: "v_t", value: angle }])
        .collect()
}

impl Benchmark {
    /// The range of each input in which an entry of the result scores least beside the level, the worst first.
    #[must_use]
    pub fn shortfalls(&self, entry: &BenchmarkEntry) -> Vec<Shortfall> {
        let own = |one: &&ScoredReading| entry.kind.answers_for(one.observable);
        let readings: Vec<ScoredReading> = entry.readings.iter().filter(own).copied().collect();
        let worst = |over: &Over| {
            let parts = self.parts(over, &readings);
            parts.into_iter().filter(|part| part.gain < 0.0).min_by(|a, b| a.gain.total_cmp(&b.gain))
        };
        let mut found: Vec<Shortfall> = inputs().iter().filter_map(worst).collect();
        found.sort_by(|a, b| a.gain.total_cmp(&b.gain));
        found
    }

    /// Parts of the range of an input; none where it does not vary.
    fn parts(&self, over: &Over, readings: &[ScoredReading]) -> Vec<Shortfall> {
        let set = |one: &ScoredReading| -> &ReadSet { &self.sets[one.set] };
        let states = |one: &&ScoredReading| set(one).states(over.needs);
        let value = |one: &ScoredReading| (over.value)(&set(one).data.rows[one.row].impact);
        let mut counts = vec![0.0; self.sources.len()];
        readings.iter().filter(states).for_each(|one| counts[set(one).source] += 1.0);
        let weight = |one: &ScoredReading| 1.0 / counts[set(one).source];
        let mut own: Vec<(f64, &ScoredReading)> =
            readings.iter().filter(states).map(|one| (value(one), one)).collect();
        own.sort_by(|a, b| a.0.total_cmp(&b.0));
        let total: f64 = own.iter().map(|(_, one)| weight(one)).sum();
        let mut parts: Vec<Vec<(f64, &ScoredReading)>> = vec![Vec::new(); PARTS];
        let mut below = 0.0;
        // Equal values stay in one part.
        for equal in own.chunk_by(|a, b| a.0 == b.0) {
            let here: f64 = equal.iter().map(|(_, one)| weight(one)).sum();
            let part = ((below + 0.5 * here) / total * PARTS as f64) as usize;
            parts[part.min(PARTS - 1)].extend_from_slice(equal);
            below += here;
        }
        if parts.iter().filter(|part| !part.is_empty()).count() < 2 {
            return Vec::new();
        }
        let large = parts.iter().filter(|part| part.len() >= LEAST_READINGS);
        large
            .map(|part| {
                let weights: f64 = part.iter().map(|(_, one)| weight(one)).sum();
                let gain = part.iter().map(|(_, one)| weight(one) * one.gain).sum::<f64>() / weights;
                let range = [part[0].0, part[part.len() - 1].0];
                Shortfall { input: over.name, unit: over.unit, range, readings: part.len(), gain }
            })
            .collect()
    }
}
