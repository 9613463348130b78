//! jred's own ticks.
//!
//! The data of each tick is a table image.

use core::hint::black_box;

use jred::axis::{
    Counter, Encoder, FeedForward, FrictionRamp, Gearbox, MotionState, Mounting, Period,
    TorqueLimits, Tracker, Transmission,
};
use jred::number::{Number, Quantity};
use jred::table::{AccelerationOf, Format, MotorTorqueOf, SpeedOf};
use jred::{
    Cubic, CurveSet, FirmwareError, Image, Model, Phase, Q15, Q31, Quadratic, Rows16,
    SliderCrankForm, Spline, Spline16, curves,
};

use crate::target::{Kernel, Point, each};

/// Load, and constant friction of the drive link.
const FULL: CurveSet = curves::LOAD | curves::CONSTANT_VISCOUS | curves::CONSTANT_COULOMB;
/// Only the inertia.
const BARE: CurveSet = curves::INERTIA;
/// With a seed of 1/J instead of a division.
const SEED: CurveSet = curves::RECIPROCAL;

/// A function with this name, and with the number type, the layout and the curves of its model.
macro_rules! kernels {
    ($($name:ident: $number:ident, $format:ty, $set:ident, $body:expr;)*) => {
        $(
            #[unsafe(no_mangle)]
            #[inline(never)]
            extern "Rust" fn $name(
                model: &Model<$format, $set>,
                phase: Phase,
                omega: $number,
                third: $number,
            ) -> $number {
                let body: fn(&Model<$format, $set>, _, _, _) -> _ = $body;
                body(model, phase, omega, third)
            }
        )*

        pub(crate) const KERNELS: &[Kernel] = &[
            $((stringify!($name), |image, points| over(image, points, $name))),*
        ];
    };
}

/// A function with this name: from a count to a motor's torque.
macro_rules! axes {
    ($($name:ident: $number:ident, $format:ty;)*) => {
        $(
            #[unsafe(no_mangle)]
            #[inline(never)]
            extern "Rust" fn $name(
                axis: &mut Axis<$format>,
                count: u32,
                omega: SpeedOf<$format>,
                alpha: AccelerationOf<$format>,
            ) -> MotorTorqueOf<$format> {
                axis.interrupt(count, omega, alpha)
            }
        )*

        pub(crate) const AXES: &[Kernel] = &[
            $((stringify!($name), |image, points| along(image, points, $name))),*
        ];
    };
}

axes! {
    jred_f32_axis: f32, Cubic<f32>;
    jred_q31_quadratic_axis: Q31, Quadratic<Q31>;
    jred_q15_axis: Q15, Rows16;
}

kernels! {
    jred_f32_torque: f32, Cubic<f32>, FULL, |m, p, w, a| m.torque(p, of(w), of(a)).number();
    jred_f32_acceleration: f32, Cubic<f32>, BARE, |m, p, w, t| m.acceleration(p, of(w), of(t)).value.number();
    jred_f32_spline_torque: f32, Spline<f32>, FULL, |m, p, w, a| m.torque(p, of(w), of(a)).number();
    jred_f32_spline_acceleration: f32, Spline<f32>, BARE, |m, p, w, t| m.acceleration(p, of(w), of(t)).value.number();
    jred_f32_slider_crank_torque: f32, SliderCrankForm, FULL, |m, p, w, a| m.torque(p, of(w), of(a)).number();
    jred_f32_slider_crank_acceleration: f32, SliderCrankForm, BARE, |m, p, w, t| m.acceleration(p, of(w), of(t)).value.number();
    jred_q31_torque: Q31, Cubic<Q31>, FULL, |m, p, w, a| m.torque(p, of(w), of(a)).number();
    jred_q31_acceleration: Q31, Cubic<Q31>, SEED, |m, p, w, t| m.acceleration(p, of(w), of(t)).value.number();
    jred_q31_quadratic_torque: Q31, Quadratic<Q31>, FULL, |m, p, w, a| m.torque(p, of(w), of(a)).number();
    jred_q31_spline16_torque: Q31, Spline16, FULL, |m, p, w, a| m.torque(p, of(w), of(a)).number();
    jred_q31_spline16_acceleration: Q31, Spline16, SEED, |m, p, w, t| m.acceleration(p, of(w), of(t)).value.number();
    jred_q31_quadratic_acceleration: Q31, Quadratic<Q31>, SEED, |m, p, w, t| m.acceleration(p, of(w), of(t)).value.number();
    jred_q15_torque: Q15, Rows16, FULL, |m, p, w, a| m.torque(p, of(w), of(a)).number();
    jred_q15_acceleration: Q15, Rows16, SEED, |m, p, w, t| m.acceleration(p, of(w), of(t)).value.number();
    jred_f32_counts: f32, Cubic<f32>, FULL, |m, p, w, a| m.torque(counted(p), of(w), of(a)).number();
    jred_q31_quadratic_counts: Q31, Quadratic<Q31>, FULL, |m, p, w, a| m.torque(counted(p), of(w), of(a)).number();
    jred_q15_counts: Q15, Rows16, FULL, |m, p, w, a| m.torque(counted(p), of(w), of(a)).number();
}

const ENCODER: Encoder = match Encoder::new(Mounting::direct(10_000)) {
    Ok(encoder) => encoder,
    Err(_) => panic!("the encoder's figures"),
};

