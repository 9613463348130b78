//! Tells the library whether the processor has a long multiplication (32 × 32 bits into 64): Cortex-M0, M0+, M1 and M23 have
//! not; whether it has the DSP extension; and whether single precision is software. No stable `cfg` of the compiler says so.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rustc-check-cfg=cfg(short_multiply, dsp, soft_float)");
    let target = std::env::var("TARGET").unwrap_or_default();
    if target.starts_with("thumbv6m") || target.starts_with("thumbv8m.base") {
        println!("cargo::rustc-cfg=short_multiply");
    }
    if target.starts_with("thumbv7em") {
        println!("cargo::rustc-cfg=dsp");
    }
    let hard = target.ends_with("eabihf") || target.starts_with("riscv32imaf");
    if (target.starts_with("thumb") || target.starts_with("riscv32")) && !hard {
        println!("cargo::rustc-cfg=soft_float");
    }
}
