//! Tells the library whether the processor has a long multiplication (32 × 32 bits into 64): Cortex-M0, M0+, M1 and M23 have
//! not; and whether it has the DSP extension. No stable `cfg` of the compiler says so.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rustc-check-cfg=cfg(short_multiply, dsp)");
    let target = std::env::var("TARGET").unwrap_or_default();
    if target.starts_with("thumbv6m") || target.starts_with("thumbv8m.base") {
        println!("cargo::rustc-cfg=short_multiply");
    }
    if target.starts_with("thumbv7em") {
        println!("cargo::rustc-cfg=dsp");
    }
}
