//! Explanations of data, their evidence, and the search among them: the same for measured impacts and for a rig.
//!
//! An explanation is the base model with additions, or the same data read otherwise. Its evidence is
//! the probability of the data under it with its parameters integrated out. With `n` readings whose
//! noise is fitted, `k` parameters and the gain `G` in log likelihood over the base model, and a
//! normal prior that weighs as much as one reading (g prior with `g = n`; Liang et al. 2008):
//! `½ (n-1-k) ln(1+n) - ½ (n-1) ln(1 + n exp(-2G/n))`, which for many readings is `G - ½ k ln n`
//! (Schwarz 1978) and for few is bounded, however well they are met. Where the noise is stated it is
//! `G - ½ k ln(1+n)`.
//!
//! The search expands explanations within Occam's window (Madigan and Raftery 1994) of the best one
//! that needs no more additions: by every addition, and by leaving out each of those that it has.
//! One with more additions closes no window: where two explain a first observable alike, the second
//! observable is asked of both, and not only of the one that led by chance.

/// Ratio of evidence beyond which an explanation is not pursued, as a logarithm [nats]: 20 to 1.
pub(super) const WINDOW: f64 = 3.0;

/// An explanation with everything fitted.
#[derive(Debug, Clone)]
pub(super) struct Explanation<F> {
    /// What it adds, in alphabetical order: this tells it from other explanations.
    pub keys: Vec<String>,
    pub fitted: F,
    /// Log likelihood of each row or experiment [nats].
    pub scores: Vec<f64>,
    /// Number of fitted parameters.
    pub freedom: f64,
    /// Logarithm of the prior probability [nats].
    pub log_prior: f64,
}

impl<F> Explanation<F> {
    /// Log likelihood [nats].
    pub fn score(&self) -> f64 {
        self.scores.iter().sum()
    }
}

/// What turns a log likelihood into evidence.
#[derive(Debug, Clone, Copy)]
pub(super) struct Evidence {
    /// Log likelihood of the base model [nats].
    pub base: f64,
    /// Number of readings.
    pub readings: f64,
    /// Whether the noise of all readings is stated.
    pub stated: bool,
}

impl Evidence {
    /// Log evidence over that of the base model, with the prior [nats].
    pub fn of<F>(&self, explanation: &Explanation<F>) -> f64 {
        self.gain(explanation.score(), explanation.freedom) + explanation.log_prior
    }

    /// The same without the prior, of a log likelihood [nats] with so many parameters.
    pub fn gain(&self, score: f64, freedom: f64) -> f64 {
        let (gain, n) = (score - self.base, self.readings);
        if self.stated {
            return gain - 0.5 * freedom * (1.0 + n).ln();
        }
        let left = n - 1.0 - freedom;
        if left <= 0.0 {
            return f64::NEG_INFINITY;
        }
        0.5 * left * (1.0 + n).ln() - 0.5 * (n - 1.0) * (n * (-2.0 * gain / n).exp()).ln_1p()
    }
}

/// A kind of data among whose explanations is searched.
pub(super) trait Explained {
    /// What is fitted.
    type Fitted: Clone;

    fn evidence(&self) -> Evidence;

    /// Effort of an expansion, in that of the base model.
    fn effort(&self, of: &Explanation<Self::Fitted>) -> usize;

    /// The explanation with one addition more, each promising one fitted.
    fn extended(&self, of: &Explanation<Self::Fitted>) -> Vec<Explanation<Self::Fitted>>;

    /// The explanation without one of its additions; `known` tells those that need no fit.
    fn reduced(
        &self,
        of: &Explanation<Self::Fitted>,
        known: &dyn Fn(&[String]) -> bool,
    ) -> Vec<Explanation<Self::Fitted>>;
}

/// All explanations that the search visits from `starts`, the one with the largest evidence first. It expands
/// until the effort reaches `most`.
pub(super) fn explore<K: Explained>(
    kind: &K,
    starts: Vec<Explanation<K::Fitted>>,
    most: usize,
) -> Vec<Explanation<K::Fitted>> {
    let mut search = Exploration::new(starts, kind.evidence());
    search.expand(kind, most);
    search.finish(kind)
}

