//! Passes the memory of the board named by the features to the linker, and sets the number type for its core.

use std::path::PathBuf;
use std::{env, fs};

const BOARDS: [&str; 4] = ["qemu-m4f", "qemu-m0", "nucleo-f446re", "nucleo-g071rb"];

fn main() {
    let feature = |board: &str| format!("CARGO_FEATURE_{}", board.to_uppercase().replace('-', "_"));
    let chosen: Vec<_> = BOARDS
        .iter()
        .filter(|board| env::var_os(feature(board)).is_some())
        .collect();
    let [board] = chosen[..] else {
        panic!(
            "one board is needed, {} are given: `cargo qemu-m4f`, or `--features` with one of {BOARDS:?}",
            chosen.len()
        );
    };
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    let memory = format!("boards/{board}.x");
    fs::copy(&memory, out.join("memory.x")).unwrap_or_else(|error| panic!("{memory}: {error}"));
    println!("cargo::rerun-if-changed={memory}");
    println!("cargo::rustc-link-search={}", out.display());
    // Except in jred's own folder, whose `.cargo/config.toml` passes it to all programs.
    if !env::var("CARGO_ENCODED_RUSTFLAGS")
        .unwrap_or_default()
        .contains("-Tlink.x")
    {
        println!("cargo::rustc-link-arg-bins=-Tlink.x");
    }
    // Where single precision is software, the tick computes in integers.
    println!("cargo::rustc-check-cfg=cfg(fixed_point)");
    if env::var("TARGET").is_ok_and(|target| !target.ends_with("hf")) {
        println!("cargo::rustc-cfg=fixed_point");
    }
}
