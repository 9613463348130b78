//! Coefficients of each cell's own polynomial.

use super::{
    Cubic, Layout, More, Quadratic, Store, about, cubic, cubic_value, cubic_value_and_slope,
    quadratic, run, word,
};
use crate::curve::curves::width;
use crate::number::{Kernel, Ring};

impl Layout for Cubic {
    const NAME: &'static str = "cubic";
}

impl Store for Cubic {
    const CODE: u8 = 2;
    const NEWTON: bool = true;
    const COLUMN: usize = 4;
    const DEGREE: u8 = 3;
    const MORE_ROWS: usize = 0;
    const OFFSET: bool = false;

    fn words(cells: usize, set: u8) -> usize {
        cells * Self::pitch(set)
    }
    fn pitch(set: u8) -> usize {
        4 * width(set)
    }
    #[inline]
    fn cell<T>(words: &[T], index: usize, set: u8) -> Option<&[T]> {
        match width(set) {
            1 => run::<T, 4>(words, index),
            2 => run::<T, 8>(words, index),
            3 => run::<T, 12>(words, index),
            4 => run::<T, 16>(words, index),
            _ => run::<T, 20>(words, index),
        }
    }
    #[inline]
    fn coefficients<S: Kernel, R: Ring>(
        cell: &[S::Word],
        column: usize,
        _: u8,
        _: More<R>,
        read: impl Fn(S::Word) -> R,
    ) -> [R; 4] {
        [0, 1, 2, 3].map(|k| word(cell, 4 * column + k, &read))
    }
    #[inline]
    fn locate<S: Kernel>(phase: u32, cells: u32) -> (u32, S::Fraction) {
        S::locate_row(phase, cells)
    }
    #[inline]
    fn value<S: Kernel>(coefficients: [S::Raw; 4], u: S::Fraction) -> S::Raw {
        cubic_value::<S>(coefficients, u, S::row_step)
    }
    #[inline]
    fn value_and_slope<S: Kernel>(coefficients: [S::Raw; 4], u: S::Fraction) -> (S::Raw, S::Raw) {
        cubic_value_and_slope::<S>(coefficients, u, S::row_step)
    }
    fn step<S: Kernel>() -> i8 {
        1
    }
    fn centre<S: Kernel>() -> f64 {
        S::ROW_CENTRE
    }
    fn stored<S: Kernel>(points: [f64; 4]) -> [f64; 4] {
        about(cubic(points, 1), S::ROW_CENTRE)
    }
}

impl Layout for Quadratic {
    const NAME: &'static str = "quadratic";
}

impl Store for Quadratic {
    const CODE: u8 = 3;
    const NEWTON: bool = false;
    const COLUMN: usize = 3;
    const DEGREE: u8 = 2;
    const MORE_ROWS: usize = 0;
    const OFFSET: bool = false;

    fn words(cells: usize, set: u8) -> usize {
        cells * Self::pitch(set)
    }
    fn pitch(set: u8) -> usize {
        (3 * width(set)).next_multiple_of(4)
    }
    #[inline]
    fn cell<T>(words: &[T], index: usize, set: u8) -> Option<&[T]> {
        match Self::pitch(set) {
            4 => run::<T, 4>(words, index),
            8 => run::<T, 8>(words, index),
            12 => run::<T, 12>(words, index),
            _ => run::<T, 16>(words, index),
        }
    }
    #[inline]
    fn coefficients<S: Kernel, R: Ring>(
        cell: &[S::Word],
        column: usize,
        _: u8,
        _: More<R>,
        read: impl Fn(S::Word) -> R,
    ) -> [R; 4] {
        let [p0, p1, p2] = [0, 1, 2].map(|k| word(cell, 3 * column + k, &read));
        [p0, p1, p2, R::default()]
    }
    #[inline]
    fn locate<S: Kernel>(phase: u32, cells: u32) -> (u32, S::Fraction) {
        S::locate_row_short(phase, cells)
    }
    #[inline]
    fn value<S: Kernel>([p0, p1, p2, _]: [S::Raw; 4], u: S::Fraction) -> S::Raw {
        p0 + S::row_step_short(p1 + S::row_step_short(p2, u), u)
    }
    #[inline]
    fn value_and_slope<S: Kernel>(
        [p0, p1, p2, _]: [S::Raw; 4],
        u: S::Fraction,
    ) -> (S::Raw, S::Raw) {
        let t = S::row_step_short(p2, u);
        let q = p1 + t;
        (p0 + S::row_step_short(q, u), q + t)
    }
    fn step<S: Kernel>() -> i8 {
        1
    }
    fn centre<S: Kernel>() -> f64 {
        S::ROW_CENTRE
    }
    fn stored<S: Kernel>([c0, c1, c2, _]: [f64; 4]) -> [f64; 4] {
        about(quadratic([c0, c1, c2], 1), S::ROW_CENTRE)
    }
}
