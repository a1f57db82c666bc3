//! Melting and freezing of a deposit: what [`super::front`] finds for the step.
//!
//! On a wall of a given temperature that is not cooled, slag is liquid above the temperature at which it
//! is solid, and frozen below; powder that slag has enclosed melts with it. Powder on the outside stays
//! powder there: it landed as powder at that temperature.

use std::sync::Arc;

use super::Deposit;
use super::layers::Layers;
use super::process::{DepositHeat, Process, ProcessInfo, Step};

pub(super) const INFO: ProcessInfo =
    ProcessInfo { name: "melting", loss: None, gain: None, read: |_| Ok(Some(Arc::new(Melting))) };

#[derive(Debug)]
struct Melting;

impl Process for Melting {
    fn after(&self, deposit: &Deposit, step: &Step<'_>) -> Deposit {
        match step.heat {
            DepositHeat::Cooled { front, .. } => deposit.with_layers(front.masses),
            DepositHeat::Isothermal { liquid: Some(liquid) } if deposit.slag() > 0.0 => {
                deposit.with_layers(isothermal(deposit.layers(), liquid))
            }
            _ => *deposit,
        }
    }
}

/// The layers where all slag is liquid, or all is frozen.
fn isothermal(layers: Layers<f64>, liquid: bool) -> Layers<f64> {
    let slag = layers.frozen + layers.molten;
    if liquid {
        Layers { molten: slag + layers.inner_powder, frozen: 0.0, inner_powder: 0.0, ..layers }
    } else {
        Layers { molten: 0.0, frozen: slag, ..layers }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn on_a_wall_of_one_temperature_slag_is_liquid_or_solid() {
        let layers = Layers { inner_powder: 1.0, frozen: 2.0, molten: 4.0, outer_powder: 8.0 };
        assert_eq!(isothermal(layers, true).outwards(), [0.0, 0.0, 7.0, 8.0]);
        assert_eq!(isothermal(layers, false).outwards(), [1.0, 6.0, 0.0, 8.0]);
    }
}
