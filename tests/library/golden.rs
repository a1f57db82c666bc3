//! Thornton–Ning against 400 cases computed with 40 digits, through the Rust API; `tests/c_api` and
//! `tests/command` ask the C library and the command.

use crate::common::golden::{Golden, golden_cases};
use nearwall::normal::{Contact, NormalLaw, reduced_modulus, restitution};
use nearwall::{Impact, ImpactRng, Model};

/// Relative error 1e-11 (the restitution near its zero: 1e-9 absolute).
fn agree(name: &str, row: usize, ours: f64, golden: f64, absolute: f64) {
    let allowed = (1e-11 * golden.abs()).max(absolute);
    assert!((ours - golden).abs() <= allowed, "case {row}: {name} {ours:e}, golden {golden:e}");
}

#[test]
fn the_laws_agree() {
    for (row, case) in golden_cases().iter().enumerate() {
        let contact = case.contact();
        agree("E*", row, contact.reduced_modulus, case.reduced_modulus, 0.0);
        let speeds = NormalLaw::ThorntonNing.speeds(&contact, case.d);
        agree("v_adh", row, speeds.adhesive, case.v_adh, 0.0);
        agree("v_y", row, speeds.yielding, case.v_yield, 0.0);
        agree("v_s", row, speeds.sticking, case.v_stick, 0.0);
        agree("e_n", row, restitution(case.v_n, speeds.adhesive, speeds.yielding), case.e_n, 1e-9);
    }
}

#[test]
fn the_model_agrees() {
    for (row, case) in golden_cases().iter().enumerate() {
        let model = Model::from_toml("golden", &case.model()).unwrap();
        let outcome = model.resolve(0, &case.impact(), ImpactRng::default()).unwrap();
        agree("e_n", row, outcome.normal_restitution, case.e_n, 1e-9);
        assert_eq!(outcome.stuck, case.v_n <= case.v_stick, "case {row}");
    }
}

impl Golden {
    fn contact(&self) -> Contact {
        let solid = |youngs_modulus, poisson_ratio| nearwall::material::Mechanical {
            density: self.rho,
            youngs_modulus,
            poisson_ratio,
            yield_strength: self.p_y,
            surface_energy: 0.0,
            work_of_adhesion: None,
        };
        let (particle, wall) = (solid(self.e1, self.nu1), solid(self.e2, self.nu2));
        let contact = Contact::new(&particle, &wall, 1.0, Some(self.work_of_adhesion));
        assert_eq!(contact.reduced_modulus, reduced_modulus(&particle, &wall));
        contact
    }

    fn impact(&self) -> Impact {
        Impact { normal_speed: self.v_n, diameter: self.d, ..Impact::default() }
    }
}
