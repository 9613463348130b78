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

use crate::scalar::{Outcome, Scalar};
use crate::table::{Table, TableError, curves};
use crate::{Domain, Phase, Scale};

/// A reduced machine ready for the tick, over a table in RAM or in flash.
///
/// Everything was checked when it was built: [`torque`](Self::torque) and [`acceleration`](Self::acceleration)
/// neither fail nor panic nor allocate, and take the same path every time.
#[derive(Clone, Copy, Debug)]
pub struct Model<'a, S: Scalar, const CURVES: u8> {
    table: Table<'a, S, CURVES>,
    velocity_factor: S::Factor,
}

impl<'a, S: Scalar, const CURVES: u8> Model<'a, S, CURVES> {
    /// A model over `table`, whose range is `span` (2π, or the stroke in m) and whose machine units are `scale`.
    ///
    /// # Errors
    /// [`TableError::VelocityTorque`]: ½·J′·ω_b² does not fit the torque base.
    pub fn new(
        table: Table<'a, S, CURVES>,
        span: S::Span,
        scale: &Scale,
    ) -> Result<Self, TableError> {
        let overflow = |cell| TableError::VelocityTorque { cell };
        let factor = S::velocity_factor(table.cells(), span, scale).ok_or(overflow(0))?;
        for cell in 0..table.cells() {
            let [_, p1, p2, p3] = S::cubic(table.points(cell, 0)).map(S::to_wide_f32);
            // The slope is a parabola: it stays within its Bézier points.
            let hull = [p1, p1 + p2, p1 + 2.0 * p2 + 3.0 * p3];
            if !hull.iter().all(|slope| S::factor_fits(*slope, factor)) {
                return Err(overflow(cell));
            }
        }
        Ok(Self {
            table,
            velocity_factor: factor,
        })
    }

    /// As [`new`](Self::new), with the range of the machine that the table was made from.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn for_domain(
        table: Table<'a, S, CURVES>,
        domain: Domain,
        scale: &Scale,
    ) -> Result<Self, TableError> {
        Self::new(table, S::span(domain), scale)
    }

    /// The table.
    pub const fn table(&self) -> &Table<'a, S, CURVES> {
        &self.table
    }

    /// Inverse dynamics: the torque on the drive link that the motion needs.
    #[inline]
    pub fn torque(&self, phase: Phase, omega: S, alpha: S) -> Outcome<S> {
        let Some(cell) = self.table.cell(phase) else {
            return Outcome::default();
        };
        let inertia = cell.cubic(0);
        let own = S::value(inertia, cell.u).times(alpha);
        S::narrow(own + self.resisting(&cell, inertia, omega))
    }

    /// Forward dynamics: the acceleration that a torque on the drive link gives.
    #[inline]
    pub fn acceleration(&self, phase: Phase, omega: S, torque: S) -> Outcome<S> {
        let Some(cell) = self.table.cell(phase) else {
            return Outcome::default();
        };
        let inertia = cell.cubic(0);
        let net = torque.wide() - self.resisting(&cell, inertia, omega);
        S::quotient(net, S::value(inertia, cell.u))
    }

    /// ½·J′·ω² − load + b·ω + c·sgn ω, of the curves that the machine has.
    #[inline]
    fn resisting(
        &self,
        cell: &crate::table::Cell<'_, S, CURVES>,
        inertia: [S; 4],
        omega: S,
    ) -> S::Wide {
        let slope = S::slope(inertia, cell.u).scaled(self.velocity_factor);
        let square = S::narrow(omega.times(omega)).value;
        let mut sum = slope.times(square);
        if CURVES & curves::LOAD != 0 {
            sum = sum - cell.curve(curves::LOAD).wide();
        }
        if CURVES & curves::VISCOUS != 0 {
            sum = sum + cell.curve(curves::VISCOUS).times(omega);
        }
        if CURVES & curves::COULOMB != 0 {
            sum = sum + cell.curve(curves::COULOMB).signed_like(omega);
        }
        sum
    }
}
