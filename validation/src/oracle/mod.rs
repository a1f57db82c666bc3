//! The same impact computed another way. Nothing here uses the library.

pub mod compliant_sphere;
pub mod jkr;
pub mod rigid_sphere;
