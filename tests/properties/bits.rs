//! The same impact has the same bits: alone, in batches of any size, on any thread and at any address.
#![allow(unsafe_code, reason = "the C interface")]

use std::ptr::{null, null_mut};

use nearwall::c_api::{
    NW_OK, nw_impacts, nw_model, nw_model_free, nw_model_parse, nw_outcomes, nw_resolve_batch,
};
use nearwall::impact::INPUTS;
use nearwall::{Impact, ImpactRng, Model, Outcome};
use proptest::prelude::*;

use crate::cases::{config, effects_but, impacts, normal_laws, spinning, tangential_laws};

/// A model of the C interface, shared by threads as the header allows.
struct Shared(*mut nw_model);

// SAFETY: the header lets any number of threads share a model.
unsafe impl Sync for Shared {}

impl Shared {
    fn new(toml: &str) -> Self {
        let mut model = null_mut();
        // SAFETY: a text with its size.
        let status = unsafe {
            nw_model_parse(toml.as_ptr().cast(), toml.len(), null(), &raw mut model, null_mut(), 0)
        };
        assert_eq!(status, NW_OK);
        Self(model)
    }
}

impl Drop for Shared {
    fn drop(&mut self) {
        // SAFETY: made by `new`, freed once.
        unsafe { nw_model_free(self.0) };
    }
}

type Bits = [u64; 6];

fn bits(outcome: &Outcome) -> Bits {
    let o = outcome;
    let numbers = [o.normal_restitution, o.tangential_restitution, o.sticking_probability, o.spin];
    let [a, b, c, d] = numbers.map(f64::to_bits);
    [a, b, c, d, o.regime as u64, o.stuck.into()]
}

/// Numbers on an address that is `offset` bytes off.
fn column(offset: usize, numbers: impl Iterator<Item = [u8; 8]>) -> Vec<u8> {
    std::iter::repeat_n(0, offset).chain(numbers.flatten()).collect()
}

/// One batch whose arrays lie `offset` bytes off; the first impact has the key `first`.
fn batch(model: &Shared, impacts: &[Impact], first: u64, seed: u64, offset: usize) -> Vec<Bits> {
    let count = impacts.len();
    let columns =
        INPUTS.map(|input| column(offset, impacts.iter().map(|impact| (input.value)(impact).to_ne_bytes())));
    let keys = column(offset, (first..first + count as u64).map(u64::to_ne_bytes));
    let key = keys[offset..].as_ptr().cast();
    let mut asked = nw_impacts { count, seed, key, ..nw_impacts::default() };
    for (array, column) in asked.columns_mut().into_iter().zip(&columns) {
        *array = column[offset..].as_ptr().cast();
    }
    let mut numbers: [Vec<u8>; 4] = std::array::from_fn(|_| vec![0; offset + 8 * count]);
    let mut marks: [Vec<u8>; 2] = std::array::from_fn(|_| vec![0; offset + 4 * count]);
    let [e_n, e_t, p_stick, omega] = numbers.each_mut().map(|bytes| bytes[offset..].as_mut_ptr().cast());
    let [regime, stuck] = marks.each_mut().map(|bytes| bytes[offset..].as_mut_ptr().cast());
    let wanted = nw_outcomes { e_n, e_t, p_stick, omega, regime, stuck, ..nw_outcomes::default() };
    // SAFETY: every array has `count` entries.
    assert_eq!(unsafe { nw_resolve_batch(model.0, &raw const asked, &raw const wanted, null_mut()) }, NW_OK);
    let word =
        |bytes: &[u8], index: usize| u64::from_ne_bytes(bytes[offset + 8 * index..][..8].try_into().unwrap());
    let mark = |bytes: &[u8], index: usize| {
        u64::from(u32::from_ne_bytes(bytes[offset + 4 * index..][..4].try_into().unwrap()))
    };
    let row = |index| {
        let [a, b, c, d] = numbers.each_ref().map(|bytes| word(bytes, index));
        [a, b, c, d, mark(&marks[0], index), mark(&marks[1], index)]
    };
    (0..count).map(row).collect()
}

proptest! {
    #![proptest_config(config(60))]

    #[test]
    fn alone_in_batches_on_threads_and_on_any_address(
        normal in normal_laws(),
        tangential in tangential_laws(),
        effects in effects_but(&[]),
        cases in proptest::collection::vec(prop_oneof![impacts(), spinning()], 1..120),
        sizes in proptest::collection::vec(1usize..40, 1..6),
        offset in 0usize..16,
        seed in any::<u64>(),
    ) {
        let toml = format!(
            "[particle]\nmaterial = \"montan-wax\"\n[walls.default]\nmaterial = \"pyrex\"\n\
             [normal]\n{normal}\n[tangential]\n{tangential}\n{effects}"
        );
        let rust = Model::from_toml("m", &toml).unwrap();
        let alone: Vec<Bits> = cases
            .iter()
            .zip(0..)
            .map(|(impact, key)| bits(&rust.resolve(0, impact, ImpactRng::new(seed, key)).unwrap()))
            .collect();
        let model = Shared::new(&toml);
        prop_assert_eq!(&batch(&model, &cases, 0, seed, offset), &alone);
        let mut cut = Vec::new();
        let mut turn = 0;
        while cut.len() < cases.len() {
            let end = (cut.len() + sizes[turn % sizes.len()]).min(cases.len());
            cut.extend(batch(&model, &cases[cut.len()..end], cut.len() as u64, seed, offset + turn));
            turn += 1;
        }
        prop_assert_eq!(&cut, &alone);
        let threads: Vec<Vec<Bits>> = std::thread::scope(|scope| {
            let (model, cases) = (&model, &cases);
            let runs: Vec<_> =
                (0..4).map(|thread| scope.spawn(move || batch(model, cases, 0, seed, offset + thread))).collect();
            runs.into_iter().map(|run| run.join().unwrap()).collect()
        });
        for found in &threads {
            prop_assert_eq!(found, &alone);
        }
    }
}
