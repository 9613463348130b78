//! Feed-forward: the torque for a motion, and whether the table is valid for that motion.

use core::marker::PhantomData;

use super::error::{positive, within};
use super::{AxisError, MotionRange, MotionState, Status};
use crate::curve::{AccelerationOf, CurveSet, Format, SpeedOf};
use crate::number::{Factor, FrictionSign, Number, Quantity};
use crate::tick::{MachineUnits, Validity};
use crate::{Model, Phase};

/// A torque on the drive link, and whether the table is valid for its motion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CheckedTorque<N: Number> {
    /// The torque of [`Model::torque`]; for a motion outside the validity of the table, the torque of the nearest valid motion. Always finite.
    pub torque: N::Torque,
    /// Which of speed and acceleration are outside the validity.
    pub status: Status,
}

/// Feed-forward with a model, limited to the motions that its table is valid for.
///
/// Two modes. [`at_reference`](Self::at_reference) takes position, speed and acceleration from the set-point: measurements cannot disturb it, and it
/// is right as long as the machine follows. [`at_measured`](Self::at_measured) takes position and speed from the encoder (computed torque): it is
/// right where the machine *is*, but feeds back the encoder's noise. In both, Coulomb friction should have the sign of the set-point's speed
/// (`FrictionSign::OfSpeed(reference.omega)`, or a [`FrictionRamp`]), so that noise of a measured speed around zero does not reverse it.
///
/// The one [`Status`] covers every input: speed, acceleration, the set-point's speed and the friction's speed or share; too large, NaN or infinite. A
/// flagged motion gets the torque of the nearest valid one, so that the weight of an axis is still carried (test `what_is_flagged_holds_the_weight`).
///
/// The other parts between model and drive are separate: before it a lead time ([`Period::later`](super::Period::later)), after it the gearbox
/// ([`Transmission`](super::Transmission)) and, last of all, the limits of the drive ([`TorqueLimits`]).
///
/// ```
/// use jred::axis::{Encoder, FeedForward, Gearbox, MotionState, Mounting, Period, TorqueLimits, Transmission};
/// use jred::number::FrictionSign;
/// use jred::{CurveSet, Image, Model, Spline, curves, include_image};
///
/// const PRESS: CurveSet = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;
/// const ENCODER: Encoder = match Encoder::new(Mounting::direct(10_000)) {
///     Ok(encoder) => encoder,
///     Err(_) => panic!("the encoder's figures"),
/// };
///
/// # fn main() -> Result<(), jred::FirmwareError> {
/// // Once.
/// let image = Image::from_bytes(include_image!("../../examples/data/press_f32.jred"))?;
/// let press: Model<'_, Spline<f32>, PRESS> = image.model()?;
/// let feed_forward = FeedForward::new(press, image.validity());
/// // The drive needs 0.2 ms from the command to the torque.
/// let lead = Period::new(0.000_2, &press)?;
/// let gearbox = Gearbox { ratio: 20.0, efficiency: 0.95, rotor: 0.000_3 };
/// let gearbox = Transmission::new(gearbox, &press)?;
/// let limits = TorqueLimits::new(-12.0, 12.0)?;
///
/// // Every tick.
/// let reference = MotionState { phase: ENCODER.phase(1234), omega: 10.0, alpha: 50.0 };
/// let needed = feed_forward.at_reference(lead.later(reference).value, FrictionSign::OfSpeed(reference.omega));
/// assert!(needed.status.is_valid());
/// let motor = gearbox.motor(needed.torque, reference.omega, reference.alpha).value;
/// let command = limits.limited(motor);
/// assert_eq!(command.torque + command.clipped, motor);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct FeedForward<'a, F: Format, const SET: CurveSet> {
    model: Model<'a, F, SET>,
    range: MotionRange<F::Number>,
}

impl<'a, F: Format, const SET: CurveSet> FeedForward<'a, F, SET> {
    /// Feed-forward with a model and the validity of its table ([`Image::validity`](crate::Image::validity), of the same image).
    #[must_use]
    pub fn new(model: Model<'a, F, SET>, validity: Validity) -> Self {
        let range = MotionRange::new(validity, model.table().scale());
        Self { model, range }
    }

