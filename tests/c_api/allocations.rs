//! Deciding impacts allocates nothing, one at a time or in a batch, whatever their number.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::ptr::{null, null_mut};

use nearwall::c_api::*;

struct Counting;

thread_local! {
    static COUNT: Cell<usize> = const { Cell::new(0) };
}

// SAFETY: the system's allocator does the work.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        COUNT.with(|count| count.set(count.get() + 1));
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

const WAX: &str = "[particle]\nmaterial = \"montan-wax\"\n[walls.default]\nmaterial = \"pyrex\"\n\
    [normal]\nmodel = \"thornton-ning\"\nyield_ratio = 0.7\n\
    [tangential]\nmodel = \"sliding-rolling\"\nfriction = 0.28\n";
const MELTING: &str = "[[effects]]\nkind = \"melting-transition\"\ntemperature = 360\nwidth = 7\n";
const GENERAL: &str = "[[effects]]\nkind = \"gas-lift\"\nstrength = 0.05\n";

const BY_NAME: &str = "[particle]\nmaterial = \"montan-wax\"\n[walls.default]\nmaterial = \"pyrex\"\n\
    [normal]\nmodel = \"bons\"\nwork_of_adhesion = 1e-4\n[tangential]\nmodel = \"maw-barber-fawcett\"\nfriction = 0.28\n";

/// Allocations of the calls on one model: single ones, then a batch of so many.
fn allocations(model: &str, count: usize) -> usize {
    let (mut handle, speeds) = (null_mut(), vec![1.5; count]);
    let mut e_n = vec![0.0; count];
    let mut outcome = nw_outcome::default();
    let impact = nw_impact { v_n: 1.5, v_t: 0.5, ..nw_impact::default() };
    // SAFETY: live structs, and arrays of `count` entries.
    unsafe {
        let loaded = nw_model_parse(model.as_ptr().cast(), model.len(), null(), &mut handle, null_mut(), 0);
        assert_eq!(loaded, NW_OK, "{model}");
        let mut impacts: nw_impacts = std::mem::zeroed();
        let mut outcomes: nw_outcomes = std::mem::zeroed();
        (impacts.struct_size, outcomes.struct_size) =
            (size_of::<nw_impacts>() as u32, size_of::<nw_outcomes>() as u32);
        (impacts.count, impacts.v_n, outcomes.e_n) = (count, speeds.as_ptr(), e_n.as_mut_ptr());
        let before = COUNT.get();
        assert_eq!(nw_resolve(handle, &impact, &mut outcome), NW_OK);
        assert_eq!(nw_resolve_batch(handle, &impacts, &outcomes, null_mut()), NW_OK);
        let counted = COUNT.get() - before;
        nw_model_free(handle);
        counted
    }
}

#[test]
fn calls_allocate_nothing() {
    let before = COUNT.get();
    drop(std::hint::black_box(Box::new(1)));
    assert!(COUNT.get() > before, "the counter counts");
    for model in [WAX.to_owned(), WAX.to_owned() + MELTING, WAX.to_owned() + GENERAL, BY_NAME.to_owned()] {
        // The first batch of a process asks the processor for its vectors.
        allocations(&model, 1);
        for count in [0, 1, 127, 10_000] {
            assert_eq!(allocations(&model, count), 0, "{count} impacts, {model}");
        }
    }
}
