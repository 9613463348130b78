//! The arithmetic of a tick over 16-bit rows: the same bits on every processor.
//!
//! Qn is an integer in units of 2⁻ⁿ. All products fit into 32 bits, so that one short multiplication is enough:
//!
//! | | bits | limit |
//! |---|---|---|
//! | a line's difference times the place | i16·u16 | 2¹⁵·(2¹⁶ − 1) < 2³¹ |
//! | J·α | u16·i16 | (2¹⁶ − 1)·2¹⁵ < 2³¹ |
//! | V·ω + b, Q30 | i16·i16, and b | < 2³¹ |
//! | T − resisting, times 1/J | 17 bits·u15 | 65535·32767 < 2³¹ |
//!
//! The product (V·ω + b)·ω and the partial sums may wrap: they are modulo 2³², and only the whole sum matters, which [`Table`](crate::table::Table)
//! ensures to fit.

use crate::number::{FrictionSign, Outcome, fence};
use crate::{Phase, Q15};

/// The cell, and the place in it in units of 2⁻¹⁶ of a cell.
#[inline(always)]
pub(super) fn locate(phase: Phase, cells: u32) -> (usize, i32) {
    let (cell, fraction) = crate::number::phase::cell_short(phase.to_bits(), cells);
    (cell as usize, (fraction >> 16) as i32)
}

/// A line over the cell, from a word with value (upper half) and difference: floor((word + difference·u)/2¹⁶).
///
/// The whole word is used: its lower half adds up to one unit to the value, which `fill` takes into account.
#[inline(always)]
pub(super) fn line(word: u32, u: i32) -> i32 {
    let difference = i32::from(word as i16);
    (word as i32).wrapping_add(difference.wrapping_mul(u)) >> 16
}

/// J in Q16, from the words of its line and start.
#[inline(always)]
pub(super) fn inertia(line_word: u32, start: u32, u: i32) -> i32 {
    let rise = line(line_word, u).wrapping_mul(u);
    (start.wrapping_add(rise as u32) >> 16) as i32
}

/// `sum` − load in Q31, from the words of the load's line and start.
#[inline(always)]
pub(super) fn minus_load(sum: i32, line_word: u32, start: u32, u: i32) -> i32 {
    let sum = sum.wrapping_add((start << 16) as i32);
    sum.wrapping_add(line(line_word, u).wrapping_mul(u))
}

/// (V·ω + b)·ω in Q31, for V and ω in Q15 and b in Q30.
#[inline(always)]
pub(super) fn of_speed(velocity: i32, b: i32, omega: i32) -> i32 {
    let coefficient = velocity.wrapping_mul(omega).wrapping_add(b) >> 14; // Q16
    coefficient.wrapping_mul(omega)
}

/// V·ω² in Q15, for V and ω in Q15: both products rounded down.
#[inline(always)]
pub(super) fn of_speed_alone(velocity: i32, omega: i32) -> i32 {
    (velocity.wrapping_mul(omega) >> 15).wrapping_mul(omega) >> 15
}

/// sgn x, without a branch.
#[inline(always)]
fn sign(x: i32) -> i32 {
    x >> 31 | (x.wrapping_neg() as u32 >> 31) as i32
}

/// sum + c·sgn ω, for c ≥ 0 in Q31.
#[inline(always)]
#[allow(clippy::comparison_chain, reason = "the three ways of sgn")]
fn add_signed(sum: i32, c: i32, omega: i32) -> i32 {
    if cfg!(not(short_multiply)) {
        return if omega > 0 {
            sum.wrapping_add(c)
        } else if omega < 0 {
            sum.wrapping_sub(c)
        } else {
            sum
        };
    }
    if omega > 0 {
        // Without the fence the branches are merged, and all terms wait behind them in more registers than exist.
        fence();
        return sum.wrapping_add(c);
    }
    sum.wrapping_sub(if omega < 0 { c } else { 0 })
}

/// sum + |c|·sgn ω or |c| times the share, in Q31, for c in Q15 with any sign.
#[inline(always)]
pub(super) fn add_sliding(sum: i32, c: i32, friction: FrictionSign<Q15>) -> i32 {
    match friction {
        FrictionSign::OfSpeed(omega) if cfg!(not(short_multiply)) => {
            // c with the sign of c·ω, which is 0 only if a factor is 0.
            let product = c.wrapping_mul(i32::from(omega.to_bits()));
            sum.wrapping_add(c.wrapping_mul(sign(product)) << 16)
        }
        _ => add_constant(sum, c.wrapping_abs() << 16, friction),
    }
}

/// The same for a constant c ≥ 0 in Q31.
#[inline(always)]
pub(super) fn add_constant(sum: i32, c: i32, friction: FrictionSign<Q15>) -> i32 {
    match friction {
        FrictionSign::OfSpeed(omega) => add_signed(sum, c, i32::from(omega.to_bits())),
        FrictionSign::Scaled(share) => {
            let product = (c >> 16).wrapping_mul(i32::from(share.to_bits())); // Q30
            sum.wrapping_add(product << 1)
        }
    }
}

/// A torque in Q31 as a number: the `Table` was checked, so that it fits.
#[inline(always)]
pub(super) fn torque(sum: i32) -> Q15 {
    Q15::from_bits((sum >> 16) as i16)
}

/// Limited to the range of the number, for an integer part of any size.
#[inline(always)]
pub(super) fn limited(x: i32) -> Outcome<Q15> {
    if cfg!(not(short_multiply)) {
        // Conditional instructions need no branch.
        let value = x.clamp(i32::from(i16::MIN), i32::from(i16::MAX));
        return Outcome {
            value: Q15::from_bits(value as i16),
            saturated: value != x,
        };
    }
    if x >> 15 == x >> 31 {
        return Outcome {
            value: Q15::from_bits(x as i16),
            saturated: false,
        };
    }
    // Without the fence the branches are merged, and the frequent one takes longer.
    fence();
    Outcome {
        value: Q15::from_bits((x >> 31 ^ 0x7fff) as i16),
        saturated: true,
    }
}

/// net/J towards zero, for net in Q15 (17 bits) and J in Q16, greater than 0. One 32-bit division, in software where the processor has none.
#[inline(always)]
pub(super) fn quotient(net: i32, inertia: i32) -> Outcome<Q15> {
    let (magnitude, divisor) = (net.unsigned_abs(), inertia.unsigned_abs());
    if magnitude << 1 >= divisor {
        // |net/J| ≥ 1; −1 itself counts as saturated, too.
        return Outcome {
            value: if net < 0 { Q15::MIN } else { Q15::MAX },
            saturated: true,
        };
    }
    // Below 2¹⁵, because magnitude < divisor/2 < 2¹⁵; the divisor is not 0.
    let quotient = (magnitude << 16).checked_div(divisor).unwrap_or(0) as i32;
    Outcome {
        value: Q15::from_bits(if net < 0 { -quotient } else { quotient } as i16),
        saturated: false,
    }
}
