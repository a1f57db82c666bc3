//! The same impact computed another way. Nothing here uses the library.

pub mod carried;
pub mod normal_contact;
