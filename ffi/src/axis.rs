//! Creates the parts of an axis in memory of the caller. Their ticks are in the header, inlined into the C call; only the observer's and the payload's
//! are here.

use core::mem::MaybeUninit;

use jred::axis::{
    AxisError, FrictionRamp, Gearbox, Observed, Observer, Payload, PayloadEstimate, Period,
    TorqueLimits, Tracker, Transmission,
};
use jred::number::Number;
use jred::{Phase, Q15, Q31};

use crate::image::Info;
use crate::memory::Held;
use crate::number::{CNumber, of, to_c};
use crate::status::Status;

/// 64-bit words of memory for an observer and for a payload, as in `jred.h`.
pub(crate) const OBSERVER_WORDS: usize = 28;
pub(crate) const PAYLOAD_WORDS: usize = 14;

/// Writes what was created; zeros on an error, whose ticks give 0.
fn keep<T>(memory: Option<&mut MaybeUninit<T>>, made: Result<T, Status>) -> Status {
    let Some(memory) = memory else {
        return Status::Null;
    };
    *memory = MaybeUninit::zeroed();
    match made {
        Ok(part) => {
            memory.write(part);
            Status::Ok
        }
        Err(status) => status,
    }
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
pub(crate) type Pay<N> = Held<Payload<N>, PAYLOAD_WORDS>;

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

/// `jred_payload_estimate` in C.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct CEstimate {
    payload: f32,
    offset: f32,
    explained: f32,
    excited: bool,
}

impl From<PayloadEstimate> for CEstimate {
    fn from(estimate: PayloadEstimate) -> Self {
        Self {
            payload: estimate.payload,
            offset: estimate.offset,
            explained: estimate.explained,
            excited: estimate.excited,
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
                let units = Info::units::<$number>(info);
                let made = units.and_then(|units| Period::new(seconds, &units).map_err(figure));
                keep(memory, made)
            }

            #[unsafe(export_name = concat!($prefix, "_friction_ramp_make"))]
            extern "C" fn ramp(
                memory: Option<&mut MaybeUninit<FrictionRamp<$number>>>,
                info: Option<&Info>,
                width: f32,
            ) -> Status {
                let units = Info::units::<$number>(info);
                let made = units.and_then(|units| FrictionRamp::new(width, &units).map_err(figure));
                keep(memory, made)
            }

            #[unsafe(export_name = concat!($prefix, "_transmission_make"))]
            extern "C" fn transmission(
                memory: Option<&mut MaybeUninit<Transmission<$number>>>,
                info: Option<&Info>,
                gearbox: Option<&Gearbox>,
            ) -> Status {
                let units = Info::units::<$number>(info);
                let both = units.and_then(|units| Ok((units, *gearbox.ok_or(Status::Null)?)));
                let made = both.and_then(|(units, gearbox)| {
                    Transmission::new(gearbox, &units).map_err(figure)
                });
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
                let units = Info::units::<$number>(info);
                let made = units.and_then(|units| {
                    Observer::with_bandwidth(bandwidth, period, &units).map_err(figure)
                });
                let made = made.map(|made| made.at(Phase::from_bits(phase)));
                Held::keep(memory, made)
            }

            #[unsafe(export_name = concat!($prefix, "_payload_make"))]
            extern "C" fn payload(
                memory: Option<&mut Pay<$number>>,
                info: Option<&Info>,
                observer: Option<&mut Observe<$number>>,
                largest: f32,
                window: u32,
            ) -> Status {
                let observer = observer.ok_or(Status::Null);
                let observer = observer.and_then(|held| held.get().ok_or(Status::NotLoaded));
                let made = Info::units::<$number>(info).and_then(|units| {
                    Payload::new(largest, window, observer?, &units).map_err(figure)
                });
                Held::keep(memory, made)
            }

            #[unsafe(export_name = concat!($prefix, "_payload_update"))]
            extern "C" fn update(memory: Option<&mut Pay<$number>>, load: C, unit: C) {
                if let Some(payload) = memory.and_then(Held::get) {
                    payload.update(of(load), of(unit));
                }
            }

            #[unsafe(export_name = concat!($prefix, "_payload_estimate"))]
            extern "C" fn estimate(
                memory: Option<&mut Pay<$number>>,
                found: Option<&mut MaybeUninit<CEstimate>>,
            ) -> Status {
                let Some(found) = found else {
                    return Status::Null;
                };
                let found = found.write(CEstimate::default());
                let Some(payload) = memory.and_then(Held::get) else {
                    return Status::NotLoaded;
                };
                *found = payload.estimate().into();
                Status::Ok
            }
        };
    };
}

axis!("jred_f32", f32);
axis!("jred_q31", Q31);
axis!("jred_q15", Q15);
