//! A turn in pieces, for curves with jumps.
//!
//! A table is at least continuously differentiable. Where a curve of the machine jumps (a load that is switched on, a cam whose follower starts with
//! a shock), the largest error of one table over the turn is at least half the jump, with any number of cells. More cells only narrow the region of
//! large error, to the width of a cell (test `one_table_cannot_follow_a_jump`). Separate tables for the pieces between the jumps have no such cells.
//! A [`Part`](crate::tabulate::Part) of the machine is tabulated as a stroke; [`Pieces`] combines the models again.

use crate::curve::{AccelerationOf, CurveSet, Format, SpeedOf, TableError, TorqueOf};
use crate::math::Real;
use crate::number::{Number, Outcome};
use crate::{AccelerationRange, Domain, Model, Phase, Scale};

/// A turn (or a stroke, whose first piece starts at phase 0) of N pieces, each with its own model; they share the machine units and the set of
/// curves.
///
/// Accuracy of the place within a piece: 2⁻³¹ of its length (test `phases_are_mapped_to_2_31_of_a_piece`). Cost in addition to the model's tick: N
/// comparisons and one long multiplication.
///
/// In 32-bit fixed point the machine units of a model depend on the width of its cells ([`Scale::for_cells`](crate::Scale::for_cells)). Pieces share
/// them if one common width is a multiple of the cell width of each piece: `for_cells` of that width then suits every piece. So the jumps must lie at
/// multiples of a small part of the turn; `jred export --pieces` finds it.
///
/// ```
/// use core::f64::consts::TAU;
/// use jred::error::Error;
/// use jred::machine::{PoseError, Reducible, Reduction};
/// use jred::tabulate::{Part, Request, fill, scratch_len, tabulate};
/// use jred::{CurveSet, Domain, Model, Phase, Pieces, Scale, Spline, curves};
///
/// /// A flywheel, and a brake that is on from 1 to 2 rad.
/// struct Braked;
///
/// impl Reducible for Braked {
///     fn domain(&self) -> Domain {
///         Domain::Turn
///     }
///     fn reduction(&self, phi: f64) -> Result<Reduction, PoseError> {
///         let on = (1.0..2.0).contains(&phi.rem_euclid(TAU));
///         let process = if on { -5.0 } else { 0.0 };
///         Ok(Reduction::new([0.1, 0.0, 0.0]).with_process(process))
///     }
/// }
///
/// fn main() -> Result<(), Error> {
///     const SET: CurveSet = curves::LOAD;
///     const MOST: u32 = 16;
///     let request = Request::new(0.001).with_max_speed(20.0).with_max_acceleration(100.0).with_max_cells(MOST);
///     let mut scratch = [0.0; scratch_len(MOST, SET)];
///     let mut words = [[0.0f32; 2 * (MOST as usize + 3)]; 2];
///     let [on, off] = words.each_mut();
///     let mut model = |from: f64, to: f64, words| {
///         let part = Part::new(&Braked, from, to)?;
///         let words: &mut [f32; 2 * (MOST as usize + 3)] = words;
///         let cells = tabulate::<Spline<f32>>(&part, SET, &request, &Scale::SI, &mut scratch, &mut words[..])?.cells;
///         let table = fill::<Spline<f32>>(&part, SET, cells, &Scale::SI, &mut scratch, words)?;
///         let model = Model::new(table)?;
///         Ok::<_, Error>((Phase::from_radians(from), model))
///     };
///     let turn: Pieces<'_, Spline<f32>, SET, 2> =
///         Pieces::new(Domain::Turn, [model(1.0, 2.0, on)?, model(2.0, 1.0 + TAU, off)?])?;
///     let torque = |phi: f64| turn.torque(Phase::from_radians(phi), 0.0, 0.0);
///     assert!(torque(0.999_999).abs() < 0.001 && (torque(1.000_001) - 5.0).abs() < 0.001);
///     assert!((torque(1.999_999) - 5.0).abs() < 0.001 && torque(2.000_001).abs() < 0.001);
///     Ok(())
/// }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Pieces<'a, F: Format, const SET: CurveSet, const N: usize> {
    models: [Piece<'a, F, SET>; N],
    pub(super) scale: Scale,
    pub(super) domain: Domain<<F::Number as Number>::Real>,
}

#[derive(Clone, Copy, Debug)]
struct Piece<'a, F: Format, const SET: CurveSet> {
    start: u32,
    /// Left shift of the piece's length until its top bit is set.
    shift: u32,
    /// 2⁶³ divided by the shifted length.
    stretch: u32,
    model: Model<'a, F, SET>,
}

