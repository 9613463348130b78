//! Functions of a real number, by libm: the same bits on every system, as WebAssembly too. Those of the standard library differ in the last bit from
//! one system to the next; `tool/clippy.toml` refuses them. Square roots and integer powers do not differ.

pub use libm::{
    acos, asin, atan, atan2, cbrt, cos, exp, exp2, expm1, hypot, log as ln, log2, log10, pow, sin,
    sincos as sin_cos, tan, tanh,
};

#[cfg(test)]
mod tests {
    use super::{exp2, log2, log10};

    /// Rounding to digits takes the whole part of a logarithm.
    #[test]
    fn powers_have_whole_logarithms() {
        for n in -300..=300 {
            let power: f64 = format!("1e{n}").parse().expect("a number");
            assert_eq!(log10(power).to_bits(), f64::from(n).to_bits(), "1e{n}");
        }
        for n in -1022..=1023 {
            let power = f64::from_bits(((n + 1023) as u64) << 52);
            assert_eq!(log2(power).to_bits(), f64::from(n).to_bits(), "2^{n}");
            assert_eq!(exp2(f64::from(n)).to_bits(), power.to_bits(), "2^{n}");
        }
    }
}
