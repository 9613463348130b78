//! Adds defmt's linker script to this package's program; link.x is named in .cargo/config.toml.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    if std::env::var("CARGO_CFG_TARGET_OS").as_deref() == Ok("none") {
        println!("cargo::rustc-link-arg=-Tdefmt.x");
    }
}