/// An axis with every part, whose figures hardly change the torque: the filter does not smooth, the lead time is four microseconds, friction is complete
/// from a small speed on, and the motor has no gearbox.
struct Axis<'a, F: Format> {
    counter: Counter<32>,
    tracker: Tracker,
    tick: Period<F::Number>,
    lead: Period<F::Number>,
    ramp: FrictionRamp<F::Number>,
    press: FeedForward<'a, F, FULL>,
    gearbox: Transmission<F::Number>,
    limits: TorqueLimits<MotorTorqueOf<F>>,
    speed: SpeedOf<F>,
    clipped: MotorTorqueOf<F>,
}

impl<'a, F: Format> Axis<'a, F> {
    fn new(image: &'a [u32]) -> Result<Self, FirmwareError> {
        let image = Image::new(image)?;
        let model = image.model::<F, FULL>()?;
        let gearbox = Gearbox {
            ratio: 1.0,
            efficiency: 1.0,
            rotor: 1e-9,
        };
        let limit = |torque| MotorTorqueOf::<F>::of(F::Number::per_unit(torque, 1.0).value);
        Ok(Self {
            counter: Counter::at(0),
            tracker: Tracker::new(0.0)?,
            tick: Period::new(1e-3, &model)?,
            lead: Period::new(4e-6, &model)?,
            ramp: FrictionRamp::new(1e-5 * model.table().scale().speed(), &model)?,
            gearbox: Transmission::new(gearbox, &model)?,
            limits: TorqueLimits::new(limit(-1e6), limit(1e6))?,
            press: FeedForward::new(model, image.validity()),
            speed: Quantity::of(F::Number::default()),
            clipped: Quantity::of(F::Number::default()),
        })
    }

    #[expect(
        clippy::inline_always,
        reason = "as the program of a drive, of one interrupt"
    )]
    #[inline(always)]
    fn interrupt(
        &mut self,
        count: u32,
        omega: SpeedOf<F>,
        alpha: AccelerationOf<F>,
    ) -> MotorTorqueOf<F> {
        let count = self.counter.extend(count);
        let tracked = self.tracker.update(ENCODER.phase_wide(count));
        self.speed = self.tick.omega(tracked).value;
        let reference = MotionState {
            phase: tracked.phase,
            omega,
            alpha,
        };
        let later = self.lead.later(reference).value;
        let friction = self.ramp.at(omega);
        let (phase, speed) = (later.phase, later.omega);
        let needed = self.press.at_measured(phase, speed, reference, friction);
        let motor = self.gearbox.motor(needed.torque, omega, alpha).value;
        let limited = self.limits.limited(motor);
        self.clipped = limited.clipped;
        limited.torque
    }
}

/// An interrupt of an axis: count, speed and acceleration.
type Interrupt<F> = fn(&mut Axis<'_, F>, u32, SpeedOf<F>, AccelerationOf<F>) -> MotorTorqueOf<F>;

/// Calls a kernel along the axis of an image; the speed and what was cut off replace the second and the third number of a point.
fn along<F: Format<Number: Word>>(image: &[u32], points: &mut [Point], kernel: Interrupt<F>) {
    let kernel = black_box(kernel);
    let mut axis = Axis::new(image).expect("an axis");
    for [count, omega, alpha] in points {
        let [speed, acceleration] = [*omega, *alpha].map(Word::number);
        let torque = kernel(&mut axis, *count, of(speed), of(acceleration));
        *count = torque.number().word();
        *omega = axis.speed.number().word();
        *alpha = axis.clipped.number().word();
    }
}

/// The phase of a count, which is passed as a phase.
#[expect(clippy::inline_always, reason = "a kernel contains it")]
#[inline(always)]
fn counted(count: Phase) -> Phase {
    ENCODER.phase(count.to_bits().cast_signed())
}

/// A speed, an acceleration or a torque.
fn of<Q: Quantity>(number: Q::Number) -> Q {
    Q::of(number)
}

/// Calls a kernel over the model in the image.
#[expect(clippy::type_complexity, reason = "a kernel is told by its type")]
fn over<F: Format<Number: Word>, const SET: CurveSet>(
    image: &[u32],
    points: &mut [Point],
    kernel: fn(&Model<F, SET>, Phase, F::Number, F::Number) -> F::Number,
) {
    let kernel = black_box(kernel);
    let image = Image::new(image).expect("a table image");
    let model = image.model().expect("of this format and set of curves");
    each(points, |[phase, omega, third]| {
        let [omega, third] = [omega, third].map(Word::number);
        kernel(&model, Phase::from_bits(phase), omega, third).word()
    });
}

/// A number of the tick as a word.
trait Word: Number {
    fn number(bits: u32) -> Self;
    fn word(self) -> u32;
}

impl Word for f32 {
    fn number(bits: u32) -> Self {
        Self::from_bits(bits)
    }
    fn word(self) -> u32 {
        self.to_bits()
    }
}

impl Word for Q31 {
    fn number(bits: u32) -> Self {
        Self::from_bits(bits.cast_signed())
    }
    fn word(self) -> u32 {
        self.to_bits().cast_unsigned()
    }
}

impl Word for Q15 {
    fn number(bits: u32) -> Self {
        Self::from_bits(bits as i16)
    }
    fn word(self) -> u32 {
        i32::from(self.to_bits()).cast_unsigned()
    }
}