/// Largest relative difference of a phase's length between two pieces: a length of 2¹⁶ units, rounded to one.
const UNITS: f32 = 1e-4;
/// 2³²
const TURN: f32 = 4_294_967_296.0;

impl<'a, F: Format, const SET: CurveSet, const N: usize> Pieces<'a, F, SET, N> {
    /// Creates pieces of this range, from their models and the phases at which they start, in ascending order; the last ends where the first starts.
    ///
    /// # Errors
    /// [`TableError::Pieces`]: no piece, starts that do not ascend, or a piece shorter than 2⁻¹⁶ of a turn. [`TableError::PieceUnits`]: a model whose
    /// range is not its part of the whole one, or whose machine units differ from the first model's.
    pub fn new(
        domain: Domain<<F::Number as Number>::Real>,
        models: [(Phase, Model<'a, F, SET>); N],
    ) -> Result<Self, TableError> {
        let starts = models.map(|(start, _)| start.to_bits());
        let Some((_, first)) = models.first() else {
            return Err(TableError::Pieces);
        };
        if !starts.is_sorted_by(|a, b| a < b) {
            return Err(TableError::Pieces);
        }
        let scale = *first.table().scale();
        let span = domain.span().to_f32();
        let mut following = starts.iter().cycle().skip(1);
        let (mut too_short, mut apart) = (false, false);
        let pieces = models.map(|(start, model)| {
            let start = start.to_bits();
            let next = following.next().copied().unwrap_or(start);
            // A single piece is a whole turn, whose length does not fit: use one unit less.
            let length = match next.wrapping_sub(start) {
                0 => u32::MAX,
                length => length,
            };
            too_short |= length < 1 << 16;
            let shift = length.leading_zeros();
            let shifted = u64::from(length.wrapping_shl(shift)).max(1);
            // Rounded: off by half a unit, which is a unit of 2⁻³² at the end of the piece.
            let stretch = (((1u64 << 63) + shifted / 2) / shifted).min(u64::from(u32::MAX));
            // Length of the piece's phases as a part of its range.
            let table = model.table();
            let expected = length as f32 / TURN * span;
            let near = (table.domain().span().to_f32() - expected).abs() <= UNITS * expected;
            apart |= !near || scale != *table.scale();
            Piece {
                start,
                shift,
                stretch: stretch as u32,
                model,
            }
        });
        if too_short {
            return Err(TableError::Pieces);
        }
        if apart {
            return Err(TableError::PieceUnits);
        }
        Ok(Self {
            models: pieces,
            scale,
            domain,
        })
    }

    /// The model of the piece at `phase`, and the phase within it.
    #[inline]
    fn at(&self, phase: Phase) -> Option<(&Model<'a, F, SET>, Phase)> {
        // Before the first start lies the last piece, continued from the previous turn.
        let mut piece = self.models.last()?;
        for candidate in &self.models {
            if phase.to_bits() >= candidate.start {
                piece = candidate;
            }
        }
        let beyond = phase.to_bits().wrapping_sub(piece.start);
        let shifted = u64::from(beyond.wrapping_shl(piece.shift));
        let within = (shifted * u64::from(piece.stretch)) >> 31;
        let within = within.min(u64::from(u32::MAX)) as u32;
        Some((&piece.model, Phase::from_bits(within)))
    }

    /// As [`Model::torque`].
    #[inline]
    pub fn torque(&self, phase: Phase, omega: SpeedOf<F>, alpha: AccelerationOf<F>) -> TorqueOf<F> {
        let found = self.at(phase);
        found.map_or(TorqueOf::<F>::default(), |(model, phase)| {
            model.torque(phase, omega, alpha)
        })
    }

    /// As [`Model::acceleration`].
    #[inline]
    pub fn acceleration(
        &self,
        phase: Phase,
        omega: SpeedOf<F>,
        torque: TorqueOf<F>,
    ) -> Outcome<AccelerationOf<F>> {
        let found = self.at(phase);
        found.map_or(Outcome::default(), |(model, phase)| {
            model.acceleration(phase, omega, torque)
        })
    }

    /// As [`Model::acceleration_range`].
    #[inline]
    pub fn acceleration_range(
        &self,
        phase: Phase,
        omega: SpeedOf<F>,
        least: TorqueOf<F>,
        greatest: TorqueOf<F>,
    ) -> AccelerationRange<F::Number> {
        let found = self.at(phase);
        found.map_or(AccelerationRange::default(), |(model, phase)| {
            model.acceleration_range(phase, omega, least, greatest)
        })
    }
}
