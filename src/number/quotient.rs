//! A long division by two short ones: most processors divide 32 by 32 bits in one instruction, and 64 by 64 in a routine of 400.

/// Floor of dividend·2³¹/divisor, for a dividend less than the divisor.
///
/// Two 16-bit digits, by long division (D. Knuth, *The Art of Computer Programming*, vol. 2, algorithm D).
#[inline]
pub(crate) fn quotient(dividend: u32, divisor: u32) -> u32 {
    let shift = divisor.leading_zeros();
    // The top bit is set, except for a divisor of 0, which then counts as the largest.
    let divisor = divisor.wrapping_shl(shift) | 1 << 31;
    // Less than divisor·2³¹.
    let dividend = u64::from(dividend) << (31 + (shift & 31));
    let (upper, rest) = digit((dividend >> 32) as u32, dividend as u32 >> 16, divisor);
    let (lower, _) = digit(rest, dividend as u32 & 0xffff, divisor);
    upper << 16 | lower
}

/// Quotient and remainder of (u·2¹⁶ + next)/divisor, for u less than the divisor, a 16-bit `next`, and a divisor whose top bit is set.
#[inline]
fn digit(u: u32, next: u32, divisor: u32) -> (u32, u32) {
    let (upper, lower) = (divisor >> 16 | 1 << 15, divisor & 0xffff);
    // The digit, or up to two more: no product overflows.
    let mut digit = u / upper;
    let mut rest = u % upper;
    let too_large = |digit: u32, rest: u32| digit > 0xffff || digit * lower > (rest << 16 | next);
    if too_large(digit, rest) {
        digit -= 1;
        rest += upper;
        if rest <= 0xffff && too_large(digit, rest) {
            digit -= 1;
        }
    }
    let rest = (u << 16 | next).wrapping_sub(digit.wrapping_mul(divisor));
    (digit, rest)
}

#[cfg(test)]
mod tests {
    use super::quotient;

    #[test]
    fn two_digits_give_the_long_quotient() {
        // A fixed sequence of numbers of every magnitude (xorshift; G. Marsaglia 2003), and the extremes.
        let mut state = 0x9e37_79b9_u32;
        let mut next = move || {
            state ^= state << 13;
            state ^= state >> 17;
            state ^= state << 5;
            state >> (state % 32)
        };
        let extremes = [
            1,
            2,
            3,
            0x7fff,
            0x8000,
            0xffff,
            0x1_0000,
            0x7fff_ffff,
            0x8000_0000,
            0xffff_0000,
            0xffff_fffe,
            u32::MAX,
        ];
        let pairs = (0..300_000).map(|_| [next(), next()]);
        let ends = extremes.iter().flat_map(|a| extremes.map(|b| [*a, b]));
        // Dividends near the divisor, and near a multiple of its upper half, make the digits too large.
        let near = extremes
            .iter()
            .flat_map(|d| [1, 2, 0xffff].map(|k| [d.wrapping_sub(k), *d]));
        for [a, b] in pairs.chain(ends).chain(near) {
            let (dividend, divisor) = (a.min(b), a.max(b));
            if dividend < divisor {
                let long = (u64::from(dividend) << 31) / u64::from(divisor);
                assert_eq!(
                    u64::from(quotient(dividend, divisor)),
                    long,
                    "{dividend}/{divisor}"
                );
            }
        }
    }
}
