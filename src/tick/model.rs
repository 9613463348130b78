//! The tick: the equation of motion of the reduced machine, solved for torque or acceleration.
//!
//! ```text
//! inverse:  T = J(φ)·α + ½·J′(φ)·ω² − load(φ) + b(φ)·ω + c(φ)·sgn ω
//! forward:  α = (T − ½·J′(φ)·ω² + load(φ) − b(φ)·ω − c(φ)·sgn ω)/J(φ)
//! ```
//!
//! (7.12) of Nazarenko, *Dynamics of mechanisms* (2002); for a sliding drive link (7.10), with m_red for J, F for T and v for ω. T acts on the drive
//! link: a motor behind a gear ratio i has T/i, and its rotor belongs in J as i²·J_M (`Machine::with_flywheel`). sgn 0 = 0: at standstill the model
//! has no friction, because friction then balances the other forces.

use crate::curve::{AccelerationOf, CurveSet, Format, SpeedOf, Table, TableError, TorqueOf};
use crate::number::{FrictionSign, Number, Quantity};
use crate::{Outcome, Phase};

/// A reduced machine ready for the tick, over a table in RAM or in flash. Its set of [`curves`](crate::curves) is part of the type, so that absent
/// curves cost neither memory nor instructions.
///
/// Everything was checked when it was created: [`torque`](Self::torque), [`acceleration`](Self::acceleration) and
/// [`acceleration_range`](Self::acceleration_range) neither fail nor panic nor allocate, and always take the same path.
///
/// A tick takes a [`Phase`] and, in numbers of the model's format, a speed and an acceleration. In SI units these are plain numbers,
///
/// ```
/// # use jred::{Model, Phase, Spline};
/// fn torque(model: &Model<Spline<f32>, 0>) -> f32 {
///     model.torque(Phase::from_radians(0.5), 10.0, 50.0)
/// }
/// ```
///
/// in per-unit they have their own types:
///
/// ```
/// # use jred::{Acceleration, Model, Phase, Q31, Speed, Spline, Torque};
/// fn torque(model: &Model<Spline<Q31>, 0>, omega: Speed<Q31>, alpha: Acceleration<Q31>) -> Torque<Q31> {
///     model.torque(Phase::from_radians(0.5), omega, alpha)
/// }
/// ```
///
/// These do not compile: an angle in radians,
///
/// ```compile_fail,E0308
/// # use jred::{Acceleration, Model, Phase, Q31, Speed, Spline, Torque};
/// fn torque(model: &Model<Spline<Q31>, 0>, omega: Speed<Q31>, alpha: Acceleration<Q31>) -> Torque<Q31> {
///     model.torque(0.5, omega, alpha)
/// }
/// ```
///
/// speed and acceleration swapped,
///
/// ```compile_fail,E0308
/// # use jred::{Acceleration, Model, Phase, Q31, Speed, Spline, Torque};
/// fn torque(model: &Model<Spline<Q31>, 0>, omega: Speed<Q31>, alpha: Acceleration<Q31>) -> Torque<Q31> {
///     model.torque(Phase::from_radians(0.5), alpha, omega)
/// }
/// ```
///
/// a torque given as a speed,
///
/// ```compile_fail,E0308
/// # use jred::{Acceleration, Model, Outcome, Phase, Q31, Speed, Spline, Torque};
/// fn alpha(model: &Model<Spline<Q31>, 0>, torque: Torque<Q31>) -> Outcome<Acceleration<Q31>> {
///     model.acceleration(Phase::from_radians(0.5), torque, torque)
/// }
/// ```
///
/// a torque taken for an acceleration,
///
/// ```compile_fail,E0308
/// # use jred::{Acceleration, Model, Phase, Q31, Speed, Spline, Torque};
/// fn torque(model: &Model<Spline<Q31>, 0>, omega: Speed<Q31>, alpha: Acceleration<Q31>) -> Acceleration<Q31> {
///     model.torque(Phase::from_radians(0.5), omega, alpha)
/// }
/// ```
///
/// SI numbers in a per-unit model,
///
/// ```compile_fail,E0308
/// # use jred::{Model, Phase, Q31, Spline, Torque};
/// fn torque(model: &Model<Spline<Q31>, 0>) -> Torque<Q31> {
///     model.torque(Phase::from_radians(0.5), 10.0, 50.0)
/// }
/// ```
///
/// and 16-bit numbers in a 32-bit model:
///
/// ```compile_fail,E0308
/// # use jred::{Acceleration, Model, Phase, Q15, Q31, Speed, Spline, Torque};
/// fn torque(model: &Model<Spline<Q31>, 0>, omega: Speed<Q15>, alpha: Acceleration<Q15>) -> Torque<Q31> {
///     model.torque(Phase::from_radians(0.5), omega, alpha)
/// }
/// ```
///
/// Models of different formats or curve sets are different types:
///
/// ```
/// # use jred::{Model, Spline, curves};
/// fn same<'a>(model: Model<'a, Spline<f32>, { curves::LOAD }>) -> Model<'a, Spline<f32>, { curves::LOAD }> {
///     model
/// }
/// ```
///
/// ```compile_fail,E0308
/// # use jred::{Cubic, Model, Spline, curves};
/// fn same<'a>(model: Model<'a, Cubic<f32>, { curves::LOAD }>) -> Model<'a, Spline<f32>, { curves::LOAD }> {
///     model
/// }
/// ```
///
/// ```compile_fail,E0308
/// # use jred::{Model, Spline, curves};
/// fn same<'a>(model: Model<'a, Spline<f32>, { curves::INERTIA }>) -> Model<'a, Spline<f32>, { curves::LOAD }> {
///     model
/// }
/// ```
#[derive(Clone, Copy, Debug)]
#[repr(transparent)]
pub struct Model<'a, F: Format, const SET: CurveSet>(AnyModel<'a, F>);

