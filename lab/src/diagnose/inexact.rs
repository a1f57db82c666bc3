//! A level beside laws, or laws that are not exact?
//!
//! Beside several laws a shift of the level of `e_n` or `e_t` may gain by what the laws get wrong on average. Inexact
//! laws explain the rows on which they act as well; where no law acts, the base model has no shift. So an explanation
//! with a level has a twin without one: the same scores, but those without the level where no law acts.

use super::hypothesis::Hypothesis;
use super::likelihood::Mean;

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
    let evaluate = |one: &Hypothesis<'_>| -> (Vec<Mean>, Vec<f64>) {
        let evaluation = one.evaluate(&*data.search, one.offsets()).with_scatter(with.scatter);
        (evaluation.means().map(|(_, mean)| mean).collect(), evaluation.scores())
    };
    let (_, with_level) = evaluate(with);
    let (others, without_level) = evaluate(without);
    let (base, _) = evaluate(&Hypothesis::with_parts(data, Vec::new(), with.scatter));
    let gain = |place: usize| {
        let (other, base) = (&others[place], &base[place]);
        let moved = |which: usize| (other.restitution[which] - base.restitution[which]).abs();
        let is_alone = (0..2).all(|which| moved(which) < UNMOVED * with.scatter[which])
            && (other.capture - base.capture).abs() < UNMOVED_CAPTURE;
        if is_alone { without_level[place] - with_level[place] } else { 0.0 }
    };
    (0..base.len()).map(gain).collect()
}
