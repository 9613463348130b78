//! C sees the same as Rust.

use std::io::Write as _;
use std::process::{Command, Stdio};

use jred::{CurveSet, Q31, Spline, curves, include_image};

use crate::memory::Memory;

mod axis;
mod c99;
mod encoder;
mod follower;
mod header;
mod numbers;
mod sets;
mod slider_crank;
mod ticks;

const PRESS: CurveSet = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;

type Press = Memory<Spline<f32>>;

#[allow(improper_ctypes, reason = "C sees the memory of a model as bytes")]
unsafe extern "C" {
    fn jred_spline_f32_load(
        memory: *mut Press,
        set: CurveSet,
        words: *const u32,
        length: usize,
    ) -> i32;
    fn jred_spline_q31_load(
        memory: *mut Memory<Spline<Q31>>,
        set: CurveSet,
        words: *const u32,
        length: usize,
    ) -> i32;
}

fn words(bytes: &[u8]) -> Vec<u32> {
    let (words, _) = bytes.as_chunks();
    words.iter().map(|word| u32::from_le_bytes(*word)).collect()
}

/// The image of the press.
fn press() -> Vec<u32> {
    words(include_image!("../../examples/data/press_f32.jred"))
}

/// A fixed sequence of numbers of every magnitude (xorshift; G. Marsaglia 2003).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }
    fn below(&mut self, most: u64) -> u64 {
        self.next() % most
    }
}

/// The answers of a program `tests/NAME.c`, one per line, with the products of this core or of the smallest cores.
fn answers(name: &str, asked: &str, short: bool) -> Vec<String> {
    let program = format!("jred-{name}-{}-{short}", std::process::id());
    let program = std::env::temp_dir().join(program);
    let compiled = Command::new("cc")
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args([
            "-std=c99",
            "-Wall",
            "-Wextra",
            "-Wpedantic",
            "-Wconversion",
            "-Werror",
            "-O2",
            "-fsanitize=undefined",
        ])
        .args([
            "-fno-sanitize-recover",
            "-ffp-contract=off",
            "-Iinclude",
            "-Ic99",
        ])
        .arg(format!("-DJRED_SHORT_MULTIPLY_={}", u8::from(short)))
        .args([&format!("tests/{name}.c"), "-o"])
        .arg(&program)
        .status();
    assert!(
        compiled
            .expect("a C compiler is what Rust links with")
            .success()
    );
    let mut child = Command::new(&program)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut stdin = child.stdin.take().unwrap();
    let asked = asked.to_owned();
    let writer = std::thread::spawn(move || stdin.write_all(asked.as_bytes()).unwrap());
    let output = child.wait_with_output().unwrap();
    writer.join().unwrap();
    std::fs::remove_file(&program).unwrap();
    assert!(output.status.success());
    let text = String::from_utf8(output.stdout).unwrap();
    text.lines().map(str::to_owned).collect()
}
