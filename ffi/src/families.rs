//! The models with functions: every format with every possible set of curves.

use jred::{
    Cubic, CurveSet, Harmonic, Q15, Q31, Quadratic, Rows16, SliderCrankForm, Spline, Spline16,
};

use crate::follower::{Follow, follow as follow_plan};
use crate::memory::Memory;
use crate::status::Status;
use crate::ticks::{observe, ticks};

macro_rules! family {
    ($name:literal, $format:ty, $number:ty, [$($set:literal)*]) => {
        const _: () = {
            /// # Safety
            /// `words` is null, or the address of `length` words that stay valid and unchanged as long as the model is ticked; `memory` is null or a
            /// `jred_memory`.
            #[unsafe(export_name = concat!("jred_", $name, "_load"))]
            unsafe extern "C" fn load(
                memory: Option<&mut Memory<$format>>,
                set: CurveSet,
                words: *const u32,
                length: usize,
            ) -> Status {
                // SAFETY: as promised by the caller.
                memory.map_or(Status::Null, |memory| unsafe { memory.load(set, words, length) })
            }

            /// # Safety
            /// `words` is null, or the address of `length` words that stay valid and unchanged as long as the follower is ticked; `memory` and
            /// `follow` are null, or a `jred_memory` and a follower of this number type.
            #[unsafe(export_name = concat!("jred_", $name, "_follow"))]
            unsafe extern "C" fn follow(
                memory: Option<&Memory<$format>>,
                follow: Option<&mut Follow<$number>>,
                words: *const u32,
                length: usize,
                period: f32,
                ramp: f32,
            ) -> Status {
                let (Some(memory), Some(follow)) = (memory, follow) else {
                    return Status::Null;
                };
                // SAFETY: as promised by the caller.
                memory.loaded().map_or(Status::NotLoaded, |model| unsafe {
                    follow_plan(follow, words, length, [period, ramp], model)
                })
            }
        };
        ticks!(concat!("jred_", $name, "_any_"), $format, $number, Memory::any);
        $(
            ticks!(concat!("jred_", $name, "_s", $set, "_"), $format, $number, Memory::known::<$set>);
            observe!(concat!("jred_", $name, "_s", $set, "_"), $format, $number, $set);
        )*
    };
}

/// A family with the sets of polynomials: with or without a load; b absent, a curve or a constant; c likewise. With `reciprocal` also those with 1/J.
macro_rules! polynomials {
    ($name:literal, $format:ty, $number:ty) => {
        #[cfg(few_sets)]
        family!($name, $format, $number, [0 21 49]);
        #[cfg(not(few_sets))]
        family!($name, $format, $number, [0 1 2 3 4 5 6 7 16 17 20 21 32 33 34 35 48 49]);
    };
    ($name:literal, $format:ty, $number:ty, reciprocal) => {
        #[cfg(few_sets)]
        family!($name, $format, $number, [0 8 21 49]);
        #[cfg(not(few_sets))]
        family!($name, $format, $number, [
            0 1 2 3 4 5 6 7 16 17 20 21 32 33 34 35 48 49
            8 9 10 11 12 13 14 15 24 25 28 29 40 41 42 43 56 57
        ]);
    };
}

polynomials!("spline_f32", Spline<f32>, f32);
polynomials!("cubic_f32", Cubic<f32>, f32);
polynomials!("quadratic_f32", Quadratic<f32>, f32);
polynomials!("spline_q31", Spline<Q31>, Q31, reciprocal);
polynomials!("cubic_q31", Cubic<Q31>, Q31, reciprocal);
polynomials!("quadratic_q31", Quadratic<Q31>, Q31, reciprocal);
polynomials!("spline16_q31", Spline16, Q31, reciprocal);
polynomials!("rows_q15", Rows16, Q15, reciprocal);

// Harmonics have more than a thousand sets. These have cosines, sines or both of J and of a load, and constant frictions; the others use the
// functions for any set.
#[cfg(few_sets)]
family!("harmonic_f32", Harmonic<f32>, f32, [2305]);
#[cfg(not(few_sets))]
family!("harmonic_f32", Harmonic<f32>, f32, [
    0 256 512 768 1 257 513 769 1025 1281 1537 1793 2049 2305 2561 2817 3073 3329 3585 3841
    16 272 528 784 17 273 529 785 1041 1297 1553 1809 2065 2321 2577 2833 3089 3345 3601 3857
    32 288 544 800 33 289 545 801 1057 1313 1569 1825 2081 2337 2593 2849 3105 3361 3617 3873
    48 304 560 816 49 305 561 817 1073 1329 1585 1841 2097 2353 2609 2865 3121 3377 3633 3889
]);

// For a slider-crank: a load with or without parts in the crank's sine and cosine, b absent or constant, c absent, the slider's, constant or both;
// the others use the functions for any set.
#[cfg(few_sets)]
family!("slider_crank_f32", SliderCrankForm, f32, [0 49 529]);
#[cfg(not(few_sets))]
family!("slider_crank_f32", SliderCrankForm, f32, [
    0 1 4 5 16 17 20 21 32 33 36 37 48 49 52 53 513 517 529 533
    545 549 561 565 1025 1029 1041 1045 1057 1061 1073 1077 1537 1541 1553 1557 1569 1573 1585 1589
]);
