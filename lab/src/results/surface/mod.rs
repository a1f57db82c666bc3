//! What lies on the faces of a wall, and the wall unrolled into a plane.
//!
//! [`crate::results::openfoam`] reads a [`WallSurface`]; [`unroll()`] lays its faces into a plane; [`Shape`]s are what a map
//! of one quantity draws.

mod axis;
mod nearest;
mod shapes;
mod unroll;

pub(super) use nearest::add_regimes;
pub use shapes::{GRID, MOST_FACES, Shape, shapes};
pub use unroll::{PlaneAxis, Unrolled, Unrolling, WallAxis, unroll};

/// A quantity on the faces of a wall.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
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

impl Quantity {
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
    pub corners: Vec<[f64; 3]>,
    /// Its centre [m].
    pub centre: [f64; 3],
    /// Its normal times its area [m²].
    pub normal: [f64; 3],
    /// Its area [m²].
    pub area: f64,
}

impl WallFace {
    /// The face with these corners [m]. Its area is that of OpenFOAM: the length of the sum of its triangles' normals.
    pub fn new(corners: Vec<[f64; 3]>) -> Self {
        let count = corners.len().max(1) as f64;
        let middle: [f64; 3] =
            std::array::from_fn(|i| corners.iter().map(|corner| corner[i]).sum::<f64>() / count);
        let (mut normal, mut moment, mut weight) = ([0.0; 3], [0.0; 3], 0.0);
        for (place, corner) in corners.iter().enumerate() {
            let next = &corners[(place + 1) % corners.len()];
            let part =
                axis::cross(axis::from_to(&middle, corner), axis::from_to(&middle, next)).map(|x| 0.5 * x);
            let area = axis::length(part);
            weight += area;
            for i in 0..3 {
                normal[i] += part[i];
                moment[i] += area * (middle[i] + corner[i] + next[i]) / 3.0;
            }
        }
        let centre = if weight > 0.0 { moment.map(|sum| sum / weight) } else { middle };
        Self { corners, centre, normal, area: axis::length(normal) }
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
    pub quantities: Vec<(Quantity, Vec<f64>)>,
    /// Mass per area [kg/m²] of the captured parcels that lie on each face, by the regime of their capture in the order of
    /// [`nearwall::impact::Regime::ALL`]; `None` where the source does not tell it.
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
