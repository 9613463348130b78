//! Follows a commanded speed as far as all limits allow.

use super::limits::{AccelerationBound, Limit, finite};
use super::{AxisError, Direction, Limits, LookAhead, MotionState};
use crate::Model;
use crate::curve::{CurveSet, Format};
use crate::number::{FrictionSign, Number, Quantity as _};

/// Follows a commanded speed with a motion that the drive can make, and slows down before places where the drive could not follow.
///
/// Each tick it chooses the acceleration that reaches the commanded speed at the end of the tick, within the [feasible](super::Limits::feasible)
/// range, and within the limit of a [`LookAhead`]:
///
/// ```text
/// α ≤ ½·d(ω_max²)/dφ + (ω_max² − ω²)/(2·ω_top·τ)
/// ```
///
/// The speed is continuous. Along a limit the second term is 0 and the first is the acceleration of the limit itself, so that the command does not
/// switch between braking and driving (test `the_governor_does_not_chatter`). The limit is approached without overshoot: within a tick at the top
/// speed, more slowly below it.
///
/// ```
/// use jred::axis::{Braking, Direction, Envelope, Governor, Limits, LookAhead, MotionState, Period};
/// use jred::{CurveSet, Image, Model, Phase, Spline, curves, include_image};
///
/// const PRESS: CurveSet = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;
///
/// # fn main() -> Result<(), jred::FirmwareError> {
/// // Once.
/// let image = Image::from_bytes(include_image!("../../examples/data/press_f32.jred"))?;
/// let press: Model<'_, Spline<f32>, PRESS> = image.model()?;
/// let tick = Period::new(0.001, &press)?;
/// let envelope = Envelope::new([[10.0, 250.0], [20.0, 100.0]], 250.0, &press)?;
/// let limits = Limits::new(envelope, 15.0, 100.0, tick, &press)?;
/// let braking = Braking { torque: 200.0, deceleration: 100.0, helped: false };
/// // In the last quarter of the turn not faster than 6 rad/s.
/// let limit = |phase: Phase| if phase.to_bits() >= 3 << 30 { 6.0 } else { 12.0 };
/// let ahead = LookAhead::<f32, 64>::new(&press, Direction::Forward, braking, limit, &tick)?;
/// let governor = Governor::one_way(&ahead);
///
/// // Every tick: the motion that is to follow the commanded 12 rad/s.
/// let mut motion = MotionState::<f32>::default();
/// for _ in 0..1000 {
///     let governed = governor.govern(&limits, &press, &motion, 12.0);
///     motion.alpha = governed.alpha;
///     let torque = press.torque_with(motion.phase, motion.omega, motion.alpha, governed.friction);
///     assert!(torque.abs() <= 250.01);
///     motion = tick.later(motion).value;
///     assert!(motion.omega <= 1.01 * limit(motion.phase));
/// }
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Governor<'a, N, const NODES: usize> {
    forward: Option<&'a LookAhead<N, NODES>>,
    backward: Option<&'a LookAhead<N, NODES>>,
}

/// The acceleration of a tick, and the limit that kept it from the command.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct GovernorOutput<N: Number> {
    /// α, in machine units.
    pub alpha: N::Acceleration,
    /// The limit that binds; `None`: the commanded speed is reached at the end of the tick.
    pub by: Option<Limit>,
    /// As [`FeasibleAccelerations::unkept`](super::FeasibleAccelerations::unkept); [`Limit::Ahead`]: too fast to satisfy all limits ahead;
    /// [`Limit::Speed`]: also for a command that is NaN.
    pub unkept: Option<Limit>,
    /// The sign of friction: of the speed, or at rest of the beginning motion, with the least speed in its direction. [`Model::torque_with`]
    /// then gives a torque that the drive has. Where friction keeps the machine at rest, which a torque does not consider,
    /// [`TorqueLimits`](super::TorqueLimits) ensures that.
    pub friction: FrictionSign<N>,
}

impl<'a, N: Number, const NODES: usize> Governor<'a, N, NODES> {
    /// For motions in one direction: a command in the other stops the machine.
    #[must_use]
    pub const fn one_way(ahead: &'a LookAhead<N, NODES>) -> Self {
        let [forward, backward] = match ahead.direction() {
            Direction::Forward => [Some(ahead), None],
            Direction::Backward => [None, Some(ahead)],
        };
        Self { forward, backward }
    }

    /// For motions in both directions, with the look-ahead of each.
    ///
    /// # Errors
    /// [`AxisError::Directions`]: the first is not for forward motion, or the second not for backward motion.
    pub fn both_ways(
        forward: &'a LookAhead<N, NODES>,
        backward: &'a LookAhead<N, NODES>,
    ) -> Result<Self, AxisError> {
        let ways = [forward.direction(), backward.direction()];
        let holds = ways == [Direction::Forward, Direction::Backward];
        if !holds {
            return Err(AxisError::Directions);
        }
        Ok(Self {
            forward: Some(forward),
            backward: Some(backward),
        })
    }

    /// The acceleration of this tick, for a machine in this motion that is to reach the speed `commanded`. A command that is NaN requests zero
    /// acceleration: the result is 0 or the nearest possible one, with the binding limit in `by`, and `unkept` reports it. If the motion's speed is
    /// NaN, the acceleration is 0, and `unkept` reports that, too.
    #[inline]
    pub fn govern<F: Format<Number = N>, const SET: CurveSet, const POINTS: usize>(
        &self,
        limits: &Limits<N, POINTS>,
        model: &Model<'_, F, SET>,
        motion: &MotionState<N>,
        commanded: N::Speed,
    ) -> GovernorOutput<N> {
        let rest = N::Speed::default();
        let omega = motion.omega;
        let period = limits.period();
        let feasible = limits.feasible(model, motion.phase, omega);
        // To rest at most, not into the other direction: there is no limit beyond which that begins.
        let stopped = period.needed(omega.negated()).value;
        let bounded = |alpha| {
            let by = Limit::Ahead;
            AccelerationBound { alpha, by }.within([feasible.least, feasible.greatest])
        };
        let [least, most] = [feasible.least.alpha, feasible.greatest.alpha];
        let forward = self.forward.map(|way| way.greatest(motion, [least, most]));
        let (forward, too_fast) = forward.unwrap_or((stopped, false));
        let opposite = [most.negated(), least.negated()];
        let backward = self.backward.map(|way| way.greatest(motion, opposite));
        let (backward, too_fast_back) = backward.map_or((stopped, false), |(alpha, beyond)| {
            (alpha.negated(), beyond)
        });
        let greatest = bounded(if forward > stopped { forward } else { stopped });
        let least = bounded(if backward < stopped {
            backward
        } else {
            stopped
        });
        let known = commanded >= rest || commanded <= rest;
        let wanted = finite::<N>(period.needed(commanded.minus(omega).value).value);
        let (alpha, by) = if wanted > greatest.alpha {
            (greatest.alpha, Some(greatest.by))
        } else if wanted < least.alpha {
            (least.alpha, Some(least.by))
        } else {
            (wanted, None)
        };
        let beyond = (too_fast || too_fast_back).then_some(Limit::Ahead);
        GovernorOutput {
            alpha,
            by,
            unkept: feasible
                .unkept
                .or(beyond)
                .or((!known).then_some(Limit::Speed)),
            friction: FrictionSign::OfSpeed(if omega == rest {
                N::Speed::of(alpha.number().least())
            } else {
                omega
            }),
        }
    }
}
