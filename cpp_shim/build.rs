//! Compiles the bridge, and with it `nearwall.hpp`, as C++11 with strict warnings.
fn main() {
    let folder = std::env::var("CARGO_MANIFEST_DIR").unwrap_or_default();
    cxx_build::bridge("src/lib.rs")
        .file("src/bridge.cpp")
        .include(folder)
        .std("c++11")
        .flag_if_supported("-pedantic")
        .warnings(true)
        .extra_warnings(true)
        .compile("nearwall_cpp_shim");
    for source in ["src/bridge.h", "src/bridge.cpp", "nearwall.h", "nearwall.hpp"] {
        println!("cargo:rerun-if-changed={source}");
    }
}
