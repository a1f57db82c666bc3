//! What lies on the faces of a wall, and the wall unrolled into a plane.
//!
//! [`crate::results::openfoam`] reads a [`WallSurface`]; [`unroll()`] lays its faces into a plane;
//! [`shapes`] makes the cells of a map of one quantity.

mod nearest;
mod unroll;

use nalgebra::Vector3;

use super::map_cells::{Grid, MapCell, extent};

pub(super) use nearest::add_regimes;
pub use unroll::{PlaneAxis, Unrolled, Unrolling, WallAxis, unroll};

/// A wall with more faces is drawn as a grid.
pub const MOST_FACES: usize = 4000;
/// Columns and rows of the grid.
pub const WALL_GRID: [usize; 2] = [100, 60];

/// A quantity on the faces of a wall.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SurfaceQuantity {
    /// Molten mass and powder per area [kg/m²], of a wall with memory.
    Deposit,
    /// Mass captured per area since the start [kg/m²], of a wall without memory.
    Captured,
    /// Thickness of the powder with its voids [m].
    Layer,
    /// Temperature that impacts meet [K].
    Temperature,
    /// Heat flux into the wall [W/m²].
    HeatFlux,
}

impl SurfaceQuantity {
    /// Name for a reader.
    pub fn name(self) -> &'static str {
        match self {
            Self::Deposit => "Deposit",
            Self::Captured => "Captured mass",
            Self::Layer => "Thickness of the powder",
            Self::Temperature => "Surface temperature",
            Self::HeatFlux => "Heat flux",
        }
    }

    /// Unit.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Deposit | Self::Captured => "kg/m²",
            Self::Layer => "m",
            Self::Temperature => "K",
            Self::HeatFlux => "W/m²",
        }
    }
}

/// A face of a wall.
#[derive(Debug, Clone, PartialEq)]
pub struct WallFace {
    /// Its corners in turn [m].
    pub corners: Vec<Vector3<f64>>,
    /// Its centre [m].
    pub centre: Vector3<f64>,
    /// Its normal times its area [m²].
    pub normal: Vector3<f64>,
    /// Its area [m²].
    pub area: f64,
}

impl WallFace {
    /// The face with these corners [m]. Its area is that of OpenFOAM: the length of the sum of its triangles' normals.
    pub fn new(corners: Vec<[f64; 3]>) -> Self {
        let corners: Vec<Vector3<f64>> = corners.into_iter().map(Vector3::from).collect();
        let middle = corners.iter().sum::<Vector3<f64>>() / corners.len().max(1) as f64;
        let (mut normal, mut moment, mut weight) = (Vector3::zeros(), Vector3::zeros(), 0.0);
        for (corner, next) in corners.iter().zip(corners.iter().cycle().skip(1)) {
            let part = 0.5 * (corner - middle).cross(&(next - middle));
            weight += part.norm();
            normal += part;
            moment += part.norm() * (middle + corner + next) / 3.0;
        }
        let centre = if weight > 0.0 { moment / weight } else { middle };
        Self { corners, centre, normal, area: normal.norm() }
    }
}

/// A wall with quantities on its faces, at one time.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct WallSurface {
    /// Name of the wall.
    pub wall: String,
    /// Time [s], or number of iterations.
    pub time: f64,
    /// Its faces.
    pub faces: Vec<WallFace>,
    /// Quantities and their values on each face.
    pub quantities: Vec<(SurfaceQuantity, Vec<f64>)>,
    /// Mass per area [kg/m²] of the captured parcels that lie on each face, by the regime of their
    /// capture in the order of [`nearwall::impact::Regime::ALL`]; `None` where the source does not
    /// tell it.
    pub captured: Option<[Vec<f64>; 4]>,
}

impl WallSurface {
    /// Area [m²].
    pub fn area(&self) -> f64 {
        self.faces.iter().map(|face| face.area).sum()
    }

    /// Integral of values over the area [their unit times m²].
    pub fn integral(&self, values: &[f64]) -> f64 {
        self.faces.iter().zip(values).map(|(face, value)| face.area * value).sum()
    }
}

/// The cells of a map: one for each face, or those of a grid where there are too many.
pub fn shapes(faces: &[WallFace], unrolled: &Unrolled, values: &[f64]) -> Vec<MapCell> {
    let each = faces.iter().zip(&unrolled.outlines).zip(values);
    let cell = |((face, outline), value): ((&WallFace, &Vec<[f64; 2]>), &f64)| MapCell {
        outline: outline.clone(),
        area: face.area,
        value: *value,
    };
    let cells: Vec<MapCell> = each.map(cell).collect();
    match extent(&cells).filter(|_| cells.len() > MOST_FACES) {
        Some(ends) => Grid::new(ends, WALL_GRID).means(&cells, 0.0),
        None => cells,
    }
}
