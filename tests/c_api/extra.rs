//! Inputs that the model file declares: names, words, defaults, and their values in one impact and in a batch.

use std::ffi::{CStr, CString, c_char};
use std::ptr::{null, null_mut};

use nearwall::c_api::*;

use crate::calls::Calls;

/// `e_n` = 0.5 + 0.2 humidity, `e_t` = 0.76, or 0.66 on glass.
const MODEL: &str = "[particle]\nmaterial = \"montan-wax\"\n[walls.default]\nmaterial = \"pyrex\"\n\
    [normal]\nmodel = \"constant\"\ne_n = 0.5\n[tangential]\nmodel = \"constant\"\ne_t = 0.76\n\
    [inputs.humidity]\ndefault = 0.4\n[inputs.\"wall plate\"]\nlabels = [\"steel\", \"glass\"]\n\
    [[effects]]\nkind = \"fitted-curve\"\ninput = \"humidity\"\non = \"e_n\"\nknots = [0, 1]\nvalues = [0, 0.2]\n\
    [[effects]]\nkind = \"fitted-curve\"\ninput = \"wall plate\"\non = \"e_t\"\nknots = [\"steel\", \"glass\"]\n\
    values = [0, -0.1]\n";

const UNTOUCHED: f64 = -1.0;

struct Loaded {
    calls: Calls,
    model: *mut nw_model,
}

impl Loaded {
    fn new() -> Self {
        let calls = Calls::load();
        let model = calls.parse(MODEL);
        Self { calls, model }
    }

    fn name(&self, index: u32, size: usize) -> Result<String, i32> {
        let mut name = [b'x' as c_char; 40];
        let status = unsafe { (self.calls.nw_extra_input_name)(self.model, index, name.as_mut_ptr(), size) };
        if status != NW_OK {
            assert!(name.iter().all(|letter| *letter == b'x' as c_char), "written on failure");
            return Err(status);
        }
        assert!(name[size..].iter().all(|letter| *letter == b'x' as c_char), "written beyond the end");
        Ok(unsafe { CStr::from_ptr(name.as_ptr()) }.to_str().unwrap().to_owned())
    }

    fn word(&self, index: u32, place: u32) -> Result<String, i32> {
        let mut word = [0; 40];
        let status = unsafe {
            (self.calls.nw_extra_input_word)(self.model, index, place, word.as_mut_ptr(), word.len())
        };
        let text = unsafe { CStr::from_ptr(word.as_ptr()) }.to_str().unwrap().to_owned();
        if status == NW_OK { Ok(text) } else { Err(status) }
    }

    /// The value of a text, or status and message.
    fn value(&self, index: u32, text: &str) -> Result<f64, (i32, String)> {
        let (text, mut value, mut message) = (CString::new(text).unwrap(), UNTOUCHED, [0; 200]);
        let call = self.calls.nw_extra_input_value;
        let status =
            unsafe { call(self.model, index, text.as_ptr(), &raw mut value, message.as_mut_ptr(), 200) };
        if status == NW_OK {
            assert_eq!(message[0], 0, "a message on success");
            return Ok(value);
        }
        assert_eq!(value, UNTOUCHED);
        Err((status, unsafe { CStr::from_ptr(message.as_ptr()) }.to_str().unwrap().to_owned()))
    }

    /// `e_n` and `e_t` of an impact with these values first in `extra`.
    fn restitutions(&self, extra: &[f64]) -> Result<[f64; 2], i32> {
        let mut impact = nw_impact { v_n: 2.0, v_t: 1.0, ..nw_impact::default() };
        impact.extra[..extra.len()].copy_from_slice(extra);
        self.calls.resolve(self.model, &impact).map(|outcome| [outcome.e_n, outcome.e_t])
    }
}

impl Drop for Loaded {
    fn drop(&mut self) {
        self.calls.free(self.model);
    }
}

fn near(found: Result<[f64; 2], i32>, e_n: f64, e_t: f64) {
    let [n, t] = found.unwrap();
    assert!((n - e_n).abs() < 1e-15 && (t - e_t).abs() < 1e-15, "{n} {t}, expected {e_n} {e_t}");
}

