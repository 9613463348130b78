//! An image is refused, or ticked with the same bits as in Rust.

use core::mem::zeroed;
use core::ptr::{null, null_mut};

use jred::number::FrictionSign;
use jred::table::Format;
use jred::{Cubic, CurveSet, Image, Model, Phase, Spline, curves};

use super::{PRESS, Press, jred_spline_f32_load, jred_spline_q31_load, press};
use crate::image::jred_image_info;
use crate::memory::{ANY, Memory};
use crate::status::Status;

#[allow(improper_ctypes, reason = "C sees the memory of a model as bytes")]
unsafe extern "C" {
    fn jred_cubic_f32_load(
        memory: *mut Memory<Cubic<f32>>,
        set: CurveSet,
        words: *const u32,
        length: usize,
    ) -> i32;
    fn jred_spline_f32_s21_torque(memory: *const Press, phase: u32, omega: f32, alpha: f32) -> f32;
    fn jred_spline_f32_s21_acceleration(
        memory: *const Press,
        phase: u32,
        omega: f32,
        torque: f32,
    ) -> f32;
    fn jred_spline_f32_s21_torque_with(
        memory: *const Press,
        phase: u32,
        omega: f32,
        alpha: f32,
        number: f32,
        is_share: bool,
    ) -> f32;
    fn jred_spline_f32_any_torque(memory: *const Press, phase: u32, omega: f32, alpha: f32) -> f32;
}

/// A function of C: phase and speed, and acceleration or torque.
type Tick<'t> = &'t dyn Fn(u32, f32, f32) -> f32;

/// A thousand ticks: torques and acceleration of C have the bits of Rust; the acceleration is computed from the torque.
pub(super) fn same_bits<F: Format<Number = f32>, const SET: CurveSet>(
    model: &Model<'_, F, SET>,
    torques: [Tick<'_>; 2],
    acceleration: Tick<'_>,
) {
    for k in 0..1000_u32 {
        let phase = k.wrapping_mul(4_294_967);
        let (omega, alpha) = (k as f32 * 0.03 - 15.0, 200.0 - k as f32 * 0.41);
        let torque = model.torque(Phase::from_bits(phase), omega, alpha);
        let back = model.acceleration(Phase::from_bits(phase), omega, torque);
        assert!((back.value - alpha).abs() < 1e-2, "{k}");
        let same = |a: f32, b: f32| assert_eq!(a.to_bits(), b.to_bits(), "{k}");
        for of_c in torques {
            same(of_c(phase, omega, alpha), torque);
        }
        same(acceleration(phase, omega, torque), back.value);
    }
}

#[test]
fn a_tick_through_c_has_the_bits_of_one_in_rust() {
    let words = press();
    let model: Model<'_, Spline<f32>, PRESS> = Image::new(&words).unwrap().model().unwrap();
    // SAFETY: zeros are no model; the words outlive it.
    unsafe {
        let mut memory: Press = zeroed();
        assert_eq!(
            jred_spline_f32_load(&raw mut memory, PRESS, words.as_ptr(), words.len()),
            0
        );
        let memory = &raw const memory;
        same_bits(
            &model,
            [
                &|phase, omega, alpha| jred_spline_f32_s21_torque(memory, phase, omega, alpha),
                &|phase, omega, alpha| jred_spline_f32_any_torque(memory, phase, omega, alpha),
            ],
            &|phase, omega, torque| jred_spline_f32_s21_acceleration(memory, phase, omega, torque),
        );
    }
}

/// Friction against another speed, and a share of it.
#[test]
fn friction_of_a_set_point_has_the_bits_of_rust() {
    let words = press();
    let model: Model<'_, Spline<f32>, PRESS> = Image::new(&words).unwrap().model().unwrap();
    // SAFETY: zeros are no model; the words outlive it.
    let mut memory: Press = unsafe { zeroed() };
    // SAFETY: as above.
    let status =
        unsafe { jred_spline_f32_load(&raw mut memory, PRESS, words.as_ptr(), words.len()) };
    assert_eq!(status, 0);
    for k in 0..1000_u32 {
        let phase = k.wrapping_mul(4_294_967);
        let (omega, alpha) = (k as f32 * 0.03 - 15.0, 200.0 - k as f32 * 0.41);
        let (against, share) = (15.3 - k as f32 * 0.03, k as f32 * 0.002 - 1.0);
        for (number, is_share) in [(against, false), (share, true), (0.0, false), (0.0, true)] {
            let friction = if is_share {
                FrictionSign::Scaled(number)
            } else {
                FrictionSign::OfSpeed(number)
            };
            let of_rust = model.torque_with(Phase::from_bits(phase), omega, alpha, friction);
            // SAFETY: the model was loaded.
            let of_c = unsafe {
                jred_spline_f32_s21_torque_with(
                    &raw const memory,
                    phase,
                    omega,
                    alpha,
                    number,
                    is_share,
                )
            };
            assert_eq!(of_c.to_bits(), of_rust.to_bits(), "{k} {friction:?}");
        }
    }
}

#[test]
fn what_is_no_image_of_the_model_is_refused() {
    let words = press();
    let (address, length) = (words.as_ptr(), words.len());
    let status = |status: Status| status as i32;
    let damaged = |word: usize, bit: u32| {
        let mut words = words.clone();
        words[word] ^= bit;
        words
    };
    // SAFETY: zeros are no model; null pointers are allowed; the words outlive the models.
    unsafe {
        let (mut memory, mut cubic, mut fixed): (Press, _, _) = (zeroed(), zeroed(), zeroed());
        let mut load = |set, words: *const u32, length| {
            jred_spline_f32_load(&raw mut memory, set, words, length)
        };
        assert_eq!(load(PRESS, null(), length), status(Status::Null));
        assert_eq!(
            load(PRESS, address.byte_add(2), length - 1),
            status(Status::Misaligned)
        );
        for short in [0, 1, 24, length - 1] {
            assert_eq!(
                load(PRESS, address, short),
                status(Status::Length),
                "{short}"
            );
        }
        assert_eq!(load(curves::LOAD, address, length), status(Status::Set));
        assert_eq!(load(ANY, address, length), 0);
        for (word, bit, expected) in [
            (0, 1, Status::NotAnImage),
            (1, 1, Status::Version),
            (2, 1, Status::Length),
            (30, 1, Status::Crc),
        ] {
            let words = damaged(word, bit);
            assert_eq!(load(PRESS, words.as_ptr(), length), status(expected));
        }
        assert_eq!(
            jred_spline_f32_load(null_mut(), PRESS, address, length),
            status(Status::Null)
        );
        assert_eq!(
            jred_cubic_f32_load(&raw mut cubic, PRESS, address, length),
            status(Status::Layout)
        );
        assert_eq!(
            jred_spline_q31_load(&raw mut fixed, PRESS, address, length),
            status(Status::NumberType)
        );
        assert_eq!(jred_image_info(address, length, None), Status::Null);
        assert_eq!(jred_image_info(null(), 0, None), Status::Null);
    }
}
