//! Pairs of links that close a chain (dyads, Assur groups of the second class): the position of two links from the positions of their outer joints.

use crate::machine::link::Frame;
use crate::number::transfer::Transfer;

/// The side of a directed line on which the pin between two links lies: a pair of links can be assembled in two ways.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Side {
    /// To the left, in the direction of the line.
    #[default]
    Left,
    /// To the right.
    Right,
}

impl Side {
    /// +1 for left, −1 for right: the sign of the cross product of the line and the vector to the pin.
    pub(super) const fn sign(self) -> f64 {
        match self {
            Self::Left => 1.0,
            Self::Right => -1.0,
        }
    }
}

/// Two links that meet in a pin B, the first from A, the second from C: frames at A along AB and at C along CB.
///
/// With f = |AC|, p = (f² + b² − c²)/2 and q = ±2·area of the triangle (Heron),
///
/// ```text
/// AB = (p·AC + q·AC⊥)/f²      CB = ((p − f²)·AC + q·AC⊥)/f²      4·q² = ((b + c)² − f²)·(f² − (b − c)²)
/// ```
///
/// `None` where the links are stretched or folded, or do not meet at all.
pub(super) fn pinned(
    a: [Transfer; 2],
    c: [Transfer; 2],
    lengths: [f64; 2],
    side: Side,
) -> Option<[Frame; 2]> {
    let ([x, y], [first, second]) = ([c[0] - a[0], c[1] - a[1]], lengths);
    let square = x * x + y * y;
    let (sum, difference) = (first + second, first - second);
    let q_square = (Transfer::constant(sum * sum) - square)
        * (square - Transfer::constant(difference * difference))
        * 0.25;
    if square.value <= 0.0 || q_square.value <= 0.0 {
        return None;
    }
    let q = q_square.sqrt() * side.sign();
    Some(placed([a, c], ([x, y], square), lengths, q))
}

/// The two links of [`pinned`] with known AC, its square f² > 0, and q, of either sign or zero.
#[inline(always)]
pub(super) fn placed(
    [a, c]: [[Transfer; 2]; 2],
    ([x, y], square): ([Transfer; 2], Transfer),
    [first, second]: [f64; 2],
    q: Transfer,
) -> [Frame; 2] {
    let (sum, difference) = (first + second, first - second);
    let along = |p: Transfer, length: f64| {
        let scale = square * length;
        let cos = (p * x - q * y).over(scale);
        let sin = (p * y + q * x).over(scale);
        (sin, cos)
    };
    let excess = Transfer::constant(sum * difference);
    let (sin, cos) = along((excess + square) * 0.5, first);
    let from_a = Frame::moving(a, sin, cos);
    let (sin, cos) = along((excess - square) * 0.5, second);
    [from_a, Frame::moving(c, sin, cos)]
}

/// A link from the pin B to a slider whose pin moves on the line y = `guide`: frames of the link (at B, towards the slider) and of the slider. `sign`
/// is the sign of the link's cosine: +1 with the slider on the right of B. The link's angle stays within a quarter turn of 0 or π.
///
/// `None` if the link is perpendicular to the guide, or does not reach it.
pub(super) fn sliding(b: [Transfer; 2], length: f64, guide: f64, sign: f64) -> Option<[Frame; 2]> {
    let guide = Transfer::constant(guide);
    let one = Transfer::constant(1.0);
    let sin = (guide - b[1]) * (1.0 / length);
    let under_root = (one - sin) * (one + sin);
    if under_root.value <= 0.0 {
        return None;
    }
    let near = if sign > 0.0 {
        0.0
    } else {
        core::f64::consts::PI
    };
    let link = Frame::moving(b, sin, under_root.sqrt() * sign).unwrapped(near);
    let [x, _] = link.point([length, 0.0]);
    Some([link, Frame::translating([x, guide])])
}
