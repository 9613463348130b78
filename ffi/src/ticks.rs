//! The functions of one model.

/// The ticks with names that begin with `$prefix`. The caller must have checked that the memory has a model of this set, as the functions of `jred.h`
/// do: here the check would need registers that the tick uses.
macro_rules! ticks {
    ($prefix:expr, $format:ty, $number:ty, $model:expr) => {
        const _: () = {
            use core::mem::MaybeUninit;

            use jred::Phase;

            use $crate::memory::Memory;
            use $crate::number::{CNumber, Range, friction, of, to_c};

            type C = <$number as CNumber>::C;

            #[unsafe(export_name = concat!($prefix, "torque"))]
            unsafe extern "C" fn torque(
                memory: &Memory<$format>,
                phase: u32,
                omega: C,
                alpha: C,
            ) -> C {
                // SAFETY: as promised by the caller.
                let model = unsafe { $model(memory) };
                to_c(model.torque(Phase::from_bits(phase), of(omega), of(alpha)))
            }

            #[unsafe(export_name = concat!($prefix, "torque_with"))]
            unsafe extern "C" fn torque_with(
                memory: &Memory<$format>,
                phase: u32,
                omega: C,
                alpha: C,
                number: C,
                is_share: bool,
            ) -> C {
                // SAFETY: as promised by the caller.
                let model = unsafe { $model(memory) };
                let friction = friction::<$number>(number, is_share);
                let phase = Phase::from_bits(phase);
                to_c(model.torque_with(phase, of(omega), of(alpha), friction))
            }

            #[unsafe(export_name = concat!($prefix, "acceleration"))]
            unsafe extern "C" fn acceleration(
                memory: &Memory<$format>,
                phase: u32,
                omega: C,
                torque: C,
            ) -> C {
                // SAFETY: as promised by the caller.
                let model = unsafe { $model(memory) };
                let found = model.acceleration(Phase::from_bits(phase), of(omega), of(torque));
                to_c(found.value)
            }

            #[unsafe(export_name = concat!($prefix, "acceleration_range"))]
            unsafe extern "C" fn acceleration_range(
                memory: &Memory<$format>,
                phase: u32,
                omega: C,
                least: C,
                greatest: C,
                range: &mut MaybeUninit<Range<C>>,
            ) {
                // SAFETY: as promised by the caller.
                let model = unsafe { $model(memory) };
                let phase = Phase::from_bits(phase);
                let found = model.acceleration_range(phase, of(omega), of(least), of(greatest));
                range.write(Range {
                    least: to_c(found.least.value),
                    greatest: to_c(found.greatest.value),
                    least_limited: found.least.saturated,
                    greatest_limited: found.greatest.saturated,
                });
            }
        };
    };
}

/// The tick of an observer, of a set that is known when the library is compiled. Memory as above; the header also checks the observer.
macro_rules! observe {
    ($prefix:expr, $format:ty, $number:ty, $set:literal) => {
        const _: () = {
            use core::mem::MaybeUninit;

            use jred::Phase;

            use $crate::axis::{CObserved, Observe};
            use $crate::memory::Memory;
            use $crate::number::{CNumber, friction, of};

            type C = <$number as CNumber>::C;

            #[unsafe(export_name = concat!($prefix, "observe"))]
            unsafe extern "C" fn observe(
                memory: &Memory<$format>,
                observer: &mut Observe<$number>,
                measured: u32,
                torque: C,
                number: C,
                is_share: bool,
                seen: &mut MaybeUninit<CObserved<C>>,
            ) {
                // SAFETY: as promised by the caller.
                let (model, observer) = unsafe { (memory.known::<$set>(), observer.made()) };
                let friction = friction::<$number>(number, is_share);
                let phase = Phase::from_bits(measured);
                seen.write(observer.update(model, phase, of(torque), friction).into());
            }
        };
    };
}
pub(crate) use {observe, ticks};
