//! Speeds, accelerations and torques of a tick: in fixed point, distinct types.

use core::fmt;

use super::{Factor, Number, Outcome};
use crate::{Q15, Q31};

/// A speed, an acceleration or a torque of a tick. Sealed.
///
/// In fixed point each has its own type, [`Speed`], [`Acceleration`], [`Torque`] and [`MotorTorque`], because neither magnitude nor unit of a
/// per-unit number shows its meaning. In floating point all are plain `f32` or `f64`.
///
/// ```
/// use jred::number::Quantity;
/// use jred::{Q31, Speed};
///
/// let omega: Speed<Q31> = Quantity::of(Q31::from_bits(1 << 30));
/// assert_eq!(omega.number().to_bits(), 1 << 30);
/// assert_eq!(20.0_f32.number().to_bits(), 20.0_f32.to_bits());
/// ```
pub trait Quantity:
    Copy
    + Default
    + PartialEq
    + PartialOrd
    + fmt::Debug
    + crate::sealed::Logged
    + crate::sealed::Sealed
    + 'static
{
    /// Its number type: itself in floating point.
    type Number: Number;

    /// The quantity with this number, in machine units.
    fn of(number: Self::Number) -> Self;
    /// Its number, in machine units.
    fn number(self) -> Self::Number;

    /// The sum; limited and flagged in fixed point.
    #[doc(hidden)]
    #[inline(always)]
    fn plus(self, other: Self) -> Outcome<Self> {
        self.number().plus(other.number()).map(Self::of)
    }
    /// self − other; limited and flagged in fixed point.
    #[doc(hidden)]
    #[inline(always)]
    fn minus(self, other: Self) -> Outcome<Self> {
        self.number().minus(other.number()).map(Self::of)
    }
    /// −self; limited in fixed point.
    #[doc(hidden)]
    #[must_use]
    #[inline(always)]
    fn negated(self) -> Self {
        Self::default().minus(self).value
    }
    /// The mean of two.
    #[doc(hidden)]
    #[must_use]
    #[inline(always)]
    fn mean(self, other: Self) -> Self {
        Self::of(self.number().mean(other.number()))
    }
    /// Whether its magnitude is greater than the limit; true for NaN.
    #[doc(hidden)]
    #[inline(always)]
    fn exceeds(self, limit: Self) -> bool {
        self.number().exceeds(limit.number())
    }
    /// Limited to a range; NaN becomes 0.
    #[doc(hidden)]
    #[must_use]
    #[inline(always)]
    fn within(self, [least, greatest]: [Self; 2]) -> Self {
        Self::of(self.number().within([least.number(), greatest.number()]))
    }
    /// Another quantity, the number times the factor; limited and flagged in fixed point.
    #[doc(hidden)]
    #[inline(always)]
    fn times<Q: Quantity<Number = Self::Number>>(self, factor: &Factor) -> Outcome<Q> {
        self.number().times(factor).map(Q::of)
    }
    /// `si` in units of `base`.
    #[doc(hidden)]
    #[inline(always)]
    fn from_si(si: f32, base: f32) -> Outcome<Self> {
        Self::Number::per_unit(si, base).map(Self::of)
    }
    /// From units of `base` to SI.
    #[doc(hidden)]
    #[inline(always)]
    fn to_si(self, base: f32) -> f32 {
        self.number().si(base)
    }
}

macro_rules! float {
    ($float:ident) => {
        impl Quantity for $float {
            type Number = $float;
            #[inline(always)]
            fn of(number: $float) -> $float {
                number
            }
            #[inline(always)]
            fn number(self) -> $float {
                self
            }
        }
    };
}

float!(f32);
float!(f64);

