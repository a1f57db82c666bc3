//! Every number of the paper that is compared, with its place.

use crate::{Claim, ClaimBasis, Published};

/// A number that the paper states.
#[derive(Debug, Clone, Copy)]
pub struct StatedNumber {
    /// Where.
    pub place: &'static str,
    /// What it is, with its unit.
    pub what: &'static str,
    /// As printed.
    pub value: f64,
    /// How far ours may be off: the stated uncertainty, half of the last digit, or for "around" and
    /// "about" a whole one.
    pub tolerance: f64,
}

impl StatedNumber {
    /// The statement beside our number.
    pub fn beside(self, ours: f64, basis: ClaimBasis) -> Claim {
        let published = Published::within(self.value, self.tolerance);
        basis.number(self.place, self.what, published, ours)
    }
}

const fn stated(place: &'static str, what: &'static str, value: f64, tolerance: f64) -> StatedNumber {
    StatedNumber { place, what, value, tolerance }
}

/// Particle diameter [m] of the non-sticky tests (Table 3: 75 ± 10 µm).
pub const WAX_DIAMETER: f64 = 75e-6;
/// Half of the range of that diameter [m].
pub const DIAMETER_SPREAD: f64 = 10e-6;
/// Impact angle [degrees from the surface] of Figs 8 to 13.
pub const STEEP: f64 = 84.0;
/// Angles [degrees] of [`E_N_GLANCING`], [`E_T_GLANCING`] and [`E_T_STEEP`].
pub const GLANCING: f64 = 35.0;
pub const SHALLOW: f64 = 13.0;
pub const NEARLY_STEEP: f64 = 80.0;
/// Smallest angle of Figs 6 and 7 [degrees].
pub const LEAST_ANGLE: f64 = 10.0;
/// Normal speeds [m/s] of Figs 8 and 10 (Table 3).
pub const FIGURE_SPEEDS: [f64; 2] = [0.5, 3.0];
/// Standard deviation of the wax's strength [Pa] and modulus [Pa] (Table 1).
pub const STRENGTH_SPREAD: f64 = 2.5e6;
/// See [`STRENGTH_SPREAD`].
pub const MODULUS_SPREAD: f64 = 66e6;

pub const E_N_GLANCING: StatedNumber = stated("Fig 6", "e_n at 35° and v_n = 1 m/s, \"around\"", 0.41, 0.01);
pub const E_N_NEAR_NORMAL: StatedNumber =
    stated("Fig 6", "e_n near the normal at v_n = 1 m/s, \"around\"", 0.28, 0.01);
pub const E_T_GLANCING: StatedNumber = stated("Fig 6", "e_t at 13°, \"around\"", 0.8, 0.1);
pub const E_T_STEEP: StatedNumber = stated("Fig 6", "e_t at about 80°", 0.85, 0.005);
pub const E_T_LEAST: StatedNumber = stated("Fig 6", "angle of the least e_t, \"≈\" [°]", 40.0, 5.0);
pub const FIT_E_N: StatedNumber = stated("Fig 6", "e_n of the best fit of Eq. 9", 0.31, 0.005);
pub const FIT_E_T: StatedNumber = stated("Fig 6", "e_t of the best fit of Eq. 9", 0.76, 0.005);
pub const WAX_FRICTION: StatedNumber = stated("Fig 7", "impulse ratio f between 10° and 45°", 0.28, 0.005);
pub const SLIDING_END: StatedNumber =
    stated("Fig 7", "(1+e_n) tan(alpha) at which sliding ends", 1.31, 0.005);
pub const SLIDING_END_ANGLE: StatedNumber = stated("Fig 7", "the same as an angle [°]", 45.0, 0.5);
pub const CRITICAL_ANGLE: StatedNumber = stated("Eq 11", "critical angle of wax on Pyrex [°]", 43.0, 0.5);
pub const RIGID_ROLLING: StatedNumber = stated("Sec 4.1", "e_t of a rolling rigid sphere", 0.714, 0.0005);
pub const YIELD_RATIO: StatedNumber = stated("Fig 8", "c = p_y/sigma_y that fits best", 0.7, 0.05);
/// The same of a hard sphere, which does not fit.
pub const HARD_SPHERE: [f64; 2] = [2.6, 3.0];
pub const E_N_FIG_8: StatedNumber = stated("Fig 8", "e_n from 0.5 to 3 m/s, \"~\"; the mean", 0.3, 0.05);
pub const E_N_MEAN: StatedNumber = stated("Fig 10", "mean e_n on Pyrex, 0.5 to 3 m/s", 0.28, 0.005);
pub const E_N_MEAN_WAX: StatedNumber = stated("Fig 10", "mean e_n on smooth wax, 0.5 to 3 m/s", 0.28, 0.005);
pub const E_N_THIN: StatedNumber =
    stated("Fig 10", "mean e_n over 0.25 mm of powder, \"around\"", 0.10, 0.01);
