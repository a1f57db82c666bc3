//! Many impacts in one call: as one by one, or nothing at all.

use std::ptr::{null, null_mut};

use nearwall::c_api::*;
use nearwall::impact::INPUTS;

use crate::calls::{Calls, c_case};
use crate::common::random::{EVERY_REGIME, random_cases, seed};

/// Columns of impacts; `offset` shifts every array by so many bytes, so that nothing is aligned.
struct Columns {
    offset: usize,
    count: usize,
    bytes: Vec<Vec<u8>>,
}

impl Columns {
    fn new(offset: usize, count: usize) -> Self {
        Self { offset, count, bytes: Vec::new() }
    }

    fn put<T: Copy, const N: usize>(
        &mut self,
        values: impl Iterator<Item = T>,
        to_bytes: fn(T) -> [u8; N],
    ) -> *const T {
        let mut column = vec![0; self.offset];
        column.extend(values.flat_map(to_bytes));
        self.bytes.push(column);
        self.bytes[self.bytes.len() - 1][self.offset..].as_ptr().cast()
    }

    /// Every column of `cases`; the seed is that of the first.
    fn of(&mut self, cases: &[nw_impact]) -> nw_impacts {
        let mut impacts = only(self.count, null());
        for (column, input) in impacts.columns_mut().into_iter().zip(&INPUTS) {
            *column = self.put(cases.iter().map(|case| (input.value)(&case.to_impact())), f64::to_ne_bytes);
        }
        nw_impacts {
            walls: self.put(cases.iter().map(|i| i.wall), u32::to_ne_bytes),
            key: self.put(cases.iter().map(|i| i.key), u64::to_ne_bytes),
            seed: cases.first().map_or(0, |case| case.seed),
            ..impacts
        }
    }
}

/// Impacts with a speed only.
fn only(count: usize, v_n: *const f64) -> nw_impacts {
    nw_impacts { count, v_n, ..nw_impacts::default() }
}

/// No outcome wanted.
fn nothing() -> nw_outcomes {
    nw_outcomes::default()
}

/// Poisoned room for the outcomes, one entry more than asked for.
struct Room {
    floats: [Vec<u64>; 4],
    words: [Vec<u32>; 3],
}

const POISON: u64 = 0xA5A5_A5A5_A5A5_A5A5;

impl Room {
    fn new(count: usize) -> Self {
        Self {
            floats: std::array::from_fn(|_| vec![POISON; count + 1]),
            words: std::array::from_fn(|_| vec![POISON as u32; count + 1]),
        }
    }

    fn pointers(&mut self) -> nw_outcomes {
        let [e_n, e_t, p_stick, omega] =
            self.floats.each_mut().map(|column| column.as_mut_ptr().cast::<f64>());
        let [regime, stuck, flags] = self.words.each_mut().map(|column| column.as_mut_ptr());
        nw_outcomes { e_n, e_t, p_stick, omega, regime, stuck, flags, ..nothing() }
    }

    fn row(&self, i: usize) -> [u64; 7] {
        let [e_n, e_t, p_stick, omega] = &self.floats;
        let [regime, stuck, flags] = &self.words;
        [e_n[i], e_t[i], p_stick[i], omega[i], regime[i].into(), stuck[i].into(), flags[i].into()]
    }

    fn untouched(&self) -> bool {
        self.floats.iter().flatten().all(|word| *word == POISON)
            && self.words.iter().flatten().all(|word| *word == POISON as u32)
    }
}

/// Makes an impact unusable.
type Breakage = fn(&mut nw_impact);

fn row(outcome: &nw_outcome) -> [u64; 7] {
    let nw_outcome { e_n, e_t, p_stick, omega, regime, stuck, flags, .. } = *outcome;
    let [e_n, e_t, p_stick, omega] = [e_n, e_t, p_stick, omega].map(f64::to_bits);
    [e_n, e_t, p_stick, omega, regime.into(), stuck.into(), flags.into()]
}

/// A library, a model and impacts that it can resolve, all with the same seed.
fn scene(calls: &Calls) -> (*mut nw_model, Vec<nw_impact>) {
    let model = calls.parse(EVERY_REGIME);
    let mut cases: Vec<nw_impact> = random_cases(seed(), 500).iter().map(c_case).collect();
    cases.retain(|case| calls.resolve(model, case).is_ok());
    assert!(cases.len() > 300);
    (model, cases)
}

#[test]
fn a_batch_is_one_by_one() {
    let calls = Calls::load();
    let (model, cases) = scene(&calls);
    for offset in [0, 1, 4, 7] {
        let mut columns = Columns::new(offset, cases.len());
        let (impacts, mut room) = (columns.of(&cases), Room::new(cases.len()));
        let outcomes = room.pointers();
        let mut first_bad = 4321;
        let status = unsafe { (calls.nw_resolve_batch)(model, &impacts, &outcomes, &raw mut first_bad) };
        assert_eq!((status, first_bad), (NW_OK, 4321));
        for (i, case) in cases.iter().enumerate() {
            assert_eq!(room.row(i), row(&calls.resolve(model, case).unwrap()), "impact {i}");
        }
        let end = cases.len();
        assert_eq!(room.row(end)[0], POISON, "one entry too many");
    }
    calls.free(model);
}

