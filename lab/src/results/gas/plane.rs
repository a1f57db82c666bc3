//! The plane in which the gas is shown: through the middle of the domain, normal to the axis along
//! which it extends least.

/// The plane is off the middle by this share of the extent, so that no faces of a symmetric mesh lie in it [1].
const OFF_MIDDLE: f64 = 1e-5;
/// Extents that differ by less than this share count as equal [1].
const SAME_EXTENT: f64 = 0.01;

/// A plane normal to a main axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CutPlane {
    /// Number of the axis that is normal to it: 0 is x.
    pub normal: usize,
    /// Where it cuts that axis [m].
    pub place: f64,
    /// Extent of the domain along that axis [m].
    pub extent: f64,
}

impl CutPlane {
    /// The plane through the middle of a box, whose ends are in m. Of equal extents it takes y, then x,
    /// then z: in a round vertical vessel the plane is normal to y. `None` for a box without an extent.
    pub fn through(ends: &[[f64; 2]; 3]) -> Option<Self> {
        let extents = ends.map(|[low, high]| high - low);
        if !extents.iter().all(|extent| extent.is_finite() && *extent > 0.0) {
            return None;
        }
        let least = extents.iter().copied().fold(f64::INFINITY, f64::min);
        let normal = [1, 0, 2].into_iter().find(|axis| extents[*axis] <= least * (1.0 + SAME_EXTENT))?;
        let [low, high] = ends[normal];
        Some(Self {
            normal,
            place: 0.5 * (low + high) + OFF_MIDDLE * extents[normal],
            extent: extents[normal],
        })
    }

    /// The axes in the plane, rightwards and upwards.
    pub fn axes(&self) -> [usize; 2] {
        match self.normal {
            0 => [1, 2],
            1 => [0, 2],
            _ => [0, 1],
        }
    }

    /// How far a place is from the plane, along the normal [m].
    pub fn distance(&self, place: &[f64; 3]) -> f64 {
        place[self.normal] - self.place
    }

    /// A place in the plane [m].
    pub fn project(&self, place: &[f64; 3]) -> [f64; 2] {
        self.axes().map(|axis| place[axis])
    }

    /// `y = 0.2 m`.
    pub fn words(&self) -> String {
        // The shift off the middle is not worth a word.
        let digits = (2.0 - self.extent.log10().floor()).clamp(0.0, 12.0) as usize;
        let place = format!("{:.digits$}", self.place);
        let place =
            if place.contains('.') { place.trim_end_matches('0').trim_end_matches('.') } else { &place };
        let place = if place == "-0" { "0" } else { place };
        format!("{} = {place} m", ["x", "y", "z"][self.normal])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_plane_is_normal_to_the_least_extent() {
        let plane = |ends| CutPlane::through(&ends).unwrap();
        let vessel = plane([[-0.2, 0.2], [-0.2, 0.2], [-1.45, 0.0]]);
        assert_eq!((vessel.normal, vessel.axes(), vessel.words().as_str()), (1, [0, 2], "y = 0 m"));
        let tube = plane([[0.0, 1.0], [0.0, 2.0], [0.001, 0.003]]);
        assert_eq!((tube.normal, tube.words().as_str()), (2, "z = 0.002 m"));
        assert_eq!(plane([[0.0, 1.0], [2.0, 5.0], [0.0, 9.0]]).words(), "x = 0.5 m");
        assert_eq!(CutPlane::through(&[[0.0, 1.0], [f64::INFINITY, 0.0], [0.0, 1.0]]), None);
        assert_eq!(CutPlane::through(&[[0.0, 0.0], [0.0, 1.0], [0.0, 1.0]]), None);
    }
}