pub const E_N_THICK: StatedNumber =
    stated("Fig 10", "mean e_n over 1.4 mm of powder, \"around\"", 0.07, 0.01);
pub const E_N_SYRUP: StatedNumber = stated(
    "Fig 10",
    "mean e_n over 0.2 mm of powder on syrup: \"the same reduction\" as dry, taken as that of the thin layer",
    0.10,
    0.01,
);
pub const CAPTURE_70: StatedNumber = stated("Fig 12", "capture at 70 °C, \"around\" [%]", 8.0, 1.0);
pub const CAPTURE_105: StatedNumber = stated("Fig 12", "capture at 105 °C [%]", 93.0, 0.5);
/// Impacts a point, at the least.
pub const IMPACTS_A_POINT: f64 = 50.0;
/// Capture of molten wax [%] lies above this (Fig. 14).
pub const CAPTURE_120: f64 = 85.0;
/// Melting range of the wax [°C] (section 3.1).
pub const MELTING: [f64; 2] = [75.0, 85.0];
/// Flow of the wax [1] at a temperature [°C] (Craig et al., in section 4.2).
pub const FLOW_TEST: [[f64; 2]; 3] = [[65.0, 0.01], [71.1, 0.50], [74.6, 0.70]];
/// Conversion [1] over which the capture of coal rises (Fig. 12).
pub const CHAR_CONVERSION: [f64; 2] = [0.88, 0.90];
pub const TUBE_LENGTH: StatedNumber = stated("Eq 13", "length of the tube [m]", 0.65, 0.005);
pub const FUSION_TIME: f64 = 0.11;
pub const RESIDENCE: StatedNumber =
    stated("Sec 3.1", "time in the tube over the fusion time 0.11 s, \"about three times\"", 3.0, 0.5);
pub const TUBE_SPEED: StatedNumber = stated("Table 3, Fig 12", "impact speed v_i [m/s]", 2.0, 0.1);

/// A target of Tables 2 and 4.
pub struct StatedTarget {
    pub name: &'static str,
    /// Wall of `targets.toml` and material of the library.
    pub wall: &'static str,
    pub material: &'static str,
    /// Surface energy [J/m²], modulus [Pa], Poisson's ratio [1].
    pub surface_energy: f64,
    pub modulus: f64,
    pub poisson: f64,
    /// Yield and sticking velocity as printed [m/s], and half of the last digit.
    pub yielding: [f64; 2],
    pub sticking: [f64; 2],
}

pub const TARGETS: [StatedTarget; 4] = [
    StatedTarget {
        name: "Teflon",
        wall: "teflon",
        material: "teflon",
        surface_energy: 0.02,
        modulus: 0.5e9,
        poisson: 0.46,
        yielding: [6.8e-3, 0.05e-3],
        sticking: [3.02e-2, 0.005e-2],
    },
    StatedTarget {
        name: "wax",
        wall: "wax",
        material: "montan-wax",
        surface_energy: 0.03,
        modulus: 0.7e9,
        poisson: 0.49,
        yielding: [6.8e-3, 0.05e-3],
        sticking: [3.03e-2, 0.005e-2],
    },
    StatedTarget {
        name: "steel",
        wall: "steel",
        material: "stainless-steel",
        surface_energy: 0.80,
        modulus: 190e9,
        poisson: 0.30,
        yielding: [6.8e-3, 0.05e-3],
        sticking: [1.04e-2, 0.005e-2],
    },
    PYREX,
];

