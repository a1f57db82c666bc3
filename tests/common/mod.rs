//! What several tests share: the golden table, measured slags and resuspension, random impacts,
//! compilers and a browser.
#![allow(dead_code, reason = "each test uses its part")]
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "clippy.toml's leave for tests does not reach their helpers"
)]

pub mod browser;
pub mod compile;
pub mod golden;
pub mod measured_resuspension;
pub mod measured_slags;
pub mod random;
