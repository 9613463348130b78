//! Numbers of a tick in C, and SI units.

use core::mem::MaybeUninit;

use jred::axis::MotionRange;
use jred::number::{FrictionSign, Number, Quantity};
use jred::{Q15, Q31, Scale};

use crate::image::Info;
use crate::status::Status;

/// A number of a tick, and its type in C.
pub(crate) trait CNumber: Number {
    /// `float`, `int32_t` or `int16_t`.
    type C: Copy + Default;

    fn number(c: Self::C) -> Self;
    fn c(self) -> Self::C;
}

impl CNumber for f32 {
    type C = Self;

    #[inline]
    fn number(c: Self) -> Self {
        c
    }
    #[inline]
    fn c(self) -> Self {
        self
    }
}

impl CNumber for Q31 {
    type C = i32;

    #[inline]
    fn number(c: i32) -> Self {
        Self::from_bits(c)
    }
    #[inline]
    fn c(self) -> i32 {
        self.to_bits()
    }
}

impl CNumber for Q15 {
    type C = i16;

    #[inline]
    fn number(c: i16) -> Self {
        Self::from_bits(c)
    }
    #[inline]
    fn c(self) -> i16 {
        self.to_bits()
    }
}

/// A speed, an acceleration or a torque from C's number: C distinguishes them only by the names of parameters.
#[inline]
pub(crate) fn of<Q: Quantity<Number: CNumber>>(c: <Q::Number as CNumber>::C) -> Q {
    Q::of(CNumber::number(c))
}

/// Inverse of [`of`].
#[inline]
pub(crate) fn to_c<Q: Quantity<Number: CNumber>>(quantity: Q) -> <Q::Number as CNumber>::C {
    CNumber::c(quantity.number())
}

/// The sign of Coulomb friction: `jred_…_friction_sign` in C, member by member.
#[inline]
pub(crate) fn friction<N: CNumber>(number: N::C, is_share: bool) -> FrictionSign<N> {
    if is_share {
        FrictionSign::Scaled(N::number(number))
    } else {
        FrictionSign::OfSpeed(of(number))
    }
}

/// `jred_…_range` in C.
#[repr(C)]
pub(crate) struct Range<C> {
    pub(crate) least: C,
    pub(crate) greatest: C,
    pub(crate) least_limited: bool,
    pub(crate) greatest_limited: bool,
}

/// `jred_…_motion_range` in C.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct CMotionRange<C> {
    pub(crate) max_speed: C,
    pub(crate) max_acceleration: C,
}

/// The motions that a table is valid for, in the numbers of its model; only rest if the bases are invalid.
fn motion_range<N: CNumber>(
    info: Option<&Info>,
    range: Option<&mut MaybeUninit<CMotionRange<N::C>>>,
) -> Status {
    let Some(range) = range else {
        return Status::Null;
    };
    let range = range.write(CMotionRange::default());
    let Some(info) = info else {
        return Status::Null;
    };
    let Ok(scale) = Scale::new(info.bases()) else {
        return Status::Figure;
    };
    let found = MotionRange::<N>::new(info.validity(), &scale);
    *range = CMotionRange {
        max_speed: to_c(found.max_speed()),
        max_acceleration: to_c(found.max_acceleration()),
    };
    Status::Ok
}

macro_rules! motion_ranges {
    ($($name:ident: $number:ty,)*) => {$(
        #[unsafe(no_mangle)]
        pub(crate) extern "C" fn $name(
            info: Option<&Info>,
            range: Option<&mut MaybeUninit<CMotionRange<<$number as CNumber>::C>>>,
        ) -> Status {
            motion_range::<$number>(info, range)
        }
    )*};
}

motion_ranges! {
    jred_f32_motion_range_of: f32,
    jred_q31_motion_range_of: Q31,
    jred_q15_motion_range_of: Q15,
}

/// `si` in units of `base`.
fn from_si<N: CNumber>(si: f32, base: f32, number: Option<&mut N::C>) -> Status {
    let Some(number) = number else {
        return Status::Null;
    };
    let found = N::per_unit(si, base);
    *number = found.value.c();
    if found.saturated {
        Status::Limited
    } else {
        Status::Ok
    }
}

#[unsafe(no_mangle)]
pub(crate) extern "C" fn jred_q31_from_si(si: f32, base: f32, number: Option<&mut i32>) -> Status {
    from_si::<Q31>(si, base, number)
}

#[unsafe(no_mangle)]
pub(crate) extern "C" fn jred_q15_from_si(si: f32, base: f32, number: Option<&mut i16>) -> Status {
    from_si::<Q15>(si, base, number)
}

#[unsafe(no_mangle)]
pub(crate) extern "C" fn jred_q31_to_si(number: i32, base: f32) -> f32 {
    Q31::from_bits(number).si(base)
}

#[unsafe(no_mangle)]
pub(crate) extern "C" fn jred_q15_to_si(number: i16, base: f32) -> f32 {
    Q15::from_bits(number).si(base)
}
