//! Formats with a polynomial for each curve and cell.

mod cell;
mod check;
mod fill;
mod rounding;
mod rows;
mod spline;

pub use rows::{Cubic, Quadratic};
pub use spline::{Spline, Spline16};

use cell::Cell;

use super::{CONSTANTS, Format, Row, Rows, Runs, Size, bases};
use crate::curve::curves::{self, CurveSet};
use crate::curve::samples::{Sample, Samples};
use crate::curve::table::{CellCurves, CurveValues, Table};
use crate::curve::{MAX_CELLS, TableError, Usage};
use crate::number::error::RangeError;
use crate::number::{FrictionSign, Kernel, Number, Ring, Role, Scalar, fence};
use crate::{Outcome, Phase, Q31};

/// Constants of a table of polynomials, in addition to its rows; in machine units, zero if absent.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Constants<W> {
    /// Added to every J of a [`Spline`], so that its control points are small and lose little to rounding.
    pub inertia: W,
    /// b, if constant.
    pub viscous: W,
    /// c, if constant.
    pub coulomb: W,
    /// Multipliers of the points of J, load, b, c and 1/J in a [`Spline16`].
    pub gains: [u16; 5],
}

/// Values that a curve's coefficients need in addition to its words.
#[derive(Clone, Copy, Default)]
pub struct More<R> {
    /// Added to the value of the curve that has it: software single precision spends as much on adding zero as any number.
    offset: Option<R>,
    /// Multiplies 16-bit points.
    gain: R,
}

pub(crate) type Word<L> = <<L as Format>::Number as Number>::Word;
type Raw<L> = <<L as Format>::Number as Kernel>::Raw;
type Fraction<L> = <<L as Format>::Number as Kernel>::Fraction;

/// Polynomials in memory.
pub trait Layout:
    Format<Number: Scalar, Word = Word<Self>, Constants = Constants<Word<Self>>>
{
    /// Its rows, by the lengths of the sets of curves.
    type Rows<'a>: Runs<'a, Word<Self>>;
    /// Code in the image header.
    const CODE: u8;
    /// Length of a row.
    const ROW: Row;
    /// Degree of the spline that the curves are made from.
    const DEGREE: u8;
    /// Whether the curve of 1/J is only a seed for one step of Newton's iteration. Quadratics have enough cells for a curve as accurate as J itself.
    const NEWTON: bool = Self::DEGREE == 3;
    /// Words from one curve of a row to the next.
    const COLUMN: usize;
    /// Coefficient k is stored times the power k of this, because a product with the place divides by it.
    const STEP: i8 = 1;
    /// The centre of the polynomial in a cell, 0 to 1.
    const CENTRE: f64 = <Self::Number as Kernel>::ROW_CENTRE;
    /// Whether a word contains two 16-bit numbers.
    const HALVES: bool = false;

    /// The rows of a table.
    fn rows(words: &[Word<Self>], set: CurveSet) -> Self::Rows<'_> {
        Runs::new(words, Self::ROW.pitch(set))
    }
    /// Number of cells. If each row is a cell, its rows are counted: the index is compared with that number anyway.
    #[inline(always)]
    fn cells(rows: &Self::Rows<'_>, table: &Table<'_, Self>, set: CurveSet) -> u32 {
        if Self::ROW.more == 0 {
            rows.count(Self::ROW.pitch(set)) as u32
        } else {
            // At most MAX_CELLS, so that the compiler knows that no sum with an index overflows.
            table.cells() & MAX_CELLS
        }
    }
    /// The words of a cell.
    #[inline(always)]
    fn cell<'a>(rows: &Self::Rows<'a>, index: usize, set: CurveSet) -> Option<&'a [Word<Self>]> {
        rows.row(Self::ROW.pitch(set), index)
    }
    /// The coefficients of one curve, computed in R.
    fn coefficients<R: Ring>(
        cell: &[Word<Self>],
        column: usize,
        set: CurveSet,
        more: More<R>,
        read: impl Fn(Word<Self>) -> R,
    ) -> [R; 4];
    fn locate(phase: u32, cells: u32) -> (u32, Fraction<Self>);
    /// x·u
    fn times(x: Raw<Self>, u: Fraction<Self>) -> Raw<Self>;
    #[inline(always)]
    fn value([p0, p1, p2, p3]: [Raw<Self>; 4], u: Fraction<Self>) -> Raw<Self> {
        let times = Self::times;
        p0 + times(p1 + times(p2 + times(p3, u), u), u)
    }
    /// Value, and slope per cell times `STEP`. A double Horner scheme (the second row is the derivative's) shares two of its products.
    #[inline(always)]
    fn value_and_slope(
        [p0, p1, p2, p3]: [Raw<Self>; 4],
        u: Fraction<Self>,
    ) -> (Raw<Self>, Raw<Self>) {
        let t3 = Self::times(p3, u);
        let b2 = p2 + t3;
        let b1 = p1 + Self::times(b2, u);
        (p0 + Self::times(b1, u), b1 + Self::times(b2 + t3, u))
    }
    /// The stored numbers for a cell of one curve with control points c₀…c₃ (or c₀…c₂), scaled so that their sum is the value: the coefficients, or
    /// the point c₀ first; the first `COLUMN` of them are used.
    fn stored(points: [f64; 4]) -> [f64; 4];
    /// The upper or lower 16-bit number of a word, if words contain halves.
    #[inline(always)]
    fn half(word: Word<Self>, _upper: bool) -> Word<Self> {
        word
    }
    /// One unit of a half, in machine units.
    fn unit(_: Role) -> f64 {
        1.0
    }
    /// `word` with one half replaced, if the number fits into 16 bits.
    fn with_half(_: Word<Self>, _upper: bool, half: Word<Self>) -> Option<Word<Self>> {
        Some(half)
    }
}

