//! Creates the parts of an axis in memory of the caller. Their ticks are in the header, inlined into the C call; only the
//! observer's is here.

use core::mem::MaybeUninit;

use jred::axis::{
    AxisError, FrictionRamp, Gearbox, Observed, Observer, Period, TorqueLimits, Tracker,
    Transmission, Units,
};
use jred::number::Number;
use jred::{Phase, Q15, Q31};

use crate::image::Info;
use crate::memory::Held;
use crate::number::{CNumber, of, to_c};
use crate::status::Status;

/// 64-bit words of memory for an observer, as in `jred_axis.h`.
pub(crate) const OBSERVER_WORDS: usize = 28;

/// Writes what was created; zeros on an error, whose ticks give 0.
fn keep<T>(memory: Option<&mut MaybeUninit<T>>, made: Result<T, Status>) -> Status {
    let Some(memory) = memory else {
        return Status::Null;
    };
    *memory = MaybeUninit::zeroed();
    made.map_or_else(
        |status| status,
        |part| {
            memory.write(part);
            Status::Ok
        },
    )
}

/// A part for the machine units of an image.
fn of_units<N: Number<Real = f32>, T>(
    info: Option<&Info>,
    make: impl FnOnce(&Units<N>) -> Result<T, AxisError>,
) -> Result<T, Status> {
    make(&Info::units(info)?).map_err(figure)
}

const fn figure(_: AxisError) -> Status {
    Status::Figure
}

#[unsafe(no_mangle)]
pub(crate) extern "C" fn jred_tracker_make(
    tracker: Option<&mut MaybeUninit<Tracker>>,
    bandwidth: f32,
    period: f32,
    phase: u32,
) -> Status {
    let made = Tracker::with_bandwidth(bandwidth, period);
    keep(
        tracker,
        made.map(|made| made.at(Phase::from_bits(phase)))
            .map_err(figure),
    )
}

pub(crate) type Observe<N> = Held<Observer<N>, OBSERVER_WORDS>;

/// `jred_…_motion` in C.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct CMotion<C> {
    pub(crate) phase: u32,
    pub(crate) omega: C,
    pub(crate) alpha: C,
}

/// `jred_…_observed` in C.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct CObserved<C> {
    pub(crate) motion: CMotion<C>,
    pub(crate) load: C,
    pub(crate) residual: i32,
    pub(crate) jumped: bool,
    pub(crate) limited: bool,
}

impl<N: CNumber> From<Observed<N>> for CObserved<N::C> {
    #[inline]
    fn from(seen: Observed<N>) -> Self {
        Self {
            motion: CMotion {
                phase: seen.motion.phase.to_bits(),
                omega: to_c(seen.motion.omega),
                alpha: to_c(seen.motion.alpha),
            },
            load: to_c(seen.load),
            residual: seen.residual,
            jumped: seen.jumped,
            limited: seen.limited,
        }
    }
}

/// The functions of one number type.
macro_rules! axis {
    ($prefix:literal, $number:ty) => {
        const _: () = {
            type C = <$number as CNumber>::C;
            type Motor = <$number as Number>::MotorTorque;

            #[unsafe(export_name = concat!($prefix, "_period_make"))]
            extern "C" fn period(
                memory: Option<&mut MaybeUninit<Period<$number>>>,
                info: Option<&Info>,
                seconds: f32,
            ) -> Status {
                keep(memory, of_units(info, |units| Period::new(seconds, units)))
            }

            #[unsafe(export_name = concat!($prefix, "_friction_ramp_make"))]
            extern "C" fn ramp(
                memory: Option<&mut MaybeUninit<FrictionRamp<$number>>>,
                info: Option<&Info>,
                width: f32,
            ) -> Status {
                keep(
                    memory,
                    of_units(info, |units| FrictionRamp::new(width, units)),
                )
            }

            #[unsafe(export_name = concat!($prefix, "_transmission_make"))]
            extern "C" fn transmission(
                memory: Option<&mut MaybeUninit<Transmission<$number>>>,
                info: Option<&Info>,
                gearbox: Option<&Gearbox>,
            ) -> Status {
                let made = gearbox.ok_or(Status::Null);
                let made = made
                    .and_then(|gearbox| of_units(info, |units| Transmission::new(*gearbox, units)));
                keep(memory, made)
            }

            #[unsafe(export_name = concat!($prefix, "_torque_limits_make"))]
            extern "C" fn limits(
                memory: Option<&mut MaybeUninit<TorqueLimits<Motor>>>,
                least: C,
                greatest: C,
            ) -> Status {
                let made = TorqueLimits::new(of::<Motor>(least), of(greatest));
                keep(memory, made.map_err(figure))
            }

            #[unsafe(export_name = concat!($prefix, "_observer_make"))]
            extern "C" fn observer(
                memory: Option<&mut Observe<$number>>,
                info: Option<&Info>,
                bandwidth: f32,
                period: f32,
                phase: u32,
            ) -> Status {
                let made = of_units(info, |units| {
                    Observer::with_bandwidth(bandwidth, period, units)
                });
                Held::keep(memory, made.map(|made| made.at(Phase::from_bits(phase))))
            }
        };
    };
}

axis!("jred_f32", f32);
axis!("jred_q31", Q31);
axis!("jred_q15", Q15);
