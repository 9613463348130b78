//! Steps before and after the tick.

use core::hint::black_box;

use jred::axis::{Counter, Encoder, Period, StrokeEncoder, Tracker, TrackerOutput};
use jred::{Cubic, Model, Outcome, Phase, Q31, Quadratic, Speed};

use crate::port::{Word, read, write};
use crate::{FIXED, PRESS, TEN_THOUSAND, model};

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
fn tracker_update(tracker: &mut Tracker, phase: Phase) -> TrackerOutput {
    tracker.update(phase)
}

#[unsafe(no_mangle)]
#[inline(never)]
fn omega_f32(period: &Period<f32>, tracked: TrackerOutput) -> Outcome<f32> {
    period.omega(tracked)
}

#[unsafe(no_mangle)]
#[inline(never)]
fn omega_q31(period: &Period<Q31>, tracked: TrackerOutput) -> Outcome<Speed<Q31>> {
    period.omega(tracked)
}

/// SI units to fixed point and back.
#[unsafe(no_mangle)]
#[inline(never)]
fn si_q31(model: &Model<Quadratic<Q31>, FIXED>, phase: Phase, omega: f32, alpha: f32) -> f32 {
    let scale = *model.table().scale();
    let (omega, alpha) = (scale.omega(omega).value, scale.alpha(alpha).value);
    scale.torque_si(model.torque(phase, omega, alpha))
}

pub fn run() {
    let (count, phase) = (read(0).cast_signed(), Phase::from_bits(read(3)));
    let wide = counter_extend(black_box(&mut Counter::at(0)), read(0));
    write(wide as u32);
    write(encoder_phase(black_box(&TEN_THOUSAND), count).to_bits());
    write(encoder_phase_wide(black_box(&TEN_THOUSAND), i64::from(count) << 7).to_bits());
    let stroke = jred::Domain::Stroke { from: 0.0, to: 0.5 };
    let scaled = jred::axis::StrokeMounting {
        resolution: 1e-6,
        homing_offset: 0,
        home_position: 0.0,
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