/// The format of a layout: a separate implementation for each, so that the documentation shows only public names.
macro_rules! format {
    ($layout:ty, $name:literal, $number:ty $(, $generic:ident)?) => {
        impl$(<$generic: Scalar>)? Format for $layout {
            type Number = $number;
            type Word = <$number as Number>::Word;
            type Constants = Constants<<$number as Number>::Word>;
            type Tick<'a> = check::LayoutTick<'a, Self>;

            const NAME: &'static str = $name;
            const CODES: Option<[u8; 2]> = match <$number as Kernel>::CODE {
                Some(number) => Some([number, <Self as Layout>::CODE]),
                None => None,
            };
            const SIZE: Size = Size::Rows(<Self as Layout>::ROW);
            const WHOLE_FACTOR: bool = Self::Number::FIXED;

            fn accepts(set: CurveSet) -> bool {
                let divides = !curves::has(set, curves::RECIPROCAL);
                curves::is_known(set) && (divides || Self::Number::FIXED)
            }

            fn check(table: &Table<'_, Self>) -> Result<(), TableError> {
                check::table(table)
            }

            fn read(table: &Table<'_, Self>, phase: Phase) -> CurveValues {
                let read = per_cell(table, phase);
                let span = table.domain().to::<f64>().span();
                CurveValues {
                    inertia_slope: read.inertia_slope * (f64::from(table.cells()) / span),
                    ..read
                }
            }

            fn si(table: &Table<'_, Self>, phase: Phase, cells_per_position: f64) -> CurveValues {
                let read = per_cell(table, phase);
                let [torque, speed, inertia] = bases(table.scale());
                CurveValues {
                    inertia: read.inertia * inertia,
                    inertia_slope: read.inertia_slope * inertia * cells_per_position,
                    load: read.load * torque,
                    viscous: read.viscous * torque / speed,
                    coulomb: read.coulomb * torque,
                }
            }

            fn cell_curves(
                table: &Table<'_, Self>,
                cell: u32,
                cells_per_position: f64,
            ) -> Option<CellCurves> {
                cell::curves(table, cell, cells_per_position)
            }

            fn reciprocal(table: &Table<'_, Self>, phase: Phase) -> Option<f64> {
                let (constants, _) = check::reciprocal(table).ok()?;
                let unit = f64::from(Self::Number::reciprocal_unit(constants));
                let raw = Cell::at(table, phase)?.curve(Role::Reciprocal)?;
                Some(Self::Number::exact(Role::Reciprocal, raw) / unit)
            }

            fn reciprocal_error(table: &Table<'_, Self>) -> f32 {
                check::reciprocal(table).map_or(0.0, |(_, error)| error)
            }

            fn fill<E: From<TableError> + From<RangeError>>(
                samples: &Samples<impl Fn(f64) -> Result<Sample, E>>,
                scratch: &mut [f64],
                words: &mut [Self::Word],
            ) -> Result<Self::Constants, E> {
                fill::fill::<Self, E>(samples, scratch, words)
            }

            fn base(curve: u8, set: CurveSet) -> &'static str {
                let mut roles = curves::roles(set);
                let found = roles.find(|(column, _)| *column == usize::from(curve));
                found.map_or("torque", |(_, role)| role.base())
            }

            fn header(constants: &Self::Constants, _: CurveSet) -> [u32; CONSTANTS] {
                // Numbers of 64 bits do not fit, and are not stored.
                let bits = |word: Self::Word| bytemuck::try_cast(word).unwrap_or(0);
                let [j, load, b, c, reciprocal] = constants.gains.map(u32::from);
                [
                    bits(constants.inertia),
                    bits(constants.viscous),
                    bits(constants.coulomb),
                    j | load << 16,
                    b | c << 16,
                    reciprocal,
                    0,
                    0,
                    0,
                    0,
                    0,
                ]
            }

            fn from_header(header: &[u32; CONSTANTS]) -> Self::Constants {
                let word = |bits: u32| bytemuck::try_cast(bits).unwrap_or_default();
                let &[inertia, viscous, coulomb, j_load, b_c, reciprocal, ..] = header;
                Constants {
                    inertia: word(inertia),
                    viscous: word(viscous),
                    coulomb: word(coulomb),
                    gains: [j_load, j_load >> 16, b_c, b_c >> 16, reciprocal].map(|gain| gain as u16),
                }
            }

            fn usage(table: &Table<'_, Self>) -> Result<Usage, TableError> {
                check::usage(table)
            }

            fn prepare<'a>(table: &Table<'a, Self>) -> Result<Self::Tick<'a>, TableError> {
                check::model(table)
            }

            #[inline(always)]
            fn moved<'a>(
                tick: &Self::Tick<'_>,
                table: &Table<'a, Self>,
                set: CurveSet,
            ) -> Self::Tick<'a> {
                tick.moved(table, set)
            }

            #[inline(always)]
            fn torque(
                table: &Table<'_, Self>,
                tick: &Self::Tick<'_>,
                set: CurveSet,
                phase: Phase,
                omega: Self::Number,
                alpha: Self::Number,
                friction: FrictionSign<Self::Number>,
            ) -> Self::Number {
                let Some(cell) = Cell::of(table, &tick.rows, phase, set) else {
                    return beyond();
                };
                let (inertia, slope) = cell.inertia();
                let sum = Self::Number::product(inertia, alpha);
                let coefficient = cell.speed_coefficient(slope, tick.factor, omega);
                let sum = Self::Number::accumulate(sum, coefficient, omega);
                // Each term is finished before the next is read, which saves registers. Not in forward dynamics, where a program requests several
                // accelerations at one place, and their common values would be read again.
                fence();
                let sum = cell.with_load(sum);
                fence();
                Self::Number::torque(cell.with_friction(sum, friction))
            }

            fn torque_terms(
                table: &Table<'_, Self>,
                tick: &Self::Tick<'_>,
                set: CurveSet,
                phase: Phase,
                omega: Self::Number,
                alpha: Self::Number,
                friction: FrictionSign<Self::Number>,
            ) -> [Self::Number; 5] {
                let cell = Cell::of(table, &tick.rows, phase, set);
                cell.map_or_else(Default::default, |cell| {
                    cell.torque_terms(tick.factor, omega, alpha, friction)
                })
            }

            #[inline(always)]
            fn accelerations(
                table: &Table<'_, Self>,
                tick: &Self::Tick<'_>,
                set: CurveSet,
                phase: Phase,
                omega: Self::Number,
                friction: FrictionSign<Self::Number>,
                torques: [Self::Number; 2],
            ) -> [Outcome<Self::Number>; 2] {
                let Some(cell) = Cell::of(table, &tick.rows, phase, set) else {
                    return [Outcome::default(); 2];
                };
                let (inertia, slope) = cell.inertia();
                let resisting =
                    Self::Number::product(cell.speed_coefficient(slope, tick.factor, omega), omega);
                let resisting = cell.with_friction(cell.with_load(resisting), friction);
                let reciprocal = cell.curve(Role::Reciprocal);
                // Not by `map`: it may become a loop in a function shared by many models, which does not know the set of curves.
                let [one, other] = torques;
                [
                    outcome::<Self>(one, resisting, inertia, reciprocal, tick),
                    outcome::<Self>(other, resisting, inertia, reciprocal, tick),
                ]
            }
        }
    };
}

