//! Coefficients of each cell's own polynomial.

use core::marker::PhantomData;

use super::{Fraction, Layout, More, Raw, Row, Rows, Word, about, word};
use crate::curve::curves::CurveSet;
use crate::number::spline::cubic;
use crate::number::{Ring, Scalar};

/// The four coefficients of each cell's cubic.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cubic<S>(PhantomData<S>);

/// The three coefficients of each cell's quadratic, from a uniform quadratic B-spline. Rows are padded to a multiple of four words; in fixed point
/// the place in a cell has 16 bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quadratic<S>(PhantomData<S>);

impl<S: Scalar> Layout for Cubic<S> {
    type Rows<'a> = Rows<'a, Word<Self>, 4, 8, 12, 16, 20>;
    const CODE: u8 = 2;
    const ROW: Row = Row {
        head: 0,
        halves: 8,
        padded: false,
        more: 0,
    };
    const DEGREE: u8 = 3;
    const COLUMN: usize = 4;

    #[inline(always)]
    fn coefficients<R: Ring>(
        cell: &[Word<Self>],
        column: usize,
        _: CurveSet,
        _: More<R>,
        read: impl Fn(Word<Self>) -> R,
    ) -> [R; 4] {
        let p = |k| word(cell, 4 * column + k, &read);
        [p(0), p(1), p(2), p(3)]
    }
    #[inline(always)]
    fn locate(phase: u32, cells: u32) -> (u32, Fraction<Self>) {
        S::locate_row(phase, cells)
    }
    #[inline(always)]
    fn times(x: Raw<Self>, u: Fraction<Self>) -> Raw<Self> {
        S::row_step(x, u)
    }
    fn stored(points: [f64; 4]) -> [f64; 4] {
        about(cubic(points, 1), S::ROW_CENTRE)
    }
}

impl<S: Scalar> Layout for Quadratic<S> {
    type Rows<'a> = Rows<'a, Word<Self>, 4, 8, 12, 16, 20>;
    const CODE: u8 = 3;
    const ROW: Row = Row {
        head: 0,
        halves: 6,
        padded: true,
        more: 0,
    };
    const DEGREE: u8 = 2;
    const COLUMN: usize = 3;

    #[inline(always)]
    fn coefficients<R: Ring>(
        cell: &[Word<Self>],
        column: usize,
        _: CurveSet,
        _: More<R>,
        read: impl Fn(Word<Self>) -> R,
    ) -> [R; 4] {
        let p = |k| word(cell, 3 * column + k, &read);
        [p(0), p(1), p(2), R::default()]
    }
    #[inline(always)]
    fn locate(phase: u32, cells: u32) -> (u32, Fraction<Self>) {
        S::locate_row_short(phase, cells)
    }
    #[inline(always)]
    fn times(x: Raw<Self>, u: Fraction<Self>) -> Raw<Self> {
        S::row_step_short(x, u)
    }
    #[inline(always)]
    fn value([p0, p1, p2, _]: [Raw<Self>; 4], u: Fraction<Self>) -> Raw<Self> {
        p0 + S::row_step_short(p1 + S::row_step_short(p2, u), u)
    }
    #[inline(always)]
    fn value_and_slope(
        [p0, p1, p2, _]: [Raw<Self>; 4],
        u: Fraction<Self>,
    ) -> (Raw<Self>, Raw<Self>) {
        let t = S::row_step_short(p2, u);
        let q = p1 + t;
        (p0 + S::row_step_short(q, u), q + t)
    }
    fn stored([c0, c1, c2, _]: [f64; 4]) -> [f64; 4] {
        // Control points in halves.
        let polynomial = [c0 + c1, (c1 - c0) * 2.0, c0 - c1 * 2.0 + c2, 0.0];
        about(polynomial, S::ROW_CENTRE)
    }
}
