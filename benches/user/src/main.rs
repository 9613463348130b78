//! The calls of a drive's firmware, each a function of its own so that its instructions can be told.
//!
//! They are compiled as in firmware: several calls on one model, the image known only when the program runs, an encoder of 10 000 and one
//! of 4096 counts. The program is never run; `cargo xtask perf` follows its code.
#![no_std]
#![no_main]

use core::hint::black_box;
use core::ptr::{read_volatile, write_volatile};

use cortex_m_rt::entry;
use jred::axis::{
    AxisError, Braking, Counter, Direction, Encoder, Envelope, Feasible, FeedForward, Gearbox,
    Governed, Governor, ImageSlot, Limited, Limits, LookAhead, Motion, Mounting, Period, Ramp,
    Stop, StrokeEncoder, TorqueLimits, Tracked, Tracker, Transmission,
};
use jred::number::Sliding;
use jred::table::{AccelerationOf, Format, SpeedOf, TorqueOf};
use jred::{
    Acceleration, AccelerationRange, Cubic, Image, Model, Outcome, Phase, Q15, Q31, Quadratic,
    Rows16, Set, SliderCrankForm, Speed, Spline, Torque, curves, slider_crank,
};
use panic_halt as _;

/// The curves of the press of the examples.
const PRESS: Set = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;
/// In fixed point, with 1/J instead of a division.
const FIXED: Set = PRESS | curves::RECIPROCAL;

/// As a slider-crank in closed form: the weight of its crank has a part in sin φ.
const CRANK: Set = PRESS | slider_crank::terms::LOAD_SIN;

const fn encoder(counts_per_turn: u32) -> Encoder {
    match Encoder::new(Mounting::direct(counts_per_turn)) {
        Ok(encoder) => encoder,
        Err(_) => panic!("counts"),
    }
}
const TEN_THOUSAND: Encoder = encoder(10_000);
const POWER_OF_TWO: Encoder = encoder(4096);

/// Arguments come from and results go to where the compiler knows nothing about.
static mut PORT: [u32; 8] = [0; 8];

fn read(index: usize) -> u32 {
    unsafe { read_volatile(&raw const PORT[index & 7]) }
}

fn write(word: u32) {
    unsafe { write_volatile(&raw mut PORT[7], word) }
}

/// A number of a tick as a word.
trait Word {
    fn read(index: usize) -> Self;
    fn write(self);
}

impl Word for f32 {
    fn read(index: usize) -> Self {
        Self::from_bits(read(index))
    }
    fn write(self) {
        write(self.to_bits());
    }
}

/// A quantity in fixed point.
macro_rules! word {
    ($quantity:ident<Q31>) => {
        impl Word for $quantity<Q31> {
            fn read(index: usize) -> Self {
                Self::from_bits(read(index).cast_signed())
            }
            fn write(self) {
                write(self.to_bits().cast_unsigned());
            }
        }
    };
    ($quantity:ident<Q15>) => {
        impl Word for $quantity<Q15> {
            fn read(index: usize) -> Self {
                Self::from_bits(read(index) as i16)
            }
            fn write(self) {
                write(u32::from(self.to_bits().cast_unsigned()));
            }
        }
    };
}

word!(Speed<Q31>);
word!(Acceleration<Q31>);
word!(Torque<Q31>);
word!(Speed<Q15>);
word!(Acceleration<Q15>);
word!(Torque<Q15>);

/// The calls on one model of a format: torque, acceleration, their range, and torque from counts.
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
model!(f32 SliderCrankForm, CRANK: crank_f32
    crank_f32_torque crank_f32_acceleration crank_f32_range crank_f32_counts crank_f32_binary);
model!(Q31 Cubic<Q31>, FIXED: cubic_q31
    cubic_q31_torque cubic_q31_acceleration cubic_q31_range cubic_q31_counts cubic_q31_binary);
model!(Q31 Quadratic<Q31>, FIXED: quadratic_q31
    quadratic_q31_torque quadratic_q31_acceleration quadratic_q31_range quadratic_q31_counts quadratic_q31_binary);
model!(Q15 Rows16, FIXED: rows_q15
    rows_q15_torque rows_q15_acceleration rows_q15_range rows_q15_counts rows_q15_binary);

/// What comes before and after the tick.
mod around {
    use super::*;

    #[unsafe(no_mangle)]
    #[inline(never)]
    fn counter_extend(counter: &mut Counter<16>, register: u32) -> i64 {
        counter.extend(register)
    }

