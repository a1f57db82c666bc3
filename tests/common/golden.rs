//! The golden table of the Thornton–Ning law.
#![allow(dead_code, reason = "each test uses its part")]
#![allow(clippy::unwrap_used, reason = "clippy.toml's leave for tests does not reach their helpers")]

/// One case of `tests/data/thornton_ning.csv`, columns in their order.
#[derive(Debug)]
pub struct Golden {
    pub e1: f64,
    pub nu1: f64,
    pub e2: f64,
    pub nu2: f64,
    pub rho: f64,
    pub d: f64,
    pub work_of_adhesion: f64,
    pub p_y: f64,
    pub v_n: f64,
    pub reduced_modulus: f64,
    pub v_adh: f64,
    pub v_yield: f64,
    pub v_stick: f64,
    pub e_n: f64,
}

impl Golden {
    /// A model file with this case's numbers: both solids yield at `p_y`, so the ratio is 1.
    pub fn model(&self) -> String {
        let Self { e1, nu1, e2, nu2, rho, work_of_adhesion, p_y, .. } = self;
        format!(
            "[particle]\nmaterial = \"p\"\n[walls.default]\nmaterial = \"w\"\n\
             [normal]\nmodel = \"thornton-ning\"\nyield_ratio = 1\nwork_of_adhesion = {work_of_adhesion:e}\n\
             [tangential]\nmodel = \"constant\"\ne_t = 1\n\
             [materials.p]\ndensity = {rho:e}\nyoungs_modulus = {e1:e}\npoisson_ratio = {nu1:e}\n\
             yield_strength = {p_y:e}\nsurface_energy = 0\n\
             [materials.w]\ndensity = {rho:e}\nyoungs_modulus = {e2:e}\npoisson_ratio = {nu2:e}\n\
             yield_strength = {p_y:e}\nsurface_energy = 0\n"
        )
    }
}

/// The golden table.
pub fn golden_cases() -> Vec<Golden> {
    let text = include_str!("../data/thornton_ning.csv");
    let cases: Vec<Golden> = text.lines().skip(1).map(golden_case).collect();
    assert_eq!(cases.len(), 400);
    cases
}

fn golden_case(line: &str) -> Golden {
    let v: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
    Golden {
        e1: v[0],
        nu1: v[1],
        e2: v[2],
        nu2: v[3],
        rho: v[4],
        d: v[5],
        work_of_adhesion: v[6],
        p_y: v[7],
        v_n: v[8],
        reduced_modulus: v[9],
        v_adh: v[10],
        v_yield: v[11],
        v_stick: v[12],
        e_n: v[13],
    }
}