#[test]
fn names_defaults_and_words_are_those_of_the_file() {
    let loaded = Loaded::new();
    let (calls, model) = (&loaded.calls, loaded.model);
    let mut count = 77;
    assert_eq!(unsafe { (calls.nw_extra_input_count)(model, &raw mut count) }, NW_OK);
    assert_eq!(count, 2);
    assert_eq!(loaded.name(0, 40).as_deref(), Ok("humidity"));
    assert_eq!(loaded.name(1, 5).as_deref(), Ok("wall"));
    assert_eq!(loaded.name(2, 40), Err(NW_UNKNOWN_INPUT));
    assert_eq!(loaded.name(0, 0), Err(NW_NULL_POINTER));

    assert_eq!([0, 1].map(|place| loaded.word(1, place).unwrap()), ["steel", "glass"]);
    assert_eq!(
        [(0, 0), (1, 2), (9, 0)].map(|(i, w)| loaded.word(i, w)),
        [const { Err(NW_UNKNOWN_INPUT) }; 3]
    );

    let default = |index| {
        let mut value = UNTOUCHED;
        let status = unsafe { (calls.nw_extra_input_default)(model, index, &raw mut value) };
        (status, value)
    };
    assert_eq!((default(0), default(2)), ((NW_OK, 0.4), (NW_UNKNOWN_INPUT, UNTOUCHED)));
    assert!(default(1).1.is_nan());

    assert_eq!((loaded.value(0, "0.25"), loaded.value(1, "glass")), (Ok(0.25), Ok(1.0)));
    let refused = |index, text, status, words: &str| {
        let (found, message) = loaded.value(index, text).unwrap_err();
        assert!(found == status && message.contains(words), "{found}: {message}");
    };
    refused(0, "damp", NW_BAD_STATE, "`damp` is not a finite number");
    refused(0, "inf", NW_BAD_STATE, "`inf` is not a finite number");
    refused(1, "glas", NW_BAD_STATE, "did you mean `glass`? (known here: steel, glass)");
    refused(9, "glass", NW_UNKNOWN_INPUT, "declares no such input");
}

#[test]
fn null_pointers_are_refused() {
    let Loaded { calls, model } = &Loaded::new();
    let (model, text, mut value) = (*model, c"1".as_ptr(), UNTOUCHED);
    let statuses = unsafe {
        [
            (calls.nw_extra_input_count)(model, null_mut()),
            (calls.nw_extra_input_name)(model, 0, null_mut(), 5),
            (calls.nw_extra_input_name)(null(), 0, null_mut(), 5),
            (calls.nw_extra_input_word)(model, 1, 0, null_mut(), 5),
            (calls.nw_extra_input_default)(model, 0, null_mut()),
            (calls.nw_extra_input_default)(null(), 0, &raw mut value),
            (calls.nw_extra_input_value)(model, 0, null(), &raw mut value, null_mut(), 0),
            (calls.nw_extra_input_value)(model, 0, text, null_mut(), null_mut(), 0),
            (calls.nw_extra_input_value)(null(), 0, text, &raw mut value, null_mut(), 0),
        ]
    };
    assert_eq!((statuses, value), ([NW_NULL_POINTER; 9], UNTOUCHED));
}

#[test]
fn an_impact_takes_its_values_or_the_defaults() {
    let loaded = Loaded::new();
    near(loaded.restitutions(&[]), 0.58, 0.76);
    near(loaded.restitutions(&[f64::NAN, 0.0]), 0.58, 0.76);
    near(loaded.restitutions(&[0.9]), 0.68, 0.76);
    near(loaded.restitutions(&[0.9, 1.0]), 0.68, 0.66);
    // Entries beyond the model's inputs are not read.
    near(loaded.restitutions(&[0.9, 1.0, 7.0, f64::INFINITY]), 0.68, 0.66);
    assert_eq!(loaded.restitutions(&[f64::INFINITY]), Err(NW_BAD_STATE));
}

