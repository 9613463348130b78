//! The torque of the load, observed from position and drive torque.

use super::error::positive;
use super::motion::per_square;
use super::tracker::memory_of;
use super::{AxisError, MotionState, Period, Tracker, TrackerOutput};
use crate::curve::{CurveSet, Format};
use crate::number::{Factor, FrictionSign, Number, Quantity as _};
use crate::tick::MachineUnits;
use crate::{Model, Phase};

/// An observer of phase, speed, and the load torque d that the model does not contain: a [`Tracker`] whose acceleration the model predicts.
///
/// The reduced equation, with d in +φ like the load of the table, and its discrete form over a period T with the torque that acted in it:
///
/// ```text
/// J(φ)·α + ½·J′(φ)·ω² = T_drive + T_red(φ, ω) + d
///
/// predict   α from the model, in the middle of the period     correct by r = φ_measured − φ
///           φ ← φ + ω·T + ½·α·T²                              φ ← φ + (1 − θ³)·r
///           ω ← ω + α·T                                       ω ← ω + 3/2·(1 − θ²)·(1 − θ)·r/T
///           d ← d                                             d ← d + J(φ)·(1 − θ)³·r/T²
/// ```
///
/// These are the gains of the [`Tracker`], but the third one times J(φ): the error obeys the same linear equation wherever the machine is, with
/// three poles at θ = 1/(1 + 2π·bandwidth·T). A load that begins is seen as the share
///
/// ```text
/// d̂/d = (1 − θ)³·½·(1 + q)/(1 − θ·q)³        q: a delay of one period
/// ```
///
/// of it: half after 2.7, 90 % after 5.3, all but 1 % after 8.4/(1 − θ) periods, without overshoot. For constant J this is exact (test
/// `a_load_settles_as_the_closed_form_says`); while J varies as 3 : 1, to 0.2 % of the load at a bandwidth of 25 times the machine's turns a second
/// (test `a_variable_inertia_settles_the_same`). A lasting load has no error left. Noise of the encoder makes σ_d = J·σ_α with the σ_α of the [`Tracker`]
/// (test `the_encoder_makes_the_noise_of_the_tracker`).
///
/// The torque must be the one that *acted* since the reading before: after [`TorqueLimits`](super::TorqueLimits), with the losses of the gearbox, and
/// delayed as the drive delays it; otherwise d contains the difference. It also contains what the table lacks: friction, and the error of J times α.
/// At rest friction balances the other torques, and d shows what it balances.
///
/// Fixed point computes as the table does: d to a few units of the last place of its torque (test `fixed_point_observes_the_same`).
///
/// Cost on a Cortex-M4F with a table of splines: 293 instructions in `f32`, 497 in `Q31` (`scripts/test counts`); in `f32` one division.
///
/// ```
/// use jred::axis::Observer;
/// use jred::number::FrictionSign;
/// use jred::{CurveSet, Image, Model, Phase, Spline, curves, include_image};
///
/// const PRESS: CurveSet = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;
///
/// # fn main() -> Result<(), jred::FirmwareError> {
/// // Once.
/// let image = Image::from_bytes(include_image!("../../examples/data/press_f32.jred"))?;
/// let press: Model<'_, Spline<f32>, PRESS> = image.model()?;
/// let mut observer = Observer::with_bandwidth(60.0, 0.000_5, &press)?.at(Phase::default()); // Hz, s
///
/// // Every tick: the press stands at its dead centre, whatever acts on it there.
/// let seen = observer.update(&press, Phase::default(), 0.0, FrictionSign::OfSpeed(0.0));
/// assert!(seen.load.abs() < 1e-3 && !seen.jumped && !seen.limited);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Observer<N: Number> {
    tracker: Tracker,
    tick: Period<N>,
    half: Period<N>,
    /// From an acceleration to that of the tracker.
    square: Factor,
    memory: f32,
    motion: MotionState<N>,
    load: N::Torque,
}

/// The machine as an [`Observer`] sees it, in the machine units of its model.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Observed<N: Number> {
    /// Phase, speed and acceleration now.
    pub motion: MotionState<N>,
    /// d: the torque on the drive link that the model does not contain, in +φ.
    pub load: N::Torque,
    /// As [`TrackerOutput::residual`].
    pub residual: i32,
    /// As [`TrackerOutput::jumped`]. If the speed restarted at 0, so did the load.
    pub jumped: bool,
    /// The torque or the friction's speed was NaN, or torque, speed or acceleration were limited to the number range: the load is wrong until it has
    /// settled.
    pub limited: bool,
}

