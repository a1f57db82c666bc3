//! A cut through the gas with the parcels near it, at one time.
//!
//! [`crate::results::openfoam::gas`] reads a [`GasCut`]; [`Plane`] chooses where to cut; [`on_grid`] makes a large cut small.

mod grid;
mod plane;

pub use grid::{GRID_CELLS, on_grid};
pub use plane::Plane;

/// What colours the gas.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GasQuantity {
    /// Temperature [K].
    Temperature,
    /// Magnitude of the velocity [m/s].
    Speed,
}

impl GasQuantity {
    /// Name for a reader.
    pub fn name(self) -> &'static str {
        match self {
            Self::Temperature => "gas temperature",
            Self::Speed => "gas speed",
        }
    }

    /// Unit.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Temperature => "K",
            Self::Speed => "m/s",
        }
    }
}

/// What colours the parcels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ParcelQuantity {
    /// Share of the carbon at injection that is gone [1].
    Conversion,
    /// Temperature [K].
    Temperature,
}

impl ParcelQuantity {
    /// Name for a reader.
    pub fn name(self) -> &'static str {
        match self {
            Self::Conversion => "carbon conversion",
            Self::Temperature => "parcel temperature",
        }
    }

    /// Unit.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Conversion => "1",
            Self::Temperature => "K",
        }
    }
}

/// A cell where the plane cuts it.
#[derive(Debug, Clone, PartialEq)]
pub struct CutCell {
    /// Corners in the plane, in turn [m].
    pub outline: Vec<[f64; 2]>,
    /// The quantity of the gas.
    pub value: f64,
}

/// A parcel in flight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlyingParcel {
    /// Position [m].
    pub position: [f64; 3],
    /// The quantity of the parcels; NaN where it is unknown.
    pub value: f64,
}

/// Gas and parcels of a cloud at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct GasCut {
    /// Time [s], or number of iterations.
    pub time: f64,
    /// Where the mesh is cut.
    pub plane: Plane,
    /// Whether the plane cuts every cell: the mesh is one cell thick.
    pub is_flat: bool,
    /// What the values of the cells are.
    pub quantity: GasQuantity,
    /// The cells that the plane cuts.
    pub cells: Vec<CutCell>,
    /// What the values of the parcels are; `None` where the cloud has neither.
    pub coloured_by: Option<ParcelQuantity>,
    /// All parcels in flight.
    pub parcels: Vec<FlyingParcel>,
    /// Number of parcels at rest.
    pub resting: usize,
}

/// Thickness of the slab whose parcels are shown, over the extent of the domain in that direction [1].
pub const SLAB: f64 = 0.1;

impl GasCut {
    /// Thickness of the slab whose parcels are shown [m]; `None` where all are.
    pub fn slab(&self) -> Option<f64> {
        (!self.is_flat).then_some(SLAB * self.plane.extent)
    }

    /// The parcels in the slab: places in the plane [m] and values.
    pub fn shown(&self) -> Vec<([f64; 2], f64)> {
        let reach = self.slab().map_or(f64::INFINITY, |slab| 0.5 * slab);
        let near = self.parcels.iter().filter(|parcel| self.plane.distance(&parcel.position).abs() <= reach);
        near.map(|parcel| (self.plane.project(&parcel.position), parcel.value)).collect()
    }

    /// Area of the cut [m²].
    pub fn area(&self) -> f64 {
        self.cells.iter().map(|cell| area(&cell.outline)).sum()
    }
}

/// Area of a polygon [m²], by the trapezoid formula.
fn area(outline: &[[f64; 2]]) -> f64 {
    let next = outline.iter().cycle().skip(1);
    outline.iter().zip(next).map(|(a, b)| 0.5 * (a[0] - b[0]) * (a[1] + b[1])).sum::<f64>().abs()
}
