//! Upper halves of products, the same bits with and without a long multiplication.
//!
//! Cortex-M3 and up multiply 32 × 32 bits into 64 in one instruction. Cortex-M0, M0+ and M23 do not: the compiler would call a helper of about 40
//! instructions, so that products are composed of 16-bit halves instead. `build.rs` sets `short_multiply` for them; the tests compare both.

/// Floor of a·b/2³².
#[inline(always)]
pub(crate) fn high(a: i32, b: i32) -> i32 {
    if cfg!(short_multiply) {
        high_by_halves(a, b)
    } else {
        ((i64::from(a) * i64::from(b)) >> 32) as i32
    }
}

#[inline(always)]
fn high_by_halves(a: i32, b: i32) -> i32 {
    let (a1, a0) = (a >> 16, a & 0xffff);
    let (b1, b0) = (b >> 16, b & 0xffff);
    let low = ((a0 as u32).wrapping_mul(b0 as u32) >> 16) as i32;
    // No sum overflows: |a0·b1| ≤ 65535·2¹⁵, and at most 65535 is added.
    let middle = a0.wrapping_mul(b1).wrapping_add(low);
    let other = a1.wrapping_mul(b0).wrapping_add(middle & 0xffff);
    a1.wrapping_mul(b1)
        .wrapping_add(middle >> 16)
        .wrapping_add(other >> 16)
}

/// Floor of x·n/2¹⁶, where n is the upper half of u.
#[inline(always)]
pub(crate) fn high_short(x: i32, u: i32) -> i32 {
    if cfg!(short_multiply) {
        high_short_by_halves(x, u)
    } else if cfg!(dsp) {
        // One instruction (SMULWT), which reads the upper half of u directly.
        ((i64::from(x) * i64::from(u >> 16)) >> 16) as i32
    } else {
        high(x, u & !0xffff)
    }
}

#[inline(always)]
fn high_short_by_halves(x: i32, u: i32) -> i32 {
    let n = u >> 16;
    let low = (x & 0xffff).wrapping_mul(n) >> 16;
    (x >> 16).wrapping_mul(n).wrapping_add(low)
}

/// The words of b = upper·2³² + lower, with a signed lower word, so that both factors of a long product are signed.
pub(crate) const fn signed_words(b: u64) -> (i32, u32) {
    let lower = b as i32;
    (lower, ((b >> 32) as u32).wrapping_add((lower < 0) as u32))
}

/// Floor of (a·b + c)/2³², modulo 2³², from the [`signed_words`] of b.
#[inline(always)]
pub(crate) const fn upper_of_sum(a: i32, (lower, upper): (i32, u32), c: u64) -> u32 {
    let sum = if cfg!(short_multiply) {
        upper_of_short_sum_by_halves(a, lower, c)
    } else {
        ((a as i64 * lower as i64).wrapping_add(c as i64) >> 32) as u32
    };
    sum.wrapping_add((a as u32).wrapping_mul(upper))
}

/// The same for a 32-bit factor b.
#[inline(always)]
const fn upper_of_short_sum_by_halves(a: i32, b: i32, c: u64) -> u32 {
    let (a1, a0) = (a >> 16, a & 0xffff);
    let (b1, b0) = (b >> 16, b & 0xffff);
    // No sum overflows, as in `high_by_halves`.
    let low = (a0 as u32).wrapping_mul(b0 as u32);
    let middle = a0.wrapping_mul(b1).wrapping_add((low >> 16) as i32);
    let other = a1.wrapping_mul(b0).wrapping_add(middle & 0xffff);
    let upper = a1
        .wrapping_mul(b1)
        .wrapping_add(middle >> 16)
        .wrapping_add(other >> 16);
    let (_, carry) = ((other as u32) << 16 | low & 0xffff).overflowing_add(c as u32);
    (upper as u32)
        .wrapping_add((c >> 32) as u32)
        .wrapping_add(carry as u32)
}

#[cfg(test)]
mod tests {
    use super::{
        high_by_halves, high_short_by_halves, signed_words, upper_of_short_sum_by_halves,
        upper_of_sum,
    };

    /// A fixed sequence of numbers of every magnitude (xorshift; G. Marsaglia 2003), after the extremes.
    fn numbers() -> impl Iterator<Item = i32> + Clone {
        let mut state = 0x9e37_79b9_u32;
        let random = core::iter::repeat_with(move || {
            state ^= state << 13;
            state ^= state >> 17;
            state ^= state << 5;
            (state as i32) >> (state % 31)
        });
        [
            i32::MIN,
            i32::MAX,
            0,
            1,
            -1,
            0xffff,
            0x1_0000,
            -0x1_0000,
            0x7fff_0000,
        ]
        .into_iter()
        .chain(random.take(600))
    }

    #[test]
    fn halves_give_the_bits_of_the_long_product() {
        for a in numbers() {
            for b in numbers() {
                let long = ((i64::from(a) * i64::from(b)) >> 32) as i32;
                assert_eq!(high_by_halves(a, b), long, "{a} · {b}");
                let u = b;
                let long = ((i64::from(a) * i64::from(u & !0xffff)) >> 32) as i32;
                assert_eq!(high_short_by_halves(a, u), long, "{a} · {u}");
            }
        }
    }
    /// Compared with 128-bit integers.
    #[test]
    fn the_upper_word_of_the_sum_is_exact() {
        for a in numbers().take(200) {
            for b in numbers().take(200) {
                let c = (i64::from(b) << 32 | i64::from(b ^ a)).rotate_left(17) as u64;
                let exact = |factor: i128| ((i128::from(a) * factor + i128::from(c)) >> 32) as u32;
                let halves = upper_of_short_sum_by_halves(a, b, c);
                assert_eq!(halves, exact(b.into()), "{a} · {b} + {c}");
                let long = i64::from(b) << 32 | i64::from(b.rotate_left(7) ^ a);
                let sum = upper_of_sum(a, signed_words(long as u64), c);
                assert_eq!(sum, exact((long as u64).into()), "{a} · {long} + {c}");
            }
        }
    }
}