/// A search that can be stopped, told further explanations, and go on.
pub(super) struct Exploration<F> {
    visited: Vec<Explanation<F>>,
    /// Keys of the explanations that were expanded.
    expanded: Vec<Vec<String>>,
    /// Effort so far.
    spent: usize,
    evidence: Evidence,
}

impl<F: Clone> Exploration<F> {
    pub fn new(starts: Vec<Explanation<F>>, evidence: Evidence) -> Self {
        let mut new = Self { visited: Vec::new(), expanded: Vec::new(), spent: 0, evidence };
        new.add(starts);
        new
    }

    pub fn visited(&self) -> &[Explanation<F>] {
        &self.visited
    }

    /// Adds explanations; of two with the same additions the better fit stays.
    pub fn add(&mut self, found: impl IntoIterator<Item = Explanation<F>>) {
        found.into_iter().for_each(|one| add(&mut self.visited, one, self.evidence));
    }

    /// Expands until the effort reaches `most`.
    pub fn expand(&mut self, kind: &impl Explained<Fitted = F>, most: usize) {
        while self.spent < most
            && let Some(next) = next(&self.visited, &self.expanded, self.evidence)
        {
            self.spent += kind.effort(&next);
            self.expanded.push(next.keys.clone());
            let known = |keys: &[String]| self.visited.iter().any(|one| one.keys == keys);
            let reduced = kind.reduced(&next, &known);
            self.add(kind.extended(&next).into_iter().chain(reduced));
        }
    }

    /// All that was visited and what the parts of the best one lead to, the one with the largest evidence first.
    pub fn finish(mut self, kind: &impl Explained<Fitted = F>) -> Vec<Explanation<F>> {
        for part in parts_of_best(&self.visited, &self.expanded, self.evidence) {
            if kind.effort(&part) == 1 {
                self.add(kind.extended(&part));
            }
        }
        let evidence = self.evidence;
        self.visited.sort_by(|a, b| evidence.of(b).total_cmp(&evidence.of(a)));
        self.visited
    }
}

/// The best explanation without each of its additions, as far as known and not expanded: what gains little alone, since
/// another addition is missing, may take the place of one that gains more alone.
fn parts_of_best<F: Clone>(
    visited: &[Explanation<F>],
    expanded: &[Vec<String>],
    evidence: Evidence,
) -> Vec<Explanation<F>> {
    let best = visited.iter().max_by(|a, b| evidence.of(a).total_cmp(&evidence.of(b)));
    let keys = best.map_or(&[][..], |best| &best.keys);
    let without = |place: usize| [&keys[..place], &keys[place + 1..]].concat();
    let parts = (0..keys.len()).map(without).filter(|part| !part.is_empty() && !expanded.contains(part));
    parts.filter_map(|part| visited.iter().find(|one| one.keys == part).cloned()).collect()
}

/// The explanation that is expanded next.
fn next<F: Clone>(
    visited: &[Explanation<F>],
    expanded: &[Vec<String>],
    evidence: Evidence,
) -> Option<Explanation<F>> {
    // The base model as it is comes first, whatever a rival gains.
    if let Some(base) = visited.iter().find(|one| one.keys.is_empty() && expanded.is_empty()) {
        return Some(base.clone());
    }
    let worth: Vec<f64> = visited.iter().map(|one| evidence.of(one)).collect();
    let behind = |place: usize| {
        let smaller =
            visited.iter().zip(&worth).filter(|(one, _)| one.keys.len() <= visited[place].keys.len());
        smaller.map(|(_, worth)| *worth).fold(f64::NEG_INFINITY, f64::max) - worth[place]
    };
    let all = visited.iter().enumerate().map(|(place, one)| (behind(place), worth[place], one));
    let open = all.filter(|(behind, _, one)| *behind < WINDOW && !expanded.contains(&one.keys));
    let first = open.min_by(|a, b| a.0.total_cmp(&b.0).then(b.1.total_cmp(&a.1)));
    first.map(|(.., one)| one.clone())
}

