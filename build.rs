//! Names the shared library the way loaders expect: a soname that changes with the ABI, and never unloaded
//! once loaded (a solver may close it while thread-local storage of the Rust runtime is still in use).
fn main() {
    if std::env::var("CARGO_CFG_TARGET_OS").as_deref() == Ok("linux") {
        println!("cargo:rustc-cdylib-link-arg=-Wl,-soname,libnearwall.so.1");
        println!("cargo:rustc-cdylib-link-arg=-Wl,-z,nodelete");
    }
    println!("cargo:rerun-if-changed=build.rs");
}
