//! The tick: the equation of motion of the reduced machine, both ways.
//!
//! ```text
//! inverse:  T = J(φ)·α + ½·J′(φ)·ω² − load(φ) + b(φ)·ω + c(φ)·sgn ω
//! forward:  α = (T − ½·J′(φ)·ω² + load(φ) − b(φ)·ω − c(φ)·sgn ω)/J(φ)
//! ```
//!
//! (7.12) of Nazarenko, *Dynamics of mechanisms* (2002); for a sliding drive link (7.10), with m_red for J, F for T
//! and v for ω. T acts on the drive link: a motor behind a gear ratio i gives T/i, and its rotor belongs into J as
//! i²·J_M (`Machine::with_flywheel`). sgn 0 = 0: at standstill the model states no friction, because friction there is whatever holds the
//! machine.

use super::range::{self, check};
use crate::curve::{Cell, Layout, Spline, Table, TableError, curves};
use crate::number::{Outcome, Scalar};
use crate::{Domain, Phase, Scale};

/// A reduced machine ready for the tick, over a table in RAM or in flash.
///
/// Everything was checked when it was built: [`torque`](Self::torque), [`acceleration`](Self::acceleration) and
/// [`acceleration_range`](Self::acceleration_range) neither fail nor panic nor allocate, and take the same path every time.
#[derive(Clone, Copy, Debug)]
pub struct Model<'a, S: Scalar, const CURVES: u8, L: Layout = Spline> {
    table: Table<'a, S, L>,
    velocity_factor: S::Factor,
    reciprocal: S::Reciprocal,
}

/// The accelerations that an interval of torques can give.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct AccelerationRange<S> {
    /// At the least torque.
    pub least: Outcome<S>,
    /// At the greatest torque.
    pub greatest: Outcome<S>,
}

impl<'a, S: Scalar, const CURVES: u8, L: Layout> Model<'a, S, CURVES, L> {
    /// A model over `table`, whose range is `span` (2π, or the stroke in m) and whose machine units are `scale`.
    ///
    /// In fixed point it is proven here that no torque leaves the number range for any speed and acceleration in it.
    ///
    /// # Errors
    /// [`TableError::VelocityTorque`]: ½·J′·ω_b² does not fit the torque base. [`TableError::TorqueRange`]: all terms
    /// together do not fit the torque base. [`TableError::Reciprocal`]: the seed of 1/J is not that of J.
    pub fn new(table: Table<'a, S, L>, span: S::Span, scale: &Scale) -> Result<Self, TableError> {
        if table.curves() != CURVES {
            return Err(TableError::Curves(table.curves()));
        }
        let (factor, reciprocal) = check(&table, span, scale)?;
        Ok(Self {
            table,
            velocity_factor: factor,
            reciprocal,
        })
    }