macro_rules! quantity {
    ($(#[$documentation:meta])* $name:ident) => {
        $(#[$documentation])*
        ///
        /// `from_bits` and `to_bits` give the raw integers for a motion table or a log.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[cfg_attr(feature = "defmt", derive(defmt::Format))]
        #[repr(transparent)]
        pub struct $name<N>(N);

        impl $name<Q31> {
            /// The largest, 1 − 2⁻³¹ of its base.
            pub const MAX: Self = Self(Q31::MAX);
            /// The smallest, −1 of its base.
            pub const MIN: Self = Self(Q31::MIN);

            /// From the raw integer, in units of 2⁻³¹ of its base.
            #[must_use]
            #[inline]
            pub const fn from_bits(bits: i32) -> Self {
                Self(Q31::from_bits(bits))
            }

            /// The raw integer, in units of 2⁻³¹ of its base.
            #[must_use]
            #[inline]
            pub const fn to_bits(self) -> i32 {
                self.0.to_bits()
            }
        }

        impl $name<Q15> {
            /// The largest, 1 − 2⁻¹⁵ of its base.
            pub const MAX: Self = Self(Q15::MAX);
            /// The smallest, −1 of its base.
            pub const MIN: Self = Self(Q15::MIN);

            /// From the raw integer, in units of 2⁻¹⁵ of its base.
            #[must_use]
            #[inline]
            pub const fn from_bits(bits: i16) -> Self {
                Self(Q15::from_bits(bits))
            }

            /// The raw integer, in units of 2⁻¹⁵ of its base.
            #[must_use]
            #[inline]
            pub const fn to_bits(self) -> i16 {
                self.0.to_bits()
            }
        }

        impl<N: Number> $name<N> {
            /// The sum, limited to the range.
            #[must_use]
            #[inline]
            pub fn saturating_add(self, other: Self) -> Self {
                Self(self.0.plus(other.0).value)
            }

            /// The difference, limited to the range.
            #[must_use]
            #[inline]
            pub fn saturating_sub(self, other: Self) -> Self {
                Self(self.0.minus(other.0).value)
            }

            /// The negative, limited to the range.
            #[must_use]
            #[inline]
            pub fn saturating_neg(self) -> Self {
                Self(N::default().minus(self.0).value)
            }
        }

        quantity!(of $name<Q31>);
        quantity!(of $name<Q15>);
    };
    (of $name:ident<$number:ident>) => {
        impl crate::sealed::Sealed for $name<$number> {}

        impl Quantity for $name<$number> {
            type Number = $number;
            #[inline(always)]
            fn of(number: $number) -> Self {
                Self(number)
            }
            #[inline(always)]
            fn number(self) -> $number {
                self.0
            }
        }
    };
}

quantity! {
    /// A speed ω of the drive link in fixed point: 1 is the speed base of the [`Scale`](crate::Scale).
    ///
    /// ```
    /// use jred::{Outcome, Q31, Scale, Speed, number::Bases};
    ///
    /// let scale = Scale::new(Bases { torque: 20.0, speed: 60.0, inertia: 0.05 })?;
    /// let Outcome { value: omega, saturated }: Outcome<Speed<Q31>> = scale.omega(15.0);
    /// assert!(omega.to_bits() == 1 << 29 && !saturated);
    /// assert_eq!(scale.omega_si(omega.saturating_add(omega)), 30.0);
    /// assert_eq!(omega.clamp(Speed::<Q31>::MIN, Speed::default()), Speed::default());
    /// # Ok::<(), jred::number::RangeError>(())
    /// ```
    ///
    /// Meaningless operations do not compile: a speed and a torque have no sum,
    ///
    /// ```compile_fail,E0308
    /// # use jred::{Q31, Speed, Torque};
    /// fn sum(omega: Speed<Q31>, torque: Torque<Q31>) -> Speed<Q31> {
    ///     omega.saturating_add(torque)
    /// }
    /// ```
    ///
    /// and a speed is not an acceleration:
    ///
    /// ```compile_fail,E0271
    /// # use jred::{Q31, Scale, Speed};
    /// fn shown(scale: &Scale, omega: Speed<Q31>) -> f32 {
    ///     scale.alpha_si(omega)
    /// }
    /// ```
    Speed
}

quantity! {
    /// An acceleration α of the drive link in fixed point: 1 is the acceleration base of the [`Scale`](crate::Scale), T_b/J_b.
    Acceleration
}

quantity! {
    /// A torque on the drive link in fixed point: 1 is the torque base of the [`Scale`](crate::Scale).
    Torque
}

quantity! {
    /// A torque on the motor's shaft, behind a gearbox, in fixed point: 1 is the base of the [`Transmission`](crate::axis::Transmission).
    MotorTorque
}