#[test]
fn a_batch_takes_an_array_for_each_input() {
    let loaded = Loaded::new();
    let (v_n, humidity, plate) = ([1.0, 2.0, 3.0], [0.0, f64::NAN, 1.0], [1.0, 0.0, f64::NAN]);
    let resolve = |extra: [*const f64; 2]| {
        let mut impacts =
            nw_impacts { count: 3, v_n: v_n.as_ptr(), v_t: v_n.as_ptr(), ..nw_impacts::default() };
        impacts.extra[..2].copy_from_slice(&extra);
        let (mut e_n, mut e_t) = ([UNTOUCHED; 3], [UNTOUCHED; 3]);
        let outcomes = nw_outcomes { e_n: e_n.as_mut_ptr(), e_t: e_t.as_mut_ptr(), ..nw_outcomes::default() };
        let mut bad = 77;
        let call = loaded.calls.nw_resolve_batch;
        let status = unsafe { call(loaded.model, &raw const impacts, &raw const outcomes, &raw mut bad) };
        if status != NW_OK {
            assert_eq!((e_n, e_t), ([UNTOUCHED; 3], [UNTOUCHED; 3]));
            return Err((status, bad));
        }
        Ok([0, 1, 2].map(|index| [e_n[index], e_t[index]]))
    };
    let all = resolve([humidity.as_ptr(), plate.as_ptr()]).unwrap();
    for ([e_n, e_t], found) in [[0.5, 0.66], [0.58, 0.76], [0.7, 0.76]].into_iter().zip(all) {
        near(Ok(found), e_n, e_t);
    }
    resolve([null(), null()]).unwrap().into_iter().for_each(|found| near(Ok(found), 0.58, 0.76));
    let wrong = [0.1, 0.2, f64::INFINITY];
    assert_eq!(resolve([wrong.as_ptr(), null()]), Err((NW_BAD_STATE, 2)));
}

/// Groups and forms are computed by the library: the caller gives inputs alone. At 5 m/s and 0.03 N/m, We = 100:
/// e_n = 2/sqrt(100); the capture is half at pi_1 = 100.
#[test]
fn groups_and_forms_have_the_bits_of_the_library() {
    let plain = MODEL.split("[inputs.").next().unwrap();
    let form = |input: &str, on: &str, rest: &str| {
        format!("[[effects]]\nkind = \"fitted-form\"\ninput = \"{input}\"\non = \"{on}\"\n{rest}\n")
    };
    let text = format!(
        "{plain}[inputs.sigma_p]\ndefault = 0.03\n\
         [groups]\npi_1 = {{ rho_p = 1, v_n = 2, d = 1, sigma_p = -1 }}\n{}{}",
        form("We", "e_n", "form = \"power\"\na = 2\nb = -0.5"),
        form("pi_1", "capture", "form = \"logistic\"\nx_0 = 100\nn = 4"),
    );
    let rust = nearwall::Model::from_toml("m", &text).unwrap();
    let calls = Calls::load();
    let model = calls.parse(&text);
    let mut impact = nw_impact { v_n: 5.0, v_t: 1.0, d: 120e-6, T_p: 393.15, ..nw_impact::default() };
    let mut same = nearwall::Impact {
        normal_speed: 5.0,
        diameter: 120e-6,
        particle_temperature: 393.15,
        ..Default::default()
    };
    same.tangential_speed = 1.0;
    for (tension, by_hand) in [(f64::NAN, Some([0.2, 0.5])), (0.05, None), (0.4, None)] {
        (impact.extra[0], same.extra[0]) = (tension, tension);
        let found = calls.resolve(model, &impact).unwrap();
        let expected = rust.resolve(0, &same, nearwall::ImpactRng::default()).unwrap();
        assert_eq!(found.e_n.to_bits(), expected.normal_restitution.to_bits());
        assert_eq!(found.p_stick.to_bits(), expected.sticking_probability.to_bits());
        if let Some([e_n, p_stick]) = by_hand {
            assert!((found.e_n - e_n).abs() < 1e-12 && (found.p_stick - p_stick).abs() < 1e-12);
        }
    }
    calls.free(model);
}
