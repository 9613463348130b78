//! Whether a row stays within the stroke, also between its ends: by its Bernstein coefficients, in integers.

use super::row::{Row, Units, Window, shifted};

/// Bits of a position below 2⁻³² of the range. With the 57 of a row they are 63.
const FINER: i32 = 6;

/// Halvings of the window, down to the smallest time step of a tick.
const DEEPEST: u32 = 32;

/// Coefficients of Bernstein polynomials of degree five: the curve lies between the least and the greatest of them.
type Hull = [i64; 6];

/// Whether the position of a row of `length` units of time is nowhere more than `slack` below 0 or above the whole range.
///
/// Where the hull of the window reaches too far, it is halved until the part lies inside, or begins outside. A part that begins after the row's end
/// does not count.
pub(super) fn stays_inside(row: &Row, length: u32, units: Units, slack: u64) -> bool {
    let whole = hull(row, Window::of(length, units).shifts(row, units));
    let slack = slack.min(1 << 32).cast_signed() << FINER;
    let inside = |position: i64| (-slack..=(1 << (32 + FINER)) + slack).contains(&position);
    // The end of the row as a share of the window, in units of 2⁻³².
    let end = u64::from(length) << length.leading_zeros();
    // The part from k/2ⁿ to (k + 1)/2ⁿ.
    let (mut k, mut n) = (0_u64, 0);
    while k << (DEEPEST - n) < end {
        let part = part(whole, k, n);
        let [start, ..] = part;
        if !inside(start) {
            return false;
        }
        if n == DEEPEST || part.into_iter().all(inside) {
            // The next part, as large as the index allows.
            k += 1;
            let up = k.trailing_zeros().min(n);
            (k, n) = (k >> up, n - up);
            if n == 0 {
                return true;
            }
        } else {
            (k, n) = (2 * k, n + 1);
        }
    }
    true
}

/// The hull of the whole window.
fn hull(row: &Row, [_, to_position, moved]: [i32; 3]) -> Hull {
    let start = row.position << FINER;
    let even = shifted(row.speed.into(), moved + 32 + FINER);
    let [c2, c3, c4, c5] = row.coefficients;
    let c2 = shifted(c2.into(), to_position + FINER) / 10;
    let c3 = shifted(c3.into(), to_position + FINER) / 10;
    let c4 = shifted(c4.into(), to_position + FINER) / 5;
    let c5 = shifted(c5.into(), to_position + FINER);
    let v = even / 5;
    [
        start,
        start + v,
        start + 2 * v + c2,
        start + 3 * v + 3 * c2 + c3,
        start + 4 * v + 6 * c2 + 4 * c3 + c4,
        start + 5 * v + 10 * c2 + 10 * c3 + 5 * c4 + c5,
    ]
}

/// The hull of the part from k/2ⁿ to (k + 1)/2ⁿ.
fn part(whole: Hull, k: u64, n: u32) -> Hull {
    let halves = (0..n).rev().map(|bit| k >> bit & 1 == 1);
    halves.fold(whole, half)
}

/// The hull of the left or right half (de Casteljau).
fn half([a, b, c, d, e, f]: Hull, right: bool) -> Hull {
    let middle = |[a, b]: [i64; 2]| (a + b) >> 1;
    let [ab, bc, cd, de, ef] = [[a, b], [b, c], [c, d], [d, e], [e, f]].map(middle);
    let [abc, bcd, cde, def] = [[ab, bc], [bc, cd], [cd, de], [de, ef]].map(middle);
    let [abcd, bcde, cdef] = [[abc, bcd], [bcd, cde], [cde, def]].map(middle);
    let [abcde, bcdef] = [[abcd, bcde], [bcde, cdef]].map(middle);
    let all = middle([abcde, bcdef]);
    if right {
        [all, bcdef, cdef, def, ef, f]
    } else {
        [a, ab, abc, abcd, abcde, all]
    }
}
