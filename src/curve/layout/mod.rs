//! How a table's curves lie in memory, and what it costs to read them.
//!
//! Every layout is a polynomial in each cell,
//!
//! ```text
//! f(u) = p0 + u·(p1 + u·(p2 + u·p3)),   u in [0, 1) within the cell
//! ```
//!
//! whose value and slope come from the same coefficients. All curves of a cell lie side by side: one index, one contiguous
//! read.
//!
//! | layout | words a curve and cell | continuous | for |
//! |---|---|---|---|
//! | [`Spline`] | 1 | value, slope, curvature | the smallest table |
//! | [`Spline16`] | ½ | as [`Spline`] | less than half of that, to about 1e-4 |
//! | [`Cubic`] | 4 | as the curve it was made from | the fastest tick |
//! | [`Quadratic`] | 3, rows padded to 4 | value, slope | the fastest tick without a long multiplication |

mod rows;
mod spline;

use crate::number::{Kernel, Ring};

/// A way to store curves. Sealed: [`Spline`], [`Spline16`], [`Cubic`], [`Quadratic`].
pub trait Layout: Store {
    /// Name as the command line writes it.
    const NAME: &'static str;
}

/// Control points of a uniform cubic B-spline, one a knot and curve: see [`CubicSpline`](crate::curve::CubicSpline).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Spline;

/// As [`Spline`], with 16 bits a control point, two of them in a word; fixed point only. The arithmetic stays that of 32 bits:
/// a curve's points are multiplied by a whole number of its own ([`Constants::gains`](crate::curve::Constants::gains)), so that they
/// use all of their bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Spline16;

/// The four coefficients of each cell's cubic.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cubic;

/// The three coefficients of each cell's quadratic, from a uniform quadratic B-spline; rows are padded to a multiple of four
/// words, the place in a cell has 16 bits in fixed point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quadratic;

/// What a curve's coefficients need besides its words.
#[derive(Clone, Copy, Default)]
pub struct More<R> {
    /// Added to the value.
    pub(crate) offset: R,
    /// Multiplies 16-bit points.
    pub(crate) gain: R,
}

/// Not nameable outside the crate.
pub trait Store: crate::sealed::Sealed + Copy + core::fmt::Debug + 'static {
    /// Code in the image header.
    const CODE: u8;
    /// Degree of the spline that the curves are made from.
    const DEGREE: u8;

    /// Words of a whole table.
    fn words(cells: usize, set: u8) -> usize;
    /// Words from one cell to the next.
    fn pitch(set: u8) -> usize;
    /// The words that a cell reads.
    fn cell<T>(words: &[T], index: usize, set: u8) -> Option<&[T]>;
    /// The coefficients of one curve, as computed in R.
    fn coefficients<S: Kernel, R: Ring>(
        cell: &[S::Word],
        column: usize,
        set: u8,
        more: More<R>,
        read: impl Fn(S::Word) -> R,
    ) -> [R; 4];
    /// Coefficient k is stored times the power k of this, because a product with the place divides by it.
    fn step<S: Kernel>() -> i8;
    /// The place in a cell that the polynomial is about, 0 to 1.
    fn centre<S: Kernel>() -> f64;
    fn locate<S: Kernel>(phase: u32, cells: u32) -> (u32, S::Fraction);
    fn value<S: Kernel>(coefficients: [S::Raw; 4], u: S::Fraction) -> S::Raw;
    /// Value, and slope a cell times `step`.
    fn value_and_slope<S: Kernel>(coefficients: [S::Raw; 4], u: S::Fraction) -> (S::Raw, S::Raw);
    /// What is stored for a cell of one curve, of control points c₀…c₃ (or c₀…c₂) divided so that their sum is the value: the
    /// coefficients, or the point c₀ first; `COLUMN` of them count.
    fn stored<S: Kernel>(points: [f64; 4]) -> [f64; 4];

    /// Whether the curve of 1/J is only a seed, for one step of Newton's iteration. Quadratics have so many cells that it is as
    /// exact as J itself.
    const NEWTON: bool;
    /// Words from one curve of a row to the next.
    const COLUMN: usize;
    /// Rows beyond the cells.
    const MORE_ROWS: usize;
    /// Whether the inertia's offset is used.
    const OFFSET: bool;
    /// Whether a word holds two numbers of 16 bits.
    const HALVES: bool = false;
}

/// The cubic of a cell from the control points (in sixths) of a uniform cubic B-spline; coefficient k times stepᵏ.
pub(crate) fn cubic<R: Ring>([c0, c1, c2, c3]: [R; 4], step: i8) -> [R; 4] {
    // Differences of neighbours are exact in floating point, sums of points are not: the slope would lose digits.
    let (d0, d1, d2) = (c1 - c0, c2 - c1, c3 - c2);
    let (s0, s1) = (d1 - d0, d2 - d1);
    [
        c1.times(6) + s0,
        (d0 + d1).times(3 * step),
        s0.times(3 * step * step),
        (s1 - s0).times(step * step * step),
    ]
}

/// The quadratic of a cell from the control points (in halves) of a uniform quadratic B-spline.
pub(crate) fn quadratic<R: Ring>([c0, c1, c2]: [R; 3], step: i8) -> [R; 4] {
    [
        c0 + c1,
        (c1 - c0).times(2 * step),
        (c0 - c1.times(2) + c2).times(step * step),
        R::default(),
    ]
}

/// The same polynomial in powers of u − centre.
pub(crate) fn about<R>([p0, p1, p2, p3]: [R; 4], centre: R) -> [R; 4]
where
    R: Copy + core::ops::Add<Output = R> + core::ops::Mul<Output = R>,
{
    let (two, three) = (p2 + p2, p3 + p3 + p3);
    [
        p0 + centre * (p1 + centre * (p2 + centre * p3)),
        p1 + centre * (two + centre * three),
        p2 + centre * three,
        p3,
    ]
}

/// The index-th run of N words. The compiler knows the length of what comes back, so that reads from it need no check.
#[inline]
fn run<T, const N: usize>(words: &[T], index: usize) -> Option<&[T]> {
    words.as_chunks::<N>().0.get(index).map(<[T; N]>::as_slice)
}

#[inline]
fn word<T: Copy, R: Ring>(cell: &[T], index: usize, read: impl Fn(T) -> R) -> R {
    cell.get(index).map_or(R::default(), |w| read(*w))
}

#[inline]
fn cubic_value<S: Kernel>(
    [p0, p1, p2, p3]: [S::Raw; 4],
    u: S::Fraction,
    step: impl Fn(S::Raw, S::Fraction) -> S::Raw,
) -> S::Raw {
    p0 + step(p1 + step(p2 + step(p3, u), u), u)
}

/// Horner's scheme twice over (the second row is that of the derivative) shares two of its products.
#[inline]
fn cubic_value_and_slope<S: Kernel>(
    [p0, p1, p2, p3]: [S::Raw; 4],
    u: S::Fraction,
    step: impl Fn(S::Raw, S::Fraction) -> S::Raw,
) -> (S::Raw, S::Raw) {
    let t3 = step(p3, u);
    let b2 = p2 + t3;
    let b1 = p1 + step(b2, u);
    (p0 + step(b1, u), b1 + step(b2 + t3, u))
}
