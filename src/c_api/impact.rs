//! The structs of one and of many impacts, from the table of inputs.
#![allow(non_camel_case_types)]

use super::boundary::get;
use super::extra::NW_EXTRA_INPUTS;
use super::types::zero_by_default;
use crate::impact::{ExtraInputs, INPUTS, Impact, for_each_input};
use crate::rng::ImpactRng;

/// Items, and their text for cbindgen, which does not expand macros.
macro_rules! with_source {
    ($($item:tt)*) => {
        $($item)*

        /// The structs that follow from the table of inputs, as Rust source.
        #[doc(hidden)]
        pub const INPUT_STRUCTS: &str = stringify!($($item)*);
    };
}

macro_rules! define_structs {
    ($(
        #[doc = $about:literal]
        $name:ident, $field:ident, $place:ident, $unit:literal, $bounds:ident, $default:literal;
    )*) => {
        with_source! {
            /// One particle as it reaches a wall. Fill it with `nw_impact_init`, then set the known inputs.
            #[repr(C)]
            #[derive(Debug, Clone, Copy)]
            #[allow(non_snake_case)]
            pub struct nw_impact {
                /// `sizeof(nw_impact)`.
                pub struct_size: u32,
                /// Index of the wall, from `nw_model_find_wall`.
                pub wall: u32,
                /// Seed of the run's random draws.
                pub seed: u64,
                /// Unique key of this impact: random draws depend only on `seed` and `key`.
                pub key: u64,
                $(
                    #[doc = $about]
                    pub $name: f64,
                )*
                /// The inputs that the model file declares, in the order of `nw_extra_input_name`; NaN for the default.
                pub extra: [f64; NW_EXTRA_INPUTS],
            }

            /// Arrays of impacts, each with `count` entries. Only `v_n` is required; a null array
            /// means the value that `nw_impact_init` sets, and for `key` the index of the entry:
            /// with a null `key`, change `seed` in every call, or each call repeats the draws.
            #[repr(C)]
            #[derive(Debug, Clone, Copy)]
            #[allow(non_snake_case)]
            pub struct nw_impacts {
                /// `sizeof(nw_impacts)`.
                pub struct_size: u32,
                /// Wall of every impact if `walls` is null.
                pub wall: u32,
                /// Number of impacts.
                pub count: usize,
                /// Seed of all draws.
                pub seed: u64,
                /// Wall of each impact.
                pub walls: *const u32,
                /// Unique key of each impact.
                pub key: *const u64,
                $(
                    #[doc = $about]
                    pub $name: *const f64,
                )*
                /// The inputs that the model file declares, in the order of `nw_extra_input_name`; NaN for the default.
                pub extra: [*const f64; NW_EXTRA_INPUTS],
            }
        }

        /// Wall 0, seed and key 0.
        impl From<&Impact> for nw_impact {
            fn from(impact: &Impact) -> Self {
                let struct_size = size_of::<Self>() as u32;
                let extra = impact.extra.0;
                Self { struct_size, wall: 0, seed: 0, key: 0, $($name: impact.$field,)* extra }
            }
        }

        impl nw_impact {
            /// The inputs.
            pub fn to_impact(self) -> Impact {
                Impact { $($field: self.$name,)* extra: ExtraInputs(self.extra) }
            }
        }

        impl nw_impacts {
            /// The arrays of the inputs, in the order of [`INPUTS`].
            pub fn columns(&self) -> [*const f64; INPUTS.len()] {
                [$(self.$name,)*]
            }

            /// The same, to set them.
            pub fn columns_mut(&mut self) -> [&mut *const f64; INPUTS.len()] {
                [$(&mut self.$name,)*]
            }

            /// One impact with its wall and its draws.
            ///
            /// # Safety
            /// `index < count`, and every array that is not null has `count` entries.
            pub(super) unsafe fn entry(&self, index: usize) -> (usize, Impact, ImpactRng) {
                // SAFETY: the caller's promise.
                unsafe {
                    let extra = ExtraInputs(self.extra.map(|array| get(array, index, f64::NAN)));
                    let impact = Impact { $($field: get(self.$name, index, $default),)* extra };
                    let wall = get(self.walls, index, self.wall) as usize;
                    (wall, impact, ImpactRng::new(self.seed, get(self.key, index, index as u64)))
                }
            }
        }
    };
}

for_each_input!(define_structs);
zero_by_default!(nw_impacts);

impl Default for nw_impact {
    fn default() -> Self {
        Self::from(&Impact::default())
    }
}
