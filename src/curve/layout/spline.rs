//! Control points of a uniform cubic B-spline.

use super::{
    Layout, More, Spline, Spline16, Store, cubic, cubic_value, cubic_value_and_slope, word,
};
use crate::curve::curves::width;
use crate::number::{Kernel, Ring};

/// Four rows of W words each, from the index-th on.
#[inline]
fn rows<T, const W: usize>(words: &[T], index: usize) -> Option<&[T]> {
    let rows = words.as_chunks::<W>().0.get(index..)?;
    rows.first_chunk::<4>().map(|rows| rows.as_flattened())
}

impl Layout for Spline {
    const NAME: &'static str = "spline";
}

impl Store for Spline {
    const CODE: u8 = 1;
    const NEWTON: bool = true;
    const COLUMN: usize = 1;
    const DEGREE: u8 = 3;
    const MORE_ROWS: usize = 3;
    const OFFSET: bool = true;

    fn words(cells: usize, set: u8) -> usize {
        (cells + Self::MORE_ROWS) * width(set)
    }
    fn pitch(set: u8) -> usize {
        width(set)
    }
    #[inline]
    fn cell<T>(words: &[T], index: usize, set: u8) -> Option<&[T]> {
        match width(set) {
            1 => rows::<T, 1>(words, index),
            2 => rows::<T, 2>(words, index),
            3 => rows::<T, 3>(words, index),
            4 => rows::<T, 4>(words, index),
            _ => rows::<T, 5>(words, index),
        }
    }
    #[inline]
    fn coefficients<S: Kernel, R: Ring>(
        cell: &[S::Word],
        column: usize,
        set: u8,
        more: More<R>,
        read: impl Fn(S::Word) -> R,
    ) -> [R; 4] {
        let point = |row: usize| word(cell, row * width(set) + column, &read);
        let [p0, p1, p2, p3] = cubic([0, 1, 2, 3].map(point), S::STEP);
        [p0 + more.offset, p1, p2, p3]
    }
    #[inline]
    fn locate<S: Kernel>(phase: u32, cells: u32) -> (u32, S::Fraction) {
        S::locate(phase, cells)
    }
    #[inline]
    fn value<S: Kernel>(coefficients: [S::Raw; 4], u: S::Fraction) -> S::Raw {
        cubic_value::<S>(coefficients, u, S::step)
    }
    #[inline]
    fn value_and_slope<S: Kernel>(coefficients: [S::Raw; 4], u: S::Fraction) -> (S::Raw, S::Raw) {
        cubic_value_and_slope::<S>(coefficients, u, S::step)
    }
    fn step<S: Kernel>() -> i8 {
        S::STEP
    }
    fn centre<S: Kernel>() -> f64 {
        0.0
    }
    fn stored<S: Kernel>(points: [f64; 4]) -> [f64; 4] {
        points
    }
}

impl Layout for Spline16 {
    const NAME: &'static str = "spline16";
}

impl Store for Spline16 {
    const CODE: u8 = 4;
    const NEWTON: bool = true;
    const COLUMN: usize = 1;
    const DEGREE: u8 = 3;
    const MORE_ROWS: usize = 3;
    const OFFSET: bool = true;
    const HALVES: bool = true;

    fn words(cells: usize, set: u8) -> usize {
        (cells + Self::MORE_ROWS) * Self::pitch(set)
    }
    fn pitch(set: u8) -> usize {
        width(set).div_ceil(2)
    }
    #[inline]
    fn cell<T>(words: &[T], index: usize, set: u8) -> Option<&[T]> {
        match Self::pitch(set) {
            1 => rows::<T, 1>(words, index),
            2 => rows::<T, 2>(words, index),
            _ => rows::<T, 3>(words, index),
        }
    }
    #[inline]
    fn coefficients<S: Kernel, R: Ring>(
        cell: &[S::Word],
        column: usize,
        set: u8,
        more: More<R>,
        read: impl Fn(S::Word) -> R,
    ) -> [R; 4] {
        let half = |word| read(S::half(word, column % 2 == 1));
        let point = |row: usize| word(cell, row * Self::pitch(set) + column / 2, half);
        let [p0, p1, p2, p3] = cubic([0, 1, 2, 3].map(point), S::STEP).map(|p| p * more.gain);
        [p0 + more.offset, p1, p2, p3]
    }
    #[inline]
    fn locate<S: Kernel>(phase: u32, cells: u32) -> (u32, S::Fraction) {
        S::locate(phase, cells)
    }
    #[inline]
    fn value<S: Kernel>(coefficients: [S::Raw; 4], u: S::Fraction) -> S::Raw {
        cubic_value::<S>(coefficients, u, S::step)
    }
    #[inline]
    fn value_and_slope<S: Kernel>(coefficients: [S::Raw; 4], u: S::Fraction) -> (S::Raw, S::Raw) {
        cubic_value_and_slope::<S>(coefficients, u, S::step)
    }
    fn step<S: Kernel>() -> i8 {
        S::STEP
    }
    fn centre<S: Kernel>() -> f64 {
        0.0
    }
    fn stored<S: Kernel>(points: [f64; 4]) -> [f64; 4] {
        points
    }
}