#[test]
fn arrays_that_are_null_stand_for_the_defaults() {
    let calls = Calls::load();
    let model = calls.parse(&EVERY_REGIME.replace("width = 0.05", "width = 5"));
    let v_n: Vec<f64> = (0..100).map(|i| 0.1 * f64::from(i)).collect();
    let impacts = nw_impacts { wall: 1, seed: 9, ..only(v_n.len(), v_n.as_ptr()) };
    let mut room = Room::new(v_n.len());
    let outcomes = room.pointers();
    assert_eq!(unsafe { (calls.nw_resolve_batch)(model, &impacts, &outcomes, null_mut()) }, NW_OK);
    for (i, v_n) in v_n.iter().enumerate() {
        let one = nw_impact { v_n: *v_n, wall: 1, seed: 9, key: i as u64, ..nw_impact::default() };
        assert_eq!(room.row(i), row(&calls.resolve(model, &one).unwrap()));
    }
    let mut e_t = vec![-1.0; v_n.len()];
    let some = nw_outcomes { e_t: e_t.as_mut_ptr(), ..nothing() };
    assert_eq!(unsafe { (calls.nw_resolve_batch)(model, &impacts, &some, null_mut()) }, NW_OK);
    assert!(e_t.iter().enumerate().all(|(i, e_t)| e_t.to_bits() == room.row(i)[1]));
    assert_eq!(unsafe { (calls.nw_resolve_batch)(model, &impacts, &nothing(), null_mut()) }, NW_OK);
    calls.free(model);
}

#[test]
fn one_bad_impact_and_nothing_is_written() {
    let calls = Calls::load();
    let (model, cases) = scene(&calls);
    let last = cases.len() - 1;
    let faults: [(i32, Breakage); 5] = [
        (NW_BAD_STATE, |impact| impact.v_n = f64::NAN),
        (NW_BAD_STATE, |impact| impact.omega = f64::INFINITY),
        (NW_BAD_STATE, |impact| impact.d = 0.0),
        (NW_UNKNOWN_WALL, |impact| impact.wall = 3),
        (NW_OUT_OF_RANGE, |impact| (impact.wall, impact.T_w, impact.T_under) = (2, 900.0, 0.0)),
    ];
    for (status, break_it) in faults {
        for bad in [0, 1, 17, last] {
            let mut broken = cases.clone();
            break_it(&mut broken[bad]);
            if bad < last {
                broken[last].v_t = -1.0;
            }
            let mut columns = Columns::new(0, broken.len());
            let (impacts, mut room) = (columns.of(&broken), Room::new(broken.len()));
            let outcomes = room.pointers();
            let mut first_bad = usize::MAX;
            let found = unsafe { (calls.nw_resolve_batch)(model, &impacts, &outcomes, &raw mut first_bad) };
            assert_eq!((found, first_bad), (status, bad));
            assert!(room.untouched());
            let found = unsafe { (calls.nw_resolve_batch)(model, &impacts, &outcomes, null_mut()) };
            assert!(found == status && room.untouched());
        }
    }
    calls.free(model);
}

#[test]
fn counts_null_pointers_and_other_sizes() {
    let calls = Calls::load();
    let model = calls.parse(EVERY_REGIME);
    let v_n = [1.0; 4];
    let mut room = Room::new(4);
    let outcomes = room.pointers();
    let good = only(4, v_n.as_ptr());
    let batch = |model: *const nw_model, impacts: *const nw_impacts, outcomes: *const nw_outcomes| {
        let mut first_bad = 4321;
        let status = unsafe { (calls.nw_resolve_batch)(model, impacts, outcomes, &raw mut first_bad) };
        assert_eq!(first_bad, 4321, "no impact is at fault");
        status
    };
    assert_eq!(batch(model, &only(0, null()), &nothing()), NW_OK);
    assert_eq!(batch(model, &only(0, null()), &outcomes), NW_OK);
    assert_eq!(batch(model, &only(1, null()), &outcomes), NW_NULL_POINTER);
    for count in [usize::MAX, usize::MAX / 8, usize::MAX / 16 + 1] {
        assert_eq!(batch(model, &only(count, v_n.as_ptr()), &outcomes), NW_STRUCT_SIZE);
    }
    assert_eq!(batch(null(), &good, &outcomes), NW_NULL_POINTER);
    assert_eq!(batch(model, null(), &outcomes), NW_NULL_POINTER);
    assert_eq!(batch(model, &good, null()), NW_NULL_POINTER);
    for change in [-8_i32, -4, -1, 1, 4, 8] {
        let struct_size = good.struct_size.wrapping_add_signed(change);
        assert_eq!(batch(model, &nw_impacts { struct_size, ..good }, &outcomes), NW_STRUCT_SIZE);
        let struct_size = outcomes.struct_size.wrapping_add_signed(change);
        assert_eq!(batch(model, &good, &nw_outcomes { struct_size, ..outcomes }), NW_STRUCT_SIZE);
    }
    assert!(room.untouched());
    calls.free(model);
}