/// As [`Model`], with a set of [`curves`](crate::curves) known at run time: for hosts, which tick any table. The same bits.
#[derive(Clone, Copy, Debug)]
pub struct AnyModel<'a, F: Format> {
    table: Table<'a, F>,
    tick: F::Tick<'a>,
}

/// The accelerations for an interval of torques.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct AccelerationRange<N: Number> {
    /// At the least torque.
    pub least: Outcome<N::Acceleration>,
    /// At the greatest torque.
    pub greatest: Outcome<N::Acceleration>,
}

/// The terms of the drive torque.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct TorqueTerms<N: Number> {
    /// J·α
    pub acceleration: N::Torque,
    /// ½·J′·ω²
    pub velocity: N::Torque,
    /// −load
    pub load: N::Torque,
    /// b·ω
    pub viscous: N::Torque,
    /// c·sgn ω
    pub coulomb: N::Torque,
}

impl<'a, F: Format> AnyModel<'a, F> {
    /// Creates a model over `table`.
    ///
    /// In fixed point this proves that no torque leaves the number range for any speed and acceleration in it.
    ///
    /// # Errors
    /// [`TableError::VelocityTorque`]: ½·J′·ω_b² does not fit the torque base. [`TableError::TorqueRange`]: the sum of all terms does not fit the
    /// torque base. [`TableError::Reciprocal`]: the seed of 1/J does not match J. [`TableError::SpeedBase`], [`TableError::Slope`]: the machine units
    /// are not those of the table.
    pub fn new(table: Table<'a, F>) -> Result<Self, TableError> {
        let tick = F::prepare(&table)?;
        Ok(Self { table, tick })
    }

    const fn any(&self) -> &Self {
        self
    }

    /// The same model over its words, borrowed again or moved.
    #[inline(always)]
    fn moved<'b>(&self, words: &'b [F::Word], set: CurveSet) -> AnyModel<'b, F> {
        let table = self.table.moved(words);
        let tick = F::moved(&self.tick, &table, set);
        AnyModel { table, tick }
    }
}

