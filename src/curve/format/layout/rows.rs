//! Coefficients of each cell's own polynomial.

use core::marker::PhantomData;

use super::{Fraction, Layout, More, Raw, Row, Word, about, word};
use crate::curve::curves::{Set, width};
use crate::number::spline::cubic;
use crate::number::{Ring, Scalar};

/// The four coefficients of each cell's cubic.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cubic<S>(PhantomData<S>);

/// The three coefficients of each cell's quadratic, from a uniform quadratic B-spline; rows are padded to a multiple of four
/// words, the place in a cell has 16 bits in fixed point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quadratic<S>(PhantomData<S>);

/// The index-th run of N words. The compiler knows the length of what comes back, so that reads from it need no check.
#[inline(always)]
fn run<T, const N: usize>(words: &[T], index: usize) -> Option<&[T]> {
    words.as_chunks::<N>().0.get(index).map(<[T; N]>::as_slice)
}

impl<S: Scalar> Layout for Cubic<S> {
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
    fn cell<T>(words: &[T], index: usize, set: Set) -> Option<&[T]> {
        match width(set) {
            1 => run::<T, 4>(words, index),
            2 => run::<T, 8>(words, index),
            3 => run::<T, 12>(words, index),
            4 => run::<T, 16>(words, index),
            _ => run::<T, 20>(words, index),
        }
    }
    #[inline(always)]
    fn coefficients<R: Ring>(
        cell: &[Word<Self>],
        column: usize,
        _: Set,
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
    fn cell<T>(words: &[T], index: usize, set: Set) -> Option<&[T]> {
        match Self::ROW.pitch(set) {
            4 => run::<T, 4>(words, index),
            8 => run::<T, 8>(words, index),
            12 => run::<T, 12>(words, index),
            _ => run::<T, 16>(words, index),
        }
    }
    #[inline(always)]
    fn coefficients<R: Ring>(
        cell: &[Word<Self>],
        column: usize,
        _: Set,
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
