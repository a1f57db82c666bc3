#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| nearwall_fuzz::diagnose(bytes));
