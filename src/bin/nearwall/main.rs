//! The command `nearwall`.
fn main() {}
