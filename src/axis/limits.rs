//! The accelerations that are possible in a tick, and what limits them.

use super::envelope::in_range;
use super::error::positive;
use super::{AxisError, Envelope, Period};
use crate::curve::{CurveSet, Format};
use crate::number::{FrictionSign, Number, Quantity};
use crate::tick::MachineUnits;
use crate::{AccelerationRange, Model, Outcome, Phase};

/// The limit of an acceleration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Limit {
    /// The torque of the drive at this speed.
    Torque,
    /// The greatest acceleration.
    Acceleration,
    /// The greatest speed, which would be exceeded at the end of the tick.
    Speed,
    /// Limits ahead, found by a [`LookAhead`](super::LookAhead).
    Ahead,
    /// The range of fixed-point numbers: the drive could do more than the acceleration base.
    Range,
}

/// An acceleration, and its limit.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct AccelerationBound<N: Number> {
    /// α, in machine units.
    pub alpha: N::Acceleration,
    /// The limit that binds.
    pub by: Limit,
}

/// The accelerations that are possible in a tick: never empty, because a drive's torque always includes 0.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct FeasibleAccelerations<N: Number> {
    /// The least.
    pub least: AccelerationBound<N>,
    /// The greatest.
    pub greatest: AccelerationBound<N>,
    /// The limit that is violated: the load drives the machine beyond it, or the speed is beyond it already. The torque is never violated.
    pub unkept: Option<Limit>,
}

/// Limits of a motion: those of the drive, and the greatest speed and acceleration of the machine.
///
/// They give the possible accelerations for the state of a tick:
///
/// ```text
/// α ∈ [(T_least − w)/J, (T_greatest − w)/J],   w = ½·J′·ω² − load + b·ω + c·sgn ω
/// |α| ≤ α_max,   |ω + α·τ| ≤ ω_max
/// ```
///
/// At rest friction keeps the machine in place until a torque exceeds it: α is 0 there while |T + load| ≤ c.
///
/// Limits that cannot all be satisfied are satisfied in this order: torque, acceleration, speed.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Limits<N: Number, const POINTS: usize> {
    envelope: Envelope<N, POINTS>,
    speed: [N::Speed; 2],
    acceleration: [N::Acceleration; 2],
    period: Period<N>,
}

impl<N: Number, const POINTS: usize> Limits<N, POINTS> {
    /// Limits from a drive's torque, and the greatest speed (rad/s, or m/s) and acceleration (rad/s², or m/s²) of the drive link in both directions,
    /// for a tick of this `period`. The greatest speed is reduced to the last point of the torque curve: beyond it there is no torque.
    ///
    /// # Errors
    /// A limit that is not positive and finite, or in fixed point beyond its base or less than the smallest number.
    pub fn new(
        envelope: Envelope<N, POINTS>,
        speed: f32,
        acceleration: f32,
        period: Period<N>,
        model: &impl MachineUnits<Number = N>,
    ) -> Result<Self, AxisError> {
        const SPEED: &str = "the greatest speed";
        const ACCELERATION: &str = "the greatest acceleration";
        positive(SPEED, speed)?;
        positive(ACCELERATION, acceleration)?;
        let (scale, rest) = (model.scale(), N::Speed::default());
        Ok(Self {
            speed: both(
                in_range(SPEED, speed, scale.speed(), scale.omega::<N::Speed>(speed))?
                    .within([rest, envelope.top()]),
            ),
            envelope,
            acceleration: both(in_range(
                ACCELERATION,
                acceleration,
                scale.acceleration(),
                scale.alpha(acceleration),
            )?),
            period,
        })
    }

    /// The drive's torque.
    #[must_use]
    pub const fn envelope(&self) -> &Envelope<N, POINTS> {
        &self.envelope
    }

    /// The period of the tick.
    #[must_use]
    pub const fn period(&self) -> &Period<N> {
        &self.period
    }