    #[unsafe(no_mangle)]
    #[inline(never)]
    fn encoder_phase(encoder: &Encoder, count: i32) -> Phase {
        encoder.phase(count)
    }

    #[unsafe(no_mangle)]
    #[inline(never)]
    fn encoder_phase_wide(encoder: &Encoder, count: i64) -> Phase {
        encoder.phase_wide(count)
    }

    #[unsafe(no_mangle)]
    #[inline(never)]
    fn stroke_phase(encoder: &StrokeEncoder, count: i32) -> Outcome<Phase> {
        encoder.phase(count)
    }

    #[unsafe(no_mangle)]
    #[inline(never)]
    fn tracker_update(tracker: &mut Tracker, phase: Phase) -> Tracked {
        tracker.update(phase)
    }

    #[unsafe(no_mangle)]
    #[inline(never)]
    fn omega_f32(period: &Period<f32>, tracked: Tracked) -> Outcome<f32> {
        period.omega(tracked)
    }

    #[unsafe(no_mangle)]
    #[inline(never)]
    fn omega_q31(period: &Period<Q31>, tracked: Tracked) -> Outcome<Speed<Q31>> {
        period.omega(tracked)
    }

    /// SI in and out of fixed point.
    #[unsafe(no_mangle)]
    #[inline(never)]
    fn si_q31(model: &Model<Quadratic<Q31>, FIXED>, phase: Phase, omega: f32, alpha: f32) -> f32 {
        let scale = *model.table().scale();
        let (omega, alpha) = (scale.omega(omega).value, scale.alpha(alpha).value);
        scale.torque_si(model.torque(phase, omega, alpha))
    }

    pub(super) fn run() {
        let (count, phase) = (read(0).cast_signed(), Phase::from_bits(read(3)));
        let wide = counter_extend(black_box(&mut Counter::at(0)), read(0));
        write(wide as u32);
        write(encoder_phase(black_box(&TEN_THOUSAND), count).to_bits());
        write(encoder_phase_wide(black_box(&TEN_THOUSAND), i64::from(count) << 7).to_bits());
        let stroke = jred::Domain::Stroke { from: 0.0, to: 0.5 };
        let scaled = jred::axis::Scaled {
            resolution: 1e-6,
            home: 0,
            at_home: 0.0,
        };
        if let Ok(stroke) = StrokeEncoder::new(stroke, scaled) {
            let phase = stroke_phase(black_box(&stroke), count);
            write(phase.value.to_bits());
            write(phase.saturated.into());
        }
        let single = model::<Cubic<f32>, PRESS>();
        let model = model();
        if let (Ok(mut tracker), Ok(single), Ok(fixed)) = (
            Tracker::new(0.9),
            Period::new(1e-4, &single),
            Period::new(1e-4, &model),
        ) {
            let tracked = tracker_update(black_box(&mut tracker), phase);
            write(tracked.acceleration.cast_unsigned());
            omega_f32(black_box(&single), tracked).value.write();
            let omega = omega_q31(black_box(&fixed), tracked);
            omega.value.write();
            write(omega.saturated.into());
        }
        si_q31(&model, phase, f32::read(1), f32::read(2)).write();
    }
}

/// What may be put before and after the model, each for itself.
mod command {
    use super::*;

    #[unsafe(no_mangle)]
    #[inline(never)]
    fn status_torque(
        press: &FeedForward<Cubic<f32>, PRESS>,
        phase: Phase,
        omega: f32,
        alpha: f32,
    ) -> (f32, bool) {
        let motion = Motion {
            phase,
            omega,
            alpha,
        };
        let checked = press.at_reference(motion, Sliding::Against(omega));
        (checked.torque, checked.status.is_valid())
    }

    #[unsafe(no_mangle)]
    #[inline(never)]
    fn slot_torque(
        slot: &ImageSlot<Cubic<f32>, PRESS>,
        phase: Phase,
        omega: f32,
        alpha: f32,
    ) -> (f32, bool) {
        let Some(press) = slot.feed_forward() else {
            return (0.0, false);
        };
        let motion = Motion {
            phase,
            omega,
            alpha,
        };
        let checked = press.at_reference(motion, Sliding::Against(omega));
        (checked.torque, checked.status.is_valid())
    }

    #[unsafe(no_mangle)]
    #[inline(never)]
    fn period_later(lead: &Period<f32>, motion: Motion<f32>) -> Motion<f32> {
        lead.later(motion).value
    }

