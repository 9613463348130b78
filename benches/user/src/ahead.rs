//! Limits of the drive, now and ahead.

use core::hint::black_box;

use jred::axis::{
    AxisError, Braking, Direction, Envelope, FeasibleAccelerations, GovernorOutput, Governor, Limits, LookAhead,
    MotionState, Period, Stop,
};
use jred::table::SpeedOf;
use jred::{Cubic, Image, Model, Phase, Q31, Quadratic};

use crate::port::{Word, read, write};
use crate::{FIXED, PRESS, words};

macro_rules! ahead {
    ($run:ident $number:ident $format:ty, $set:ident: $feasible:ident $govern:ident $stop:ident) => {
        #[unsafe(no_mangle)]
        #[inline(never)]
        fn $feasible(
            limits: &Limits<$number, 2>,
            model: &Model<$format, $set>,
            phase: Phase,
            omega: SpeedOf<$format>,
        ) -> FeasibleAccelerations<$number> {
            limits.feasible(model, phase, omega)
        }

        #[unsafe(no_mangle)]
        #[inline(never)]
        fn $govern(
            governor: &Governor<$number, 64>,
            limits: &Limits<$number, 2>,
            model: &Model<$format, $set>,
            motion: &MotionState<$number>,
            commanded: SpeedOf<$format>,
        ) -> GovernorOutput<$number> {
            governor.govern(limits, model, motion, commanded)
        }

        #[unsafe(no_mangle)]
        #[inline(never)]
        fn $stop(ahead: &LookAhead<$number, 64>, phase: Phase, omega: SpeedOf<$format>) -> Stop {
            ahead.stop(phase, omega)
        }

        fn $run() -> Result<(), AxisError> {
            let Ok(image) = Image::new(words()) else {
                return Ok(());
            };
            let Ok(model) = image.model() else {
                return Ok(());
            };
            let motion = MotionState {
                phase: Phase::from_bits(read(3)),
                omega: Word::read(1),
                alpha: Word::read(2),
            };
            let period = Period::new(1e-3, &model)?;
            let envelope = Envelope::new([[10.0, 200.0], [20.0, 100.0]], 200.0, &model)?;
            let limits = Limits::new(envelope, 15.0, 100.0, period, &model)?;
            let braking = Braking {
                torque: 150.0,
                deceleration: 100.0,
                helped: false,
            };
            let ahead = LookAhead::new(&model, Direction::Forward, braking, |_| 10.0, &period)?;
            let stop = $stop(black_box(&ahead), motion.phase, motion.omega);
            write(stop.phase.to_bits());
            write(stop.turns);
            let governor = Governor::one_way(&ahead);
            let feasible = $feasible(
                black_box(&limits),
                black_box(&model),
                motion.phase,
                motion.omega,
            );
            feasible.least.alpha.write();
            write(feasible.unkept.is_some().into());
            let governed = $govern(
                black_box(&governor),
                &limits,
                &model,
                &motion,
                Word::read(2),
            );
            governed.alpha.write();
            write(governed.by.is_some().into());
            write(governed.unkept.is_some().into());
            Ok(())
        }
    };
}

ahead!(ahead_f32 f32 Cubic<f32>, PRESS: f32_feasible f32_govern f32_stop);
ahead!(ahead_q31 Q31 Quadratic<Q31>, FIXED: q31_feasible q31_govern q31_stop);

pub fn run() {
    write(ahead_f32().is_ok().into());
    write(ahead_q31().is_ok().into());
}
