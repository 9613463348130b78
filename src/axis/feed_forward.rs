//! Feed-forward: the torque that a motion needs, and whether the table was made for that motion.

use core::marker::PhantomData;

use super::error::{positive, within};
use super::{AxisError, Motion, MotionRange, Status};
use crate::curve::{AccelerationOf, Format, Set, SpeedOf};
use crate::number::{Factor, Number, Quantity, Sliding};
use crate::{MachineUnits, Model, Phase, Validity};

/// A torque on the drive link, and whether the table was made for its motion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Checked<N: Number> {
    /// The torque, as [`Model::torque`] gives it; of a motion that the table was not made for, the torque of the nearest one that it was made for. Always a finite number.
    pub torque: N::Torque,
    /// What is wrong with the motion.
    pub status: Status,
}

/// Feed-forward with a model, and with the motions that its table was made for.
///
/// Two modes. [`at_reference`](Self::at_reference) takes everything from the set-point: nothing that is measured can disturb it, and it is right as
/// long as the machine follows. [`at_measured`](Self::at_measured) takes position and speed from the encoder (computed torque): it is right where the
/// machine *is*, but feeds the encoder's noise back. In both, Coulomb friction should have the sign of the set-point's speed
/// (`Sliding::Against(reference.omega)`, or a [`Ramp`]), so that the noise of a measured speed around zero does not turn it over.
///
/// Every input has a say in the one [`Status`]: the speed, the acceleration, the set-point's speed, what friction is against; too large, NaN and infinity. A motion that is flagged
/// gets the torque of the nearest that the table was made for, so that the weight of an axis stays held (test `what_is_flagged_holds_the_weight`).
///
/// What else stands between the model and the drive is put before and after it, each piece for itself: a lead time
/// ([`Period::later`](super::Period::later)), the gearbox ([`Transmission`](super::Transmission)), the limits of the drive
/// ([`TorqueLimits`], last of all).
///
/// ```
/// use jred::axis::{Encoder, FeedForward, Gearbox, Motion, Mounting, Period, TorqueLimits, Transmission};
/// use jred::number::Sliding;
/// use jred::{Image, Model, Set, Spline, curves, include_image};
///
/// const PRESS: Set = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;
/// const ENCODER: Encoder = match Encoder::new(Mounting::direct(10_000)) {
///     Ok(encoder) => encoder,
///     Err(_) => panic!("the encoder's figures"),
/// };
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
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
/// let reference = Motion { phase: ENCODER.phase(1234), omega: 10.0, alpha: 50.0 };
/// let needed = feed_forward.at_reference(lead.later(reference).value, Sliding::Against(reference.omega));
/// assert!(needed.status.is_valid());
/// let motor = gearbox.motor(needed.torque, reference.omega, reference.alpha).value;
/// let command = limits.limited(motor);
/// assert_eq!(command.torque + command.clipped, motor);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct FeedForward<'a, F: Format, const SET: Set> {
    model: Model<'a, F, SET>,
    range: MotionRange<F::Number>,
}

impl<'a, F: Format, const SET: Set> FeedForward<'a, F, SET> {
    /// With a model and what its table was made for ([`Image::validity`](crate::Image::validity), of the same image).
    #[must_use]
    pub fn new(model: Model<'a, F, SET>, validity: Validity) -> Self {
        let range = MotionRange::new(validity, model.table().scale());
        Self { model, range }
    }

    /// The same over the words that its model was made of, borrowed anew or in another place.
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

    /// The motions that the table was made for.
    #[must_use]
    pub const fn range(&self) -> &MotionRange<F::Number> {
        &self.range
    }

    /// As [`MotionRange::status`].
    #[inline]
    pub fn status(&self, omega: SpeedOf<F>, alpha: AccelerationOf<F>) -> Status {
        self.range.status(omega, alpha)
    }

    /// The torque for the reference, at the reference's phase and speed. The status is of what `sliding` is against, too.
    #[inline(always)]
    pub fn at_reference(
        &self,
        reference: Motion<F::Number>,
        sliding: Sliding<F::Number>,
    ) -> Checked<F::Number> {
        self.checked(reference, sliding, false)
    }

    /// The torque for the reference's acceleration, at the measured phase and speed. The status is of both speeds, and of what `sliding` is against.
    #[inline(always)]
    pub fn at_measured(
        &self,
        phase: Phase,
        omega: SpeedOf<F>,
        reference: Motion<F::Number>,
        sliding: Sliding<F::Number>,
    ) -> Checked<F::Number> {
        let measured = Motion {
            phase,
            omega,
            alpha: reference.alpha,
        };
        self.checked(
            measured,
            sliding,
            reference.omega.exceeds(self.range.omega()),
        )
    }

    #[inline(always)]
    fn checked(
        &self,
        motion: Motion<F::Number>,
        sliding: Sliding<F::Number>,
        beyond: bool,
    ) -> Checked<F::Number> {
        let mut status = self.range.status(motion.omega, motion.alpha);
        status.speed_beyond |= beyond || self.range.is_beyond(sliding);
        let (motion, sliding) = if status.is_valid() {
            (motion, sliding)
        } else {
            self.range.nearest(motion, sliding)
        };
        let Motion {
            phase,
            omega,
            alpha,
        } = motion;
        Checked {
            torque: self.model.torque_with(phase, omega, alpha, sliding),
            status,
        }
    }
}

/// Coulomb friction that rises in a straight line between standstill and a speed, instead of a jump.
///
/// One of a model in `Q15` is none for speeds in `Q31`:
///
/// ```compile_fail,E0308
/// # use jred::axis::Ramp;
/// # use jred::number::Sliding;
/// # use jred::{Q15, Q31, Speed};
/// fn friction(ramp: &Ramp<Q15>, omega: Speed<Q31>) -> Sliding<Q31> {
///     ramp.at(omega)
/// }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Ramp<N> {
    share: Factor,
    number: PhantomData<N>,
}

impl<N: Number> Ramp<N> {
    /// Up to the speed `width` (rad/s, or m/s), for a model in its machine units.
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

    /// How much of c acts at a speed: that of the set-point. Nothing at NaN, which the status of [`FeedForward`] finds in the set-point itself; all of it at infinity.
    #[inline]
    pub fn at(&self, omega: N::Speed) -> Sliding<N> {
        Sliding::Share(omega.number().times(&self.share).value.to_unit())
    }
}

/// What a drive can do: the command is limited after everything else, so that the drive gets what it was told and the program knows what is missing.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct TorqueLimits<T> {
    limits: [T; 2],
}

/// A torque within its limits.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Limited<T> {
    /// The torque; 0 for what is no number.
    pub torque: T,
    /// What the limits took away: 0 if nothing.
    pub clipped: T,
}

impl<T: Quantity> TorqueLimits<T> {
    /// From `least` to `greatest`.
    ///
    /// # Errors
    /// Limits that do not contain 0, or are NaN; the message has them in machine units. An infinite limit is none.
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

    /// The torque within the limits, and what they took away: of NaN the torque is 0, and what was taken away NaN; of infinity the limit and infinity.
    #[inline]
    pub fn limited(&self, torque: T) -> Limited<T> {
        let within = torque.within(self.limits);
        Limited {
            torque: within,
            clipped: torque.minus(within).value,
        }
    }
}