/// The target of most tests.
pub const PYREX: StatedTarget = StatedTarget {
    name: "Pyrex",
    wall: "pyrex",
    material: "pyrex",
    surface_energy: 1.0,
    modulus: 64e9,
    poisson: 0.20,
    yielding: [6.8e-3, 0.05e-3],
    sticking: [1.15e-2, 0.005e-2],
};

/// A row of Table 1: name there, material of the library, modulus and its deviation, strength and its deviation [Pa].
pub type StatedSolid = (&'static str, &'static str, [f64; 2], [f64; 2]);

pub const SOLIDS: [StatedSolid; 7] = [
    ("Waradur E wax", "montan-wax", [700e6, 66e6], [9.5e6, 2.5e6]),
    ("Coal 100a", "coal-rank-100a", [3675e6, 545e6], [17e6, 2.82e6]),
    ("Coal 201", "coal-rank-201", [1324e6, 193e6], [5.3e6, 0.83e6]),
    ("Coal 301", "coal-rank-301", [400e6, 103e6], [1.93e6, 0.27e6]),
    ("Coal 801", "coal-rank-801", [3805e6, 41.37e6], [26.54e6, 2.07e6]),
    ("Schleenhain brown coal", "brown-coal-schleenhain", [43e6, 15e6], [2.35e6, 0.78e6]),
    ("Its char, 800 °C", "brown-coal-char-800", [206e6, 63e6], [11.2e6, 5e6]),
];
/// Modulus of slag [Pa] at a temperature [K] (Table 1).
pub const SLAG: [[f64; 2]; 2] = [[1273.15, 20e9], [1723.15, 5e9]];

/// A column of Table 3: regime, air temperatures [°C], air flow [m³/h at 273 K], diameter [m], impact speed [m/s].
pub struct Operation {
    pub regime: &'static str,
    pub air: [f64; 2],
    pub flow: [f64; 2],
    pub diameter: f64,
    pub speed: [f64; 2],
}

pub const OPERATIONS: [Operation; 3] = [
    Operation {
        regime: "NSP–NSW", air: [20.0, 20.0], flow: [2.0, 8.0], diameter: 75e-6, speed: [0.5, 3.0]
    },
    Operation {
        regime: "NSP→SP", air: [20.0, 110.0], flow: [3.0, 4.0], diameter: 80e-6, speed: [2.0, 2.0]
    },
    Operation {
        regime: "SP–NSW",
        air: [120.0, 120.0],
        flow: [3.0, 5.0],
        diameter: 120e-6,
        speed: [0.7, 5.0],
    },
];

/// Inner diameter and length of the outer tube, and how far the inner one reaches into it [m] (section 3.1).
pub const TUBE: [f64; 3] = [0.03, 0.65, 0.08];
/// Density of the wax [kg/m³] (section 3.1).
pub const WAX_DENSITY: f64 = 1000.0;
/// Diameters of the batches that were fed [m] (section 3.1).
pub const FEED: [f64; 2] = [50e-6, 100e-6];

/// What section 3.1 says of a melt.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StatedMelt {
    /// Surface tension [N/m], viscosity [Pa s], density [kg/m³].
    pub tension: [f64; 2],
    pub viscosity: [f64; 2],
    pub density: [f64; 2],
}

pub const COAL_SLAG: StatedMelt =
    StatedMelt { tension: [0.4, 0.7], viscosity: [0.01, 1.0], density: [2500.0, 3000.0] };
pub const MOLTEN_WAX: StatedMelt =
    StatedMelt { tension: [0.03, 0.03], viscosity: [0.02, 0.1], density: [WAX_DENSITY, WAX_DENSITY] };
/// Temperatures [K] of the two viscosities of [`MOLTEN_WAX`].
pub const VISCOSITY_AT: [f64; 2] = [403.15, 363.15];

/// The camera (section 3.2): width of the picture [m] and its pixels, time between frames and time of exposure [s].
pub struct Camera {
    pub width: f64,
    pub pixels: f64,
    pub frame: f64,
    pub exposure: f64,
}

pub const CAMERA: Camera = Camera { width: 0.028, pixels: 1024.0, frame: 1e-3, exposure: 42e-6 };

impl Camera {
    /// Width of a pixel [µm].
    pub fn pixel(&self) -> f64 {
        1e6 * self.width / self.pixels
    }
}
