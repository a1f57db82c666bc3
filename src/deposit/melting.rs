//! Melting of powder that is hotter than it melts.
//!
//! The temperature of the powder rises linearly from its cold to its hot side. The part that is hotter
//! than the temperature at which captured particles count as molten becomes melt at once, with its mass.
//! *Assumed*: the heat of fusion is small against what the powder conducts in a step.

use std::sync::Arc;

use super::Deposit;
use super::process::{PowderMaterial, Process, ProcessInfo, Surroundings};

pub(super) const INFO: ProcessInfo =
    ProcessInfo { name: "melting", loss: None, read: |_| Ok(Some(Arc::new(Melting))) };

/// Halvings of a layer in search of the depth at which powder melts.
const BISECTIONS: u32 = 50;

#[derive(Debug)]
struct Melting;

impl Process for Melting {
    fn after(
        &self,
        deposit: &Deposit,
        powder: &dyn PowderMaterial,
        surroundings: &Surroundings,
        _duration: f64,
    ) -> Deposit {
        match surroundings.powder_sides {
            Some(sides) if deposit.powder > 0.0 => {
                deposit.melted(melting_share(|kelvin| powder.melts(deposit.conversion, kelvin), sides))
            }
            _ => *deposit,
        }
    }
}

/// Share of powder [1] that melts, in a layer with these temperatures [K] of its cold and its hot side
/// and a straight line in between.
fn melting_share(melts: impl Fn(f64) -> bool, [cold, hot]: [f64; 2]) -> f64 {
    if !melts(hot) {
        return 0.0;
    }
    if melts(cold) {
        return 1.0;
    }
    let [mut low, mut high] = [0.0, 1.0];
    for _ in 0..BISECTIONS {
        let depth = 0.5 * (low + high);
        if melts(cold + depth * (hot - cold)) { high = depth } else { low = depth }
    }
    1.0 - high
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_hotter_than_its_melting_point_melts() {
        let share = |sides| melting_share(|kelvin| kelvin >= 1500.0, sides);
        assert_eq!([share([1000.0, 1400.0]), share([1500.0, 1600.0])], [0.0, 1.0]);
        assert!((share([1000.0, 2000.0]) - 0.5).abs() < 1e-12);
        assert!((share([1400.0, 1800.0]) - 0.75).abs() < 1e-12);
    }
}
