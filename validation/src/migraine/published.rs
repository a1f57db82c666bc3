//! What the paper prints, each number once. Section 4 unless said otherwise.

/// The sets whose target faced the dust, all but set 4: rebounds with `e_n` below 0.6, and all rebounds.
pub fn near_normal() -> [usize; 2] {
    let sets = || SETS.iter().filter(|set| set.number != 4);
    [sets().map(|set| set.below).sum(), sets().map(Set::rebounds).sum()]
}

/// One set of impacts of tungsten dust.
#[derive(Debug, Clone, Copy)]
pub struct Set {
    /// Its number in the paper.
    pub number: usize,
    /// Figure of its normal restitution.
    pub figure: &'static str,
    /// Impacts that were analysed.
    pub impacts: usize,
    /// Of these, stuck.
    pub stuck: usize,
    /// Of the rebounds, with `e_n` below 0.6.
    pub below: usize,
    /// The same share as printed, in per cent; set 4 is printed as "all".
    pub below_percent: f64,
    /// Least and largest `v_n` [m/s].
    pub normal: [f64; 2],
    /// Least and largest `v_t` [m/s].
    pub along: [f64; 2],
    /// Least, mean and largest angle from the normal [degrees].
    pub angle: [f64; 3],
    /// Mean `e_t`.
    pub e_t: f64,
    /// What every `e_t` "always exceeded", where it is printed; taken as the smallest.
    pub least_e_t: Option<f64>,
    /// Smallest, most probable and largest diameter [µm] (section 3).
    pub size: [f64; 3],
    /// What the paper says of the plasma.
    pub plasma: &'static str,
}

impl Set {
    /// Impacts that rebounded.
    pub fn rebounds(&self) -> usize {
        self.impacts - self.stuck
    }

    /// Impacts that stuck [%].
    pub fn stuck_percent(&self) -> f64 {
        100.0 * self.stuck as f64 / self.impacts as f64
    }

    /// `set 1`.
    pub fn name(&self) -> String {
        format!("set {}", self.number)
    }
}

const SMALL: [f64; 3] = [8.0, 9.0, 10.0];

/// Sets 1 to 5.
pub const SETS: [Set; 5] = [
    Set {
        number: 1,
        figure: "Fig 1",
        impacts: 230,
        stuck: 62,
        below: 119,
        below_percent: 71.0,
        normal: [1.36, 12.95],
        along: [0.0, 6.88],
        angle: [0.0, 24.3, 73.4],
        e_t: 0.86,
        least_e_t: Some(0.61),
        size: SMALL,
        plasma: "220 A, 0.4 eV, 2.5e20 m⁻³",
    },
    Set {
        number: 2,
        figure: "Fig 3",
        impacts: 65,
        stuck: 9,
        below: 37,
        below_percent: 66.0,
        normal: [0.70, 8.86],
        along: [0.0, 3.53],
        angle: [0.0, 22.9, 73.3],
        e_t: 0.75,
        least_e_t: None,
        size: SMALL,
        plasma: "220 A, slightly weaker",
    },
    Set {
        number: 3,
        figure: "Fig 4",
        impacts: 122,
        stuck: 2,
        below: 90,
        below_percent: 75.0,
        normal: [0.78, 7.71],
        along: [0.0, 3.11],
        angle: [0.0, 19.0, 80.8],
        e_t: 0.83,
        least_e_t: None,
        size: SMALL,
        plasma: "130–150 A, 0.25 eV, 1.5e20 m⁻³",
    },
    Set {
        number: 4,
        figure: "Fig 5",
        impacts: 41,
        stuck: 0,
        below: 41,
        below_percent: 100.0,
        normal: [0.88, 4.50],
        along: [2.04, 8.81],
        angle: [42.9, 60.6, 77.3],
        e_t: 0.74,
        least_e_t: Some(0.56),
        size: SMALL,
        plasma: "220 A, weaker",
    },
    Set {
        number: 5,
        figure: "Fig 6",
        impacts: 49,
        stuck: 2,
        below: 37,
        below_percent: 79.0,
        normal: [0.57, 7.90],
        along: [0.0, 2.48],
        angle: [0.0, 21.7, 57.8],
        e_t: 0.76,
        least_e_t: None,
        size: [12.0, 14.0, 16.0],
        plasma: "220 A, 0.4 eV, 2.5e20 m⁻³",
    },
];

/// Set 6: molten molybdenum, impacts and of these stuck.
pub const MOLTEN: [usize; 2] = [13, 13];
/// Size of set 6 as of set 5 [µm].
pub const MOLTEN_SIZE: [f64; 3] = [12.0, 14.0, 16.0];
/// All six sets (section 4, first paragraph).
pub const ALL_IMPACTS: usize = 520;
/// Share of the near-normal rebounds with strong dissipation [%], "~".
pub const STRONG_PERCENT: f64 = 75.0;
/// `e_n` that parts strong from weak dissipation.
pub const PARTING: f64 = 0.6;
/// `p_y/sigma_y` found, and used before.
pub const RATIO: [f64; 2] = [4.0, 2.8];
/// `p_y/sigma_y` drawn here; 1.6 to 2.8 is what finite elements give (section 2), 4 what the paper finds.
pub const DRAWN_RATIOS: [f64; 3] = [1.6, 2.8, 4.0];
/// Mean `e_t` over all sets.
pub const E_T: f64 = 0.8;
/// Temperatures of dust and target in the figures [K].
pub const FIGURE_TEMPERATURES: [f64; 2] = [3000.0, 1000.0];
/// Molybdenum is hotter than this, the target at most so hot [K].
pub const MOLTEN_TEMPERATURES: [f64; 2] = [2900.0, 1000.0];
/// Duration of an impact [s] (section 3, "Uncertainties"), "~".
pub const DURATION: f64 = 10e-9;
