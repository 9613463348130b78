//! The parts before and after the model, one by one.

use core::hint::black_box;

use jred::axis::{
    FeedForward, Gearbox, ImageSlot, LimitedTorque, MotionState, Period, FrictionRamp, TorqueLimits, Transmission,
};
use jred::number::FrictionSign;
use jred::{Cubic, Image, Model, Phase};

use crate::port::{Word, read, write};
use crate::{PRESS, words};

#[unsafe(no_mangle)]
#[inline(never)]
fn status_torque(
    press: &FeedForward<Cubic<f32>, PRESS>,
    phase: Phase,
    omega: f32,
    alpha: f32,
) -> (f32, bool) {
    let motion = MotionState {
        phase,
        omega,
        alpha,
    };
    let checked = press.at_reference(motion, FrictionSign::OfSpeed(omega));
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
    let motion = MotionState {
        phase,
        omega,
        alpha,
    };
    let checked = press.at_reference(motion, FrictionSign::OfSpeed(omega));
    (checked.torque, checked.status.is_valid())
}

#[unsafe(no_mangle)]
#[inline(never)]
fn period_later(lead: &Period<f32>, motion: MotionState<f32>) -> MotionState<f32> {
    lead.later(motion).value
}

#[unsafe(no_mangle)]
#[inline(never)]
fn ramp_torque(
    model: &Model<Cubic<f32>, PRESS>,
    ramp: &FrictionRamp<f32>,
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
fn limits_limited(limits: &TorqueLimits<f32>, torque: f32) -> LimitedTorque<f32> {
    limits.limited(torque)
}

pub fn run() {
    let Ok(image) = Image::new(words()) else {
        return;
    };
    let Ok(model) = image.model() else { return };
    let motion = MotionState {
        phase: Phase::from_bits(read(3)),
        omega: f32::read(1),
        alpha: f32::read(2),
    };
    let feed_forward = FeedForward::new(model, image.validity());
    let (torque, valid) = status_torque(&feed_forward, motion.phase, motion.omega, motion.alpha);
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
        FrictionRamp::new(0.1, &model),
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