    /// The accelerations that are possible in this state: 0 at a speed that is NaN, finite at an infinite one; `unkept` reports both.
    #[inline]
    pub fn feasible<F: Format<Number = N>, const SET: CurveSet>(
        &self,
        model: &Model<'_, F, SET>,
        phase: Phase,
        omega: N::Speed,
    ) -> FeasibleAccelerations<N> {
        let torques = self.envelope.torques(omega);
        let [low, high] = torques;
        let given = |friction| model.acceleration_range_with(phase, omega, friction, low, high);
        // At rest, once against friction of a forward motion and once of a backward one: only the sign of the speed counts.
        let [back, forth] = self.acceleration.map(|alpha| N::Speed::of(alpha.number()));
        let rests = omega == N::Speed::default();
        let mut range = given(FrictionSign::OfSpeed(if rests { forth } else { omega }));
        if rests {
            let backward = given(FrictionSign::OfSpeed(back));
            range = AccelerationRange {
                least: held(range.least, backward.least),
                greatest: held(range.greatest, backward.greatest),
            };
        }
        let torque: [AccelerationBound<N>; 2] = [of_torque(range.least), of_torque(range.greatest)];
        let [low, high] = self.speed;
        let [slowest, fastest] = [self.up_to(low, omega), self.up_to(high, omega)];
        let rest = N::Acceleration::default();
        let too_fast = fastest.by == Limit::Acceleration && fastest.alpha <= rest;
        let too_slow = slowest.by == Limit::Acceleration && slowest.alpha >= rest;
        FeasibleAccelerations {
            least: slowest.within(torque),
            greatest: fastest.within(torque),
            unkept: if torque[0].alpha > self.acceleration[1]
                || torque[1].alpha < self.acceleration[0]
            {
                Some(Limit::Acceleration)
            } else {
                let lost = fastest.alpha < torque[0].alpha || slowest.alpha > torque[1].alpha;
                (lost || too_fast || too_slow).then_some(Limit::Speed)
            },
        }
    }

    /// The acceleration that reaches a speed at the end of the tick, within the greatest acceleration.
    #[inline]
    fn up_to(&self, speed: N::Speed, omega: N::Speed) -> AccelerationBound<N> {
        let needed = self.period.needed(speed.minus(omega).value).value;
        let alpha = needed.within(self.acceleration);
        let by = if alpha == needed {
            Limit::Speed
        } else {
            Limit::Acceleration
        };
        AccelerationBound { alpha, by }
    }
}

impl<N: Number> AccelerationBound<N> {
    /// Limited to a range.
    #[inline]
    pub(super) fn within(self, [least, greatest]: [Self; 2]) -> Self {
        if self.alpha <= least.alpha {
            least
        } else if self.alpha >= greatest.alpha {
            greatest
        } else {
            self
        }
    }
}

/// The greatest value, in both directions.
fn both<Q: Quantity>(greatest: Q) -> [Q; 2] {
    [greatest.negated(), greatest]
}

/// At rest: the acceleration if friction opposes forward motion, or if it opposes backward motion, or 0.
#[inline]
fn held<A: Quantity>(forward: Outcome<A>, backward: Outcome<A>) -> Outcome<A> {
    let rest = A::default();
    if forward.value > rest {
        forward
    } else if backward.value < rest {
        backward
    } else {
        Outcome::exact(rest)
    }
}

/// NaN becomes 0, infinity the largest finite number.
#[inline]
pub(super) fn finite<N: Number>(alpha: N::Acceleration) -> N::Acceleration {
    alpha.within([f32::MIN, f32::MAX].map(|end| N::Acceleration::of(N::per_unit(end, 1.0).value)))
}

#[inline]
fn of_torque<N: Number>(alpha: Outcome<N::Acceleration>) -> AccelerationBound<N> {
    let Outcome { value, saturated } = alpha;
    AccelerationBound {
        alpha: finite::<N>(value),
        by: if saturated {
            Limit::Range
        } else {
            Limit::Torque
        },
    }
}
