//! The published tungsten campaign: six sets with their counts, sizes, speeds and angles; the truth is hidden.

use crate::campaign::{Campaign, System};
use crate::contact::Tangential;
use crate::dice::Dice;
use crate::sets::Plan;

/// A placeholder until the six sets are written.
pub fn plan(dice: &mut Dice) -> Plan {
    Plan { campaign: Campaign::new(System::Tungsten, Tangential::Constant(1.0), dice), plants: vec![] }
}
