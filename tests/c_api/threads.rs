//! A model that many threads share.

use nearwall::c_api::{nw_impact, nw_model};

use crate::calls::{Calls, bytes, c_case};
use crate::common::random::{EVERY_REGIME, random_cases, seed};

const THREADS: usize = 8;

/// A pointer that the library's promise lets threads share.
#[derive(Clone, Copy)]
struct Shared(*const nw_model);

unsafe impl Send for Shared {}
unsafe impl Sync for Shared {}

impl Shared {
    fn pointer(self) -> *const nw_model {
        self.0
    }
}

#[test]
fn eight_threads_get_the_same_bits_in_any_order() {
    let calls = Calls::load();
    let owned = calls.parse(EVERY_REGIME);
    let model = Shared(owned);
    let cases: Vec<nw_impact> = random_cases(seed(), 2000).iter().map(c_case).collect();
    let answer = |case: &nw_impact| {
        let mut wall = 0;
        let status =
            unsafe { (calls.nw_model_find_wall)(model.pointer(), c"quenchRing".as_ptr(), &raw mut wall) };
        assert_eq!((status, wall), (0, 2));
        calls.resolve(model.pointer(), case).map(|outcome| bytes(&outcome))
    };
    let expected: Vec<_> = cases.iter().map(answer).collect();
    let start = std::sync::Barrier::new(THREADS);
    std::thread::scope(|scope| {
        for thread in 0..THREADS {
            let (start, cases, expected, answer) = (&start, &cases, &expected, &answer);
            scope.spawn(move || {
                start.wait();
                for step in 0..cases.len() {
                    // Each thread its own order: up or down, from its own place.
                    let step = if thread % 2 == 0 { step } else { cases.len() - 1 - step };
                    let i = (step + thread * 251) % cases.len();
                    assert_eq!(answer(&cases[i]), expected[i], "thread {thread}, impact {i}");
                }
            });
        }
    });
    calls.free(owned);
}
