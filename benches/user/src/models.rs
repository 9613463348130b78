//! The calls on one model of a format: torque, acceleration, their range, and torque from counts.

use jred::table::{AccelerationOf, SpeedOf, TorqueOf};
use jred::{
    AccelerationRange, Cubic, Model, Outcome, Phase, Q15, Q31, Quadratic, Rows16, SliderCrankForm,
    Spline, Spline16,
};

use crate::port::{Word, read, write};
use crate::{CRANK, FIXED, POWER_OF_TWO, PRESS, TEN_THOUSAND, model};

macro_rules! model {
    ($number:ident $format:ty, $set:ident: $run:ident $torque:ident $acceleration:ident $range:ident $counts:ident $binary:ident) => {
        #[unsafe(no_mangle)]
        #[inline(never)]
        fn $torque(
            model: &Model<$format, $set>,
            phase: Phase,
            omega: SpeedOf<$format>,
            alpha: AccelerationOf<$format>,
        ) -> TorqueOf<$format> {
            model.torque(phase, omega, alpha)
        }

        #[unsafe(no_mangle)]
        #[inline(never)]
        fn $acceleration(
            model: &Model<$format, $set>,
            phase: Phase,
            omega: SpeedOf<$format>,
            torque: TorqueOf<$format>,
        ) -> Outcome<AccelerationOf<$format>> {
            model.acceleration(phase, omega, torque)
        }

        #[unsafe(no_mangle)]
        #[inline(never)]
        fn $range(
            model: &Model<$format, $set>,
            phase: Phase,
            omega: SpeedOf<$format>,
            most: TorqueOf<$format>,
        ) -> AccelerationRange<$number> {
            model.acceleration_range(phase, omega, TorqueOf::<$format>::default(), most)
        }

        #[unsafe(no_mangle)]
        #[inline(never)]
        fn $counts(
            model: &Model<$format, $set>,
            count: i32,
            omega: SpeedOf<$format>,
            alpha: AccelerationOf<$format>,
        ) -> TorqueOf<$format> {
            model.torque(TEN_THOUSAND.phase(count), omega, alpha)
        }

        #[unsafe(no_mangle)]
        #[inline(never)]
        fn $binary(
            model: &Model<$format, $set>,
            count: i32,
            omega: SpeedOf<$format>,
            alpha: AccelerationOf<$format>,
        ) -> TorqueOf<$format> {
            model.torque(POWER_OF_TWO.phase(count), omega, alpha)
        }

        fn $run() {
            let model = model::<$format, $set>();
            let (count, omega) = (read(0).cast_signed(), Word::read(1));
            let (alpha, torque) = (Word::read(2), Word::read(2));
            let phase = Phase::from_bits(read(3));
            $torque(&model, phase, omega, alpha).write();
            let reached = $acceleration(&model, phase, omega, torque);
            reached.value.write();
            write(reached.saturated.into());
            let range = $range(&model, phase, omega, torque);
            range.least.value.write();
            write(range.greatest.saturated.into());
            range.greatest.value.write();
            $counts(&model, count, omega, alpha).write();
            $binary(&model, count, omega, alpha).write();
        }
    };
}

model!(f32 Cubic<f32>, PRESS: cubic_f32
    cubic_f32_torque cubic_f32_acceleration cubic_f32_range cubic_f32_counts cubic_f32_binary);
model!(f32 Spline<f32>, PRESS: spline_f32
    spline_f32_torque spline_f32_acceleration spline_f32_range spline_f32_counts spline_f32_binary);
model!(f32 Quadratic<f32>, PRESS: quadratic_f32
    quadratic_f32_torque quadratic_f32_acceleration quadratic_f32_range quadratic_f32_counts quadratic_f32_binary);
model!(f32 SliderCrankForm, CRANK: crank_f32
    crank_f32_torque crank_f32_acceleration crank_f32_range crank_f32_counts crank_f32_binary);
model!(Q31 Cubic<Q31>, FIXED: cubic_q31
    cubic_q31_torque cubic_q31_acceleration cubic_q31_range cubic_q31_counts cubic_q31_binary);
model!(Q31 Quadratic<Q31>, FIXED: quadratic_q31
    quadratic_q31_torque quadratic_q31_acceleration quadratic_q31_range quadratic_q31_counts quadratic_q31_binary);
model!(Q31 Spline<Q31>, FIXED: spline_q31
    spline_q31_torque spline_q31_acceleration spline_q31_range spline_q31_counts spline_q31_binary);
model!(Q31 Spline16, FIXED: spline16_q31
    spline16_q31_torque spline16_q31_acceleration spline16_q31_range spline16_q31_counts spline16_q31_binary);
model!(Q15 Rows16, FIXED: rows_q15
    rows_q15_torque rows_q15_acceleration rows_q15_range rows_q15_counts rows_q15_binary);

pub fn run() {
    cubic_f32();
    spline_f32();
    quadratic_f32();
    crank_f32();
    cubic_q31();
    quadratic_q31();
    spline_q31();
    spline16_q31();
    rows_q15();
}
