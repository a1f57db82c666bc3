//! The measured slag viscosities, `tests/data/slag_viscosity_measured.csv`.
#![allow(dead_code, reason = "each test uses its part")]
#![allow(clippy::unwrap_used, reason = "clippy.toml's leave for tests does not reach their helpers")]

use nearwall::slag::Composition;

const TABLE: &str = include_str!("../data/slag_viscosity_measured.csv");

/// The oxides of the table, in its order.
pub const OXIDES: [&str; 11] =
    ["SiO2", "TiO2", "Al2O3", "FeO", "Fe2O3", "MnO", "Na2O", "K2O", "MgO", "CaO", "P2O5"];

/// One measured point.
pub struct Measured {
    pub source: &'static str,
    /// [wt%], as [`OXIDES`].
    pub shares: [f64; 11],
    /// [K]
    pub temperature: f64,
    /// Viscosity in Pa s.
    pub log10_viscosity: f64,
    pub in_ash_window: bool,
}

impl Measured {
    /// Share of an oxide [wt%].
    pub fn share(&self, oxide: &str) -> f64 {
        OXIDES.iter().position(|name| *name == oxide).map(|i| self.shares[i]).unwrap()
    }

    /// Both oxides of iron [wt%].
    pub fn iron(&self) -> f64 {
        self.share("FeO") + self.share("Fe2O3")
    }

    pub fn composition(&self) -> Composition {
        Composition::new(OXIDES.into_iter().zip(self.shares)).unwrap()
    }

    /// The same melt at the same temperature, to 0.3 wt% and 2 K, with the same viscosity, to 0.02 in log10.
    pub fn repeats(&self, other: &Self) -> bool {
        let shares = self.shares.iter().zip(other.shares);
        shares.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) < 0.3
            && (self.temperature - other.temperature).abs() < 2.0
            && (self.log10_viscosity - other.log10_viscosity).abs() < 0.02
    }
}

/// Every row of the table. The numbers stand at the end of a line; source and sample before them may carry commas of
/// their own.
pub fn measured() -> Vec<Measured> {
    let mut lines = TABLE.lines().filter(|line| !line.starts_with('#'));
    let header: Vec<&str> = lines.next().unwrap().split(',').collect();
    let expected: Vec<String> = OXIDES.iter().map(|o| format!("{}_wt", o.to_lowercase())).collect();
    assert_eq!(header[2..13], expected);
    assert_eq!(header[13..], ["T_K", "log10_eta_Pa_s", "ash_window"]);
    lines
        .map(|line| {
            let mut fields: Vec<&str> = line.rsplitn(15, ',').collect();
            fields.reverse();
            let numbers: Vec<f64> = fields[1..].iter().map(|field| field.parse().unwrap()).collect();
            let source = match fields[0].strip_prefix('"') {
                Some(quoted) => quoted.split('"').next().unwrap(),
                None => fields[0].split(',').next().unwrap(),
            };
            Measured {
                source,
                shares: numbers[..11].try_into().unwrap(),
                temperature: numbers[11],
                log10_viscosity: numbers[12],
                in_ash_window: numbers[13] == 1.0,
            }
        })
        .collect()
}