/// For an absent cell: never called. The fence makes it a separate branch, which costs a tick one branch instruction.
#[cold]
#[inline(always)]
fn beyond<T: Default>() -> T {
    fence();
    T::default()
}

/// (torque − resisting)/J, by 1/J if the table has it.
#[inline(always)]
fn outcome<L: Layout>(
    torque: L::Number,
    resisting: Raw<L>,
    inertia: Raw<L>,
    reciprocal: Option<Raw<L>>,
    tick: &check::LayoutTick<'_, L>,
) -> Outcome<L::Number> {
    let Some(reciprocal) = reciprocal else {
        return L::Number::quotient(torque, resisting, inertia);
    };
    let inertia = L::NEWTON.then_some(inertia);
    L::Number::by_reciprocal(torque, resisting, reciprocal, tick.reciprocal, inertia)
}

format!(Spline<S>, "spline", S, S);
format!(Spline16, "spline16", Q31);
format!(Cubic<S>, "cubic", S, S);
format!(Quadratic<S>, "quadratic", S, S);

/// All curves in machine units, the slope per cell.
fn per_cell<L: Layout>(table: &Table<'_, L>, phase: Phase) -> CurveValues {
    let Some(cell) = Cell::at(table, phase) else {
        return CurveValues::default();
    };
    let (inertia, slope) = cell.inertia();
    let number = |role, raw: Option<Raw<L>>| raw.map_or(0.0, |raw| L::Number::exact(role, raw));
    CurveValues {
        inertia: L::Number::exact(Role::Inertia, inertia),
        inertia_slope: L::Number::exact(Role::Inertia, slope) / f64::from(L::STEP),
        load: number(Role::Load, cell.curve(Role::Load)),
        viscous: number(Role::Viscous, cell.viscous()),
        coulomb: number(Role::Coulomb, cell.coulomb()).abs(),
    }
}

/// The same polynomial in powers of u − centre.
fn about<R>([p0, p1, p2, p3]: [R; 4], centre: R) -> [R; 4]
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

#[inline(always)]
fn word<T: Copy, R: Ring>(cell: &[T], index: usize, read: impl Fn(T) -> R) -> R {
    cell.get(index).map_or(R::default(), |w| read(*w))
}
