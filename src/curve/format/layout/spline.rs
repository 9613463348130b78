//! Control points of a uniform cubic B-spline.

use core::marker::PhantomData;

use super::{Fraction, Layout, More, Raw, Row, Rows, Runs, Word, word};
use crate::Q31;
use crate::curve::curves::{CurveSet, width};
use crate::number::spline::cubic;
use crate::number::{Kernel, Ring, Role, Scalar};

/// Control points of a uniform cubic B-spline, one per knot and curve: see [`CubicSpline`](crate::table::CubicSpline).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Spline<S>(PhantomData<S>);

/// As [`Spline<Q31>`](Spline), with 16 bits per control point, two of them in a word. The arithmetic has 32 bits: a curve's points are multiplied by
/// its own integer ([`Constants::gains`](crate::table::Constants::gains)), so that they use all of their bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Spline16;

/// Rows that close a turn.
const MORE: usize = 3;

impl<S: Scalar> Layout for Spline<S> {
    type Rows<'a> = Rows<'a, Word<Self>, 1, 2, 3, 4, 5>;
    const CODE: u8 = 1;
    const ROW: Row = Row {
        head: 0,
        halves: 2,
        padded: false,
        more: MORE,
    };
    const DEGREE: u8 = 3;
    const COLUMN: usize = 1;
    const STEP: i8 = S::STEP;
    const CENTRE: f64 = 0.0;

    #[inline(always)]
    fn cell<'a>(rows: &Self::Rows<'a>, index: usize, set: CurveSet) -> Option<&'a [Word<Self>]> {
        rows.four(Self::ROW.pitch(set), index)
    }
    #[inline(always)]
    fn coefficients<R: Ring>(
        cell: &[Word<Self>],
        column: usize,
        set: CurveSet,
        more: More<R>,
        read: impl Fn(Word<Self>) -> R,
    ) -> [R; 4] {
        let point = |row: usize| word(cell, row * width(set) + column, &read);
        let [p0, p1, p2, p3] = cubic([point(0), point(1), point(2), point(3)], S::STEP);
        [more.offset.map_or(p0, |offset| p0 + offset), p1, p2, p3]
    }
    #[inline(always)]
    fn locate(phase: u32, cells: u32) -> (u32, Fraction<Self>) {
        S::locate(phase, cells)
    }
    #[inline(always)]
    fn times(x: Raw<Self>, u: Fraction<Self>) -> Raw<Self> {
        S::step(x, u)
    }
    fn stored(points: [f64; 4]) -> [f64; 4] {
        points
    }
}

impl Layout for Spline16 {
    type Rows<'a> = Rows<'a, i32, 1, 2, 3, 4, 5>;
    const CODE: u8 = 4;
    const ROW: Row = Row {
        head: 0,
        halves: 1,
        padded: false,
        more: MORE,
    };
    const DEGREE: u8 = 3;
    const COLUMN: usize = 1;
    const STEP: i8 = Q31::STEP;
    const CENTRE: f64 = 0.0;
    const HALVES: bool = true;

    #[inline(always)]
    fn cell<'a>(rows: &Self::Rows<'a>, index: usize, set: CurveSet) -> Option<&'a [Word<Self>]> {
        rows.four(Self::ROW.pitch(set), index)
    }
    #[inline(always)]
    fn coefficients<R: Ring>(
        cell: &[i32],
        column: usize,
        set: CurveSet,
        more: More<R>,
        read: impl Fn(i32) -> R,
    ) -> [R; 4] {
        let half = |word| read(Self::half(word, column % 2 == 1));
        let point = |row: usize| word(cell, row * Self::ROW.pitch(set) + column / 2, half);
        let [p0, p1, p2, p3] = cubic([point(0), point(1), point(2), point(3)], Q31::STEP);
        let gain = more.gain;
        let p0 = p0 * gain;
        let p0 = more.offset.map_or(p0, |offset| p0 + offset);
        [p0, p1 * gain, p2 * gain, p3 * gain]
    }
    #[inline(always)]
    fn locate(phase: u32, cells: u32) -> (u32, Fraction<Self>) {
        Q31::locate(phase, cells)
    }
    #[inline(always)]
    fn times(x: Raw<Self>, u: Fraction<Self>) -> Raw<Self> {
        Q31::step(x, u)
    }
    fn stored(points: [f64; 4]) -> [f64; 4] {
        points
    }
    #[inline(always)]
    fn half(word: i32, upper: bool) -> i32 {
        if upper {
            word >> 16
        } else {
            i32::from(word as i16)
        }
    }
    fn unit(role: Role) -> f64 {
        Q31::exact(role, Q31::raw(1))
    }
    fn with_half(word: i32, upper: bool, half: i32) -> Option<i32> {
        let half = i32::from(i16::try_from(half).ok()?);
        Some(if upper {
            half << 16 | word & 0xffff
        } else {
            word & !0xffff | half & 0xffff
        })
    }
}
