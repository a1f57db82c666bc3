//! The same impact computed another way. Nothing here uses the library.

pub mod carried;
pub mod compliant_sphere;
pub mod jkr;
pub mod normal_contact;
pub mod rigid_sphere;