/// Adds an explanation; of two with the same additions the better fit stays.
fn add<F>(visited: &mut Vec<Explanation<F>>, mut new: Explanation<F>, evidence: Evidence) {
    new.keys.sort();
    if evidence.of(&new).is_nan() {
        return;
    }
    match visited.iter_mut().find(|one| one.keys == new.keys) {
        Some(known) if evidence.of(known) >= evidence.of(&new) => {}
        Some(known) => *known = new,
        None => visited.push(new),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn evidence(readings: f64, stated: bool) -> Evidence {
        Evidence { base: 0.0, readings, stated }
    }

    /// Of many readings the evidence is that of Schwarz; five readings met exactly say at most
    /// `6^1.5` to one for one parameter.
    #[test]
    fn evidence_has_its_limits() {
        let many = evidence(1e6, false).gain(30.0, 3.0) - (30.0 - 1.5 * f64::ln(1e6));
        assert!(many.abs() < 0.02, "{many}");
        let few = evidence(5.0, false).gain(1e3, 1.0);
        assert!((few - 1.5 * f64::ln(6.0)).abs() < 1e-9, "{few}");
        assert_eq!(evidence(5.0, false).gain(0.0, 0.0), 0.0);
        assert!(evidence(5.0, false).gain(1e3, 4.0).is_infinite());
    }

    /// Additions a, b and c of which a and b are true.
    struct Planted;

    impl Explained for Planted {
        type Fitted = ();

        fn evidence(&self) -> Evidence {
            evidence(100.0, true)
        }

        fn effort(&self, _: &Explanation<()>) -> usize {
            1
        }

        fn extended(&self, of: &Explanation<()>) -> Vec<Explanation<()>> {
            let with = |key: &&str| {
                let mut keys = of.keys.clone();
                keys.push((*key).to_owned());
                explained(keys)
            };
            ["a", "b", "c"].iter().filter(|key| !of.keys.contains(&(**key).to_owned())).map(with).collect()
        }

        fn reduced(&self, of: &Explanation<()>, known: &dyn Fn(&[String]) -> bool) -> Vec<Explanation<()>> {
            let without = |place: usize| {
                let mut keys = of.keys.clone();
                keys.remove(place);
                keys
            };
            (0..of.keys.len()).map(without).filter(|keys| !known(keys)).map(explained).collect()
        }
    }

    /// The truth is a and b; c gains most alone.
    fn explained(keys: Vec<String>) -> Explanation<()> {
        let has = |key: &str| keys.iter().any(|own| own == key);
        let score = match (has("a"), has("b"), has("c")) {
            (true, true, _) => 60.0,
            (true, false, true) | (false, true, true) => 50.0,
            (_, _, true) => 45.0,
            (true, false, false) | (false, true, false) => 30.0,
            (false, false, false) => 0.0,
        };
        Explanation { freedom: keys.len() as f64, keys, fitted: (), scores: vec![score], log_prior: 0.0 }
    }

    #[test]
    fn what_gains_most_alone_is_left_out_later() {
        let found = explore(&Planted, vec![explained(Vec::new())], 8);
        assert_eq!(found[0].keys, ["a", "b"]);
    }

    /// Two groups, `k` and `w`, that explain restitution alike; captures are explained best by `w`.
    struct Twins;

    impl Explained for Twins {
        type Fitted = ();

        fn evidence(&self) -> Evidence {
            evidence(100.0, true)
        }

        fn effort(&self, _: &Explanation<()>) -> usize {
            1
        }

        fn extended(&self, of: &Explanation<()>) -> Vec<Explanation<()>> {
            let with = |key: &str| Explanation {
                keys: [of.keys.clone(), vec![key.to_owned()]].concat(),
                ..of.clone()
            };
            let scored =
                |(key, score): (&str, f64)| Explanation { scores: vec![score], freedom: 1.0, ..with(key) };
            let next: &[(&str, f64)] = match of.keys.first().map(String::as_str) {
                None => &[("k", 50.0), ("w", 49.0)],
                Some("k") if of.keys.len() == 1 => &[("k2", 80.0)],
                Some("w") if of.keys.len() == 1 => &[("w2", 90.0)],
                _ => &[],
            };
            next.iter().copied().map(scored).collect()
        }

        fn reduced(&self, _: &Explanation<()>, _: &dyn Fn(&[String]) -> bool) -> Vec<Explanation<()>> {
            Vec::new()
        }
    }

    #[test]
    fn what_follows_is_asked_of_both_twins() {
        let found = explore(&Twins, vec![explained(Vec::new())], 4);
        assert_eq!(found[0].keys, ["w", "w2"]);
    }
}
