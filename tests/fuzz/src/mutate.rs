//! Random changes of bytes.

use rand::{Rng, RngExt as _};

/// Words of jred's texts, and numbers at the ends of every range.
const WORDS: &[&str] = &[
    "0",
    "-0",
    "1",
    "-1",
    "1e308",
    "-1e308",
    "1e-308",
    "5e-324",
    "1e400",
    "nan",
    "inf",
    "-inf",
    "0.1",
    "1e6",
    "1e-6",
    "1_0",
    "0x1",
    "4294967296",
    "18446744073709551616",
    "\"",
    "'",
    "\"\"\"",
    "[",
    "]",
    "[[",
    "{",
    "}",
    "=",
    ",",
    ";",
    ":",
    "#",
    "# ",
    "\n",
    "\r\n",
    "\r",
    "\t",
    "\0",
    "\u{1b}[31m",
    "\u{202e}",
    "\u{feff}",
    "°",
    "φ",
    " deg",
    " rad",
    " rpm",
    " mm",
    " m",
    " kg",
    " kg m^2",
    " N m",
    " N",
    " s",
    " ms",
    " %",
    " degC",
    " m/s^2",
    "null",
    "true",
    "\\u0000",
    "../",
    "/dev/stdin",
    "--",
    "-",
];

/// Largest number of changes to one input.
const CHANGES: usize = 6;

/// Largest size of an input (bytes).
const LONGEST: usize = 1 << 16;

/// One of the `seeds` with a few changes: bits flipped, parts removed, doubled, replaced, or taken from another seed.
///
/// # Panics
/// There are no seeds.
pub fn mutated(rng: &mut impl Rng, seeds: &[Vec<u8>]) -> Vec<u8> {
    let mut bytes = seeds[rng.random_range(0..seeds.len())].clone();
    for _ in 0..rng.random_range(1..=CHANGES) {
        let part = part(rng, bytes.len());
        match rng.random_range(0..7) {
            0 => bytes
                .iter_mut()
                .skip(part.start)
                .take(1)
                .for_each(|byte| *byte ^= 1 << rng.random_range(0..8)),
            1 => drop(bytes.drain(part)),
            2 => {
                let doubled = bytes[part.clone()].to_vec();
                bytes.splice(part.start..part.start, doubled);
            }
            3 => {
                let other = &seeds[rng.random_range(0..seeds.len())];
                let taken = self::part(rng, other.len());
                bytes.splice(part, other[taken].iter().copied());
            }
            4 => drop(bytes.splice(
                part.start..part.start,
                WORDS[rng.random_range(0..WORDS.len())].bytes(),
            )),
            // A number, if there is one, becomes another word.
            5 => {
                let number = number_behind(&bytes, part.start);
                bytes.splice(number, WORDS[rng.random_range(0..WORDS.len())].bytes());
            }
            _ => bytes[part].iter_mut().for_each(|byte| *byte = rng.random()),
        }
    }
    bytes.truncate(LONGEST);
    bytes
}

/// A part of the input, mostly a short one.
fn part(rng: &mut impl Rng, length: usize) -> std::ops::Range<usize> {
    let start = rng.random_range(0..=length);
    let longest = if rng.random_ratio(1, 4) { 200 } else { 8 };
    start..length.min(start + rng.random_range(0..=longest))
}

/// Range of the next number from `start` on; empty at the end without a number.
fn number_behind(bytes: &[u8], start: usize) -> std::ops::Range<usize> {
    let digit = |byte: &u8| byte.is_ascii_digit() || *byte == b'.';
    let from = bytes[start..]
        .iter()
        .position(digit)
        .map_or(bytes.len(), |k| start + k);
    let length = bytes[from..].iter().take_while(|byte| digit(byte)).count();
    from..from + length
}