impl<'a, F: Format, const SET: CurveSet> Model<'a, F, SET> {
    /// Creates a model over `table`.
    ///
    /// # Errors
    /// As [`AnyModel::new`]; [`TableError::Curves`]: the table has another set.
    pub fn new(table: Table<'a, F>) -> Result<Self, TableError> {
        if table.set() != SET {
            return Err(TableError::Curves(table.set()));
        }
        AnyModel::new(table).map(Self)
    }

    const fn any(&self) -> &AnyModel<'a, F> {
        &self.0
    }

    /// J·α: the torque that alone causes this acceleration, at rest.
    #[inline(always)]
    pub(crate) fn inertial(&self, phase: Phase, alpha: AccelerationOf<F>) -> TorqueOf<F> {
        let Self(AnyModel { table, tick }) = self;
        let rest = F::Number::default();
        let friction = FrictionSign::Scaled(rest);
        let [torque, ..] = F::torque_terms(table, tick, SET, phase, rest, alpha.number(), friction);
        TorqueOf::<F>::of(torque)
    }

    /// The same model over its words, borrowed again or moved.
    #[inline(always)]
    pub(crate) fn moved<'b>(&self, words: &'b [F::Word]) -> Model<'b, F, SET> {
        Model(self.0.moved(words, SET))
    }
}