impl<N: Number> Observer<N> {
    /// An observer with three poles at the corner frequency `bandwidth` (Hz), called every `period` (s), for a model in its machine units.
    ///
    /// # Errors
    /// As [`Tracker::with_bandwidth`] and [`Period::new`]; [`AxisError::OutOfRange`]: the acceleration base is more than single precision can convert
    /// to phases per period squared.
    pub fn with_bandwidth(
        bandwidth: f32,
        period: f32,
        model: &impl MachineUnits<Number = N>,
    ) -> Result<Self, AxisError> {
        let memory = memory_of(bandwidth, period)?;
        let out_of_range = AxisError::OutOfRange {
            what: "the period of the tick",
            value: period,
            range: "between a microsecond and a second, or so",
        };
        positive("the period of the tick", period)?;
        Ok(Self {
            tracker: Tracker::new(memory)?,
            tick: Period::new(period, model)?,
            half: Period::new(0.5 * period, model)?,
            square: Factor::to_count(1.0 / per_square(period, model)).ok_or(out_of_range)?,
            memory,
            motion: MotionState::default(),
            load: N::Torque::default(),
        })
    }

    /// The same at rest at this phase, without a load: for the start, or after the encoder was set.
    #[must_use]
    pub fn at(self, phase: Phase) -> Self {
        let rest = MotionState::default();
        Self {
            tracker: self.tracker.at(phase),
            motion: MotionState { phase, ..rest },
            load: N::Torque::default(),
            ..self
        }
    }

    /// As [`Tracker::with_largest_step`].
    #[must_use]
    pub const fn with_largest_step(self, step: Phase) -> Self {
        Self {
            tracker: self.tracker.with_largest_step(step),
            ..self
        }
    }

    /// θ of its poles.
    #[must_use]
    pub const fn memory(&self) -> f32 {
        self.memory
    }

    /// Advances one period, with the encoder's phase now, and the torque on the drive link that acted since the reading before. Coulomb friction has
    /// the sign of the set-point's speed, or a [ramp](super::FrictionRamp).
    ///
    /// A torque that is NaN counts as no acceleration, a friction's speed that is NaN as forward; both are flagged.
    #[inline]
    pub fn update<F: Format<Number = N>, const SET: CurveSet>(
        &mut self,
        model: &Model<'_, F, SET>,
        measured: Phase,
        torque: N::Torque,
        friction: FrictionSign<N>,
    ) -> Observed<N> {
        // In the middle of the period the error of the prediction is of third order.
        let middle = self.half.later(self.motion);
        let MotionState { phase, omega, .. } = middle.value;
        let acting = torque.plus(self.load);
        let alpha = model.acceleration_with(phase, omega, friction, acting.value);
        let predicted = alpha.value.number().to_count(&self.square);
        self.tracker.accelerate(predicted);
        let tracked = if self.tick.on_stroke() {
            self.tracker.update_stroke(measured)
        } else {
            self.tracker.update(measured)
        };
        let correction = self.tick.alpha(TrackerOutput {
            acceleration: self.tracker.correction(tracked.residual),
            ..tracked
        });
        let load = self.load.plus(model.inertial(phase, correction.value));
        self.load = if tracked.jumped && self.tracker.restarted() {
            N::Torque::default()
        } else {
            load.value
        };
        let (omega, corrected) = (self.tick.omega(tracked), self.tick.alpha(tracked));
        self.motion = MotionState {
            phase: tracked.phase,
            omega: omega.value,
            alpha: corrected.value,
        };
        let (none, rest) = (N::Acceleration::default(), N::Speed::default());
        let known = alpha.value >= none || alpha.value <= none;
        let sliding = match friction {
            FrictionSign::OfSpeed(omega) => omega >= rest || omega <= rest,
            FrictionSign::Scaled(_) => true,
        };
        let beyond = matches!(predicted, i32::MIN | i32::MAX);
        let saturated = [middle.saturated, acting.saturated, alpha.saturated];
        let corrections = [correction.saturated, load.saturated, omega.saturated];
        Observed {
            motion: self.motion,
            load: self.load,
            residual: tracked.residual,
            jumped: tracked.jumped,
            limited: !(known && sliding)
                || beyond
                || corrected.saturated
                || saturated.contains(&true)
                || corrections.contains(&true),
        }
    }
}
