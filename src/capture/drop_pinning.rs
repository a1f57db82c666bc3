//! Work that a pinned contact line takes from a drop that recoils.
//!
//! The line advances at the angle `theta` and recedes at the smaller `theta_r`. Over a disc of `xi`
//! diameters `d` of the drop that costs `pi/4 (xi d)² sigma (cos theta_r - cos theta)`, which is `xi²/4
//! (cos theta_r - cos theta)` of the drop's surface energy `pi d² sigma`. At small Weber numbers it
//! falls slower than the kinetic energy `We/12`: it decides which slow drops stay.
//!
//! `theta`, `theta_r` [rad], `sigma` surface tension [N/m], `d` [m]. Source: the work of Young's force on
//! a line with two angles (de Gennes, Rev. Mod. Phys. 57 (1985) 827, not re-read). Published and in
//! agreement: water of 2.5 mm bounced at `We` 25 to 585 only from walls with `theta_r` above 100°
//! (Antonini et al., Langmuir 29 (2013) 16045, abstract).
//!
//! Neglected: angles that depend on the speed of the line, liquid that a fast drop presses into a
//! rough wall, and the wetting that a drop at rest would still reach.

/// The angles at which the contact line of a drop moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactAngles {
    /// Angle `theta` at rest or when the line advances [rad].
    pub contact: f64,
    /// Angle `theta_r` when the line recedes [rad], where it is given.
    pub receding: Option<f64>,
}

/// Difference of both angles [rad] on a wall that a drop hardly touches, where the model gives none: 5°. Such walls are
/// made for less than 10°, and none has 0 (*assumed*).
pub const USUAL_HYSTERESIS: f64 = 5.0 * std::f64::consts::PI / 180.0;

impl ContactAngles {
    /// Work of pinning [1, of the drop's surface energy] on a disc of `spread` [1] times the drop's
    /// diameter, where the angles differ by `usual` [rad] if the receding one is not given.
    pub fn pinning_work(&self, spread: f64, usual: f64) -> f64 {
        let receding = self.receding.unwrap_or((self.contact - usual).max(0.0));
        0.25 * spread * spread * (receding.cos() - self.contact.cos())
    }
}