macro_rules! dynamics {
    ($model:ident, [$($set:tt)*], |$any:ident| $curves:expr) => {
        impl<'a, F: Format, $($set)*> dynamics!(@type $model [$($set)*]) {
            /// The table.
            pub const fn table(&self) -> &Table<'a, F> {
                &self.any().table
            }

            /// Inverse dynamics of many samples: `torques[k]` becomes the torque at `phases[k]`, `omegas[k]`, `alphas[k]`. Computes as many as the
            /// shortest slice has, and returns their number.
            pub fn torques(
                &self,
                phases: &[Phase],
                omegas: &[SpeedOf<F>],
                alphas: &[AccelerationOf<F>],
                torques: &mut [TorqueOf<F>],
            ) -> usize {
                let samples = phases.iter().zip(omegas).zip(alphas).zip(torques);
                samples
                    .map(|(((phase, omega), alpha), torque)| {
                        *torque = self.torque(*phase, *omega, *alpha);
                    })
                    .count()
            }

            /// Inverse dynamics: the torque on the drive link (N·m, or per unit) for the speed `omega` and the acceleration `alpha`. It never
            /// saturates.
            ///
            /// Accuracy against the same formula without rounding, for the table's own words at the place in the cell that the tick reads. The
            /// scripts of `tests/proofs` prove it (`scripts/test proofs`); the tests of `tests/proven.rs` try to exceed it:
            ///
            /// - `Q31`: 24 units of 2⁻³¹ of the torque base, plus 7 (`Spline` 3½, `Quadratic` 4) for each whole slope per cell that
            ///   [`Scale::for_cells`](crate::Scale::for_cells) assigns to the velocity torque. The sum of the values that [`Table::at`] reads has 10
            ///   of them (test `q31_torque_rounds_as_stated`).
            /// - `Q15`: 5.75 units of 2⁻¹⁵; the sum has ¾ of them (test `torque_is_that_of_the_curves`).
            /// - `f32`, with cells: 115 units of 2⁻²⁴ (`Spline` 192), if coefficients (of a `Spline`, eight times its points), arguments and the
            ///   factor of the velocity torque (½·cells/range in SI units) are at most 1; otherwise of the largest term.
            ///
            /// Not included: the rounding of the scale's bases, 2.5e-7 of the velocity torque in `Q31` if `Scale::for_cells` made them (1.4e-6 are
            /// accepted), 3e-7 in `f32`; and the error of the table, which `tabulate` reports. docs/theory.md adds them up. Cost:
            /// docs/performance.md.
            #[inline]
            pub fn torque(&self, phase: Phase, omega: SpeedOf<F>, alpha: AccelerationOf<F>) -> TorqueOf<F> {
                self.torque_with(phase, omega, alpha, FrictionSign::OfSpeed(omega))
            }

            /// As [`torque`](Self::torque), with Coulomb friction given by `friction`: the sign of the set-point, or a ramp.
            #[inline(always)]
            pub fn torque_with(
                &self,
                phase: Phase,
                omega: SpeedOf<F>,
                alpha: AccelerationOf<F>,
                friction: FrictionSign<F::Number>,
            ) -> TorqueOf<F> {
                let $any = self.any();
                let (omega, alpha) = (omega.number(), alpha.number());
                TorqueOf::<F>::of(F::torque(&$any.table, &$any.tick, $curves, phase, omega, alpha, friction))
            }

            /// The separate terms of [`torque_with`](Self::torque_with). Their sum is the torque except for their roundings, each of four units in
            /// `Q31` and of one in `Q15`.
            pub fn torque_terms(
                &self,
                phase: Phase,
                omega: SpeedOf<F>,
                alpha: AccelerationOf<F>,
                friction: FrictionSign<F::Number>,
            ) -> TorqueTerms<F::Number> {
                let $any = self.any();
                let (omega, alpha) = (omega.number(), alpha.number());
                let [acceleration, velocity, load, viscous, coulomb] =
                    F::torque_terms(&$any.table, &$any.tick, $curves, phase, omega, alpha, friction)
                        .map(TorqueOf::<F>::of);
                TorqueTerms { acceleration, velocity, load, viscous, coulomb }
            }

            /// Forward dynamics: the acceleration that `torque` on the drive link causes at the speed `omega`; in fixed point limited to the number
            /// range, and flagged. With [`curves::RECIPROCAL`](crate::curves::RECIPROCAL) there is no division; [`Table::reciprocal_error`] gives the
            /// error of that.
            #[inline(always)]
            pub fn acceleration(
                &self,
                phase: Phase,
                omega: SpeedOf<F>,
                torque: TorqueOf<F>,
            ) -> Outcome<AccelerationOf<F>> {
                self.acceleration_with(phase, omega, FrictionSign::OfSpeed(omega), torque)
            }

            /// As [`acceleration`](Self::acceleration), with Coulomb friction given by `friction`.
            #[inline(always)]
            pub fn acceleration_with(
                &self,
                phase: Phase,
                omega: SpeedOf<F>,
                friction: FrictionSign<F::Number>,
                torque: TorqueOf<F>,
            ) -> Outcome<AccelerationOf<F>> {
                let $any = self.any();
                let [found, _] = F::accelerations(
                    &$any.table, &$any.tick, $curves, phase, omega.number(), friction, [torque.number(); 2],
                );
                found.map(AccelerationOf::<F>::of)
            }

            /// The accelerations for torques from `least` to `greatest`: the limits for planning a motion.
            #[inline]
            pub fn acceleration_range(
                &self,
                phase: Phase,
                omega: SpeedOf<F>,
                least: TorqueOf<F>,
                greatest: TorqueOf<F>,
            ) -> AccelerationRange<F::Number> {
                self.acceleration_range_with(phase, omega, FrictionSign::OfSpeed(omega), least, greatest)
            }

            /// As [`acceleration_range`](Self::acceleration_range), with Coulomb friction given by `friction`: at rest, against the motion that is to
            /// begin.
            #[inline(always)]
            pub fn acceleration_range_with(
                &self,
                phase: Phase,
                omega: SpeedOf<F>,
                friction: FrictionSign<F::Number>,
                least: TorqueOf<F>,
                greatest: TorqueOf<F>,
            ) -> AccelerationRange<F::Number> {
                let $any = self.any();
                let [least, greatest] = F::accelerations(
                    &$any.table, &$any.tick, $curves, phase, omega.number(), friction,
                    [least.number(), greatest.number()],
                );
                AccelerationRange {
                    least: least.map(AccelerationOf::<F>::of),
                    greatest: greatest.map(AccelerationOf::<F>::of),
                }
            }
        }
    };
    (@type $model:ident []) => { $model<'a, F> };
    (@type $model:ident [const SET: CurveSet]) => { $model<'a, F, SET> };
}

dynamics!(Model, [const SET: CurveSet], |any| SET);
dynamics!(AnyModel, [], |any| any.table.set());