    /// The same over the words of its model, borrowed again or moved.
    #[inline(always)]
    pub(super) fn moved<'b>(&self, words: &'b [F::Word]) -> FeedForward<'b, F, SET> {
        FeedForward {
            model: self.model.moved(words),
            range: self.range,
        }
    }

    /// The model.
    #[must_use]
    pub const fn model(&self) -> &Model<'a, F, SET> {
        &self.model
    }

    /// The motions that the table is valid for.
    #[must_use]
    pub const fn range(&self) -> &MotionRange<F::Number> {
        &self.range
    }

    /// As [`MotionRange::status`].
    #[inline]
    pub fn status(&self, omega: SpeedOf<F>, alpha: AccelerationOf<F>) -> Status {
        self.range.status(omega, alpha)
    }

    /// The torque for the reference, at the reference's phase and speed. The status includes the speed or share in `friction`.
    #[inline(always)]
    pub fn at_reference(
        &self,
        reference: MotionState<F::Number>,
        friction: FrictionSign<F::Number>,
    ) -> CheckedTorque<F::Number> {
        self.checked(reference, friction, false)
    }

    /// The torque for the reference's acceleration, at the measured phase and speed. The status includes both speeds, and the speed or share in
    /// `friction`.
    #[inline(always)]
    pub fn at_measured(
        &self,
        phase: Phase,
        omega: SpeedOf<F>,
        reference: MotionState<F::Number>,
        friction: FrictionSign<F::Number>,
    ) -> CheckedTorque<F::Number> {
        let measured = MotionState {
            phase,
            omega,
            alpha: reference.alpha,
        };
        self.checked(
            measured,
            friction,
            reference.omega.exceeds(self.range.max_speed()),
        )
    }

    #[inline(always)]
    fn checked(
        &self,
        motion: MotionState<F::Number>,
        friction: FrictionSign<F::Number>,
        beyond: bool,
    ) -> CheckedTorque<F::Number> {
        let mut status = self.range.status(motion.omega, motion.alpha);
        status.speed_beyond |= beyond || self.range.is_beyond(friction);
        let (motion, friction) = if status.is_valid() {
            (motion, friction)
        } else {
            self.range.nearest(motion, friction)
        };
        let MotionState {
            phase,
            omega,
            alpha,
        } = motion;
        CheckedTorque {
            torque: self.model.torque_with(phase, omega, alpha, friction),
            status,
        }
    }
}

/// Coulomb friction that rises linearly from standstill to a speed, instead of a jump.
///
/// A ramp for a model in `Q15` does not accept speeds in `Q31`:
///
/// ```compile_fail,E0308
/// # use jred::axis::FrictionRamp;
/// # use jred::number::FrictionSign;
/// # use jred::{Q15, Q31, Speed};
/// fn friction(ramp: &FrictionRamp<Q15>, omega: Speed<Q31>) -> FrictionSign<Q31> {
///     ramp.at(omega)
/// }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(C)]
pub struct FrictionRamp<N> {
    share: Factor,
    number: PhantomData<N>,
}

impl<N: Number> FrictionRamp<N> {
    /// Creates a ramp up to the speed `width` (rad/s, or m/s), for a model in its machine units.
    ///
    /// # Errors
    /// A width that is not positive and finite, or less than 1e-6 of the speed base.
    pub fn new(width: f32, model: &impl MachineUnits<Number = N>) -> Result<Self, AxisError> {
        let base = model.scale().speed();
        let ratio = base / positive("the width of the friction ramp", width)?;
        let factor = (ratio <= 1e6).then(|| Factor::new(ratio)).flatten();
        let ramp = |share| Self {
            share,
            number: PhantomData,
        };
        factor.map(ramp).ok_or(AxisError::OutOfRange {
            what: "the width of the friction ramp",
            value: width,
            range: "at least a millionth of the speed base",
        })
    }

    /// The share of c that acts at the set-point's speed `omega`: 0 at NaN, which the status of [`FeedForward`] reports for the set-point itself; all
    /// of c at infinity.
    #[inline]
    pub fn at(&self, omega: N::Speed) -> FrictionSign<N> {
        FrictionSign::Scaled(omega.number().times(&self.share).value.to_unit())
    }
}

/// The torque limits of a drive, applied to the command last of all, so that the program knows by how much the drive's torque falls short.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(C)]
pub struct TorqueLimits<T> {
    limits: [T; 2],
}

/// A torque within its limits.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LimitedTorque<T> {
    /// The torque; NaN becomes 0.
    pub torque: T,
    /// The part of the torque that was cut off; 0 within the limits.
    pub clipped: T,
}

impl<T: Quantity> TorqueLimits<T> {
    /// Limits from `least` to `greatest`.
    ///
    /// # Errors
    /// Limits that do not contain 0, or are NaN; the message has them in machine units. An infinite limit does not limit.
    pub fn new(least: T, greatest: T) -> Result<Self, AxisError> {
        let none = T::default();
        for (what, torque, holds, range) in [
            ("the least torque", least, least <= none, "zero or negative"),
            (
                "the greatest torque",
                greatest,
                greatest >= none,
                "zero or positive",
            ),
        ] {
            within(what, torque.to_si(1.0), holds, range)?;
        }
        Ok(Self {
            limits: [least, greatest],
        })
    }

    /// The torque within the limits, and the part that was cut off. NaN: torque 0, cut off NaN. Infinity: the limit, cut off infinity.
    #[inline]
    pub fn limited(&self, torque: T) -> LimitedTorque<T> {
        let within = torque.within(self.limits);
        LimitedTorque {
            torque: within,
            clipped: torque.minus(within).value,
        }
    }
}