    /// As [`new`](Self::new), with the range of the machine that the table was made from.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn for_domain(
        table: Table<'a, S, L>,
        domain: Domain,
        scale: &Scale,
    ) -> Result<Self, TableError> {
        Self::new(table, S::span(domain), scale)
    }

    /// How far forward and inverse dynamics disagree, as a part of the acceleration: what is left of 1/J's own curve, as found
    /// at four places of every cell. 0 for a model that divides.
    pub fn reciprocal_error(&self) -> f32 {
        match curves::RECIPROCAL & CURVES {
            0 => 0.0,
            _ => range::reciprocal(&self.table).map_or(0.0, |(_, error)| error),
        }
    }

    /// The table.
    pub const fn table(&self) -> &Table<'a, S, L> {
        &self.table
    }

    /// Inverse dynamics of many samples: `torques[k]` becomes the torque at `phases[k]`, `omegas[k]`, `alphas[k]`. As many as
    /// the shortest slice has; their number is returned.
    pub fn torques(
        &self,
        phases: &[Phase],
        omegas: &[S],
        alphas: &[S],
        torques: &mut [S],
    ) -> usize {
        let samples = phases.iter().zip(omegas).zip(alphas).zip(torques);
        samples
            .map(|(((phase, omega), alpha), torque)| *torque = self.torque(*phase, *omega, *alpha))
            .count()
    }

    /// Inverse dynamics: the torque on the drive link (N·m, or per unit) that the speed `omega` and the acceleration `alpha` need.
    /// It never saturates.
    ///
    /// Exact for the table's curves to the roundings of the number type: in `Q31` to 10 units of 2⁻³¹ of the torque base (test
    /// `tests/fixed_point.rs`). What the table itself is off by, `tabulate` says. Cost: docs/performance.md.
    #[inline]
    pub fn torque(&self, phase: Phase, omega: S, alpha: S) -> S {
        let Some(cell) = self.table.cell(phase, CURVES) else {
            return S::default();
        };
        let (inertia, slope) = cell.inertia();
        let sum = S::product(self.speed_coefficient(&cell, slope, omega), omega);
        let sum = S::accumulate(sum, inertia, alpha);
        S::torque(Self::with_load_and_friction(&cell, sum, omega))
    }

    /// Forward dynamics: the acceleration that the torque `torque` on the drive link gives at the speed `omega`; in fixed point
    /// limited to the number range, and flagged. With [`curves::RECIPROCAL`] there is no division;
    /// [`reciprocal_error`](Self::reciprocal_error) says how far it is from one.
    #[inline]
    pub fn acceleration(&self, phase: Phase, omega: S, torque: S) -> Outcome<S> {
        let Some(cell) = self.table.cell(phase, CURVES) else {
            return Outcome::default();
        };
        self.accelerations(&cell, omega, [torque])[0]
    }

    /// The accelerations that torques from `least` to `greatest` can give: the limits for whatever plans the motion.
    #[inline]
    pub fn acceleration_range(
        &self,
        phase: Phase,
        omega: S,
        least: S,
        greatest: S,
    ) -> AccelerationRange<S> {
        let Some(cell) = self.table.cell(phase, CURVES) else {
            return AccelerationRange::default();
        };
        let [least, greatest] = self.accelerations(&cell, omega, [least, greatest]);
        AccelerationRange { least, greatest }
    }

    #[inline]
    fn accelerations<const N: usize>(
        &self,
        cell: &Cell<'_, S, L>,
        omega: S,
        torques: [S; N],
    ) -> [Outcome<S>; N] {
        let (inertia, slope) = cell.inertia();
        let resisting = S::product(self.speed_coefficient(cell, slope, omega), omega);
        let resisting = Self::with_load_and_friction(cell, resisting, omega);
        let reciprocal = cell.reciprocal();
        torques.map(|torque| match reciprocal {
            Some(reciprocal) => {
                let inertia = L::NEWTON.then_some(inertia);
                S::by_reciprocal(torque, resisting, reciprocal, self.reciprocal, inertia)
            }
            None => S::quotient(torque, resisting, inertia),
        })
    }

    /// Factor of the velocity torque a unit of the slope a cell and a cell, up to a constant: inversely proportional to the
    /// range, and otherwise the same for all models in the same machine units.
    pub(super) fn factor_of_range(&self) -> f32 {
        S::factor_size(self.velocity_factor) / self.table.cells() as f32
    }

    /// ½·J′·ω + b
    #[inline]
    fn speed_coefficient(&self, cell: &Cell<'_, S, L>, slope: S::Raw, omega: S) -> S::Raw {
        let velocity = S::velocity(slope, self.velocity_factor, omega);
        cell.viscous().map_or(velocity, |b| velocity + b)
    }

    /// sum − load + c·sgn ω, of the curves that the machine has.
    #[inline]
    fn with_load_and_friction(cell: &Cell<'_, S, L>, sum: S::Raw, omega: S) -> S::Raw {
        let sum = cell.load().map_or(sum, |load| sum - load);
        cell.coulomb().map_or(sum, |c| S::add_signed(sum, c, omega))
    }
}
