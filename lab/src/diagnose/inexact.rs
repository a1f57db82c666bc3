//! A level beside laws, or laws that are not exact?
//!
//! Beside several laws a shift of the level of `e_n` or `e_t` may gain by what the laws get wrong on average. Inexact
//! laws explain the rows on which they act as well; where no law acts, the base model has no shift. So an explanation
//! with a level has a twin without one: the same scores, but those without the level where no law acts.

use super::evaluation::Evaluation;
use super::hypothesis::Hypothesis;
use super::likelihood::{Mean, Scatter};

/// Least number of laws: one law takes on a level as far as it can when both are fitted.
pub(super) const LEAST_LAWS: usize = 2;
/// Key of the twin.
pub(super) const INEXACT: &str = "inexact-laws";
/// A law does not act where it moves the prediction by less than this share of the scatter [1].
const UNMOVED: f64 = 0.1;
/// The same for the probability of capture [1].
const UNMOVED_CAPTURE: f64 = 0.01;

/// What the rows of the search gain if the level acts only where other additions do: `with` has it, `without` has not
/// [nats].
pub(super) fn gains_of_inexact_laws(with: &Hypothesis<'_>, without: &Hypothesis<'_>) -> Vec<f64> {
    let data = with.data;
    let base = Hypothesis::with_parts(data, Vec::new(), with.scatter);
    let [with_level, others, base] = [with, without, &base].map(|one| evaluated(one, with.scatter));
    let acts = |((_, other), (_, base)): ((_, Mean), (_, Mean))| {
        let moved = |which: usize| (other.restitution[which] - base.restitution[which]).abs();
        (0..2).any(|which| moved(which) >= UNMOVED * with.scatter[which])
            || (other.capture - base.capture).abs() >= UNMOVED_CAPTURE
    };
    let acting = others.means().zip(base.means()).map(acts);
    let changes = others.scores().into_iter().zip(with_level.scores()).map(|(without, with)| without - with);
    changes.zip(acting).map(|(change, acts)| if acts { 0.0 } else { change }).collect()
}

/// The rows of the search under a hypothesis, with this scatter.
fn evaluated<'a>(one: &Hypothesis<'a>, scatter: Scatter) -> Evaluation<'a> {
    one.evaluate(&*one.data.search, one.offsets()).with_scatter(scatter)
}