    #[unsafe(no_mangle)]
    #[inline(never)]
    fn ramp_torque(
        model: &Model<Cubic<f32>, PRESS>,
        ramp: &Ramp<f32>,
        phase: Phase,
        omega: f32,
    ) -> f32 {
        model.torque_with(phase, omega, 0.0, ramp.at(omega))
    }

    #[unsafe(no_mangle)]
    #[inline(never)]
    fn transmission_motor(gearbox: &Transmission<f32>, torque: f32, omega: f32, alpha: f32) -> f32 {
        gearbox.motor(torque, omega, alpha).value
    }

    #[unsafe(no_mangle)]
    #[inline(never)]
    fn limits_limited(limits: &TorqueLimits<f32>, torque: f32) -> Limited<f32> {
        limits.limited(torque)
    }

    pub(super) fn run() {
        let Ok(image) = Image::new(words()) else {
            return;
        };
        let Ok(model) = image.model() else { return };
        let motion = Motion {
            phase: Phase::from_bits(read(3)),
            omega: f32::read(1),
            alpha: f32::read(2),
        };
        let feed_forward = FeedForward::new(model, image.validity());
        let (torque, valid) =
            status_torque(&feed_forward, motion.phase, motion.omega, motion.alpha);
        write(valid.into());
        let mut memory = [0; 1200];
        let mut slot = ImageSlot::new(&mut memory);
        let received = slot.receive(black_box(&[]));
        write((received.is_ok() && slot.check(16).is_some()).into());
        let (torque_of_slot, valid) =
            slot_torque(black_box(&slot), motion.phase, motion.omega, motion.alpha);
        torque_of_slot.write();
        write(valid.into());
        let gearbox = Gearbox {
            ratio: 10.0,
            efficiency: 0.95,
            rotor: 0.001,
        };
        if let (Ok(lead), Ok(ramp), Ok(gearbox), Ok(limits)) = (
            Period::new(1e-4, &model),
            Ramp::new(0.1, &model),
            Transmission::new(gearbox, &model),
            TorqueLimits::new(-5.0, 5.0),
        ) {
            let later = period_later(black_box(&lead), motion);
            let ramped = ramp_torque(
                black_box(&model),
                black_box(&ramp),
                later.phase,
                later.omega,
            );
            let motor = transmission_motor(
                black_box(&gearbox),
                torque + ramped,
                later.omega,
                later.alpha,
            );
            let limited = limits_limited(black_box(&limits), motor);
            limited.torque.write();
            limited.clipped.write();
        }
    }
}

/// What the drive can do, now and ahead.
macro_rules! ahead {
    ($run:ident $number:ident $format:ty, $set:ident: $feasible:ident $govern:ident $stop:ident) => {
        #[unsafe(no_mangle)]
        #[inline(never)]
        fn $feasible(
            limits: &Limits<$number, 2>,
            model: &Model<$format, $set>,
            phase: Phase,
            omega: SpeedOf<$format>,
        ) -> Feasible<$number> {
            limits.feasible(model, phase, omega)
        }

        #[unsafe(no_mangle)]
        #[inline(never)]
        fn $govern(
            governor: &Governor<$number, 64>,
            limits: &Limits<$number, 2>,
            model: &Model<$format, $set>,
            motion: &Motion<$number>,
            commanded: SpeedOf<$format>,
        ) -> Governed<$number> {
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
            let motion = Motion {
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

/// A table image that comes from outside the program.
fn words() -> &'static [u32] {
    static mut IMAGE: [u32; 512] = [0; 512];
    for k in 0..512 {
        unsafe { write_volatile(&raw mut IMAGE[k], read(k)) }
    }
    // Of any length: that a slider-crank of 512 words is refused is known when the program is compiled.
    let image: &[u32] = unsafe { &*&raw const IMAGE };
    black_box(image)
}

fn model<F: Format, const SET: Set>() -> Model<'static, F, SET> {
    match Image::new(words()).and_then(|image| image.model()) {
        Ok(model) => model,
        Err(_) => panic!("the image"),
    }
}

#[entry]
fn main() -> ! {
    loop {
        cubic_f32();
        spline_f32();
        crank_f32();
        cubic_q31();
        quadratic_q31();
        rows_q15();
        around::run();
        command::run();
        write(ahead_f32().is_ok().into());
        write(ahead_q31().is_ok().into());
    }
}
