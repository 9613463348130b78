//! Number of words of a table, and its rows.

use super::harmonic::{means, row};
use crate::curve::curves::{CurveSet, width};

/// The words of a table.
#[derive(Clone, Copy, Debug)]
pub enum Size {
    /// Row after row.
    Rows(Row),
    /// Means, then harmonic after harmonic.
    Harmonics,
    /// The coefficients of a slider-crank.
    #[cfg(feature = "micromath")]
    SliderCrank,
}

impl Size {
    /// Words of a whole table.
    #[inline]
    pub(crate) const fn words(&self, cells: usize, set: CurveSet) -> usize {
        match self {
            Self::Rows(row) => (cells + row.more) * row.pitch(set),
            Self::Harmonics => means(set) + cells * row(set),
            #[cfg(feature = "micromath")]
            Self::SliderCrank => super::slider_crank::words(set),
        }
    }
}

/// The words of a row.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// Words in addition to those of the curves.
    pub(super) head: usize,
    /// Half-words of a curve.
    pub(super) halves: usize,
    /// Rows are padded to a multiple of four words.
    pub(super) padded: bool,
    /// Rows in addition to the cells.
    pub(super) more: usize,
}

impl Row {
    /// Words from one row to the next: never 0.
    #[inline]
    pub(crate) const fn pitch(&self, set: CurveSet) -> usize {
        let words = self.head + (width(set) * self.halves).div_ceil(2);
        // By a mask: a division would need a check for zero.
        if self.padded { (words + 3) & !3 } else { words }
    }
}

/// The rows of a table, by their length: those of the length in use contain all words. So the compiler knows the length of a row, and a read from it
/// needs no check; the number of rows is known without a division.
#[derive(Clone, Copy, Debug)]
pub struct Rows<
    'a,
    T,
    const A: usize,
    const B: usize,
    const C: usize,
    const D: usize,
    const E: usize,
> {
    pub(super) a: &'a [[T; A]],
    pub(super) b: &'a [[T; B]],
    pub(super) c: &'a [[T; C]],
    pub(super) d: &'a [[T; D]],
    pub(super) e: &'a [[T; E]],
}

/// Rows of any length.
pub trait Runs<'a, T>: Copy + core::fmt::Debug {
    /// Rows of `pitch` words.
    fn new(words: &'a [T], pitch: usize) -> Self;
    /// The same for `rows` rows, at most 17 bits: without a division, for a tick.
    fn counted(words: &'a [T], pitch: usize, rows: u32) -> Self;
    /// Number of rows.
    fn count(&self, pitch: usize) -> usize;
    /// A row.
    fn row(&self, pitch: usize, index: usize) -> Option<&'a [T]>;
    /// Four rows, from row `index` on.
    fn four(&self, pitch: usize, index: usize) -> Option<&'a [T]>;
}

impl<T, const A: usize, const B: usize, const C: usize, const D: usize, const E: usize>
    Rows<'_, T, A, B, C, D, E>
{
    const NONE: Self = Self {
        a: &[],
        b: &[],
        c: &[],
        d: &[],
        e: &[],
    };
}

impl<'a, T, const A: usize, const B: usize, const C: usize, const D: usize, const E: usize>
    Runs<'a, T> for Rows<'a, T, A, B, C, D, E>
where
    T: Copy + core::fmt::Debug,
{
    fn new(words: &'a [T], pitch: usize) -> Self {
        let mut rows = Self::NONE;
        if pitch == A {
            rows.a = words.as_chunks().0;
        } else if pitch == B {
            rows.b = words.as_chunks().0;
        } else if pitch == C {
            rows.c = words.as_chunks().0;
        } else if pitch == D {
            rows.d = words.as_chunks().0;
        } else {
            rows.e = words.as_chunks().0;
        }
        rows
    }

    #[inline(always)]
    fn counted(words: &'a [T], pitch: usize, count: u32) -> Self {
        let mut rows = Self::NONE;
        if pitch == A {
            rows.a = counted(words, count);
        } else if pitch == B {
            rows.b = counted(words, count);
        } else if pitch == C {
            rows.c = counted(words, count);
        } else if pitch == D {
            rows.d = counted(words, count);
        } else {
            rows.e = counted(words, count);
        }
        rows
    }

    #[inline(always)]
    fn count(&self, pitch: usize) -> usize {
        if pitch == A {
            self.a.len()
        } else if pitch == B {
            self.b.len()
        } else if pitch == C {
            self.c.len()
        } else if pitch == D {
            self.d.len()
        } else {
            self.e.len()
        }
    }

    #[inline(always)]
    fn row(&self, pitch: usize, index: usize) -> Option<&'a [T]> {
        if pitch == A {
            self.a.get(index).map(<[T; A]>::as_slice)
        } else if pitch == B {
            self.b.get(index).map(<[T; B]>::as_slice)
        } else if pitch == C {
            self.c.get(index).map(<[T; C]>::as_slice)
        } else if pitch == D {
            self.d.get(index).map(<[T; D]>::as_slice)
        } else {
            self.e.get(index).map(<[T; E]>::as_slice)
        }
    }

    #[inline(always)]
    fn four(&self, pitch: usize, index: usize) -> Option<&'a [T]> {
        if pitch == A {
            four(self.a, index)
        } else if pitch == B {
            four(self.b, index)
        } else if pitch == C {
            four(self.c, index)
        } else if pitch == D {
            four(self.d, index)
        } else {
            four(self.e, index)
        }
    }
}

/// `rows` rows. The compiler sees that the product does not overflow, so that dividing by the same number inverts it.
#[inline(always)]
fn counted<T, const W: usize>(words: &[T], rows: u32) -> &[[T; W]] {
    let words = words.get(..(rows & 0x1_ffff) as usize * W);
    words.unwrap_or_default().as_chunks().0
}

#[inline(always)]
fn four<T, const W: usize>(rows: &[[T; W]], index: usize) -> Option<&[T]> {
    let rows = rows.get(index..index.checked_add(4)?)?;
    Some(rows.as_flattened())
}
