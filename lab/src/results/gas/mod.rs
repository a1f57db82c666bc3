//! A cut through the gas with the parcels near it, at one time.
//!
//! [`crate::results::openfoam::gas`] reads a [`GasCut`]; [`CutPlane`] chooses where to cut.

mod plane;

use super::map_cells::{Grid, MapCell, extent};

pub use plane::CutPlane;

/// About the most squares of a grid, and the most cells that are drawn one by one.
pub const GAS_CELLS: usize = 20_000;
/// Share of a square that has to lie in the cut [1].
const LEAST_COVERED: f64 = 0.5;

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
    pub plane: CutPlane,
    /// Whether the plane cuts every cell: the mesh is one cell thick.
    pub is_flat: bool,
    /// What the values of the cells are.
    pub quantity: GasQuantity,
    /// The cells that the plane cuts.
    pub cells: Vec<MapCell>,
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
        self.cells.iter().map(|cell| cell.area).sum()
    }

    /// The cells of a picture: those of the cut, or the means in equal rectangles where there are
    /// more than [`GAS_CELLS`].
    pub fn drawn(&self) -> Vec<MapCell> {
        match extent(&self.cells).filter(|_| self.cells.len() > GAS_CELLS) {
            Some(ends) => Grid::of_squares(ends, GAS_CELLS).means(&self.cells, LEAST_COVERED),
            None => self.cells.clone(),
        }
    }
}
